"""Places, rays, free segments and shortest paths in the free space at a time, by definition."""

from __future__ import annotations

from random import Random
from typing import Final

from exactpt import FreeSpace, Scene, Simulation, UnreachableError, first_contact
from exactpt.kernel.numbers import QQ, fraction
from exactpt.testing.reference import space as definition
from exactpt.testing.reference.paths import Length, length_of, shortest_length
from exactpt.testing.reference.space import Places, Point
from exactpt.testing.scenes import generate
from fuzz.changes.awkward import awkward
from fuzz.changes.excerpts import subscene
from fuzz.questions.scenes import crowded_scene
from fuzz.questions.tiny import touching_scene
from fuzz.witnesses import tilings_of

__all__ = ["is_inside", "path_length", "some_point", "wrong_path", "wrong_place"]

FAMILIES: Final = ("convex", "stars", "combs", "letters", "chains", "chains_on_grid", "small_grid",
                   "bodies_on_grid", "linear_points", "points_in_line", "frames")  # fmt: skip

ASKED: Final = 6
"""Number of points in a case about places."""

PATHS: Final = 3
"""Number of paths in a case."""

MOST: Final = 24
"""Maximum number of vertices of a case about paths: the visibility graph takes long."""


def wrong_place(random: Random) -> tuple[Scene, str, str | None]:
    """Return a scene, the tiling that is asked, and a wrong place, ray or free segment."""
    scene, tiling, space = _space(random)
    bodies = definition.points_of(scene, space.at)
    points = [some_point(random, bodies) for _ in range(ASKED)]
    for k, p in enumerate(points):
        place, owner = space.locate(p), definition.owner(p, bodies)
        if (place.body, place.vertex, place.edge) != (owner or (None, None, None)):
            return scene, tiling, f"{p} is in {place}, not in {owner}"
        q = points[k - 1]
        fault = None if p == q else _wrong_ray(space, bodies, p, q)
        if fault is not None:
            return scene, tiling, fault
    return scene, tiling, None


def _wrong_ray(space: FreeSpace, bodies: Places, p: Point, q: Point) -> str | None:
    """Return the fault of the ray from p through q, or of the segment."""
    direction = q[0] - p[0], q[1] - p[1]
    hit, expected = space.ray_cast(p, direction), definition.first_hit(p, direction, bodies)
    found = None if hit is None else (hit.at, hit.body, hit.vertex, hit.edge)
    if found != expected:
        return f"the ray from {p} to {q} hits {found}, not {expected}"
    is_free = expected is None or expected[0] > 1
    if space.is_free(p, q) != is_free:
        return f"the segment from {p} to {q} is {'' if is_free else 'not '}free"
    if space.is_free(q, p) != is_free:
        return f"the segment from {q} to {p} is {'' if is_free else 'not '}free"
    return None


def wrong_path(random: Random) -> tuple[Scene, str, str | None]:
    """Return a scene, the tiling that is asked, and a path that is not the shortest one."""
    scene, tiling, space = _space(random, MOST)
    bodies = definition.points_of(scene, space.at)
    for _ in range(PATHS):
        p, q = some_point(random, bodies), some_point(random, bodies)
        if any(is_inside(point, bodies) for point in (p, q)):
            continue
        expected = shortest_length(bodies, p, q)
        for start, goal in ((p, q), (q, p)):
            found = path_length(space, start, goal)
            if (found is None) != (expected is None):
                return scene, tiling, f"from {start} to {goal}: {found}, not {expected}"
            if found is not None and expected is not None and not found.may_be(expected):
                return scene, tiling, f"from {start} to {goal}: {found}, not {expected}"
    return scene, tiling, None


def path_length(space: FreeSpace, start: Point, goal: Point) -> Length | None:
    """Return the length of the shortest path; None if there is no path."""
    try:
        return length_of(space.shortest_path(start, goal).points)
    except UnreachableError:
        return None


def is_inside(point: Point, bodies: Places) -> bool:
    """Return True if a point is in the interior of a body."""
    owner = definition.owner(point, bodies)
    return owner is not None and owner[1:] == (None, None)


def _space(random: Random, most: int = 60) -> tuple[Scene, str, FreeSpace]:
    """Return a scene without a contact at its start, and its space there or a little later."""
    while True:
        scene = _scene(random)
        contact = first_contact(scene)
        if scene.vertex_count > most or (contact is not None and contact.kind == "initial"):
            continue
        names = tilings_of(scene)
        if not names:
            continue
        tiling = random.choice(names)
        simulation = Simulation(scene, tiling=tiling)
        at = scene.exact_start + (scene.exact_end - scene.exact_start) * QQ(
            random.choice([0, 0, 1, 2, 3]), 8
        )
        if contact is not None and contact.time.compare_rational(at) <= 0:
            at = scene.exact_start
        for _ in simulation.run(until=fraction(at)):
            pass
        return scene, tiling, simulation.space(at=fraction(at))


def _scene(random: Random) -> Scene:
    kind = random.randrange(4)
    if kind == 0:
        return crowded_scene(random)
    if kind == 1:
        return touching_scene(random)
    scene = subscene(generate(random.choice(FAMILIES), random.getrandbits(20)), random)
    return scene if kind == 2 else awkward(scene, random)


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
