"""The last line of a certificate: two bodies that share a point, or come near, soon after L."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import product
from typing import final

import numpy as np

from exactpt.check_apart import are_near, require_passage
from exactpt.motion.track import Incidence
from exactpt.proof.frame import TINY
from exactpt.proof.paths import Item, Paths
from exactpt.proof_scene import Poly, Rejected, Whole, surrounds, written


@final
class Meetings:
    """Last lines, each checked as the checker does it."""

    def __init__(self, paths: Paths) -> None:
        self._paths = paths

    def items(self, body: int) -> range:
        """Return the numbers of the items of a body."""
        first = self._paths.first_item
        return range(first[body], first[body + 1])

    def _items_at(self, body: int, vertex: int) -> list[int]:
        """Return those of them with a vertex."""
        v = self._paths.first[body] + vertex
        return [k for k in self.items(body) if v in self._paths.items[k].ends]

    def at(
        self, pairs: Sequence[tuple[int, int]], touches: Sequence[Incidence], t: Fraction
    ) -> str:
        """Return a last line by two bodies at a time: first by items that touch.

        Raises:
            Rejected: if there is none.
        """
        first, items = self._paths.first, self._paths.items
        for i, v, j, edge, u in touches:
            far = self._paths.distance + self._paths.bodies[i].radius + self._paths.bodies[j].radius
            others = [self.items(j)[edge]] if edge >= 0 else self._items_at(j, u)
            for k, m in product(self._items_at(i, v), others):
                ends = *items[k].ends, *items[m].ends
                if are_near([self._paths.place(w, t) for w in ends], far):
                    return f"meet {written(t)} {k} {m}"
        place = {
            v: self._paths.place(v, t)
            for k in {k for pair in pairs for k in pair}
            for v in range(first[k], first[k] + self._paths.bodies[k].size)
        }
        for i, j in pairs:
            far = self._paths.distance + self._paths.bodies[i].radius + self._paths.bodies[j].radius
            for k, m in _candidates(self.items(i), self.items(j), items, place, float(far)):
                if are_near([place[v] for v in (*items[k].ends, *items[m].ends)], far):
                    return f"meet {written(t)} {k} {m}"
            for one, other in ((i, j), (j, i)):
                body = self._paths.bodies[other]
                rings = [[place[first[other] + v] for v in ring] for ring in body.rings]
                for v in (first[one] + ring[0] for ring in self._paths.bodies[one].rings):
                    odd = sum(surrounds(ring, place[v]) for ring in rings) % 2
                    if body.has_interior and odd:
                        return f"inside {written(t)} {v} {other}"
        raise Rejected("no two bodies share a point")

    def passage(
        self, v: int, item: int, until: Fraction, low: Fraction, high: Fraction, end: Fraction
    ) -> str:
        """Return a last line by a vertex that passes through an edge.

        Raises:
            Rejected: if it is not one.
        """
        _, a, b = self._paths.items[item]
        for u in (v, a):
            breaks = self._paths.of(u).breaks
            until = max([until, *(q for q in breaks if q <= low)])
            end = min([end, *(q for q in breaks if q >= high)])
        tracks = [tuple(map(Poly, self._paths.track(u, until))) for u in (v, a, b)]
        require_passage(tracks, until, end)  # type: ignore[arg-type]
        return f"cross {written(until)} {written(end)} {v} {item}"


def _candidates(
    one: Sequence[int],
    other: Sequence[int],
    items: Sequence[Item],
    place: Mapping[int, Whole],
    far: float,
) -> list[tuple[int, int]]:
    """Return pairs of items whose boxes come near each other, by doubles; the nearest first."""
    at = {v: (x / w, y / w) for v, (x, y, w) in place.items()}
    ends = [np.array([[at[v] for v in items[k].ends] for k in some]) for some in (one, other)]
    low, high = ([e.min(axis=1) for e in ends], [e.max(axis=1) for e in ends])
    gaps = np.maximum(low[0][:, None] - high[1], low[1] - high[0][:, None]).clip(0)
    apart = np.hypot(gaps[..., 0], gaps[..., 1])
    size = far + max(float(np.abs(e).max()) for e in ends)
    near = apart <= far + 1e-9 * size + TINY  # the exact test decides about these
    order = sorted(np.argwhere(near).tolist(), key=lambda km: float(apart[km[0], km[1]]))
    return [(one[k], other[m]) for k, m in order]
