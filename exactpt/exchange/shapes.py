"""Shapes, the common form of all file formats and libraries, and those of a scene.

Shared by all formats: a ring may repeat its first point, names may be missing or equal, a shape
may have holes, and not every shape is a valid body.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Final, Literal, NamedTuple, TypeAlias

from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import nearest_float, rational, shorten, show

if TYPE_CHECKING:
    from exactpt.geometry.predicates import Point
    from exactpt.kernel.numbers import QQ, Rational
    from exactpt.motion.body import Body
    from exactpt.scene.scene import Scene

DEEPEST: Final = 100
"""Maximum depth to which collections and groups may be nested in a file."""

Kind: TypeAlias = Literal["point", "line", "polygon"]

DIGITS: Final = 24
"""Number of significant digits of coordinates at an irrational time: more than doubles have."""


class Shape(NamedTuple):
    """A point, a line or a polygon of a file.

    Attributes:
        where: its place in the file, for messages: ``feature 3, polygon 2``.
        name: the wanted name of the body; several shapes may want the same.
        kind: a line is open (a segment or a chain), a polygon has an interior.
        points: its points in order; the first may be repeated at the end.
        holes: rings inside a polygon that bound its holes.
        radius: all points within it belong to the shape: only of shapes to be written.
        more: further polygons of the same shape, which have none themselves.
        properties: further data; None if there are none.
    """

    where: str
    name: str
    kind: Kind
    points: Sequence[Point]
    holes: Sequence[Sequence[Point]] = ()
    radius: QQ | int = 0
    more: Sequence[Shape] = ()
    properties: Mapping[str, object] | None = None

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def parts(self) -> tuple[Shape, ...]:
        """The parts, as shapes of one part each."""
        return (self._replace(more=()), *self.more)

    def without_holes(self) -> Shape:
        """Return the shape with its holes filled."""
        more = [part._replace(holes=()) for part in self.more]
        return self._replace(holes=(), more=more)

    @property
    def rings(self) -> list[Sequence[Point]]:
        """Its points, then its holes."""
        return [self.points, *self.holes]


def together(parts: Sequence[Shape]) -> list[Shape]:
    """Polygons as one shape of several parts; other shapes as they are."""
    if len(parts) > 1 and all(part.kind == "polygon" for part in parts):
        return [parts[0]._replace(more=parts[1:])]
    return list(parts)


def positive_tolerance(tolerance: Rational) -> float:
    """Return a maximum distance of chords as the nearest double; a larger one is the largest.

    Raises:
        InputError: if it is not a positive number.
    """
    try:
        exact = rational(tolerance)
    except InputError:
        exact = rational(0)
    if exact <= 0:
        raise InputError(f"the tolerance is a positive number: {shorten(tolerance)}")
    # The least double stands for a positive number that is nearer to 0.
    return min(max(nearest_float(exact), math.ulp(0.0)), sys.float_info.max)


def shapes_at(scene: Scene, time: Rational | AlgebraicNumber) -> list[Shape]:
    """Return the bodies of a scene at a time, as shapes.

    At an irrational time coordinates are rounded to `DIGITS` significant digits.

    Raises:
        InputError: if the time is outside the time span.
    """
    at = time if isinstance(time, AlgebraicNumber) else AlgebraicNumber(time)
    if at.compare_rational(scene.exact_start) < 0 or at.compare_rational(scene.exact_end) > 0:
        span = f"from {show(scene.exact_start)} to {show(scene.exact_end)}"
        when = show(at.exact_low) if at.is_rational else repr(float(at))
        raise InputError(f"t = {when} is outside the time span {span}")
    return [shape_at(body, at) for body in scene.bodies]


def shape_at(body: Body, at: AlgebraicNumber) -> Shape:
    """Return a body at a time as a shape, see `shapes_at`."""
    if at.is_rational:
        points = body.exact_at(at.exact_low)
    else:
        points = [(rational(x), rational(y)) for x, y in body.at(at, DIGITS)]
    parts = [
        Shape(
            f"body {shorten(body.name)}",
            body.name,
            _kind(body),
            points[outline.start : outline.stop],
            [points[hole.start : hole.stop] for hole in holes],
            body.exact_radius,
            properties=body.properties or None,
        )
        for outline, *holes in body.parts
    ]
    return parts[0]._replace(more=parts[1:])


def _kind(body: Body) -> Kind:
    if body.size == 1:
        return "point"
    return "polygon" if body.has_interior else "line"


def rounded(shape: Shape) -> list[tuple[float, float]]:
    """Return the points of a shape, each coordinate rounded to the nearest double.

    Raises:
        InputError: if a coordinate is larger than the largest double.
    """
    return _rounded(shape, shape.points)


def rounded_rings(shape: Shape) -> list[list[list[tuple[float, float]]]]:
    """For each part the boundary and those of its holes, likewise."""
    return [[_rounded(shape, ring) for ring in (part.points, *part.holes)] for part in shape.parts]


def _rounded(shape: Shape, ring: Sequence[Point]) -> list[tuple[float, float]]:
    points = [(nearest_float(x), nearest_float(y)) for x, y in ring]
    if not all(map(math.isfinite, chain.from_iterable(points))):
        raise InputError(f"{shape.where}: a coordinate is too large for a double")
    return points
