"""The mesh of an incremental pseudo-triangulation.

The edge from p to its parent in the upper tree has the half-edges 4 p (from p) and 4 p + 1,
the one in the lower tree 4 p + 2 and 4 p + 3. If these are the same edge (for the second
point, and for more points if the first ones are collinear), only the former exist.
"""

from __future__ import annotations

from itertools import pairwise

from exactpt.indices import NO_VERTEX, HalfEdge, VertexId
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.mesh import OUTER, Mesh
from exactpt.tiling.incremental.fan import path
from exactpt.tiling.incremental.structure import LOWER, UPPER, IncrementalStructure

__all__ = ["mesh_of"]


def mesh_of(structure: IncrementalStructure) -> Mesh:
    """The tiles Delta(p), p from the third point on, and the outer face."""
    upper, lower = structure.trees
    mesh = Mesh(len(structure.order))
    for p in map(VertexId, range(len(structure.order))):
        for tree in structure.trees:
            z = tree.parent[p]
            h = mesh.add_edge(p, z, boundary=False)
            if z < 0 or (tree is lower and z == upper.parent[p]):
                mesh.map.origin[h] = mesh.map.origin[h + 1] = NO_VERTEX
    for p in structure.order[1:]:
        if upper.parent[p] != lower.parent[p]:
            down, up = _from(structure, UPPER, p), twin(_from(structure, LOWER, p))
            face = [down, *_sides(structure, upper.before[p], lower.before[p]), up]
            _close(mesh, face)
            for h in (face[0], face[1], face[-1]):
                mesh.corner[h] = True
    first = structure.order[0] if structure.order else -1
    if len(structure.order) > 1:
        hull = _sides(structure, upper.last[first], lower.last[first])
        _close(mesh, hull)
        for h in hull:
            mesh.region[h] = OUTER
    return mesh


def _from(structure: IncrementalStructure, side: int, p: VertexId) -> HalfEdge:
    """The half-edge from p to its parent in a tree."""
    upper, lower = structure.trees
    if side == LOWER and upper.parent[p] != lower.parent[p]:
        return HalfEdge(4 * p + 2)
    return HalfEdge(4 * p)


def _sides(
    structure: IncrementalStructure, upper_top: VertexId, lower_top: VertexId
) -> list[HalfEdge]:
    """The half-edges of a chain from its upper end to its lower one, bulging to the right.

    Args:
        structure: the structure.
        upper_top: the vertex after the upper end, if the upper side has one.
        lower_top: the vertex before the lower end, if the lower side has one.
    """
    upper, lower = structure.trees
    return [twin(_from(structure, UPPER, c)) for c in path(upper_top, upper)] + [
        _from(structure, LOWER, c) for c in reversed(list(path(lower_top, lower)))
    ]


def _close(mesh: Mesh, face: list[HalfEdge]) -> None:
    for h, g in pairwise([*face, face[0]]):
        mesh.map.link(h, g)
