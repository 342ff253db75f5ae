"""Proofs as files, written while a tiling runs; a file is complete or absent."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from exactpt import proof_scene
from exactpt.brief import record_in_brief
from exactpt.errors import AuditError, BudgetExceeded
from exactpt.files import write_atomically
from exactpt.proof.emit import ProofRun, write_beside
from exactpt.scene.scene import Scene, a_scene
from exactpt.scene.written import scene_bytes

if TYPE_CHECKING:
    from exactpt.check_apart import Proved as Certified
    from exactpt.pair.contact import Contact
    from exactpt.proof_check import Proved


class Proof(NamedTuple):
    """A first contact with its proof, or its certificate (`certify`), in memory.

    Attributes:
        contact: the first contact, or None.
        scene: the bytes of the scene's file.
        text: the bytes of the proof.
    """

    contact: Contact | None
    scene: bytes
    text: bytes

    def __repr__(self) -> str:
        return record_in_brief(self)

    def check(self) -> Proved | Certified:
        """Have `exactpt.proof_check`, or `exactpt.check_apart`, verify the proof.

        Returns:
            the proved statement, a text with the attributes ``until`` and ``whole`` (whether
            it covers the whole time span of the scene).

        Raises:
            AuditError: if a line of it does not hold.
            BudgetExceeded: if the checker's budget of work is used up.
        """
        from exactpt import check_apart, proof_check

        checker = check_apart if self.text.startswith(b"exactpt-apart") else proof_check
        try:
            return checker.check(self.scene, self.text)  # type: ignore[no-any-return]
        except proof_scene.Rejected as rejected:
            raise AuditError(str(rejected)) from None
        except proof_scene.Exhausted as exhausted:
            raise BudgetExceeded(str(exhausted), None) from None

    def save(self, path: str | Path) -> None:
        """Write the proof, and its scene beside it, with ``.scene.json`` appended to its name.

        Raises:
            InputError: if a file cannot be written, or the one beside is not the scene of an
                earlier proof at this path.
        """
        write_beside(Path(path), self.scene)
        write_atomically(Path(path), self.text)


def prove(
    scene: Scene, *, tiling: str = "auto", scene_file: bytes | None = None, exact_only: bool = False
) -> Proof:
    """Return the first contact of a scene by a tiling, with its proof (docs/proofs.md).

    >>> import exactpt
    >>> p = exactpt.Body("p", [(0, 0)], exactpt.Translation([0, 1]))
    >>> scene = exactpt.Scene([p, exactpt.Body("q", [(3, 0)])], time=(0, 9))
    >>> exactpt.prove(scene).check().split(" ", 2)[2]
    "first contact at T = 3: incidences exactly b0.0 at b1.0 (b0 is 'p', b1 is 'q')"

    Args:
        scene: the scene.
        tiling: the name of the tiling; "auto" is the one with the fewest events.
        scene_file: the bytes of the scene's file; by default those that `Scene.save` writes.
        exact_only: whether the float filters are switched off.

    Raises:
        InputError: if the scene is none, the tiling does not exist, or does not support these
            bodies, or a coordinate has a degree above 64, which no checker takes.
    """
    a_scene(scene)
    file = scene_bytes(scene) if scene_file is None else scene_file
    run = ProofRun(scene, tiling=tiling, scene_file=file, exact_only=exact_only)
    text = "".join(f"{line}\n" for line in run.lines())
    return Proof(run.contact, file, text.encode())


def write_proof(
    scene: Scene,
    path: str | Path,
    *,
    tiling: str = "auto",
    scene_file: bytes | None = None,
    exact_only: bool = False,
) -> Contact | None:
    """Return the first contact of a scene, or None, by a tiling; the proof is written to a file.

    Args and raises: as `ProofRun`.
    """
    search = ProofRun(
        scene, Path(path), tiling=tiling, scene_file=scene_file, exact_only=exact_only
    )
    return search.run_to_contact()
