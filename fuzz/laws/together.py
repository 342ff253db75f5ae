"""Laws about many scenes in one call: batch and arrays report what each scene has by itself."""

from __future__ import annotations

import json
from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations
from random import Random
from typing import Final, TypeAlias

import exactpt
from exactpt import Body, Contact, Polynomial, Scene, Translation
from exactpt.kernel.numbers import QQ
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.witnesses import Difference

__all__ = [
    "array_queries_are_first_contacts",
    "arrays_are_single_calls",
    "batch_is_single_calls",
]

LINES: Final = 5
"""Maximum number of scenes in a batch."""

ROWS: Final = 12
"""Maximum number of pairs in arrays."""


def batch_is_single_calls(scene: Scene, random: Random) -> str:
    """A batch of scenes, of two bodies each, has the contact of each of them."""
    pairs = list(combinations(scene.bodies, 2))
    refuse_unless(pairs)
    chosen = random.sample(pairs, min(LINES, len(pairs)))
    scenes = [Scene(two, (scene.start, scene.end)) for two in chosen]
    lines = (json.dumps(one.to_json()) for one in scenes)
    found = 0
    for one, answer in zip(scenes, exactpt.batch.answers(lines), strict=True):
        contact = exactpt.first_contact(one)
        expected = None if contact is None else _as_read(contact.to_json())
        check_equal("batch", _as_read(answer.get("contact", answer)), expected)
        found += contact is not None
    return "no contact" if found == 0 else "some contacts"


def _as_read(data: object) -> object:
    """Return JSON data as they are when they have been written and read."""
    return json.loads(json.dumps(data))


def arrays_are_single_calls(scene: Scene, random: Random) -> str:
    """First contacts in arrays of doubles are those of the scenes of two bodies."""
    bodies = [body for body in scene.bodies if _suits_arrays(body)]
    refuse_unless(len(bodies) >= 2)
    refuse_unless(_is_double(scene.exact_start) and _is_double(scene.exact_end))
    pairs = list(combinations(range(len(bodies)), 2))
    rows = random.sample(pairs, min(ROWS, len(pairs)))
    contacts = _in_arrays(scene, bodies, rows)
    outcomes = set()
    for row, (i, j) in enumerate(rows):
        expected = exactpt.first_contact(Scene([bodies[i], bodies[j]], (scene.start, scene.end)))
        if expected is not None and expected.kind == "self":
            continue  # arrays compare two bodies, and no body with itself
        _check_row(contacts, row, expected)
        outcomes.add("none" if expected is None else expected.kind)
    return ", ".join(sorted(outcomes)) or "none"


def array_queries_are_first_contacts(scene: Scene, random: Random) -> str:
    """First contacts of moving points with moving segments, in arrays, are those of the scenes."""
    bodies = [body for body in scene.bodies if _suits_arrays(body) and _is_straight(body)]
    points = [_places_of(body) for body in bodies]
    refuse_unless(points and any(len(two) > 1 for two in points))
    refuse_unless(_is_double(scene.exact_start) and _is_double(scene.exact_end))
    rows = [_a_query(points, random) for _ in range(ROWS)]
    moving = [[row[k] for row in rows] for k in range(3)]
    span = float(scene.exact_start), float(scene.exact_end)
    contacts = exactpt.arrays.point_segment_contacts(
        *[[place for place, _ in vertices] for vertices in moving],
        velocities=[[velocity for _, velocity in vertices] for vertices in moving],
        time=span,
        errors="mask",
    )
    outcomes = set()
    for row, (point, first, last) in enumerate(rows):
        if contacts.refused[row]:
            continue
        bodies = [_body("point", point), _body("segment", first, last)]
        expected = exactpt.first_contact(Scene(bodies, span))
        _check_row(contacts, row, expected)
        outcomes.add("none" if expected is None else expected.kind)
    return ", ".join(sorted(outcomes)) or "refused"


Moving: TypeAlias = tuple[tuple[float, float], tuple[float, float]]
"""A vertex in straight motion: its place at time 0, and its velocity."""


def _is_straight(body: Body) -> bool:
    assert isinstance(body.motion, Translation)  # noqa: S101 - see `_suits_arrays`
    return body.motion.x.degree <= 1 and body.motion.y.degree <= 1


