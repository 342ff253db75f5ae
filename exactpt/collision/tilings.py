"""Choice of the tiling to keep for a scene."""

from __future__ import annotations

from typing import Final, NamedTuple

from exactpt.certificates.at_time import PredicatesAt
from exactpt.errors import InputError
from exactpt.kernel.counters import Counters
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.scene.scene import Scene
from exactpt.tiling.tiling import Tiling

__all__ = [
    "POINT_TILING",
    "TILINGS",
    "TilingPlan",
    "check_tiling",
    "plan_tiling",
    "start_tiling",
    "tiling_class",
    "tiling_for_contact",
]

TILINGS: Final = ("greedy", "mixed", "lazy")
"""Names of the tilings that accept bodies of any shape."""

POINT_TILING: Final = "incremental"
"""Name of the tiling for scenes in which all bodies are points."""


class TilingPlan(NamedTuple):
    """A chosen tiling that has not been built yet.

    Attributes:
        name: one of `TILINGS`, or `POINT_TILING`.
        kind: the class that implements it.
        vertices: the moving vertices.
        end: end of the time span.
    """

    name: str
    kind: type[Tiling]
    vertices: Vertices
    end: QQ

    def start(self, time: QQ, *, exact_only: bool = False) -> Tiling:
        """The kinetic tiling just after a time at which the bodies are disjoint."""
        return self.kind.begin(self.vertices, time, self.end, exact_only=exact_only)

    def mesh_at(self, time: QQ) -> Mesh:
        """The static tiling at a time."""
        return self.kind.mesh_at(PredicatesAt(self.vertices, time, after=False))


def check_tiling(name: str) -> None:
    """Check that a tiling of this name, or "auto", exists.

    Raises:
        InputError: if not.
    """
    names = ("auto", POINT_TILING, *TILINGS)
    if name not in names:
        raise InputError(f"no tiling {name!r}; there are: {', '.join(names)}")


def plan_tiling(scene: Scene, name: str, start: QQ) -> TilingPlan:
    """The tiling of a given name; "auto" chooses by the shapes.

    "auto" is "incremental" if all bodies are points, "greedy" if all bodies stay convex until
    the end, and "mixed" otherwise.

    Raises:
        InputError: if there is no such tiling, or it does not support these bodies.
    """
    check_tiling(name)
    points = all(body.size == 1 for body in scene.bodies)
    if name == POINT_TILING or (name == "auto" and points):
        from exactpt.tiling.incremental.incremental import IncrementalTiling

        vertices = IncrementalTiling.vertices_of(scene.bodies, start, scene._end)
        return TilingPlan(POINT_TILING, IncrementalTiling, vertices, scene._end)
    vertices = Vertices.of(scene.bodies, start, scene._end)
    convex = name in ("auto", "greedy") and PredicatesAt(vertices, start).all_stay_convex()
    vertices.counters = Counters()  # decisions made for the choice are not part of the run
    if name == "auto":
        name = "greedy" if convex else "mixed"
    return TilingPlan(name, tiling_class(name, convex=convex), vertices, scene._end)


def tiling_for_contact(scene: Scene, name: str) -> str:
    """The given name; instead of "auto", the tiling with the fewest events."""
    if name != "auto":
        return name
    return POINT_TILING if all(body.size == 1 for body in scene.bodies) else "lazy"


def tiling_class(name: str, *, convex: bool) -> type[Tiling]:
    """The class that implements a tiling; "greedy" has one for convex bodies, one for others."""
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


def start_tiling(scene: Scene, name: str, start: QQ, *, exact_only: bool = False) -> Tiling:
    """The kinetic tiling of a scene just after a time at which its bodies are disjoint."""
    return plan_tiling(scene, name, start).start(start, exact_only=exact_only)
