"""Boxes of pieces during a window of time, and the pairs of boxes that meet.

**The box of a piece** in the window t = middle + half s, -1 <= s <= 1. With the model of its path
(`exactpt.filters.models`), and less a drift, which is a path that all pieces have in common,

    p(t) - d(t)  =  (p0 - d0) + (p1 - d1) s + (p2 - d2) s^2,    within r,

with d0, d1, d2 of the drift d(t) = v t + b t^2. So it stays within its *reach* |p1 - d1| + |p2 -
d2| + r of its *center* p0 - d0::

            reach          left + reach      what the places of the piece add: from low to high
        |-----------|           |
        left .......center............... right
        |  low  |                   | high |

What the places add to the path is in the box of the places (`STRAIGHT`, `CURVED`), of all their
turns (`TURNING`) or of their images (`AFFINE`: `image_along`). If vertices move by themselves
(`OWN`, `GENERAL`), each has a path, and adds nothing. What is common to two pieces brings them no
nearer, so boxes less the drift meet if the pieces do: few do when all of a scene moves in one
direction.

*Errors.* A place is off by e at most in x and in y, and its turn by less than 2 e. The path is off
by path_error + speed_error |t|, beside relative errors, which are in r. The radius is added.

*Rounding.* Every sum and product below is rounded by at most U of its size. A term of the path or
of the drift goes through 5 operations at most until it is in the center or the reach (`course`):
that is in the reach, by 16 U of the sizes of all terms. Then a side of a box is a sum of three
terms and of two bounds: 16 U of the sizes of these terms again (`around_path`). `SLACK` covers the
rounding of bounds, `TINY` underflow. A number that is out of range ends in a margin that is
infinite or NaN: then the box is the plane.

**The pairs of boxes that meet**: `strips`.
"""

import math
from typing import Final

from librt.vecs import append, vec
from mypy_extensions import i64

from exactpt.filters.models import ROUNDING, Model, of_polynomial
from exactpt.filters.rounding import INFINITY, SLACK, TINY, U, as_lower, as_upper
from exactpt.filters.rows import (
    AFFINE,
    BOTTOM,
    BOX,
    COEFFICIENTS,
    FRAME,
    GENERAL,
    LEFT,
    MATRIX_A,
    MATRIX_B,
    MATRIX_C,
    MATRIX_D,
    OWN,
    OWN_Y,
    PATH_X,
    PATH_Y,
    RIGHT,
    TOP,
    Box,
    Table,
    append_box,
)
from exactpt.filters.windows import quotients

RUN: Final[i64] = 16
"""So many numbers are sorted by insertion, before runs are merged."""
ONE_STRIP: Final[i64] = 128
"""Up to so many boxes are swept in one strip."""


class Drift:
    """A path of degree 2 from the origin: any may be subtracted from all pieces.

    Attributes:
        x, y: the coefficients of t.
        bend_x, bend_y: those of t^2.
    """

    def __init__(
        self, x: float = 0.0, y: float = 0.0, bend_x: float = 0.0, bend_y: float = 0.0
    ) -> None:
        self.x = x
        self.y = y
        self.bend_x = bend_x
        self.bend_y = bend_y


def during(table: Table, low: float, high: float, drift: Drift) -> tuple[vec[i64], vec[float]]:
    """Return the pieces that last during a part of [low, high], and their boxes.

    A box holds the piece in that part, grown by its radius, less the drift: `BOX` numbers each.
    """
    active, boxes = vec[i64](), vec[float]()
    n: i64 = len(table.body)
    k: i64 = 0
    while k < n:
        start, end = table.start[k], table.end[k]
        if start <= high and end >= low:
            first, last = max(low, start), min(high, end)
            left, right, bottom, top = of_piece(table, k, first, last, drift)
            active = append(active, k)
            boxes = append_box(boxes, left, right, bottom, top)
        k += 1
    return active, boxes


