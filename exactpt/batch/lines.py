"""Files of scenes, one on each line, cut into chunks."""

from __future__ import annotations

import os
import stat
import sys
from bisect import bisect_right
from collections.abc import Iterator, Mapping
from hashlib import blake2b
from pathlib import Path
from typing import BinaryIO, Final, Protocol

from exactpt.batch.chunks import DIGEST, Chunk, Record
from exactpt.errors import InputError

LARGEST: Final = 1 << 18
"""Most bytes of a chunk, unless it is one line."""
SMALLEST: Final = 1 << 12
PARTS: Final = 16
"""Least number of chunks for each worker, if they are not smaller than `SMALLEST` then."""


class Source(Protocol):
    """An input.

    Attributes:
        length: its length, in the unit of the places of chunks.
        size: its number of bytes, about.
    """

    length: int
    size: int

    def chunks(self, done: Mapping[int, Record], most: int) -> Iterator[Chunk]:
        """Return the chunks of about ``most`` bytes between the finished ones, which are by start.

        Raises:
            InputError: if the finished part differs from before.
        """


def size_of(total: int, workers: int) -> int:
    """Return the size of chunks of an input of that many bytes."""
    return min(LARGEST, max(SMALLEST, total // (PARTS * workers)))


class Lines:
    """A file of scenes, one on each line.

    Attributes:
        length: its size in bytes.
        size: the same.

    Args:
        path: the file.
        longest: most bytes of a line; of a longer one the rest is left out.

    Raises:
        InputError: if the file does not exist.
    """

    def __init__(self, path: Path, longest: int) -> None:
        self._path, self._longest = path, longest
        with self._open() as file:
            kind = os.fstat(file.fileno())
        if not stat.S_ISREG(kind.st_mode):
            raise InputError(f"{path}: not a file that can be read again")
        self.length = self.size = kind.st_size

    def chunks(self, done: Mapping[int, Record], most: int) -> Iterator[Chunk]:
        """See `Source`."""
        starts, line, start = sorted(done), 1, 0
        with self._open() as file:
            while True:
                known = done.get(start)
                if known is not None:
                    if _read_next(file, known.stop - start) != (known.digest, known.lines):
                        raise changed(self._path)
                    start, line = known.stop, line + known.lines
                    continue
                k = bisect_right(starts, start)
                room = starts[k] - start if k < len(starts) else sys.maxsize
                text, digest = self._next(file, min(most, room))
                if not text:
                    return
                if file.tell() - start > room:  # a finished chunk would begin within a line
                    raise changed(self._path)
                chunk = Chunk(line, start, file.tell(), digest, text)
                yield chunk
                line += text.removesuffix(b"\n").count(b"\n") + 1
                start = chunk.stop

    def _next(self, file: BinaryIO, most: int) -> tuple[bytes, str]:
        """Whole lines of about ``most`` bytes, and their digest; the last is cut if too long."""
        text = file.read(most)
        digest = blake2b(text, digest_size=DIGEST)
        last = len(text) - (text.rfind(b"\n") + 1)
        while text and not text.endswith(b"\n") and (piece := file.readline(LARGEST)):
            digest.update(piece)
            if last <= self._longest:
                text += piece
                last += len(piece)
            elif piece.endswith(b"\n"):
                break
        return text, digest.hexdigest()

    def _open(self) -> BinaryIO:
        try:
            return self._path.open("rb")
        except (OSError, ValueError) as error:
            reason = error.strerror if isinstance(error, OSError) else error
            raise InputError(f"{self._path}: cannot be read: {reason}") from None


def changed(path: Path) -> InputError:
    """Return the error that an input has changed."""
    return InputError(f"{path}: it has changed since the batch began")


def _read_next(file: BinaryIO, count: int) -> tuple[str, int]:
    """Return the digest and the number of lines of the next bytes."""
    digest, lines, last = blake2b(digest_size=DIGEST), 0, b"\n"
    while count and (piece := file.read(min(count, 1 << 20))):
        digest.update(piece)
        count -= len(piece)
        lines += piece.count(b"\n")
        last = piece[-1:]
    return digest.hexdigest(), lines + (last != b"\n")
