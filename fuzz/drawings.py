"""Drawings: the outlines that are read are those that an independent renderer fills.

A case is one random outline in up to four random groups, copies, symbols, nested drawings and clip
paths. The renderer is resvg: the filled pixels have the box and the area of the outline. Features
in which resvg differs from SVG 2 are left out: percentages in nested drawings, and places in style
sheets. An outline that a reader refuses, since something cuts it, is not compared.
"""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Final, NamedTuple

import click
import numpy as np
from numpy.typing import NDArray

from exactpt import InputError
from exactpt.exchange.shapes import Shape
from exactpt.exchange.svg import shapes_of
from exactpt.geometry.polygon import signed_area2
from exactpt.render.png import png_of
from fuzz.campaign import Check, Counts, Finding, Item, Result, Step, Tell
from fuzz.options import HELP, Options, conduct, options

__all__ = ["Drawings", "compared", "drawing", "drawings"]

SIDE: Final = 400
"""Width and height of a drawing, in pixels."""
PATIENCE: Final = 20.0
"""Seconds in which a drawing is read and rendered."""
_BORDER: Final = 6.0
"""Pixels by which boxes may differ: the last pixels of a sharp corner are nearly empty."""
_PART: Final = 0.03
"""Relative difference of areas that is allowed, beside that of `_FEW` pixels."""
_FEW: Final = 60.0

_LEAST: Final = 0.05
"""The least part of a pixel that counts for the box."""

_ASPECTS: Final = (
    "", 'preserveAspectRatio="none"', 'preserveAspectRatio="xMinYMin meet"',
    'preserveAspectRatio="xMaxYMid slice"', 'preserveAspectRatio="xMidYMax meet"',
)  # fmt: skip


class Compared(NamedTuple):
    """The comparison of a drawing with its picture.

    Attributes:
        outcome: "same", "refused", "outside" (not all is on the page), or "FAULT".
        fault: the difference; empty without one.
    """

    outcome: str
    fault: str = ""


def drawing(rng: Random) -> str:
    """A random drawing."""
    text = _outline(rng)
    for _ in range(rng.randint(0, 4)):
        text = _wrapped(rng, text)
    head = f'width="{SIDE}" height="{SIDE}" viewBox="0 0 {SIDE} {SIDE}"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {head}>{text}</svg>'


def _some(rng: Random, low: float, high: float) -> float:
    return round(rng.uniform(low, high), 1)


def _outline(rng: Random) -> str:
    x, y = _some(rng, 0, 50), _some(rng, 0, 50)
    wide, high = _some(rng, 20, 60), _some(rng, 20, 60)
    match rng.randrange(8):
        case 0:
            return (
                f'<rect x="{x}" y="{y}" width="{wide}" height="{high}" rx="{rng.choice([0, 9])}"/>'
            )
        case 1:
            return f'<circle cx="{x + 40}" cy="{y + 40}" r="{wide / 2}"/>'
        case 2:
            return f'<ellipse cx="{x + 40}" cy="{y + 40}" rx="{wide / 2}" ry="{high / 2}"/>'
        case 3:
            return f'<polygon points="{x},{y} {x + wide} {y} {x},{y + high}"/>'
        case 4:
            return f'<path d="M{x} {y}h{wide}q{_some(rng, 0, 20)} 9 12 {high}L{x} {y + high}z"/>'
        case 5 | 6:
            return _crossing(rng)
        case _:
            flags = f"{rng.choice([0, 20, 70])} {rng.randint(0, 1)} {rng.randint(0, 1)}"
            return f'<path d="M{x} {y}a{wide / 2} {high / 2} {flags} {wide / 3} {high / 3}z"/>'


def _crossing(rng: Random) -> str:
    """A path of loops that cross, with a fill rule of its own, of a group, or none."""
    loops = (
        " ".join(f"{_some(rng, 0, 90)},{_some(rng, 0, 90)}" for _ in range(rng.randint(3, 6)))
        for _ in range(rng.randint(1, 3))
    )
    data = " ".join(f"M{loop}z" for loop in loops)
    rule, outer = (rng.choice(["", "nonzero", "evenodd"]) for _ in range(2))
    own = rng.choice([f'fill-rule="{rule}"', f'style="fill-rule: {rule}"']) if rule else ""
    path = f'<path {own} d="{data}"/>'
    return f'<g fill-rule="{outer}">{path}</g>' if outer else path


