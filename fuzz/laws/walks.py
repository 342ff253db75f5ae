"""Laws about walks: shortened ones are taut, and can be deformed into the walk; so are hulls."""

from __future__ import annotations

from itertools import pairwise
from random import Random
from typing import Final

from exactpt import FreeSpace, InputError, Scene, ShortestPath
from exactpt.geometry.predicates import orient2d
from exactpt.testing.reference import homotopy
from exactpt.testing.reference import space as definition
from exactpt.testing.reference.shapes import is_on_segment
from exactpt.testing.reference.space import Places, Point
from fuzz.laws.law import check_equal
from fuzz.laws.space import a_space, some_point
from fuzz.witnesses import Difference

__all__ = ["relative_hulls_are_taut", "shortened_walks_are_taut"]

WALKS: Final = 3
"""Number of walks in a case."""

STEPS: Final = 12
"""Maximum number of steps of a walk that are tried."""


def shortened_walks_are_taut(scene: Scene, random: Random) -> str:
    """A shortened walk has no body in its way, one at each bend, and is homotopic to the walk.

    So it is the shortest path of its class.
    """
    asked = a_space(scene, random)
    space, bodies, _ = asked
    obstacles = homotopy.split_into_parts(bodies)
    inner = {name: homotopy.inner_point(points, random) for name, points in obstacles.items()}
    bends = 0
    for _ in range(WALKS):
        walk = _a_walk(space, bodies, random)
        try:
            path, direct = space.shorten(walk), space.path(walk[0], walk[-1])
        except InputError:  # the walk begins in a body
            continue
        check_equal("ends of a walk", (path.points[0], path.points[-1]), (walk[0], walk[-1]))
        _check_taut(path, bodies)
        _check_taut(direct, bodies)
        anchors = homotopy.anchors_beside(path.points, obstacles, inner)
        found, expected = (
            homotopy.crossing_word(points, anchors) for points in (path.points, walk)
        )
        check_equal("class of a walk", found, expected)
        fresh = asked.anew()
        check_equal("path of a space not asked before", fresh.path(walk[0], walk[-1]), direct)
        bends += len(path.bends)
    return "no bends" if bends == 0 else "some bends"


def _a_walk(space: FreeSpace, bodies: Places, random: Random) -> list[Point]:
    """Return a walk of free steps; its first point may be in a body."""
    walk = [some_point(random, bodies)]
    for _ in range(random.randint(1, STEPS)):
        p = some_point(random, bodies)
        if len(walk) == 1 and not space.locate(walk[0]).is_free:
            walk = [p]
        elif space.is_free(walk[-1], p):
            walk.append(p)
    return walk


def _check_taut(path: ShortestPath, bodies: Places) -> None:
    points = path.points
    if any(definition.crosses(p, q, bodies) for p, q in pairwise(points)):
        raise Difference("a body in the way", f"{points}")
    for i, (name, vertex) in enumerate(path.bends):
        check_equal("place of a bend", bodies[name][vertex], points[i + 1])
        before, here, after = points[i : i + 3]
        if not definition.bends_around(before, here, after, bodies[name], vertex):
            raise Difference("not taut", f"{points} at vertex {vertex} of {name!r}")


def relative_hulls_are_taut(scene: Scene, random: Random) -> str:
    """A relative hull goes around one body and no other, has none in the way, and is taut."""
    space, bodies, _ = a_space(scene, random)
    inner = {name: homotopy.inner_point(points, random) for name, points in bodies.items()}
    outcomes = set()
    for body, own in bodies.items():
        try:
            hull = space.relative_hull(body)
        except InputError as error:
            if "several parts" not in str(error):
                raise
            outcomes.add("several parts")
            continue
        if len(own) < 3:
            check_equal("hull of a segment", set(hull), {(body, v) for v in range(len(own))})
            continue
        points = [bodies[name][vertex] for name, vertex in hull]
        _check_loop(body, hull, points, bodies)
        _check_inside(body, points, bodies, inner)
        others = {name for name, _ in hull} - {body}
        outcomes.add("touches others" if others else "its own")
    return ", ".join(sorted(outcomes)) or "segments"


def _check_loop(
    body: str, hull: list[tuple[str, int]], points: list[Point], bodies: Places
) -> None:
    for i, (name, vertex) in enumerate(hull):
        before, here, after = points[i - 1], points[i], points[(i + 1) % len(points)]
        if definition.crosses(here, after, bodies):
            raise Difference("a body in the hull", f"of {body!r}: {here} to {after}")
        turn = orient2d(before, here, after)
        if turn and not (
            (turn < 0 or name == body)
            and definition.bends_around(before, here, after, bodies[name], vertex)
        ):
            raise Difference("hull not taut", f"of {body!r} at vertex {vertex} of {name!r}")


def _check_inside(body: str, points: list[Point], bodies: Places, inner: dict[str, Point]) -> None:
    """Check that a loop winds around its body and those in its holes, and around no other."""
    for name, p in inner.items():
        if any(is_on_segment(p, points[i - 1], points[i]) for i in range(len(points))):
            is_thin = len(bodies[name]) < 3 or isinstance(bodies[name], definition.OpenChain)
            if not is_thin:
                raise Difference("hull", f"of {body!r} runs through {name!r}")
            continue
        is_around = name == body or definition.is_in_hole(p, bodies[body])
        check_equal("winding of a hull", definition.winding(p, points), int(is_around))