def of_piece(table: Table, k: i64, low: float, high: float, drift: Drift) -> Box:
    """Return a box of a piece in [low, high], grown by its radius, less the drift."""
    middle = 0.5 * (low + high)
    half = max(high - middle, middle - low) * (1.0 + 4.0 * U)
    kind = table.kind[k]
    if kind in (OWN, GENERAL):
        left, right, bottom, top = around_vertices(table, k, middle, half, drift)
    else:
        left, right, bottom, top = around_path(table, k, middle, half, drift)
    latest = abs(middle - table.origin[k]) + half
    error = 2.0 * table.place_error[k] + table.path_error[k] + table.speed_error[k] * latest
    margin = (table.radius[k] + error) * SLACK + TINY
    left, right = left - margin, right + margin
    bottom, top = bottom - margin, top + margin
    if not (left <= right and bottom <= top):
        return plane()
    return left, right, bottom, top


def around_all(table: Table, t: float) -> Box:
    """Return the box of all pieces at a time, but for those of which no box is known."""
    left, right, bottom, top = INFINITY, -INFINITY, INFINITY, -INFINITY
    still = Drift()
    k: i64 = 0
    while k < len(table.body):
        if table.start[k] <= t <= table.end[k]:
            low_x, high_x, low_y, high_y = of_piece(table, k, t, t, still)
            if high_x - low_x < INFINITY and high_y - low_y < INFINITY:
                left, right = min(left, low_x), max(right, high_x)
                bottom, top = min(bottom, low_y), max(top, high_y)
        k += 1
    return left, right, bottom, top


def plane() -> Box:
    """Return the box of everything; compiled code has no constant tuples."""
    return -INFINITY, INFINITY, -INFINITY, INFINITY


def course(f: Model, middle: float, half: float, speed: float, bend: float) -> tuple[float, float]:
    """Return the center and the reach of a function less a drift, in the window."""
    c0, c1, c2, rest = f
    d0 = (speed + bend * middle) * middle
    d1 = (speed + 2.0 * bend * middle) * half
    d2 = bend * half * half
    latest = abs(middle) + half
    size_of_drift = (abs(speed) + abs(bend) * latest) * latest
    rounding = ROUNDING * (abs(c0) + abs(c1) + abs(c2) + 2.0 * size_of_drift)
    reach = (abs(c1 - d1) + abs(c2 - d2) + rest + rounding) * SLACK + TINY
    return c0 - d0, reach


def around_vertices(table: Table, k: i64, middle: float, half: float, drift: Drift) -> Box:
    """Return a box of vertices that move by themselves; the plane if one is out of range."""
    left, right, bottom, top = INFINITY, -INFINITY, INFINITY, -INFINITY
    local = middle - table.origin[k]
    v: i64 = 0
    while v < table.size[k]:
        if table.kind[k] == GENERAL:
            f, g = quotients(table, k, v, local, half)
        else:
            at = COEFFICIENTS * (table.place[k] + v)
            f = of_polynomial(table.own, at, local, half)
            g = of_polynomial(table.own, at + OWN_Y, local, half)
        x, reach_x = course(f, middle, half, drift.x, drift.bend_x)
        y, reach_y = course(g, middle, half, drift.y, drift.bend_y)
        if not (abs(x) + reach_x < INFINITY and abs(y) + reach_y < INFINITY):
            return plane()  # min and max would lose a NaN
        left, right = min(left, x - reach_x), max(right, x + reach_x)
        bottom, top = min(bottom, y - reach_y), max(top, y + reach_y)
        v += 1
    return left, right, bottom, top


