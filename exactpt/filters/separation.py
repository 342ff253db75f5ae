"""Two pieces in straight motion that a line separates during a window: they do not touch in it.

Boxes along the axes say little of long thin bodies side by side, and of bodies that pass each
other in a slanting direction. Another direction n often tells them apart. With all places of the
first piece displaced by c + w t relative to the second one, as in `exactpt.filters.straight`, the
two are disjoint at t if

        max over p of n . p + n . (c + w t)   <   min over q of n . q,      or the other way round,

and they are in a whole window if that is so at both of its ends, as n . (c + w t) is linear in t::

         p--p                       n . p + n . (c + w t)
        /   |   ---->  w            |=======|
       p----p                 ------|-------|-----|=========|------> n
                  q-----q                         n . q
                   `---q

Two directions are tried: across w, along which nothing moves, so that pieces that pass each other
are separated at all times; and across the longest edge of either piece, for thin ones.

Errors. n is any vector of doubles, so it has none. With |n| = |nx| + |ny|, S at least the size of
any coordinate of a place, and T of any time, n . p is off by |n| times the error of a place and 2 U
|n| S; n . (c + w t) by |n| (c_error + w_error T) and 4 U |n| (|c| + |w| T); one sum and one
comparison of sums are left. The margin has twice the first, and `ROUNDING`, 16 U, times the sizes.
A product that overflows separates nothing.
"""

from __future__ import annotations

from mypy_extensions import i64

from exactpt.filters.blocks import FEW
from exactpt.filters.models import ROUNDING
from exactpt.filters.rounding import INFINITY, SLACK, TINY
from exactpt.filters.rows import Table
from exactpt.filters.straight import RelativeMotion, larger_size, relative_motion


def are_separated(table: Table, a: i64, b: i64, low: float, high: float) -> bool:
    """Return True if a line certainly separates two pieces during [low, high].

    It is not tried for a piece of many vertices: blocks of them are compared in less time.

    Args:
        table: the pieces.
        a: a piece in straight motion, without radius.
        b: another one.
        low: the begin of a window within the spans of both pieces.
        high: its end.
    """
    if table.size[a] > FEW or table.size[b] > FEW:
        return False
    motion = relative_motion(table, a, b)
    gap = Gap(table, motion, a, b, low, high)
    if gap.is_across(motion.wx, motion.wy):
        return True
    ux, uy = longest_edge(table, a)
    if gap.is_across(ux, uy):
        return True
    ux, uy = longest_edge(table, b)
    return gap.is_across(ux, uy)


class Gap:
    """What is the same for all directions across which two pieces may have a gap.

    Attributes:
        table, motion, a, b: the pieces, and the motion of a relative to b.
        low, high: the window.
        margin: the margin (see above) of a vector n with |n| = 1.
    """

    def __init__(
        self, table: Table, motion: RelativeMotion, a: i64, b: i64, low: float, high: float
    ) -> None:
        self.table = table
        self.motion = motion
        self.a = a
        self.b = b
        self.low = low
        self.high = high
        times = larger_size(low, high)
        c_size, w_size = abs(motion.cx) + abs(motion.cy), abs(motion.wx) + abs(motion.wy)
        places = table.place_error[a] + table.place_error[b]
        error = places + motion.c_error + motion.w_error * times
        size = size_of_places(table, a) + size_of_places(table, b) + c_size + w_size * times
        self.margin = (2.0 * error + ROUNDING * size) * SLACK + TINY

    def is_across(self, ux: float, uy: float) -> bool:
        """Return True if the pieces certainly have a gap across a vector during the window."""
        nx, ny = -uy, ux
        least_a, most_a = extent(self.table, self.a, nx, ny)
        least_b, most_b = extent(self.table, self.b, nx, ny)
        motion = self.motion
        c, w = motion.cx * nx + motion.cy * ny, motion.wx * nx + motion.wy * ny
        begin, end = c + w * self.low, c + w * self.high
        if not (-INFINITY < begin < INFINITY and -INFINITY < end < INFINITY):
            return False
        margin = (abs(nx) + abs(ny)) * self.margin + TINY
        if most_a + max(begin, end) + margin < least_b:
            return True
        return least_a + min(begin, end) - margin > most_b


def size_of_places(table: Table, k: i64) -> float:
    """Return a bound of the size of all coordinates of the places of a piece."""
    left, right, bottom, top = table.box(k)
    return max(larger_size(left, right), larger_size(bottom, top))


def longest_edge(table: Table, k: i64) -> tuple[float, float]:
    """Return the vector of about the longest edge of a piece."""
    xs, ys, place, first = table.xs, table.ys, table.place[k], table.edge[k]
    longest_x, longest_y, longest = 0.0, 0.0, -1.0
    edge: i64 = 0
    while edge < table.edges[k]:
        i, j = place + table.begins[first + edge], place + table.ends[first + edge]
        ux, uy = xs[j] - xs[i], ys[j] - ys[i]
        length = ux * ux + uy * uy
        if length > longest:
            longest_x, longest_y, longest = ux, uy, length
        edge += 1
    return longest_x, longest_y


def extent(table: Table, k: i64, nx: float, ny: float) -> tuple[float, float]:
    """Return bounds of the products of a vector and the places of a piece; infinite if one is."""
    xs, ys, place = table.xs, table.ys, table.place[k]
    least, most = INFINITY, -INFINITY
    v: i64 = 0
    while v < table.size[k]:
        along = nx * xs[place + v] + ny * ys[place + v]
        if not -INFINITY < along < INFINITY:
            return -INFINITY, INFINITY
        least, most = min(least, along), max(most, along)
        v += 1
    return least, most
