"""Crowds that move straight and almost alike for a very long time, before 0 or after it.

No velocity is a double. So an error of 2^-53 of it, times the time, is much larger than the bodies
and than the differences of their velocities: every bound that depends on the time matters, at both
ends of the span.
"""

from __future__ import annotations

from random import Random
from typing import Final

from exactpt import Body, Scene, Translation, first_contact
from exactpt.kernel.numbers import QQ
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from fuzz.changes.awkward import awkward_number

__all__ = ["convoy", "wrong_in_convoy"]

LONG: Final = (10**3, 10**6, 10**9, 10**12)
"""Lengths of the time span."""

PAIRS: Final = 7
"""Number of pairs of bodies: of fewer than eleven bodies no boxes are made."""

SHAPES: Final = (
    [(0, 0)],
    [(0, 0), (1, 0)],
    [(0, 0), (1, 2)],
    [(0, 0), (2, 0), (2, 1)],
    [(0, 0), (1, 0), (1, 1), (0, 1)],
)


def wrong_in_convoy(random: Random) -> tuple[Scene, str, str | None]:
    """Return a crowd, what happens in it, and the difference from the definition."""
    scene = convoy(random)
    expected, found = reference.first_contact(scene), first_contact(scene, method="pairs")
    difference = disagreement(expected, found)
    fault = None if difference is None else str(difference)
    when = "before 0" if scene.end <= 0 else "after 0" if scene.start >= 0 else "around 0"
    return scene, f"{when}, {'no contact' if expected is None else expected.kind}", fault


def convoy(random: Random) -> Scene:
    """Return pairs of bodies far from each other, of which some meet in corners, once.

    The corners of two bodies are in one place at a time near one end of the span, and they pass
    each other: bounds of that time are the narrower the larger the relative velocity. Some are
    rounded, and touch where the sum of two radii is their distance in one coordinate.
    """
    length = random.choice(LONG)
    start = random.choice([-length, -length, 0, -length // 2])
    time = start + length * random.choice([QQ(1, 10**4), QQ(1, 7), 1 - QQ(1, 10**4)])
    common = awkward_number(random, 3), awkward_number(random, 3)
    is_rounded = random.random() < 0.3
    bodies: list[Body] = []
    for k in range(PAIRS):
        x, y = 40 * k * random.choice([1, -1]), 40 * k
        meets = random.random() < 0.3
        radii = [abs(awkward_number(random, 2)) if is_rounded else 0 for _ in "ab"]
        for name, radius in zip("ab", radii, strict=True):
            slow = [awkward_number(random, 2) / length for _ in "xy"]
            shift = [(x, y)[i] - slow[i] * time for i in (0, 1)]
            if name == "b":
                shift[0] += sum(radii) if meets else sum(radii) + 9
            sign = 1 if name == "a" else -1
            shape = [(sign * p, sign * q) for p, q in random.choice(SHAPES)]
            motion = Translation([shift[0], common[0] + slow[0]], [shift[1], common[1] + slow[1]])
            bodies.append(Body(f"{name}{k}", shape, motion, radius=radius))
    return Scene(bodies, (start, start + length))
