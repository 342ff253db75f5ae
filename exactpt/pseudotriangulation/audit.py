"""The audit of a tiling at one instant: whether it is an embedded pseudo-triangulation."""

from __future__ import annotations

from itertools import pairwise

from exactpt.certificates.predicates import Predicates
from exactpt.errors import AuditError
from exactpt.indices import HalfEdge, VertexId
from exactpt.motion.vertices import Vertices
from exactpt.pseudotriangulation.mesh import SOLID, Mesh


def audit_angles(mesh: Mesh, predicates: Predicates) -> None:
    """Check links and marks, the sign of every marked angle, and the order around vertices.

    Raises:
        AuditError: at the first fault.
    """
    mesh.audit()
    m = mesh.map
    for h in m.half_edges():
        a, p, b = m.origin[m.previous[h]], m.origin[h], m.origin[h ^ 1]
        if (
            mesh.region[h] != SOLID
            and a != b
            and (predicates.orientation(a, p, b) > 0) != mesh.corner[h]
        ):
            raise AuditError(f"angle {h} at vertices {a}, {p}, {b} is not as marked")
    for h in mesh.ring_edges():
        audit_star(mesh, h, predicates)


def audit_star(mesh: Mesh, h: HalfEdge, predicates: Predicates) -> None:
    """Check that the star of a vertex turns once around it, counter-clockwise.

    The angles from the first half-edge to the others must increase between 0 and 2 pi.

    Raises:
        AuditError: if they do not.
    """
    m = mesh.map
    v = m.origin[h]
    targets = [m.target(g) for g in m.star(h)]
    base = targets[0]
    for u, w in pairwise(targets[1:]):
        # Angle from the first half-edge: 1 if below pi, 0 if pi, -1 if above.
        side_u, side_w = predicates.orientation(v, base, u), predicates.orientation(v, base, w)
        if side_u < side_w or (side_u == side_w and predicates.orientation(v, u, w) <= 0):
            raise AuditError(f"vertex {v}: the edges to {u} and {w} are in the wrong order")


def audit_connected(mesh: Mesh, vertices: Vertices) -> None:
    """Check that all vertices are connected, except for those in the holes of rigid bodies.

    A body inside another one is connected to nothing, though no angle need be wrong.

    Raises:
        AuditError: if they are not.
    """
    if not vertices.bodies:
        return
    holes = sum(
        len(rings) - 1
        for moving in vertices.bodies
        if not moving.is_tiled
        for rings in moving.body.parts
    )
    count = _count_components(mesh, vertices)
    if count != 1 + holes:
        raise AuditError(f"{count} components, with {holes} holes")


def _count_components(mesh: Mesh, vertices: Vertices) -> int:
    """Return the number of components of the graph of all edges."""
    m = mesh.map
    left = set(vertices.ids())
    count = 0
    while left:
        count += 1
        reached: list[VertexId] = [left.pop()]
        while reached:
            star = m.star(mesh.ring_edge[reached.pop()])
            new = left.intersection(m.target(h) for h in star)
            left -= new
            reached.extend(new)
    return count
