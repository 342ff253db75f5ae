"""The check of scenes of the scope by number, fifty at a time."""

from __future__ import annotations

import datetime
import json
import time as clock
from dataclasses import dataclass, field
from typing import Final

from exactpt.scene.written import to_json
from fuzz.campaign import Check, Counts, Finding, Item, Result, Step, Tell
from fuzz.cases import Case, Failure, failure_of, shrunk
from fuzz.limits import TimeIsUp
from fuzz.small_scope import tally
from fuzz.small_scope.look import AUDITED, looks, looks_at_proofs
from fuzz.small_scope.scope import planned, sizes

__all__ = ["Scope", "start_of"]

A_DAY: Final = 4000
"""Distance of the starts of two consecutive days."""

PATIENCE: Final = 120.0
"""Seconds in which fifty scenes are checked by all methods."""


def start_of(day: datetime.date) -> int:
    """The first scene of a day; scenes that a day leaves out come in later rounds."""
    return day.toordinal() * A_DAY


@dataclass
class Scope(Check):
    """The check of scenes of the scope.

    Attributes:
        proofs: whether proofs are checked, instead of answers compared.
        shrink: seconds for shrinking the first scene of a fault.
        known: faults that have been reported, in this process: methods and the fault.
    """

    proofs: bool = False
    shrink: float = 20.0
    known: set[tuple[str, str]] = field(default_factory=set)
    name = "small scope"
    chunk = 50

    @property
    def about(self) -> object:
        """The sizes of the scope, and the checks."""
        return [sizes(), "with --proofs" if self.proofs else "without --proofs"]

    def wanted(self, counts: Counts) -> frozenset[tuple[str, str]] | None:
        """Return None: everything. The faults of the cases before are known from then on."""
        self.known |= {fault[:2] for fault in tally.faults(counts)}
        return None

    def run(self, item: Item, tell: Tell, ends: float | None) -> Result:
        """Check scenes; a finding is the first scene of a fault that is not known."""
        first, last = item.numbers[0], item.numbers[-1]
        tell(Step(PATIENCE, Finding("", "hangs", f"scenes {first} to {last}")))
        began, counts = clock.process_time(), Counts()
        compare = looks_at_proofs if self.proofs else looks
        for seen in compare([planned(number) for number in item.numbers]):
            counts.add(tally.counts_of(seen))
        counts["all", "seconds"] = clock.process_time() - began
        findings = []
        for fault, (number, _) in tally.faults(counts).items():
            if fault[:2] not in self.known:
                self.known.add(fault[:2])
                why = f"scene {number}: {' - '.join(fault)}"
                tell(Step(PATIENCE + self.shrink, Finding("", "", why), is_found=True))
                finding = _failure_in(int(number), fault, self.shrink, ends)
                findings.append(finding._replace(row="", why=f"{why}\n  {finding.why}"))
        return Result(counts, findings)

    def table(self, counts: Counts) -> list[str]:
        """Lines by part, shapes, order, place and time; then by method."""
        return tally.table(counts)


def _failure_in(number: int, fault: tally.Fault, seconds: float, ends: float | None) -> Finding:
    """The failure of a scene as in a campaign of families, shrunk for at most ``seconds``.

    A fault that no witness of these finds is not shrunk.
    """
    scene, turn = planned(number).scene, number // AUDITED
    case = Case(number, "small scope", number)
    witness = {"static": "static", "proof": "proof"}.get(fault.method.split()[0], "reference")
    try:
        failure = failure_of(witness, scene, turn, ends=ends)
        if failure is not None and seconds:
            failure = shrunk(failure, turn, seconds, patience=5.0, ends=ends)
    except TimeIsUp:
        failure = None
    if failure is None:
        said = f"{fault.method}: {fault.what}"
        failure = Failure("small-scope", said, said, json.dumps(to_json(scene)))
    return failure.of(case)
