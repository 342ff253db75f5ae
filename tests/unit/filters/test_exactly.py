"""The first of some candidates, exactly in doubles, against rationals."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from fractions import Fraction

import pytest

from exactpt.filters import straight
from exactpt.filters.candidates import Candidates, vertex_on_edge
from exactpt.filters.exactly import ExactIncidence, First, first_exactly
from exactpt.filters.rows import Table

END = 100.3
Points = list[tuple[float, float]]
SQUARE: Points = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]


def add(
    table: Table, points: Points, path: tuple[float, ...], start: float = 0.0, end: float = END
) -> None:
    """Add a ring of points in the motion c + w t, given as cx, cy, wx, wy."""
    cx, cy, wx, wy = path
    xs, ys = [x for x, _ in points], [y for _, y in points]
    table.add_straight(table.count(), start, end, xs, ys, (cx, wx), (cy, wy), 0.0)


def table_of(*pieces: tuple[Points, tuple[float, ...]]) -> Table:
    """Return a table of pieces."""
    table = Table()
    for points, path in pieces:
        add(table, points, path)
    return table


def all_candidates(table: Table) -> Candidates:
    """Return all vertices and edges of two pieces as candidates, in no order."""
    found = Candidates(math.inf)
    for one, other in ((1, 0), (0, 1)):
        for vertex in range(table.size[one]):
            for edge in range(table.edges[other]):
                found.add(vertex_on_edge(one, vertex, other, edge), 0.0, math.inf, math.inf)
    return found


def filtered(table: Table) -> Candidates:
    """Return the candidates of two pieces that the filter finds."""
    found = Candidates(END)
    low, high = straight.meeting(table, 0, 1, 0.0, END)
    if low <= high:
        straight.collect(table, 0, 1, low, high, 0.0, found)
    return found


def entry(
    table: Table, one: int, vertex: int, other: int, edge: int
) -> tuple[Fraction, int] | None:
    """Return when a vertex first is on an edge, and at which end: z + w t = s u, for s and t."""

    def exact(values: object, k: int) -> Fraction:
        return Fraction(values[k])  # type: ignore[index]

    def point(piece: int, k: int) -> tuple[Fraction, Fraction]:
        place = table.place[piece] + k
        return (
            exact(table.xs, place) + exact(table.frames, 24 * piece),
            exact(table.ys, place) + exact(table.frames, 24 * piece + 4),
        )

    number = table.edge[other] + edge
    begin, end = table.begins[number], table.ends[number]
    (px, py), (qx, qy), (rx, ry) = point(one, vertex), point(other, begin), point(other, end)
    wx = exact(table.frames, 24 * one + 1) - exact(table.frames, 24 * other + 1)
    wy = exact(table.frames, 24 * one + 5) - exact(table.frames, 24 * other + 5)
    z, u, w = (px - qx, py - qy), (rx - qx, ry - qy), (wx, wy)
    determinant = u[0] * w[1] - u[1] * w[0]
    if determinant:
        t = (u[1] * z[0] - u[0] * z[1]) / determinant
        s = (w[1] * z[0] - w[0] * z[1]) / determinant
        return (t, begin if s == 0 else end if s == 1 else -1) if 0 <= s <= 1 else None
    if not any(w) or u[0] * z[1] != u[1] * z[0]:
        return None
    axis = 0 if w[0] else 1
    if not any(u):
        t = -z[axis] / w[axis]
        return (t, begin) if z[1 - axis] + w[1 - axis] * t == 0 else None
    times = sorted([(-z[axis] / w[axis], begin), ((u[axis] - z[axis]) / w[axis], end)])
    return times[0]


def expected(table: Table, after: Fraction) -> tuple[Fraction | None, set[ExactIncidence]]:
    """Return the first time after another one at which vertices come to edges, and all of these."""
    first: Fraction | None = None
    rows: set[ExactIncidence] = set()
    for one, other in ((0, 1), (1, 0)):
        for vertex in range(table.size[one]):
            for edge in range(table.edges[other]):
                found = entry(table, one, vertex, other, edge)
                if found is None or not after < found[0] < Fraction(END):
                    continue
                if first is None or found[0] < first:
                    first, rows = found[0], set()
                if found[0] == first:
                    rows.add(ExactIncidence(one, vertex, other, edge, found[1]))
    return first, rows


def assert_is(first: First, found: Candidates, table: Table, after: float) -> None:
    """Check a result that holds."""
    time, rows = expected(table, Fraction(after))
    assert set(first.rows(found)) == rows
    if time is not None:
        assert Fraction(first.numerator) / Fraction(first.denominator) == time
        assert first.latest >= time


def random_table(rng: random.Random, number: Callable[[], float]) -> Table:
    """Return two pieces of a few vertices, often points, squares, or with equal speeds."""
    pieces: list[tuple[Points, tuple[float, ...]]] = []
    for _ in range(2):
        points: Points = [(number(), number()) for _ in range(rng.choice([1, 3, 3, 4]))]
        if rng.random() < 0.5:
            points = [(x + points[0][0], y + points[0][1]) for x, y in SQUARE]
        path = [number(), number(), number(), number()]
        if rng.random() < 0.5:  # along an axis, and often along an edge
            path[rng.choice((2, 3))] = 0.0
        if pieces and rng.random() < 0.1:
            path[2:] = pieces[0][1][2:]
        pieces.append((points, tuple(path)))
    return table_of(*pieces)


@pytest.mark.parametrize("candidates", [all_candidates, filtered])
def test_first_exactly_on_grids_nearly_always_holds_and_is_right(
    candidates: Callable[[Table], Candidates],
) -> None:
    rng = random.Random(1)
    held = several = 0
    for _ in range(600):
        table = random_table(rng, lambda: float(rng.randint(-4, 4)))
        found = candidates(table)
        first = first_exactly(table, found, 0.0)
        if first.holds:
            held += 1
            several += len(first.number) > 1
            assert_is(first, found, table, 0.0)
    assert held >= 599
    assert several > 50


@pytest.mark.parametrize("scale", [2.0**-30, 0.125, 2.0**20, 2.0**-200])
def test_first_exactly_on_scaled_grids_is_right_if_it_holds(scale: float) -> None:
    rng = random.Random(2)
    held = 0
    for _ in range(300):
        table = random_table(rng, lambda: scale * rng.randint(-9, 9))
        found = all_candidates(table)
        first = first_exactly(table, found, 0.0)
        if first.holds:
            held += 1
            assert_is(first, found, table, 0.0)
    assert held > 290 or scale < 2.0**-100


def test_first_exactly_of_random_doubles_is_right_if_it_holds() -> None:
    rng = random.Random(3)
    for _ in range(500):
        bits = rng.choice([6, 10, 13, 16, 53])
        table = random_table(rng, lambda: rng.getrandbits(bits) * 2.0**-bits)  # noqa: B023
        found = filtered(table)
        first = first_exactly(table, found, 0.0)
        if first.holds:
            assert_is(first, found, table, 0.0)


def test_first_exactly_after_a_double_with_all_bits_holds_on_a_grid() -> None:
    rng = random.Random(4)
    after = 1.0 / 3.0
    held = 0
    for _ in range(300):
        table = random_table(rng, lambda: float(rng.randint(-4, 4)))
        found = all_candidates(table)
        first = first_exactly(table, found, after)
        if first.holds:  # not where a time is 1/3, which is not that double
            held += 1
            assert_is(first, found, table, after)
    assert held > 280


def test_first_exactly_when_an_edge_lands_flat_gives_both_vertices() -> None:
    # Squares of side 2: the right side of one, x = 2 + t, meets the left side of the other, x = 7,
    # at t = 5; it is higher by 1, so one vertex of each is inside the side of the other.
    table = table_of((SQUARE, (0.0, 0.0, 1.0, 0.0)), (SQUARE, (7.0, 1.0, 0.0, 0.0)))
    found = filtered(table)
    first = first_exactly(table, found, 0.0)
    assert first.holds
    assert first.numerator / first.denominator == 5.0
    assert set(first.rows(found)) == {
        ExactIncidence(0, 2, 1, 3, -1),
        ExactIncidence(1, 0, 0, 1, -1),
    }


def test_first_exactly_when_equal_sides_meet_gives_both_ends() -> None:
    # As above at one height: two pairs of vertices. Each vertex comes to the end of the side that
    # it meets, and to the end of a level side, along whose line it moves.
    table = table_of((SQUARE, (0.0, 0.0, 1.0, 0.0)), (SQUARE, (7.0, 0.0, 0.0, 0.0)))
    found = filtered(table)
    first = first_exactly(table, found, 0.0)
    assert first.holds
    ends = {(row.piece, row.vertex, row.end) for row in first.rows(found)}
    assert ends == {(0, 1, 0), (0, 2, 3), (1, 0, 1), (1, 3, 2)}
    assert len(first.number) == 8


def test_first_exactly_of_a_vertex_that_enters_an_edge_at_its_end_gives_that_end() -> None:
    # The point (0, 0) + (1, 0) t and the segment from (9, 0) to (3, 0): at t = 3, at vertex 1.
    table = table_of(([(0.0, 0.0)], (0.0, 0.0, 1.0, 0.0)), ([(9.0, 0.0), (3.0, 0.0)], (0.0,) * 4))
    found = filtered(table)
    first = first_exactly(table, found, 0.0)
    assert first.holds
    assert first.numerator / first.denominator == 3.0
    assert {row.end for row in first.rows(found) if row.piece == 0} == {1}


def test_first_exactly_of_two_points_that_meet_gives_both_incidences() -> None:
    # (0, 0) + (1, 2) t and (3, 6): at t = 3.
    table = table_of(([(0.0, 0.0)], (0.0, 0.0, 1.0, 2.0)), ([(3.0, 6.0)], (0.0,) * 4))
    found = filtered(table)
    first = first_exactly(table, found, 0.0)
    assert first.holds
    assert first.numerator / first.denominator == 3.0
    assert len(first.rows(found)) == 2


def test_first_exactly_of_equal_speeds_finds_nothing() -> None:
    table = table_of((SQUARE, (0.0, 0.0, 1.0, 3.0)), (SQUARE, (2.0, 0.0, 1.0, 3.0)))
    found = all_candidates(table)
    first = first_exactly(table, found, 0.0)
    assert first.holds
    assert not first.rows(found)


def test_first_exactly_behind_the_end_of_a_piece_finds_nothing() -> None:
    # They would meet at t = 5, but the first piece ends at 4.
    table = Table()
    add(table, SQUARE, (0.0, 0.0, 1.0, 0.0), end=4.0)
    add(table, SQUARE, (7.0, 1.0, 0.0, 0.0))
    found = all_candidates(table)
    first = first_exactly(table, found, 0.0)
    assert first.holds
    assert not first.rows(found)


@pytest.mark.parametrize(("start", "end"), [(0.0, 5.0), (5.0, 9.0)])
def test_first_exactly_at_an_end_of_a_piece_does_not_hold(start: float, end: float) -> None:
    # They meet at t = 5: the exact end may be less than the double 5, the exact start may be more.
    table = Table()
    add(table, SQUARE, (0.0, 0.0, 1.0, 0.0), start, end)
    add(table, SQUARE, (7.0, 1.0, 0.0, 0.0))
    assert not first_exactly(table, all_candidates(table), 0.0).holds


@pytest.mark.parametrize("error", ["place_error", "path_error", "speed_error", "radius"])
def test_first_exactly_of_a_piece_with_an_error_or_a_radius_does_not_hold(error: str) -> None:
    table = table_of((SQUARE, (0.0, 0.0, 1.0, 0.0)), (SQUARE, (7.0, 1.0, 0.0, 0.0)))
    getattr(table, error)[1] = 2.0**-500
    assert not first_exactly(table, all_candidates(table), 0.0).holds


def test_first_exactly_of_thirds_in_doubles_does_not_hold() -> None:
    third = 1.0 / 3.0
    table = table_of((SQUARE, (0.0, third, third, 0.0)), (SQUARE, (7.0, 1.0, 0.0, -third / 7.0)))
    assert not first_exactly(table, all_candidates(table), 0.0).holds


def test_first_exactly_of_an_unknown_number_does_not_hold() -> None:
    for unknown in (math.nan, math.inf, -math.inf):
        table = table_of((SQUARE, (0.0, 0.0, 1.0, unknown)), (SQUARE, (7.0, 1.0, 0.0, 0.0)))
        assert not first_exactly(table, all_candidates(table), 0.0).holds
