"""The rings of a body: the outlines of its parts, and of the holes in them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Final, TypeAlias

from exactpt.errors import InputError
from exactpt.geometry.touching_rings import ring_meetings
from exactpt.kernel.numbers import QQ, shorten
from exactpt.motion.motions import Position
from exactpt.motion.shape import Shape, VertexLike, are_constant, listed

Outline: TypeAlias = "Iterable[VertexLike]"
"""The vertices of a ring as a caller may write them."""

PartLike: TypeAlias = "Outline | Mapping[str, object]"
"""A part: its outline, or a mapping with its "vertices" and its "holes"."""

Parts: TypeAlias = "tuple[tuple[range, ...], ...]"
"""For each part, the numbers of the vertices of its rings, the outer one first."""

FEWEST: Final = 3
"""Minimum number of vertices of a ring of a body with several."""


def read_rings(
    vertices: Outline | None, holes: Iterable[Outline], parts: Iterable[PartLike] | None
) -> tuple[Shape, Parts | None]:
    """Return the vertices of all rings, and the rings; None instead of the ring of a plain polygon.

    Args:
        vertices: the outline of the only part; None if ``parts`` are given.
        holes: its holes.
        parts: several parts.

    Raises:
        InputError: if these are not rings.
    """
    shapes: list[Shape] = []
    found: list[tuple[range, ...]] = []
    outlines = [("", vertices, holes)] if parts is None else list(_outlines(parts))
    if not outlines:
        raise InputError("at least one part is needed")
    for where, outline, inner in outlines:
        rings = [_read_ring(f"{where}outline: " if where else "", outline)]
        rings += [
            _read_ring(f"{where}hole {i}: ", hole) for i, hole in enumerate(listed("holes", inner))
        ]
        first = sum(shape.size for shape in shapes)
        ranges: list[range] = []
        for ring in rings:
            ranges.append(range(first, first + ring.size))
            first += ring.size
        shapes += rings
        found.append(tuple(ranges))
    if len(shapes) == 1:
        return shapes[0], None
    return _joined(shapes), tuple(found)


def _outlines(parts: Iterable[PartLike]) -> Iterable[tuple[str, Outline, Iterable[Outline]]]:
    for i, part in enumerate(listed("parts", parts)):
        where = f"part {i}: "
        if not isinstance(part, Mapping):
            yield where, part, ()
            continue
        unknown = set(part) - {"vertices", "holes"}
        if unknown or "vertices" not in part:
            what = f"unknown key {shorten(min(unknown))}" if unknown else 'no "vertices"'
            raise InputError(f"{where}{what}")
        yield where, part["vertices"], part.get("holes", ())


def _read_ring(where: str, outline: Outline | None) -> Shape:
    try:
        ring = Shape(outline, ring=True)
        if ring.size < FEWEST:
            raise InputError(f"a ring has at least {FEWEST} vertices, not {ring.size}")
    except InputError as error:
        raise InputError(f"{where}{error}") from None
    return ring


def _joined(rings: list[Shape]) -> Shape:
    """Return the vertices of several rings, one after the other; doubles if all are."""
    known = [zip(*ring.doubles, strict=True) for ring in rings if ring.doubles is not None]
    if len(known) == len(rings):
        return Shape([vertex for ring in known for vertex in ring])
    return Shape([vertex for ring in rings for vertex in ring.positions])


def ring_edges(parts: Parts) -> list[tuple[int, int]]:
    """Return the edges of all rings; edge i starts at vertex i."""
    return [
        (i, i + 1 if i + 1 < ring.stop else ring.start)
        for rings in parts
        for ring in rings
        for i in ring
    ]


def rest_touches(
    vertices: Sequence[Position], edges: Sequence[tuple[int, int]], rings: Sequence[range]
) -> tuple[tuple[QQ, QQ], ...]:
    """Return the points in which rings with these vertices touch; none if the vertices deform."""
    if not are_constant(vertices):
        return ()
    points = [(x.exact_at(QQ(0)), y.exact_at(QQ(0))) for x, y in vertices]
    return tuple(touch.point for touch in ring_meetings(points, edges, rings).touches)


def parts_given(parts: Parts, vertices: Sequence[object]) -> dict[str, object]:
    """Return the keyword arguments from which a body with these rings of vertices can be made."""
    made: list[dict[str, object]] = [
        {
            "vertices": vertices[outer.start : outer.stop],
            "holes": tuple(vertices[hole.start : hole.stop] for hole in holes),
        }
        for outer, *holes in parts
    ]
    return made[0] if len(made) == 1 else {"parts": tuple(made)}
