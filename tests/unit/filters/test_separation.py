"""Lines that separate two pieces: never wrong, and found where they are plain."""

from fractions import Fraction
from unittest.mock import patch

import pytest

from exactpt.filters import separation
from exactpt.filters.rows import Table
from exactpt.filters.separation import are_separated
from fuzz.adversaries.separation import attack
from fuzz.power.edits import Edit

# Without `ROUNDING`, and without the tests of infinite numbers, the adversary finds nothing in 10^4
# pairs: a touch within the rounding of three sums, in a direction that is tried, is too rare. The
# rows of `AIMED` are for these.
PLANTED = {
    "no margin": Edit(separation.Gap, "is_across", " + TINY", " * 0.0"),
    "no stated errors": Edit(separation.Gap, "__init__", "2.0 * error + ", ""),
    "the begin alone": Edit(
        separation.Gap, "is_across", "begin, end = c + w * self.low, c + w * self.high",
        "begin = end = c + w * self.low",
    ),
    "the end alone": Edit(
        separation.Gap, "is_across", "begin, end = c + w * self.low, c + w * self.high",
        "begin = end = c + w * self.high",
    ),
    "the wrong extreme": Edit(separation.Gap, "is_across", "most_a + max(", "least_a + max("),
}  # fmt: skip


def triangles(x, y, velocity, size=1.0):
    """A long thin triangle at an angle, and the same one beside it, which moves."""
    table = Table()
    shape = [(0.0, 0.0), (100.0 * size, 100.0 * size), (100.0 * size, 101.0 * size)]
    for dx, dy, (vx, vy) in ((0.0, 0.0, (0.0, 0.0)), (x, y, velocity)):
        xs, ys = [px + dx for px, _ in shape], [py + dy for _, py in shape]
        table.add_straight(table.count(), 0.0, 10.0, xs, ys, (0.0, vx), (0.0, vy), 0.0)
    return table


def point_at_an_edge(place, displacement, begin, end):
    """A point that rests at place + displacement, and an edge, which is the longest one."""
    table = Table()
    (x, y), (cx, cy) = place, displacement
    table.add_straight(0, 0.0, 1.0, [x], [y], (cx,), (cy,), 0.0)
    table.add_straight(1, 0.0, 1.0, *([p[k] for p in (begin, end)] for k in (0, 1)), (), (), 0.0)
    return table


def hexadecimal(*numbers):
    return tuple(map(float.fromhex, numbers))


# The point is at an end q of the edge. As computed, n . p + n . c is off n . q by 1.6 U of sizes:
# products just above powers of two, all rounded to the side that parts them (a search climbed to
# these numbers).
ROUNDED = (
    hexadecimal("0x1.00000281c4a02p+0", "-0x1.000000b09e919p+0"),
    hexadecimal("-0x1.d333ce3p-24", "-0x1.e11addp-28"),
    hexadecimal("0x1.000000ae90d1fp+0", "-0x1.000000ceb03f6p+0"),
    hexadecimal("0x1.8000006e8f2f9p+0", "-0x1.000001e21f0e9p-1"),
)
B = 2.0**511
# The point, at (2.75, -2.5) B, is on the line x + y = B / 4 of the edge, between its ends. With
# n = (B, B), 4.25 B, its x without the displacement, times B overflows: 4 B^2 = 2^1024.
OVERFLOWING = (
    (4.25 * B, -2.5 * B),
    (-1.5 * B, 0.0),
    (2.0 * B, -1.75 * B),
    (3.0 * B, -2.75 * B),
)
AIMED = {
    "rounding of 1 U": (patch.object(separation, "ROUNDING", 2.0**-53), ROUNDED),
    "infinite extents": (
        Edit(separation, "extent", "not -INFINITY < along < INFINITY", "False").made(),
        OVERFLOWING,
    ),
}


def is_on_edge(place, displacement, begin, end):
    """Return True if a point is on an edge, by rationals."""
    (x, y), (bx, by), (ex, ey) = (tuple(map(Fraction, p)) for p in (place, begin, end))
    x, y = x + Fraction(displacement[0]), y + Fraction(displacement[1])
    ux, uy, zx, zy = ex - bx, ey - by, x - bx, y - by
    return ux * zy == uy * zx and 0 <= zx * ux + zy * uy <= ux * ux + uy * uy


def test_thin_bodies_side_by_side_are_separated_across_their_longest_edge():
    """Their boxes overlap. Across (-1, 1) the one is in [0, 1], the other in [5, 6] less t / 2."""
    table = triangles(0.0, 5.0, (0.25, -0.25))

    assert are_separated(table, 0, 1, 0.0, 7.0)
    assert not are_separated(table, 0, 1, 0.0, 9.0)  # at t = 8 the gap is closed


def test_bodies_that_pass_each_other_are_separated_across_their_relative_motion():
    """Moving along (1, 1), the other stays in [3, 4] across (-1, 1), at all times."""
    table = triangles(-200.0, -197.0, (40.0, 40.0))

    assert are_separated(table, 0, 1, 0.0, 10.0)


def test_touching_bodies_are_not_separated():
    """The first triangle ends at y - x = 1, where the other one begins."""
    assert not are_separated(triangles(0.0, 1.0, (0.0, 0.0)), 0, 1, 0.0, 1.0)


@pytest.mark.parametrize("size", [2.0**-1060, 1e306])
def test_numbers_at_the_ends_of_doubles_separate_nothing_wrongly(size):
    assert not are_separated(triangles(0.0, size, (0.0, 0.0), size), 0, 1, 0.0, 1.0)


def overflowing_motion():
    """The products of c and of w with a direction are about 10^308: their sum is -infinity."""
    table = Table()
    xs, ys = [0.0, -1.0348619574947573e154], [0.0, -8.72206612947026e153]
    x = -1.3267253959881757e153, -3.89090938995143e153
    y = -2.7813805261684905e154, -1.2367219190392802e154
    table.add_straight(0, -4.0, 4.0, xs, ys, x, y, 0.0)
    xs, ys = [0.0, 7.104865347426913e153], [0.0, 1.567202942290529e154]
    table.add_straight(1, -4.0, 4.0, xs, ys, (), (), 0.0)

    return table


def test_motion_that_overflows_separates_nothing():
    assert not are_separated(overflowing_motion(), 0, 1, -2.9375, 2.25)  # they touch, by rationals


@pytest.mark.plain
def test_motion_that_overflows_finds_that_infinite_sums_are_not_left_out():
    is_finite = "(-INFINITY < begin < INFINITY and -INFINITY < end < INFINITY)"

    with Edit(separation.Gap, "is_across", f"not {is_finite}", "False").made():
        assert are_separated(overflowing_motion(), 0, 1, -2.9375, 2.25)


def test_adversary_finds_no_wrong_answer():
    report = attack(3000, 1)

    assert report.wrong == []
    assert report.counts["separated"] > 300
    assert report.counts["touching"] > 300


@pytest.mark.plain
@pytest.mark.parametrize("name", PLANTED)
def test_adversary_of_a_planted_mistake_finds_it(name):
    with PLANTED[name].made():
        assert any(attack(2000, seed).wrong for seed in range(1, 9))


@pytest.mark.plain
@pytest.mark.parametrize("name", AIMED)
def test_aimed_row_finds_a_planted_mistake(name):
    mistake, row = AIMED[name]

    assert is_on_edge(*row)
    assert not are_separated(point_at_an_edge(*row), 0, 1, 0.0, 1.0)
    with mistake:
        assert are_separated(point_at_an_edge(*row), 0, 1, 0.0, 1.0)
