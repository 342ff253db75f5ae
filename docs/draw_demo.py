"""Draws demo.svg, the moving picture of the README: the demo's tiling up to its first contact.

    python docs/draw_demo.py           # with exactpt installed; `make pictures` does it

Positions are exact at the times of the keys, and rounded to a tenth of a pixel; a viewer
moves everything straight in between. One that cannot shows the start.
"""

from __future__ import annotations

from importlib.resources import files
from itertools import accumulate
from pathlib import Path

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from exactpt.render.film import Film, film_of
from exactpt.render.palette import LIGHT, body_colour
from exactpt.scene.format import loads

KEYS = 60
SECONDS, PAUSE = 12, 3
WIDTH, MARGIN = 800, 24
LEVELS = (0.16, 0.28, 0.4)


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
        """The picture."""
        film, colours = self.film, LIGHT
        bodies = film.scene.bodies
        ring = list(accumulate((body.size for body in bodies), initial=0))
        parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {self.height}">',
            f'<rect width="100%" height="100%" fill="{colours["paper"]}"/>',
            '<g stroke-linejoin="round" stroke-linecap="round">',
        ]
        for tile in film.tiles:
            if not tile.inside:
                fill = f'fill="{colours[f"tint{tile.tint}"]}"'
                if tile.place.body >= 0:
                    strength = LEVELS[tile.place.level % len(LEVELS)]
                    fill = f'fill="{body_colour(tile.place.body)}" fill-opacity="{strength}"'
                shape = self.moving("polygon", tile.nodes, tile.first, tile.last)
                parts.append(f"<g {fill}>{shape}</g>" if shape else "")
        for i, body in enumerate(bodies):
            nodes = tuple(range(ring[i], ring[i + 1]))
            look = f'fill="{body_colour(i)}" stroke="{colours["outline"]}" stroke-width="1.2"'
            if body.size < 3:
                width, nodes = (9, nodes * 2) if body.size == 1 else (4, nodes)
                look = f'fill="none" stroke="{body_colour(i)}" stroke-width="{width}"'
            parts.append(f"<g {look}>{self.moving('polygon', nodes, 0, None)}</g>")
        for kind, width in (("diagonal", 1.1), ("hull", 1.8), ("rim", 1.8)):
            colour = colours["diagonal" if kind == "diagonal" else "hull"]
            parts.append(f'<g fill="none" stroke="{colour}" stroke-width="{width}">')
            parts += [
                self.moving("polyline", (edge.u, edge.v), edge.first, edge.last)
                for edge in film.edges
                if edge.kind == kind
            ]
            parts.append("</g>")
        return "\n".join([*filter(None, parts), self.contact(), "</g></svg>", ""])

    def contact(self) -> str:
        """A ring around what touches, while the picture stands still."""
        contact, share = self.film.contact, SECONDS / (SECONDS + PAUSE)
        if contact is None:
            return ""
        rings = []
        for pair in contact.pairs:
            x, y = self.pixel(*map(QQ, pair.point)).split(",")
            rings.append(f'<circle cx="{x}" cy="{y}" r="11"/>')
        loop = f'dur="{SECONDS + PAUSE}s" repeatCount="indefinite" calcMode="discrete"'
        seen = f'values="hidden;visible" keyTimes="0;{share}" {loop}'
        show = f'<animate attributeName="visibility" {seen}/>'
        look = f'fill="none" stroke="{LIGHT["contact"]}" stroke-width="2.6" visibility="hidden"'
        return f"<g {look}>{''.join(rings)}{show}</g>"


def drawn() -> str:
    """The picture of the demo."""
    scene = loads((files("exactpt") / "data" / "demo.json").read_text(encoding="utf-8"))
    return Picture(film_of(scene, tiling="mixed")).svg()


def main() -> None:
    """Draw it."""
    (Path(__file__).parent / "demo.svg").write_text(drawn(), encoding="utf-8")


if __name__ == "__main__":
    main()
