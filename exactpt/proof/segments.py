"""The proofs of a simulation: one for each part of it between two changes of motions.

A checker takes a body for rigid if it is so from the start of a proof to its end. The end of a
part is not known when it begins; so a part ends at the latest where a body that has been rigid
begins to deform.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from itertools import chain
from pathlib import Path
from tempfile import TemporaryFile
from typing import TYPE_CHECKING, Final, final

from exactpt.errors import InputError
from exactpt.files import create, open_regular, writing
from exactpt.proof.degrees import refuse_degrees
from exactpt.proof.emit import Part, ProofRun
from exactpt.proof.lines import Lines, header
from exactpt.proof.nodes import Nodes, rigid_until
from exactpt.scene.written import scene_bytes
from exactpt.tiling.driver import CHANGES, Observer

if TYPE_CHECKING:
    from exactpt.indices import HalfEdge
    from exactpt.kernel.numbers import QQ
    from exactpt.motion.track import Incidence
    from exactpt.scene.scene import Scene
    from exactpt.tiling.tiling import Tiling

CHAIN: Final = "exactpt-chain 1"
"""The first line of ``run.chain``."""
KINDS: Final = ("*.proof", "*.scene.json", "run.chain")
"""The names of the files of such a folder."""


@contextmanager
def _naming(folder: Path) -> Iterator[None]:
    """Name the folder in errors of the file system."""
    try:
        yield
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise InputError(f"{folder}: cannot be written: {reason}") from None


@final
class ProofFolder(Observer):
    """An observer that writes ``1.proof``, ``2.proof``, ... and ``1.scene.json``, ... to a folder.

    ``run.chain`` has a line for each part as soon as it is written (docs/proofs.md).

    Args:
        folder: the folder; it is made with the first proof if it does not exist.

    Raises:
        InputError: if it cannot be made, or contains proofs.
    """

    listens_to: int = CHANGES

    def __init__(self, folder: str | Path) -> None:
        self._folder = Path(folder)
        with _naming(self._folder):
            is_new = not self._folder.exists()
            self._folder.mkdir(exist_ok=True)
            is_used = any(any(self._folder.glob(kind)) for kind in KINDS)
            if is_new:
                self._folder.rmdir()  # it can be made; a scene that is refused leaves none behind
        if is_used:
            raise InputError(f"{folder}: contains proofs")
        self._written = 0
        self._before = CHAIN
        self._part: Part | None = None

    def on_initial_contact(self, scene: Scene) -> None:
        """See `Observer.on_initial_contact`."""
        file = scene_bytes(scene)
        self._write(file, ProofRun(scene, scene_file=file).lines())

    def on_advance(self, scene: Scene, tiling: Tiling) -> None:
        """See `Observer.on_advance`."""
        if self._part is None and tiling.now.compare_rational(scene.exact_end) < 0:
            refuse_degrees(scene.bodies)
            self._begin(scene.going_on(scene.bodies, tiling.now.exact_low), tiling)

    def on_changed_edges(self, changed: set[HalfEdge] | None) -> None:
        """See `Observer.on_changed_edges`."""
        if self._part is not None:
            self._part.on_changed_edges(changed)
            if self._part.watch.now.compare_rational(self._end) >= 0:
                self.on_change(self._end)

    def on_change(self, t: QQ) -> None:
        """See `Observer.on_change`."""
        part, self._part = self._part, None
        if part is None:
            return
        if t > self._scene.exact_start:
            part.none(t)
            self._keep(t)
        else:
            self._file.close()

    def on_contact(self, tiling: Tiling, touches: Sequence[Incidence]) -> None:
        """See `Observer.on_contact`."""
        part, self._part = self._part, None
        if part is not None:
            part.on_contact(tiling, touches)
            self._keep(self._end)

    def finish(self) -> None:
        """See `Observer.finish`."""
        if self._part is not None:
            self.on_change(self._part.before_now())

    def _begin(self, scene: Scene, kinetic: Tiling) -> None:
        """Begin a part, whose lines are in a temporary file until its end is known."""
        self._scene, self._end = scene, rigid_until(scene)
        nodes = Nodes(scene.until(self._end))
        file = self._file = TemporaryFile("w+", encoding="utf-8")  # noqa: SIM115 - see `_keep`

        def put(lines: Iterable[str]) -> None:
            file.writelines(f"{line}\n" for line in lines)

        self._part = Part(kinetic, nodes, Lines(nodes), put)

    def _keep(self, end: QQ) -> None:
        """Write the files of a part that is over."""
        scene = scene_bytes(self._scene)
        with self._file as file:
            file.seek(0)
            lines = (line.rstrip("\n") for line in file)
            self._write(scene, chain(header(scene, self._scene.exact_start, end), lines))

    def _write(self, scene: bytes, lines: Iterable[str]) -> None:
        self._written += 1
        with _naming(self._folder):
            self._folder.mkdir(exist_ok=True)
        path = self._folder / f"{self._written}.proof"
        with writing(path.with_suffix(".scene.json"), new=True) as write:
            write(scene)
        digest, span = hashlib.sha256(), ""
        with writing(path, new=True) as write:
            for line in lines:
                write(f"{line}\n")
                digest.update(f"{line}\n".encode())
                span = span or line.removeprefix("span ") if line.startswith("span ") else span
        self._note(f"{hashlib.sha256(scene).hexdigest()} {digest.hexdigest()} {span}")

    def _note(self, part: str) -> None:
        """Add the line of a part to ``run.chain``, with the hash of the line before."""
        before = hashlib.sha256(self._before.encode()).hexdigest()
        line = f"{self._written} {part} {before}"
        path = self._folder / "run.chain"
        if self._written == 1:
            create(path, f"{CHAIN}\n{line}\n".encode()).close()
        else:
            with _naming(self._folder), open_regular(path, writable=True) as file:
                file.seek(0, os.SEEK_END)
                file.write(f"{line}\n".encode())
        self._before = line
