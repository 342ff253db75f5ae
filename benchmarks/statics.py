"""The greedy pseudo-triangulation of one instant, for bodies with more and more vertices.

The vertical decomposition and the rotational sweep take O(k log^2 n) comparisons for k convex
bodies of n vertices each, once these have been read (the paper: O(k log n), section 4.1).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from random import Random
from typing import Final, NamedTuple

from benchmarks.output import Output, Row
from benchmarks.timing import exponent, timed
from exactpt.certificates.at_time import PredicatesAt
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.vertices import Vertices
from exactpt.tiling.greedy.sweep import greedy_diagonals
from exactpt.tiling.greedy.vertical import VerticalDecomposition

__all__ = ["FULL", "QUICK", "Sizes", "run", "swept"]


class Sizes(NamedTuple):
    """The number of bodies, and the numbers of vertices that each of them has in turn."""

    bodies: int
    vertices: Sequence[int]


QUICK: Final = Sizes(16, (8, 64, 512))
FULL: Final = Sizes(64, (8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096))


class Swept(NamedTuple):
    """The cost of one pseudo-triangulation.

    Attributes:
        diagonals: their number.
        decisions: number of signs and comparisons of abscissas.
        seconds: of processor time, without the reading of the bodies.
    """

    diagonals: int
    decisions: int
    seconds: float


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Build the pseudo-triangulation for each number of vertices."""
    rows: list[Row] = []
    found = []
    for n in sizes.vertices:
        bodies = _round_bodies(sizes.bodies, n, Random(f"statics:{seed}"))
        one = swept(bodies)
        found.append(one)
        rows.append(
            {
                "vertices a body": n,
                "diagonals": one.diagonals,
                "decisions": one.decisions,
                "ms": 1e3 * one.seconds,
            }
        )
    output.table("statics", rows)
    fits: Row = {
        "p decisions": exponent(sizes.vertices, [one.decisions for one in found]),
        "p ms": exponent(sizes.vertices, [one.seconds for one in found]),
    }
    output.table("statics-exponents", [fits])


def swept(bodies: Sequence[Body]) -> Swept:
    """The greedy pseudo-triangulation of convex bodies at time 0; the best of three."""
    vertices = Vertices.of(bodies, QQ(0), QQ(1))
    instant = PredicatesAt(vertices, QQ(0))

    def build() -> int:
        diagonals, _ = greedy_diagonals(instant, VerticalDecomposition.at(instant))
        return len(diagonals)

    before = vertices.counters.now()
    diagonals, seconds = timed(build)
    after = vertices.counters.now()
    decisions = after.filtered + after.exact - before.filtered - before.exact
    return Swept(diagonals, decisions, min(seconds, *(timed(build)[1] for _ in range(2))))


def _round_bodies(k: int, n: int, rng: Random) -> list[Body]:
    """Polygons inscribed in circles, the same circles for every n, in a grid of cells."""
    side = math.isqrt(k - 1) + 1
    bodies = []
    for i in range(k):
        x, y = 10 * (i % side) + 3 * rng.random(), 10 * (i // side) + 3 * rng.random()
        radius, turn = 2.0 + 1.4 * rng.random(), rng.random()
        angles = [2 * math.pi * (j + turn) / n for j in range(n)]
        points = [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]
        bodies.append(Body(f"b{i}", points))
    return bodies
