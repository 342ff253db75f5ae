"""Where rings touch: the points, faults, and whether the inside of a part is connected."""

from random import Random

import pytest
import shapely
from shapely.geometry import MultiPolygon, Polygon

from exactpt import Body, InputError, Scene
from exactpt.geometry.touching_rings import FaultKind, dividing_loop, ring_meetings
from exactpt.kernel.numbers import QQ
from exactpt.motion.rings import ring_edges
from exactpt.testing.reference.valid import is_valid
from fuzz.questions.touching_rings import random_parts

SQUARE = [(0, 0), (8, 0), (8, 8), (0, 8)]


def meetings(*rings):
    """Of rings that are parts of their own, which changes nothing."""
    points, parts = [], []
    for ring in rings:
        parts.append((range(len(points), len(points) + len(ring)),))
        points += [(QQ(x), QQ(y)) for x, y in ring]
    return ring_meetings(points, ring_edges(tuple(parts)), [ring for (ring,) in parts])


def touches(*rings):
    found = meetings(*rings)
    assert found.fault is None
    return {touch.point: set(touch.passages) for touch in found.touches}


def test_touches_of_a_vertex_and_an_edge_and_of_two_vertices_are_points():
    on_edge, at_corner = [(4, 0), (5, 2), (3, 2)], [(0, 0), (2, 1), (1, 2)]
    assert touches(SQUARE, on_edge) == {(4, 0): {0, 1}}
    assert touches(SQUARE, at_corner) == {(0, 0): {0, 1}}


@pytest.mark.parametrize("turn", [1, -1])
@pytest.mark.parametrize("back", [1, -1])
def test_touches_do_not_depend_on_the_orientation_of_rings(turn, back):
    """A hole between two that share its tip; and one in the reflex angle of another."""
    above, between = [(4, 4), (7, 6), (4, 7)], [(4, 4), (7, 5), (7, 3)]
    assert touches(SQUARE[::turn], above[::back], between[::turn]) == {(4, 4): {1, 2}}
    opposite = [(4, 4), (1, 1), (7, 3)]  # leaves the point against the directions of the other
    assert touches(SQUARE[::turn], above[::back], opposite[::turn]) == {(4, 4): {1, 2}}
    assert touches(SQUARE[::turn], opposite[::back], above[::turn]) == {(4, 4): {1, 2}}
    dart, inner = [(1, 1), (7, 4), (1, 7), (4, 4)], [(4, 4), (2, 5), (2, 3)]
    assert touches(SQUARE[::turn], dart[::back], inner[::turn]) == {(4, 4): {1, 2}}
    wide = [(4, 4), (6, 6), (6, 2)]
    assert meetings(SQUARE, dart[::back], wide[::turn]).fault.kind is FaultKind.CROSSING


def test_three_rings_in_one_point_are_one_touch():
    one, two, three = (
        [(4, 4), (6, 3), (6, 5)], [(4, 4), (3, 6), (5, 6)], [(4, 4), (2, 3), (2, 5)]
    )  # fmt: skip
    assert touches(SQUARE, one, two, three) == {(4, 4): {1, 2, 3}}


@pytest.mark.parametrize(
    ("rings", "kind", "edges"),
    [
        # edges are numbered 0 to 3 in the square, from 4 on in the other ring
        ([SQUARE, [(4, 4), (9, 4), (4, 5)]], FaultKind.CROSSING, (1, 4)),
        ([SQUARE, [(8, 2), (8, 6), (6, 4)]], FaultKind.COMMON_PIECE, (1, 4)),
        ([SQUARE, [(7, 4), (8, 5), (9, 4), (8, 6)]], FaultKind.CROSSING, (1, 4)),
        ([SQUARE, [(8, 4), (9, 5), (9, 6), (8, 7), (7, 6)]], FaultKind.CROSSING, (1, 6)),
        ([SQUARE, [(1, 1), (3, 3), (2, 2), (4, 1)]], FaultKind.SAME_RING, (4, 5)),
        ([SQUARE, [(1, 1), (1, 1), (2, 2)]], FaultKind.NO_LENGTH, (4, 4)),
        ([SQUARE, SQUARE], FaultKind.COMMON_PIECE, (0, 4)),
    ],
)
def test_edges_that_share_more_than_a_touch_are_a_fault(rings, kind, edges):
    fault = meetings(*rings).fault
    assert (fault.kind, (fault.first, fault.second)) == (kind, edges)


def test_rings_that_cross_in_a_vertex_of_both_are_a_fault():
    """The triangle goes on at (8, 8) from the inside of the square to its outside."""
    assert meetings(SQUARE, [(8, 8), (7, 7), (9, 8)]).fault.kind is FaultKind.CROSSING
    inside, outside = [(8, 8), (6, 7), (7, 6)], [(8, 8), (10, 9), (9, 10)]
    assert touches(SQUARE, inside, outside) == {(8, 8): {0, 1, 2}}


def loop(*rings):
    return set(dividing_loop(meetings(*rings).touches, range(len(rings))))


