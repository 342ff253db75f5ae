"""Flips: a diagonal between two tiles replaced by its shadow edge, until the tiling is greedy."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from exactpt.certificates.predicates import Predicates
from exactpt.errors import AuditError
from exactpt.indices import Ends, HalfEdge, VertexId
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.shadow import shadow


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
        mesh.corner[a] = (
            predicates.orientation(m.origin[m.previous[a]], m.origin[a], m.origin[a ^ 1]) > 0
        )
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


class Shadows:
    """Provides `flip_until_greedy` with shadow edges of diagonals; a subclass may store them."""

    def is_greedy(self, h: HalfEdge) -> bool:  # noqa: ARG002 - nothing is known
        """Return True if a diagonal is known to have a shadow of larger theta."""
        return False

    def find(
        self, mesh: Mesh, h: HalfEdge, predicates: Predicates
    ) -> tuple[HalfEdge, HalfEdge] | None:
        """Return the visits that the shadow edge of a diagonal joins; None if it has no shadow."""
        return shadow(mesh, h, predicates)

    def keep(self, h: HalfEdge, visits: tuple[HalfEdge, HalfEdge]) -> None:
        """Record the visits of a diagonal that has been found greedy."""


def flip_until_greedy(
    mesh: Mesh,
    predicates: Predicates,
    candidates: Sequence[HalfEdge],
    shadows: Shadows | None = None,
) -> list[Flip]:
    """Flip diagonals whose shadow has smaller theta, until there is none.

    Each flip lowers the multiset of the theta, so the process terminates; a
    pseudo-triangulation without such a diagonal is the greedy one (paper, Lemma 4.2: the
    local property).

    Args:
        mesh: a pseudo-triangulation just after the time of the predicates.
        predicates: the predicates just after that time.
        candidates: the edges (even half-edges, each once) to test first.
        shadows: the known shadow edges; new ones are reported to it.

    Returns:
        The flips, in order.

    Raises:
        AuditError: if a diagonal has no shadow: the mesh is not a pseudo-triangulation.
    """
    if shadows is None:
        shadows = Shadows()
    todo, k = list(candidates), 0
    waiting: set[HalfEdge] | None = None  # those still to be tested, from the first flip on
    flips: list[Flip] = []
    while k < len(todo):
        h = todo[k]
        k += 1
        if waiting is not None:
            waiting.discard(h)
        if mesh.is_fixed(h) or mesh.map.origin[h] < 0 or mesh.is_hull(h) or shadows.is_greedy(h):
            continue
        visits = shadows.find(mesh, h, predicates)
        if visits is None:
            raise AuditError(f"diagonal {h} has no shadow edge")
        old, new = mesh.ends(h), (mesh.map.origin[visits[0]], mesh.map.origin[visits[1]])
        if not _theta_is_smaller(mesh, new, old, predicates):
            shadows.keep(h, visits)
            continue
        changed = flip(mesh, h, visits, predicates)
        flips.append(Flip(old, new, changed))
        if waiting is None:
            waiting = set(todo[k:])
        for g in (*mesh.map.face(changed[0]), *mesh.map.face(changed[1])):
            edge = min(g, twin(g))
            if edge not in waiting:
                waiting.add(edge)
                todo.append(edge)
    return flips


def _theta_is_smaller(mesh: Mesh, s: Ends, t: Ends, predicates: Predicates) -> bool:
    """Return True if theta(s) < theta(t), for two edges that cross.

    If they are permanently parallel, they join copies of the same two vertices. Inflation
    then changes the slope by (h(b) - h(a)) / L, where h is +1 for a body below the line
    (`exactpt.tiling.greedy.slope`); larger slope is smaller theta.
    """
    a, b = s
    c, d = t
    if not predicates.left_of(a, b):
        a, b = b, a
    if not predicates.left_of(c, d):
        c, d = d, c
    turn = predicates.cross_sign(a, b, c, d)
    if turn == 0:
        turn = _rise(mesh, c, d, predicates) - _rise(mesh, a, b, predicates)
    return turn < 0


def _rise(mesh: Mesh, a: VertexId, b: VertexId, predicates: Predicates) -> int:
    """Return the difference h(b) - h(a) for a bitangent from a to b; see `_theta_is_smaller`."""
    return _side(mesh, a, a, b, predicates) - _side(mesh, b, a, b, predicates)


def _side(mesh: Mesh, v: VertexId, a: VertexId, b: VertexId, predicates: Predicates) -> int:
    """1 if the body of v, an end of the bitangent ab, is on its left; -1 if on its right."""
    m = mesh.map
    neighbours = [m.target(h) for h in m.star(mesh.ring_edge[v]) if mesh.is_boundary(h)]
    return next((s for n in neighbours if (s := predicates.orientation(a, b, n))), 0)
