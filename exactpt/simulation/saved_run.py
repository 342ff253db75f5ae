"""The state of a run as JSON data, exactly, and back."""

from __future__ import annotations

from exactpt.kernel.budget import Budget
from exactpt.kernel.counters import Counts
from exactpt.kernel.numbers import parse_rational
from exactpt.scene.scene import Scene
from exactpt.simulation.mutable_scene import Choice, MutableScene
from exactpt.simulation.reported_contact import ReportedContact
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
    mutable = run.mutable
    counts = counts_of(mutable.tiling)
    return {
        "name": mutable.name,
        "tiling": mutable.choice.requested,
        "exact_only": mutable.choice.exact_only,
        "margin": str(run.margin),
        "scene": scene,
        "contact": None if run.contact is None else run.contact.to_json(),
        "met": _reported_to_json(run.reported, mutable),
        "pending": [event.to_json() for event in run.pending],
        "counts": {
            "contacts": run.contacts,
            "changes": mutable.changes,
            "exact": counts.exact,
            "filtered": counts.filtered,
            "reasons": dict(counts.reasons),
        },
        "state": None if mutable.tiling is None else tiling_to_json(mutable.tiling),
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
    run = Run(MutableScene(scene, kinetic, choice, counts["changes"]), budget)
    run.margin = parse_rational(data["margin"])
    run.pending.extend(map(event_from_json, data["pending"]))
    run.contact = data["contact"] and contact_from_json(data["contact"])
    run.contacts = counts["contacts"]
    run.reported = data["met"] and _reported_from_json(data["met"], run.mutable)
    return run


def _reported_to_json(reported: ReportedContact | None, mutable: MutableScene) -> Data | None:
    """Return the last contact with a response; None if it can no longer recur."""
    if reported is None or not reported.may_recur(mutable):
        return None
    return {"time": number_to_json(reported.time), "bodies": sorted(reported.bodies)}


def _reported_from_json(data: Data, mutable: MutableScene) -> ReportedContact:
    bodies = {name: mutable.body(name) for name in data["bodies"]}
    return ReportedContact(number_from_json(data["time"]), bodies)
