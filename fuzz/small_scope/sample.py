"""The sample: larger shapes and a third body, spread evenly over all possibilities."""

from __future__ import annotations

from functools import cache
from itertools import product
from typing import Final, NamedTuple

from fuzz.small_scope.numbering import mixed, spread
from fuzz.small_scope.placements import Placement, complete, disjoint, placements, small_shapes
from fuzz.small_scope.shapes import Shape, Vector, shapes

__all__ = ["SAMPLES", "Third", "sampled"]

SAMPLES: Final = {"4 x 4 grid": 40_000, "4 and more": 40_000, "three bodies": 40_000}
"""The parts of the sample, with the number of scenes of each in a round.

On a 4 x 4 grid, shapes with up to 4 vertices and shapes with up to 3; on a 3 x 3 grid, shapes
with 4 vertices and shapes with 3 or 4; placements of the complete part with a third body.
"""

FAR: Final[tuple[Vector, ...]] = tuple(
    (u * x, v * y) for x, y in ((10, 12), (20, 2)) for u, v in product((1, -1), repeat=2)
)
"""Offsets of distant bodies, in half units."""

NEAR: Final[tuple[Vector, ...]] = tuple((x, y) for x in range(-6, 9, 2) for y in range(-6, 9, 2))
"""Offsets of near bodies."""


class Third(NamedTuple):
    """A third body.

    Attributes:
        shape: its shape.
        offset: position of its corner, as in `Placement`.
        along: whether it moves with the first body of the placement; otherwise it rests.
    """

    shape: Shape
    offset: Vector
    along: bool


@cache
def _wide() -> tuple[list[Shape], list[Shape]]:
    """The shapes that need a 4 x 4 grid, and those with up to 3 vertices on one."""
    wide = [s for s in small_shapes(2, 4, grid=4) if max(max(v) for v in s.vertices) > 2]
    return wide, small_shapes(1, 3, grid=4)


@cache
def _heavy() -> tuple[list[Shape], list[Shape]]:
    """The shapes with 4 vertices on a 3 x 3 grid, and those with 3 or 4."""
    return small_shapes(4, 4), small_shapes(3, 4)


def sampled(part: str, index: int) -> tuple[Placement, Third | None]:
    """The placement with an index in a part of the sample, and its third body, if it has one."""
    if part == "three bodies":
        found = complete()[spread(index, len(complete()))]
        return found, _third(found, index)
    first, second = _wide() if part == "4 x 4 grid" else _heavy()
    pair = spread(index, len(first) * len(second))
    a, b = first[pair // len(second)], second[pair % len(second)]
    choice = list(placements(a, b))
    return choice[mixed(index) % len(choice)], None


def _third(placement: Placement, index: int) -> Third:
    """A point or any shape, distant or near, at rest or moving with the first body."""
    code = mixed(index)
    small = small_shapes(1, 3)
    shape = shapes(1, closed=False)[0] if code % 3 == 0 else small[code // 64 % len(small)]
    along = code // 4 % 2 == 1
    for k in range(len(NEAR)):
        offset = NEAR[spread(code // 128 + k, len(NEAR))]
        beside = (offset[0] - placement.offset[0], offset[1] - placement.offset[1])
        mate = placement.a if along else placement.b
        if code // 8 % 3 and disjoint(shape, mate, beside if along else offset):
            return Third(shape, offset, along)
    return Third(shape, FAR[code // 32 % len(FAR)], along)
