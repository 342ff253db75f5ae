"""Shadow edges: the other diagonal of a pseudo-quadrangle.

Removing a diagonal s between two pseudo-triangles leaves a pseudo-quadrangle, a face with
four corners. The two corners opposite to s are joined by a geodesic inside; its one edge
that is not a boundary edge is the shadow of s (paper, section 2.2; checked against the
definition in the tests). The boundary of a pseudo-quadrangle may visit a vertex twice, so
this module works with visits, that is half-edges: those of the two faces of s, except for
s itself.
"""

from __future__ import annotations

from mypy_extensions import i64

from exactpt.certificates.predicates import Predicates
from exactpt.indices import NO_HALF_EDGE, HalfEdge, VertexId
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.mesh import Mesh


def opposite_corner(mesh: Mesh, h: HalfEdge) -> HalfEdge:
    """Return the corner of the face of h opposite to the side chain with h.

    `NO_HALF_EDGE` if the face does not have exactly three corners, as may happen between the
    repairs of one time.
    """
    following, corner = mesh.map.following, mesh.corner
    count: i64 = 0
    found, g = NO_HALF_EDGE, h
    while True:
        g = following[g]
        if corner[g]:
            count += 1
            if count == 2:
                found = g
        if g == h:
            return found if count == 3 else NO_HALF_EDGE


def shadow(mesh: Mesh, h: HalfEdge, predicates: Predicates) -> tuple[HalfEdge, HalfEdge] | None:
    """Return the visits (half-edges of the two faces of h) that the shadow edge of h joins.

    The ends start at the two opposite corners and move away from them along their side
    chains until the segment between them is tangent at both. None if the result does not
    cross h: the mesh is then not a pseudo-triangulation just after now.
    """
    here, there = opposite_corner(mesh, h), opposite_corner(mesh, twin(h))
    if here < 0 or there < 0:
        return None
    origin = mesh.map.origin
    # Visit i moves, visit j waits; then they change their parts.
    i, j = here, there
    distance: i64 = 0  # from the corner of i, negative: backwards
    other_distance: i64 = 0
    stuck: i64 = 0
    moved: i64 = 0
    left: i64 = 8 * _size(mesh, h)
    is_tangent, is_turned = True, False
    while stuck < 2 and left > 0:
        left -= 1
        y = origin[j]
        at_other = origin[i] == y  # then the other end must move
        step: i64 = 0 if at_other else _step(mesh, h, i, distance, moved, y, predicates)
        if step != 0:
            g = visit_after(mesh, h, i) if step > 0 else visit_before(mesh, h, i)
            if distance + step == 0 or not is_corner_without(mesh, h, g, predicates):
                i, distance, moved = g, distance + step, step
                stuck, is_tangent = 0, True
                continue
        stuck, moved = stuck + 1, 0
        is_tangent = is_tangent and step == 0 and not at_other
        i, j, distance, other_distance = j, i, other_distance, distance
        is_turned = not is_turned
    if is_turned:
        i, j = j, i
    u, v = mesh.ends(h)
    if not (stuck == 2 and is_tangent and crosses(origin[i], origin[j], u, v, predicates)):
        return None
    return i, j


def _size(mesh: Mesh, h: HalfEdge) -> i64:
    """Return the number of visits of the two faces of h without h."""
    following = mesh.map.following
    size: i64 = -2
    for k in range(2):
        start = h ^ k
        g = following[start]
        size += 1
        while g != start:
            size += 1
            g = following[g]
    return size


def _step(
    mesh: Mesh,
    h: HalfEdge,
    i: HalfEdge,
    distance: i64,
    moved: i64,
    y: VertexId,
    predicates: Predicates,
) -> i64:
    """Return the direction in which visit i must move for tangency to the segment to y: 1, -1 or 0.

    At its corner (distance 0) the segment must be inside the angle. On the chain after
    the corner both neighbours must be on the right of the segment, on the chain before
    it on the left: the solid side. A neighbour farther from the corner that is on the
    line for all times is nearer to y and sticks out: the end moves there. (A neighbour may be
    another visit of the vertex of y; then the other end must move.) The test that moved the
    visit here, away from its corner, shows that it need not move back.
    """
    origin = mesh.map.origin
    x, after, before = origin[i], origin[i ^ 1], origin[visit_before(mesh, h, i)]
    if distance >= 0 and y != after and predicates.orientation(x, after, y) <= 0:
        return 1
    if distance <= 0 and y != before and predicates.orientation(x, y, before) <= 0:
        return -1
    if distance > 0 and moved <= 0 and predicates.orientation(x, y, before) > 0:
        return -1
    if distance < 0 and moved >= 0 and predicates.orientation(x, y, after) < 0:
        return 1
    return 0


