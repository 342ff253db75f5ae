"""Laws by CGAL's own code: intersections, distances, hulls, faces and unions at rational times.

docs/cgal.md has the functions of CGAL that are called, and what is C++ of this project.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations, pairwise
from random import Random
from typing import Final, TypeAlias

import exactpt
from exactpt import (
    AlgebraicNumber,
    Body,
    Contact,
    ContactPoint,
    FreeSpace,
    InputError,
    Scene,
)
from exactpt.cgal import BodyShape, PlacedBody, Relation
from exactpt.kernel.numbers import Rational, fraction
from exactpt.testing import reference
from exactpt.testing.agreement import plain
from exactpt.testing.reference import Nearest, Place
from exactpt.testing.reference.space import Places, Point
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.questions import a_time, two_names
from fuzz.laws.space import a_space, some_point
from fuzz.questions.by_cgal import DifferError, are_within, witness
from fuzz.witnesses import Difference, LeftOutError, contact_by, tilings_of

__all__ = [
    "contacts_are_confirmed",
    "distances_are_confirmed",
    "first_contact_is_confirmed",
    "spaces_are_confirmed",
    "unions_are_confirmed",
]

TIMES: Final = 2
"""Number of random times of a case, beside those near a contact."""

POINTS: Final = 4
"""Number of points, and of segments between them, in a case about the free space."""

FEATURES: Final = 40
"""Maximum product of the numbers of vertices of two bodies whose signs CGAL decides."""

NEAR: Final = Fraction(1, 2**64)
"""A time next to a rational time of a contact is so far from it, in parts of the time span."""

REJECTED: Final = "cgal_check: "
"""Beginning of the message about a body that CGAL rejects; that about a bad request is another."""

Pair: TypeAlias = frozenset[str]
PointLike: TypeAlias = Sequence[Rational]


class _NotValidError(Exception):
    """CGAL has no answer: a body that deforms has crossed or touched itself."""


# Two bodies at a time


def _relation(a: PlacedBody, b: PlacedBody) -> Relation:
    try:
        return witness().relate(a, b)
    except InputError as error:
        if str(error).startswith(REJECTED):
            raise _NotValidError from None
        raise


def _relation_at(a: Body, b: Body, time: Fraction) -> Relation:
    placed, other = PlacedBody.of_body(a, time), PlacedBody.of_body(b, time)
    _check_rings(placed)
    _check_rings(other)
    return _relation(placed, other)


def _check_rings(body: PlacedBody) -> None:
    """Raise unless the holes of a body are in its outlines, and no holes or parts overlap."""
    for rings in body.shape.parts:
        outline, *holes = (_placed([body.points[i] for i in ring]) for ring in rings)
        _check_apart(holes)
        if not witness().check_union([outline, *holes], outline).ok:
            raise _NotValidError
    _check_apart([_part(body, rings) for rings in body.shape.parts])


def _part(body: PlacedBody, rings: Sequence[Sequence[int]]) -> PlacedBody:
    """Return a part of a body, with its holes, as a body of its own."""
    points = [body.points[i] for ring in rings for i in ring]
    numbers = iter(range(len(points)))
    renumbered = [[next(numbers) for _ in ring] for ring in rings]
    return PlacedBody(BodyShape("part", len(points), parts=[renumbered]), points)


def _check_apart(bodies: list[PlacedBody]) -> None:
    """Raise if the interiors of two bodies overlap."""
    if any(_relation(one, other).do_overlap for one, other in combinations(bodies, 2)):
        raise _NotValidError


def _touch(a: Body, b: Body, time: Fraction) -> bool:
    """Return True if CGAL says that two bodies share a point at a time, with their radii."""
    found = _relation_at(a, b, time)
    reach = a.radius + b.radius
    check_equal("distance 0 and no common point", found.squared == 0, found.do_intersect)
    if found.do_overlap and not found.do_intersect:
        raise Difference("CGAL against CGAL", f"{found} at {time}")
    return found.squared <= reach**2


def _pairs_that_touch(scene: Scene, time: Fraction) -> set[Pair]:
    """Return the names of all pairs of bodies that share a point at a time, by CGAL."""
    return {
        frozenset({a.name, b.name}) for a, b in combinations(scene.bodies, 2) if _touch(a, b, time)
    }


def _before(scene: Scene, time: AlgebraicNumber) -> Fraction:
    """Return a rational time just before an exact time, or the start."""
    low, _ = time.canonical_interval()
    near = low if time > low else low - NEAR * (scene.end - scene.start)
    return max(near, scene.start)


def _after(scene: Scene, time: AlgebraicNumber) -> Fraction:
    """Return a rational time just after an exact time, or the end."""
    _, high = time.canonical_interval()
    near = high if time < high else high + NEAR * (scene.end - scene.start)
    return min(near, scene.end)


# The first contact


def first_contact_is_confirmed(scene: Scene, random: Random) -> str:
    """By CGAL no bodies share a point before a first contact, those named at it, and none more.

    At an irrational time it decides at rational times on both sides, and the signs of polynomials
    at that time: by these the named bodies share a point.
    """
    refuse_unless(len(scene.bodies) >= 2 and not scene.ignoring)
    contact = contact_by(scene, random.choice(["auto", "pairs", *tilings_of(scene)]))
    try:
        _check_nothing_before(scene, contact, random)
        if contact is None:
            return "no contact"
        is_rational = contact.time.canonical_interval()[0] == contact.time
        if is_rational:
            _check_at(scene, contact)
        else:
            _check_signs_at(scene, contact)
        followed = _check_after(scene, contact, random)
    except _NotValidError:
        refuse_unless(not scene.has_radius)  # one with a radius may touch itself before
        raise Difference("not valid", f"a body, not after {contact}") from None
    return f"{contact.kind}, {'' if is_rational else 'ir'}rational, {followed}"


def _check_nothing_before(scene: Scene, contact: Contact | None, random: Random) -> None:
    times = {fraction(a_time(scene, random, 16)) for _ in range(TIMES)}
    if contact is None:
        times.add(scene.end)
    else:
        times = {time for time in times if contact.time > time}
        before = _before(scene, contact.time)
        times |= {before} if contact.time > before else set()
    for time in sorted(times):
        touching = _pairs_that_touch(scene, time)
        if touching:
            raise Difference("contact before the first", f"{_names(touching)} at {time}")


def _check_at(scene: Scene, contact: Contact) -> None:
    """Check a contact at a rational time: the pairs of bodies, and every incidence."""
    time = contact.time.canonical_interval()[0]
    for incidence in contact.pairs:
        _check_incidence(scene, incidence, time)
    if any(incidence.body == incidence.other for incidence in contact.pairs):
        return  # a body that touches itself is not simple
    found, expected = _pairs_that_touch(scene, time), _named_pairs(contact)
    if found != expected:
        raise Difference("pairs", f"{_names(expected)} at {time}, by CGAL {_names(found)}")
    if contact.kind != "initial":
        for a, b in (map(scene.body, sorted(names)) for names in found):
            relation = _relation_at(a, b, time)
            if relation.do_overlap or relation.squared != (a.radius + b.radius) ** 2:
                raise Difference("overlap at the first contact", f"{a}, {b}: {relation}")


def _check_signs_at(scene: Scene, contact: Contact) -> None:
    """Check the pairs of a contact at an irrational time by the signs of polynomials there."""
    for names in _named_pairs(contact):
        if len(names) == 1:
            continue  # a body that touches itself
        a, b = map(scene.body, sorted(names))
        if a.size * b.size > FEATURES:
            continue
        squared = (a.exact_radius + b.exact_radius) ** 2
        try:
            is_contact = are_within(a, b, squared, contact.time, scene.exact_start)
        except DifferError as error:
            raise Difference("sign by CGAL", str(error)) from None
        if not is_contact:
            raise Difference("no contact by signs", f"{a}, {b} at {contact.time!r}")


def _check_incidence(scene: Scene, incidence: ContactPoint, time: Fraction) -> None:
    """Check that a vertex and the feature it touches are as far apart as the radii say."""
    a, b = scene.body(incidence.body), scene.body(incidence.other)
    vertex = _placed_feature(a, Place(incidence.vertex, None), time)
    touched = _placed_feature(b, Place(incidence.other_vertex, incidence.edge), time)
    reach = a.radius + b.radius if a is not b else Fraction(0)
    if _relation(vertex, touched).squared != reach**2:
        raise Difference("incidence", f"{incidence} at {time}")


def _placed_feature(body: Body, place: Place, time: Fraction) -> PlacedBody:
    """Return a vertex or an edge of a body as a body of its own."""
    points = body.at(time)
    if place.edge is not None:
        start, end = body.edges[place.edge]
        return _placed([points[start], points[end]])
    if place.vertex is not None:
        return _placed([points[place.vertex]])
    raise Difference("no feature", f"{place} of {body}")


def _check_after(scene: Scene, contact: Contact, random: Random) -> str:
    """Check the pairs of a contact just after it, and later, by their contact intervals."""
    followed = set()
    for names in _named_pairs(contact):
        if len(names) == 1 or contact.time == scene.end:
            continue
        intervals = exactpt.contact_intervals(scene, *sorted(names))
        first = intervals[0]
        check_equal("start of the first interval", first.start, contact.time)
        after, end = _after(scene, contact.time), first.end.canonical_interval()[0]
        times = [after]
        if after < end:
            times.append(after + (end - after) * Fraction(random.randint(1, 8), 8))
        a, b = map(scene.body, sorted(names))
        for time in times:
            is_in = any(interval.start <= time <= interval.end for interval in intervals)
            try:
                if _touch(a, b, time) != is_in:
                    raise Difference("after the contact", f"{a}, {b} at {time}, not {is_in}")
            except _NotValidError:
                followed.add("not valid after")
            else:
                followed.add("in contact after" if is_in else "apart after")
    return ", ".join(sorted(followed)) or "nothing after"


def _named_pairs(contact: Contact) -> set[Pair]:
    """Return the names of the bodies of each pair in a contact; one name of a body with itself."""
    named = contact.initial_pairs or [(found.body, found.other) for found in contact.pairs]
    return set(map(frozenset, named))


def _names(pairs: set[Pair]) -> list[list[str]]:
    return sorted(map(sorted, pairs))


# All contacts, and distances


def contacts_are_confirmed(scene: Scene, random: Random) -> str:
    """By CGAL two bodies share a point at a time if and only if it is in a contact interval."""
    refuse_unless(not scene.ignoring)
    first, second = two_names(scene, random)
    intervals = exactpt.contact_intervals(scene, first, second)
    times = {fraction(a_time(scene, random, 16)) for _ in range(TIMES)}
    for interval in intervals:
        for end in (interval.start, interval.end):
            times |= {_before(scene, end), _after(scene, end), *_rational(end)}
    said = 0
    for time in sorted(times):
        expected = any(interval.start <= time <= interval.end for interval in intervals)
        try:
            found = _touch(scene.body(first), scene.body(second), time)
        except _NotValidError:
            continue
        said += 1
        if found != expected:
            raise Difference("contact", f"{expected} at {time}, by CGAL {found}")
    refuse_unless(said)
    return f"{min(len(intervals), 3)} intervals"


def _rational(time: AlgebraicNumber) -> Iterator[Fraction]:
    low, _ = time.canonical_interval()
    if low == time:
        yield low


def distances_are_confirmed(scene: Scene, random: Random) -> str:
    """Distances are those of CGAL, and so are the distances of all nearest features.

    Overlaps by definition of bodies without radii are those of CGAL, too.
    """
    refuse_unless(not scene.ignoring)
    first, second = two_names(scene, random)
    a, b = scene.body(first), scene.body(second)
    time = fraction(a_time(scene, random, 16))
    found = plain(exactpt.distance(scene, first, second, at=time))
    assert isinstance(found, Nearest)  # noqa: S101 - as `plain` documents
    try:
        relation = _relation_at(a, b, time)
    except _NotValidError:
        raise LeftOutError from None
    check_equal("squared distance", found.core_squared, relation.squared)
    check_equal("distance 0", found.core_squared == 0, relation.do_intersect)
    for p, q in found.features:
        pair = _relation(_placed_feature(a, p, time), _placed_feature(b, q, time))
        check_equal("distance of features", pair.squared, found.core_squared)
    if a.has_interior and b.has_interior and not (a.exact_radius or b.exact_radius):
        check_equal("overlap by definition", reference.overlap(a, b, time), relation.do_overlap)
    return "overlap" if relation.do_overlap else "touch" if relation.do_intersect else "apart"


# The free space


def spaces_are_confirmed(scene: Scene, random: Random) -> str:
    """By CGAL's arrangements and hulls: faces, hulls, owners of points, and free segments."""
    asked = a_space(scene, random)
    space, points = asked.space, asked.bodies
    tile = space.snapshot.to_json()
    shapes = BodyShape.of_scene(scene)
    verdict = witness().check_tiling(tile, shapes, deep=True)
    if not verdict.ok:
        raise Difference("tile", verdict.reason)
    bodies = {body.name: PlacedBody.of_body(body, space.at) for body in scene.bodies}
    hull = [points[name][vertex] for name, vertex in space.hull()]
    everything = [p for places in points.values() for p in places]
    corners = _corners(everything)
    check_equal("hull", _beginning_at(corners[0], [p for p in hull if p in corners]), corners)
    check_equal("corners of the hull", _corners(hull), corners)
    outcomes = {_check_relative_hull(space, name, bodies) for name in bodies}
    _check_points(space, points, bodies, random)
    return ", ".join(sorted(outcomes))


