"""Draws proof.svg, the picture of the README that says what a proof is, from a proof alone.

python docs/draw_proof.py          # with exactpt installed; `make pictures` does it

Maps and positions are read off the proof and its scene by `exactpt.proof_check`.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import exactpt
from exactpt import Body, Translation
from exactpt.proof_check import Face, PlanarMap
from exactpt.proof_scene import Scene
from exactpt.render.palette import LIGHT, body_colour

SCENE = exactpt.Scene(
    [
        Body("boat", [(0, 1), (3, 1), (4, 2), (3, 3), (0, 3)], Translation([0, 1])),
        Body("quay", [(10, -1), (12, -1), (12, 5), (10, 5)]),
        Body("buoy", [(7, 5), (8, 5), ("15/2", 6)], Translation([0], [0, "1/8"])),
        Body("rock", [(6, -2), (8, -3), (7, -1)]),
    ],
    time=(0, 9),
)
TINTS = ("#e9f0f7", "#f7f0e3", "#e6f3ef", "#efeaf6", "#edf4e5", "#f7ebf1")
SCALE, WIDTH, HEIGHT, TOP = 20, 280, 290, 215


class Panel:
    """The map of a proof at a time."""

    def __init__(self, scene: Scene, faces: list[Face], time: Fraction, left: int) -> None:
        self.scene, self.faces, self.left = scene, faces, left
        self.at = [scene.at(v, time) for v in range(len(scene.body_of))]

    def pixel(self, v: int) -> str:
        """A vertex in the picture."""
        x, y = self.at[v]
        return f"{float(self.left + 14 + x * SCALE):.1f},{float(TOP - 75 - y * SCALE):.1f}"

    def polygon(self, vertices: list[int], style: str) -> str:
        """A polygon."""
        return f'<polygon points="{" ".join(map(self.pixel, vertices))}" {style}/>'

    def line(self, u: int, v: int, style: str) -> str:
        """An edge."""
        (x1, y1), (x2, y2) = (self.pixel(w).split(",") for w in (u, v))
        return f'<line x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}" {style}/>'

    def parts(self) -> Iterator[str]:
        """Faces, and the bodies over them."""
        edge = f'stroke="{LIGHT["diagonal"]}" stroke-width="0.8"'
        for i, face in enumerate(self.faces):
            yield self.polygon([u for u, _ in face], f'fill="{TINTS[i % len(TINTS)]}" {edge}')
        for i, body in enumerate(self.scene.bodies):
            yield self.polygon([*body.vertices], f'fill="{body_colour(i)}"')

    def text(self, row: int, words: str, style: str = "") -> str:
        """A line below the map."""
        return f'<text x="{self.left + 14}" y="{TOP + 18 * row}" {style}>{words}</text>'

    def dot(self, v: int) -> str:
        """A mark at a vertex."""
        x, y = self.pixel(v).split(",")
        return f'<circle cx="{x}" cy="{y}" r="4" fill="{LIGHT["contact"]}"/>'


def panels(lines: list[list[str]], scene: Scene) -> Iterator[str]:
    """The start, the first event, and the contact."""
    cycles = [[int(v) for v in words[1:]] for words in lines if words[0] in ("face", "outer")]
    shown = PlanarMap(len(scene.body_of))
    shown.begin([*cycles, *([*body.vertices] for body in scene.bodies)])
    outer = {u for words in lines if words[0] == "outer" for u in map(int, words[1:])}

    def panel(time: Fraction, k: int) -> Panel:
        solid = {frozenset(body.vertices) for body in scene.bodies}
        inner = [f for f in sorted(shown.faces) if {u for u, _ in f} not in [*solid, outer]]
        return Panel(scene, inner, time, k * WIDTH)

    first = panel(scene.start, 0)
    yield from first.parts()
    yield first.text(0, "1. At the start: faces with three convex")
    yield first.text(1, "angles each. So no two bodies meet.")
    for row, words in enumerate([w for w in lines if w[0] == "face"][:2], 2):
        yield first.text(row, " ".join(words), 'class="line"')

    event = next(words for words in lines if words[0] == "event")
    u, v, a, b = (int(event[k]) for k in (4, 5, 7, 8))
    second = panel(Fraction(event[1]), 1)
    yield from second.parts()
    yield second.line(u, v, f'stroke="{LIGHT["contact"]}" stroke-width="2" stroke-dasharray="5 4"')
    yield second.line(a, b, f'stroke="{LIGHT["added"]}" stroke-width="2"')
    yield second.text(0, "2. When an angle vanishes: which edges")
    yield second.text(1, "go and come. Until then, none vanishes.")
    yield second.text(2, " ".join(event), 'class="line"')

    for words in (w for w in lines if w[0] == "event"):
        change(shown, words)
    contact = lines[-1]
    third = panel(Fraction(contact[1]), 2)
    yield from third.parts()
    yield third.dot(int(contact[4]))
    yield third.text(0, "3. The last line: what touches, and when.")
    yield third.text(1, "It is true that it does, by exact signs.")
    yield third.text(2, " ".join(contact), 'class="line"')


def change(shown: PlanarMap, words: list[str]) -> None:
    """Change a map as the line of an event says."""
    items: dict[str, list[list[int]]] = {"-": [], "+": [], "=": []}
    start = next(k for k, word in enumerate(words) if word in items)
    for word in words[start:]:
        if word in items:
            kind = word
            items[kind].append([])
        else:
            items[kind][-1].append(int(word))
    gone, come = shown.change([(u, v) for u, v in items["-"]], items["+"])
    shown.make_faces(gone | {d for u, v, w in come for d in ((u, v), (v, w))})


def picture() -> str:
    """The picture as an SVG document."""
    proof = exactpt.prove(SCENE, tiling="lazy")
    lines = [line.split() for line in proof.text.decode().splitlines()]
    text = f"text{{font:13px sans-serif;fill:{LIGHT['ink']}}}"
    style = f"{text}.line{{font:11px monospace;fill:{LIGHT['soft']}}}"
    head = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {3 * WIDTH} {HEIGHT}" role="img">',
        "<title>A proof: the tiling at the start, its changes, and the contact</title>",
        f"<style>{style}</style>",
        f'<rect width="{3 * WIDTH}" height="{HEIGHT}" fill="{LIGHT["paper"]}"/>',
    ]
    return "\n".join([*head, *panels(lines, Scene(proof.scene.decode())), "</svg>", ""])


if __name__ == "__main__":
    Path(__file__).with_name("proof.svg").write_text(picture(), encoding="utf-8")
