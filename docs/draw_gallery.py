"""Runs the commands of gallery.md, and keeps the pictures that they draw.

python docs/draw_gallery.py        # with exactpt installed; `make pictures` does it
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

DOCS = Path(__file__).parent
BLOCK = re.compile(r"```sh\n(.*?)```", re.DOTALL)


def blocks() -> list[str]:
    """The commands of each scene."""
    return BLOCK.findall((DOCS / "gallery.md").read_text(encoding="utf-8"))


def run(block: str, folder: Path, ending: str = "svg") -> Path:
    """Run the commands of a scene in a folder, by this Python; the picture that they draw."""
    (folder / "examples").symlink_to(DOCS.parent / "examples")
    for line in block.splitlines():
        command, *arguments = shlex.split(line)
        python = [sys.executable] if command == "python" else [sys.executable, "-m", command]
        environment = os.environ | {"PYTHONPATH": str(DOCS.parent)}
        subprocess.run([*python, *arguments], cwd=folder, env=environment, check=True)
    (picture,) = folder.glob(f"*.{ending}")
    return picture


def main() -> None:
    """Draw all of them anew."""
    for block in blocks():
        with TemporaryDirectory() as folder:
            picture = run(block, Path(folder))
            shutil.copyfile(picture, DOCS / "gallery" / picture.name)


if __name__ == "__main__":
    main()
