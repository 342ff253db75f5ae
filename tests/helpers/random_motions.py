"""Random scenes of one kind of motion with one kind of number, at any place, time and scale.

Coefficients are random, so nothing but the events themselves is degenerate.
"""

import math
import random
from dataclasses import dataclass
from fractions import Fraction

from exactpt import Affine, Body, Pieces, Rigid, Scene, Translation

__all__ = ["MOTIONS", "NUMBERS", "SETTINGS", "Setting", "lanes", "random_scene"]

NUMBERS = ["doubles", "decimals", "ratios"]
MOTIONS = {
    "linear": 1,
    "quadratic": 2,
    "cubic": 3,
    "quartic": 4,
    "rotation": 0,
    "rolling": 1,
    "wobbling": 1,
    "affine": 1,
    "slightly affine": 1,
    "pieces": 1,
    "deforming": 1,
    "any": 0,
}
"""Kinds of motion, with the degree of the translation in them; "any" is another for each body."""
SPAN = 8


@dataclass(frozen=True)
class Setting:
    """Where, when, and at what scale of space and time a scene takes place."""

    place: Fraction = Fraction(0)
    start: Fraction = Fraction(0)
    size: Fraction = Fraction(1)
    duration: Fraction = Fraction(1)


SETTINGS = {
    "here": Setting(),
    "far": Setting(place=Fraction(10**9)),
    "very far": Setting(place=Fraction(10**15, 7)),
    "late": Setting(start=Fraction(10**6)),
    "very late": Setting(start=Fraction(10**12, 7)),
    "small": Setting(size=Fraction(1, 10**30)),
    "large": Setting(size=Fraction(10**30)),
    "fast": Setting(duration=Fraction(1, 10**30)),
    "slow": Setting(duration=Fraction(10**30)),
    "small and slow": Setting(size=Fraction(1, 10**5), duration=Fraction(10**7)),
    "large and fast": Setting(size=Fraction(10**7), duration=Fraction(1, 10**7)),
}


@dataclass
class Random:
    """Random numbers of one kind, and polynomials with them in one setting."""

    rng: random.Random
    numbers: str
    setting: Setting

    def number(self, size):
        """A number of absolute value at most ``size``."""
        size = Fraction(size)
        if self.numbers == "decimals":
            return size * Fraction(self.rng.randint(-(10**4), 10**4), 10**4)
        if self.numbers == "ratios":
            q = self.rng.randint(1, 997)
            return size * Fraction(self.rng.randint(-q, q), q)
        return Fraction(self.rng.uniform(-1, 1) * float(size))

    def kept(self, q):
        """A number of the setting's scale, as a number of the kind."""
        return Fraction(float(q)) if self.numbers == "doubles" else q

    def path(self, coefficients, size=None):
        """The polynomial with these coefficients in the scene's own space and time."""
        size = self.setting.size if size is None else size
        f = [
            self.kept(Fraction(c) * size / self.setting.duration**i)
            for i, c in enumerate(coefficients)
        ]
        for i in range(len(f) - 1):
            for j in range(len(f) - 2, i - 1, -1):
                f[j] -= self.setting.start * f[j + 1]
        return f

    def translation(self, degree, speed=Fraction(1, 4)):
        """Two paths from the origin."""
        return tuple(
            self.path([0, *(self.number(speed / 4**i) for i in range(degree))]) for _ in "xy"
        )


def random_scene(motion, numbers, seed, *, setting=SETTINGS["here"], side=4):
    """A grid of ``side`` by ``side`` random polygons."""
    draw = Random(random.Random(f"{motion}:{numbers}:{seed}"), numbers, setting)
    bodies = []
    for i in range(side):
        for j in range(side):
            x, y = (10 * k + draw.number(1) for k in (i, j))
            bodies.append(_body(draw, motion, f"b{i}-{j}", x, y))
    start = setting.start
    return Scene(bodies, (start, start + SPAN * setting.duration))


