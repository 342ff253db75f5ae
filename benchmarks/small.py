"""Small questions and the building of scenes: two triangles, a crowd, plans, many pieces.

Each query is one of scenes built anew, from doubles. Times are the least of some runs, in
milliseconds for one query. Every result is compared with that of another method.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from random import Random
from typing import Any, Final, NamedTuple, TypeAlias

from benchmarks.methods import others
from benchmarks.methods.closed_form import CLOSED_FORM
from benchmarks.methods.method import Method, UnsuitableScene, error_of
from benchmarks.output import Output, Row
from benchmarks.timing import beside, time_of, timed
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, fraction
from exactpt.motion.body import Body
from exactpt.motion.motions import Pieces, Translation
from exactpt.pair.contact import Contact
from exactpt.scene.scene import Scene
from exactpt.search.first import first_contact
from exactpt.search.planner import Planner
from exactpt.testing import reference
from exactpt.testing.reference import FirstContact

__all__ = ["FULL", "QUICK", "Sizes", "run"]

Points: TypeAlias = "list[tuple[float, float]]"
Times: TypeAlias = "Sequence[AlgebraicNumber | None]"


class Sizes(NamedTuple):
    """Numbers of scenes of two triangles, of bodies to build, of plans, of pieces; of runs."""

    triangles: int
    bodies: int
    plans: int
    pieces: int
    runs: int


QUICK: Final = Sizes(triangles=10, bodies=100, plans=10, pieces=10, runs=3)
FULL: Final = Sizes(triangles=50, bodies=1000, plans=1000, pieces=200, runs=5)

OBSTACLES: Final = 30
CROWD: Final = 20
"""Number of bodies whose motion consists of pieces."""


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Measure all questions."""
    rows: list[Row] = []
    for title, ask in (
        ("two triangles", _triangles),
        ("a crowd", _crowd),
        ("discs", _discs),
        ("plans", _plans),
        ("pieces", _pieces),
    ):
        output.progress(f"small: {title}")
        rows += ask(output, sizes, Random(f"small {title} {seed}"))
    output.table("small", rows)


def _row(
    question: str, method: str, seconds: float, count: int, found: Times, error: float | None = None
) -> Row:
    return {
        "question": question,
        "method": method,
        "milliseconds": 1000.0 * seconds / count,
        "questions": count,
        "contacts": sum(time is not None for time in found),
        "error": error,
    }


def _polygon(rng: Random, x: float, y: float, corners: int) -> Points:
    """A convex polygon on a circle of radius 1 around (x, y)."""
    turn = rng.uniform(0.0, 2.0 * math.pi)
    angles = [turn + 2.0 * math.pi * (i + rng.uniform(0.1, 0.9)) / corners for i in range(corners)]
    return [(x + math.cos(a), y + math.sin(a)) for a in angles]


def _velocity(rng: Random) -> Translation:
    return Translation([0.0, rng.uniform(-1.0, 1.0)], [0.0, rng.uniform(-1.0, 1.0)])


def _triangles(output: Output, sizes: Sizes, rng: Random) -> list[Row]:
    """Two triangles of doubles in linear motion: built, queried, both; other programs."""
    given = [
        (
            _polygon(rng, 0, 0, 3),
            _polygon(rng, 4, 0, 3),
            rng.uniform(0.3, 1),
            rng.uniform(-0.2, 0.2),
        )
        for _ in range(sizes.triangles)
    ]

    def build() -> list[Scene]:
        return [
            Scene([Body("a", a, Translation([0.0, u], [0.0, v])), Body("b", b)], (0, 10))
            for a, b, u, v in given
        ]

    def answer(search: Callable[[Scene], Contact | FirstContact | None]) -> Times:
        return [time_of(search(scene)) for scene in build()]

    question, count = "two triangles", sizes.triangles
    searches = {m: partial(first_contact, method=m) for m in ("auto", "kinetic")}
    ways = {name: partial(partial, answer, search) for name, search in searches.items()}
    ways["reference"] = partial(partial, answer, reference.first_contact)
    expected, least = beside(question, ways, sizes.runs)
    seconds = min(timed(build)[1] for _ in range(sizes.runs))
    rows = [_row(question, "exactpt, scene alone", seconds, count, [])]
    rows += [
        _row(question, f"exactpt, scene and {name}", least[name], count, expected, 0.0)
        for name in searches
    ]
    for other in (
        CLOSED_FORM,
        others.shapely(1000, bisect=True),
        others.pymunk(1000),
        others.tight_inclusion(1e-6, 32),
        others.BOX2D,
    ):
        if other.package is None or output.has(other.package):
            rows += _other(question, other, build(), expected, sizes.runs)
    return rows


def _other(
    question: str, method: Method, scenes: Sequence[Scene], expected: Times, runs: int
) -> list[Row]:
    """Another program about scenes that it has prepared; its largest error."""
    total, errors, contacts = 0.0, [0.0], []
    for scene, truth in zip(scenes, expected, strict=True):
        try:
            answers = [timed(method.prepare(scene)) for _ in range(runs)]
        except UnsuitableScene:
            return []
        answer = answers[0][0]
        total += min(seconds for _, seconds in answers)
        if answer is not None:
            contacts.append(truth)
            if truth is not None:
                errors.append(error_of(answer, truth))
    name = f"{method.name}, {method.setting}, the question alone".replace(", ,", ",")
    return [_row(question, name, total, len(scenes), contacts, max(errors))]


