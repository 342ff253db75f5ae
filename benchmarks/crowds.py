"""The first contact of crowds of convex bodies: built from arrays, and from bodies.

Times are the least of some runs, each with a scene built anew. Both scenes have the same result.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from random import Random
from typing import Final, NamedTuple

import numpy as np

from benchmarks.output import Output, Row
from benchmarks.shapes import crowd
from benchmarks.timing import beside, in_turn, near
from exactpt import Body, Contact, Scene, Translation, first_contact
from exactpt.kernel.doubles import Floats
from exactpt.kernel.numbers import QQ

__all__ = ["FULL", "QUICK", "Sizes", "run"]


class Sizes(NamedTuple):
    """Numbers of bodies of dense and of sparse crowds, and of runs."""

    dense: Sequence[int]
    sparse: Sequence[int]
    runs: int


QUICK: Final = Sizes(dense=(100,), sparse=(100, 1000), runs=2)
FULL: Final = Sizes(dense=(1000,), sparse=(1000, 100_000), runs=7)

RADII: Final = {"dense": 400, "sparse": 60}
"""Radius of bodies in cells of width 1,000."""


class _Arrays(NamedTuple):
    """A crowd in arrays: vertices (n, 2), offsets (k + 1), velocities (k, 2)."""

    vertices: Floats
    offsets: Sequence[int]
    velocities: Floats


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Measure all crowds.

    Raises:
        AuditError: if the two scenes of a crowd have different results.
    """
    rows: list[Row] = []
    for density, numbers in (("dense", sizes.dense), ("sparse", sizes.sparse)):
        for k in numbers:
            output.progress(f"crowds: {k} bodies, {density}")
            rng = Random(f"crowds {density} {k} {seed}")
            scene = crowd(k, rng, radius=RADII[density], end=1)
            asked = {
                "arrays": partial(_from_arrays, _arrays_of(scene)),
                "bodies": partial(_from_bodies, _arrays_of(scene)),
            }
            what = f"{k} bodies, {density}"
            builds = {way: partial(partial, build) for way, build in asked.items()}
            built = {way: seconds for way, (_, seconds) in in_turn(builds, sizes.runs).items()}
            ways = {way: partial(_asking, build) for way, build in asked.items()}
            contact, answered = beside(what, ways, sizes.runs, lambda c: c and c.to_json())
            rows += [_row(density, k, w, built[w], answered[w], contact) for w in asked]
    output.table("crowds", rows)


def _arrays_of(scene: Scene) -> _Arrays:
    """The crowd of a scene, whose vertices at the start and velocities are integers."""
    places = [body.exact_at(QQ(0)) for body in scene.bodies]
    after = [body.exact_at(QQ(1)) for body in scene.bodies]
    velocities = [
        (float(b[0][0] - a[0][0]), float(b[0][1] - a[0][1]))
        for a, b in zip(places, after, strict=True)
    ]
    offsets = np.cumsum([0, *map(len, places)]).tolist()
    vertices = np.array([(float(x), float(y)) for place in places for x, y in place])
    return _Arrays(vertices, offsets, np.array(velocities))


def _from_arrays(given: _Arrays) -> Scene:
    return Scene.from_arrays(given.vertices, given.offsets, velocities=given.velocities)


def _from_bodies(given: _Arrays) -> Scene:
    points, velocities = given.vertices.tolist(), given.velocities.tolist()
    return Scene(
        [
            Body(str(i), points[first:last], Translation([0.0, u], [0.0, v]))
            for i, (first, last, (u, v)) in enumerate(
                zip(given.offsets, given.offsets[1:], velocities, strict=False)
            )
        ],
        (0, 1),
    )


def _asking(build: Callable[[], Scene]) -> Callable[[], Contact | None]:
    return partial(first_contact, build())


def _row(
    density: str, bodies: int, way: str, built: float, answered: float, contact: Contact | None
) -> Row:
    return {
        "crowd": density,
        "bodies": bodies,
        "scene of": way,
        "ms to build": 1000.0 * built,
        "ms to answer": 1000.0 * answered,
        "time": near(contact),
    }
