"""Contraction of the faces of a mesh to those of the unperturbed free space.

The infinitesimal copies of a vertex become one vertex; faces that have no area for all times are
left out, and edges along such a face are split at its vertices.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import pairwise
from typing import NamedTuple, TypeAlias, final

from exactpt.indices import HalfEdge
from exactpt.kernel.numbers import QQ
from exactpt.planar.halfedge import edge_key

Edge: TypeAlias = tuple[int, int]


class Cycle(NamedTuple):
    """A face with an area, or the outer face: the vertices around it, the least one first."""

    label: str
    nodes: tuple[int, ...]


class Face(NamedTuple):
    """A face of a mesh, in vertices of the scene.

    Attributes:
        label: "face", "inside" or "outer".
        around: its vertices in order.
        corners: the three corners of a pseudo-triangle; empty for any other face.
    """

    label: str
    around: list[int]
    corners: list[int]


@final
class Contraction:
    """The contracted faces of a mesh that changes, at the cost of the affected faces.

    Args:
        is_flat: whether three vertices are collinear for all times.
    """

    def __init__(self, is_flat: Callable[[int, int, int], bool]) -> None:
        self._is_flat = is_flat
        self._whole: dict[HalfEdge, tuple[str, list[int]]] = {}
        self._cycles: dict[HalfEdge, Cycle] = {}
        self._cuts: dict[Edge, dict[HalfEdge, list[int]]] = {}
        self._cutting: dict[HalfEdge, list[Edge]] = {}
        self._users: dict[Edge, set[HalfEdge]] = {}
        self._used: dict[HalfEdge, list[Edge]] = {}

    def update(
        self,
        gone: Iterable[HalfEdge],
        come: Iterable[tuple[HalfEdge, Face]],
        place: Callable[[int], tuple[QQ, QQ]],
    ) -> tuple[set[Cycle], set[Cycle]]:
        """Replace faces, and return the cycles removed and added.

        Args:
            gone: the faces removed, each by one of its half-edges.
            come: the faces added, likewise, without the interiors of rigid bodies.
            place: the position of a vertex at some time at which the mesh is valid.
        """
        before, changed, new = set[Cycle](), set[Edge](), list[HalfEdge]()
        for key in gone:
            self._whole.pop(key, None)
            self._forget(key, before)
            changed.update(self._uncut(key))
        for key, face in come:
            nodes = [v for v, w in pairwise([*face.around, face.around[0]]) if v != w]
            if not (face.corners and self._is_flat(*face.corners)):
                self._whole[key] = face.label, nodes or face.around[:1]
                new.append(key)
            elif len(set(nodes)) > 2:
                changed.update(self._cut(key, nodes, place))
        again = {key for edge in changed for key in self._users.get(edge, ())}
        for key in again:
            self._forget(key, before)
        after = {self._contract(key, place) for key in again.union(new)}
        return before - after, after - before

    def _forget(self, key: HalfEdge, before: set[Cycle]) -> None:
        """Forget the cycle of a face, if it has one; removed half-edges are added to ``before``."""
        if key in self._cycles:
            before.add(self._cycles.pop(key))
            for edge in set(self._used.pop(key)):
                self._users[edge].discard(key)
                if not self._users[edge]:
                    del self._users[edge]

    def _contract(self, key: HalfEdge, place: Callable[[int], tuple[QQ, QQ]]) -> Cycle:
        label, nodes = self._whole[key]
        used = self._used[key] = []
        edges = pairwise([*nodes, nodes[0]]) if len(nodes) > 1 else ()
        path = [w for u, v in edges for w in self._path(u, v, used, place)]
        for edge in used:
            self._users.setdefault(edge, set()).add(key)
        self._cycles[key] = cycle = Cycle(label, _from_least(path or nodes))
        return cycle

    def _cut(
        self, key: HalfEdge, nodes: list[int], place: Callable[[int], tuple[QQ, QQ]]
    ) -> list[Edge]:
        """Split the edges of a face without area at its vertices in their interiors."""
        ordered = sorted(set(nodes), key=place)
        rank = {v: i for i, v in enumerate(ordered)}
        cut = self._cutting[key] = []
        for u, v in pairwise([*nodes, nodes[0]]):
            low, high = sorted((rank[u], rank[v]))
            if high - low > 1:
                cut.append(edge_key(u, v))
                self._cuts.setdefault(cut[-1], {})[key] = ordered[low + 1 : high]
        return cut

    def _uncut(self, key: HalfEdge) -> list[Edge]:
        """Undo `_cut`."""
        cut = self._cutting.pop(key, [])
        for edge in set(cut):
            del self._cuts[edge][key]
            if not self._cuts[edge]:
                del self._cuts[edge]
        return cut

    def _path(
        self, u: int, v: int, used: list[Edge], place: Callable[[int], tuple[QQ, QQ]]
    ) -> Iterator[int]:
        """Yield the vertices from u to v along an edge with its splits, v excluded."""
        used.append(edge_key(u, v))
        inside = {w for vertices in self._cuts.get(used[-1], {}).values() for w in vertices}
        if not inside:
            yield u
            return
        along = sorted(inside, key=place, reverse=place(u) > place(v))
        for p, q in pairwise([u, *along, v]):
            yield from self._path(p, q, used, place)


def _from_least(nodes: list[int]) -> tuple[int, ...]:
    least = min(nodes)
    starts = [i for i, v in enumerate(nodes) if v == least]
    return min(tuple(nodes[i:] + nodes[:i]) for i in starts)
