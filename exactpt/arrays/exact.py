"""What the filters leave open, decided in rational arithmetic."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Literal, NamedTuple, TypeAlias, final

from exactpt.geometry.polygon import edges
from exactpt.geometry.predicates import Point
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly, add, multiply, subtract, trimmed
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import common_roots, roots_after
from exactpt.scene.body_arrays import BodyArrays

__all__ = [
    "Incidence",
    "Place",
    "Translating",
    "cleared",
    "earliest",
    "exact",
    "first_zero",
    "incidence",
    "is_zero_at",
]

Path: TypeAlias = "Sequence[tuple[QQ, QQ]]"
"""The coefficients of a moving point in x and in y, constant first."""
Vector: TypeAlias = "tuple[IntPoly, IntPoly]"
Place: TypeAlias = 'Literal["first", "last", "inside"]'
"""Where a vertex is on its edge: at its first or last vertex, or between these."""


class Incidence(NamedTuple):
    """A vertex p and an edge ab: b - a, p - a, and (b - a) x (p - a), up to positive factors.

    ``u`` and ``w`` have one factor in common. A point is an edge of which ``u`` is 0.
    """

    u: Vector
    w: Vector
    turn: IntPoly

    def first_time(self, start: AlgebraicNumber, until: QQ) -> AlgebraicNumber | None:
        """The first time in (start, until] at which p is on ab, and was not just before.

        If the three are collinear for all times, p enters the edge at one of its ends.
        """
        if self.turn:
            roots = roots_after(self.turn, start, until)
            return next((root.time for root in roots if self.place_at(root.time)), None)
        ends = [first_zero(self.w, start, until), first_zero(self.from_last(), start, until)]
        return earliest(ends)

    def place_at(self, t: AlgebraicNumber) -> Place | None:
        """Where p is on the closed edge ab at a time; None if it is not."""
        if t.sign_of(self.turn) != 0:
            return None
        if is_zero_at(self.w, t):
            return "first"
        v = self.from_last()
        if is_zero_at(v, t):
            return "last"
        (ux, uy), (wx, wy), (vx, vy) = self.u, self.w, v
        along = t.sign_of(add(multiply(ux, wx), multiply(uy, wy)))
        back = t.sign_of(add(multiply(ux, vx), multiply(uy, vy)))
        return "inside" if along > 0 > back else None

    def from_last(self) -> Vector:
        """p - b."""
        return subtract(self.w[0], self.u[0]), subtract(self.w[1], self.u[1])


@final
class Translating:
    """A body of some arrays, in rational numbers.

    Attributes:
        edges: the edges as pairs of vertices; a point has one, from itself to itself.
        has_interior: whether it is a polygon.
    """

    __slots__ = ("_motion", "_vertices", "edges", "has_interior")

    def __init__(self, bodies: BodyArrays, k: int) -> None:
        first, last = bodies.offsets[k : k + 2].tolist()
        rows = bodies.vertices[first:last].tolist()
        self._vertices = [(exact(x), exact(y)) for x, y in rows]
        x, y = bodies.coefficients[k].tolist()
        self._motion = [(exact(a), exact(b)) for a, b in zip(x, y, strict=True)]
        closed = bool(bodies.closed[k])
        self.edges = edges(len(rows), closed=closed) or [(0, 0)]
        self.has_interior = closed and len(rows) > 2

    def path(self, vertex: int) -> Path:
        """The path of a vertex."""
        (x, y), (dx, dy) = self._vertices[vertex], self._motion[0]
        return [(x + dx, y + dy), *self._motion[1:]]

    def at(self, t: QQ) -> list[Point]:
        """The positions of the vertices at a time."""
        dx = dy = QQ(0)
        for x, y in reversed(self._motion):
            dx, dy = dx * t + x, dy * t + y
        return [(x + dx, y + dy) for x, y in self._vertices]


def exact(x: float) -> QQ:
    """The value of a double."""
    return QQ(*x.as_integer_ratio())


def incidence(p: Path, a: Path, b: Path) -> Incidence:
    """The incidence of a moving point with the segment of two others."""
    u, w = cleared(_minus(b, a), _minus(p, a))
    turn = subtract(multiply(u[0], w[1]), multiply(u[1], w[0]))
    return Incidence(u, w, turn)


def earliest(times: Iterable[AlgebraicNumber | None]) -> AlgebraicNumber | None:
    """The earliest of some times; None if there is none."""
    best: AlgebraicNumber | None = None
    for time in times:
        if time is not None and (best is None or time.compare(best) < 0):
            best = time
    return best


def is_zero_at(v: Vector, t: AlgebraicNumber) -> bool:
    """Whether a vector vanishes at a time."""
    return t.sign_of(v[0]) == 0 and t.sign_of(v[1]) == 0


def first_zero(v: Vector, start: AlgebraicNumber, until: QQ) -> AlgebraicNumber | None:
    """The first time in (start, until] at which a vector vanishes, unless it always does."""
    return next((root.time for root in common_roots(*v, start, until)), None)


def _minus(p: Path, q: Path) -> list[tuple[QQ, QQ]]:
    """p - q."""
    zero = (QQ(0), QQ(0))
    size = max(len(p), len(q))
    pairs = zip([*p, *[zero] * (size - len(p))], [*q, *[zero] * (size - len(q))], strict=True)
    return [(a[0] - b[0], a[1] - b[1]) for a, b in pairs]


def cleared(*paths: Path) -> list[Vector]:
    """The paths times their common denominator, the largest: all are powers of two."""
    largest = max((c.denominator for f in paths for pair in f for c in pair), default=ZZ(1))
    factor = QQ(ZZ(largest))
    return [
        (
            trimmed([ZZ((x * factor).numerator) for x, _ in f]),
            trimmed([ZZ((y * factor).numerator) for _, y in f]),
        )
        for f in paths
    ]
