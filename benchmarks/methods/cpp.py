"""A plain sweep-and-prune in C++ doubles, compiled where g++ is found: a floor of run time."""

from __future__ import annotations

import ctypes
import math
import shutil
import subprocess
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Final

import numpy as np

from benchmarks.methods.method import Answer, Method, UnsuitableScene
from benchmarks.methods.moving import Moving
from exactpt.scene.scene import Scene

__all__ = ["SWEEP_AND_PRUNE", "has_compiler"]

SOURCE: Final = Path(__file__).with_name("sweep_and_prune.cpp")


def has_compiler() -> bool:
    """Return True if g++ is found."""
    return shutil.which("g++") is not None


@lru_cache(maxsize=1)
def _library() -> ctypes.CDLL:
    """Compile the source, and load it."""
    with TemporaryDirectory() as folder:
        made = Path(folder, "sweep.so")
        options = ["-O2", "-march=native", "-shared", "-fPIC"]
        subprocess.run(["g++", *options, str(SOURCE), "-o", str(made)], check=True)
        library = ctypes.CDLL(str(made))
    library.first_contact.restype = ctypes.c_double
    return library


def _prepare(scene: Scene) -> Callable[[], Answer]:
    moving = Moving(scene)
    if moving.degree > 1 or any(shape.deforms for shape in moving.shapes):
        raise UnsuitableScene("motions that are not linear translations")
    if any(body.has_rings for body in scene.bodies):
        raise UnsuitableScene("bodies with several rings")
    some = [shape.first for shape in moving.shapes]
    first = np.array([*some, len(moving.body)], np.int32)
    closed = np.array([shape.closed for shape in moving.shapes], np.uint8)
    still = np.zeros((len(moving.x), 2 - moving.x.shape[1]))
    x, y = (np.hstack((values, still)) for values in (moving.x, moving.y))
    # Of one body all vertices have the same velocity.
    rows = [np.ascontiguousarray(f) for f in (x[:, 0], y[:, 0], x[some, 1], y[some, 1])]
    arrays: list[np.ndarray[Any, Any]] = [first, closed, *rows]
    pointers = [ctypes.c_void_p(array.ctypes.data) for array in arrays]
    span = ctypes.c_double(moving.start), ctypes.c_double(moving.end)
    find = _library().first_contact

    def ask() -> Answer:
        time = float(find(len(some), *pointers, *span))
        assert arrays  # noqa: S101 - they live as long as the pointers
        return None if math.isinf(time) else time

    return ask


SWEEP_AND_PRUNE: Final = Method("C++ doubles", "sweep-and-prune", _prepare)
"""The floor."""
