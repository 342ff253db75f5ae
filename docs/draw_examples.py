"""Draws the pictures of docs/examples, of what the code of each page has made.

python docs/draw_examples.py        # with exactpt and its test extra installed; `make pictures`
"""

from __future__ import annotations

import doctest
from pathlib import Path
from typing import Any, Final

from exactpt.kernel.numbers import rational
from exactpt.render.draw import draw

EXAMPLES = Path(__file__).parent / "examples"

DRAWN: Final = {
    "robot": "best, '13/10'",
    "game": "Scene([Body.launched('puck', [(0, 0)], at=0, velocity=(3, '13/10'), radius='1/2'), "
    "*bats, walls[0], walls[2]], time=(0, 9)), 'contact'",
    "nesting": "scene, 10",
    "morph": "Scene([body for body in morph.bodies if body.name == 'Zambia']), 'contact'",
    "gears": "train(10.1, thickness=0.6), 'contact'",
}
"""For each page the scene that is drawn, and the time."""


def made(page: str) -> dict[str, Any]:
    """The names that the code of a page has bound."""
    text = (EXAMPLES / f"{page}.md").read_text(encoding="utf-8")
    names: dict[str, Any] = {}
    for example in doctest.DocTestParser().get_examples(text):
        exec(compile(example.source, page, "single"), names)
    return names


def main() -> None:
    """Draw all of them anew."""
    for page, expression in DRAWN.items():
        scene, at = eval(expression, made(page))
        time = at if at == "contact" else rational(at)
        draw(scene, EXAMPLES / f"{page}.svg", at=time)


if __name__ == "__main__":
    main()