def _crowd(output: Output, sizes: Sizes, rng: Random) -> list[Row]:  # noqa: ARG001
    """A crowd of convex bodies: built, and the first contact found."""
    width = math.isqrt(sizes.bodies - 1) + 1
    given = [
        (
            f"b{i}",
            _polygon(rng, 3.0 * (i % width), 3.0 * (i // width), rng.randint(3, 6)),
            _velocity(rng),
        )
        for i in range(sizes.bodies)
    ]

    def build() -> Scene:
        return Scene([Body(*body) for body in given], (0, 10))

    question = f"{sizes.bodies} convex bodies"
    seconds = min(timed(build)[1] for _ in range(sizes.runs))
    rows = [_row(question, "exactpt, scene alone", seconds, 1, [])]
    return [*rows, *_by_methods(question, build, sizes.runs, {"method": "kinetic"})[:1]]


def _by_methods(
    question: str, build: Callable[[], Scene], runs: int, *others: dict[str, Any]
) -> list[Row]:
    """The default method, and others by their options, of scenes built anew."""
    ways = {
        f"exactpt, {' '.join(map(str, options.values())) or 'auto'}": options
        for options in ({}, *others)
    }
    asks = {name: lambda o=o: partial(first_contact, build(), **o) for name, o in ways.items()}
    contact, seconds = beside(question, asks, runs, time_of)
    return [_row(question, name, seconds[name], 1, [time_of(contact)], 0.0) for name in ways]


def _discs(output: Output, sizes: Sizes, rng: Random) -> list[Row]:  # noqa: ARG001
    """A crowd of discs, and of the octagons in them: their first contacts."""
    width = math.isqrt(sizes.bodies - 1) + 1
    given = [
        (4.0 * (i % width) + rng.random(), 4.0 * (i // width) + rng.random(), _velocity(rng))
        for i in range(sizes.bodies)
    ]
    corners = [(math.cos(k * math.pi / 4), math.sin(k * math.pi / 4)) for k in range(8)]
    rows: list[Row] = []
    for what, shape, radius in (("octagons", corners, 0), ("discs", [(0.0, 0.0)], 1)):
        bodies = [
            Body(f"b{i}", [(x + u, y + v) for u, v in shape], motion, radius=radius)
            for i, (x, y, motion) in enumerate(given)
        ]
        build = partial(Scene, bodies, (0, 10))
        rows += _by_methods(f"{sizes.bodies} {what}", build, sizes.runs, {"exact_only": True})[:1]
    return rows


def _plans(output: Output, sizes: Sizes, rng: Random) -> list[Row]:  # noqa: ARG001
    """Plans of one shape among obstacles: by scenes, and by a planner."""
    obstacles = [
        Body(f"o{i}", _polygon(rng, 4.0 * (i % 6) + 4.0, 4.0 * (i // 6), rng.randint(3, 6)))
        for i in range(OBSTACLES)
    ]
    shape = [(-1.0, -0.5), (0.0, -0.5), (0.0, 0.5), (-1.0, 0.5)]
    motions = [
        Translation([0.0, rng.uniform(1.0, 4.0)], [0.0, rng.uniform(-0.2, 2.5)])
        for _ in range(sizes.plans)
    ]
    names = [body.name for body in obstacles]

    def by_scenes() -> Times:
        scenes = (Scene([*obstacles, Body("shape", shape, m)], (0, 10)) for m in motions)
        return [time_of(first_contact(scene, ignoring=[names])) for scene in scenes]

    def by_planner() -> Times:
        return list(map(time_of, Planner(obstacles, (0, 10)).first_contacts(shape, motions)))

    question = f"plans among {OBSTACLES} obstacles"
    asks = {"a scene each": lambda: by_scenes, "Planner": lambda: by_planner}
    found, least = beside(question, asks, sizes.runs)
    return [
        _row(question, f"exactpt, {name}", taken, sizes.plans, found, 0.0)
        for name, taken in least.items()
    ]


def _pieces(output: Output, sizes: Sizes, rng: Random) -> list[Row]:  # noqa: ARG001
    """Bodies of many pieces of motion, all their ends different."""
    given = [
        (_polygon(rng, 0.0, 0.0, 3), _path(rng, 10 * (i % 5), 10 * (i // 5), sizes.pieces))
        for i in range(CROWD)
    ]

    def build() -> Scene:
        return Scene([Body(f"b{i}", *body) for i, body in enumerate(given)], (0, 10))

    question = f"{CROWD} bodies of {sizes.pieces} pieces"
    return _by_methods(question, build, sizes.runs, {"tiling": "lazy"}, {"tiling": "greedy"})


def _path(rng: Random, x: int, y: int, count: int) -> Pieces:
    """A walk about a place, at velocities that are multiples of 1/64."""
    ends = sorted(QQ(rng.randrange(1, 10**9), 10**8) for _ in range(count - 1))
    here, since = (QQ(x), QQ(y)), QQ(0)
    pieces = []
    for until in (*ends, None):
        span = (until or QQ(10)) - since
        velocity = [
            QQ(int(64 * (home + QQ(rng.randint(-300, 300), 100) - at) / span), 64)
            for home, at in zip((x, y), here, strict=True)
        ]
        line = [[at - v * since, v] for at, v in zip(here, velocity, strict=True)]
        pieces.append((None if until is None else fraction(until), Translation(*line)))
        here = here[0] + velocity[0] * span, here[1] + velocity[1] * span
        since += span
    return Pieces(pieces)
