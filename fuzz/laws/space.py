"""Laws about the free space: places, rays, segments, hulls and shortest paths, by definition."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import inf, nextafter
from random import Random
from typing import Final, NamedTuple

from exactpt import FreeSpace, InputError, Scene, Simulation, UnreachableError
from exactpt.geometry.predicates import orient2d
from exactpt.kernel.numbers import QQ, fraction
from exactpt.query.answers import PLACES, Place
from exactpt.testing.reference import space as definition
from exactpt.testing.reference.paths import Length, length_of, shortest_length
from exactpt.testing.reference.shapes import is_on_segment
from exactpt.testing.reference.space import Places, Point
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.tilings import a_tiling
from fuzz.witnesses import Difference

__all__ = ["Asked", "a_space", "paths_are_shortest", "places_are_as_defined", "some_point"]

POINTS: Final = 6
"""Number of points in a case about places."""

PATHS: Final = 2
"""Number of paths in a case about paths."""

LEAST, LARGEST = Fraction(1, 2**400), 2**1000
"""Bounds of numbers that are compared as doubles: lengths are defined to some 500 bits."""

EVENTS: Final = 30
"""Maximum number of events until the space is asked for."""


class Asked(NamedTuple):
    """A free space that is asked, and what is there.

    Attributes:
        space: the free space.
        bodies: the points of each body at its time.
        run: the run that it is of.
    """

    space: FreeSpace
    bodies: Places
    run: Simulation

    def anew(self) -> FreeSpace:
        """Return the same free space, of which nothing has been asked yet."""
        return self.run.copy().space(at=self.space.at)


def a_space(scene: Scene, random: Random) -> Asked:
    """Return the free space at a time before the first contact.

    It is the start, or a part of the time span, or an event whose time is rational.
    """
    refuse_unless(scene.bodies)
    start = Simulation(scene, tiling=a_tiling(scene, random))
    refuse_unless(start.contact is None)
    run = start.copy()
    kind = random.choice(["start", "part", "event"])
    if kind == "part":
        span = scene.exact_end - scene.exact_start
        for _ in run.run(until=fraction(scene.exact_start + span * QQ(random.randint(1, 7), 8))):
            pass
    elif kind == "event":
        _step_to_a_rational_event(run, random)
    if run.contact is not None or not run.now.simplified().is_rational:
        run = start
    space = run.space()
    return Asked(space, definition.points_of(scene, space.at), run)


def _step_to_a_rational_event(run: Simulation, random: Random) -> None:
    """Process some events, and more as long as the time is irrational."""
    least = random.randint(1, EVENTS)
    for count in range(2 * EVENTS):
        if count >= least and run.now.simplified().is_rational:
            return
        if not run.step():
            return


# Points


def some_point(random: Random, bodies: Places) -> Point:
    """Return a vertex, a point in line or level with two, one of the lattice, or any other one."""
    points = [p for ps in bodies.values() for p in ps]
    a, b = random.choice(points), random.choice(points)
    kind = random.randrange(6)
    if kind == 0:
        return a
    if kind == 1:
        t = QQ(random.randint(-2, 6), 4)
        return a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])
    if kind == 2:
        return a[0], b[1]
    if kind == 3:
        return QQ(round(a[0])) + random.randint(-3, 3), QQ(round(a[1])) + random.randint(-3, 3)

    def anywhere(axis: int) -> QQ:
        low, high = (QQ(of(p[axis] for p in points)) for of in (min, max))
        part: QQ = (high - low + 1) * QQ(random.randint(-10, 110), 100)
        return low + part

    return anywhere(0), anywhere(1)


def _is_in_range(point: Point) -> bool:
    """Return True if the coordinates of a point are in the range of doubles."""
    return all(abs(coordinate) < LARGEST for coordinate in point)


def _in_doubles(point: Point, random: Random) -> tuple[float, float]:
    """Return the nearest doubles to a point, or those one unit in the last place beside."""
    x, y = map(float, point)
    if random.random() < 0.5:
        x = nextafter(x, random.choice([-inf, inf]))
    return x, y


def _given(point: Point, random: Random) -> tuple[object, Point]:
    """Return a point as it is given in a query, exactly or in doubles; and its exact value."""
    if random.random() < 0.6 or not _is_in_range(point):
        return point, point
    x, y = _in_doubles(point, random)
    return (x, y), (Fraction(x), Fraction(y))


# Places, rays and hulls


def places_are_as_defined(scene: Scene, random: Random) -> str:
    """Places, rays, free segments, neighbours and the hull are found by looking at all edges."""
    space, bodies, run = a_space(scene, random)
    points = [some_point(random, bodies) for _ in range(POINTS)]
    for p, q in pairwise(points):
        given, exact = _given(p, random)
        _check_place(space, bodies, space.locate(given), exact)  # type: ignore[arg-type]
        _check_ray(space, bodies, (given, exact), q)
    in_range = [_in_doubles(point, random) for point in points if _is_in_range(point)]
    _check_places_in_array(space, scene, in_range)
    _check_neighbours(space, bodies)
    hull = [bodies[body][vertex] for body, vertex in space.hull()]
    corners = definition.convex_hull([p for points in bodies.values() for p in points])
    if not set(corners) <= set(hull) or not all(_is_on_hull(p, corners) for p in hull):
        raise Difference("hull", f"{hull}, with the corners {corners}")
    when = "at the start" if space.at == scene.start else "later"
    return f"{run.name}, {when}"


def _check_place(space: FreeSpace, bodies: Places, place: Place, p: Point) -> None:
    owner = definition.owner(p, bodies)
    check_equal(f"the place of {p}", (place.body, place.vertex, place.edge), owner or (None,) * 3)
    snapshot = space.snapshot
    if place.kind == "tile":
        assert place.tile is not None  # noqa: S101 - of this kind
        nodes = [snapshot.nodes[v] for v in snapshot.faces[place.tile].nodes]
        if not definition.is_inside(p, [(node.exact_x, node.exact_y) for node in nodes]):
            raise Difference("tile", f"{p} is not in tile {place.tile}")
    elif place.kind == "diagonal":
        a, b = (bodies[name][vertex] for name, vertex in place.diagonal or ())
        if not is_on_segment(p, a, b):
            raise Difference("diagonal", f"{p} is not on {place.diagonal}")
    elif place.kind == "outside":
        corners = definition.convex_hull([q for points in bodies.values() for q in points])
        if _is_in_hull(p, corners):
            raise Difference("outside", f"{p} is in the hull")


def _is_in_hull(p: Point, corners: list[Point]) -> bool:
    """Return True if a point is in the closed hull with these corners, counter-clockwise."""
    edges = list(pairwise([*corners, corners[0]]))
    if len(corners) < 3:
        return any(is_on_segment(p, a, b) for a, b in edges)
    return all(orient2d(a, b, p) >= 0 for a, b in edges)


def _is_on_hull(p: Point, corners: list[Point]) -> bool:
    return any(is_on_segment(p, a, b) for a, b in pairwise([*corners, corners[0]]))


def _check_ray(space: FreeSpace, bodies: Places, origin: tuple[object, Point], q: Point) -> None:
    """Check the ray from a point through another one, and the segment between them."""
    given, p = origin
    direction = q[0] - p[0], q[1] - p[1]
    if p == q:
        return
    hit = space.ray_cast(given, direction)  # type: ignore[arg-type]
    expected = definition.first_hit(p, direction, bodies)
    found = None if hit is None else (hit.at, hit.body, hit.vertex, hit.edge)
    if found != expected:
        raise Difference("ray", f"from {p} to {q}: {found}, not {expected}")
    if hit is not None:
        x, y = (p[k] + hit.at * direction[k] for k in (0, 1))
        check_equal("point of a hit", hit.point, (x, y))
        crossed = definition.edges_crossed(p, (x, y), _diagonals(space))
        check_equal("number of diagonals that a ray crosses", hit.crossed, len(crossed))
    is_free = expected is None or expected.at > 1
    for a, b in ((given, q), (q, given)):
        if space.is_free(a, b) != is_free:  # type: ignore[arg-type]
            raise Difference("segment", f"from {a} to {b} is {'' if is_free else 'not '}free")


def _diagonals(space: FreeSpace) -> list[tuple[Point, Point]]:
    """Return the ends of the diagonals of a free space."""
    places = [(node.exact_x, node.exact_y) for node in space.snapshot.nodes]
    return [(places[edge.u], places[edge.v]) for edge in space.snapshot.diagonals]


def _check_places_in_array(
    space: FreeSpace, scene: Scene, points: list[tuple[float, float]]
) -> None:
    """Check that places in arrays are those of each point."""
    names = [body.name for body in scene.bodies]
    if not points:
        return
    located = space.locate_many(points)
    for point, kind, owner, feature in zip(points, *located, strict=True):
        place = space.locate(point)
        expected_owner = place.tile if place.body is None else names.index(place.body)
        expected_feature = place.edge if place.vertex is None else place.vertex
        check_equal(
            f"the place of {point} in an array",
            (PLACES[kind], owner, feature),
            (place.kind, *(-1 if n is None else n for n in (expected_owner, expected_feature))),
        )


def _check_neighbours(space: FreeSpace, bodies: Places) -> None:
    """Check that neighbours are joined by diagonals, and that no body is apart."""
    joined: dict[str, set[str]] = {name: set() for name in bodies}
    for edge in space.snapshot.diagonals:
        a, b = (space.snapshot.nodes[node].body for node in (edge.u, edge.v))
        if a != b:
            joined[a].add(b)
            joined[b].add(a)
    names = list(bodies)
    for name in names:
        expected = sorted(joined[name], key=names.index)
        check_equal(f"the neighbours of {name!r}", space.neighbours(name), expected)
    reached, next_ones = set(names[:1]), names[:1]
    while next_ones:
        new = joined[next_ones.pop()] - reached
        reached |= new
        next_ones.extend(new)
    check_equal("bodies connected by diagonals", reached, set(names))


# Paths


def paths_are_shortest(scene: Scene, random: Random) -> str:
    """Shortest paths are as long as those in the visibility graph, from both ends.

    None leads into a body.
    """
    space, bodies, _ = a_space(scene, random)
    outcome = "no path"
    for _ in range(PATHS):
        p, q = some_point(random, bodies), some_point(random, bodies)
        if _is_inside(p, bodies) or _is_inside(q, bodies):
            _check_no_path(space, p, q)
            continue
        expected = shortest_length(bodies, p, q)
        for start, goal in ((p, q), (q, p)):
            found = _path_length(space, start, goal)
            is_right = found is None and expected is None
            if found is not None and expected is not None:
                is_right = found.may_be(expected)
            if not is_right:
                raise Difference("path", f"from {start} to {goal}: {found}, not {expected}")
        outcome = "unreachable" if expected is None else "a path"
    return outcome


def _check_no_path(space: FreeSpace, p: Point, q: Point) -> None:
    """Check that a path between points of which one is inside a body is refused."""
    for find in (space.shortest_path, space.path):
        try:
            path = find(p, q)
        except InputError:
            continue
        raise Difference("path from inside a body", f"from {p} to {q}: {path}")


def _path_length(space: FreeSpace, start: Point, goal: Point) -> Length | None:
    """Return the length of the shortest path; None if there is no path.

    Raises:
        Difference: if it has other ends, or another length in doubles, or crosses another number
            of diagonals. Around the hull there are more of them, which a snapshot does not have.
    """
    try:
        path = space.shortest_path(start, goal)
    except UnreachableError:
        return None
    check_equal("ends of a path", (path.points[0], path.points[-1]), (start, goal))
    if not any(space.locate(end).kind == "outside" for end in (start, goal)):
        diagonals = _diagonals(space)
        legs = [definition.edges_crossed(a, b, diagonals) for a, b in pairwise(path.points)]
        crossed = sum(map(len, legs))
        check_equal("number of diagonals that a path crosses", path.crossed, crossed)
    length = length_of(path.points)
    if length.low > LEAST and length.high < LARGEST:
        check_equal("length of a path", path.length, float(length))
    return length


def _is_inside(point: Point, bodies: Places) -> bool:
    """Return True if a point is in the interior of a body."""
    owner = definition.owner(point, bodies)
    return owner is not None and owner.vertex is None and owner.edge is None