def _body(draw, motion, name, x, y):
    if motion == "any":
        motion = draw.rng.choice([kind for kind in MOTIONS if kind != "any"])
    vertices, size = [], draw.rng.choice([3, 4, 5])
    first = draw.rng.random()
    for k in range(size):
        angle = 2 * math.pi * (first + k) / size
        px = x + Fraction(round(300 * math.cos(angle)), 100) + draw.number(Fraction(1, 2))
        py = y + Fraction(round(300 * math.sin(angle)), 100) + draw.number(Fraction(1, 2))
        vertices.append(tuple(draw.kept(p * draw.setting.size) for p in (px, py)))
    offset = draw.setting.place * draw.setting.size
    vertices = [(p + offset, q + offset) for p, q in vertices]
    if motion == "deforming":
        vertices = [
            {"x": _added([p], draw.translation(1, Fraction(1, 20))[0]),
             "y": _added([q], draw.translation(1, Fraction(1, 20))[1])}
            for p, q in vertices
        ]  # fmt: skip
    center = tuple(draw.kept(c * draw.setting.size) + offset for c in (x, y))
    return Body(name, vertices, _motion(draw, motion, center))


def _motion(draw, motion, center):
    dx, dy = draw.translation(MOTIONS[motion])
    if motion in ("rotation", "rolling", "wobbling"):
        turn = {
            "rotation": [0, draw.number(Fraction(1, 4))],
            "rolling": [draw.number(1), draw.number(Fraction(1, 4))],
            "wobbling": [draw.number(1), draw.number(Fraction(1, 4)), draw.number(Fraction(1, 32))],
        }[motion]
        pivot = [c + draw.kept(draw.number(1) * draw.setting.size) for c in center]
        return Rigid(draw.path(turn, Fraction(1)), pivot=pivot, x=dx, y=dy)
    if motion in ("affine", "slightly affine"):
        grain = Fraction(1, 64) if motion == "affine" else Fraction(1, 10**6)
        (a, b), (c, d) = (
            [draw.path([int(i == j), draw.number(grain)], Fraction(1)) for j in (0, 1)]
            for i in (0, 1)
        )
        p, q = center
        return Affine(
            [[a, b], [c, d]],
            x=_added(_added(dx, [p]), [-p * m - q * n for m, n in zip(a, b, strict=True)]),
            y=_added(_added(dy, [q]), [-p * m - q * n for m, n in zip(c, d, strict=True)]),
        )
    if motion == "pieces":
        t = draw.setting.start + draw.kept(
            (Fraction(SPAN, 2) + draw.number(SPAN // 2 - 1)) * draw.setting.duration
        )
        ex, ey = draw.translation(1)
        ex[0] += (dx[1] - ex[1]) * t + dx[0] - ex[0]
        ey[0] += (dy[1] - ey[1]) * t + dy[0] - ey[0]
        return Pieces([(t, Translation(dx, dy)), (None, Translation(ex, ey))])
    return Translation(dx, dy)


def _added(f, g):
    size = max(len(f), len(g))
    f, g = ([*h, *[Fraction(0)] * (size - len(h))] for h in (f, g))
    return [a + b for a, b in zip(f, g, strict=True)]


def lanes(numbers, seed, bodies=300, direction=(Fraction(3, 5), Fraction(4, 5))):
    """Polygons in parallel lanes: all velocities are multiples of one direction."""
    draw = Random(random.Random(f"lanes:{numbers}:{seed}"), numbers, SETTINGS["here"])
    side, found = math.isqrt(bodies - 1) + 1, []
    for k in range(bodies):
        x, y = (10 * i + draw.number(1) for i in divmod(k, side))
        speed = draw.number(1)
        v = [float(speed * d) if numbers == "doubles" else speed * d for d in direction]
        body = _body(draw, "linear", f"b{k}", x, y)
        found.append(Body(f"b{k}", body.vertices, Translation([0, v[0]], [0, v[1]])))
    return Scene(found, (0, 20))
