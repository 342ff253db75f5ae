"""Run time against error in the time of the first contact, in comparison with other programs.

The true time is planted, or found by the exact reference search if that is fast enough;
otherwise it is the common result of two methods of exactpt that share little code.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from random import Random
from statistics import median
from typing import Final, NamedTuple, TypeAlias, final

from benchmarks.methods import others
from benchmarks.methods.arrays import FROM_ARRAYS
from benchmarks.methods.closed_form import CLOSED_FORM
from benchmarks.methods.cpp import SWEEP_AND_PRUNE, has_compiler
from benchmarks.methods.method import Answer, Method, UnsuitableScene, error_of
from benchmarks.methods.own import EXACT_SEARCH, OWN
from benchmarks.output import Output, Row
from benchmarks.shapes import (
    clamp,
    combs,
    crowd,
    deforming,
    grazing,
    spirals,
    tangle,
    thin_and_fast,
)
from benchmarks.timing import timed
from exactpt import AlgebraicNumber, AuditError, Scene

__all__ = ["FAMILIES", "FULL", "QUICK", "Sizes", "run"]

LEAST_ERROR: Final = 1e-17
"""Stands for no error on a logarithmic axis."""

PAIR_SECONDS: Final = 3e-5
"""Estimated seconds of the exact reference search for one vertex and one edge."""

Family: TypeAlias = Callable[[int, Random], Scene]

FAMILIES: Final[dict[str, Family]] = {
    "sparse": partial(crowd, radius=60, end=2),
    "dense": partial(crowd, radius=400, end=1),
    "clamps": clamp,
    "combs": lambda n, _: tangle(combs(n)),
    "spirals": lambda n, _: tangle(spirals(n)),
    "deforming": deforming,
    "grazing": grazing,
    "thin and fast": thin_and_fast,
    "long span": partial(crowd, radius=60, end=10_000),
}
"""Scenes by size: number of bodies of crowds, teeth of clamps, vertices of each comb and spiral."""

PLANTED: Final = {"combs": AlgebraicNumber(14), "grazing": AlgebraicNumber(2)}
"""Planted times: teeth 2 apart at a speed of 1/7; the apex of every throw."""


class Sizes(NamedTuple):
    """Size of the benchmark.

    Attributes:
        sizes: sizes of the scenes, by family.
        scenes: number of scenes of each size.
        steps: numbers of time steps, for programs that take steps.
        seconds: other methods that take longer than this are not run on larger scenes.
        runs: maximum number of runs of a method; the fastest counts.
    """

    sizes: Mapping[str, Sequence[int]]
    scenes: int
    steps: Sequence[int]
    seconds: float
    runs: int


QUICK: Final = Sizes(
    {
        "sparse": (10, 100),
        "dense": (10, 100),
        "clamps": (5, 20),
        "combs": (16, 64),
        "spirals": (16, 64),
        "deforming": (4, 16),
        "grazing": (4, 16),
        "thin and fast": (10, 50),
        "long span": (10, 100),
    },
    scenes=1,
    steps=(100, 1000),
    seconds=0.5,
    runs=1,
)
FULL: Final = Sizes(
    {
        "sparse": (10, 100, 1000, 3000),
        "dense": (10, 100, 1000, 3000),
        "clamps": (5, 20, 100),
        "combs": (64, 256, 1024),
        "spirals": (64, 256, 1024),
        "deforming": (4, 16, 64, 256),
        "grazing": (4, 16, 64),
        "thin and fast": (10, 100, 1000),
        "long span": (10, 100, 1000),
    },
    scenes=1,
    steps=(100, 1000, 10_000),
    seconds=1.0,
    runs=3,
)


@final
@dataclass(slots=True)
class _Result:
    """The results of a method for the scenes of one size."""

    seconds: list[float] = field(default_factory=list)
    errors: list[float] = field(default_factory=list)
    missed: int = 0
    invented: int = 0

    def add(self, answer: Answer, seconds: float, truth: AlgebraicNumber | None) -> None:
        self.seconds.append(seconds)
        if answer is None:
            self.missed += truth is not None
        elif truth is None:
            self.invented += 1
        else:
            self.errors.append(error_of(answer, truth))


class _Truth(NamedTuple):
    """The first contact of a scene, how it is known, and the seconds of the reference search."""

    time: AlgebraicNumber | None
    how: str
    seconds: float | None = None


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Run every method on every family, from small to large scenes.

    Raises:
        AuditError: if a result of exactpt is wrong.
    """
    methods = [m for m in _methods(sizes.steps) if m.package is None or output.has(m.package)]
    if not has_compiler():
        output.say("skipped: g++ is not installed: no sweep-and-prune in C++")
        methods.remove(SWEEP_AND_PRUNE)
    for method in methods:  # imports on first use are not timed
        method.prepare(crowd(2, Random(seed), radius=60, end=1))()
    rows: list[Row] = []
    for family in sizes.sizes:
        rows += _run_family(output, family, sizes, seed, methods)
    largest = [row for row in rows if row["size"] == sizes.sizes[str(row["family"])][-1]]
    output.table("first-contact", rows, largest)


