"""Which tiling is kept for a scene."""

from __future__ import annotations

from typing import Final

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ
from exactpt.scene.scene import Scene
from exactpt.tiling.greedy.greedy import GreedyTiling
from exactpt.tiling.incremental.incremental import IncrementalTiling
from exactpt.tiling.lazy import LazyTiling
from exactpt.tiling.tiling import Tiling

__all__ = ["TILINGS", "start_tiling", "tiling_for"]

TILINGS: Final[dict[str, type[Tiling]]] = {
    "greedy": GreedyTiling,
    "incremental": IncrementalTiling,
    "lazy": LazyTiling,
}
"""The tilings by name."""


def tiling_for(scene: Scene, name: str) -> str:
    """The name of the tiling to keep; "auto" is resolved by the shapes of the bodies.

    Raises:
        InputError: if there is no such tiling.
    """
    if name == "auto":
        points = all(body.size == 1 for body in scene.bodies)
        return "incremental" if points else "greedy"
    if name not in TILINGS:
        raise InputError(f"no tiling {name!r}; there are: auto, {', '.join(sorted(TILINGS))}")
    return name


def start_tiling(scene: Scene, name: str, start: QQ, *, exact_only: bool = False) -> Tiling:
    """The tiling of a scene just after a time at which its bodies are disjoint."""
    kind = TILINGS[tiling_for(scene, name)]
    vertices = kind.vertices_of(scene.bodies, start, scene.end)
    return kind(vertices, start, scene.end, exact_only=exact_only)
