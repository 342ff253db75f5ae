"""The vertices and edges of moving bodies as numbers, and the pairs whose swept boxes intersect."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Final, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from exactpt.geometry.boxes import Boxes, crossing_pairs, overlapping_pairs
from exactpt.kernel.budget import ask
from exactpt.kernel.doubles import Indices
from exactpt.kernel.numbers import QQ, power_of_two
from exactpt.motion.body import Body
from exactpt.motion.swept import SweptBoxes
from exactpt.motion.vertices import Vertices

Near: TypeAlias = tuple[Indices, Indices]
"""Pairs of a vertex and an edge, by number."""

MANY: Final = 8
"""Number of bodies from which on those that are near no other are left out first."""

SMALL: Final = 64
"""Number of vertices, of fewer bodies than that, below which all are compared with all edges."""

PATIENCE: Final = 8
"""Number of slabs after which one as long as the last that was too long is tried again."""

SMALLEST_SLAB: Final = 1 << 40
"""The shortest slab is the time span divided by this."""


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
        motion: the motion identity of each vertex, see `exactpt.motion.image.Image`.
        deforms: for each body, whether it deforms.
        boxes: the swept boxes of the vertices.
    """

    def __init__(self, bodies: Sequence[Body], start: QQ, end: QQ) -> None:
        self._start, self._end = start, end
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
        self._read_images()

    def _read_images(self) -> None:
        images = [self.vertices.all[v].image for v in self.ids]
        self.boxes = SweptBoxes(images, self.vertices.enclosures.errors)
        self.motion: Indices = np.array([image.motion for image in images])
        self.deforms = np.array([moving.deforms for moving in self.vertices.bodies])

    def slabs(self, near: Callable[[QQ, QQ], Near]) -> Iterator[tuple[QQ, QQ, Near]]:
        """Cut the time span into slabs, none longer than a piece of motion: start, end, candidates.

        They are longer while there are few candidates. After a slab that was too long, the
        following ones are shorter than it for a while.

        Args:
            near: the candidates of a slab.
        """
        now, end = self._start, self._end
        step, limit = self._first_step(), end - now
        since = 0  # number of slabs since one was too long
        while now < end:
            ask()
            tried = step
            step, later, found = self._slab(now, step, near)
            yield now, later, found
            since += 1
            if step < tried:
                limit, since = tried / 2, 0
            elif since > PATIENCE:
                limit = end - self._start
            if later == now + step and 4 * len(found[0]) < self._many():
                step = min(2 * step, limit)
            now = later
            self.enter_pieces(now)

    def _slab(self, now: QQ, step: QQ, near: Callable[[QQ, QQ], Near]) -> tuple[QQ, QQ, Near]:
        """Return a slab from now on: its length, its end, and the candidates in it.

        With many candidates it is shortened, by 4 or by 16, as long as these get fewer by the
        square root of that at least; else they stay near each other, and shorter slabs are no
        help.
        """
        until = self.until()
        later = min(now + step, until)
        found = near(now, later)
        least = (self._end - self._start) / SMALLEST_SLAB
        tried = step
        while len(found[0]) > self._many() and tried > least and 8 * tried >= step:
            tried /= 4
            fewer = near(now, min(now + tried, until))
            if len(fewer[0]) ** 2 * step <= len(found[0]) ** 2 * tried:
                step, later, found = tried, min(now + tried, until), fewer
        return step, later, found

    def _many(self) -> int:
        """Return the number of candidates above which a slab is shortened."""
        return 2 * len(self.ids) + 64

    def _first_step(self) -> QQ:
        """Length of the first slab: the average vertex moves an eighth as far as others are.

        It depends on how fast bodies pass each other, not on how long they are watched. Slabs
        with few candidates grow longer.
        """
        span, frame = self._end - self._start, self.vertices.frame
        stride = self.boxes.stride(frame.time(self._start)[0])
        # Shorter slabs are no help to vertices without boxes, nor where nothing moves.
        if math.isnan(stride) or math.isinf(stride):
            return span
        return min(span, power_of_two(math.frexp(stride / 8.0)[1] + frame.time_scale))

    def until(self) -> QQ:
        """Return the earliest end of the current pieces of motion, at most that of the span."""
        untils = (m.until for m in self.vertices.bodies if m.until is not None)
        return min([self._end, *untils])

    def enter_pieces(self, now: QQ) -> None:
        """Replace the pieces of motion that end at a time by those that follow."""
        ended = [i for i, m in enumerate(self.vertices.bodies) if m.until == now]
        for i in ended:
            self.vertices.enter_piece(i, now)
        if not all(self._replace_images(i) for i in ended):
            self._read_images()

    def _replace_images(self, i: int) -> bool:
        """Read the enclosures of a body that has entered a piece; false if there is no room."""
        moving = self.vertices.bodies[i]
        images = [self.vertices.all[v].image for v in moving.ring]
        first = int(moving.ring[0])  # ids are numbered in order
        self.motion[first : first + len(images)] = [image.motion for image in images]
        self.deforms[i] = moving.deforms
        return self.boxes.replace(first, images, self.vertices.enclosures.errors)

    def during(self, now: QQ, later: QQ) -> Boxes:
        """Return the boxes that the vertices sweep, normalised."""
        frame = self.vertices.frame
        return self.boxes.during(frame.time(now)[0], frame.time(later)[1])

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

    def _near_others(self, body: Indices, boxes: Boxes, hulls: Boxes) -> NDArray[np.bool_]:
        """For each box of a body, whether the body deforms, or the box of another intersects it."""
        near = self.deforms[body]
        for j, (left, right, low, high) in enumerate(hulls.tolist()):
            meets = (boxes[:, 0] <= right) & (boxes[:, 1] >= left) & (body != j)
            near |= meets & (boxes[:, 2] <= high) & (boxes[:, 3] >= low)
        return near

    def _busy(self, boxes: Boxes) -> NDArray[np.bool_]:
        """For each body, whether it deforms, or its box intersects that of another one."""
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
