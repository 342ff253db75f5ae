"""Parquet files of scenes and of answers, by pyarrow: the only module that imports it."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from hashlib import blake2b
from pathlib import Path
from typing import TYPE_CHECKING, Any, final

from exactpt.batch.chunks import Chunk, Record
from exactpt.batch.lines import DIGEST, changed
from exactpt.errors import InputError

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

__all__ = ["Rows", "table"]

COLUMN = "scene"
AT_A_TIME = 1024
"""Number of rows that are read at a time."""


def _pyarrow() -> Any:  # noqa: ANN401
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise InputError("Parquet needs: pip install 'exactpt[parquet]'") from None
    return pyarrow


@final
class Rows:
    """A Parquet file with a column "scene" of texts; a row counts as a line.

    Attributes:
        length: the number of rows.
        size: the number of bytes of the texts and their encoding, about.

    Raises:
        InputError: if it is none.
    """

    def __init__(self, path: Path) -> None:
        arrow = _pyarrow()
        self._path = path
        try:
            self._file = arrow.parquet.ParquetFile(path)
        except (OSError, arrow.ArrowException) as error:
            raise InputError(f"{path}: cannot be read: {_first_line(error)}") from None
        schema = self._file.schema_arrow
        found = schema.field(COLUMN).type if COLUMN in schema.names else None
        if found not in {arrow.string(), arrow.large_string(), arrow.string_view()}:
            raise InputError(f'{path}: a column "{COLUMN}" of texts is needed')
        about = self._file.metadata
        self.length: int = about.num_rows
        groups = (about.row_group(i) for i in range(about.num_row_groups))
        self.size: int = sum(group.total_byte_size for group in groups)

    def chunks(self, done: Mapping[int, Record], most: int) -> Iterator[Chunk]:
        """See `Source`."""
        rows: list[bytes] = []
        start = size = 0
        for at, row in enumerate(self._rows()):
            known = done.get(start)
            full = at in done or size >= most if known is None else at == known.stop
            if rows and full:
                yield from self._chunk(start, rows, known)
                start, rows, size = at, [], 0
            rows.append(row)
            size += len(row)
        if rows:
            yield from self._chunk(start, rows, done.get(start))

    def _chunk(self, start: int, rows: list[bytes], known: Record | None) -> Iterator[Chunk]:
        text = b"\n".join(rows)
        digest = blake2b(text, digest_size=DIGEST).hexdigest()
        if known is None:
            yield Chunk(start + 1, start, start + len(rows), digest, text)
        elif digest != known.digest:
            raise changed(self._path)

    def _rows(self) -> Iterator[bytes]:
        """The texts, each on one line; a missing one is null."""
        for batch in self._file.iter_batches(AT_A_TIME, columns=[COLUMN]):
            for text in batch.column(0).to_pylist():
                row = (text or "").replace("\n", " ").encode()
                yield row if row.strip() else b"null"


class _Sink(io.RawIOBase):
    """A file for pyarrow that is written by a function."""

    def __init__(self, write: Callable[[bytes], None]) -> None:
        self._write, self._at = write, 0

    def writable(self) -> bool:
        return True

    def tell(self) -> int:
        return self._at

    def write(self, content: ReadableBuffer, /) -> int:
        data = bytes(content)
        self._write(data)
        self._at += len(data)
        return len(data)


@contextmanager
def table(write: Callable[[bytes], None]) -> Iterator[Callable[[bytes], None]]:
    """Give a function that takes lines of answers and writes them as rows of a Parquet file.

    Its columns: "line"; "time", the nearest double, null where the answer is no time; "error",
    null where there is none; "answer", the line of JSON.
    """
    arrow = _pyarrow()
    columns = {"line": arrow.int64(), "time": arrow.float64()}
    schema = arrow.schema({**columns, "error": arrow.string(), "answer": arrow.string()})
    with arrow.parquet.ParquetWriter(_Sink(write), schema) as writer:

        def add(text: bytes) -> None:
            rows = []
            for answer in text.decode().splitlines():
                data = json.loads(answer)
                found = data.get("contact") or data.get("approach")
                row = {"line": data["line"], "error": data.get("error"), "answer": answer}
                rows.append({**row, "time": found["time"]["approx"] if found else None})
            writer.write_table(arrow.Table.from_pylist(rows, schema))

        yield add


def _first_line(error: Exception) -> str:
    return str(error).partition("\n")[0]
