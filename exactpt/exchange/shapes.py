"""Shapes, the common form of all file formats and libraries, and the bodies they become.

Shared by all formats: a ring may repeat its first point, names may be missing or equal, a shape
may have holes, and not every shape is a valid body.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Iterable, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Final, Literal, NamedTuple, TypeAlias

import numpy as np

from exactpt.errors import InputError
from exactpt.geometry.boxes import Boxes, Indices, boxes_of_points, overlapping_pairs
from exactpt.geometry.polygon import contains, signed_area2
from exactpt.kernel.numbers import nearest_float, shorten, show
from exactpt.motion.body import Body
from exactpt.motion.motions import REST, Motion
from exactpt.scene.scene import Scene

if TYPE_CHECKING:
    from exactpt.geometry.predicates import Point
    from exactpt.kernel.numbers import QQ, Rational

__all__ = [
    "DEEPEST",
    "Holes",
    "Kind",
    "Shape",
    "body_of",
    "free_name",
    "nested",
    "rounded",
    "rounded_rings",
    "scene_of",
    "shapes_at",
]

DEEPEST: Final = 100
"""Maximum depth to which collections and groups may be nested in a file."""

_MOST_NESTED: Final = 10_000_000
"""Maximum number of pairs of rings of one outline with one box inside the other."""

Kind: TypeAlias = Literal["point", "line", "polygon"]
Holes: TypeAlias = Literal["refuse", "fill"]

_NONE: Final[Indices] = np.empty(0, dtype=np.int64)
_FEWEST: Final[dict[Kind, int]] = {"point": 1, "line": 2, "polygon": 3}


class Shape(NamedTuple):
    """A point, a line or a polygon of a file.

    Attributes:
        where: its place in the file, for messages: ``feature 3, polygon 2``.
        name: the wanted name of the body; several shapes may want the same.
        kind: a line is open (a segment or a chain), a polygon has an interior.
        points: its points in order; the first may be repeated at the end.
        holes: rings inside a polygon that bound its holes.
        radius: all points within it belong to the shape: only of shapes to be written.
    """

    where: str
    name: str
    kind: Kind
    points: Sequence[Point]
    holes: Sequence[Sequence[Point]] = ()
    radius: QQ | int = 0

    @property
    def rings(self) -> list[Sequence[Point]]:
        """Its points, then its holes."""
        return [self.points, *self.holes]


def scene_of(
    shapes: Iterable[Shape],
    *,
    time: Sequence[Rational] = (0, 1),
    holes: Holes = "refuse",
    radius: Rational = 0,
    skipped: Callable[[str], None] | None = None,
) -> Scene:
    """The scene at rest of some shapes, in their order.

    Args:
        shapes: the shapes, one for each body; a name that is taken gets a number.
        time: the start and the end of the time span.
        holes: "refuse" polygons with holes, or "fill" them.
        radius: the radius of each body.
        skipped: called with a message for each shape that cannot be a body and is left out;
            if None, such a shape is an error.

    Raises:
        InputError: one line that names the shape and says what to do about it.
    """
    empty = Scene([], time)
    bodies: dict[str, Body] = {}
    last: dict[str, int] = {}
    for shape in shapes:
        try:
            name = free_name(shape.name, bodies, last)
            body = body_of(shape, name, holes=holes, radius=radius)
            _check_simple(shape, body, time)
        except InputError as error:
            if skipped is None:
                raise
            skipped(str(error))
            continue
        bodies[body.name] = body
    return empty.going_on(bodies.values(), empty._start)


def body_of(
    shape: Shape, name: str, motion: Motion = REST, *, holes: Holes = "refuse", radius: Rational = 0
) -> Body:
    """The body that a shape becomes.

    Repeated consecutive points count once. A line that ends where it began becomes the polygon
    that it bounds.

    Raises:
        InputError: if the shape has too few points, no area, or (``holes="refuse"``) holes.
    """
    if shape.holes and holes == "refuse":
        count = len(shape.holes)
        raise InputError(
            f"{shape.where}: polygon {shorten(shape.name)} has {_counted(count, 'hole')}, "
            "and a body has none: fill them (--holes fill, in Python holes='fill') "
            "or cut the polygon open"
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
            f"{shape.where}: {kind} {shorten(shape.name)} has no {lacks}: "
            "remove it, or leave such shapes out (--skip-invalid)"
        )
    return Body(name, points, motion, closed=is_polygon or len(points) < 3, radius=radius)


def shapes_at(scene: Scene, at: QQ) -> list[Shape]:
    """The bodies of a scene at a time, as shapes.

    Raises:
        InputError: if the time is outside the time span.
    """
    if not scene._start <= at <= scene._end:
        span = f"from {show(scene._start)} to {show(scene._end)}"
        raise InputError(f"t = {show(at)} is outside the time span {span}")
    return [
        Shape(
            f"body {shorten(body.name)}",
            body.name,
            _kind(body),
            body._at(at),
            radius=body._radius,
        )
        for body in scene.bodies
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
    return _rounded(shape, shape.points)


def rounded_rings(shape: Shape) -> list[list[tuple[float, float]]]:
    """The boundary of a polygon and those of its holes, likewise."""
    return [_rounded(shape, ring) for ring in shape.rings]


def _rounded(shape: Shape, ring: Sequence[Point]) -> list[tuple[float, float]]:
    points = [(nearest_float(x), nearest_float(y)) for x, y in ring]
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

    Of rings that do not cross, those around a ring are around each other too. So they are the
    innermost one and those around that, and only boxes around a ring's box need to be tried,
    from the innermost on. A box around another one contains more boxes than that.

    Raises:
        InputError: if too many boxes are inside others.
    """
    around = _boxes_around(boxes_of_points(rings))
    size = [0] * len(rings)
    for outside in around.values():
        for j in outside:
            size[j] += 1
    outer: list[int | None] = [None] * len(rings)
    depth = [0] * len(rings)
    for i in sorted(range(len(rings)), key=lambda i: -size[i]):  # each after its outer ring
        for j in sorted(around.get(i, ()), key=size.__getitem__):
            if _inside(rings[i], rings[j]):
                outer[i], depth[i] = j, depth[j] + 1
                break
    holes: dict[int, list[int]] = {i: [] for i in range(len(rings)) if depth[i] % 2 == 0}
    for i, its in enumerate(outer):
        if its is not None and depth[i] % 2:
            holes[its].append(i)
    return list(holes.items())


