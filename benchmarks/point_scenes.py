"""Scenes of moving points: random ones, and ones whose tiling changes often."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Final

from exactpt import Body, Scene, Translation

__all__ = ["FAMILIES", "random_linear", "swaps_beside_arc"]


def random_linear(n: int, rng: Random) -> Scene:
    """Positions in [0, 10^6]^2, velocities in [-10^4, 10^4]^2, time 0 to 100."""
    return Scene([_random_point(rng, i, 0) for i in range(n)], (0, 100))


def random_quadratic(n: int, rng: Random) -> Scene:
    """As `random_linear`, with an acceleration for each point."""
    return Scene([_random_point(rng, i, 200) for i in range(n)], (0, 100))


def _random_point(rng: Random, i: int, acceleration: int) -> Body:
    x, y = (
        [0, rng.randint(-(10**4), 10**4)]
        + [rng.randint(-acceleration, acceleration)] * (acceleration > 0)
        for _ in range(2)
    )
    return Body(f"p{i}", [(rng.randint(0, 10**6), rng.randint(0, 10**6))], Translation(x, y))


def crossing_lines(n: int, rng: Random) -> Scene:
    """Half the points on a line, half on another line that crosses it; slightly perturbed."""
    bodies = []
    for i in range(n):
        line, k = i % 2, i // 2
        x, y = 10**6 * k + rng.randint(0, 10**5), rng.randint(-10, 10)
        if line:
            at = (x // 3 - 10**6 * n // 4, 10**6 * n // 8 + x // 5 + y)
            bodies.append(Body(f"p{i}", [at], Translation([0, 10**6], [0, -(10**5) * 3])))
        else:
            bodies.append(Body(f"p{i}", [(x, y)]))
    return Scene(bodies, (0, n))


def parabola_on_line(n: int, rng: Random) -> Scene:
    """A parabola, open to the left, sweeps over points close to a steep line."""
    m = n // 2
    bodies = []
    for i in range(m):
        y = 2 * i - m
        at = (-1000 * y * y + rng.randint(0, 999), 1000 * y + rng.randint(0, 9))
        bodies.append(Body(f"a{i}", [at], Translation([0, 1000 * m])))
    for i in range(n - m):
        at = (rng.randint(1000, 2000) * (i + 1), 1000 * (2 * i - m) + rng.randint(10, 999))
        bodies.append(Body(f"b{i}", [at], Translation([0, rng.randint(-30, 30)])))
    return Scene(bodies, (0, 2 * m))


def turns_beside_arc(n: int, rng: Random) -> Scene:
    """Points that take turns in being the first to the right of an arc, each seeing all of it.

    The arc is a parabola at rest. Point k of the others has x = far + (k^2 - 2 k t), the smallest
    near t = k, and is above or below the arc alternately.
    """
    m = n // 2
    bodies = []
    for i in range(m):
        y = 2 * i - m
        bodies.append(Body(f"a{i}", [(-1000 * y * y, 8000 * y + rng.randint(0, 99))]))
    for k in range(n - m):
        y = (1 if k % 2 else -1) * (40000 * m + 20 * k + rng.randint(0, 9))
        x = [1000 * (4 * m * m + k * k) + rng.randint(0, 99), -2000 * k - rng.randint(0, 9)]
        bodies.append(Body(f"b{k}", [{"x": x, "y": [y]}]))
    return Scene(bodies, (0, n - m))


def swaps_beside_arc(n: int, _: Random) -> Scene:
    """Two points beside a long arc swap 400 times; the chain r r' is the whole arc each time."""
    m, swaps = n - 2, 400
    bodies = []
    for i in range(m):
        y = 2 * i - m
        bodies.append(Body(f"a{i}", [(-y * y, 2 * y)]))
    for name, s, y in (("p", 1, 3 * m), ("q", -1, -3 * m)):
        frames = [(t, [(m * m + (s if t % 2 else -s), y)]) for t in range(swaps + 1)]
        bodies.append(Body(name, keyframes=frames))
    return Scene(bodies, (0, swaps))


FAMILIES: Final[dict[str, Callable[[int, Random], Scene]]] = {
    "random, linear": random_linear,
    "random, quadratic": random_quadratic,
    "two lines crossing": crossing_lines,
    "parabola sweeps a line": parabola_on_line,
    "turns beside an arc": turns_beside_arc,
}
"""By name, functions from the number of points and a random generator to a scene."""
