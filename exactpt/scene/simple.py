"""The check that a body is a simple polygon or chain at the start of a scene."""

from __future__ import annotations

from collections.abc import Sequence

from exactpt.errors import InputError
from exactpt.geometry.polygon import contains, first_touch, signed_area2
from exactpt.geometry.predicates import Point
from exactpt.geometry.simple import is_surely_simple
from exactpt.kernel.numbers import QQ, shorten, show
from exactpt.motion.body import Body
from exactpt.motion.outline import outline_at

__all__ = ["check_simple"]


def check_simple(body: Body, start: QQ) -> None:
    """Check that a body is a simple polygon or chain at the start of a scene.

    If it has several rings, each is simple and disjoint from all others, each hole is inside of
    its outline and of no other hole, and no part is inside of another one.

    Raises:
        InputError: if it is not.
    """
    shape = outline_at(body, start)
    if (
        shape is not None
        and not body.has_rings
        and is_surely_simple(shape.xs, shape.ys, closed=body.closed, error=shape.error)
    ):
        return
    points = body._at(start)
    touch = first_touch(points, body.edges)
    if touch is not None:
        raise _not_simple(body, points, touch, start)
    if body.has_interior:
        for ring in body.rings:
            if signed_area2(points[ring.start : ring.stop]) == 0:
                what = f"the ring of vertex {ring.start}" if body.has_rings else "the polygon"
                raise InputError(
                    f"body {shorten(body.name)}: {what} has no area at t = {show(start)}"
                )
    if body.has_rings:
        _check_nesting(body, points, start)


def _not_simple(
    body: Body, points: Sequence[Point], touch: tuple[int, int], start: QQ
) -> InputError:
    i, j = touch
    what = "polygon" if body.closed else "chain"
    if i == j:
        u = points[i]
        return InputError(
            f"body {shorten(body.name)}: vertex {i} and the next one are both at "
            f"{show(*u)} at the start, t = {show(start)}"
        )
    return InputError(
        f"body {shorten(body.name)}: not a simple {what} "
        f"at the start, t = {show(start)}: "
        f"edge {i} from {show(*points[i])} meets edge {j} from {show(*points[j])}"
    )


def _check_nesting(body: Body, points: Sequence[Point], start: QQ) -> None:
    """Check that disjoint rings are outlines and holes of disjoint parts."""

    def is_in(inner: range, outer: range) -> bool:
        return contains(points[outer.start : outer.stop], points[inner.start])

    def fault(ring: range, what: str) -> InputError:
        at = show(*points[ring.start])
        return InputError(
            f"body {shorten(body.name)}: at the start, t = {show(start)}, {what}: "
            f"vertex {ring.start} at {at}"
        )

    for k, (outline, *holes) in enumerate(body.parts):
        for hole in holes:
            if not is_in(hole, outline):
                raise fault(hole, "a hole is outside of its outline")
            if any(is_in(hole, other) for other in holes if other is not hole):
                raise fault(hole, "a hole is inside of another one")
        for other, *others in body.parts[:k] + body.parts[k + 1 :]:
            if is_in(outline, other) and not any(is_in(outline, hole) for hole in others):
                raise fault(outline, "a part is inside of another one")
