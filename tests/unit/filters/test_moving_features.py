"""Pairs of features of two pieces in any motion: the candidates."""

import math
from random import Random

import pytest
from mypy_extensions import i64

from exactpt import Body, Rigid, Scene, first_contact
from exactpt.filters import features
from exactpt.filters.candidates import NO_EDGE, NO_VERTEX, Candidates
from exactpt.filters.features import Filter
from exactpt.filters.rows import AFFINE, CURVED, EXACT, OWN, STRAIGHT, TURNING, Piece, Table
from exactpt.filters.windows import Window, are_apart
from fuzz.adversaries.features import KINDS, check, checked, pairs_of
from fuzz.adversaries.report import Report
from fuzz.power.edits import Edit

NAN, INFINITY = math.nan, math.inf
is_plain = features.__file__.endswith(".py")


@pytest.mark.parametrize("name", KINDS)
def test_candidates_of_an_adversary_keep_every_contact(name):
    report = checked(KINDS[name])(1500, 59)

    assert report.wrong == []
    assert report.counts["contacts"] > 10
    assert report.counts["sure"] > 10


def add(table, kind, places, frame, *, span=(0.0, 10.0), radius=0.0):
    """Add a ring of places, or a point, to a table; of two coefficients of each polynomial."""
    n = len(places)
    edge = table.add_ring(n) if n > 1 else table.add_edges([(0, 0)])
    xs, ys = [x for x, _ in places], [y for _, y in places]
    own = [c for x, y in places for c in (x, *frame, 0.0, 0.0, y, 0.0, 0.0, 0.0)]
    first = table.add_own(own) if kind == OWN else table.add_places(xs, ys)
    numbers = [c for two in frame for c in (*two, 0.0, 0.0)] if kind != OWN else []
    numbers += [0.0] * (24 - len(numbers))
    box = (min(xs), max(xs), min(ys), max(ys))
    if kind == TURNING:
        reach = max(map(math.hypot, xs, ys)) * 1.001
        box = (-reach, reach, -reach, reach)
    deforms = kind >= AFFINE
    row = Piece(table.count(), kind, *span, first, n, edge, n, numbers, box, EXACT, radius, deforms)
    table.add_piece(row)


SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def collected(table, a=0, b=1, *, after=0.0, low=0.0, high=10.0):
    """The candidates of two pieces in a span, and the same sharpened."""
    found = Candidates(INFINITY)
    search = Filter(table)
    search.collect(i64(a), i64(b), low, high, after, found)
    return found, search.sharpen(found, after)


def test_discs_that_meet_are_sure_in_a_short_interval():
    table = Table()
    add(table, STRAIGHT, [(0.0, 0.0)], [(0.0, 1.0), (0.0, 0.0)], radius=1.0)
    add(table, STRAIGHT, [(5.0, 0.0)], [(0.0, 0.0), (0.0, 0.0)], radius=1.0)

    found, _ = collected(table)  # at the distance 2 from t = 3 on

    (row,) = found.rows()
    assert row[2:7] == (0, 0, 1, NO_EDGE, 0)
    assert row.low < 3.0 < row.high < 3.0 + 1e-12
    assert found.limit == row.high


def test_discs_that_pass_at_the_distance_of_their_radii_may_touch():
    table = Table()
    add(table, STRAIGHT, [(0.0, 2.0)], [(0.0, 1.0), (0.0, 0.0)], radius=1.0)
    add(table, STRAIGHT, [(5.0, 0.0)], [(0.0, 0.0), (0.0, 0.0)], radius=1.0)

    found, _ = collected(table)  # a double zero at t = 5

    (row,) = found.rows()
    assert row.low < 5.0
    assert found.limit == INFINITY


def test_errors_that_are_given_make_no_window_shorter():
    # Places are off by up to a tenth: shorter windows say no more, so there is one, and one pair.
    table = Table()
    add(table, STRAIGHT, [(0.0, 0.0)], [(0.0, 1.0), (0.0, 0.0)], radius=1.0)
    add(table, CURVED, [(5.0, 0.0)], [(0.0, 0.0), (0.0, 0.0)], radius=1.0)
    table.place_error[0] = table.place_error[1] = 0.1

    found, _ = collected(table)

    assert found.compared == 1
    assert found.rows()[0].low < 2.8


def test_rounding_far_from_the_begin_of_time_makes_no_window_shorter():
    # x = (t - T)^3 with T = 2^20: a window of 4 units of time around T, of which no part says more.
    later = 2.0**20
    cube = [-(later**3), 3.0 * later**2, -3.0 * later, 1.0]
    table = Table()
    add(table, CURVED, [(0.0, 0.0)], [(0.0, 0.0), (0.0, 0.0)], span=(0.0, 2.0 * later))
    add(table, CURVED, [(1.0, 0.0)], [(0.0, 0.0), (0.0, 0.0)], span=(0.0, 2.0 * later))
    table.radius[0] = 0.5
    for k in range(4):
        table.frames[k] = cube[k]

    found, _ = collected(table, low=later - 2.0, high=later + 2.0)

    assert found.compared < 10
    assert found.rows()[0].low < later + 0.7937  # the cube root of 1/2


