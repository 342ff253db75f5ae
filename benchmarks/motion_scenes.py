"""Scenes in any motion, made by what version 0.2 and this one have in common.

This file is imported by the benchmark `motions`; and it is run as a script in two processes, where
`exactpt` is the old or the new package. So it needs nothing but the public interface of both, and
both build their scenes in the same way, from the same numbers.

As a script it reads a request a line (JSON) and writes an answer a line:

    {"scene": "turning", "size": 100, "seed": 0}
    {"seconds": 0.0071, "found": ["1/3"], "doubles": [0.333], "bodies": 100, "vertices": 452}

These are the members of `Asked`. The first line that it writes says what runs:
{"where": "/.../exactpt/__init__.py"}.
"""

from __future__ import annotations

import gc
import inspect
import json
import math
import sys
from collections.abc import Callable, Iterator, Sequence
from random import Random
from time import process_time
from typing import Any, Final, NamedTuple, TypeAlias

import exactpt
from exactpt import (
    Body,
    Contact,
    Pieces,
    Planner,
    Polynomial,
    Rigid,
    Scene,
    Spin,
    Translation,
    first_contact,
)

__all__ = ["BESIDE", "FITTED", "PLANS", "SCENES", "Asked", "measured"]

Points: TypeAlias = "list[tuple[float, float]]"
Make: TypeAlias = Callable[[int, Random], Scene]
"""From a size and a random generator to a scene."""

FEW: Final = 60
"""A scene of fewer vertices is asked about several times, so that a clock can measure it."""

MOTIONS: Final = 200
"""Number of plans among obstacles."""

AWAY: Final = -50
"""Both coordinates of the place of a body that is far from a crowd."""


class Asked(NamedTuple):
    """What a process says about a question.

    Attributes:
        seconds: the processor time of one question, without the building of its scene unless it is
            one of `FITTED`.
        found: the exact time of each first contact, as a text; "none" without one.
        doubles: the same times as doubles; None without a contact.
        bodies, vertices: numbers of these in the scene.
    """

    seconds: float
    found: list[str]
    doubles: list[float | None]
    bodies: int
    vertices: int


# Shapes and places


def _polygon(corners: int, x: float, y: float, radius: float, turn: float) -> Points:
    """Return a regular polygon around (x, y)."""
    angles = [turn + 2.0 * math.pi * i / corners for i in range(corners)]
    return [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]


def _star(points: int, x: float, y: float, radii: tuple[float, float], turn: float) -> Points:
    """Return a star around (x, y); radii of its tips and of its notches."""
    angles = [turn + math.pi * i / points for i in range(2 * points)]
    return [
        (x + radii[i % 2] * math.cos(a), y + radii[i % 2] * math.sin(a))
        for i, a in enumerate(angles)
    ]


