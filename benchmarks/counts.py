"""What a search by pairs does: slabs, pairs, comparisons, exact decisions, as its scenes grow.

A scene of size n is n scenes of a family, beside each other and far enough apart that none comes to
another. So its first contact must be the earliest of theirs. The more scenes, the earlier this is:
a search ends with the slab of time that has the contact, and need not grow with the size.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import count, islice
from typing import Any, Final, NamedTuple, cast

from benchmarks.output import Output, Row
from benchmarks.timing import time_of
from exactpt import AlgebraicNumber, AuditError, Scene, first_contact
from exactpt.kernel.numbers import QQ
from exactpt.scene.written import to_json
from exactpt.search.first import pair_search
from exactpt.testing.scenes import generate
from fuzz.changes.variants import Variant

__all__ = ["FULL", "QUICK", "Sizes", "beside", "run"]

FAMILIES: Final = (
    "convex",
    "mixed_shapes",
    "ballistic",
    "turning",
    "deforming",
    "pieces",
    "keyframed",
    "grids_passing",
    "row",
    "convoy",
    "polygons_in_step",
    "grazing",
    "stars",
    "turning_stars",
    "combs",
    "spirals",
    "clamps",
    "letters",
    "chains",
    "flat",
    "nested",
    "linear_points",
    "ballistic_points",
    "turning_points",
    "parabola_points",
    "kissing_discs",
    "sliding_capsules",
    "rounded_motions",
    "lakes",
    "orbits",
)
"""Families of `exactpt.testing.scenes`; of each, most scenes are apart at the start."""

MOMENTS: Final = 16
"""Number of parts of a time span at whose ends the extent of a scene is measured."""

APART: Final = 3
"""Width of the cell of a scene, in extents of the widest one."""


class Alone(NamedTuple):
    """A scene, and the time of its first contact; None without one."""

    scene: Scene
    time: AlgebraicNumber | None


class Sizes(NamedTuple):
    """Families, and numbers of their scenes beside each other."""

    families: Sequence[str]
    scenes: Sequence[int]


QUICK: Final = Sizes(FAMILIES[::6], (1, 4))
FULL: Final = Sizes(FAMILIES, (1, 4, 16, 64, 256))


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Count for all families and sizes.

    Raises:
        AuditError: if the first contact is not the earliest of those of the scenes alone.
    """
    rows: list[Row] = []
    for family in sizes.families:
        output.progress(f"counts: {family}")
        scenes = list(islice(_apart_at_start(family, seed), max(sizes.scenes)))
        rows.extend({"family": family, **_counts(scenes[:n])} for n in sizes.scenes)
    output.table("counts", rows)


def _apart_at_start(family: str, seed: int) -> Iterator[Alone]:
    """Yield the scenes of a family, from a seed on, in which no bodies touch at the start."""
    for number in count(seed):
        scene = generate(family, number)
        time = time_of(first_contact(scene))
        if time is None or time > scene.exact_start:
            yield Alone(scene, time)


def _counts(scenes: Sequence[Alone]) -> Row:
    """Return the counts of a search of scenes beside each other, by name of the column.

    Raises:
        AuditError: if the first contact is not the earliest of those of the scenes alone.
    """
    scene = beside([alone.scene for alone in scenes])
    search = pair_search(scene)
    found = time_of(search.run_to_contact())
    times = [alone.time for alone in scenes if alone.time is not None]
    expected = min((time for time in times if time <= scene.exact_end), default=None)
    if found != expected:
        raise AuditError(f"counts: the first of {len(scenes)} scenes is {found}, not {expected}")
    stats = cast("dict[str, int]", search.stats)
    return {
        "scenes": len(scenes),
        "bodies": stats["bodies"],
        "vertices": stats["vertices"],
        "slabs": stats["slabs"],
        "pairs": stats["pairs"],
        "compared": stats["certificates"],
        "exact": stats["exact"],
        "contact": None if found is None else float(found),
    }


def beside(scenes: Sequence[Scene]) -> Scene:
    """Return a scene of several ones, in the cells of a square grid.

    It ends with the one that ends first. A body "b0" of the scene with number 3 is "3 b0".
    """
    width = math.ceil(math.sqrt(len(scenes)))
    cell = APART * max(map(_extent, scenes))
    bodies: list[Any] = []
    for i, scene in enumerate(scenes):
        shift = (i % width * cell, i // width * cell)
        shifted: Any = to_json(Variant(shift=shift).scene(scene))
        bodies.extend({**body, "name": f"{i} {body['name']}"} for body in shifted["bodies"])
    start, end = max(scene.start for scene in scenes), min(scene.end for scene in scenes)
    return Scene.from_json({"exactpt": 1, "time": [str(start), str(end)], "bodies": bodies})


def _extent(scene: Scene) -> QQ:
    """Return the width or height of all that bodies cover at some times, whichever is larger."""
    start, span = scene.exact_start, scene.exact_end - scene.exact_start
    times = [start + span * k / MOMENTS for k in range(MOMENTS + 1)]
    points = [p for body in scene.bodies for t in times for p in body.exact_at(t)]
    most = max(body.exact_radius for body in scene.bodies)
    xs, ys = [x for x, _ in points], [y for _, y in points]
    return max(max(xs) - min(xs), max(ys) - min(ys)) + 2 * most + 1
