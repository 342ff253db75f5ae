"""How often the tilings of convex bodies change, beside the paper's bounds.

Lemma 4.5 and Theorem 4.6 bound the changes of the greedy tiling. The families have no contacts, so
every run goes on to the end of its time span. c and p of c n^p are fitted by least squares over
the logarithms. The counts are the same on every machine.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import cos, exp, log, pi, sin
from random import Random
from typing import Final, NamedTuple

from benchmarks.output import Output, Row
from benchmarks.timing import exponent
from exactpt import Body, Rigid, Scene, Translation
from exactpt.tiling.driver import Driver

__all__ = ["FULL", "QUICK", "Family", "changes", "run"]

RADIUS: Final = 10**6
KINDS: Final = ("corner", "reflex", "hull", "diagonal")
"""Kinds of events that change edges."""
TILINGS: Final = ("greedy", "lazy")


class Family(NamedTuple):
    """Scenes of one kind.

    Attributes:
        scene: the scene of a size and a seed.
        size: the name of the size.
        bound: the paper's bound on the changes of the greedy tiling, as a power of the size.
        source: where the paper has it.
    """

    scene: Callable[[int, int], Scene]
    size: str
    bound: int
    source: str


def outline(
    vertices: int, x: int, y: int, *, radius: int = RADIUS, shift: float = 0.0
) -> list[tuple[int, int]]:
    """A convex polygon close to a circle, with integer vertices."""
    angles = (2.0 * pi * (i + shift) / vertices for i in range(vertices))
    return [(x + round(radius * cos(a)), y + round(radius * sin(a))) for a in angles]


def passing(m: int, seed: int) -> Scene:
    """Two polygons of m vertices, one of which passes the other: lines turn by nearly pi."""
    rng = Random(f"passing {m} {seed}")
    first = Body("first", outline(m, 0, 0))
    second = outline(m, 0, 3 * RADIUS + rng.randrange(RADIUS), shift=0.37)
    return Scene([first, Body("second", second, Translation([-50 * RADIUS, 100 * RADIUS]))])


def three(m: int, seed: int) -> Scene:
    """Three polygons of m vertices: one passes between the two others, along their bitangents."""
    rng = Random(f"three {m} {seed}")
    bodies = [Body(f"{i}", outline(m, x * RADIUS, 0)) for i, x in enumerate((-4, 4))]
    across = outline(m, rng.randrange(RADIUS // 9), 0, shift=0.37)
    return Scene([*bodies, Body("across", across, Translation([], [-50 * RADIUS, 100 * RADIUS]))])


def turning(m: int, seed: int) -> Scene:
    """Two polygons of m vertices that turn by pi in opposite directions, side by side."""
    rng = Random(f"turning {m} {seed}")
    bodies = []
    for i, turn in enumerate(([-1, 2], [1, -2])):
        x, y = 3 * RADIUS * i, rng.randrange(RADIUS)
        bodies.append(Body(f"{i}", outline(m, x, y, shift=0.3 * i), Rigid(turn, pivot=(x, y))))
    return Scene(bodies)


def lanes(k: int, seed: int) -> Scene:
    """k squares in lanes, at random speeds, all of which pass each other."""
    rng = Random(f"lanes {k} {seed}")
    bodies = []
    for i in range(k):
        speed = rng.randrange(-100 * RADIUS, 100 * RADIUS)
        square = outline(4, rng.randrange(RADIUS), 3 * RADIUS * i, shift=rng.random())
        bodies.append(Body(f"b{i}", square, Translation([-speed, 2 * speed])))
    return Scene(bodies)


def rows(k: int, seed: int) -> Scene:
    """Two rows of k / 2 octagons each, one of which passes the other."""
    rng = Random(f"rows {k} {seed}")
    bodies = []
    for i in range(k):
        x, y = 3 * RADIUS * (i // 2) + rng.randrange(RADIUS // 2), rng.randrange(RADIUS // 9)
        ring = outline(8, x, y + 3 * RADIUS * (i % 2), shift=rng.random())
        path = [-3 * k * RADIUS, 6 * k * RADIUS] if i % 2 else []
        bodies.append(Body(f"b{i}", ring, Translation(path)))
    return Scene(bodies)


FAMILIES: Final = {
    "one passes another, translation": Family(passing, "vertices of each", 1, "Lemma 4.5"),
    "one passes between two, translation": Family(three, "vertices of each", 1, "Lemma 4.5"),
    "two turn by pi, rigid": Family(turning, "vertices of each", 2, "Lemma 4.5"),
    "squares in lanes, translation": Family(lanes, "bodies", 3, "Theorem 4.6"),
    "two rows pass, translation": Family(rows, "bodies", 3, "Theorem 4.6"),
}


class Sizes(NamedTuple):
    """Sizes of each family, in the order of `FAMILIES`."""

    sizes: Sequence[Sequence[int]]


QUICK: Final = Sizes(((8, 16), (8, 16), (4, 8), (3, 6), (4, 8)))
FULL: Final = Sizes(
    (
        (16, 32, 64, 128, 256, 512),
        (16, 32, 64, 128, 256, 512),
        (8, 16, 32, 64),
        (8, 16, 32, 64, 128),
        (8, 16, 32, 64, 128),
    )
)


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Count the changes of both tilings of all families."""
    found: list[Row] = []
    fits: list[Row] = []
    for (name, family), some in zip(FAMILIES.items(), sizes.sizes, strict=True):
        for tiling in TILINGS:
            counts = []
            for n in some:
                output.progress(f"{name}, {tiling}, size {n}")
                counts.append(changes(family.scene(n, seed), tiling))
                found.append({"family": name, "tiling": tiling, "size": n, "changes": counts[-1]})
            p = exponent(some, counts)
            c = exp(sum(log(m / n**p) for m, n in zip(counts, some, strict=True)) / len(some))
            fits.append(
                {
                    "family": name,
                    "tiling": tiling,
                    "of": family.size,
                    "changes": counts[-1],
                    "c": c,
                    "p": p,
                    "bound": family.bound,
                    "source": family.source,
                }
            )
    output.table("changes", found)
    output.table("changes-exponents", fits)


def changes(scene: Scene, tiling: str) -> int:
    """The number of events that change edges, up to the end; the scene has no contact."""
    driver = Driver(scene)
    driver.start(tiling)
    driver.run(scene.exact_end)
    return sum(driver.tiled.kinetic.stats.events.get(kind, 0) for kind in KINDS)
