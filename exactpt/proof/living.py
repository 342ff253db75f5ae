"""The proofs of a simulation: one for each part of it between two changes of plans.

A checker takes a body for rigid if it is so from the start of a proof to its end. The end of a
part is not known when it begins; so a part ends at the latest where a body that has been rigid
begins to deform.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from pathlib import Path
from tempfile import TemporaryFile
from typing import TYPE_CHECKING, Final, final

from exactpt.errors import InputError
from exactpt.files import write_atomically, writing
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.proof.degrees import refuse_degrees
from exactpt.proof.emit import ProofRun, scene_bytes
from exactpt.proof.lines import Lines, header
from exactpt.proof.nodes import Nodes, rigid_until
from exactpt.proof.watch import Step, Watch

if TYPE_CHECKING:
    from exactpt.kernel.numbers import QQ
    from exactpt.motion.incidence import Touch
    from exactpt.scene.scene import Scene
    from exactpt.tiling.tiling import Tiling

__all__ = ["ProofFolder"]

CHAIN: Final = "exactpt-chain 1"
"""The first line of ``run.chain``."""


@final
class ProofFolder:
    """A `Recorder` that writes ``1.proof``, ``2.proof``, ... and ``1.scene.json``, ... to a folder.

    ``run.chain`` has a line for each part as soon as it is written (docs/proofs.md).

    Args:
        folder: the folder; it is made if it does not exist.

    Raises:
        InputError: if it cannot be made, or contains proofs.
    """

    def __init__(self, folder: str | Path) -> None:
        self._folder = Path(folder)
        try:
            self._folder.mkdir(exist_ok=True)
            is_used = any(self._folder.glob("*.proof")) or (self._folder / "run.chain").exists()
        except (OSError, ValueError) as error:
            reason = error.strerror if isinstance(error, OSError) else error
            raise InputError(f"{folder}: cannot be written: {reason}") from None
        if is_used:
            raise InputError(f"{folder}: contains proofs")
        self._written = 0
        self._before = CHAIN
        self._part: _Part | None = None

    def touching(self, scene: Scene) -> None:
        """See `Recorder.touching`."""
        file = scene_bytes(scene)
        self._write(file, ProofRun(scene, scene_file=file).lines())

    def begin(self, scene: Scene, kinetic: Tiling) -> None:
        """See `Recorder.begin`."""
        if self._part is None and kinetic.now.compare_rational(scene._end) < 0:
            refuse_degrees(scene.bodies)
            self._part = _Part(scene.going_on(scene.bodies, kinetic.now._low), kinetic)

    def advanced(self) -> None:
        """See `Recorder.advanced`."""
        part = self._part
        if part is not None:
            part.advanced()
            if part.watch.now.compare_rational(part.end) >= 0:
                self.change(part.end)

    def change(self, t: QQ) -> None:
        """See `Recorder.change`."""
        part, self._part = self._part, None
        if part is not None and t > part.scene._start:
            part.none(t)
            self._keep(part, t)

    def met(self, touches: Sequence[Touch]) -> None:
        """See `Recorder.met`."""
        part, self._part = self._part, None
        if part is not None:
            part.contact(touches)
            self._keep(part, part.end)

    def finish(self) -> None:
        """See `Recorder.finish`."""
        if self._part is not None:
            self.change(self._part.before_now())

    def _keep(self, part: _Part, end: QQ) -> None:
        """Write the files of a part that is over."""
        file = scene_bytes(part.scene)
        self._write(file, chain(header(file, part.scene._start, end), part.lines()))

    def _write(self, scene: bytes, lines: Iterable[str]) -> None:
        self._written += 1
        path = self._folder / f"{self._written}.proof"
        write_atomically(path.with_suffix(".scene.json"), scene)
        digest, span = hashlib.sha256(), ""
        with writing(path) as write:
            for line in lines:
                write(f"{line}\n")
                digest.update(f"{line}\n".encode())
                span = span or line.removeprefix("span ") if line.startswith("span ") else span
        self._note(f"{hashlib.sha256(scene).hexdigest()} {digest.hexdigest()} {span}")

    def _note(self, part: str) -> None:
        """Add the line of a part to ``run.chain``, with the hash of the line before."""
        before = hashlib.sha256(self._before.encode()).hexdigest()
        line = f"{self._written} {part} {before}"
        try:
            with (self._folder / "run.chain").open("a", encoding="utf-8", newline="") as file:
                file.write(f"{line}\n" if self._written > 1 else f"{CHAIN}\n{line}\n")
        except OSError as error:
            raise InputError(f"{self._folder}: cannot be written: {error.strerror}") from None
        self._before = line


@final
class _Part:
    """A part of a run: a proof whose lines are in a temporary file until its end is known.

    The last event is held back, since there is no line for one at the end.

    Attributes:
        scene: the scene from the start of this part on.
        end: the time at which the part ends at the latest.
        watch: the tiling.
    """

    def __init__(self, scene: Scene, kinetic: Tiling) -> None:
        self.scene = scene
        self.end = rigid_until(scene)
        nodes = Nodes(scene.until(self.end))
        self.watch = Watch(kinetic, nodes)
        self._lines = Lines(nodes)
        self._file = TemporaryFile("w+", encoding="utf-8")  # noqa: SIM115 - closed with the part
        self._held: Step | None = None
        self._last = AlgebraicNumber(scene._start)
        self._put(self._lines.faces(self.watch.first()))

    def advanced(self) -> None:
        """Note the changes of an event, or that there was none up to now."""
        if self._held is None or self._held.time.compare(self.watch.now) < 0:
            self._release()
            self._held = self.watch.step()

    def none(self, end: QQ) -> None:
        """Put the last lines, if there is no contact up to a time."""
        if self._held is not None and self._held.time.compare_rational(end) < 0:
            self._release()
        self._put(self._lines.none(end))

    def contact(self, touches: Sequence[Touch]) -> None:
        """Put the last lines, if there is a contact now."""
        self._release()
        self._put(self._lines.contact(self.watch.now, self.watch.names(), touches))

    def before_now(self) -> QQ:
        """Now, if it is rational; else a time between the last two events."""
        now = self.watch.now.simplified()
        return now._low if now.is_rational else rational_between(self._last, now)

    def lines(self) -> Iterator[str]:
        """The lines, which can be read once."""
        with self._file as file:
            file.seek(0)
            for line in file:
                yield line.rstrip("\n")

    def _release(self) -> None:
        """Put the lines of the event that is held back."""
        if self._held is not None:
            self._last = self._held.time
            self._put(self._lines.event(self._held))
            self._held = None

    def _put(self, lines: Iterable[str]) -> None:
        self._file.writelines(f"{line}\n" for line in lines)
