"""First contacts of bodies with a radius: by hand, against the definition, and as text."""

import json
import pickle
from fractions import Fraction
from itertools import combinations
from random import Random

import pytest
from mpmath import mp, mpf

from exactpt import (
    Body,
    BudgetExceeded,
    InputError,
    Pieces,
    Planner,
    Rigid,
    Scene,
    Simulation,
    Translation,
    first_contact,
    first_within,
)
from exactpt.check import check_run
from exactpt.kernel.numbers import QQ
from exactpt.pairs import search
from exactpt.pairs.features import FeaturePair
from exactpt.pairs.features_sweep import PairsSearch
from exactpt.proof import prove
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from exactpt.testing.scenes import ROUNDED, generate

RIGHT = Translation([0, 1])
WALL = Body("wall", [(10, -9), (10, 9)])
BOX = Body("box", [(0, 0), (5, 0), (5, 9), (0, 9)])


def disc(name="disc", at=(0, 0), radius=1, motion=RIGHT):
    return Body(name, [at], motion, radius=radius)


def met(*bodies, time=(0, 20), **options):
    return first_contact(Scene(bodies, time), **options)


def test_two_discs():
    contact = met(disc(), disc("other", (5, 1), "1/2", Translation()))
    (pair,) = contact.pairs

    assert contact.time.polynomial == (95, -40, 4)  # (5 - t)^2 + 1 = (3/2)^2
    assert contact.kind == pair.kind == "vertex-vertex"
    assert (pair.body, pair.vertex, pair.other, pair.other_vertex) == ("disc", 0, "other", 0)
    assert pair.normal == (-(1.25**0.5) / 1.5, -2 / 3)
    assert pair.point == pytest.approx((float(contact.time) - pair.normal[0], 2 / 3), abs=1e-15)


def test_a_disc_and_a_wall():
    (pair,) = met(disc(), WALL).pairs

    assert met(disc(), WALL).time == 9
    assert (pair.kind, pair.other, pair.edge) == ("vertex-edge", "wall", 0)
    assert (pair.point, pair.normal) == ((10.0, 0.0), (-1.0, 0.0))


def test_a_disc_and_a_rounded_wall():
    """The point is on both boundaries: neither on a core nor in the middle."""
    contact = met(disc(), Body("wall", WALL.vertices, radius="1/4"))

    assert (contact.time, contact.pairs[0].point) == (Fraction(35, 4), (9.75, 0.0))


def test_the_corner_of_a_box():
    contact = met(disc(at=(-4, -3), radius="5/2", motion=Translation([0, 1], [0, 1])), BOX)
    (pair,) = contact.pairs

    assert pair.kind == "vertex-vertex"
    assert contact.time.polynomial == (75, -56, 8)


@pytest.mark.parametrize("gap, time", [(0, 5), ("1e-40", None), ("-1e-40", 5)])
def test_a_graze(gap, time):
    """Discs that pass at the sum of the radii, and less or more by nearly nothing."""
    contact = met(disc(radius=1), disc("post", (5, 2), 1 - Fraction(gap), Translation()))

    if time is None:
        assert contact is None
    else:
        assert float(contact.time) == pytest.approx(time)
        assert (contact.time == 5) == (gap == 0)


def test_a_slide_begins_at_the_end_of_the_capsule():
    """The distance of the lines is that of a touch for all times."""
    floor = Body("floor", [(0, 0), (6, 0)], radius=1)
    slider = Body("slider", [(-8, 2), (-6, 2)], RIGHT, radius=1)
    contact = met(floor, slider)

    assert contact.time == 6
    assert [(p.kind, p.vertex, p.other_vertex) for p in contact.pairs] == [("vertex-vertex", 0, 1)]


def test_a_disc_that_fills_a_corner_touches_both_walls():
    corner = Body("corner", [(-9, 0), (0, 0), (0, 9)], closed=False)
    contact = met(corner, disc(at=(-5, 5), motion=Translation([0, 1], [0, -1])))

    assert contact.time == 4
    assert [(p.other, p.edge) for p in contact.pairs] == [("corner", 0), ("corner", 1)]


