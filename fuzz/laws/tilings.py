"""Laws about tilings: kinetic equals static, filters decide as exact arithmetic does."""

from __future__ import annotations

from random import Random

from exactpt import Scene, Simulation
from exactpt.testing import audit
from fuzz.laws.law import refuse_unless
from fuzz.witnesses import Difference, tilings_of

__all__ = ["a_tiling", "filters_decide_exactly", "kinetic_is_static"]


def a_tiling(scene: Scene, random: Random) -> str:
    """Return the name of a tiling that supports a scene.

    Raises:
        LeftOutError: if there is none.
    """
    names = tilings_of(scene)
    refuse_unless(names)
    return random.choice(names)


def kinetic_is_static(scene: Scene, random: Random) -> str:
    """Between any two events a tiling equals the one built from nothing, with its certificates."""
    tiling = a_tiling(scene, random)
    run = Simulation(scene, tiling=tiling)
    audit(run)
    steps = 0
    while run.step():
        audit(run)
        steps += 1
    ended = "no contact" if run.contact is None else "a contact"
    return f"{tiling}, {_some(steps)} steps, {ended}"


def filters_decide_exactly(scene: Scene, random: Random) -> str:
    """The event log is the same, byte for byte, with and without the float filters."""
    tiling = a_tiling(scene, random)
    filtered, exact = (
        [event.to_json() for event in Simulation(scene, tiling=tiling, exact_only=exact).run()]
        for exact in (False, True)
    )
    for number, (found, expected) in enumerate(zip(filtered, exact, strict=False)):
        if found != expected:
            raise Difference(f"{tiling}: event", f"event {number}: {found}, exactly {expected}")
    if len(filtered) != len(exact):
        raise Difference(f"{tiling}: number of events", f"{len(filtered)}, exactly {len(exact)}")
    return f"{tiling}, {_some(len(exact))} events"


def _some(count: int) -> str:
    return "no" if count == 0 else "few" if count < 10 else "many"
