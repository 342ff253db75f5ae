"""The first time at which any two bodies of a scene are within a distance of each other.

The time span is swept in slabs, as in the search for contacts by pairs. In a slab, a vertex and an
edge whose boxes, grown by the distance, do not intersect are farther apart. The other pairs are
examined in halves of the slab, then in halves of these; `_may_be_near` bounds the distance from
below. The few that remain are decided by exact arithmetic, in the order of time.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Final, final

import numpy as np

from exactpt.filters.rounding import U
from exactpt.geometry.boxes import Boxes, grown
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Flags, Indices
from exactpt.kernel.numbers import QQ, nearest_float, power_of_two
from exactpt.motion.slabs import Near
from exactpt.motion.swept_edges import SweptEdges
from exactpt.motion.track import Incidence, Track, vertex_touch
from exactpt.pair.features import FeaturePair
from exactpt.pair.start import Apart, Limit
from exactpt.pair.straight import Earliest, LinearContact
from exactpt.scene.scene import Scene

FEW: Final = 4
"""Number of pairs of a vertex and an edge that exact arithmetic takes over."""
DEPTH: Final = 12
"""Maximum number of bisections of a slab."""
LARGEST_UNIT: Final = 900
"""Largest binary exponent of a unit: boxes in smaller ones, below 2^110, stay doubles in it."""
LASTING: Final = 2
"""Number of bisections, one after the other, that exclude too little to go on."""


@final
class ApproachSearch:
    """A search for the first approach.

    Args:
        scene: the bodies, their motions and the time span.
        squared: the squares of the distances.
        reach: a number for each body; no two bodies keep a distance larger than their sum.
        apart: which pairs keep a distance; by default all of different bodies.
        swept: the boxes of the vertices, if these are known.
    """

    def __init__(
        self,
        scene: Scene,
        squared: Limit,
        reach: Sequence[QQ],
        apart: Apart = np.not_equal,
        swept: SweptEdges | None = None,
    ) -> None:
        self._squared = squared
        self._apart = apart
        self._swept = swept or SweptEdges(scene.bodies, scene.exact_start, scene.exact_end)
        normalization = self._swept.vertices.normalization
        # Units of both axes, relative to the smaller one: powers of two.
        unit = min(normalization.scale)
        self._units = [s - unit for s in normalization.scale]
        near = [nearest_float(d * power_of_two(-unit)) for d in reach]
        with np.errstate(all="ignore"):
            self._grown = np.array(near)[self._swept.body] * (1.0 + 4.0 * U)

    def run(self) -> LinearContact | None:
        """Return the first approach, if no two bodies are within their distance at the start."""
        found = (self.first(*slab) for slab in self._swept.slabs(self.near))
        return next((meeting for meeting in found if meeting is not None), None)

    def first(self, now: QQ, later: QQ, near: Near) -> LinearContact | None:
        """Return the first approach in (now, later] of the candidates of this slab."""
        return self._search(now, later, self._left(now, later, near), DEPTH)

    def _boxes(self, now: QQ, later: QQ) -> Boxes:
        """Return the boxes of the vertices in the smaller unit; the products are exact.

        An axis whose unit is out of the range of doubles then has no bounds.
        """
        boxes = self._swept.during(now, later)
        for axis, unit in enumerate(self._units):
            sides = boxes[:, 2 * axis : 2 * axis + 2]
            if unit <= LARGEST_UNIT:
                sides *= math.ldexp(1.0, unit)
            else:
                sides[:] = -np.inf, np.inf
        return boxes

    def near(self, now: QQ, later: QQ) -> Near:
        """Return the vertices and edges of other bodies that may be near in a slab, by number."""
        boxes = self._boxes(now, later)
        of_edges = self._swept.around(boxes)
        vs, es = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
        body, first = self._swept.body, self._swept.ends[:, 0]
        by = self._grown[:, None]
        for v, e in self._swept.meeting(grown(boxes, by), grown(of_edges, by[first])):
            apart = self._apart(body[v], body[first[e]])
            vs.append(v[apart])
            es.append(e[apart])
        return np.concatenate(vs), np.concatenate(es)

    def _search(
        self, now: QQ, later: QQ, near: Near, depth: int, lasting: int = 0
    ) -> LinearContact | None:
        """Return the first approach in (now, later] of vertices to edges, given by their numbers.

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

    def _left(self, now: QQ, later: QQ, near: Near) -> Near:
        """Return those pairs that may be near in [now, later]."""
        may = self._may_be_near(self._boxes(now, later), *near)
        return near[0][may], near[1][may]

    @np.errstate(all="ignore")
    def _may_be_near(self, boxes: Boxes, v: Indices, e: Indices) -> Flags:
        """Return True if each vertex may be within the distance of an edge, by their boxes.

        With m the middle of a box and h half its diagonal, a point of the edge is within
        max(h_a, h_b) of a point of the segment m_a m_b. So the distance is at least that of m_v
        from this segment, less h_v + max(h_a, h_b). All is computed relative to m_v, of size at
        most some L; each of the few operations errs by at most u times its result, which is at
        most 4 L^2 before the square root and 4 L after it: 64 u L covers them all, and 64 u
        times the largest coordinate the rounding of the middles.
        """
        middle = 0.5 * (boxes[:, ::2] + boxes[:, 1::2])
        half = np.hypot(*(0.5 * (boxes[:, 1::2] - boxes[:, ::2])).T)
        a, b = self._swept.ends[e, 0], self._swept.ends[e, 1]
        to_a, to_b = middle[a] - middle[v], middle[b] - middle[v]
        along = to_b - to_a
        length = np.einsum("ij,ij->i", along, along)
        share = -np.einsum("ij,ij->i", to_a, along) / np.where(length > 0.0, length, 1.0)
        foot = to_a + np.clip(share, 0.0, 1.0)[:, None] * along
        size = np.abs(to_a).sum(axis=1) + np.abs(to_b).sum(axis=1)
        size += np.abs(middle[v]).sum(axis=1) + np.abs(middle[a]).sum(axis=1)
        spread = half[v] + np.maximum(half[a], half[b])
        spread += self._grown[v] + self._grown[a]
        bound = np.hypot(foot[:, 0], foot[:, 1]) - spread * (1.0 + 64.0 * U)
        may: Flags = ~(bound > 64.0 * U * size)  # NaN: it may
        return may

    def _decide(self, now: QQ, later: QQ, v: Indices, e: Indices) -> LinearContact | None:
        """Return the first approach, exactly."""
        begin = AlgebraicNumber(now)
        best: Earliest[Incidence] = Earliest()
        for pair in self._feature_pairs(v, e):
            check_budget()
            squared = self._squared(pair.touch.body, pair.touch.other)
            time = pair.first_time(squared, begin, best.until(later))
            if time is not None:
                best.add(time, [pair.touch] if pair.is_inside(time) else [])
        return None if best.time is None else LinearContact(best.time, best.found)

    def _feature_pairs(self, v: Indices, e: Indices) -> Iterator[FeaturePair]:
        """Yield the pairs of features to which a vertex and an edge belong, each once."""
        seen: set[Incidence] = set()
        for one, edge in zip(v.tolist(), e.tolist(), strict=True):
            a, b = self._swept.ends[edge].tolist()
            track, body, vertex = self._vertex(one)
            ends = [self._vertex(k) for k in ((a, b) if a != b else (a,))]
            other, number = ends[0][1], self._swept.edge_index[edge]
            pairs = [
                (vertex_touch(body, vertex, other, end[2]), ends[k : k + 1])
                for k, end in enumerate(ends)
            ]
            if a != b:
                pairs.append((Incidence(body, vertex, other, number, -1), ends))
            for touch, of in pairs:
                if touch not in seen:
                    seen.add(touch)
                    yield FeaturePair(touch, track, tuple(end[0] for end in of))

    def _vertex(self, k: int) -> tuple[Track, int, int]:
        """Return the trajectory of a vertex, its body and its number in that."""
        vertex = self._swept.vertices.all[self._swept.ids[k]]
        return vertex.track, int(self._swept.body[k]), vertex.index
