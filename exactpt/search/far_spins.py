"""Bodies that come near others, as far as is known without the pieces of a `Spin`.

A vertex of a body that spins stays at one distance from the pivot. So the body is in the square
around the pivot whose half side is the distance r of the farthest vertex, moved along the
translation: if this has a degree of at most 1, between its places at the start and at the end.
"""

from __future__ import annotations

from exactpt.geometry.boxes import boxes_of_points, overlapping_pairs
from exactpt.geometry.predicates import Point
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.motion.outline import reach_from
from exactpt.motion.shape import are_constant
from exactpt.motion.spin import Spin
from exactpt.scene.scene import Scene


def bodies_near_others(scene: Scene) -> list[int]:
    """Return the numbers of the bodies that may touch others or themselves, in order.

    All bodies, unless some spin, and each of them is in a box that is known for the whole span.
    """
    everything = list(range(len(scene.bodies)))
    if not any(isinstance(body.motion, Spin) for body in scene.bodies):
        return everything
    corners: list[list[Point]] = []
    for body in scene.bodies:
        check_budget()
        found = _corners(body, scene.exact_start, scene.exact_end)
        if found is None:
            return everything
        corners.append(found)
    pairs = overlapping_pairs(boxes_of_points(corners))
    return sorted({i for first, second in pairs for i in (*first.tolist(), *second.tolist())})


def _corners(body: Body, start: QQ, end: QQ) -> list[Point] | None:
    """Return corners of boxes that contain a rigid body from start to end; None if unknown."""
    motion = body.motion
    if not body.vertices or not are_constant(body.vertices):
        return None
    places = [(x.exact_at(start), y.exact_at(start)) for x, y in body.vertices]
    if isinstance(motion, Spin):
        reach = reach_from(body, motion.exact_pivot)
        if reach is None:
            return None
        places, margin = [motion.exact_pivot], reach + body.exact_radius
    elif isinstance(motion, Translation):
        margin = body.exact_radius
    else:
        return None
    if max(motion.x.degree, motion.y.degree) > 1:
        return None
    left, right = min(x for x, _ in places) - margin, max(x for x, _ in places) + margin
    low, high = min(y for _, y in places) - margin, max(y for _, y in places) + margin
    return [
        (x + motion.x.exact_at(t), y + motion.y.exact_at(t))
        for t in (start, end)
        for x, y in ((left, low), (right, high))
    ]
