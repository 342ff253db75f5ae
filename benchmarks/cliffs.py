"""Scenes on which some method was slow: each beside the best method, or beside its own twin.

A twin is the same scene without what made it slow: a shorter time span, rates with few digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from random import Random
from typing import Final, NamedTuple

from benchmarks.auto import by_methods
from benchmarks.methods.own import fresh
from benchmarks.output import Output, Row
from benchmarks.timing import beside, in_turn, time_of
from exactpt import Body, Contact, Rigid, Scene, Simulation, Translation, first_contact

__all__ = ["FULL", "QUICK", "Sizes", "run"]

METHODS: Final = {
    "auto": {},
    "pairs": {"method": "pairs"},
    "lazy": {"tiling": "lazy"},
    "greedy": {"tiling": "greedy"},
}
SPANS: Final = (1, 10, 100, 10_000)


class Sizes(NamedTuple):
    """Numbers of bodies of convoys, of bodies in lanes, of bodies that turn; of runs."""

    convoys: tuple[int, ...]
    lanes: int
    turning: int
    runs: int


QUICK: Final = Sizes((30,), 20, 6, 2)
FULL: Final = Sizes((100, 300, 1000), 300, 60, 5)


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Measure all families.

    Raises:
        AuditError: if two methods disagree.
    """
    rng = Random(f"cliffs {seed}")
    rows: list[Row] = []
    for n in sizes.convoys:
        output.progress(f"cliffs: a convoy of {n}")
        rows += _beside_the_best(f"convoy of {n}", _convoy(rng, n), sizes.runs)
    for question, ask in (("spans", _spans), ("rates", _rates)):
        output.progress(f"cliffs: {question}")
        rows += ask(rng, sizes.runs)
    output.progress("cliffs: turning bodies")
    scene = _turning(rng, sizes.turning)
    rows += _beside_the_best(f"{sizes.turning} turning bodies", scene, sizes.runs)
    output.table("cliffs", rows)
    output.progress("cliffs: lanes")
    output.table("cliffs-lanes", _events_in_lanes(_lanes(rng, sizes.lanes), sizes.runs))


def _row(question: str, method: str, seconds: float, beside: str, least: float) -> Row:
    return {
        "question": question,
        "method": method,
        "milliseconds": 1000.0 * seconds,
        "beside": beside,
        "ratio": seconds / least,
    }


def _polygon(
    rng: Random, x: float, y: float, radius: float, corners: int
) -> list[tuple[float, float]]:
    """A convex polygon on a circle around (x, y)."""
    turns = [2.0 * math.pi * (i + rng.uniform(0.1, 0.9)) / corners for i in range(corners)]
    return [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in turns]


def _grid(n: int) -> list[tuple[int, int]]:
    side = math.isqrt(n - 1) + 1
    return [divmod(i, side) for i in range(n)]


def _beside_the_best(question: str, scene: Scene, runs: int) -> list[Row]:
    """Rows of all methods, in ratio to the fastest."""
    _, seconds = by_methods(question, scene, METHODS, runs)
    best = min(seconds, key=seconds.__getitem__)
    return [_row(question, m, s, best, seconds[best]) for m, s in seconds.items()]


def _convoy(rng: Random, n: int) -> Scene:
    """Bodies that all move at one velocity."""
    common = Translation([0, 3], [0, 5])
    bodies = [
        Body(f"b{i}", _polygon(rng, 10.0 * x, 10.0 * y, 4.0, rng.randint(3, 6)), common)
        for i, (x, y) in enumerate(_grid(n))
    ]
    return Scene(bodies, (0, 1000))


def _spans(rng: Random, runs: int) -> list[Row]:
    """Crowds with a first contact before time 1, in time spans of several lengths."""
    return [
        row
        for name, degree in (("straight", 1), ("on parabolas", 2))
        for row in _in_spans(name, _crowd(rng, degree), runs)
    ]


def _crowd(rng: Random, degree: int) -> list[Body]:
    """A hundred bodies close to each other, on random paths of a degree."""
    return [
        Body(
            f"b{i}",
            _polygon(rng, 10.0 * x, 10.0 * y, 4.5, rng.randint(3, 6)),
            Translation(*([0, *(rng.uniform(-1, 1) for _ in range(degree))] for _ in "xy")),
        )
        for i, (x, y) in enumerate(_grid(100))
    ]


