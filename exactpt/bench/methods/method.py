"""What every way to find a first contact is: a preparation, and then a question."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias, final

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.scene.scene import Scene

__all__ = ["Answer", "Method", "UnsuitableScene", "error_of"]

Answer: TypeAlias = "AlgebraicNumber | float | None"
"""The time of the first contact, as far as it is known; None: there is none."""


class UnsuitableScene(Exception):  # noqa: N818 - an outcome: the method is for other scenes
    """A method cannot be asked about a scene; the message says why."""


@final
@dataclass(frozen=True, slots=True)
class Method:
    """A way to find a first contact.

    Attributes:
        name: what finds it.
        setting: how it is tuned.
        prepare: turns a scene into the method's own input and returns the question, whose
            time is taken; raises `UnsuitableScene`.
        package: what must be installed.
    """

    name: str
    setting: str
    prepare: Callable[[Scene], Callable[[], Answer]]
    package: str | None = None


def error_of(answer: Answer, truth: AlgebraicNumber) -> float:
    """How far an answer is from the truth; 0 if it is equal, or the nearest double."""
    if answer is None:
        raise ValueError("no time was answered")
    if isinstance(answer, AlgebraicNumber):
        if answer.compare(truth) == 0:
            return 0.0
        return max(abs(float(answer) - float(truth)), 5e-324)
    return abs(answer - float(truth))
