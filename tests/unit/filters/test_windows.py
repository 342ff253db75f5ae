"""Vertices of a piece in a window: their models, rho and the box."""

import math
from unittest.mock import patch

import pytest
from librt.vecs import vec
from mypy_extensions import i64

from exactpt.filters import windows
from exactpt.filters.rows import AFFINE, EXACT, GENERAL, OWN, TURNING, Errors, Piece, Table
from exactpt.filters.windows import ROW, Window, edge_box
from fuzz.adversaries.windows import PARTS
from fuzz.power.edits import Edit

NAN, INFINITY = math.nan, math.inf
is_plain = windows.__file__.endswith(".py")


@pytest.mark.parametrize("name", PARTS)
def test_vertices_of_an_adversary_are_within_rho_and_in_the_box(name):
    report = PARTS[name](3000, 59)

    assert report.wrong == []
    assert report.close > (3 if name == "general" else 30)


def point(kind, frame, place=(1.0, 0.0), errors=EXACT):
    """A table of one piece of one vertex."""
    table = Table()
    first = table.add_places([place[0]], [place[1]])
    edge = table.add_edges([(0, 0)])
    box = (place[0], place[0], place[1], place[1])
    frame = frame + [0.0] * (24 - len(frame))
    table.add_piece(
        Piece(0, kind, 0.0, 9.0, first, 1, edge, 1, frame, box, errors, 0.0, deforms=False)
    )
    return table


def filled(table, middle=0.0, half=1.0):
    """The window of the only piece."""
    window = Window()
    window.fill(table, i64(0), middle, half)
    return window


def test_window_of_a_point_on_a_line_is_its_path():
    # x = 1 + 2 t, y = 5 - t in t = 3 + s / 2
    table = Table()
    table.add_straight(0, 0.0, 9.0, [1.0], [5.0], (0.0, 2.0), (0.0, -1.0), 0.0)

    window = filled(table, 3.0, 0.5)

    assert list(window.rows) == [7.0, 1.0, 0.0, 2.0, -0.5, 0.0]
    assert window.rho < 1e-13
    sides = [window.left, window.right, window.bottom, window.top]
    assert sides == pytest.approx([6.0, 8.0, 1.5, 2.5], abs=1e-12)
    assert window.left < 6.0
    assert window.right > 8.0


def test_window_of_a_short_turn_has_a_small_remainder():
    # the tangent of half the angle is t / 2^10 in [-1, 1]; the remainder is of its third order
    window = filled(point(TURNING, [0.0] * 9 + [2.0**-10]))

    assert not window.is_coarse
    assert window.rho < 2.0**-25


def test_window_of_a_long_turn_is_coarse_and_holds_the_circle():
    window = filled(point(TURNING, [0.0] * 9 + [100.0]))

    assert window.is_coarse
    assert window.left <= -1.0
    assert window.top >= 1.0


def test_error_of_a_place_counts_the_remainder_of_each_factor():
    # x = (1 + 8 t^3) dy with dy = 0 up to 1: 9 at t = 1; the model of b is 1, its remainder 8
    frame = [0.0] * 12 + [1.0, 0.0, 0.0, 8.0]

    window = filled(point(AFFINE, frame, (0.0, 0.0), Errors(1.0, 0.0, 0.0)))

    assert window.rows[0] == 0.0
    assert window.rho >= 9.0


@pytest.mark.parametrize(
    "errors", [Errors(1.0, 0.0, 0.0), Errors(0.0, 1.0, 0.0), Errors(0, 0, 0.25)]
)
@pytest.mark.parametrize("kind", [0, 1, TURNING, AFFINE, OWN])
def test_errors_that_are_given_are_in_rho_for_all_kinds(kind, errors):
    frame = [0.0] * 8 + [1.0 if kind == AFFINE else 0.0]
    table = point(kind, frame, (0.0, 0.0), errors)
    table.add_own([0.0] * 8)
    table.place[0] = 0

    assert filled(table, 3.0, 1.0).rho >= 1.0  # the error of the speed counts for 4 units of time


@pytest.mark.parametrize("place", [(NAN, 0.0), (0.0, NAN), (INFINITY, 0.0), (0.0, -INFINITY)])
@pytest.mark.parametrize("kind", [0, 1, TURNING, AFFINE])
def test_place_that_is_no_number_is_in_every_box(kind, place):
    window = filled(point(kind, [0.0] * 24, place))

    assert not window.rho < INFINITY
    assert not window.left > -1e300
    assert not window.right < 1e300


def test_vertex_of_its_own_that_is_no_number_is_in_every_box():
    table = Table()
    first = table.add_own([0.0, NAN, *[0.0] * 6])
    edge = table.add_edges([(0, 0)])
    box = (0.0, 0.0, 0.0, 0.0)
    table.add_piece(
        Piece(0, OWN, 0.0, 9.0, first, 1, edge, 1, [0.0] * 24, box, EXACT, 0.0, deforms=False)
    )

    assert not filled(table).rho < INFINITY


