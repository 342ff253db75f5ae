"""Films as GIF or MP4: frames of a film at equal distances in time, drawn by Pillow."""

from __future__ import annotations

from contextlib import closing
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Final

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.files import write_atomically, writing
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, Rational, nearest_float, rational
from exactpt.render.canvas import Canvas, Line, Shape, Tile, marks_of
from exactpt.render.fixed import near
from exactpt.render.palette import body_colour
from exactpt.render.window import Window, widened, window_of
from exactpt.render.words import contact_in_words, time_in_words

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from PIL.Image import Image

    from exactpt.render.film import Film

SECONDS: Final = 8
"""Length of a film, unless another is given."""
RATE: Final = 20
"""Frames in a second, unless another number is given."""
MOST: Final = 100_000
"""Most frames of a film."""
REST: Final = 1.0
"""Seconds for which the last frame stays."""
COLOURS: Final = 256
"""Colours of a GIF."""
SAMPLES: Final = 4
"""Number of frames, beside the last one, whose colours it has."""
_LINES: Final = {"diagonal": "diagonal", "hull": "hull", "rim": "hull", "fan": "fan"}
"""The kind of line by the kind of `EdgeSpan`."""
_WHOLE: Final = 16
"""Number of equal parts of the time span at whose ends everything is in view."""


def write_movie(
    film: Film,
    path: Path,
    *,
    theme: str = "light",
    seconds: Rational | None = None,
    fps: int | None = None,
    done: Callable[[int, int], None] | None = None,
) -> None:
    """Write a film as ``.gif`` or ``.mp4``, of the same length whatever its time span.

    Args:
        film: the run.
        path: the file; it is complete or not there.
        theme: "light" or "dark".
        seconds: the length of the film (`SECONDS`), before its last frame stays for a second.
        fps: frames in a second (`RATE`); GIF players show at most 50.
        done: called with the number of frames that are drawn, and of all.

    Raises:
        InputError: if Pillow or imageio-ffmpeg is not installed; the message has the command to
            install them. Without frames, or if there are more than 100,000.
    """
    rate = rational(RATE if fps is None else fps)
    count = round(rational(SECONDS if seconds is None else seconds) * rate)
    if not (0 < count < MOST and rate >= 1 and rate.denominator == 1):
        raise InputError(
            f"{path}: a film has from 1 to {MOST} frames, a whole number of them in a second"
        )
    try:
        from exactpt.render.raster import image_of

        images = (image_of(frame, theme) for frame in frames_of(film, count))
        counted = _counted(images, count + 1, done)
        if path.suffix.lower() == ".gif":
            some = [image_of(frame, theme) for frame in frames_of(film, SAMPLES)]
            _write_gif(counted, some, path, int(rate))
        else:
            _write_mp4(counted, path, int(rate))
    except ImportError as error:
        raise InputError(
            f"a GIF needs Pillow, an MP4 imageio-ffmpeg too; there is no module {error.name}: "
            "pip install 'exactpt[film]' (SVG and HTML need nothing)"
        ) from None


def _counted(
    images: Iterable[Image], count: int, done: Callable[[int, int], None] | None
) -> Iterator[Image]:
    for k, image in enumerate(images, 1):
        yield image
        if done is not None:
            done(k, count)


def _write_mp4(images: Iterator[Image], path: Path, fps: int) -> None:
    from imageio_ffmpeg import write_frames

    image = next(images)
    with TemporaryDirectory() as folder:
        made = Path(folder) / "film.mp4"
        with closing(write_frames(made, image.size, fps=fps, macro_block_size=2)) as film:
            film.send(None)
            film.send(image.tobytes())
            for image in images:
                film.send(image.tobytes())
            for _ in range(round(REST * fps) - 1):
                film.send(image.tobytes())
        write_atomically(path, made.read_bytes())


def _write_gif(images: Iterable[Image], some: Sequence[Image], path: Path, fps: int) -> None:
    """Write the images with the colours of some of them: all have the same bodies and tints.

    Pillow takes 30 ms to choose colours for an image, and 1 ms to map it to known ones. Of each
    image the file has the rectangle that differs from the one before, and memory has two images.
    """
    from PIL import Image, ImageChops
    from PIL.GifImagePlugin import getdata, getheader

    width, height = some[0].size
    together = Image.new("RGB", (width, height * len(some)))
    for k, image in enumerate(some):
        together.paste(image, (0, k * height))
    colours = together.quantize(COLOURS)
    flat = (image.quantize(palette=colours, dither=Image.Dither.NONE) for image in images)
    before = next(flat)
    with writing(path) as write:
        for part in getheader(before.copy(), info={"loop": 0, "optimize": False})[0]:
            write(part)
        box = (0, 0, width, height)
        for k, now in enumerate(chain(flat, [None])):
            # A GIF counts hundredths of a second.
            rest = REST * 1000 if now is None else 10 * _hundredths(k, fps)
            for part in getdata(before.crop(box), box[:2], duration=rest, disposal=1):
                write(part)
            if now is not None:
                box = ImageChops.difference(now, before).getbbox() or (0, 0, 1, 1)
                before = now
        write(b";")


def _hundredths(k: int, fps: int) -> int:
    """Return how long frame k stays, so that the times of all frames are rounded together."""
    return round(100 / fps * (k + 1)) - round(100 / fps * k)


def frames_of(film: Film, count: int) -> Iterator[Canvas]:
    """Frames at ``count`` + 1 times, the first at the start and the last at the end."""
    start = film.scene.exact_start
    end = near(film.end.simplified(), film.scene.exact_end - start)
    window = _window(film, [start + (end - start) * k / _WHOLE for k in range(_WHOLE + 1)])
    step = 0
    for k in range(count + 1):
        check_budget()
        t = start + (end - start) * k / count
        last = k == count
        while step < len(film.steps) and (last or film.steps[step].time.compare_rational(t) <= 0):
            step += 1
        yield _frame(film, step, t, window, is_end=last)


def _window(film: Film, times: list[QQ]) -> Window:
    return window_of(
        [
            point
            for t in times
            for i, body in enumerate(film.scene.bodies)
            if film.is_there(i, t)
            for point in widened(body.exact_at(t), body.exact_radius)
        ]
    )


def _frame(film: Film, step: int, t: QQ, window: Window, *, is_end: bool) -> Canvas:
    bodies = film.scene.bodies
    pixels = [tuple(window.pixel(x, y) for x, y in body.exact_at(t)) for body in bodies]
    nodes = [pixel for body in pixels for pixel in body]
    place = {body.name: pixels[i] for i, body in enumerate(bodies)}
    contact = film.contact if is_end else None
    return Canvas(
        window,
        time_in_words(film.end if contact is not None else t),
        "" if contact is None else contact_in_words(contact),
        counted(sum(film.is_there(i, t) for i in range(len(bodies))), "body"),
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
                nearest_float(body.exact_radius * window.scale),
            )
            for i, body in enumerate(bodies)
            if film.is_there(i, t)
        ),
        tuple(
            Line(nodes[edge.u], nodes[edge.v], _LINES[edge.kind])
            for edge in film.edges
            if _holds(edge.first, edge.last, step)
        ),
        () if contact is None else marks_of(film.scene, contact, place, window),
    )


def _holds(first: int, last: int | None, step: int) -> bool:
    return first <= step and (last is None or step < last)
