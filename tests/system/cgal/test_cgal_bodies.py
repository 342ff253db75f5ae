"""Two bodies at one time, and unions, by CGAL: every value is found by hand."""

from fractions import Fraction

import pytest

import exactpt
from exactpt import Body, InputError, Translation
from exactpt.cgal import BodyShape, PlacedBody, Relation, Verdict

pytestmark = pytest.mark.cgal


def square(left, bottom, side):
    left, bottom, side = map(Fraction, (left, bottom, side))
    right, top = left + side, bottom + side
    return [(left, bottom), (right, bottom), (right, top), (left, top)]


def polygon(points):
    return Body("polygon", points)


def chain(*points):
    return Body("chain", points, closed=False)


UNIT = polygon(square(0, 0, 1))
FRAME = Body("frame", square(0, 0, 6), holes=[square(1, 1, 4)])
SEGMENT = chain((0, 0), (4, 0))
TWO = Body("two", parts=[square(0, 0, 1), square(10, 0, 1)])
# A hole that touches the outline with a corner in the middle of an edge, at (3, 0).
PINCHED = Body("pinched", square(0, 0, 6), holes=[[(3, 0), (4, 2), (2, 2)]])
LARGE = 10**400


def point(x, y):
    return Body("point", [(x, y)])


PAIRS = {
    "points": (point(0, 0), point(3, 4), (False, False, 25)),
    "equal points": (point(0, 0), point(0, 0), (True, False, 0)),
    "point beside an end": (SEGMENT, point(-3, 4), (False, False, 25)),
    "point above": (SEGMENT, point(1, 3), (False, False, 9)),
    "point on a segment": (SEGMENT, point(3, 0), (True, False, 0)),
    # The line x + 2 y = 0 is at |2 + 2 * 3| / sqrt(5) from (2, 3): 64 / 5 squared.
    "oblique": (chain((-9, "9/2"), (9, "-9/2")), point(2, 3), (False, False, Fraction(64, 5))),
    "segments that cross": (SEGMENT, chain((1, -1), (2, 1)), (True, False, 0)),
    "segments end to end": (SEGMENT, chain((4, 0), (9, 5)), (True, False, 0)),
    "segments on a line": (SEGMENT, chain((5, 0), (9, 0)), (False, False, 1)),
    "segments that overlap": (SEGMENT, chain((3, 0), (9, 0)), (True, False, 0)),
    "parallel segments": (SEGMENT, chain((9, 2), (-9, 2)), (False, False, 4)),
    "point in a chain": (chain((0, 0), (4, 0), (4, 4), (0, 4)), point(1, 2), (False, False, 4)),
    "place twice in a chain": (chain((0, 0), (0, 0), (1, 0)), point(0, 2), (False, False, 4)),
    "point inside": (UNIT, point("1/3", "2/7"), (True, False, 0)),
    "point on an edge": (UNIT, point("1/3", 0), (True, False, 0)),
    "point next to an edge": (UNIT, point("1/3", "-1/7"), (False, False, Fraction(1, 49))),
    "segment inside": (polygon(square(-9, -9, 18)), SEGMENT, (True, False, 0)),
    "segment across": (UNIT, chain((-1, "1/2"), (2, "1/2")), (True, False, 0)),
    "squares apart": (UNIT, polygon(square(4, 5, 1)), (False, False, 25)),
    "squares with a common edge": (UNIT, polygon(square(1, 0, 1)), (True, False, 0)),
    "squares with a common corner": (UNIT, polygon(square(1, 1, 1)), (True, False, 0)),
    "equal squares": (UNIT, polygon(square(0, 0, 1)[::-1]), (True, True, 0)),
    "square in a square": (UNIT, polygon(square(-9, -9, 18)), (True, True, 0)),
    "squares that overlap": (UNIT, polygon(square("1/2", 0, 1)), (True, True, 0)),
    "square in a hole": (FRAME, polygon(square(2, 2, 2)), (False, False, 1)),
    "square that fills a hole": (FRAME, polygon(square(1, 1, 4)), (True, False, 0)),
    "square over a hole": (FRAME, polygon(square(2, 2, 4)), (True, True, 0)),
    "square around a frame": (FRAME, polygon(square(-1, -1, 8)), (True, True, 0)),
    "square in the wood of a frame": (FRAME, polygon(square(0, 0, 1)), (True, True, 0)),
    "point in a hole": (FRAME, point(4, 2), (False, False, 1)),
    "frame in a hole": (
        FRAME,
        Body("small", square(2, 2, 2), holes=[square("5/2", "5/2", 1)]),
        (False, False, 1),
    ),
    "second part": (TWO, polygon(square(11, 1, 3)), (True, False, 0)),
    "inside of the second part": (TWO, point("21/2", "1/2"), (True, False, 0)),
    "between the parts": (TWO, point(5, 0), (False, False, 16)),
    "point at the pinch": (PINCHED, point(3, 0), (True, False, 0)),
    "point in the hole at the pinch": (PINCHED, point(3, 1), (False, False, Fraction(1, 5))),
    "triangle that fills the hole": (
        PINCHED,
        polygon([(3, 0), (4, 2), (2, 2)]),
        (True, False, 0),
    ),
    "beyond the doubles": (
        point(LARGE, LARGE),
        chain((0, 1), (2 * LARGE, 2 * LARGE + 1)),
        (False, False, Fraction(1, 2)),
    ),
}


def related(witness, a, b, time=0):
    return witness.relate(PlacedBody.of_body(a, time), PlacedBody.of_body(b, time))


