"""Fill rules and unions: degenerate rings with known results, and references that share no code."""

import math
from collections import Counter
from fractions import Fraction
from itertools import combinations
from random import Random

import pytest
import shapely
from shapely.ops import polygonize, unary_union

from exactpt.geometry import overlay
from exactpt.geometry.overlay import Part, as_given, evenodd, nonzero, union
from exactpt.geometry.polygon import signed_area2
from exactpt.kernel.numbers import QQ
from fuzz.overlays import Drawing, fault_of_drawing, fault_of_parts, random_drawing


def ring(*points):
    return [(QQ(x), QQ(y)) for x, y in points]


def square(x, y, side, *, clockwise=False):
    corners = ring((x, y), (x + side, y), (x + side, y + side), (x, y + side))
    return corners[::-1] if clockwise else corners


def places(parts):
    """The rings of each part as pairs of integers or texts."""
    return [
        [
            [tuple(int(c) if c.denominator == 1 else str(c) for c in p) for p in r]
            for r in part.rings
        ]
        for part in parts
    ]


def area(parts):
    return sum((signed_area2(r) for part in parts for r in part.rings), QQ(0)) / 2


BIG, SMALL = square(0, 0, 9), square(3, 3, 2)
SQUARE = [[(0, 0), (9, 0), (9, 9), (0, 9)]]
HOLE = [(3, 3), (3, 5), (5, 5), (5, 3)]
TIE = [[[(0, 0), (2, 2), (0, 4)]], [[(4, 4), (2, 2), (4, 0)]]]
NOTCH = ring((4, 0), (5, 2), (3, 2))


