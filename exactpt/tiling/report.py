"""Statistics of a run; docs/howto/simulation.md explains the keys."""

from __future__ import annotations

from exactpt.certificates.certifier import X_ORDER
from exactpt.geometry.predicates import orientation
from exactpt.indices import VertexId
from exactpt.kernel.counters import Counts
from exactpt.kernel.numbers import shorten
from exactpt.motion.vertices import MovingBody
from exactpt.scene.scene import Scene
from exactpt.tiling.catalogue import Bodies, has_convex_rules
from exactpt.tiling.tiling import Tiling


def report(scene: Scene, kinetic: Tiling | None) -> dict[str, object]:
    """Return the counts of a run so far; the tiling is None if there is none yet."""
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
    fan = {} if kinetic.fan is None else {"fan_changes": kinetic.fan.changes}
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
        **fan,
    }


def rules_of(kinetic: Tiling, *, is_auto: bool) -> dict[str, object]:
    """Return the class of the rules of a tiling, and why it was chosen.

    Args:
        kinetic: the tiling.
        is_auto: whether "auto" was requested.
    """
    entry = kinetic.entry
    fits = {Bodies.POINTS: "all bodies are points", Bodies.CONVEX: "all bodies stay convex"}
    why = fits.get(entry.bodies, f"{entry.name} is for any bodies")
    if entry.bodies is Bodies.ANY and (is_auto or has_convex_rules(entry.name)):
        name = next((m.body.name for m in kinetic.vertices.bodies if _may_bend(m)), None)
        if name is not None:  # the body may have been removed since
            why = f"body {shorten(name)} need not stay convex"
    return {"tiling": entry.name, "rules": entry.place.partition(":")[2], "why": why}


def _may_bend(moving: MovingBody) -> bool:
    """Return True unless a body is a point, a segment or a polygon that stays convex."""
    body = moving.body
    if moving.is_tiled or body.has_rings or body.size < 3 or not body.closed:
        return moving.is_tiled or body.size > 2
    points = body.exact_at(moving.since)
    sides = (orientation(points[i - 2], points[i - 1], p) for i, p in enumerate(points))
    return {1, -1}.issubset(sides)


def counts_of(kinetic: Tiling | None) -> Counts:
    """Return the counts of decisions of a run so far."""
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
        for body in {vertices.all[VertexId(v)].body for v in ids if v >= 0}:
            counts[body] += 1
    return max(counts, default=0), sum(counts) / len(counts) if counts else 0.0
