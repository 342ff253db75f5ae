"""The files of other commits of this repository: of the old engine, and of the base of a change."""

from __future__ import annotations

import io
import subprocess
import tarfile
from pathlib import Path
from typing import Final

from exactpt.errors import InputError

__all__ = ["ROOT", "unpack"]

ROOT: Final = Path(__file__).parents[1]


def unpack(commit: str, place: Path) -> None:
    """Unpack the files of a commit into a folder; a shallow clone fetches the commit first.

    Args:
        commit: what names a commit to git, such as a hash or a branch.
        place: an empty folder.

    Raises:
        InputError: if the repository has no such commit.
    """
    if _resolved(commit).returncode != 0:
        _git("fetch", "--quiet", "--depth=1", "origin", "--", commit)
    found = _resolved(commit)
    if found.returncode != 0:
        why = found.stderr.decode(errors="replace").strip().splitlines()[:1]
        raise InputError(": ".join([f"no commit {commit} in {ROOT}", *why]) + "; fetch it")
    archive = _git("archive", "--format=tar", found.stdout.decode().strip())
    with tarfile.open(fileobj=io.BytesIO(archive.stdout)) as files:
        files.extractall(place, filter="data")


def _resolved(commit: str) -> subprocess.CompletedProcess[bytes]:
    return _git("rev-parse", "--verify", "--quiet", "--end-of-options", f"{commit}^{{commit}}")


def _git(*words: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True, check=False)