def test_a_disc_that_rolls_round_a_corner_keeps_its_gap():
    """On the arc it is as far from the corner for all times; then it meets what stands there."""
    roll = Pieces(
        [(4, Translation([-4, 1])), (5, Rigid([4, -1])), (None, Translation([2], [3, -1]))]
    )
    table = Body("table", [(-6, -4), (0, -4), (0, 0), (-6, 0)])
    rolling = disc(at=(0, 2), motion=Pieces([(4, Translation([-4, 1])), (None, Rigid([4, -1]))]))

    assert met(table, rolling, time=(0, 5)) is None
    assert (
        met(table, Body("disc", [(0, 2)], rolling.motion, radius=2), time=(0, 5)).kind == "initial"
    )
    assert roll.motions[1] == rolling.motion.motions[1]
    stop = Body("stop", [("7/2", 0)], radius="1/2")
    contact = met(table, stop, rolling, time=(0, 5))
    assert (contact.time, contact.pairs[0].point) == (5, (3.0, 0.0))


def test_a_contact_where_the_motion_changes():
    back = Pieces([(9, RIGHT), (None, Translation([18, -1]))])

    assert met(disc(motion=back), WALL).time == 9
    assert met(disc(motion=back, radius="999/1000"), WALL) is None


@pytest.mark.parametrize(
    "at, pairs",
    [((10, 0), []), ((9, 0), [("wall", 0)]), ((9.5, 0), []), ((8.5, 0), None)],
    ids=["on it", "touching", "overlapping", "apart"],
)
def test_at_the_start(at, pairs):
    contact = met(disc(at=at), WALL)

    if pairs is None:
        assert contact.kind == "vertex-edge"
        return
    assert (contact.kind, contact.time, contact.initial_pairs) == (
        "initial",
        0,
        (("disc", "wall"),),
    )
    assert [(pair.other, pair.edge) for pair in contact.pairs] == pairs


def test_a_body_inside_of_another_one_overlaps_it():
    inside = disc(at=(2, 4), radius="1/100")

    assert met(inside, BOX).initial_pairs == (("disc", "box"),)
    assert met(Body("big", BOX.vertices, radius=1), disc(at=(2, 4), radius=0)).kind == "initial"


def test_a_hole_is_no_inside():
    """A ring of a chain: its interior is free."""
    ring = Body("ring", [(-5, -5), (5, -5), (5, 5), (-5, 5), (-5, -4)], closed=False)

    assert met(disc(), ring).time == 4


def test_a_rounded_body_does_not_touch_itself():
    jaw = [(-1, 0), (4, 0), (4, 1), (0, 1), (0, 3), {"x": [4], "y": [3, -1]}, (4, 4), (-1, 4)]

    assert met(Body("jaw", jaw), time=(0, 9)).kind == "self"
    assert met(Body("jaw", jaw, radius="1/9"), time=(0, 9)) is None
    assert met(
        Body("jaw", jaw, radius="1/9"), disc(at=(9, 2), motion=Translation([0, -1]))
    ).time == (5 - Fraction(10, 9))


def test_ignored_groups():
    bodies = [disc(), disc("post", (5, 0), 1, Translation()), WALL]

    assert met(*bodies).time == 3
    assert met(*bodies, ignoring=[["disc", "post"]]).time == 9
    assert met(*bodies, ignoring=[["disc", "post", "wall"]]) is None


def test_bodies_without_radius_among_rounded_ones():
    """Whatever comes first counts; what comes at the same time is reported together."""
    point = Body("point", [(0, 5)], RIGHT)

    assert met(point, disc(), WALL).kind == "vertex-edge"
    assert [p.body for p in met(point, disc(), WALL).pairs] == ["disc"]
    late = disc(radius=1, at=(1, 0))
    both = met(Body("point", [(2, 5)], RIGHT), late, WALL)
    assert (both.time, [p.body for p in both.pairs]) == (8, ["point", "disc"])


def test_a_contact_is_told():
    contact = met(disc(), WALL)

    assert pickle.loads(pickle.dumps(contact)).pairs == contact.pairs
    data = json.loads(json.dumps(contact.to_json()))
    assert data["pairs"] == [
        {
            "kind": "vertex-edge",
            "a": {"body": "disc", "vertex": 0},
            "b": {"body": "wall", "edge": 0},
            "point": [10.0, 0.0],
            "normal": [-1.0, 0.0],
        }
    ]


def summary(contact):
    return None if contact is None else contact.to_json()


