"""The journal of a batch: the finished chunks, and the places of their results."""

from __future__ import annotations

import json
import os
import secrets
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from hashlib import blake2b
from pathlib import Path
from typing import BinaryIO, Final

from exactpt.batch.chunks import DIGEST, Answered, Record, Tally, digest_of, record_of, tally
from exactpt.batch.options import Options
from exactpt.errors import InputError
from exactpt.files import create, is_at, lock, open_regular
from exactpt.kernel.stored import Stored

VERSION: Final = 2
BATCH: Final = "exactpt batch"
"""The key of the version in the first line of a journal."""
RESULTS: Final = "exactpt results of"
"""The key of the batch in the first line of the file of its results."""
SEAL: Final = "seal"
"""The key of the digest of all other values of a line of a journal."""
LONGEST: Final = 1 << 20
"""Maximum number of bytes of a line of a journal, and of what is read at a time."""
BEGINNING: Final = b'{"line": '
"""The first bytes of every result."""


class Journal:
    """Results in the order in which they come, and a line about each chunk of them.

    They are in two files beside the results' own, with ``.part`` and ``.journal`` after its name.
    A line is written when its results are on the disk, so whatever ends the process, the last
    whole line is its end; the rest is cut off when the journal is opened again.

    Both files are created with a first line that has the same random name of the batch. A file
    without it is not of this batch, and is not opened for writing. A line has the digest of its
    results, and one of itself: files that were changed meanwhile are refused as they are.

    Args:
        target: the file of results.
        options: the query.
        length: the length of the input, which a batch that goes on must find again.

    Attributes:
        records: the finished chunks, by their starts.

    Raises:
        InputError: if the files are not those of a batch with this query, were changed, cannot be
            written, or another process writes them.
    """

    def __init__(self, target: Path, options: Options, length: int) -> None:
        self._target = target
        self._part_path, self._journal_path = _beside(target, "part"), _beside(target, "journal")
        self._about = {"question": options.to_json(), "length": length}
        self._length = length
        self.records: dict[int, Record] = {}
        with ExitStack() as opened:
            if os.path.lexists(self._journal_path):
                self._go_on(opened)
            else:
                self._begin(opened)
            self._close = opened.pop_all().close

    def add(self, answered: Answered) -> None:
        """Keep the results for a chunk."""
        record = record_of(answered, self._part.tell())
        try:
            self._part.write(answered.text)
            self._part.flush()
            os.fsync(self._part.fileno())
            self._journal.write(_sealed(record))
            self._journal.flush()
        except OSError as error:
            reason = f"cannot be written: {error.strerror}"
            raise InputError(f"{self._target}: {reason}") from None
        self.records[record.start] = record

    def pass_on(self, write: Callable[[bytes], None]) -> Tally:
        """Pass all results on, in the order of their scenes; return their counts.

        Raises:
            InputError: if they are not those that were written.
        """
        scenes, failures, first = 0, 0, ""
        for start in sorted(self.records):
            record = self.records[start]
            self._part.seek(record.at)
            results = self._part.read(record.size)
            if digest_of(results) != record.results:
                raise self._changed(record)
            write(results)
            counts = tally(results)
            scenes, failures = scenes + counts.scenes, failures + counts.failures
            first = first or counts.first
        return Tally(scenes, failures, first)

    def remove(self) -> None:
        """Remove the files, unless other files have their names by now."""
        for file, path in ((self._part, self._part_path), (self._journal, self._journal_path)):
            if is_at(file, path):
                path.unlink()

    def close(self) -> None:
        """Leave the files as they are, for another time; without any results, remove them."""
        if not self.records:
            self.remove()
        self._close()

    # The beginning of a batch

    def _begin(self, opened: ExitStack) -> None:
        """Create both files."""
        if os.path.lexists(self._part_path):
            raise InputError(
                f"{self._part_path}: not of this batch, which has no journal: "
                "move it away, or choose another output"
            )
        name = secrets.token_hex(8)
        head = {BATCH: VERSION, **self._about, "name": name}
        self._journal = opened.enter_context(create(self._journal_path, _line(head)))
        self._lock()
        try:
            self._part = opened.enter_context(create(self._part_path, _line({RESULTS: name})))
        except BaseException:
            self._journal_path.unlink()
            raise

    def _lock(self) -> None:
        """Keep other batches off; the journal must still be there, if one has just ended."""
        if not lock(self._journal) or not is_at(self._journal, self._journal_path):
            raise InputError(f"{self._journal_path}: locked by another batch")

    # A batch that goes on

    def _go_on(self, opened: ExitStack) -> None:
        """Open both files, once all of their contents are known to be of this batch."""
        with open_regular(self._journal_path, writable=False) as file:
            name = self._name_in(file)
            self._journal = opened.enter_context(open_regular(self._journal_path, writable=True))
            if not os.path.sameopenfile(file.fileno(), self._journal.fileno()):
                raise InputError(f"{self._journal_path}: replaced by another file meanwhile")
        self._lock()
        own = _line({RESULTS: name})
        end = self._read_records(len(own))
        if not os.path.lexists(self._part_path):
            if self.records:
                raise InputError(f"{self._part_path}: results of the journal are missing")
            self._part = opened.enter_context(create(self._part_path, own))
        else:
            with open_regular(self._part_path, writable=False) as file:
                stop = self._check_results(file, own)
                self._part = opened.enter_context(open_regular(self._part_path, writable=True))
                if not os.path.sameopenfile(file.fileno(), self._part.fileno()):
                    raise InputError(f"{self._part_path}: replaced by another file meanwhile")
            self._part.truncate(stop)
            self._part.seek(stop)
        self._journal.truncate(end)
        self._journal.seek(end)

    def _name_in(self, file: BinaryIO) -> str:
        """Return the name of the batch in the first line of a journal.

        Raises:
            InputError: if it is not the journal of a batch with this query and input.
        """
        path = self._journal_path
        head = _read_object(file.readline(LONGEST))
        if head is None or BATCH not in head:
            raise InputError(
                f"{path}: not the journal of a batch: move it away, or choose another output"
            )
        stored = Stored(head, f"{path}: line 1")
        if head[BATCH] != VERSION:
            raise InputError(
                f"{path}: of a batch of another version, {stored[BATCH].shown}: "
                f"remove it and {self._part_path.name}, or finish it by that version"
            )
        name = stored["name"].text()
        if head != {BATCH: VERSION, **_as_read(self._about), "name": name}:
            raise InputError(
                f"{path}: of another query or input: remove it and "
                f"{self._part_path.name}, or repeat the same query"
            )
        return name

    def _read_records(self, first: int) -> int:
        """Read the journal up to its last whole line, and return where that ends.

        Args:
            first: the place of the first results.

        Raises:
            InputError: if a line is not as it was written.
        """
        self._journal.readline(LONGEST)
        end, at = self._journal.tell(), first
        for number, line in enumerate(_lines(self._journal), 2):
            if not line.endswith(b"\n"):
                break
            where = f"{self._journal_path}: line {number}"
            record = self._record(line, where)
            stored = Stored(record._asdict(), where)
            if record.at != at:
                raise stored["at"].refused(f"{at}, where the results before end")
            if record.start in self.records:
                raise stored["start"].refused("another chunk than those before")
            self.records[record.start] = record
            end, at = end + len(line), at + record.size
        self._check_order()
        return end

    def _record(self, line: bytes, where: str) -> Record:
        """Return the record in a line of a journal."""
        data = _read_object(line)
        if data is None:
            raise InputError(f"{where}: expected an object, got {_shown(line)}")
        stored = Stored(data, where).with_keys(*Record._fields, SEAL)
        record = Record.read(stored, self._length)
        if _sealed(record) != line:
            raise stored[SEAL].refused("the digest of the other values, which were changed")
        return record

    def _check_order(self) -> None:
        """Check that no chunk overlaps another.

        Raises:
            InputError: if one does.
        """
        before = 0
        for start in sorted(self.records):
            if start < before:
                raise InputError(
                    f"{self._journal_path}: the chunk from {start} on begins before the end of "
                    f"another, {before}"
                )
            before = self.records[start].stop

    def _check_results(self, file: BinaryIO, own: bytes) -> int:
        """Check the results that are there, and return where they end.

        Args:
            file: the file of results.
            own: its first line in this batch.

        Raises:
            InputError: if the file is another one, or results are missing or were changed.
        """
        path = self._part_path
        if file.readline(LONGEST) != own:
            raise InputError(
                f"{path}: not of this batch: move it away, or remove {self._journal_path.name} "
                "and choose another output"
            )
        size = os.fstat(file.fileno()).st_size
        for record in sorted(self.records.values(), key=lambda record: record.at):
            if record.at + record.size > size:
                raise InputError(f"{path}: results of the journal are missing")
            if _digest_of_next(file, record) != record.results:
                raise self._changed(record)
        stop = file.tell()
        if not all(map(_is_unfinished, _lines(file))):
            raise InputError(
                f"{path}: byte {stop}: expected the results of this batch, got something else; "
                "restore the file, or remove it with its journal"
            )
        return stop

    def _changed(self, record: Record) -> InputError:
        return InputError(
            f"{self._part_path}: byte {record.at}: changed since the batch wrote it; "
            "restore the file, or remove it with its journal"
        )


