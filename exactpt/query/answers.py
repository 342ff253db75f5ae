"""What queries answer."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import TypeAlias, final

from exactpt.kernel.numbers import nearest_float

__all__ = ["Hit", "Path", "Place", "VertexName"]

VertexName: TypeAlias = tuple[str, int]
"""A body and the number of a vertex of it, as in the scene."""


@final
@dataclass(frozen=True, slots=True)
class Place:
    """Where a point is.

    Attributes:
        kind: "tile" (inside a tile of free space), "diagonal" (inside a diagonal),
            "outside" (of the convex hull of all bodies), "body" (inside a body), "edge"
            (inside an edge of a body), or "vertex" (of a body).
        body: on or in which body; None in free space.
        vertex: which vertex of it.
        edge: which edge of it: from vertex ``edge`` to the next.
        tile: which face of the tiling (`Snapshot.faces`), for "tile".
        diagonal: the two ends, for "diagonal".
        crossed: how many edges and vertices the walk to the point has passed.
    """

    kind: str
    body: str | None = None
    vertex: int | None = None
    edge: int | None = None
    tile: int | None = None
    diagonal: tuple[VertexName, VertexName] | None = None
    crossed: int = 0

    @property
    def is_free(self) -> bool:
        """Whether no (closed) body has the point."""
        return self.body is None


@final
@dataclass(frozen=True, slots=True)
class Hit:
    """The first point of a ray that a body has.

    Attributes:
        body: which one.
        vertex: the vertex that is hit, if one is.
        edge: else the edge of which an inner point is hit; neither if the ray starts
            inside the body.
        point: where, exactly.
        at: the parameter: the point is origin + at * direction.
        crossed: how many edges the ray has crossed before.
    """

    body: str
    vertex: int | None
    edge: int | None
    point: tuple[Fraction, Fraction]
    at: Fraction
    crossed: int


@final
@dataclass(frozen=True, slots=True)
class Path:
    """A shortest path among those that can be deformed into each other.

    Attributes:
        points: from the start by way of the bends to the goal.
        bends: of each point in between, the vertex that the path bends around.
        crossed: how many diagonals its sleeve of tiles crosses.
    """

    points: tuple[tuple[Fraction, Fraction], ...]
    bends: tuple[VertexName, ...]
    crossed: int

    @property
    def length(self) -> float:
        """The Euclidean length, in doubles."""
        return sum(
            math.hypot(nearest_float(c - a), nearest_float(d - b))
            for (a, b), (c, d) in pairwise(self.points)
        )
