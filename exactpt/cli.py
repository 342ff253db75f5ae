"""The command line: reads what was typed, calls the library, writes what came back."""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from exactpt.errors import AuditError, BudgetExceeded, InputError
from exactpt.kernel.numbers import QQ, parse_rational

if TYPE_CHECKING:
    from exactpt.collision.contact import Contact
    from exactpt.collision.pairs import PairsSearch
    from exactpt.scene.scene import Scene
    from exactpt.simulation.simulation import Simulation

__all__ = ["main"]

OK, FAILED, BAD_INPUT, BROKEN, SPENT, INTERRUPTED = 0, 1, 2, 3, 4, 130


class _Rational(click.ParamType[QQ]):
    """A number of the scene format: 3, 1/3, 0.25, -3e-2."""

    name = "number"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> QQ:
        """The exact rational that was typed."""
        try:
            return parse_rational(str(value))
        except InputError as error:
            self.fail(str(error), param, ctx)


class _Moment(click.ParamType["QQ | Literal['contact']"]):
    """A number of the scene format, or the word "contact"."""

    name = "number|contact"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> QQ | Literal["contact"]:
        """The exact rational that was typed, or "contact"."""
        return "contact" if value == "contact" else RATIONAL.convert(value, param, ctx)


RATIONAL = _Rational()
SCENE = click.argument("scene", type=click.Path(path_type=Path), metavar="SCENE")
TILING = click.option(
    "--tiling",
    default="auto",
    show_default=True,
    type=click.Choice(["auto", "incremental", "greedy", "mixed", "lazy"]),
    help="Which tiling to keep.",
)


def _budget(command: Callable[..., Any]) -> Callable[..., Any]:
    """The bounds that every command which simulates accepts."""
    command = click.option(
        "--max-seconds", type=click.FloatRange(min=0), help="Stop after this time (exit code 4)."
    )(command)
    return click.option(
        "--max-events", type=click.IntRange(min=0), help="Stop after so many events (exit code 4)."
    )(command)


@click.group(context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="exactpt")
def cli() -> None:
    """Exact collision detection of moving and deforming polygons in the plane."""


@cli.command()
@SCENE
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@click.option("--until", type=RATIONAL, help="Look no further than this time.")
@TILING
@click.option(
    "--method",
    default="kinetic",
    show_default=True,
    type=click.Choice(["kinetic", "pairs", "auto"]),
    help="By a tiling, by a search over pairs, or whichever is expected to be faster.",
)
@click.option("--stats", is_flag=True, help="Print counts of events, certificates, decisions.")
@click.option("--exit-code", is_flag=True, help="Return 1 if there is a contact.")
@click.option("--exact-only", is_flag=True, help="Switch the float filters off.")
@_budget
def collide(
    scene: Path,
    as_json: bool,
    until: QQ | None,
    tiling: str,
    method: str,
    stats: bool,
    exit_code: bool,
    exact_only: bool,
    max_events: int | None,
    max_seconds: float | None,
) -> int:
    """Find the first contact of a scene, exactly.

    \b
    Examples:
      exactpt collide scene.json
      exactpt collide scene.json --json --stats
      exactpt collide scene.json --until 7/2 --exit-code && echo "no contact"
    """
    given = _load(scene, until)
    search = _search(
        given, method, tiling, exact_only=exact_only, max_events=max_events, max_seconds=max_seconds
    )
    answer: dict[str, object] = {"contact": None, "until": str(given.end), "tiling": search.name}
    try:
        contact = search.run_to_contact()
    except BudgetExceeded as spent:
        if as_json:
            answer |= {"stats": search.stats, "reached": str(spent.reached)}
            click.echo(json.dumps(answer, indent=1))
        else:
            click.echo(f"no contact up to t = {spent.reached}")
        raise
    if as_json:
        answer |= {"contact": contact and contact.to_json(), "stats": search.stats}
        click.echo(json.dumps(answer, indent=1))
    else:
        click.echo("\n".join(_in_words(given, contact)))
        if stats:
            click.echo("\n".join(_stats_in_words(search.stats)))
    return FAILED if exit_code and contact is not None else OK


