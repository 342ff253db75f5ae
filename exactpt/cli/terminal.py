"""What commands print: results in words, on streams whose faults change no exit code; its end."""

from __future__ import annotations

import contextlib
import io
import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

import click

from exactpt.brief import cut
from exactpt.errors import printable
from exactpt.kernel.numbers import shorten

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.pair.contact import Contact
    from exactpt.scene.scene import Scene
    from exactpt.search.enclosed import EnclosedContact
    from exactpt.search.intervals import ContactInterval
    from exactpt.simulation.event import RunEvent


def print_output(*lines: str) -> None:
    """Print lines of a result on standard output, unprintable characters escaped."""
    click.echo("\n".join(map(printable, lines)))


def print_error(*lines: str) -> None:
    """Print lines on standard error, unprintable characters escaped.

    If they cannot be written, they are lost; the exit code is the same.
    """
    try:
        click.echo("\n".join(map(printable, lines)), err=True)
    except (OSError, ValueError):  # a full disk, a closed stream
        with contextlib.suppress(OSError, ValueError):
            _discard(sys.stderr.fileno())


def is_terminal() -> bool:
    """Return True if standard error is shown on a terminal."""
    try:
        return sys.stderr is not None and sys.stderr.isatty()
    except ValueError:  # closed
        return False


@contextlib.contextmanager
def endings() -> Iterator[None]:
    """Make SIGTERM and SIGHUP raise `SystemExit`, so that temporary files are removed.

    Only in the main thread, and only for signals that have their default handler.
    """
    names = [name for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
    taken = [
        number
        for number in map(signal.Signals.__getitem__, names)
        if threading.current_thread() is threading.main_thread()
        and signal.getsignal(number) is signal.SIG_DFL
    ]

    def end(signum: int, frame: FrameType | None) -> NoReturn:  # noqa: ARG001
        raise SystemExit(128 + signum)

    for number in taken:
        signal.signal(number, end)
    try:
        yield
    finally:
        for number in taken:
            signal.signal(number, signal.SIG_DFL)


@contextlib.contextmanager
def encodable() -> Iterator[None]:
    """Within the context, characters that standard output cannot encode are escaped."""
    stream = sys.stdout
    if not isinstance(stream, io.TextIOWrapper):
        yield
        return
    errors = stream.errors
    stream.reconfigure(errors="backslashreplace")
    try:
        yield
    finally:
        if not stream.closed:
            with contextlib.suppress(OSError):
                stream.reconfigure(errors=errors)


def drop_standard_output() -> None:
    """Discard further output, after a broken pipe."""
    _discard(sys.stdout.fileno())


def drop_unwritten_output() -> None:
    """Discard buffered standard output that cannot be written, as on a full disk."""
    try:
        if sys.stdout is not None:
            sys.stdout.flush()
    except OSError:
        drop_standard_output()


def _discard(stream: int) -> None:
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, stream)
    os.close(nowhere)


# Results in words


def answer_in_words(scene: Scene, contact: Contact | None, new: str = "") -> list[str]:
    """Return the first contact in words: time, kind, and all incidences with their points.

    ``new`` is "new " for a contact after the start.
    """
    if contact is None:
        return [f"no {new}contact from t = {scene.exact_start} to t = {scene.exact_end}"]
    lines = [f"first {new}contact at t = {_when(contact.time)}, kind {contact.kind}"]
    for pair in contact.pairs:
        feature = f"vertex {pair.other_vertex}" if pair.edge is None else f"edge {pair.edge}"
        x, y = pair.point
        lines.append(
            f"  vertex {pair.vertex} of {name_in_words(pair.body)} on {feature} "
            f"of {name_in_words(pair.other)} at ({x}, {y})"
        )
    lines += [
        f"  {name_in_words(a)} and {name_in_words(b)} share a point"
        for a, b in contact.initial_pairs
    ]
    return lines


def intervals_in_words(scene: Scene, intervals: Sequence[ContactInterval]) -> list[str]:
    """Return the intervals in which bodies touch, one line each."""
    if not intervals:
        return answer_in_words(scene, None)
    return [
        f"{name_in_words(i.a)} and {name_in_words(i.b)} meet "
        + (f"at t = {begin}" if i.start == i.end else f"from t = {begin} to t = {_when(i.end)}")
        for i in intervals
        for begin in [_when(i.start)]
    ]


def bounds_in_words(scene: Scene, found: EnclosedContact | None) -> list[str]:
    """Return bounds of the time of the first contact, and the pairs that may touch first."""
    if found is None:
        return answer_in_words(scene, None)
    pairs = [f"  {name_in_words(a)} and {name_in_words(b)} may meet first" for a, b in found.pairs]
    if found.high is None:
        return [f"perhaps a contact, not before t = {_when(found.low)}", *pairs]
    low, high = _when(found.low), _when(found.high)
    return [f"first contact not before t = {low}", f"  and not after t = {high}", *pairs]


def _when(time: AlgebraicNumber) -> str:
    """Return the nearest double, and the exact number."""
    if time.is_rational:
        return f"{float(time)!r} ({time.exact_low})"
    from exactpt.render.words import polynomial_in_words

    return f"{float(time)!r} (root of {polynomial_in_words(time.exact_polynomial)})"


def name_in_words(name: str) -> str:
    """Return a name, cut if it is long; quoted and escaped if a character is unprintable."""
    return cut(name) if name.isprintable() else shorten(name)


def event_in_words(event: RunEvent) -> str:
    """Return an event in words: time, kind, removed and added edges of the tiling."""
    changes = [f"-{u}~{v}" for u, v in event.removed] + [f"+{u}~{v}" for u, v in event.added]
    words = [f"t = {float(event.time)!r}", event.kind, *map(name_in_words, changes)]
    return " ".join(words)


def stats_in_words(stats: dict[str, object]) -> list[str]:
    """Return one line per count."""
    return [
        f"  {key}: {', '.join(f'{k} {v}' for k, v in value.items()) or 'none'}"
        if isinstance(value, dict)
        else f"  {key}: {value}"
        for key, value in stats.items()
    ]
