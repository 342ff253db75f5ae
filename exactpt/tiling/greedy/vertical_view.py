"""What a vertex sees along the vertical: from tile to tile, up to the edge of a body."""

from __future__ import annotations

from exactpt.certificates.predicates import Predicates
from exactpt.pseudotriangulation.mesh import SOLID, Mesh

__all__ = ["seen_from"]


def seen_from(mesh: Mesh, predicates: Predicates, v: int, *, up: bool) -> int | None:
    """The edge of a body above (or below) a vertex; None if there is none.

    Args:
        mesh: a tiling.
        predicates: of the time.
        v: a vertex; straight up and down from it is free space.
        up: whether to look up.

    Returns:
        The half-edge on whose left the vertex is.
    """
    h = _visit(mesh, predicates, v, up=up)
    if h is None:
        return None
    crossed: int | None = None
    while True:
        # The vertical may meet a tile twice: only what lies beyond the edge crossed last counts.
        nearest: int | None = None
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
        h = nearest ^ 1


def _visit(mesh: Mesh, predicates: Predicates, v: int, *, up: bool) -> int | None:
    """The half-edge out of a vertex whose free angle the vertical is in."""
    m = mesh.map
    wide = None
    for h in m.fan(mesh.ring_edge[v]):
        if mesh.region[h] != SOLID:
            leads_right = predicates.left_of(v, m.target(h))
            next_leads_right = predicates.left_of(v, m.origin[m.previous[h]])
            # Counter-clockwise from an edge to the right to one to the left lies "up".
            if leads_right != next_leads_right and leads_right == up:
                return h
            if not mesh.corner[h]:
                wide = h
    return wide  # all edges lead to one side; both verticals are in the one angle above pi


def _faces(mesh: Mesh, predicates: Predicates, h: int, v: int, *, up: bool) -> bool:
    """Whether an edge crosses the vertical of a vertex, above it (or below), facing it."""
    left, right = mesh.ends(h)[::-1] if up else mesh.ends(h)
    return (
        predicates.left_of(left, v)
        and predicates.left_of(v, right)
        and predicates.sign(*mesh.ends(h), v) > 0
    )


def _is_nearer(mesh: Mesh, predicates: Predicates, g: int, h: int) -> bool:
    """Of two edges that face a vertex, whether g is nearer: an end of it is on the side of it."""
    left_of, sign = predicates.left_of, predicates.sign
    (a, b), (c, d) = mesh.ends(g), mesh.ends(h)
    if left_of(b, a):
        a, b, c, d = b, a, d, c
    # From left to right they are ab and cd; an end of one of them is between those of the other.
    if b != d:
        return sign(*mesh.ends(h), b) > 0 if left_of(b, d) else sign(*mesh.ends(g), d) <= 0
    return sign(*mesh.ends(h), a) > 0 if left_of(c, a) else sign(*mesh.ends(g), c) <= 0
