"""The whole set: a folder that is complete or not there."""

from __future__ import annotations

import hashlib
import os
import secrets
import shutil
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Final, NamedTuple

from benchmarks.collision_set import passages
from benchmarks.collision_set.about import LICENSE, about
from benchmarks.collision_set.parts import Part, Written, write_part
from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.testing import families

PASSAGES: Final = 1_000_000
"""Number of questions about a point and a segment in the whole set."""
SCENES: Final = 10_000
"""Number of scenes in the whole set."""

_MANIFEST: Final = "SHA256SUMS"


class Summary(NamedTuple):
    """The set that was written.

    Attributes:
        files: the number of files beside the manifest.
        manifest: the SHA-256 of the manifest, which has those of all other files.
    """

    files: int
    manifest: str

    def __repr__(self) -> str:
        return record_in_brief(self)


def planned(questions: int = PASSAGES, scenes: int = SCENES) -> list[Part]:
    """The parts of a set: the questions are dealt to the families as evenly as it goes.

    Args:
        questions: the number of questions about a point and a segment.
        scenes: the number of scenes.
    """
    return [
        *_dealt("point-segment", list(passages.FAMILIES), questions),
        *_dealt("scenes", list(families.FAMILIES), scenes),
    ]


def write_set(
    folder: Path, parts: Sequence[Part], *, jobs: int = 1, done: Callable[[], None] = lambda: None
) -> Summary:
    """Write the Exact 2D collision set, the same for the same parts on every machine.

    Files are compressed, so the checksums are those of their contents: the compressed bytes depend
    on the version of zlib.

    Args:
        folder: where it is written; it is complete or not there.
        parts: see `planned`.
        jobs: the number of processes.
        done: called after each part.

    Raises:
        InputError: if the folder is there and not empty, or cannot be written, or if docstrings,
            which the README of a set quotes, were removed.
    """
    if sys.flags.optimize > 1:
        raise InputError(
            "PYTHONOPTIMIZE=2 removes the descriptions that the README of a set quotes"
        )
    with _written_beside(folder) as place:
        written: list[Written] = []
        for files in _each(place, parts, jobs):
            written += files
            done()
        for name, text in (("README.md", about(parts, written)), ("LICENSE", LICENSE)):
            (place / name).write_text(text, encoding="utf-8")
            written.append(Written(name, _sha256(text), 0))
        manifest = "".join(f"{w.sha256}  {w.name}\n" for w in sorted(written))
        (place / _MANIFEST).write_text(manifest, encoding="utf-8")
    return Summary(len(written), _sha256(manifest))


def _dealt(kind: str, names: Sequence[str], count: int) -> list[Part]:
    share, rest = divmod(count, len(names))
    return [Part(kind, name, share + (k < rest)) for k, name in enumerate(names)]


def _each(place: Path, parts: Sequence[Part], jobs: int) -> Iterator[list[Written]]:
    """The files of each part, in the order of the parts."""
    if jobs == 1:
        yield from map(partial(write_part, place), parts)
    else:
        with get_context("spawn").Pool(jobs) as pool:  # it is terminated at the end
            yield from pool.imap(partial(write_part, place), parts)


@contextmanager
def _written_beside(folder: Path) -> Iterator[Path]:
    """A new folder beside a folder whose place it takes at the end."""
    target = folder.resolve()
    place = target.with_name(f".exactpt-{secrets.token_hex(8)}")
    try:
        if target.exists() and (not target.is_dir() or any(target.iterdir())):
            raise InputError(f"{folder}: it is there; name a new folder")
        place.mkdir()
        yield place
        os.replace(place, target)
    except OSError as error:
        raise InputError(f"{folder}: cannot be written: {error.strerror}") from None
    finally:
        shutil.rmtree(place, ignore_errors=True)


def _sha256(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
