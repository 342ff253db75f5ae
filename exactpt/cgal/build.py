"""Building cgal_check from the C++ sources that come with the package."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Final

from exactpt.errors import InputError

PACKAGES: Final = "g++ cmake make libcgal-dev nlohmann-json3-dev"
"""What Debian calls the packages that the build needs."""


def sources() -> Path:
    """Return the folder of the C++ sources, of the checkout or of the installed package.

    Raises:
        InputError: if there is none.
    """
    here = Path(__file__).parent
    for folder in (here.parents[1] / "cgal_check", here / "sources"):
        if (folder / "CMakeLists.txt").is_file():
            return folder
    raise InputError("the sources of cgal_check are not in this installation")


def build_program(folder: Path) -> Path:
    """Build cgal_check in a folder, which is made; returns the program.

    It takes a minute, and prints the output of CMake if it fails.

    Raises:
        InputError: if CMake or a library is missing, or the build fails.
    """
    source = ["-S", str(sources()), "-B", str(folder), "-DCMAKE_BUILD_TYPE=Release"]
    _run("cmake", *source)
    _run("cmake", "--build", str(folder), "--parallel", "2")
    return folder / "cgal_check"


def _run(*command: str) -> None:
    debian = f"on Debian and Ubuntu it needs: apt-get install {PACKAGES}"
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise InputError(f"cannot start {command[0]}: {error.strerror}; {debian}") from None
    if done.returncode:
        output = [line.strip() for line in (done.stderr + done.stdout).splitlines() if line.strip()]
        why = next((line for line in output if "error" in line.lower()), "it says nothing")
        reason = " ".join([why, *output[output.index(why) + 1 :][:2]]) if why in output else why
        raise InputError(f"cgal_check cannot be built: {reason[:400]}; {debian}")