def around_path(table: Table, k: i64, middle: float, half: float, drift: Drift) -> Box:
    """Return a box of a path and of what its places add."""
    at, local = FRAME * k, middle - table.origin[k]
    path_x = of_polynomial(table.frames, at + PATH_X, local, half)
    path_y = of_polynomial(table.frames, at + PATH_Y, local, half)
    x, reach_x = course(path_x, middle, half, drift.x, drift.bend_x)
    y, reach_y = course(path_y, middle, half, drift.y, drift.bend_y)
    low_x, high_x, low_y, high_y = table.box(k)
    if table.kind[k] == AFFINE:
        a, b, c, d = at + MATRIX_A, at + MATRIX_B, at + MATRIX_C, at + MATRIX_D
        low_x, high_x = image_along(table, k, a, b, local, half)
        low_y, high_y = image_along(table, k, c, d, local, half)
    # of all terms: a side may be a small difference of large ones
    rounding_x = ROUNDING * (abs(x) + reach_x + abs(low_x) + abs(high_x))
    rounding_y = ROUNDING * (abs(y) + reach_y + abs(low_y) + abs(high_y))
    left, right = (x - reach_x) + low_x - rounding_x, (x + reach_x) + high_x + rounding_x
    bottom, top = (y - reach_y) + low_y - rounding_y, (y + reach_y) + high_y + rounding_y
    return left, right, bottom, top


def image_along(
    table: Table, k: i64, a: i64, b: i64, middle: float, half: float
) -> tuple[float, float]:
    """Return bounds of a(t) dx + b(t) dy over the places of a piece, in the window.

    a is off a0 by its reach |a1| + |a2| + r at most, likewise b; dx is in the box of the places,
    but for its error e. So the sum is within that of a0 and b0 times the sides of the box, but for

        reach_a (|dx| + e) + |a0| e + reach_b (|dy| + e) + |b0| e.

    Args:
        table: the table.
        k: the piece.
        a: where the polynomial a begins in the frames.
        b: where b does.
        middle: of the window, since the origin of the piece.
        half: of its width.
    """
    a0, a1, a2, a_rest = of_polynomial(table.frames, a, middle, half)
    b0, b1, b2, b_rest = of_polynomial(table.frames, b, middle, half)
    left, right, bottom, top = table.box(k)
    error = table.place_error[k]
    size_x = max(abs(left), abs(right)) + error
    size_y = max(abs(bottom), abs(top)) + error
    reach_a, reach_b = abs(a1) + abs(a2) + a_rest, abs(b1) + abs(b2) + b_rest
    off = reach_a * size_x + reach_b * size_y + (abs(a0) + abs(b0)) * error
    rounding = ROUNDING * (abs(a0) * size_x + abs(b0) * size_y)
    margin = (off + rounding) * SLACK + TINY
    low = min(a0 * left, a0 * right) + min(b0 * bottom, b0 * top)
    high = max(a0 * left, a0 * right) + max(b0 * bottom, b0 * top)
    return low - margin, high + margin


def strips(boxes: vec[float], split: i64) -> vec[i64]:
    """Return the pairs of boxes that meet, as numbers i < j one after the other: each pair once.

    The plane is cut into horizontal strips. In each, the boxes that meet it are swept from left to
    right. Two boxes are compared in the strip of the higher of their lower sides, and in no other::

          strip 2   ......+-----+........        +---+ meets strips 0 and 1, the other one 1 and 2:
                          |     |                they are compared in strip 1, where the lower side
          strip 1   ..+---|-+...|........        of the higher one is.
                      |   +-----+
          strip 0   ..+-----+............

    If they meet, that height is between the sides of both. The strip of a height is computed by
    monotone functions, so both meet that strip: no pair is lost.

    Sides may be infinite. A NaN says nothing of where a side is: it counts as infinite, so that the
    box meets whatever it may meet.

    Args:
        boxes: `BOX` numbers a box.
        split: if positive, only pairs of a box below this number and one not below it.
    """
    cut = cut_of(boxes)
    members = Members(boxes, cut)
    pairs = vec[i64]()
    strip: i64 = 0
    while strip < cut.count:
        pairs = members.swept(strip, split, pairs)
        strip += 1
    return pairs


class Cut:
    """Strips of one height, from ``base`` upward; the first and the last are unbounded."""

    def __init__(self, base: float, height: float, count: i64) -> None:
        self.base = base
        self.height = height
        self.count = count

    def strip(self, y: float) -> i64:
        """Return the strip of a height: not decreasing with y, as each rounded operation is not."""
        place = (y - self.base) / self.height
        if not place >= 1.0:
            return 0
        if place >= float(self.count):
            return self.count - 1
        return i64(place)


