"""Twenty families of questions for `exponents`, written from the documents alone.

Users write such scenes without knowing which are fast: the author had read the README and the
pages of `docs`, and neither the code of the package nor the families of `exponents` that it was
tuned on.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Final, TypeAlias

from exactpt import (
    Body,
    Bounce,
    Pieces,
    PosePath,
    Rigid,
    Scene,
    Simulation,
    Translation,
    arrays,
    certify,
    clearance,
    contacts,
    first_contact,
    first_contact_enclosed,
    first_within,
    onward,
    read_shapes,
    write_shapes,
)  # fmt: skip
from exactpt.batch import Options, answers
from exactpt.certificates import CertificateQueue, squared_distance
from exactpt.kernel import Polynomial

__all__ = ["USER_FAMILIES"]

Ask: TypeAlias = "Callable[[], object]"
Point: TypeAlias = tuple[float, float]
East: Final = Translation([0, 1])


def _square(x: float, y: float, side: float = 1.0) -> list[Point]:
    return [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]


def _cells(n: int) -> Ask:
    """Cells of a map that touch at the start; one of them moves off."""
    side = math.isqrt(n - 1) + 1
    cells = [Body(f"c{i}", _square(i % side, i // side)) for i in range(n)]
    moving = Body("m", _square(-3, 0.5), East)
    return lambda: first_contact(Scene([*cells, moving], time=(0, 10)), after_start=True)


def _dominoes(n: int) -> Ask:
    """Boxes that stand in a row, with gaps of 10^-12; a hand pushes the last one away."""
    gap = 1 + 1e-12
    row = [Body(f"d{i}", _square(i * gap, 0)) for i in range(n)]
    hand = Body("hand", _square(-5, 0.25, 0.5), East)
    return lambda: first_contact(Scene([*row, hand], time=(0, 10)))


def _rivers(n: int) -> Ask:
    """Two open chains with many bends, one of which drifts towards the other."""
    random = Random("rivers")
    ys = [[random.uniform(0, 0.4) for _ in range(n)] for _ in range(2)]
    upper = Body("upper", [(i, 1 + y) for i, y in enumerate(ys[0])], closed=False)
    lower = Body(
        "lower", [(i, -y) for i, y in enumerate(ys[1])], Translation([0], [0, 1]), closed=False
    )
    return lambda: first_contact(Scene([upper, lower], time=(0, 10)))


def _subdivided(n: int) -> Ask:
    """Two boxes, their facing edges cut into many, that slide past each other with a gap."""
    top = [*((i / n, 1.0) for i in range(n + 1)), (1.0, 2.0), (0.0, 2.0)]
    bottom = [*((i / n, 0.5) for i in range(n + 1)), (1.0, -1.0), (0.0, -1.0)]
    scene = Scene([Body("a", top, East), Body("b", bottom)], time=(-2, 2))
    return lambda: first_contact(scene)


def _ring_gear(teeth: int) -> Ask:
    """A toothed wheel that turns inside of a ring with as many teeth."""
    turns = [math.pi * i / teeth for i in range(2 * teeth)]
    radii = (1.0, 1.0 + 1.0 / teeth)
    wheel = [(radii[i % 2] * math.cos(a), radii[i % 2] * math.sin(a)) for i, a in enumerate(turns)]
    inner = [(1.3 * x, 1.3 * y) for x, y in wheel]
    outer = [(2 * math.cos(a), 2 * math.sin(a)) for a in turns]
    bodies = [Body("wheel", wheel, Rigid([0, "1/2"])), Body("ring", outer, holes=[inner])]
    return lambda: first_contact(Scene(bodies, time=(0, 4)))


def _discs(n: int) -> Ask:
    """Discs of several radii that drift among each other."""
    random, side = Random("discs"), math.isqrt(n - 1) + 1
    bodies = []
    for i in range(n):
        drift = Translation(*([0, random.uniform(-0.1, 0.1)] for _ in "xy"))
        bodies.append(Body(f"d{i}", [(i % side, i // side)], drift, radius=0.1 + 0.2 * (i % 2)))
    return lambda: first_within(Scene(bodies, time=(0, 3)), distance="1/100")


def _combined(n: int) -> Ask:
    """Two bodies of many parts each, one of which moves over the other."""
    side = math.isqrt(n - 1) + 1
    at = [(2.0 * (i % side), 2.0 * (i // side)) for i in range(n)]
    a = Body("a", parts=[_square(x, y, 0.5) for x, y in at])
    slide = Translation([0, "1/100"], [0, "1/50"])
    b = Body("b", parts=[_square(x + 0.8, y + 0.8, 0.5) for x, y in at], motion=slide)
    return lambda: first_contact(Scene([a, b], time=(0, 40)))


def _gate(n: int) -> Ask:
    """Bodies one after the other through a gate: when does each overlap it?"""
    cars = [Body(f"c{i}", _square(-2.0 * i - 2, 0), East) for i in range(n)]
    gate = Body("gate", [(0, -1), (0.5, -1), (0.5, 3), (0, 3)])
    return lambda: contacts(Scene([gate, *cars], time=(0, 2 * n + 4)))


def _commuter(legs: int) -> Ask:
    """One body that goes to and fro among resting ones; when is it within a distance?"""
    at, motions = 0, list[tuple[int | None, Translation]]()
    for k in range(legs):
        v = (-1) ** k
        motions.append((k + 1 if k + 1 < legs else None, Translation([at - v * k, v])))
        at += v
    posts = [Body(f"p{i}", _square(3 * i, 2)) for i in range(10)]
    scene = Scene([Body("m", _square(0, 0), Pieces(motions)), *posts], time=(0, legs))
    return lambda: clearance(scene, "m", "p1").below("3/2")


def _degree(n: int) -> Ask:
    """Forty triangles on polynomials of a high degree, in rows that do not touch."""
    random, bodies = Random("degree"), []
    for i in range(40):
        wave = Polynomial([0, *(Fraction(random.randint(-9, 9), 10 * n) for _ in range(n))])
        shape = [(0, 3 * i), (1, 3 * i), (0, 3 * i + 1)]
        bodies.append(Body(f"b{i}", shape, Translation(wave, [0])))
    return lambda: contacts(Scene(bodies, time=(0, 1)))


def _digits(n: int) -> Ask:
    """Two hundred triangles whose coordinates have many digits."""
    random, unit = Random("digits"), 10**n

    def number(low: int) -> Fraction:
        return low + Fraction(random.randrange(unit), unit)

    bodies = []
    for i in range(200):
        shape = [
            (number(3 * i), number(0)),
            (number(3 * i + 1), number(0)),
            (number(3 * i), number(2)),
        ]
        bodies.append(Body(f"b{i}", shape, Translation([0, number(-1)], [0, number(-1)])))
    return lambda: first_contact(Scene(bodies, time=(0, 10)))


def _samples(n: int) -> Ask:
    """A robot along many samples of its pose, beside a wall."""
    poses = [(0.1 * i, math.sin(0.2 * i), 0.1 * i) for i in range(n + 1)]

    def asked() -> object:
        path = PosePath.through(range(n + 1), poses, error="1/1000")
        robot = Body("robot", [(-0.2, -0.1), (0.2, -0.1), (0.2, 0.1), (-0.2, 0.1)], path)
        wall = Body("wall", [(-1, 2), (0.1 * n + 1, 2), (0.1 * n + 1, 3), (-1, 3)])
        return first_contact_enclosed(Scene([robot, wall], time=(0, n)))

    return asked


def _from_arrays(n: int) -> Ask:
    """The first contact of a crowd in arrays."""
    numpy, side = __import__("numpy"), math.isqrt(n - 1) + 1
    random = numpy.random.default_rng(7)
    corners = numpy.array([(0, 0), (0.3, 0), (0.1, 0.3)])
    cells = numpy.stack([numpy.arange(n) % side, numpy.arange(n) // side], axis=1)
    points = (cells[:, None, :] + random.uniform(0, 0.6, (n, 1, 2)) + corners).reshape(-1, 2)
    offsets, v = numpy.arange(0, 3 * n + 1, 3), random.uniform(-0.1, 0.1, (n, 2))
    return lambda: first_contact(Scene.from_arrays(points, offsets, velocities=v, time=(0, 3)))


def _rows_of_pairs(n: int) -> Ask:
    """Pairs of squares on an integer grid, in arrays: ties everywhere."""
    numpy = __import__("numpy")
    random = numpy.random.default_rng(7)
    shape = numpy.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    points = (random.integers(0, 9, (2 * n, 1, 2)) + shape).reshape(-1, 2).astype(float)
    offsets, v = numpy.arange(0, 8 * n + 1, 4), random.integers(-2, 3, (2 * n, 2)).astype(float)
    pairs = numpy.arange(2 * n).reshape(-1, 2)
    return lambda: arrays.first_contacts(points, offsets, pairs, velocities=v, time=(0, 9))


def _lines(n: int) -> Ask:
    """Texts of scenes with decimals, as of `exactpt batch`."""
    random, lines = Random("lines"), []
    for _ in range(n):
        bodies = []
        for name in "abc":
            x, y = (round(random.uniform(0, 9), 2) for _ in "xy")
            shape = [[str(u), str(v)] for u, v in ((x, y), (x + 1, y), (x, y + 1))]
            move = {k: ["0", str(round(random.uniform(-1, 1), 2))] for k in "xy"}
            bodies.append({"name": name, "vertices": shape, "motion": move})
        lines.append(json.dumps({"exactpt": 1, "time": ["0", "5"], "bodies": bodies}))
    return lambda: list(answers(lines, Options()))


def _bouncing(seconds: int) -> Ask:
    """A ball between two walls, recorded; the run is then a scene with a question."""
    ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]))
    walls = [Body("left", [(-1, -9), (-1, 9)]), Body("right", [(6, -9), (6, 9)])]

    def asked() -> object:
        run = Simulation(Scene([ball, *walls], time=(0, seconds)), record=True)
        for _ in run.run(on_contact=Bounce(fixed=["left", "right"])):
            pass
        return first_contact(run.history().scene())

    return asked


def _steered(steps: int) -> Ask:
    """A boat among buoys that gets a new velocity at each step, and is copied."""
    buoys = [Body(f"o{i}", _square(3 * (i % 5), 3 + 3 * (i // 5))) for i in range(20)]
    scene = Scene([Body("boat", _square(0, 0, 0.5), East), *buoys], time=(0, steps))

    def asked() -> object:
        run = Simulation(scene)
        for k in range(1, steps):
            for _ in run.run(until=k):
                pass
            run.set_motion("boat", onward(run.body("boat"), k, ((-1) ** k, 0)))
        return run.copy()

    return asked


def _files(n: int) -> Ask:
    """Features written and read as GeoJSON."""
    side = math.isqrt(n - 1) + 1
    scene = Scene([Body(f"c{i}", _square(2 * (i % side), 2 * (i // side))) for i in range(n)])

    def asked() -> object:
        with TemporaryDirectory() as folder:
            path = Path(folder, "shapes.geojson")
            write_shapes(scene, path, at=0)
            return read_shapes(path, time=(0, 10))

    return asked


def _certified(n: int) -> Ask:
    """A certificate that rows of bodies stay apart."""
    scene = Scene([Body(f"b{i}", _square(3 * i, 0), East) for i in range(n)], time=(0, 5))
    return lambda: certify(scene)


def _closest(n: int) -> Ask:
    """The distances of moving points from one of them, as certificates in a queue."""
    random, one = Random("closest"), Polynomial([0, 1])

    def coordinate() -> Polynomial:
        return random.randint(-99, 99) + random.randint(-9, 9) * one

    points = [(coordinate(), coordinate()) for _ in range(n)]

    def asked() -> object:
        certificate_queue = CertificateQueue(0, 8)
        for i, point in enumerate(points[1:]):
            certificate_queue.watch(i, squared_distance(points[0], point) - Polynomial([900]))
        failed = 0
        while gone := certificate_queue.advance():
            failed += len(gone)
        return failed

    return asked


USER_FAMILIES: Final[dict[str, tuple[Callable[[int], Ask], int, float]]] = {
    "user: cells of a map": (_cells, 100, 1.0),
    "user: dominoes": (_dominoes, 1000, 1.0),
    "user: rivers": (_rivers, 500, 1.0),
    "user: subdivided boxes": (_subdivided, 500, 1.0),
    "user: ring gear": (_ring_gear, 20, 1.0),
    "user: discs": (_discs, 500, 1.0),
    "user: bodies of parts": (_combined, 50, 1.0),
    "user: gate": (_gate, 200, 1.0),
    "user: commuter": (_commuter, 100, 1.0),
    "user: degree": (_degree, 4, 1.0),
    "user: digits": (_digits, 250, 1.0),
    "user: samples of a pose": (_samples, 10, 1.0),
    "user: from_arrays": (_from_arrays, 8000, 1.0),
    "user: pairs on a grid": (_rows_of_pairs, 400, 1.0),
    "user: lines of scenes": (_lines, 100, 1.0),
    "user: recorded bounces": (_bouncing, 100, 1.0),
    "user: steered": (_steered, 100, 1.0),
    "user: GeoJSON": (_files, 300, 1.0),
    "user: certified": (_certified, 50, 1.0),
    "user: queue": (_closest, 500, 1.0),
}  # fmt: skip
