"""Visibility from a vertex: the tile in a direction, and the body edge seen vertically."""

from __future__ import annotations

from exactpt.certificates.predicates import Predicates
from exactpt.indices import NO_VERTEX, HalfEdge, VertexId
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.mesh import FREE, SOLID, Mesh


def seen_from(mesh: Mesh, predicates: Predicates, v: VertexId, *, up: bool) -> HalfEdge | None:
    """Return the body edge vertically above (or below) a vertex; None if there is none.

    Args:
        mesh: a tiling.
        predicates: the predicates of the time.
        v: a vertex, with free space vertically above and below it.
        up: whether to look up.

    Returns:
        The half-edge that has the vertex on its left.
    """
    h = _visit(mesh, predicates, v, up=up)
    if h is None:
        return None
    crossed: HalfEdge | None = None
    while True:
        # The vertical may cross a tile twice; only edges beyond the one crossed last count.
        nearest: HalfEdge | None = None
        for g in mesh.map.face(h):
            if (
                _faces(mesh, predicates, g, v, up=up)
                and (crossed is None or _is_nearer(mesh, predicates, crossed, g))
                and (nearest is None or _is_nearer(mesh, predicates, g, nearest))
            ):
                nearest = g
        if nearest is None or mesh.is_boundary(nearest):
            return nearest
        crossed = nearest
        h = twin(nearest)


def facing_visit(
    mesh: Mesh, around: list[HalfEdge], target: VertexId, predicates: Predicates
) -> HalfEdge | None:
    """Return the half-edge out of a vertex whose free angle contains the direction to a target.

    Args:
        mesh: a tiling.
        around: some half-edges out of one vertex.
        target: another vertex.
        predicates: the predicates of the time.
    """
    m = mesh.map
    known = NO_VERTEX
    side = 0  # of the target: left or right of the direction to the vertex ``known``
    for h in around:
        if mesh.region[h] != FREE:
            continue
        p, after, before = m.origin[h], m.origin[h ^ 1], m.origin[m.previous[h]]
        if target in (after, before):
            continue
        left = (side if after == known else predicates.orientation(p, after, target)) > 0
        if mesh.corner[h] and not left:
            continue
        known, side = before, predicates.orientation(p, before, target)
        if (left and side < 0) if mesh.corner[h] else (left or side < 0):
            return h
    return None


def _visit(mesh: Mesh, predicates: Predicates, v: VertexId, *, up: bool) -> HalfEdge | None:
    """Return the half-edge out of a vertex whose angle, in free space, contains the vertical."""
    m = mesh.map
    wide = None
    for h in m.star(mesh.ring_edge[v]):
        if mesh.region[h] != SOLID:
            leads_right = predicates.left_of(v, m.target(h))
            next_leads_right = predicates.left_of(v, m.origin[m.previous[h]])
            # Counter-clockwise from an edge to the right to one to the left lies "up".
            if leads_right != next_leads_right and leads_right == up:
                return h
            if not mesh.corner[h]:
                wide = h
    return wide  # all edges lead to one side, and both verticals are in the angle above pi


def _faces(mesh: Mesh, predicates: Predicates, h: HalfEdge, v: VertexId, *, up: bool) -> bool:
    """Return True if a half-edge crosses the vertical above (or below) a vertex on its left."""
    left, right = mesh.ends(h)[::-1] if up else mesh.ends(h)
    return (
        predicates.left_of(left, v)
        and predicates.left_of(v, right)
        and predicates.orientation(*mesh.ends(h), v) > 0
    )


def _is_nearer(mesh: Mesh, predicates: Predicates, g: HalfEdge, h: HalfEdge) -> bool:
    """Return True if g is nearer than h, of two half-edges that have the vertex on their left.

    They do not cross. An end of one is vertically above or below the other, and its side decides.
    """
    left_of, sign = predicates.left_of, predicates.orientation
    (a, b), (c, d) = mesh.ends(g), mesh.ends(h)
    if left_of(b, a):
        a, b, c, d = b, a, d, c
    # From left to right they are ab and cd; an end of one of them is between those of the other.
    if b != d:
        return sign(*mesh.ends(h), b) > 0 if left_of(b, d) else sign(*mesh.ends(g), d) <= 0
    return sign(*mesh.ends(h), a) > 0 if left_of(c, a) else sign(*mesh.ends(g), c) <= 0
