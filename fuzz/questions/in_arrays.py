"""Pairs of rounded bodies in arrays of doubles, and each pair as a scene.

Their numbers are doubles next to awkward ones. At the start the bodies are farther apart than the
sum of their radii by a few units in the last place, or much, or they touch.
"""

from __future__ import annotations

import math
from random import Random
from typing import Final, NamedTuple

from exactpt import Body, Contact, Scene, Translation, first_contact
from exactpt.arrays import KINDS, first_contacts
from exactpt.kernel.numbers import of_double
from fuzz.changes.awkward import awkward_number

__all__ = ["TOGETHER", "rounded_pair_of_doubles", "wrong_in_arrays"]

TOGETHER: Final = 32
"""Number of pairs in a call."""

END: Final = 4.0

SHAPES: Final = ([(0, 0)], [(0, 0), (1, 0)], [(0, 0), (1, 0), (0, 1)], [(0, 0), (2, 1), (2, 2)])


class _Moving(NamedTuple):
    """A rounded body in doubles."""

    vertices: list[tuple[float, float]]
    velocity: tuple[float, float]
    radius: float

    def body(self, name: str) -> Body:
        x, y = self.velocity
        return Body(name, self.vertices, Translation([0, x], [0, y]), radius=self.radius)


def wrong_in_arrays(random: Random) -> tuple[Scene, str, str | None]:
    """Return a scene of two bodies, what happens in it, and the fault of the arrays."""
    bodies = [body for _ in range(TOGETHER) for body in _two(random)]
    offsets = [0]
    for body in bodies:
        offsets.append(offsets[-1] + len(body.vertices))
    found = first_contacts(
        [v for body in bodies for v in body.vertices], offsets,
        [(2 * k, 2 * k + 1) for k in range(TOGETHER)],
        velocities=[body.velocity for body in bodies],
        radii=[body.radius for body in bodies], time=(0.0, END),
    )  # fmt: skip
    for k in range(TOGETHER):
        scene = Scene([bodies[2 * k].body("a"), bodies[2 * k + 1].body("b")], (0, END))
        expected = first_contact(scene)
        fault = None
        if bool(found.found[k]) != (expected is not None):
            fault = f"{'missed' if expected else 'found'}: {expected}"
        elif expected is not None:
            kind = KINDS[found.kind[k]]
            ends = float(found.low[k]), float(found.high[k])
            fault = _wrong(expected, kind, ends)
        if fault is not None or k == TOGETHER - 1:
            return scene, "none" if expected is None else expected.kind, fault
    raise AssertionError


def _wrong(expected: Contact, kind: str, ends: tuple[float, float]) -> str | None:
    low, high = map(of_double, ends)
    if not expected.time.compare_rational(low) >= 0 >= expected.time.compare_rational(high):
        return f"{expected.time} is not in {ends}"
    return None if kind == expected.kind else f"{kind}, not {expected.kind}"


def rounded_pair_of_doubles(random: Random) -> Scene:
    """Return a scene of two bodies in doubles, about as far apart at the start as their radii."""
    first, second = _two(random)
    return Scene([first.body("a"), second.body("b")], (0, END))


def _two(random: Random) -> tuple[_Moving, _Moving]:
    """Return two bodies of which the first vertices are about as far apart as the radii."""
    size = random.choice([1e-3, 1.0, 1.0, 1e4])
    radii = [abs(float(awkward_number(random, 2))) * size for _ in "ab"]
    radii[0] += size / 3
    reach = radii[0] + radii[1]
    angle = random.random() * math.tau
    beyond = random.choice([0.0, 2.0**-52, 2.0**-50, 2.0**-45, 0.1, 1.0])
    x, y = (reach * (1.0 + beyond) * f(angle) for f in (math.cos, math.sin))
    shapes = [random.choice(SHAPES) for _ in "ab"]
    # The first body points away from the second one, which is at its vertex (0, 0).
    signs = (-math.copysign(1.0, x), -math.copysign(1.0, y))
    first = [(size * signs[0] * p, size * signs[1] * q) for p, q in shapes[0]]
    second = [(x - size * signs[0] * p, y - size * signs[1] * q) for p, q in shapes[1]]
    velocities = [
        (size * float(awkward_number(random, 2)), size * float(awkward_number(random, 2)))
        for _ in "ab"
    ]
    return _Moving(first, velocities[0], radii[0]), _Moving(second, velocities[1], radii[1])
