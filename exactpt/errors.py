"""The exceptions of exactpt: invalid input, broken invariants, exceeded bounds."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from fractions import Fraction
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from exactpt.scene.scene import Scene


def printable(text: str) -> str:
    """Return the text with every unprintable character escaped: controls, line breaks, overrides.

    Names and paths come from files. Written raw, their control characters would be commands to
    the terminal that shows them, and their directional overrides would reorder its text.
    """
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)


class ExactPTError(Exception):
    """Base class of all exceptions that exactpt raises on purpose."""


class InputError(ExactPTError, ValueError):
    """The input is not acceptable; the message is one printable line: the fault, and its place."""

    def __init__(self, message: str) -> None:
        super().__init__(printable(message))


class TimeRangeError(InputError):
    """The given time is outside the time span or after the contact."""


class UnreachableError(InputError):
    """No path leads from the start to the goal: bodies are in between, whichever way one goes."""


class RoundingError(ExactPTError, ArithmeticError):
    """The floating-point environment of the thread is not the default of IEEE 754.

    Other modes of rounding, and subnormal numbers that are flushed to zero, invalidate the bounds
    of float filters; docs/robustness.md shows how to reset them.
    """


class AuditError(ExactPTError, AssertionError):
    """An invariant is broken: a bug in exactpt, or a forged state of a saved run.

    Attributes:
        scene: the scene in which it broke, with the motions of that time; None if the error did
            not come from a `Simulation` or `first_contact`. To report the bug:
            ``error.scene.save("bug.json")``.
    """

    scene: Scene | None = None


@contextmanager
def carrying(scene: Callable[[], Scene]) -> Iterator[None]:
    """Within the context, an `AuditError` that has no scene yet is given this one."""
    try:
        yield
    except AuditError as error:
        carry(error, scene)
        raise


def carry(error: AuditError, scene: Callable[[], Scene]) -> None:
    """Give an error a scene, if it has none yet."""
    if error.scene is None:
        error.scene = scene()
        error.add_note('To report it, save the scene: error.scene.save("bug.json")')


class BudgetExceeded(ExactPTError):  # noqa: N818 - an outcome, named as one
    """A limit on events, time or memory was reached.

    ``reached`` is a rational time: no contact exists in the closed interval from the start
    of the scene to it. It is None if nothing has been proved. ``answer`` has the first contact, or
    None, if that was found, but no certificate of it.
    """

    answer: tuple[Any] | None = None

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
