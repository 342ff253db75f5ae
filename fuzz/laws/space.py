"""Laws about the free space: places, rays, segments, hulls and shortest paths, by definition."""

from __future__ import annotations

from itertools import pairwise
from random import Random
from typing import Final

import exactpt
from exactpt import FreeSpace, Scene, Simulation
from exactpt.kernel.numbers import QQ, fraction
from exactpt.testing.reference import space as definition
from exactpt.testing.reference.paths import shortest_length
from exactpt.testing.reference.space import Places, Point
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.tilings import a_tiling
from fuzz.questions.free_space import is_inside, path_length, some_point
from fuzz.witnesses import Difference

__all__ = ["a_space", "paths_are_shortest", "places_are_as_defined"]

POINTS: Final = 6
"""Number of points in a case about places."""

PATHS: Final = 2
"""Number of paths in a case about paths."""


def a_space(scene: Scene, random: Random) -> tuple[FreeSpace, Places]:
    """Return the free space at the start, or at a time of the run, and the bodies there."""
    refuse_unless(scene.bodies)
    contact = exactpt.first_contact(scene)
    refuse_unless(contact is None or contact.kind != "initial")
    simulation = Simulation(scene, tiling=a_tiling(scene, random))
    span = scene.exact_end - scene.exact_start
    time = scene.exact_start + span * QQ(random.choice([0, 0, 0, 1, 2, 3]), 8)
    refuse_unless(contact is None or contact.time.compare_rational(time) > 0)
    for _ in simulation.run(until=fraction(time)):
        pass
    return simulation.space(at=fraction(time)), definition.points_of(scene, fraction(time))


def places_are_as_defined(scene: Scene, random: Random) -> str:
    """Places, rays, free segments and the hull are those found by looking at all edges."""
    space, bodies = a_space(scene, random)
    points = [some_point(random, bodies) for _ in range(POINTS)]
    for p, q in pairwise(points):
        place, owner = space.locate(p), definition.owner(p, bodies)
        found = place.body, place.vertex, place.edge
        check_equal(f"the place of {p}", found, owner or (None, None, None))
        if p != q:
            _check_ray(space, bodies, p, q)
    hull = [bodies[body][vertex] for body, vertex in space.hull()]
    corners = definition.convex_hull([p for points in bodies.values() for p in points])
    if not set(corners) <= set(hull):
        raise Difference("hull", f"{hull}, without {set(corners) - set(hull)}")
    return "at the start" if space.at == scene.start else "later"


def _check_ray(space: FreeSpace, bodies: Places, p: Point, q: Point) -> None:
    direction = q[0] - p[0], q[1] - p[1]
    hit, expected = space.ray_cast(p, direction), definition.first_hit(p, direction, bodies)
    found = None if hit is None else (hit.at, hit.body, hit.vertex, hit.edge)
    if found != expected:
        raise Difference("ray", f"from {p} to {q}: {found}, not {expected}")
    is_free = expected is None or expected[0] > 1
    if space.is_free(p, q) != is_free:
        raise Difference("segment", f"from {p} to {q} is {'' if is_free else 'not '}free")


def paths_are_shortest(scene: Scene, random: Random) -> str:
    """Shortest paths are as long as those in the visibility graph, from both ends."""
    space, bodies = a_space(scene, random)
    outcome = "no path"
    for _ in range(PATHS):
        p, q = some_point(random, bodies), some_point(random, bodies)
        if is_inside(p, bodies) or is_inside(q, bodies):
            continue
        expected = shortest_length(bodies, p, q)
        for start, goal in ((p, q), (q, p)):
            found = path_length(space, start, goal)
            is_right = found is None and expected is None
            if found is not None and expected is not None:
                is_right = found.may_be(expected)
            if not is_right:
                raise Difference("path", f"from {start} to {goal}: {found}, not {expected}")
        outcome = "unreachable" if expected is None else "a path"
    return outcome
