"""Drawings: a picture (SVG, PNG), an animation (HTML) or a film (GIF, MP4), by the suffix."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, Literal

from exactpt.errors import InputError, TimeRangeError
from exactpt.files import write_atomically
from exactpt.kernel.budget import Budget
from exactpt.kernel.numbers import show
from exactpt.render.canvas import frame_of
from exactpt.render.film import film_of
from exactpt.render.marked import film_of_run
from exactpt.render.movie import write_movie
from exactpt.render.page import page_of
from exactpt.render.plot import plot_of, svg_of_plot
from exactpt.render.png import png_of
from exactpt.render.still import has_fan, still, still_of
from exactpt.render.svg import svg_of
from exactpt.search.surroundings import clearance

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.kernel.numbers import QQ, Rational
    from exactpt.render.film import Film
    from exactpt.scene.scene import Scene
    from exactpt.simulation.simulation import Simulation

ENDINGS: Final = (".svg", ".png", ".html", ".gif", ".mp4")
MOVIES: Final = (".gif", ".mp4")


def draw(
    scene: Scene,
    path: Path,
    *,
    at: QQ | Literal["contact"] | None = None,
    tiling: str | None = "auto",
    fan: bool = False,
    theme: str = "auto",
    gap: tuple[str, str] | None = None,
    below: QQ | None = None,
    legend: bool = False,
    poses: int = 0,
    seconds: Rational | None = None,
    fps: int | None = None,
    max_events: int | None = None,
    max_seconds: float | None = None,
    reached: Callable[[AlgebraicNumber], None] | None = None,
    done: Callable[[int, int], None] | None = None,
) -> None:
    """Draw a scene into a file, as a picture, an animation or a film by the suffix of the file.

    The arguments are those of `Scene.draw`; ``max_events`` and ``max_seconds`` are those of
    `Simulation`, ``reached`` is called with the times that the run of an animation reaches, and
    ``done`` with the number of frames of a film that are drawn, and of all.

    Raises:
        InputError: if the suffix is not in `ENDINGS`, or no contact or body to draw exists.
        TimeRangeError: if there is nothing to draw at that time.
        BudgetExceeded: if ``max_events`` or ``max_seconds`` is exceeded.
    """
    ending = _ending(path)
    if (legend or poses) and (gap is not None or ending not in (".svg", ".png")):
        raise InputError(f"{path}: a legend and poses are for a picture of bodies")
    _check_film(path, seconds, fps)
    if poses < 0:
        raise InputError(f"poses: not a number of them: {poses}")
    if below is not None and gap is None:
        raise InputError(f"below: {show(below)} is for a plot of the clearance, and none is asked")
    if below is not None and below < 0:
        raise InputError(f"below: a distance is not negative: {show(below)}")
    if ending in MOVIES and (at is not None or gap is not None):
        raise InputError(f"{path}: a film has all times, and no plot")
    if fan and (tiling is None or (gap is not None and ending != ".html")):
        raise InputError(f"{path}: a fan triangulation is for a picture with a tiling")
    if ending == ".html" or ending in MOVIES:
        with Budget(None, max_seconds).held():  # frames take longer than most runs
            film = film_of(
                scene,
                tiling=tiling,
                fan=fan,
                max_events=max_events,
                max_seconds=max_seconds,
                reached=reached,
            )
            if ending in MOVIES:
                write_movie(film, path, theme=_paper(theme), seconds=seconds, fps=fps, done=done)
                return
            first = _shown_first(film, at)
            distance = None if gap is None else clearance(_shown(film), *gap)
            page = page_of(film, title=path.stem, at=first, theme=theme, gap=distance, below=below)
            write_atomically(path, page)
        return
    light = _paper(theme) if ending == ".png" else theme
    if gap is not None:
        _write_picture(path, svg_of_plot(plot_of(clearance(scene, *gap), below), theme=light))
        return
    then = None if at == "contact" else scene.exact_start if at is None else at
    picture = still(
        scene, then, tiling=tiling, fan=fan, max_events=max_events, max_seconds=max_seconds
    )
    frame = frame_of(picture, legend=legend, poses=poses)
    _write_picture(path, svg_of(frame, theme=light))


def draw_run(
    simulation: Simulation,
    path: Path,
    *,
    theme: str = "auto",
    seconds: Rational | None = None,
    fps: int | None = None,
) -> None:
    """Draw a simulation into a file, see `Simulation.draw`."""
    ending = _ending(path)
    _check_film(path, seconds, fps)
    fan = has_fan(simulation)
    if ending == ".html":
        page = page_of(film_of_run(simulation.history(), fan=fan), title=path.stem, theme=theme)
        write_atomically(path, page)
    elif ending in MOVIES:
        film = film_of_run(simulation.history(), fan=fan)
        write_movie(film, path, theme=_paper(theme), seconds=seconds, fps=fps)
    else:
        light = _paper(theme) if ending == ".png" else theme
        _write_picture(path, svg_of(frame_of(still_of(simulation)), theme=light))


def _ending(path: Path) -> str:
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        raise InputError(f"{path}: a drawing ends in one of {', '.join(ENDINGS)}")
    return ending


def _check_film(path: Path, seconds: Rational | None, fps: int | None) -> None:
    if path.suffix.lower() not in MOVIES and (seconds, fps) != (None, None):
        raise InputError(f"{path}: seconds and fps are for a film, {' or '.join(MOVIES)}")


def _paper(theme: str) -> str:
    """Return the theme of a picture that cannot follow the reader's preference."""
    return "light" if theme == "auto" else theme


def _write_picture(path: Path, svg: str) -> None:
    write_atomically(path, png_of(svg) if path.suffix.lower() == ".png" else svg)


def _shown(film: Film) -> Scene:
    """Return the scene up to the end of its animation; all of it if that ends at the start."""
    last = film.end.simplified().exact_canonical_interval()[1]
    return film.scene.until(last) if last > film.scene.exact_start else film.scene


def _shown_first(film: Film, at: QQ | Literal["contact"] | None) -> AlgebraicNumber | QQ | None:
    if at == "contact":
        if film.contact is None:
            raise InputError(
                f"no contact to draw from t = {show(film.scene.exact_start)} "
                f"to t = {show(film.scene.exact_end)}"
            )
        return film.end
    if at is not None and (at < film.scene.exact_start or film.end.compare_rational(at) < 0):
        raise TimeRangeError(
            f"nothing to show at t = {show(at)}: the animation runs from "
            f"t = {show(film.scene.exact_start)} to t = {float(film.end)!r}"
        )
    return at
