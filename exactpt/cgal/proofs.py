"""Proofs of first contacts (docs/proofs.md), verified by the program cgal_check."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path
from typing import Final, NamedTuple

from exactpt.brief import record_in_brief
from exactpt.cgal.client import find_program, recognise
from exactpt.errors import AuditError, BudgetExceeded, InputError
from exactpt.kernel.numbers import shorten

_ACCEPTED: Final = 0
_REJECTED: Final = 1
_NO_PROOF: Final = 2
_NOT_DECIDED: Final = 4
_UNTIL: Final = re.compile(
    r"no (?:contact|two bodies .*?) in \[\S+ (\S+)\]; the span of the scene is "
)
_PARTIAL: Final = re.compile("; (the span of the scene is|between b|ignoring b)")


class ProofVerdict(NamedTuple):
    """The verdict on a proof.

    Attributes:
        accepted: True if the proof holds.
        line: the verdict: the proved statement, or the first line that does not hold.
    """

    accepted: bool
    line: str

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def statement(self) -> str | None:
        """The proved statement, without the hash of the scene; None if the proof does not hold."""
        return self.line.split(" ", 2)[2] if self.accepted else None

    @property
    def whole(self) -> bool:
        """True if the proof holds, and covers the whole time span of the scene."""
        return self.accepted and not _PARTIAL.search(self.line)

    @property
    def until(self) -> str | None:
        """The rational end of the span without contact, if it is before that of the scene."""
        found = _UNTIL.search(self.line) if self.accepted else None
        return found[1] if found else None


def check_proof(
    scene: str | Path,
    proof: str | Path,
    *,
    jobs: int = 1,
    program: str | Path | None = None,
    max_seconds: float | None = None,
) -> ProofVerdict:
    """Have cgal_check verify a proof or certificate, of a part too: see `ProofVerdict.whole`.

    Args:
        scene: the path of the scene's file.
        proof: the path of the proof.
        jobs: number of processes, from 1 to 256; the verdict does not depend on it.
        program: the path of the program; by default the result of `find_program`.
        max_seconds: maximum duration in seconds; None for no limit.

    Raises:
        InputError: if the program is missing, or the file is not a proof of this
            scene.
        BudgetExceeded: if ``max_seconds``, or the program's own budget of work, is exceeded.
        AuditError: if the program itself fails.
    """
    return _verdict([str(scene), str(proof)], jobs, program, max_seconds)


def check_proofs(
    folder: str | Path,
    *,
    jobs: int = 1,
    program: str | Path | None = None,
    max_seconds: float | None = None,
) -> ProofVerdict:
    """Have cgal_check verify the proofs of a run, which ``Simulation(proof=folder)`` has written.

    Args and raises: as `check_proof`.
    """
    return _verdict([str(folder)], jobs, program, max_seconds)


def _verdict(
    paths: list[str], jobs: int, program: str | Path | None, max_seconds: float | None
) -> ProofVerdict:
    path = find_program() if program is None else Path(program)
    command = [str(path), "proof", *paths, "--jobs", str(jobs), "--partial"]
    try:
        done = subprocess.run(command, capture_output=True, timeout=max_seconds, check=False)
    except subprocess.TimeoutExpired:
        raise BudgetExceeded("time limit exceeded while the proof was verified", None) from None
    except OSError as error:
        raise InputError(f"cannot start {shorten(str(path), 200)}: {error.strerror}") from None
    line = done.stdout.decode("utf-8", "replace").strip()
    if done.returncode == _ACCEPTED and line.startswith("accepted: "):
        return ProofVerdict(accepted=True, line=line)
    if done.returncode == _REJECTED and line.startswith("rejected: "):
        return ProofVerdict(accepted=False, line=line)
    recognise(path)
    if done.returncode == _NO_PROOF:
        raise InputError(f"cgal_check: {line}")
    if done.returncode == _NOT_DECIDED:
        raise BudgetExceeded(f"cgal_check: {line}", None)
    message = done.stderr[-2000:].decode("utf-8", "replace").strip()
    raise AuditError(f"cgal_check ended with {done.returncode}: {line} {message}".rstrip())
