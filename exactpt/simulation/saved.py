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

from exactpt.certificates.certificate import KIND_COUNT
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventTime
from exactpt.errors import InputError
from exactpt.indices import VertexId
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import sign_at, square_free
from exactpt.kernel.numbers import QQ, ZZ, parse_rational, shorten, show
from exactpt.kernel.sturm import count_roots, sturm_sequence
from exactpt.motion.body import Body
from exactpt.motion.normalization import Normalization
from exactpt.motion.vertices import Vertices
from exactpt.pairs.contact import Contact, Pair
from exactpt.simulation.event import Event
from exactpt.tiling import catalogue
from exactpt.tiling.events import Stats
from exactpt.tiling.start import make
from exactpt.tiling.tiling import Tiling

Data: TypeAlias = "dict[str, Any]"
"""A JSON object that has been read; defects are detected where it is used."""

_STATS = ("batches", "rebuilds", "flips", "most")

_SLOTS = 64 * KIND_COUNT
"""A bound, a vertex, on the slots of a queue (which has room for all up to the largest): 64 parts
of each kind; a planar map of n vertices has less than 6 n half-edges."""


def tiling_to_json(kinetic: Tiling) -> Data:
    """Return the state of a tiling between two events."""
    certifier, stats, vertices = kinetic.certifier, kinetic.stats, kinetic.vertices
    if certifier.now.exact is None:
        certifier.resolve(certifier.now)  # the same file, whether or not it was computed before
    data: Data = {
        "kind": kinetic.name,
        "convex": kinetic.entry.is_for_convex,
        "end": str(certifier.end),
        "now": _time_to_json(certifier.now),
        "roots_now": [[t.a, t.b, t.c] for t in certifier.roots_now],
        "bodies": [
            {
                "since": str(moving.since),
                "ring": [[v, vertices.all[v].index] for v in moving.ring],
                "tiled": moving.is_tiled,
            }
            for moving in vertices.bodies
        ],
        "free": list(vertices.free),
        "frame": _normalization_to_json(vertices.normalization)
        | {"errors": list(vertices.enclosures.errors)},
        "counts": [certifier.made, certifier.skipped, certifier.zeros],
        "stats": {"events": dict(stats.events)} | {name: getattr(stats, name) for name in _STATS},
        "queue": [
            [slot, _time_to_json(time)]
            for slot in kinetic.queue.slots()
            if (time := kinetic.queue.pending(slot)) is not None
        ],
    }
    return {**data, **kinetic.state()}


def _rings_from_json(data: Data, bodies: Sequence[Body]) -> list[list[tuple[VertexId, int]]]:
    """Return the ring of each body: ids, every one used once, each with its vertex in the scene."""
    rings = [[(v, index) for v, index in body["ring"]] for body in data["bodies"]]
    ids = sorted([*(v for ring in rings for v, _ in ring), *data["free"]])
    if ids != list(range(len(ids))):
        raise InputError("a vertex is there twice, or not at all")
    for body, ring in zip(bodies, rings, strict=True):
        if {index for _, index in ring} != set(range(body.size)):
            raise InputError(f"not the vertices of body {shorten(body.name)}")
    return rings


def tiling_from_json(data: Data, bodies: Sequence[Body], last: QQ, *, exact_only: bool) -> Tiling:
    """Return the tiling with a saved state, for bodies with their motions, up to the ``last`` time.

    Raises:
        InputError: if the state is of another time span, which the run would take for its own, or
            does not have the vertices of the bodies.
    """
    if parse_rational(data["end"]) != last:
        raise InputError(f"the tiling ends at t = {shorten(data['end'])[1:-1]}, not {show(last)}")
    vertices = Vertices(
        bodies,
        _rings_from_json(data, bodies),
        [parse_rational(body["since"]) for body in data["bodies"]],
        _normalization_from_json(data["frame"]),
        parse_rational(data["end"]),
        data["free"],
    )
    vertices.enclosures.errors[:] = data["frame"]["errors"]
    for moving, body in zip(vertices.bodies, data["bodies"], strict=True):
        moving.is_tiled = body["tiled"]
    certifier = Certifier(vertices, QQ(0), parse_rational(data["end"]), exact_only=exact_only)
    now = _time_from_json(data["now"])
    roots = [EventTime(now.low, now.high, a, b, c) for a, b, c in data["roots_now"]]
    certifier.move_to(now, roots)
    certifier.made, certifier.skipped, certifier.zeros = data["counts"]
    stats = Stats()
    stats.events = dict(data["stats"]["events"])
    for name in _STATS:
        setattr(stats, name, data["stats"][name])
    entry = catalogue.find(data["kind"], convex=data["convex"])
    kinetic = make(entry, vertices, certifier, stats)
    kinetic.resume(data)
    most = _SLOTS * (len(vertices.all) + 1)
    for slot, time in data["queue"]:
        if not 0 <= slot < most:
            raise InputError(f"not a certificate: {shorten(slot)}")
        kinetic.queue.schedule(slot, _time_from_json(time))
    return kinetic


# Numbers and times


def number_to_json(number: AlgebraicNumber) -> Data:
    """Return an algebraic number with its current isolating interval."""
    return {
        "polynomial": [str(c) for c in number._polynomial],
        "low": str(number._low),
        "high": str(number._high),
    }


def number_from_json(data: Data) -> AlgebraicNumber:
    """Return the number that `number_to_json` has written.

    Raises:
        InputError: if the polynomial has not just one root in the interval: refinements of it
            would not end.
    """
    low, high = parse_rational(data["low"]), parse_rational(data["high"])
    f = tuple(ZZ(c) for c in data["polynomial"])
    if low == high:
        isolated = sign_at(f, low) == 0
    else:
        simple = len(f) > 1 and len(square_free(f)) == len(f)
        isolated = simple and low < high and count_roots(sturm_sequence(f), low, high) == 1
    if not isolated:
        raise InputError(f"no root of its polynomial: {shorten(data)}")
    return AlgebraicNumber.root(f, low, high)


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


def _normalization_to_json(normalization: Normalization) -> Data:
    return {
        "center": [str(c) for c in normalization.center],
        "scale": list(normalization.scale),
        "origin": str(normalization.origin),
        "time_scale": normalization.time_scale,
    }


def _normalization_from_json(data: Data) -> Normalization:
    x, y = map(parse_rational, data["center"])
    sx, sy = data["scale"]
    return Normalization((x, y), (sx, sy), parse_rational(data["origin"]), data["time_scale"])


# Events and contacts


def event_from_json(data: Mapping[str, Any]) -> Event:
    """Return the event that `Event.to_json` has written."""
    removed, added = (tuple((u, v) for u, v in data[key]) for key in ("removed", "added"))
    return Event(number_from_json(data["time"]), data["kind"], removed, added)


def contact_from_json(data: Mapping[str, Any]) -> Contact:
    """Return the contact that `Contact.to_json` has written."""
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
