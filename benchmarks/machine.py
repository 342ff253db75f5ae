"""The machine that a benchmark runs on, and the versions of all software that takes part."""

from __future__ import annotations

import os
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Final

from benchmarks.peers import PEERS
from exactpt.kernel import filters

__all__ = ["machine"]

OWN: Final = ("exactpt", "gmpy2", "numpy")


def machine() -> list[str]:
    """One line each: processor, system, build of exactpt, and the version of every package."""
    versions = [f"{name} {_version(name)}" for name in (*OWN, *PEERS)]
    return [
        f"{_processor()}, {os.cpu_count()} processors, {platform.system()} {platform.release()}",
        f"exactpt {'plain Python' if filters.__file__.endswith('.py') else 'compiled by mypyc'}",
        f"Python {platform.python_version()}, " + ", ".join(versions),
    ]


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"


def _processor() -> str:
    """The name of the processor, as far as the system tells."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()
