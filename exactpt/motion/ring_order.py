"""The order of a body's vertices along its rings: the body is on the left of its edges."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from exactpt.geometry.polygon import is_counter_clockwise
from exactpt.indices import VertexId
from exactpt.kernel.numbers import QQ
from exactpt.motion.infinitesimal import ring_of_copies

if TYPE_CHECKING:
    from exactpt.motion.body import Body

__all__ = ["ring_indices", "rings_of"]


def ring_indices(body: Body, t: QQ, *, plain: bool = False) -> list[int]:
    """The indices of a body's vertices, with copies where it needs them, along its rings.

    Args:
        body: the body.
        t: a rational time at which its edges do not cross.
        plain: whether the vertices are taken as they are: those of points.
    """
    if plain:
        return list(range(body.size))
    if not body.has_interior:
        return ring_of_copies(body.size)
    positions = _turned_alike(body, t)
    if body.has_rings:
        return [i for rings in body.parts for ring in _turned(rings, positions) for i in ring]
    ring = list(range(body.size))
    return ring if is_counter_clockwise(positions) else ring[::-1]


def _turned_alike(body: Body, t: QQ) -> Sequence[tuple[QQ | float, QQ | float]]:
    """Positions of the vertices at a time; those at rest, if it is only translated."""
    moved = body._piece_after(t).translation
    return body._at(t) if moved is None else list(zip(*moved[0], strict=True))


def rings_of(body: Body, ring: list[VertexId]) -> list[list[VertexId]]:
    """The ids of each ring of a body, given those of all."""
    if not body.has_rings:
        return [ring]
    return [ring[part.start : part.stop] for part in body.rings]


def _turned(
    rings: Sequence[range], positions: Sequence[tuple[QQ | float, QQ | float]]
) -> list[list[int]]:
    """The rings of a part, the outline counter-clockwise, holes clockwise."""
    turned = []
    for k, ring in enumerate(rings):
        turns_left = is_counter_clockwise([positions[i] for i in ring])
        indices = list(ring)
        turned.append(indices if turns_left == (k == 0) else indices[::-1])
    return turned
