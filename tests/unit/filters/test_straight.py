"""The filter for straight motion: single cases, an adversary, and mistakes that it must find."""

from __future__ import annotations

import math
from contextlib import ExitStack
from typing import Any
from unittest.mock import patch

import pytest

from exactpt.filters import straight
from exactpt.filters.candidates import Candidate, Candidates
from exactpt.filters.rows import EXACT, STRAIGHT, Errors, Piece, Table
from fuzz.adversaries.exact_times import as_integers, compared, touching
from fuzz.adversaries.straight import Tally, attack, fill, judge, one_vertex_and_edge
from fuzz.adversaries.straight_pieces import attack_boxes, attack_near, attack_pieces
from fuzz.adversaries.straight_rows import THIRDS, Row
from fuzz.power.edits import Edit

U = 2.0**-53
SQUARE = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]
IS_COMPILED = straight.__file__.endswith((".so", ".pyd"))


def add(
    table: Table,
    points: list[tuple[float, float]],
    path: tuple[float, float, float, float],
    start: float = 0.0,
    end: float = 10.0,
    errors: Errors = EXACT,
) -> None:
    """Add a ring of points in the motion c + w t, given as cx, cy, wx, wy."""
    xs, ys = [x for x, _ in points], [y for _, y in points]
    frame = [0.0] * 24
    frame[0], frame[4], frame[1], frame[5] = path
    n = len(points)
    place, edge = table.add_places(xs, ys), table.add_ring(n)
    box = min(xs), max(xs), min(ys), max(ys)
    k = table.count()
    table.add_piece(
        Piece(
            body=k,
            kind=STRAIGHT,
            start=start,
            end=end,
            place=place,
            size=n,
            edge=edge,
            edges=n,
            frame=frame,
            box=box,
            errors=errors,
            radius=0.0,
            deforms=False,
        )
    )


def two_squares(**of_first: Any) -> Table:
    """Return a square that moves to the right, and one that rests 5 ahead and 1 higher."""
    table = Table()
    add(table, SQUARE, (0.0, 0.0, 1.0, 0.0), **of_first)
    add(table, SQUARE, (7.0, 1.0, 0.0, 0.0))
    return table


def collected(
    table: Table, low: float = 0.0, high: float = 10.0, limit: float = 10.0
) -> Candidates:
    """Return the candidates of the two pieces of a table."""
    found = Candidates(limit)
    straight.collect(table, 0, 1, low, high, 0.0, found)
    return found


def features(rows: list[Candidate]) -> set[tuple[int, int, int]]:
    """Return the piece and the number of each vertex, and the number of its edge."""
    return {(row.one, row.vertex, row.edge) for row in rows}


def test_collect_of_squares_that_land_flat_is_sure_of_the_vertices_inside_a_side() -> None:
    # The side x = 2 + t meets the side x = 7 at t = 5. One vertex of each is 1 above an end of it.
    found = collected(two_squares())
    assert features(found.rows()) == {(0, 2, 3), (1, 0, 1)}
    assert all(row.low < 5.0 < row.high < 5.0 + 1e-12 for row in found.rows())
    assert 5.0 < found.limit < 5.0 + 1e-12


def test_collect_before_the_contact_finds_nothing() -> None:
    assert not collected(two_squares(), high=4.9).rows()


def test_collect_of_a_contact_after_the_limit_finds_nothing() -> None:
    found = collected(two_squares(), limit=4.9)
    assert not found.rows()
    assert found.limit == 4.9


@pytest.mark.parametrize(("start", "end"), [(0.0, 5.0), (5.0, 10.0), (0.0, math.nextafter(5.0, 9))])
def test_collect_at_an_end_of_a_piece_is_not_sure(start: float, end: float) -> None:
    # The exact end of the piece may be before t = 5, or its exact start after it.
    table = two_squares(start=start, end=end)
    found = collected(table, low=start, high=min(end, 5.5))
    assert features(found.rows()) == {(0, 2, 3), (1, 0, 1)}
    assert found.limit == 10.0


def test_collect_of_disjoint_pieces_after_the_contact_is_not_sure() -> None:
    found = Candidates(10.0)
    straight.collect(two_squares(), 0, 1, 0.0, 5.5, 5.0, found)
    assert found.count() == 2
    assert found.limit == 10.0


