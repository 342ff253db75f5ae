"""The outlines of many bodies at rest, in columns: edges, boxes, numbers of vertices."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from exactpt.geometry.ragged import Edges, edges_of
from exactpt.kernel.doubles import Flags, Floats, Indices, native
from exactpt.scene.body_arrays import BodyArrays


class Outlines(NamedTuple):
    """Outlines in columns.

    Attributes:
        x, y: the coordinates of the vertices.
        first_vertex, vertex_count: the vertices of each body.
        first_edge, edge_count: its edges.
        edges: the ends of the edges; those of a point are equal.
        ax, ay, ux, uy: the first vertex of each edge, and the difference of its ends.
        rings: which bodies are polygons.
        points: whether any body is a point.
        low, high: shape (n, 2), the boxes of the bodies.
    """

    x: Floats
    y: Floats
    first_vertex: Indices
    vertex_count: Indices
    first_edge: Indices
    edge_count: Indices
    edges: Edges
    ax: Floats
    ay: Floats
    ux: Floats
    uy: Floats
    rings: Flags
    points: bool
    low: Floats
    high: Floats


def outlines_of(bodies: BodyArrays) -> Outlines:
    """Return the outlines of bodies; a difference beyond the largest double is infinite."""
    x, y = np.ascontiguousarray(bodies.vertices.T)
    edges = edges_of(bodies.offsets, bodies.closed)
    ax, ay = x[edges.first], y[edges.first]
    with np.errstate(all="ignore"):
        ux, uy = x[edges.last] - ax, y[edges.last] - ay
    first, count = bodies.offsets[:-1], np.diff(bodies.offsets)
    low, high = (
        np.stack([extreme.reduceat(c, native(first)) for c in (x, y)], axis=1)
        if len(first) else np.zeros((0, 2))
        for extreme in (np.minimum, np.maximum)
    )  # fmt: skip
    return Outlines(
        x, y, first, count, edges.offsets[:-1], np.diff(edges.offsets), edges, ax, ay, ux, uy,
        bodies.closed & (count > 2), bool((count == 1).any()), low, high,
    )  # fmt: skip
