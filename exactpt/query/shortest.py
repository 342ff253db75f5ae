"""Shortest paths of all: A* over the corners that a path can bend around.

A shortest path among bodies bends at their vertices, around them. From each corner that the search
reaches, in the order of the length so far plus the distance to the goal, the corners that are
seen from it are computed. Only legs at which the path is taut are followed: of two ways to a
corner that are equally long, if one is the beginning of a shortest path, so is the other, and every
shortest path is taut. Lengths are compared exactly.
"""

from __future__ import annotations

from heapq import heappop, heappush
from typing import final

from exactpt.indices import VertexId
from exactpt.query.lengths import Length, squared_distance
from exactpt.query.sight import Corner, FreeTriangles


@final
class Step:
    """A corner that is reached, and how.

    Attributes:
        corner: the corner.
        before: the step before; None at the start.
        length: the length of the path to it; None for zero.
        crossed: number of diagonals crossed.
    """

    __slots__ = ("_total", "before", "corner", "crossed", "length")

    def __init__(
        self,
        corner: Corner,
        before: Step | None,
        length: Length | None,
        total: Length,
        crossed: int,
    ) -> None:
        self.corner = corner
        self.before = before
        self.length = length
        self.crossed = crossed
        self._total = total

    def __lt__(self, other: Step) -> bool:
        return self._total < other._total

    def nodes(self) -> list[VertexId]:
        """Return the nodes of the path, from its start to here."""
        nodes = []
        step: Step | None = self
        while step is not None:
            nodes.append(step.corner[0])
            step = step.before
        return nodes[::-1]


def last_step(free: FreeTriangles, start: VertexId, goal: VertexId) -> Step | None:
    """Return the last step of a shortest path from a node to another; None if there is none."""
    points = free.points
    target = points[goal]
    far = Length(None, squared_distance(points[start], target))
    heap = [Step(corner, None, None, far, 0) for corner in free.corners_at(start)]
    best: dict[Corner, Length] = {}
    done: set[Corner] = set()
    while heap:
        step = heappop(heap)
        node = step.corner[0]
        if node == goal:
            return step
        if step.corner in done:
            continue
        done.add(step.corner)
        for corner, crossed in free.seen(step.corner):
            there = corner[0]
            if corner in done or not _leads_on(free, step, corner, goal):
                continue
            length = Length(step.length, squared_distance(points[node], points[there]))
            if corner in best and not length < best[corner]:
                continue
            best[corner] = length
            total = Length(length, squared_distance(points[there], target))
            heappush(heap, Step(corner, step, length, total, step.crossed + crossed))
    return None


def _leads_on(free: FreeTriangles, step: Step, corner: Corner, goal: VertexId) -> bool:
    """Return True if a shortest path may go on from a step to a corner."""
    there = corner[0]
    if there != goal and not free.may_pass(step.corner[0], corner):
        return False
    return step.before is None or free.is_taut(step.before.corner[0], step.corner, there)
