"""How run time grows with the size of queries of users: families of scenes at three sizes.

The exponent is that of the least-squares fit of c w^p to the processor time, w being the work of
the result: the number of queries, bodies, vertices or pieces, or its square where every pair is
in the result. Families with an exponent above the limit are cliffs.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Final, NamedTuple, TypeAlias

from benchmarks.output import Output, Row
from benchmarks.timing import exponent, timed
from benchmarks.user_families import USER_FAMILIES
from exactpt import (
    Affine,
    Body,
    FreeSpace,
    Pieces,
    Planner,
    PosePath,
    Rigid,
    Scene,
    Simulation,
    Spin,
    Translation,
    Velocity,
    clearance,
    contact_intervals,
    contacts,
    distance,
    first_contact,
    first_within,
    in_local_time,
    prove,
)  # fmt: skip

__all__ = ["FAMILIES", "FULL", "QUICK", "Sizes", "run"]

Point: TypeAlias = tuple[float, float]
Ask: TypeAlias = "Callable[[], object]"

SHORTEST: Final = 0.02
"""Seconds that the least size takes, at full size: smaller ones are passed over."""
LONGEST: Final = 10.0
"""Seconds after which the sizes of a family end."""
LARGEST: Final = 100
"""No size above so many times the least one: a question that never takes long would not end."""


class Family(NamedTuple):
    """A family of questions: makes one of a size, from this size on, with this exponent of work."""

    make: Callable[[int], Ask]
    size: int
    work: float = 1.0


class Sizes(NamedTuple):
    """The part of each least size that is taken, the number of sizes, the families (or all)."""

    share: float
    steps: int
    families: tuple[str, ...] = ()


QUICK: Final = Sizes(0.2, 2)
FULL: Final = Sizes(1.0, 3)


def run(output: Output, sizes: Sizes, seed: int) -> list[Row]:
    """Measure all families; the rows of the table."""
    rows: list[Row] = []
    for name in sizes.families or FAMILIES:
        output.progress(f"exponents: {name}")
        rows.append(_row(name, sizes))
    output.say(f"seeds are fixed (seed {seed} is not used); times in seconds of processor time")
    output.table("exponents", rows)
    return rows


def _row(name: str, sizes: Sizes) -> Row:
    family = FAMILIES[name]
    family.make(max(2, round(family.size * sizes.share)))()  # the first use imports
    counts: list[int] = []
    seconds: list[float] = []
    n = max(2, round(family.size * sizes.share))
    while len(counts) < sizes.steps and not (seconds and seconds[-1] > LONGEST):
        repetitions = 1 if seconds and seconds[-1] > 0.5 else 3
        taken = min(_seconds_of(family.make(n)) for _ in range(repetitions))
        is_long_enough = taken >= SHORTEST * sizes.share or n > LARGEST * family.size
        if counts or is_long_enough:
            counts.append(n)
            seconds.append(taken)
        n *= 2
    return {
        "family": name,
        "sizes": " ".join(map(str, counts)),
        "seconds": " ".join(f"{s:.3g}" for s in seconds),
        "exponent": exponent([n**family.work for n in counts], seconds),
    }


def _seconds_of(ask: Ask) -> float:
    """The time of a question asked once: a scene keeps what its first question has computed."""
    return timed(ask)[1]


# Shapes


def _ngon(m: int, x: float, y: float, r: float, turn: float = 0.0) -> list[Point]:
    turns = (turn + 2.0 * math.pi * i / m for i in range(m))
    return [(x + r * math.cos(a), y + r * math.sin(a)) for a in turns]


def _gear(m: int, x: float = 0.0, inner: float = 0.8) -> list[Point]:
    r = 2.0
    turns = ((i, 2.0 * math.pi * i / m) for i in range(m))
    radii = ((r if i % 2 else inner * r, a) for i, a in turns)
    return [(x + s * math.cos(a), s * math.sin(a)) for s, a in radii]


def _crowd(k: int, radius: float = 0.06, speed: float = 1.0, seed: int = 1) -> list[Body]:
    """Pentagons in the cells of a grid, with random velocities."""
    random, side = Random(f"exponents {seed}"), math.isqrt(k - 1) + 1
    bodies = []
    for i in range(k):
        x, y = i % side + random.uniform(0.3, 0.7), i // side + random.uniform(0.3, 0.7)
        vx, vy = random.uniform(-speed, speed), random.uniform(-speed, speed)
        bodies.append(Body(f"b{i}", _ngon(5, x, y, radius), Translation([0, vx], [0, vy])))
    return bodies


def _space(k: int) -> FreeSpace:
    return Simulation(Scene(_crowd(k, 0.3, 0.01), time=(0, "1/10"))).space()


def _points(k: int, bodies: int) -> list[Point]:
    random, side = Random("points"), math.sqrt(bodies)
    return [(random.uniform(0, side), random.uniform(0, side)) for _ in range(k)]


def _two(a: list[Point], b: list[Point], *motions: Rigid | Translation) -> Scene:
    return Scene([Body("a", a, motions[0]), Body("b", b, *motions[1:])], time=(0, 10))


# Families


def _locate(bodies: int) -> Ask:
    space = _space(bodies)
    places = _points(1000, bodies)
    return lambda: [space.locate(p) for p in places]


def _locate_many(queries: int) -> Ask:
    space, places = _space(300), _points(queries, 300)
    return lambda: space.locate_many(places)


def _rays(queries: int) -> Ask:
    space, random = _space(300), Random("rays")
    return lambda: [space.ray_cast(p, (1, random.random())) for p in _points(queries, 300)]


def _shortest_path(bodies: int) -> Ask:
    run, side = Simulation(Scene(_crowd(bodies, 0.3, 0.01), time=(0, "1/10"))), math.sqrt(bodies)
    return lambda: run.shortest_path((-1, -1), (side + 1, side + 1))


def _distance(n: int) -> Ask:
    scene = _two(_ngon(n, 0, 0, 1), _ngon(n, 5, 1, 1), Translation([0]))
    return lambda: distance(scene, "a", "b", 1)


def _within(scene: Scene) -> object:
    return first_within(scene, distance="1/100")


def _clearance_translating(n: int) -> Ask:
    moving = Translation([0, Fraction(-1, 10)], [0, Fraction(1, 100)])
    scene = _two(_ngon(n, 5, 1, 1), _ngon(n, 0, 0, 1), moving)
    return lambda: clearance(scene, "a", "b").minimum


def _clearance_turning(n: int) -> Ask:
    scene = _two(_ngon(n, 0, 0, 1), _ngon(n, 5, 1, 1), Rigid([0, "1/2"]))
    return lambda: clearance(scene, "a", "b").minimum


def _clearance_to_all(bodies: int) -> Ask:
    scene = Scene(_crowd(bodies, speed=0.2), time=(0, 1))
    return lambda: clearance(scene, "b0").minimum


def _intervals_of_gears(teeth: int) -> Ask:
    scene = _two(
        _gear(2 * teeth), _gear(2 * teeth, 3.0), Rigid([0, 1]), Rigid([0, -1], pivot=(3, 0))
    )
    return lambda: contact_intervals(scene, "a", "b")


def _oscillating(pieces: int) -> Ask:
    swings = [(1, Velocity(3 * (-1) ** k, 0)) for k in range(pieces)]
    scene = Scene(
        [Body("a", _ngon(6, 0, 0, 0.5), in_local_time(swings)), Body("b", _ngon(6, 3, 0, 0.5))],
        time=(0, pieces),
    )
    return lambda: contact_intervals(scene, "a", "b")


def _first(bodies: list[Body], end: int = 10) -> Ask:
    return lambda: first_contact(Scene(bodies, time=(0, end)))


def _fragments(n: int) -> Ask:
    """Fragments that fly apart from a ring, without a contact."""
    random, bodies = Random("fragments"), []
    for i in range(n):
        a, r = 2.0 * math.pi * i / n, n / 5.0
        speed = random.uniform(1, 2)
        motion = Translation([0, speed * math.cos(a)], [0, speed * math.sin(a)])
        bodies.append(Body(f"f{i}", _ngon(4, r * math.cos(a), r * math.sin(a), 0.3), motion))
    return _first(bodies)


def _explosion(n: int) -> Ask:
    """Bodies that fly apart at one speed for a long time: their swept boxes overlap."""
    bodies = []
    for i in range(n):
        a, r = 2.0 * math.pi * i / n, n / 3.0
        motion = Translation([0, math.cos(a)], [0, math.sin(a)])
        bodies.append(Body(f"f{i}", _ngon(5, r * math.cos(a), r * math.sin(a), 0.3), motion))
    return _first(bodies, 10**6)


def _planks(degrees: float, n: int) -> Ask:
    """Long thin bodies side by side, along a direction."""
    random, a = Random("planks"), math.radians(degrees)
    c, s = math.cos(a), math.sin(a)
    bodies = []
    for i in range(n):
        x, y = -1.5 * i * s, 1.5 * i * c
        end = x + 1000 * c, y + 1000 * s
        shape = [(x, y), end, (end[0] - 0.1 * s, end[1] + 0.1 * c)]
        drift = Translation([0, random.uniform(-0.1, 0.1)], [0, random.uniform(-0.1, 0.1)])
        bodies.append(Body(f"p{i}", shape, drift))
    return _first(bodies, 3)


def _waypoints(pieces: int) -> Ask:
    """Twenty bodies that turn at many waypoints."""
    bodies = []
    for k in range(20):
        legs = [(1, Velocity((-1) ** i, (-1) ** (i // 2))) for i in range(pieces)]
        bodies.append(Body(f"w{k}", _ngon(4, 5 * k, 0, 1), in_local_time(legs)))
    return _first(bodies, pieces)


def _keyframes(frames: int) -> Ask:
    bodies = []
    for k in range(5):
        ring = _ngon(4, 9 * k, 0, 1)
        at = [(t, [(x + t % 2, y) for x, y in ring]) for t in range(frames)]
        bodies.append(Body(f"k{k}", keyframes=at))
    return _first(bodies, frames - 1)


def _far(bodies: int) -> Ask:
    """Triangles at an exact offset of 10^18."""
    random, side = Random("far"), math.isqrt(bodies) + 1
    made = []
    for i in range(bodies):
        x, y = 10**18 + 4 * (i % side), 4 * (i // side)
        u, v = (Fraction(random.randint(-9, 9), 16) for _ in "xy")
        shape = [(x, y), (x + 1, y), (x, y + 1)]
        made.append(Body(f"b{i}", shape, Translation([0, u], [0, v])))
    return _first(made)


def _plate(holes: int, *, filled: bool = False) -> Ask:
    """A plate with holes; its first contact with a ball in each, or the scene alone."""
    side = math.isqrt(holes - 1) + 1
    centres = [(2 * (i % side) + 1, 2 * (i // side) + 1) for i in range(holes)]
    rings = [_ngon(6, x, y, 0.8) for x, y in centres]
    w = 2 * side
    outline = [(0, 0), (w, 0), (w, w), (0, w)]
    if filled:
        rolling = Translation([0, "1/100"])
        balls = [Body(f"b{i}", _ngon(4, x, y, 0.3), rolling) for i, (x, y) in enumerate(centres)]
        return _first([Body("plate", outline, holes=rings), *balls])
    return lambda: Scene([Body("plate", outline, holes=rings)], time=(0, 1))


def _comb(vertices: int) -> Ask:
    teeth = [p for i in range(vertices // 2) for p in ((i, 0.0), (i + 0.5, -5.0))]
    shape = [(-1.0, 3.0), *teeth, (vertices / 2, 3.0)]
    return lambda: Scene([Body("comb", shape)], time=(0, 1))


def _big_gear(vertices: int) -> Ask:
    shape = _gear(vertices, inner=0.9)
    return lambda: Scene([Body("gear", shape)], time=(0, 1))


def _spinners(n: int) -> Ask:
    def made() -> object:
        bodies = [Body(f"s{i}", _ngon(4, 3 * i, 0, 1), Spin(1, error="1/1000")) for i in range(n)]
        return first_contact(Scene(bodies, time=(0, 10)))

    return made


def _pose_paths(poses: int) -> Ask:
    rows = [([i, 1], [0], [i, 1]) for i in range(poses)]
    return lambda: PosePath(range(poses + 1), rows, error="1/1000")


def _deforming(bodies: int) -> Ask:
    grow = Affine([[[1, "1/100"], [0]], [[0], [1, "1/100"]]], x=[0], y=[0])
    made = []
    for i in range(bodies):
        motion = Pieces([(1, Translation([0])), (None, Translation([-1, 1]))]) if i % 2 else grow
        made.append(Body(f"d{i}", _ngon(5, 6 * i, 0, 1), motion))
    return _first(made, 3)


def _plans(obstacles: int) -> Ask:
    side = math.isqrt(obstacles - 1) + 1
    walls = [Body(f"o{i}", _ngon(5, 5 * (i % side), 5 * (i // side), 1)) for i in range(obstacles)]
    planner, random = Planner(walls, time=(0, 10)), Random("plans")
    ways = [
        Translation([0, random.uniform(-1, 1)], [0, random.uniform(-1, 1)]) for _ in range(50)
    ]  # fmt: skip
    return lambda: planner.first_contacts(_ngon(4, 2.5, 2.5, 0.3), ways)


def _of_crowd(question: Callable[[Scene], object], radius: float, speed: float, n: int) -> Ask:
    scene = Scene(_crowd(n, radius, speed), time=(0, 3))
    return lambda: question(scene)


def _events(n: int) -> Ask:
    scene = Scene(_crowd(n, speed=0.1), time=(0, 1))
    return lambda: sum(1 for _ in Simulation(scene, tiling="lazy").run())


def _drawing(n: int) -> Ask:
    scene = Scene(_crowd(n, speed=0.1), time=(0, 1))

    def drawn() -> None:
        with TemporaryDirectory() as folder:
            scene.draw(Path(folder, "film.html"))

    return drawn


FAMILIES: Final[dict[str, Family]] = {
    "locate, by bodies": Family(_locate, 250, 0.3),
    "locate_many": Family(_locate_many, 2000),
    "ray_cast": Family(_rays, 100),
    "shortest_path": Family(_shortest_path, 60, 1.5),
    "clearance, translating": Family(_clearance_translating, 60),
    "clearance, turning": Family(_clearance_turning, 6),
    "clearance to all others": Family(_clearance_to_all, 100),
    "distance": Family(_distance, 60, 2.0),
    "contact_intervals, gears": Family(_intervals_of_gears, 10, 2.0),
    "contact_intervals, oscillating": Family(_oscillating, 50),
    "contacts of a crowd": Family(partial(_of_crowd, contacts, 0.1, 1.0), 60),
    "first_within of a crowd": Family(partial(_of_crowd, _within, 0.06, 1.0), 1000),
    "first_contact, fragments": Family(_fragments, 250),
    "first_contact, explosion": Family(_explosion, 250),
    "first_contact, plate with balls": Family(partial(_plate, filled=True), 100),
    "first_contact, planks at 45 degrees": Family(partial(_planks, 45.0), 200),
    "first_contact, planks at 20 degrees": Family(partial(_planks, 20.0), 200),
    "first_contact, waypoints": Family(_waypoints, 250),
    "first_contact, keyframes": Family(_keyframes, 60),
    "first_contact, far": Family(_far, 250),
    "first_contact, spinners": Family(_spinners, 4),
    "first_contact, deforming": Family(_deforming, 20),
    "PosePath": Family(_pose_paths, 8),
    "Scene, plate with holes": Family(_plate, 100),
    "Scene, comb": Family(_comb, 4000),
    "Scene, gear": Family(_big_gear, 2500),
    "Scene, bodies": Family(lambda n: lambda: Scene(_crowd(n), time=(0, 1)), 2000),
    "Scene.to_json": Family(
        lambda n: partial(json.dumps, Scene(_crowd(n), time=(0, 1)).to_json()), 2000
    ),
    "Planner": Family(_plans, 100),
    "Simulation, all events": Family(_events, 60, 1.5),
    "prove": Family(partial(_of_crowd, prove, 0.06, 1.0), 60),
    "draw, HTML": Family(_drawing, 120, 1.5),
    **{name: Family(*family) for name, family in USER_FAMILIES.items()},
}  # fmt: skip
