"""The machine that a benchmark runs on, the date, and the versions of all software."""

from __future__ import annotations

import os
import platform
import subprocess
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Final

from benchmarks.peers import PEERS
from exactpt.certificates import first_root as filters

__all__ = ["is_compiled", "machine"]

OWN: Final = ("exactpt", "gmpy2", "numpy")


def machine() -> list[str]:
    """Return a line each: processor and system, build of exactpt, date and commit, all versions."""
    versions = [f"{name} {_version(name)}" for name in (*OWN, *PEERS)]
    return [
        f"{_processor()}, {os.cpu_count()} processors, {platform.system()} {platform.release()}",
        f"exactpt {'compiled by mypyc' if is_compiled() else 'plain Python'}",
        f"measured on {datetime.now(UTC):%Y-%m-%d} at {_commit()}",
        f"Python {platform.python_version()}, " + ", ".join(versions),
    ]


def is_compiled() -> bool:
    """Return True if the hot modules of exactpt are compiled."""
    return not filters.__file__.endswith(".py")


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"


def _commit() -> str:
    """Return the commit of the checkout, and if the package differs from it."""
    git = ["git", "-C", str(Path(__file__).parent)]
    try:
        head = subprocess.check_output([*git, "rev-parse", "--short", "HEAD"], text=True)
        same = subprocess.run([*git, "diff", "--quiet", "HEAD", "--", "../exactpt"], check=False)
    except (OSError, subprocess.CalledProcessError):
        return "an unknown commit"
    return f"commit {head.strip()}" + (", with changes" if same.returncode else "")


def _processor() -> str:
    """Return the name of the processor, as far as the system has it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()
