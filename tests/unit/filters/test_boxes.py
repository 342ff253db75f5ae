"""Boxes of pieces, and the pairs of boxes that meet."""

import math
import random
from fractions import Fraction
from unittest.mock import patch

import pytest
from librt.vecs import vec

from exactpt.filters import boxes
from exactpt.filters.boxes import Cut, Drift, Members, during, of_piece, sorted_by, strips
from exactpt.filters.rows import (
    AFFINE,
    EXACT,
    OWN,
    TURNING,
    Errors,
    Piece,
    Table,
)
from fuzz.adversaries.boxes import attack_pieces, attack_strips
from fuzz.adversaries.pieces import KINDS
from fuzz.power.edits import Edit

NAN, INFINITY = math.nan, math.inf
PLANE = (-INFINITY, INFINITY, -INFINITY, INFINITY)
is_plain = boxes.__file__.endswith(".py")


def square(x, y, *, radius=0.0):
    """The unit square from the origin on, with a path of two coefficients for each coordinate."""
    table = Table()
    table.add_straight(0, 0.0, 10.0, [0.0, 1.0, 1.0, 0.0], [0.0, 0.0, 1.0, 1.0], x, y, radius)
    return table


def test_box_of_a_square_that_moves_holds_both_ends_of_its_way():
    # from x in [0, 1] to x in [6, 7] in two units of time, at y in [5, 6], within 1/4
    table = square((0.0, 3.0), (5.0,), radius=0.25)

    assert of_piece(table, 0, 0.0, 2.0, Drift()) == pytest.approx((-0.25, 7.25, 4.75, 6.25))


def test_box_less_the_velocity_of_a_piece_is_that_of_a_piece_at_rest():
    table = square((0.0, 3.0), (5.0, -1.0))

    assert of_piece(table, 0, 0.0, 2.0, Drift(3.0, -1.0)) == pytest.approx((0.0, 1.0, 5.0, 6.0))


def test_box_is_not_smaller_than_the_piece_at_one_time():
    left, right, bottom, top = of_piece(square((0.1,), (0.7,)), 0, 3.0, 3.0, Drift())

    assert Fraction(left) <= Fraction(0.1)
    assert Fraction(right) >= Fraction(0.1) + 1
    assert Fraction(bottom) <= Fraction(0.7)
    assert Fraction(top) >= Fraction(0.7) + 1


def test_boxes_during_a_window_are_those_of_pieces_that_last_in_it_with_its_ends():
    table = Table()
    for k, (start, end) in enumerate([(0.0, 1.0), (1.0, 2.0), (2.0, 3.0), (3.5, 4.0)]):
        table.add_straight(k, start, end, [0.0], [0.0], (0.0, 1.0), (), 0.0)

    active, found = during(table, 1.0, 2.5, Drift())

    assert list(active) == [0, 1, 2]
    assert list(found)[::4] == pytest.approx([1.0, 1.0, 2.0])  # left sides: x = t from then on
    assert list(found)[1::4] == pytest.approx([1.0, 2.0, 2.5])


@pytest.mark.parametrize("value", [NAN, INFINITY])
@pytest.mark.parametrize("at", [0, 9, 15])
def test_box_of_vertices_of_their_own_is_the_plane_if_one_is_out_of_range(value, at):
    numbers = [float(k % 3) for k in range(16)]
    numbers[at] = value
    table = Table()
    place = table.add_own(numbers)
    edge = table.add_edges([(0, 1)])
    ends = place, 2, edge, 1
    table.add_piece(
        Piece(0, int(OWN), 1e3, 1e9, *ends, [0.0] * 24, (0.0,) * 4, EXACT, 0.0, deforms=True)
    )

    assert of_piece(table, 0, 1e8, 1e9, Drift()) == PLANE


@pytest.mark.parametrize("value", [NAN, INFINITY])
@pytest.mark.parametrize("errors", [None, 0, 1, 2])
def test_box_of_a_path_or_an_error_out_of_range_is_the_plane(value, errors):
    table = square((0.0, 3.0), (5.0,))
    if errors is None:
        table.frames[5] = value
    else:
        (table.place_error, table.path_error, table.speed_error)[errors][0] = value

    assert of_piece(table, 0, 1.0, 2.0, Drift()) == PLANE


