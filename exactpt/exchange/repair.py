"""Polygons of files that are not valid, replaced by valid ones: the even-odd rule, exactly."""

from __future__ import annotations

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.exchange.shapes import Shape, together
from exactpt.geometry.overlay import as_given, evenodd, union
from exactpt.kernel.numbers import shorten


def mended(shape: Shape, fault: str) -> Shape:
    """Return the polygons that a shape of any rings fills, as the parts of one shape.

    Each part of the shape fills the points that an odd number of turns of its rings surrounds; the
    result is the union of these areas. Its vertices are given ones and exact crossings. Where the
    boundary meets itself in a point, rings of the result meet there, so the result is valid.

    A line that ends where it began is such a polygon.

    Args:
        shape: a shape that is not valid.
        fault: why it is not.

    Raises:
        InputError: if the shape is not a polygon, or fills nothing.
    """
    if shape.kind != "polygon" and (len(shape.points) < 4 or shape.points[0] != shape.points[-1]):
        raise InputError(
            f"{shape.where}: {shorten(shape.name)}: {fault}; only polygons are repaired: "
            "remove it, or leave such shapes out (--skip-invalid)"
        )
    try:
        filled = [evenodd(part.rings) for part in shape.parts]
        parts = filled[0] if len(filled) == 1 else union(part for some in filled for part in some)
    except InputError as error:
        raise InputError(f"{shape.where}: {shorten(shape.name)}: {error}") from None
    if not parts:
        raise InputError(
            f"{shape.where}: nothing of {shorten(shape.name)} has an area: remove it, or leave "
            "such shapes out (--skip-invalid)"
        )
    given = [ring for part in shape.parts for ring in part.rings]
    alone = shape._replace(kind="polygon", more=())
    return together(
        [alone._replace(points=part.outline, holes=part.holes) for part in as_given(parts, given)]
    )[0]


def repair_report(shape: Shape, repaired: Shape, fault: str) -> str:
    """Return a line about a repair."""
    return (
        f"{shape.where}: repaired {shorten(shape.name)} ({fault}): "
        f"{_size(shape)} became {_size(repaired)}"
    )


def _size(shape: Shape) -> str:
    vertices = sum(len(ring) - (ring[0] == ring[-1]) for part in shape.parts for ring in part.rings)
    return f"{counted(len(shape.parts), 'polygon')} of {counted(vertices, 'vertex')}"
