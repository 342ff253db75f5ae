"""Proofs as files, written while a tiling runs; a file is complete or absent."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, final

from exactpt.files import write_atomically, writing
from exactpt.kernel.counters import Counts
from exactpt.proof.emit import Proof, scene_bytes
from exactpt.simulation.report import report

if TYPE_CHECKING:
    from exactpt.collision.contact import Contact
    from exactpt.kernel.numbers import QQ
    from exactpt.scene.scene import Scene

__all__ = ["Proved", "ProvedSearch", "prove", "write_proof"]


class Proved(NamedTuple):
    """An answer with its proof, in memory.

    Attributes:
        contact: the first contact, or None.
        scene: the bytes of the scene's file.
        proof: the bytes of the proof.
    """

    contact: Contact | None
    scene: bytes
    proof: bytes


def prove(
    scene: Scene, *, tiling: str = "auto", scene_file: bytes | None = None, exact_only: bool = False
) -> Proved:
    """The first contact of a scene by a tiling, with its proof.

    Args:
        scene: the scene.
        tiling: the name of the tiling.
        scene_file: the bytes of the scene's file; by default those that `Scene.save` writes.
        exact_only: whether the float filters are switched off.
    """
    file = scene_bytes(scene) if scene_file is None else scene_file
    proof = Proof(scene, tiling=tiling, scene_file=file, exact_only=exact_only)
    text = "".join(f"{line}\n" for line in proof.lines())
    return Proved(proof.contact, file, text.encode())


@final
class ProvedSearch:
    """A search for the first contact by a tiling, which writes a proof of its answer.

    Args:
        scene: the scene.
        path: the path of the proof.
        tiling: the name of the tiling.
        scene_file: the bytes of the scene's file; by default the scene is written beside the
            proof, with ``.scene.json`` appended to its name.
        exact_only: whether the float filters are switched off.
        max_events: the maximum number of events of the tiling; None for no limit.
    """

    def __init__(
        self,
        scene: Scene,
        path: Path,
        *,
        tiling: str = "auto",
        scene_file: bytes | None = None,
        exact_only: bool = False,
        max_events: int | None = None,
    ) -> None:
        self._scene, self._path, self._beside = scene, path, scene_file is None
        self._file = scene_bytes(scene) if scene_file is None else scene_file
        self._proof = Proof(
            scene,
            tiling=tiling,
            scene_file=self._file,
            exact_only=exact_only,
            max_events=max_events,
        )

    @property
    def name(self) -> str:
        """The name of the tiling."""
        return self._proof.tiling

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the run; see `exactpt.simulation.report`."""
        kinetic = self._proof.kinetic
        counts = Counts(0, 0, {}) if kinetic is None else kinetic.vertices.counters.now()
        return report(self._scene, kinetic, counts)

    def run_to_contact(self) -> Contact | None:
        """Write the proof, and return the first contact, or None.

        Raises:
            BudgetExceeded: if there are more than ``max_events`` events.
            InputError: if a file cannot be written.
        """
        if self._beside:
            write_atomically(self._path.with_name(f"{self._path.name}.scene.json"), self._file)
        with writing(self._path) as write:
            for line in self._proof.lines():
                write(f"{line}\n")
        return self._proof.contact

    def passed(self) -> QQ:
        """A rational time before which there is provably no contact."""
        return self._proof.reached()


def write_proof(
    scene: Scene,
    path: str | Path,
    *,
    tiling: str = "auto",
    scene_file: bytes | None = None,
    exact_only: bool = False,
) -> Contact | None:
    """The first contact of a scene, or None, by a tiling; the proof is written to a file.

    Args and raises: as `ProvedSearch`.
    """
    search = ProvedSearch(
        scene, Path(path), tiling=tiling, scene_file=scene_file, exact_only=exact_only
    )
    return search.run_to_contact()