def test_box_of_an_affine_piece_has_the_error_of_its_places_times_the_matrix():
    # x = 100 dx: a place that is off by 1/2 has an image that is off by 50
    table = Table()
    frame = [0.0] * 8 + [100.0, 0.0, 0.0, 0.0] + [0.0] * 8 + [1.0, 0.0, 0.0, 0.0]
    place, edge = table.add_places([2.0], [3.0]), table.add_edges([(0, 0)])
    where = place, 1, edge, 1
    box, errors = (2.0, 2.0, 3.0, 3.0), Errors(0.5, 0.0, 0.0)
    table.add_piece(Piece(0, int(AFFINE), 0.0, 1.0, *where, frame, box, errors, 0.0, deforms=False))

    left, right, bottom, top = of_piece(table, 0, 0.0, 1.0, Drift())

    assert left <= 150.0
    assert right >= 250.0
    assert bottom <= 2.5
    assert top >= 3.5


def test_box_of_a_piece_that_turns_has_the_error_of_its_places_in_all_directions():
    # (1, 1), off by (1/4, 1/4) and turned by -45 degrees, is at x = 5/4 times the root of 2
    table = Table()
    half_turn = -math.tan(math.pi / 8)
    frame = [0.0] * 8 + [half_turn] + [0.0] * 15
    place, edge = table.add_places([1.0], [1.0]), table.add_edges([(0, 0)])
    where = place, 1, edge, 1
    reach = math.sqrt(2.0) * (1.0 + 1e-10)
    box, errors = (-reach, reach, -reach, reach), Errors(0.25, 0.0, 0.0)
    table.add_piece(
        Piece(0, int(TURNING), 0.0, 1.0, *where, frame, box, errors, 0.0, deforms=False)
    )

    _, right, _, _ = of_piece(table, 0, 0.0, 1.0, Drift())

    assert right >= 1.25 * math.sqrt(2.0)


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
def test_box_attacked_in_rationals_holds_every_vertex(kind):
    found = attack_pieces(kind, 3000, seed=59)

    assert found.wrong == 0, found.first
    assert found.near > 30


def test_strips_attacked_by_all_pairs_lose_none():
    found = attack_strips(300_000, seed=59)

    assert found.wrong == 0, found.first
    assert found.near > 100


def test_strips_of_a_box_that_is_not_a_number_meet_all():
    sides = [[0.0, 1.0, 0.0, 1.0], [5.0, 6.0, 5.0, 6.0], [NAN] * 4]

    pairs = strips(vec[float]([v for box in sides for v in box]), 0)

    assert sorted(zip(pairs[::2], pairs[1::2], strict=True)) == [(0, 2), (1, 2)]


def test_strips_of_no_boxes_are_no_pairs():
    assert list(strips(vec[float](), 0)) == []


@pytest.mark.parametrize("n", [0, 1, 2, 15, 16, 17, 33, 100, 1000])
def test_order_of_keys_is_that_of_the_built_in_sort(n):
    rng = random.Random(n)
    keys = [
        rng.choice([rng.random(), float(rng.randint(0, 5)), -INFINITY, INFINITY]) for _ in range(n)
    ]

    assert list(sorted_by(vec[float](keys))) == sorted(range(n), key=keys.__getitem__)


def test_order_of_keys_that_are_not_numbers_is_before_all_others():
    assert list(sorted_by(vec[float]([2.0, NAN, 1.0, NAN]))) == [1, 3, 2, 0]


