"""The first time within a distance beside the first contact, of the same crowds.

Each row is one question about one crowd; `ratio` is its time divided by that of `first_contact`.
Every approach is compared with that of a search without filters: exact arithmetic decides about all
vertices and edges whose boxes meet.
"""

from __future__ import annotations

from functools import partial
from random import Random
from typing import Final, NamedTuple

from benchmarks.output import Output, Row
from benchmarks.shapes import crowd
from benchmarks.timing import fastest, near, time_of
from exactpt import Approach, AuditError, Body, Scene, Translation, first_contact, first_within
from exactpt.kernel.numbers import QQ
from exactpt.search.reading import rows_of
from exactpt.search.sweep_search import AllPairs, Slabs, Sweep

__all__ = ["FULL", "QUICK", "Sizes", "run"]


class Sizes(NamedTuple):
    """Numbers of bodies and of runs."""

    bodies: int
    runs: int


QUICK: Final = Sizes(bodies=100, runs=2)
FULL: Final = Sizes(bodies=1000, runs=5)

DISTANCES: Final = (1, 10, 40)


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Measure all questions.

    Raises:
        AuditError: if two ways disagree.
    """
    rows: list[Row] = []
    for name, scene in _crowds(sizes.bodies, seed).items():
        output.progress(f"within: {name}")
        contact, unit = fastest(partial(first_contact, scene), sizes.runs)
        rows.append(_row(name, sizes, "first_contact", unit, 1.0, near(contact)))
        for d in DISTANCES:
            found, taken = fastest(partial(_within, scene, d), sizes.runs)
            _audit(scene, d, found)
            rows.append(_row(name, sizes, f"first_within {d}", taken, taken / unit, near(found)))
    output.table("within", rows)


def _within(scene: Scene, d: int) -> Approach | None:
    return first_within(scene, distance=d)


def _row(
    name: str, sizes: Sizes, question: str, seconds: float, ratio: float, time: float | None
) -> Row:
    return {
        "crowd": name,
        "bodies": sizes.bodies,
        "question": question,
        "milliseconds": 1000.0 * seconds,
        "ratio": ratio,
        "time": time,
    }


def _crowds(bodies: int, seed: int) -> dict[str, Scene]:
    """Convex bodies in cells of width 1,000: in straight motion, and accelerated."""
    rng = Random(f"within {seed}")
    sparse = crowd(bodies, rng, radius=60, end=2)
    thrown = [
        Body(
            body.name,
            body.vertices,
            Translation([0, rng.randint(-999, 999)], [0, rng.randint(-999, 999), -500]),
        )
        for body in sparse.bodies
    ]
    return {
        "sparse": sparse,
        "dense": crowd(bodies, rng, radius=400, end=1),
        "accelerated": Scene(thrown, (0, 2)),
    }


def _audit(scene: Scene, d: int, found: Approach | None) -> None:
    if found is not None and found.time == scene.start:
        return  # the search is for approaches after the start
    rows = rows_of(scene.bodies, scene.exact_start, scene.exact_end, QQ(d) / 2)
    slabs = Slabs(rows, AllPairs(rows, with_themselves=False))
    expected = Sweep(rows, slabs, lambda _, __: QQ(d * d), exact_only=True).first_after_start()
    if time_of(found) != (None if expected is None else expected.number):
        raise AuditError(f"two ways disagree about distance {d}: {found}, {expected}")
