"""Options that several commands share, and their types."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

import click
from click.core import ParameterSource

from exactpt.errors import InputError, TimeRangeError
from exactpt.files import MAX_BYTES
from exactpt.kernel.numbers import QQ, parse_rational, shorten

if TYPE_CHECKING:
    from exactpt.scene.scene import Scene

    _RationalType = click.ParamType[QQ]
    _MomentType = click.ParamType["QQ | Literal['contact']"]
else:  # before click 8.4 it has no parameter
    _RationalType = _MomentType = click.ParamType


class _Rational(_RationalType):
    """A number of the scene format: 3, 1/3, 0.25, -3e-2."""

    name = "number"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> QQ:
        """Return the exact rational."""
        try:
            return parse_rational(str(value))
        except InputError as error:
            self.fail(str(error), param, ctx)


class _Moment(_MomentType):
    """A number of the scene format, or the word "contact"."""

    name = "number|contact"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> QQ | Literal["contact"]:
        """Return the exact rational, or "contact"."""
        return "contact" if value == "contact" else RATIONAL.convert(value, param, ctx)


class _Seconds(click.FloatRange):
    """A time limit in seconds."""

    name = "seconds"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """Return the number; NaN, which passes the range check, is refused."""
        seconds = float(super().convert(value, param, ctx))  # type: ignore[arg-type]
        if math.isnan(seconds):
            self.fail(f"{shorten(value)} is not a time", param, ctx)
        return seconds


class _Tiling(click.Choice):  # type: ignore[type-arg]  # it has a parameter from click 8.2 on
    """A name in the catalogue of tilings, which is read for other names than "auto"."""

    def __init__(self) -> None:
        self.case_sensitive = True

    @property
    def choices(self) -> tuple[str, ...]:  # type: ignore[override]
        """The names."""
        from exactpt.tiling.catalogue import known

        return tuple(known())

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the name."""
        return value if value == "auto" else super().convert(value, param, ctx)


SCENE_FILE: Final = "exactpt.scene"
"""Key in the context of a command under which its scene file is kept."""

RATIONAL = _Rational()
SECONDS = _Seconds(min=0)
MOMENT = _Moment()
QUIET = click.option("-q", "--quiet", is_flag=True, help="Print nothing but errors.")
SCENE = click.argument("scene", type=click.Path(path_type=Path), metavar="SCENE")
TILING = click.option(
    "--tiling",
    default="auto",
    show_default=True,
    type=_Tiling(),
    help="The tiling to maintain.",
)