@cli.command()
@SCENE
@click.option("--events", type=click.Path(path_type=Path), help="Write an event a line (JSON).")
@click.option("--until", type=RATIONAL, help="Stop at this time.")
@TILING
@_budget
def simulate(
    scene: Path,
    events: Path | None,
    until: QQ | None,
    tiling: str,
    max_events: int | None,
    max_seconds: float | None,
) -> int:
    """Run a scene to the end of its time span or its first contact.

    \b
    Examples:
      exactpt simulate scene.json
      exactpt simulate scene.json --events events.jsonl --until 5
    """
    from exactpt.scene.format import write_atomically
    from exactpt.simulation.simulation import Simulation

    given = _load(scene, until)
    simulation = Simulation(given, tiling=tiling, max_events=max_events, max_seconds=max_seconds)
    lines: list[str] = []
    try:
        for event in simulation.run():
            if events is not None:
                lines.append(json.dumps(event.to_json()))  # noqa: PERF401 - kept if it stops early
    finally:
        if events is not None and not isinstance(sys.exception(), KeyboardInterrupt):
            write_atomically(events, "".join(f"{line}\n" for line in lines))
    click.echo("\n".join(_in_words(given, simulation.contact)))
    click.echo("\n".join(_stats_in_words(simulation.stats)))
    return OK


@cli.command()
@SCENE
@click.option("--at", type=RATIONAL, help="When; by default at the start.")
@click.option("--run", "by_running", is_flag=True, help="Simulate up to then.")
@TILING
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Write to a file.")
@_budget
def tile(
    scene: Path,
    at: QQ | None,
    by_running: bool,
    tiling: str,
    output: Path | None,
    max_events: int | None,
    max_seconds: float | None,
) -> int:
    """Print the tiling of the free space at a rational time, as JSON.

    It is built at that time, or with --run reached by simulating from the start; for the
    canonical tilings the two are equal.

    \b
    Examples:
      exactpt tile scene.json
      exactpt tile scene.json --at 5/2 -o tiling.json
      exactpt tile scene.json --at 5/2 --run
    """
    from exactpt.scene.format import write_atomically
    from exactpt.simulation.tile import tile_at

    given = _load(scene, None)
    snapshot = tile_at(
        given,
        given.start if at is None else at,
        tiling=tiling,
        by_running=by_running,
        max_events=max_events,
        max_seconds=max_seconds,
    )
    text = json.dumps(snapshot.to_json(), indent=1) + "\n"
    if output is None:
        click.echo(text, nl=False)
    else:
        write_atomically(output, text)
    return OK


@cli.command()
@SCENE
@click.option("--json", "as_json", is_flag=True, help="Print the report as JSON.")
@TILING
@_budget
def check(
    scene: Path,
    as_json: bool,
    tiling: str,
    max_events: int | None,
    max_seconds: float | None,
) -> int:
    """Simulate, and have CGAL verify every tiling and every event time.

    \b
    Examples:
      exactpt check scene.json
      exactpt check scene.json --json
    """
    from exactpt.check import check_scene

    given = _load(scene, None)
    report = check_scene(given, tiling=tiling, max_events=max_events, max_seconds=max_seconds)
    click.echo(json.dumps(report.to_json(), indent=1) if as_json else "\n".join(report.lines()))
    return OK if report.ok else FAILED


@cli.command()
@SCENE
@click.option(
    "-o",
    "--out",
    "--output",
    "output",
    type=click.Path(path_type=Path),
    required=True,
    help="The file: .svg or .png for a picture, .html for an animation.",
)
@click.option(
    "--at",
    type=_Moment(),
    help='When: a number, or "contact"; by default at the start.',
)
@click.option(
    "--theme",
    type=click.Choice(["auto", "light", "dark"]),
    default="auto",
    show_default=True,
    help="Light or dark; auto: as the reader prefers (PNG: light).",
)
@TILING
@_budget
def draw(
    scene: Path,
    output: Path,
    at: QQ | Literal["contact"] | None,
    theme: str,
    tiling: str,
    max_events: int | None,
    max_seconds: float | None,
) -> int:
    """Draw a scene: a picture of it and its tiling at a time, or an animation.

    An animation runs from the start to the first contact or the end, and is one file that
    opens in any browser; with --at it begins there. PNG needs: pip install 'exactpt[draw]'.

    \b
    Examples:
      exactpt draw scene.json -o start.svg
      exactpt draw scene.json --at 5/2 -o then.png --theme dark
      exactpt draw scene.json --at contact -o contact.svg
      exactpt draw scene.json -o film.html
    """
    from exactpt.render.draw import draw as draw_scene

    draw_scene(
        _load(scene, None),
        output,
        at=at,
        tiling=tiling,
        theme=theme,
        max_events=max_events,
        max_seconds=max_seconds,
    )
    return OK


