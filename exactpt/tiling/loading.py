"""From a line of the catalogue to its tiling; the rules are imported when they are asked for."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any

from exactpt.certificates.certifier import Certifier
from exactpt.errors import InputError
from exactpt.motion.vertices import Vertices
from exactpt.tiling.catalogue import Bodies, Entry
from exactpt.tiling.engine import Engine
from exactpt.tiling.events import Stats
from exactpt.tiling.tiling import Tiling

if TYPE_CHECKING:
    from exactpt.certificates.at_time import PredicatesAt
    from exactpt.kernel.numbers import QQ
    from exactpt.motion.body import Body
    from exactpt.pseudotriangulation.mesh import Mesh

__all__ = ["make", "mesh_at", "vertices_of_points"]


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