def crosses(x: VertexId, y: VertexId, u: VertexId, v: VertexId, predicates: Predicates) -> bool:
    """Return True if segments xy and uv cross in their interiors, or share one end."""
    if x in (u, v) or y in (u, v):
        return not ((x == u and y == v) or (x == v and y == u))
    if predicates.orientation(x, y, u) == predicates.orientation(x, y, v):
        return False
    return predicates.orientation(u, v, x) != predicates.orientation(u, v, y)


def is_tangent(mesh: Mesh, h: HalfEdge, i: HalfEdge, j: HalfEdge, predicates: Predicates) -> bool:
    """Return True if the segment between two visits at h is tangent at the first one.

    At a corner it is inside the angle; at a reflex vertex both neighbours are on one side of it.
    Permanently collinear vertices are not a tangency.

    A segment xy that is tangent at both ends is the shadow edge of h, unless it is h:

    **It lies in the pseudo-quadrangle Q.** The line xy divides Q into parts. Each is on one side
    of the line, and its vertex farthest from it is a corner of Q. A component of the intersection
    of Q and the line makes one part two, and one more where it touches a reflex vertex whose
    neighbours are on one side. If x and y were in two components, there would be
    1 + 2 + 2 parts, but one less for each of x and y that is a corner: there, a component begins.
    So there would be one part more than Q has corners that are not on the line. Hence x and y
    are in one component; for the same reason it touches no third vertex. (Nothing is assumed of
    the side chains, which may turn by more than pi.)

    **It is a diagonal of Q.** It divides Q into two faces with six corners together, two
    pseudo-triangles; and Q has two diagonals.
    """
    origin = mesh.map.origin
    x, y = origin[i], origin[j]
    after, before = origin[i ^ 1], origin[visit_before(mesh, h, i)]
    if y in (x, after, before):
        return False
    first, second = predicates.orientation(x, after, y), predicates.orientation(x, y, before)
    if first > 0 and second > 0:
        return is_corner_without(mesh, h, i, predicates)
    return first * second < 0 and not is_corner_without(mesh, h, i, predicates)


# The boundary of the two faces of a diagonal together


def visit_after(mesh: Mesh, h: HalfEdge, visit: HalfEdge) -> HalfEdge:
    """Return the visit after one, counter-clockwise around the two faces of h without h."""
    following = mesh.map.following
    g = following[visit]
    return following[g ^ 1] if g | 1 == h | 1 else g


def visit_before(mesh: Mesh, h: HalfEdge, visit: HalfEdge) -> HalfEdge:
    """Return the visit before one, counter-clockwise around the two faces of h without h."""
    previous = mesh.map.previous
    g = previous[visit]
    return previous[g ^ 1] if g | 1 == h | 1 else g


def is_corner_without(mesh: Mesh, h: HalfEdge, visit: HalfEdge, predicates: Predicates) -> bool:
    """Return True if a visit of the two faces of h is at a corner of their union.

    At an end of h itself the angles of the two faces are one.
    """
    m = mesh.map
    if visit == m.following[h] or visit == m.following[h ^ 1]:
        before = m.origin[visit_before(mesh, h, visit)]
        return predicates.orientation(before, m.origin[visit], m.origin[visit ^ 1]) > 0
    return mesh.corner[visit]


def has_visits(mesh: Mesh, h: HalfEdge, i: HalfEdge, j: HalfEdge) -> bool:
    """Return True if two half-edges are visits of the two faces of h without h."""
    t = twin(h)
    return (_is_after(mesh, h, i) or _is_after(mesh, t, i)) and (
        _is_after(mesh, h, j) or _is_after(mesh, t, j)
    )


def _is_after(mesh: Mesh, h: HalfEdge, i: HalfEdge) -> bool:
    """Return True if i is another half-edge of the face of h."""
    following = mesh.map.following
    g = following[h]
    while g not in (h, i):
        g = following[g]
    return g != h