TO_THE_LEFT, TO_THE_RIGHT = [(0, 4), (2, 3), (4, 4)], [(4, 4), (6, 3), (8, 4)]
"""Holes from the left side of the square to its middle, and from there to the right side."""


@pytest.mark.parametrize(
    ("rings", "points"),
    [
        ([SQUARE], set()),
        ([SQUARE, [(0, 4), (3, 3), (3, 5)]], set()),
        # A hole that touches the outline twice divides the inside.
        ([SQUARE, [(0, 4), (4, 3), (8, 4)]], {(0, 4), (8, 4)}),
        # So do two holes that touch each other twice, and enclose a part of it.
        ([SQUARE, [(2, 2), (4, 1), (6, 2), (4, 3)], [(2, 2), (4, 4), (6, 2), (4, 5)]],
         {(2, 2), (6, 2)}),
        # Outline, hole, hole, outline: a cycle of three touches.
        ([SQUARE, TO_THE_LEFT, TO_THE_RIGHT], {(0, 4), (4, 4), (8, 4)}),
        ([SQUARE, TO_THE_LEFT, [(4, 4), (6, 3), (7, 4)]], set()),
        # Three holes around a triangle.
        ([SQUARE, [(2, 2), (6, 2), (4, 1)], [(6, 2), (4, 6), (6, 5)], [(4, 6), (2, 2), (2, 5)]],
         {(2, 2), (6, 2), (4, 6)}),
        # Three holes in one point are a star, no cycle.
        ([SQUARE, [(4, 4), (6, 3), (6, 5)], [(4, 4), (3, 6), (5, 6)], [(4, 4), (2, 3), (2, 5)]],
         set()),
        # Two of three in one point touch in another one, too.
        ([SQUARE, [(4, 4), (6, 3), (6, 5)], [(4, 4), (3, 6), (6, 7), (6, 5), (5, 6)],
          [(4, 4), (2, 3), (2, 5)]],
         {(4, 4), (6, 5)}),
    ],
)  # fmt: skip
def test_the_inside_is_divided_by_a_cycle_of_touches_alone(rings, points):
    assert loop(*rings) == points
    assert Polygon(rings[0], rings[1:]).is_valid == (not points)


def test_a_long_chain_of_holes_divides_when_it_is_closed():
    """200 holes in a row, each touching the next, from the left side of a box to the right one."""
    box = [(0, -2), (400, -2), (400, 2), (0, 2)]
    chain = [[(2 * k, 0), (2 * k + 2, 0), (2 * k + 1, 1)] for k in range(200)]
    assert len(loop(box, *chain)) == 201
    assert loop(box, *chain[:-1]) == set()
    assert loop(box, *chain[1:-1]) == set()


def placed(parts, place):
    return [[[place(QQ(x), QQ(y)) for x, y in ring] for ring in rings] for rings in parts]


PLACES = {
    "sevenths and thirds": lambda x, y: (x / 7 + y / 3, y / 9 - x / 13),
    "far": lambda x, y: (x / 3 + 10**20, y / 7 - 10**40),
    "tiny": lambda x, y: (x / 3**700, y / 7**400),
    "flat": lambda x, y: (x + 10**30 * y / 3, x + (10**30 / QQ(3) + QQ(1, 10**30)) * y),
}
"""Affine maps: validity and touches stay, and no coordinate is a double."""


@pytest.mark.parametrize("name", PLACES)
def test_validity_does_not_depend_on_the_place_and_the_numbers(name):
    random = Random(f"places:{name}")
    for _ in range(30):
        parts = random_parts(random)
        assert accepted(placed(parts, PLACES[name])) == accepted(parts)


@pytest.mark.parametrize("tiny", [QQ(1, 10**18), QQ(1, 10**40), QQ(1, 3**700)])
def test_a_touch_is_told_from_a_gap_and_from_a_crossing_however_small(tiny):
    def body(y):
        return Body("b", SQUARE, holes=[[(4, y), (5, 2), (3, 2)]])

    assert Scene([body(0)]).bodies[0].exact_ring_touches == ((4, 0),)
    assert Scene([body(tiny)]).bodies[0].exact_ring_touches == ()
    with pytest.raises(InputError, match="two rings cross: edge 0"):
        Scene([body(-tiny)])


def accepted(parts):
    given = [{"vertices": outline, "holes": holes} for outline, *holes in parts]
    try:
        Scene([Body("b", parts=given)])
    except InputError:
        return False
    return True


@pytest.mark.long("1", "2", "3")
@pytest.mark.parametrize("seed", range(4))
def test_what_is_accepted_is_valid_by_geos_and_by_cutting_into_trapezoids(seed):
    """On integers, shapely's `is_valid` is exact enough; the third way is that by cells."""
    random, counts = Random(f"valid:{seed}"), {True: 0, False: 0}
    for _ in range(100):
        parts = random_parts(random)
        polygons = [Polygon(outline, holes) for outline, *holes in parts]
        whole = MultiPolygon(polygons) if len(polygons) > 1 else polygons[0]
        found = accepted(parts)
        assert found == whole.is_valid, (parts, shapely.is_valid_reason(whole))
        assert found == is_valid(parts), parts
        counts[found] += 1
    assert min(counts.values()) > 20
