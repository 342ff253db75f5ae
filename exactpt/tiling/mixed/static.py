"""The mixed tiling of an instant: geodesics, labels, and the greedy tiling of F2."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain, pairwise

from exactpt.certificates.at_time import PredicatesAt
from exactpt.indices import Ends
from exactpt.kernel.budget import check_budget
from exactpt.pseudotriangulation.build import build_mesh
from exactpt.pseudotriangulation.flip import flip_until_greedy
from exactpt.pseudotriangulation.mesh import FREE, INSIDE, SOLID, Diagonal
from exactpt.pseudotriangulation.plane_sweep import Sweep, SweptEdge, body_edges
from exactpt.pseudotriangulation.pointed import make_pointed
from exactpt.tiling.mixed.forest import NO_LABEL, Forest, Label
from exactpt.tiling.mixed.geodesics import Geodesics
from exactpt.tiling.mixed.labels import LabelledMesh
from exactpt.tiling.mixed.tree import ROOT, TOP


def mixed_mesh(instant: PredicatesAt) -> LabelledMesh:
    """Return the mixed tiling of an instant."""
    vertices = instant.vertices
    forest = Forest(vertices)
    by_ends = _geodesic_labels(instant, forest)
    swept = Sweep(instant, _f2_edges(instant, forest, by_ends)).run()
    boundary = {(u, vertices.ahead(u)) for u in vertices.ids()}
    bridges = [
        Diagonal(u, v, FREE)
        for u, v in by_ends
        if (u, v) not in boundary and (v, u) not in boundary and (u < v or (v, u) not in by_ends)
    ]
    inside = [d for d in Sweep(instant, body_edges(instant)).run() if d.region == INSIDE]
    mesh = LabelledMesh(len(vertices.all), forest)
    build_mesh(instant, [*bridges, *swept, *inside], mesh)
    for h in mesh.map.half_edges():
        mesh.labels[h] = by_ends.get((mesh.map.origin[h], mesh.map.origin[h ^ 1]), NO_LABEL)
    make_pointed(mesh, instant)
    flip_until_greedy(mesh, instant, mesh.flippable())
    return mesh


def _geodesic_labels(instant: PredicatesAt, forest: Forest) -> dict[Ends, Label]:
    """Return the labels by the ends of the half-edges."""
    triangulation = build_mesh(instant, Sweep(instant, body_edges(instant), triangulate=True).run())
    triangles = {h for h in triangulation.map.half_edges() if triangulation.region[h] == FREE}
    geodesics = Geodesics(instant, triangulation, triangles)
    sets: dict[Ends, set[int]] = {}
    for tree, nodes, vertices, is_hole in chain.from_iterable(forest.bodies):
        check_budget()
        ring = [triangulation.ring_edge[v] for v in vertices[:-1]]
        cycle = (geodesics.around_contents if is_hole else geodesics.from_leftmost)(ring)
        for k, node in enumerate(nodes):
            part = cycle if k == TOP else ring[tree.low[k] : tree.high[k]]
            if k <= ROOT and not cycle:
                continue  # the loops around nothing are points
            for ends in pairwise(geodesics.path(part)):
                sets.setdefault(ends, set()).add(node)
    return {ends: frozenset(nodes) for ends, nodes in sets.items()}


def _f2_edges(
    instant: PredicatesAt, forest: Forest, labels: dict[Ends, Label]
) -> Iterable[SweptEdge]:
    """Yield all labelled edges, from left to right; only the parts of F2 above are tiled."""
    done = set()
    for u, v in labels:
        a, b = (u, v) if instant.left_of(u, v) else (v, u)
        if (a, b) in done:
            continue
        done.add((a, b))
        above = forest.node(labels.get((a, b), NO_LABEL), labels.get((b, a), NO_LABEL))
        yield SweptEdge(a, b, FREE if above < 0 else SOLID)
