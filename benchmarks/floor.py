"""The cost of the certificates of an event alone, without a queue and a tiling to repair."""

from __future__ import annotations

from random import Random
from typing import Final

from benchmarks.timing import per_event, timed
from exactpt.indices import Triple, VertexId
from exactpt.tiling.tiling import Tiling

__all__ = ["CERTIFICATES", "floor"]

CERTIFICATES: Final = 7
"""Number of certificates that an event of a crowd makes, on average."""


def floor(kinetic: Tiling, events: int) -> float:
    """Microseconds to compute as many certificates as an event makes, and their failures.

    Those of pending angles, in random order: an event anywhere may be next. The tiling is left
    as it is, and can go on.

    Args:
        kinetic: a tiling of convex bodies in linear motion, whose queue has angles only.
        events: the number of events.
    """
    rng, queue = Random(0), kinetic.queue
    angles: list[Triple] = []
    for slot in rng.choices(queue.slots(), k=CERTIFICATES * events):
        time = queue.pending(slot)
        if time is not None:
            angles.append((VertexId(time.a), VertexId(time.b), VertexId(time.c)))
    _, seconds = timed(lambda: kinetic.certifier.orientations_of_any(angles))
    return per_event(seconds, events)
