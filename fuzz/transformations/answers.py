"""The questions, with their answers in terms of the old scene: what must stay equal.

Each function takes a side of an image and the numbers of the case, and returns a value that is
the same for both sides. Bodies that are one body in the old or in the new scene have a common
name; a pair of common names stands for all pairs of their bodies.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, Final, NamedTuple, Protocol, TypeAlias

import exactpt
from exactpt import AlgebraicNumber, Contact, ContactPoint, FreeSpace, InputError, Simulation
from exactpt.arrays import first_contacts
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.testing import reference
from fuzz.changes.images import Feature, Side
from fuzz.small_scope.by_arrays import suits

__all__ = ["QUESTIONS", "Case", "NotAskedError", "Question", "Refusal", "answer"]

Answer: TypeAlias = "Any"
Point: TypeAlias = "tuple[QQ, QQ]"


class Refusal(str):
    """The class of the exception by which a question is refused: no case if both sides are."""

    __slots__ = ()


class NotAskedError(Exception):
    """The question does not apply to this scene, or the transformation not to this question."""


@dataclass(frozen=True)
class Case:
    """The arguments of the questions about a scene, the same for both sides.

    Attributes:
        groups: two common names.
        t: a time.
        d: a distance.
        points: three points.
        tiling: the name of a tiling.
    """

    groups: tuple[str, str]
    t: QQ
    d: QQ
    points: tuple[Point, Point, Point]
    tiling: str


Ask: TypeAlias = "Callable[[Side, Case], Answer]"


class _Placed(Protocol):
    """A vertex or the interior of an edge."""

    @property
    def vertex(self) -> int | None: ...
    @property
    def edge(self) -> int | None: ...


class Question(NamedTuple):
    """A question that is asked about both sides.

    Attributes:
        calls: the public functions and methods that answer it.
        ask: the answer, in terms of the old scene.
        equal: what stays equal, for the table.
        knows_no_direction: whether the answer is the same, in time reversed, if time is.
    """

    calls: tuple[str, ...]
    ask: Ask
    equal: str
    knows_no_direction: bool = False


@dataclass(frozen=True)
class _Incidence:
    """Two features in contact, with the point, and the normal if there is one.

    The normal points from the lesser to the greater feature. One answer may give it and the other
    one not, where an edge has a new vertex at the point. Its last digits depend on the length of
    the edge. Of a body without interior and radius, a vertex that comes along an edge has no
    side: the sign of the normal then depends on the direction of the edge.
    """

    features: frozenset[Feature]
    point: tuple[float, float]
    normal: tuple[float, float] | None
    is_signed: bool

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _Incidence):
            return NotImplemented
        if (self.features, self.point) != (other.features, other.point):
            return False
        if self.normal is None or other.normal is None:
            return True
        cosine = self.normal[0] * other.normal[0] + self.normal[1] * other.normal[1]
        return abs((cosine if self.is_signed else abs(cosine)) - 1.0) < 1e-9

    __hash__ = None  # type: ignore[assignment]


def _contact(side: Side, contact: Contact | None) -> Answer:
    if contact is None:
        return None
    initial_pairs = {
        frozenset(side.groups[name] for name in names) for names in contact.initial_pairs
    }
    kind = contact.kind if contact.kind in ("initial", "self") else "later"
    if kind == "initial" and side.scene.has_radius and _has_groups(side):
        # Rounded bodies that overlap have no incidences, though other parts of them may touch.
        return contact.time, kind, initial_pairs
    return contact.time, kind, initial_pairs, _incidences(side, contact.pairs)


def _incidences(side: Side, pairs: Iterable[ContactPoint]) -> list[_Incidence]:
    """Return the incidences in terms of the old scene, each once.

    New vertices make incidences that the old scene does not list: of two edges, of an edge with
    its own end, and of an edge that is a point at this time, where only its ends are listed.
    """
    found: dict[frozenset[Feature], _Incidence] = {}
    for pair in pairs:
        v = side.vertices[pair.body, pair.vertex]
        if pair.edge is None:
            w = side.vertices[pair.other, pair.other_vertex or 0]
        else:
            w = side.edges[pair.other, pair.edge]
        features = frozenset({v, w})
        if v.kind == w.kind == "edge" or len(features) == 1 or _is_end(side, v, w):
            continue
        normal = pair.normal
        if normal is not None and v < w:
            normal = -normal[0], -normal[1]
        if normal is not None:
            normal = side.mirror.point(normal)
        body, other = side.scene.body(pair.body), side.scene.body(pair.other)
        is_signed = other.has_interior or bool(body.radius or other.radius)
        before = found.get(features)
        if before is None or before.normal is None:
            point = side.mirror.point(pair.point)
            found[features] = _Incidence(features, point, normal, is_signed)
    kept = [i for i in found.values() if not _is_at_both_ends(side, i.features, found)]
    return sorted(kept, key=lambda i: sorted(i.features))


def _is_end(side: Side, v: Feature, w: Feature) -> bool:
    """Return True if one is an edge and the other an end of it."""
    if v.kind == w.kind or v.body != w.body:
        return False
    edge, vertex = (v, w) if v.kind == "edge" else (w, v)
    return vertex in _ends(side, edge)


def _is_at_both_ends(
    side: Side, features: frozenset[Feature], found: Mapping[frozenset[Feature], _Incidence]
) -> bool:
    """Return True for an edge and a vertex that touches both ends of it: the edge is a point."""
    edge, vertex = sorted(features)
    if edge.kind == vertex.kind:
        return False
    return all(frozenset({end, vertex}) in found for end in _ends(side, edge))


def _ends(side: Side, edge: Feature) -> set[Feature]:
    """Return the two vertices of the old scene between which an edge of it lies."""
    bodies = {body.name: body for body in side.scene.bodies}
    pieces = [number for number, feature in side.edges.items() if feature == edge]
    ends = {(name, e) for name, i in pieces for e in (i, bodies[name].end_of_edge(i))}
    features = {side.vertices[end] for end in ends}
    return {feature for feature in features if feature.kind == "vertex"}


def _pairs(side: Side, case: Case) -> list[tuple[str, str]]:
    one, other = case.groups
    return list(product(side.members(one), side.members(other)))


def _first_contact(side: Side, case: Case) -> Answer:  # noqa: ARG001
    return _contact(side, exactpt.first_contact(side.scene, method="pairs"))


def _by_tiling(side: Side, case: Case) -> Answer:
    contact = exactpt.first_contact(side.scene, method="kinetic", tiling=_tiling(side, case))
    return _contact(side, contact)


def _tiling(side: Side, case: Case) -> str:
    if side.scene.has_radius:
        raise NotAskedError
    return case.tiling


def _run(side: Side, case: Case) -> Answer:
    simulation = Simulation(side.scene, tiling=_tiling(side, case))
    contact = simulation.run_to_contact()
    return _contact(side, contact), contact is None or simulation.now == contact.time


def _proof(side: Side, case: Case) -> Answer:
    proof = exactpt.prove(side.scene, tiling=_tiling(side, case))
    accepted = proof.check().partition(" ")[0]
    return accepted, _contact(side, proof.contact)


def _after_start(side: Side, case: Case) -> Answer:  # noqa: ARG001
    if _has_groups(side):
        first = exactpt.first_contact(side.scene, method="pairs")
        if first is not None and first.kind == "initial":
            raise NotAskedError  # a body is new to another one only if no part of it touched it
    return _contact(side, exactpt.first_contact(side.scene, after_start=True))


def _has_groups(side: Side) -> bool:
    names = list(side.groups.values())
    return len(set(names)) < len(set(side.groups))


def _between(side: Side, case: Case) -> Answer:
    return _contact(side, exactpt.first_contact(side.scene, between=_pairs(side, case)))


def _ignoring(side: Side, case: Case) -> Answer:
    group = [name for common in case.groups for name in side.members(common)]
    groups = [group] if len({*group}) > 1 else []  # two bodies may be one on the other side
    return _contact(side, exactpt.first_contact(side.scene, ignoring=groups))


def _since(side: Side, case: Case) -> Answer:
    return _contact(side, exactpt.first_contact(side.scene, since=case.t))


def _contacts(side: Side, case: Case) -> Answer:  # noqa: ARG001
    found: dict[frozenset[str], list[tuple[AlgebraicNumber, AlgebraicNumber]]] = {}
    for i in exactpt.contacts(side.scene):
        names = frozenset({side.groups[i.a], side.groups[i.b]})
        found.setdefault(names, []).append(side.mirror.interval(i.start, i.end))
    return {names: _union(intervals) for names, intervals in found.items()}


def _intervals(side: Side, case: Case) -> Answer:
    return _union(
        side.mirror.interval(i.start, i.end)
        for a, b in _pairs(side, case)
        for i in exactpt.contact_intervals(side.scene, a, b)
    )


def _union(
    intervals: Iterable[tuple[AlgebraicNumber, AlgebraicNumber]],
) -> list[tuple[AlgebraicNumber, AlgebraicNumber]]:
    """Return the maximal intervals of a union of closed ones."""
    found: list[tuple[AlgebraicNumber, AlgebraicNumber]] = []
    for start, end in sorted(intervals, key=lambda i: i[0]):
        if found and start <= found[-1][1]:
            found[-1] = (found[-1][0], max(found[-1][1], end))
        else:
            found.append((start, end))
    return found


def _distance(side: Side, case: Case) -> Answer:
    found = [
        (there, a, b)
        for a, b in _pairs(side, case)
        for there in [exactpt.distance(side.scene, a, b, at=side.mirror.time(case.t))]
    ]
    least = min(there.core_squared for there, _, _ in found)
    features = set()
    for there, a, b in found:
        if there.core_squared == least:
            for f, g in there.features:
                two = frozenset({_place(side, a, f), _place(side, b, g)})
                if {feature.kind for feature in two} != {"edge"}:
                    features.add(two)
    return least, min(float(there) for there, _, _ in found), features


def _place(side: Side, name: str, place: _Placed) -> Feature:
    if place.vertex is not None:
        return side.vertices[name, place.vertex]
    return side.edges[name, place.edge or 0]


def _clearance(side: Side, case: Case) -> Answer:
    found = [exactpt.clearance(side.scene, a, b) for a, b in _pairs(side, case)]
    least = min((gap.minimum.squared, gap.minimum.time) for gap in found)
    squared = min(gap.squared_with_radius(case.t) for gap in found)
    return least, squared, min(gap(case.t) for gap in found)


def _within(side: Side, case: Case) -> Answer:
    return _first(exactpt.first_within(side.scene, a, b, case.d) for a, b in _pairs(side, case))


def _first(times: Iterable[AlgebraicNumber | None]) -> AlgebraicNumber | None:
    return min((t for t in times if t is not None), default=None)


def _approach(side: Side, case: Case) -> Answer:
    if _has_groups(side):
        _check_apart(side, case.d)
    found = exactpt.first_within(side.scene, distance=case.d)
    if found is None:
        return None
    return found.time, {frozenset(side.groups[name] for name in pair) for pair in found.pairs}


def _check_apart(side: Side, d: QQ) -> None:
    """Raise `NotAskedError` if bodies of one group are within a distance all the time."""
    bodies = side.scene.bodies
    for k, a in enumerate(bodies):
        for b in bodies[:k]:
            if side.groups[a.name] == side.groups[b.name]:
                reach = a.exact_radius + b.exact_radius + d
                if reference.nearest(a, b, side.scene.exact_start).core_squared <= reach**2:
                    raise NotAskedError


def _enclosed(side: Side, case: Case) -> Answer:  # noqa: ARG001
    found = exactpt.first_contact_enclosed(side.scene)
    return None if found is None else Bounds(found.low, found.high)


@dataclass(frozen=True)
class Bounds:
    """Bounds of one time: two of them are equal if they have a time in common."""

    low: AlgebraicNumber
    high: AlgebraicNumber | None

    def __eq__(self, other: object) -> bool:
        if other is None:
            return self.high is None
        if not isinstance(other, Bounds):
            return NotImplemented
        return (self.high is None or other.low <= self.high) and (
            other.high is None or self.low <= other.high
        )

    __hash__ = None  # type: ignore[assignment]


def _planner(side: Side, case: Case) -> Answer:
    members = side.members(case.groups[0])
    if _size(side, case.groups[0]) > 1:
        raise NotAskedError
    shape = side.scene.body(members[0])
    obstacles = [body for body in side.scene.bodies if body.name != shape.name]
    planner = exactpt.Planner(obstacles, time=(side.scene.start, side.scene.end))
    return _contact(side, planner.first_contact(shape, shape.motion))


def _size(side: Side, group: str) -> int:
    """Return the number of bodies of a group in the scene in which these are more."""
    others = [name for name, common in side.groups.items() if common == group and name != group]
    return max(1, len(others))


def _arrays(side: Side, case: Case) -> Answer:
    bodies = [side.scene.body(name) for name in sorted(b.name for b in side.scene.bodies)]
    if not suits(side.scene) or any(body.has_rings for body in bodies) or _has_groups(side):
        raise NotAskedError
    if case.d < 1:
        bodies.reverse()
    vertices = [tuple(map(float, v)) for body in bodies for v in body.at(side.scene.start)]
    at = side.scene.exact_start
    moved = [_paths(body, at) for body in bodies]
    found = first_contacts(
        vertices, [0, bodies[0].size, len(vertices)], [(0, 1)], coefficients=_padded(moved),
        closed=[body.closed for body in bodies], radii=[float(body.radius) for body in bodies],
        time=(float(side.scene.start), float(side.scene.end)),
    )  # fmt: skip
    if not found.found[0]:
        return None
    low, high, first = found.low[0], found.high[0], found.contact(0)
    if first is None:
        return "found, but no contact"
    is_enclosed = first.time.compare_rational(QQ(low)) >= 0 >= first.time.compare_rational(QQ(high))
    return is_enclosed, first.time, first.kind in ("initial", "self")


def _paths(body: Body, at: QQ) -> list[list[float]]:
    """Return the coefficients of the translation since a time, in x and in y."""
    motion = body.motion
    assert isinstance(motion, Translation)  # noqa: S101 - by `suits`
    found = []
    for f in (motion.x, motion.y):
        c = [float(x) for x in f.coefficients] or [0.0]
        c[0] -= float(f(at))
        found.append(c)
    return found


def _padded(paths: Sequence[Sequence[Sequence[float]]]) -> list[list[list[float]]]:
    n = max(len(c) for path in paths for c in path)
    return [[[*c, *[0.0] * (n - len(c))] for c in path] for path in paths]


def _space(side: Side, case: Case) -> FreeSpace:
    tiling = _tiling(side, case)
    if tiling not in side.spaces:
        side.spaces[tiling] = Simulation(side.scene, tiling=tiling).space()
    return side.spaces[tiling]


def _is_free(side: Side, case: Case) -> Answer:
    p, q, _ = map(side.mirror.point, case.points)
    return _space(side, case).is_free(p, q)


def _locate(side: Side, case: Case) -> Answer:
    found: list[object] = []
    for p in map(side.mirror.point, case.points):
        place = _space(side, case).locate(p)
        if place.body is None:
            found.append(place.is_free)
        elif place.kind == "body":
            found.append(side.groups[place.body])
        else:
            found.append(_place(side, place.body, place))
    return found


def _ray_cast(side: Side, case: Case) -> Answer:
    (ax, ay), (bx, by), _ = map(side.mirror.point, case.points)
    hit = _space(side, case).ray_cast((ax, ay), (bx - ax, by - ay))
    if hit is None:
        return None
    inside = hit.vertex is None and hit.edge is None
    place = side.groups[hit.body] if inside else _place(side, hit.body, hit)
    return hit.at, side.mirror.point(hit.point), place


def _shortest_path(side: Side, case: Case) -> Answer:
    p, q, _ = map(side.mirror.point, case.points)
    return Length(_space(side, case).shortest_path(p, q).length)


def _shorten(side: Side, case: Case) -> Answer:
    points = [side.mirror.point(p) for p in case.points]
    return Length(_space(side, case).shorten(points).length)


@dataclass(frozen=True)
class Length:
    """A length to the precision of doubles."""

    value: float

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Length):
            return NotImplemented
        return math.isclose(self.value, other.value, rel_tol=1e-14)

    __hash__ = None  # type: ignore[assignment]


def _hull(side: Side, case: Case) -> Answer:
    return _corners(side, _space(side, case).hull())


def _relative_hull(side: Side, case: Case) -> Answer:
    if _size(side, case.groups[0]) > 1:
        raise NotAskedError
    return _corners(side, _space(side, case).relative_hull(case.groups[0]))


def _corners(side: Side, names: Iterable[tuple[str, int]]) -> Answer:
    """Return the old vertices of a loop, from the least one on: new ones are in edges."""
    found = [f for f in (side.vertices[name] for name in names) if f.kind == "vertex"]
    if not side.mirror.is_orientation_kept:
        found.reverse()
    k = found.index(min(found)) if found else 0
    if len(set(found)) < len(found):
        return sorted(set(found))  # a loop without area passes a vertex twice
    return found[k:] + found[:k]


def _positions(side: Side, case: Case) -> Answer:
    found = {}
    for body in side.scene.bodies:
        places = body.at(side.mirror.time(case.t))
        for i, place in enumerate(places):
            feature = side.vertices[body.name, i]
            if feature.kind == "vertex":
                found[feature] = side.mirror.point(place)
    return found


QUESTIONS: Final[Mapping[str, Question]] = {
    "first contact": Question(
        ("first_contact",), _first_contact, "time, point, normal up to its sign, features"
    ),
    "first contact by a tiling": Question(
        ("first_contact",), _by_tiling, "time, point, normal up to its sign, features"
    ),
    "run to contact": Question(
        ("Simulation.run_to_contact", "Simulation.now"), _run, "the contact; it is the current time"
    ),
    "proof": Question(("prove", "Proof.check"), _proof, "the contact; the proof is accepted"),
    "new contact": Question(
        ("first_contact",), _after_start, "the contact; for parts, if nothing touches at the start"
    ),
    "contact of some pairs": Question(("first_contact",), _between, "the contact"),
    "contact, ignoring a group": Question(("first_contact",), _ignoring, "the contact"),
    "contact since a time": Question(("first_contact",), _since, "the contact"),
    "all contacts": Question(
        ("contacts",),
        _contacts,
        "the union of the intervals of all parts",
        knows_no_direction=True,
    ),
    "contact intervals": Question(
        ("contact_intervals",),
        _intervals,
        "the union of the intervals of all parts",
        knows_no_direction=True,
    ),
    "distance": Question(
        ("distance",),
        _distance,
        "the least distance of the parts, its features",
        knows_no_direction=True,
    ),
    "clearance": Question(
        ("clearance",), _clearance, "the least minimum of the parts, its time; the values"
    ),
    "first within, two bodies": Question(("first_within",), _within, "the first time of the parts"),
    "first within, all": Question(
        ("first_within",), _approach, "the time and the pairs, if parts are farther apart"
    ),
    "enclosed contact": Question(
        ("first_contact_enclosed",), _enclosed, "bounds overlap, as both contain the same time"
    ),
    "planner": Question(
        ("Planner.first_contact",), _planner, "the contact, if the shape is one body in both"
    ),
    "arrays": Question(("arrays.first_contacts",), _arrays, "found, the time, whether initial"),
    "free segment": Question(("FreeSpace.is_free",), _is_free, "free or not"),
    "location": Question(
        ("FreeSpace.locate",), _locate, "free or not; the body, the vertex or the edge"
    ),
    "ray": Question(("FreeSpace.ray_cast",), _ray_cast, "the point, its parameter, the feature"),
    "shortest path": Question(("FreeSpace.shortest_path",), _shortest_path, "the length"),
    "shortened walk": Question(("FreeSpace.shorten",), _shorten, "the length"),
    "hull": Question(
        ("FreeSpace.hull",), _hull, "the vertices; new ones on its edges are left out"
    ),
    "relative hull": Question(
        ("FreeSpace.relative_hull",), _relative_hull, "as the hull, if the body is one in both"
    ),
    "positions": Question(
        ("Body.at", "Scene.at"),
        _positions,
        "the position of each old vertex",
        knows_no_direction=True,
    ),
}
"""The questions by name."""


def answer(question: Question, side: Side, case: Case) -> Answer:
    """Return the answer; for a refusal the name of the exception.

    Raises:
        NotAskedError: if the question does not apply.
    """
    if side.mirror.turning is not None and not question.knows_no_direction:
        raise NotAskedError
    try:
        return question.ask(side, case)
    except InputError as error:
        return Refusal(type(error).__name__)
