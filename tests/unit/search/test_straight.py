"""Bodies that move straight: contacts close to degeneracy, and how few pairs are compared."""

import json
import math
import sys
from itertools import product
from random import Random

import pytest

from exactpt import Body, Contact, Pieces, Scene, Translation, first_contact, first_within
from exactpt.kernel.numbers import QQ
from exactpt.pair import incidences
from exactpt.search.first import pair_search
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement

HEIGHTS = [0.0, 0.0, 0.0, 1.0, 2.0, 1e-9]


def summary(contact):
    return None if contact is None else json.dumps(contact.to_json())


def odd(rng, x):
    """A double, or one beside it, or a rational nearby that is no double."""
    kind = rng.randrange(40)
    if kind == 0:
        return math.nextafter(x, rng.choice([-math.inf, math.inf]))
    return QQ(*x.as_integer_ratio()) + QQ(1, 3 << 60) if kind == 1 else x


def degenerate(rng):
    """A few small bodies on a grid, some of their coordinates off by an ulp or less."""
    bodies = []
    far = rng.choice([0.0, 0.0, 1e6, 2.0**40])
    for i in range(rng.randint(2, 4)):
        x, y = far + 8 * i, rng.choice(HEIGHTS)
        size = rng.randint(1, 5)
        points = [
            (odd(rng, x + rng.randrange(4)), odd(rng, y + rng.randrange(4))) for _ in range(size)
        ]
        speed = [odd(rng, rng.choice([-2.0, -1.0, 0.0, 1.0])) for _ in range(2)]
        first = Translation([0, speed[0]], [0, speed[1]])
        if rng.random() < 0.3:
            back = Translation([speed[0]], [speed[1]])
            bodies.append((points, Pieces([(1, first), (None, back)])))
        else:
            bodies.append((points, first))
    return bodies


def scenes(count, name):
    rng = Random(name)
    found = 0
    while found < count:
        try:
            bodies = [
                Body(f"b{i}", p, m, closed=rng.random() < 0.7)
                for i, (p, m) in enumerate(degenerate(rng))
            ]
            scene = Scene(bodies, (0, rng.choice([1, 8, "100/3"])))
        except ValueError:  # not simple
            continue
        found += 1
        yield scene


@pytest.mark.long
@pytest.mark.parametrize("count", [150, pytest.param(5000, marks=pytest.mark.slow)])
def test_contact_close_to_degeneracy_is_as_defined(count):
    kinds = set()
    for scene in scenes(count, "close"):
        expected = reference.first_contact(scene)
        contact = first_contact(scene)
        assert disagreement(expected, contact) is None
        kinds.update({None} if contact is None else {pair.kind for pair in contact.pairs})
    assert kinds == {None, "vertex-edge", "vertex-vertex"}


def test_along_the_line_of_an_edge():
    """A vertex slides along the line of an edge: the contact is at the edge's end."""
    table = Body("table", [(0, -1), (4, -1), (4, 0), (0, 0)])
    for start, speed, time in ((-3, 2, 1.5), (9, -1, 5)):
        for shape in ([(start, 0)], [(start, 0), (start, 3)], [(start, 0), (start, 2), (start, 5)]):
            slider = Body("slider", shape, Translation([0, speed]), closed=False)
            contact = first_contact(Scene([table, slider], (0, 10)))
            expected = reference.first_contact(Scene([table, slider], (0, 10)))
            assert contact.time == time
            assert disagreement(expected, contact) is None


def bits(rng, count):
    """A random number below 1 with so many bits, and sign."""
    return QQ(rng.randrange(1, 1 << count), 1 << count) * rng.choice([-1, 1])


def beside(points, at, along, side):
    """The points, mirrored at ``at`` where they are not on a side of its line."""
    (x, y), (dx, dy) = at, along
    return [
        (u, v) if side * (dx * (v - y) - dy * (u - x)) > 0 else (2 * x - u, 2 * y - v)
        for u, v in points
    ]


def touching_at_ends(rng, *, in_doubles, far):
    """A segment whose end only touches the end of another, or a corner, and when.

    They are on two sides of the path of that end.
    """
    time = QQ(rng.randint(1, 2000), 256)
    long, short = (24, 12) if in_doubles else (40, 60)
    w = bits(rng, long) / (1 if in_doubles else 3), bits(rng, long) / (1 if in_doubles else 3)
    q = far + bits(rng, short), bits(rng, short)
    start = q[0] - w[0] * time, q[1] - w[1] * time
    side = rng.choice([-1, 1])
    ends = [(q[0] + bits(rng, 30), q[1] + bits(rng, 30)) for _ in range(rng.randint(1, 2))]
    back = [(start[0] + bits(rng, 30), start[1] + bits(rng, 30))]
    body = [q, *beside(ends, q, w, side)]
    moving = [start, *beside(back, q, w, -side)]
    number = float if in_doubles else str
    exact = all(QQ(*float(c).as_integer_ratio()) == c for p in (*body, *moving) for c in p)
    scene = Scene(
        [
            Body(
                "moving",
                [tuple(map(number, p)) for p in moving],
                Translation([0, number(w[0])], [0, number(w[1])]),
            ),
            Body("body", [tuple(map(number, p)) for p in body]),
        ],
        (0, 8),
    )
    return (scene, time) if exact or not in_doubles else None


