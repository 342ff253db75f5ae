"""The vertices and edges of moving bodies as numbers, and the pairs whose swept boxes intersect."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Final, final

import numpy as np

from exactpt.geometry.boxes import Boxes, crossing_pairs, grown, overlapping_pairs
from exactpt.kernel.doubles import Flags, Floats, Indices, middles
from exactpt.kernel.numbers import QQ, enclosing_floats, nearest_float, power_of_two
from exactpt.kernel.polynomial import ZERO, Polynomial
from exactpt.motion.body import Body
from exactpt.motion.course import Piece
from exactpt.motion.motions import Rigid, SimpleMotion, Translation
from exactpt.motion.outline import is_rigid, reach_from
from exactpt.motion.slabs import PATIENCE, Near, Slab, slabs
from exactpt.motion.swept import INSTANT, SweptBoxes
from exactpt.motion.track import Track
from exactpt.motion.vertices import Vertices

MANY: Final = 8
"""Number of bodies from which on those that are near no other are left out first."""

SAMPLES: Final = 5
"""Number of times in the time span at which bodies are looked at."""

TOGETHER: Final = 16
"""Number of pieces of motion of which boxes are made at once."""

FEW: Final = 256
"""Number of vertices up to which those count alone whose bodies come near others."""

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
        self._changing = [
            i for i, body in enumerate(bodies) if body.exact_breakpoints_between(start, end)
        ]
        self._rigid = {i for i in self._changing if is_rigid(bodies[i])}
        self._read_tracks()

    def _read_tracks(self) -> None:
        float_tracks = [self.vertices.all[v].float_track for v in self.ids]
        self.boxes = SweptBoxes(float_tracks, self.vertices.enclosures.errors)
        self.motion: Indices = np.array([float_track.motion for float_track in float_tracks])
        self.deforms = np.array([moving.deforms for moving in self.vertices.bodies])
        self._boxes_of_pieces: dict[tuple[int, QQ | None], Boxes] = {}  # less the drift

    def slabs(
        self,
        near: Callable[[QQ, QQ], Near],
        longest: QQ | None = None,
        many: int | None = None,
        bodies_of: Callable[[Near], Near] | None = None,
    ) -> Iterator[Slab]:
        """Cut the time span into `slabs`.

        The motions of bodies that have candidates do not change within a slab, nor those of bodies
        that are not rigid. Other bodies may go through many pieces of their motions in it.

        Args:
            near: the candidates in a slab, among the pairs whose boxes intersect during it.
            longest: the length of the longest slab, if it is limited.
            many: the number of candidates above which a slab is shortened.
            bodies_of: returns the bodies of candidates; these are vertices and edges by default.
        """
        start, end = self._start, self._end
        longest = longest or end - start
        normalization = self.vertices.normalization
        since, until = normalization.time(start)[0], normalization.time(end)[1]
        all_count = 1 if self.deforms.any() else 2  # of so few bodies none is left out
        looks_ahead = len(self._first) > all_count and len(self.ids) <= FEW
        ahead = np.linspace(since, until, SAMPLES).tolist() if looks_ahead else []
        here, there, *later = self.boxes.places([since, since + INSTANT, *ahead])
        relevant = self._relevant(np.array(later))
        many = many or int(relevant.sum()) + 32
        first = self._first_length(longest, here[relevant], there[relevant])
        bodies_of = bodies_of or self._bodies_of
        held: set[int] = set()  # bodies that have been near others, or seem to come near them
        if looks_ahead:
            held.update(self.body[relevant].tolist())
        release = 2 * PATIENCE  # the number of slabs after which they are looked at anew

        def between(now: QQ, later: QQ) -> Slab:
            until = self._first_change_near_others(now, later, held)
            while True:
                found = near(now, until)
                changes = self._changes_before(until)
                if not changes:
                    return Slab(now, until, found)
                met = [i for i in _numbers(bodies_of(found)) if i in changes]
                if not met:
                    return Slab(now, until, found)
                held.update(met)
                until = min(changes[i] for i in met)

        for count, slab in enumerate(slabs(start, end, between, many, first, longest), 1):
            yield slab
            self._enter_pieces(slab.end)
            if count == release:
                held.clear()
                release *= 4

    def _first_change_near_others(self, now: QQ, later: QQ, held: set[int]) -> QQ:
        """Return the first time at which the motion of a body changes that now is near another.

        Or of a body that is not rigid, or is held; ``later``, if that is earlier. Bodies that are
        near others become held. For the others, boxes of later pieces are worth their price.
        """
        changes = self._changes_before(later)
        if not changes:
            return later
        first = min(changes.values())
        if any(i not in self._rigid or i in held for i, t in changes.items() if t == first):
            return first
        normalization = self.vertices.normalization
        busy = self._busy(
            self.boxes.during(normalization.time(now)[0], normalization.time(first)[1])
        )
        held.update(i for i in changes if busy[i])
        ending = [t for i, t in changes.items() if i not in self._rigid or i in held]
        return min(ending, default=later)

    def _bodies_of(self, near: Near) -> Near:
        """Return the bodies of vertices and edges."""
        return self.body[near[0]], self.body[self.ends[near[1], 0]]

    @np.errstate(all="ignore")
    def _relevant(self, places: Floats) -> Flags:
        """For each vertex, whether its body seems to come near another, or deforms: an estimate.

        Near are bodies whose boxes meet, or, if none deforms, are at most twice as far apart as
        those of any two. The boxes are around places at some times, as if the first pieces of
        motion went on. (What a body sweeps that turns for long may have no bounds.) Without places
        all vertices count: of many vertices other costs are larger than that of some short slabs.
        """
        if not len(places):
            return np.ones(len(self.ids), np.bool_)
        units = [power_of_two(-scale) for scale in self.vertices.normalization.scale]
        radii = [moving.body.exact_radius for moving in self.vertices.bodies]
        reach = np.array([[nearest_float(radius * unit) for unit in units] for radius in radii])
        low = np.minimum.reduceat(places.min(axis=0), self._first) - reach
        high = np.maximum.reduceat(places.max(axis=0), self._first) + reach
        gaps = (low[:, None] - high).max(axis=2)
        gaps = np.maximum(gaps, gaps.T)
        np.fill_diagonal(gaps, np.inf)
        closest = 0.0 if self.deforms.any() else max(0.0, gaps.min())
        near = ~(gaps > 2.0 * closest).all(axis=1)
        relevant: Flags = (near | self.deforms)[self.body]
        return relevant

    def _first_length(self, longest: QQ, here: Floats, there: Floats) -> QQ:
        """Return the length of the first slab, given places of vertices and those an instant later.

        The average vertex moves an eighth as far in it as others are. This depends on how fast
        bodies pass each other, not on how long they are watched, nor on bodies far away.
        """
        with np.errstate(all="ignore"):
            gap = np.hypot(*np.ptp(here, axis=0)) / np.sqrt(len(here))
            speed = _speed(here, there - middles(there - here))
            stride = float(gap / speed)
        # Shorter slabs do not help vertices without boxes, nor where nothing moves.
        if not math.isfinite(stride):
            return longest
        time_scale = self.vertices.normalization.time_scale
        return min(longest, power_of_two(math.frexp(stride / 8.0)[1] + time_scale))

    def _changes_before(self, later: QQ) -> dict[int, QQ]:
        """Return the bodies whose motions change before a time, each with that of its change."""
        found: dict[int, QQ] = {}
        for i in self._changing:
            change = self.vertices.bodies[i].until
            if change is not None and change < later:
                found[i] = change
        return found

    def _enter_pieces(self, now: QQ) -> None:
        """Replace the pieces of motion that have ended at a time by those that follow."""
        ended = [
            i for i, m in enumerate(self.vertices.bodies) if m.until is not None and m.until <= now
        ]
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
        """Return the boxes that the vertices sweep, normalised.

        Of a body whose motion changes in that time, each box is that of all its vertices.
        """
        normalization = self.vertices.normalization
        boxes = self.boxes.during(normalization.time(now)[0], normalization.time(later)[1])
        for i in self._changes_before(later):
            first = self._first[i]
            boxes[first : first + self.vertices.bodies[i].body.size] = self._box_until(i, later)
        return boxes

    def _box_until(self, i: int, later: QQ) -> Boxes:
        """Return the box of a rigid body from its current piece of motion to a later one."""
        moving, made = self.vertices.bodies[i], self._boxes_of_pieces
        since: QQ | None = moving.since
        pieces: list[tuple[QQ, Piece]] = []
        while since is not None and since < later:
            piece = moving.body.exact_piece_after(since)
            pieces.append((since, piece))
            since = piece.until
        new = [(t, piece) for t, piece in pieces if (i, piece.until) not in made]
        for k in range(0, len(new), TOGETHER):
            some = new[k : k + TOGETHER]
            boxes = self._boxes_during(moving.body, some)
            made.update(
                {(i, piece.until): box for (_, piece), box in zip(some, boxes, strict=True)}
            )
        return _hull(np.stack([made[i, piece.until] for _, piece in pieces]))

    def _boxes_during(self, body: Body, pieces: Sequence[tuple[QQ, Piece]]) -> Boxes:
        """Return a box of a rigid body for each piece of its motion, from a time to the end of it.

        The body stays within a square around a point that moves along a path, of which the box is
        that of one vertex.
        """
        enclosures, normalization = self.vertices.enclosures, self.vertices.normalization
        paths: list[Track] = []
        reaches: list[list[float]] = []
        units = [power_of_two(-scale) for scale in normalization.scale]
        for _, piece in pieces:
            path, reach = _path_and_reach(body, piece.motion)
            paths.append(path)
            by = [
                math.inf if reach is None else enclosing_floats(reach * unit)[1] for unit in units
            ]
            reaches.append(by)
        float_tracks = enclosures.float_tracks(paths)
        swept = SweptBoxes(float_tracks, enclosures.errors, self.boxes.drift)
        ends = [self._end if piece.until is None else piece.until for _, piece in pieces]
        low = np.array([normalization.time(since)[0] for since, _ in pieces])
        high = np.array([normalization.time(end)[1] for end in ends])
        each = np.arange(len(pieces))
        boxes = swept.during(low, high)[each, each]
        return grown(boxes, np.array(reaches))

    def move_together(self, v: Indices, e: Indices, later: QQ) -> Flags:
        """For each pair, whether the vertex surely keeps its place relative to the edge.

        From now to a later time, that is.
        """
        a, b = self.ends[e, 0], self.ends[e, 1]
        motion = self.motion
        together: Flags = (motion[v] >= 0) & (motion[v] == motion[a]) & (motion[v] == motion[b])
        for i in self._changes_before(later):
            together &= (self.body[v] != i) & (self.body[a] != i)
        return together

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


def _path_and_reach(body: Body, motion: SimpleMotion) -> tuple[Track, QQ | None]:
    """Return the path of a point from which no vertex of a rigid body is farther than a distance.

    The point is the pivot, or the first vertex of a body that translates.
    """
    assert isinstance(motion, (Rigid, Translation))  # noqa: S101 - `is_rigid`
    if isinstance(motion, Rigid):
        x, y = motion.exact_pivot
    else:
        x, y = (f.exact_at(QQ(0)) for f in body.vertices[0])
    path = Translation(Polynomial([x]) + motion.x, Polynomial([y]) + motion.y)
    return path.track((ZERO, ZERO)), reach_from(body, (x, y))


def _numbers(pairs: Near) -> set[int]:
    """Return all numbers in pairs."""
    return {*pairs[0].tolist(), *pairs[1].tolist()}


def _speed(here: Floats, there: Floats) -> float:
    """Return the mean speed of points that are elsewhere an instant later."""
    return float(np.hypot(*(there - here).T).mean() / INSTANT)


def _hull(boxes: Boxes) -> Boxes:
    """Return the least box that contains some boxes: shape (1, 4)."""
    hull: Boxes = boxes.max(axis=0, keepdims=True)
    hull[:, ::2] = boxes[:, ::2].min(axis=0)
    return hull