def alike(scene):
    """The contact, found in three ways, as the definition has it."""
    expected = reference.first_contact(scene)
    for found in (
        first_contact(scene),
        PairsSearch(scene).run_to_contact(),
        PairsSearch(scene, exact_only=True).run_to_contact(),
    ):
        assert disagreement(expected, found) is None
    return expected


@pytest.mark.long
@pytest.mark.parametrize("family", sorted(ROUNDED))
@pytest.mark.parametrize("count", [12, pytest.param(300, marks=pytest.mark.slow)])
def test_families_against_the_definition(family, count):
    kinds = set()
    for seed in range(count):
        scene = generate(family, seed)
        if scene.vertex_count <= 40:
            contact = alike(scene)
            kinds.add(contact and contact.kind)

    assert kinds - {None, "initial"}


def exact_places(body, t):
    """The positions at a time with many digits."""
    tracks = body.exact_piece_after(t.exact_low).tracks
    x = mpf(int(t.exact_low.numerator)) / int(t.exact_low.denominator)

    def value(f):
        return sum((mpf(int(c)) * x**k for k, c in enumerate(f)), mpf(0))

    return [(value(p.x) / value(p.w), value(p.y) / value(p.w)) for p in tracks]


@pytest.mark.long
@pytest.mark.parametrize("family", ["discs", "rounded_motions", "rounded_grid"])
def test_point_and_normal_are_the_nearest_doubles(family):
    """Computed again from the cores, in 200 digits."""
    mp.dps = 220
    told_of = 0
    for seed in range(40):
        scene = generate(family, seed)
        contact = first_contact(scene)
        if contact is None or contact.kind == "initial":
            continue
        while contact.time.exact_high - contact.time.exact_low > QQ(1, 2**700):
            contact.time.refine()
        for pair in contact.pairs:
            one, other = scene.body(pair.body), scene.body(pair.other)
            reach = one.radius + other.radius
            if not reach:
                continue
            told_of += 1
            v = exact_places(one, contact.time)[pair.vertex]
            places = exact_places(other, contact.time)
            if pair.edge is None:
                foot = places[pair.other_vertex]
            else:
                a, b = places[pair.edge], places[(pair.edge + 1) % len(places)]
                e = b[0] - a[0], b[1] - a[1]
                share = (e[0] * (v[0] - a[0]) + e[1] * (v[1] - a[1])) / (e[0] ** 2 + e[1] ** 2)
                foot = a[0] + share * e[0], a[1] + share * e[1]
            r, s = (mpf(int(q.numerator)) / int(q.denominator) for q in (reach, other.radius))
            normal = (v[0] - foot[0]) / r, (v[1] - foot[1]) / r
            assert abs(normal[0] ** 2 + normal[1] ** 2 - 1) < mpf(10) ** -60
            assert pair.normal == pytest.approx(tuple(map(float, normal)), rel=1e-15, abs=1e-60)
            point = foot[0] + s * normal[0], foot[1] + s * normal[1]
            assert pair.point == pytest.approx(tuple(map(float, point)), rel=1e-15, abs=1e-60)

    assert told_of > 3


@pytest.mark.parametrize("shift", [0, 10**9, 2**60])
def test_a_crowd_far_away(shift):
    """The same contact, wherever the scene is."""
    rng = Random(5)
    at = [(rng.randint(0, 60), rng.randint(0, 60)) for _ in range(40)]
    speed = [(rng.randint(-2, 2), rng.randint(-2, 2)) for _ in at]
    bodies = [
        Body(str(i), [(x + shift, y - shift)], Translation([0, u], [0, v]), radius="1/3")
        for i, ((x, y), (u, v)) in enumerate(zip(at, speed, strict=True))
        if at.index((x, y)) == i
    ]
    contact = met(*bodies)

    assert contact.time == met(*bodies, exact_only=True).time
    assert [(p.body, p.other) for p in contact.pairs] == [("3", "36")] or contact.kind != "initial"


