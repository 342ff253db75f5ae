"""Which tiling is kept for a scene."""

from __future__ import annotations

from typing import Final

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices
from exactpt.scene.scene import Scene
from exactpt.tiling.greedy.greedy import GreedyTiling
from exactpt.tiling.kinetic import KineticTiling
from exactpt.tiling.lazy import LazyTiling

__all__ = ["TILINGS", "start_tiling", "tiling_for"]

TILINGS: Final[dict[str, type[KineticTiling]]] = {"greedy": GreedyTiling, "lazy": LazyTiling}
"""The tilings by name."""


def tiling_for(scene: Scene, name: str) -> str:
    """The name of the tiling to keep; "auto" is resolved by the shapes of the bodies.

    Raises:
        InputError: if there is no such tiling.
    """
    del scene
    if name == "auto":
        return "greedy"
    if name not in TILINGS:
        raise InputError(f"no tiling {name!r}; there are: auto, {', '.join(sorted(TILINGS))}")
    return name


def start_tiling(scene: Scene, name: str, start: QQ, *, exact_only: bool = False) -> KineticTiling:
    """The tiling of a scene just after a time at which its bodies are disjoint."""
    vertices = Vertices(scene.bodies, start, scene.end, tile_insides=name != "greedy")
    return TILINGS[tiling_for(scene, name)](vertices, start, scene.end, exact_only=exact_only)
