"""Builds the old engine: a plain wheel of one commit of this repository, in a folder of its own.

The folder, `.old-engine`, is not in the tree: it holds the wheel, what is installed from it
(`site`) and the name of the commit. What the wheel needs (gmpy2, numpy, ...) is that of the
environment in which it runs.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from exactpt.errors import InputError
from fuzz.commits import ROOT, unpack

__all__ = ["COMMIT", "FOLDER", "SITE", "build", "is_built"]

COMMIT: Final = "c49c20d683d5a8126f098fb248ac8accf7b5693b"
"""The last commit of version 0.2."""

FOLDER: Final = ROOT / ".old-engine"
SITE: Final = FOLDER / "site"
"""What is put before all other packages where the old engine runs."""

_BUILT: Final = FOLDER / "commit.txt"
"""Written last: names the commit that has been built."""


def is_built() -> bool:
    """Return True if the old engine is there, and is that of the commit."""
    return _BUILT.is_file() and _BUILT.read_text(encoding="ascii").strip() == COMMIT


def build() -> Path:
    """Build the wheel and install it into `SITE`; return the wheel.

    An older build is removed first. The environment must have setuptools.

    Raises:
        InputError: if the repository has not the commit, or the wheel cannot be built.
    """
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir()
    with TemporaryDirectory() as place:
        try:
            unpack(COMMIT, Path(place))
        except InputError as error:
            raise InputError(f"the old engine: {error}") from None
        # Plain: mistakes are planted and traced in plain modules, and no compiler is needed.
        plain = {**os.environ, "EXACTPT_PLAIN": "1"}
        offline = ("--no-deps", "--no-build-isolation", "--no-index")
        _pip("wheel", *offline, "--wheel-dir", str(FOLDER), place, environment=plain)
    (wheel,) = FOLDER.glob("exactpt-*.whl")
    _pip("install", "--no-deps", "--no-index", "--target", str(SITE), str(wheel))
    _BUILT.write_text(f"{COMMIT}\n", encoding="ascii")
    return wheel


def _pip(*words: str, environment: dict[str, str] | None = None) -> None:
    command = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check", *words]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        last = done.stderr.strip().splitlines()[-1:]
        raise InputError(f"the old engine: pip {words[0]} fails: {' '.join(last)}")
