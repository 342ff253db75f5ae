"""Rows of bodies in any motion: their doubles against exact positions, in units of all kinds."""

from fractions import Fraction
from itertools import pairwise
from math import inf, isfinite

import pytest
from mypy_extensions import i64

from exactpt import Affine, Body, Pieces, Rigid, Spin, Translation
from exactpt.filters.boxes import Drift, of_piece
from exactpt.filters.rows import AFFINE, CURVED, GENERAL, OWN, STRAIGHT, TURNING, WAITING
from exactpt.filters.windows import ROW, X0, Y0, Window
from exactpt.kernel.numbers import QQ, nearest_float, of_double, power_of_two
from exactpt.kernel.polynomial import substituted
from exactpt.motion.normalization import Normalization
from exactpt.search.body_rows import BodyRows
from exactpt.search.reading import Rows, rows_of
from exactpt.search.units import PLAIN
from fuzz.power.edits import Edit

THIRD, SEVENTH, TINY = Fraction(1, 3), Fraction(1, 7), Fraction(1, 10**400)
TRIANGLE = [(THIRD, 0), (2, SEVENTH), (1, "5/3")]
INSTANTS = (QQ(-1), QQ(0), QQ(1, 3), QQ(-5, 7), QQ(1))
"""Times of a window, from its start at -1 to its end at 1."""


class Mirrored:
    """A motion of a caller's own class: the place (x, y) goes to (y, x + t)."""

    def track(self, position):
        x, y = position
        return Translation([0], [0, 1]).track((y, x))


def moving_vertices(degree):
    """Three vertices that move by themselves, by polynomials of a degree."""
    way = [0] * (degree - 1)
    return [
        {"x": [THIRD, *way, SEVENTH], "y": [0]},
        {"x": [2], "y": [0, *way[1:], SEVENTH, THIRD][: degree + 1]},
        (1, "5/3"),
    ]


STRAIGHTLY = Translation([THIRD, SEVENTH], [0, "-2/3"])
BY_HALF = Rigid([0, "1/3", "1/7"], pivot=(THIRD, 2), x=[1, SEVENTH, 0, THIRD], y=[0, 0, SEVENTH])
TURNED = Rigid([0, "1/3"], pivot=(1, THIRD), orientation=("3/5", "-4/5"))
LINEAR = Affine([[1, ["0", "1/7"]], [["0", "1/3"], [1, 0, "1/9"]]], x=[THIRD, 1])

BODIES = {
    "straight": (Body("b", TRIANGLE, STRAIGHTLY), {STRAIGHT}),
    "point": (Body("b", [(THIRD, SEVENTH)], STRAIGHTLY), {STRAIGHT}),
    "chain": (Body("b", TRIANGLE, STRAIGHTLY, closed=False), {STRAIGHT}),
    "hole": (
        Body("b", [(0, 0), (9, 0), (0, 9)], STRAIGHTLY, holes=[[(1, 1), (2, 1), (1, THIRD + 2)]]),
        {STRAIGHT},
    ),
    "curved": (Body("b", TRIANGLE, Translation([0, 0, 0, SEVENTH], [THIRD, 1, "-2/3"])), {CURVED}),
    "tiny path": (Body("b", TRIANGLE, Translation([THIRD, SEVENTH, TINY], [0, TINY, 1])), {CURVED}),
    "long": (Body("b", TRIANGLE, Translation([0, 0, 0, 0, SEVENTH], [THIRD])), {GENERAL}),
    "turning": (Body("b", TRIANGLE, BY_HALF), {TURNING}),
    "turned": (Body("b", TRIANGLE, TURNED), {TURNING}),
    "turning long": (Body("b", TRIANGLE, Rigid([0, 1, 0, 0, SEVENTH])), {GENERAL}),
    "affine": (Body("b", TRIANGLE, LINEAR), {AFFINE}),
    "affine long": (Body("b", TRIANGLE, Affine([[1, [0, 0, 0, 0, 1]], [0, 1]])), {GENERAL}),
    "own": (Body("b", moving_vertices(3)), {OWN}),
    "own long": (Body("b", moving_vertices(5)), {GENERAL}),
    "own turning": (Body("b", moving_vertices(2), BY_HALF), {GENERAL}),
    "own affine": (Body("b", moving_vertices(1), LINEAR), {OWN}),
    "keyframes": (
        Body("b", keyframes=[(0, TRIANGLE), (1, [(0, 0), (2, 0), (SEVENTH, 2)])]),
        {OWN},
    ),
    "pieces": (
        Body(
            "b",
            TRIANGLE,
            Pieces([(1, STRAIGHTLY), (None, Translation([THIRD, SEVENTH, 0], ["-2/3"]))]),
        ),
        {STRAIGHT},
    ),
    "spin": (Body("b", TRIANGLE, Spin(2, (THIRD, 1), error="1/50")), {TURNING}),
    "own class": (Body("b", TRIANGLE, Mirrored()), {OWN}),
}
UNITS = {
    "plain": PLAIN,
    "shifted": Normalization((QQ(1, 3), QQ(-7)), (0, 0), QQ(0), 0),
    "later": Normalization((QQ(0), QQ(0)), (0, 0), QQ(2, 3), 0),
    "tiny": Normalization((QQ(0), QQ(0)), (-90, -90), QQ(0), 0),
    "slow": Normalization((QQ(1, 7), QQ(1)), (70, 70), QQ(1, 3), 9),
}


