"""The state of a run as JSON data, exactly, and back."""

from __future__ import annotations

from exactpt.kernel.budget import Budget
from exactpt.kernel.counters import Counts
from exactpt.kernel.numbers import parse_rational
from exactpt.scene.scene import Scene
from exactpt.simulation.living import Choice, LivingScene
from exactpt.simulation.met import Met
from exactpt.simulation.running import Run
from exactpt.simulation.saved import (
    Data,
    contact_from_json,
    event_from_json,
    number_from_json,
    number_to_json,
    tiling_from_json,
    tiling_to_json,
)
from exactpt.tiling.report import counts_of


def run_to_json(run: Run, scene: object) -> Data:
    """Return the state of a run, with a given representation of its scene.

    Raises:
        InputError: if the run was interrupted in the middle of an event.
    """
    run.check_whole()
    living = run.living
    counts = counts_of(living.tiling)
    return {
        "name": living.name,
        "tiling": living.choice.asked,
        "exact_only": living.choice.exact_only,
        "margin": str(run.margin),
        "scene": scene,
        "contact": None if run.contact is None else run.contact.to_json(),
        "met": _met_to_json(run.met, living),
        "pending": [event.to_json() for event in run.pending],
        "counts": {
            "contacts": run.contacts,
            "changes": living.changes,
            "exact": counts.exact,
            "filtered": counts.filtered,
            "reasons": dict(counts.reasons),
        },
        "state": None if living.tiling is None else tiling_to_json(living.tiling),
    }


def run_from_json(data: Data, scene: Scene, budget: Budget) -> Run:
    """Return the run of a scene with a saved state."""
    counts, exact_only = data["counts"], data["exact_only"]
    choice = Choice(data["tiling"], data["name"], exact_only)
    kinetic = data["state"] and tiling_from_json(
        data["state"], scene.bodies, scene._end, exact_only=exact_only
    )
    if kinetic is not None:
        before = Counts(counts["exact"], counts["filtered"], counts["reasons"])
        kinetic.vertices.counters.set(before)
    run = Run(LivingScene(scene, kinetic, choice, counts["changes"]), budget)
    run.margin = parse_rational(data["margin"])
    run.pending.extend(map(event_from_json, data["pending"]))
    run.contact = data["contact"] and contact_from_json(data["contact"])
    run.contacts = counts["contacts"]
    run.met = data["met"] and _met_from_json(data["met"], run.living)
    return run


def _met_to_json(met: Met | None, living: LivingScene) -> Data | None:
    """Return the last contact with a response; None if it can no longer recur."""
    if met is None or not met.may_recur(living):
        return None
    return {"time": number_to_json(met.time), "bodies": sorted(met.bodies)}


def _met_from_json(data: Data, living: LivingScene) -> Met:
    bodies = {name: living.body(name) for name in data["bodies"]}
    return Met(number_from_json(data["time"]), bodies)