def _places_of(body: Body) -> list[Moving]:
    """Return the vertices of a body in straight motion whose places at time 0 are doubles."""
    assert isinstance(body.motion, Translation)  # noqa: S101 - see `_suits_arrays`
    path = body.motion.x, body.motion.y
    found = []
    for vertex in body.vertices:
        place = [c(0) + f(0) for c, f in zip(vertex, path, strict=True)]
        if all(map(_is_double, place)):
            velocity = [float(f.coefficients[1]) if f.degree == 1 else 0.0 for f in path]
            found.append(((float(place[0]), float(place[1])), (velocity[0], velocity[1])))
    return found


def _a_query(points: list[list[Moving]], random: Random) -> tuple[Moving, Moving, Moving]:
    """Return a point and the ends of a segment: of two bodies, or ends that move apart."""
    edge = random.choice([some for some in points if len(some) > 1])
    k = random.randrange(len(edge))
    first, last = edge[k - 1], edge[k]
    others = [vertex for some in points if some is not edge for vertex in some] or edge
    if random.random() < 0.3:
        last = random.choice(others)
    return random.choice(others), first, last


def _body(name: str, *vertices: Moving) -> Body:
    """Return a point or a segment whose vertices have velocities of their own."""
    tracks = [
        [Polynomial([Fraction(x), Fraction(u)]) for x, u in zip(place, velocity, strict=True)]
        for place, velocity in vertices
    ]
    return Body(name, [(x, y) for x, y in tracks], closed=False)


def _suits_arrays(body: Body) -> bool:
    """Return True if a body is a row of an array: it translates, and its numbers are doubles."""
    if not isinstance(body.motion, Translation) or body.has_rings or body.keyframes:
        return False
    if any(f.degree > 0 for vertex in body.vertices for f in vertex):
        return False
    return all(_is_double(number) for number in _numbers(body))


def _numbers(body: Body) -> Iterator[QQ]:
    yield body.exact_radius
    for vertex in body.vertices:
        for coordinate in vertex:
            yield from coordinate.coefficients
    assert isinstance(body.motion, Translation)  # noqa: S101 - see `_suits_arrays`
    for path in (body.motion.x, body.motion.y):
        yield from path.coefficients


def _is_double(number: QQ) -> bool:
    try:
        return Fraction(float(number)) == Fraction(str(number))
    except OverflowError:  # beyond all doubles
        return False


def _in_arrays(
    scene: Scene, bodies: list[Body], rows: list[tuple[int, int]]
) -> exactpt.arrays.Contacts:
    paths = [
        [list(map(float, path.coefficients)) for path in (body.motion.x, body.motion.y)]
        for body in bodies
        if isinstance(body.motion, Translation)
    ]
    length = max(1, *(len(path) for two in paths for path in two))
    coefficients = [[path + [0.0] * (length - len(path)) for path in two] for two in paths]
    vertices = [[float(c(0)) for c in vertex] for body in bodies for vertex in body.vertices]
    offsets = [0]
    for body in bodies:
        offsets.append(offsets[-1] + body.size)
    return exactpt.arrays.first_contacts(
        vertices,
        offsets,
        rows,
        coefficients=coefficients,
        closed=[body.closed for body in bodies],
        radii=[float(body.exact_radius) for body in bodies],
        time=(float(scene.exact_start), float(scene.exact_end)),
        errors="mask",
    )


def _check_row(contacts: exactpt.arrays.Contacts, row: int, expected: Contact | None) -> None:
    found = contacts.contact(row)
    if found is None or expected is None:
        if found is not expected:
            raise Difference("arrays", f"{found}, not {expected}")
        return
    check_equal(
        "arrays",
        (found.time, found.kind, len(found.pairs)),
        (expected.time, expected.kind, len(expected.pairs)),
    )
    low, high = QQ(float(contacts.low[row])), QQ(float(contacts.high[row]))
    if expected.time.compare_rational(low) < 0 or expected.time.compare_rational(high) > 0:
        raise Difference("enclosure", f"{expected.time} is not in [{low}, {high}]")
