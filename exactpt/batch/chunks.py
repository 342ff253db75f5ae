"""The results of chunks of lines, each computed by one worker."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable
from functools import partial
from hashlib import blake2b
from typing import Final, NamedTuple

from exactpt.batch.answering import Answer, answer, answers_of
from exactpt.batch.options import Options
from exactpt.kernel.stored import Stored
from exactpt.workers.processes import results_of
from exactpt.workers.work import Step, Work

DIGEST: Final = 16
"""Bytes of a digest."""
LARGEST_FILE: Final = (1 << 63) - 1
"""Maximum number of bytes of a file."""


def digest_of(text: bytes) -> str:
    """Return the digest of some bytes."""
    return blake2b(text, digest_size=DIGEST).hexdigest()


class Chunk(NamedTuple):
    """Some lines of the input, one after the other.

    Attributes:
        line: the number of the first, counted from 1.
        start, stop: their place in the input, in bytes or rows.
        digest: of their content.
        text: the lines, separated by line breaks; cut where a line is too long.
    """

    line: int
    start: int
    stop: int
    digest: str
    text: bytes


class Answered(NamedTuple):
    """The results of a chunk.

    Attributes:
        start, stop, digest: those of the chunk.
        lines: the number of its lines.
        text: a line of JSON for each of these that is not empty.
    """

    start: int
    stop: int
    digest: str
    lines: int
    text: bytes


class Tally(NamedTuple):
    """Counts of results.

    Attributes:
        scenes: the number of results.
        failures: the number of those that are an error.
        first: the line and the error of the first of these; empty if there is none.
    """

    scenes: int
    failures: int
    first: str


_FAILURE: Final = re.compile(rb'^\{"line": \d+, "error": .*$', re.MULTILINE)


def tally(text: bytes) -> Tally:
    """Return the counts of the results in a text of lines."""
    failures = _FAILURE.findall(text)
    first = json.loads(failures[0]) if failures else None
    shown = "" if first is None else f"line {first['line']}: {first['error']}"
    return Tally(text.count(b"\n"), len(failures), shown)


class Record(NamedTuple):
    """A chunk with its results.

    Attributes:
        start, stop, digest, lines: as in `Answered`.
        at, size: the place and the number of bytes of its results.
        results: the digest of these.
    """

    start: int
    stop: int
    digest: str
    lines: int
    at: int
    size: int
    results: str

    @classmethod
    def read(cls, data: Stored, length: int) -> Record:
        """Return the record in a line of a journal.

        Args:
            data: the line, an object with the attributes as keys.
            length: the length of the input.

        Raises:
            InputError: if a batch writes no such value there.
        """
        start = data["start"].integer(0, length)
        stop = data["stop"].integer(start + 1, length)
        return cls(
            start,
            stop,
            data["digest"].text(),
            data["lines"].integer(1, stop - start),
            data["at"].integer(0, LARGEST_FILE),
            data["size"].integer(0, LARGEST_FILE),
            data["results"].text(),
        )


def record_of(answered: Answered, at: int) -> Record:
    """Return the record of results that are kept at a place."""
    *about, text = answered
    return Record._make([*about, at, len(text), digest_of(text)])


def answered(chunk: Chunk, _report: Callable[[Step], None], options: Options) -> Answered:
    """Return the results of a chunk; an empty line has no result."""
    rows = _rows(chunk)
    return _joined(chunk, zip(rows, answers_of([*rows.values()], options), strict=True))


def one_by_one(chunk: Chunk, _step: Step | None, _why: str, options: Options) -> Answered:
    """Return the results of a chunk that ends its workers, each scene by itself in a process."""
    work = Work(partial(_answer, options=options), _no_answer)
    found = dict(results_of(work, iter(_rows(chunk).items()), 1))
    return _joined(chunk, sorted(found.items()))


def _rows(chunk: Chunk) -> dict[int, bytes]:
    """Return the lines that are not empty, by their numbers."""
    rows = enumerate(chunk.text.removesuffix(b"\n").split(b"\n"), chunk.line)
    return {number: row for number, row in rows if row.strip()}


def _answer(
    row: tuple[int, bytes],
    _report: Callable[[Step], None],
    options: Options,
) -> tuple[int, Answer]:
    return row[0], answer(row[1], options)


def _no_answer(row: tuple[int, bytes], _step: Step | None, why: str) -> tuple[int, Answer]:
    return row[0], {"error": f"the scene {why}"}


def _joined(chunk: Chunk, found: Iterable[tuple[int, Answer]]) -> Answered:
    text = "".join(f"{json.dumps({'line': number, **data})}\n" for number, data in found)
    lines = chunk.text.removesuffix(b"\n").count(b"\n") + 1
    return Answered(chunk.start, chunk.stop, chunk.digest, lines, text.encode())
