"""Certificates of bodies: when a piece of motion ends, and when a body loses its inside."""

from __future__ import annotations

from exactpt.certificates.certificate import MOTION, SHRINK, pack
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventTime
from exactpt.motion.vertices import MovingBody
from exactpt.tiling.clock import Clock

__all__ = ["certify_piece"]


def certify_piece(clock: Clock, moving: MovingBody, i: int) -> None:
    """Schedule when body i's current piece ends, and when the body loses its inside.

    That may be so of a segment that shrinks to a point, and a triangle that becomes
    flat: the only bodies that deform so and whose inside is not tiled.
    """
    collapse = _collapse(clock.certifier, moving) if moving.deforms else None
    clock.table.schedule(pack(SHRINK, i), collapse)
    clock.table.schedule(pack(MOTION, i), clock.end_of_piece(moving))


def _collapse(certifier: Certifier, moving: MovingBody) -> EventTime | None:
    if moving.body.size == 2:
        return certifier.first_coincidence(moving.ring[0], moving.ring[2])
    if moving.body.size == 3 and moving.body.closed:
        return certifier.orientation(*moving.ring)[1]
    return None
