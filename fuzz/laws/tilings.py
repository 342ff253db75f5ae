"""Laws about tilings: kinetic equals static, filters decide as exact arithmetic does."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from itertools import combinations, pairwise
from math import ceil, log2
from random import Random
from typing import Final, TypeAlias

import numpy as np

from exactpt import AlgebraicNumber, Body, Polynomial, RunEvent, Scene, Simulation, Translation
from exactpt.kernel.numbers import fraction
from exactpt.pseudotriangulation.snapshot import Snapshot
from exactpt.testing import audit
from exactpt.testing.reference.greedy import ConvexBodies
from exactpt.testing.reference.space import components, convex_hull
from exactpt.testing.reference.tangents import tangents
from exactpt.tiling.catalogue import ENTRIES, Bodies, Entry
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.questions import a_time, contact_value
from fuzz.witnesses import Difference, LeftOutError, tilings_of

__all__ = [
    "a_tiling",
    "arrays_are_tiled_as_bodies",
    "at_once_is_one_by_one",
    "events_lead_to_the_next_tiling",
    "filters_decide_exactly",
    "general_position_needs_no_rebuild",
    "greedy_in_two_ways",
    "kinetic_is_static",
    "mixed_tiling_has_its_regions",
    "most_decisions_are_of_filters",
    "tiling_is_as_defined",
    "tilings_at_events_are_whole",
]

AUDITS: Final = 40
"""Number of steps of a run of which each is audited; of the later ones, one in `LATER` is."""

LATER: Final = 8

ODD: Final = 9973
"""Number of parts of a time span: a prime, so that events at simple times are at none of them."""

TIMES: Final = 8
"""Number of times at which the tilings of a run are compared."""

SEGMENTS: Final = 20
"""Number of segments of which crossings are counted."""

EXACT: Final = 0.01
"""Maximum share of exact decisions in general position."""

FEWEST: Final = 300
"""Number of decisions from which their shares are compared."""

Place: TypeAlias = tuple[Fraction, Fraction]


def a_tiling(scene: Scene, random: Random) -> str:
    """Return the name of a tiling that supports a scene.

    Raises:
        LeftOutError: if there is none.
    """
    names = tilings_of(scene)
    refuse_unless(names)
    return random.choice(names)


def kinetic_is_static(scene: Scene, random: Random) -> str:
    """Between any two events a tiling equals the one built from nothing, with its certificates."""
    tiling = a_tiling(scene, random)
    run = Simulation(scene, tiling=tiling)
    audit(run)
    steps = 0
    while run.step():
        steps += 1
        if steps <= AUDITS or random.randrange(LATER) == 0:
            audit(run)
    ended = "no contact" if run.contact is None else "a contact"
    return f"{tiling}, {_some(steps)} steps, {ended}"


def filters_decide_exactly(scene: Scene, random: Random) -> str:
    """The event log is the same, byte for byte, with and without the float filters."""
    tiling = a_tiling(scene, random)
    filtered, exact = (
        [event.to_json() for event in Simulation(scene, tiling=tiling, exact_only=exact).run()]
        for exact in (False, True)
    )
    for number, (found, expected) in enumerate(zip(filtered, exact, strict=False)):
        if found != expected:
            raise Difference(f"{tiling}: event", f"event {number}: {found}, exactly {expected}")
    if len(filtered) != len(exact):
        raise Difference(f"{tiling}: number of events", f"{len(filtered)}, exactly {len(exact)}")
    return f"{tiling}, {_some(len(exact))} events"


def at_once_is_one_by_one(scene: Scene, random: Random) -> str:
    """A search that reports no events ends in the state of a run by steps, with equal counts."""
    tiling = a_tiling(scene, random)
    by_steps, at_once = (Simulation(scene, tiling=tiling) for _ in range(2))
    steps = 0
    while by_steps.step():
        steps += 1
    contact = at_once.run_to_contact()
    check_equal("contact", contact_value(contact), contact_value(by_steps.contact))
    check_equal("counts", at_once.stats, by_steps.stats)
    check_equal("state", _state(at_once), _state(by_steps))
    return f"{tiling}, {_some(steps)} steps, {'no contact' if contact is None else 'a contact'}"


def _state(run: Simulation) -> dict[str, object]:
    """Return the state of a run, apart from the events that are still to be reported."""
    return {key: value for key, value in run.to_json().items() if key not in ("pending", "sha256")}


# Definitions


def tiling_is_as_defined(scene: Scene, random: Random) -> str:
    """The tiling of points, and the greedy one of convex bodies, are those of their definitions."""
    are_points = all(body.size == 1 for body in scene.bodies)
    name = "incremental" if are_points else "greedy"
    refuse_unless(name in tilings_of(scene) and len(scene.bodies) > 1)
    run = Simulation(scene, tiling=name)
    for _ in run.run(until=fraction(a_time(scene, random, steps=97))):
        pass
    refuse_unless(run.contact is None)
    tiling = run.snapshot()
    places = _places(tiling)
    found = {(edge.u, edge.v) for edge in tiling.diagonals}
    expected = tangents(places) if are_points else _greedy_edges(scene.bodies, places)
    check_equal(f"{name} tiling", sorted(found), sorted(expected))
    if not are_points or _are_general(places):
        edges, faces = _counts_of(scene.bodies, are_points=are_points)
        check_equal(f"{name} tiling: number of edges", len(found), edges)
        check_equal(f"{name} tiling: number of faces", len(tiling.faces), faces)
    return f"{name}, {_some(len(expected))} edges"


def _counts_of(bodies: Sequence[Body], *, are_points: bool) -> tuple[int, int]:
    """Return the numbers of edges and faces of a tiling in general position.

    Of n points: 2 n - 3 and n - 2. Of k convex bodies, m of them not points: 3 k - 3 bitangents,
    one less for each point, whose two have one geometry; and k + m - 2 (paper, Lemma 2.1).
    """
    count = len(bodies)
    points = sum(body.size == 1 for body in bodies)
    if are_points:
        return 2 * count - 3, count - 2
    return 3 * count - 3 - points, 2 * count - points - 2


def _places(tiling: Snapshot) -> list[Place]:
    """Return the positions of the vertices at a rational time."""
    return [(fraction(node.exact_x), fraction(node.exact_y)) for node in tiling.nodes]


def _greedy_edges(bodies: Sequence[Body], places: list[Place]) -> set[tuple[int, int]]:
    """Return the edges of the greedy tiling of convex bodies in general position, by definition.

    Raises:
        LeftOutError: if a body is not convex, or three vertices are on one line, or two on a
            vertical one.
    """
    refuse_unless(all(body.closed and not body.has_rings for body in bodies))
    refuse_unless(_are_general(places))
    outlines: list[list[int]] = []
    for body in bodies:
        first = sum(map(len, outlines))
        outlines.append(_counter_clockwise(list(range(first, first + body.size)), places))
    defined = ConvexBodies([[places[v] for v in outline] for outline in outlines])
    ends = ((outlines[i][a], outlines[j][b]) for (i, a), (j, b) in defined.edges(defined.greedy()))
    return {(min(u, v), max(u, v)) for u, v in ends}


def _are_general(places: Sequence[Place]) -> bool:
    """Return True if no three points are on one line, and no two on a vertical one."""
    if len({x for x, _ in places}) < len(places):
        return False
    return all(_turn(*three) for three in combinations(places, 3))


def _counter_clockwise(outline: list[int], places: list[Place]) -> list[int]:
    """Return the vertices of a convex polygon in counter-clockwise order.

    Raises:
        LeftOutError: if it is not convex.
    """
    if len(outline) < 3:
        return outline
    around = [*outline, *outline[:2]]
    turns = {_turn(*(places[v] for v in around[k : k + 3])) for k in range(len(outline))}
    refuse_unless(len(turns) == 1)
    return outline if turns == {1} else outline[::-1]


def _turn(a: Place, b: Place, c: Place) -> int:
    """Return 1 if three points turn left, -1 if right, 0 if they are on one line."""
    left, right = (b[0] - a[0]) * (c[1] - a[1]), (b[1] - a[1]) * (c[0] - a[0])
    return (left > right) - (left < right)


# The greedy tiling of convex bodies in two ways, and the mixed one in regions


SHADOWED: Final = Entry("shadowed", Bodies.ANY, "exactpt.tiling.greedy.shadowed:ShadowRules")
"""The greedy tiling by the rules for any bodies, for bodies that stay convex too."""


def greedy_in_two_ways(scene: Scene, random: Random) -> str:
    """The rules for bodies that stay convex, and those for any, keep the same greedy tiling."""
    refuse_unless("greedy" in tilings_of(scene))
    with _registered(SHADOWED):
        convex, any_bodies = (Simulation(scene, tiling=name) for name in ("greedy", SHADOWED.name))
    refuse_unless(convex.stats.get("rules") == "VerticalRules")
    compared = 0
    for time in _odd_times(scene, random):
        times = [event.time for run in (convex, any_bodies) for event in run.run(until=time)]
        check_equal("contact", any_bodies.contact, convex.contact)
        if convex.contact is not None:
            break
        if time not in times:
            check_equal("diagonals", any_bodies.snapshot().diagonals, convex.snapshot().diagonals)
            compared += 1
    return f"{_some(compared)} tilings"


@contextmanager
def _registered(entry: Entry) -> Iterator[None]:
    """Add a tiling to the catalogue (docs/extending.md)."""
    ENTRIES.append(entry)
    try:
        yield
    finally:
        ENTRIES.remove(entry)


def mixed_tiling_has_its_regions(scene: Scene, random: Random) -> str:
    """Outside of relative hulls there are two faces a body but two, and little else of each kind.

    Of k bodies, O(k) edges that join two are on the border of that region, and within it (paper,
    Lemma 5.2, Corollary 5.3). A segment in the free space crosses few edges inside of relative
    hulls (Lemma 5.4).
    """
    refuse_unless("mixed" in tilings_of(scene))
    run = Simulation(scene, tiling="mixed")
    time = _odd_times(scene, random)[0]
    refuse_unless(time not in [event.time for event in run.run(until=time)])
    refuse_unless(run.contact is None)
    tiling = run.snapshot()
    outlines = components(Scene(scene.bodies, (time, scene.end))).values()
    expected = sum(max(0, 2 * len(names) - 2) for names in outlines)
    outer = [face for face in tiling.faces if face.region == "F2"]
    are_polygons = all(body.closed and body.size > 2 for body in scene.bodies)
    if are_polygons or len(outer) > expected:  # faces of copies alone have no area
        check_equal("number of faces in F2", len(outer), expected)
    if not any(body.has_rings for body in scene.bodies):
        _check_bridges(tiling, len(scene.bodies))
    crossed = _check_crossings(tiling, scene, random)
    return f"{_some(len(outer))} faces in F2, {_some(crossed)} edges crossed"


def _check_bridges(tiling: Snapshot, count: int) -> None:
    """Check the numbers of edges that join two bodies on the border of F2, and within it."""
    regions = _regions_beside(tiling)
    bridges = [
        regions.get((edge.u, edge.v), set())
        for edge in tiling.diagonals
        if tiling.nodes[edge.u].body != tiling.nodes[edge.v].body
    ]
    for beside, most in (({"F1", "F2"}, 6 * count), ({"F2"}, 3 * count)):
        found = bridges.count(beside)
        if found > most:
            raise Difference("bridges", f"{found} beside {sorted(beside)}, at most {most}")


def _regions_beside(tiling: Snapshot) -> dict[tuple[int, int], set[str]]:
    """Return the regions on both sides of each edge of a face."""
    regions: dict[tuple[int, int], set[str]] = {}
    for face in tiling.faces:
        for u, v in pairwise([*face.nodes, face.nodes[0]]):
            regions.setdefault((min(u, v), max(u, v)), set()).add(face.region)
    return regions


def _check_crossings(tiling: Snapshot, scene: Scene, random: Random) -> int:
    """Check how many edges of F1 free segments cross; return the largest number found."""
    places, regions = _places(tiling), _regions_beside(tiling)
    inner = [edge for edge in tiling.diagonals if "F1" in regions.get((edge.u, edge.v), ())]
    solid = [edge for edge in tiling.edges if edge.kind == "boundary"]
    largest = max(body.size for body in scene.bodies)
    most = 2 * (ceil(log2(largest)) + 2)
    found = 0
    for _ in range(SEGMENTS):
        segment = _near(random, places), _near(random, places)
        if any(_cross(segment, (places[e.u], places[e.v])) for e in solid):
            continue
        crossed = sum(_cross(segment, (places[e.u], places[e.v])) for e in inner)
        if crossed > most:
            raise Difference("edges of F1", f"{segment} crosses {crossed}, at most {most}")
        found = max(found, crossed)
    return found


def _near(random: Random, places: Sequence[Place]) -> Place:
    """Return a point near a vertex, on its free side or not."""
    x, y = random.choice(places)
    return x + Fraction(random.randint(-300, 300), 97), y + Fraction(random.randint(-300, 300), 101)


def _cross(s: tuple[Place, Place], t: tuple[Place, Place]) -> bool:
    """Return True if two segments cross at inner points."""
    (a, b), (c, d) = s, t
    return _turn(a, b, c) * _turn(a, b, d) < 0 and _turn(c, d, a) * _turn(c, d, b) < 0


# Tilings as users see them


def tilings_at_events_are_whole(scene: Scene, random: Random) -> str:
    """At each event the faces have three corners, and fill the hull of the bodies with them."""
    tiling = a_tiling(scene, random)
    run = Simulation(scene, tiling=tiling)
    seen = 0
    while run.contact is None and seen < AUDITS:
        _check_corners(run)
        if run.now.simplified().is_rational:
            _check_area(run, scene)
            seen += 1
        if not run.step():
            break
    return f"{tiling}, {_some(seen)} tilings"


def _check_corners(run: Simulation) -> None:
    """Check that each face has three corners, and that its sides are edges."""
    tiling = run.tiling
    edges = {(edge.u, edge.v) for edge in tiling.edges}
    for face in tiling.faces:
        check_equal("number of corners", len(set(face.corners)), 3)
        for u, v in pairwise([*face.nodes, face.nodes[0]]):
            if (min(u, v), max(u, v)) not in edges:
                raise Difference("side of a face", f"{u} {v} is no edge at {run.now!r}")


def _check_area(run: Simulation, scene: Scene) -> None:
    """Check that faces are left turns at their corners alone, and that nothing is left out."""
    tiling = run.snapshot()
    places = _places(tiling)
    area = Fraction(0)
    for face in tiling.faces:
        around = [face.nodes[-1], *face.nodes, face.nodes[0]]
        three = ([places[v] for v in around[k : k + 3]] for k in range(len(face.nodes)))
        convex = {v for v, points in zip(face.nodes, three, strict=True) if _turn(*points) > 0}
        check_equal("corners", convex, set(face.corners))
        area += _doubled_area([places[v] for v in face.nodes])
    area += sum(_doubled_area_of(body, run.now) for body in scene.bodies)
    hull = convex_hull(places) if places else []
    check_equal("area of faces and bodies", area, abs(_doubled_area(hull)))


def _doubled_area_of(body: Body, time: AlgebraicNumber) -> Fraction:
    """Return twice the area of a body, holes left out."""
    if not body.closed or body.size < 3:
        return Fraction(0)
    points = body.at(fraction(time.simplified().exact_low))
    if not body.has_rings:
        return abs(_doubled_area(points))
    rings = [(ring, k > 0) for part in body.parts for k, ring in enumerate(part)]
    areas = [(abs(_doubled_area([points[v] for v in ring])), is_hole) for ring, is_hole in rings]
    return sum((-area if is_hole else area for area, is_hole in areas), Fraction(0))


def _doubled_area(points: Sequence[Place]) -> Fraction:
    """Return twice the signed area of a polygon."""
    return sum(
        (a[0] * b[1] - a[1] * b[0] for a, b in pairwise([*points, *points[:1]])),
        Fraction(0),
    )


# Events


def events_lead_to_the_next_tiling(scene: Scene, random: Random) -> str:
    """The edges that events remove and add make of one tiling a later one, and of a fan too."""
    are_points = all(body.size == 1 for body in scene.bodies)
    are_polygons = all(body.closed and body.size > 2 for body in scene.bodies)
    refuse_unless(are_points or are_polygons)  # copies of a vertex have edges of their own
    tiling = "incremental" if are_points else a_tiling(scene, random)
    refuse_unless(tiling in tilings_of(scene))
    run = Simulation(scene, tiling=tiling, fan=are_points)
    edges: Counter[_Edge] | None = None
    compared = 0
    for time in _odd_times(scene, random):
        events = list(run.run(until=time))
        if run.contact is not None:
            break
        if any(event.time == time for event in events):
            edges = None  # the tiling at an event is neither that before nor that after it
            continue
        expected = _edges_between_bodies(run.snapshot(), are_points)
        if edges is not None:
            _replay(edges, events)
            check_equal("edges", +edges, expected)
            compared += bool(events)
        edges = expected
    return f"{tiling}, {_some(compared)} changes"


_Edge: TypeAlias = tuple[str, frozenset[str]]
"""The names of two vertices, and "tiling" or "fan", which has the edges of the tiling too."""


def _odd_times(scene: Scene, random: Random) -> list[Fraction]:
    """Return some times in the span of a scene, at which there is hardly ever an event."""
    span = fraction(scene.exact_end - scene.exact_start)
    parts = sorted(random.sample(range(1, ODD), TIMES))
    return [fraction(scene.exact_start) + span * Fraction(k, ODD) for k in parts]


def _edges_between_bodies(tiling: Snapshot, with_fan: bool) -> Counter[_Edge]:  # noqa: FBT001
    """Return the diagonals between two bodies; those within one may lie inside of it."""
    names = [f"{node.body}:{node.vertex}" for node in tiling.nodes]
    diagonals = [(edge.u, edge.v) for edge in tiling.diagonals]
    parts = {"tiling": diagonals}
    if with_fan:
        parts["fan"] = [*diagonals, *tiling.fan]  # each once: no fan edge is a diagonal
    return Counter(
        (part, frozenset((names[u], names[v])))
        for part, edges in parts.items()
        for u, v in edges
        if tiling.nodes[u].body != tiling.nodes[v].body
    )


def _replay(edges: Counter[_Edge], events: Iterable[RunEvent]) -> None:
    """Apply events to the edges between bodies."""
    for event in events:
        part = "fan" if event.kind == "fan" else "tiling"
        for ends, count in ((event.removed, -1), (event.added, 1)):
            for u, v in ends:
                if u.rpartition(":")[0] != v.rpartition(":")[0]:
                    edges[part, frozenset((u, v))] += count


# Counts


def general_position_needs_no_rebuild(scene: Scene, random: Random) -> str:
    """In general position each event is repaired alone: nothing is built anew, nothing flipped."""
    tiling = a_tiling(scene, random)
    run = Simulation(scene, tiling=tiling)
    events = len(list(run.run()))
    refuse_unless(run.kinetic is not None)
    check_equal("rebuilds", run.stats["rebuilds"], 0)
    check_equal("flips in repairs", run.stats["flips"], 0)
    return f"{tiling}, {_some(events)} events"


def most_decisions_are_of_filters(scene: Scene, random: Random) -> str:
    """In general position filters decide nearly all: exact decisions are fewer than a hundredth."""
    run = Simulation(scene, tiling=a_tiling(scene, random))
    list(run.run())
    exact, filtered = (int(str(run.stats[key])) for key in ("exact", "filtered"))
    refuse_unless(exact + filtered >= FEWEST)
    if exact > EXACT * (exact + filtered):
        raise Difference("exact decisions", f"{exact}, of filters {filtered}")
    return "none is exact" if exact == 0 else "some are exact"


# Arrays


def arrays_are_tiled_as_bodies(scene: Scene, random: Random) -> str:
    """A scene from arrays has the tiling, the counts and the events of its bodies."""
    tiling = a_tiling(scene, random)
    of_arrays, of_bodies = (
        Simulation(_in_arrays(scene), tiling=tiling),
        Simulation(scene, tiling=tiling),
    )
    if of_bodies.contact is None:
        check_equal("tiling", of_arrays.tiling.to_json(), of_bodies.tiling.to_json())
    check_equal("counts at the start", of_arrays.stats, of_bodies.stats)
    events, expected = ([e.to_json() for e in run.run()] for run in (of_arrays, of_bodies))
    check_equal("events", events, expected)
    return f"{tiling}, {_some(len(events))} events"


def _in_arrays(scene: Scene) -> Scene:
    """Return the scene of the same bodies of doubles, in arrays.

    Raises:
        LeftOutError: if a vertex is not constant and a double, or a motion not linear.
    """
    corners: list[list[float]] = []
    offsets, paths = [0], []
    for body in scene.bodies:
        motion = body.motion
        if not isinstance(motion, Translation) or body.has_rings:
            raise LeftOutError
        corners += [[_constant(x), _constant(y)] for x, y in body.vertices]
        offsets.append(len(corners))
        paths.append([_linear(motion.x), _linear(motion.y)])
    return Scene.from_arrays(
        np.array(corners),
        np.array(offsets),
        coefficients=np.array(paths),
        closed=np.array([body.closed for body in scene.bodies]),
        names=[body.name for body in scene.bodies],
        time=(scene.start, scene.end),
    )


def _constant(path: Polynomial) -> float:
    """Return the value of a constant coordinate, a double."""
    refuse_unless(path.degree <= 0)
    return _linear(path)[0]


def _linear(path: Polynomial) -> list[float]:
    """Return the two coefficients, doubles, of a path of degree 1.

    Raises:
        LeftOutError: if they are not doubles, or the degree is higher.
    """
    refuse_unless(path.degree <= 1)
    exact = [*path.coefficients, Fraction(0), Fraction(0)][:2]
    doubles = [float(c) for c in exact]
    refuse_unless([Fraction(c) for c in doubles] == exact)
    return doubles


def _some(count: int) -> str:
    return "no" if count == 0 else "few" if count < 10 else "many"
