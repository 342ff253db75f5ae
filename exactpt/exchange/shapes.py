"""Shapes, the common form of all file formats and libraries, and the bodies they become.

Shared by all formats: a ring may repeat its first point, names may be missing or equal, a shape
may have holes, and not every shape is a valid body.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Iterable, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Final, Literal, NamedTuple, TypeAlias

from exactpt.errors import InputError
from exactpt.geometry.polygon import contains, signed_area2
from exactpt.kernel.numbers import nearest_float
from exactpt.motion.body import Body
from exactpt.motion.motions import REST, Motion
from exactpt.scene.scene import Scene

if TYPE_CHECKING:
    from exactpt.geometry.predicates import Point
    from exactpt.kernel.numbers import QQ, Rational

__all__ = ["Holes", "Kind", "Shape", "body_of", "nested", "rounded", "scene_of", "shapes_at"]

Kind: TypeAlias = Literal["point", "line", "polygon"]
Holes: TypeAlias = Literal["refuse", "fill"]

_FEWEST: Final[dict[Kind, int]] = {"point": 1, "line": 2, "polygon": 3}


class Shape(NamedTuple):
    """A point, a line or a polygon of a file.

    Attributes:
        where: its place in the file, for messages: ``feature 3, polygon 2``.
        name: the wanted name of the body; several shapes may want the same.
        kind: a line is open (a segment or a chain), a polygon has an interior.
        points: its points in order; the first may be repeated at the end.
        holes: rings inside a polygon that bound its holes.
    """

    where: str
    name: str
    kind: Kind
    points: Sequence[Point]
    holes: Sequence[Sequence[Point]] = ()


def scene_of(
    shapes: Iterable[Shape],
    *,
    time: Sequence[Rational] = (0, 1),
    holes: Holes = "refuse",
    skipped: Callable[[str], None] | None = None,
) -> Scene:
    """The scene at rest of some shapes, in their order.

    Args:
        shapes: the shapes, one for each body; a name that is taken gets a number.
        time: the start and the end of the time span.
        holes: "refuse" polygons with holes, or "fill" them.
        skipped: called with a message for each shape that cannot be a body and is left out;
            if None, such a shape is an error.

    Raises:
        InputError: one line that names the shape and says what to do about it.
    """
    empty = Scene([], time)
    bodies: dict[str, Body] = {}
    for shape in shapes:
        try:
            body = body_of(shape, _free_name(shape.name, bodies), holes=holes)
            _check_simple(shape, body, time)
        except InputError as error:
            if skipped is None:
                raise
            skipped(str(error))
            continue
        bodies[body.name] = body
    return empty.going_on(bodies.values(), empty._start)


def body_of(shape: Shape, name: str, motion: Motion = REST, *, holes: Holes = "refuse") -> Body:
    """The body that a shape becomes.

    Repeated consecutive points count once. A line that ends where it began becomes the polygon
    that it bounds.

    Raises:
        InputError: if the shape has too few points, no area, or (``holes="refuse"``) holes.
    """
    if shape.holes and holes == "refuse":
        count = len(shape.holes)
        raise InputError(
            f"{shape.where}: polygon {shape.name!r} has {_counted(count, 'hole')}, and a body "
            "has none: fill them (--holes fill, in Python holes='fill') or cut the polygon open"
        )
    points = _distinct_neighbours(shape.points)
    closes = shape.kind != "point" and len(points) > 1 and points[0] == points[-1]
    if closes:
        points.pop()
    is_polygon = shape.kind == "polygon" or (closes and len(points) > 2)
    kind: Kind = "polygon" if is_polygon else shape.kind
    if len(points) < _FEWEST[kind] or (is_polygon and signed_area2(points) == 0):
        lacks = {"point": "position", "line": "length", "polygon": "area"}[kind]
        raise InputError(
            f"{shape.where}: {kind} {shape.name!r} has no {lacks}: "
            "remove it, or leave such shapes out (--skip-invalid)"
        )
    return Body(name, points, motion, closed=is_polygon or len(points) < 3)


def shapes_at(scene: Scene, at: QQ) -> list[Shape]:
    """The bodies of a scene at a time, as shapes.

    Raises:
        InputError: if the time is outside the time span.
    """
    if not scene._start <= at <= scene._end:
        raise InputError(f"t = {at} is outside the time span from {scene._start} to {scene._end}")
    return [
        Shape(f"body {body.name!r}", body.name, _kind(body), body._at(at)) for body in scene.bodies
    ]


def _kind(body: Body) -> Kind:
    if body.size == 1:
        return "point"
    return "polygon" if body.has_interior else "line"


def rounded(shape: Shape) -> list[tuple[float, float]]:
    """The points of a shape, each coordinate rounded to the nearest double.

    Raises:
        InputError: if a coordinate is larger than the largest double.
    """
    points = [(nearest_float(x), nearest_float(y)) for x, y in shape.points]
    if not all(map(math.isfinite, chain.from_iterable(points))):
        raise InputError(f"{shape.where}: a coordinate is too large for a double")
    return points


def _check_simple(shape: Shape, body: Body, time: Sequence[Rational]) -> None:
    try:
        Scene([body], time)
    except InputError as error:
        raise InputError(
            f"{shape.where}: {error}; mend it, or leave such outlines out (--skip-invalid)"
        ) from None


def nested(rings: Sequence[Sequence[Point]]) -> list[tuple[int, list[int]]]:
    """The outer rings among rings that do not cross, each with its holes, all as indices.

    By the even-odd rule, a ring inside an odd number of others is a hole; it belongs to the
    innermost outer ring around it.
    """
    around = [
        [j for j, other in enumerate(rings) if j != i and _inside(ring, other)]
        for i, ring in enumerate(rings)
    ]
    return [
        (i, [h for h, outer in enumerate(around) if i in outer and len(outer) == len(mine) + 1])
        for i, mine in enumerate(around)
        if len(mine) % 2 == 0
    ]


def _inside(ring: Sequence[Point], other: Sequence[Point]) -> bool:
    corners = set(other)
    free = next((p for p in ring if p not in corners), None)
    return free is not None and len(other) > 2 and contains(other, free)


def _distinct_neighbours(points: Sequence[Point]) -> list[Point]:
    return [p for i, p in enumerate(points) if i == 0 or p != points[i - 1]]


def _free_name(wanted: str, taken: Container[str]) -> str:
    name, number = wanted, 1
    while name in taken:
        number += 1
        name = f"{wanted} {number}"
    return name


def _counted(count: int, what: str) -> str:
    return f"{count} {what}" + ("s" if count > 1 else "")
