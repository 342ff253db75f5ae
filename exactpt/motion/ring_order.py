"""The order of a body's vertices along its rings: the body is on the left of its edges."""

from __future__ import annotations

from typing import TYPE_CHECKING

from exactpt.geometry.simple import orientation_of_doubles
from exactpt.kernel.numbers import QQ

if TYPE_CHECKING:
    from exactpt.indices import VertexId
    from exactpt.motion.body import Body


def ring_indices(body: Body, t: QQ, *, plain: bool = False) -> list[int]:
    """Return the indices of a body's vertices, with copies where it needs them, along its rings.

    Outlines are counter-clockwise, holes clockwise.

    Args:
        body: the body.
        t: a rational time at which its edges do not cross.
        plain: whether the vertices are taken as they are: those of points.
    """
    if plain:
        return list(range(body.size))
    if not body.has_interior:
        from exactpt.motion.infinitesimal import ring_of_copies

        return ring_of_copies(body.size)
    turned: list[int] = []
    for rings in body.parts:
        for k, ring in enumerate(rings):
            is_outline = k == 0
            turned += ring if turns_left(body, ring, t) == is_outline else ring[::-1]
    return turned


def turns_left(body: Body, ring: range, t: QQ) -> bool:
    """Return True if a ring of a body with interior is counter-clockwise at a time."""
    moved = body._piece_after(t).translation
    if moved is not None:
        xs, ys, is_exact = moved[0]
        some = slice(ring.start, ring.stop)
        turn = orientation_of_doubles(xs[some], ys[some], is_exact=is_exact)
        if turn:
            return turn > 0
    from exactpt.geometry.polygon import is_counter_clockwise

    return is_counter_clockwise(body._at(t)[ring.start : ring.stop])


def rings_of(body: Body, ring: list[VertexId]) -> list[list[VertexId]]:
    """Return the ids of each ring of a body, given those of all."""
    if not body.has_rings:
        return [ring]
    return [ring[part.start : part.stop] for part in body.rings]
