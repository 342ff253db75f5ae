"""What commands print: printable lines, on streams whose faults change no exit code."""

from __future__ import annotations

import contextlib
import io
import os
import sys
from collections.abc import Iterator

import click

from exactpt.errors import printable


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
