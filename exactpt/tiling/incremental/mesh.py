"""The mesh of an incremental pseudo-triangulation.

The edge from p to its parent in the upper tree has the half-edges 4 p (from p) and 4 p + 1,
the one in the lower tree 4 p + 2 and 4 p + 3. If these are the same edge (for the second
point, and for more points if the first ones are collinear), only the former exist.
"""

from __future__ import annotations

from collections.abc import Collection
from itertools import pairwise

from exactpt.indices import NO_VERTEX, HalfEdge, VertexId
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.mesh import FREE, OUTER, Mesh
from exactpt.tiling.incremental.fan import path
from exactpt.tiling.incremental.structure import LOWER, UPPER, IncrementalStructure


def mesh_of(structure: IncrementalStructure) -> Mesh:
    """Return the tiles Delta(p), p from the third point on, and the outer face."""
    mesh = Mesh(len(structure.order))
    points = [VertexId(p) for p in range(len(structure.order))]
    for p in points:
        for _ in structure.trees:
            mesh.add_edge(p, p, boundary=False)
    update_mesh(mesh, structure, points)
    return mesh


def update_mesh(mesh: Mesh, structure: IncrementalStructure, changed: Collection[VertexId]) -> None:
    """Update the mesh of a structure in which some points have other links than before."""
    for p in changed:
        _place_edges(mesh, structure, p)
    # The point itself; and that of whose tile the chain through it is a side.
    tiles = {*changed, *(_beside(structure, side, p) for side in (UPPER, LOWER) for p in changed)}
    for p in tiles:
        _close_tile(mesh, structure, p)


def _place_edges(mesh: Mesh, structure: IncrementalStructure, p: VertexId) -> None:
    """Give the half-edges of a point and its parents their origins."""
    upper, lower = (tree.parent[p] for tree in structure.trees)
    for h, z in ((HalfEdge(4 * p), upper), (HalfEdge(4 * p + 2), lower)):
        exists = z >= 0 and (h % 4 == 0 or z != upper)
        mesh.map.place(h, p if exists else NO_VERTEX)
        mesh.map.place(twin(h), z if exists else NO_VERTEX)


def _beside(structure: IncrementalStructure, side: int, v: VertexId) -> VertexId:
    """Return the point whose tile has the chain through v; the first one: outer face."""
    tree = structure.trees[side]
    while (z := tree.parent[v]) >= 0 and tree.last[z] == v:
        v = z
    return v if z < 0 else tree.after[v]


def _close_tile(mesh: Mesh, structure: IncrementalStructure, p: VertexId) -> None:
    """Link the half-edges of the tile of a point, or of the outer face for the first point."""
    upper, lower = structure.trees
    is_outer = upper.parent[p] < 0
    if is_outer:
        face = _sides(structure, upper.last[p], lower.last[p])
    elif upper.parent[p] != lower.parent[p]:
        down, up = _from(structure, UPPER, p), twin(_from(structure, LOWER, p))
        face = [down, *_sides(structure, upper.before[p], lower.before[p]), up]
    else:
        return
    for h, g in pairwise([*face, *face[:1]]):
        mesh.map.link(h, g)
        mesh.region[h] = OUTER if is_outer else FREE
        mesh.corner[h] = not is_outer and h in (face[0], face[1], face[-1])


def _from(structure: IncrementalStructure, side: int, p: VertexId) -> HalfEdge:
    """Return the half-edge from p to its parent in a tree."""
    upper, lower = structure.trees
    if side == LOWER and upper.parent[p] != lower.parent[p]:
        return HalfEdge(4 * p + 2)
    return HalfEdge(4 * p)


def _sides(
    structure: IncrementalStructure, upper_top: VertexId, lower_top: VertexId
) -> list[HalfEdge]:
    """Return the half-edges of a chain from its upper end to its lower one, bulging to the right.

    Args:
        structure: the structure.
        upper_top: the vertex after the upper end, if the upper side has one.
        lower_top: the vertex before the lower end, if the lower side has one.
    """
    upper, lower = structure.trees
    return [twin(_from(structure, UPPER, c)) for c in path(upper_top, upper)] + [
        _from(structure, LOWER, c) for c in reversed(list(path(lower_top, lower)))
    ]
