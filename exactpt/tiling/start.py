"""The choice of a tiling for a scene, and its start; its rules are imported on first use."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.convex_bodies import all_stay_convex
from exactpt.errors import AuditError, InputError
from exactpt.indices import VertexId
from exactpt.kernel.collection import collector_at_rest
from exactpt.kernel.counters import Counters
from exactpt.kernel.numbers import QQ, shorten
from exactpt.motion.body import Body
from exactpt.motion.tileable import refuse_untileable
from exactpt.motion.vertices import Vertices
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.scene.groups import NO_TILING, refuse_groups
from exactpt.scene.scene import Scene
from exactpt.tiling import catalogue
from exactpt.tiling.catalogue import Bodies, Entry
from exactpt.tiling.engine import Engine
from exactpt.tiling.events import Stats
from exactpt.tiling.tiling import Tiling

if TYPE_CHECKING:
    from collections.abc import Callable

TILINGS: Final = tuple(catalogue.names(points=False))
"""Names of the tilings that accept bodies of any shape."""


class TilingPlan(NamedTuple):
    """A chosen tiling that has not been built yet.

    Attributes:
        entry: its entry in the catalogue.
        vertices: the moving vertices.
        end: end of the time span.
        fan: whether the fan triangulation is maintained.
    """

    entry: Entry
    vertices: Vertices
    end: QQ
    fan: bool = False

    @property
    def name(self) -> str:
        """Its name in the catalogue."""
        return self.entry.name

    def start(self, time: QQ, *, exact_only: bool = False) -> Tiling:
        """Return the kinetic tiling just after a time at which the bodies are disjoint."""
        certifier = Certifier(self.vertices, time, self.end, exact_only=exact_only)
        tiling = make(self.entry, self.vertices, certifier, Stats(), fan=self.fan)
        with collector_at_rest():
            tiling.begin(time)
        return tiling

    def mesh_at(self, time: QQ) -> Mesh:
        """Return the static tiling at a time."""
        return _mesh_at(self.entry, PredicatesAt(self.vertices, time, after=False))


def tilings_for(scene: Scene) -> list[str]:
    """Return the names of the tilings that are for the bodies of a scene."""
    return catalogue.names(points=_are_points(scene.bodies))


def tiling_for_contact(scene: Scene, name: str) -> str:
    """Return the given name; instead of "auto", the tiling with the fewest events.

    Raises:
        InputError: if the tiling does not exist.
    """
    auto = name == catalogue.AUTO
    points = not auto or _are_points(scene.bodies)
    return catalogue.choose(name, points=points, convex=lambda: not auto, fewest_events=auto).name


def start_tiling(scene: Scene, name: str, start: QQ, *, exact_only: bool = False) -> Tiling:
    """Return the kinetic tiling of a scene just after a time at which its bodies are disjoint."""
    with collector_at_rest():  # in one piece: at its end all that is new is visited once
        return plan_tiling(scene, name, start).start(start, exact_only=exact_only)


def plan_tiling(scene: Scene, name: str, start: QQ, *, fan: bool = False) -> TilingPlan:
    """Return the tiling of a given name; "auto" chooses by the shapes.

    "auto" is "incremental" if all bodies are points, "greedy" if all bodies stay convex until
    the end, and "mixed" otherwise.

    Args:
        scene: the scene.
        name: the name of the tiling, or "auto".
        start: the time at which the tiling is built.
        fan: whether the fan triangulation is maintained too.

    Raises:
        InputError: if the tiling does not exist, is for points and a body is not one, a body
            is rounded, or bodies of the scene ignore each other; or if a fan triangulation is
            requested, and the tiling has none.
    """
    bodies, end = scene.bodies, scene.exact_end
    refuse_untileable(bodies)
    refuse_groups(scene, NO_TILING)
    made: list[Vertices] = []

    def vertices() -> Vertices:
        if not made:
            made.append(Vertices.of(bodies, start, end))
        return made[0]

    with collector_at_rest():
        entry = catalogue.choose(
            name,
            points=_are_points(bodies),
            convex=lambda: all_stay_convex(PredicatesAt(vertices(), start)),
        )
        if fan and not entry.has_fan:
            raise _no_fan(entry, bodies)
        if entry.bodies is Bodies.POINTS:
            return TilingPlan(entry, _vertices_of_points(entry, bodies, start, end), end, fan)
        vertices().counters = Counters()  # decisions made for the choice are not part of the run
        return TilingPlan(entry, vertices(), end)


def _are_points(bodies: Sequence[Body]) -> bool:
    return all(body.size == 1 for body in bodies)


def _vertices_of_points(entry: Entry, bodies: Sequence[Body], start: QQ, end: QQ) -> Vertices:
    """Return the moving vertices of points, one each, for a tiling of points alone."""
    for body in bodies:
        if body.size > 1:
            raise InputError(
                f"body {shorten(body.name)}: has {body.size} vertices: "
                f"the {entry.name} tiling is for points"
            )
    return Vertices.of(bodies, start, end, plain=True)


def _no_fan(entry: Entry, bodies: Sequence[Body]) -> InputError:
    """Return the error about a fan triangulation that a tiling of these bodies does not have."""
    polygon = next((body for body in bodies if body.size > 1), None)
    if polygon is not None:
        return InputError(
            f"fan: only points have a fan triangulation, got body {shorten(polygon.name)} with "
            f"{polygon.size} vertices; leave the fan out"
        )
    return InputError(
        f"fan: only the incremental tiling has a fan triangulation, got the {entry.name} tiling; "
        "leave the fan out, or choose the tiling incremental or auto"
    )


def make(
    entry: Entry, vertices: Vertices, certifier: Certifier, stats: Stats, *, fan: bool = False
) -> Tiling:
    """Return the tiling, still without a mesh; `Tiling.begin` or `Tiling.resume` must follow.

    Args:
        entry: its entry in the catalogue.
        vertices: the moving vertices.
        certifier: certificates and the current time.
        stats: the counts of the run.
        fan: whether the fan triangulation is maintained, by a tiling that has one.
    """
    loaded = _load(entry)
    if entry.bodies is Bodies.POINTS:
        # Only with a fan: the classes of other tilings need not have that argument.
        options = {"fan": True} if fan else {}
        tiling: Tiling = loaded(entry, vertices, certifier, stats, **options)
        return tiling
    return Engine(entry, loaded, vertices, certifier, stats)


def relative_hulls(instant: PredicatesAt) -> Callable[[int], list[VertexId]]:
    """Return the shortest loop around each body, as vertex ids, by a tiling that contains them."""
    entry = catalogue.with_relative_hulls()
    hulls = _mesh_at(entry, instant).relative_hulls()
    if hulls is None:
        raise AuditError(f"the {entry.name} tiling knows no relative hulls")
    return hulls


def _mesh_at(entry: Entry, instant: PredicatesAt) -> Mesh:
    """Return the tiling of an instant."""
    mesh: Mesh = _load(entry).build(instant)
    return mesh


def _load(entry: Entry) -> Any:  # noqa: ANN401 - a class of rules, or of a tiling of points
    module, name = entry.place.split(":")
    return getattr(import_module(module), name)
