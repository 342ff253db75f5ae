"""Pointed pseudo-triangulations, which have the fewest faces, from any pseudo-triangulation.

A pseudo-triangulation is *pointed* if at every vertex some tile has an angle above pi,
except where the free space itself has an angle below pi (at a reflex vertex of a polygon).
The pointed ones are those with the fewest faces: k + m + r - 2 in free space (paper, Lemma
2.1, which needs pointed, not minimal).

A diagonal whose removal leaves a tile with three corners is removed. If there is none
but a vertex is not pointed, one of its diagonals is flipped: the other diagonal of the
pseudo-quadrangle does not end there, since the vertex is a corner of it. So the degree of
the vertex decreases until two of its adjacent angles add up to more than pi; the
diagonal between these can be removed (it removes two corners at the one end and, as a
face has at least three, just one at the other).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from typing import NamedTuple

from exactpt.certificates.predicates import Predicates
from exactpt.errors import AuditError
from exactpt.indices import Ends, HalfEdge
from exactpt.kernel.budget import check_budget
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.flip import flip
from exactpt.pseudotriangulation.mesh import OUTER, Mesh
from exactpt.pseudotriangulation.shadow import shadow


class Change(NamedTuple):
    """A diagonal removed, or replaced by another.

    Attributes:
        handle: the half-edge that was removed.
        old: its ends.
        new: the ends of the diagonal in its place, or None.
        angles: the half-edges whose angles have changed; all of a tile if there was a
            triangle, since the angles of a triangle share a certificate.
    """

    handle: HalfEdge
    old: Ends
    new: Ends | None
    angles: list[HalfEdge]


def make_pointed(
    mesh: Mesh, predicates: Predicates, nearby: Iterable[HalfEdge] | None = None
) -> list[Change]:
    """Remove and flip diagonals, in place, until every vertex that can be pointed is.

    Args:
        mesh: a pseudo-triangulation.
        predicates: the predicates of the time.
        nearby: the half-edges to test, with their origins; changes propagate from them. All
            if not given.

    Returns:
        The changes, in order.

    Raises:
        AuditError: if the mesh is not a pseudo-triangulation.
    """
    if nearby is None:
        changes = _remove(mesh, predicates, mesh.diagonals())
        rings = mesh.ring_edges()
    else:
        edges = list(nearby)
        rings = [mesh.ring_edge[v] for v in sorted({mesh.map.origin[h] for h in edges})]
        changes = _remove(mesh, predicates, [min(h, twin(h)) for h in edges])
    for first in rings:
        changes += point_vertex(mesh, first, predicates)
    return changes


def point_vertex(mesh: Mesh, first: HalfEdge, predicates: Predicates) -> list[Change]:
    """Make one vertex pointed, by flips and removals of its diagonals.

    Args:
        mesh: a pseudo-triangulation, in which no diagonal can be removed.
        first: the half-edge of the ring that starts at the vertex.
        predicates: the predicates of the time.

    Returns:
        The changes, in order; none if the vertex is pointed or need not be.

    Raises:
        AuditError: if the mesh is not a pseudo-triangulation.
    """
    m = mesh.map
    changes: list[Change] = []
    while diagonals := _needless_diagonals(mesh, first, predicates):
        removed = _remove(mesh, predicates, diagonals)
        changes += removed
        if removed:
            continue
        h = diagonals[0]
        visits = shadow(mesh, h, predicates)
        if visits is None:
            raise AuditError(f"diagonal {h} has no shadow edge")
        old, new = mesh.ends(h), (m.origin[visits[0]], m.origin[visits[1]])
        angles = flip(mesh, h, visits, predicates)
        changes.append(Change(h, old, new, angles))
    return changes


def _remove(mesh: Mesh, predicates: Predicates, todo: list[HalfEdge]) -> list[Change]:
    """Remove every diagonal whose two tiles merge into one with three corners."""
    m = mesh.map
    changes = []
    pending = deque(dict.fromkeys(todo))
    waiting = set(pending)
    while pending:
        check_budget()
        h = pending.popleft()
        waiting.discard(h)
        if m.origin[h] < 0 or mesh.is_hull(h) or mesh.is_fixed(h):
            continue
        corners = _corners_after_removal(mesh, h, predicates)
        if corners is None:
            continue
        old = mesh.ends(h)
        was_triangle = any(m.following[m.following[m.following[g]]] == g for g in (h, twin(h)))
        joined = mesh.flip_out(h)
        for g, is_corner in zip(joined, corners, strict=True):
            mesh.corner[g] = is_corner
        angles = m.face(joined[0]) if was_triangle else list(joined)
        changes.append(Change(h, old, None, angles))
        # The four angles at its ends decide whether a diagonal can be removed: two are new.
        for g in joined:
            for e in (g, m.previous[g]):
                if (even := min(e, twin(e))) not in waiting:
                    waiting.add(even)
                    pending.append(even)
    return changes


def _corners_after_removal(
    mesh: Mesh, h: HalfEdge, predicates: Predicates
) -> tuple[bool, bool] | None:
    """Return the marks of the joined angles at the ends of h; None if it cannot be removed."""
    m = mesh.map
    marks = []
    lost = 0
    for g in (h, twin(h)):
        # At the origin of g: the angles of g and of the half-edge after its twin.
        before, after = m.previous[g], m.following[g ^ 1]
        a, p, b = m.origin[before], m.origin[g], m.target(after)
        joined = (
            a != b and predicates.orientation(a, p, b) > 0 and mesh.corner[g] and mesh.corner[after]
        )
        marks.append(joined)
        lost += mesh.corner[g] + mesh.corner[after] - joined
    return (marks[0], marks[1]) if lost == 3 else None


def _needless_diagonals(mesh: Mesh, first: HalfEdge, predicates: Predicates) -> list[HalfEdge]:
    """Return the diagonals in a sector of a vertex whose angles are all below pi but need not be.

    A sector lies between two successive fixed edges; if the angle of a sector is above pi,
    one of its tiles should have an angle above pi.
    """
    m = mesh.map
    v = m.origin[first]
    sector: list[HalfEdge] = []  # the half-edges of its angles, from a fixed edge on
    for h in [*m.star(first), first]:
        if sector and mesh.is_fixed(h):
            diagonals = sector[1:]
            if (
                diagonals
                and all(mesh.corner[g] for g in sector)
                and mesh.region[sector[0]] != OUTER
            ):
                # A face of the whole sector would pass v from the far edge h to the near one.
                a, b = m.target(h), m.target(sector[0])
                if a == b or predicates.orientation(a, v, b) <= 0:
                    return diagonals
            sector = []
        sector.append(h)
    return []
