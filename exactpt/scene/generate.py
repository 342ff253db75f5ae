"""Random scenes by family and seed, generic to fully degenerate: the same on every machine."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
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

__all__ = [
    "CONVEX",
    "EVERY",
    "FAMILIES",
    "POINTS",
    "RINGS",
    "ROUNDED",
    "SIMPLE",
    "SPINNING",
    "Family",
    "generate",
]

Family: TypeAlias = Callable[[Random], Scene]

CONVEX: Final[dict[str, Family]] = {
    "convex": convex.convex,
    "mixed_shapes": convex.mixed_shapes,
    "ballistic": convex.ballistic,
    "turning": convex.turning,
    "deforming": convex.deforming,
    "pieces": convex.pieces,
    "keyframed": convex.keyframed,
    "small_grid": degenerate.small_grid,
    "grids_passing": degenerate.grids_passing,
    "row": degenerate.row,
    "convoy": degenerate.convoy,
    "mirrored": degenerate.mirrored,
    "polygons_in_step": degenerate.polygons_in_step,
    "grazing": degenerate.grazing,
    "concentric": degenerate.concentric,
    "sweeping": degenerate.sweeping,
}
"""Families of convex bodies that stay convex (points and segments included)."""

SIMPLE: Final[dict[str, Family]] = {
    "stars": simple.stars,
    "turning_stars": simple.turning_stars,
    "blobs": simple.blobs,
    "combs": simple.combs,
    "spirals": simple.spirals,
    "clamps": simple.clamps,
    "letters": simple.letters,
    "chains": simple.chains,
    "chains_on_grid": grid.chains_on_grid,
    "bodies_on_grid": grid.bodies_on_grid,
    "flat": simple.flat,
    "nested": simple.nested,
    "hairs": degenerate.hairs,
}
"""Families with simple polygons of any shape."""

FAMILIES: Final[dict[str, Family]] = {**CONVEX, **SIMPLE}
"""All families but those of points alone; each makes a scene from a random generator."""

POINTS: Final[dict[str, Family]] = {
    "linear_points": points.linear_points,
    "ballistic_points": points.ballistic_points,
    "piecewise_points": points.piecewise_points,
    "turning_points": points.turning_points,
    "grid_points": points.grid_points,
    "point_convoy": points.point_convoy,
    "point_grids_passing": points.point_grids_passing,
    "points_in_line": points.points_in_line,
    "crossing_lines": points.crossing_lines,
    "parabola_points": points.parabola_points,
    "simultaneous_swaps": points.simultaneous_swaps,
}
"""Families of points alone."""


ROUNDED: Final[dict[str, Family]] = {
    "discs": rounded.discs,
    "kissing_discs": rounded.kissing_discs,
    "sliding_capsules": rounded.sliding_capsules,
    "rolling_discs": rounded.rolling_discs,
    "discs_in_corners": rounded.discs_in_corners,
    "rounded_grid": rounded.rounded_grid,
    "rounded_motions": rounded.rounded_motions,
}
"""Families with rounded bodies, which no tiling holds."""


RINGS: Final[dict[str, Family]] = {
    "lakes": rings.lakes,
    "frames": rings.frames,
    "walls": rings.walls,
}
"""Families of bodies with holes and several parts."""

SPINNING: Final[dict[str, Family]] = {
    "gears": spinning.gears,
    "mills": spinning.mills,
    "orbits": spinning.orbits,
}
"""Families of bodies that turn at a constant rate, by `Spin`."""


EVERY: Final[dict[str, Family]] = {**FAMILIES, **POINTS, **ROUNDED, **RINGS, **SPINNING}
"""All families, by their names."""


def generate(family: str, seed: int) -> Scene:
    """Return the scene of a family with this seed."""
    return EVERY[family](Random(f"{family}:{seed}"))