def rows_in(body, units, start=0, end=2):
    """All rows of a body."""
    rows = Rows([body], QQ(start), QQ(end), units=units)
    rows.add_all()
    rows.make_all_pieces()
    return rows


def off_in_window(rows, k, low, high):
    """Return the largest error of a row in a window, by what is stated, and whether it is known.

    Raises:
        AssertionError: if a vertex is outside the box of the row.
    """
    table, units, (body,) = rows.table, rows.units, rows.bodies
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    window = Window()
    window.fill(table, i64(k), middle, half)
    box = of_piece(table, k, low, high, Drift())
    sides = [of_double(side) if isfinite(side) else side for side in box]
    worst = QQ(0)
    for instant in INSTANTS:
        t = of_double(middle) + instant * of_double(half)
        start, end = rows.spans[k]
        now = min(max(t * power_of_two(units.time_scale) + units.origin, start), end)
        t = (now - units.origin) * power_of_two(-units.time_scale)
        s = (t - of_double(middle)) / (of_double(half) or 1)
        for v, place in enumerate(body.exact_at(now)):
            exact = [
                (c - center) * power_of_two(-scale)
                for c, center, scale in zip(place, units.center, units.scale, strict=True)
            ]
            assert sides[0] <= exact[0] <= sides[1]
            assert sides[2] <= exact[1] <= sides[3]
            for at, c in zip((X0, Y0), exact, strict=True):
                model = [window.rows[i64(int(ROW) * v + int(at) + i)] for i in range(3)]
                if not window.rho < inf:
                    return None
                near = of_double(model[0]) + s * (of_double(model[1]) + s * of_double(model[2]))
                worst = max(worst, abs(near - c) / of_double(window.rho))
    return nearest_float(worst), window.rho


def windows_of(table, k):
    """Windows of a row: its whole span, parts of it, and single times."""
    start, end = table.start[k], table.end[k]
    parts = [start + (end - start) * j / 8 for j in range(9)]
    return [(start, end), *pairwise(parts), *[(t, t) for t in parts]]


@pytest.mark.parametrize("units", UNITS.values(), ids=UNITS)
@pytest.mark.parametrize("body, kinds", BODIES.values(), ids=BODIES)
def test_row_at_rational_times_is_within_its_stated_errors(body, kinds, units):
    rows = rows_in(body, units)
    table = rows.table
    size = max(
        abs(nearest_float(c * power_of_two(-units.scale[0]))) for c in (QQ(9), units.center[0])
    )

    assert {*table.kind} - {WAITING} == kinds
    known = 0
    for k in range(table.count()):
        if table.kind[k] == WAITING:
            continue
        for low, high in windows_of(table, k):
            found = off_in_window(rows, k, low, high)
            if found is not None:
                assert found[0] <= 1.0
                known += 1
                assert high > low or found[1] < 1e-12 * size
    assert known >= 9


@pytest.mark.parametrize("body, kinds", BODIES.values(), ids=BODIES)
def test_rows_of_a_body_follow_each_other_with_its_edges(body, kinds):
    rows = rows_in(body, PLAIN)
    table = rows.table
    pieces = [k for k in range(table.count()) if table.kind[k] != WAITING]

    spans = [rows.spans[k] for k in pieces]
    assert kinds
    assert (spans[0][0], spans[-1][1]) == (0, 2)
    assert all(one[1] == two[0] for one, two in pairwise(spans))
    for k in pieces:
        assert table.size[k] == body.size
        ends = [rows.ends_of(k, e) for e in range(table.edges[k])]
        assert ends == (body.edges or [(0, 0)])
        assert of_double(table.start[k]) <= rows.spans[k][0]
        assert of_double(table.end[k]) >= rows.spans[k][1]


def later(f, shift):
    """The coefficients of f(t - shift)."""
    return [*map(Fraction, map(str, substituted([*map(QQ, map(str, f))], QQ(-shift), QQ(1))))]