@pytest.mark.long
@pytest.mark.parametrize("in_doubles", [True, False])
@pytest.mark.parametrize("far", [0, 1000])
def test_rounding_misses_no_end_that_is_touched(in_doubles, far):
    """At the end of an edge, or between two points, a filter without bounds misses contacts."""
    rng = Random(f"ends {in_doubles} {far}")
    asked = 0
    while asked < 250:
        found = touching_at_ends(rng, in_doubles=in_doubles, far=far)
        if found is not None:
            asked += 1
            contact = first_contact(found[0])
            assert contact is not None
            assert (contact.time, contact.kind) == (found[1], "vertex-vertex")
            ends = [
                Body(f"end{i}", [body.at(0)[0]], body.motion)
                for i, body in enumerate(found[0].bodies)
            ]
            contact = first_contact(Scene(ends, (0, 8)))
            assert contact is not None
            assert contact.time == found[1]


def test_two_segments_and_two_points_on_one_line():
    for first, second in (([(0, 0), (1, 0)], [(5, 0), (7, 0)]), ([(0, 0)], [(5, 0)])):
        scene = Scene([Body("a", first, Translation([0, 1])), Body("b", second)], (0, 10))
        contact = first_contact(scene)
        assert contact.kind == "vertex-vertex"
        assert disagreement(reference.first_contact(scene), contact) is None


