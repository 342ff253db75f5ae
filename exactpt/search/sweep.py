"""Pairs of rows that come near each other in a slab of time, and their candidates.

A *slab* is a window [low, high] of the time span. In a slab a row (`exactpt.filters.rows`) has a
box that contains it all the time; two rows whose boxes do not meet do not touch in the slab. Of
the pairs that are left, those that move straight have the times [enter, leave] at which their
moving boxes meet. `Scan` compares their features in the order of `enter`, and ends at a time by
which two of them certainly touch:

    enter of the pairs   |--1--|    |--2--|  |--3--|         |--4--|
                                          ^ limit: pair 2 certainly touches here
    compared              1          2      3 up to the limit

So most pairs are never compared. All of this is in doubles, within the bounds of the filters.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Final

from librt.vecs import append, vec
from mypy_extensions import i64

from exactpt.filters import straight
from exactpt.filters.boxes import Drift, during, of_piece, sorted_by, strips
from exactpt.filters.candidates import Candidates
from exactpt.filters.features import Filter
from exactpt.filters.rounding import INFINITY
from exactpt.filters.rows import (
    BOX,
    COEFFICIENTS,
    FRAME,
    GENERAL,
    LINE,
    OWN,
    OWN_Y,
    PATH_Y,
    STRAIGHT,
    WAITING,
    Table,
    append_box,
)
from exactpt.filters.separation import are_separated
from exactpt.filters.starts import Starts
from exactpt.kernel.budget import check_budget

BOXES_A_LOOK: Final[i64] = 512
"""Number of pairs of boxes between two looks at the budget."""
ROWS_A_LOOK: Final[i64] = 64
"""Number of rows of groups between two looks at the budget."""
STARTS_A_LOOK: Final[i64] = 8
"""Number of pairs of rows that are compared at the start between two looks at the budget."""
SAMPLE: Final[i64] = 256
"""Number of rows, about, of which a drift and a stride are estimated."""


class Ignored:
    """Bodies that ignore each other.

    Args:
        groups: for each body the numbers of its groups, in increasing order; empty if no body is
            in a group.
        pairs: pairs i < j of bodies that ignore each other, beside those of the groups.
    """

    def __init__(
        self, groups: Sequence[Sequence[int]] = (), pairs: Iterable[tuple[int, int]] = ()
    ) -> None:
        self._pairs = frozenset(pairs)
        self._first = vec[i64]()
        self._numbers = vec[i64]()
        for some in groups:
            self._first = append(self._first, i64(len(self._numbers)))
            for number in some:
                self._numbers = append(self._numbers, i64(number))
        self._first = append(self._first, i64(len(self._numbers)))

    def has(self, i: i64, j: i64) -> bool:
        """Return True if two different bodies ignore each other."""
        if self._pairs and (int(min(i, j)), int(max(i, j))) in self._pairs:
            return True
        first, numbers = self._first, self._numbers
        if len(first) == 1:
            return False
        p, q = first[i], first[j]
        while p < first[i + 1] and q < first[j + 1]:
            if numbers[p] == numbers[q]:
                return True
            if numbers[p] < numbers[q]:
                p += 1
            else:
                q += 1
        return False


class Pairs:
    """Pairs of rows.

    Attributes:
        one, two: the rows of each pair.
        enter, leave: bounds of the times at which they may touch.
        waiting: for each row of the kind `WAITING` that others may touch, from when to when. With
            its pieces, pairs are to be found anew.
    """

    def __init__(self) -> None:
        self.waiting: dict[int, tuple[float, float]] = {}
        self.one = vec[i64]()
        self.two = vec[i64]()
        self.enter = vec[float]()
        self.leave = vec[float]()

    def _need(self, row: int, enter: float, leave: float) -> None:
        """Note that the pieces of a row are needed in [enter, leave]."""
        known = self.waiting.get(row)
        if known is not None:
            enter, leave = min(enter, known[0]), max(leave, known[1])
        self.waiting[row] = enter, leave

    def count(self) -> int:
        """Return the number of pairs."""
        return len(self.one)

    def add(self, table: Table, one: i64, two: i64, low: float, high: float) -> None:
        """Add two rows, or a row with itself, unless they certainly do not touch in [low, high]."""
        enter = max(low, table.start[one], table.start[two])
        leave = min(high, table.end[one], table.end[two])
        if is_on_line(table, one) and is_on_line(table, two):
            enter, leave = straight.meeting(table, one, two, enter, leave)
        if not enter <= leave:
            return
        if table.kind[one] == WAITING:
            self._need(int(one), enter, leave)
        if table.kind[two] == WAITING:
            self._need(int(two), enter, leave)
        self.one = append(self.one, one)
        self.two = append(self.two, two)
        self.enter = append(self.enter, enter)
        self.leave = append(self.leave, leave)

    def rows(self) -> list[tuple[int, int]]:
        """Return the pairs of rows, in the order in which they were found."""
        found: list[tuple[int, int]] = []
        k: i64 = 0
        while k < len(self.one):
            found.append((int(self.one[k]), int(self.two[k])))
            k += 1
        return found


def is_on_line(table: Table, row: i64) -> bool:
    """Return True if a row, or the box of one that waits, moves straight."""
    kind = table.kind[row]
    return kind == STRAIGHT or (kind == WAITING and table.terms[row] == LINE)


def are_straight(table: Table, one: i64, two: i64) -> bool:
    """Return True if two rows move straight, and touch where they have a point in common."""
    if table.kind[one] != STRAIGHT or table.kind[two] != STRAIGHT:
        return False
    return table.radius[one] + table.radius[two] == 0.0


def move_together(table: Table, one: i64, two: i64) -> bool:
    """Return True if two rows keep their places beside each other: they do not begin to touch."""
    return one != two and table.together[one] != 0 and table.together[one] == table.together[two]


class Flow:
    """A path that many rows have in common, and a time in which they meet others.

    Any path and any stride are right: they are estimates, of a sample.

    Attributes:
        drift: the path with the median velocity and acceleration; boxes are relative to it, as
            what all have in common brings no two of them nearer.
        stride: the time in which rows move, on average, by the mean distance of neighbours.
    """

    def __init__(self, drift: Drift, stride: float) -> None:
        self.drift = drift
        self.stride = stride


def flow_of(table: Table, now: float) -> Flow:
    """Estimate the drift and the stride of the rows at a time."""
    n: i64 = len(table.body)
    if n == 0:
        return Flow(Drift(), INFINITY)
    step = max(n // SAMPLE, 1)
    speeds_x, speeds_y = vec[float](), vec[float]()
    bends_x, bends_y = vec[float](), vec[float]()
    left, right, bottom, top = INFINITY, -INFINITY, INFINITY, -INFINITY
    k: i64 = 0
    while k < n:
        if table.kind[k] == GENERAL:
            k += step
            continue
        coefficients, at = table.frames, FRAME * k
        x = coefficients[at] + 0.5 * (table.boxes[BOX * k] + table.boxes[BOX * k + 1])
        y = coefficients[at + PATH_Y] + 0.5 * (table.boxes[BOX * k + 2] + table.boxes[BOX * k + 3])
        if table.kind[k] == OWN:
            coefficients, at = table.own, COEFFICIENTS * table.place[k]
            x, y = coefficients[at], coefficients[at + OWN_Y]
        local = now - table.origin[k]
        speeds_x = append(speeds_x, speed_at(coefficients, at, local))
        speeds_y = append(speeds_y, speed_at(coefficients, at + PATH_Y, local))
        bends_x = append(bends_x, bend_at(coefficients, at, local))
        bends_y = append(bends_y, bend_at(coefficients, at + PATH_Y, local))
        left, right, bottom, top = min(left, x), max(right, x), min(bottom, y), max(top, y)
        k += step
    m: i64 = len(speeds_x)
    if m == 0:
        return Flow(Drift(), INFINITY)
    speed_x, speed_y = median(speeds_x), median(speeds_y)
    bend_x, bend_y = median(bends_x), median(bends_y)
    # of a path with this velocity and this bend at the time
    drift = Drift(speed_x - 2.0 * bend_x * now, speed_y - 2.0 * bend_y * now, bend_x, bend_y)
    total = 0.0
    k = 0
    while k < m:
        total += abs(speeds_x[k] - speed_x) + abs(speeds_y[k] - speed_y)
        k += 1
    mean_speed = total / float(m)
    if not mean_speed > 0.0:
        return Flow(drift, INFINITY)
    mean_distance = ((right - left) + (top - bottom)) / float(n) ** 0.5
    return Flow(drift, mean_distance / mean_speed)


def speed_at(coefficients: vec[float], at: i64, t: float) -> float:
    """Return about the derivative of a polynomial of degree 3."""
    bend = 2.0 * coefficients[at + 2] + 3.0 * t * coefficients[at + 3]
    return coefficients[at + 1] + t * bend


def bend_at(coefficients: vec[float], at: i64, t: float) -> float:
    """Return about half the second derivative of a polynomial of degree 3."""
    return coefficients[at + 2] + 3.0 * t * coefficients[at + 3]


def median(values: vec[float]) -> float:
    """Return a median of some values, one or more."""
    n: i64 = len(values)
    return values[sorted_by(values)[n // 2]]


def pairs_during(
    table: Table,
    ignored: Ignored,
    low: float,
    high: float,
    drift: Drift,
    *,
    with_themselves: bool = True,
) -> Pairs:
    """Return the pairs of rows that may touch in [low, high].

    Args:
        table: the rows.
        ignored: bodies that ignore each other.
        low: the start.
        high: the end.
        drift: what boxes are relative to.
        with_themselves: whether rows that may touch themselves are pairs with themselves.
    """
    active, boxes = during(table, low, high, drift)
    pairs = Pairs()
    if has_several_pieces(table, active):
        add_of_bodies(pairs, table, active, boxes, ignored, low, high)
    else:
        add_of_rows(pairs, table, active, boxes, ignored, low, high)
    k: i64 = 0
    while with_themselves and k < len(active):
        add_itself(pairs, table, active[k], low, high)
        k += 1
    return pairs


def has_several_pieces(table: Table, active: vec[i64]) -> bool:
    """Return True if two rows, one after the other, are of one body."""
    k: i64 = 1
    while k < len(active):
        if table.body[active[k]] == table.body[active[k - 1]]:
            return True
        k += 1
    return False


def add_of_rows(
    pairs: Pairs,
    table: Table,
    active: vec[i64],
    boxes: vec[float],
    ignored: Ignored,
    low: float,
    high: float,
) -> None:
    """Add the pairs of rows of which the boxes meet."""
    met = strips(boxes, 0)
    k: i64 = 0
    while k < len(met):
        one, two = active[met[k]], active[met[k + 1]]
        k += 2
        if k % (2 * BOXES_A_LOOK) == 0:
            check_budget()
        i, j = table.body[one], table.body[two]
        if i != j and not ignored.has(i, j):
            pairs.add(table, one, two, low, high)


def add_of_bodies(
    pairs: Pairs,
    table: Table,
    active: vec[i64],
    boxes: vec[float],
    ignored: Ignored,
    low: float,
    high: float,
) -> None:
    """Add the pairs of rows of which the boxes meet, where bodies have many pieces.

    The boxes of bodies are compared first: pieces of one body, of which most boxes meet, are not
    compared at all, and those of two bodies only if they last at one time.
    """
    groups = Groups(table, active)
    met = strips(groups.around(boxes), 0)
    k: i64 = 0
    while k < len(met):
        p, q = met[k], met[k + 1]
        k += 2
        if not ignored.has(groups.body[p], groups.body[q]):
            groups.add_pairs(pairs, p, q, boxes, low, high)


class Groups:
    """Rows by their bodies, those of a body in the order of time.

    Args:
        table: the rows.
        active: the numbers of some rows.

    Attributes:
        body: the body of each group.
    """

    def __init__(self, table: Table, active: vec[i64]) -> None:
        self._table = table
        self._active = active
        self._steps: i64 = 0
        starts = vec[float]()
        k: i64 = 0
        while k < len(active):
            starts = append(starts, table.start[active[k]])
            k += 1
        members: dict[int, list[int]] = {}
        order = sorted_by(starts)
        k = 0
        while k < len(order):
            members.setdefault(int(table.body[active[order[k]]]), []).append(int(order[k]))
            k += 1
        self.body = vec[i64]()
        self._first = vec[i64]()
        self._members = vec[i64]()  # numbers in `active`
        for body, some in members.items():
            self.body = append(self.body, i64(body))
            self._first = append(self._first, i64(len(self._members)))
            for member in some:
                self._members = append(self._members, i64(member))
        self._first = append(self._first, i64(len(self._members)))

    def around(self, boxes: vec[float]) -> vec[float]:
        """Return a box of each group, given those of the active rows."""
        found = vec[float]()
        p: i64 = 0
        while p < len(self.body):
            left, right, bottom, top = INFINITY, -INFINITY, INFINITY, -INFINITY
            m = self._first[p]
            while m < self._first[p + 1]:
                at = BOX * self._members[m]
                left, right = min(left, boxes[at]), max(right, boxes[at + 1])
                bottom, top = min(bottom, boxes[at + 2]), max(top, boxes[at + 3])
                m += 1
            found = append_box(found, left, right, bottom, top)
            p += 1
        return found

    def add_pairs(
        self, pairs: Pairs, p: i64, q: i64, boxes: vec[float], low: float, high: float
    ) -> None:
        """Add the pairs of rows of two groups that last at one time, by their doubles.

        Args:
            pairs: takes them.
            p: a group.
            q: another group.
            boxes: those of the active rows, which have to meet; none if they do not matter.
            low: the start.
            high: the end.
        """
        table, members = self._table, self._members
        first = self._first[q]  # of the rows that have not ended
        k = self._first[p]
        while k < self._first[p + 1]:
            self._steps += 1
            if self._steps % ROWS_A_LOOK == 0:
                check_budget()
            one = self._active[members[k]]
            while (
                first < self._first[q + 1]
                and table.end[self._active[members[first]]] < table.start[one]
            ):
                first += 1
            m = first
            while m < self._first[q + 1]:
                two = self._active[members[m]]
                if table.start[two] > table.end[one]:
                    break
                if len(boxes) == 0 or boxes_meet(boxes, members[k], members[m]):
                    pairs.add(table, one, two, low, high)
                m += 1
            k += 1


def boxes_meet(boxes: vec[float], k: i64, m: i64) -> bool:
    """Return True if two boxes have a point in common."""
    a, b = BOX * k, BOX * m
    if boxes[a] > boxes[b + 1] or boxes[b] > boxes[a + 1]:
        return False
    return boxes[a + 2] <= boxes[b + 3] and boxes[b + 2] <= boxes[a + 3]


def add_itself(pairs: Pairs, table: Table, row: i64, low: float, high: float) -> None:
    """Add a row and itself, if its vertices may touch its own edges in [low, high]."""
    if table.deforms[row] == 1:
        pairs.add(table, row, row, low, high)


def pairs_of_bodies(
    table: Table, bodies: Sequence[tuple[int, int]], low: float, high: float
) -> Pairs:
    """Return the pairs of rows of given pairs of different bodies that may touch in [low, high]."""
    groups = Groups(table, rows_of_some(table, {i for pair in bodies for i in pair}))
    number = {int(body): p for p, body in enumerate(groups.body)}
    pairs, no_boxes = Pairs(), vec[float]()
    for i, j in bodies:
        check_budget()
        groups.add_pairs(pairs, i64(number[i]), i64(number[j]), no_boxes, low, high)
    return pairs


def rows_of_some(table: Table, bodies: set[int]) -> vec[i64]:
    """Return the rows of some bodies."""
    found = vec[i64]()
    k: i64 = 0
    while k < len(table.body):
        if int(table.body[k]) in bodies:
            found = append(found, k)
        k += 1
    return found


def boxes_during(table: Table, low: float, high: float) -> vec[float]:
    """Return the boxes of all rows while they last in [low, high], `BOX` numbers each."""
    boxes, still = vec[float](), Drift()
    k: i64 = 0
    while k < len(table.body):
        first, last = max(low, table.start[k]), min(high, table.end[k])
        left, right, bottom, top = of_piece(table, k, first, last, still)
        boxes = append_box(boxes, left, right, bottom, top)
        k += 1
    return boxes


def pairs_with_others(table: Table, boxes: vec[float], low: float, high: float) -> Pairs:
    """Return the pairs of one of the last rows, and of one of the first or itself, that may touch.

    Args:
        table: the rows; the last ones are of another body than the first ones.
        boxes: the boxes in [low, high] of the first rows, see `boxes_during`.
        low: the start.
        high: the end.
    """
    pairs, still = Pairs(), Drift()
    others: i64 = len(boxes) // BOX
    row = others
    while row < len(table.body):
        check_budget()
        first, last = max(low, table.start[row]), min(high, table.end[row])
        left, right, bottom, top = of_piece(table, row, first, last, still)
        k: i64 = 0
        while k < others:
            at = BOX * k
            is_beside = boxes[at] > right or boxes[at + 1] < left
            is_above = boxes[at + 2] > top or boxes[at + 3] < bottom
            if not is_beside and not is_above:
                pairs.add(table, row, k, low, high)
            k += 1
        add_itself(pairs, table, row, low, high)
        row += 1
    return pairs


def near_at_start(
    table: Table, pairs: Pairs, low: float, high: float, *, exact_only: bool = False
) -> list[tuple[int, int]]:
    """Return the pairs i < j of bodies that may touch at a start between two doubles, sorted.

    Args:
        table: the rows.
        pairs: all pairs of rows that may touch at the start, and others.
        low: at most the start.
        high: at least the start.
        exact_only: whether all pairs are returned whose boxes meet.
    """
    is_at_double = low == high and not exact_only
    found: set[tuple[int, int]] = set()
    starts = Starts(table, low)
    k: i64 = 0
    while k < len(pairs.one):
        one, two = pairs.one[k], pairs.two[k]
        if k % STARTS_A_LOOK == 0:
            check_budget()
        if one == two:  # a body does not touch itself at the start
            k += 1
            continue
        if pairs.enter[k] <= high and not (is_at_double and starts.are_disjoint(one, two)):
            i, j = table.body[one], table.body[two]
            found.add((int(min(i, j)), int(max(i, j))))
        k += 1
    return sorted(found)


class Scan:
    """The candidates of some pairs of rows, pair by pair in the order of `Pairs.enter`.

    Args:
        table: the rows.
        pairs: the pairs.
        after: a double at or after the start: a pair that is found to touch later certainly
            begins to touch after the start.
        end: the end of the slab.
        exact_only: whether all that boxes do not exclude is left to exact arithmetic.

    Attributes:
        found: the candidates so far.
        low: no pair that is still to be compared touches before it.
        is_done: whether all pairs that matter have been compared.
    """

    def __init__(
        self, table: Table, pairs: Pairs, after: float, end: float, *, exact_only: bool = False
    ) -> None:
        self._table = table
        self._pairs = pairs
        self._after = after
        self._end = end
        self._order = sorted_by(pairs.enter)
        self._next: i64 = 0
        self._exact_only = exact_only
        self._filter = Filter(table, exact_only=exact_only, look=check_budget)
        self.found = Candidates(end)
        self.low = -INFINITY
        self.is_done = False

    def free_until(self) -> float:
        """Return a double before which no two rows touch, as far as it is known now."""
        low, lows = min(self.low, self._end), self.found.low
        k: i64 = 0
        while k < len(lows):
            low = min(low, lows[k])
            k += 1
        return low

    def compare(self, many: int) -> None:
        """Compare pairs until so many pairs of features, or more, have been compared."""
        table, pairs, found = self._table, self._pairs, self.found
        enough: i64 = found.compared + i64(many)
        while self._next < len(self._order):
            k = self._order[self._next]
            self.low = pairs.enter[k]
            if self.low > found.limit:
                break
            if found.compared >= enough:
                return
            self._next += 1
            found.pairs += 1
            one, two = pairs.one[k], pairs.two[k]
            if move_together(table, one, two):
                continue
            leave = min(pairs.leave[k], found.limit)
            if are_straight(table, one, two) and not self._exact_only:
                if not are_separated(table, one, two, self.low, leave):
                    straight.collect(table, one, two, self.low, leave, self._after, found)
            else:
                self._filter.collect(one, two, self.low, leave, self._after, found)
        self.low = INFINITY
        self.found = self._filter.sharpen(found, self._after)
        self.is_done = True