@pytest.mark.parametrize("shift", [100, 10**6])
@pytest.mark.parametrize("kind", ["curved", "turning", "affine", "own", "general"])
def test_piece_long_after_time_0_has_an_origin_of_its_own(kind, shift):
    """Windows say as much as of the piece at time 0, although powers of its times are large."""
    cubic, turn = [THIRD, 1, "-2/3", SEVENTH], [0, "1/3", "1/7"]

    def made(shift):
        x, h = later(cubic, shift), later(turn, shift)
        motion = {
            "curved": Translation(x),
            "turning": Rigid(h, pivot=(THIRD, 1), x=x),
            "affine": Affine([[1, h], [h, 1]], x=x),
            "own": Translation(x),
            "general": Translation([*later([*cubic, 1], shift)]),
        }[kind]
        shape = TRIANGLE
        if kind == "own":
            shape = [{"x": h, "y": [0]}, *TRIANGLE[1:]]
        return rows_in(Body("b", shape, motion), PLAIN, shift, shift + 2)

    far, near = made(shift), made(0)

    assert near.table.origin[0] == 0.0
    assert abs(far.table.origin[0] - (shift + 1)) < 1.0
    for low, high in windows_of(near.table, 0):
        error, rho = off_in_window(far, 0, low + shift, high + shift)
        assert error <= 1.0
        assert rho < 20.0 * off_in_window(near, 0, low, high)[1] + 1e-9


def test_spin_that_waits_is_in_the_box_of_its_row_all_the_time():
    spin = Spin(2, (THIRD, 1), error="1/50", x=[0, SEVENTH], y=[1, 0, THIRD])
    body = Body("b", TRIANGLE, spin)
    rows = Rows([body], QQ(0), QQ(4))
    rows.add_all()
    table = rows.table

    assert list(table.kind) == [WAITING]
    assert (table.size[0], table.edges[0]) == (0, 0)
    for k in range(64):
        low, high = k / 16, (k + 1) / 16
        left, right, bottom, top = map(of_double, of_piece(table, 0, low, high, Drift()))
        for x, y in body.exact_at(of_double(low)) + body.exact_at(QQ(k, 16) + QQ(1, 21)):
            assert left <= x <= right
            assert bottom <= y <= top


def test_pieces_are_made_up_to_a_time_and_the_row_waits_from_then_on():
    body = Body("b", TRIANGLE, Spin(2, (THIRD, 1), error="1/50"))
    rows = rows_of([body], QQ(0), QQ(4))

    rows.make_pieces(0, 0.0, 1.0, 1000)

    made = rows.spans[1:]
    assert [end for _, end in made[:-1]] == [start for start, _ in made[1:]]
    assert made[0][0] == 0
    assert made[-2][1] < 1 <= made[-1][1]
    assert rows.spans[0] == (made[-1][1], 4)
    assert of_double(rows.table.start[0]) <= made[-1][1]
    rows.make_pieces(0, 0.0, inf, 1000)
    assert rows.spans[-1][1] == 4
    assert rows.table.start[0] == inf


def test_numbers_out_of_the_range_of_doubles_are_nan():
    """Of such a row filters know nothing."""
    for motion in (
        Translation([0, 0, 10**400]),
        Rigid([0, TINY]),
        Affine([[1, [0, TINY]], [0, 1]]),
    ):
        rows = rows_in(Body("b", TRIANGLE, motion), PLAIN)
        window = Window()
        window.fill(rows.table, i64(0), 0.5, 0.5)

        assert not window.rho < inf


@pytest.mark.parametrize("factor", [1, 10**5])
def test_rows_of_vertices_that_are_quotients_have_w_that_begins_with_1(factor):
    """w is the square of the denominator of the turn, times any number."""
    body = Body("b", moving_vertices(2), Rigid([0, Fraction(factor, 3)]))
    table = rows_in(body, PLAIN).table
    terms = table.terms[0]

    assert [table.general[table.place[0] + (3 * v + 2) * terms] for v in range(3)] == [1.0] * 3


MISTAKES = {
    "the turn": Edit(BodyRows, "_turning", "cosine == 1 else", "True else"),
    "the pivot": Edit(
        BodyRows,
        "_turning",
        "frame = self._path(motion, motion.exact_pivot",
        "frame = self._path(motion, (NOTHING, NOTHING)",
    ),
    "the center": Edit(BodyRows, "_place_in_time", "moved[i] -= center * c", "moved[i] -= c"),
    "the unit of time": Edit(BodyRows, "_in_time", "* step, step)", "* step, ONE)"),
    "the origin": Edit(
        BodyRows, "_of_time", "exact_coefficients, origin)", "exact_coefficients, 0.0)"
    ),
    "the denominator": Edit(BodyRows, "_general", "[c * scale for c in f]", "[*f]"),
    "the piece": Edit(BodyRows, "row_after", "exact_piece_after(start)", "exact_piece_after(ONE)"),
}


@pytest.mark.plain
@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=MISTAKES)
def test_planted_mistake_in_rows_is_found(mistake):
    with mistake.made(), pytest.raises(AssertionError):
        check_all()


def check_all():
    """Run the tests of positions."""
    for body, kinds in BODIES.values():
        for units in UNITS.values():
            test_row_at_rational_times_is_within_its_stated_errors(body, kinds, units)
    for kind in ("curved", "turning", "affine", "own", "general"):
        test_piece_long_after_time_0_has_an_origin_of_its_own(kind, 100)
    test_rows_of_vertices_that_are_quotients_have_w_that_begins_with_1(10**5)
