"""The state of a run as JSON data, exactly, and back."""

from __future__ import annotations

from typing import Final

from exactpt.kernel.budget import Budget
from exactpt.kernel.counters import Counts
from exactpt.kernel.stored import Stored
from exactpt.scene.groups import NO_TILING, refuse_groups
from exactpt.scene.scene import Scene
from exactpt.simulation.mutable_scene import Choice, MutableScene
from exactpt.simulation.reported_contact import ReportedContact
from exactpt.simulation.running import Run
from exactpt.simulation.saved import (
    Data,
    contact_from_json,
    counts_from_json,
    event_from_json,
    number_from_json,
    number_to_json,
    tiling_from_json,
    tiling_to_json,
)
from exactpt.tiling.catalogue import known
from exactpt.tiling.report import counts_of

KEYS: Final = (
    "name", "tiling", "exact_only", "begun", "scene",
    "contact", "met", "pending", "counts", "state",
)  # fmt: skip


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
        "begun": str(run.begun),
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


def run_from_json(data: Stored, scene: Scene, budget: Budget) -> Run:
    """Return the run of a scene with a saved state.

    Raises:
        InputError: if a value is not what `run_to_json` writes, or contradicts the scene.
    """
    data.with_keys(*KEYS)
    refuse_groups(scene, NO_TILING)
    counts, state, contact, met = data["counts"], data["state"], data["contact"], data["met"]
    exact_only = data["exact_only"].flag()
    kinetic = None
    if not state.is_null:
        kinetic = tiling_from_json(state, scene.bodies, scene.exact_end, exact_only=exact_only)
        reasons = counts_from_json(counts["reasons"])
        before = Counts(counts["exact"].integer(0), counts["filtered"].integer(0), reasons)
        kinetic.vertices.counters.set(before)
    elif contact.is_null:
        raise state.refused("a tiling, since bodies do not touch at the start")
    has_fan = kinetic is not None and kinetic.fan is not None
    requested, name = data["tiling"].text(known()), data["name"].text(known())
    choice = Choice(requested, name, exact_only, has_fan)
    begun = data["begun"].rational()
    if begun > scene.exact_start:
        raise data["begun"].refused("a time up to the start of the scene")
    mutable = MutableScene(scene, kinetic, choice, counts["changes"].integer(0))
    run = Run(mutable, budget, begun=begun)
    run.pending.extend(map(event_from_json, data["pending"].entries()))
    run.contact = None if contact.is_null else contact_from_json(contact, scene.bodies)
    run.contacts = counts["contacts"].integer(0)
    run.reported = None if met.is_null else _reported_from_json(met, run.mutable)
    return run


def _reported_to_json(reported: ReportedContact | None, mutable: MutableScene) -> Data | None:
    """Return the last contact with a response; None if it can no longer recur."""
    if reported is None or not reported.may_recur(mutable):
        return None
    return {"time": number_to_json(reported.time), "bodies": sorted(reported.bodies)}


def _reported_from_json(data: Stored, mutable: MutableScene) -> ReportedContact:
    names = [entry.text() for entry in data["bodies"].entries()]
    bodies = {name: mutable.body(name) for name in names}
    return ReportedContact(number_from_json(data["time"]), bodies)
