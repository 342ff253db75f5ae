"""Drawings: the ending of a file says what, a picture (SVG, PNG) or an animation (HTML)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from exactpt.errors import InputError
from exactpt.render.film import Film, film_of
from exactpt.render.frame import frame_of
from exactpt.render.page import page_of
from exactpt.render.png import png_of
from exactpt.render.still import still
from exactpt.render.svg import svg_of
from exactpt.scene.format import write_atomically

if TYPE_CHECKING:
    from pathlib import Path

    from exactpt.kernel.numbers import QQ
    from exactpt.scene.scene import Scene

__all__ = ["ENDINGS", "draw", "write_animation"]

ENDINGS: Final = (".svg", ".png", ".html")


def draw(
    scene: Scene,
    path: Path,
    *,
    at: QQ | None = None,
    at_contact: bool = False,
    tiling: str = "auto",
    theme: str = "auto",
    max_events: int | None = None,
    max_seconds: float | None = None,
) -> None:
    """Draw a scene into a file, whose ending says what: a picture or an animation.

    Args:
        scene: what moves.
        path: the file; it is complete or not there.
        at: when (by default at the start); an animation is shown at that time first.
        at_contact: the same, at the first contact.
        tiling: which tiling to draw.
        theme: "light", "dark" or "auto" (as the reader prefers; PNG: light).
        max_events: see `Simulation`.
        max_seconds: see `Simulation`.

    Raises:
        InputError: if the ending is none of `ENDINGS`, or there is nothing to draw then.
        BudgetExceeded: if the bounds are reached.
    """
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        raise InputError(f"{path}: a drawing ends in one of {', '.join(ENDINGS)}")
    if ending == ".html":
        film = film_of(scene, tiling=tiling, max_events=max_events, max_seconds=max_seconds)
        write_animation(film, path, title=path.stem, at=at, theme=theme)
        return
    then = scene.start if at is None else at
    picture = frame_of(
        still(
            scene,
            None if at_contact else then,
            tiling=tiling,
            max_events=max_events,
            max_seconds=max_seconds,
        )
    )
    if ending == ".svg":
        write_atomically(path, svg_of(picture, theme=theme))
    else:
        write_atomically(path, png_of(svg_of(picture, theme=theme)))


def write_animation(
    film: Film, path: Path, *, title: str, at: QQ | None = None, theme: str = "auto"
) -> None:
    """Write the animation of a film: one HTML file that needs nothing else."""
    write_atomically(path, page_of(film, title=title, at=at, theme=theme))
