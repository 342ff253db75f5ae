"""The tiling at a degenerate instant, the time of an event itself.

A kinetic tiling is the one just after the current time. Where certificates vanish at that
time, some of its edges pass through vertices, and some of its faces have no area.
`close_at` gives the tiling of the instant itself: vertices collinear then are treated
like permanently collinear vertices (`exactpt.certificates.perturbation`), so that the middle
one of three sticks out.
"""

from __future__ import annotations

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.perturbation import comes_first
from exactpt.errors import AuditError
from exactpt.indices import HalfEdge, Triple
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.motion.vertex import Vertex
from exactpt.planar.halfedge import found, twin
from exactpt.pseudotriangulation.mesh import FREE, INSIDE, Mesh


def close_at(mesh: Mesh, instant: PredicatesAt) -> bool:
    """Collapse, in place, every corner whose angle is 0 or pi at an instant.

    Args:
        mesh: a pseudo-triangulation just before or just after the instant.
        instant: predicates at the time itself.

    Returns:
        Whether anything changed.

    Raises:
        AuditError: if a corner closes on the edge of a body, which is a contact; or if
            corners open again without end.
    """
    half_edges = mesh.map.half_edges()
    closed = {h for h in half_edges if _has_closed(mesh, h, instant)}
    changed = bool(closed)
    rounds = 0
    while closed:
        rounds += 1
        if rounds > 2 * len(half_edges):
            raise AuditError("corners do not stay closed")
        h = _first(mesh, closed, instant)
        for g in _collapse(mesh, h, instant):
            closed.discard(g)
            if mesh.map.origin[g] >= 0 and _has_closed(mesh, g, instant):
                closed.add(g)
    return changed


def _angle(mesh: Mesh, h: HalfEdge) -> Triple:
    m = mesh.map
    return m.origin[m.previous[h]], m.origin[h], m.origin[h ^ 1]


def _has_closed(mesh: Mesh, h: HalfEdge, instant: PredicatesAt) -> bool:
    a, p, b = _angle(mesh, h)
    may_close = mesh.region[h] in (FREE, INSIDE) and mesh.corner[h] and a != b
    return may_close and instant.orientation(a, p, b) <= 0


def _first(mesh: Mesh, closed: set[HalfEdge], instant: PredicatesAt) -> HalfEdge:
    """Return the least closed corner; of infinitesimal copies, the first to close."""
    all_vertices = instant.vertices.all
    number = AlgebraicNumber(instant.time)
    first, *others = sorted(closed)

    def vertices(h: HalfEdge) -> tuple[Vertex, Vertex, Vertex]:
        a, p, b = _angle(mesh, h)
        return all_vertices[a], all_vertices[p], all_vertices[b]

    p = vertices(first)
    for h in others:
        q = vertices(h)
        if {(v.body, v.index) for v in p} == {(v.body, v.index) for v in q} and comes_first(
            q, -1, p, -1, number
        ):
            first, p = h, q
    return first


def _collapse(mesh: Mesh, h: HalfEdge, instant: PredicatesAt) -> list[HalfEdge]:
    """Collapse one corner; returns the half-edges whose angles may have changed."""
    m = mesh.map
    a, p, b = _angle(mesh, h)
    before, face = m.previous[h], m.face(h)
    if len(face) == 3:
        middle = instant.middle(a, p, b)
        opposite = (g for g in face if middle not in mesh.ends(g))
        edge = found(opposite, "edge opposite of the vertex in the middle")
    else:
        origin_moves = instant.nearer(p, a, b)
        edge = h if origin_moves else before
    if mesh.is_boundary(edge):
        raise AuditError(f"a vertex is on the body edge {mesh.ends(edge)}")
    nearby = [*face, *m.face(twin(edge))]
    if len(face) == 3:
        mesh.dissolve_triangle(edge)
    else:
        mesh.collapse_corner(h, origin_moves=edge == h)
    return nearby
