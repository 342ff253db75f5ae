"""How many decisions the float filter settled, and how many needed exact arithmetic, and why.

The one piece of process-wide state: written where decisions are made, read by the
statistics of a run (as differences), never by logic.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Final, NamedTuple, Self, final

__all__ = ["Counters", "Counts", "counters"]


class Counts(NamedTuple):
    """How many decisions were made in a while.

    Attributes:
        exact: those that needed exact arithmetic.
        filtered: those settled by floats with a proven bound.
        reasons: the exact ones, by what was decided and why floats did not do.
    """

    exact: int
    filtered: int
    reasons: Mapping[str, int]

    def since(self, earlier: Self) -> Counts:
        """What has been counted after other counts."""
        reasons = Counter(self.reasons)
        reasons.subtract(earlier.reasons)
        return Counts(
            self.exact - earlier.exact,
            self.filtered - earlier.filtered,
            {reason: n for reason, n in sorted(reasons.items()) if n},
        )


@final
class Counters:
    """Running totals.

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
        return Counts(self.exact, self.filtered, dict(self.reasons))


counters: Final = Counters()
