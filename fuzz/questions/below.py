"""The times at which two bodies are within a distance, by definition; often it is their least one.

Then an interval is a single time, at which the distance is reached and not undercut.
"""

from __future__ import annotations

from random import Random
from typing import Final

from exactpt import Scene, clearance
from exactpt.kernel.numbers import QQ, fraction
from exactpt.kernel.square_root import exact_square_root
from exactpt.pairs.clearance import Clearance
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from fuzz.questions.rounded import rounded_pair
from fuzz.questions.scenes import distant_scene

__all__ = ["wrong_intervals"]

DISTANCES: Final = (QQ(0), QQ(1), QQ(1, 3), QQ(5, 7), QQ(2))


def wrong_intervals(random: Random) -> tuple[Scene, str, str | None]:
    """Return two bodies, how often they are within a distance, and a fault of the intervals."""
    scene = random.choice([distant_scene, distant_scene, rounded_pair])(random)
    a, b = scene.bodies
    gap = clearance(scene, a.name, b.name)
    d = _asked(random, gap)
    squared = (d + a.exact_radius + b.exact_radius) ** 2
    expected = reference.intervals_within(a, b, scene.time, squared)
    moments = sum(start == end for start, end in expected)
    kind = f"{len(expected)} intervals, {moments} of them a single time"
    difference = disagreement(expected, gap.below(fraction(d)))
    return scene, kind, None if difference is None else f"below {d}: {difference}"


def _asked(random: Random, gap: Clearance) -> QQ:
    """Return a distance: the least one if it is rational, in half of the cases."""
    squared = gap.minimum.squared.simplified()
    root = exact_square_root(squared.exact_low) if squared.is_rational else None
    if root is not None and random.random() < 0.5:
        least: QQ = root - QQ(gap.radius)
        if least >= 0:
            return least
    return random.choice(DISTANCES)