def test_a_crowd_needs_few_exact_decisions(monkeypatch):
    decided = []
    exactly = search.first_at_distance
    monkeypatch.setattr(
        search, "first_at_distance", lambda *given: decided.append(1) or exactly(*given)
    )
    rng = Random(3)
    bodies = [
        disc(str(i), (5.0 * (i % 20) + rng.random(), 5.0 * (i // 20) + rng.random()), 1.0,
             Translation([0.0, rng.uniform(-1, 1)], [0.0, rng.uniform(-1, 1)]))
        for i in range(400)
    ]  # fmt: skip
    assert met(*bodies).kind == "vertex-vertex"

    assert 1 <= len(decided) <= 10


def test_large_bodies_and_other_motions_are_searched_in_slabs():
    zigzag = [(k, k % 2) for k in range(100)] + [(99, 9), (0, 9)]
    falling = disc(at=(50, -60), motion=Translation([0], [0, 0, 1]))
    contact = alike(Scene([Body("saw", zigzag), falling], (0, 9)))

    assert contact.kind in ("vertex-edge", "vertex-vertex")
    assert abs(float(contact.time) - 59**0.5) < 0.1


@pytest.mark.parametrize("family", sorted(ROUNDED))
def test_a_planner_finds_what_first_contact_does(family):
    scene = generate(family, 3)
    *others, body = scene.bodies
    planner = Planner(others, (scene.start, scene.end))
    groups = [[other.name for other in others]] if len(others) > 1 else []
    expected = first_contact(scene, ignoring=groups)
    if expected is None or expected.kind != "self":
        assert summary(planner.first_contact(body, body.motion)) == summary(expected)


def test_what_keeps_a_tiling_refuses_rounded_bodies():
    scene = Scene([disc(), WALL], (0, 20))
    told_why = "body 'disc' has a radius: no tiling holds rounded bodies"
    for ask in (
        lambda: Simulation(scene),
        lambda: first_contact(scene, method="kinetic"),
        lambda: first_contact(scene, tiling="lazy"),
        lambda: first_contact(scene, proof="proof"),
        lambda: prove(scene),
        lambda: check_run(scene),
        lambda: Simulation(Scene([WALL], (0, 20))).add(disc()),
    ):
        with pytest.raises(InputError, match=told_why):
            ask()


def test_a_bounded_search_says_how_far_it_came():
    bodies = [disc(str(i), (3 * i, 0), 1, Translation([0], [0, 0, i])) for i in range(300)]
    with pytest.raises(BudgetExceeded) as spent:
        met(*bodies, max_seconds=0)
    assert spent.value.reached in (None, 0)


def test_new_contacts_after_a_touch_at_the_start():
    """Discs that kiss, part, and meet again; and one that presses into another at once."""
    hop = Pieces([(2, Translation([2], [0, 1])), (None, Translation([2], [4, -1]))])
    post = disc("post", (0, 0), 1, Translation())
    hopping = disc("hopping", (0, 0), 1, hop)

    assert met(post, hopping).kind == "initial"
    assert met(post, hopping, after_start=True).time == 4
    pressing = disc("pressing", (2, 0), 1, Translation([0, -1]))
    assert met(post, pressing, after_start=True).time == 0
    rolling = disc("rolling", (2, 0), 1, Rigid([0, 1]))
    assert met(post, rolling, after_start=True) is None
    assert met(post, rolling, WALL, after_start=True, between=[("post", "wall")]) is None


def test_some_pairs_and_a_later_start():
    bodies = [disc(), disc("post", (5, 0), 1, Translation()), WALL]

    assert met(*bodies, between=[("disc", "wall")]).time == 9
    assert met(*bodies, since=4).initial_pairs == (("disc", "post"),)
    assert met(*bodies, since=8).time == 9


def test_any_two_rounded_bodies_within_a_distance():
    bodies = [disc(), disc("post", (5, 0), 1, Translation()), WALL, Body("dot", [(7, 9)])]
    scene = Scene(bodies, (0, 20))

    found = first_within(scene, distance="1/2")

    times = [first_within(scene, a.name, b.name, "1/2") for a, b in combinations(bodies, 2)]
    assert found.time == min(time for time in times if time is not None)


def test_features_that_graze_after_the_contact_are_not_decided_exactly(monkeypatch):
    """Vertices that pass at the sum of the radii have double roots, later than the contact."""
    decided = []
    exactly = FeaturePair.first_time
    monkeypatch.setattr(
        FeaturePair, "first_time", lambda self, *given: decided.append(1) or exactly(self, *given)
    )
    quarter = Fraction(1, 4)
    a = Body("a", [(0, 0), (1, 0), (0, 1)], Translation([0, 1]), radius=quarter)
    b = Body("b", [(6, 0), (7, "1/2"), ("13/2", "3/2")], Translation([0, -1]), radius=quarter)

    assert met(a, b).time == Fraction(9, 4)
    assert len(decided) <= 4
