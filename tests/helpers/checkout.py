"""A copy of this checkout, or of the unpacked sdist, to build from."""

import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).parents[2]
MADE = (".venv", "build", "dist", "*.egg-info", "__pycache__", "*.so", ".*_cache", ".hypothesis")


def tracked(*, and_new=False):
    """Return the paths of the files in git, from the root; None where there is no repository.

    Args:
        and_new: whether files count that are neither in git nor ignored.
    """
    if not (ROOT / ".git").exists():
        return None
    new = ["--cached", "--others", "--exclude-standard"] if and_new else []
    command = ["git", "ls-files", "-z", *new]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, check=True)
    return {name for name in listed.stdout.decode().split("\0") if (ROOT / name).is_file()}


def copy_to(folder, *, and_new=False):
    """Copy the files that `tracked` lists into a folder that does not exist."""
    names = tracked(and_new=and_new)
    if names is None:
        shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(*MADE))
        return
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, folder / name)
