"""The page that runs exactpt in the browser: docs/browser, and what is made for it.

    python docs/make_page.py FOLDER

writes a folder for any web server: the page, the packaged scene, and the wheel, which is plain
Python (`make browser`). The site has the same at browser/ (docs/make_site.py).
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

__all__ = ["PAGE", "made", "write"]

ROOT: Final = Path(__file__).parents[1]
PAGE: Final = ROOT / "docs" / "browser"
NOT_COPIED: Final = (".*", "build", "dist", "*.egg-info", "__pycache__", "*.so")


def made() -> Iterator[tuple[str, bytes]]:
    """The files of the page that are not in its folder: their paths in it and contents."""
    yield "scenes/demo.json", (ROOT / "exactpt" / "data" / "demo.json").read_bytes()
    with TemporaryDirectory() as folder:
        wheel = _build(Path(folder))
        yield wheel.name, wheel.read_bytes()


def write(folder: Path) -> None:
    """Write the whole page into a folder."""
    shutil.copytree(PAGE, folder, dirs_exist_ok=True)
    for name, content in made():
        (folder / name).write_bytes(content)


def _build(folder: Path) -> Path:
    """The wheel without compiled modules.

    It is built in a copy of the checkout, since setuptools writes beside the sources: two builds
    at a time in one checkout delete each other's files.
    """
    source = folder / "source"
    shutil.copytree(ROOT, source, ignore=shutil.ignore_patterns(*NOT_COPIED))
    command = [sys.executable, "-m", "build", "--no-isolation", "--skip-dependency-check"]
    command += ["--outdir", folder, source]  # by way of an sdist: of sources alone
    environment = {**os.environ, "EXACTPT_PLAIN": "1"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"the wheel of the page cannot be built:\n{done.stdout}{done.stderr}")
    (wheel,) = folder.glob("*-py3-none-any.whl")
    return wheel


if __name__ == "__main__":
    write(Path(sys.argv[1]))
