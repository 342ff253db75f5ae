"""Requests of the line protocol (cgal_check/README.md), written from claims."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Final, TypedDict, cast

from exactpt.cgal.claims import (
    BodyShape,
    IsolatedRoot,
    PlacedBody,
    RootClaim,
    Tile,
    Verdict,
    exactly,
)
from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, ZZ, Rational, rational, shorten

_WRITTEN: Final = re.compile(r"-?[0-9]+(?:/[0-9]*[1-9][0-9]*)?", re.ASCII)


class _TileVertex(TypedDict):
    body: str
    vertex: int
    x: object
    y: object


class _TileEdge(TypedDict):
    u: int
    v: int
    kind: str
    hull: bool


class _TileFace(TypedDict):
    vertices: list[int]
    corners: list[int]


class _Tile(TypedDict):
    # The keys that are read; a caller's own type may have more.
    vertices: list[_TileVertex]
    edges: list[_TileEdge]
    faces: list[_TileFace]
    fan: list[list[int]]


class _BadTileError(Exception):
    """The tile contradicts itself or the bodies: a verdict that needs no request."""


def tiling_request(word: str, tile: Tile, bodies: Iterable[BodyShape]) -> str | Verdict:
    """Return the text of a request; or the verdict, if the tile does not match the bodies."""
    parts = cast("_Tile", tile)
    with_faces = word.startswith("tiling")
    try:
        lines = [word, *_vertex_lines(parts["vertices"])]
        lines += _body_lines(parts["vertices"], [BodyShape(*shape) for shape in bodies])
        index = range(len(parts["vertices"]))
        lines += _edge_lines(parts["edges"], [] if with_faces else parts["fan"], index)
        lines += _face_lines(parts["faces"], index) if with_faces else []
    except _BadTileError as fault:
        return Verdict(ok=False, reason=str(fault))
    except KeyError as error:
        raise InputError(f"not a tile as `exactpt tile` writes it: {error} is missing") from None
    except (TypeError, ValueError) as error:
        raise InputError(f"not a tile as `exactpt tile` writes it: {error}") from None
    return "\n".join([*lines, "end\n"])


def _vertex_lines(vertices: list[_TileVertex]) -> Iterator[str]:
    yield f"vertices {len(vertices)}"
    for vertex in vertices:
        yield f"{_coordinate(vertex['x'])} {_coordinate(vertex['y'])}"


def _body_lines(vertices: list[_TileVertex], shapes: list[BodyShape]) -> Iterator[str]:
    place: dict[tuple[str, int], int] = {}
    for i, vertex in enumerate(vertices):
        if place.setdefault((vertex["body"], vertex["vertex"]), i) != i:
            name, place_there = shorten(vertex["body"]), shorten(vertex["vertex"])
            raise _BadTileError(f"vertex {i} is {name}: {place_there} again")
    yield f"bodies {len(shapes)}"
    for shape in shapes:
        ring = [place.pop((shape.name, number), None) for number in range(shape.size)]
        if None in ring:
            missing = ring.index(None)
            raise _BadTileError(f"body {shorten(shape.name)}: vertex {missing} is not in the tile")
        yield _shape_words(shape, ring)
    for (name, number), i in place.items():
        raise _BadTileError(f"vertex {i} is of no body: {shorten(name)}: {shorten(number)}")


def _shape_words(shape: BodyShape, place: Sequence[int | None]) -> str:
    """Return the kind of a body, and its vertices by their places."""
    if shape.parts:
        return f"parts {len(shape.parts)} {_part_words(shape.parts, place)}"
    words = " ".join(map(str, reversed(place) if shape.clockwise else place))
    if shape.size < 3:
        return f"{'point' if shape.size == 1 else 'segment'} {words}"
    if not shape.closed:
        return f"chain {shape.size} {words}"
    return f"{'ring' if shape.clockwise is None else 'polygon'} {shape.size} {words}"


def _part_words(parts: Sequence[Sequence[Sequence[int]]], place: Sequence[int | None]) -> str:
    """Return the parts of a body with holes, by the places of its vertices."""

    def cycle(ring: Sequence[int]) -> str:
        return " ".join(map(str, (len(ring), *(place[i] for i in ring))))

    return " ".join(
        " ".join([cycle(outline), f"holes {len(holes)}", *map(cycle, holes)])
        for outline, *holes in parts
    )


def _edge_lines(edges: list[_TileEdge], fan: list[list[int]], index: range) -> Iterator[str]:
    yield f"edges {len(edges) + len(fan)}"
    for edge in edges:
        ends, kind, hull = _indices((edge["u"], edge["v"]), index), edge["kind"], edge["hull"]
        if kind not in {"boundary", "diagonal"} or not isinstance(hull, bool):
            raise ValueError(f"edge {ends}: kind {shorten(kind)}, hull {shorten(hull)}")
        yield f"{ends} {kind} {'hull' if hull else 'inner'}"
    for u, v in fan:
        yield f"{_indices((u, v), index)} diagonal inner"


def _face_lines(faces: list[_TileFace], index: range) -> Iterator[str]:
    yield f"faces {len(faces)}"
    for i, face in enumerate(faces):
        cycle, corners = face["vertices"], face["corners"]
        if len(corners) != 3:
            raise _BadTileError(f"face {i} has {len(corners)} corners")
        yield f"{len(cycle)} {_indices(cycle, index)} corners {_indices(corners, index)}"


def _indices(vertices: Iterable[int], index: range) -> str:
    words = []
    for v in vertices:
        if type(v) is not int:
            raise TypeError(f"not the index of a vertex: {shorten(v)}")
        if v not in index:
            raise _BadTileError(f"there is no vertex {v} among {len(index)}")
        words.append(str(v))
    return " ".join(words)


def _coordinate(value: object) -> str:
    if isinstance(value, str) and _WRITTEN.fullmatch(value):
        return value  # in the form that the protocol requires
    return _rational_words(exactly(value))


def _rational_words(value: QQ) -> str:
    return f"{value.numerator}/{value.denominator}"


def point_words(point: Sequence[Rational]) -> str:
    """Return the exact coordinates of a point.

    Raises:
        InputError: if it has not two coordinates, or one is not a number.
    """
    if len(point) != 2:
        raise InputError(f"a point must have two coordinates, got {shorten(point)}")
    x, y = point
    return f"{_rational_words(rational(x))} {_rational_words(rational(y))}"


def bodies_request(word: str, bodies: Sequence[PlacedBody]) -> str:
    """Return the text of a request about bodies at one time.

    Raises:
        InputError: if a body has not as many points as its shape has vertices, or not all of these
            are in its parts.
    """
    points: list[str] = []
    shapes: list[str] = []
    for shape, given in bodies:
        _check_placed(shape, len(given))
        places = range(len(points), len(points) + shape.size)
        points += map(point_words, given)
        shapes.append(_shape_words(shape, places))
    head = f"{word} vertices {len(points)} {' '.join(points)}"
    return "\n".join([head, f"bodies {len(shapes)}", *shapes, "end\n"])


def _check_placed(shape: BodyShape, points: int) -> None:
    where = f"body {shorten(shape.name)}"
    if points != shape.size:
        raise InputError(f"{where}: {shape.size} points are needed, got {points}")
    numbers = [number for part in shape.parts for ring in part for number in ring]
    if shape.parts and sorted(numbers) != list(range(shape.size)):
        wanted = f"the parts must have each vertex from 0 to {shape.size - 1} once"
        raise InputError(f"{where}: {wanted}, got {shorten(numbers)}")


def polynomial_words(f: Sequence[int]) -> str:
    """Return an integer polynomial: the number of coefficients, then these, constant first."""
    if f and f[-1] == 0:
        raise InputError("the leading coefficient of a polynomial is zero")
    # ZZ: Python does not convert an int of more than 4,300 digits to a string.
    return " ".join(map(str, (len(f), *map(ZZ, f))))


def root_words(root: RootClaim) -> str:
    """Return a root: its polynomial and the interval that isolates it."""
    if not isinstance(root, IsolatedRoot):
        root = IsolatedRoot(root.exact_polynomial, root.exact_low, root.exact_high)
    low, high = _rational_words(root.low), _rational_words(root.high)
    return f"polynomial {polynomial_words(root.polynomial)} between {low} {high}"
