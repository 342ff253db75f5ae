"""Random scenes by family and seed, generic to fully degenerate: the same on every machine."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from types import ModuleType
from typing import Final, TypeAlias

from exactpt.scene.families import (
    convex,
    degenerate,
    grid,
    points,
    rings,
    rounded,
    simple,
    spinning,
)
from exactpt.scene.scene import Scene

Family: TypeAlias = Callable[[Random], Scene]


def _named(*rows: tuple[ModuleType, str]) -> dict[str, Family]:
    return {name: getattr(module, name) for module, names in rows for name in names.split()}


CATALOGUE: Final[dict[str, dict[str, Family]]] = {
    "convex": _named(
        (convex, "convex mixed_shapes ballistic turning deforming pieces keyframed"),
        (degenerate, "small_grid grids_passing row convoy mirrored polygons_in_step grazing"),
        (degenerate, "concentric sweeping"),
    ),
    "simple": _named(
        (simple, "stars turning_stars blobs combs spirals clamps letters chains"),
        (grid, "chains_on_grid bodies_on_grid"),
        (simple, "flat nested"),
        (degenerate, "hairs"),
    ),
    "points": _named(
        (points, "linear_points ballistic_points piecewise_points turning_points grid_points"),
        (points, "point_convoy point_grids_passing points_in_line crossing_lines parabola_points"),
        (points, "simultaneous_swaps"),
    ),
    "rounded": _named(
        (rounded, "discs kissing_discs sliding_capsules rolling_discs discs_in_corners"),
        (rounded, "rounded_grid rounded_motions"),
    ),
    "rings": _named((rings, "lakes frames walls")),
    "touching": _named((rings, "touching_rings")),
    "spinning": _named((spinning, "gears mills orbits")),
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
