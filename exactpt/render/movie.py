"""Films as GIF or MP4: frames of a film at equal distances in time, written by imageio."""

from __future__ import annotations

import io
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Final

from exactpt.errors import InputError
from exactpt.files import write_atomically
from exactpt.kernel.numbers import QQ, nearest_float
from exactpt.render.fixed import near
from exactpt.render.frame import Frame, Line, Shape, Tile, marks_of
from exactpt.render.palette import body_colour
from exactpt.render.png import png_of
from exactpt.render.svg import svg_of
from exactpt.render.window import Window, window_of
from exactpt.render.words import contact_in_words, time_in_words

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import ModuleType

    from exactpt.render.film import Film

__all__ = ["frames_of", "write_movie"]

SECONDS: Final = 8
RATE: Final = 20
"""Frames in a second."""
REST: Final = 20
"""Number of times that the last frame is written."""
_WHOLE: Final = 16
"""Number of equal parts of the time span at whose ends everything is in view."""


def write_movie(film: Film, path: Path, *, theme: str = "light") -> None:
    """Write a film as ``.gif`` or ``.mp4``: eight seconds, whatever its time span.

    Raises:
        InputError: if imageio, its ffmpeg or resvg is not installed; the message says how to
            install them.
    """
    imageio = _imageio(path)
    options: dict[str, object] = {"fps": RATE, "macro_block_size": 2}
    if path.suffix.lower() == ".gif":
        options = {"duration": 1000 / RATE, "loop": 0}
    with TemporaryDirectory() as folder:
        made = Path(folder) / f"film{path.suffix.lower()}"
        with imageio.get_writer(made, **options) as writer:
            repeats = [1] * (SECONDS * RATE) + [REST]
            for frame, count in zip(frames_of(film, SECONDS * RATE), repeats, strict=True):
                image = imageio.imread(io.BytesIO(png_of(svg_of(frame, theme=theme), zoom=1)))
                height, width = (size // 2 * 2 for size in image.shape[:2])  # as encoders want it
                for _ in range(count):
                    writer.append_data(image[:height, :width, :3])
        write_atomically(path, made.read_bytes())


def _imageio(path: Path) -> ModuleType:
    try:
        import imageio.v2 as imageio

        if path.suffix.lower() == ".mp4":
            import imageio_ffmpeg  # noqa: F401
    except ImportError as error:
        raise InputError(
            f"GIF and MP4 need the library {error.name}, which is not installed: "
            "pip install 'exactpt[film]' (SVG and HTML need nothing)"
        ) from None
    module: ModuleType = imageio
    return module


def frames_of(film: Film, count: int) -> Iterator[Frame]:
    """Frames at ``count`` + 1 times, the first at the start and the last at the end."""
    start = film.scene._start
    end = near(film.end.simplified(), film.scene._end - start)
    window = _window(film, [start + (end - start) * k / _WHOLE for k in range(_WHOLE + 1)])
    step = 0
    for k in range(count + 1):
        t = start + (end - start) * k / count
        last = k == count
        while step < len(film.steps) and (last or film.steps[step].time.compare_rational(t) <= 0):
            step += 1
        yield _frame(film, step, t, window, is_end=last)


def _window(film: Film, times: list[QQ]) -> Window:
    return window_of(
        [
            (x + side * body._radius, y + side * body._radius)
            for t in times
            for i, body in enumerate(film.scene.bodies)
            if film.is_there(i, t)
            for x, y in body._at(t)
            for side in ((1, -1) if body._radius else (0,))
        ]
    )


def _frame(film: Film, step: int, t: QQ, window: Window, *, is_end: bool) -> Frame:
    bodies = film.scene.bodies
    pixels = [tuple(window.pixel(x, y) for x, y in body._at(t)) for body in bodies]
    nodes = [pixel for body in pixels for pixel in body]
    place = {body.name: pixels[i] for i, body in enumerate(bodies)}
    contact = film.contact if is_end else None
    return Frame(
        window,
        time_in_words(film.end if contact is not None else t),
        "" if contact is None else contact_in_words(contact, limit=1),
        f"{sum(film.is_there(i, t) for i in range(len(bodies)))} bodies",
        tuple(
            Tile(
                tuple(nodes[v] for v in tile.nodes),
                tile.tint,
                None if tile.place.body < 0 else body_colour(tile.place.body),
                tile.place.level,
            )
            for tile in film.tiles
            if not tile.inside and _holds(tile.first, tile.last, step)
        ),
        tuple(
            Shape(
                body.name,
                body_colour(i),
                pixels[i],
                body.closed,
                None,
                body.rings,
                nearest_float(body._radius * window.scale),
            )
            for i, body in enumerate(bodies)
            if film.is_there(i, t)
        ),
        tuple(
            Line(nodes[edge.u], nodes[edge.v], "diagonal" if edge.kind == "diagonal" else "hull")
            for edge in film.edges
            if _holds(edge.first, edge.last, step)
        ),
        () if contact is None else marks_of(film.scene, contact, place, window),
    )


def _holds(first: int, last: int | None, step: int) -> bool:
    return first <= step and (last is None or step < last)
