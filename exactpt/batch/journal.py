"""The journal of a batch: the finished chunks, and the places of their results."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import BinaryIO

from exactpt.batch.chunks import Answered, Record, record_of
from exactpt.batch.options import Options
from exactpt.errors import InputError
from exactpt.files import lock

VERSION = 1


class Journal:
    """Results in the order in which they come, and a line about each chunk of them.

    They are in two files beside the results' own, with ``.part`` and ``.journal`` after its name.
    A line is written when its results are on the disk, so whatever ends the process, the last
    whole line is its end; the rest is cut off when the journal is opened again.

    Args:
        target: the file of results.
        options: the query.
        length: the length of the input, which a batch that goes on must find again.

    Attributes:
        records: the finished chunks, by their starts.

    Raises:
        InputError: if the files are not those of a batch with this query, cannot be written,
            or another process writes them.
    """

    def __init__(self, target: Path, options: Options, length: int) -> None:
        self._target = target
        self._paths = _beside(target, "part"), _beside(target, "journal")
        self.records: dict[int, Record] = {}
        with ExitStack() as opened:
            self._part, self._journal = (opened.enter_context(_open(path)) for path in self._paths)
            if not lock(self._journal):
                raise InputError(f"{self._paths[1]}: locked by another batch")
            about = {"exactpt batch": VERSION, "question": options.to_json(), "length": length}
            self._read(json.dumps(about))
            self._close = opened.pop_all().close

    def add(self, answered: Answered) -> None:
        """Keep the results for a chunk."""
        record = record_of(answered, self._part.tell())
        try:
            self._part.write(answered.text)
            self._part.flush()
            os.fsync(self._part.fileno())
            self._append(json.dumps(record))
        except OSError as error:
            raise _refused(self._target, error) from None
        self.records[record.start] = record

    def pass_on(self, write: Callable[[bytes], None]) -> None:
        """Pass all results on, in the order of their scenes."""
        for start in sorted(self.records):
            record = self.records[start]
            self._part.seek(record.at)
            write(self._part.read(record.size))

    def remove(self) -> None:
        """Remove the files."""
        for path in self._paths:
            path.unlink(missing_ok=True)

    def close(self) -> None:
        """Leave the files as they are, for another time; without any results, remove them."""
        if not self.records:
            self.remove()
        self._close()

    def _append(self, line: str) -> None:
        self._journal.write(line.encode() + b"\n")
        self._journal.flush()

    def _read(self, head: str) -> None:
        """Read the journal up to its last whole line, and cut off the rest."""
        known, *lines = self._journal.read().split(b"\n")[:-1] or [b""]
        if known not in {b"", head.encode()}:
            raise InputError(
                f"{self._paths[1]}: of another query or input: remove it and "
                f"{self._paths[0].name}, or repeat the same query"
            )
        size = 0
        try:
            for line in lines:
                record = Record(*json.loads(line))
                self.records[record.start] = record
                size = record.at + record.size
        except (TypeError, ValueError):
            raise InputError(f"{self._paths[1]}: not the journal of a batch") from None
        if self._part.seek(0, os.SEEK_END) < size:
            raise InputError(f"{self._paths[0]}: answers of the journal are missing")
        self._part.truncate(size)
        self._part.seek(size)
        self._journal.truncate(sum(len(line) + 1 for line in (known, *lines)) if known else 0)
        self._journal.seek(0, os.SEEK_END)
        if not known:
            self._append(head)


def _beside(target: Path, ending: str) -> Path:
    return target.with_name(f"{target.name}.{ending}")


def _open(path: Path) -> BinaryIO:
    try:
        return open(os.open(path, os.O_RDWR | os.O_CREAT, 0o666), "r+b")
    except OSError as error:
        raise _refused(path, error) from None


def _refused(path: Path, error: OSError) -> InputError:
    return InputError(f"{path}: cannot be written: {error.strerror}")
