"""Contacts missed, invented and late, close to degeneracy: the case for exactness."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from random import Random
from typing import Final, NamedTuple, final

from benchmarks.methods import others
from benchmarks.methods.arrays import ARRAYS
from benchmarks.methods.closed_form import CLOSED_FORM
from benchmarks.methods.method import Method, UnsuitableScene, error_of
from benchmarks.methods.own import OWN
from benchmarks.output import Cell, Output, Row
from benchmarks.planted import FAMILIES, Planted
from exactpt.errors import AuditError

__all__ = ["FULL", "QUICK", "Sizes", "Wrong", "count_wrong", "run"]

EXACT: Final = (*OWN, ARRAYS)
"""The methods of exactpt: they may not be wrong."""
OFF: Final = 1e-9
"""Minimum error of a time that counts as wrong."""


class Sizes(NamedTuple):
    """Size of the benchmark: scenes per family, steps of the programs that take steps."""

    scenes: int
    steps: int


QUICK: Final = Sizes(10, 200)
FULL: Final = Sizes(100, 1000)


@final
@dataclass(slots=True)
class Wrong:
    """Number of wrong results of a method for a family; off: found, but at another time."""

    scenes: int = 0
    missed: int = 0
    invented: int = 0
    off: int = 0

    @property
    def total(self) -> int:
        """The number of all wrong results."""
        return self.missed + self.invented + self.off


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Run every method on every family.

    Raises:
        AuditError: if a result of exactpt is wrong.
    """
    methods = [m for m in _methods(sizes.steps) if m.package is None or output.has(m.package)]
    names = [_short_name(method) for method in methods]
    rows: list[Row] = []
    shown: list[Row] = []
    shares: list[list[float | None]] = []
    for family, make in FAMILIES.items():
        scenes = [make(Random(f"{family}:{seed}:{i}")) for i in range(sizes.scenes)]
        line: list[float | None] = []
        short: dict[str, Cell] = {"missed/invented/off": family}
        for method in methods:
            output.progress(f"{family}: {method.name}")
            wrong = count_wrong(method, scenes)
            rows.append(
                {
                    "family": family,
                    "method": method.name,
                    "setting": method.setting,
                    "scenes": wrong.scenes,
                    "missed": wrong.missed,
                    "invented": wrong.invented,
                    "off": wrong.off,
                }
            )
            counts = f"{wrong.missed}/{wrong.invented}/{wrong.off}" if wrong.scenes else None
            short[_short_name(method)] = counts
            line.append(wrong.total / wrong.scenes if wrong.scenes else None)
            if method in EXACT and (wrong.total or wrong.scenes < len(scenes)):
                raise AuditError(f"{method.name} {method.setting}, {family}: {wrong}")
        shares.append(line)
        shown.append(short)
    output.table("wrong-answers", rows, shown)
    output.shares("wrong-answers", "Share of wrong answers", list(FAMILIES), names, shares)


def count_wrong(method: Method, scenes: Sequence[Planted]) -> Wrong:
    """Compare a method's results with the truth; scenes that do not suit it do not count."""
    wrong = Wrong()
    for scene, truth in scenes:
        try:
            answer = method.prepare(scene)()
        except UnsuitableScene:
            continue
        wrong.scenes += 1
        if truth is None:
            wrong.invented += answer is not None
        elif answer is None:
            wrong.missed += 1
        else:
            error = error_of(answer, truth)
            wrong.off += error > (0.0 if method in EXACT else OFF)
    return wrong


def _methods(steps: int) -> list[Method]:
    return [
        *EXACT,
        CLOSED_FORM,
        others.shapely(steps, bisect=True),
        others.pymunk(steps),
        others.tight_inclusion(1e-6, 32),
        others.additive(0.9999, 32),
    ]


def _short_name(method: Method) -> str:
    return f"{method.name} {method.setting}" if method in EXACT else method.name
