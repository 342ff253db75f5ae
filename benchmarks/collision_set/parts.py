"""The files of one family: compressed, with the checksums of their contents."""

from __future__ import annotations

import gzip
import hashlib
import io
import json
import tarfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Final, NamedTuple

from benchmarks.collision_set.answers import answers
from benchmarks.collision_set.lines import ccd_query, question_line, truth_line
from benchmarks.collision_set.passages import make_passage
from exactpt.proof import prove
from exactpt.testing.families import make_question
from exactpt.testing.truth import Truth

VERSION: Final = 1
"""The version of the set; the seed of its scenes."""
CHUNK: Final = 4096
"""Number of passages at a time."""


class Part(NamedTuple):
    """The questions of one family.

    Attributes:
        kind: "point-segment" or "scenes".
        family: the name of the family.
        size: the number of questions.
    """

    kind: str
    family: str
    size: int


class Written(NamedTuple):
    """A file of a part.

    Attributes:
        name: its path in the set without the suffix ``.gz``.
        sha256: the checksum of its content before compression, in hexadecimal digits.
        contacts: the number of questions in the part that have a contact.
    """

    name: str
    sha256: str
    contacts: int


class _Output(io.RawIOBase):
    """A compressed file, which is the same whenever it is written, and its checksum."""

    def __init__(self, path: Path) -> None:
        self._hash = hashlib.sha256()
        self._raw = path.open("xb")
        self._file = gzip.GzipFile("", "wb", 6, self._raw, mtime=0)

    def write(self, content: bytes) -> int:  # type: ignore[override]  # bytes are all it gets
        """Write some bytes."""
        self._hash.update(content)
        return self._file.write(content)

    def write_text(self, text: str) -> None:
        """Write some text."""
        self.write(text.encode())

    @property
    def sha256(self) -> str:
        """The checksum of the lines written."""
        return self._hash.hexdigest()

    def close(self) -> None:
        """End the file."""
        if not self.closed:
            self._file.close()
            self._raw.close()
        super().close()


@contextmanager
def _outputs(folder: Path, part: Part, *endings: str) -> Iterator[dict[str, _Output]]:
    """The files of a part by their names."""
    (folder / part.kind).mkdir(exist_ok=True)
    names = [f"{part.kind}/{part.family}.{ending}" for ending in endings]
    with ExitStack() as stack:
        yield {name: stack.enter_context(_Output(folder / f"{name}.gz")) for name in names}


def write_part(folder: Path, part: Part) -> list[Written]:
    """Write the files of a family into a folder; they are not there yet."""
    if part.kind == "scenes":
        with _outputs(folder, part, "jsonl", "truths.jsonl", "proofs.tar") as files:
            contacts = _write_scenes(part, *files.values())
    else:
        with _outputs(folder, part, "jsonl", "truths.jsonl", "csv") as files:
            contacts = _write_passages(part, *files.values())
    return [Written(name, file.sha256, contacts) for name, file in files.items()]


def _write_passages(part: Part, questions: _Output, truths: _Output, queries: _Output) -> int:
    contacts = 0
    for first in range(0, part.size, CHUNK):
        numbers = range(first, min(first + CHUNK, part.size))
        passages = [make_passage(part.family, number) for number in numbers]
        for k, passage, truth in zip(numbers, passages, answers(passages), strict=True):
            name, touches = f"{part.family}:{k}", truth.time is not None
            questions.write_text(question_line(name, passage))
            truths.write_text(truth_line(name, truth))
            queries.write_text(ccd_query(passage, touches=touches))
            contacts += touches
    return contacts


def _write_scenes(part: Part, questions: _Output, truths: _Output, proofs: _Output) -> int:
    contacts = 0
    with tarfile.open(fileobj=proofs, mode="w|", format=tarfile.USTAR_FORMAT) as archive:
        for number in range(part.size):
            question = make_question(part.family, VERSION, number)
            proof = prove(question.scene)
            questions.write_text(json.dumps(question.to_json()) + "\n")
            found, pairs = Truth(None), []
            if proof.contact is not None:
                contacts += 1
                pairs = [_incidence(pair.to_json()) for pair in proof.contact.pairs]
                found = Truth(proof.contact.time, proof.contact.kind, pairs[0] if pairs else None)
            row = {"id": question.name, **found.to_json()}
            truths.write_text(json.dumps({**row, "pairs": pairs} if pairs else row) + "\n")
            _add(archive, f"{part.family}/{number}.json", proof.scene)
            _add(archive, f"{part.family}/{number}.proof", proof.text)
    return contacts


def _incidence(pair: dict[str, object]) -> dict[str, object]:
    """An incidence without its point and normal, which are rounded."""
    return {key: pair[key] for key in ("kind", "a", "b")}


def _add(archive: tarfile.TarFile, name: str, content: bytes) -> None:
    entry = tarfile.TarInfo(name)  # of no time and of nobody
    entry.size = len(content)
    archive.addfile(entry, io.BytesIO(content))
