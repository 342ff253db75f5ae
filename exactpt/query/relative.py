"""The relative hull of a body: the shortest closed curve homotopic to its boundary in free space.

The mixed tiling contains it: it consists of the half-edges that carry the label of the unpinned
cycle (`exactpt.tiling.mixed.labels`). The curve may pass a vertex of its own body twice, where
it closes a pocket; the free side, on its left, then determines the next half-edge.
"""

from __future__ import annotations

from exactpt.errors import AuditError
from exactpt.tiling.mixed.labels import LabelledMesh
from exactpt.tiling.mixed.tree import TOP

__all__ = ["relative_hull", "top_nodes"]


def top_nodes(mesh: LabelledMesh) -> list[int]:
    """For each body, the root node of its tree: the node whose cycle is its relative hull."""
    return [tree.nodes[TOP] for tree in mesh.forest.bodies]


def relative_hull(mesh: LabelledMesh, top: int) -> list[int]:
    """The vertex ids along the relative hull of a body, counter-clockwise.

    Args:
        mesh: a mixed tiling.
        top: the root node of the body, see `top_nodes`.

    Raises:
        AuditError: if the labels do not form a single cycle.
    """
    m = mesh.map
    cycle = [h for h in m.half_edges() if top in mesh.labels[h]]
    ordered = [cycle[0]]
    while True:
        # The next half-edge is the first one clockwise from the reversed current one.
        g = m.following[ordered[-1]]
        while top not in mesh.labels[g]:
            g = m.following[g ^ 1]
        if g == ordered[0]:
            break
        ordered.append(g)
        if len(ordered) > len(cycle):
            break
    if sorted(ordered) != cycle:
        raise AuditError(f"the relative hull of node {top} is not one cycle: {cycle}")
    return [m.origin[h] for h in ordered]
