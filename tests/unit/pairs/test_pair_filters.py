"""The filter for bodies in linear motion, with and without radii, against the definition."""

import math
from fractions import Fraction
from random import Random

import pytest

from exactpt import Body, BudgetExceeded, Scene, Translation, first_contact
from exactpt.collision.searches import ContactQuery, search_for
from exactpt.kernel.numbers import QQ
from exactpt.motion.outline import straight_pieces
from exactpt.pairs import search
from exactpt.pairs.features_sweep import PairsSearch
from exactpt.pairs.filters import candidates_of, window
from exactpt.pairs.pieces import ContactDistance
from exactpt.pairs.rational import span_of
from exactpt.pairs.search import first_of_candidates
from exactpt.testing.reference import first_within, nearest

SHAPES = [
    [(0, 0)],
    [(0, 0), (2, 1)],
    [(0, 0), (2, 0), (0, 2)],
    [(0, 0), (2, 0), (2, 2), (1, 1)],
    [(-1, -1), (3, -1), (3, 2), (1, 0), (-1, 2)],
]
UNITS = [Fraction(1), Fraction(1, 3), Fraction(2) ** -60, Fraction(2) ** 70, Fraction(1, 10**30)]


def body(rng, name, unit, offset, velocity, radius):
    shape, turned = rng.choice(SHAPES), rng.random() < 0.5
    at = [((y, -x) if turned else (x, y)) for x, y in shape]
    dx, dy = offset
    vertices = [((x + dx) * unit, (y + dy) * unit) for x, y in at]
    motion = Translation([0, velocity[0] * unit], [0, velocity[1] * unit])
    return Body(name, vertices, motion, radius=radius * unit)


def hard_pair(rng):
    """Two bodies on a grid of some unit, perhaps far from the origin or nearly tangential."""
    unit, far = rng.choice(UNITS), rng.choice([0, 0, 10**6, 10**13])
    radius = rng.choice([Fraction(1), Fraction(1, 2), Fraction(1, 3), Fraction(5, 4)])
    gap = rng.randint(-6, 6) + rng.choice([0, 0, Fraction(1, 3), Fraction(1, 10**12)])
    one = body(
        rng, "a", unit, (far - 9, far + gap), (rng.randint(1, 3), rng.randint(-1, 1)), radius
    )
    other = body(rng, "b", unit, (far, far), (rng.randint(-1, 0), rng.randint(-1, 1)), 0)
    return one, other


@pytest.mark.parametrize("seed", range(4))
def test_filter_with_radius_loses_no_first_contact_of_the_definition(seed):
    rng, compared, found = Random(seed), 0, 0
    end = QQ(12)
    while compared < 60:
        a, b = hard_pair(rng)
        reach = a.exact_radius + b.exact_radius
        if nearest(a, b, 0).core_squared <= reach**2:
            continue
        compared += 1
        expected = first_within(a, b, (0, end), reach**2)
        pieces = [straight_pieces(x)[0][0] for x in (a, b)]
        distance = ContactDistance.of(reach**2, reach)
        span = span_of(QQ(0), end)
        candidates = candidates_of(*pieces, span, math.inf, distance.nearest)
        meeting = first_of_candidates(*pieces, span, candidates, distance)
        assert (meeting is None) == (expected is None)
        if meeting is not None:
            found += 1
            assert meeting.time.compare(expected) == 0
            assert meeting.touches
            low, high = window(*pieces, 0.0, 12.0, distance.nearest)
            enclosed = expected.enclosure()
            assert low <= enclosed[1]
            assert enclosed[0] <= high
    assert found >= 10


def test_contact_distances_below_all_doubles_count():
    tiny = Fraction(2) ** -1200
    a = Body("a", [(0, 0)], Translation([0, 1]), radius=tiny)
    b = Body("b", [(4, -1), (4, 1)])
    assert first_contact(Scene([a, b], time=(0, 9))).time == 4 - tiny
    pieces = [straight_pieces(x)[0][0] for x in (a, b)]
    assert ContactDistance.of(QQ(tiny) ** 2, QQ(tiny)).nearest > 0.0
    assert len(candidates_of(*pieces, span_of(QQ(0), QQ(9)), distance=math.ulp(0.0))) >= 1


def test_bodies_with_radii_in_linear_motion_are_not_searched_in_slabs(monkeypatch):
    monkeypatch.setattr(PairsSearch, "run_to_contact", None)
    discs = [Body(str(k), [(3 * k, 0)], Translation([0, 1 - k]), radius=1) for k in range(14)]
    for count in (2, 14):
        contact = first_contact(Scene(discs[:count], time=(0, 9)))
        assert contact.kind == "vertex-vertex"
        assert contact.time == 1


def test_overlap_at_the_start_ends_the_search(monkeypatch):
    monkeypatch.setattr(search._Search, "run", None)
    monkeypatch.setattr(PairsSearch, "_run", None)
    far = [Body(f"far{k}", [(30 + 3 * k, 0)], Translation([0, -k])) for k in range(12)]
    two = [Body("a", [(0, 0)], radius=2), Body("b", [(1, 0)], radius=1)]
    curved = Body("curved", [(0, 90)], Translation([0, 0, 1]))
    for bodies in ([*two, *far], [*two, *far, curved]):
        contact = first_contact(Scene(bodies, time=(0, 1)))
        assert contact.kind == "initial"
        assert contact.initial_pairs == (("a", "b"),)


def test_search_interrupted_between_pieces_has_passed_no_contact(monkeypatch):
    """At each comparison, the claimed interval is closed and has no contact."""
    bodies = [Body("point", [(200, 0)], Translation([0, 1])), Body("wall", [(208, -1), (208, 1)])]
    for k in range(6):  # parallel segments that pass each other: their boxes intersect at 2 + k
        by = 20 * k - 10 - k
        bodies.append(Body(f"post {k}", [(20 * k, 0), (20 * k + 8, 8)]))
        passing = [(by + 3, -10 - k), (by + 11, -2 - k)]
        bodies.append(Body(f"passes {k}", passing, Translation([0, 1], [0, 1])))
    scene = Scene(bodies, time=(0, 9))
    first = first_contact(scene).time
    claimed, compare = [], search._Search.compare

    def watched(self, a, b):
        claimed.append(running.contact_free_until())
        compare(self, a, b)
        claimed.append(running.contact_free_until())

    monkeypatch.setattr(search._Search, "compare", watched)
    running = search_for(scene, ContactQuery("auto", "auto"))
    assert running.contact_free_until() is None
    assert running.run_to_contact().time == first
    assert len(claimed) >= 4
    assert all(0 <= t < first for t in claimed)
    stats = running.stats
    assert stats["certificates"] == stats["exact"] + stats["filtered"] == len(claimed) // 2


def test_linear_search_out_of_time_says_so():
    bodies = [Body("a", [(0, 0)], Translation([0, 1])), Body("b", [(4, -1), (4, 1)])]
    running = search_for(Scene(bodies, time=(0, 9)), ContactQuery("auto", "auto", max_seconds=0.0))
    with pytest.raises(BudgetExceeded) as spent:
        running.run_to_contact()
    assert spent.value.reached == 0
