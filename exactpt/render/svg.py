"""SVG: the primitives of a frame as a document, for light and for dark paper."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Final
from xml.sax.saxutils import escape

from exactpt.render.palette import FONT, TINTS, style_of
from exactpt.render.window import HEADER, Pixel, arrow
from exactpt.render.words import clean, short

if TYPE_CHECKING:
    from exactpt.render.canvas import Canvas, Line, Mark, Shape, Tile

_COLUMN: Final = 190
"""Width of a legend."""
_ROW: Final = 18


def svg_of(frame: Canvas, *, theme: str = "auto") -> str:
    """Return the picture as an SVG document.

    Strokes keep their width when the picture is scaled. Pixel (0, 0) of the frame's window is
    at (0, 60), below the caption.
    """
    column = _COLUMN if frame.legend else 0
    width, height = frame.window.width + column, frame.window.height + HEADER
    size = f'width="{width}" height="{height}"'
    box = f'viewBox="0 0 {width} {height}"'
    rules = partial(
        _rules,
        has_more=bool(frame.scale or frame.ghosts),
        has_fan=any(line.kind == "fan" for line in frame.lines),
    )
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" class="exactpt-{theme}" {box} {size} role="img">',
        f"<title>{_text(frame.caption)}</title>",
        f"<style>{style_of(theme, 'exactpt', rules)}</style>",
        f'<rect class="paper" {size}/>',
        f'<text class="caption" x="20" y="27">{_text(frame.caption)}</text>',
        f'<text class="news" x="20" y="48">{_text(frame.news)}</text>',
        f'<text class="note" x="20" y="{height - 16}">{_text(frame.note)}</text>',
        f'<g transform="translate(0 {HEADER})">',
        *(_group("ghosts bodies", map(_shape, frame.ghosts)) if frame.ghosts else ()),
        *(_group("paths", map(_path, frame.paths)) if frame.paths else ()),
        *_group("tiles", map(_tile, frame.tiles)),
        *_group("bodies", map(_shape, frame.shapes)),
        *_group("lines", map(_line, frame.lines)),
        *_group("names", (_name(s.name, s.label) for s in frame.shapes if s.label is not None)),
        *_group("contact", (part for mark in frame.marks for part in _mark(mark))),
        "</g>",
        *_legend(frame.legend, frame.window.width, height),
        *_bar(frame.scale, frame.window.width, height),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def _rules(colours: dict[str, str], *, has_more: bool, has_fan: bool) -> dict[str, str]:
    halo = f"paint-order:stroke;stroke:{colours['paper']};stroke-linejoin:round"
    rules = {
        "text": f"font-family:{FONT};fill:{colours['ink']}",
        "path,line,polygon,polyline,circle": "vector-effect:non-scaling-stroke",
        ".paper": f"fill:{colours['paper']}",
        ".caption": "font-size:16px;font-weight:600",
        ".news": f"font-size:14px;font-weight:600;fill:{colours['contact']}",
        ".note": f"font-size:12px;fill:{colours['soft']}",
        **{f".t{i}": f"fill:{colours[f'tint{i}']}" for i in range(TINTS)},
        ".bodies *": f"stroke:{colours['outline']};stroke-width:1.2;stroke-linejoin:round",
        ".bodies .thin": "fill:none;stroke-width:3.4;stroke-linecap:round",
        ".diagonal": f"stroke:{colours['diagonal']};stroke-width:1.1",
        ".hull": f"stroke:{colours['hull']};stroke-width:1.7",
        ".names text": f"font-size:12px;text-anchor:middle;stroke-width:3px;{halo}",
        ".contact": f"stroke:{colours['contact']};fill:none;stroke-width:2.4",
        ".contact .dot": f"fill:{colours['contact']};stroke:none",
        ".contact .touched": "stroke-width:4;stroke-opacity:.55;stroke-linecap:round",
    }
    if has_fan:
        rules[".fan"] = f"stroke:{colours['fan']};stroke-width:1.1;stroke-dasharray:5 4"
    if has_more:
        rules |= {
            ".ghosts": "fill-opacity:.18;stroke-opacity:.35",
            ".paths *": "fill:none;stroke-width:1.4;stroke-dasharray:5 3",
            ".legend text": "font-size:12px",
            ".bar": f"stroke:{colours['ink']};stroke-width:2;fill:none",
        }
    return rules


def _group(name: str, parts: Iterable[str]) -> Iterator[str]:
    yield f'<g class="{name}">'
    yield from parts
    yield "</g>"


def _tile(tile: Tile) -> str:
    if tile.colour is None:
        return f'<polygon class="t{tile.tint}" points="{_points(tile.pixels)}"/>'
    # Three opacities by level, from the relative hull inwards.
    opacity = (0.16, 0.28, 0.4)[tile.level % 3]
    fill = f'fill="{tile.colour}" fill-opacity="{opacity}"'
    return f'<polygon {fill} points="{_points(tile.pixels)}"/>'


def _shape(shape: Shape) -> str:
    title = f"<title>{_text(shape.name)}</title>"
    x, y = shape.pixels[0]
    if shape.radius:
        return f'<g class="rounded">{title}{"".join(_rounded(shape))}</g>'
    if len(shape.pixels) == 1:
        return (
            f'<circle cx="{_number(x)}" cy="{_number(y)}" r="4.5" fill="{shape.colour}">'
            f"{title}</circle>"
        )
    if len(shape.pixels) == 2 or not shape.closed:
        return (
            f'<polyline class="thin" style="stroke:{shape.colour}" '
            f'points="{_points(shape.pixels)}">{title}</polyline>'
        )
    name, drawn = _core(shape)
    return f'<{name} fill="{shape.colour}" {drawn}>{title}</{name}>'


def _core(shape: Shape) -> tuple[str, str]:
    """Return the name of the element that draws a polygon, and its outline as attributes."""
    if len(shape.rings) == 1:
        return "polygon", f'points="{_points(shape.pixels)}"'
    rings = ((_pair(shape.pixels[i]) for i in ring) for ring in shape.rings)
    path = "".join(f"M{'L'.join(ring)}Z" for ring in rings)
    return "path", f'fill-rule="evenodd" d="{path}"'


def _rounded(shape: Shape) -> Iterator[str]:
    """Yield the core, drawn twice with a wide pen; the wider one makes the outline."""
    if shape.closed and len(shape.pixels) > 2:
        core, drawn = _core(shape)
    else:
        points = _points(shape.pixels if len(shape.pixels) > 1 else shape.pixels * 2)
        core, drawn = "polyline", f'points="{points}"'
    pen = "stroke-linejoin:round;stroke-linecap:round;vector-effect:none"
    for paint, more in (("", 2.4), (f";stroke:{shape.colour}", 0.0)):
        fill = shape.colour if paint and core != "polyline" else "none"
        style = f"fill:{fill};stroke-width:{_number(2.0 * shape.radius + more)}px;{pen}{paint}"
        yield f'<{core} style="{style}" {drawn}/>'


def _line(line: Line) -> str:
    (x1, y1), (x2, y2) = line.start, line.end
    return (
        f'<line class="{line.kind}" x1="{_number(x1)}" y1="{_number(y1)}" '
        f'x2="{_number(x2)}" y2="{_number(y2)}"/>'
    )


def _name(name: str, at: Pixel) -> str:
    return f'<text x="{_number(at[0])}" y="{_number(at[1] + 4)}">{_text(short(name))}</text>'


def _mark(mark: Mark) -> Iterator[str]:
    """Yield the feature that is touched, a ring around the point, and the normal."""
    x, y = mark.pixel
    if mark.edge is not None:
        (x1, y1), (x2, y2) = mark.edge
        yield (
            f'<line class="touched" x1="{_number(x1)}" y1="{_number(y1)}" '
            f'x2="{_number(x2)}" y2="{_number(y2)}"/>'
        )
    yield f'<circle cx="{_number(x)}" cy="{_number(y)}" r="11"/>'
    yield f'<circle class="dot" cx="{_number(x)}" cy="{_number(y)}" r="3.2"/>'
    if mark.normal is not None:
        start, tip, left, right = map(_pair, arrow(mark.pixel, mark.normal))
        yield f'<path class="normal" d="M{start}L{tip}M{left}L{tip}L{right}"/>'


def _path(path: tuple[str, Sequence[Pixel]]) -> str:
    colour, pixels = path
    return f'<polyline style="stroke:{colour}" points="{_points(pixels)}"/>'


def _legend(rows: Sequence[tuple[str, str]], left: int, height: int) -> Iterator[str]:
    """Yield names with colours in a column, as many as have room."""
    room = (height - 2 * _ROW) // _ROW
    shown = rows if len(rows) <= room else rows[: room - 1]
    yield from ['<g class="legend">'] if rows else []
    for k, (colour, name) in enumerate(shown):
        y = _ROW * (k + 1)
        yield f'<rect x="{left}" y="{y}" width="12" height="12" fill="{colour}"/>'
        yield f'<text x="{left + 18}" y="{y + 10}">{_text(short(name))}</text>'
    if len(shown) < len(rows):
        more = len(rows) - len(shown)
        yield f'<text x="{left}" y="{_ROW * (room + 1) - 6}">and {more} more</text>'
    yield from ["</g>"] if rows else []


def _bar(scale: tuple[float, str] | None, right: int, height: int) -> Iterator[str]:
    if scale is not None:
        pixels, text = scale
        left = right - 20 - pixels
        yield f'<path class="bar" d="M{_number(left)} {height - 24}v6h{_number(pixels)}v-6"/>'
        middle = _number(left + pixels / 2)
        place = f'x="{middle}" y="{height - 28}" text-anchor="middle"'
        yield f'<text class="note" {place}>{text}</text>'


def _points(pixels: Sequence[Pixel]) -> str:
    return " ".join(_pair(pixel) for pixel in pixels)


def _pair(pixel: Pixel) -> str:
    return f"{_number(pixel[0])},{_number(pixel[1])}"


def _number(value: float) -> str:
    """Return a coordinate rounded to a thousandth of a pixel."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _text(text: str) -> str:
    return escape(clean(text))
