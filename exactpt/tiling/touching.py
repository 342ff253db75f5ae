"""Contacts at the time of an event: which vanishing angles may be one, and what touches there.

That none is missed is proved in `exactpt.certificates.incidences`.
"""

from __future__ import annotations

from collections.abc import Iterable

from exactpt.certificates.coincidence import nearer, strictly_between
from exactpt.certificates.incidences import touches
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.events import ContactFound

__all__ = ["look_for_contact", "may_touch", "report_touches"]


def look_for_contact(
    certified: CertifiedMesh, angles: Iterable[int], shrinking: Iterable[int]
) -> None:
    """Report what touches now near angles that vanish, and segments that shrink.

    Raises:
        ContactFound: if anything does.
    """
    candidates: set[int] = set()
    for h in angles:
        candidates.update(certified.straight_run(h))
    for i in shrinking:
        candidates.update(certified.vertices.bodies[i].ring)
    if candidates:
        report_touches(certified, candidates)


def may_touch(certified: CertifiedMesh, h: int) -> bool:
    """Whether the vanishing of one angle alone may be a contact.

    A corner that closes on a body edge is one; so are vertices that coincide, and a reflex
    angle that folds up instead of straightening (a spike of a deforming body). A corner that
    closes on a diagonal is none: what it meets beyond the diagonal would pinch a face there,
    with an angle that vanishes now too.
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
        return True  # of a deforming body; its other vertices may be on the line too
    return not strictly_between(certified.certifier, a, p, b)


def report_touches(certified: CertifiedMesh, candidates: Iterable[int]) -> None:
    """Report what touches now of some vertices.

    Raises:
        ContactFound: if anything does.
    """
    found = touches(certified.certifier, certified.vertices, candidates)
    if found:
        raise ContactFound(found)
