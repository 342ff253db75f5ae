"""Counts of the scenes of a scope, by cell and by method, and their table."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

from fuzz.campaign import FIRST, Counts
from fuzz.small_scope.look import Look
from fuzz.small_scope.motions import ORDERS, TIMES
from fuzz.small_scope.placements import complete
from fuzz.small_scope.scope import COMPLETE, Cell, sizes

__all__ = ["Fault", "cells", "counts_of", "disagreements", "faults", "methods", "table"]

CELL, METHOD, FAULT = "cell", "method", "fault"
"""The first words of rows."""

SCENES: Final = ("scenes", "contacts", "planned", "disagreements")
"""The columns of a cell."""

ANSWERS: Final = ("answers", "disagreements", "seconds")
"""The columns of a method."""


class Fault(NamedTuple):
    """A fault, as far as faults can be told apart.

    Attributes:
        method: the method that is wrong.
        what: the attribute in which its answer differs.
        kinds: the kinds of the shapes.
        order: the order of contact.
    """

    method: str
    what: str
    kinds: str
    order: str


def counts_of(seen: Look) -> Counts:
    """Return the counts of a scene."""
    cell, counts = seen.planned.cell, Counts()
    wrong = any(answer.fault for answer in seen.answers)
    figures = (1, seen.contact is not None, seen.as_planned, wrong)
    counts.update({(CELL, *cell, name): int(n) for name, n in zip(SCENES, figures, strict=True)})
    for method, seconds, fault in seen.answers:
        answers = (1, int(fault is not None), seconds)
        counts.update({(METHOD, method, c): n for c, n in zip(ANSWERS, answers, strict=True)})
        if fault is not None:
            key = (FAULT, *Fault(method, fault, cell.kinds, cell.order))
            counts[*key, FIRST] = seen.planned.number
            counts[*key, "scenes"] += 1
    return counts


def cells(counts: Counts) -> dict[Cell, list[float]]:
    """Return the numbers of each cell: scenes, contacts, contacts as planned, disagreements."""
    found = dict.fromkeys(Cell(*key[1:-1]) for key in counts if key[0] == CELL)
    return {cell: [counts[CELL, *cell, name] for name in SCENES] for cell in found}


def methods(counts: Counts) -> dict[str, list[float]]:
    """Return for each method the answers, disagreements and processor time."""
    found = dict.fromkeys(key[1] for key in counts if key[0] == METHOD)
    return {method: [counts[METHOD, method, name] for name in ANSWERS] for method in found}


def faults(counts: Counts) -> dict[Fault, list[float]]:
    """Return for each fault the number of the first scene, and the number of scenes."""
    found = dict.fromkeys(Fault(*key[1:-1]) for key in counts if key[0] == FAULT)
    return {f: [counts[FAULT, *f, name] for name in (FIRST, "scenes")] for f in found}


def disagreements(counts: Counts) -> int:
    """Return the number of scenes on which some methods disagree."""
    return sum(int(row[-1]) for row in cells(counts).values())


def table(counts: Counts) -> list[str]:
    """Lines by part, shapes, order, place and time; then by method."""
    return [*_by_cell(counts), "", *_by_method(counts), "", *_summary(counts)]


def _by_cell(counts: Counts) -> Iterator[str]:
    yield f"{'':34}{'cells':>7}{'scenes':>10}{'contacts':>10}{'planned':>10}{'disagreements':>15}"
    rows = cells(counts)
    for column, name in enumerate(Cell._fields):
        yield name
        for value in sorted({cell[column] for cell in rows}, key=_rank):
            yield _line(value, [c for key, c in rows.items() if key[column] == value])
    yield _line("all", list(rows.values()), indent=0)


def _by_method(counts: Counts) -> Iterator[str]:
    yield f"{'method':34}{'answers':>9}{'disagreements':>15}{'seconds':>10}"
    for method, (answers, wrong, seconds) in methods(counts).items():
        yield f"  {method:32}{answers:>9,}{wrong:>15,}{seconds:>10.1f}"


def _summary(counts: Counts) -> Iterator[str]:
    rows = cells(counts)
    for part, size in sizes().items():
        done = sum(c[0] for cell, c in rows.items() if cell.part == part)
        yield f"{part}: {done:,} of {size:,} scenes of a round, {100 * done / size:.2f} %"
    own = [figures for cell, figures in rows.items() if cell.part == COMPLETE]
    without = sum(not planned for _, _, planned, _ in own)
    yield (
        f"{len(own):,} of {_cells_in_all():,} cells of the complete part seen, "
        f"{without:,} of them without a planned contact so far"
    )
    yield f"{counts['all', 'seconds']:,.0f} s of processor time"


def _rank(value: str) -> tuple[int, str]:
    """Sort key: orders and times in their own order, everything else by name."""
    ranked = (*sizes(), *ORDERS, *TIMES)
    return (ranked.index(value) if value in ranked else -1, value)


def _line(name: str, rows: Sequence[Sequence[float]], indent: int = 2) -> str:
    scenes, contacts, planned, wrong = (
        sum(column) for column in zip((0, 0, 0, 0), *rows, strict=True)
    )
    head = f"{' ' * indent + name:34}{len(rows):>7,}"
    return f"{head}{scenes:>10,}{contacts:>10,}{planned:>10,}{wrong:>15,}"


def _cells_in_all() -> int:
    """Number of cells of the complete part; at rest the only contact is at the start."""
    kinds = {(placement.kinds, placement.place) for placement in complete()}
    return len(kinds) * ((len(ORDERS) - 1) * len(TIMES) + 1)