@pytest.mark.parametrize(
    "rings, by_nonzero, by_evenodd",
    [
        ([], [], []),
        ([[]], [], []),
        ([ring((1, 1))], [], []),
        ([ring((1, 1), (1, 1), (1, 1))], [], []),
        ([ring((0, 0), (4, 4))], [], []),
        ([ring((0, 0), (4, 4), (2, 2))], [], []),
        ([BIG], [SQUARE], [SQUARE]),
        ([BIG[::-1]], [[[(0, 9), (0, 0), (9, 0), (9, 9)]]], [[[(0, 9), (0, 0), (9, 0), (9, 9)]]]),
        ([[*BIG, BIG[0]]], [SQUARE], [SQUARE]),
        ([[p for p in BIG for _ in range(3)]], [SQUARE], [SQUARE]),
        # a bow tie: two parts that meet in a point
        ([ring((0, 0), (4, 4), (4, 0), (0, 4))], TIE, TIE),
        # a ring in another one, of the same and of the other orientation
        ([BIG, SMALL], [SQUARE], [[*SQUARE, HOLE]]),
        ([BIG, SMALL[::-1]], [[*SQUARE, [(3, 5), (5, 5), (5, 3), (3, 3)]]],
         [[*SQUARE, [(3, 5), (5, 5), (5, 3), (3, 3)]]]),
        # a ring twice, in the same direction and in opposite ones
        ([BIG, BIG], [SQUARE], []),
        ([BIG * 2], [SQUARE], []),
        ([BIG, BIG[::-1]], [], []),
        # a spike outside, one inside, and one along the boundary
        ([ring((0, 0), (9, 0), (9, 9), (12, 12), (9, 9), (0, 9))], [SQUARE], [SQUARE]),
        ([ring((0, 0), (9, 0), (9, 9), (5, 5), (9, 9), (0, 9))], [SQUARE], [SQUARE]),
        ([ring((0, 0), (9, 0), (4, 0), (9, 0), (9, 9), (0, 9))],
         [[[(0, 0), (4, 0), (9, 0), (9, 9), (0, 9)]]],
         [[[(0, 0), (4, 0), (9, 0), (9, 9), (0, 9)]]]),
        # two squares with a common edge, in the same direction of turning and in opposite ones
        ([square(0, 0, 2), square(2, 0, 2)],
         [[[(0, 0), (2, 0), (4, 0), (4, 2), (2, 2), (0, 2)]]],
         [[[(0, 0), (2, 0), (4, 0), (4, 2), (2, 2), (0, 2)]]]),
        ([square(0, 0, 2), square(2, 0, 2, clockwise=True)],
         [[[(0, 0), (2, 0), (4, 0), (4, 2), (2, 2), (0, 2)]]],
         [[[(0, 0), (2, 0), (4, 0), (4, 2), (2, 2), (0, 2)]]]),
        # two squares that meet in a corner
        ([square(0, 0, 2), square(2, 2, 2)],
         [[[(0, 0), (2, 0), (2, 2), (0, 2)]], [[(2, 2), (4, 2), (4, 4), (2, 4)]]],
         [[[(0, 0), (2, 0), (2, 2), (0, 2)]], [[(2, 2), (4, 2), (4, 4), (2, 4)]]]),
        # a hole that touches the outline in a point: the edge keeps no vertex there
        ([BIG, NOTCH[::-1]], [[*SQUARE, [(3, 2), (5, 2), (4, 0)]]],
         [[*SQUARE, [(3, 2), (5, 2), (4, 0)]]]),
        # one ring that comes back to a vertex of its own: outline and hole
        ([ring((0, 0), (4, 0), (3, 2), (5, 2), (4, 0), (9, 0), (9, 9), (0, 9))],
         [[[(0, 0), (4, 0), (9, 0), (9, 9), (0, 9)], [(4, 0), (3, 2), (5, 2)]]],
         [[[(0, 0), (4, 0), (9, 0), (9, 9), (0, 9)], [(4, 0), (3, 2), (5, 2)]]]),
        # a hole that touches the outline in two points divides the inside
        ([BIG, ring((0, 3), (4, 4), (9, 3), (4, 5))],
         [SQUARE],
         [[[(0, 0), (9, 0), (9, 3), (4, 4), (0, 3)]], [[(9, 9), (0, 9), (0, 3), (4, 5), (9, 3)]]]),
        # three segments through one point: six sectors, every other one filled
        ([ring((-2, -1), (2, 1), (0, 2), (0, -2), (2, -1), (-2, 1))], None,
         [[[(-2, -1), (0, 0), (-2, 1)]], [[(2, 1), (0, 2), (0, 0)]], [[(0, -2), (2, -1), (0, 0)]]]),
        # an island in a hole
        ([BIG, square(1, 1, 7, clockwise=True), SMALL],
         [[*SQUARE, [(1, 8), (8, 8), (8, 1), (1, 1)]], [[(3, 3), (5, 3), (5, 5), (3, 5)]]],
         [[*SQUARE, [(1, 8), (8, 8), (8, 1), (1, 1)]], [[(3, 3), (5, 3), (5, 5), (3, 5)]]]),
    ],
)  # fmt: skip
def test_degenerate_rings_have_known_parts(rings, by_nonzero, by_evenodd):
    assert places(evenodd(rings)) == by_evenodd
    if by_nonzero is not None:
        assert places(nonzero(rings)) == by_nonzero
    assert fault_of_drawing(Drawing("given", [r for r in rings if r])) is None


def test_pentagram_differs_by_the_rules():
    """A star of five turns twice around its middle: evenodd leaves out the middle."""
    star = ring((0, 30), (18, -24), (-28, 9), (28, 9), (-18, -24))

    (whole,), points = nonzero([star]), evenodd([star])

    assert (len(whole.outline), whole.holes) == (10, [])
    assert [len(part.outline) for part in points] == [3] * 5
    assert area([whole]) > area(points)


@pytest.mark.parametrize("kind", ["same", "opposite"])
def test_a_chain_of_rings_encloses_a_hole(kind):
    """Four squares that meet in corners: parts each, around a hole that is no part's."""
    squares = [square(*corner, 2) for corner in ((0, 2), (2, 0), (4, 2), (2, 4))]
    if kind == "opposite":
        squares[1::2] = [r[::-1] for r in squares[1::2]]

    parts = nonzero(squares)

    assert [len(part.rings) for part in parts] == [1, 1, 1, 1]
    assert fault_of_drawing(Drawing("given", squares)) is None


def test_union_takes_either_orientation_and_keeps_holes():
    frame = Part(BIG[::-1], [square(1, 1, 7)])
    bar = Part(ring((0, 4), (9, 4), (9, 5), (0, 5)))

    (whole,) = union([frame, bar])

    assert area([whole]) == 81 - 49 + 7
    assert [len(hole) for hole in whole.holes] == [4, 4]
    assert places(union([frame, Part(square(1, 1, 7, clockwise=True))]))[0][1:] == []


