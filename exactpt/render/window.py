"""Windows: the part of the plane that a picture shows, and its exact scaling to pixels."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias, final

from exactpt.kernel.numbers import QQ, ceil, nearest_float

WIDTH: Final = 960
HEIGHT: Final = 680
LEAST: Final = (560, 240)
MARGIN: Final = 48
HEADER: Final = 60
"""Height of the captions above a window."""
ARROW: Final = 46.0
"""Length in pixels of the normal of a contact, from its point."""

Pixel: TypeAlias = tuple[float, float]


@final
@dataclass(frozen=True, slots=True)
class Window:
    """A rectangle of the plane, ``width`` by ``height`` pixels.

    Attributes:
        left, top: the point of the plane at pixel (0, 0); pixel rows count downwards.
        scale: pixels per unit of length, the same in both directions.
    """

    left: QQ
    top: QQ
    scale: QQ
    width: int
    height: int

    def pixel(self, x: QQ, y: QQ) -> tuple[float, float]:
        """Return the pixel of a point of the plane."""
        across, down = (x - self.left) * self.scale, (self.top - y) * self.scale
        return nearest_float(across), nearest_float(down)


def arrow(tail: Pixel, direction: Pixel) -> tuple[Pixel, Pixel, Pixel, Pixel]:
    """Return the start of an arrow just outside the ring at a contact, its tip, and both barbs."""
    (x, y), length = tail, math.hypot(*direction)
    dx, dy = (c / length for c in direction)
    tip = (x + ARROW * dx, y + ARROW * dy)
    left, right = (
        (tip[0] - 9 * dx - side * 5 * dy, tip[1] - 9 * dy + side * 5 * dx) for side in (1, -1)
    )
    return (x + 11 * dx, y + 11 * dy), tip, left, right


def widened(points: Iterable[tuple[QQ, QQ]], radius: QQ) -> Iterator[tuple[QQ, QQ]]:
    """Yield opposite corners of the boxes around the discs with a radius; or the points for 0."""
    return ((x + r, y + r) for x, y in points for r in ((radius, -radius) if radius else (radius,)))


def window_of(points: Sequence[tuple[QQ, QQ]]) -> Window:
    """Return the window around some points: as large as fits, with a margin, without distortion."""
    xs = [x for x, _ in points] or [QQ(0)]
    ys = [y for _, y in points] or [QQ(0)]
    across, up = max(xs) - min(xs), max(ys) - min(ys)
    room = ((across, WIDTH - 2 * MARGIN), (up, HEIGHT - 2 * MARGIN))
    scale = min((QQ(pixels) / extent for extent, pixels in room if extent), default=QQ(1))
    width, height = (
        max(least, int(ceil(d * scale)) + 2 * MARGIN)
        for d, least in zip((across, up), LEAST, strict=True)
    )
    return Window(
        left=(min(xs) + max(xs)) / 2 - QQ(width) / (2 * scale),
        top=(min(ys) + max(ys)) / 2 + QQ(height) / (2 * scale),
        scale=scale,
        width=width,
        height=height,
    )
