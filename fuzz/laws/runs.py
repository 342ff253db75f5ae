"""Laws about runs: what is saved, copied or changed goes on as if nothing had happened."""

from __future__ import annotations

import copy
from collections.abc import Callable
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Final

import exactpt
from exactpt import Contact, Scene, Simulation
from fuzz.laws.law import check_equal
from fuzz.laws.tilings import a_tiling
from fuzz.soak import Soak

__all__ = ["living_run_is_static", "restored_run_goes_on"]

EVENTS: Final = 12
"""Maximum number of steps until a run is saved."""

ACTIONS: Final = 12
"""Number of actions in a living run."""

LIVING: Final = ("greedy", "lazy", "mixed")


def _ignore(simulation: Simulation, contact: Contact) -> None:
    """Let a run go on after a contact as before."""


def restored_run_goes_on(scene: Scene, random: Random) -> str:
    """A run saved at some event, and its copy, have its state and go on as the run does."""
    run = Simulation(scene, tiling=a_tiling(scene, random))
    for _ in range(random.randint(0, EVENTS)):
        if not run.step():
            break
    again = _restored(run)
    copied = run.copy() if random.random() < 0.5 else copy.deepcopy(run)
    check_equal("state of the restored run", again.to_json(), run.to_json())
    respond: Callable[[Simulation, Contact], object] | None
    respond = random.choice([None, exactpt.stop, _ignore])
    events, events_restored, events_copied = (
        [event.to_json() for event in one.run(on_contact=respond)] for one in (run, again, copied)
    )
    check_equal("events after restoring", events_restored, events)
    check_equal("events of the copy", events_copied, events)
    check_equal("contacts after restoring", again.contacts, run.contacts)
    return f"{min(run.contacts, 2)} contacts, {'some' if events else 'no'} events"


def _restored(run: Simulation) -> Simulation:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "run.json"
        run.save(path)
        return Simulation.restore(path)


def living_run_is_static(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """A run in which motions, bodies, copies and saves come and go equals one built from nothing.

    It makes its own room of bodies (`fuzz.soak`), and every state is audited.
    """
    soak = Soak(random.getrandbits(32), random.choice(LIVING))
    soak.act(ACTIONS)
    return f"{soak.tiling}, {min(soak.simulation.contacts, 2)} contacts"
