"""The relative hull of a polygon: the tightest loop around it that passes the others by.

The shortest closed curve in the free space that can be deformed into the boundary. In the
mixed tiling it is there to be read: the half-edges that carry the label of the cycle
pinned nowhere (`exactpt.tiling.mixed.labels`). Such a cycle passes each vertex at most
once, since two bends around one body at one place would be nested, and nothing is between
them.
"""

from __future__ import annotations

from exactpt.errors import AuditError
from exactpt.tiling.mixed.labels import LabelledMesh

__all__ = ["relative_hull"]


def relative_hull(mesh: LabelledMesh, body: int) -> list[int]:
    """The vertex ids of the relative hull of a body, counter-clockwise from the least one.

    Raises:
        AuditError: if the labels are not those of one cycle.
    """
    top, m = mesh.forest.bodies[body].first, mesh.map
    ahead: dict[int, int] = {}
    for h in m.half_edges():
        if top in mesh.labels[h]:
            if m.origin[h] in ahead:
                raise AuditError(f"the relative hull of body {body} passes {m.origin[h]} twice")
            ahead[m.origin[h]] = m.target(h)
    cycle = [min(ahead)]
    while len(cycle) < len(ahead):
        cycle.append(ahead.get(cycle[-1], cycle[0]))
        if cycle[-1] == cycle[0]:
            break
    if len(cycle) < len(ahead) or ahead[cycle[-1]] != cycle[0]:
        raise AuditError(f"the relative hull of body {body} is not one cycle: {sorted(ahead)}")
    return cycle
