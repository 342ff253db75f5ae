"""draw and demo: pictures and animations."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from exactpt.brief import counted
from exactpt.cli.options import (
    MOMENT,
    QUIET,
    RATIONAL,
    SCENE,
    TILING,
    budget,
    fan_option,
    keep_input,
    load,
    naming_at,
    output,
    two_names,
    within_budget,
)
from exactpt.cli.progress import estimating, progress
from exactpt.cli.terminal import answer_in_words, print_output
from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ

if TYPE_CHECKING:
    from exactpt.scene.scene import Scene


@click.command()
@SCENE
@output(
    "The file: .svg or .png for a picture, .html for an animation, .gif or .mp4 for a film.",
    required=True,
)
@click.option(
    "--at",
    type=MOMENT,
    help='The time: a number, or "contact"; by default the start.',
)
@click.option(
    "--theme",
    type=click.Choice(["auto", "light", "dark"]),
    default="auto",
    show_default=True,
    help="Light or dark; auto: the preference of the reader (PNG: light).",
)
@click.option(
    "--clearance",
    metavar="NAME,NAME",
    help="Two bodies whose distance over time is plotted beside the animation, with its minimum; "
    "a picture is of the plot alone.",
)
@click.option("--below", type=RATIONAL, help="A distance that is marked in the plot.")
@click.option("--legend", is_flag=True, help="Add a scale bar and the names of bodies (pictures).")
@click.option(
    "--poses",
    type=click.IntRange(0, 1000),
    default=0,
    help="Add the path of each moving body and so many faint poses (pictures).",
)
@click.option("--seconds", type=RATIONAL, help="Length of a film.  [default: 8]")
@click.option("--fps", type=click.IntRange(1, 100), help="Its frames in a second.  [default: 20]")
@QUIET
@TILING
@fan_option("Draw the fan triangulation too, its edges dashed")
@click.option("--no-tiling", is_flag=True, help="Draw the bodies alone.")
@budget
def draw(
    scene: Path,
    output: Path,
    at: QQ | Literal["contact"] | None,
    theme: str,
    clearance: str | None,
    below: QQ | None,
    legend: bool,
    poses: int,
    seconds: QQ | None,
    fps: int | None,
    quiet: bool,
    tiling: str,
    fan: bool,
    no_tiling: bool,
    max_events: int | None,
    max_seconds: float | None,
) -> int:
    """Draw a scene: a picture of it and its tiling at a time, or an animation.

    An animation runs from the start to the first contact or the end, and is one file that
    opens in any browser; with --at it begins there. PNG needs: pip install 'exactpt[draw]';
    GIF and MP4: pip install 'exactpt[film]'.

    \b
    Examples:
      exactpt draw scene.json -o start.svg
      exactpt draw scene.json --at 5/2 -o then.png --theme dark
      exactpt draw scene.json --at contact -o contact.svg
      exactpt draw scene.json -o film.html
      exactpt draw scene.json -o film.gif
      exactpt draw scene.json -o film.html --clearance ball,wheel
      exactpt draw scene.json -o poses.svg --no-tiling --legend --poses 5
      exactpt draw scene.json -o short.gif --seconds 2 --fps 10
      exactpt draw points.json -o fan.svg --fan
    """
    from exactpt.render.draw import draw as draw_scene

    keep_input(scene, output)
    gap = None if clearance is None else two_names(clearance, "--clearance")
    if gap is not None and at is not None and output.suffix.lower() != ".html":
        raise InputError("--at: a plot of the clearance is of all times")
    with within_budget(max_seconds), naming_at():
        given = load(scene)
        if gap is not None:
            _check_clearance(given, gap)
        with (
            progress(given, "drawing", quiet=quiet) as reached,
            estimating("frames", quiet=quiet or output.suffix not in (".gif", ".mp4")) as done,
        ):
            draw_scene(
                given,
                output,
                at=at,
                tiling=None if no_tiling else tiling,
                fan=fan,
                theme=theme,
                gap=gap,
                below=below,
                legend=legend,
                poses=poses,
                seconds=seconds,
                fps=fps,
                done=done,
                max_events=max_events,
                max_seconds=max_seconds,
                reached=reached,
            )
    return 0


@click.command()
@output("Where the animation goes.", default=Path("exactpt-demo.html"))
@click.option("--open", "show", is_flag=True, help="Open the animation in a browser.")
def demo(output: Path, *, show: bool) -> int:
    """Run a packaged scene to its first contact, draw an animation, and have a proof checked.

    \b
    Example:
      exactpt demo -o demo.html
      exactpt demo --open
    """
    from importlib.resources import files

    from exactpt.files import write_atomically
    from exactpt.proof import prove
    from exactpt.render.film import film_of
    from exactpt.render.page import page_of
    from exactpt.scene.format import loads

    given = loads((files("exactpt") / "data" / "demo.json").read_text(encoding="utf-8"))
    film = film_of(given, tiling="auto")
    bodies = ", ".join(body.name for body in given.bodies)
    print_output(
        f"{counted(len(given.bodies), 'body')}: {bodies}",
        *answer_in_words(given, film.contact),
    )
    write_atomically(output, page_of(film, title="exactpt demo"))
    print_output(f"the animation is in {output}: open it in a browser (or: exactpt demo --open)")
    proof = prove(given)
    print_output(f"a proof of {len(proof.text):,} bytes, checked by a program that shares no code:")
    print_output(f"  {proof.check()}")
    if show and click.launch(str(output.resolve())):
        raise InputError(f"no browser to open {output} in")
    return 0


def _check_clearance(scene: Scene, gap: tuple[str, str]) -> None:
    """Refuse names of bodies that have no distance, before anything is drawn."""
    from exactpt.pair.pieces_of_two import two_bodies

    try:
        two_bodies(scene, *gap)
    except InputError as error:
        raise InputError(f"--clearance: {error}") from None
