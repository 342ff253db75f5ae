"""Queries in space of small integers, compared with their definition."""

from __future__ import annotations

from fractions import Fraction
from random import Random

from exactpt.testing.space import SpaceContact, SpaceQuery, edge_edge, vertex_face
from exactpt.testing.space.vectorized import edge_edge_array, vertex_face_array
from fuzz.references import space as reference

__all__ = ["small_query", "space_kind", "wrong_in_space"]

Points = list[list[int]]


def small_query(random: Random) -> SpaceQuery:
    """Return a query of small integers, most of them degenerate or near a contact."""
    is_face = random.random() < 0.5
    style = random.choice(["any", "meeting", "near", "near", "plane", "graze", "degenerate"])
    size = random.choice([1, 2, 3])
    start, end = _points(random, size), _points(random, size)
    if style in ("meeting", "near", "degenerate"):
        start, end = _meeting(random, is_face, start, end)
    if style == "near":
        start[0][random.randrange(3)] += random.choice([1, -1])
    if style == "plane":
        for p in start + end:
            p[2] = 0
    if style == "graze":
        start, end = _grazing(random, is_face)
    if style == "degenerate":
        i, j = random.choice([(2, 3), (2, 3), (1, 2)] if is_face else [(2, 3), (0, 1)])
        start[j], end[j] = list(start[i]), list(end[i])
    i, j = random.sample(range(3), 2)
    shear = random.choice([0, 1, -1])
    for p in start + end:
        p[i] += shear * p[j]
    rows = [
        tuple((float(p[0]), float(p[1]), float(p[2])) for p in points) for points in (start, end)
    ]
    return SpaceQuery("vertex-face" if is_face else "edge-edge", rows[0], rows[1])


def _points(random: Random, size: int) -> Points:
    return [[random.randint(-size, size) for _ in range(3)] for _ in range(4)]


def _meeting(random: Random, is_face: bool, start: Points, end: Points) -> tuple[Points, Points]:  # noqa: FBT001
    """Return points of which the first is on the others' hull (or edges cross) at some time."""
    t = random.randint(1, 4)  # of 4
    places, speeds = start, end
    if is_face:
        places[0] = [0, 0, 0]
        places[3] = [-a - b for a, b in zip(places[1], places[2], strict=True)]
    else:
        places[1] = [-c for c in places[0]]
        places[3] = [-c for c in places[2]]
    return tuple(  # type: ignore[return-value]  # a tuple of two
        [
            [c + (now - t) * v for c, v in zip(p, w, strict=True)]
            for p, w in zip(places, speeds, strict=True)
        ]
        for now in (0, 4)
    )


def _grazing(random: Random, is_face: bool) -> tuple[Points, Points]:  # noqa: FBT001
    """Return points whose cubic has a double root at a contact."""
    t, size = random.randint(1, 3), random.randint(2, 4)

    def at(slope: int) -> Points:
        if is_face:
            corners = [(-size, -size), (size, -size), (0, size)]
            return [[slope, 0, 0], *[[4 * x, 4 * y, slope * x] for x, y in corners]]
        ends = [[-4 * size, 0, -size * slope], [4 * size, 0, size * slope]]
        return [*ends, [slope, -size, 0], [slope, size, 0]]

    return at(-t), at(4 - t)


def wrong_in_space(query: SpaceQuery) -> tuple[str, str | None]:
    """Return the class of a query, and how its answers differ from the definition, or None."""
    points = [[[int(c) for c in p] for p in points] for points in (query.start, query.end)]
    is_face = query.kind == "vertex-face"
    contact = (vertex_face if is_face else edge_edge)(*points)
    expected = reference.first_contact(query.kind, *points)
    rows = (vertex_face_array if is_face else edge_edge_array)([query.start + query.end])
    kind = space_kind(query.kind, points, expected)
    if bool(rows.hit[0]) != (expected is not None):
        return kind, f"the array says {bool(rows.hit[0])}"
    if contact is None or expected is None:
        same = contact is None and expected is None
        return kind, None if same else f"{contact!r}, not {expected}"
    if not rows.low[0] <= contact.time <= rows.high[0]:
        return kind, f"{contact!r} is not in [{rows.low[0]}, {rows.high[0]}]"
    return kind, _wrong_contact(query, points, contact, expected)


def _wrong_contact(
    query: SpaceQuery, points: list[Points], contact: SpaceContact, expected: reference.Moment
) -> str | None:
    exact = expected.rational
    if exact is None:
        low, high = contact.time.enclosure()
        ball = expected.enclosure()
        is_root = tuple(map(int, expected.polynomial.coeffs())) in (
            contact.time.minimal_polynomial(),
            tuple(-c for c in contact.time.minimal_polynomial()),
        )
        return None if is_root and low < ball < high else f"{contact!r}, not {expected}"
    if contact.time != exact:
        return f"{contact!r}, not t = {exact}"
    least = reference.least_coordinates(query.kind, points[0], points[1], expected)
    found = tuple(Fraction(*c.as_integer_ratio()) for c in contact.coordinates)
    return None if found == least else f"coordinates {found}, not {least}"


def space_kind(kind: str, points: list[Points], moment: reference.Moment | None) -> str:
    """Return the class of a query for the table: when, and how degenerate."""
    rational = None if moment is None else moment.rational
    when = (
        "never" if moment is None else "at a rational time" if rational else "at an irrational time"
    )
    if rational == 0:
        when = "at the start"
    return f"{kind}, {when}, {_degeneracy(kind, points, moment)}"


def _degeneracy(kind: str, points: list[Points], moment: reference.Moment | None) -> str:
    """Return a word on the face or edges at all times and at the contact, and on the root."""
    pairs = [(2, 1), (3, 1), (3, 2)] if kind == "vertex-face" else [(1, 0), (3, 2)]
    if any(all(p[i] == p[j] for p in points) for i, j in pairs):
        return "degenerate"
    determinant = reference.coplanarity(kind, *points)
    if not determinant:
        return "always coplanar"
    if moment is not None and moment.sign(determinant.derivative()) == 0:
        return "multiple root"
    return "simple"