def _places(count: int, spacing: int = 1) -> Iterator[tuple[str, int, int]]:
    """Yield a name and a place of a square grid for each body."""
    width = math.ceil(math.sqrt(count))
    for i in range(count):
        yield f"b{i}", spacing * (i % width), spacing * (i // width)


def _velocity(rng: Random, speed: float) -> Translation:
    return Translation([0.0, rng.uniform(-speed, speed)], [0.0, rng.uniform(-speed, speed)])


def _spin(
    omega: str | int, pivot: tuple[float, float], error: str, x: Sequence[str | int] = ()
) -> Spin:
    """Return a turn at a constant rate; version 0.2 must know for which times it is needed."""
    is_old = "time" in inspect.signature(Spin).parameters
    during: dict[str, Any] = {"time": (0, 10)} if is_old else {}
    return Spin(omega, pivot, error=error, x=x, **during)


# Scenes


def _two_triangles(size: int, rng: Random) -> Scene:  # noqa: ARG001
    moving = Body("a", _polygon(3, 0, 0, 1, 0.3), Translation([0, 0.7], [0, 0.1]))
    other = Body("b", _polygon(3, 5, 0.4, 1, 1.2), Translation([0, -0.3], [0, 0.02]))
    return Scene([moving, other], time=(0, 10))


def _parabola(size: int, rng: Random) -> Scene:  # noqa: ARG001
    thrown = Body("a", _polygon(3, 0, 0, 1, 0.3), Translation([0, 1], [0, 2, -1]))
    return Scene([thrown, Body("b", _polygon(3, 2, 0.4, 1, 1.2))], time=(0, 10))


def _two_turning(size: int, rng: Random) -> Scene:  # noqa: ARG001
    turning = Body("a", _polygon(4, 0, 0, 1, 0), Rigid([0, "1/2"], x=[0, "1/4"]))
    return Scene([turning, Body("b", _polygon(4, 5, 0.4, 1, 0.3))], time=(0, 20))


def _two_spins(size: int, rng: Random) -> Scene:  # noqa: ARG001
    """Two convex polygons that turn at constant rates; the pieces are fitted to within 10^-4."""
    moving = _spin(1, (0, 0), "1/10000", x=[0, "1/8"])
    staying = _spin("-1/2", (3, 0.2), "1/10000")
    pentagon = Body("a", _polygon(5, 0, 0, 1, 0.1), moving)
    square = Body("b", _polygon(4, 3, 0.2, 1, 0.3), staying)
    return Scene([pentagon, square], time=(0, 10))


def _spins_apart(size: int, rng: Random) -> Scene:
    """Bodies that turn at one rate and never touch."""
    bodies = [
        Body(name, _polygon(4, x, y, 1, rng.uniform(0, 6)), _spin(1, (x, y), "1/1000"))
        for name, x, y in _places(size, 3)
    ]
    return Scene(bodies, time=(0, 10))


def _crowd(size: int, rng: Random, radius: float, speed: float) -> list[Body]:
    """Return convex bodies in straight motion, one in each cell of width 1."""
    bodies = []
    for name, x, y in _places(size):
        corners, turn = rng.randint(3, 6), rng.uniform(0, 6)
        outline = _polygon(corners, x + 0.5, y + 0.5, radius * rng.uniform(0.7, 1), turn)
        bodies.append(Body(name, outline, _velocity(rng, speed)))
    return bodies


def _dense(size: int, rng: Random) -> Scene:
    return Scene(_crowd(size, rng, 0.4, 1), time=(0, 1))


def _sparse(size: int, rng: Random) -> Scene:
    return Scene(_crowd(size, rng, 0.06, 1), time=(0, 1))


def _turning_bodies(size: int, rng: Random, radius: float, terms: int) -> list[Body]:
    """Return convex bodies that turn about their middles and drift.

    Args:
        size: the number of bodies.
        rng: a random generator.
        radius: their radius, in cells of width 1.
        terms: the degree of the half-tangents in time: with 2, the rates of turning change.
    """
    bodies = []
    for name, left, below in _places(size):
        x, y = left + 0.5, below + 0.5
        motion = Rigid(
            [0, *(rng.uniform(-1, 1) for _ in range(terms))],
            x=[0, rng.uniform(-0.2, 0.2)],
            y=[0, rng.uniform(-0.2, 0.2)],
            pivot=(x, y),
        )
        outline = _polygon(rng.randint(3, 6), x, y, radius, rng.uniform(0, 6))
        bodies.append(Body(name, outline, motion))
    return bodies


def _turning(size: int, rng: Random) -> Scene:
    return Scene(_turning_bodies(size, rng, 0.3, terms=1), time=(0, 1))


def _turning_faster(size: int, rng: Random) -> Scene:
    """Larger convex bodies whose rates of turning grow."""
    return Scene(_turning_bodies(size, rng, 0.45, terms=2), time=(0, 4))


def _turning_stars(size: int, rng: Random) -> Scene:
    """Ten-pointed stars that turn and do not touch: the tips of neighbours pass close by."""
    bodies = []
    for i, (name, x, y) in enumerate(_places(size)):
        outline = _star(10, x, y, (0.49, 0.2), rng.uniform(0, 6))
        bodies.append(Body(name, outline, Rigid([0, "1/2" if i % 2 else "-1/3"], pivot=(x, y))))
    return Scene(bodies, time=(0, 4))


def _deforming(size: int, rng: Random) -> Scene:
    """Stars of 16 vertices, each of which moves straight on its own."""
    bodies = []
    for name, x, y in _places(size, 100):
        vertices = [
            (Polynomial([u, rng.randint(-10, 10)]), Polynomial([v, rng.randint(-10, 10)]))
            for u, v in _star(8, x, y, (48.0, 30.0), rng.uniform(0, 6))
        ]
        bodies.append(Body(name, vertices))
    return Scene(bodies, time=(0, 4))


def _combs(size: int, rng: Random) -> Scene:  # noqa: ARG001
    """Two interlocked combs, with teeth of width 2 at distance 8; one drifts along the teeth."""
    teeth = (size // 2 - 4) // 4
    lower = [(-2, -2), (8 * teeth, -2), (8 * teeth, 0)]
    for x in range(8 * (teeth - 1), -1, -8):
        lower += [(x + 2, 0), (x + 2, 9), (x, 9), (x, 0)]
    lower.append((-2, 0))
    upper = [(x + 4, 11 - y) for x, y in reversed(lower)]
    drift = Translation([0, "1/7"], [0, "1/5"])
    return Scene([Body("a", lower), Body("b", upper, drift)], time=(0, 41))


def _holes(size: int, rng: Random) -> Scene:
    """Frames with a hexagonal hole, and a square in each hole: half of the bodies are frames."""
    bodies = []
    for name, x, y in _places(size // 2, 3):
        square = [(x - 1, y - 1), (x + 1, y - 1), (x + 1, y + 1), (x - 1, y + 1)]
        hole = _polygon(6, x, y, 0.8, 0)
        bodies.append(Body(f"frame {name}", square, _velocity(rng, 0.2), holes=[hole]))
        bodies.append(Body(name, _polygon(4, x, y, 0.3, 0.2), _velocity(rng, 0.2)))
    return Scene(bodies, time=(0, 5))


def _discs(size: int, rng: Random) -> Scene:
    bodies = [
        Body(name, [(x + 0.5, y + 0.5)], _velocity(rng, 1), radius=rng.uniform(0.1, 0.3))
        for name, x, y in _places(size)
    ]
    return Scene(bodies, time=(0, 1))


SCENES: Final[dict[str, Make]] = {
    "two triangles": _two_triangles,
    "a triangle on a parabola": _parabola,
    "a square that turns": _two_turning,
    "two polygons with constant rates": _two_spins,
    "constant rates, apart": _spins_apart,
    "a dense crowd": _dense,
    "a sparse crowd": _sparse,
    "turning bodies": _turning,
    "turning bodies, faster and faster": _turning_faster,
    "turning stars, apart": _turning_stars,
    "combs": _combs,
    "holes": _holes,
    "deforming stars": _deforming,
    "discs": _discs,
}
"""Scenes by name. Sizes are numbers of bodies; of combs, of vertices."""

FITTED: Final = ("two polygons with constant rates", "constant rates, apart")
"""Scenes of motions that are not rational: pieces are fitted to them.

Version 0.2 fits all of them as a motion is built, this one as a search comes to their times. So of
these scenes the time of a question has that of the building.
"""


def _far_square(motion: Translation | Rigid | Pieces) -> Body:
    """Return a square that is far from a crowd."""
    return Body("far", _polygon(4, AWAY, AWAY, 1, 0), motion)


def _far_disc() -> Body:
    return Body("far", [(AWAY, AWAY)], radius=1)


def _far_hole() -> Body:
    hole = _polygon(4, AWAY, AWAY, 1, 0)
    return Body("far", _polygon(4, AWAY, AWAY, 3, 0), holes=[hole])


SLOW: Final = Translation([0, "1/7"])

BESIDE: Final[dict[str, Callable[[], Body] | None]] = {
    "nothing": None,
    "65 vertices": lambda: Body("far", _polygon(65, AWAY, AWAY, 1, 0)),
    "a turn": lambda: _far_square(Rigid([0, "1/7"], pivot=(AWAY, AWAY))),
    "a parabola": lambda: _far_square(Translation([0, "1/7"], [0, 0, "1/9"])),
    "a disc": _far_disc,
    "a hole": _far_hole,
    "two pieces": lambda: _far_square(Pieces([("1/2", SLOW), (None, Translation(["1/14"]))])),
    "a third": lambda: Body("far", [("1/3", AWAY), (2, AWAY), (1, AWAY + 1)]),
}
"""What is far from a sparse crowd: a body that is unlike those of the crowd in this."""

PLANS: Final = "plans among obstacles"


# Questions


def measured(name: str, size: int, seed: int) -> Asked:
    """Ask about a scene, built anew.

    Args:
        name: one of `SCENES` or `BESIDE`, or `PLANS`.
        size: the number of bodies, of vertices or of obstacles.
        seed: seed of everything random.
    """
    if name == PLANS:
        return _measured_plans(size, Random(f"{name} {size} {seed}"))
    scene = _scene(name, size, seed)
    count = 1 + FEW // scene.vertex_count
    if name in FITTED:
        seconds, contacts = _timed(
            lambda: [first_contact(_scene(name, size, seed)) for _ in range(count)]
        )
    else:
        copies = [_scene(name, size, seed) for _ in range(count)]
        seconds, contacts = _timed(lambda: [first_contact(copy) for copy in copies])
    return _asked(seconds, contacts, len(scene.bodies), scene.vertex_count)


def _scene(name: str, size: int, seed: int) -> Scene:
    if name in BESIDE:  # the crowd is the same, whatever is beside it
        crowd = _crowd(size, Random(f"beside {size} {seed}"), 0.06, 1)
        far = BESIDE[name]
        return Scene(crowd if far is None else [*crowd, far()], time=(0, 1))
    return SCENES[name](size, Random(f"{name} {size} {seed}"))


def _measured_plans(size: int, rng: Random) -> Asked:
    """Measure plans of a square among obstacles that rest; the planner is prepared before."""
    width = math.ceil(math.sqrt(size))
    obstacles = [
        Body(name, _polygon(rng.randint(3, 6), x + 0.5, y + 0.5, 0.25, rng.random()))
        for name, x, y in _places(size)
    ]
    shape = _polygon(4, 0, 0, 0.05, 0.3)
    motions = [
        Translation(*([rng.randrange(width), rng.uniform(-3, 3)] for _ in "xy"))
        for _ in range(MOTIONS)
    ]
    planner = Planner(obstacles, time=(0, 1))
    planner.first_contacts(shape, motions[:3])  # what is prepared once, is prepared at the first
    seconds, contacts = _timed(lambda: planner.first_contacts(shape, motions))
    vertices = sum(body.size for body in obstacles) + len(shape)
    return _asked(seconds, contacts, len(obstacles) + 1, vertices)


def _timed(ask: Callable[[], list[Contact | None]]) -> tuple[float, list[Contact | None]]:
    """Return the processor time of a function in seconds, and its result."""
    gc.collect()
    start = process_time()
    contacts = ask()
    return process_time() - start, contacts


def _asked(seconds: float, contacts: list[Contact | None], bodies: int, vertices: int) -> Asked:
    """Return what is said about questions that have taken some seconds in all."""
    times = [None if contact is None else contact.time for contact in contacts]
    return Asked(
        seconds / len(contacts),
        ["none" if time is None else str(time) for time in times],
        [None if time is None else float(time) for time in times],
        bodies,
        vertices,
    )


def _main() -> None:
    _say({"where": exactpt.__file__})
    for line in sys.stdin:
        request = json.loads(line)
        asked = measured(request["scene"], request["size"], request["seed"])
        _say(asked._asdict())


def _say(value: object) -> None:
    sys.stdout.write(json.dumps(value) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    _main()
