"""The exact check that a body is a simple polygon or chain at the start of a scene."""

from __future__ import annotations

from collections.abc import Sequence

from exactpt.errors import InputError
from exactpt.geometry.polygon import contains, first_touch, near_groups, signed_area2
from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ, shorten, show
from exactpt.motion.body import Body


def check_exactly(body: Body, start: QQ) -> None:
    """Check that a body is a simple polygon or chain at the start of a scene.

    If it has several rings, each is simple and disjoint from all others, each hole is inside of
    its outline and of no other hole, and no part is inside another part.

    Raises:
        InputError: if it is not.
    """
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
    rings = [ring for rings in body.parts for ring in rings]
    parts = [k for k, rings in enumerate(body.parts) for _ in rings]
    outlines = [k for k, part in enumerate(parts) if k == 0 or parts[k - 1] != part]
    # A ring is inside another ring only if their boxes, rounded outward, intersect.
    near: list[list[int]] = [[] for _ in rings]
    for i, j in near_groups([points[ring.start : ring.stop] for ring in rings]):
        near[i].append(j)
        near[j].append(i)

    def around(i: int) -> set[int]:
        """Return the rings that contain the first vertex of a ring."""
        first = points[rings[i].start]
        return {j for j in near[i] if contains(points[rings[j].start : rings[j].stop], first)}

    def fault(ring: range, what: str) -> InputError:
        at = show(*points[ring.start])
        return InputError(
            f"body {shorten(body.name)}: at the start, t = {show(start)}, {what}: "
            f"vertex {ring.start} at {at}"
        )

    for outline in outlines:
        k = parts[outline]
        for i in range(outline + 1, outline + len(body.parts[k])):
            outer = around(i)
            if outline not in outer:
                raise fault(rings[i], "a hole is outside of its outline")
            if any(parts[j] == k and j != outline for j in outer):
                raise fault(rings[i], "a hole is inside another hole")
        outer = around(outline)
        for other in sorted(outer.intersection(outlines)):
            if not any(parts[j] == parts[other] and j != other for j in outer):
                raise fault(rings[outline], "a part is inside another part")
