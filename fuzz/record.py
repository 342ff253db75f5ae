"""Records: digests of all output of runs, to compare two versions of the code.

A refactoring must not change any output. A record has one line for every scene and tiling;
two records with the same seed are equal if and only if all event logs, contacts, tilings and
saved simulations are, byte for byte.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from exactpt import Contact, Scene, Simulation, first_contact
from exactpt.kernel.numbers import QQ
from fuzz.changes.excerpts import scene_of
from fuzz.witnesses import tilings_of

__all__ = ["differences", "digest", "record"]

SHARES: Final = (0, 1, 2, 3)
"""Quarters of the time up to the contact at which tiling and saved simulation are recorded."""


def record(families: Sequence[str], count: int, seed: int = 0) -> Iterator[str]:
    """The lines of a record of the first scenes, the families taken in turn."""
    for number in range(count):
        family, turn = families[number % len(families)], seed + number // len(families)
        scene = scene_of(family, turn)
        contact = first_contact(scene, method="pairs")
        last = scene.end if contact is None else contact.time.canonical_interval()[0]
        yield f"{family} {turn} pairs {digest(_told(contact))}"
        for tiling in tilings_of(scene):
            run = _run(scene, tiling, last)
            printed = " ".join(f"{name} {digest(data)}" for name, data in run.items())
            yield f"{family} {turn} {tiling} {printed}"


def differences(old: Sequence[str], new: Sequence[str]) -> list[str]:
    """The differences of two records: lines of the new one, and lines missing from it."""
    known, made = set(old), set(new)
    changed = [f"+ {line}" for line in new if line not in known]
    return changed + [f"- {line}" for line in old if line not in made]


def _told(contact: Contact | None) -> object:
    return None if contact is None else contact.to_json()


def _run(scene: Scene, tiling: str, last: QQ) -> dict[str, object]:
    """The events, the contact, tilings and saved simulations of a run."""
    simulation = Simulation(scene, tiling=tiling)
    events: list[object] = []
    tilings: list[object] = []
    saved: list[object] = []
    for share in SHARES:
        time = scene.start + (last - scene.start) * share / len(SHARES)
        events += [event.to_json() for event in simulation.run(time)]
        if simulation.contact is None:
            tilings.append(simulation.snapshot().to_json())
            saved.append(_saved(simulation))
    events += [event.to_json() for event in simulation.run()]
    contact = _told(simulation.contact)
    return {"events": events, "contact": contact, "tilings": tilings, "saved": saved}


def _saved(simulation: Simulation) -> object:
    """The data of the saved simulation."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "run.json"
        simulation.save(path)
        data: object = json.loads(path.read_text(encoding="utf-8"))
    return data


def digest(data: object) -> str:
    """Return a digest of JSON values."""
    return hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()[:16]
