"""Counts of the decisions made by float filters and by exact arithmetic, with the reasons.

Each run has its own counters (`exactpt.motion.vertices.Vertices.counters`): written where
decisions are made, read by the statistics of the run, never by logic.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import NamedTuple, final


class Counts(NamedTuple):
    """Numbers of decisions made.

    Attributes:
        exact: those that needed exact arithmetic.
        filtered: those decided by floats with a proven bound.
        reasons: the exact ones, by their subject and the reason of the filter's failure.
    """

    exact: int
    filtered: int
    reasons: Mapping[str, int]


@final
class Counters:
    """Running totals of one run.

    Attributes:
        filtered: signs and comparisons of times decided by floats with a proven bound.
        exact: those that needed exact arithmetic.
        reasons: the exact ones, by ``"what: why"``.
    """

    def __init__(self) -> None:
        self.filtered: int = 0
        self.exact: int = 0
        self.reasons: Counter[str] = Counter()

    def count_exact(self, what: str, why: str) -> None:
        """Count an exact decision."""
        self.exact += 1
        self.reasons[f"{what}: {why}"] += 1

    def now(self) -> Counts:
        """Return the totals so far."""
        return Counts(self.exact, self.filtered, dict(sorted(self.reasons.items())))

    def add(self, counts: Counts) -> None:
        """Add the counts of another part of the same run."""
        self.exact += counts.exact
        self.filtered += counts.filtered
        self.reasons.update(counts.reasons)

    def set(self, counts: Counts) -> None:
        """Replace the totals by those of a saved run, which goes on from them."""
        self.exact, self.filtered = counts.exact, counts.filtered
        self.reasons = Counter(counts.reasons)