def cut_of(boxes: vec[float]) -> Cut:
    """Return strips that are twice as high as the mean box: at most about the root of the number.

    Any strips would do. With these a finite box is in 2.5 of them at most on average.
    """
    n: i64 = len(boxes) // BOX
    if n <= ONE_STRIP:
        return Cut(0.0, 1.0, 1)
    lowest, highest, total = INFINITY, -INFINITY, 0.0
    k: i64 = 0
    while k < n:
        bottom, top = boxes[BOX * k + BOTTOM], boxes[BOX * k + TOP]
        if bottom > -INFINITY and top < INFINITY:
            lowest, highest = min(lowest, bottom), max(highest, top)
            total += top - bottom
        k += 1
    extent = highest - lowest
    if not 0.0 < extent < INFINITY:
        return Cut(0.0, 1.0, 1)
    mean = total / float(n)
    height = max(2.0 * mean, extent / float(n) ** 0.5)
    if not height > 0.0:  # it underflows
        return Cut(0.0, 1.0, 1)
    return Cut(lowest, height, i64(extent / height) + 1)


class Members:
    """The boxes in each strip, from left to right.

    Attributes:
        cut: the strips.
        firsts: strip s has the members from number firsts[s] up to, but without, firsts[s + 1].
        numbers: the number of the box of each member.
        boxes: its sides, `BOX` numbers a member: so a sweep reads one vector from begin to end.
    """

    def __init__(self, boxes: vec[float], cut: Cut) -> None:
        self.cut = cut
        sides = boxes if are_numbers(boxes) else without_nan(boxes)
        self._count(sides)
        self._distribute(sides)

    def _count(self, sides: vec[float]) -> None:
        """Find how many members each strip has; ``firsts`` is then ahead by one place."""
        cut = self.cut
        firsts = zeros(cut.count + 2)
        n: i64 = len(sides) // BOX
        k: i64 = 0
        while k < n:
            strip = cut.strip(sides[BOX * k + BOTTOM])
            last = cut.strip(sides[BOX * k + TOP])
            while strip <= last:
                firsts[strip + 2] += 1
                strip += 1
            k += 1
        k = 2
        while k < cut.count + 2:
            firsts[k] += firsts[k - 1]
            k += 1
        self.firsts = firsts

    def _distribute(self, sides: vec[float]) -> None:
        """Put the boxes into their strips, from left to right; ``firsts`` moves to its place."""
        cut, firsts = self.cut, self.firsts
        order = sorted_by(column(sides, LEFT))
        total = firsts[cut.count + 1]
        numbers = zeros(total)
        boxes = vec[float]()
        k: i64 = 0
        while k < total:
            boxes = append_box(boxes, 0.0, 0.0, 0.0, 0.0)
            k += 1
        k = 0
        while k < len(order):
            box = order[k]
            at = BOX * box
            left, right = sides[at + LEFT], sides[at + RIGHT]
            bottom, top = sides[at + BOTTOM], sides[at + TOP]
            strip, last = cut.strip(bottom), cut.strip(top)
            while strip <= last:
                member = firsts[strip + 1]
                firsts[strip + 1] += 1
                numbers[member] = box
                to = BOX * member
                boxes[to + LEFT], boxes[to + RIGHT] = left, right
                boxes[to + BOTTOM], boxes[to + TOP] = bottom, top
                strip += 1
            k += 1
        self.numbers = numbers
        self.boxes = boxes

    def swept(self, strip: i64, split: i64, pairs: vec[i64]) -> vec[i64]:
        """Return the pairs with those that are compared in a strip, and meet.

        Of a later member the left side is not to the left of that of the first. So they meet in x
        just if it is not to the right of the right side of the first; beyond it no member does.
        """
        cut, boxes, numbers = self.cut, self.boxes, self.numbers
        end = self.firsts[strip + 1]
        k = self.firsts[strip]
        while k < end:
            one = numbers[k]
            at = BOX * k
            right, bottom, top = boxes[at + RIGHT], boxes[at + BOTTOM], boxes[at + TOP]
            j = k + 1
            while j < end and boxes[BOX * j + LEFT] <= right:
                two = numbers[j]
                low, high = boxes[BOX * j + BOTTOM], boxes[BOX * j + TOP]
                j += 1
                if low > top or high < bottom:
                    continue
                if cut.count > 1 and cut.strip(max(low, bottom)) != strip:
                    continue
                if split > 0 and (one < split) == (two < split):
                    continue
                pairs = append(pairs, min(one, two))
                pairs = append(pairs, max(one, two))
            k += 1
        return pairs


