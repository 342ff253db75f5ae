"""Laws about runs: what is saved, copied or changed goes on as if nothing had happened."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable, Mapping
from fractions import Fraction
from itertools import islice
from math import isqrt
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any, Final

import exactpt
from exactpt import (
    AlgebraicNumber,
    Body,
    Contact,
    InputError,
    RunEvent,
    Scene,
    Simulation,
    Translation,
)
from exactpt.testing import reference
from exactpt.testing.agreement import plain_contact
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.tilings import a_tiling
from fuzz.soak import Soak
from fuzz.witnesses import Difference, LeftOutError

__all__ = [
    "bounce_in_doubles",
    "bounces_are_first_contacts",
    "living_run_is_static",
    "restored",
    "restored_run_goes_on",
    "stops_change_nothing",
]

EVENTS: Final = 12
"""Maximum number of steps until a run is saved."""

ACTIONS: Final = 12
"""Number of actions in a living run."""

BOUNCES: Final = 4
"""Number of contacts until a run that bounces is left."""

MASSES: Final = (1, 2, 7)
"""Masses of bodies that bounce."""

FAST: Final = 2**30
"""Speed up to which a double is off by less than a speed of separation is compared to."""

SLOWEST: Final = 1 / 16
"""Least speed of separation after a `Bounce`."""

GRID: Final = Fraction(1, 2**20)
"""The grid of velocities of a `Bounce`."""

STOPS: Final = 12
"""Number of stops on the way of a run."""

LIVING: Final = ("greedy", "lazy", "mixed")


def _ignore(simulation: Simulation, contact: Contact) -> None:
    """Let a run go on after a contact as before."""


def restored_run_goes_on(scene: Scene, random: Random) -> str:
    """A run saved at some event, and its copy, have its state and go on as the run does.

    A user compares the time of the restored run, which refines its number and changes nothing else.
    """
    exact_only = random.random() < 0.2
    run = Simulation(scene, tiling=a_tiling(scene, random), exact_only=exact_only)
    for _ in range(random.randint(0, EVENTS)):
        if not run.step():
            break
    again = restored(run)
    _refine_now(again)
    copied = run.copy() if random.random() < 0.5 else copy.deepcopy(run)
    check_equal("state of the restored run", again.to_json(), run.to_json())
    check_equal("counts of the restored run", again.stats, run.stats)
    respond: Callable[[Simulation, Contact], object] | None
    respond = random.choice([None, exactpt.stop, _ignore])
    events, events_restored, events_copied = (
        [event.to_json() for event in one.run(on_contact=respond)] for one in (run, again, copied)
    )
    check_equal("events after restoring", events_restored, events)
    check_equal("events of the copy", events_copied, events)
    check_equal("contacts after restoring", again.contacts, run.contacts)
    check_equal("state of the run restored at its end", restored(run).to_json(), run.to_json())
    return f"{min(run.contacts, 2)} contacts, {'some' if events else 'no'} events"


def _refine_now(run: Simulation) -> None:
    """Compare the time of a run with the middle of its isolating interval."""
    middle = (run.now.low + run.now.high) / 2
    run.now.compare_rational(middle)


def restored(run: Simulation) -> Simulation:
    """Return the run that is read from its file."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "run.json"
        run.save(path)
        return Simulation.restore(path)


def stops_change_nothing(scene: Scene, random: Random) -> str:
    """However a run is stopped on its way, its events and its contact are the same.

    Up to a time are exactly the events that are not after it, also beside an event. What is
    proved to be free of contacts is before the contact. Each exact decision has its reason.
    """
    tiling, exact_only = a_tiling(scene, random), random.random() < 0.2
    whole = Simulation(scene, tiling=tiling, exact_only=exact_only)
    events = list(whole.run())
    run = Simulation(scene, tiling=tiling, exact_only=exact_only)
    seen: list[RunEvent] = []
    for _ in range(STOPS):
        _check_proved(run, whole.contact)
        _go_on(run, events, seen, random)
    seen += run.run()
    check_equal("events", [e.to_json() for e in seen], [e.to_json() for e in events])
    check_equal("contact", run.contact, whole.contact)
    check_equal("time at the end", run.now, whole.now)
    _check_reasons(run, exact_only=exact_only)
    _check_counts(run)
    return f"{tiling}, {'some' if events else 'no'} events"


