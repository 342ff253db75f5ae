"""Insertion and removal of bodies in the mixed tiling: which geodesics change.

Between a geodesic and its chain of the boundary lie the tiles of its node and of the nodes
below. A new body changes the geodesic if it intersects one of these tiles. Otherwise there is
nothing new between the two, and a shortest path in the free space remains shortest in a
smaller free space. A removed body changes the geodesic if the geodesic bends at it. The body
is on its right; the geodesic of a longer chain passes between the two, and so bends at
the body too. In either case, if the geodesic of a node changes, so do those of all its
ancestors.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import NamedTuple

from exactpt.indices import HalfEdge
from exactpt.pseudotriangulation.mesh import FREE
from exactpt.tiling.mixed.forest import RingTree
from exactpt.tiling.mixed.labels import LabelledMesh
from exactpt.tiling.mixed.tree import ROOT, TOP


class ChangedGeodesics(NamedTuple):
    """The geodesics of one body that have to be recomputed, and the chains along which.

    Attributes:
        tree: the tree of the body.
        edges: a cycle of half-edges around the body, made of geodesics that do not change.
        after: for half-edges in the cycle, the next one along the same geodesic.
        spans: for each node of the tree that has to be recomputed, its range in the cycle.
    """

    tree: RingTree
    edges: list[HalfEdge]
    after: dict[HalfEdge, HalfEdge]
    spans: dict[int, tuple[int, int]]


def nodes_changed_by_insertion(mesh: LabelledMesh, faces: Iterable[HalfEdge]) -> set[int]:
    """Return the nodes whose geodesics change when a body is added that intersects some faces."""
    return _with_ancestors(mesh, (mesh.node(h) for h in faces if mesh.region[h] == FREE))


def nodes_changed_by_removal(
    mesh: LabelledMesh, own: RingTree, sides: Iterable[HalfEdge]
) -> set[int]:
    """Return the nodes of other bodies whose geodesics change when a body is removed.

    Args:
        mesh: the tiling.
        own: the tree of the body.
        sides: the half-edges that start or end at the body.
    """
    return _with_ancestors(
        mesh, {node for h in sides for node in mesh.labels[h]}.difference(own.nodes)
    )


def _with_ancestors(mesh: LabelledMesh, nodes: Iterable[int]) -> set[int]:
    """Return some nodes with all their ancestors; -1 is not a node."""
    found: set[int] = set()
    for node in nodes:
        while node >= 0 and node not in found:
            found.add(node)
            node = mesh.forest.parent[node]  # noqa: PLW2901
    return found


def changed_geodesics(
    mesh: LabelledMesh, ring_tree: RingTree, changing: set[int]
) -> ChangedGeodesics:
    """Return the chains of a body: geodesics of its highest unchanged nodes, in order."""
    tree = ring_tree.tree
    edges: list[HalfEdge] = []
    after: dict[HalfEdge, HalfEdge] = {}
    spans: dict[int, tuple[int, int]] = {}

    def descend(k: int) -> None:
        if ring_tree.nodes[k] not in changing:
            geodesic = mesh.geodesic(ring_tree, k)
            edges.extend(geodesic)
            after.update(pairwise(geodesic))
            return
        start = len(edges)
        for child in (tree.child[k], tree.child[k] + 1):
            descend(child)
        spans[k] = (start, len(edges))

    descend(ROOT)
    spans[TOP] = (0, len(edges))
    return ChangedGeodesics(ring_tree, edges, after, spans)
