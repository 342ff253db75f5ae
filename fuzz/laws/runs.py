"""Laws about runs: what is saved, copied or changed goes on as if nothing had happened."""

from __future__ import annotations

import copy
from collections.abc import Callable
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Final

import exactpt
from exactpt import Body, Contact, InputError, Scene, Simulation
from exactpt.kernel.numbers import fraction
from exactpt.testing import audit, reference
from exactpt.testing.agreement import plain_contact
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.questions import a_time
from fuzz.laws.tilings import a_tiling
from fuzz.soak import Soak
from fuzz.witnesses import Difference, LeftOutError

__all__ = [
    "bounces_are_first_contacts",
    "living_run_is_static",
    "population_is_a_new_scene",
    "restored_run_goes_on",
]

EVENTS: Final = 12
"""Maximum number of steps until a run is saved."""

ACTIONS: Final = 12
"""Number of actions in a living run."""

BOUNCES: Final = 4
"""Number of contacts until a run that bounces is left."""

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


def bounces_are_first_contacts(scene: Scene, random: Random) -> str:
    """Each contact of a run that bounces is the first one of what was planned, by all pairs.

    And the history of the run is one scene without a contact, at whose end its bodies are.
    """
    tiling = a_tiling(scene, random)
    run = Simulation(scene, tiling=tiling, record=True)
    refuse_unless(run.contact is None)
    bounce = exactpt.Bounce(restitution=random.choice(["0", "1/2", "1"]))
    planned = scene
    contacts = 0

    def respond(simulation: Simulation, contact: Contact) -> None:
        nonlocal planned, contacts
        contacts += 1
        expected = reference.first_contact(planned)
        check_equal("contact", plain_contact(contact), expected)
        try:
            bounce(simulation, contact)
        except InputError as error:
            if "beyond the range of doubles" not in str(error):
                raise
            raise LeftOutError from None
        planned = _from_now_on(simulation)

    for _ in run.run(on_contact=respond):
        if contacts == BOUNCES:
            break
    else:
        _check_history(run)
    return f"{tiling}, {contacts} contacts"


def _from_now_on(run: Simulation) -> Scene:
    """Return the bodies of a run from now on, which is a rational time."""
    return Scene(run.scene.bodies, (fraction(run.now.exact_low), run.scene.end))


def _check_history(run: Simulation) -> None:
    """Check the history of a run that has come to its end."""
    history = run.history()
    if not history.is_scene:
        return
    past = history.scene()
    contact = exactpt.first_contact(past, method="pairs")
    check_equal("contact in the history", contact, run.contact)
    for body in run.scene.bodies:
        check_equal("end of the history", past.body(body.name).at(past.end), body.at(past.end))


def population_is_a_new_scene(scene: Scene, random: Random) -> str:
    """After a body has come, or one has gone, a run is that of the bodies that are there."""
    tiling = a_tiling(scene, random)
    refuse_unless(len(scene.bodies) >= 2)
    *others, last = random.sample(scene.bodies, len(scene.bodies))
    run = Simulation(Scene(others, (scene.start, scene.end)), tiling=tiling)
    time = fraction(a_time(scene, random))
    refuse_unless(time < scene.end and run.contact is None)
    for _ in run.run(until=time):
        pass
    refuse_unless(run.contact is None)
    try:
        later = Scene([*others, last], (time, scene.end))
    except InputError:
        raise LeftOutError from None  # it has touched itself before, and is no body any more
    expected = reference.first_contact(later)
    if expected is not None and expected.kind == "initial":
        return f"{tiling}, {_refused_to_come(run, last)}"
    run.add(last)
    audit(run)
    outcome = "came"
    if len(others) > 1 and random.random() < 0.5:
        run.remove(random.choice(others).name)
        audit(run)
        expected = reference.first_contact(_from_now_on(run))
        outcome = "came and went"
    contact = run.run_to_contact()
    check_equal("time of the contact", contact and contact.time, expected and expected.time)
    return f"{tiling}, {outcome}, {'no contact' if contact is None else 'a contact'}"


def _refused_to_come(run: Simulation, body: Body) -> str:
    """Check that a body that touches another one is refused."""
    try:
        run.add(body)
    except InputError:
        audit(run)
        return "refused"
    raise Difference("add", f"{body.name!r} touches another body, and is accepted")


def living_run_is_static(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """A run in which motions, bodies, copies and saves come and go equals one built from nothing.

    It makes its own room of bodies (`fuzz.soak`), and every state is audited.
    """
    soak = Soak(random.getrandbits(32), random.choice(LIVING))
    soak.act(ACTIONS)
    return f"{soak.tiling}, {min(soak.simulation.contacts, 2)} contacts"
