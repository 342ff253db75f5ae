"""Random scenes by family and seed, generic to fully degenerate: the same on every machine.

>>> from exactpt.testing.scenes import generate
>>> generate("combs", 3)
<Scene: 2 bodies, 40 vertices, t in [0, 5]>

A family is a function from a `random.Random` to a `Scene`, in a module of this package. Entered in
`CATALOGUE`, it is drawn by `generate`, ``exactpt generate``, the fuzzer and the tests.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Final, TypeAlias

from exactpt.scene.scene import Scene
from exactpt.testing.scenes import (
    convex,
    degenerate,
    grid,
    points,
    rings,
    rounded,
    simple,
    spinning,
)

Family: TypeAlias = Callable[[Random], Scene]


def _by_name(*makers: Family) -> dict[str, Family]:
    """Return families by the names of their functions."""
    return {make.__name__: make for make in makers}


CATALOGUE: Final[dict[str, dict[str, Family]]] = {
    "convex": _by_name(
        convex.convex,
        convex.mixed_shapes,
        convex.ballistic,
        convex.turning,
        convex.deforming,
        convex.pieces,
        convex.keyframed,
        degenerate.small_grid,
        degenerate.grids_passing,
        degenerate.row,
        degenerate.convoy,
        degenerate.mirrored,
        degenerate.polygons_in_step,
        degenerate.grazing,
        degenerate.concentric,
        degenerate.sweeping,
    ),
    "simple": _by_name(
        simple.stars,
        simple.turning_stars,
        simple.blobs,
        simple.combs,
        simple.spirals,
        simple.clamps,
        simple.letters,
        simple.chains,
        grid.chains_on_grid,
        grid.bodies_on_grid,
        simple.flat,
        simple.nested,
        degenerate.hairs,
    ),
    "points": _by_name(
        points.linear_points,
        points.ballistic_points,
        points.piecewise_points,
        points.turning_points,
        points.grid_points,
        points.point_convoy,
        points.point_grids_passing,
        points.points_in_line,
        points.crossing_lines,
        points.parabola_points,
        points.simultaneous_swaps,
    ),
    "rounded": _by_name(
        rounded.discs,
        rounded.kissing_discs,
        rounded.sliding_capsules,
        rounded.rolling_discs,
        rounded.discs_in_corners,
        rounded.rounded_grid,
        rounded.rounded_motions,
    ),
    "rings": _by_name(
        rings.lakes,
        rings.frames,
        rings.walls,
    ),
    "touching": _by_name(
        rings.touching_rings,
    ),
    "spinning": _by_name(
        spinning.gears,
        spinning.mills,
        spinning.orbits,
    ),
}
"""Families by kind, each a function from a random generator to a scene.

Convex bodies that stay convex (points and segments included); simple polygons of any shape; points
alone; rounded bodies, which no tiling holds; bodies with holes and several parts; bodies whose
rings touch, which no tiling holds; bodies that turn at a constant rate, by `Spin`.
"""


def families(*kinds: str) -> dict[str, Family]:
    """Return the families of some kinds of `CATALOGUE`, by name, in the order of the kinds."""
    return {name: make for kind in kinds for name, make in CATALOGUE[kind].items()}


CONVEX: Final = families("convex")
FAMILIES: Final = families("convex", "simple")
POINTS: Final = families("points")
ROUNDED: Final = families("rounded")
RINGS: Final = families("rings")
TOUCHING: Final = families("touching")
SPINNING: Final = families("spinning")
EVERY: Final = families(*CATALOGUE)


def generate(family: str, seed: int) -> Scene:
    """Return the scene of a family with this seed."""
    return EVERY[family](Random(f"{family}:{seed}"))
