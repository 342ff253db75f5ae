"""Normals of contacts, from the definition: positions just before the contact, and its edges."""

from __future__ import annotations

import math
from typing import Final

from exactpt import Contact, ContactPoint, Scene
from exactpt.kernel.numbers import QQ, power_of_two

__all__ = ["wrong_normal"]

BEFORE: Final = power_of_two(-90)
"""How long before a contact a vertex is on the side of an edge from which it has come: in tiny
scenes the zeros of orientations are much farther apart."""

TOLERANCE: Final = 1e-9


def wrong_normal(scene: Scene, contact: Contact | None) -> str | None:
    """Return the fault of the normals of a contact after the start; None if nothing is.

    The normal of a vertex on an edge of a body without radius is a unit vector perpendicular to the
    edge. If the body has no interior, it points to the side from which the vertex comes, to the
    right of the edge if that moves along the line.
    """
    if contact is None or not contact.time > scene.start:
        return None
    time = contact.time
    while time.high - time.low > BEFORE / 2**20:
        time.refine()
    for pair in contact.pairs:
        bodies = scene.body(pair.body), scene.body(pair.other)
        if pair.edge is not None and not any(body.radius for body in bodies):
            side = None if bodies[1].has_interior else _side(scene, pair, time.low - BEFORE)
            if not _is_right(scene, pair, float(time), side):
                return "normal"
    return None


def _places(scene: Scene, pair: ContactPoint, at: QQ) -> list[tuple[QQ, QQ]]:
    """Return the positions of the vertex, and of the ends of the edge."""
    edge, other = pair.edge or 0, scene.body(pair.other)
    places = other.exact_at(at)
    return [scene.body(pair.body).exact_at(at)[pair.vertex], places[edge],
            places[other.end_of_edge(edge)]]  # fmt: skip


def _side(scene: Scene, pair: ContactPoint, at: QQ) -> int:
    """Return 1 if the vertex is on the left of the edge, else -1."""
    (x, y), (ax, ay), (bx, by) = _places(scene, pair, at)
    return 1 if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0 else -1


def _is_right(scene: Scene, pair: ContactPoint, at: float, side: int | None) -> bool:
    """Return True if a normal is perpendicular to the edge, and on the given side of it."""
    if pair.normal is None:
        return False
    (nx, ny), places = pair.normal, _places(scene, pair, min(QQ(at), scene.exact_end))
    (ax, ay), (bx, by) = ((float(x), float(y)) for x, y in places[1:])
    ux, uy = bx - ax, by - ay
    size = math.hypot(ux, uy)
    unit = abs(math.hypot(nx, ny) - 1) < TOLERANCE and abs(nx * ux + ny * uy) < TOLERANCE * size
    return unit and (side is None or side * (ux * ny - uy * nx) > 0)
