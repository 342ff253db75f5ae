"""The first time at which any two bodies of a scene are within a distance of each other.

The time span is swept in slabs, as in the search for contacts by pairs. In a slab, a vertex and an
edge whose boxes, grown by the distance, do not meet are farther apart. What is left is looked at in
halves of the slab, then in halves of these; `_may_be_near` bounds the distance from below. The few
that remain are decided by exact arithmetic, in the order of time.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Final, NamedTuple, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from exactpt.geometry.boxes import Boxes, boxes_of_points, overlapping_pairs
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import ask
from exactpt.kernel.numbers import QQ, nearest_float, power_of_two
from exactpt.kernel.roots import roots_after
from exactpt.kernel.rounding import U
from exactpt.motion.swept import SweptBoxes
from exactpt.motion.track import Track
from exactpt.motion.vertices import Vertices
from exactpt.proximity.distance import squared_distance
from exactpt.proximity.features import Feature, FeaturePair
from exactpt.proximity.stretches import segments_of
from exactpt.scene.scene import Scene

__all__ = ["Approach", "ApproachSearch"]

Indices: TypeAlias = NDArray[np.int64]
Limit: TypeAlias = Callable[[int, int], QQ]

SLABS: Final = 32
"""Number of initial slabs in the time span."""
FEW: Final = 4
"""Number of pairs of a vertex and an edge that exact arithmetic takes over."""
DEPTH: Final = 12
"""Maximum number of bisections of a slab."""
LASTING: Final = 2
"""Number of bisections, one after the other, that exclude too little to go on."""


class Approach(NamedTuple):
    """The first time at which bodies are within their distance.

    Attributes:
        time: the exact time.
        pairs: the indices of the bodies, i < j.
    """

    time: AlgebraicNumber
    pairs: tuple[tuple[int, int], ...]


@final
class ApproachSearch:
    """A search for the first approach.

    Args:
        scene: the bodies, their motions and the time span.
        squared: the square of the distance that two bodies keep, by their indices.
        most: no distance is larger.
    """

    def __init__(self, scene: Scene, squared: Limit, most: QQ) -> None:
        self._scene = scene
        self._squared = squared
        self._most = most
        self._vertices = Vertices.of(scene.bodies, scene._start, scene._end, plain=True)
        ids: list[int] = []
        edges: list[tuple[int, int]] = []
        numbers: list[int] = []
        for moving, body in zip(self._vertices.bodies, scene.bodies, strict=True):
            base = len(ids)
            ids += moving.ring
            edges += [(base + a, base + b) for a, b in segments_of(body)]
            numbers += range(len(segments_of(body)))
        self._ids = ids
        self._edges: Indices = np.array(edges)
        self._numbers = numbers
        self._body: Indices = np.array([self._vertices.all[v].body for v in ids])
        self._read_tracks()

    def run(self) -> Approach | None:
        """The first approach in the closed time span; None if there is none."""
        pairs = tuple(self._within_at_start())
        if pairs:
            return Approach(AlgebraicNumber(self._scene._start), pairs)
        now, end = self._scene._start, self._scene._end
        step = (end - now) / SLABS
        while now < end:
            ask()
            until = min([end, *(m.until for m in self._vertices.bodies if m.until is not None)])
            later = min(now + step, until)
            near = self._near(now, later)
            if len(near[0]) > 2 * len(self._ids) + 64 and step > (end - now) / 2**20:
                step /= 2
                continue
            found = self._search(now, later, self._left(now, later, near), DEPTH)
            if found is not None:
                return found
            if 4 * len(near[0]) < len(self._ids):
                step *= 2
            now = later
            self._enter_pieces(now)
        return None

    def _within_at_start(self) -> Iterator[tuple[int, int]]:
        """The pairs of bodies that are within their distance at the start."""
        scene = self._scene
        points = [body._at(scene._start) for body in scene.bodies]
        d = self._most
        grown = [[(x + s * d, y + s * d) for x, y in ring for s in (-1, 1)] for ring in points]
        for first, second in overlapping_pairs(boxes_of_points(grown)):
            for i, j in sorted(zip(first.tolist(), second.tolist(), strict=True)):
                a, b = scene.bodies[i], scene.bodies[j]
                if squared_distance(a, b, scene._start) <= self._squared(i, j):
                    yield i, j

    def _read_tracks(self) -> None:
        """Read the trajectories of the current pieces of motion."""
        images = [self._vertices.all[v].image for v in self._ids]
        frame = self._vertices.frame
        self._swept = SweptBoxes(images, self._vertices.enclosures.errors)
        # Units of both axes, relative to the smaller one: powers of two.
        unit = min(frame.scale)
        self._units = np.array([math.ldexp(1.0, s - unit) for s in frame.scale])
        self._reach = nearest_float(self._most * power_of_two(-unit)) * (1.0 + 4.0 * U)

    def _enter_pieces(self, now: QQ) -> None:
        ended = [i for i, m in enumerate(self._vertices.bodies) if m.until == now]
        for i in ended:
            self._vertices.enter_piece(i, now)
        if ended:
            self._read_tracks()

    def _boxes(self, now: QQ, later: QQ) -> Boxes:
        """The boxes of the vertices in the smaller unit; the products are exact."""
        frame = self._vertices.frame
        boxes = self._swept.during(frame.time(now)[0], frame.time(later)[1])
        boxes *= np.repeat(self._units, 2)
        return boxes

    def _near(self, now: QQ, later: QQ) -> tuple[Indices, Indices]:
        """The numbers of vertices and of edges of other bodies that may be near in a slab."""
        boxes = self._boxes(now, later)
        a, b = self._edges[:, 0], self._edges[:, 1]
        low, high = np.minimum(boxes[a], boxes[b]), np.maximum(boxes[a], boxes[b])
        of_edges = np.stack((low[:, 0], high[:, 1], low[:, 2], high[:, 3]), axis=1)
        of_edges[:, ::2] = np.nextafter(of_edges[:, ::2] - self._reach, -np.inf)
        of_edges[:, 1::2] = np.nextafter(of_edges[:, 1::2] + self._reach, np.inf)
        n = len(self._ids)
        vs, es = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
        for first, second in overlapping_pairs(np.concatenate((boxes, of_edges))):
            crossed = (first < n) & (second >= n)
            v, e = first[crossed], second[crossed] - n
            apart = self._body[v] != self._body[self._edges[e, 0]]
            vs.append(v[apart])
            es.append(e[apart])
        return np.concatenate(vs), np.concatenate(es)

    def _search(
        self, now: QQ, later: QQ, near: tuple[Indices, Indices], depth: int, lasting: int = 0
    ) -> Approach | None:
        """The first approach in (now, later] of vertices to edges, given by their numbers.

        Pairs that hover at about their distance are near in both halves of every interval: exact
        arithmetic decides these, too.
        """
        count = len(near[0])
        if not count:
            return None
        if count <= FEW or not depth or lasting == LASTING:
            return self._decide(now, later, *near)
        middle = (now + later) / 2
        halves = [(a, b, self._left(a, b, near)) for a, b in ((now, middle), (middle, later))]
        excluded = 2 * count - sum(len(left[0]) for _, _, left in halves)
        lasting = 0 if 2 * excluded >= count else lasting + 1
        for begin, end, left in halves:
            found = self._search(begin, end, left, depth - 1, lasting)
            if found is not None:
                return found
        return None

    def _left(self, now: QQ, later: QQ, near: tuple[Indices, Indices]) -> tuple[Indices, Indices]:
        """Those pairs that may be near in [now, later]."""
        may = self._may_be_near(self._boxes(now, later), *near)
        return near[0][may], near[1][may]

    @np.errstate(all="ignore")
    def _may_be_near(self, boxes: Boxes, v: Indices, e: Indices) -> NDArray[np.bool_]:
        """Whether each vertex may be within the distance of an edge, somewhere in their boxes.

        With m the middle of a box and h half its diagonal, a point of the edge is within
        max(h_a, h_b) of a point of the segment m_a m_b. So the distance is at least that of m_v
        from this segment, less h_v + max(h_a, h_b). All is computed relative to m_v, of size at
        most L, say; each of the few operations errs by at most u times its result, which is at
        most 4 L^2 before the square root and 4 L after it: 64 u L covers them all, and 64 u
        times the largest coordinate the rounding of the middles.
        """
        middle = 0.5 * (boxes[:, ::2] + boxes[:, 1::2])
        half = np.hypot(*(0.5 * (boxes[:, 1::2] - boxes[:, ::2])).T)
        a, b = self._edges[e, 0], self._edges[e, 1]
        to_a, to_b = middle[a] - middle[v], middle[b] - middle[v]
        along = to_b - to_a
        length = np.einsum("ij,ij->i", along, along)
        share = -np.einsum("ij,ij->i", to_a, along) / np.where(length > 0.0, length, 1.0)
        foot = to_a + np.clip(share, 0.0, 1.0)[:, None] * along
        size = np.abs(to_a).sum(axis=1) + np.abs(to_b).sum(axis=1)
        size += np.abs(middle[v]).sum(axis=1) + np.abs(middle[a]).sum(axis=1)
        spread = half[v] + np.maximum(half[a], half[b])
        bound = np.hypot(foot[:, 0], foot[:, 1]) - (spread + self._reach) * (1.0 + 64.0 * U)
        may: NDArray[np.bool_] = ~(bound > 64.0 * U * size)  # NaN: it may
        return may

    def _decide(self, now: QQ, later: QQ, v: Indices, e: Indices) -> Approach | None:
        """The first approach, exactly."""
        begin = AlgebraicNumber(now)
        found: list[tuple[AlgebraicNumber, tuple[int, int]]] = []
        best: AlgebraicNumber | None = None
        for (i, j), pair in self._feature_pairs(v, e):
            ask()
            f = pair.at_distance(self._squared(i, j))
            limit = later if best is None else min(later, best._high)
            for root in roots_after(f, begin, limit) if f else ():
                if pair.holds(root.time):
                    found.append((root.time, (i, j)))
                    if best is None or root.time.compare(best) < 0:
                        best = root.time
                    break
        if best is None:
            return None
        return Approach(best, tuple(sorted({ij for t, ij in found if t.compare(best) == 0})))

    def _feature_pairs(
        self, v: Indices, e: Indices
    ) -> Iterator[tuple[tuple[int, int], FeaturePair]]:
        """The pairs of features to which a vertex and an edge belong, each once."""
        seen: set[tuple[int, ...]] = set()
        for one, edge in zip(v.tolist(), e.tolist(), strict=True):
            a, b = self._edges[edge].tolist()
            bodies = int(self._body[one]), int(self._body[a])
            for ends in ((a,), (b,), (a, b)) if a != b else ((a,),):
                key = (one, *ends) if len(ends) > 1 else tuple(sorted((one, *ends)))
                if key in seen:
                    continue
                seen.add(key)
                other = self._vertex(ends[0])[1] if len(ends) == 1 else None
                feature = Feature(other, None if len(ends) == 1 else self._numbers[edge])
                track, index = self._vertex(one)
                features = (Feature(index, None), feature)
                tracks = tuple(self._vertex(k)[0] for k in ends)
                in_order = bodies[0] < bodies[1]
                yield (
                    bodies if in_order else bodies[::-1],
                    FeaturePair(features if in_order else features[::-1], track, tracks),
                )

    def _vertex(self, k: int) -> tuple[Track, int]:
        """The trajectory of a vertex and its number in its body."""
        vertex = self._vertices.all[self._ids[k]]
        return vertex.track, vertex.index