def _boxes_around(boxes: Boxes) -> dict[int, list[int]]:
    """For each box, the boxes that contain it; of equal boxes the first contains the second."""
    inner: list[Indices] = []
    outer: list[Indices] = []
    count = 0
    for first, second in overlapping_pairs(boxes):
        for a, b in ((first, second), (second, first)):
            p, q = boxes[a], boxes[b]  # is q inside p
            inside = (p[:, ::2] <= q[:, ::2]).all(axis=1) & (p[:, 1::2] >= q[:, 1::2]).all(axis=1)
            inside &= (p != q).any(axis=1) | (a < b)
            inner.append(b[inside])
            outer.append(a[inside])
            count += len(inner[-1])
        if count > _MOST_NESTED:
            raise InputError(f"more than {_MOST_NESTED} pairs of its outlines are nested")
    around: dict[int, list[int]] = {}
    for b, a in zip(np.concatenate([_NONE, *inner]), np.concatenate([_NONE, *outer]), strict=True):
        around.setdefault(int(b), []).append(int(a))
    return around


def _inside(ring: Sequence[Point], other: Sequence[Point]) -> bool:
    corners = set(other)
    free = next((p for p in ring if p not in corners), None)
    return free is not None and len(other) > 2 and contains(other, free)


def _distinct_neighbours(points: Sequence[Point]) -> list[Point]:
    return [p for i, p in enumerate(points) if i == 0 or p != points[i - 1]]


def free_name(wanted: str, taken: Container[str], last: dict[str, int]) -> str:
    """The wanted name, or the first free one of "wanted 2", "wanted 3", ...

    ``last`` has the last number tried for each name: those below it stay taken.
    """
    number = last.get(wanted, 1)
    name = wanted if number == 1 else f"{wanted} {number}"
    while name in taken:
        number += 1
        name = f"{wanted} {number}"
    last[wanted] = number
    return name


def _counted(count: int, what: str) -> str:
    return f"{count} {what}" + ("s" if count > 1 else "")
