"""Whether two pieces are certainly disjoint at one time."""

import math
from unittest.mock import patch

import pytest

from exactpt.filters import starts
from exactpt.filters.rows import EXACT, STRAIGHT, Piece, Table
from exactpt.filters.starts import Pair, Starts
from fuzz.adversaries.pieces import KINDS
from fuzz.adversaries.starts import attack
from fuzz.power.edits import Edit

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
CORNER = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 4.0), (0.0, 4.0)]
is_plain = starts.__file__.endswith(".py")


def add(table, *rings, at=(0.0, 0.0), scale=1.0, radius=0.0, chain=False):
    """Add a piece of rings at rest."""
    points = [(at[0] + scale * x, at[1] + scale * y) for ring in rings for x, y in ring]
    xs, ys = [x for x, _ in points], [y for _, y in points]
    edges, first = [], 0
    for ring in rings:
        n = len(ring)
        edges += [(first + i, first + (i + 1) % n) for i in range(n - 1 if chain else n)]
        first += n
    place, edge = table.add_places(xs, ys), table.add_edges(edges)
    where = place, len(xs), edge, len(edges)
    box = (min(xs), max(xs), min(ys), max(ys))
    frame = [0.0] * 24
    row = Piece(
        table.count(), int(STRAIGHT), 0.0, 1.0, *where, frame, box, EXACT, radius, deforms=False
    )
    table.add_piece(row)


def answer(table):
    """What the filter says of the pieces 0 and 1, in both orders."""
    found = Starts(table, 0.0).are_disjoint(0, 1)
    assert Starts(table, 0.0).are_disjoint(1, 0) == found
    return found


def test_square_in_the_corner_of_an_l_is_disjoint_from_it():
    # no line along an edge separates them, and heights of vertices are equal
    table = Table()
    add(table, CORNER)
    add(table, SQUARE, at=(2.0, 2.0), scale=0.5)

    assert answer(table)


def test_square_in_a_hole_is_disjoint_from_the_frame_around_it():
    table = Table()
    add(table, [(5 * x, 5 * y) for x, y in SQUARE], [(1 + 3 * x, 1 + 3 * y) for x, y in SQUARE])
    add(table, SQUARE, at=(2.0, 2.0))

    assert answer(table)


def test_square_inside_another_one_is_not_disjoint_from_it():
    table = Table()
    add(table, SQUARE)
    add(table, SQUARE, at=(0.25, 0.25), scale=0.5)

    assert not answer(table)


def test_second_part_inside_another_piece_is_not_overlooked():
    # the first part is outside, and no edges cross
    table = Table()
    add(table, [(8 * x, 8 * y) for x, y in SQUARE])
    add(table, [(x + 20, y) for x, y in SQUARE], [(x + 2, y + 2) for x, y in SQUARE])

    assert not answer(table)


def test_point_enclosed_by_an_open_chain_is_disjoint_from_it():
    table = Table()
    add(table, SQUARE, chain=True)
    add(table, [(0.5, 0.5)])

    assert answer(table)


def test_edges_on_one_line_apart_are_disjoint():
    table = Table()
    add(table, CORNER)
    add(table, [(2.0, 1.0), (3.5, 2.0), (1.5, 2.0)], at=(0.5, 1e-9))  # its vertex is above y = 1

    assert answer(table)


def test_pieces_with_radii_are_disjoint_only_if_their_boxes_are():
    table = Table()
    add(table, SQUARE, radius=0.25)
    add(table, SQUARE, at=(1.5, 0.0), radius=0.125)

    assert answer(table)

    table.radius[1] = 0.25

    assert not answer(table)


@pytest.mark.parametrize("column", ["place_error", "path_error", "radius"])
@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_piece_out_of_range_is_not_disjoint_from_any(column, value):
    table = Table()
    add(table, SQUARE)
    add(table, SQUARE, at=(9.0, 9.0))
    getattr(table, column)[1] = value

    assert not answer(table)


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
def test_disjoint_pieces_attacked_in_rationals_have_no_common_point(kind):
    found = attack(kind, 1000, seed=59)

    assert found.wrong == 0, found.first
    assert found.near > 300
    assert found.common > 150
    assert found.told > 0.97 * found.random > 30


