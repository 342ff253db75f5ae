"""How many decisions the float filter settled, and how many needed exact arithmetic.

The one piece of process-wide state: written where decisions are made, read by the
statistics of a run (as differences), never by logic.
"""

from __future__ import annotations

from typing import final

__all__ = ["Counters", "counters"]


@final
class Counters:
    """Running totals.

    Attributes:
        filtered: signs and comparisons of times settled by floats with a proven bound.
        exact: those that needed exact arithmetic.
    """

    def __init__(self) -> None:
        self.filtered: int = 0
        self.exact: int = 0


counters = Counters()