def _go_on(run: Simulation, events: list[RunEvent], seen: list[RunEvent], random: Random) -> None:
    """Let a run go on by a step, to its next event, or up to a time near that."""
    kind = random.choice(["step", "next event", "a time", "a time"])
    if kind == "step":
        seen += run.step()
    elif kind == "next event":
        seen += islice(run.run(), 1)
    elif run.contact is None:
        end = AlgebraicNumber(run.scene.end)
        ahead = events[len(seen)].time if len(seen) < len(events) else end
        until = _a_time_near(ahead, run, random)
        seen += run.run(until=until)
        passed = [event for event in events if event.time <= until]
        check_equal(f"number of events up to {until}", len(seen), len(passed))
        if run.contact is None:
            check_equal("time now", run.now, min(until, run.scene.end))


def _a_time_near(event: AlgebraicNumber, run: Simulation, random: Random) -> Fraction:
    """Return the time of an event or an end of its canonical interval, or one a little beside."""
    low, high = map(Fraction, event.canonical_interval())
    beside = Fraction(1, 2 ** random.choice([1, 30, 60, 100]))
    time = random.choice([low, high, (low + high) / 2, low - beside, high + beside])
    earliest = Fraction(run.now.canonical_interval()[1])
    return max(time, earliest)


def _check_proved(run: Simulation, contact: Contact | None) -> None:
    for proved in (run.passed(), run.reached()):
        if contact is not None and proved is not None and contact.time <= proved:
            raise Difference("free of contacts", f"up to {proved}, but one at {contact.time}")


def _check_reasons(run: Simulation, *, exact_only: bool) -> None:
    """Check that the reasons of exact decisions are complete."""
    reasons, exact = run.stats["reasons"], run.stats["exact"]
    assert isinstance(reasons, dict)  # noqa: S101 - a documented type
    check_equal("number of reasons", sum(reasons.values()), exact)
    if exact_only:
        check_equal("decisions of filters", run.stats["filtered"], 0)
    elif any(key.endswith("asked") for key in reasons):
        raise Difference("exact without need", f"{reasons}")


def _check_counts(run: Simulation) -> None:
    """Check that the counts of events are those of their kinds, and ratios those of counts."""
    if run.kinetic is None:
        return  # bodies touch at the start
    stats: Any = run.stats
    by_kind = stats["by_kind"]
    check_equal("events", stats["events"], sum(by_kind.values()))
    internal = by_kind.get("internal", 0) + by_kind.get("motion", 0)
    check_equal("internal events", stats["internal"], internal)
    check_equal("external events", stats["external"], stats["events"] - internal)
    efficiency = stats["events"] / stats["external"] if stats["external"] else 0.0
    check_equal("efficiency", stats["efficiency"], efficiency)
    touched = stats["certificates"] + stats["skipped"]
    responsiveness = touched / stats["events"] if stats["events"] else 0.0
    check_equal("responsiveness", stats["responsiveness"], responsiveness)


def bounces_are_first_contacts(scene: Scene, random: Random) -> str:
    """Each contact of a run that bounces is the first one of what was planned, by all pairs.

    Two bodies that only translate always separate. No bounce changes the momentum, and the
    restitution is the ratio of the speeds along the normal. A pickle of a bounce does the same.
    """
    tiling = a_tiling(scene, random)
    run = Simulation(scene, tiling=tiling)
    refuse_unless(run.contact is None)
    restitution = random.choice([0.0, 0.5, 1.0])
    masses = {body.name: random.choice(MASSES) for body in scene.bodies if random.random() < 0.5}
    bounce = exactpt.Bounce(restitution=restitution, masses=masses)
    planned = scene
    contacts = 0

    def respond(simulation: Simulation, contact: Contact) -> None:
        nonlocal bounce, planned, contacts
        contacts += 1
        expected = reference.first_contact(planned)
        check_equal("contact", plain_contact(contact), expected)
        before, speed = bounce.momentum(simulation), _parting_speed(simulation, contact)
        bounce_in_doubles(bounce, simulation, contact)
        bounce = pickle.loads(pickle.dumps(bounce))
        _check_momentum(before, bounce, masses, simulation)
        if speed is not None:
            _check_restitution(-speed, _parting_speed(simulation, contact), restitution)
        planned = _from_now_on(simulation)

    for _ in run.run(on_contact=respond):
        if contacts == BOUNCES:
            break
    if len(scene.bodies) == 2 and all(map(_only_translates, scene.bodies)):
        check_equal("contact that ends the run", run.contact, None)
    return f"{tiling}, {contacts} contacts"


