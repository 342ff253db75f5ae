"""How many decisions the float filter settled, and how many needed exact arithmetic, and why.

Each run has counters of its own (`exactpt.motion.vertices.Vertices.counters`): written where
decisions are made, read by the statistics of the run, never by logic.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import NamedTuple, final

__all__ = ["Counters", "Counts"]


class Counts(NamedTuple):
    """How many decisions were made.

    Attributes:
        exact: those that needed exact arithmetic.
        filtered: those settled by floats with a proven bound.
        reasons: the exact ones, by what was decided and why floats did not do.
    """

    exact: int
    filtered: int
    reasons: Mapping[str, int]


@final
class Counters:
    """Running totals of one run.

    Attributes:
        filtered: signs and comparisons of times settled by floats with a proven bound.
        exact: those that needed exact arithmetic.
        reasons: the latter, by ``"what: why"``.
    """

    def __init__(self) -> None:
        self.filtered: int = 0
        self.exact: int = 0
        self.reasons: Counter[str] = Counter()

    def count_exact(self, what: str, why: str) -> None:
        """Note an exact decision."""
        self.exact += 1
        self.reasons[f"{what}: {why}"] += 1

    def now(self) -> Counts:
        """The totals so far."""
        return Counts(self.exact, self.filtered, dict(sorted(self.reasons.items())))

    def add(self, counts: Counts) -> None:
        """Count what another part of the same run has counted."""
        self.exact += counts.exact
        self.filtered += counts.filtered
        self.reasons.update(counts.reasons)

    def set(self, counts: Counts) -> None:
        """Go on from what a run had counted when it was saved."""
        self.exact, self.filtered = counts.exact, counts.filtered
        self.reasons = Counter(counts.reasons)
