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
from typing import Final, NamedTuple, final

from exactpt.cached_property import cached_property
from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget, deadline_in, searching
from exactpt.kernel.numbers import QQ, fraction, of_double
from exactpt.pair.contact import Contact, contact_of
from exactpt.pair.straight import LinearContact
from exactpt.scene.scene import Scene
from exactpt.search.decide import Decider, Squares
from exactpt.search.query import Selection
from exactpt.search.reading import Rows
from exactpt.search.sweep import (
    Drift,
    Ignored,
    Pairs,
    Scan,
    drift_of,
    near_at_start,
    pairs_during,
    pairs_of_bodies,
)
from exactpt.search.trace import trace_of

FEW: Final = 4
"""Number of bodies up to which the whole time span is one slab at first."""
SHORTEST: Final = 2.0**-40
"""Part of the time span below which no slab is cut."""
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


@final
class SlabsOfAll:
    """The slabs of all pairs of bodies that count.

    Args:
        rows: the rows.
        selection: the pairs that count, none of them by its name; by default all.
    """

    def __init__(self, rows: Rows, selection: Selection | None = None) -> None:
        self._table = rows.table
        self._span = rows.span
        self._count = len(rows.bodies)
        self._ignored = _ignored(selection, self._count)

    def __iter__(self) -> Iterator[Slab]:
        low, end = self._span.low, self._span.high
        drift = drift_of(self._table, low)
        span = end - low
        length = span
        if self._count > FEW and 0.0 < drift.stride < math.inf:
            length = min(span, 0.5 * drift.stride)  # both of two neighbours move
        many = 4 * self._count + 64
        is_last = False
        while not is_last:
            high = end if length >= span else self._later(low, length)
            pairs = self._pairs(low, high, drift)
            while pairs.count() > many and length > span * SHORTEST:
                sooner = self._later(low, length / 4.0)
                fewer = self._pairs(low, sooner, drift)
                if fewer.count() * 2 > pairs.count():
                    break
                length /= 4.0
                high, pairs = sooner, fewer
            is_last = high >= end
            yield Slab(low, high, pairs)
            low, length = high, 2.0 * length

    def _later(self, low: float, length: float) -> float:
        """Return the end of a slab, which is later than its start."""
        return min(max(low + length, math.nextafter(low, math.inf)), self._span.high)

    def _pairs(self, low: float, high: float, drift: Drift) -> Pairs:
        return pairs_during(self._table, self._ignored, low, high, drift)


def _ignored(selection: Selection | None, count: int) -> Ignored:
    """Return the groups of a selection, for compiled code."""
    groups = None if selection is None else selection.groups
    if not groups:
        return Ignored()
    return Ignored([sorted(groups.get(i, ())) for i in range(count)])


def slab_of_bodies(rows: Rows, bodies: Sequence[tuple[int, int]]) -> Slab:
    """Return the whole time span as one slab, with the rows of given pairs of different bodies."""
    low, high = rows.span.low, rows.span.high
    return Slab(low, high, pairs_of_bodies(rows.table, bodies, low, high))


@final
class Sweep:
    """The first contact of rows, slab by slab.

    Args:
        rows: the rows.
        slabs: windows of time that cover the span, in order, with the pairs of rows that count.
        squares: when two bodies touch; None if where their distance is the sum of their radii.
        deadline: the time on the clock after which the search ends; None for no limit.

    Attributes:
        slabs, pairs, compared: numbers of slabs, of pairs of rows and of features so far.
    """

    def __init__(
        self,
        rows: Rows,
        slabs: Iterable[Slab],
        squares: Squares | None = None,
        deadline: float | None = None,
    ) -> None:
        self._rows = rows
        self._slabs = iter(slabs)
        self._trace = trace_of(rows)
        self._decider = Decider(rows, squares, self._trace)
        self._deadline = deadline
        self._low: float | None = None
        self._in_progress: Scan | Decider | None = None
        self.slabs = self.pairs = self.compared = 0

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
        return near_at_start(self._rows.table, self._first.pairs, span.low, span.after)

    def first_after_start(self) -> LinearContact | None:
        """Return the first contact of bodies that do not touch at the start.

        Raises:
            BudgetExceeded: if the deadline, or the time or memory of this thread, is exceeded.
        """
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
        scan = self._in_progress = Scan(rows.table, slab.pairs, rows.span.after, slab.high)
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
        return max(span.start, of_double(before)) if math.isfinite(before) else span.start


@final
class SweepSearch:
    """A search for the first contact of bodies that all move straight.

    Args:
        scene: the bodies, their motions and the time span.
        rows: the rows of the bodies.
        slabs: windows of time that cover the span, in order, with the pairs of rows that count.
        max_seconds: time limit, in seconds; None for no limit.

    Attributes:
        name: the name of the tiling: None.
    """

    name = None
    lacks_boxes = False

    def __init__(
        self, scene: Scene, rows: Rows, slabs: Iterable[Slab], max_seconds: float | None = None
    ) -> None:
        self._scene = scene
        self._deadline = deadline_in(max_seconds)
        self._sweep = Sweep(rows, slabs, deadline=self._deadline)

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the search so far, see docs/format.md."""
        sweep = self._sweep
        return {
            "bodies": len(self._scene.bodies),
            "vertices": self._scene.vertex_count,
            "events": 0,
            "slabs": sweep.slabs,
            "pairs": sweep.pairs,
            "certificates": sweep.compared,
            "skipped": 0,
            "exact": sweep.exact,
            "filtered": sweep.compared - sweep.exact,
        }

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
            initial = self._contact_at_start(near) if near else None
            if initial is not None:
                return initial
            found = self._sweep.first_after_start()
            return None if found is None else contact_of(self._scene, found.number, found.touches)

    def _contact_at_start(self, near: Sequence[tuple[int, int]]) -> Contact | None:
        """Return the contact at the start, of the pairs of bodies that may touch there."""
        from exactpt.pair.start import initial_touches  # it imports numpy

        touches, pairs = initial_touches(self._scene, near)
        if not pairs:
            return None
        return contact_of(self._scene, AlgebraicNumber(self._scene.exact_start), touches, pairs)


def first_of_two(rows: Rows) -> LinearContact | None:
    """Return the first contact after the start of two bodies that do not touch at the start."""
    return Sweep(rows, [slab_of_bodies(rows, [(0, 1)])]).first_after_start()