def test_collect_of_a_vertex_along_an_edge_keeps_it_in_the_whole_window() -> None:
    # The point (0, 0) + (1, 0) t enters the segment from (9, 0) to (3, 0).
    table = Table()
    add(table, [(0.0, 0.0)], (0.0, 0.0, 1.0, 0.0))
    add(table, [(9.0, 0.0), (3.0, 0.0)], (0.0, 0.0, 0.0, 0.0))
    rows = [row for row in collected(table, 1.0, 8.0).rows() if row.one == 0]
    assert [(row.low, row.high) for row in rows] == [(1.0, 8.0)] * 2


def test_collect_of_a_vertex_beside_a_parallel_edge_finds_nothing() -> None:
    table = Table()
    add(table, [(0.0, 0.0)], (0.0, 0.0, 1.0, 0.0))
    add(table, [(9.0, 1e-9), (3.0, 1e-9)], (0.0, 0.0, 0.0, 0.0))
    assert not collected(table).rows()


def test_collect_of_two_points_that_meet_keeps_both_with_the_time() -> None:
    # (0, 0) + (1, 2) t and (3, 6): at t = 3.
    table = Table()
    add(table, [(0.0, 0.0)], (0.0, 0.0, 1.0, 2.0))
    add(table, [(3.0, 6.0)], (0.0, 0.0, 0.0, 0.0))
    rows = collected(table).rows()
    assert features(rows) == {(0, 0, 0), (1, 0, 0)}
    assert all(3.0 - 1e-12 < row.low <= 3.0 <= row.high < 3.0 + 1e-12 for row in rows)


def test_collect_of_two_points_that_miss_each_other_finds_nothing() -> None:
    table = Table()
    add(table, [(0.0, 0.0)], (0.0, 0.0, 1.0, 2.0))
    add(table, [(3.0, 6.000001)], (0.0, 0.0, 0.0, 0.0))
    assert not collected(table).rows()


def test_collect_of_many_features_finds_what_all_pairs_find() -> None:
    # Two saws of 160 vertices, whose teeth point to each other: 12,800 pairs of features.
    table = Table()
    saw = [(float(k), 0.75 * (k % 2)) for k in range(159)]
    add(table, [*saw, (79.0, -1.0)], (0.0, 0.0, 0.0, 1.0))
    add(table, [*((x, 5.0 - y) for x, y in saw), (79.0, 6.0)], (0.25, 0.0, 0.0, 0.0))
    few = collected(table)
    assert few.compared < 2_000
    with patch.object(straight, "FEW_PAIRS", 10**6) if not IS_COMPILED else ExitStack():
        all_pairs = collected(table)
    assert len(features(few.rows())) > 150
    if not IS_COMPILED:
        assert all_pairs.compared == 2 * 160 * 160
        assert features(few.rows()) == features(all_pairs.rows())


def test_meeting_of_boxes_is_about_the_time_between_their_sides() -> None:
    # x: 2 + t = 7 at t = 5, t = 9 at 9; y: always.
    low, high = straight.meeting(two_squares(), 0, 1, 0.0, 10.0)
    assert 5.0 - 1e-12 < low <= 5.0
    assert 9.0 <= high < 9.0 + 1e-12


def test_meeting_of_boxes_that_pass_beside_each_other_is_empty() -> None:
    table = Table()
    add(table, SQUARE, (0.0, 0.0, 1.0, 0.0))
    add(table, SQUARE, (7.0, 2.5, 0.0, 0.0))
    low, high = straight.meeting(table, 0, 1, 0.0, 10.0)
    assert low > high