def zeros(n: i64) -> vec[i64]:
    """Return n zeros."""
    found = vec[i64]()
    k: i64 = 0
    while k < n:
        found = append(found, 0)
        k += 1
    return found


def column(boxes: vec[float], side: i64) -> vec[float]:
    """Return one side of all boxes."""
    found = vec[float]()
    k = side
    while k < len(boxes):
        found = append(found, boxes[k])
        k += BOX
    return found


def without_nan(boxes: vec[float]) -> vec[float]:
    """Return the same boxes with infinite sides for those that are NaN."""
    found = vec[float]()
    k: i64 = 0
    while k < len(boxes):
        left, right = boxes[k + LEFT], boxes[k + RIGHT]
        bottom, top = boxes[k + BOTTOM], boxes[k + TOP]
        left, right = as_lower(left), as_upper(right)
        bottom, top = as_lower(bottom), as_upper(top)
        found = append_box(found, left, right, bottom, top)
        k += BOX
    return found


def sorted_by(keys: vec[float]) -> vec[i64]:
    """Return the numbers of the keys in the order of the keys, equal ones in their own; NaN first.

    A merge sort, on runs sorted by insertion. A vector has no method to sort it, and the built-in
    ``sorted`` makes objects of all numbers: for 100 to 10,000 keys it takes twice as long as this
    does compiled.
    """
    n: i64 = len(keys)
    order, other = vec[i64](), vec[i64]()
    k: i64 = 0
    while k < n:
        order = append(order, k)
        other = append(other, k)
        k += 1
    known = keys if are_numbers(keys) else lower_bounds(keys)
    begin: i64 = 0
    while begin < n:
        end = min(begin + RUN, n)
        insert(known, order, begin, end)
        begin = end
    width = RUN
    while width < n:
        begin = 0
        while begin < n:
            middle, end = min(begin + width, n), min(begin + 2 * width, n)
            merge(known, order, other, begin, middle, end)
            begin = end
        order, other = other, order
        width *= 2
    return order


def insert(keys: vec[float], order: vec[i64], begin: i64, end: i64) -> None:
    """Sort a part of the order by insertion."""
    k = begin + 1
    while k < end:
        item = order[k]
        key = keys[item]
        j = k - 1
        while j >= begin and keys[order[j]] > key:
            order[j + 1] = order[j]
            j -= 1
        order[j + 1] = item
        k += 1


def merge(
    keys: vec[float], order: vec[i64], to: vec[i64], begin: i64, middle: i64, end: i64
) -> None:
    """Merge two sorted parts of an order, before the middle and from it on; the first one first."""
    i, j = begin, middle
    k = begin
    while k < end:
        if i < middle and (j >= end or keys[order[i]] <= keys[order[j]]):
            to[k] = order[i]
            i += 1
        else:
            to[k] = order[j]
            j += 1
        k += 1


def are_numbers(values: vec[float]) -> bool:
    """Return True if no value is NaN."""
    k: i64 = 0
    while k < len(values):
        if math.isnan(values[k]):
            return False
        k += 1
    return True


def lower_bounds(values: vec[float]) -> vec[float]:
    """Return the same values, but -infinity for NaN."""
    found = vec[float]()
    k: i64 = 0
    while k < len(values):
        found = append(found, as_lower(values[k]))
        k += 1
    return found
