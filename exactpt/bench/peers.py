"""The optional packages that benchmarks compare with or draw by."""

from __future__ import annotations

from importlib import import_module
from typing import Final

__all__ = ["PEERS", "is_installed"]

PEERS: Final = {
    "shapely": "shapely",
    "pymunk": "pymunk",
    "ipctk": "ipctk",
    "python-flint": "flint",
    "sympy": "sympy",
    "mpmath": "mpmath",
    "matplotlib": "matplotlib",
}
"""The module of each package."""


def is_installed(package: str) -> bool:
    """Whether a package can be imported."""
    try:
        import_module(PEERS[package])
    except ImportError:
        return False
    return True
