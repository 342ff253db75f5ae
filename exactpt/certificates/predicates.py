"""The interface of predicates at a time, or one-sided ones (t-, t+), that tilings use.

A class, not a protocol: compiled code then calls it without the interpreter.
"""

from __future__ import annotations

from abc import abstractmethod

from exactpt.indices import VertexId


class Predicates:
    """Signs at a time, just after it, or just before it."""

    @abstractmethod
    def orientation(self, a: VertexId, b: VertexId, c: VertexId) -> int:
        """1 if a, b, c turn left, -1 if they turn right, 0 if always collinear (counts as -1)."""

    @abstractmethod
    def left_of(self, a: VertexId, b: VertexId) -> bool:
        """Return True if a is left of b."""

    @abstractmethod
    def cross_sign(self, a: VertexId, b: VertexId, c: VertexId, d: VertexId) -> int:
        """1 if the direction from a to b turns left to that from c to d, -1 if right."""

    @abstractmethod
    def nearer(self, p: VertexId, a: VertexId, b: VertexId) -> bool:
        """Return True if a is nearer to p than b is, for a and b in the same direction from p."""
