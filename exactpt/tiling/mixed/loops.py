"""The relative hull of a polygon: the tightest loop around it that passes the others by.

The shortest closed curve in the free space that can be deformed into the boundary. In the
mixed tiling it is there to be read: the half-edges that carry the label of the cycle
pinned nowhere (`exactpt.tiling.mixed.labels`). It may pass a vertex of its own body twice,
where a mouth is pulled shut: what is on its left tells how it goes on.
"""

from __future__ import annotations

from collections.abc import Sequence

from exactpt.errors import AuditError
from exactpt.planar.halfedge import PlanarMap

__all__ = ["loop_along"]


def loop_along(m: PlanarMap, labels: Sequence[frozenset[int]], top: int) -> list[int]:
    """The vertex ids along the cycle of a node that is pinned nowhere, counter-clockwise.

    Raises:
        AuditError: if the labels are not those of one cycle.
    """
    cycle = [h for h in m.half_edges() if top in labels[h]]
    ordered = [cycle[0]]
    while True:
        # The first one to the left: clockwise from where it comes from.
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
