"""Conversion from and to shapely, imported on demand.

It is the only module that imports shapely.

A coordinate of shapely is a double and is taken at its exact value.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from typing import TYPE_CHECKING, Final, NamedTuple

from numpy import errstate

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.exchange.bodies import Holes, Parts, body_of, scene_of
from exactpt.exchange.losses import Losses
from exactpt.exchange.shapes import (
    Kind,
    Shape,
    positive_tolerance,
    rounded,
    rounded_rings,
    shapes_at,
    together,
)
from exactpt.kernel.numbers import nearest_float, rational, shorten

try:
    import shapely
    from shapely.geometry.base import BaseGeometry
except ImportError:
    raise InputError("this needs shapely: pip install 'exactpt[shapely]'") from None

if TYPE_CHECKING:
    from exactpt.geometry.predicates import Point
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.kernel.numbers import Rational
    from exactpt.motion.body import Body
    from exactpt.motion.motions import Motion
    from exactpt.scene.scene import Scene


_MAX_CHORDS: Final = 10_000
"""Maximum number of chords of a quarter of a circle."""

_KINDS: Final[dict[str, Kind]] = {
    "Point": "point",
    "LineString": "line",
    "LinearRing": "line",
    "Polygon": "polygon",
}


class ReadText(NamedTuple):
    """A geometry that shapely reads from a well-known text.

    Attributes:
        geometry: the geometry, of doubles.
        size: its number of points.
        dimensions: the number of coordinates of each.
        further: the names of the coordinates beside x and y: "z", "m".
    """

    geometry: BaseGeometry
    size: int
    dimensions: int
    further: list[str]


def read_wkt(text: str, where: str) -> ReadText:
    """Return the geometry of a text.

    Raises:
        InputError: if it is not well-known text, or of a kind that shapely cannot read.
    """
    try:
        with errstate(all="ignore"):  # numbers may be beyond the doubles, or NaN
            geometry = shapely.from_wkt(text)
    except shapely.errors.ShapelyError as error:
        reason = shorten(str(error).split("Exception: ")[-1].strip())
        raise InputError(f"{where}: not well-known text: {reason[1:-1]}") from None
    except NotImplementedError:
        kind = text.split("(", maxsplit=1)[0].strip()
        raise InputError(f"{where}: shapely reads no curves: {shorten(kind)}") from None
    size = int(shapely.get_num_coordinates(geometry))
    dimensions = int(shapely.get_coordinate_dimension(geometry))
    return ReadText(geometry, size, dimensions, _further(geometry) if size else [])


def _further(geometry: BaseGeometry) -> list[str]:
    """Return the names of the coordinates of a geometry beside x and y."""
    dimensions = int(shapely.get_coordinate_dimension(geometry))
    has_z = bool(shapely.has_z(geometry) or dimensions == 4)
    return ["z"] * has_z + ["m"] * (dimensions - 2 - has_z)


def shapes_of_geometry(
    geometry: object, where: str, name: str, points: Sequence[Point] | None = None
) -> Iterator[Shape]:
    """Yield the shapes of a geometry; a collection may mix kinds.

    The parts of a MultiPolygon are one shape, those of other geometries are one each.

    Args:
        geometry: a geometry of shapely.
        where: its place in the input, for messages.
        name: the wanted name of every part.
        points: the exact points of the geometry, in the order of its coordinates; if None, the
            doubles are taken at their exact value.

    Raises:
        InputError: if it is not a geometry, or empty.
    """
    if not isinstance(geometry, BaseGeometry):
        raise InputError(f"{where}: not a shapely geometry: {shorten(geometry)}")
    if points is None:
        try:
            points = [
                (rational(float(x)), rational(float(y)))
                for x, y in shapely.get_coordinates(geometry)
            ]
        except InputError as error:
            raise InputError(f"{where} ({shorten(name)[1:-1]}): {error}") from None
    left, count = iter(points), 0
    for unit in _units(geometry):
        shapes: list[Shape] = []
        for part in unit:
            at = where if part is geometry else f"{where}, part {count}"
            rings = [part] if part.geom_type != "Polygon" else [part.exterior, *part.interiors]
            taken = [list(islice(left, shapely.get_num_coordinates(ring))) for ring in rings]
            shapes.append(Shape(at, name, _KINDS[part.geom_type], taken[0], taken[1:]))
            count += 1
        yield from together(shapes)
    if count == 0:
        yield Shape(where, name, _KINDS.get(geometry.geom_type.removeprefix("Multi"), "point"), ())


def _units(geometry: BaseGeometry) -> Iterator[list[BaseGeometry]]:
    """Yield the parts of a geometry, recursively, in their order; polygons together."""
    if geometry.geom_type in _KINDS:
        yield [geometry]
    elif geometry.geom_type == "MultiPolygon":
        yield list(shapely.get_parts(geometry))
    else:
        for part in shapely.get_parts(geometry):
            yield from _units(part)


def body_from(geometry: object, name: str, motion: Motion, holes: Holes, radius: Rational) -> Body:
    """Return the body of a geometry, see `Body.from_shapely`."""
    shapes = list(shapes_of_geometry(geometry, "geometry", name))
    if len(shapes) != 1:
        raise InputError(
            f"geometry {shorten(name)} has {counted(len(shapes), 'part')}, "
            "of which only polygons can be one body: see Scene.from_shapely"
        )
    return body_of(shapes[0], name, motion, holes=holes, radius=radius)


def scene_from(
    geometries: Iterable[object] | Mapping[str, object],
    time: Sequence[Rational],
    holes: Holes,
    parts: Parts,
    radius: Rational,
    *,
    repair: bool,
    skip_invalid: bool,
) -> Scene:
    """Return the scene at rest of geometries, see `Scene.from_shapely`."""
    if isinstance(geometries, BaseGeometry):
        raise InputError(f"geometries: not a list, but one geometry: {shorten(geometries)}")
    if isinstance(geometries, Mapping):
        named = [(str(name), geometry) for name, geometry in geometries.items()]
    else:
        named = [(f"body {i}", geometry) for i, geometry in enumerate(geometries)]
    shapes = (
        shape
        for i, (name, geometry) in enumerate(named)
        for shape in shapes_of_geometry(geometry, f"geometry {i}", name)
    )
    scene = scene_of(
        shapes,
        time=time,
        holes=holes,
        parts=parts,
        radius=radius,
        repaired=_silent if repair else None,
        skipped=_silent if skip_invalid else None,
    )
    scene.lost = _lost_of(geometry for _, geometry in named)
    return scene


def _silent(_message: str) -> None:
    """Say nothing about a geometry that is repaired or left out, as the caller has asked."""


def _lost_of(geometries: Iterable[object]) -> tuple[str, ...]:
    """Return the data of geometries without a place in a scene: z, m, and the number of a crs."""
    losses = Losses()
    for geometry in geometries:
        if isinstance(geometry, BaseGeometry):
            size = int(shapely.get_num_coordinates(geometry))
            for key in _further(geometry):
                losses.count(key, "point", size)
            if shapely.get_srid(geometry):
                losses.count("SRID", "geometry")
    return losses.texts()


def geometries_of(
    scene: Scene, at: Rational | AlgebraicNumber, tolerance: float | None
) -> dict[str, BaseGeometry]:
    """Return the bodies at a time, by name, see `Scene.to_shapely`."""
    return {shape.name: _geometry(shape, tolerance) for shape in shapes_at(scene, at)}


def outlined(shape: Shape, tolerance: float | None) -> Shape:
    """Return a shape with a radius as a polygon, with chords within a tolerance of its arcs.

    Raises:
        InputError: if the tolerance is not positive, or a chord for each arc is too many.
    """
    outline = _geometry(shape, tolerance)
    if shape.kind != "polygon" and outline.geom_type != "Polygon":
        return shape._replace(radius=0)
    turned = shapely.orient_polygons(outline)  # as RFC 7946 requires; the order is new
    (whole,) = shapes_of_geometry(turned, shape.where, shape.name)
    parts = [
        part._replace(
            points=part.points[:-1],
            holes=[hole[:-1] for hole in part.holes],
            properties=shape.properties,
        )
        for part in whole.parts
    ]
    return together(parts)[0]


def _geometry(shape: Shape, tolerance: float | None) -> BaseGeometry:
    """Return the outline; the core, if the radius vanishes beside it in doubles."""
    core, radius = _core(shape), nearest_float(rational(shape.radius))
    if not radius:
        return core
    outline = core.buffer(radius, quad_segs=_quarter(radius, tolerance))
    return core if outline.is_empty else outline


def _core(shape: Shape) -> BaseGeometry:
    points = rounded(shape)
    if shape.kind == "point":
        return shapely.Point(points[0])
    if shape.kind == "line":
        return shapely.LineString(points)
    polygons = [shapely.Polygon(outline, holes) for outline, *holes in rounded_rings(shape)]
    return shapely.MultiPolygon(polygons) if shape.more else polygons[0]


def _quarter(radius: float, tolerance: float | None) -> int:
    """Return the least number of chords of a quarter of a circle within the tolerance.

    It is the least n with r (1 - cos(pi / 4 n)) <= tolerance.
    """
    ratio = 0.01 if tolerance is None else positive_tolerance(tolerance) / radius
    # 1 - cos(a) = 2 sin(a / 2)^2.
    half = math.asin(math.sqrt(min(ratio, 1.0) / 2.0))
    count = math.pi / (8.0 * half) if half else math.inf  # 0: the quotient is below all doubles
    if count > _MAX_CHORDS:
        raise InputError(f"an arc needs more than {_MAX_CHORDS} chords: raise the tolerance")
    return math.ceil(count)
