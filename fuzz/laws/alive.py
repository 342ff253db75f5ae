"""Laws about runs to which much happens: after each change they are as if begun there."""

from __future__ import annotations

import copy
import json
import pickle
from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from random import Random
from typing import Final

import exactpt
from exactpt import Body, InputError, Rigid, RunEvent, Scene, Simulation
from exactpt.simulation.history import History
from exactpt.testing import audit, reference
from exactpt.testing.agreement import plain_contact
from fuzz.laws.journeys import Journey, Moment, touched_by
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.runs import restored
from fuzz.laws.tilings import a_tiling
from fuzz.witnesses import Difference, tilings_of

__all__ = [
    "changed_run_is_a_new_scene",
    "events_are_the_same_in_any_way",
    "history_is_what_happened",
    "pockets_are_tiled_again",
]

COMINGS: Final = 12
"""Number of changes, each of one body, in a case about pockets."""

SMALL: Final = 30
"""Maximum number of vertices of a scene whose contact is that of the definition."""


def changed_run_is_a_new_scene(scene: Scene, random: Random) -> str:
    """After each change a run equals one built from nothing, and meets what its bodies meet.

    A body that comes is refused exactly if it touches another one, and then nothing changes.
    """
    tiling = a_tiling(scene, random)
    journey = Journey(scene, tiling, random)
    for _ in journey.events(lambda journey: audit(journey.run)):
        pass
    run = journey.run
    check_equal("number of changes", run.stats["plans"], journey.changes)
    if run.contact is not None or run.now >= run.scene.end or not run.now.simplified().is_rational:
        return f"{tiling}, to the end"
    _check_jump_is_refused(run, random)
    rest = Scene(run.scene.bodies, (run.now.low, run.scene.end))
    contact = run.run_to_contact()
    if rest.vertex_count <= SMALL:
        check_equal("contact", plain_contact(contact), reference.first_contact(rest))
    else:
        by_pairs = exactpt.first_contact(rest, method="pairs")
        check_equal("contact, by pairs", plain_contact(contact), plain_contact(by_pairs))
    return f"{tiling}, {'no contact' if contact is None else 'a contact'}"


def _check_jump_is_refused(run: Simulation, random: Random) -> None:
    """Check that a body at rest which is given with a vertex elsewhere is refused.

    Raises:
        Difference: if it is not.
    """
    simple = [body for body in run.scene.bodies if not body.has_rings and not body.keyframes]
    if not simple:
        return
    chosen = random.choice(simple)
    run.set_motion(chosen.name, chosen.halted(run.now.low))
    rest = run.body(chosen.name)
    (x, y), *others = rest.at(run.now.low)
    moved = Body(rest.name, [(x + 1, y), *others], rest.motion, closed=rest.closed)
    before = run.to_json()
    try:
        run.set_motion(rest.name, moved)
    except InputError:
        check_equal("state after a refused jump", run.to_json(), before)
    else:
        raise Difference("jump", f"{moved!r} is accepted in the place of {rest!r}")


def pockets_are_tiled_again(scene: Scene, random: Random) -> str:
    """Bodies come into pockets and go, and the mixed tiling is that of the bodies there.

    It is changed, not built anew, unless geodesics along a hole change.
    """
    refuse_unless("mixed" in tilings_of(scene))
    run = Simulation(Scene([], (scene.start, scene.end)), tiling="mixed")
    absent = random.sample(scene.bodies, len(scene.bodies))
    for _ in range(COMINGS):
        here = [body.name for body in run.scene.bodies]
        if len(here) > random.randint(0, len(scene.bodies) - 1):
            absent.insert(0, run.body(random.choice(here)))
            run.remove(absent[0].name)
        else:
            body = absent.pop(random.randrange(len(absent)))
            if touched_by(body, run.scene, scene.start):
                absent.append(body)
                continue
            run.add(body)
        audit(run)
    if not any(body.has_rings for body in scene.bodies):
        check_equal("number of tilings built anew", run.stats["rebuilds"], 0)
    return f"{min(len(scene.bodies), 9)} bodies"


# Events


def events_are_the_same_in_any_way(scene: Scene, random: Random) -> str:
    """Events are the same read at once or late, and after any copies and files on the way."""
    tiling, seed = a_tiling(scene, random), random.getrandbits(32)

    def journey() -> Journey:
        return Journey(scene, tiling, Random(seed))

    at_once = [_text(event) for event in journey().events()]
    late = list(journey().events())
    check_equal("events read late", [_text(event) for event in late], at_once)
    ways = random.choices(list(WAYS), k=3)

    def go_on_in_another(journey: Journey) -> None:
        journey.run = WAYS[random.choice(ways)](journey.run)

    replaced = list(journey().events(go_on_in_another))
    check_equal(
        "events of copies and files", [_text(event) for event in reversed(replaced)], at_once[::-1]
    )
    return f"{tiling}, {'some' if at_once else 'no'} events"


def _text(event: RunEvent) -> str:
    return json.dumps(event.to_json())


WAYS: Final[dict[str, Callable[[Simulation], Simulation]]] = {
    "the run itself": lambda run: run,
    "a file": restored,
    "a copy": Simulation.copy,
    "a deep copy": copy.deepcopy,
    "a pickle": lambda run: pickle.loads(pickle.dumps(run)),
}
"""Runs that go on as a given one does."""


# The past


def history_is_what_happened(scene: Scene, random: Random) -> str:
    """The history of a run has its bodies where they were, and a mark for each change.

    A body with an angle error has a life for each point about which it turns.
    """
    tiling = a_tiling(scene, random)
    erring = [_with_an_angle_error(body, random) for body in scene.bodies]
    scene = Scene(erring, (scene.start, scene.end))
    journey = Journey(scene, tiling, random, record=True)
    for _ in journey.events():
        pass
    run = journey.run
    history = run.history()
    ends = [*journey.moments, Moment(history.end, ())]
    for (since, bodies), (until, _) in pairwise(ends):
        if since < until:
            _check_lives(history, bodies, since, until)
    marks = [mark.kind for mark in history.marks]
    check_equal("contacts in the history", marks.count("contact"), run.contacts)
    times = [mark.time for mark in history.marks]
    check_equal("order of marks", times, sorted(times))
    if history.is_scene and history.start < history.end:
        past = history.scene()
        contact = exactpt.first_contact(past, method="pairs")
        check_equal("contact in the history", plain_contact(contact), plain_contact(run.contact))
    return f"{tiling}, {'one scene' if history.is_scene else 'several lives'}"


def _with_an_angle_error(body: Body, random: Random) -> Body:
    """Return a body that turns with an angle error, perhaps, and any other one as it is."""
    if isinstance(body.motion, Rigid) and random.random() < 0.5:
        return body.with_errors(angle_error=Fraction(1, 1000))
    return body


def _check_lives(
    history: History, bodies: Sequence[Body], since: Fraction, until: Fraction
) -> None:
    """Check which bodies there were in an interval without changes, and where."""
    lives = {
        life.body.name: life.body
        for life in history.lives
        if life.since <= since and life.until >= until
    }
    check_equal("bodies in the history", set(lives), {body.name for body in bodies})
    for body in bodies:
        for time in (since, (since + until) / 2, until):
            if lives[body.name].at(time) != body.at(time):
                raise Difference("place in the history", f"{body.name!r} at t = {time}")
