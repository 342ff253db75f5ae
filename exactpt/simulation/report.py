"""The figures of a run: as in docs/format.md, and the measures of a kinetic data structure."""

from __future__ import annotations

from exactpt.certificates.certifier import X_ORDER
from exactpt.kernel.counters import Counts
from exactpt.scene.scene import Scene
from exactpt.tiling.tiling import Tiling

__all__ = ["report"]


def report(scene: Scene, kinetic: Tiling | None, counts: Counts) -> dict[str, object]:
    """The counts of a run so far.

    Keys, besides those of docs/format.md:

    * ``by_kind``: events by kind. ``external``: those that change the tiling as others see
      it; ``internal``: the rest (new motions, copies of thin vertices, extremes).
    * ``pending``, ``most_pending``: certificates that may fail, now and at most.
    * ``locality``: how many of them involve one body now, at most and on average.
    * ``responsiveness``: certificates computed or skipped an event.
    * ``efficiency``: all events to external ones.
    * ``batches``: times at which several certificates failed; ``rebuilds``: how often the
      tiling was built anew; ``flips``: repair flips.
    * ``zeros``: certificates that were decided exactly because they vanish, now or for
      ever.
    * ``reasons``: the exact decisions, by ``"what: why"``. What: "certificate" (a sign, and
      when it may change), "sign" (in repairs and constructions), "time" (which of two
      events is first), "place" (the order along a line, coincidence), "contact" (a vertex
      on an edge). Why: "zero" (the answer is zero: collinear, level, at one time, touching),
      "close" (it is not, but floats cannot tell), "copies" (of a vertex of a thin body),
      "range" (numbers too large or too small for the filters), "asked" (filters off).
    """
    data: dict[str, object] = {
        "bodies": len(scene.bodies),
        "vertices": scene.vertex_count,
        "events": 0,
        "certificates": 0,
        "skipped": 0,
        "exact": counts.exact,
        "filtered": counts.filtered,
        "reasons": dict(counts.reasons),
    }
    if kinetic is None:
        return data
    stats, certifier = kinetic.stats, kinetic.certifier
    by_kind = dict(sorted(stats.events.items()))
    internal = sum(by_kind.get(kind, 0) for kind in ("internal", "motion"))
    external = stats.total - internal
    touched = certifier.made + certifier.skipped
    most, mean = _locality(kinetic)
    return data | {
        "events": stats.total,
        "certificates": certifier.made,
        "skipped": certifier.skipped,
        "by_kind": by_kind,
        "external": external,
        "internal": internal,
        "pending": len(kinetic.queue),
        "most_pending": stats.most,
        "locality": {"most": most, "mean": mean},
        "responsiveness": touched / stats.total if stats.total else 0.0,
        "efficiency": stats.total / external if external else 0.0,
        "batches": stats.batches,
        "rebuilds": stats.rebuilds,
        "flips": stats.flips,
        "zeros": certifier.zeros,
    }


def _locality(kinetic: Tiling) -> tuple[int, float]:
    """The largest and the mean number of pending certificates that involve one body."""
    vertices, queue = kinetic.vertices, kinetic.queue
    counts = [0] * len(vertices.bodies)
    for slot in queue.slots():
        time = queue.pending(slot)
        if time is None or time.a < 0:  # the end of a piece of motion
            continue
        ids = (time.a, time.b) if time.c == X_ORDER else (time.a, time.b, time.c)
        for body in {vertices.all[v].body for v in ids if v >= 0}:
            counts[body] += 1
    return max(counts, default=0), sum(counts) / len(counts) if counts else 0.0
