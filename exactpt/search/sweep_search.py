"""The first contact by one sweep over time: rows, slabs, candidates, exact decisions.

    bodies -> rows                          exactpt.search.reading
    slab by slab:
        rows -> pairs of rows               exactpt.search.sweep
        pairs of rows -> candidates         exactpt.filters
        candidates -> the first contact     exactpt.search.decide

The first slab is as long as rows take, on average, to come to their neighbours, and each is twice
as long as the one before. One with too many pairs is cut to a quarter, unless most of them are
near each other all the time. The length changes no answer: at its end a slab leaves pairs that
certainly have not touched.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import chain
from typing import Final, NamedTuple, Protocol, final

from exactpt.cached_property import cached_property
from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget, deadline_in, searching
from exactpt.kernel.numbers import QQ, fraction
from exactpt.pair.contact import Contact, contact_of
from exactpt.pair.straight import LinearContact
from exactpt.scene.scene import Scene
from exactpt.search.decide import Decider, Squares
from exactpt.search.query import Selection
from exactpt.search.reading import Rows
from exactpt.search.sweep import (
    Ignored,
    Pairs,
    Scan,
    flow_of,
    near_at_start,
    pairs_during,
    pairs_of_bodies,
)
from exactpt.search.trace import trace_of

FEW: Final = 4
"""Number of bodies up to which the whole time span is one slab at first."""
SHORTEST: Final = 2.0**-40
"""Part of the time span below which no slab is cut."""
SHORT: Final = 256.0
"""Number of first slabs in the time span of a small scene, if a body turns, curves or deforms."""
SMALL: Final = 16
"""Number of bodies of a small scene. In a crowd slabs cost more than what is after a contact."""
PIECES: Final = 8
"""Number of pieces that a body gets at a time: a slab is no longer than these last."""
MANY: Final = 1 << 10
"""Number of pairs of features that are compared between two looks at the budget."""


class Slab(NamedTuple):
    """A window of time, and the pairs of rows that may touch in it.

    Attributes:
        low, high: doubles, the window.
        pairs: the pairs.
    """

    low: float
    high: float
    pairs: Pairs


class PairsDuring(Protocol):
    """Finds pairs of rows."""

    def during(self, low: float, high: float) -> Pairs:
        """Return all pairs of rows that count and may touch in [low, high]."""

    def first_length(self, span: float) -> float:
        """Return a length of the first slab, at most that of the time span."""


@final
class AllPairs:
    """The pairs of rows of all pairs of bodies that count.

    Args:
        rows: the rows.
        selection: the pairs that count, none of them by its name; by default all.
        apart: pairs i < j of bodies that do not count either.
        with_themselves: whether bodies that deform count with themselves.
    """

    def __init__(
        self,
        rows: Rows,
        selection: Selection | None = None,
        apart: Iterable[tuple[int, int]] = (),
        *,
        with_themselves: bool = True,
    ) -> None:
        self._with_themselves = with_themselves
        self._table = rows.table
        self._count = len(rows.bodies)
        groups = None if selection is None else selection.groups
        each = [sorted(groups.get(i, ())) for i in range(self._count)] if groups else []
        self._ignored = Ignored(each, apart)
        self._rows = rows
        self._flow = flow_of(rows.table, rows.span.low)

    def during(self, low: float, high: float) -> Pairs:
        """See `PairsDuring`."""
        if not self._rows.are_straight:
            self._flow = flow_of(self._table, low)  # it changes with time
        themselves = self._with_themselves
        return pairs_during(
            self._table, self._ignored, low, high, self._flow.drift, with_themselves=themselves
        )

    def first_length(self, span: float) -> float:
        """See `PairsDuring`: the time in which neighbours meet, unless the bodies are few."""
        stride = self._flow.stride
        if self._count > FEW and 0.0 < stride < math.inf:
            return min(span, 0.5 * stride)  # both of two neighbours move
        return span


@final
class NamedPairs:
    """The pairs of rows of some pairs of different bodies.

    Args:
        rows: the rows.
        bodies: the pairs.
    """

    def __init__(self, rows: Rows, bodies: Sequence[tuple[int, int]]) -> None:
        self._table = rows.table
        self._bodies = bodies

    def during(self, low: float, high: float) -> Pairs:
        """See `PairsDuring`."""
        return pairs_of_bodies(self._table, self._bodies, low, high)

    def first_length(self, span: float) -> float:
        """See `PairsDuring`: all at once."""
        return span


def pairs_that_count(
    rows: Rows,
    selection: Selection,
    apart: Iterable[tuple[int, int]] = (),
    *,
    with_themselves: bool = True,
) -> PairsDuring:
    """Return what finds all pairs of rows that count.

    Args:
        rows: the rows.
        selection: the pairs of bodies that count.
        apart: pairs i < j of bodies that do not count either.
        with_themselves: whether bodies that deform count with themselves, unless pairs are named.
    """
    if selection.named is None:
        return AllPairs(rows, selection, apart, with_themselves=with_themselves)
    others = set(apart)
    return NamedPairs(rows, [pair for pair in selection.named if pair not in others])


@final
class Slabs:
    """Windows of time that cover the span, in order, with the pairs of rows that may touch.

    Args:
        rows: the rows; those that are waiting get their pieces.
        pairs: finds pairs of rows.
        longest: the length of a slab is at most this.
    """

    def __init__(self, rows: Rows, pairs: PairsDuring, longest: float = math.inf) -> None:
        self._rows = rows
        self._pairs = pairs
        self._longest = longest

    def __iter__(self) -> Iterator[Slab]:
        span = self._rows.span
        low, length = span.low, self._first_length()
        while True:
            slab = self._with_pieces(self._with_few_pairs(low, min(length, self._longest)))
            yield slab
            if slab.high >= span.high:
                return
            low, length = slab.high, 2.0 * (slab.high - slab.low)

    def _first_length(self) -> float:
        """Return the length of the first slab."""
        whole = self._rows.span.high - self._rows.span.low
        length = self._pairs.first_length(whole)
        is_small = len(self._rows.bodies) <= SMALL
        if length < whole or self._rows.are_straight or not is_small:
            return length
        return whole / SHORT  # what comes after a contact costs nothing

    def _with_few_pairs(self, low: float, length: float) -> Slab:
        """Return a slab of this length, or of a part of it: with not too many pairs.

        Where most pairs are near each other all the time, a shorter slab has as many.
        """
        span = self._rows.span
        shortest = (span.high - span.low) * SHORTEST
        many = 4 * len(self._rows.bodies) + 64
        slab = self._slab(low, self._end(low, length))
        while slab.pairs.count() > many and length > shortest:
            length /= 4.0
            shorter = self._slab(low, self._end(low, length))
            if shorter.pairs.count() * 2 > slab.pairs.count():
                break
            slab = shorter
        return slab

    def _with_pieces(self, slab: Slab) -> Slab:
        """Return a slab in which no row waits: pieces are made, and the slab ends with these."""
        pieces = PIECES
        while slab.pairs.waiting:
            low, high = slab.low, slab.high
            made = math.inf
            for row, (enter, leave) in sorted(slab.pairs.waiting.items()):
                made = min(made, self._rows.make_pieces(row, enter, min(leave, high), pieces))
            if made < high:
                high = max(made, math.nextafter(low, math.inf))
            slab = self._slab(low, high)
            pieces *= 2  # many may be shorter than the distance of two doubles
        return slab

    def _end(self, low: float, length: float) -> float:
        """Return the end of a slab: later than its start, and not after the time span."""
        end = self._rows.span.high
        if length >= end - low:
            return end
        return min(max(low + length, math.nextafter(low, math.inf)), end)

    def _slab(self, low: float, high: float) -> Slab:
        return Slab(low, high, self._pairs.during(low, high))


@final
class Sweep:
    """The first contact of rows, slab by slab.

    Args:
        rows: the rows.
        slabs: windows of time that cover the span, in order, with the pairs of rows that count.
        squares: when two bodies touch; None if where their distance is the sum of their radii.
        exact_only: whether exact arithmetic decides all that boxes do not exclude.
        deadline: the time on the clock after which the search ends; None for no limit.

    Attributes:
        slabs, pairs, compared: numbers of slabs, of pairs of rows and of features so far.
        starts: number of the pairs of bodies that may touch at the start.
    """

    def __init__(
        self,
        rows: Rows,
        slabs: Iterable[Slab],
        squares: Squares | None = None,
        *,
        exact_only: bool = False,
        deadline: float | None = None,
    ) -> None:
        self._exact_only = exact_only
        self._rows = rows
        self._slabs = iter(slabs)
        self._trace = trace_of(rows)
        self._decider = Decider(rows, squares, self._trace, exact_only=exact_only)
        self._deadline = deadline
        self._low: float | None = None
        self._in_progress: Scan | Decider | None = None
        self.slabs = self.pairs = self.compared = self.starts = 0

    @cached_property
    def _first(self) -> Slab:
        """The first slab, found when the search begins: its budget holds for that, too."""
        return next(self._slabs)

    @property
    def exact(self) -> int:
        """Number of the candidates that rationals or polynomials have decided."""
        return self._decider.exact

    def near_at_start(self) -> list[tuple[int, int]]:
        """Return the pairs i < j of bodies that may touch at the start, sorted."""
        span = self._rows.span
        table, pairs = self._rows.table, self._first.pairs
        near = near_at_start(table, pairs, span.low, span.after, exact_only=self._exact_only)
        self.starts = len(near)
        return near

    def first_after_start(self) -> LinearContact | None:
        """Return the first contact of bodies that do not touch at the start.

        Raises:
            BudgetExceeded: if the deadline, or the time or memory of this thread, is exceeded.
        """
        if self._low is not None:
            raise RuntimeError("a search runs once: what it has passed is not kept")
        span, best = self._rows.span, self._decider.best
        self._low = span.low
        for slab in chain([self._first], self._slabs):
            self._search(slab)
            if best.time is not None:
                return LinearContact(best.time, sorted(set(best.found)))  # of two vertices once
            self._low, self._in_progress = slab.high, None
        self._low = math.inf
        return None

    def _search(self, slab: Slab) -> None:
        """Find the first contact in a slab."""
        if self._trace is not None:
            self._trace.slab(slab)
        rows = self._rows
        scan = self._in_progress = Scan(
            rows.table, slab.pairs, rows.span.after, slab.high, exact_only=self._exact_only
        )
        while not scan.is_done:
            check_budget()
            if self._deadline is not None and clock.monotonic() > self._deadline:
                raise BudgetExceeded("time limit exceeded", None)
            scan.compare(MANY)
        self.slabs += 1
        self.pairs += scan.found.pairs
        self.compared += scan.found.compared
        self._low, self._in_progress = scan.free_until(), self._decider
        self._decider.decide(scan.found, slab.high)

    @property
    def free_until(self) -> QQ | None:
        """A time up to which bodies certainly do not touch; None before they are apart at first.

        What is passed has no contact, nor has what is before all that is still to be looked at.
        """
        if self._low is None:
            return None
        low = self._low
        if self._in_progress is not None:
            low = max(low, self._in_progress.free_until())
        span, before = self._rows.span, math.nextafter(low, -math.inf)
        if before >= span.high:
            return span.end
        if not math.isfinite(before):
            return span.start
        return max(span.start, self._rows.units.exact_time(before))


@final
class SweepSearch:
    """A search for the first contact of the bodies of a scene.

    Args:
        scene: the bodies, their motions and the time span.
        rows: the rows of the bodies.
        pairs: finds the pairs of rows that count.
        exact_only: whether exact arithmetic decides all that boxes do not exclude.
        max_seconds: time limit, in seconds; None for no limit.

    Attributes:
        name: the name of the tiling: None.
    """

    name = None

    def __init__(
        self,
        scene: Scene,
        rows: Rows,
        pairs: PairsDuring,
        *,
        exact_only: bool = False,
        max_seconds: float | None = None,
    ) -> None:
        self._scene = scene
        self._deadline = deadline_in(max_seconds)
        slabs = Slabs(rows, pairs)
        self._sweep = Sweep(rows, slabs, exact_only=exact_only, deadline=self._deadline)

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the search so far, see docs/format.md."""
        return stats_of(self._scene, self._sweep)

    def contact_free_until(self) -> Fraction | None:
        """See `exactpt.search.first.Search`."""
        free = self._sweep.free_until
        return None if free is None else fraction(free)

    def run_to_contact(self) -> Contact | None:
        """Return the first contact in the closed time span of the scene; None if there is none.

        Raises:
            BudgetExceeded: if the time or memory of this thread, or of the search, is used up.
        """
        with searching(self._deadline, self.contact_free_until):
            near = self._sweep.near_at_start()
            initial = contact_at_start(self._scene, near) if near else None
            if initial is not None:
                return initial
            found = self._sweep.first_after_start()
            return None if found is None else contact_of(self._scene, found.number, found.touches)


def stats_of(scene: Scene, sweep: Sweep) -> dict[str, object]:
    """Return the counts of a search, see docs/format.md."""
    return {
        "bodies": len(scene.bodies),
        "vertices": scene.vertex_count,
        "events": 0,
        "slabs": sweep.slabs,
        "starts": sweep.starts,
        "pairs": sweep.pairs,
        "certificates": sweep.compared,
        "skipped": 0,
        "exact": sweep.exact,
        "filtered": sweep.compared - sweep.exact,
    }


def contact_at_start(scene: Scene, near: Sequence[tuple[int, int]]) -> Contact | None:
    """Return the contact at the start, of the pairs of bodies that may touch there."""
    from exactpt.pair.start import initial_touches  # it imports numpy

    touches, pairs = initial_touches(scene, near)
    if not pairs:
        return None
    return contact_of(scene, AlgebraicNumber(scene.exact_start), touches, pairs)