@pytest.mark.parametrize("name", PAIRS)
def test_relation_of_two_bodies_is_the_one_by_hand(witness, name):
    a, b, expected = PAIRS[name]

    assert related(witness, a, b) == expected
    assert related(witness, b, a) == expected


def test_relation_at_a_time_is_that_of_the_places_then(witness):
    """The example of `CgalCheck.relate`: the point falls from 3 above the square into it."""
    box, ball = polygon(square(0, 0, 2)), Body("ball", [(1, 5)], Translation([], [0, -1]))

    assert [related(witness, box, ball, time) for time in (0, 3, 4)] == [
        Relation(do_intersect=False, do_overlap=False, squared=Fraction(9)),
        Relation(do_intersect=True, do_overlap=False, squared=Fraction(0)),
        Relation(do_intersect=True, do_overlap=False, squared=Fraction(0)),
    ]


def test_radius_is_not_part_of_a_placed_body(witness):
    assert related(witness, Body("disc", [(0, 0)], radius=9), point(3, 4)).squared == 25


@pytest.mark.parametrize(
    ("points", "ring"),
    [
        ([(0, 0), (2, 2), (2, 0), (0, 2)], "the outline of part 0"),  # crosses itself
        ([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)], "the outline of part 0"),
        ([(0, 0), (2, 0), (4, 0)], "the outline of part 0"),  # without area
    ],
)
def test_ring_that_is_not_simple_is_refused(witness, points, ring):
    bad = PlacedBody(BodyShape("bad", len(points)), points)

    with pytest.raises(InputError, match=f"cgal_check: {ring} of body 1 is not simple"):
        witness.relate(PlacedBody.of_body(UNIT, 0), bad)
    with pytest.raises(InputError, match=f"cgal_check: {ring} of body 0 is not simple"):
        witness.relate(bad, PlacedBody.of_body(UNIT, 0))


def test_hole_that_is_not_simple_is_named(witness):
    points = [*square(0, 0, 9), (1, 1), (3, 3), (3, 1), (1, 3)]
    bad = PlacedBody(BodyShape("bad", 8, parts=[[range(4), range(4, 8)]]), points)

    with pytest.raises(InputError, match="hole 0 of part 0 of body 0 is not simple"):
        witness.relate(bad, PlacedBody.of_body(UNIT, 0))


@pytest.mark.parametrize(
    ("shape", "points", "message"),
    [
        (BodyShape("bad", 3), [(0, 0), (1, 0)], "body 'bad': 3 points are needed, got 2"),
        (BodyShape("bad", 1), [(0, 0, 0)], r"a point must have two coordinates, got \(0, 0, 0\)"),
        (BodyShape("bad", 1), [(0, "1/0")], "denominator is zero"),
        (BodyShape("bad", 1), [(0, float("nan"))], "nan"),
        (
            BodyShape("bad", 3, parts=[[[0, 1, -1]]]),
            [(0, 0), (1, 0), (0, 1)],
            r"body 'bad': the parts must have each vertex from 0 to 2 once, got \[0, 1, -1\]",
        ),
        (BodyShape("bad", 0), [], "cgal_check refuses the request"),
    ],
)
def test_placed_body_that_is_wrong_is_refused(witness, shape, points, message):
    bad = PlacedBody(shape, points)

    with pytest.raises(InputError, match=message):
        witness.relate(bad, bad)
    with pytest.raises(InputError, match=message):
        witness.check_union([bad], bad)


def united(witness, bodies, union):
    return witness.check_union(
        [PlacedBody.of_body(body, 0) for body in bodies], PlacedBody.of_body(union, 0)
    )


def test_union_is_confirmed_and_another_one_is_not(witness):
    """Squares of area 4 with a common square of area 1: the example of `check_union`."""
    first, second = Body("first", square(0, 0, 2)), Body("second", square(1, 1, 2))
    both = exactpt.union([first, second], name="both")

    assert united(witness, [first, second], both) == Verdict(
        ok=True, stats={"parts": 1, "holes": 0}
    )
    assert united(witness, [first], both) == Verdict(
        ok=False, reason="an area of 0 is missing, of 3 is too much"
    )
    assert united(witness, [both], first).reason == "an area of 3 is missing, of 0 is too much"


def test_union_of_four_bars_has_a_hole(witness):
    """Bars around the square from (1, 1) to (5, 5): a frame, and not the full square."""
    bars = [
        polygon([(left, bottom), (right, bottom), (right, top), (left, top)])
        for left, bottom, right, top in [(0, 0, 6, 1), (0, 5, 6, 6), (0, 0, 1, 6), (5, 0, 6, 6)]
    ]

    assert united(witness, bars, FRAME).stats == {"parts": 1, "holes": 1}
    full = united(witness, bars, polygon(square(0, 0, 6)))
    assert full.reason == "an area of 0 is missing, of 16 is too much"


def test_union_that_touches_itself_is_confirmed(witness):
    """The squares touch in (1, 1): two parts for exactpt, and one description of it by CGAL."""
    squares = [UNIT, polygon(square(1, 1, 1))]
    corners = Body("both", parts=[square(0, 0, 1), square(1, 1, 1)])

    assert united(witness, squares, corners).ok
    assert not united(witness, squares, TWO).ok


def test_areas_of_a_wrong_union_are_exact(witness):
    third = polygon(square(0, 0, "1/3"))

    assert united(witness, [UNIT], third).reason == "an area of 8/9 is missing, of 0 is too much"