def fan_option(words: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return the option that requests the fan triangulation, with its effect on a command."""
    scope = "for points, in the tiling incremental; other scenes and tilings are refused"
    return click.option("--fan", is_flag=True, help=f"{words} ({scope}).")


IGNORE = click.option(
    "--ignore",
    multiple=True,
    metavar="NAME,NAME...",
    help="Bodies whose contacts with each other are ignored (repeatable), beside the groups of the "
    "scene; a name that ends in * means all whose name starts so. For --method pairs or auto. "
    'A name with a comma stands in double quotes: "a,b",c.',
)
AFTER_START = click.option(
    "--after-start",
    is_flag=True,
    help="Find the first new contact: bodies that touch at the start count when they have parted "
    "and touch again, or begin to overlap; for --method pairs or auto.",
)
BETWEEN = click.option(
    "--between",
    multiple=True,
    metavar="NAME,NAME",
    help="Two bodies whose contacts with each other count, and no others (repeatable); for "
    "--method pairs or auto.",
)


def _keep_bound(ctx: click.Context, param: click.Parameter, value: int | None) -> None:
    ctx.meta[f"exactpt.{param.name}"] = value


def bounded(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options that bound the time and memory of a command, and the size of its input.

    Memory and size are kept in the context, for `max_memory` and `max_bytes`.
    """
    command = click.option(
        "--max-bytes",
        type=click.IntRange(min=0),
        help=f"Refuse larger input files; by default {MAX_BYTES}.",
        callback=_keep_bound,
        expose_value=False,
    )(command)
    command = click.option(
        "--max-memory",
        type=click.IntRange(min=1),
        metavar="MEGABYTES",
        help="Stop when the process has more memory than this (exit code 4).",
        callback=_keep_bound,
        expose_value=False,
    )(command)
    return click.option("--max-seconds", type=SECONDS, help="Stop after this time (exit code 4).")(
        command
    )


def max_memory() -> int | None:
    """Return the maximum memory of the current command in bytes, if one is given."""
    megabytes: int | None = click.get_current_context().meta.get("exactpt.max_memory")
    return None if megabytes is None else megabytes * 10**6


def within_budget(seconds: float | None) -> AbstractContextManager[None]:
    """Return a context with a time limit, and the limit of memory of the current command."""
    memory = max_memory()
    if seconds is None and memory is None:
        return nullcontext()
    from exactpt.cli.alarm import time_limit

    return time_limit(seconds, memory)


def max_bytes() -> int | None:
    """Return the maximum size of the input file of the current command, if one is given."""
    bound: int | None = click.get_current_context().meta.get("exactpt.max_bytes")
    return bound


def budget(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options that bound a run to a command."""
    command = bounded(command)
    return click.option(
        "--max-events",
        type=click.IntRange(min=0),
        help="Stop if there are more events than these (exit code 4).",
    )(command)


def output(
    words: str, *, required: bool = False, default: Path | None = None
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return the option that names the file to write."""
    names = ("-o", "--out", "--output", "output")
    kind = click.Path(path_type=Path)
    if default is None:
        return click.option(*names, type=kind, help=words, required=required)
    return click.option(*names, type=kind, help=words, default=default, show_default=True)


def keep_input(source: Path, *outputs: Path | None) -> None:
    """Check that no output is the input, which would be replaced.

    Raises:
        InputError: if one is, by this name or another one.
    """
    for path in outputs:
        try:
            is_input = path is not None and path.samefile(source)
        except (OSError, ValueError):  # one of them does not exist
            continue
        if is_input:
            raise InputError(f"{path}: is the input: choose another name for the output")


def typed(*names: str) -> list[str]:
    """Return those of these parameters that were given on the command line, as written."""
    context = click.get_current_context()
    source = context.get_parameter_source
    written = {param.name: max(param.opts, key=len) for param in context.command.params}
    given = [name for name in names if source(name) is ParameterSource.COMMANDLINE]
    return [written[name] for name in given]


def load(path: Path, until: QQ | None = None, since: QQ | None = None) -> Scene:
    """Return the scene of a file; ``until`` and ``since`` shorten its time span."""
    from exactpt.scene.scene import Scene

    click.get_current_context().meta[SCENE_FILE] = path
    scene = Scene.load(path, max_bytes=max_bytes())
    option = "--until"
    try:
        if until is not None:
            scene = scene.until(until)
        option = "--since"
        return scene if since is None else scene.since(since)
    except InputError as error:
        raise InputError(f"{option}: {error}") from None


@contextmanager
def naming_at() -> Iterator[None]:
    """Name the option --at in errors about the time that it gives."""
    try:
        yield
    except TimeRangeError as error:
        raise InputError(f"--at: {error}") from None


def names_in(text: str, option: str) -> list[str]:
    """Return the names in a text, separated by commas and perhaps quoted, as in CSV."""
    try:
        (names,) = csv.reader([text], strict=True)
    except (csv.Error, ValueError):
        raise InputError(f"{option}: quotes that do not match: {shorten(text)}") from None
    return names


def two_names(text: str, option: str) -> tuple[str, str]:
    """Return the names of two bodies in a text."""
    names = names_in(text, option)
    if len(names) != 2:
        raise InputError(f"{option}: not the names of two bodies: {shorten(text)}")
    return names[0], names[1]
