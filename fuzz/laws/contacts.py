"""Laws about the intervals in which bodies touch."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from random import Random
from typing import Final

import exactpt
from exactpt import Body, ContactInterval, Scene
from exactpt.kernel.numbers import QQ, fraction
from exactpt.testing import reference
from fuzz.laws.law import refuse_unless
from fuzz.laws.questions import a_time
from fuzz.witnesses import Difference

__all__ = ["bodies_touch_in_their_intervals"]

PAIRS: Final = 3
"""Number of pairs of bodies that are compared, at some times each."""

TIMES: Final = 3
"""Number of times that have nothing to do with intervals."""

STEPS: Final = 60
"""Those times are multiples of this part of the time span."""

PARTS: Final = (QQ(1, 10), QQ(1, 2**20), QQ(1, 2**60))
"""How far from an end of an interval a time is, as a part of the time span."""


def bodies_touch_in_their_intervals(scene: Scene, random: Random) -> str:
    """Two bodies touch at a time if it is in one of their intervals, and at no other time."""
    pairs = reference.counted_pairs(scene)
    refuse_unless(pairs)
    found: dict[tuple[str, str], list[ContactInterval]] = {}
    for interval in exactpt.contacts(scene):
        found.setdefault((interval.a, interval.b), []).append(interval)
    some = _mostly_touching(pairs, found, random)
    touching = 0
    for a, b in some:
        intervals = found.get((a.name, b.name), [])
        for time in _times(scene, intervals, random):
            expected = _touch(a, b, time)
            if any(i.start <= fraction(time) <= i.end for i in intervals) != expected:
                said = f"{a.name} and {b.name} touch in {intervals}"
                raise Difference("contacts", f"{said}; at {time}: {expected}")
            touching += expected
    return "some touch" if touching else "none touch"


def _mostly_touching(
    pairs: Sequence[tuple[Body, Body]],
    found: dict[tuple[str, str], list[ContactInterval]],
    random: Random,
) -> list[tuple[Body, Body]]:
    """Return some pairs of bodies: one of all pairs, and such as have intervals."""
    touching = [(a, b) for a, b in pairs if (a.name, b.name) in found]
    return [random.choice(pairs), *random.sample(touching, min(PAIRS - 1, len(touching)))]


def _times(scene: Scene, intervals: list[ContactInterval], random: Random) -> Iterator[QQ]:
    """Yield some times, and times just before, just after and at the ends of the intervals."""
    span = scene.exact_end - scene.exact_start
    for _ in range(TIMES):
        yield a_time(scene, random, STEPS)
    for interval in random.sample(intervals, min(2, len(intervals))):
        for end in (interval.start, interval.end):
            near = span * random.choice(PARTS)
            while not end.is_rational and end.exact_high - end.exact_low > near:
                end.refine()
            times = end.exact_low - near, end.exact_low, end.exact_high, end.exact_high + near
            yield from (t for t in times if scene.exact_start <= t <= scene.exact_end)


def _touch(a: Body, b: Body, time: QQ) -> bool:
    reach = a.radius + b.radius
    return reference.nearest(a, b, time).core_squared <= reach**2
