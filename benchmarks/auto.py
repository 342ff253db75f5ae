"""The default method beside all others, on families of scenes as users bring them."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from random import Random
from typing import Final, NamedTuple

from benchmarks.everyday import EVERYDAY
from benchmarks.everyday_later import EVERYDAY_LATER
from benchmarks.methods.own import fresh
from benchmarks.output import Output, Row
from benchmarks.timing import beside, near
from exactpt import Contact, Scene, first_contact
from exactpt.tiling.start import tilings_for

__all__ = ["FULL", "QUICK", "Sizes", "by_methods", "run"]

DEFAULT: Final = "auto"
WARM: Final = tuple(EVERYDAY[name](Random(0), 3) for name in ("spinning rocks", "a huge offset"))


class Sizes(NamedTuple):
    """Sizes of the scenes; number of runs, of which the fastest counts."""

    sizes: tuple[int, ...]
    runs: int


QUICK: Final = Sizes((2,), 3)
FULL: Final = Sizes((3, 6), 5)


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Run every method on a scene of every family and size.

    Raises:
        AuditError: if two methods disagree.
    """
    rows: list[Row] = []
    for family, make in {**EVERYDAY, **EVERYDAY_LATER}.items():
        for size in sizes.sizes:
            output.progress(f"auto: {family}, size {size}")
            scene = make(Random(f"auto:{family}:{size}:{seed}"), size)
            rows.append(_row(family, scene, sizes.runs))
    output.table("auto", rows)


def _row(family: str, scene: Scene, runs: int) -> Row:
    names = {"pairs": {"method": "pairs"}, **{t: {"tiling": t} for t in tilings_for(scene)}}
    contact, seconds = by_methods(family, scene, {DEFAULT: {}, **names}, runs)
    best = min(names, key=seconds.__getitem__)
    return {
        "family": family,
        "bodies": len(scene.bodies),
        "vertices": scene.vertex_count,
        "contact": near(contact),
        "auto ms": 1000.0 * seconds[DEFAULT],
        "best": best,
        "best ms": 1000.0 * seconds[best],
        "ratio": seconds[DEFAULT] / seconds[best],
        **{f"{name} ms": 1000.0 * seconds[name] for name in names if name != "incremental"},
    }


def by_methods(
    question: str, scene: Scene, methods: dict[str, dict[str, str]], runs: int
) -> tuple[Contact | None, dict[str, float]]:
    """The first contact, and the least seconds of each method, see `beside`.

    Args:
        question: its name.
        scene: the scene; each question is about a fresh copy.
        methods: by name, the arguments of `first_contact`.
        runs: number of runs.
    """

    def prepare(options: dict[str, str]) -> Callable[[], Contact | None]:
        return partial(first_contact, fresh(scene), **options)  # type: ignore[arg-type]

    for options in methods.values():  # imports on first use are not timed
        for small in WARM:
            first_contact(small, **options)  # type: ignore[arg-type]
    ways = {name: partial(prepare, options) for name, options in methods.items()}
    return beside(question, ways, runs, lambda c: c and (c.time, c.kind, c.pairs))
