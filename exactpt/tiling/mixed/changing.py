"""Bodies that come and go in the mixed tiling: which geodesics change.

Between a geodesic and its chain of the boundary lie the tiles of its node and of those
below. A body that comes changes it if it meets one of these tiles. Else nothing is new
between the two, and what is as short as can be in the free space is so in less of it. A
body that goes changes it if it has bent there. The body is on its right then; what is
pulled tight around more of the boundary passes between the two, and so bends there too.
In either case, with a node all above it change.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import NamedTuple

from exactpt.pseudotriangulation.mesh import FREE
from exactpt.tiling.mixed.labels import BodyTree, LabelledMesh
from exactpt.tiling.mixed.tree import ROOT, TOP

__all__ = ["Chains", "chains_of", "nodes_left", "nodes_met"]


class Chains(NamedTuple):
    """Along what the geodesics of one body are looked for.

    Attributes:
        of: its tree.
        edges: a cycle of half-edges around it.
        after: of half-edges in the cycle, the next one along the same geodesic.
        spans: of each node of the tree that has to be looked for, its part of the cycle.
    """

    of: BodyTree
    edges: list[int]
    after: dict[int, int]
    spans: dict[int, tuple[int, int]]


def nodes_met(mesh: LabelledMesh, faces: Iterable[int]) -> set[int]:
    """The nodes whose geodesics change when a body comes that meets some faces."""
    return _up(mesh, (mesh.node(h) for h in faces if mesh.region[h] == FREE))


def nodes_left(mesh: LabelledMesh, own: BodyTree, sides: Iterable[int]) -> set[int]:
    """The nodes of other bodies whose geodesics change when a body goes.

    Args:
        mesh: the tiling.
        own: the tree of the body.
        sides: the half-edges that start or end at it.
    """
    return _up(mesh, {node for h in sides for node in mesh.labels[h]}.difference(own.nodes))


def _up(mesh: LabelledMesh, nodes: Iterable[int]) -> set[int]:
    """Some nodes and all above them; -1 is none."""
    found: set[int] = set()
    for node in nodes:
        while node >= 0 and node not in found:
            found.add(node)
            node = mesh.forest.parent[node]  # noqa: PLW2901
    return found


def chains_of(mesh: LabelledMesh, of: BodyTree, changing: set[int]) -> Chains:
    """The geodesics of the highest nodes of a body that do not change, one after the other."""
    tree = of.tree
    edges: list[int] = []
    after: dict[int, int] = {}
    spans: dict[int, tuple[int, int]] = {}

    def descend(k: int) -> None:
        if of.nodes[k] not in changing:
            geodesic = mesh.geodesic(of, k)
            edges.extend(geodesic)
            after.update(pairwise(geodesic))
            return
        start = len(edges)
        for child in (tree.child[k], tree.child[k] + 1):
            descend(child)
        spans[k] = (start, len(edges))

    descend(ROOT)
    spans[TOP] = (0, len(edges))
    return Chains(of, edges, after, spans)