@cli.command()
@click.option(
    "-o",
    "--out",
    "--output",
    "output",
    type=click.Path(path_type=Path),
    default=Path("exactpt-demo.html"),
    show_default=True,
    help="Where the animation goes.",
)
def demo(output: Path) -> int:
    """Run a packaged scene to its first contact and draw an animation of it.

    \b
    Example:
      exactpt demo -o demo.html
    """
    from importlib.resources import files

    from exactpt.render.film import film_of
    from exactpt.render.page import page_of
    from exactpt.scene.format import loads, write_atomically

    given = loads((files("exactpt") / "data" / "demo.json").read_text(encoding="utf-8"))
    film = film_of(given, tiling="auto")
    bodies = ", ".join(body.name for body in given.bodies)
    click.echo(f"{len(given.bodies)} bodies: {bodies}")
    click.echo("\n".join(_in_words(given, film.contact)))
    write_atomically(output, page_of(film, title="exactpt demo"))
    click.echo(f"the animation is in {output}: open it in a browser")
    return OK


def _load(path: Path, until: QQ | None) -> Scene:
    from exactpt.scene.scene import Scene

    scene = Scene.load(path)
    if until is None:
        return scene
    try:
        return scene.until(until)
    except InputError as error:
        raise InputError(f"--until: {error}") from None


def _search(
    scene: Scene,
    method: str,
    tiling: str,
    *,
    exact_only: bool,
    max_events: int | None,
    max_seconds: float | None,
) -> Simulation | PairsSearch:
    """What finds the first contact."""
    from exactpt.collision.detector import prefers_pairs

    if method == "pairs" or (method == "auto" and prefers_pairs(scene)):
        from exactpt.collision.pairs import PairsSearch

        return PairsSearch(scene, exact_only=exact_only, max_seconds=max_seconds)
    from exactpt.collision.tilings import tiling_for_contact
    from exactpt.simulation.simulation import Simulation

    return Simulation(
        scene,
        tiling=tiling_for_contact(scene, tiling),
        exact_only=exact_only,
        max_events=max_events,
        max_seconds=max_seconds,
    )


def _in_words(scene: Scene, contact: Contact | None) -> list[str]:
    from exactpt.render.words import polynomial_in_words

    if contact is None:
        return [f"no contact from t = {scene.start} to t = {scene.end}"]
    time = contact.time
    root = f"root of {polynomial_in_words(time.polynomial)}"
    exactly = str(time.low) if time.is_rational else root
    lines = [f"first contact at t = {float(time)!r} ({exactly}), kind {contact.kind}"]
    for pair in contact.pairs:
        feature = f"vertex {pair.other_vertex}" if pair.edge is None else f"edge {pair.edge}"
        x, y = pair.point
        lines.append(
            f"  vertex {pair.vertex} of {pair.body} on {feature} of {pair.other} at ({x}, {y})"
        )
    lines += [f"  {a} and {b} share a point" for a, b in contact.overlaps]
    return lines


def _stats_in_words(stats: dict[str, object]) -> list[str]:
    return [
        f"  {key}: {', '.join(f'{k} {v}' for k, v in value.items()) or 'none'}"
        if isinstance(value, dict)
        else f"  {key}: {value}"
        for key, value in stats.items()
    ]


def _report_bug(error: AuditError, arguments: Sequence[str]) -> None:
    """Say that an invariant broke, and keep the scene that did it."""
    scene = next((Path(a) for a in arguments if a.endswith(".json") and Path(a).is_file()), None)
    click.echo(f"exactpt: an invariant broke: {error}", err=True)
    if scene is not None:
        with tempfile.NamedTemporaryFile(
            "w", prefix="exactpt-bug-", suffix=".json", delete=False, encoding="utf-8"
        ) as file:
            file.write(scene.read_text(encoding="utf-8"))
        click.echo(f"exactpt: the scene is saved in {file.name}", err=True)
    click.echo(
        "exactpt: this is a bug in exactpt; please report it with the command and the scene",
        err=True,
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit with its code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        code = cli.main(given, prog_name="exactpt", standalone_mode=False)
    except click.ClickException as error:
        error.show()
        code = BAD_INPUT
    except InputError as error:
        click.echo(f"exactpt: {error}", err=True)
        code = BAD_INPUT
    except BudgetExceeded as error:
        click.echo(f"exactpt: {error}", err=True)
        code = SPENT
    except AuditError as error:
        _report_bug(error, given)
        code = BROKEN
    except (KeyboardInterrupt, click.Abort):
        click.echo("exactpt: interrupted", err=True)
        code = INTERRUPTED
    except BrokenPipeError:
        sys.stderr.close()
        code = OK
    sys.exit(code if isinstance(code, int) else OK)
