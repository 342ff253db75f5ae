"""The interface of methods that find a first contact: a preparation, then a question."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias, final

from exactpt import AlgebraicNumber, Scene

__all__ = ["Answer", "Method", "UnsuitableScene", "error_of"]

Answer: TypeAlias = "AlgebraicNumber | float | None"
"""The time of the first contact as the method returns it; None if there is none."""


class UnsuitableScene(Exception):  # noqa: N818 - an outcome: the method is for other scenes
    """The method does not support a scene; the message has the reason."""


@final
@dataclass(frozen=True, slots=True)
class Method:
    """A method that finds a first contact.

    Attributes:
        name: the program.
        setting: its parameters.
        prepare: converts a scene to the method's own input and returns the question, whose time
            is measured; raises `UnsuitableScene`.
        package: the package that must be installed; None if none.
    """

    name: str
    setting: str
    prepare: Callable[[Scene], Callable[[], Answer]]
    package: str | None = None


def error_of(answer: Answer, truth: AlgebraicNumber) -> float:
    """The error of a result; 0 if it is the truth or the double nearest to it."""
    if answer is None:
        raise ValueError("no time was answered")
    if isinstance(answer, AlgebraicNumber):
        if answer.compare(truth) == 0:
            return 0.0
        return max(abs(float(answer) - float(truth)), 5e-324)
    return abs(answer - float(truth))
