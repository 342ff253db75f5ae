"""The state of a running tiling as JSON data, exactly, and back.

Everything that influences later decisions is saved: half-edges with their handles, pending
failures with their enclosures, and exact numbers with their current isolating intervals. A
restored run therefore takes the same steps as the saved one would have.

Rationals are texts ``"p/q"``; doubles are JSON numbers (which Python writes and reads
exactly); exact times are ``{"polynomial", "low", "high"}``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventTime
from exactpt.collision.contact import Contact, Pair
from exactpt.collision.tilings import POINT_TILING, tiling_class
from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, ZZ, parse_rational
from exactpt.motion.body import Body
from exactpt.motion.frame import Frame
from exactpt.motion.vertices import Vertices
from exactpt.planar.halfedge import PlanarMap
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.simulation.event import Event
from exactpt.tiling.events import Stats
from exactpt.tiling.greedy.greedy import GreedyTiling
from exactpt.tiling.greedy.vertical import VerticalDecomposition
from exactpt.tiling.incremental.chains import Chains
from exactpt.tiling.incremental.incremental import IncrementalTiling
from exactpt.tiling.incremental.structure import IncrementalStructure
from exactpt.tiling.kinetic import KineticTiling
from exactpt.tiling.mixed.labels import Forest, LabelledMesh
from exactpt.tiling.tiling import Tiling

__all__ = [
    "Data",
    "contact_from_json",
    "event_from_json",
    "number_from_json",
    "number_to_json",
    "tiling_from_json",
    "tiling_to_json",
]

Data: TypeAlias = "dict[str, Any]"
"""A JSON object that has been read; defects are detected where it is used."""

_STATS = ("batches", "rebuilds", "flips", "most")
_CELLS = ("vertex", "left", "right", "left_up", "left_down", "right_up", "right_down")


def tiling_to_json(kinetic: Tiling) -> Data:
    """The state of a tiling between two events."""
    certifier, stats, vertices = kinetic.certifier, kinetic.stats, kinetic.vertices
    data: Data = {
        "kind": kinetic.name,
        "convex": isinstance(kinetic, GreedyTiling),
        "end": str(certifier.end),
        "now": _time_to_json(certifier.now),
        "roots_now": [list(key) for key in certifier.roots_now],
        "bodies": [
            {
                "since": str(moving.since),
                "ring": [[v, vertices.all[v].index] for v in moving.ring],
                "tiled": moving.is_tiled,
            }
            for moving in vertices.bodies
        ],
        "free": list(vertices.free),
        "frame": _frame_to_json(vertices.frame),
        "counts": [certifier.made, certifier.skipped, certifier.zeros],
        "stats": {"events": dict(stats.events)} | {name: getattr(stats, name) for name in _STATS},
        "queue": [
            [slot, _time_to_json(time)]
            for slot in kinetic.queue.slots()
            if (time := kinetic.queue.pending(slot)) is not None
        ],
    }
    if isinstance(kinetic, KineticTiling):
        data["flat"] = sorted(kinetic.flat)
        data["mesh"] = _mesh_to_json(kinetic.mesh)
    if isinstance(kinetic, GreedyTiling):
        data["cells"] = {name: list(getattr(kinetic.cells, name)) for name in _CELLS}
    if isinstance(kinetic, IncrementalTiling):
        data["structure"] = _structure_to_json(kinetic.structure)
        data["chains"] = [kinetic.chains.kind, kinetic.chains.allowed]
    return data


def tiling_from_json(data: Data, bodies: Sequence[Body], *, exact_only: bool) -> Tiling:
    """The tiling with a saved state, for bodies with their motions."""
    vertices = Vertices(
        bodies,
        [[(v, index) for v, index in body["ring"]] for body in data["bodies"]],
        [parse_rational(body["since"]) for body in data["bodies"]],
        _frame_from_json(data["frame"]),
        parse_rational(data["end"]),
        data["free"],
    )
    vertices.frame.errors[:] = data["frame"]["errors"]
    for moving, body in zip(vertices.bodies, data["bodies"], strict=True):
        moving.is_tiled = body["tiled"]
    certifier = Certifier(vertices, QQ(0), parse_rational(data["end"]), exact_only=exact_only)
    certifier.move_to(_time_from_json(data["now"]), [(a, b, c) for a, b, c in data["roots_now"]])
    certifier.made, certifier.skipped, certifier.zeros = data["counts"]
    stats = Stats()
    stats.events = dict(data["stats"]["events"])
    for name in _STATS:
        setattr(stats, name, data["stats"][name])
    kinetic = _kept(data, certifier, vertices, stats)
    for slot, time in data["queue"]:
        kinetic.queue.schedule(slot, _time_from_json(time))
    return kinetic


def _kept(data: Data, certifier: Certifier, vertices: Vertices, stats: Stats) -> Tiling:
    """The tiling of the saved class, without pending certificates."""
    if data["kind"] == POINT_TILING:
        structure, chains = _structure_from_json(data["structure"]), Chains(*data["chains"])
        return IncrementalTiling(vertices, certifier, stats, structure, chains)
    kind = tiling_class(data["kind"], convex=data["convex"])
    if not issubclass(kind, KineticTiling):
        raise InputError(f"no tiling {data['kind']!r} can be restored")
    kinetic = kind(vertices, certifier, stats)
    kinetic.resume(_mesh_from_json(data["mesh"], vertices), data["flat"])
    if isinstance(kinetic, GreedyTiling):
        kinetic.cells = VerticalDecomposition(0)
        for name in _CELLS:
            setattr(kinetic.cells, name, data["cells"][name])
    return kinetic


# Numbers and times


def number_to_json(number: AlgebraicNumber) -> Data:
    """An algebraic number with its current isolating interval."""
    return {
        "polynomial": [str(c) for c in number._polynomial],
        "low": str(number._low),
        "high": str(number._high),
    }


def number_from_json(data: Data) -> AlgebraicNumber:
    """The number that `number_to_json` has written."""
    low, high = parse_rational(data["low"]), parse_rational(data["high"])
    return AlgebraicNumber.root(tuple(ZZ(c) for c in data["polynomial"]), low, high)


def _time_to_json(time: EventTime) -> Data:
    data: Data = {"low": time.low, "high": time.high, "of": [time.a, time.b, time.c]}
    if time.exact is not None:
        data["exact"] = number_to_json(time.exact)
    if not time.crossing:
        data["crossing"] = False
    return data


def _time_from_json(data: Data) -> EventTime:
    exact = number_from_json(data["exact"]) if "exact" in data else None
    low, high = float(data["low"]), float(data["high"])
    a, b, c = data["of"]
    return EventTime(low, high, a, b, c, exact, data.get("crossing", True))


def _frame_to_json(frame: Frame) -> Data:
    return {
        "center": [str(c) for c in frame.center],
        "scale": list(frame.scale),
        "origin": str(frame.origin),
        "time_scale": frame.time_scale,
        "errors": list(frame.errors),
    }


def _frame_from_json(data: Data) -> Frame:
    x, y = map(parse_rational, data["center"])
    sx, sy = data["scale"]
    return Frame((x, y), (sx, sy), parse_rational(data["origin"]), data["time_scale"])


# The mesh


def _mesh_to_json(mesh: Mesh) -> Data:
    m = mesh.map
    data: Data = {
        "origin": list(m.origin),
        "following": list(m.following),
        "previous": list(m.previous),
        "free": list(m.free),
        "region": list(mesh.region),
        "corner": [int(c) for c in mesh.corner],
        "boundary": [int(b) for b in mesh.boundary],
        "ring_edge": list(mesh.ring_edge),
    }
    if isinstance(mesh, LabelledMesh):
        data["labels"] = [sorted(label) for label in mesh.labels]
    return data


def _mesh_from_json(data: Data, vertices: Vertices) -> Mesh:
    mesh = Mesh(0)
    if "labels" in data:
        mesh = LabelledMesh(0, Forest(vertices))
        mesh.labels = [frozenset(label) for label in data["labels"]]
    mesh.map = PlanarMap.of(data["origin"], data["following"], data["previous"], data["free"])
    mesh.region = data["region"]
    mesh.corner = [bool(c) for c in data["corner"]]
    mesh.boundary = [bool(b) for b in data["boundary"]]
    mesh.ring_edge = data["ring_edge"]
    mesh.audit()
    return mesh


# The structure of points


def _structure_to_json(structure: IncrementalStructure) -> Data:
    return {
        "order": list(structure.order),
        "parents": [list(tree.parent) for tree in structure.trees],
        "steps": [tree.steps for tree in structure.trees],
    }


def _structure_from_json(data: Data) -> IncrementalStructure:
    upper, lower = data["parents"]
    structure = IncrementalStructure.of(data["order"], (upper, lower))
    for tree, steps in zip(structure.trees, data["steps"], strict=True):
        tree.steps = steps
    return structure


# Events and contacts


def event_from_json(data: Mapping[str, Any]) -> Event:
    """The event that `Event.to_json` has written."""
    removed, added = (tuple((u, v) for u, v in data[key]) for key in ("removed", "added"))
    return Event(number_from_json(data["time"]), data["kind"], removed, added)


def contact_from_json(data: Mapping[str, Any]) -> Contact:
    """The contact that `Contact.to_json` has written."""
    pairs = tuple(
        Pair(
            pair["kind"],
            pair["a"]["body"],
            pair["a"]["vertex"],
            pair["b"]["body"],
            pair["b"].get("edge"),
            pair["b"].get("vertex"),
            (pair["point"][0], pair["point"][1]),
            None if pair["normal"] is None else (pair["normal"][0], pair["normal"][1]),
        )
        for pair in data["pairs"]
    )
    overlaps = tuple((a, b) for a, b in data.get("overlaps", ()))
    return Contact(number_from_json(data["time"]), data["kind"], pairs, overlaps)
