"""The oracle: questions as lines of JSON in, truths as lines of JSON out, in the same order."""

from __future__ import annotations

import json
import os
import select
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import BinaryIO, Final

from exactpt.errors import InputError
from exactpt.kernel.budget import check_budget
from exactpt.testing.questions import Asked, Name, id_of, objects, read_question
from exactpt.testing.space.exact import SpaceContact, contact_of
from exactpt.testing.space.queries import SpaceQuery
from exactpt.testing.truth import Truth, truths

MOST: Final = 4096
"""Most questions that are answered at once."""
LONGEST: Final = 1 << 24
"""Most bytes of a line, unless another limit is given."""
PIECE: Final = 1 << 16


@dataclass(slots=True)
class Refusals:
    """How many questions were refused, and the reason of the first."""

    count: int = 0
    first: str = ""


def chunks_of_lines(stream: BinaryIO, longest: int | None = None) -> Iterator[list[bytes]]:
    """Yield all complete lines read so far; never block while any are buffered.

    Args:
        stream: the stream, which has a file descriptor.
        longest: the maximum number of bytes of a line; by default `LONGEST`.

    Raises:
        InputError: if a line is longer; the lines before it come first.
    """
    most = LONGEST if longest is None else longest
    rest = b""
    while piece := _next_piece(stream):
        lines = (rest + piece).split(b"\n")
        while len(lines) <= MOST and _has_more(stream) and (piece := _next_piece(stream)):
            more = (lines.pop() + piece).split(b"\n")
            lines += more
            if len(lines[-1]) > most:
                break
        rest = lines.pop()
        long = next((k for k, line in enumerate(lines) if len(line) > most), None)
        if lines[:long]:
            yield lines[:long]
        if long is not None or len(rest) > most:
            raise InputError(f"a line of more than {most} bytes: allow more by --max-bytes")
    if rest:
        yield [rest]


def _next_piece(stream: BinaryIO) -> bytes:
    """Return the next bytes, and wait for them; empty at the end."""
    return os.read(stream.fileno(), PIECE)


def _has_more(stream: BinaryIO) -> bool:
    """Return True if more has come; false on Windows, where `select` takes only sockets."""
    return sys.platform != "win32" and bool(select.select([stream], [], [], 0)[0])


def answers(lines: Sequence[bytes], first: int, refusals: Refusals) -> Iterator[str]:
    """Yield the answers to lines of questions, each a line of JSON; empty lines have none.

    Args:
        lines: the questions.
        first: the number of the first line, from 1; it is the id of a question without one.
        refusals: where the refused ones are counted. Their answer is ``{"id", "error"}``; without
            an id that can be read it is ``{"id": null, "line", "error"}``.
    """
    names: list[tuple[Name, int]] = []  # ids, and numbers of lines
    found: list[Truth | SpaceContact | InputError] = []
    asked: list[Asked] = []
    places: list[int] = []
    for number, line in enumerate(lines, first):
        check_budget()
        if not line.strip():
            continue
        try:
            name, question = _read(line)
            if isinstance(question, SpaceQuery):
                found.append(contact_of(question) or Truth(None))
            else:
                places.append(len(found))
                asked.append(question)
                found.append(Truth(None))
        except InputError as error:
            name = _id_of(line)
            found.append(error)
        names.append((name, number))
    for place, answer in zip(places, _each(asked), strict=True):
        found[place] = answer
    for (name, number), result in zip(names, found, strict=True):
        if not isinstance(result, InputError):
            yield json.dumps({"id": number if name is None else name, **result.to_json()})
        else:
            refusals.count += 1
            where = f"line {number}" if name is None else f"question {name}"
            refusals.first = refusals.first or f"{where}: {result}"
            line_of = {"line": number} if name is None else {}
            yield json.dumps({"id": name, **line_of, "error": str(result)})


def _id_of(line: bytes) -> Name:
    """Return the id of a refused line, None if it has none that can be read."""
    try:
        return id_of(objects(line))
    except InputError:
        return None


def _read(line: bytes) -> tuple[Name, Asked | SpaceQuery]:
    """Return the id and the question of a line; one with a "kind" is a query in space."""
    if b'"kind"' in line:
        data = objects(line)
        if "kind" in data:
            query = SpaceQuery.from_json(data)
            return query.name, query
    return read_question(line)


def _each(asked: Sequence[Asked]) -> list[Truth | InputError]:
    """Return the answer of each question, or the reason why there is none, by halves."""
    try:
        return [*truths(asked)]
    except InputError as error:
        if len(asked) == 1:
            return [error]
    middle = len(asked) // 2
    return _each(asked[:middle]) + _each(asked[middle:])
