"""Why a decision needed exact arithmetic; computed only where it was used anyway."""

from __future__ import annotations

from math import isnan
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from exactpt.motion.vertex import Vertex


def reason(*vertices: Vertex, is_zero: bool, exact_only: bool) -> str:
    """Return the reason why a sign was decided exactly.

    Args:
        vertices: the vertices of the sign.
        is_zero: whether the sign is zero.
        exact_only: whether the filters are switched off.

    Returns:
        "asked" (the filters are switched off), "zero", "copies" (two vertices are copies of
        one of a degenerate body: no filter exists), "range" (a number is too large or too
        small for the filters), or "close" (not zero, but too close for floats).
    """
    if exact_only:
        return "asked"
    if is_zero:
        return "zero"
    if len({(v.body, v.index) for v in vertices}) < len({v.id for v in vertices}):
        return "copies"
    return "range" if any(isnan(v.float_track.x0) for v in vertices) else "close"
