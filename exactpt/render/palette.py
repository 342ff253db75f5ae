"""Colours: one per body, tints for tiles, and two themes; the same in every picture."""

from __future__ import annotations

import colorsys
from collections.abc import Callable
from typing import Final, TypeAlias

TINTS: Final = 6
"""Number of tints for tiles."""

# No reds: red is for contacts.
_FIRST: Final = (
    "#4c7fb5",  # blue
    "#e8a33d",  # amber
    "#35a08c",  # teal
    "#8c6cc4",  # violet
    "#6ea544",  # green
    "#c9709f",  # pink
    "#3fa3c9",  # sky
    "#b38a45",  # ochre
    "#6474c4",  # indigo
    "#93a83b",  # lime
    "#a3785f",  # brown
    "#4fae6d",  # mint
)

LIGHT: Final[dict[str, str]] = {
    "paper": "#fbfbf9",
    "card": "#ffffff",
    "line": "#e2e4e8",
    "ink": "#1b2430",
    "soft": "#5c6776",
    "outline": "#26313f",
    "diagonal": "#7d8a9c",
    "fan": "#0e8fa3",
    "hull": "#3c4b60",
    "accent": "#2f6fd0",
    "contact": "#d92d20",
    "added": "#0a8f5b",
    "removed": "#c4620a",
    "next": "#7a3fd1",
    "tint0": "#e6eef8",
    "tint1": "#ece8f7",
    "tint2": "#e2f2ee",
    "tint3": "#f6efe1",
    "tint4": "#eaf2df",
    "tint5": "#f6e8ef",
}

DARK: Final[dict[str, str]] = {
    "paper": "#0e1218",
    "card": "#161c25",
    "line": "#2a3340",
    "ink": "#e8edf4",
    "soft": "#98a5b6",
    "outline": "#f1f4f8",
    "diagonal": "#7688a0",
    "fan": "#45c4d8",
    "hull": "#b4c2d6",
    "accent": "#6ea8ff",
    "contact": "#ff5c50",
    "added": "#3ddc97",
    "removed": "#ff9f45",
    "next": "#b78cff",
    "tint0": "#172536",
    "tint1": "#211f39",
    "tint2": "#132b2b",
    "tint3": "#2b2619",
    "tint4": "#1d2a19",
    "tint5": "#2c1c2a",
}

FONT: Final = "ui-sans-serif, system-ui, 'DejaVu Sans', Arial, sans-serif"

Rules: TypeAlias = Callable[[dict[str, str]], dict[str, str]]
"""The style rules for given colours, by selectors."""


def style_of(theme: str, kind: str, rules: Rules) -> str:
    """Return the style rules of a theme, each under a class: a page may hold many pictures."""
    if theme != "auto":
        return _under(f".{kind}-{theme}", rules(DARK if theme == "dark" else LIGHT))
    light, dark = (_under(f".{kind}-auto", rules(colours)) for colours in (LIGHT, DARK))
    return f"{light}@media (prefers-color-scheme:dark){{{dark}}}"


def _under(name: str, rules: dict[str, str]) -> str:
    return "".join(
        f"{name} {part}{{{rule}}}"
        for selector, rule in rules.items()
        for part in selector.split(",")
    )


def body_colour(index: int) -> str:
    """Return the colour of the body with a given index, legible on light and on dark paper."""
    if index < len(_FIRST):
        return _FIRST[index]
    # Golden-ratio steps through the hues from yellow to pink, in three degrees of lightness.
    step = index - len(_FIRST)
    hue = 0.09 + 0.80 * (step * 0.6180339887498949 % 1.0)
    rgb = colorsys.hls_to_rgb(hue, (0.52, 0.60, 0.46)[step % 3], 0.46)
    return "#" + "".join(f"{round(255 * c):02x}" for c in rgb)
