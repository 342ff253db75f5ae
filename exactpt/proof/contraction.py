"""Contraction of the faces of a mesh to those of the unperturbed free space.

The infinitesimal copies of a vertex become one vertex; faces that have no area for ever are
left out, and edges along such a face are split at its vertices.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from exactpt.kernel.numbers import QQ
from exactpt.planar.halfedge import edge_key

__all__ = ["Cycle", "Face", "contract"]


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


def contract(
    faces: Sequence[Face],
    is_flat: Callable[[int, int, int], bool],
    places: Callable[[], Sequence[tuple[QQ, QQ]]],
) -> set[Cycle]:
    """The faces that have an area, and the outer face.

    Args:
        faces: the faces of a mesh, without the interiors of rigid bodies.
        is_flat: whether three vertices are collinear for ever.
        places: gives the positions of all vertices at some time at which the mesh is valid.
    """
    cuts: dict[tuple[int, int], set[int]] = {}
    whole = []
    at: Sequence[tuple[QQ, QQ]] = ()
    for face in faces:
        nodes = [v for v, w in pairwise([*face.around, face.around[0]]) if v != w]
        if face.corners and is_flat(*face.corners):
            if len(set(nodes)) > 2:
                at = at or places()
                _cut(nodes, at, cuts)
        else:
            whole.append((face.label, nodes or face.around[:1]))
    found = set()
    for label, nodes in whole:
        edges = pairwise([*nodes, nodes[0]]) if cuts else ()
        cut = [w for u, v in edges for w in _path(u, v, cuts, at)]
        found.add(Cycle(label, _from_least(cut or nodes)))
    return found


def _from_least(nodes: list[int]) -> tuple[int, ...]:
    least = min(nodes)
    starts = [i for i, v in enumerate(nodes) if v == least]
    return min(tuple(nodes[i:] + nodes[:i]) for i in starts)


def _cut(
    nodes: list[int], at: Sequence[tuple[QQ, QQ]], cuts: dict[tuple[int, int], set[int]]
) -> None:
    """Split the edges of a face without area at its vertices in their interiors."""
    ordered = sorted(set(nodes), key=lambda v: at[v])
    rank = {v: i for i, v in enumerate(ordered)}
    for u, v in pairwise([*nodes, nodes[0]]):
        low, high = sorted((rank[u], rank[v]))
        if high - low > 1:
            cuts.setdefault(edge_key(u, v), set()).update(ordered[low + 1 : high])


def _path(
    u: int, v: int, cuts: dict[tuple[int, int], set[int]], at: Sequence[tuple[QQ, QQ]]
) -> Iterator[int]:
    """The vertices from u to v along an edge with its splits, v excluded."""
    inside = cuts.get(edge_key(u, v))
    if not inside:
        yield u
        return
    along = sorted(inside, key=lambda w: at[w], reverse=at[u] > at[v])
    for p, q in pairwise([u, *along, v]):
        yield from _path(p, q, cuts, at)
