"""Scenes with a planned contact, made from a placement and a motion."""

from __future__ import annotations

from typing import NamedTuple

from exactpt import Body, InputError, Scene
from exactpt.kernel.numbers import QQ
from exactpt.motion.motions import Motion
from fuzz.small_scope.motions import (
    DRIFTS,
    Approach,
    Clock,
    Path,
    Points,
    deforming,
    drifting,
    motion_of,
)
from fuzz.small_scope.placements import DIRECTIONS, Placement
from fuzz.small_scope.sample import Third
from fuzz.small_scope.shapes import SYMMETRIES, Matrix, Shape, Vector, edges, on_segment, turned

__all__ = ["Plan", "Presentation", "scene_of", "touching"]

SMALLEST = 8
"""A deforming vertex moves by at least 2 to the power of minus this."""


class Plan(NamedTuple):
    """A planned contact.

    Attributes:
        placement: the two bodies at the contact.
        third: another body, or None.
        order: the order of contact.
        clock: the time of contact.
        approach: the motion.
        mover: which of the two bodies moves or deforms.
    """

    placement: Placement
    third: Third | None
    order: str
    clock: Clock
    approach: Approach
    mover: int


class Presentation(NamedTuple):
    """The presentation of a scene, which is irrelevant for the contact.

    Attributes:
        matrix: a symmetry applied to the scene.
        drift: a motion shared by all bodies.
        listing: a number that determines the order of bodies and vertices.
    """

    matrix: Matrix
    drift: Path
    listing: int

    @classmethod
    def numbered(cls, code: int) -> Presentation:
        """The presentation encoded by the digits of a number."""
        code, i = divmod(code, len(SYMMETRIES))
        listing, k = divmod(code, len(DRIFTS))
        return cls(SYMMETRIES[i], DRIFTS[k], listing)

    def point(self, place: Vector) -> tuple[QQ, QQ]:
        """The image of a point in half units."""
        x, y = turned(self.matrix, place)
        return QQ(x, 2), QQ(y, 2)

    def listed(self, shape: Shape) -> list[int]:
        """The order of the vertices: a chain or polygon from either end or from any vertex."""
        order = list(range(len(shape.vertices)))
        if shape.closed:
            first = self.listing // 2 % len(order)
            order = order[first:] + order[:first]
        return order[::-1] if self.listing % 2 else order


def touching(placement: Placement, mover: int) -> tuple[list[int], Vector]:
    """The vertices of a body without which there is no contact, and a point of contact."""
    both = (placement.a, _corners(placement, 0)), (placement.b, _corners(placement, 1))
    own, other = both[mover], both[1 - mover]
    found = [i for i, p in enumerate(own[1]) if any(on_segment(p, *e) for e in _edges(*other))]
    if found:
        return found, own[1][found[0]]
    size = len(own[1])
    for i, edge in enumerate(_edges(*own)):
        for p in other[1]:
            if on_segment(p, *edge):
                return [i, (i + 1) % size], p
    raise AssertionError("the shapes of a placement touch")


def _corners(placement: Placement, which: int) -> list[Vector]:
    """The vertices of one of the two bodies, in half units."""
    return _moved((placement.a, placement.b)[which], ((0, 0) if which else placement.offset))


def _moved(shape: Shape, offset: Vector) -> list[Vector]:
    return [(2 * x + offset[0], 2 * y + offset[1]) for x, y in shape.vertices]


def _edges(shape: Shape, corners: list[Vector]) -> list[tuple[Vector, Vector]]:
    return edges(Shape(tuple(corners), shape.closed))


def scene_of(plan: Plan, shown: Presentation) -> Scene:
    """The scene with a planned contact."""
    x, y = turned(shown.matrix, DIRECTIONS[plan.approach.direction])
    step = (-x, -y) if plan.mover else (x, y)
    touched = shown.point(touching(plan.placement, plan.mover)[1])
    rest = drifting(shown.drift)
    if plan.order == "deform":
        movers = [_deformed(plan, shown, step, QQ(1, 1 << k)) for k in range(SMALLEST + 1)]
        carried = rest
    else:
        carried = motion_of(plan.order, plan.approach, step, plan.clock, shown.drift, touched)
        movers = [_body("a", plan, shown, plan.mover, carried)]
    others = [_body("b", plan, shown, 1 - plan.mover, rest)]
    if plan.third is not None:
        motion = rest if plan.third.along == bool(plan.mover) else carried
        shape = plan.third.shape
        others.append(_listed("c", shape, _moved(shape, plan.third.offset), shown, motion))
    return _first_valid(movers, others, plan, shown)


def _first_valid(movers: list[Body], others: list[Body], plan: Plan, shown: Presentation) -> Scene:
    """The scene with the first of the moving bodies that is simple at the start."""
    first = shown.listing // 8 % (len(others) + 1)
    for body in movers:
        bodies = [*others[:first], body, *others[first:]]
        try:
            return Scene(bodies, plan.clock.span)
        except InputError:
            if body is movers[-1]:
                raise
    raise AssertionError("there is a body")


def _body(name: str, plan: Plan, shown: Presentation, which: int, motion: Motion) -> Body:
    shape = (plan.placement.a, plan.placement.b)[which]
    return _listed(name, shape, _corners(plan.placement, which), shown, motion)


def _listed(
    name: str, shape: Shape, corners: list[Vector], shown: Presentation, motion: Motion
) -> Body:
    points = [shown.point(corners[i]) for i in shown.listed(shape)]
    return Body(name, points, motion, closed=shape.closed or len(points) < 3)


def _deformed(plan: Plan, shown: Presentation, step: Vector, factor: QQ) -> Body:
    shape = (plan.placement.a, plan.placement.b)[plan.mover]
    order, corners = shown.listed(shape), _corners(plan.placement, plan.mover)
    points: Points = [shown.point(corners[i]) for i in order]
    vertex = order.index(plan.approach.part)
    return deforming(
        "a",
        points,
        vertex,
        plan.approach,
        step,
        plan.clock,
        shown.drift,
        factor,
        closed=shape.closed,
    )
