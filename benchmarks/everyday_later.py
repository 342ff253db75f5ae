"""Ten more families, written after the search had been mended by the first ten."""

from __future__ import annotations

import math
from random import Random
from typing import Final

from benchmarks.everyday import Family, Points
from exactpt import Affine, Body, Pieces, Rigid, Scene, Translation

__all__ = ["EVERYDAY_LATER"]


def _around(x: float, y: float, radius: float, corners: int, turn: float = 0.0) -> Points:
    angles = [turn + 2.0 * math.pi * i / corners for i in range(corners)]
    return [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]


def _billiards(rng: Random, size: int) -> Scene:
    """A rack of balls, and one that comes and slows down."""
    balls = [
        Body(f"ball{i}-{j}", _around(30.0 + 2.2 * i, 2.5 * j - 1.25 * i, 1.0, 16))
        for i in range(size)
        for j in range(i + 1)
    ]
    cue = Translation([0.0, rng.uniform(8.0, 9.0), -0.6], [0.0, rng.uniform(-0.3, 0.3)])
    return Scene([*balls, Body("cue", _around(0.0, 0.0, 1.0, 16), cue)], (0, 6))


def _stop_and_go(rng: Random, size: int) -> Scene:
    """Crates on belts that stop and go on."""
    crates = []
    for i in range(6 * size):
        x, y, speed = 4.0 * (i // 6), 3.0 * (i % 6), rng.randint(1, 3)
        rest, ends = 0, []
        for stop in range(1, 10):
            ends.append((2 * stop - 1, Translation([rest - speed * (2 * stop - 2), speed])))
            rest += speed
            ends.append((2 * stop, Translation([rest])))
        outline = [(x, y), (x + 1.5, y), (x + 1.5, y + 2.0), (x, y + rng.uniform(1.0, 2.8))]
        crates.append(Body(f"crate{i}", outline, Pieces([*ends, (None, Translation([rest]))])))
    return Scene(crates, (0, 18))


def _gears(rng: Random, size: int) -> Scene:
    """Gears in a row that turn, and come closer to each other."""
    gears = []
    for i in range(6):
        teeth = 3 * size
        outline = [
            (16.4 * i + r * math.cos(a), r * math.sin(a))
            for k in range(teeth)
            for r, a in (
                (6.0, 2.0 * math.pi * k / teeth),
                (8.0, 2.0 * math.pi * (k + 0.5 + rng.uniform(-0.1, 0.1)) / teeth),
            )
        ]
        rate, drift = (-1) ** i * rng.uniform(0.04, 0.05), [0.0, (-1) ** i * 0.05]
        gears.append(Body(f"gear{i}", outline, Rigid([0.0, rate], pivot=(16.4 * i, 0.0), x=drift)))
    return Scene(gears, (0, 8))


def _swarm(rng: Random, size: int) -> Scene:
    """Points that fly through walls of chains."""
    points = [
        Body(
            f"p{i}",
            [(rng.uniform(0, 50), rng.uniform(0, 50))],
            Translation([0.0, rng.gauss(0, 1)], [0.0, rng.gauss(0, 1)]),
        )
        for i in range(10 * size)
    ]
    walls = [
        Body(f"w{i}", [(9.0 * i + rng.uniform(0, 2), 60.0 + k) for k in range(12)], closed=False)
        for i in range(5)
    ]
    return Scene([*points, *walls], (0, 12))


def _pendulums(rng: Random, size: int) -> Scene:
    """Chains that swing beside each other."""
    chains = []
    for i in range(3 * size):
        x = 5.0 * i
        chain = [(x + rng.uniform(-0.3, 0.3), -float(k)) for k in range(9)]
        swing = [rng.uniform(-0.02, 0.02), rng.uniform(-0.1, 0.1)]
        chains.append(Body(f"c{i}", chain, Rigid(swing, pivot=(x, 0.0)), closed=False))
    return Scene(chains, (0, 9))


def _blobs(rng: Random, size: int) -> Scene:
    """Bodies that swell, each vertex at its own rate."""
    blobs = []
    for i in range(3 * size):
        x, y = 8.0 * (i % 6), 8.0 * (i // 6)
        outline = [
            {"x": [p, s * (p - x), 0.01], "y": [q, s * (q - y)]}
            for p, q in _around(x, y, 2.0, 11, rng.random())
            for s in [rng.uniform(0.05, 0.1)]
        ]
        blobs.append(Body(f"blob{i}", outline))
    return Scene(blobs, (0, 12))


def _broom(rng: Random, size: int) -> Scene:
    """A bar swept over segments that stand at random."""
    segments = []
    for i in range(15 * size):
        x, y, a = 3.0 * (i % 15), 3.0 * (i // 15), rng.uniform(0.0, math.pi)
        segments.append(Body(f"s{i}", [(x, y), (x + 1.4 * math.cos(a), y + 1.4 * math.sin(a))]))
    bar = Body("bar", [(-9.0, -9.0), (-8.0, 40.0)], Translation([0.0, 0.7, 0.03], [0.0, 0.01]))
    return Scene([*segments, bar], (0, 10))


def _arms(rng: Random, size: int) -> Scene:
    """Arms that follow key frames beside posts."""
    bodies = []
    for i in range(size):
        x = 20.0 * i
        frames = [
            (2 * t, [(x, 0.0), (x + 3.0, rng.uniform(3, 5)), (x + rng.uniform(6.0, 11.0), 6.0)])
            for t in range(6)
        ]
        bodies.append(Body(f"arm{i}", keyframes=frames, closed=False))
        bodies.append(Body(f"post{i}", _around(x + 13.0, 6.0, rng.uniform(1.0, 1.9), 7)))
    return Scene(bodies, (0, 10))


def _throws(rng: Random, size: int) -> Scene:
    """Bodies on paths of degree 5."""
    bodies = []
    for i in range(4 * size):
        x, y = 9.0 * (i % 8), 9.0 * (i // 8)
        path = [[0.0, *(rng.uniform(-1.0, 1.0) / 2.0**k for k in range(1, 6))] for _ in "xy"]
        outline = _around(x, y, 2.5, rng.randint(3, 7), rng.random())
        bodies.append(Body(f"b{i}", outline, Translation(*path)))
    return Scene(bodies, (0, 3))


def _sheared(rng: Random, size: int) -> Scene:
    """Bodies that are sheared and drift."""
    bodies = []
    for i in range(3 * size):
        x, y = 9.0 * (i % 6), 9.0 * (i // 6)
        shear = [[[1.0], [0.0, rng.uniform(-0.02, 0.02)]], [[0.0], [1.0]]]
        drift = [0.0, rng.uniform(-0.5, 0.5)]
        outline = _around(x, y, 3.0, rng.randint(3, 9), rng.random())
        bodies.append(Body(f"b{i}", outline, Affine(shear, x=drift)))
    return Scene(bodies, (0, 10))


EVERYDAY_LATER: Final[dict[str, Family]] = {
    "a billiard break": _billiards,
    "crates that stop and go": _stop_and_go,
    "gears": _gears,
    "a swarm of points": _swarm,
    "pendulums": _pendulums,
    "blobs that swell": _blobs,
    "a bar over segments": _broom,
    "arms at key frames": _arms,
    "paths of degree 5": _throws,
    "sheared bodies": _sheared,
}
"""By name, as `benchmarks.everyday.EVERYDAY`."""
