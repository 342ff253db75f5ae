"""Shadow edges and flips: the other diagonal of a pseudo-quadrangle.

Removing a diagonal s between two pseudo-triangles leaves a pseudo-quadrangle, a face with
four corners. The two corners opposite to s are joined by a geodesic inside; its one edge
that is not a boundary edge is the shadow of s (paper, section 2.2; checked against the
definition in the tests). The boundary of a pseudo-quadrangle may visit a vertex twice, so
this module works with visits, that is half-edges.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterable
from typing import NamedTuple

from exactpt.certificates.predicates import Predicates
from exactpt.errors import AuditError
from exactpt.indices import NO_HALF_EDGE, Ends, HalfEdge, Triple, VertexId
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.mesh import Mesh

__all__ = [
    "Flip",
    "crosses",
    "flip",
    "flip_until_greedy",
    "opposite_corner",
    "shadow",
    "tangency",
]


def opposite_corner(mesh: Mesh, h: HalfEdge) -> HalfEdge:
    """The corner of the face of h opposite to the side chain with h.

    `NO_HALF_EDGE` if the face does not have exactly three corners, as may happen between the
    repairs of one time.
    """
    following, corner = mesh.map.following, mesh.corner
    count, found, g = 0, NO_HALF_EDGE, h
    while True:
        g = following[g]
        if corner[g]:
            count += 1
            if count == 2:
                found = g
        if g == h:
            return found if count == 3 else NO_HALF_EDGE


def shadow(mesh: Mesh, h: HalfEdge, predicates: Predicates) -> tuple[HalfEdge, HalfEdge] | None:
    """The visits (half-edges of the two faces of h) that the shadow edge of h joins.

    The ends start at the two opposite corners and move away from them along their side
    chains until the segment between them is tangent at both. None if the result does not
    cross h: the mesh is then not a pseudo-triangulation just after now.
    """
    m, t = mesh.map, twin(h)
    here, there = opposite_corner(mesh, h), opposite_corner(mesh, t)
    if here < 0 or there < 0:
        return None
    cycle = _cycle(mesh, h, here)
    n = len(cycle)
    points = [m.origin[g] for g in cycle]
    is_corner = [mesh.corner[g] for g in cycle]
    for g in (m.following[h], m.following[t]):  # two angles have merged here
        k = cycle.index(g)
        is_corner[k] = predicates.sign(points[k - 1], points[k], points[(k + 1) % n]) > 0
    # Visit i moves, visit j waits; then they change their parts.
    i, j = 0, cycle.index(there)
    distance = other_distance = 0  # from their corners, negative: backwards
    stuck = steps = moved = 0
    is_tangent, is_turned = True, False
    while stuck < 2 and steps < 8 * n:
        steps += 1
        at_other = points[i] == points[j]  # then the other end must move
        step = 0 if at_other else _step(points, i, distance, moved, points[j], predicates)
        if step and (not is_corner[(i + step) % n] or distance + step == 0):
            i, distance, moved = (i + step) % n, distance + step, step
            stuck, is_tangent = 0, True
        else:
            stuck, moved = stuck + 1, 0
            is_tangent = is_tangent and step == 0 and not at_other
            i, j, distance, other_distance = j, i, other_distance, distance
            is_turned = not is_turned
    if is_turned:
        i, j = j, i
    if not (stuck == 2 and is_tangent and crosses(points[i], points[j], *mesh.ends(h), predicates)):
        return None
    return cycle[i], cycle[j]


def tangency(mesh: Mesh, h: HalfEdge, visits: tuple[HalfEdge, HalfEdge]) -> list[Triple]:
    """The four triples whose orientations certify that a shadow edge is tangent at both ends.

    Each end gives two, with its neighbours before and after it on the boundary of the two
    faces of h. Empty if the faces do not have both visits.
    """
    i, j = visits
    if not _has_visits(mesh, h, i, j):
        return []
    m = mesh.map
    x, y = m.origin[i], m.origin[j]
    return [
        (x, m.origin[i ^ 1], y),
        (x, y, _before(mesh, h, i)),
        (y, m.origin[j ^ 1], x),
        (y, x, _before(mesh, h, j)),
    ]


def _has_visits(mesh: Mesh, h: HalfEdge, i: HalfEdge, j: HalfEdge) -> bool:
    """Whether two visits are on the boundary of the union of the two faces of h."""
    following, t = mesh.map.following, twin(h)
    missing = 1 if i == j else 2
    g = following[h]
    while True:
        if g == h:  # at the origin of h: continue in the other face
            g = following[t]
        if g == t:
            return False
        if g in (i, j):
            missing -= 1
            if missing == 0:
                return True
        g = following[g]


def _before(mesh: Mesh, h: HalfEdge, visit: HalfEdge) -> VertexId:
    """The vertex before a visit on the boundary of the union of the two faces of h."""
    m, t = mesh.map, twin(h)
    g = m.previous[visit]
    if g in (h, t):
        g = m.previous[g ^ 1]
    return m.origin[g]


def _cycle(mesh: Mesh, h: HalfEdge, start: HalfEdge) -> list[HalfEdge]:
    """The visits around the union of the two faces of h, counter-clockwise from ``start``."""
    following, t = mesh.map.following, twin(h)
    cycle = [start]
    g = following[start]
    while True:
        if g == h:  # at the origin of h: continue in the other face
            g = following[t]
        elif g == t:
            g = following[h]
        if g == start:
            return cycle
        cycle.append(g)
        g = following[g]


def _step(
    points: list[VertexId], i: int, distance: int, moved: int, y: VertexId, predicates: Predicates
) -> int:
    """The direction in which visit i must move for tangency to the segment to y: 1, -1 or 0.

    At its corner (distance 0) the segment must be inside the angle. On the chain after
    the corner both neighbours must be on the right of the segment, on the chain before
    it on the left: the solid side. A neighbour farther from the corner that is on the
    line for ever is nearer to y and sticks out: the end moves there. (A neighbour may be
    another visit of the vertex of y; then the other end must move.) The test that moved the
    visit here, away from its corner, shows that it need not move back.
    """
    x, after, before = points[i], points[(i + 1) % len(points)], points[i - 1]
    if distance >= 0 and y != after and predicates.sign(x, after, y) <= 0:
        return 1
    if distance <= 0 and y != before and predicates.sign(x, y, before) <= 0:
        return -1
    if distance > 0 and moved <= 0 and predicates.sign(x, y, before) > 0:
        return -1
    if distance < 0 and moved >= 0 and predicates.sign(x, y, after) < 0:
        return 1
    return 0


def crosses(x: VertexId, y: VertexId, u: VertexId, v: VertexId, predicates: Predicates) -> bool:
    """Whether segments xy and uv cross in their interiors, or share one end."""
    if x in (u, v) or y in (u, v):
        return {x, y} != {u, v}
    if predicates.sign(x, y, u) == predicates.sign(x, y, v):
        return False
    return predicates.sign(u, v, x) != predicates.sign(u, v, y)


def flip(
    mesh: Mesh, h: HalfEdge, visits: tuple[HalfEdge, HalfEdge], predicates: Predicates
) -> list[HalfEdge]:
    """Replace diagonal h by the segment between two visits of its faces.

    Returns:
        The half-edges whose angles have changed, the first one of the new diagonal. If one
        of the two faces was a triangle, these are all angles of both new faces.
    """
    m = mesh.map
    was_triangle = any(m.following[m.following[m.following[g]]] == g for g in (h, twin(h)))
    g, k = visits
    joined = mesh.flip_out(h)
    e = mesh.flip_in(g, k)
    changed = [e, twin(e), g, k, *[a for a in joined if a not in visits]]
    for a in changed:
        mesh.corner[a] = predicates.sign(m.origin[m.previous[a]], m.origin[a], m.origin[a ^ 1]) > 0
    if was_triangle:
        changed += [a for a in (*m.face(e), *m.face(twin(e))) if a not in changed]
    return changed


class Flip(NamedTuple):
    """A diagonal replaced by its shadow.

    Attributes:
        old, new: the ends of the diagonal before and after.
        changed: the half-edges whose angles have changed.
    """

    old: Ends
    new: Ends
    changed: list[HalfEdge]


def flip_until_greedy(
    mesh: Mesh,
    predicates: Predicates,
    candidates: Iterable[HalfEdge],
    shadows: dict[HalfEdge, tuple[HalfEdge, HalfEdge]] | None = None,
    is_known: Callable[[HalfEdge], bool] | None = None,
) -> list[Flip]:
    """Flip diagonals whose shadow has smaller theta, until there is none.

    Each flip lowers the multiset of the theta, so the process terminates; a
    pseudo-triangulation without such a diagonal is the greedy one (paper, Lemma 4.2: the
    local property).

    Args:
        mesh: a pseudo-triangulation just after the time of the predicates.
        predicates: the predicates just after that time.
        candidates: half-edges of the diagonals to test first.
        shadows: receives the visits of the shadow of each diagonal that was tested, is not
            known and remains.
        is_known: whether a diagonal is known to have a shadow of larger theta.

    Returns:
        The flips, in order.

    Raises:
        AuditError: if a diagonal has no shadow: the mesh is not a pseudo-triangulation.
    """
    todo = OrderedDict.fromkeys(min(h, twin(h)) for h in candidates)
    flips = []
    while todo:
        h, _ = todo.popitem(last=False)
        if mesh.is_fixed(h) or mesh.map.origin[h] < 0 or mesh.is_hull(h):
            continue
        if is_known is not None and is_known(h):
            if shadows is not None:
                shadows.pop(h, None)  # computed before a flip nearby
            continue
        visits = shadow(mesh, h, predicates)
        if visits is None:
            raise AuditError(f"diagonal {h} has no shadow edge")
        old, new = mesh.ends(h), (mesh.map.origin[visits[0]], mesh.map.origin[visits[1]])
        if _theta_is_smaller(mesh, new, old, predicates):
            changed = flip(mesh, h, visits, predicates)
            flips.append(Flip(old, new, changed))
            e = changed[0]
            for g in (*mesh.map.face(e), *mesh.map.face(twin(e))):
                todo.setdefault(min(g, twin(g)))
        elif shadows is not None:
            shadows[h] = visits
    return flips


def _theta_is_smaller(mesh: Mesh, s: Ends, t: Ends, predicates: Predicates) -> bool:
    """Whether theta(s) < theta(t), for two edges that cross.

    If they are parallel for ever, they join copies of the same two vertices. Inflation
    then changes the slope by (h(b) - h(a)) / L, where h is +1 for a body below the line
    (`exactpt.tiling.greedy.slope`); larger slope is smaller theta.
    """
    a, b = s if predicates.left_of(*s) else s[::-1]
    c, d = t if predicates.left_of(*t) else t[::-1]
    turn = predicates.turn(a, b, c, d)
    if turn == 0:
        turn = _rise(mesh, c, d, predicates) - _rise(mesh, a, b, predicates)
    return turn < 0


def _rise(mesh: Mesh, a: VertexId, b: VertexId, predicates: Predicates) -> int:
    """The difference h(b) - h(a) for a bitangent from a to b; see `_theta_is_smaller`."""
    return _side(mesh, a, a, b, predicates) - _side(mesh, b, a, b, predicates)


def _side(mesh: Mesh, v: VertexId, a: VertexId, b: VertexId, predicates: Predicates) -> int:
    """1 if the body of v, an end of the bitangent ab, is on its left; -1 if on its right."""
    m = mesh.map
    neighbours = [m.target(h) for h in m.star(mesh.ring_edge[v]) if mesh.is_boundary(h)]
    return next((s for n in neighbours if (s := predicates.sign(a, b, n))), 0)
