"""The errors that exactpt raises on purpose: the caller's, the engine's, and a spent budget."""

from __future__ import annotations

import math
from fractions import Fraction

__all__ = ["AuditError", "BudgetExceeded", "ExactPTError", "InputError"]


class ExactPTError(Exception):
    """Root of every error that exactpt raises on purpose."""


class InputError(ExactPTError, ValueError):
    """What the caller passed in is not acceptable; the message says what and where."""


class AuditError(ExactPTError, AssertionError):
    """An invariant is broken: always a bug in exactpt, never in the input."""


class BudgetExceeded(ExactPTError):  # noqa: N818 - an outcome, named as one
    """A bound on events or seconds was reached; ``reached`` is the time proved free of contact.

    ``reached`` is a rational: no contact happens in the closed interval from the
    start of the scene to it. None: nothing is proved.
    """

    def __init__(self, message: str, reached: Fraction | None) -> None:
        super().__init__(message, reached)  # both: a pickle makes the error from these
        self.reached = reached

    def __str__(self) -> str:
        what = str(self.args[0])
        if self.reached is None:
            return what
        try:
            return f"{what} at t = {float(self.reached)!r}"
        except OverflowError:
            return f"{what} at t = {math.inf if self.reached > 0 else -math.inf!r}"
