"""The relative hull of a polygon: the tightest loop around it that passes the others by.

The shortest closed curve in the free space that can be deformed into the boundary. In the
mixed tiling it is there to be read: the half-edges that carry the label of the cycle
pinned nowhere (`exactpt.tiling.mixed.labels`). It may pass a vertex of its own body twice,
where a mouth is pulled shut: what is on its left tells how it goes on.
"""

from __future__ import annotations

from exactpt.errors import AuditError
from exactpt.tiling.mixed.labels import LabelledMesh
from exactpt.tiling.mixed.tree import TOP

__all__ = ["relative_hull", "top_nodes"]


def top_nodes(mesh: LabelledMesh) -> list[int]:
    """Of each body, the node whose cycle is its relative hull."""
    return [tree.nodes[TOP] for tree in mesh.forest.bodies]


def relative_hull(mesh: LabelledMesh, top: int) -> list[int]:
    """The vertex ids along the relative hull of a body, by its node, counter-clockwise.

    Raises:
        AuditError: if the labels are not those of one cycle.
    """
    m = mesh.map
    cycle = [h for h in m.half_edges() if top in mesh.labels[h]]
    ordered = [cycle[0]]
    while True:
        # The first one to the left: clockwise from where it comes from.
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