def _placed(points: Sequence[PointLike]) -> PlacedBody:
    """Return a point, a segment or a polygon."""
    return PlacedBody(BodyShape("points", len(points)), points)


def _corners(points: Sequence[PointLike]) -> list[PointLike]:
    """Return the corners of the convex hull by CGAL, from the smallest point."""
    return [points[i] for i in witness().hull(points)]


def _beginning_at(point: PointLike, points: list[Point]) -> list[Point]:
    """Return a cycle of points that begins at one of them."""
    if point not in points:
        return points
    first = points.index(point)
    return points[first:] + points[:first]


def _check_relative_hull(space: FreeSpace, name: str, bodies: dict[str, PlacedBody]) -> str:
    """Check that a relative hull has its body inside and no other one.

    It is the convex hull if that meets no other body.
    """
    body = bodies[name]
    others = [other for key, other in bodies.items() if key != name]
    convex = _corners(body.points)
    if len(body.shape.parts) > 1 or len(convex) < 3:
        return "hulls without area, or of several parts"
    loop = [bodies[owner].points[vertex] for owner, vertex in space.relative_hull(name)]
    hull = _placed(loop)
    if not any(_relation(_placed(convex), other).do_intersect for other in others):
        _check_union("convex relative hull", [_placed(convex)], hull)
        return "convex hulls"
    try:
        inside = [other.shape.name for other in others if _relation(hull, other).do_overlap]
    except _NotValidError:
        return "loops that touch themselves"
    if body.shape.closed:
        _check_union("body not in its relative hull", [body, hull], hull)
    if body.shape.parts:  # what is in its holes is in its hull
        outline = [body.points[i] for i in body.shape.parts[0][0]]
        inside = [key for key in inside if not _meet(outline, bodies[key])]
    if inside:
        raise Difference("relative hull", f"of {name!r}: {inside} are in it")
    return "relative hulls"