def _run_family(
    output: Output, family: str, sizes: Sizes, seed: int, methods: Sequence[Method]
) -> list[Row]:
    """The rows of one family, from small to large, and the plot of the largest size."""
    left = list(methods)
    rows: list[Row] = []
    points: dict[str, list[tuple[float, float]]] = {}
    for size in sizes.sizes[family]:
        output.progress(f"{family}, size {size}")
        scenes = [
            FAMILIES[family](size, Random(f"{family}:{size}:{seed}:{i}"))
            for i in range(sizes.scenes)
        ]
        truths = [_truth(family, scene, sizes.seconds) for scene in scenes]
        about: Row = {
            "family": family,
            "size": size,
            "bodies": len(scenes[0].bodies),
            "vertices": scenes[0].vertex_count,
            "truth": truths[0].how,
        }
        points.clear()
        for method in tuple(left):
            result = _ask(method, scenes, truths, sizes)
            slow = result is not None and median(result.seconds) > sizes.seconds
            if result is None or (slow and method.name != "exactpt"):
                left.remove(method)
            if result is None:
                continue
            rows.append({**about, **_row(method, result)})
            if result.errors:
                name = f"exactpt {method.setting}" if method.name == "exactpt" else method.name
                error = max(LEAST_ERROR, *result.errors)
                points.setdefault(name, []).append((error, median(result.seconds)))
    title = f"First contact, {family}, size {sizes.sizes[family][-1]}"
    axes = ("error in the time of contact (10^-17: none)", "seconds of processor time")
    output.lines(f"first-contact-{family.replace(' ', '-')}", title, axes, points)
    return rows


def _methods(steps: Sequence[int]) -> list[Method]:
    return [
        *OWN,
        FROM_ARRAYS,
        EXACT_SEARCH,
        CLOSED_FORM,
        SWEEP_AND_PRUNE,
        *(others.shapely(n, bisect=False) for n in steps),
        *(others.shapely(n, bisect=True) for n in steps),
        *(others.pymunk(n) for n in steps),
        *(others.tight_inclusion(tolerance, 32) for tolerance in (1e-3, 1e-6)),
        *(others.additive(rescaling, 32) for rescaling in (0.9, 0.9999)),
        others.FCL,
    ]


def _ask(
    method: Method,
    scenes: Sequence[Scene],
    truths: Sequence[_Truth],
    sizes: Sizes,
) -> _Result | None:
    """Return the results for some scenes; None if the method is unsuitable or too slow."""
    if method is EXACT_SEARCH and _search_seconds(scenes[0]) > sizes.seconds:
        return None
    result = _Result()
    for scene, truth in zip(scenes, truths, strict=True):
        if method is EXACT_SEARCH and truth.seconds is not None:
            result.add(truth.time, truth.seconds, truth.time)
            continue
        try:
            answer, spent = timed(method.prepare(scene))
            for _ in range(sizes.runs - 1 if spent <= sizes.seconds else 0):
                spent = min(spent, timed(method.prepare(scene))[1])
            result.add(answer, spent, truth.time)
        except UnsuitableScene:
            return None
    if method.name == "exactpt" and (result.missed or result.invented or any(result.errors)):
        raise AuditError(f"{method.name} {method.setting} is wrong about {scenes}: {result}")
    return result


def _search_seconds(scene: Scene) -> float:
    return PAIR_SECONDS * scene.vertex_count**2


def _truth(family: str, scene: Scene, seconds: float) -> _Truth:
    if family in PLANTED:
        return _Truth(PLANTED[family], "planted")
    if _search_seconds(scene) <= seconds:
        answer, spent = timed(EXACT_SEARCH.prepare(scene))
        return _Truth(_exact(answer), EXACT_SEARCH.name, spent)
    answers = [method.prepare(scene)() for method in OWN]
    if any(answer != answers[0] for answer in answers):
        raise AuditError(f"two ways disagree about {scene}: {answers}")
    return _Truth(_exact(answers[0]), "two ways agree")


def _exact(answer: Answer) -> AlgebraicNumber | None:
    if isinstance(answer, float):
        raise TypeError(f"not exact: {answer}")
    return answer


def _row(method: Method, result: _Result) -> Row:
    return {
        "method": method.name,
        "setting": method.setting,
        "scenes": len(result.seconds),
        "seconds": median(result.seconds),
        "error": "missed" if result.missed else max(result.errors, default=None),
        "missed": result.missed,
        "invented": result.invented,
    }