PIECES = {
    "path: the slope of the drift": Edit(boxes, "course", "c1 - d1", "c1 + d1"),
    "path: the place of the drift": Edit(boxes, "course", "c0 - d0", "c0 + d0"),
    "path: its bend": Edit(boxes, "course", "abs(c2 - d2) + ", ""),
    "path: the bend of the drift": Edit(boxes, "course", "c2 - d2", "c2"),
    "path: the slope of its bend": Edit(boxes, "course", "speed + 2.0 * bend", "speed + bend"),
    "path: its remainder": Edit(boxes, "course", "abs(c2 - d2) + rest", "abs(c2 - d2)"),
    "path: its rounding": Edit(boxes, "course", "rest + rounding", "rest"),
    "vertices: one side": Edit(boxes, "around_vertices", "x - reach_x", "x"),
    "places: their rounding in x": Edit(boxes, "around_path", "+ low_x - rounding_x", "+ low_x"),
    "places: their rounding in y": Edit(boxes, "around_path", "+ high_y + rounding_y", "+ high_y"),
    "vertices: w": Edit(
        boxes, "around_vertices", "f, g = quotients(table, k, v,", "f, g = quotients(table, k, 0,"
    ),
    "vertices: their origin": Edit(boxes, "around_vertices", " - table.origin[k]", ""),
    "path: its origin": Edit(boxes, "around_path", " - table.origin[k]", ""),
    "error of the speed: the origin": Edit(
        boxes, "of_piece", "abs(middle - table.origin[k])", "abs(0.0 * middle)"
    ),
    "affine: as if not": Edit(boxes, "around_path", "== AFFINE", "== OWN"),
    "affine: reach": Edit(boxes, "image_along", "reach_a * size_x + ", ""),
    "affine: error": Edit(boxes, "image_along", " + (abs(a0) + abs(b0)) * error", ""),
    "affine: a negative factor": Edit(
        boxes, "image_along", "min(a0 * left, a0 * right)", "a0 * left"
    ),
    "error of places": Edit(boxes, "of_piece", "2.0 * table.place_error[k] + ", ""),
    "error of the path": Edit(boxes, "of_piece", "table.path_error[k] + ", ""),
    "error of the speed": Edit(
        boxes, "of_piece", "speed_error[k] * latest", "speed_error[k] * half"
    ),
    "radius": Edit(boxes, "of_piece", "table.radius[k] + ", ""),
}
PAIRS = {
    "touching in x": Edit(Members, "swept", "<= right", "< right"),
    "touching in y": Edit(Members, "swept", "low > top", "low >= top"),
    "the strip of one box": Edit(Members, "swept", "max(low, bottom)", "bottom"),
    "the last strip": Edit(Members, "_distribute", "strip <= last", "strip < last"),
    "every strip": Edit(Members, "swept", "cut.count > 1 and", "cut.count < 0 and"),
    "split": Edit(Members, "swept", "== (two < split)", "!= (two < split)"),
    "unbounded": Edit(Cut, "strip", "return self.count - 1", "return 0"),
    "not a number": Edit(boxes, "without_nan", "as_lower(left)", "left"),
}


@pytest.mark.long
@pytest.mark.skipif(not is_plain, reason="compiled functions cannot be edited")
@pytest.mark.parametrize("mistake", PIECES.values(), ids=PIECES)
def test_planted_mistake_in_the_box_of_a_piece_is_found(mistake):
    with mistake.made():
        assert is_found()


@pytest.mark.long
@pytest.mark.skipif(not is_plain, reason="compiled functions cannot be edited")
@pytest.mark.parametrize("mistake", PAIRS.values(), ids=PAIRS)
def test_planted_mistake_in_the_strips_is_found(mistake):
    with mistake.made():
        assert attack_strips(10_000, seed=59).wrong or attack_strips(1_000_000, seed=59).wrong


@pytest.mark.long
@pytest.mark.skipif(not is_plain, reason="constants of compiled modules are in their code")
def test_rounding_left_out_of_boxes_is_found():
    with patch.object(boxes, "ROUNDING", 0.0):
        assert is_found()


def is_found():
    """Return whether an attack finds a wrong box: first by few rows of each kind."""
    return any(
        attack_pieces(kind, rows, seed=59).wrong
        for rows in (500, 3000, 20_000)
        for kind in KINDS.values()
    )
