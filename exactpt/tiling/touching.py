"""Contacts at the time of an event: the vanishing angles that may be contacts, and features.

The proof that no contact is missed is in `exactpt.certificates.incidences`.
"""

from __future__ import annotations

from collections.abc import Iterable

from exactpt.certificates.coincidence import nearer, strictly_between
from exactpt.certificates.incidences import touches
from exactpt.indices import HalfEdge, VertexId
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.events import ContactFound


def look_for_contact(
    certified: CertifiedMesh, angles: Iterable[HalfEdge], shrinking: Iterable[int]
) -> None:
    """Look for contacts at angles that vanish now, and in bodies that lose their interior.

    Raises:
        ContactFound: if there is a contact.
    """
    candidates: set[VertexId] = set()
    for h in angles:
        candidates.update(certified.collinear_run(h))
    for i in shrinking:
        candidates.update(certified.vertices.bodies[i].ring)
    if candidates:
        report_touches(certified, candidates)


def may_touch(certified: CertifiedMesh, h: HalfEdge) -> bool:
    """Return True if there may be a contact at an angle that is the only one to vanish now.

    There is one if a corner closes on a body edge, if vertices coincide, or if a reflex angle
    becomes 2 pi instead of pi (a spike of a deforming body). There is none if a corner closes
    on a diagonal: a feature touched beyond the diagonal would pinch a face there, and another
    angle would vanish now.
    """
    if certified.is_triangle(h):
        return True
    mesh = certified.mesh
    a, p, b = certified.vertices_of(h)
    if mesh.corner[h]:
        side = nearer(certified.certifier, p, a, b)
        far = h if side > 0 else mesh.map.previous[h]
        return side == 0 or mesh.is_boundary(far)
    if mesh.is_boundary(h) and mesh.is_boundary(mesh.map.previous[h]):
        return True  # of a deforming body, more of whose vertices may be on the line
    return not strictly_between(certified.certifier, a, p, b)


def report_touches(certified: CertifiedMesh, candidates: Iterable[VertexId]) -> None:
    """Look for contacts among some vertices and the body edges between them.

    Raises:
        ContactFound: if there is a contact.
    """
    found = touches(certified.certifier, certified.vertices, candidates)
    if found:
        raise ContactFound(found)