def _wrapped(rng: Random, text: str) -> str:
    """A drawing in another element."""
    x, y = _some(rng, 0, 40), _some(rng, 0, 40)
    place = f'x="{x}" y="{y}" width="{_some(rng, 100, 300)}" height="{_some(rng, 100, 300)}"'
    aspect, overflow = rng.choice(_ASPECTS), rng.choice(["", 'overflow="visible"'])
    box = f'viewBox="{_some(rng, -20, 20)} {_some(rng, -20, 20)} 150 120" {aspect} {overflow}'
    name = f"n{rng.randrange(10**9)}"
    match rng.randrange(7):
        case 0:
            turn = rng.choice([30, 90, -45, 12.5])
            return f'<g transform="translate({x} {-y}) rotate({turn} 60 60)">{text}</g>'
        case 1:
            stretch = f"{_some(rng, 0.5, 1.5)},{_some(rng, 0.5, 1.5)}"
            return f'<g transform="scale({stretch}) skewX({rng.choice([10, -20])})">{text}</g>'
        case 2:
            return f"<svg {place} {box}>{text}</svg>"
        case 3:
            return f"<svg {place} {overflow}>{text}</svg>"
        case 4:
            return f'<symbol id="{name}" {box}>{text}</symbol><use href="#{name}" {place}/>'
        case 5:
            inner = f'<g id="{name}" transform="translate(3 4)">{text}</g>'
            return f'<defs>{inner}</defs><use x="{x}" href="#{name}" y="{y}"/>'
        case _:
            sides = f"h{_some(rng, 100, 400)}v{_some(rng, 100, 400)}H-50z"
            clip = f'<clipPath id="{name}"><path d="M-50 -50{sides}"/></clipPath>'
            return f'<g clip-path="url(#{name})">{clip}{text}</g>'


def compared(text: str) -> Compared:
    """Return the comparison of a drawing with its picture."""
    try:
        shapes = list(shapes_of(text, 0.02))
    except InputError as error:
        is_cut = "cuts it" in str(error)
        return Compared("refused") if is_cut else Compared("FAULT", f"refused: {error}")
    corners = np.array([(float(x), -float(y)) for shape in shapes for x, y in shape.points])
    if corners.min() < 1 or corners.max() > SIDE - 1:
        return Compared("outside")
    filled = _filled(text)
    rows, columns = np.nonzero(filled > _LEAST)
    if not len(rows):
        return Compared("FAULT", "the picture is empty")
    picture = (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1)
    box = (*corners.min(axis=0), *corners.max(axis=0))
    if max(abs(a - b) for a, b in zip(picture, box, strict=True)) > _BORDER:
        return Compared("FAULT", f"the box {box} is {picture} in the picture")
    area, count = sum(map(_area, shapes)), float(filled.sum())
    if abs(area - count) > _PART * area + _FEW:
        return Compared("FAULT", f"the area {area} is {count} in the picture")
    return Compared("same")


def _filled(text: str) -> NDArray[np.float64]:
    """The part of each pixel that is filled, in rows."""
    from PIL import Image

    image = Image.open(io.BytesIO(png_of(text, zoom=1))).convert("RGBA")
    return np.asarray(image)[:, :, 3] / 255.0


def _area(shape: Shape) -> float:
    outline, *holes = (abs(float(signed_area2(ring))) / 2 for ring in shape.rings)
    return outline - sum(holes)


@dataclass(frozen=True)
class Drawings(Check):
    """The check of drawings.

    Attributes:
        seed: seed of all drawings.
        keep: folder for drawings with a fault.
    """

    seed: int
    keep: Path
    name = "drawings"

    @property
    def about(self) -> object:
        """The seed."""
        return self.seed

    def run(self, item: Item, tell: Tell, ends: float | None) -> Result:  # noqa: ARG002 - it is short
        """Have a drawing read and rendered."""
        number = item.numbers.start
        text = drawing(Random(f"drawing {self.seed} {number}"))
        path = self.keep / f"drawing-{self.seed}-{number}.svg"
        finding = Finding("drawing", "hangs", str(path), {path: text.encode()})
        tell(Step(PATIENCE, finding))
        found = compared(text)
        counts = Counts({("drawing", found.outcome): 1})
        if not found.fault:
            return Result(counts)
        why = f"{path}: {found.fault}"
        return Result(counts, [finding._replace(signature="FAULT", why=why)])

    def table(self, counts: Counts) -> list[str]:
        """The numbers of outcomes."""
        words = ("same", "refused", "outside", "FAULT")
        return [
            "".join(f"{word:>10}" for word in words),
            "".join(f"{counts['drawing', word]:>10}" for word in words),
        ]


@click.command("drawings", context_settings=HELP)
@click.option(
    "--keep",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path("drawings-found"),
    show_default=True,
    help="Folder for drawings with a fault.",
)
@options(500)
def drawings(chosen: Options, keep: Path) -> None:
    """Compare the outlines of random drawings with the pixels that resvg fills."""
    conduct(Drawings(chosen.seed, keep), chosen, again=f"--seed {chosen.seed}")
