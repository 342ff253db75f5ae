"""Triangulation, in place, of the interior of a body that begins to deform."""

from __future__ import annotations

from exactpt.certificates.predicates import Predicates
from exactpt.errors import AuditError
from exactpt.indices import HalfEdge
from exactpt.kernel.budget import check_budget
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.mesh import INSIDE, Mesh


def tile_inside(mesh: Mesh, first: HalfEdge, predicates: Predicates) -> None:
    """Triangulate the solid interior of a body by ear clipping.

    Args:
        mesh: a tiling in which the face is `SOLID`.
        first: a half-edge of the ring of the body.
        predicates: the predicates of the time.

    Raises:
        AuditError: if the body is not simple at that time.
    """
    m = mesh.map
    rest = m.face(first)
    for h in rest:
        mesh.region[h] = INSIDE
        mesh.corner[h] = True
    i = misses = 0
    while len(rest) > 3:
        check_budget()
        before, h = rest[i - 1], rest[i]
        if _is_ear(mesh, rest, before, h, predicates):
            e = mesh.flip_in(m.following[h], before)
            mesh.corner[e] = mesh.corner[e ^ 1] = True
            rest[i - 1] = twin(e)
            del rest[i]
            i, misses = (i - 1) % len(rest), 0
        else:
            i, misses = (i + 1) % len(rest), misses + 1
            if misses > len(rest):
                raise AuditError(f"the ring of half-edge {first} is not simple")


def _is_ear(
    mesh: Mesh, rest: list[HalfEdge], before: HalfEdge, h: HalfEdge, predicates: Predicates
) -> bool:
    """Return True if the triangle at the origin of h lies inside and contains no other vertex."""
    sign, origin = predicates.orientation, mesh.map.origin
    a, b, c = origin[before], origin[h], origin[h ^ 1]
    if sign(a, b, c) <= 0:
        return False
    return not any(
        sign(c, a, v) >= 0 and sign(a, b, v) >= 0 and sign(b, c, v) >= 0
        for v in (origin[g] for g in rest)
        if v not in (a, b, c)
    )