MISTAKES = {
    "error of the orientation": Edit(Pair, "bound", "off = 2.0 * self.rho", "off = 0.0"),
    "half the error of it": Edit(Pair, "bound", "off = 2.0 * self.rho", "off = 0.1 * self.rho"),
    "sign of the parity": Edit(Pair, "is_outside", "(side > 0) == is_up", "(side > 0) != is_up"),
    "vertex at the height": Edit(Pair, "is_outside", "p[ROW * b + Y0] > y", "p[ROW * b + Y0] >= y"),
    "edges to the right": Edit(Pair, "is_outside", ") < x:", ") > x:"),
    "other parts": Edit(Pair, "is_second_outside", "k < len(vertices)", "k < 1"),
    "rings": Edit(starts, "has_ring", "step < 0 or", "step < -99 or"),
    "the first in the second": Edit(Starts, "are_disjoint", " and swapped.is_second_outside()", ""),
    "one side of an edge": Edit(Pair, "meeting", "of_c != 0 and of_c == of_d", "of_c != 0"),
    "edges near a box": Edit(
        starts, "near_edges", "2.0 * (p.rho + q.rho)", "-2.0 * (p.rho + q.rho)"
    ),
    "boxes of edges": Edit(Pair, "_edges_may_meet_by_strips", "2.0 * self.rho", "-2.0 * self.rho"),
    "radii of strips": Edit(Pair, "_edges_may_meet_by_strips", " + self.reach", ""),
    "radii of a line between": Edit(Pair, "has_line_between", "* self.reach", "* 0.0"),
    "radii of edges near a box": Edit(starts, "near_edges", "(p.rho + q.rho) + reach", "0.0"),
    "radii of a side": Edit(Pair, "bound", "+ far", ""),
    "length of an edge": Edit(Pair, "bound", "math.sqrt(ux * ux + uy * uy)", "abs(ux)"),
    "behind an edge": Edit(Pair, "is_behind", "< -bound", "< bound"),
    "behind one end": Edit(Pair, "is_beyond_an_end", "p, a, b, q, c) and", "p, a, b, q, c) or"),
    "distance of points": Edit(Pair, "are_far", "self.reach + ", ""),
    "error of the distance": Edit(Pair, "are_far", " + 2.0 * self.rho", ""),
    "edges on one line": Edit(Pair, "meeting", "off = 2.0 * self.rho", "off = -1e9 * self.rho"),
    "line between": Edit(Pair, "has_line_between", "2.0 * off", "0.0 * off"),
    "one side of a line": Edit(
        starts, "span_along", "low, high = min(low, x + y)", "low, high = x + y"
    ),
    "strips": Edit(Pair, "edges_may_meet", "return self._edges_may", "return not self._edges_may"),
}


@pytest.mark.long
@pytest.mark.skipif(not is_plain, reason="compiled functions cannot be edited")
@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=MISTAKES)
def test_planted_mistake_in_disjoint_pieces_is_found(mistake):
    with mistake.made():
        assert is_found() or is_found_by_strips()


@pytest.mark.long
@pytest.mark.skipif(not is_plain, reason="constants of compiled modules are in their code")
@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
def test_disjoint_pieces_attacked_by_strips_have_no_common_point(kind):
    with patch.object(starts, "FEW_EDGE_PAIRS", 0):
        found = attack(kind, 200, seed=59)

    assert found.wrong == 0, found.first
    assert found.told > 0.97 * found.random > 5


def is_found():
    """Return whether an attack finds a wrong claim: first by few rows of each kind."""
    return any(attack(kind, rows, seed=59).wrong for rows in (50, 500) for kind in KINDS.values())


def is_found_by_strips():
    """Return the same, if edges of all pieces are compared by strips."""
    with patch.object(starts, "FEW_EDGE_PAIRS", 0):
        return is_found()
