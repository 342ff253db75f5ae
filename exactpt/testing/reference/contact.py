"""First contacts, the times of contact of two bodies, and the features in contact at a time.

Two definitions of the first contact share the arithmetic only. By `first_contact` every vertex is
compared with every edge, and with every vertex if bodies have radii. By `first_meeting` bodies are
compared as sets, at and between all times at which that can change.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations, islice, product
from typing import NamedTuple, TypeAlias

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ, Rational, rational
from exactpt.kernel.roots import common_roots
from exactpt.motion.body import Body
from exactpt.motion.track import Track, coincide, lies_on, orientation_polynomial, vector
from exactpt.scene.scene import Scene
from exactpt.testing.reference import shapes
from exactpt.testing.reference.features import (
    Corner,
    bodies_meet,
    coordinate_differences,
    corners,
    excess,
    has_foot,
    is_between,
    orientations,
    segments_meet,
    squared_from_line,
    squared_of_vertices,
)
from exactpt.testing.reference.nearest import nearest
from exactpt.testing.reference.shapes import edges_of
from exactpt.testing.reference.times import (
    Instant,
    Interval,
    Piece,
    Tracks,
    critical_times,
    intervals_of,
    pieces,
    roots_in,
    states,
    tracks_before,
)
from exactpt.testing.reference.within import intervals_within

__all__ = [
    "FirstContact", "NamedIncidence", "contact_intervals", "counted_pairs", "first_contact",
    "first_meeting", "incidences",
]  # fmt: skip

Pair: TypeAlias = tuple[Body, Body]
"""Two bodies in the order of the scene, or a body and itself."""


class NamedIncidence(NamedTuple):
    """A vertex on an edge or on a vertex; of bodies with radii, at the sum of these.

    Attributes:
        body: the name of the body that has the vertex.
        vertex: its number.
        other: the name of the body that it touches.
        edge: the number of the edge; None if it touches a vertex.
        other_vertex: the number of that vertex, which is on the later body of the scene, or the
            later one of the same body; None if it touches an edge.
    """

    body: str
    vertex: int
    other: str
    edge: int | None
    other_vertex: int | None


class FirstContact(NamedTuple):
    """What a first contact is, without points and normals.

    Attributes:
        time: the exact time.
        kind: "initial" at the start of the scene; "self" if every incidence is one of a body with
            itself; "vertex-edge" if one of two bodies is of a vertex and an edge; "vertex-vertex".
        incidences: all of them, at that time.
        initial_pairs: of a contact at the start, the names of any two bodies that share a point,
            in the order of the scene.
    """

    time: AlgebraicNumber
    kind: str
    incidences: frozenset[NamedIncidence]
    initial_pairs: frozenset[tuple[str, str]]

    @property
    def names(self) -> set[frozenset[str]]:
        """The names of any two bodies in contact; of a body that touches itself, its name."""
        found = self.initial_pairs or {(i.body, i.other) for i in self.incidences}
        return {frozenset(pair) for pair in found}


def counted_pairs(scene: Scene) -> list[Pair]:
    """Return any two bodies of a scene that count: no group of the scene has both.

    >>> from exactpt import Body, Scene
    >>> links = [Body(name, [(0, 0)]) for name in ("link 1", "link 2", "post")]
    >>> [(a.name, b.name) for a, b in counted_pairs(Scene(links, ignoring=[["link*"]]))]
    [('link 1', 'post'), ('link 2', 'post')]
    """
    groups = [_members(scene, texts) for texts in scene.ignoring]
    every = combinations(scene.bodies, 2)
    return [(a, b) for a, b in every if not any({a.name, b.name} <= group for group in groups)]


def _members(scene: Scene, texts: Iterable[str]) -> set[str]:
    """Return the names of the bodies that the texts of a group mean."""
    names = {body.name for body in scene.bodies}
    patterns = [text[:-1] for text in texts if text not in names]
    return {name for name in names if name in texts or any(map(name.startswith, patterns))}


def first_contact(
    scene: Scene, between: Iterable[Sequence[str]] | None = None
) -> FirstContact | None:
    """Return the first contact in the closed time span of a scene; None if there is none.

    Every vertex of every body is compared with every edge of every body, without those of bodies
    that ignore each other in the scene. A body with a radius
    does not touch itself, nor does one whose rings touch at the start: it keeps its shape.

    >>> from exactpt import Body, Scene, Translation
    >>> ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]))
    >>> contact = first_contact(Scene([ball, Body("wall", [(9, -5), (9, 5)])], time=(0, 10)))
    >>> contact.time, contact.kind
    (AlgebraicNumber('4'), 'vertex-edge')
    >>> contact.incidences
    frozenset({NamedIncidence(body='ball', vertex=1, other='wall', edge=0, other_vertex=None)})

    Args:
        scene: the scene.
        between: the pairs of names that count, twice the same name for a body with itself; all
            if not given.

    Raises:
        InputError: if there is no body of such a name.
    """
    pairs = _pairs(scene, between)
    of_two = [(a, b) for a, b in pairs if a is not b]
    initial_pairs = [(a.name, b.name) for a, b in of_two if _meet_at_start(scene, a, b)]
    if initial_pairs:
        now = AlgebraicNumber(scene.exact_start)
        found = incidences(scene, now, between)
        return FirstContact(now, "initial", found, frozenset(initial_pairs))
    times = [time for a, b in pairs if (time := _first_between(scene, a, b)) is not None]
    if not times:
        return None
    first = min(times)
    found = incidences(scene, first, between)
    return FirstContact(first, _kind(found), found, frozenset())


def _kind(found: Iterable[NamedIncidence]) -> str:
    of_two = [incidence for incidence in found if incidence.body != incidence.other]
    if not of_two:
        return "self"
    has_edge = any(incidence.edge is not None for incidence in of_two)
    return "vertex-edge" if has_edge else "vertex-vertex"


def _reach(a: Body, b: Body) -> QQ:
    return a.exact_radius + b.exact_radius


def _pairs(scene: Scene, between: Iterable[Sequence[str]] | None) -> list[Pair]:
    """Return the pairs of bodies that count, those of a body and itself included."""
    every = [*counted_pairs(scene), *((body, body) for body in scene.bodies)]
    if between is None:
        return every
    named = {frozenset(scene.body(name).name for name in pair) for pair in between}
    return [(a, b) for a, b in every if frozenset({a.name, b.name}) in named]


def _meet_at_start(scene: Scene, a: Body, b: Body) -> bool:
    """Return True if two bodies share a point at the start."""
    now, reach = scene.exact_start, _reach(a, b)
    if reach:
        return nearest(a, b, now).core_squared <= reach**2
    return shapes.bodies_meet(a, a.exact_at(now), b, b.exact_at(now))


def _can_touch_itself(scene: Scene, body: Body) -> bool:
    """Return True if a body has no radius, and no two of its rings touch at the start."""
    if body.exact_radius:
        return False
    if len(body.rings) == 1:
        return True
    points = body.exact_at(scene.exact_start)
    return not any(
        shapes.is_on_segment(points[v], points[a], points[b])
        for ring in body.rings
        for v in ring
        for a, b in body.edges
        if a not in ring
    )


def _first_between(scene: Scene, a: Body, b: Body) -> AlgebraicNumber | None:
    """Return the first time after the start at which two bodies, or one and itself, touch."""
    if a is b and not _can_touch_itself(scene, a):
        return None
    for piece in pieces(a, b, scene.exact_start, scene.exact_end):
        if _reach(a, b):
            times = _times_at_distance(a, b, piece)
        elif a is b:
            times = _times_on_edges(_own_corners(a, piece.first), piece)
        else:
            times = _times_on_edges(_corners_with_points(a, b, piece), piece)
        first = min(times, default=None)
        if first is not None:
            return first
    return None


def _corners_with_points(a: Body, b: Body, piece: Piece) -> Iterator[Corner]:
    """Yield every vertex of each body with every edge of the other; a point is an edge, too."""
    p, q = piece.first, piece.second
    yield from (Corner(v, q[k], q[l]) for v, (k, l) in product(p, edges_of(b)))
    yield from (Corner(v, p[k], p[l]) for v, (k, l) in product(q, edges_of(a)))


def _own_corners(a: Body, p: Tracks) -> Iterator[Corner]:
    """Yield every vertex of a body with every edge of which it is no end, and the ends of edges.

    An edge of a body that deforms may shrink to a point.
    """
    for i, v in enumerate(p):
        yield from (Corner(v, p[k], p[l]) for k, l in a.edges if i not in (k, l))
    yield from (Corner(p[k], p[l], p[l]) for k, l in a.edges)


def _times_on_edges(found: Iterable[Corner], piece: Piece) -> Iterator[AlgebraicNumber]:
    """Yield when a vertex comes onto an edge: roots of their orientation.

    If the three are collinear at all times, the vertex comes to the edge at one of its ends.
    """
    begin = AlgebraicNumber(piece.begin)
    for v, a, b in found:
        f = orientation_polynomial(a, b, v)
        if f:
            on_line = roots_in(f, piece.begin, piece.end)
            yield from islice((t for t in on_line if lies_on(v, a, b, t)), 1)
            continue
        for end in (a, b):
            yield from [root.time for root in common_roots(*vector(end, v), begin, piece.end)][:1]


def _times_at_distance(a: Body, b: Body, piece: Piece) -> Iterator[AlgebraicNumber]:
    """Yield when features of two cores come to the sum of the radii.

    Cores that are farther apart come to that distance first at two vertices, or at a vertex and
    the inside of an edge, at the foot of the perpendicular.
    """
    squared = _reach(a, b) ** 2
    p, q = piece.first, piece.second
    for u, v in product(p, q):
        f = excess(squared_of_vertices(u, v), squared)
        yield from roots_in(f, piece.begin, piece.end)[:1]
    for corner in corners(a, b, p, q):
        f = excess(squared_from_line(corner), squared)
        at_distance = roots_in(f, piece.begin, piece.end)
        yield from islice((t for t in at_distance if has_foot(t, corner)), 1)


# Incidences at a time


def incidences(
    scene: Scene, time: AlgebraicNumber, between: Iterable[Sequence[str]] | None = None
) -> frozenset[NamedIncidence]:
    """Return every incidence of a vertex with a vertex or an edge at a time.

    A vertex on an end of an edge is an incidence of two vertices. Bodies with radii have
    incidences if their cores are at the sum of the radii, unless they overlap at the start.

    >>> from exactpt import AlgebraicNumber, Body, Scene
    >>> scene = Scene([Body("a", [(0, 0), (4, 0)]), Body("b", [(0, 0), (1, 0)])])
    >>> sorted(incidences(scene, AlgebraicNumber(0)))[0]
    NamedIncidence(body='a', vertex=0, other='b', edge=None, other_vertex=0)

    Args:
        scene: the scene.
        time: a time in its span. The motions are those just before it, at the start just after.
        between: the pairs of names that count, twice the same name for a body with itself; all
            if not given.
    """
    tracks = {b.name: tracks_before(b, time, scene.exact_start) for b in scene.bodies}
    found: set[NamedIncidence] = set()
    for a, b in _pairs(scene, between):
        if (a is b and not _can_touch_itself(scene, a)) or _overlap_at_start(scene, a, b, time):
            continue
        touching, p, q = _Touching(time, _reach(a, b)), tracks[a.name], tracks[b.name]
        found.update(_of_vertices(touching, a, b, p, q))
        found.update(_of_edges(touching, a, b, p, q))
        if a is not b:
            found.update(_of_edges(touching, b, a, q, p))
    return frozenset(found)


def _overlap_at_start(scene: Scene, a: Body, b: Body, time: AlgebraicNumber) -> bool:
    """Return True if the time is the start, and the cores of rounded bodies are too near then."""
    reach = _reach(a, b)
    if not reach or time.compare_rational(scene.exact_start) != 0:
        return False
    return nearest(a, b, scene.exact_start).core_squared < reach**2


class _Touching(NamedTuple):
    """Which features touch at a time: those at the sum of the radii of two bodies."""

    time: AlgebraicNumber
    reach: QQ

    def are_vertices(self, u: Track, v: Track) -> bool:
        """Return True if two vertices touch."""
        if self.reach == 0:
            return coincide(u, v, self.time)
        return self.time.sign_of(excess(squared_of_vertices(u, v), self.reach**2)) == 0

    def is_on_inside(self, corner: Corner) -> bool:
        """Return True if a vertex touches an edge, and none of its ends."""
        v, a, b = corner
        if self.reach == 0:
            is_at_end = coincide(v, a, self.time) or coincide(v, b, self.time)
            return lies_on(v, a, b, self.time) and not is_at_end
        is_at_distance = self.time.sign_of(excess(squared_from_line(corner), self.reach**2)) == 0
        return is_at_distance and has_foot(self.time, corner)


def _of_vertices(
    touching: _Touching, a: Body, b: Body, p: Tracks, q: Tracks
) -> Iterator[NamedIncidence]:
    """Yield the incidences of two vertices, of one body or of two."""
    for (k, u), (l, v) in product(enumerate(p), enumerate(q)):
        if (a is not b or k < l) and touching.are_vertices(u, v):
            yield NamedIncidence(a.name, k, b.name, None, l)


def _of_edges(
    touching: _Touching, a: Body, b: Body, p: Tracks, q: Tracks
) -> Iterator[NamedIncidence]:
    """Yield the incidences of a vertex of a and an edge of b, of which it is no end."""
    for (k, v), (e, (start, end)) in product(enumerate(p), enumerate(b.edges)):
        is_end = a is b and k in (start, end)
        if not is_end and touching.is_on_inside(Corner(v, q[start], q[end])):
            yield NamedIncidence(a.name, k, b.name, e, None)


# Contacts as sets, at and between critical times


def contact_intervals(a: Body, b: Body, time: Sequence[Rational]) -> list[Interval]:
    """Return the maximal closed intervals in which two bodies share a point.

    >>> from exactpt import Body, Translation
    >>> ball = Body("ball", [(0, 0)], Translation([0, 1]))
    >>> contact_intervals(ball, Body("box", [(2, -1), (4, -1), (4, 1), (2, 1)]), (0, 9))
    [(AlgebraicNumber('2'), AlgebraicNumber('4'))]

    Args:
        a: a body.
        b: another one.
        time: the start and the end of the time span.
    """
    reach = _reach(a, b)
    if reach:
        return intervals_within(a, b, time, reach**2)

    def meet(t: Instant, p: Tracks, q: Tracks) -> bool:
        return bodies_meet(t, a, b, p, q)

    start, end = map(rational, time)
    return intervals_of(states(a, b, start, end, meet, _changes))


def _changes(p: Tracks, q: Tracks) -> Iterator[IntPoly]:
    """Yield the polynomials without whose roots two bodies go on to meet, or to be apart."""
    yield from orientations(p, q)
    yield from coordinate_differences(p, q)


def first_meeting(scene: Scene) -> tuple[AlgebraicNumber, set[frozenset[str]]] | None:
    """Return the time of the first contact, and the names of any two bodies in contact then.

    A body that touches itself has its name alone.

    >>> from exactpt import Body, Scene, Translation
    >>> ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]))
    >>> time, pairs = first_meeting(Scene([ball, Body("wall", [(9, -5), (9, 5)])], time=(0, 10)))
    >>> time, [sorted(pair) for pair in pairs]
    (AlgebraicNumber('4'), [['ball', 'wall']])

    Args:
        scene: the scene.
    """
    found: list[tuple[AlgebraicNumber, frozenset[str]]] = []
    for a, b in counted_pairs(scene):
        intervals = contact_intervals(a, b, scene.time)
        if intervals:
            since, _ = intervals[0]
            found.append((since, frozenset({a.name, b.name})))
    for body in scene.bodies:
        if _can_touch_itself(scene, body):
            own = first_self_meeting(body, scene.exact_start, scene.exact_end)
            found += [] if own is None else [(own, frozenset({body.name}))]
    if not found:
        return None
    first = min(time for time, _ in found)
    return first, {pair for time, pair in found if time == first}


def first_self_meeting(body: Body, start: QQ, end: QQ) -> AlgebraicNumber | None:
    """Return the first time after the start at which a body is not simple; None if it stays so."""
    for piece in pieces(body, body, start, end):
        p = piece.first
        polynomials = [*orientations(p), *coordinate_differences(p, p)]
        for t in critical_times(polynomials, piece.begin, piece.end):
            if not _is_simple(t, body, p):
                return t
    return None


def _is_simple(t: AlgebraicNumber, body: Body, p: Tracks) -> bool:
    """Return True if edges have a length and share their common ends only."""
    if any(coincide(p[k], p[l], t) for k, l in body.edges):
        return False
    for (i, j), (k, l) in combinations(body.edges, 2):
        shared = {i, j} & {k, l}
        if not shared and segments_meet(t, p[i], p[j], p[k], p[l]):
            return False
        if shared:
            (middle,) = shared
            (one,), (other,) = {i, j} - shared, {k, l} - shared
            if _is_fold(t, p[one], p[middle], p[other]):
                return False
    return True


def _is_fold(t: AlgebraicNumber, a: Track, middle: Track, b: Track) -> bool:
    """Return True if two edges at one vertex have the same direction from there."""
    if t.sign_of(orientation_polynomial(a, middle, b)) != 0:
        return False
    return is_between(t, a, middle, b) or is_between(t, b, middle, a)
