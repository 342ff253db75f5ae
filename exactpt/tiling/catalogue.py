"""The catalogue of tilings: the one place where a structure is registered."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from exactpt.certificates.certifier import Certifier
from exactpt.errors import InputError
from exactpt.motion.vertices import Vertices
from exactpt.tiling.engine import Engine
from exactpt.tiling.entry import Bodies, Entry
from exactpt.tiling.events import Stats
from exactpt.tiling.tiling import Tiling

if TYPE_CHECKING:
    from exactpt.certificates.at_time import PredicatesAt
    from exactpt.kernel.numbers import QQ
    from exactpt.motion.body import Body
    from exactpt.pseudotriangulation.mesh import Mesh

__all__ = ["AUTO", "ENTRIES", "choose", "find", "make", "mesh_at", "names", "vertices_of_points"]

AUTO: Final = "auto"
"""Asks for the first tiling of the catalogue that is for the bodies."""

ENTRIES: Final = [
    Entry(
        "incremental",
        Bodies.POINTS,
        "exactpt.tiling.incremental.incremental:IncrementalTiling",
        has_fewest_events=True,
    ),
    Entry("greedy", Bodies.CONVEX, "exactpt.tiling.greedy.greedy:VerticalRules"),
    Entry("mixed", Bodies.ANY, "exactpt.tiling.mixed.mixed:MixedRules"),
    Entry("greedy", Bodies.ANY, "exactpt.tiling.greedy.shadowed:ShadowRules"),
    Entry(
        "lazy",
        Bodies.ANY,
        "exactpt.tiling.lazy:LazyRules",
        is_canonical=False,
        has_fewest_events=True,
    ),
]
"""All tilings; of two with one name the first that is for the bodies is meant."""


def names(*, points: bool) -> list[str]:
    """The names of the tilings of any bodies; of points alone too, if there are but such."""
    kinds = (Bodies.CONVEX, Bodies.ANY, *([Bodies.POINTS] if points else []))
    found = [entry for kind in kinds for entry in ENTRIES if entry.bodies is kind]
    return list(dict.fromkeys(entry.name for entry in found))


def choose(
    name: str, *, points: bool, convex: Callable[[], bool], fewest_events: bool = False
) -> Entry:
    """The tiling with a name that is for the bodies; by "auto" the first one that is.

    Args:
        name: one of `names`, or `AUTO`.
        points: whether the bodies are points alone.
        convex: whether they stay convex; asked only if it matters.
        fewest_events: whether by "auto" only tilings with the fewest events are meant.

    Raises:
        InputError: if there is none.
    """
    for entry in ENTRIES:
        if name == AUTO:
            is_meant = entry.has_fewest_events or not fewest_events
            fits = entry.bodies is not Bodies.POINTS or points
        else:
            is_meant, fits = entry.name == name, True  # `vertices_of_points` refuses the others
        if is_meant and fits and (entry.bodies is not Bodies.CONVEX or convex()):
            return entry
    known = ", ".join([AUTO, *names(points=True)])
    raise InputError(f"no tiling {name!r}; there are: {known}")


def find(name: str, *, convex: bool) -> Entry:
    """The tiling of a saved run.

    Args:
        name: its name.
        convex: whether it is for convex bodies.
    """
    return choose(name, points=True, convex=lambda: convex)


def vertices_of_points(entry: Entry, bodies: Sequence[Body], start: QQ, end: QQ) -> Vertices:
    """The moving vertices of points, one each, for a tiling that is for these alone.

    Raises:
        InputError: if a body is no point.
    """
    for body in bodies:
        if body.size > 1:
            raise InputError(
                f"body {body.name!r}: has {body.size} vertices: "
                f"the {entry.name} tiling is for points"
            )
    return Vertices.of(bodies, start, end, plain=True)


def make(entry: Entry, vertices: Vertices, certifier: Certifier, stats: Stats) -> Tiling:
    """The tiling, still without a mesh: `Tiling.begin` or `Tiling.resume` comes next."""
    kept = _load(entry)
    if entry.bodies is Bodies.POINTS:
        tiling: Tiling = kept(entry, vertices, certifier, stats)
        return tiling
    return Engine(entry, kept, vertices, certifier, stats)


def mesh_at(entry: Entry, instant: PredicatesAt) -> Mesh:
    """The tiling of an instant."""
    mesh: Mesh = _load(entry).build(instant)
    return mesh


def _load(entry: Entry) -> Any:  # noqa: ANN401 - a class of rules, or of a tiling of points
    module, name = entry.place.split(":")
    return getattr(import_module(module), name)
