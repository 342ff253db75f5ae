"""Certificates of bodies: the end of a piece of motion, and the loss of the interior."""

from __future__ import annotations

from exactpt.certificates.certificate import MOTION, SHRINK, pack
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventTime
from exactpt.motion.vertex import MovingBody
from exactpt.tiling.clock import Clock


def certify_piece(clock: Clock, moving: MovingBody, i: int) -> None:
    """Schedule the end of body i's current piece of motion, and the loss of its interior.

    A segment may shrink to a point, and a triangle may become flat; the interior of every
    other body that deforms is tiled, so that angles of its tiles fail in that case.
    """
    loss = _loss_of_interior(clock.certifier, moving) if moving.deforms else None
    clock.table.schedule(pack(SHRINK, i), loss)
    clock.table.schedule(pack(MOTION, i), clock.end_of_piece(moving))


def _loss_of_interior(certifier: Certifier, moving: MovingBody) -> EventTime | None:
    if moving.body.size == 2:
        return certifier.first_coincidence(moving.ring[0], moving.ring[2])
    if moving.body.size == 3 and moving.body.closed:
        return certifier.orientation(*moving.ring)[1]
    return None