def test_unchanged_rings_come_back_as_given():
    first = BIG[2:] + BIG[:2]
    second, third = (square(x, y, 2, clockwise=True) for x, y in ((20, 0), (21, 1)))

    parts = as_given(nonzero([first, second, third]), [first, second, third])

    assert parts[0].outline is first
    assert len(parts[1].outline) == 8
    assert as_given(evenodd([second]), [second])[0].outline is second


@pytest.mark.long(*(f"{block}-{size}" for block in range(1, 4) for size in ("few", "many")))
@pytest.mark.parametrize("size", ["few", "many"])
@pytest.mark.parametrize("block", range(4))
def test_random_drawings_have_the_parts_of_the_definition(monkeypatch, block, size):
    """Once as usual, once by the ways of many edges and of long lines of a sweep.

    See `fuzz.overlays`; `python -m fuzz questions --question overlay` goes on.
    """
    if size == "many":
        monkeypatch.setattr(overlay, "FEW", 0)
        monkeypatch.setattr(overlay, "SHORT", 0)
    for seed in range(40 * block, 40 * (block + 1)):
        drawing = random_drawing(Random(f"overlay {seed}"))
        assert fault_of_drawing(drawing) is None, (seed, drawing.kind)


@pytest.mark.parametrize(
    "rings, parts, fault",
    [
        ([BIG, SMALL], [Part(BIG, [SMALL[::-1]])], None),
        ([BIG, SMALL], [Part(BIG)], "filled from"),
        ([BIG, SMALL], [], "filled from"),
        ([BIG, SMALL], [Part(BIG, [SMALL])], "area"),
        ([BIG], [Part([BIG[0], (QQ(5), QQ(0)), *BIG[1:]])], "neither given nor a crossing"),
        ([BIG, NOTCH], [Part([BIG[0], NOTCH[0], *BIG[1:]], [NOTCH[::-1]])], "within an edge"),
        (
            [ring((0, 0), (4, 4), (4, 0), (0, 4))],
            [Part(ring((0, 0), (2, 2), (4, 0), (4, 4), (2, 2), (0, 4)))],
            "a ring is not simple",
        ),
        (
            [square(0, 0, 2), square(2, 0, 2)],
            [Part(square(0, 0, 2)), Part(square(2, 0, 2))],
            "more than a point in common",
        ),
        (
            [BIG, ring((0, 3), (4, 4), (9, 3), (4, 5))],
            [Part(BIG, [ring((0, 3), (4, 5), (9, 3), (4, 4))])],
            "not connected",
        ),
    ],
)
def test_the_reference_notices_wrong_parts(rings, parts, fault):
    """Of the even-odd rule: a filled hole, no part, vertices too many, what is not valid."""
    found = fault_of_parts(parts, rings, lambda numbers: sum(numbers) % 2 == 1)
    assert found == fault if fault is None else fault in found


def crossings(edges):
    """The points that two edges have in common, by fractions of Python."""
    for ((ax, ay), (bx, by)), ((cx, cy), (dx, dy)) in combinations(edges, 2):
        cross = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
        if cross:
            s = Fraction((cx - ax) * (dy - cy) - (cy - ay) * (dx - cx), cross)
            t = Fraction((cx - ax) * (by - ay) - (cy - ay) * (bx - ax), cross)
            if 0 <= s <= 1 and 0 <= t <= 1:
                yield ax + s * (bx - ax), ay + s * (by - ay)


def scaled_to_integers(loops):
    """The loops times the least integer that makes all crossings integers."""
    edges = [edge for loop in loops for edge in zip(loop, loop[1:] + loop[:1], strict=True)]
    factor = math.lcm(*(c.denominator for p in crossings(edges) for c in p))
    return [[(x * factor, y * factor) for x, y in loop] for loop in loops]


def winding(loop, point):
    """The turns of a loop around a point that is on no edge of it, by crossings of a ray."""
    x, y = point.x, point.y
    turns = 0
    for (ax, ay), (bx, by) in zip(loop, loop[1:] + loop[:1], strict=True):
        side = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        if ay <= y < by and side > 0:
            turns += 1
        elif by <= y < ay and side < 0:
            turns -= 1
    return turns


