"""Random scenes of one kind of motion with one kind of number, at any place, time and scale.

Coefficients are random, so nothing but the events themselves is degenerate: in general position.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from typing import Final, TypeAlias

from exactpt import Affine, Body, Pieces, Rigid, Scene, Translation
from exactpt.motion.motions import Motion

__all__ = ["MOTIONS", "NUMBERS", "SETTINGS", "Setting", "general_scene", "lanes", "random_scene"]

Path: TypeAlias = list[Fraction]
"""The coefficients of a coordinate, the constant one first."""

NUMBERS: Final = ("doubles", "decimals", "ratios")

MOTIONS: Final = {
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

SPAN: Final = 8


@dataclass(frozen=True, slots=True)
class Setting:
    """Where, when, and at what scale of space and time a scene takes place."""

    place: Fraction = Fraction(0)
    start: Fraction = Fraction(0)
    size: Fraction = Fraction(1)
    duration: Fraction = Fraction(1)


SETTINGS: Final = {
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


@dataclass(frozen=True, slots=True)
class _Draw:
    """Draws numbers of one kind, and polynomials with them in one setting."""

    random: Random
    numbers: str
    setting: Setting

    def number(self, size: Fraction | int) -> Fraction:
        """A number of absolute value at most ``size``."""
        most = Fraction(size)
        if self.numbers == "decimals":
            return most * Fraction(self.random.randint(-(10**4), 10**4), 10**4)
        if self.numbers == "ratios":
            q = self.random.randint(1, 997)
            return most * Fraction(self.random.randint(-q, q), q)
        return Fraction(self.random.uniform(-1, 1) * float(most))

    def kept(self, q: Fraction) -> Fraction:
        """A number of the setting's scale, as a number of the kind."""
        return Fraction(float(q)) if self.numbers == "doubles" else q

    def path(self, coefficients: Sequence[Fraction | int], size: Fraction | None = None) -> Path:
        """The polynomial with these coefficients in the scene's own space and time."""
        unit = self.setting.size if size is None else size
        f = [
            self.kept(Fraction(c) * unit / self.setting.duration**i)
            for i, c in enumerate(coefficients)
        ]
        for i in range(len(f) - 1):
            for j in range(len(f) - 2, i - 1, -1):
                f[j] -= self.setting.start * f[j + 1]
        return f

    def translation(self, degree: int, speed: Fraction = Fraction(1, 4)) -> tuple[Path, Path]:
        """Two paths from the origin."""
        x, y = (self.path([0, *(self.number(speed / 4**i) for i in range(degree))]) for _ in "xy")
        return x, y


def random_scene(
    motion: str,
    numbers: str,
    seed: float,
    *,
    setting: Setting = SETTINGS["here"],
    side: int = 4,
) -> Scene:
    """A grid of ``side`` by ``side`` random polygons.

    Args:
        motion: a kind of motion, of `MOTIONS`.
        numbers: a kind of number, of `NUMBERS`.
        seed: the seed of its numbers.
        setting: its place, time and scale.
        side: the number of rows and of columns.
    """
    return _scene_of(_Draw(Random(f"{motion}:{numbers}:{seed}"), numbers, setting), motion, side)


def general_scene(random: Random) -> Scene:
    """A grid of two by two random polygons, of any motion, numbers and setting."""
    motion, numbers = random.choice(sorted(MOTIONS)), random.choice(NUMBERS)
    setting = SETTINGS[random.choice(sorted(SETTINGS))]
    return _scene_of(_Draw(random, numbers, setting), motion, side=2)


def _scene_of(draw: _Draw, motion: str, side: int) -> Scene:
    bodies = []
    for i in range(side):
        for j in range(side):
            x, y = (10 * k + draw.number(1) for k in (i, j))
            bodies.append(_body(draw, motion, f"b{i}-{j}", x, y))
    start = draw.setting.start
    return Scene(bodies, (start, start + SPAN * draw.setting.duration))


def _body(draw: _Draw, motion: str, name: str, x: Fraction, y: Fraction) -> Body:
    if motion == "any":
        motion = draw.random.choice([kind for kind in MOTIONS if kind != "any"])
    corners = _corners(draw, x, y)
    if motion == "deforming":
        return Body(name, [_own_paths(draw, corner) for corner in corners], _motion(draw, motion))
    offset = draw.setting.place * draw.setting.size
    center = tuple(draw.kept(c * draw.setting.size) + offset for c in (x, y))
    return Body(name, corners, _motion(draw, motion, *center))


