"""Frames: a still as drawing primitives. Here exact numbers become doubles, in pixels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, TypeAlias, final

from exactpt.render.palette import TINTS, body_colour
from exactpt.render.window import Window, window_of
from exactpt.render.words import contact_in_words, pair_in_words, time_in_words

if TYPE_CHECKING:
    from exactpt.collision.contact import Pair
    from exactpt.render.still import Still
    from exactpt.tiling.snapshot import Face, Snapshot

__all__ = ["Frame", "Line", "Mark", "Pixel", "Shape", "Tile", "frame_of", "tints"]

Pixel: TypeAlias = tuple[float, float]

NAMED: Final = 40
"""The most bodies that are still labelled with their names."""


@final
@dataclass(frozen=True, slots=True)
class Shape:
    """A body: one pixel, two, a polygon (``closed``) or an open chain."""

    name: str
    colour: str
    pixels: tuple[Pixel, ...]
    closed: bool
    labelled: bool


@final
@dataclass(frozen=True, slots=True)
class Tile:
    """A face of the tiling; ``inside`` a body, or in free space. ``tint`` counts from 0."""

    pixels: tuple[Pixel, ...]
    tint: int
    inside: bool


@final
@dataclass(frozen=True, slots=True)
class Line:
    """An edge of the tiling, of kind "diagonal" or "hull"."""

    start: Pixel
    end: Pixel
    kind: str


@final
@dataclass(frozen=True, slots=True)
class Mark:
    """An incidence of a contact; ``normal`` is a unit vector in pixels (y down), or None."""

    pixel: Pixel
    normal: Pixel | None
    edge: tuple[Pixel, Pixel] | None
    label: str


@final
@dataclass(frozen=True, slots=True)
class Frame:
    """A picture; its parts are painted in this order: tiles, shapes, inside, lines, marks."""

    window: Window
    caption: str
    note: str
    tiles: tuple[Tile, ...]
    shapes: tuple[Shape, ...]
    lines: tuple[Line, ...]
    marks: tuple[Mark, ...]


def frame_of(still: Still) -> Frame:
    """The primitives of a still."""
    scene = still.scene
    places = {body.name: body.at(still.at) for body in scene.bodies}
    window = window_of([place for body in places.values() for place in body])
    pixels = {name: tuple(window.pixel(x, y) for x, y in body) for name, body in places.items()}
    named = len(scene.bodies) <= NAMED
    shapes = tuple(
        Shape(body.name, body_colour(i), pixels[body.name], body.closed, named)
        for i, body in enumerate(scene.bodies)
    )
    tiles: tuple[Tile, ...] = ()
    lines: tuple[Line, ...] = ()
    note = f"{len(scene.bodies)} bodies"
    if still.tiling is not None:
        tiles, lines = _tiling(still.tiling, window)
        note += f" · {still.tiling.tiling} tiling, {len(tiles)} pseudo-triangles"
    marks: tuple[Mark, ...] = ()
    caption = time_in_words(still.at)
    if still.contact is not None:
        caption = contact_in_words(still.contact)
        marks = tuple(_mark(pair, pixels) for pair in still.contact.pairs)
        if still.contact.overlaps:
            pairs = ", ".join(f"{a} and {b}" for a, b in still.contact.overlaps[:3])
            note = f"{pairs} share a point"
    return Frame(window, caption, note, tiles, shapes, lines, marks)


def _tiling(tiling: Snapshot, window: Window) -> tuple[tuple[Tile, ...], tuple[Line, ...]]:
    pixels = [window.pixel(node.x, node.y) for node in tiling.nodes]
    tiles = tuple(
        Tile(tuple(pixels[v] for v in face.nodes), tint, face.region not in ("F1", "F2"))
        for face, tint in zip(tiling.faces, tints(tiling.faces), strict=True)
    )
    lines = tuple(
        Line(pixels[e.u], pixels[e.v], "hull" if e.hull else "diagonal")
        for e in tiling.edges
        if e.hull or e.kind == "diagonal"
    )
    return tiles, lines


def tints(faces: Sequence[Face]) -> list[int]:
    """A tint for each face, different across an edge wherever a greedy choice allows it."""
    at_edge: dict[frozenset[int], list[int]] = {}
    chosen: list[int] = []
    for i, face in enumerate(faces):
        taken: set[int] = set()
        for u, v in zip(face.nodes, (*face.nodes[1:], face.nodes[0]), strict=True):
            others = at_edge.setdefault(frozenset((u, v)), [])
            taken.update(chosen[j] for j in others if j < i)
            others.append(i)
        free = [tint for tint in range(TINTS) if tint not in taken]
        chosen.append(free[i % len(free)] if free else i % TINTS)
    return chosen


def _mark(pair: Pair, pixels: dict[str, tuple[Pixel, ...]]) -> Mark:
    other = pixels[pair.other]
    edge = None
    if pair.edge is not None:
        edge = (other[pair.edge], other[(pair.edge + 1) % len(other)])
    normal = None if pair.normal is None else (pair.normal[0], -pair.normal[1])
    return Mark(pixels[pair.body][pair.vertex], normal, edge, pair_in_words(pair))