def crowd(count, seed=0):
    rng = Random(seed)
    bodies = []
    for i in range(count):
        x, y = 4.0 * (i % 32) + rng.random(), 4.0 * (i // 32) + rng.random()
        corners = [(x, y), (x + rng.random() + 0.2, y), (x, y + rng.random() + 0.2)]
        velocity = rng.uniform(-1, 1), rng.uniform(-1, 1)
        bodies.append((f"b{i}", corners, Translation([0, velocity[0]], [0, velocity[1]])))
    return bodies


def test_a_crowd_of_doubles_is_built_without_a_rational(monkeypatch):
    """Neither vertices nor velocities are converted, and no exact predicate is asked."""
    count = [0]

    def counted(*_, **__):
        count[0] += 1

    bodies = crowd(200)
    monkeypatch.setattr("exactpt.motion.shape.polynomial", counted)
    monkeypatch.setattr("exactpt.motion.shape.rational", counted)
    monkeypatch.setattr("exactpt.kernel.polynomial.rational", counted)
    monkeypatch.setattr("exactpt.geometry.touching_rings.ring_meetings", counted)
    Scene([Body(*body) for body in bodies], (0, 1))
    assert count == [0]


def test_exact_vertices_are_made_for_what_may_touch_alone():
    scene = Scene([Body(*body) for body in crowd(200)], (0, 4))
    contact = first_contact(scene)
    made = [body for body in scene.bodies if body.exact_shape.is_exact]
    assert contact is not None
    assert len(made) < 40
    exactly = pair_search(scene, exact_only=True)
    assert summary(contact) == summary(exactly.run_to_contact())


def test_points_and_normals_are_computed_on_demand(monkeypatch):
    asked = []

    def recorded(*arguments):
        asked.append(1)
        return incidences.details(*arguments)

    monkeypatch.setattr("exactpt.pair.contact.details", recorded)
    box = [(0, 0), (1, 0), (1, 1), (0, 1)]
    scene = Scene(
        [Body("a", box, Translation([0, 1])), Body("b", [(x + 3, y) for x, y in box])], (0, 9)
    )
    contact = first_contact(scene)
    assert (contact.time, contact.kind, asked) == (2, "vertex-vertex", [])
    assert len(contact.pairs) == 2
    assert contact.pairs is contact.pairs
    assert len(asked) == 1
    with pytest.raises(AttributeError, match="cannot be changed"):
        contact.kind = "initial"


def test_an_irrational_time_has_its_polynomial_whenever_it_is_asked():
    ball = Body("ball", [(0, 2)], Translation([0], [0, 0, -1]))
    scene = Scene([ball, Body("floor", [(-1, 0), (1, 0)])], (0, 9))
    contact = first_contact(scene)
    assert contact.time.polynomial == (-2, 0, 1)
    again = Contact(contact.time, contact.kind, contact.pairs)
    assert repr(again) == repr(contact)


def counts_of(scene):
    """Return the counts of the whole search in a scene, and its contact."""
    search = pair_search(scene)
    contact = search.run_to_contact()
    return search.stats, contact


def test_bodies_in_many_pieces_that_keep_apart_have_few_pairs_compared():
    """20 bodies of 100 pieces keep apart: |x| <= 2 + 3 / 5, and they are 8 from each other.

    So the boxes of two bodies, of all their pieces, do not meet; of 1.9 million pairs of pieces
    hardly one is compared.
    """
    rng = Random(5)
    bodies = []
    for i in range(20):
        since, x, pieces = QQ(0), QQ(0), []
        for _ in range(99):
            until, speed = since + QQ(rng.randint(1, 999), 5000), QQ(rng.randint(-3, 3))
            if abs(x + speed * (until - since)) > 2:
                speed = -speed
            pieces.append((until, Translation([x - speed * since, speed], [0])))
            since, x = until, x + speed * (until - since)
        pieces.append((None, Translation([x], [0])))
        bodies.append(Body(f"b{i}", [(9 * i, 0), (9 * i + 1, 0), (9 * i, 1)], Pieces(pieces)))

    counts, contact = counts_of(Scene(bodies, (0, 10)))

    assert contact is None
    assert counts["pairs"] < 20


def test_pairs_that_come_near_after_the_first_contact_are_not_compared():
    """Pair i meets at t = 4 + i: the tip (1 + t, 9 i + 1/2) comes to an edge at x = 5 + i.

    It is a vertex on the inside of an edge, which a filter knows for certain. So pairs whose boxes
    meet later are left out: a box of pair i meets the other one when they touch.
    """
    bodies = []
    for i in range(40):
        bodies += [
            Body(f"a{i}", [(0, 9 * i), (1, 9 * i + 0.5), (0, 9 * i + 1)], Translation([0, 1])),
            Body(f"b{i}", [(5 + i, 9 * i), (6 + i, 9 * i), (5 + i, 9 * i + 1)]),
        ]

    counts, contact = counts_of(Scene(bodies, (0, 100)))

    assert contact.time == 4
    assert counts["pairs"] < 8


@pytest.mark.plain
def test_time_reached_at_any_line_of_the_search_is_before_the_contact():
    """A signal may end a search anywhere, and `contact_free_until` is then what it has reached.

    It is called at each line of the search: it never decreases, and is less than the contact. Rows
    of squares fly apart, so slabs get longer; above them a square at x = t + 1 comes to x = 100.
    """
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    bodies = [
        Body(f"{i},{j}", [(3 * i + x, 3 * j + y) for x, y in square], Translation([0, 0.1 * i]))
        for i, j in product(range(-4, 4), range(8))
    ]
    bodies.append(Body("moving", [(x, 40 + y) for x, y in square], Translation([0, 1])))
    bodies.append(Body("still", [(100 + x, 40 + y) for x, y in square]))
    search = pair_search(Scene(bodies, (0, 1000)))
    reached = []

    def trace(frame, event, _):
        name = frame.f_code.co_filename
        if event == "line":
            sys.settrace(None)
            reached.append(search.contact_free_until())
            sys.settrace(trace)
        return trace if "/exactpt/search/" in name else None

    sys.settrace(trace)
    try:
        contact = search.run_to_contact()
    finally:
        sys.settrace(None)

    known = [time for time in reached if time is not None]
    assert search.stats["slabs"] > 1
    assert known == sorted(known)
    assert contact.time == 99
    assert 99 > known[-1] >= known[0] == 0


def test_least_speed_of_doubles_is_searched_like_others():
    """The gap of 4 closes by 10 * 2^-1074 at most."""
    least = math.ulp(0.0)
    corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]
    slow = Body("slow", [(x + 5.0, y) for x, y in corners], Translation([0.0, -least]))
    scene = Scene([Body("still", corners), slow], (0, 10))

    assert first_contact(scene) is None
    assert first_within(scene, distance=3) is None


def test_least_height_of_doubles_is_swept_like_others():
    """Two zigzags of that height; one crosses the other at once, at a speed that no double has."""
    least = math.ulp(0.0)
    zigzag = [(float(k), least * (k % 2)) for k in range(101)]
    fast = Body(
        "fast", [(x, 1 + y) for x, y in zigzag], Translation([0], [0, -(10**400)]), closed=False
    )
    scene = Scene([Body("still", zigzag, closed=False), fast], (0, 1))

    contact = first_contact(scene)

    assert contact is not None
    assert 0 < contact.time < QQ(1, 10**399)
