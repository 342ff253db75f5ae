"""Choice of the tiling to keep for a scene."""

from __future__ import annotations

from fractions import Fraction
from typing import Final, NamedTuple

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certifier import Certifier
from exactpt.kernel.collection import collector_at_rest
from exactpt.kernel.numbers import QQ, fraction
from exactpt.motion.vertices import Vertices
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.scene.scene import Scene
from exactpt.tiling import catalogue, loading
from exactpt.tiling.catalogue import Entry
from exactpt.tiling.events import Stats
from exactpt.tiling.tiling import Tiling

__all__ = [
    "TILINGS",
    "TilingPlan",
    "check_tiling",
    "plan_tiling",
    "start_tiling",
    "tiling_for_contact",
    "tilings_for",
]

TILINGS: Final = tuple(catalogue.names(points=False))
"""Names of the tilings that accept bodies of any shape."""


class TilingPlan(NamedTuple):
    """A chosen tiling that has not been built yet.

    Attributes:
        entry: its entry in the catalogue.
        vertices: the moving vertices.
        end: end of the time span.
    """

    entry: Entry
    vertices: Vertices
    end: QQ

    @property
    def name(self) -> str:
        """Its name in the catalogue."""
        return self.entry.name

    def start(self, time: QQ, *, exact_only: bool = False) -> Tiling:
        """The kinetic tiling just after a time at which the bodies are disjoint."""
        certifier = Certifier(self.vertices, time, self.end, exact_only=exact_only)
        tiling = loading.make(self.entry, self.vertices, certifier, Stats())
        with collector_at_rest():
            tiling.begin(time)
        return tiling

    def mesh_at(self, time: QQ) -> Mesh:
        """The static tiling at a time."""
        return loading.mesh_at(self.entry, PredicatesAt(self.vertices, time, after=False))


def check_tiling(name: str) -> None:
    """Check that a tiling of this name, or "auto", exists.

    Raises:
        InputError: if not.
    """
    catalogue.choose(name, points=True, convex=lambda: True)


def tilings_for(scene: Scene) -> list[str]:
    """The names of the tilings that are for the bodies of a scene."""
    return catalogue.names(points=_are_points(scene))


def plan_tiling(scene: Scene, name: str, start: QQ) -> TilingPlan:
    """The tiling of a given name; "auto" chooses by the shapes.

    "auto" is "incremental" if all bodies are points, "greedy" if all bodies stay convex until
    the end, and "mixed" otherwise.

    Raises:
        InputError: if there is no such tiling, or it does not support these bodies.
    """
    with collector_at_rest():
        entry, vertices = loading.plan(name, scene.bodies, start, scene._end)
    return TilingPlan(entry, vertices, scene._end)


def tiling_for_contact(scene: Scene, name: str) -> str:
    """The given name; instead of "auto", the tiling with the fewest events."""
    if name != catalogue.AUTO:
        return name
    points = _are_points(scene)
    return catalogue.choose(name, points=points, convex=lambda: False, fewest_events=True).name


def start_tiling(scene: Scene, name: str, start: QQ, *, exact_only: bool = False) -> Tiling:
    """The kinetic tiling of a scene just after a time at which its bodies are disjoint."""
    with collector_at_rest():  # in one piece: at its end all that is new is visited once
        return plan_tiling(scene, name, start).start(start, exact_only=exact_only)


def proved_until(kinetic: Tiling | None, start: QQ) -> Fraction:
    """Return a rational time until which a run has passed no contact, also during an event.

    Args:
        kinetic: the tiling; None before there is one.
        start: the start of the run, at which there is no contact.
    """
    if kinetic is None or kinetic.passed is None:
        return fraction(start)
    return fraction(max(start, kinetic.vertices.frame.exact_time(kinetic.passed.low)))


def _are_points(scene: Scene) -> bool:
    return all(body.size == 1 for body in scene.bodies)
