"""Parquet files of scenes and of results, by pyarrow: the only module that imports it."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Container, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, final

from exactpt.batch.chunks import Chunk, Record, digest_of
from exactpt.batch.lines import changed
from exactpt.errors import InputError

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

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

    def others(self) -> tuple[Any, Iterator[list[Any]]]:
        """Return the schema of all other columns, and batches of them; two may have one name."""
        fields = list(self._file.schema_arrow)
        kept = [k for k, field in enumerate(fields) if field.name != COLUMN]
        batches = self._file.iter_batches(AT_A_TIME) if kept else iter(())
        columns = ([batch.column(k) for k in kept] for batch in batches)
        return _pyarrow().schema([fields[k] for k in kept]), columns

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
        digest = digest_of(text)
        if known is None:
            yield Chunk(start + 1, start, start + len(rows), digest, text)
        elif digest != known.digest:
            raise changed(self._path)

    def _rows(self) -> Iterator[bytes]:
        """Yield the texts, each on one line; a missing one is null."""
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


_SIDES = [(f"{what}_{side}", what) for side in "ab" for what in ("body", "vertex", "edge")]


@contextmanager
def table(
    write: Callable[[bytes], None], rows: Rows | None = None
) -> Iterator[Callable[[bytes], None]]:
    """Yield a function that takes lines of results and writes them as rows of a Parquet file.

    Its columns are those of docs/format.md, and all columns of the input but the scenes.

    Args:
        write: takes the bytes of the file.
        rows: the input, if it is Parquet. It has a result for each row, in the same order.
    """
    arrow = _pyarrow()
    time, text = arrow.float64(), arrow.string()
    types = {"body": text, "vertex": arrow.int32(), "edge": arrow.int32()}
    interval = arrow.struct({"body_a": text, "body_b": text, "start": time, "end": time})
    columns = {"line": arrow.int64(), "time": time, "kind": text}
    columns |= {name: types[what] for name, what in _SIDES}
    columns |= {"x": time, "y": time, "intervals": arrow.list_(interval)}
    columns |= {"error": text, "answer": text}
    mine = arrow.schema(columns)
    own, batches = (arrow.schema([]), iter(())) if rows is None else rows.others()
    left = arrow.Table.from_batches([], own)
    whole = arrow.schema([*mine, *(f.with_name(_free(f.name, columns, own.names)) for f in own)])
    with arrow.parquet.ParquetWriter(_Sink(write), whole) as writer:

        def add(answers: bytes) -> None:
            nonlocal left
            found = arrow.Table.from_pylist(
                [_row(line) for line in answers.decode().splitlines()], mine
            )
            if len(own):
                while len(left) < len(found):
                    more = arrow.Table.from_arrays(next(batches), schema=own)
                    left = arrow.concat_tables([left, more])
                theirs, left = left.slice(0, len(found)), left.slice(len(found))
                found = arrow.Table.from_arrays([*found.columns, *theirs.columns], schema=whole)
            writer.write_table(found)

        yield add


def _free(name: str, taken: Container[str], others: Container[str]) -> str:
    """Return a name for a column of the input that is not the name of a column of this module."""
    if name in taken:
        while name in taken or name in others:
            name = f"input_{name}"
    return name


def _row(answer: str) -> dict[str, object]:
    """Return the columns of a result that are not null."""
    data = json.loads(answer)
    row = {"line": data["line"], "error": data.get("error"), "answer": answer}
    if "intervals" in data:
        row["intervals"] = [
            {
                "body_a": i["a"],
                "body_b": i["b"],
                "start": i["from"]["approx"],
                "end": i["to"]["approx"],
            }
            for i in data["intervals"]
        ]
    found = data.get("contact") or data.get("approach")
    if not found:
        return row
    row |= {"time": found["time"]["approx"], "kind": found.get("kind")}
    first = next(iter(found["pairs"] or found.get("overlaps", ())), None)
    if isinstance(first, dict):
        row |= {f"{key}_{side}": v for side in "ab" for key, v in first[side].items()}
        row["x"], row["y"] = first["point"] or (None, None)
    elif first is not None:
        row["body_a"], row["body_b"] = first
    return row


def _first_line(error: Exception) -> str:
    return str(error).partition("\n")[0]
