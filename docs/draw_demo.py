"""Draws demo.svg, the moving picture of the README: the demo's tiling up to its first contact.

    python docs/draw_demo.py           # with exactpt installed; `make pictures` does it

Positions are exact at the times of the keys, and rounded to a tenth of a pixel; a viewer
moves everything straight in between. One that cannot shows the start,
and one that is asked for reduced motion the contact.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib.resources import files
from itertools import accumulate
from pathlib import Path
from typing import TypeAlias

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from exactpt.render.film import Film, film_of
from exactpt.render.palette import DARK, LIGHT, TINTS, body_colour
from exactpt.scene.format import loads

KEYS = 60
SECONDS, PAUSE = 12, 3
WIDTH, MARGIN = 800, 24
RULER = 32
LEVELS = (0.16, 0.28, 0.4)
SPOKEN = 'role="img" aria-labelledby="title"'
TITLE = "The demo's tiling flexes up to its first contact; below, the times of its events"

Shaped: TypeAlias = Callable[[str, tuple[int, ...], int, int | None], str]


class Picture:
    """A film as SVG elements that move and that are there from one key to another."""

    def __init__(self, film: Film) -> None:
        self.film = film
        end = film.end.canonical_interval()[0]
        self.start, self.span = film.scene.start, end - film.scene.start
        grid = [self.start + self.span * k / KEYS for k in range(KEYS + 1)]
        places = [
            [p for body in film.scene.bodies for p in body.at(t)] for t in grid
        ]  # at each key, of each vertex
        xs, ys = zip(*(p for row in places for p in row), strict=True)
        self.left, self.top = min(xs), max(ys)
        self.scale = QQ(WIDTH - 2 * MARGIN) / (max(xs) - self.left)
        self.height = int((self.top - min(ys)) * self.scale) + 2 * MARGIN
        self.grid, self.at_key = grid, [[self.pixel(*p) for p in row] for row in places]

    def pixel(self, x: QQ, y: QQ) -> str:
        """A place in the picture."""
        px, py = (x - self.left) * self.scale + MARGIN, (self.top - y) * self.scale + MARGIN
        return f"{float(px):.1f},{float(py):.1f}"

    def time_of(self, step: int | None) -> QQ:
        """The time of a step, a little early if it is not rational; None: of the end."""
        if step == 0:
            return self.start
        number: AlgebraicNumber = self.film.end if step is None else self.film.steps[step - 1].time
        return number.canonical_interval()[0]

    def key(self, t: QQ) -> float:
        """When in the loop a time is: the picture stands still at the end."""
        return float((t - self.start) / self.span) * SECONDS / (SECONDS + PAUSE)

    def moving(self, kind: str, nodes: tuple[int, ...], first: int, last: int | None) -> str:
        """A polygon or line through vertices, between two steps; "" if that is no time."""
        t0, t1 = self.time_of(first), self.time_of(last)
        if t0 >= t1:
            return ""
        inner = [k for k, t in enumerate(self.grid) if t0 < t < t1]
        rows = [
            [row[v] for v in nodes]
            for row in (self.at(t0), *map(self.at_key.__getitem__, inner), self.at(t1))
        ]
        times = [self.key(t) for t in (t0, *(self.grid[k] for k in inner), t1)]
        points = [" ".join(row) for row in rows]
        keys = "".join(f";{time:.5f}" for time in times)
        move = f'values="{";".join([points[0], *points, points[-1]])}" keyTimes="0{keys};1"'
        shown = f"{times[0]:.5f};{times[-1]:.5f}"
        until = "hidden" if last is not None else "visible"
        seen = f'values="hidden;visible;{until}" keyTimes="0;{shown}" calcMode="discrete"'
        if first == 0:
            seen = f'values="visible;{until}" keyTimes="0;{times[-1]:.5f}" calcMode="discrete"'
        loop = f'dur="{SECONDS + PAUSE}s" repeatCount="indefinite"'
        hidden = ' visibility="hidden"' if first > 0 else ""
        return (
            f'<{kind} points="{points[0]}"{hidden}><animate attributeName="points" {move} {loop}/>'
            f'<animate attributeName="visibility" {seen} {loop}/></{kind}>'
        )

    def at(self, t: QQ) -> list[str]:
        """The places of all vertices at a time."""
        return [self.pixel(*p) for body in self.film.scene.bodies for p in body.at(t)]

    def svg(self) -> str:
        """The picture: it moves, or shows the contact to whoever prefers reduced motion."""
        height = self.height + RULER
        parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" {SPOKEN}>',
            f'<title id="title">{TITLE}</title>',
            f"<style>{_style()}</style>",
            '<rect class="paper" width="100%" height="100%"/>',
            '<g class="moves" stroke-linejoin="round" stroke-linecap="round">',
            *self.parts(self.moving),
            self.contact(moving=True),
            "</g>",
            '<g class="rests" stroke-linejoin="round" stroke-linecap="round">',
            *self.parts(self.resting),
            self.contact(moving=False),
            "</g>",
            *self.ruler(),
            "</svg>",
        ]
        return "\n".join([*filter(None, parts), ""])

    def resting(self, kind: str, nodes: tuple[int, ...], first: int, last: int | None) -> str:
        """As `moving`, at the end."""
        if last is not None or self.time_of(first) >= self.time_of(None):
            return ""
        row = self.at_key[-1]
        return f'<{kind} points="{" ".join(row[v] for v in nodes)}"/>'

    def parts(self, shape: Shaped) -> Iterator[str]:
        """Tiles, bodies and edges."""
        film = self.film
        for tile in film.tiles:
            drawn = "" if tile.inside else shape("polygon", tile.nodes, tile.first, tile.last)
            if drawn and tile.place.body >= 0:
                strength = LEVELS[tile.place.level % len(LEVELS)]
                fill = f'fill="{body_colour(tile.place.body)}" fill-opacity="{strength}"'
                yield f"<g {fill}>{drawn}</g>"
            elif drawn:
                yield f'<g class="tint{tile.tint}">{drawn}</g>'
        ring = list(accumulate((body.size for body in film.scene.bodies), initial=0))
        for i, body in enumerate(film.scene.bodies):
            nodes = tuple(range(ring[i], ring[i + 1]))
            look = f'class="body" fill="{body_colour(i)}" stroke-width="1.2"'
            if body.size < 3:
                width, nodes = (9, nodes * 2) if body.size == 1 else (4, nodes)
                look = f'fill="none" stroke="{body_colour(i)}" stroke-width="{width}"'
            yield f"<g {look}>{shape('polygon', nodes, 0, None)}</g>"
        for kind, width in (("diagonal", 1.1), ("hull", 1.8), ("rim", 1.8)):
            name = "diagonal" if kind == "diagonal" else "hull"
            yield f'<g class="{name}" fill="none" stroke-width="{width}">'
            for edge in film.edges:
                if edge.kind == kind:
                    yield shape("polyline", (edge.u, edge.v), edge.first, edge.last)
            yield "</g>"

    def ruler(self) -> Iterator[str]:
        """The times of the events as ticks, and where the picture is."""
        y, width = self.height + RULER // 2, WIDTH - 2 * MARGIN
        share = [
            (self.time_of(k + 1) - self.start) / self.span for k in range(len(self.film.steps))
        ]
        ticks = "".join(f"M{MARGIN + float(x) * width:.1f} {y - 5}v10" for x in share[:-1])
        yield f'<path class="ticks" d="M{MARGIN} {y}h{width}{ticks}"/>'
        yield f'<path class="touch" stroke-width="2.6" d="M{WIDTH - MARGIN} {y - 8}v16"/>'
        rest = SECONDS / (SECONDS + PAUSE)
        move = (
            f'<animate attributeName="cx" values="{MARGIN};{WIDTH - MARGIN};{WIDTH - MARGIN}" '
            f'keyTimes="0;{rest};1" dur="{SECONDS + PAUSE}s" repeatCount="indefinite"/>'
        )
        yield f'<circle class="now moves" cx="{MARGIN}" cy="{y}" r="5">{move}</circle>'

    def contact(self, *, moving: bool) -> str:
        """A ring around what touches; if all else moves, while the picture stands still."""
        contact, share = self.film.contact, SECONDS / (SECONDS + PAUSE)
        if contact is None:
            return ""
        rings = []
        for pair in contact.pairs:
            x, y = self.pixel(*map(QQ, pair.point)).split(",")
            rings.append(f'<circle cx="{x}" cy="{y}" r="11"/>')
        look = 'class="touch" fill="none" stroke-width="2.6"'
        if not moving:
            return f"<g {look}>{''.join(rings)}</g>"
        loop = f'dur="{SECONDS + PAUSE}s" repeatCount="indefinite" calcMode="discrete"'
        seen = f'values="hidden;visible" keyTimes="0;{share}" {loop}'
        show = f'<animate attributeName="visibility" {seen}/>'
        return f'<g {look} visibility="hidden">{"".join(rings)}{show}</g>'


def _style() -> str:
    dark, calm = "(prefers-color-scheme:dark)", "(prefers-reduced-motion:reduce)"
    return (
        f".rests{{display:none}}{_rules(LIGHT)}@media {dark}{{{_rules(DARK)}}}"
        f"@media {calm}{{.moves{{display:none}}.rests{{display:inline}}}}"
    )


def _rules(colours: dict[str, str]) -> str:
    fills = {"paper": "paper", "now": "accent"} | {f"tint{i}": f"tint{i}" for i in range(TINTS)}
    strokes = {
        "body": "outline", "diagonal": "diagonal", "hull": "hull", "ticks": "soft",
        "touch": "contact",
    }  # fmt: skip
    return "".join(
        f".{name}{{{what}:{colours[colour]}}}"
        for what, names in (("fill", fills), ("stroke", strokes))
        for name, colour in names.items()
    )


def drawn() -> str:
    """The picture of the demo."""
    scene = loads((files("exactpt") / "data" / "demo.json").read_text(encoding="utf-8"))
    return Picture(film_of(scene, tiling="mixed")).svg()


def main() -> None:
    """Draw it."""
    (Path(__file__).parent / "demo.svg").write_text(drawn(), encoding="utf-8")


if __name__ == "__main__":
    main()
