"""The vertices and edges of moving bodies as numbers, and the pairs whose swept boxes intersect."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Final, final

import numpy as np

from exactpt.geometry.boxes import Boxes, crossing_pairs, overlapping_pairs
from exactpt.kernel.doubles import Flags, Indices
from exactpt.kernel.numbers import QQ, power_of_two
from exactpt.motion.body import Body
from exactpt.motion.slabs import Near, slabs
from exactpt.motion.swept import SweptBoxes
from exactpt.motion.vertices import Vertices

MANY: Final = 8
"""Number of bodies from which on those that are near no other are left out first."""

SMALL: Final = 64
"""Number of vertices, of fewer bodies than that, below which all are compared with all edges."""


@final
class SweptEdges:
    """All vertices and edges, numbered from 0 in the order of the bodies.

    Args:
        bodies: at least one.
        start, end: the time span.

    Attributes:
        vertices: the moving vertices.
        ids: the id of each vertex.
        body: the body of each vertex.
        ends: shape (m, 2), the vertices of each edge; a point is an edge from itself to itself.
        edge_index: the number of each edge in its body.
        motion: the motion identity of each vertex, see `exactpt.motion.float_track.FloatTrack`.
        deforms: for each body, whether it deforms.
        boxes: the swept boxes of the vertices.
    """

    def __init__(self, bodies: Sequence[Body], start: QQ, end: QQ) -> None:
        inner = {t for body in bodies for t in body.exact_breakpoints if start < t < end}
        self._times = sorted({start, end, *inner})
        self.vertices = Vertices.of(bodies, start, end, plain=True)
        self.ids = self.vertices.ids()
        self.body: Indices = np.array([self.vertices.all[v].body for v in self.ids])
        ends: list[tuple[int, int]] = []
        self.edge_index: list[int] = []
        base = 0
        for body in bodies:
            pairs = body.edges or [(0, 0)]
            ends += [(base + a, base + b) for a, b in pairs]
            self.edge_index += range(len(pairs))
            base += body.size
        self.ends: Indices = np.array(ends)
        self._first: Indices = np.cumsum([0, *(body.size for body in bodies)])[:-1]
        self._read_tracks()

    def _read_tracks(self) -> None:
        float_tracks = [self.vertices.all[v].float_track for v in self.ids]
        self.boxes = SweptBoxes(float_tracks, self.vertices.enclosures.errors)
        self.motion: Indices = np.array([float_track.motion for float_track in float_tracks])
        self.deforms = np.array([moving.deforms for moving in self.vertices.bodies])

    def slabs(
        self, near: Callable[[QQ, QQ], Near], longest: QQ | None = None, many: int | None = None
    ) -> Iterator[tuple[QQ, QQ, Near]]:
        """Cut the time span into `slabs`, none longer than a piece of motion.

        The average vertex moves an eighth as far in the first one as others are: this depends on
        how fast bodies pass each other, not on how long they are watched.

        Args:
            near: the candidates of a slab.
            longest: the length of the longest slab, if it is limited.
            many: the number of candidates above which a slab is shortened.
        """
        times, normalization = self._times, self.vertices.normalization
        first = longest = longest or times[-1] - times[0]
        stride = self.boxes.stride(normalization.time(times[0])[0])
        # Shorter slabs do not help vertices without boxes, nor where nothing moves.
        if math.isfinite(stride):
            first = min(first, power_of_two(math.frexp(stride / 8.0)[1] + normalization.time_scale))
        many = many or len(self.ids) + 32
        for now, later, found in slabs(times, near, many, first, longest):
            yield now, later, found
            self._enter_pieces(later)

    def _enter_pieces(self, now: QQ) -> None:
        """Replace the pieces of motion that end at a time by those that follow."""
        ended = [i for i, m in enumerate(self.vertices.bodies) if m.until == now]
        for i in ended:
            self.vertices.enter_piece(i, now)
        if not all(self._replace_float_tracks(i) for i in ended):
            self._read_tracks()

    def _replace_float_tracks(self, i: int) -> bool:
        """Read the enclosures of a body that has entered a piece; false if they do not fit."""
        moving = self.vertices.bodies[i]
        float_tracks = [self.vertices.all[v].float_track for v in moving.ring]
        first = int(moving.ring[0])  # ids are numbered in order
        self.motion[first : first + len(float_tracks)] = [
            float_track.motion for float_track in float_tracks
        ]
        self.deforms[i] = moving.deforms
        return self.boxes.replace(first, float_tracks, self.vertices.enclosures.errors)

    def during(self, now: QQ, later: QQ) -> Boxes:
        """Return the boxes that the vertices sweep, normalised."""
        normalization = self.vertices.normalization
        return self.boxes.during(normalization.time(now)[0], normalization.time(later)[1])

    def around(self, boxes: Boxes) -> Boxes:
        """Return the boxes of the edges, given those of the vertices."""
        a, b = self.ends[:, 0], self.ends[:, 1]
        low, high = np.minimum(boxes[a], boxes[b]), np.maximum(boxes[a], boxes[b])
        return np.stack((low[:, 0], high[:, 1], low[:, 2], high[:, 3]), axis=1)

    def meeting(self, boxes: Boxes, edge_boxes: Boxes) -> Iterator[tuple[Indices, Indices]]:
        """Yield the pairs of a vertex and an edge whose boxes intersect, in blocks.

        Pairs of one rigid body may be omitted if one of them is near no other body.
        """
        if len(self._first) < MANY and len(self.ids) < SMALL:
            yield from crossing_pairs(boxes, edge_boxes)
            return
        of_edge = self.body[self.ends[:, 0]]
        if len(self._first) < MANY:
            hulls = self.of_bodies(boxes)
            some = np.flatnonzero(self._near_others(self.body, boxes, hulls))
            others = np.flatnonzero(self._near_others(of_edge, edge_boxes, hulls))
        else:
            busy = self._busy(boxes)
            some, others = np.flatnonzero(busy[self.body]), np.flatnonzero(busy[of_edge])
        for first, second in crossing_pairs(boxes[some], edge_boxes[others]):
            yield some[first], others[second]

    def _near_others(self, body: Indices, boxes: Boxes, hulls: Boxes) -> Flags:
        """For each box of a body, whether the body deforms, or the box of another intersects it."""
        near = self.deforms[body]
        for j, (left, right, low, high) in enumerate(hulls.tolist()):
            meets = (boxes[:, 0] <= right) & (boxes[:, 1] >= left) & (body != j)
            near |= meets & (boxes[:, 2] <= high) & (boxes[:, 3] >= low)
        return near

    def _busy(self, boxes: Boxes) -> Flags:
        """For each body, whether it deforms, or its box intersects that of another body."""
        busy = self.deforms.copy()
        for first, second in overlapping_pairs(self.of_bodies(boxes)):
            busy[first] = busy[second] = True
        return busy

    def of_bodies(self, boxes: Boxes) -> Boxes:
        """Return the boxes of the bodies, given those of the vertices."""
        joined = np.empty((len(self._first), 4))
        joined[:, ::2] = np.minimum.reduceat(boxes[:, ::2], self._first)
        joined[:, 1::2] = np.maximum.reduceat(boxes[:, 1::2], self._first)
        return joined
