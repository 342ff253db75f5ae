"""The optional packages that benchmarks compare with or draw by."""

from __future__ import annotations

import warnings
from importlib import import_module
from typing import Final

__all__ = ["ENGINES", "PEERS", "is_installed"]

PEERS: Final = {
    "shapely": "shapely",
    "pymunk": "pymunk",
    "ipctk": "ipctk",
    "box2d": "Box2D",
    "python-fcl": "fcl",
    "python-flint": "flint",
    "sympy": "sympy",
    "mpmath": "mpmath",
    "matplotlib": "matplotlib",
}
"""The module of each package."""

ENGINES: Final = {"python-fcl"}
"""Those in the extra `engines`; the others are in `bench`."""


def is_installed(package: str) -> bool:
    """Return True if a package can be imported; its warnings are not shown.

    (Modules by SWIG, such as Box2D, crash where Python makes their warnings errors.)
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            import_module(PEERS[package])
    except ImportError:
        return False
    return True