def by_shapely(loops, is_filled):
    """The faces of the linework whose winding numbers are filled, by shapely."""
    lines = unary_union([shapely.LineString([*loop, loop[0]]) for loop in loops])
    faces = polygonize(lines)
    inside = [(face, face.representative_point()) for face in faces]
    return unary_union(
        [face for face, p in inside if is_filled([winding(loop, p) for loop in loops])]
    )


def in_shapely(parts):
    return shapely.MultiPolygon(
        [
            shapely.Polygon(outline, holes)
            for outline, *holes in (
                [[(int(x), int(y)) for x, y in r] for r in p.rings] for p in parts
            )
        ]
    )


RULES = {
    "nonzero": (nonzero, lambda turns: sum(turns) != 0),
    "evenodd": (evenodd, lambda turns: sum(turns) % 2 == 1),
    "union": (
        lambda rings: union(part for r in rings for part in evenodd([r])),
        lambda turns: any(n % 2 for n in turns),
    ),
}


@pytest.mark.parametrize("rule", RULES)
def test_loops_of_integers_agree_with_shapely(rule):
    """Where crossings are integers, shapely's are exact: valid, and no area in the difference."""
    fill, is_filled = RULES[rule]
    random, seen = Random(rule), Counter()
    while sum(seen.values()) < 120:
        size = random.choice([2, 3, 4, 6])
        loops = scaled_to_integers(
            [
                [(random.randint(0, size), random.randint(0, size)) for _ in range(n)]
                for n in random.choice([[7], [9], [5, 4], [4, 4, 4]])
            ]
        )
        if max(c for loop in loops for p in loop for c in p) > 1 << 24:
            continue
        found = in_shapely(fill([ring(*loop) for loop in loops]))
        expected = by_shapely(loops, is_filled)
        assert found.is_valid, (loops, shapely.is_valid_reason(found))
        assert found.area == expected.area, loops
        assert found.symmetric_difference(expected).area == 0, loops
        seen[len(found.geoms)] += 1
    assert len(seen) > 3


def wheel(count, random):
    """A star-shaped ring of doubles."""
    return [
        (QQ(math.cos(k * math.tau / count) * r), QQ(math.sin(k * math.tau / count) * r))
        for k in range(count)
        for r in [random.uniform(0.5, 1)]
    ]


def test_doubles_decide_nearly_everything_of_many_vertices(monkeypatch):
    """Of 10,000 vertices, of which 30 pairs of neighbours change places, so that edges cross."""
    random = Random(4)
    rim = wheel(10_000, random)
    for k in random.sample(range(0, 9_999, 2), 30):
        rim[k], rim[k + 1] = rim[k + 1], rim[k]
    exact = overlay.orientation
    decided = []
    monkeypatch.setattr(overlay, "orientation", lambda *points: decided.append(1) or exact(*points))

    parts = nonzero([rim])

    assert 1 <= len(parts) <= 31
    assert len(decided) < 2_000
    assert sum(len(r) for part in parts for r in part.rings) > 10_000


@pytest.mark.parametrize("count", [300])
def test_concentric_rings_alternate(count):
    rings = [square(k, k, 2 * (count - k)) for k in range(count)]

    parts = evenodd(rings)

    assert [len(part.holes) for part in parts] == [1] * (count // 2)
    assert len(nonzero(rings)) == 1


@pytest.mark.parametrize("scale", [QQ(10) ** 400, QQ(1, 10**400), QQ(1, 3)])
def test_sizes_beyond_doubles_do_not_matter(scale):
    """Two wheels of integers, apart from the scale: the same rings."""
    rounded = [[(QQ(round(x * 1000)), QQ(round(y * 1000))) for x, y in wheel(60, Random(k))]
               for k in range(2)]  # fmt: skip

    large = nonzero([[(x * scale, y * scale) for x, y in r] for r in rounded])

    assert large == [
        Part([(x * scale, y * scale) for x, y in outline],
             [[(x * scale, y * scale) for x, y in hole] for hole in holes])
        for outline, holes in nonzero(rounded)
    ]  # fmt: skip