@pytest.mark.parametrize("unknown", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("number", [0, 1, 4, 5])
def test_meeting_of_an_unknown_path_excludes_nothing_by_it(unknown: float, number: int) -> None:
    table = two_squares()
    table.frames[24 + number] = unknown
    low, high = straight.meeting(table, 0, 1, 0.0, 10.0)
    # y excludes nothing; an unknown y leaves the bounds of x
    assert low <= 5.0
    assert high >= (10.0 if number < 2 else 9.0)


@pytest.mark.parametrize(
    ("size", "unknown"),
    [
        (4, (0,)),
        (4, (5,)),
        (10, (0,)),
        (10, (1,)),
        (10, (4,)),
        (10, (5,)),
        (90, (0, 5)),
        (90, (1, 4)),
    ],
)
def test_collect_of_an_unknown_path_keeps_all_features(size: int, unknown: tuple[int, ...]) -> None:
    # The other coordinate excludes nothing, as both rings rest at one place.
    table = Table()
    ring = [(math.cos(k), math.sin(k)) for k in range(size)]
    add(table, ring, (0.0, 0.0, 0.0, 0.0))
    add(table, ring, (0.0, 0.0, 0.0, 0.0))
    for number in unknown:
        table.frames[24 + number] = math.nan
    rows = collected(table, 1.0, 2.0).rows()
    assert len(rows) == 2 * size * size
    assert {row.low for row in rows} == {1.0}


@pytest.mark.parametrize("error", ["place_error", "path_error", "speed_error"])
def test_collect_of_an_infinite_error_keeps_all_features(error: str) -> None:
    table = two_squares()
    getattr(table, error)[1] = math.inf
    assert len(collected(table).rows()) == 2 * 4 * 4


def test_adversary_of_thousands_of_rows_finds_nothing_wrong() -> None:
    tally = attack(6_000, seed=11)
    assert not tally.wrong, tally.wrong[:3]
    assert min(tally.near[aim] for aim in ("window", "span", "foot", "line", "slope")) > 50
    assert max(tally.worst.values()) > 0.9
    assert tally.sure > 500


def test_adversary_of_boxes_finds_nothing_wrong() -> None:
    tally = attack_boxes(1_000, seed=13)
    assert not tally.wrong, tally.wrong[:3]
    assert tally.candidates > 300


def test_adversary_of_features_near_a_piece_finds_nothing_wrong() -> None:
    tally = attack_near(300, seed=14)
    assert not tally.wrong, tally.wrong[:3]
    assert tally.candidates > 100


def test_adversary_of_pieces_of_many_features_finds_nothing_wrong() -> None:
    tally = attack_pieces(60, seed=12)
    assert not tally.wrong, tally.wrong[:3]
    assert tally.candidates > 50


PASSAGE = straight.Passage
# These terms have no mistake: others cover them wherever two features touch, since then the vertex
# is on the edge, at m = 0 to u.
# - d |z| in e0, d |w| in e1: an error du of the edge moves it by at most a place error along m,
#   as m du + (u - m) dq is at most |u| times that, and d |u| is in e0.
# - d and w_error |t| in s: let e = dz + t dw. m . u is off by e . u - (w . u) (u x e) / (u x w),
#   which is |u|^2 (e x w) / (u x w), and so at most |w| r |u|.
# - 2 d (2 |u| + d) and d |m| in the bound of the foot: at its ends, each covers the other.
# - K in e1 and in the two bounds of the foot: w_error has 2 U |w|, and the others are in r.
# - K of a displacement: w_error has 2 U |w|, twice, and coordinates are compared after a rounding
#   that is monotonic; only c, rounded and much larger than w t, would need it.
PLANTED = {
    "place errors left out": Edit(
        PASSAGE,
        "__init__",
        "table.place_error[a] + table.place_error[b] + motion.c_error",
        "motion.c_error",
    ),
    "path errors left out": Edit(
        PASSAGE,
        "__init__",
        "table.place_error[a] + table.place_error[b] + motion.c_error",
        "table.place_error[a] + table.place_error[b]",
    ),
    "a quarter of the errors in d": Edit(PASSAGE, "__init__", "2.0 * errors", "0.5 * errors"),
    "rounding of c left out of d": Edit(
        PASSAGE, "__init__", " + ROUNDING * (abs(motion.cx) + abs(motion.cy))", ""
    ),
    "e0 without d": Edit(PASSAGE, "orientation", " + d * (u_size + z_size + 2.0 * d)", ""),
    "e0 without d |u|": Edit(
        PASSAGE, "orientation", "d * (u_size + z_size + 2.0 * d)", "d * z_size"
    ),
    "e0 without rounding": Edit(
        PASSAGE, "orientation", "e0 = ROUNDING * (abs(left) + abs(right)) + ", "e0 = "
    ),
    "e1 without w_error": Edit(PASSAGE, "slope", " + motion.w_error * (u_size + 2.0 * d)", ""),
    "r without e0": Edit(
        PASSAGE, "compare", "(e0 + e1 * abs(t)) / least_slope", "e1 * abs(t) / least_slope"
    ),
    "r without e1": Edit(
        PASSAGE, "compare", "(e0 + e1 * abs(t)) / least_slope", "e0 / least_slope"
    ),
    "slope without e1": Edit(
        PASSAGE, "compare", "least_slope = abs(c1) - e1", "least_slope = abs(c1)"
    ),
    "parallel without e0": Edit(
        PASSAGE,
        "may_come_to_line",
        "(e0 + (abs(c1) + e1) * self.times)",
        "((abs(c1) + e1) * self.times)",
    ),
    "parallel without e1": Edit(
        PASSAGE,
        "may_come_to_line",
        "(e0 + (abs(c1) + e1) * self.times)",
        "(e0 + abs(c1) * self.times)",
    ),
    "parallel without t": Edit(
        PASSAGE, "may_come_to_line", "(e0 + (abs(c1) + e1) * self.times)", "e0"
    ),
    "parallel and unknown dropped": Edit(
        PASSAGE, "may_come_to_line", "not abs(c0) > farthest", "abs(c0) <= farthest"
    ),
    "unknown slope taken for a slope": Edit(
        PASSAGE, "compare", "not least_slope > SMALL", "least_slope <= SMALL"
    ),
    "wrong sign of t": Edit(PASSAGE, "compare", "t = -c0 / c1", "t = c0 / c1"),
    "time compared without r": Edit(
        PASSAGE, "compare", "first > high or last < self.low", "t > high or t < self.low"
    ),
    "foot without s": Edit(PASSAGE, "foot", "bound = s * (u_size + 2.0 * d) + ", "bound = "),
    "s without r": Edit(PASSAGE, "foot", "s = d + w_size * r", "s = d"),
    "wrong sign at the begin of an edge": Edit(PASSAGE, "foot", "along < -bound", "along < bound"),
    "wrong sign at the end of an edge": Edit(
        PASSAGE, "foot", "along > length + bound", "along > length - bound"
    ),
    "sure beside the edge": Edit(
        PASSAGE, "foot", "bound < along < length - bound", "-bound < along < length + bound"
    ),
    "sure before the start": Edit(
        PASSAGE, "compare", "first > self.exist_after", "last > self.exist_after"
    ),
    "sure after the end": Edit(
        PASSAGE, "compare", "last < self.exist_before", "first < self.exist_before"
    ),
    "limit too early": Edit(PASSAGE, "compare", "found.limit = last", "found.limit = first"),
    "low too late": Edit(PASSAGE, "compare", "max(self.low, first)", "max(self.low, t)"),
    "high too early": Edit(PASSAGE, "compare", "begin, last, high", "begin, t, high"),
    "edge without its end": Edit(
        PASSAGE, "places", "of_edges + table.ends[number]", "of_edges + table.begins[number]"
    ),
    "points without d": Edit(PASSAGE, "compare_with_point", "self.d + motion", "motion"),
    "points without w_error": Edit(
        PASSAGE, "compare_with_point", "self.d + motion.w_error * self.times", "self.d"
    ),
    "displacement at the begin alone": Edit(
        PASSAGE, "displacement", "min(begin, end) - margin, max(begin", "begin - margin, max(begin"
    ),
    "displacement without errors": Edit(PASSAGE, "displacement", "2.0 * error + ", ""),
    "displacement to the wrong side": Edit(
        PASSAGE,
        "near_vertices",
        "left - self.most_x, right - self.least_x",
        "left - self.least_x, right - self.most_x",
    ),
    "edges with one end outside left out": Edit(
        PASSAGE,
        "near_edges",
        "(xs[i] < left and xs[j] < left)",
        "(xs[i] < left or xs[j] < left)",
    ),
    "speed errors left out": Edit(
        straight, "relative_motion", "table.speed_error[a] + table.speed_error[b]", "0.0"
    ),
    "boxes without places": Edit(
        straight, "meeting", "table.place_error[a] + table.place_error[b]", "0.0"
    ),
    "boxes without paths": Edit(
        straight, "meeting", "table.path_error[a] + table.path_error[b]", "0.0"
    ),
    "boxes without speeds": Edit(
        straight, "meeting", "table.speed_error[a] + table.speed_error[b]", "0.0"
    ),
    "boxes without radii": Edit(straight, "meeting", "(table.radius[a] + table.radius[b])", "0.0"),
    "boxes smaller by radii": Edit(straight, "meeting", "right_a) - reach", "right_a) + reach"),
    "boxes without errors": Edit(straight, "while_between", "2.0 * error + ", ""),
    "boxes without rounding": Edit(
        straight, "while_between", " + ROUNDING * (abs(c) + abs(least) + abs(most))", ""
    ),
    "boxes without negative speeds": Edit(
        straight, "while_between", "elif w < 0.0:", "elif w == 9.0:"
    ),
}


# A vertex at p, an edge from q to r and a displacement c, of which u and z, their products and the
# displaced z are all rounded to one side. So c0 is off by 3.7 U (|ux zy| + |uy zx|), of the 4 U to
# which these roundings may add up (its own one is 0: the two products are nearly equal). The vertex
# crosses the edge at t' = -3.5 10^-14, inside of it, where e1 |t| adds nothing.
P = "0x1.9acd14af6b314p-3", "0x1.0f5bdc1a00572p-2"
Q = "-0x1.9a829aa39ef44p-1", "-0x1.79ff382c8c7f2p-1"
R = "0x1.349e8d0937705p+0", "0x1.44ad8a23464b8p+0"
C = "0x1.53f5171ae25d5p-10", "-0x1.8dcf37d407d81p-54"
ROUNDED = (*map(float.fromhex, (*P, *Q, *R, *C)), 1.0, -1.0, 0.0, 0.0, 0.0, 0.0)


def wrong_about_rounded() -> list[str]:
    """Return what the filter says wrong of `ROUNDED` in a window that ends just after t'."""
    integers, _ = as_integers(ROUNDED)
    exact = tuple(THIRDS * number for number in integers)
    times = touching(exact)
    assert times is not None
    first, _ = times
    end = math.nextafter(first[0] / first[1], math.inf)
    row = Row("random", "window", ROUNDED, exact, low=-1.0, high=end)
    table, found, tally = one_vertex_and_edge(), Candidates(math.inf), Tally()
    fill(table, row)
    straight.collect(table, 0, 1, row.low, row.high, -math.inf, found)
    judge(row, found, math.inf, tally)
    assert compared(first, row.high) < 0
    return [what for what, _ in tally.wrong]


def test_contact_just_before_the_end_of_a_window_with_all_roundings_to_one_side() -> None:
    assert wrong_about_rounded() == []


@pytest.mark.skipif(IS_COMPILED, reason="constants are compiled")
@pytest.mark.parametrize("units", [2.0, 3.5])
def test_row_with_all_roundings_to_one_side_finds_a_smaller_rounding(units: float) -> None:
    with patch.object(straight, "ROUNDING", units * U):
        assert wrong_about_rounded() == ["a contact in the window was dropped"]


def is_found(rows: int) -> bool:
    """Return True if the adversary finds a mistake in a few seeds."""
    try:
        return any(
            attack(rows, seed).wrong
            or attack_boxes(rows // 10, seed).wrong
            or attack_near(rows // 8, seed).wrong
            or attack_pieces(rows // 40, seed).wrong
            for seed in range(1, 7)
        )
    except ZeroDivisionError:
        return True


@pytest.mark.skipif(IS_COMPILED, reason="the text of a compiled function cannot be changed")
@pytest.mark.parametrize("name", PLANTED)
def test_adversary_of_a_planted_mistake_finds_it(name: str) -> None:
    with PLANTED[name].made():
        assert is_found(2_000)


@pytest.mark.skipif(IS_COMPILED, reason="constants are compiled")
@pytest.mark.parametrize(
    ("constant", "value"), [("ROUNDING", 0.5 * U), ("TINY", 0.0), ("SMALL", -1.0)]
)
def test_adversary_of_a_wrong_constant_finds_it(constant: str, value: float) -> None:
    with patch.object(straight, constant, value):
        assert is_found(2_000)
