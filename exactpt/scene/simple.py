"""The check that a body is a simple polygon or chain at the start of a scene."""

from __future__ import annotations

from exactpt.errors import InputError
from exactpt.geometry.polygon import first_self_touch, signed_area2
from exactpt.geometry.simple import is_surely_simple
from exactpt.kernel.numbers import QQ, shorten, show
from exactpt.motion.body import Body
from exactpt.motion.outline import outline_at

__all__ = ["check_simple"]


def check_simple(body: Body, start: QQ) -> None:
    """Check that a body is a simple polygon or chain at the start of a scene.

    Raises:
        InputError: if it is not.
    """
    shape = outline_at(body, start)
    if shape is not None and is_surely_simple(
        shape.xs, shape.ys, closed=body.closed, error=shape.error
    ):
        return
    points = body._at(start)
    touch = first_self_touch(points, closed=body.closed)
    if touch is not None:
        i, j = touch
        what = "polygon" if body.closed else "chain"
        if i == j:
            u = points[i]
            raise InputError(
                f"body {shorten(body.name)}: vertex {i} and the next one are both at "
                f"{show(*u)} at the start, t = {show(start)}"
            )
        raise InputError(
            f"body {shorten(body.name)}: not a simple {what} "
            f"at the start, t = {show(start)}: "
            f"edge {i} from {show(*points[i])} meets edge {j} from {show(*points[j])}"
        )
    if body.has_interior and signed_area2(points) == 0:
        raise InputError(f"body {shorten(body.name)}: the polygon has no area at t = {show(start)}")
