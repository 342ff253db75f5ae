"""Which tiling is kept for a scene."""

from __future__ import annotations

from typing import Final, NamedTuple

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices
from exactpt.scene.scene import Scene
from exactpt.tiling.instant import Instant
from exactpt.tiling.kinetic import KineticTiling
from exactpt.tiling.mesh import Mesh

__all__ = ["TILINGS", "TilingPlan", "plan_tiling", "start_tiling", "tiling_class"]

TILINGS: Final = ("greedy", "mixed", "lazy")
"""The tilings by name."""


class TilingPlan(NamedTuple):
    """A tiling chosen, not built yet.

    Attributes:
        name: one of `TILINGS`.
        kind: the class that keeps it.
        vertices: from a time on.
        end: of the time span.
    """

    name: str
    kind: type[KineticTiling]
    vertices: Vertices
    end: QQ

    def start(self, time: QQ, *, exact_only: bool = False) -> KineticTiling:
        """The tiling just after a time at which the bodies are disjoint."""
        return self.kind(self.vertices, time, self.end, exact_only=exact_only)

    def mesh_at(self, time: QQ) -> Mesh:
        """The tiling at a time."""
        return self.kind.mesh_at(Instant(self.vertices, time, after=False))


def plan_tiling(scene: Scene, name: str, start: QQ) -> TilingPlan:
    """Choose the tiling; "auto" by the shapes: convex for ever greedy, else mixed.

    Raises:
        InputError: if there is no such tiling.
    """
    if name != "auto" and name not in TILINGS:
        raise InputError(f"no tiling {name!r}; there are: auto, {', '.join(TILINGS)}")
    vertices = Vertices(scene.bodies, start, scene.end)
    convex = name in ("auto", "greedy") and Instant(vertices, start).all_stay_convex()
    if name == "auto":
        name = "greedy" if convex else "mixed"
    return TilingPlan(name, tiling_class(name, convex=convex), vertices, scene.end)


def tiling_class(name: str, *, convex: bool) -> type[KineticTiling]:
    """The class that keeps a tiling: of the greedy ones, convex bodies have their own."""
    if name == "lazy":
        from exactpt.tiling.lazy import LazyTiling

        return LazyTiling
    if name == "mixed":
        from exactpt.tiling.mixed.mixed import MixedTiling

        return MixedTiling
    if convex:
        from exactpt.tiling.greedy.greedy import GreedyTiling

        return GreedyTiling
    from exactpt.tiling.greedy.shadowed import ShadowedTiling

    return ShadowedTiling


def start_tiling(scene: Scene, name: str, start: QQ, *, exact_only: bool = False) -> KineticTiling:
    """The tiling of a scene just after a time at which its bodies are disjoint."""
    return plan_tiling(scene, name, start).start(start, exact_only=exact_only)
