"""The mixed tiling of an instant: geodesics, labels, and the greedy tiling of F2."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import NamedTuple

from exactpt.tiling.build import build_mesh
from exactpt.tiling.greedy.shadow import flip_until_greedy
from exactpt.tiling.instant import Instant
from exactpt.tiling.mesh import FREE, INSIDE, SOLID, Diagonal, Mesh
from exactpt.tiling.mixed.geodesics import Geodesics
from exactpt.tiling.mixed.labels import NO_LABEL, Forest, Label
from exactpt.tiling.mixed.tree import TOP
from exactpt.tiling.plane_sweep import Sweep, SweptEdge, body_edges
from exactpt.tiling.pointed import make_pointed

__all__ = ["LabelledMesh", "flippable", "mixed_mesh"]


class LabelledMesh(NamedTuple):
    """A mixed tiling.

    Attributes:
        mesh: the tiling.
        forest: the trees of the bodies.
        labels: of each half-edge.
    """

    mesh: Mesh
    forest: Forest
    labels: list[Label]


def mixed_mesh(instant: Instant, forest: Forest | None = None) -> LabelledMesh:
    """The mixed tiling of an instant.

    Args:
        instant: the predicates.
        forest: the trees of the bodies; by default those that begin at the leftmost
            vertices, which are on the unpinned geodesic cycles.
    """
    vertices = instant.vertices
    leftmost = [_leftmost(instant, body.ring) for body in vertices.bodies]
    if forest is None:
        forest = Forest(vertices, leftmost)
    by_ends = _geodesic_labels(instant, forest, leftmost)
    swept = Sweep(instant, _f2_edges(instant, forest, by_ends), triangulate=False).run()
    boundary = {(u, vertices.all[u].ahead) for u in range(len(vertices.all))}
    bridges = [
        Diagonal(u, v, FREE)
        for u, v in by_ends
        if (u, v) not in boundary and (v, u) not in boundary and (u < v or (v, u) not in by_ends)
    ]
    inside = [
        d
        for d in Sweep(instant, body_edges(instant), triangulate=False).run()
        if d.region == INSIDE
    ]
    mesh = build_mesh(instant, [*bridges, *swept, *inside])
    labels = [
        by_ends.get((mesh.map.origin[h], mesh.map.origin[h ^ 1]), NO_LABEL)
        for h in range(len(mesh.map.origin))
    ]
    _reduce(mesh, labels, instant)
    return LabelledMesh(mesh, forest, labels)


def flippable(mesh: Mesh, labels: list[Label], h: int) -> bool:
    """Whether a half-edge is of a diagonal of F2 that is not on the convex hull."""
    return not (labels[h] or labels[h ^ 1] or mesh.is_boundary(h) or mesh.is_hull(h)) and (
        mesh.region[h] == FREE
    )


def _reduce(mesh: Mesh, labels: list[Label], instant: Instant) -> None:
    """Make what is in F2 pointed, then greedy; and what is inside bodies pointed."""

    def may_go(h: int) -> bool:
        return not mesh.is_boundary(h) and (
            mesh.region[h] == INSIDE or flippable(mesh, labels, h)
        )

    make_pointed(mesh, instant, may_go)
    flip_until_greedy(
        mesh, instant, [h for h in mesh.diagonals() if flippable(mesh, labels, h)], may_go
    )


def _leftmost(instant: Instant, ring: list[int]) -> int:
    """The position on a ring of its leftmost vertex: it is on the ring's convex hull."""
    first = 0
    for i in range(1, len(ring)):
        if instant.left_of(ring[i], ring[first]):
            first = i
    return first


def _geodesic_labels(
    instant: Instant, forest: Forest, leftmost: list[int]
) -> dict[tuple[int, int], Label]:
    """The labels by the ends of the half-edges."""
    triangulation = build_mesh(instant, Sweep(instant, body_edges(instant), triangulate=True).run())
    geodesics = Geodesics(instant, triangulation)
    sets: dict[tuple[int, int], set[int]] = {}
    for moving, (tree, first, chain), start in zip(
        instant.vertices.bodies, forest.bodies, leftmost, strict=True
    ):
        n = tree.size
        loop = [moving.ring[(start + j) % n] for j in range(n + 1)]
        for node in range(len(tree)):
            part = loop if node == TOP else chain[tree.low[node] : tree.high[node] + 1]
            for u, v in pairwise(geodesics.path(part)):
                sets.setdefault((u, v), set()).add(first + node)
    return {ends: frozenset(nodes) for ends, nodes in sets.items()}


def _f2_edges(
    instant: Instant, forest: Forest, labels: dict[tuple[int, int], Label]
) -> Iterable[SweptEdge]:
    """All labelled edges, from left to right; only what is F2 above them is to be tiled."""
    done = set()
    for u, v in labels:
        a, b = (u, v) if instant.left_of(u, v) else (v, u)
        if (a, b) in done:
            continue
        done.add((a, b))
        above = forest.tile(labels.get((a, b), NO_LABEL), labels.get((b, a), NO_LABEL))
        is_f2 = above is not None and above.body < 0
        yield SweptEdge(a, b, FREE if is_f2 else SOLID)
