"""The state of a running tiling as JSON data, exactly, and back.

Everything that influences later decisions is saved: half-edges with their handles, pending
failures with their enclosures, and exact numbers. A restored run therefore takes the same steps as
the saved one would have.

A comparison refines the isolating intervals of two numbers, and may recognise them as rational. It
may be one of a user, who compares the time of the run; and a restored queue is filled by other
comparisons than those that the run has made. So numbers are written in a canonical form, on which
their refinements have no influence.

Rationals are texts ``"p/q"``; doubles are JSON numbers (which Python writes and reads
exactly); exact times are ``{"polynomial", "low", "high"}``.

A file may be forged, with a valid checksum. Each value is therefore read by a method of `Stored`,
which checks its type and range. No number of a file is taken as an exponent: those of the
normalisation are computed from rationals, whose digits are in the file. A forged state may still
break an invariant of the run, but neither the interpreter nor a budget.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import zip_longest
from typing import Any, Final, TypeAlias

from exactpt.certificates.certifier import X_ORDER, Certifier
from exactpt.certificates.queue import LARGEST, EventTime
from exactpt.errors import InputError
from exactpt.indices import CertificateId, VertexId
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.integer_polynomial import sign_at, square_free
from exactpt.kernel.numbers import QQ, shorten, show
from exactpt.kernel.stored import Stored
from exactpt.kernel.sturm import count_roots, sturm_sequence
from exactpt.motion.body import Body
from exactpt.motion.infinitesimal import ring_of_copies
from exactpt.motion.normalization import Normalization, Reach, normalization_of
from exactpt.motion.tileable import refuse_untileable
from exactpt.motion.vertices import Vertices
from exactpt.pair.contact import Contact, ContactPoint
from exactpt.simulation.event import RunEvent
from exactpt.tiling import catalogue
from exactpt.tiling.catalogue import Bodies, Entry
from exactpt.tiling.events import Stats
from exactpt.tiling.start import make
from exactpt.tiling.tiling import Tiling

Data: TypeAlias = "dict[str, Any]"
"""A JSON object that is written."""

_STATS: Final = ("batches", "rebuilds", "flips", "most")
_CERTIFICATE_COUNTS: Final = ("made", "skipped", "zeros")
_CONTACT_KINDS: Final = ("initial", "self", "vertex-edge", "vertex-vertex")


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
        "frame": _frame_to_json(vertices),
        "counts": {name: getattr(certifier, name) for name in _CERTIFICATE_COUNTS},
        "stats": {"events": dict(stats.events)} | {name: getattr(stats, name) for name in _STATS},
        "queue": [
            [slot, _time_to_json(time)]
            for slot in kinetic.queue.slots()
            if (time := kinetic.queue.pending(slot)) is not None
        ],
    }
    return {**data, **kinetic.state()}


def tiling_from_json(data: Stored, bodies: Sequence[Body], last: QQ, *, exact_only: bool) -> Tiling:
    """Return the tiling with a saved state, for bodies with their motions, up to the ``last`` time.

    Raises:
        InputError: if a value is not what `tiling_to_json` writes, or contradicts the bodies or
            the time span, or no tiling can hold the bodies.
    """
    refuse_untileable(bodies)
    end = data["end"].rational()
    if end != last:
        raise InputError(f"the tiling ends at t = {show(end)}, not {show(last)}")
    entry = _entry_from_json(data, bodies)
    vertices = _vertices_from_json(data, entry, bodies, end)
    certifier = Certifier(vertices, QQ(0), end, exact_only=exact_only)
    now = _time_from_json(data["now"], vertices)
    certifier.move_to(now, _roots_from_json(data["roots_now"], now, len(vertices.all)))
    _check_pieces(data["bodies"], vertices, now)
    for name in _CERTIFICATE_COUNTS:
        setattr(certifier, name, data["counts"][name].integer(0))
    fan = "fan" in data
    if fan and not entry.has_fan:
        raise data["fan"].refused(f"no fan, which the {entry.name} tiling does not have")
    kinetic = make(entry, vertices, certifier, _stats_from_json(data["stats"]), fan=fan)
    kinetic.resume(data)
    for item in data["queue"].entries():
        check_budget()
        slot, time = item.entries(2)
        certificate = CertificateId(slot.integer(0))
        if not kinetic.has_part(certificate):
            raise slot.refused("a certificate of this tiling")
        if kinetic.queue.pending(certificate) is not None:
            raise slot.refused("a certificate that is in the queue once")
        kinetic.queue.schedule(certificate, _time_from_json(time, vertices))
    return kinetic


def _entry_from_json(data: Stored, bodies: Sequence[Body]) -> Entry:
    """Return the entry of a saved tiling in the catalogue."""
    kind = data["kind"].text(catalogue.known())
    entry = catalogue.find(kind, convex=data["convex"].flag())
    if entry.bodies is Bodies.POINTS and any(body.size > 1 for body in bodies):
        raise data["kind"].refused("a tiling of these bodies, which are not all points")
    return entry


# Vertices


def _vertices_from_json(data: Stored, entry: Entry, bodies: Sequence[Body], end: QQ) -> Vertices:
    """Return the moving vertices of a saved tiling."""
    saved = data["bodies"].entries(len(bodies))
    are_points = entry.bodies is Bodies.POINTS
    rings = [
        _ring_from_json(item["ring"], body, are_points=are_points)
        for item, body in zip(saved, bodies, strict=True)
    ]
    free = data["free"].integers(0)
    ids = sorted([*(v for ring in rings for v, _ in ring), *free])
    if ids != list(range(len(ids))):
        raise InputError("a vertex is there twice, or not at all")
    vertices = Vertices(
        bodies,
        rings,
        [item["since"].rational() for item in saved],
        _normalization_from_json(data["frame"]),
        end,
        list(map(VertexId, free)),
    )
    # The bounds only grow, with the bodies that have come and gone: smaller ones are forged.
    known = vertices.enclosures.errors
    errors = [e.double(least=0.0, most=LARGEST) for e in data["frame"]["errors"].entries()]
    known[:] = [max(pair) for pair in zip_longest(known, errors, fillvalue=0.0)]
    for moving, item in zip(vertices.bodies, saved, strict=True):
        moving.is_tiled = item["tiled"].flag()
    return vertices


def _ring_from_json(data: Stored, body: Body, *, are_points: bool) -> list[tuple[VertexId, int]]:
    """Return the ring of a body: ids, each with its vertex in the scene.

    Raises:
        InputError: if its vertices are not those of the body, in the order of its rings.
    """
    pairs = data.pairs(0)
    indices = [index for _, index in pairs]
    if are_points:
        fits = indices == [0]
    elif body.has_interior:
        fits = len(indices) == body.size and all(
            indices[ring.start : ring.stop] in (list(ring), list(ring)[::-1]) for ring in body.rings
        )
    else:
        fits = indices == ring_of_copies(body.size)
    if not fits:
        raise data.refused(f"the vertices of body {shorten(body.name)} in order")
    return [(VertexId(v), index) for v, index in pairs]


def _check_pieces(data: Stored, vertices: Vertices, now: EventTime) -> None:
    """Check that each body is in the piece of its motion that it has now.

    Raises:
        InputError: if one has entered it later, or its end is over.
    """
    normalization = vertices.normalization
    for item, moving in zip(data.entries(), vertices.bodies, strict=True):
        entered = normalization.time(moving.since)[0] <= now.high
        left = moving.until is not None and normalization.time(moving.until)[1] < now.low
        if not entered or left:
            raise item["since"].refused("the start of the piece of motion now")


def _frame_to_json(vertices: Vertices) -> Data:
    """Return the numbers that determine the normalisation, and the bounds on errors in it."""
    reach = vertices.normalization.reach
    if reach is None:
        raise InputError("the normalisation of this tiling was not chosen for a scene")
    numbers = {name: list(map(str, pair)) for name, pair in reach._asdict().items()}
    return {**numbers, "errors": list(vertices.enclosures.errors)}


def _normalization_from_json(data: Stored) -> Normalization:
    """Return the normalisation for the saved numbers.

    Raises:
        InputError: if there are no such numbers; the two of a pair must not decrease.
    """
    data.with_keys("x", "y", "span", "errors")
    pairs: dict[str, tuple[QQ, QQ]] = {}
    for name in Reach._fields:
        first, second = (entry.rational() for entry in data[name].entries(2))
        if first > second:
            raise data[name].refused("two numbers that do not decrease")
        pairs[name] = first, second
    return normalization_of(Reach(**pairs))


# Counts


def _stats_from_json(data: Stored) -> Stats:
    stats = Stats()
    stats.events = counts_from_json(data["events"])
    for name in _STATS:
        setattr(stats, name, data[name].integer(0))
    return stats


def counts_from_json(data: Stored) -> dict[str, int]:
    """Return counts by the names of what is counted."""
    return {name: count.integer(0) for name, count in data.members()}


# Numbers and times


def number_to_json(number: AlgebraicNumber) -> Data:
    """Return an algebraic number in a canonical form: the same, however far it is refined."""
    number.simplified()  # in place: a rational number has another polynomial
    low, high = number.exact_canonical_interval()
    return {
        "polynomial": [str(c) for c in number.exact_polynomial],
        "low": str(low),
        "high": str(high),
    }


def number_from_json(data: Stored) -> AlgebraicNumber:
    """Return the number that `number_to_json` has written.

    Raises:
        InputError: if the polynomial has not just one root in the interval: refinements of it
            would not end.
    """
    low, high = data["low"].rational(), data["high"].rational()
    f = tuple(entry.big_integer() for entry in data["polynomial"].entries())
    is_polynomial = len(f) > 1 and f[-1] != 0
    if low == high:
        isolated = is_polynomial and sign_at(f, low) == 0
    else:
        simple = is_polynomial and len(square_free(f)) == len(f)
        isolated = simple and low < high and count_roots(sturm_sequence(f), low, high) == 1
    if not isolated:
        raise data.refused("a polynomial with one root between low and high")
    return AlgebraicNumber.root(f, low, high)


def _time_to_json(time: EventTime) -> Data:
    data: Data = {"low": time.low, "high": time.high, "of": [time.a, time.b, time.c]}
    if time.exact is not None:
        data["exact"] = number_to_json(time.exact)
    if not time.crossing:
        data["crossing"] = False
    return data


def _time_from_json(data: Stored, vertices: Vertices) -> EventTime:
    """Return a time of an event.

    Raises:
        InputError: if the enclosure is none, does not contain the exact time, or there is
            neither an exact time nor a function of vertices whose root it is.
    """
    data.with_keys("low", "high", "of", optional=("exact", "crossing"))
    low = data["low"].double()
    high = data["high"].double(least=low)
    exact = number_from_json(data["exact"]) if "exact" in data else None
    crossing = "crossing" not in data or data["crossing"].flag()
    if exact is None:
        a, b, c = _vertices_of_time(data["of"], len(vertices.all))
        if not (math.isfinite(low) and math.isfinite(high)):
            raise data.refused("a finite enclosure, or an exact time")
    else:
        a, b, c = data["of"].integers(-1, len(vertices.all) - 1, length=3)
        normalization = vertices.normalization
        is_before = normalization.time(exact.exact_high)[1] < low
        if is_before or normalization.time(exact.exact_low)[0] > high:
            raise data["exact"].refused("a time between low and high")
    return EventTime(low, high, a, b, c, exact, crossing)


def _roots_from_json(data: Stored, now: EventTime, count: int) -> list[EventTime]:
    """Return the times of the functions that vanish now."""
    triples = [item.integers(-1, count - 1, length=3) for item in data.entries()]
    return [EventTime(now.low, now.high, a, b, c) for a, b, c in triples]


def _vertices_of_time(data: Stored, count: int) -> tuple[int, int, int]:
    """Return the ids of the vertices of a function; the last one is `X_ORDER` for an x-order."""
    first, second, third = data.entries(3)
    a, b = first.integer(0, count - 1), second.integer(0, count - 1)
    return a, b, third.integer(int(X_ORDER), count - 1)


# Events and contacts


def event_from_json(data: Stored) -> RunEvent:
    """Return the event that `RunEvent.to_json` has written."""
    removed, added = (
        tuple(_names_from_json(edge) for edge in data[key].entries())
        for key in ("removed", "added")
    )
    return RunEvent(number_from_json(data["time"]), data["kind"].text(), removed, added)


def contact_from_json(data: Stored, bodies: Sequence[Body]) -> Contact:
    """Return the contact of bodies that `Contact.to_json` has written."""
    by_name = {body.name: body for body in bodies}
    pairs = tuple(_pair_from_json(pair, by_name) for pair in data["pairs"].entries())
    initial_pairs: tuple[tuple[str, str], ...] = ()
    if "overlaps" in data:
        initial_pairs = tuple(
            _names_from_json(pair, by_name) for pair in data["overlaps"].entries()
        )
    kind = data["kind"].text(_CONTACT_KINDS)
    return Contact(number_from_json(data["time"]), kind, pairs, initial_pairs)


def _pair_from_json(data: Stored, bodies: Mapping[str, Body]) -> ContactPoint:
    """Return the incidence that `ContactPoint.to_json` has written."""
    a, b = data["a"], data["b"]
    body, other = _body_from_json(a["body"], bodies), _body_from_json(b["body"], bodies)
    edge = b["edge"].integer(0, other.size - 1) if "edge" in b else None
    other_vertex = None if edge is not None else b["vertex"].integer(0, other.size - 1)
    normal = data["normal"]
    return ContactPoint(
        data["kind"].text(_CONTACT_KINDS),
        body.name,
        a["vertex"].integer(0, body.size - 1),
        other.name,
        edge,
        other_vertex,
        _doubles_from_json(data["point"]),
        None if normal.is_null else _doubles_from_json(normal),
    )


def _body_from_json(data: Stored, bodies: Mapping[str, Body]) -> Body:
    name = data.text()
    if name not in bodies:
        raise data.refused("the name of a body")
    return bodies[name]


def _names_from_json(data: Stored, known: Mapping[str, Body] | None = None) -> tuple[str, str]:
    """Return a pair of names; of known bodies, if those are given."""
    first, second = data.entries(2)
    if known is not None:
        return _body_from_json(first, known).name, _body_from_json(second, known).name
    return first.text(), second.text()


def _doubles_from_json(data: Stored) -> tuple[float, float]:
    x, y = (entry.double(least=-LARGEST, most=LARGEST) for entry in data.entries(2))
    return x, y