def _corners(draw: _Draw, x: Fraction, y: Fraction) -> list[tuple[Fraction, Fraction]]:
    """Return three to five points about on a circle."""
    size = draw.random.choice([3, 4, 5])
    first = draw.random.random()
    offset = draw.setting.place * draw.setting.size
    corners = []
    for k in range(size):
        angle = 2 * math.pi * (first + k) / size
        px = x + Fraction(round(300 * math.cos(angle)), 100) + draw.number(Fraction(1, 2))
        py = y + Fraction(round(300 * math.sin(angle)), 100) + draw.number(Fraction(1, 2))
        kept_x, kept_y = (draw.kept(p * draw.setting.size) for p in (px, py))
        corners.append((kept_x + offset, kept_y + offset))
    return corners


def _own_paths(draw: _Draw, corner: tuple[Fraction, Fraction]) -> dict[str, Path]:
    """Return a vertex with a motion of its own."""
    x, y = (_sum([p], draw.translation(1, Fraction(1, 20))[axis]) for axis, p in enumerate(corner))
    return {"x": x, "y": y}


def _motion(
    draw: _Draw, motion: str, x: Fraction = Fraction(0), y: Fraction = Fraction(0)
) -> Motion:
    """Return a motion of a kind; rotations and affine maps are about a center."""
    dx, dy = draw.translation(MOTIONS[motion])
    if motion in ("rotation", "rolling", "wobbling"):
        return _turn(draw, motion, (x, y), (dx, dy))
    if motion in ("affine", "slightly affine"):
        grain = Fraction(1, 64) if motion == "affine" else Fraction(1, 10**6)
        (a, b), (c, d) = (
            [draw.path([int(i == j), draw.number(grain)], Fraction(1)) for j in (0, 1)]
            for i in (0, 1)
        )
        back_x, back_y = (
            [-x * m - y * n for m, n in zip(*row, strict=True)] for row in ((a, b), (c, d))
        )
        return Affine(
            [[a, b], [c, d]], x=_sum(_sum(dx, [x]), back_x), y=_sum(_sum(dy, [y]), back_y)
        )
    if motion == "pieces":
        return _two_pieces(draw, dx, dy)
    return Translation(dx, dy)


def _turn(
    draw: _Draw, motion: str, center: tuple[Fraction, Fraction], shift: tuple[Path, Path]
) -> Rigid:
    quarter = draw.number(Fraction(1, 4))
    turn: list[Fraction | int] = [0, quarter]
    if motion != "rotation":
        turn[0] = draw.number(1)
    if motion == "wobbling":
        turn.append(draw.number(Fraction(1, 32)))
    pivot = [c + draw.kept(draw.number(1) * draw.setting.size) for c in center]
    return Rigid(draw.path(turn, Fraction(1)), pivot=(pivot[0], pivot[1]), x=shift[0], y=shift[1])


def _two_pieces(draw: _Draw, dx: Path, dy: Path) -> Pieces:
    """Return a translation that changes its velocity at some time, where it is."""
    since_start = (Fraction(SPAN, 2) + draw.number(SPAN // 2 - 1)) * draw.setting.duration
    time = draw.setting.start + draw.kept(since_start)
    ex, ey = draw.translation(1)
    ex[0] += (dx[1] - ex[1]) * time + dx[0] - ex[0]
    ey[0] += (dy[1] - ey[1]) * time + dy[0] - ey[0]
    return Pieces([(time, Translation(dx, dy)), (None, Translation(ex, ey))])


def _sum(f: Path, g: Path) -> Path:
    size = max(len(f), len(g))
    f, g = ([*h, *[Fraction(0)] * (size - len(h))] for h in (f, g))
    return [a + b for a, b in zip(f, g, strict=True)]


def lanes(
    numbers: str,
    seed: float,
    bodies: int = 300,
    direction: tuple[Fraction, Fraction] = (Fraction(3, 5), Fraction(4, 5)),
) -> Scene:
    """Polygons in parallel lanes: all velocities are multiples of one direction."""
    return _lanes_of(
        _Draw(Random(f"lanes:{numbers}:{seed}"), numbers, SETTINGS["here"]), bodies, direction
    )


def _lanes_of(draw: _Draw, bodies: int, direction: tuple[Fraction, Fraction]) -> Scene:
    side, found = math.isqrt(bodies - 1) + 1, []
    for k in range(bodies):
        x, y = (10 * i + draw.number(1) for i in divmod(k, side))
        speed = draw.number(1)
        velocity = [draw.kept(speed * d) for d in direction]
        corners = _corners(draw, x, y)
        found.append(Body(f"b{k}", corners, Translation([0, velocity[0]], [0, velocity[1]])))
    return Scene(found, (0, 20))
