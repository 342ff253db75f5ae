"""Pages: an animation as one self-contained HTML file, the same in every run."""

from __future__ import annotations

import json
from html import escape
from importlib.resources import files
from typing import TYPE_CHECKING, Final

from exactpt.brief import counted
from exactpt.render.data import data_of
from exactpt.render.palette import DARK, LIGHT
from exactpt.render.plot import plot_of, strip_of
from exactpt.render.words import clean, time_in_words

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.kernel.numbers import QQ
    from exactpt.render.film import Film
    from exactpt.search.clearance import Clearance

SCRIPTS: Final = (
    "exact",
    "film",
    "chart",
    "camera",
    "pen",
    "shadow",
    "painter",
    "certificates",
    "picker",
    "player",
    "panel",
    "stage",
    "pointer",
    "controls",
    "main",
)
"""The parts of the page's script, in order of dependency; `main` starts it."""


def page_of(
    film: Film,
    *,
    title: str = "exactpt",
    at: AlgebraicNumber | QQ | None = None,
    theme: str = "auto",
    gap: Clearance | None = None,
    below: QQ | None = None,
) -> str:
    """Return the animation of a film as an HTML document.

    Args:
        film: the recorded run.
        title: the title of the page.
        at: the time shown first; by default the start.
        theme: "light", "dark" or "auto" (the reader's preference).
        gap: a distance that is plotted above the scrubber.
        below: a distance that is marked in its plot.
    """
    data = json.dumps(data_of(film, at=at), separators=(",", ":"))
    parts = {
        "title": escape(clean(title)),
        "summary": escape(_summary(film)),
        "theme": "" if theme == "auto" else f' data-theme="{theme}"',
        "plotted": "" if gap is None else " plotted",
        "plot": "" if gap is None else strip_of(plot_of(gap, below)),
        "style": _variables() + _asset("page.css"),
        # Inside a script element only its closing tag has to be escaped.
        "data": data.replace("<", "\\u003c"),
        "script": "\n".join(_asset(f"{name}.js") for name in SCRIPTS),
    }
    # Split first: inserted text may itself contain a placeholder.
    pieces = _asset("page.html").split("@@")
    return "".join(parts[piece] if i % 2 else piece for i, piece in enumerate(pieces))


def _asset(name: str) -> str:
    return (files("exactpt.render") / "assets" / name).read_text(encoding="utf-8")


def _summary(film: Film) -> str:
    scene = film.scene
    count = sum(len(step.changes) for step in film.steps)
    bodies = counted(len(scene.bodies), "body")
    vertices = counted(scene.vertex_count, "vertex")
    span = f"from {time_in_words(scene.exact_start)} to {time_in_words(film.end.simplified())}"
    return f"{bodies}, {vertices}, {film.tiling} tiling, {counted(count, 'event')} {span}"


def _variables() -> str:
    light, dark = (
        "".join(f"--{name}:{value};" for name, value in theme.items()) for theme in (LIGHT, DARK)
    )
    return (
        f":root{{color-scheme:light;{light}}}\n"
        "@media (prefers-color-scheme:dark){:root:not([data-theme=light])"
        f"{{color-scheme:dark;{dark}}}}}\n"
        f":root[data-theme=dark]{{color-scheme:dark;{dark}}}\n"
    )
