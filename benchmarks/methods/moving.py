"""A scene in doubles, as input for programs without exact numbers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from benchmarks.methods.method import UnsuitableScene
from exactpt.kernel.doubles import Floats
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ, nearest_float
from exactpt.scene.scene import Scene

__all__ = ["Floats", "Indices", "Moving", "Shape"]

Indices: TypeAlias = NDArray[np.int32]


@final
class Shape:
    """One body.

    Attributes:
        first, size: number of its first vertex, and number of vertices.
        closed: whether it has an interior.
        deforms: whether its motion is more than a translation.
    """

    __slots__ = ("closed", "deforms", "first", "size")

    def __init__(self, first: int, size: int, *, closed: bool, deforms: bool) -> None:
        self.first = first
        self.size = size
        self.closed = closed
        self.deforms = deforms

    @property
    def range(self) -> slice:
        """The numbers of its vertices, as a slice."""
        return slice(self.first, self.first + self.size)


@final
class Moving:
    """All vertices in polynomial motion, with coefficients rounded to the nearest doubles.

    Attributes:
        shapes: one for each body.
        body: index of the body of each vertex.
        edges: pairs of vertices.
        x, y: coefficients, one row for each vertex, constant term first.
        start, end: the time span.

    Raises:
        UnsuitableScene: if motions are in pieces, or bodies rotate.
    """

    def __init__(self, scene: Scene) -> None:
        self.shapes: list[Shape] = []
        pairs: list[tuple[int, int]] = []
        xs: list[list[float]] = []
        ys: list[list[float]] = []
        for body in scene.bodies:
            if body.exact_breakpoints_between(scene.exact_start, scene.exact_end):
                raise UnsuitableScene("motions in pieces")
            tracks = body.exact_piece_after(scene.exact_start).tracks
            if any(len(track.w) > 1 for track in tracks):
                raise UnsuitableScene("bodies that turn")
            rigid = all(t.motion is not None and t.motion == tracks[0].motion for t in tracks)
            first = len(xs)
            closed = body.has_interior
            self.shapes.append(Shape(first, body.size, closed=closed, deforms=not rigid))
            pairs += [(first + a, first + b) for a, b in body.edges]
            xs += [_doubles(track.x, track.w) for track in tracks]
            ys += [_doubles(track.y, track.w) for track in tracks]
        width = max(map(len, (*xs, *ys)), default=1)
        self.x: Floats = np.array([c + [0.0] * (width - len(c)) for c in xs])
        self.y: Floats = np.array([c + [0.0] * (width - len(c)) for c in ys])
        self.edges: Indices = np.array(pairs, dtype=np.int32).reshape(-1, 2)
        self.body: Indices = np.repeat(
            np.arange(len(self.shapes), dtype=np.int32), [shape.size for shape in self.shapes]
        )
        self.start, self.end = float(scene.exact_start), float(scene.exact_end)

    @property
    def degree(self) -> int:
        """The maximum degree of the motions."""
        return int(self.x.shape[1]) - 1

    def at(self, t: float, vertices: slice | Sequence[int] = slice(None)) -> Floats:
        """The positions at a time, one row for each vertex."""
        positions = np.stack((self.x[vertices, -1], self.y[vertices, -1]), axis=1)
        for i in range(self.degree - 1, -1, -1):
            positions *= t
            positions[:, 0] += self.x[vertices, i]
            positions[:, 1] += self.y[vertices, i]
        return positions


def _doubles(f: IntPoly, w: IntPoly) -> list[float]:
    return [nearest_float(QQ(c, w[0])) for c in f] or [0.0]
