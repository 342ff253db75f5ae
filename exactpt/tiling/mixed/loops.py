"""The relative hull of a body: the shortest closed curve homotopic to its boundary in free space.

The mixed tiling contains it: it consists of the half-edges that carry the label of the unpinned
cycle (`exactpt.tiling.mixed.labels`). The curve may pass a vertex of its own body twice, where
it closes a pocket; the free side, on its left, then determines the next half-edge.
"""

from __future__ import annotations

from exactpt.errors import AuditError
from exactpt.indices import VertexId
from exactpt.planar.halfedge import PlanarMap


def loop_along(m: PlanarMap, labels: list[frozenset[int]], top: int) -> list[VertexId]:
    """Return the vertex ids along the unpinned cycle of a body, counter-clockwise, by its node.

    Raises:
        AuditError: if the labels do not form a single cycle.
    """
    cycle = [h for h in m.half_edges() if top in labels[h]]
    ordered = [cycle[0]]
    while True:
        # The next half-edge is the first one clockwise from the reversed current one.
        g = m.following[ordered[-1]]
        while top not in labels[g]:
            g = m.following[g ^ 1]
        if g == ordered[0]:
            break
        ordered.append(g)
        if len(ordered) > len(cycle):
            break
    if sorted(ordered) != cycle:
        raise AuditError(f"the relative hull of node {top} is not one cycle: {cycle}")
    return [m.origin[h] for h in ordered]