def test_disc_that_meets_an_edge_is_sure_on_that_side():
    table = Table()
    add(table, STRAIGHT, [(0.5, 5.0)], [(0.0, 0.0), (0.0, -1.0)], radius=1.0)
    add(table, STRAIGHT, SQUARE, [(0.0, 0.0), (0.0, 0.0)])

    found, _ = collected(table)  # (1/2, 5 - t) is 1 above the upper edge at t = 3

    first = found.rows()[0]
    assert first[2:7] == (0, 0, 1, 2, NO_VERTEX)
    assert first.low < 3.0 < first.high
    assert found.limit == first.high


def test_points_of_no_extent_that_meet_are_candidates():
    table = Table()
    add(table, CURVED, [(0.0, 0.0)], [(0.0, 1.0), (0.0, 0.0)])
    add(table, CURVED, [(5.0, 0.0)], [(0.0, 0.0), (0.0, 0.0)])

    _, sharper = collected(table)

    assert any(row.low < 5.0 <= row.until for row in sharper.rows())


def test_contact_behind_the_end_of_a_piece_is_not_sure():
    # The span ends at 3, rounded upward from some number below: a contact at 3 may be none.
    for end, is_sure in ((3.0, False), (3.5, True)):
        table = Table()
        add(table, CURVED, [(0.5, 4.0)], [(0.0, 0.0), (0.0, -1.0)], span=(0.0, end))
        add(table, CURVED, SQUARE, [(0.0, 0.0), (0.0, 0.0)])

        found, sharper = collected(table, high=end)

        assert sharper.rows()[0].low < 3.0
        assert (found.limit < INFINITY) == is_sure


def test_contact_up_to_a_time_that_the_caller_answers_for_is_not_sure():
    table = Table()
    add(table, CURVED, [(0.5, 4.0)], [(0.0, 0.0), (0.0, -1.0)])
    add(table, CURVED, SQUARE, [(0.0, 0.0), (0.0, 0.0)])

    assert collected(table, after=2.9)[0].limit < 3.0 + 1e-9
    assert collected(table, after=3.1)[0].limit > 3.9  # at t = 4 it leaves on the other side


def test_turning_square_is_sharpened_to_rounding():
    # the tangent of half the angle is t: the corner (1, 1) is at (x, sqrt 2) for tan(a / 2) = t
    table = Table()
    add(table, TURNING, SQUARE, [(0.0, 0.0), (0.0, 0.0), (0.0, 0.25)], span=(0.0, 1.0))
    add(table, STRAIGHT, [(-1.0, 1.3), (2.0, 1.3), (2.0, 3.0)], [(0.0, 0.0), (0.0, 0.0)])

    _, sharper = collected(table, high=1.0)

    # sin a + cos a = 1.3 with a = 2 atan(t / 4)
    angle = math.pi / 4 - math.acos(1.3 / math.sqrt(2))
    first = sharper.rows()[0]
    assert first.low == pytest.approx(4 * math.tan(angle / 2), abs=1e-12)
    assert first.high - first.low < 1e-12


@pytest.mark.parametrize("c", [NAN, INFINITY])
@pytest.mark.parametrize("kind", [STRAIGHT, CURVED, TURNING, AFFINE])
def test_piece_of_no_numbers_may_touch_anything(kind, c):
    frame = [(c, 0.0), (0.0, 0.0), *[(1.0, 0.0)] * 4]
    table = Table()
    add(table, kind, SQUARE, frame, radius=0.5)
    add(table, STRAIGHT, [(100.0, 0.0)], [(0.0, 0.0), (0.0, 0.0)], radius=0.5)

    found, sharper = collected(table)

    assert found.limit == INFINITY
    assert {row[2:7] for row in sharper.rows()} == {
        *((0, v, 1, NO_EDGE, 0) for v in range(4)),
        *((1, 0, 0, e, NO_VERTEX) for e in range(4)),
    }


@pytest.mark.parametrize("radius", [NAN, INFINITY])
def test_pieces_of_a_radius_that_is_no_number_may_touch_everywhere(radius):
    table = Table()
    add(table, STRAIGHT, SQUARE, [(0.0, 0.0), (0.0, 0.0)], radius=radius)
    add(table, STRAIGHT, [(100.0, 0.0)], [(0.0, 0.0), (0.0, 0.0)])

    found, _ = collected(table)

    assert found.limit == INFINITY
    assert {row[2:7] for row in found.rows()} == {
        *((0, v, 1, NO_EDGE, 0) for v in range(4)),
        *((1, 0, 0, e, NO_VERTEX) for e in range(4)),
    }


