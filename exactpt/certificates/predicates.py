"""What tilings ask of vertices at one time.

A class, not a protocol: compiled code then calls it without the interpreter.
"""

from __future__ import annotations

from abc import abstractmethod

__all__ = ["Predicates"]


class Predicates:
    """Signs at, or just after, or just before, some time."""

    @abstractmethod
    def sign(self, a: int, b: int, c: int) -> int:
        """1 if a, b, c turn left, -1 if right, 0 if collinear for ever (counts as right)."""

    @abstractmethod
    def left_of(self, a: int, b: int) -> bool:
        """Whether a comes before b from left to right."""

    @abstractmethod
    def turn(self, a: int, b: int, c: int, d: int) -> int:
        """1 if the direction from a to b turns left to that from c to d, -1 if right."""

    @abstractmethod
    def nearer(self, p: int, a: int, b: int) -> bool:
        """Whether a is nearer to p than b is, for a and b in one direction from p."""