def _parting_speed(run: Simulation, contact: Contact) -> float | None:
    """Return the speed at which a vertex leaves the only edge that it touches, along the normal.

    None if it touches more, or one of them is so fast that the rounding of doubles would show.
    The point of the edge that is nearest to the vertex has a velocity between those of its ends.
    """
    if len(contact.pairs) != 1:
        return None
    (pair,) = contact.pairs
    if pair.edge is None or pair.normal is None or pair.body == pair.other:
        return None
    one, other, now = run.body(pair.body), run.body(pair.other), run.now.low
    start, end = pair.edge, other.end_of_edge(pair.edge)
    ax, ay, bx, by = (*other.at(now)[start], *other.at(now)[end])
    px, py = one.at(now)[pair.vertex]
    dx, dy = bx - ax, by - ay
    foot = ((px - ax) * dx + (py - ay) * dy) / (dx * dx + dy * dy)
    part = min(max(foot, Fraction(0)), Fraction(1))
    u, v = one.velocity_at(now)[pair.vertex]
    velocities = other.velocity_at(now)
    w, z = (a + part * (b - a) for a, b in zip(velocities[start], velocities[end], strict=True))
    if max(map(abs, (u, v, w, z))) > FAST:
        return None
    return pair.normal[0] * float(u - w) + pair.normal[1] * float(v - z)


def _check_restitution(approach: float, parting: float | None, restitution: float) -> None:
    """Check the speed at which two bodies separate: at least `SLOWEST`, but for rounding."""
    expected = max(restitution * abs(approach), SLOWEST)
    if parting is not None and abs(parting - expected) > 1e-5 * (1 + abs(approach)):
        raise Difference("restitution", f"{approach} became {parting}, expected {expected}")


def _check_momentum(
    before: tuple[Fraction, Fraction],
    bounce: exactpt.Bounce,
    masses: Mapping[str, int],
    run: Simulation,
) -> None:
    """Check that a bounce has changed the momentum by rounding only, to doubles and to the grid.

    Where all bodies only translate, it and the energy are those of the velocities of vertices.
    """
    after, energy = bounce.momentum(run), bounce.kinetic_energy(run)
    heaviest = max(masses.values(), default=1)
    largest = isqrt(int(2 * energy)) + 1  # no velocity is larger, as no mass is below 1
    rounding = heaviest * len(run.scene.bodies) * (GRID + largest * Fraction(1, 2**40))
    for p, q in zip(before, after, strict=True):
        if abs(p - q) > rounding:
            raise Difference("momentum", f"{float(p)!r} became {float(q)!r}")
    if not all(map(_only_translates, run.scene.bodies)):
        return
    moving = [
        (masses.get(body.name, 1), body.velocity_at(run.now.low)[0]) for body in run.scene.bodies
    ]
    momentum = tuple(sum((m * v[k] for m, v in moving), Fraction(0)) for k in (0, 1))
    check_equal("momentum, by its definition", after, momentum)
    check_equal("energy", 2 * energy, sum(m * (u * u + v * v) for m, (u, v) in moving))


def bounce_in_doubles(bounce: exactpt.Bounce, run: Simulation, contact: Contact) -> None:
    """Let bodies bounce.

    Raises:
        LeftOutError: if a velocity is no double.
    """
    try:
        bounce(run, contact)
    except InputError as error:
        if "beyond the range of doubles" not in str(error):
            raise
        raise LeftOutError from None


def _only_translates(body: Body) -> bool:
    is_rigid = all(f.degree <= 0 for vertex in body.vertices for f in vertex)
    return isinstance(body.motion, Translation) and is_rigid and not body.keyframes


def _from_now_on(run: Simulation) -> Scene:
    """Return the bodies of a run from now on, which is a rational time."""
    return Scene(run.scene.bodies, (run.now.low, run.scene.end))


def living_run_is_static(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """A run in which motions, bodies, copies and saves come and go equals one built from nothing.

    It makes its own room of bodies (`fuzz.soak`), and every state is audited.
    """
    soak = Soak(random.getrandbits(32), random.choice(LIVING))
    soak.act(ACTIONS)
    return f"{soak.tiling}, {min(soak.simulation.contacts, 2)} contacts"
