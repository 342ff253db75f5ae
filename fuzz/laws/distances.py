"""Laws about distances over time."""

from __future__ import annotations

from random import Random
from typing import Final

import exactpt
from exactpt import Scene
from exactpt.kernel.numbers import fraction
from exactpt.testing import reference
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.questions import a_time, two_names
from fuzz.witnesses import Difference

__all__ = ["clearance_is_the_distance"]

TIMES: Final = 6
"""Number of times at which a clearance is compared."""

STEPS: Final = 60
"""Those times are multiples of this part of the time span."""


def clearance_is_the_distance(scene: Scene, random: Random) -> str:
    """The clearance of two bodies is their distance at each time; its minimum is not more."""
    first, second = two_names(scene, random)
    a, b = scene.body(first), scene.body(second)
    refuse_unless(not a.exact_radius and not b.exact_radius)
    gap = exactpt.clearance(scene, first, second)
    least = gap.minimum.squared
    for _ in range(TIMES):
        time = a_time(scene, random, STEPS)
        expected = reference.nearest(a, b, fraction(time)).core_squared
        check_equal("clearance", gap.squared(fraction(time)), expected)
        if least > expected:
            raise Difference("minimum", f"{least}, more than {expected} at {time}")
    return "they touch" if least == 0 else "they stay apart"
