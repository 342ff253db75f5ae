"""The pairs of features of two bodies that may be nearest at one time: a float filter.

The distance of two vertices, one of each body, bounds that of the bodies. Vertices and edges that
are farther than that from the box of the other body are in no nearest pair, and no pair is nearest
whose boxes are farther apart. Few pairs are left where the bodies are close to each other compared
with their size. `exactpt.pair.near_features.may_be_least` compares these.

Rounding. Boxes of points are rounded outward, so the gap of two boxes in x or in y is at least the
difference of the doubles, which is off by at most U of it, as is ``hypot`` by a few units: `SLACK`
covers them. The bound is the ``hypot`` of the largest differences of the sides of two boxes, again
with `SLACK`, and `TINY` for underflow. A NaN, which needs an infinity, excludes nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np

from exactpt.filters.rounding import SLACK, TINY
from exactpt.geometry.boxes import Boxes, boxes_of_points, crossing_pairs, grown
from exactpt.geometry.predicates import Point
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Flags, Floats, Indices
from exactpt.motion.body import Body
from exactpt.motion.track import Incidence, vertex_touch
from exactpt.pair.near_features import joined, may_be_least

STEPS: Final = 8
"""Number of times that the nearest vertex of either body is looked for."""


class _Features(NamedTuple):
    """Vertices or edges of one body, with their boxes.

    Attributes:
        first, last: the ends of each; twice the vertex, for a vertex.
        edge: the number of each edge in the body; -1 for a vertex.
        boxes: the box of each.
    """

    first: Indices
    last: Indices
    edge: Indices
    boxes: Boxes

    def within(self, distance: float, box: Floats) -> _Features:
        """Return those that may be within a distance of a box."""
        gaps = np.maximum(box[::2] - self.boxes[:, 1::2], self.boxes[:, ::2] - box[1::2])
        gap = np.hypot(*np.maximum(gaps, 0.0).T)
        near = ~(gap > distance * SLACK)
        return _Features(*(column[near] for column in self))


class _Pairs(NamedTuple):
    """Pairs of a vertex, and a vertex or an edge of the other body, as arrays.

    Attributes:
        v: the vertex of each.
        first, last, edge: the other feature, as in `_Features`.
    """

    v: Indices
    first: Indices
    last: Indices
    edge: Indices

    def that(self, are: Flags) -> _Pairs:
        """Return those pairs for which it is true."""
        return _Pairs(*(column[are] for column in self))


def incidences_that_may_be_nearest(
    a: Body, p: list[Point], b: Body, q: list[Point]
) -> Iterator[Incidence]:
    """Yield the pairs of features that may be nearest, with all that are, once each.

    Args:
        a: a body, with the number 0.
        p: its vertices at the time.
        b: another body, with the number 1.
        q: its vertices.
    """
    n = len(p)
    boxes = boxes_of_points([(point,) for point in (*p, *q)])
    pairs = _pairs_that_may_be_nearest(boxes, n, _ends(a), n + _ends(b))
    for v, first, _, edge in zip(*(column.tolist() for column in pairs), strict=True):
        if edge < 0:
            yield vertex_touch(0, v, 1, first - n)
        elif v < n:
            yield Incidence(0, v, 1, edge, -1)
        else:
            yield Incidence(1, v - n, 0, edge, -1)


@np.errstate(all="ignore")
def _pairs_that_may_be_nearest(boxes: Boxes, n: int, ends_a: Indices, ends_b: Indices) -> _Pairs:
    """Return the pairs, given the boxes of all vertices and the vertices of all edges.

    Those of the second body are numbered from n on.
    """
    numbers = np.arange(len(boxes))
    far = _distance_above(boxes[:n], boxes[n:])
    of_a, of_b = (_hull(some) for some in (boxes[:n], boxes[n:]))
    vertices_of_a = _vertices(numbers[:n], boxes).within(far, of_b)
    vertices_of_b = _vertices(numbers[n:], boxes).within(far, of_a)
    edges_of_a = _edges(ends_a, boxes).within(far, of_b)
    edges_of_b = _edges(ends_b, boxes).within(far, of_a)
    chunks = [
        chunk.that(may_be_least(boxes, chunk.v, chunk.first, chunk.last))
        for vertices, others in (
            (vertices_of_a, vertices_of_b),
            (vertices_of_a, edges_of_b),
            (vertices_of_b, edges_of_a),
        )
        for chunk in _near_each_other(vertices, others, far)
    ]
    pairs = _Pairs(*(np.concatenate(columns) for columns in zip(*chunks, strict=True)))
    return pairs.that(may_be_least(boxes, pairs.v, pairs.first, pairs.last))


def _vertices(numbers: Indices, boxes: Boxes) -> _Features:
    return _Features(numbers, numbers, np.full(len(numbers), -1), boxes[numbers])


def _ends(body: Body) -> Indices:
    """Return the vertices at the ends of each edge: shape (n, 2)."""
    return np.array(body.edges, np.int64).reshape(-1, 2)


def _edges(ends: Indices, boxes: Boxes) -> _Features:
    first, last = ends.T
    return _Features(first, last, np.arange(len(ends)), joined(boxes[first], boxes[last]))


def _hull(boxes: Boxes) -> Floats:
    """Return the least box that contains some boxes."""
    hull: Floats = boxes.max(axis=0)
    hull[::2] = boxes[:, ::2].min(axis=0)
    return hull


def _near_each_other(vertices: _Features, others: _Features, far: float) -> Iterator[_Pairs]:
    """Yield the pairs whose boxes are within a distance, in chunks."""
    for i, j in crossing_pairs(grown(vertices.boxes, far), others.boxes):
        check_budget()
        if len(i):
            yield _Pairs(vertices.first[i], others.first[j], others.last[j], others.edge[j])


def _distance_above(some: Boxes, others: Boxes) -> float:
    """Return an upper bound of the distance of a vertex of one body from one of the other.

    Each is about the nearest one to the other.
    """
    i = j = 0
    for _ in range(STEPS):
        i = _nearest(some, others[j])
        j = _nearest(others, some[i])
    one, other = some[i], others[j]
    x, y = np.maximum(one[1::2] - other[::2], other[1::2] - one[::2])
    far = float(np.hypot(x, y)) * SLACK + TINY
    return min(math.inf, far)  # of a NaN too


def _nearest(boxes: Boxes, box: Floats) -> int:
    return int(np.argmin(np.hypot(boxes[:, 0] - box[0], boxes[:, 2] - box[2])))
