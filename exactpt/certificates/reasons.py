"""Why a decision was not left to floats: looked at only where exact arithmetic is done anyway."""

from __future__ import annotations

from math import isnan
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from exactpt.motion.vertices import Vertex

__all__ = ["reason"]


def reason(*vertices: Vertex, is_zero: bool, exact_only: bool) -> str:
    """The reason why something about vertices was decided exactly.

    Args:
        vertices: what it was about.
        is_zero: whether the answer is zero.
        exact_only: whether the filters are switched off.

    Returns:
        "asked" (all is to be decided exactly), "zero", "copies" (two vertices are copies of
        one of a thin body: there is no filter), "range" (the filters do not take numbers
        as large or small), or "close" (not zero, but floats cannot tell).
    """
    if exact_only:
        return "asked"
    if is_zero:
        return "zero"
    if len({id(v.track) for v in vertices}) < len({v.id for v in vertices}):
        return "copies"
    return "range" if any(isnan(v.image.x0) for v in vertices) else "close"
