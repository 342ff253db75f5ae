"""Laws about limits of time: a search ends at a look at the clock, and what it reached is true.

The clock stands still, and strikes at a chosen look (`exactpt.testing.ending_at`). So each of these
places is tried by itself, and the same one again.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from types import FrameType
from typing import Final, TypeAlias, final

import exactpt
from exactpt import (
    BudgetExceeded,
    Contact,
    InputError,
    Scene,
    Simulation,
    first_contact,
)
from exactpt.testing import ending_at
from exactpt.testing.ending import StandingClock
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.runs import restored
from fuzz.laws.tilings import a_tiling
from fuzz.witnesses import Difference, tilings_of

__all__ = [
    "ended_run_is_true",
    "ended_search_is_true",
    "numbers_of_events_are_kept",
    "searches_look_at_the_clock",
]

SECONDS: Final = 1.0
"""A limit, which is over when the clock strikes."""

STRIKES: Final = 3
"""Number of looks at which the clock strikes, of a case."""

LATE: Final = 1
"""Number of looks after the strike within which a search ends: loops within loops look too."""

WITHOUT_A_LOOK: Final = 20_000
"""Most calls of functions between two looks, of a search among bodies in straight motion: about
10 ms. What is prepared for each body takes some thousand."""


# Searches

Search: TypeAlias = Callable[[Scene], Contact | None]


def _by_method(name: str) -> Search:
    return lambda scene: first_contact(scene, method=name, max_seconds=SECONDS)


def _by_tiling(name: str) -> Search:
    return lambda scene: first_contact(scene, tiling=name, max_seconds=SECONDS)


def _by_simulation(name: str) -> Search:
    return lambda scene: Simulation(scene, tiling=name, max_seconds=SECONDS).run_to_contact()


def _by_proof(name: str) -> Search:
    def search(scene: Scene) -> Contact | None:
        with TemporaryDirectory() as folder:
            path = Path(folder) / "a.proof"
            return first_contact(scene, tiling=name, proof=path, max_seconds=SECONDS)

    return search


def _a_search(scene: Scene, random: Random) -> tuple[str, Search]:
    """Return a way to search for the first contact, with its name."""
    ways = {"auto": _by_method("auto"), "pairs": _by_method("pairs")}
    for name in tilings_of(scene):
        ways[name] = _by_tiling(name)
        ways[f"simulation, {name}"] = _by_simulation(name)
        ways[f"proof, {name}"] = _by_proof(name)
    way = random.choice([*ways, "auto", "pairs"])
    return way, ways[way]


def ended_search_is_true(scene: Scene, random: Random) -> str:
    """A search whose time is over ends at once, and no contact is before what it has reached."""
    way, search = _a_search(scene, random)
    with ending_at(None) as whole:
        contact = search(scene)
    later = range(2, whole.looks + 1)  # at the first look the limit begins
    refuse_unless(later)
    outcome = "nothing reached"
    for strike in random.sample(later, min(STRIKES, len(later))):
        reached = None
        with ending_at(strike) as clock:
            try:
                search(scene)
            except BudgetExceeded as spent:
                reached = spent.reached
        if clock.looks_after > LATE:
            raise Difference(f"{way}: late", f"{clock.looks_after} looks after that at {strike}")
        if reached is not None:
            _check_free(f"{way}: reached", contact, reached)
            outcome = "no contact" if contact is None else "before a contact"
    return f"{way}, {outcome}"


def _check_free(what: str, contact: Contact | None, reached: Fraction | None) -> None:
    """Check that there is no contact up to a time."""
    if contact is not None and reached is not None and contact.time <= reached:
        raise Difference(what, f"{reached}, but a contact at {contact.time}")


# Runs


def ended_run_is_true(scene: Scene, random: Random) -> str:
    """A run whose time is over goes on as it would have, or says that it cannot.

    What it says to be free of contacts is, and its limit is the same in a copy.
    """
    tiling = a_tiling(scene, random)
    with ending_at(None) as whole:
        run = Simulation(scene, tiling=tiling, max_seconds=SECONDS)
        begun = whole.looks
        events = [event.to_json() for event in run.run()]
    contact = run.contact
    first = random.choice([2, begun + 1, begun + 1])  # at the first look the limit begins
    refuse_unless(first <= whole.looks and (contact is None or contact.kind != "initial"))
    strike = random.randint(first, whole.looks)
    reported: list[object] = []
    ended: Simulation | None = None
    with ending_at(strike):
        try:
            ended = Simulation(scene, tiling=tiling, max_seconds=SECONDS)
            for event in ended.run():
                reported.append(event.to_json())  # noqa: PERF401 - those until the time is over
        except BudgetExceeded as spent:
            _check_free("reached", contact, spent.reached)
    if ended is None:
        return f"{tiling}, before its start"
    for proved in (ended.passed(), ended.reached()):
        _check_free("free of contacts", contact, proved)
    check_equal("events before", reported, events[: len(reported)])
    try:
        rest = [event.to_json() for event in restored(ended).run()]
    except InputError as refusal:
        if "interrupted in the middle of an event: it cannot go on" not in str(refusal):
            raise
        return f"{tiling}, in an event"
    check_equal("events after", rest, events[len(reported) :])
    return f"{tiling}, between events"


def numbers_of_events_are_kept(scene: Scene, random: Random) -> str:
    """A run that may report some events reports these, and then no other one."""
    tiling = a_tiling(scene, random)
    whole = Simulation(scene, tiling=tiling)
    events = [event.to_json() for event in whole.run()]
    # The contact that ends a run is reported in any case.
    number = len(events) - (whole.contact is not None)
    most = random.randint(0, number)
    run = Simulation(scene, tiling=tiling, max_events=most)
    reported: list[object] = []
    try:
        for event in run.run():
            reported.append(event.to_json())  # noqa: PERF401 - those until the number is reached
    except BudgetExceeded as spent:
        _check_free("reached", whole.contact, spent.reached)
        check_equal("events before", reported, events[:most])
        return f"{tiling}, some events left"
    check_equal("events", reported, events)
    check_equal("number of events", most, number)
    return f"{tiling}, all events"


# Looks


@final
class _Calls:
    """Counts the calls of functions between two looks at a clock."""

    def __init__(self, clock: StandingClock) -> None:
        self._clock = clock
        self._looks = self._calls = 0
        self.most = 0  # between two looks

    def count(self, frame: FrameType, event: str, arg: object) -> None:  # noqa: ARG002
        """Count an event: see `sys.setprofile`."""
        if self._looks != self._clock.looks:
            self._looks, self._calls = self._clock.looks, 0
        if event == "call":
            self._calls += 1
            self.most = max(self.most, self._calls)


def searches_look_at_the_clock(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """A search by pairs calls few functions between two looks at the clock."""
    before = sys.getprofile()
    with ending_at(None) as clock:
        calls = _Calls(clock)
        sys.setprofile(calls.count)
        try:
            exactpt.first_contact(scene, method="pairs", max_seconds=SECONDS)
        finally:
            sys.setprofile(before)
    if calls.most > WITHOUT_A_LOOK:
        raise Difference("no look", f"{calls.most} calls of functions without a look at the clock")
    return f"up to {1000 * -(-calls.most // 1000)} calls"
