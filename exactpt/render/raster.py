"""Frames of films as images of Pillow, without an SVG document and a PNG between.

A picture has twice its size while its lines are drawn, and is then reduced: a pixel is the mean of
four. Coordinates are those of `exactpt.render.svg`, and colours those of its style.
"""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, Any, Final

from PIL import Image, ImageChops, ImageColor, ImageDraw, ImageFont

from exactpt.render.palette import DARK, LIGHT
from exactpt.render.window import HEADER, Pixel, arrow
from exactpt.render.words import clean

if TYPE_CHECKING:
    from collections.abc import Iterable

    from exactpt.render.canvas import Canvas, Line, Mark, Shape

_ZOOM: Final = 2
_DASH: Final = 5
"""Length of a dash, in pixels."""
_PERIOD: Final = 9
"""Distance from the beginning of a dash to that of the next one."""
_FONTS: Final = {
    "bold": ("DejaVuSans-Bold.ttf", "Arial_Bold.ttf", "arialbd.ttf"),
    "plain": ("DejaVuSans.ttf", "Arial.ttf", "arial.ttf"),
}


def image_of(frame: Canvas, theme: str) -> Image.Image:
    """Return a frame as an image of an even width and height, as encoders want it."""
    colours = DARK if theme == "dark" else LIGHT
    width, height = frame.window.width, frame.window.height + HEADER
    image = Image.new("RGB", (_ZOOM * width, _ZOOM * height), colours["paper"])
    pen = _Pen(image, colours)
    for tile in frame.tiles:
        opacity = 1.0 if tile.colour is None else (0.16, 0.28, 0.4)[tile.level % 3]
        pen.fill(tile.pixels, pen.mixed(tile.colour or colours[f"tint{tile.tint}"], opacity))
    for shape in frame.shapes:
        pen.shape(shape)
    for line in frame.lines:
        stroke = 1.7 if line.kind == "hull" else 1.1
        dashes = pen.dashes(line) if line.kind == "fan" else [(line.start, line.end)]
        for dash in dashes:
            pen.line(dash, colours[line.kind], stroke)
    for mark in frame.marks:
        pen.mark(mark)
    image = image.reduce(_ZOOM)
    draw = ImageDraw.Draw(image)
    for text, weight, size, colour, baseline in (
        (frame.caption, "bold", 16, "ink", 27),
        (frame.news, "bold", 14, "contact", 48),
        (frame.note, "plain", 12, "soft", height - 16),
    ):
        font, place = _font(weight, size), (20, baseline)
        draw.text(place, clean(text), colours[colour], font=font, anchor="ls")
    return image.crop((0, 0, width // 2 * 2, height // 2 * 2))


@cache
def _font(weight: str, size: int) -> Any:  # noqa: ANN401 - one of two classes of Pillow
    for name in _FONTS[weight]:
        try:
            return ImageFont.truetype(name, size)
        except OSError:
            continue
    return ImageFont.load_default(size)


class _Pen:
    """Draws on an image of twice the size; all arguments are in pixels of the window."""

    def __init__(self, image: Image.Image, colours: dict[str, str]) -> None:
        self.image = image
        self.draw = ImageDraw.Draw(image)
        self.colours = colours

    def mixed(self, colour: str, opacity: float) -> tuple[int, ...]:
        """Return a colour over the paper."""
        over, under = ImageColor.getrgb(colour), ImageColor.getrgb(self.colours["paper"])
        return tuple(
            round(opacity * a + (1 - opacity) * b) for a, b in zip(over, under, strict=True)
        )

    def fill(self, pixels: Iterable[Pixel], colour: str | tuple[int, ...]) -> None:
        self.draw.polygon(_points(pixels), fill=colour)

    def line(self, pixels: Iterable[Pixel], colour: str | tuple[int, ...], width: float) -> None:
        """Draw a chain with round ends, if it is wide enough to see them."""
        points, wide = _points(pixels), max(1, round(_ZOOM * width))
        self.draw.line(points, fill=colour, width=wide)
        if wide > 3:
            for point in points:
                self.draw.circle(point, (wide - 1) / 2, fill=colour)

    @staticmethod
    def dashes(line: Line) -> list[tuple[Pixel, Pixel]]:
        """Return the dashes of a line, with gaps as in `exactpt.render.svg`."""
        (x1, y1), (x2, y2) = line.start, line.end
        length = math.dist(line.start, line.end)

        def at(distance: float) -> Pixel:
            share = min(distance / length, 1.0)
            return x1 + share * (x2 - x1), y1 + share * (y2 - y1)

        count = math.ceil(length / _PERIOD)
        return [(at(k * _PERIOD), at(k * _PERIOD + _DASH)) for k in range(count)]

    def shape(self, shape: Shape) -> None:
        """Draw a body: its outline, and its interior or its radius."""
        outline = self.colours["outline"]
        rings = [[shape.pixels[i] for i in ring] for ring in shape.rings]
        is_polygon = shape.closed and len(shape.pixels) > 2
        if is_polygon:
            rings = [[*ring, ring[0]] for ring in rings]
        if shape.radius:
            for ring in rings:
                self.line(ring, outline, 2 * shape.radius + 2.4)
        elif len(shape.pixels) == 1:
            self.line(shape.pixels * 2, outline, 10.2)
            self.line(shape.pixels * 2, shape.colour, 7.8)
        if is_polygon:
            self.interior(rings, shape.colour)
        elif len(shape.pixels) > 1 and not shape.radius:
            self.line(shape.pixels, shape.colour, 3.4)
        for ring in rings:
            if shape.radius:
                self.line(ring, shape.colour, 2 * shape.radius)
            elif is_polygon:
                self.line(ring, outline, 1.2)

    def interior(self, rings: list[list[Pixel]], colour: str) -> None:
        """Fill the points that are inside an odd number of rings."""
        if len(rings) == 1:
            self.fill(rings[0], colour)
            return
        mask = Image.new("1", self.image.size)
        for ring in rings:
            one = Image.new("1", self.image.size)
            ImageDraw.Draw(one).polygon(_points(ring), fill=1)
            mask = ImageChops.logical_xor(mask, one)
        self.image.paste(colour, mask=mask)

    def mark(self, mark: Mark) -> None:
        """Draw the feature that is touched, a ring around the point, and the normal."""
        red = self.colours["contact"]
        if mark.edge is not None:
            self.line(mark.edge, self.mixed(red, 0.55), 4.0)
        (middle,) = _points([mark.pixel])
        self.draw.circle(middle, _ZOOM * 12.2, outline=red, width=round(_ZOOM * 2.4))
        self.draw.circle(middle, _ZOOM * 3.2, fill=red)
        if mark.normal is not None:
            start, tip, *barbs = arrow(mark.pixel, mark.normal)
            for end in (start, *barbs):
                self.line((end, tip), red, 2.4)


def _points(pixels: Iterable[Pixel]) -> list[Pixel]:
    """Return pixels of the window as those of the image that is drawn."""
    return [(_ZOOM * x, _ZOOM * (y + HEADER)) for x, y in pixels]
