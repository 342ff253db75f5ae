"""Searches whose time is over at some look at the clock: they end, and what they say is true.

The clock is one that stands still, and strikes at a chosen look. So each of these places is tried
by itself, and the same one again. How long a search goes on without a look is told by the number of
functions that it calls meanwhile, which is the same on each machine.
"""

from __future__ import annotations

import sys
from random import Random
from types import FrameType
from typing import Final, final

from exactpt import Body, BudgetExceeded, Contact, Pieces, Scene, Translation, first_contact
from exactpt.kernel.numbers import QQ, rational
from exactpt.testing.ending import StandingClock, ending_at
from exactpt.testing.scenes import generate
from fuzz.changes.awkward import awkward
from fuzz.questions.scenes import crowded_scene
from fuzz.witnesses import tilings_of

__all__ = ["chevrons", "relay", "wrong_at_the_end"]

PLAIN: Final = ("convoy", "row", "small_grid", "linear_points", "piecewise_points", "discs")
"""Families of many bodies in straight motion."""

TRIED: Final = 6
"""Number of looks at which the clock strikes, of a scene."""

LATE: Final = 1
"""Number of looks after the strike within which a search ends: loops within loops look too."""

WITHOUT_A_LOOK: Final = 20_000
"""Most calls of functions between two looks, of a search among bodies in straight motion: about
10 ms. What is prepared for each body takes some thousand."""

CHEVRONS: Final = 72
"""Number of bodies of which no box, however it is turned, is apart from that of another one."""

TIMES: Final = (QQ(1), QQ(1, 3), QQ(3, 7), QQ(5, 9), QQ(10, 13), QQ(3, 2))


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


def wrong_at_the_end(random: Random) -> tuple[Scene, str, str | None]:
    """Return a scene, how many looks a search takes, and a fault of one that was ended."""
    if random.randrange(16) == 0:
        crowd = chevrons(random)
        return crowd, "a crowd", _without_a_look(crowd)
    scene = _scene(random)
    way = random.choice(["pairs", "pairs", "auto", *tilings_of(scene)])
    with ending_at(None) as whole:
        contact = _search(scene, way)
    later = range(2, whole.looks + 1)  # at the first look the limit begins
    for strikes in random.sample(later, min(TRIED, len(later))):
        fault = _wrong(scene, way, contact, strikes)
        if fault is not None:
            return scene, "wrong", f"{way}, struck at look {strikes} of {whole.looks}: {fault}"
    return scene, f"{way}, {'few' if whole.looks < 20 else 'many'} looks", None


def _wrong(scene: Scene, way: str, contact: Contact | None, strikes: int) -> str | None:
    """Return the fault of a search whose clock strikes after some looks."""
    reached = None
    with ending_at(strikes) as struck:
        try:
            _search(scene, way)
        except BudgetExceeded as spent:
            reached = spent.reached
    if struck.looks_after > LATE:
        return f"it looks {struck.looks_after} times more"
    if contact is None or reached is None:
        return None
    if contact.time.compare_rational(rational(reached)) <= 0:
        return f"no contact until {reached}, but there is one at {contact.time}"
    return None


def _without_a_look(scene: Scene) -> str | None:
    """Return a fault if a search goes on for too long without a look at the clock."""
    before = sys.getprofile()
    with ending_at(None) as clock:
        calls = _Calls(clock)
        sys.setprofile(calls.count)
        try:
            _search(scene, "pairs")
        finally:
            sys.setprofile(before)
    if calls.most > WITHOUT_A_LOOK:
        return f"{calls.most} calls of functions without a look at the clock"
    return None


def _search(scene: Scene, way: str) -> Contact | None:
    if way in ("auto", "pairs"):
        return first_contact(scene, method=way, max_seconds=1.0)
    return first_contact(scene, tiling=way, max_seconds=1.0)


def _scene(random: Random) -> Scene:
    kind = random.randrange(4)
    if kind == 0:
        return crowded_scene(random)
    if kind == 1:
        return generate(random.choice(PLAIN), random.getrandbits(20))
    scene = relay(random)
    return scene if kind == 2 else awkward(scene, random)


def chevrons(random: Random) -> Scene:
    """Return nested angles that move almost alike and never touch: all pairs must be compared."""
    bodies = []
    for k in range(CHEVRONS):
        motion = Translation([0, 1 + QQ(k, 1024)], [0, QQ(random.randint(-3, 3), 1024)])
        bodies.append(Body(f"b{k}", [(k + 40, 40), (k, 0), (k + 40, -40)], motion, closed=False))
    return Scene(bodies, (0, 1))


def relay(random: Random) -> Scene:
    """Return walls and boxes that all turn back at one time, when some of them touch their walls.

    That time is the contact, and the start of pieces whose boxes already meet. So it is known to
    the last double of which pairs are compared before, and of which after it.
    """
    time = random.choice(TIMES)
    bodies: list[Body] = []
    for k in range(random.randint(6, 9)):
        y = 10 * k
        bodies.append(Body(f"wall{k}", [(0, y), (1, y + 2), (0, y + 4), (2, y + 4), (2, y)]))
        u = random.choice([QQ(1), QQ(2), QQ(1, 3), QQ(5, 7)])
        v = random.choice([QQ(0), QQ(0), QQ(1, 9)])
        gap = random.choice([QQ(0), QQ(1, 100), QQ(1, 7)])  # at that time, from the tip of the box
        tip = (-gap, y + 1) if random.random() < 0.5 else (1 - gap, y + 2)
        x0, y0 = tip[0] - u * time, tip[1] - v * time
        there = Translation([0, u], [0, v])
        back = Translation([2 * u * time, -u], [2 * v * time, -v])
        shape = [(x0, y0), (x0 - 1, y0 + QQ(1, 8)), (x0 - 1, y0 - QQ(1, 8))]
        bodies.append(Body(f"box{k}", shape, Pieces([(time, there), (None, back)])))
    random.shuffle(bodies)
    return Scene(bodies, (0, 2 * time))
