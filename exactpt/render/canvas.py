"""Frames: the drawing primitives of a still. Exact coordinates become doubles, in pixels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final, final

from exactpt.brief import counted
from exactpt.kernel.numbers import QQ, ceil, nearest_float, rational
from exactpt.render.data import touched_edges
from exactpt.render.labels import Named, labels
from exactpt.render.palette import TINTS, body_colour
from exactpt.render.window import ARROW, Pixel, Window, widened, window_of
from exactpt.render.words import contact_in_words, time_in_words

if TYPE_CHECKING:
    from exactpt.geometry.predicates import Point
    from exactpt.pair.contact import Contact, ContactPoint
    from exactpt.pseudotriangulation.snapshot import Face, Snapshot
    from exactpt.render.still import Still
    from exactpt.scene.scene import Scene

NAMED: Final = 40
"""Maximum number of bodies that are labelled with their names."""
BETWEEN: Final = 8
"""Number of steps of a path between two poses."""
_LETTER: Final = 8.0
"""Estimated width in pixels of a letter of `Frame.news`, rounded up."""


@final
@dataclass(frozen=True, slots=True)
class Shape:
    """A body: one point, two, a polygon (``closed``) or an open chain, in pixels.

    Its name is centred at the pixel ``label``; None if it has no place (`exactpt.render.labels`).
    With a ``radius``, all pixels within it belong to the body. ``rings`` has the numbers of the
    pixels of each ring.
    """

    name: str
    colour: str
    pixels: tuple[Pixel, ...]
    closed: bool
    label: Pixel | None
    rings: tuple[range, ...]
    radius: float = 0.0


@final
@dataclass(frozen=True, slots=True)
class Tile:
    """A face of the tiling, filled with a tint or with the colour of the body it belongs to.

    Attributes:
        pixels: its vertices in order.
        tint: index of its tint, from 0.
        colour: colour of the body, for a face of F1; else None.
        level: level of its geodesic in the tree, for a face of F1.
    """

    pixels: tuple[Pixel, ...]
    tint: int
    colour: str | None = None
    level: int = 0


@final
@dataclass(frozen=True, slots=True)
class Line:
    """An edge of the tiling, of kind "diagonal" or "hull", or of its fan, of kind "fan"."""

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


@final
@dataclass(frozen=True, slots=True)
class Canvas:
    """A picture; its parts are painted in the order tiles, shapes, lines, marks.

    Attributes:
        window: the part of the plane that is shown.
        caption: the time, in words.
        news: the contact in words, if this is its time.
        note: a description of the picture.
        tiles, shapes, lines, marks: the parts.
        ghosts: poses of bodies at other times, below all other parts.
        paths: the paths of their middles, each with a colour.
        legend: the colour and the name of each body; empty if there is none.
        scale: the length of a scale bar in pixels, and in words; None if there is none.
    """

    window: Window
    caption: str
    news: str
    note: str
    tiles: tuple[Tile, ...]
    shapes: tuple[Shape, ...]
    lines: tuple[Line, ...]
    marks: tuple[Mark, ...]
    ghosts: tuple[Shape, ...] = ()
    paths: tuple[tuple[str, tuple[Pixel, ...]], ...] = ()
    legend: tuple[tuple[str, str], ...] = ()
    scale: tuple[float, str] | None = None


def frame_of(still: Still, *, legend: bool = False, poses: int = 0) -> Canvas:
    """Return the drawing primitives of a still, see `exactpt.render.draw.draw`."""
    scene = still.scene
    places = {body.name: body.exact_at(still.at) for body in scene.bodies}
    others = _other_places(scene, poses) if poses else {}
    window = window_of(
        [
            point
            for body in scene.bodies
            for points in (places[body.name], *others.get(body.name, ()))
            for point in widened(points, body.exact_radius)
        ]
    )
    pixels = {name: tuple(window.pixel(x, y) for x, y in body) for name, body in places.items()}
    names = [
        Named(
            body.name,
            pixels[body.name],
            body.edges,
            body.has_interior,
            nearest_float(body.exact_radius * window.scale),
        )
        for body in scene.bodies
    ]
    marks: tuple[Mark, ...] = ()
    if still.contact is not None:
        marks = marks_of(scene, still.contact, pixels, window)
    arrows = [box for mark in marks for box in arrow_boxes(mark)]
    spots = labels(names, arrows) if len(names) <= NAMED else [None] * len(names)
    shapes = tuple(
        Shape(
            body.name,
            body_colour(i),
            pixels[body.name],
            body.closed,
            label,
            body.rings,
            named.radius,
        )
        for i, (body, named, label) in enumerate(zip(scene.bodies, names, spots, strict=True))
    )
    tiles: tuple[Tile, ...] = ()
    lines: tuple[Line, ...] = ()
    note = counted(len(scene.bodies), "body")
    if still.tiling is not None:
        colours = {shape.name: shape.colour for shape in shapes}
        tiles, lines = _tiling(still.tiling, window, colours)
        note += f" · {still.tiling.tiling} tiling, {counted(len(tiles), 'pseudo-triangle')}"
        if still.fan:
            fan = _fan(still.tiling, window)
            lines = fan + lines
            note += f", {counted(len(fan), 'edge')} of the fan"
    caption, news = time_in_words(still.at), ""
    if still.contact is not None:
        caption = f"first contact at {time_in_words(still.contact.time)}"
        both, one = (contact_in_words(still.contact, limit=n) for n in (2, 1))
        news = both if len(both) * _LETTER < window.width else one
    ghosts, paths = _ghosts(others, poses, shapes, window)
    return Canvas(
        window, caption, news, note, tiles, shapes, lines, marks, ghosts, paths,
        tuple((shape.colour, shape.name) for shape in shapes) if legend else (),
        _scale_bar(window) if legend else None,
    )  # fmt: skip


def _other_places(scene: Scene, poses: int) -> dict[str, list[list[Point]]]:
    """Return the places of the bodies that move at `BETWEEN` times for each of the poses."""
    count = BETWEEN * (poses - 1) if poses > 1 else 1
    step = (scene.exact_end - scene.exact_start) / count
    places = {
        body.name: [body.exact_at(scene.exact_start + step * k) for k in range(count + 1)]
        for body in scene.bodies
    }
    return {name: found for name, found in places.items() if any(p != found[0] for p in found)}


def _ghosts(
    places: dict[str, list[list[Point]]],
    poses: int,
    shapes: Sequence[Shape],
    window: Window,
) -> tuple[tuple[Shape, ...], tuple[tuple[str, tuple[Pixel, ...]], ...]]:
    """Return poses of the bodies that move, and the paths of their middles with their colours."""
    ghosts, paths = [], []
    for shape in shapes:
        found = places.get(shape.name, ())
        for points in found[:: BETWEEN if poses > 1 else 2]:
            pixels = tuple(window.pixel(x, y) for x, y in points)
            ghosts.append(replace(shape, pixels=pixels, label=None))
        if found:
            middles = [
                tuple(sum((p[k] for p in points), QQ(0)) / len(points) for k in (0, 1))
                for points in found
            ]
            paths.append((shape.colour, tuple(window.pixel(x, y) for x, y in middles)))
    return tuple(ghosts), tuple(paths)


def _scale_bar(window: Window) -> tuple[float, str]:
    """Return the longest bar of 1, 2 or 5 times a power of ten that is at most 160 pixels long."""
    most = QQ(160) / window.scale
    length = QQ(10) ** (len(str(ceil(most))) + 1)
    if most < 1:
        length = QQ(10) ** (2 - len(str(ceil(1 / most))))
    factors = (2, QQ(5, 2), 2)
    k = 0
    while length > most:
        length /= factors[k % 3]
        k += 1
    return nearest_float(length * window.scale), f"{nearest_float(length):.6g}"


def _tiling(
    tiling: Snapshot, window: Window, colours: dict[str, str]
) -> tuple[tuple[Tile, ...], tuple[Line, ...]]:
    pixels = [window.pixel(node.exact_x, node.exact_y) for node in tiling.nodes]
    tiles = tuple(
        Tile(
            tuple(pixels[v] for v in face.nodes),
            tint,
            None if face.body is None else colours[face.body],
            face.level or 0,
        )
        for face, tint in zip(tiling.faces, tints(tiling.faces), strict=True)
    )
    lines = tuple(
        Line(pixels[e.u], pixels[e.v], "hull" if e.hull else "diagonal")
        for e in tiling.edges
        if e.hull or e.kind == "diagonal"
    )
    return tiles, lines


def _fan(tiling: Snapshot, window: Window) -> tuple[Line, ...]:
    """Return the edges of the fan triangulation that are not in the tiling."""
    pixels = [window.pixel(node.exact_x, node.exact_y) for node in tiling.nodes]
    return tuple(Line(pixels[u], pixels[v], "fan") for u, v in tiling.fan)


def tints(faces: Sequence[Face]) -> list[int]:
    """Return a tint for each face, by a greedy colouring: adjacent faces differ where possible."""
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


def marks_of(
    scene: Scene, contact: Contact, pixels: dict[str, tuple[Pixel, ...]], window: Window
) -> tuple[Mark, ...]:
    """Return the marks of a contact; ``pixels`` are those of the bodies, by name."""
    rounded = {body.name for body in scene.bodies if body.exact_radius}
    return tuple(
        _mark(pair, edge, pixels, window, touches=rounded.isdisjoint((pair.body, pair.other)))
        for pair, edge in zip(contact.pairs, touched_edges(contact, scene), strict=True)
    )


def arrow_boxes(mark: Mark) -> list[tuple[float, float, float, float]]:
    """Return small boxes along the arrow of a mark, from its ring to its tip."""
    if mark.normal is None:
        return []
    length = math.hypot(*mark.normal)
    boxes = []
    for step in range(12, int(ARROW) + 1, 6):
        x, y = (c + step * d / length for c, d in zip(mark.pixel, mark.normal, strict=True))
        boxes.append((x - 5.0, y - 5.0, x + 5.0, y + 5.0))
    return boxes


def _mark(
    pair: ContactPoint,
    touched: tuple[int, int] | None,
    pixels: dict[str, tuple[Pixel, ...]],
    window: Window,
    *,
    touches: bool,
) -> Mark:
    """Return the mark of an incidence; ``touches`` unless a body has a radius."""
    other = pixels[pair.other]
    edge = None if touched is None else (other[touched[0]], other[touched[1]])
    normal = None if pair.normal in (None, (0.0, 0.0)) else (pair.normal[0], -pair.normal[1])
    if touches:
        return Mark(pixels[pair.body][pair.vertex], normal, edge)
    x, y = (rational(c) for c in pair.point)
    return Mark(window.pixel(x, y), normal, None)
