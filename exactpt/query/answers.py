"""The values that queries return."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias, final

from exactpt.brief import counted, record_in_brief
from exactpt.kernel.numbers import QQ, fraction, place
from exactpt.kernel.radicals import nearest_root_sum

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from exactpt.geometry.predicates import Point

PLACES: Final = ("tile", "diagonal", "outside", "body", "edge", "vertex")
"""The kinds of a `Place`; `Located.kind` has indices of them."""

VertexName: TypeAlias = tuple[str, int]
"""Name of a body and number of one of its vertices, as in the scene."""


@final
@dataclass(frozen=True, slots=True)
class Place:
    """The location of a point.

    Attributes:
        kind: "tile" (interior of a tile of the free space), "diagonal" (interior of a
            diagonal), "outside" (outside the convex hull of all bodies), "body" (interior of a
            body), "edge" (interior of an edge of a body), or "vertex" (of a body).
        body: name of the body that contains the point; None in free space.
        vertex: number of the vertex, for "vertex".
        edge: number of the edge, for "edge": from vertex ``edge`` to the next.
        tile: index of the face in `Snapshot.faces`, for "tile".
        diagonal: the two ends of the diagonal, for "diagonal".
        crossed: number of edges and vertices passed by the walk to the point.
    """

    kind: str
    body: str | None = None
    vertex: int | None = None
    edge: int | None = None
    tile: int | None = None
    diagonal: tuple[VertexName, VertexName] | None = None
    crossed: int = 0

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def is_free(self) -> bool:
        """True if no (closed) body contains the point."""
        return self.body is None


class Located(NamedTuple):
    """The locations of n points, in arrays of shape (n,).

    Attributes:
        kind: an index of `PLACES`.
        owner: for "tile", the index of the face in `Snapshot.faces`; for "body", "edge" and
            "vertex", the number of the body in the order of the scene; otherwise -1.
        feature: for "edge" and "vertex", its number in the body; otherwise -1.
    """

    kind: NDArray[np.int8]
    owner: NDArray[np.int64]
    feature: NDArray[np.int64]

    def __repr__(self) -> str:
        return f"<Located: {counted(len(self.kind), 'point')}>"


class _Later:
    """The values `point` and `at` of a hit are computed when one is first read."""

    __slots__ = ("_source",)

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> object:
            if name not in {"point", "at"}:
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            point, at = self._source()
            object.__setattr__(self, "point", place(point))
            object.__setattr__(self, "at", fraction(at))
            return getattr(self, name)


@final
@dataclass(frozen=True, slots=True)
class Hit(_Later):
    """The first point of a ray that belongs to a body.

    Attributes:
        body: name of the body.
        vertex: number of the vertex that is hit; None if no vertex is.
        edge: number of the edge whose interior is hit; None for a vertex. If both are None,
            the ray starts in the interior of the body.
        point: the exact point.
        at: its parameter: the point is origin + at * direction.
        crossed: number of diagonals that the ray has crossed before.
    """

    body: str
    vertex: int | None
    edge: int | None
    point: tuple[Fraction, Fraction]
    at: Fraction
    crossed: int

    def __repr__(self) -> str:
        return record_in_brief(self)


def hit_later(
    body: str,
    vertex: int | None,
    edge: int | None,
    crossed: int,
    source: Callable[[], tuple[Point, QQ]],
) -> Hit:
    """Return a hit whose point and parameter come from a call, when one of them is first read."""
    hit, put = object.__new__(Hit), object.__setattr__
    put(hit, "body", body)
    put(hit, "vertex", vertex)
    put(hit, "edge", edge)
    put(hit, "crossed", crossed)
    put(hit, "_source", source)
    return hit


@final
@dataclass(frozen=True, slots=True)
class ShortestPath:
    """A shortest path: of its homotopy class, or of all.

    Attributes:
        points: the start, the bends in order, and the goal; exact.
        bends: the vertex at each bend.
        crossed: number of diagonals crossed: by the sleeve of tiles, or by the legs of a path
            that is the shortest of all.
    """

    points: tuple[tuple[Fraction, Fraction], ...]
    bends: tuple[VertexName, ...]
    crossed: int

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def length(self) -> float:
        """The double nearest to the Euclidean length."""
        return nearest_root_sum(
            (QQ(c) - QQ(a)) ** 2 + (QQ(d) - QQ(b)) ** 2 for (a, b), (c, d) in pairwise(self.points)
        )
