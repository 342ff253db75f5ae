"""Statistics of a run: those of docs/format.md, and the measures of a kinetic data structure.

Keys, in addition to those of docs/format.md:

* ``by_kind``: number of events by kind. ``external``: number of events that change the
  tiling as users see it; ``internal``: all others (new motions, infinitesimal copies of
  vertices, extreme vertices).
* ``pending``, ``most_pending``: number of certificates in the queue, now and at most.
* ``locality``: number of pending certificates that involve one body, maximum and mean.
* ``responsiveness``: certificates computed or skipped per event.
* ``efficiency``: ratio of all events to external events.
* ``batches``: number of times at which several certificates failed; ``rebuilds``: number
  of times that the tiling was rebuilt; ``flips``: number of flips in repairs.
* ``zeros``: number of certificates decided exactly because they vanish, now or
  identically.
* ``reasons``: number of exact decisions by ``"what: why"``. What: "certificate" (a sign,
  and when it may change), "sign" (in repairs and constructions), "time" (the order of two
  events), "place" (the order along a line, coincidence), "contact" (a vertex on an edge).
  Why: "zero" (the sign is zero: collinear, equal in x or y, simultaneous, touching), "close"
  (it is not zero, but too small for the filter), "copies" (infinitesimal copies of a vertex
  of a degenerate body), "range" (numbers out of the range of the filters), "asked" (filters
  off).
"""

from __future__ import annotations

from exactpt.certificates.certifier import X_ORDER
from exactpt.kernel.counters import Counts
from exactpt.scene.scene import Scene
from exactpt.tiling.tiling import Tiling

__all__ = ["counts_of", "report"]


def report(scene: Scene, kinetic: Tiling | None) -> dict[str, object]:
    """The counts of a run so far; the tiling is None if there is none yet."""
    counts = counts_of(kinetic)
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


def counts_of(kinetic: Tiling | None) -> Counts:
    """The counts of decisions of a run so far."""
    return Counts(0, 0, {}) if kinetic is None else kinetic.vertices.counters.now()


def _locality(kinetic: Tiling) -> tuple[int, float]:
    """Maximum and mean over all bodies of the number of pending certificates that involve it."""
    vertices, queue = kinetic.vertices, kinetic.queue
    counts = [0] * len(vertices.bodies)
    for slot in queue.slots():
        time = queue.pending(slot)
        if time is None or time.a < 0:  # no certificate: the end of a piece of motion
            continue
        ids = (time.a, time.b) if time.c == X_ORDER else (time.a, time.b, time.c)
        for body in {vertices.all[v].body for v in ids if v >= 0}:
            counts[body] += 1
    return max(counts, default=0), sum(counts) / len(counts) if counts else 0.0
