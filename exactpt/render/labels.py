"""Places for the names of bodies, where they hide no body."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple, TypeAlias

from exactpt.render.window import Pixel
from exactpt.render.words import short

_Box: TypeAlias = tuple[float, float, float, float]

_LETTER: Final = 7.0
"""Estimated mean width in pixels of a letter of a name, rounded up."""
_HALF: Final = 7.0
"""Half the height in pixels of a name."""
_ASIDE: Final = (0.0, 16.0, -16.0, 32.0, -32.0, 48.0, -48.0)
"""Distances in pixels by which a name is moved down, to be beside an arrow."""
_ABOVE: Final = 13.0
"""Distance in pixels of a name from the point or line that it belongs to."""


class Named(NamedTuple):
    """A body to be labelled: its name, vertices and edges, and all pixels within a radius."""

    name: str
    pixels: Sequence[Pixel]
    edges: Sequence[tuple[int, int]]
    has_interior: bool
    radius: float

    @property
    def is_thin(self) -> bool:
        """True if no name has room inside: a point, a segment or an open chain."""
        return not self.radius and not self.has_interior


def labels(bodies: Sequence[Named], arrows: Sequence[_Box] = ()) -> Iterator[Pixel | None]:
    """For each body the centre of its name; None if it would hide a body or another name.

    A name that an arrow would cross, of which ``arrows`` has small boxes, is above or below it.

    The name is within the bounding box of its body; that of a point or line is above it, and
    outside the bounding boxes of all other bodies. `painter.js` follows the same rule, but for
    arrows.
    """
    boxes = [_box_of(body) for body in bodies]
    taken: list[_Box] = []
    for i, body in enumerate(bodies):
        x, y = _middle(body)
        half = len(short(body.name)) * _LETTER / 2
        places = [(x - half, y + up - _HALF, x + half, y + up + _HALF) for up in _ASIDE]
        if not any(_meet(arrow, places[0]) for arrow in arrows):
            places = places[:1]
        for up, place in zip(_ASIDE, places, strict=False):
            if body.is_thin:
                fits = not any(_meet(box, place) for k, box in enumerate(boxes) if k != i)
            else:
                fits = _covers(boxes[i], place)
            if fits and not any(_meet(other, place) for other in (*taken, *arrows)):
                taken.append(place)
                yield x, y + up
                break
        else:
            yield None


def _box_of(body: Named) -> _Box:
    xs, ys = zip(*body.pixels, strict=True)
    r = body.radius
    return min(xs) - r, min(ys) - r, max(xs) + r, max(ys) + r


def _meet(a: _Box, b: _Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def _covers(a: _Box, b: _Box) -> bool:
    return a[0] <= b[0] and a[1] <= b[1] and b[2] <= a[2] and b[3] <= a[3]


def _middle(body: Named) -> Pixel:
    """Return the position of a name: the middle of a body, or where it is widest."""
    pixels = body.pixels
    x, y = (sum(c) / len(pixels) for c in zip(*pixels, strict=True))
    if not body.has_interior:
        return x, min(q for _, q in pixels) - _ABOVE if body.is_thin else y
    sides = [(pixels[i], pixels[j]) for i, j in body.edges]
    if any(left < x < right for left, right in _inside_at(sides, y)):
        return x, y
    low, high = min(q for _, q in pixels), max(q for _, q in pixels)
    rows = [low + (high - low) * k / 16 for k in range(1, 16)]
    spans = [(right - left, left, row) for row in rows for left, right in _inside_at(sides, row)]
    width, left, row = max(spans, default=(0.0, x, y))
    return left + width / 2, row


def _inside_at(sides: Sequence[tuple[Pixel, Pixel]], y: float) -> list[tuple[float, float]]:
    """Return the intervals in which the horizontal line at height y is inside a polygon."""
    crossings = sorted(
        px + (y - py) * (qx - px) / (qy - py)
        for (px, py), (qx, qy) in sides
        if (py <= y) != (qy <= y)
    )
    return list(zip(crossings[::2], crossings[1::2], strict=True))