def _beside(target: Path, ending: str) -> Path:
    return target.with_name(f"{target.name}.{ending}")


def _line(data: object) -> bytes:
    return json.dumps(data).encode() + b"\n"


def _as_read(data: object) -> dict[str, object]:
    """Return data as JSON gives them back, tuples as lists."""
    read: dict[str, object] = json.loads(json.dumps(data))
    return read


def _sealed(record: Record) -> bytes:
    """Return the line of a record, with the digest of its values."""
    data = record._asdict()
    return _line({**data, SEAL: digest_of(_line(data))})


def _read_object(line: bytes) -> dict[str, object] | None:
    """Return the JSON object in a line; None if there is none."""
    try:
        data = json.loads(line)
    except (ValueError, RecursionError):
        return None
    return data if isinstance(data, dict) else None


def _shown(line: bytes) -> str:
    """Return the beginning of a line, for a message."""
    return ascii(line[:40].decode(errors="replace").rstrip("\n"))


def _lines(file: BinaryIO) -> Iterator[bytes]:
    """Yield the lines of a file, long ones in pieces."""
    while line := file.readline(LONGEST):
        yield line


def _digest_of_next(file: BinaryIO, record: Record) -> str:
    """Return the digest of the results of a chunk, which are next in a file."""
    digest, left = blake2b(digest_size=DIGEST), record.size
    while left and (piece := file.read(min(left, LONGEST))):
        digest.update(piece)
        left -= len(piece)
    return digest.hexdigest()


def _is_unfinished(line: bytes) -> bool:
    """Return True if a line may be of results that were being written when the process ended.

    After a power failure the end of a file may be zeros.
    """
    written = line.rstrip(b"\0")
    return written.startswith(BEGINNING) or BEGINNING.startswith(written)