def _in_spans(name: str, bodies: list[Body], runs: int) -> list[Row]:
    def prepare(span: int) -> Callable[[], Contact | None]:
        return partial(first_contact, fresh(Scene(bodies, (0, span))))

    ways = {f"time span {span}": partial(prepare, span) for span in SPANS}
    _, seconds = beside(f"a crowd, {name}", ways, runs, time_of)
    least = min(seconds.values())
    return [
        _row(f"a crowd, {name}, {span}", "auto", taken, "the best span", least)
        for span, taken in seconds.items()
    ]


def _rates(rng: Random, runs: int) -> list[Row]:
    """A robot that turns among boxes, at a random double and at that rounded to k / 1024."""
    rate = rng.uniform(0.2, 0.3)
    robot = [(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)]
    boxes = [
        Body(f"o{i}", _polygon(rng, 6.0 + 5.0 * x, 5.0 * y - 10.0, 1.5, 4))
        for i, (x, y) in enumerate(_grid(30))
    ]

    def seconds(turn: float) -> float:
        motion = Rigid([0, turn], pivot=(1, 1), x=[0, "1/2"])
        scene = Scene([*boxes, Body("robot", robot, motion)], (0, 20))
        return by_methods("rates", scene, {"auto": {}}, runs)[1]["auto"]

    short, long = seconds(round(1024 * rate) / 1024), seconds(rate)
    return [
        _row("a robot turns, rate k / 1024", "auto", short, "itself", short),
        _row("the same, rate a random double", "auto", long, "rate k / 1024", short),
    ]


def _turning(rng: Random, n: int) -> Scene:
    """Bodies that turn and drift; numbers are doubles."""
    bodies = []
    for i, (x, y) in enumerate(_grid(n)):
        motion = Rigid(
            [0, rng.uniform(-0.25, 0.25)], pivot=(10.0 * x, 10.0 * y),
            x=[0, rng.uniform(-0.25, 0.25)], y=[0, rng.uniform(-0.25, 0.25)],
        )  # fmt: skip
        outline = _polygon(rng, 10.0 * x, 10.0 * y, 3.5, rng.randint(3, 6))
        bodies.append(Body(f"b{i}", outline, motion))
    return Scene(bodies, (0, 8))


def _lanes(rng: Random, n: int) -> Scene:
    """Convex bodies in lanes along (3/5, 4/5), each at its own speed."""
    bodies = []
    for i, (across, along) in enumerate(_grid(n)):
        s, t = 10.0 * along + rng.uniform(-1, 1), 10.0 * across
        speed = rng.uniform(-1, 1)
        outline = _polygon(rng, 0.6 * s - 0.8 * t, 0.8 * s + 0.6 * t, 4.0, rng.randint(3, 6))
        bodies.append(Body(f"b{i}", outline, Translation([0, 0.6 * speed], [0, 0.8 * speed])))
    return Scene(bodies, (0, 4))


def _events_in_lanes(scene: Scene, runs: int) -> list[Row]:
    """The cost of an event of each tiling, and its share of exact decisions."""
    asks = {name: partial(_prepared, scene, name) for name in ("greedy", "mixed", "lazy")}
    rows: list[Row] = []
    greedy = 0.0
    for name, (simulation, seconds) in in_turn(asks, runs).items():
        stats = {key: n for key, n in simulation.stats.items() if isinstance(n, int)}
        events, decisions = max(1, stats["events"]), stats["exact"] + stats["filtered"]
        greedy = greedy or seconds / events
        rows.append(
            {
                "tiling": name,
                "bodies": len(scene.bodies),
                "events": stats["events"],
                "us an event": 1e6 * seconds / events,
                "times greedy": seconds / events / greedy,
                "certificates an event": stats["certificates"] / events,
                "exact share": stats["exact"] / max(1, decisions),
            }
        )
    return rows


def _prepared(scene: Scene, tiling: str) -> partial[Simulation]:
    """What runs a built tiling to the first contact, or the end."""
    return partial(_run, Simulation(fresh(scene), tiling=tiling))


def _run(simulation: Simulation) -> Simulation:
    for _ in simulation.run():
        pass
    return simulation
