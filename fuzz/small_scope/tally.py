"""Tallies of the scenes of a scope, by cell and by method; as a table and as JSON."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Self

from fuzz.small_scope.look import Look
from fuzz.small_scope.motions import ORDERS, TIMES
from fuzz.small_scope.placements import complete
from fuzz.small_scope.scope import COMPLETE, Cell, sizes

__all__ = ["Fault", "Tally"]

SCENES, CONTACTS, PLANNED, DISAGREEMENTS = range(4)


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


@dataclass(slots=True)
class Tally:
    """Counts of scenes.

    Attributes:
        cells: for each cell the scenes, contacts, contacts as planned, and disagreements.
        methods: for each method the answers, disagreements and processor time.
        faults: for each fault the number of the first scene, and the number of scenes.
        seconds: processor time of everything.
    """

    cells: dict[Cell, list[int]] = field(default_factory=dict)
    methods: dict[str, list[float]] = field(default_factory=dict)
    faults: dict[Fault, list[int]] = field(default_factory=dict)
    seconds: float = 0.0

    def note(self, seen: Look) -> None:
        """Count a scene."""
        cell = seen.planned.cell
        wrong = any(answer.fault for answer in seen.answers)
        _add(
            self.cells.setdefault(cell, [0] * 4),
            [1, seen.contact is not None, seen.as_planned, wrong],
        )
        for method, seconds, fault in seen.answers:
            _add(self.methods.setdefault(method, [0, 0, 0.0]), [1, fault is not None, seconds])
            if fault is not None:
                key = Fault(method, fault, cell.kinds, cell.order)
                self.faults.setdefault(key, [seen.planned.number, 0])[1] += 1

    def add(self, other: Tally) -> list[tuple[Fault, int]]:
        """Add the counts of later scenes; returns the new faults, with the first scene of each."""
        for cell, counts in other.cells.items():
            _add(self.cells.setdefault(cell, [0] * 4), counts)
        for method, figures in other.methods.items():
            _add(self.methods.setdefault(method, [0, 0, 0.0]), figures)
        self.seconds += other.seconds
        new = [(key, first) for key, (first, _) in other.faults.items() if key not in self.faults]
        for key, (first, count) in other.faults.items():
            self.faults.setdefault(key, [first, 0])[1] += count
        return new

    @property
    def scenes(self) -> int:
        """Number of scenes."""
        return sum(counts[SCENES] for counts in self.cells.values())

    @property
    def disagreements(self) -> int:
        """Number of scenes on which some methods disagree."""
        return sum(counts[DISAGREEMENTS] for counts in self.cells.values())

    def to_json(self) -> dict[str, Any]:
        """The tally as JSON data."""
        return {
            "seconds": self.seconds,
            "cells": [[*cell, *counts] for cell, counts in self.cells.items()],
            "methods": self.methods,
            "faults": [[*fault, *counts] for fault, counts in self.faults.items()],
        }

    @classmethod
    def from_json(cls, data: dict[str, Any]) -> Self:
        """The tally from JSON data."""
        return cls(
            {Cell(*row[:5]): row[5:] for row in data["cells"]},
            data["methods"],
            {Fault(*row[:4]): row[4:] for row in data["faults"]},
            data["seconds"],
        )

    def table(self) -> list[str]:
        """Lines by part, shapes, order, place and time; then by method."""
        return [*self._by_cell(), "", *self._by_method(), "", *self._summary()]

    def _by_cell(self) -> Iterator[str]:
        yield (
            f"{'':34}{'cells':>7}{'scenes':>10}{'contacts':>10}{'planned':>10}{'disagreements':>15}"
        )
        for column, name in enumerate(Cell._fields):
            yield name
            for value in sorted({cell[column] for cell in self.cells}, key=_rank):
                yield _line(value, [c for key, c in self.cells.items() if key[column] == value])
        yield _line("all", list(self.cells.values()), indent=0)

    def _by_method(self) -> Iterator[str]:
        yield f"{'method':34}{'answers':>9}{'disagreements':>15}{'seconds':>10}"
        for method, (answers, faults, seconds) in self.methods.items():
            yield f"  {method:32}{answers:>9,}{faults:>15,}{seconds:>10.1f}"

    def _summary(self) -> Iterator[str]:
        for part, size in sizes().items():
            done = sum(c[SCENES] for cell, c in self.cells.items() if cell.part == part)
            yield f"{part}: {done:,} of {size:,} scenes of a round, {100 * done / size:.2f} %"
        own = [counts for cell, counts in self.cells.items() if cell.part == COMPLETE]
        without = sum(not counts[PLANNED] for counts in own)
        yield (
            f"{len(own):,} of {_cells_in_all():,} cells of the complete part seen, "
            f"{without:,} of them without a planned contact so far"
        )
        yield f"{self.seconds:,.0f} s of processor time"


def _add(sums: list[Any], values: list[Any]) -> None:
    for i, value in enumerate(values):
        sums[i] += value


def _rank(value: str) -> tuple[int, str]:
    """Sort key: orders and times in their own order, everything else by name."""
    ranked = (*sizes(), *ORDERS, *TIMES)
    return (ranked.index(value) if value in ranked else -1, value)


def _line(name: str, rows: list[list[int]], indent: int = 2) -> str:
    scenes, contacts, planned, wrong = (sum(column) for column in zip(*rows, strict=True))
    head = f"{' ' * indent + name:34}{len(rows):>7,}"
    return f"{head}{scenes:>10,}{contacts:>10,}{planned:>10,}{wrong:>15,}"


def _cells_in_all() -> int:
    """Number of cells of the complete part; at rest the only contact is at the start."""
    kinds = {(placement.kinds, placement.place) for placement in complete()}
    return len(kinds) * ((len(ORDERS) - 1) * len(TIMES) + 1)
