"""A compiled copy of this checkout, which must answer as the plain one does.

    python -m fuzz.compiled_copy        (make compiled-copy)

The copy is in the folder `.compiled`, which is not in the tree: the sources, and what mypyc and a C
compiler make of them (setup.py). The checkout itself stays plain.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Final

import click

from exactpt.errors import InputError

__all__ = ["FOLDER", "build", "is_built"]

ROOT: Final = Path(__file__).parents[1]
FOLDER: Final = ROOT / ".compiled"
FILES: Final = ("setup.py", "pyproject.toml", "README.md", "LICENSE")
"""What the build needs besides the package."""


def is_built(folder: Path = FOLDER) -> bool:
    """Return True if a folder has a compiled copy, and of the sources that are here now."""
    if not (folder / "exactpt" / "compiled.txt").is_file():
        return False
    return _sources(folder) == _sources(ROOT)


def _sources(folder: Path) -> dict[str, bytes]:
    package = folder / "exactpt"
    return {str(path.relative_to(folder)): path.read_bytes() for path in package.rglob("*.py")}


def build(folder: Path = FOLDER) -> None:
    """Copy the checkout into a folder, and compile it there; an older copy is removed first.

    Raises:
        InputError: if nothing is compiled: mypyc or the C compiler is missing, or fails.
    """
    shutil.rmtree(folder, ignore_errors=True)
    made = shutil.ignore_patterns("*.so", "__pycache__", "compiled.txt")
    shutil.copytree(ROOT / "exactpt", folder / "exactpt", ignore=made)
    for name in FILES:
        shutil.copy2(ROOT / name, folder / name)
    command = [sys.executable, "setup.py", "--quiet", "build_ext", "--inplace"]
    compiling = {name: value for name, value in os.environ.items() if name != "EXACTPT_PLAIN"}
    done = subprocess.run(
        command, cwd=folder, env=compiling, capture_output=True, text=True, check=False
    )
    if not is_built(folder):
        last = (done.stderr.strip().splitlines() or ["nothing was compiled"])[-1]
        raise InputError(f"the compiled copy: {last}; it needs mypyc and a C compiler")


@click.command("compiled-copy")
def main() -> None:
    """Compile a copy of this checkout into .compiled, for the law "compiled/plain"."""
    try:
        build()
    except InputError as error:
        raise click.ClickException(str(error)) from None
    click.echo(f"{FOLDER.name}: python -m fuzz run compiled")


if __name__ == "__main__":
    main()