def test_edge_that_shrinks_to_a_point_is_a_candidate_of_its_own():
    # x = (1 - t / 5) dx: at t = 5 the square is a segment
    table = Table()
    shrink = [(0.0, 0.0), (0.0, 0.0), (1.0, -0.2), (0.0, 0.0), (0.0, 0.0), (1.0, 0.0)]
    add(table, AFFINE, SQUARE, shrink)

    _, sharper = collected(table, 0, 0)

    ends = {(row.vertex, row.other_vertex) for row in sharper.rows() if row.edge == NO_EDGE}
    assert {(0, 1), (2, 3)} <= ends


def test_exact_only_leaves_whole_windows_to_exact_arithmetic():
    """The point meets the edge at t = 3; boxes of the half of the span in which it does meet."""
    table = Table()
    add(table, CURVED, [(0.5, 4.0)], [(0.0, 0.0), (0.0, -1.0)])
    add(table, CURVED, SQUARE, [(0.0, 0.0), (0.0, 0.0)])
    found = Candidates(INFINITY)
    search = Filter(table, exact_only=True)
    search.collect(i64(0), i64(1), 0.0, 10.0, 0.0, found)

    sharper = search.sharpen(found, 0.0)

    assert found.limit == INFINITY
    assert not any(found.sure)
    assert len(sharper.rows()) == len(found.rows())
    keys = {row[2:7] for row in found.rows() if row.low < 3.0 <= row.until}
    assert (0, 0, 1, 2, NO_VERTEX) in keys


def test_filter_looks_at_the_clock_in_windows():
    looks = []
    table = Table()
    turn = [(0.0, 0.0), (0.0, 0.0), (-2.0, 0.5)]
    add(table, TURNING, [(0.0, 0.0), (1.9, 0.0), (1.9, 0.1)], turn)
    add(table, STRAIGHT, [(2.0, -9.0), (3.0, 0.0), (2.0, 9.0)], [(0.0, 0.0), (0.0, 0.0)])
    search = Filter(table, look=lambda: looks.append(1))

    search.collect(i64(0), i64(1), 0.0, 10.0, 0.0, Candidates(INFINITY))

    assert looks


def test_windows_apart_are_told_by_each_side():
    table = Table()
    add(table, STRAIGHT, SQUARE, [(0.0, 0.0), (0.0, 0.0)])
    for x, y, is_apart in (
        (2.5, 0.0, True),
        (-2.5, 0.0, True),
        (0.0, 2.5, True),
        (0.0, 1.5, False),
    ):
        add(table, STRAIGHT, SQUARE, [(x, 0.0), (y, 0.0)])
        p, q = Window(), Window()
        p.fill(table, i64(0), 0.0, 1.0)
        q.fill(table, i64(table.count() - 1), 0.0, 1.0)
        assert are_apart(p, q, 1.0) == is_apart


MISTAKES = {
    "one half of a window": Edit(Filter, "collect", "= self.middle, end", "= end, end"),
    "boxes: the distance": Edit(Filter, "_add_edges", "(distance + 2.0", "(0.0 * distance + 2.0"),
    "boxes: a side": Edit(Filter, "_add_edges", "right < p.left", "right < p.right"),
    "edges of one piece": Edit(Filter, "_collect_window", "self._add_edges(q, p, found)", "pass"),
    "one side of an edge": Edit(Filter, "_add_edge", "(distance, -distance)", "(distance,)"),
    "vertices": Edit(Filter, "_collect_window", "self.distance != 0.0", "self.distance < 0.0"),
    "the end of a window": Edit(Filter, "_keep", "middle + half + off", "high"),
    "the rest of a window": Edit(
        Filter, "sharpened", "low, high = high, until", "return INFINITY, INFINITY"
    ),
}


@pytest.mark.skipif(not is_plain, reason="compiled functions cannot be edited")
@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=MISTAKES)
def test_planted_mistake_in_features_is_found(mistake):
    with mistake.made():
        assert is_found()


def is_found():
    """Return whether an adversary finds a contact that is lost: first by few rows."""
    for rows in (100, 1000, 5000):
        for kinds in KINDS.values():
            report, pairs = Report(), pairs_of(kinds, Random(59))
            while report.rows < rows and not report.wrong:
                check(*next(pairs), report)
            if report.wrong:
                return True
    return False


def test_features_of_large_pieces_are_sharpened_by_themselves(monkeypatch):
    """Each candidate filled the windows of all vertices: a ring in a hole took n^2 of them."""
    filled = []
    fill = Window.fill
    monkeypatch.setattr(
        Window, "fill", lambda w, table, *a: filled.append(len(table.xs)) or fill(w, table, *a)
    )

    def ring(n, radius):
        angles = (2 * math.pi * k / n for k in range(n))
        return [(radius * math.cos(a), radius * math.sin(a)) for a in angles]

    frame = Body("frame", ring(60, 2.0), holes=[ring(60, 1.0)])
    wheel = Body("wheel", ring(60, 0.995), Rigid([0, 1]))

    assert first_contact(Scene([frame, wheel], (0, 1))) is None
    large = [size for size in filled if size > 3]
    assert len(filled) > 2 * len(large)
