"""The order of a body's vertices along its rings: the body is on the left of its edges."""

from __future__ import annotations

from typing import TYPE_CHECKING

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
    piece = body.exact_piece_after(t)
    turned: list[int] = []
    for rings in body.parts:
        for k, ring in enumerate(rings):
            is_outline = k == 0
            turned += ring if piece.turns_left(ring, t) == is_outline else ring[::-1]
    return turned


def rings_of(body: Body, ring: list[VertexId]) -> list[list[VertexId]]:
    """Return the ids of each ring of a body, given those of all."""
    if not body.has_rings:
        return [ring]
    return [ring[part.start : part.stop] for part in body.rings]