def general_point(numbers, *, terms, origin=0.0):
    """A table of one vertex at (x / w, y / w)."""
    table = Table()
    first, edge = table.add_general(numbers), table.add_edges([(0, 0)])
    box = (0.0, 0.0, 0.0, 0.0)
    piece = Piece(
        0, GENERAL, 0.0, 9.0, first, 1, edge, 1, [0.0] * 24, box, EXACT, 0.0, deforms=False
    )
    table.add_piece(piece._replace(origin=origin, terms=terms))
    return table


def test_quotient_far_from_a_pole_has_a_model():
    # x = 2 / (1 + t^2 / 4) and y = t / (1 + t^2 / 4) at t = 1, counted from the origin 5
    numbers = [2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.25]

    window = Window()
    window.fill(general_point(numbers, terms=3, origin=5.0), i64(0), 6.0, 0.0)

    assert (window.rows[0], window.rows[3]) == pytest.approx((1.6, 0.8), abs=1e-14)
    assert window.rho < 1e-13
    assert not window.is_coarse


def test_quotient_in_a_window_that_is_too_wide_is_coarse():
    """A shorter window has a model: at its middle there is one."""
    numbers = [2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 9.0]

    window = Window()
    window.fill(general_point(numbers, terms=3), i64(0), 1.0, 1.0)

    assert not window.rho < INFINITY
    assert window.is_coarse


@pytest.mark.parametrize("k", range(9))
def test_quotient_of_no_numbers_is_in_every_box_and_not_coarse(k):
    numbers = [2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.25]
    numbers[k] = NAN

    window = Window()
    window.fill(general_point(numbers, terms=3), i64(0), 1.0, 0.5)

    assert not window.rho < INFINITY
    assert not window.is_coarse


def test_box_of_an_edge_holds_the_ways_of_both_ends():
    rows = vec[float]([0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 5.0, 0.0, 0.0, 6.0, 0.0, 0.0])
    assert len(rows) == 2 * ROW

    left, right, bottom, top = edge_box(rows, 0, 1, 0.5)

    assert (left, right, bottom, top) == pytest.approx((-1.5, 5.5, -2.5, 6.5), abs=1e-13)


MISTAKES = {
    "rho: the remainders of a turn": Edit(Window, "_fill_turning", " + rest * place", ""),
    "rho: the remainders of a matrix": Edit(Window, "_fill_affine", " + rest * place", ""),
    "rho: the remainder of the path": Edit(Window, "_fill_translated", "remainder + ", ""),
    "rho: what is given": Edit(Window, "_fill_affine", " + given", ""),
    "rho: the errors of places": Edit(
        windows, "given_error", " + table.place_error[piece] * factor", ""
    ),
    "rho: the error of the path": Edit(windows, "given_error", "table.path_error[piece] + ", ""),
    "rho: the error of the speed": Edit(windows, "given_error", "abs(middle) + half", "half"),
    "translated: the slope": Edit(Window, "_fill_translated", "Y1] = py1", "Y1] = px1"),
    "turning: a sign": Edit(Window, "_fill_turning", "c1 * x - s1", "c1 * x + s1"),
    "affine: a row": Edit(Window, "_fill_affine", "d2 * y", "b2 * y"),
    "turning: the constant turn": Edit(
        Window, "_fill_turning", "cosine, sine = turned(", "_ = turned("
    ),
    "general: w": Edit(windows, "quotients", "times(x, inverse_w)", "x"),
    "general: y": Edit(windows, "quotients", "at_y, terms,", "at_x, terms,"),
    "general: the anchor": Edit(windows, "quotients", "anchor + PATH_Y", "anchor + PATH_X"),
    "general: the larger remainder": Edit(
        Window,
        "_fill_general",
        "remainder = larger(remainder, larger(x_rest, y_rest))",
        "remainder = 0.0",
    ),
    "the origin": Edit(Window, "fill", "middle -= table.origin[piece]", "pass"),
    "own: y": Edit(Window, "_fill_own", "at + OWN_Y", "at"),
    "box: a way": Edit(Window, "_find_box", "x - x_way", "x"),
    "box: its margin": Edit(Window, "_find_box", "left - margin", "left"),
}


@pytest.mark.skipif(not is_plain, reason="compiled functions cannot be edited")
@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=MISTAKES)
def test_planted_mistake_in_windows_is_found(mistake):
    with mistake.made():
        assert is_found()


@pytest.mark.skipif(not is_plain, reason="constants of compiled modules are in their code")
def test_rounding_left_out_of_windows_is_found():
    with patch.object(windows, "ROUNDING", 0.0):
        assert is_found()


def is_found():
    """Return whether an adversary finds a vertex out of place: first by few rows."""
    return any(part(rows, 59).wrong for rows in (300, 3000, 30_000) for part in PARTS.values())
