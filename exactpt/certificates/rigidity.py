"""What never changes: orientations and x-orders that need no certificate."""

from __future__ import annotations

from exactpt.motion.vertex import MovingBody, Vertex


def rigid(bodies: list[MovingBody], a: Vertex, b: Vertex, c: Vertex) -> bool:
    """Return True if three vertices keep their orientation for all times, so that no zero is lost.

    Three vertices of one motion keep their distances, and the copies of one vertex their
    displacements, unless these turn independently of the motion. The copies of a point
    or a segment alone turn with it: their orientation is 0 only where the segment shrinks
    to a point, which has an event of its own (`exactpt.tiling.pieces`).
    """
    motion = a.float_track.motion
    if motion >= 0 and motion == b.float_track.motion and motion == c.float_track.motion:
        if a.is_copy_of(b) or a.is_copy_of(c):
            turns_apart = _turns_apart(bodies, a)
        else:
            turns_apart = b.is_copy_of(c) and _turns_apart(bodies, b)
        if not turns_apart:
            return True
    return a.offset is not None and a.body == b.body == c.body and bodies[a.body].body.size < 3


def _turns_apart(bodies: list[MovingBody], copy: Vertex) -> bool:
    """Return True if the displacements of a vertex's copies do not turn with its motion.

    Those of a point never turn, even if the point does; those of a segment or chain
    that deforms may turn.
    """
    moving = bodies[copy.body]
    return bool(copy.float_track.ws) if moving.body.size == 1 else moving.deforms


def keeps_x_order(bodies: list[MovingBody], a: Vertex, b: Vertex) -> bool:
    """Return True if two vertices keep the difference of their x coordinates for all times."""
    if a.offset is not None and bodies[a.body].deforms:
        return False  # its displacements turn
    p, q = a.float_track, b.float_track
    return p.motion == q.motion and p.motion >= 0 and not p.ws
