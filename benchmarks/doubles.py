"""Exact first contacts beside a plain sweep-and-prune in C++ doubles, the floor of run time.

Convex bodies of doubles translate; of crowds a few in a thousand meet. The program in C++ has all
numbers in its own arrays, neither bounds nor tolerances, and returns one double. exactpt is
measured with a scene that is built before, and with the building of a scene from arrays. Times are
the least of some turns, in each of which all ways have the same scenes, built anew.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from random import Random
from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np

from benchmarks.methods.cpp import SWEEP_AND_PRUNE, has_compiler
from benchmarks.methods.method import Answer
from benchmarks.methods.own import in_build
from benchmarks.output import Output, Row
from benchmarks.timing import timed
from exactpt import AuditError, Body, Scene, Translation, first_contact
from exactpt.testing.scenes.shapes import cells

__all__ = ["FULL", "QUICK", "Sizes", "run"]

Points: TypeAlias = "list[tuple[float, float]]"
Ask: TypeAlias = Callable[[], Answer]

FLOOR: Final = "C++ doubles"
ROUNDING: Final = 1e-9
"""More than the times in doubles are off."""
SPACING: Final = 10
"""Width of the cells, in each of which there is at most one body, of radius 1."""


class Crowd(NamedTuple):
    """Convex bodies: the corners of each at time 0, and its velocity."""

    outlines: list[Points]
    velocities: Points
    end: float


class Sizes(NamedTuple):
    """Numbers of scenes of two triangles, of crowds by the number of their bodies, of turns."""

    triangles: int
    crowds: Mapping[int, int]
    turns: int


QUICK: Final = Sizes(triangles=10, crowds={10: 5, 100: 2}, turns=2)
FULL: Final = Sizes(triangles=200, crowds={10: 100, 100: 20, 1000: 5, 10_000: 3}, turns=9)


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Measure all sizes.

    Raises:
        AuditError: if two ways have different results: for C++ other than by rounding.
    """
    if not has_compiler():
        output.say("skipped: g++ is not installed: no sweep-and-prune in C++")
    rng = Random(f"doubles {seed}")
    triangles = [_two_triangles(rng) for _ in range(sizes.triangles)]
    rows = _rows("two triangles", triangles, sizes.turns)
    for n, count in sizes.crowds.items():
        output.progress(f"doubles: {n} bodies")
        rows += _rows(f"{n} bodies", [_crowd(rng, n) for _ in range(count)], sizes.turns)
    output.table("doubles", rows)


def _polygon(rng: Random, x: float, y: float, corners: int) -> Points:
    """Return a convex polygon on a circle of radius 1 around (x, y)."""
    turn = rng.uniform(0.0, 2.0 * math.pi)
    angles = [turn + 2.0 * math.pi * (i + rng.uniform(0.1, 0.9)) / corners for i in range(corners)]
    return [(x + math.cos(a), y + math.sin(a)) for a in angles]


def _two_triangles(rng: Random) -> Crowd:
    """Return a triangle at rest, and one that comes to it from a distance of about 2."""
    outlines = [_polygon(rng, 0.0, 0.0, 3), _polygon(rng, 4.0, 0.0, 3)]
    return Crowd(outlines, [(rng.uniform(0.3, 1.0), rng.uniform(-0.2, 0.2)), (0.0, 0.0)], 10.0)


def _crowd(rng: Random, n: int) -> Crowd:
    """Return bodies that move by up to a cell in each direction."""
    centers = [(float(x), float(y)) for x, y in cells(rng, n, SPACING)]
    outlines = [_polygon(rng, x, y, rng.randint(3, 6)) for x, y in centers]
    velocities = [(rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)) for _ in centers]
    return Crowd(outlines, velocities, 2.0)


def _scene(crowd: Crowd) -> Scene:
    """Return the scene of bodies, built from doubles."""
    bodies = [
        Body(f"b{i}", outline, Translation([0.0, u], [0.0, v]))
        for i, (outline, (u, v)) in enumerate(zip(crowd.outlines, crowd.velocities, strict=True))
    ]
    return Scene(bodies, (0.0, crowd.end))


def _arrays(crowd: Crowd) -> dict[str, Any]:
    """Return the arguments of `Scene.from_arrays`."""
    return {
        "vertices": np.array([point for outline in crowd.outlines for point in outline]),
        "offsets": np.cumsum([0, *map(len, crowd.outlines)]),
        "velocities": np.array(crowd.velocities),
        "time": (0.0, crowd.end),
    }


def _time(scene: Scene) -> Answer:
    contact = first_contact(scene)
    return None if contact is None else contact.time


def _prepare_scene(crowd: Crowd) -> Ask:
    return partial(_time, _scene(crowd))


def _prepare_arrays(crowd: Crowd) -> Ask:
    given = _arrays(crowd)
    return lambda: _time(Scene.from_arrays(**given))


def _prepare_floor(crowd: Crowd) -> Ask:
    return SWEEP_AND_PRUNE.prepare(_scene(crowd))


def _rows(question: str, crowds: Sequence[Crowd], turns: int) -> list[Row]:
    """Return a row of each way for some scenes, with its ratio to the floor."""
    ways = {in_build("scene"): _prepare_scene, in_build("from arrays"): _prepare_arrays}
    if has_compiler():
        ways = {FLOOR: _prepare_floor, **ways}
    answers: dict[str, list[Answer]] = {}
    seconds = dict.fromkeys(ways, math.inf)
    for _ in range(turns):
        for way, prepare in ways.items():
            asks = [prepare(crowd) for crowd in crowds]
            answers[way], spent = timed(lambda asks=asks: [ask() for ask in asks])  # type: ignore[misc]
            seconds[way] = min(seconds[way], spent)
    exact = answers[in_build("scene")]
    for way, found in answers.items():
        if not all(map(_agree, found, exact)):
            raise AuditError(f"doubles: {question}: {way} differs from the search of scenes")
    return [
        {
            "question": question,
            "way": way,
            "milliseconds": 1000.0 * seconds[way] / len(crowds),
            "ratio": seconds[way] / seconds[FLOOR] if FLOOR in seconds else None,
            "contacts": sum(time is not None for time in found),
            "scenes": len(crowds),
        }
        for way, found in answers.items()
    ]


def _agree(time: Answer, exact: Answer) -> bool:
    """Return True if a result is the exact one; a double, if it is the same up to rounding."""
    if time is None or exact is None:
        return time is exact
    return abs(time - float(exact)) < ROUNDING if isinstance(time, float) else time == exact