def _check_union(what: str, bodies: list[PlacedBody], union: PlacedBody) -> None:
    """Check that a body is the union of some others, by CGAL."""
    verdict = witness().check_union(bodies, union)
    if not verdict.ok:
        raise Difference(what, verdict.reason)


def _check_points(
    space: FreeSpace, places: Places, bodies: dict[str, PlacedBody], random: Random
) -> None:
    """Check the owners of points, and whether segments between them are free."""
    points = [some_point(random, places) for _ in range(POINTS)]
    for p in points:
        owners = [name for name, body in bodies.items() if _meet([p], body)]
        found = space.locate(p).body
        check_equal("owner of a point", (p, [] if found is None else [found]), (p, owners))
    for p, q in pairwise(points):
        is_free = not any(_meet([p, q], body) for body in bodies.values())
        check_equal("free segment", (p, q, space.is_free(p, q)), (p, q, is_free))


def _meet(points: Sequence[PointLike], body: PlacedBody) -> bool:
    """Return True if a point, a segment or a polygon has a point of a body."""
    return _relation(_placed(points), body).do_intersect


# Unions


def unions_are_confirmed(scene: Scene, random: Random) -> str:
    """The union of polygons is that of CGAL's Boolean operations."""
    closed = [body for body in scene.bodies if body.has_interior and not body.exact_radius]
    refuse_unless(closed)
    center = closed[0].at(scene.start)[0]
    moved = [_at_rest(body, scene.start, center, random) for body in closed]
    both = exactpt.union(moved, name="union")
    placed = [PlacedBody.of_body(body, 0) for body in moved]
    verdict = witness().check_union(placed, PlacedBody.of_body(both, 0))
    if not verdict.ok:
        raise Difference("union", verdict.reason)
    return f"{min(verdict.stats['parts'], 2)} parts, {min(verdict.stats['holes'], 2)} holes"


def _at_rest(body: Body, time: Fraction, center: Point, random: Random) -> Body:
    """Return a body at rest as it is at a time, with a vertex near a point or at it."""
    points = body.at(time)
    x, y = random.choice(points)
    shifts = [Fraction(0), Fraction(random.randint(-4, 4), 3)]
    dx = center[0] - x + random.choice(shifts)
    dy = center[1] - y + random.choice(shifts)
    rings = [[[(points[i][0] + dx, points[i][1] + dy) for i in ring] for ring in part]
             for part in body.parts]  # fmt: skip
    parts = [{"vertices": outline, "holes": holes} for outline, *holes in rings]
    return Body(body.name, parts=parts)
