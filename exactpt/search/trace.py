"""What a search did, line by line on standard error: with EXACTPT_TRACE=1 in the environment.

For each slab of time, and for each candidate in it: when the boxes of the two rows meet, what the
filter says, what exact arithmetic decides. To follow an answer, or to see why it takes long.
"""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, final

from exactpt.filters.candidates import Candidate
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, nearest_float, shorten
from exactpt.motion.track import Incidence
from exactpt.pair.straight import Begin

if TYPE_CHECKING:
    from exactpt.search.reading import Rows
    from exactpt.search.sweep_search import Slab


_IS_ASKED_FOR: Final = os.environ.get("EXACTPT_TRACE") == "1"
"""Read once: a search of two bodies takes less time than a hundred looks at the environment."""


@final
class Trace:
    """Writes what a search does.

    Args:
        rows: the rows of the bodies.
    """

    def __init__(self, rows: Rows) -> None:
        self._names = [shorten(body.name) for body in rows.bodies]
        self._table = rows.table
        self._units = rows.units
        self._times: dict[tuple[int, int], tuple[float, float]] = {}

    def slab(self, slab: Slab) -> None:
        """Write about the start of a slab."""
        pairs = slab.pairs
        self._times = {
            rows: (pairs.enter[k], pairs.leave[k]) for k, rows in enumerate(pairs.rows())
        }
        low, high = self._time(slab.low), self._time(slab.high)
        self._write(f"slab [{low}, {high}]: {pairs.count()} pairs of rows are near")

    def filtered(self, candidates: Sequence[Candidate], limit: float, end: float) -> None:
        """Write what the filters have left of a slab with an end."""
        known = f"; a contact is certain by {self._time(limit)}" if limit < end else ""
        self._write(f"  filters leave {len(candidates)} candidates{known}")

    def candidate(self, candidate: Candidate, begins: Sequence[Begin]) -> None:
        """Write about a candidate that has been decided.

        Args:
            candidate: the candidate.
            begins: when its incidences begin; none if it does not touch.
        """
        one, other = candidate.one, candidate.other
        feature = f"edge {candidate.edge}"
        if candidate.edge < 0:
            feature = f"vertex {candidate.other_vertex}"
        enter, leave = self._times.get((one, other)) or self._times[other, one]
        self._write(
            f"  vertex {candidate.vertex} of {self._name(one)}, {feature} of {self._name(other)}: "
            f"boxes meet in [{self._time(enter)}, {self._time(leave)}], "
            f"the filter says [{self._time(candidate.low)}, {self._time(candidate.high)}], "
            f"exact arithmetic: {', '.join(_said(begin.time) for begin in begins) or _said(None)}"
        )

    def in_doubles(self, time: QQ | None, incidences: Sequence[Incidence]) -> None:
        """Write that doubles without rounding have decided all candidates."""
        self._write(f"  doubles without rounding: {_said(time)}")
        for incidence in incidences:
            self._write(f"    {incidence}")

    def _time(self, time: float) -> str:
        """Return a time of the rows as one of the scene."""
        units = self._units
        if units.is_identity or not math.isfinite(time):
            return repr(time)
        return repr(nearest_float(units.exact_time(time)))

    def _name(self, row: int) -> str:
        return self._names[self._table.body[row]]

    def _write(self, line: str) -> None:
        sys.stderr.write(f"exactpt: {line}\n")


def _said(time: QQ | AlgebraicNumber | None) -> str:
    """Return an exact decision in words."""
    return "no contact" if time is None else f"contact at {time}"


def trace_of(rows: Rows) -> Trace | None:
    """Return what writes about a search; None unless the environment has asked for it."""
    return Trace(rows) if _IS_ASKED_FOR else None
