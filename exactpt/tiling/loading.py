"""The tiling of a line of the catalogue; its rules are imported on first use."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.convex_bodies import all_stay_convex
from exactpt.errors import AuditError, InputError
from exactpt.indices import VertexId
from exactpt.kernel.counters import Counters
from exactpt.motion.body import refuse_rounded
from exactpt.motion.vertices import Vertices
from exactpt.tiling import catalogue
from exactpt.tiling.catalogue import Bodies, Entry
from exactpt.tiling.engine import Engine
from exactpt.tiling.events import Stats
from exactpt.tiling.tiling import Tiling

if TYPE_CHECKING:
    from collections.abc import Callable

    from exactpt.kernel.numbers import QQ
    from exactpt.motion.body import Body
    from exactpt.pseudotriangulation.mesh import Mesh

__all__ = ["make", "mesh_at", "plan", "relative_hulls"]


def plan(name: str, bodies: Sequence[Body], start: QQ, end: QQ) -> tuple[Entry, Vertices]:
    """The tiling with a name that is for the bodies, and their moving vertices for it.

    Raises:
        InputError: if there is no such tiling, it is for points and a body is not one, or a body
            is rounded.
    """
    refuse_rounded(bodies)
    made: list[Vertices] = []

    def vertices() -> Vertices:
        if not made:
            made.append(Vertices.of(bodies, start, end))
        return made[0]

    entry = catalogue.choose(
        name,
        points=all(body.size == 1 for body in bodies),
        convex=lambda: all_stay_convex(PredicatesAt(vertices(), start)),
    )
    if entry.bodies is Bodies.POINTS:
        return entry, _vertices_of_points(entry, bodies, start, end)
    vertices().counters = Counters()  # decisions made for the choice are not part of the run
    return entry, vertices()


def _vertices_of_points(entry: Entry, bodies: Sequence[Body], start: QQ, end: QQ) -> Vertices:
    """The moving vertices of points, one each, for a tiling of points alone."""
    for body in bodies:
        if body.size > 1:
            raise InputError(
                f"body {body.name!r}: has {body.size} vertices: "
                f"the {entry.name} tiling is for points"
            )
    return Vertices.of(bodies, start, end, plain=True)


def make(entry: Entry, vertices: Vertices, certifier: Certifier, stats: Stats) -> Tiling:
    """The tiling, still without a mesh; `Tiling.begin` or `Tiling.resume` must follow."""
    loaded = _load(entry)
    if entry.bodies is Bodies.POINTS:
        tiling: Tiling = loaded(entry, vertices, certifier, stats)
        return tiling
    return Engine(entry, loaded, vertices, certifier, stats)


def mesh_at(entry: Entry, instant: PredicatesAt) -> Mesh:
    """The tiling of an instant."""
    mesh: Mesh = _load(entry).build(instant)
    return mesh


def relative_hulls(instant: PredicatesAt) -> Callable[[int], list[VertexId]]:
    """The shortest loop around each body, as vertex ids, by a tiling that contains them."""
    entry = catalogue.with_relative_hulls()
    hulls = mesh_at(entry, instant).relative_hulls()
    if hulls is None:
        raise AuditError(f"the {entry.name} tiling knows no relative hulls")
    return hulls


def _load(entry: Entry) -> Any:  # noqa: ANN401 - a class of rules, or of a tiling of points
    module, name = entry.place.split(":")
    return getattr(import_module(module), name)
