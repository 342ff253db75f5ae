"""The exceptions of exactpt: invalid input, broken invariants, exceeded bounds."""

from __future__ import annotations

import math
from fractions import Fraction

__all__ = ["AuditError", "BudgetExceeded", "ExactPTError", "InputError", "TimeRangeError"]


class ExactPTError(Exception):
    """Base class of all exceptions that exactpt raises on purpose."""


class InputError(ExactPTError, ValueError):
    """The input is not acceptable; the message says what is wrong and where."""


class TimeRangeError(InputError):
    """There is no answer at the given time: it is outside the time span or after the contact."""


class AuditError(ExactPTError, AssertionError):
    """An invariant is broken: always a bug in exactpt, never a fault of the input."""


class BudgetExceeded(ExactPTError):  # noqa: N818 - an outcome, named as one
    """A bound on events or seconds was reached.

    ``reached`` is a rational time: there is no contact in the closed interval from the start
    of the scene to it. It is None if nothing has been proved.
    """

    def __init__(self, message: str, reached: Fraction | None) -> None:
        super().__init__(message, reached)  # both are needed to restore a pickled error
        self.reached = reached

    def __str__(self) -> str:
        what = str(self.args[0])
        if self.reached is None:
            return what
        try:
            return f"{what} at t = {float(self.reached)!r}"
        except OverflowError:
            return f"{what} at t = {math.inf if self.reached > 0 else -math.inf!r}"
