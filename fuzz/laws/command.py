"""The commands of the laws: run them, repeat a case, keep one, record costs."""

from __future__ import annotations

import json
import re
import sys
from contextlib import AbstractContextManager, nullcontext
from datetime import UTC, datetime
from pathlib import Path
from typing import Final

import click

from exactpt.errors import InputError
from exactpt.files import write_atomically
from fuzz.laws import kept
from fuzz.laws.base import Base, Verdict
from fuzz.laws.known import KNOWN, reason_of
from fuzz.laws.runner import (
    COSTS,
    TIERS,
    Case,
    Fault,
    Tally,
    cases_of,
    costs,
    count_of,
    favour,
    look,
    run_for,
    runnable,
    scene_of,
    shrunk,
)
from fuzz.laws.table import LAWS
from fuzz.options import FAILED, HELP, INTERRUPTED

__all__ = ["again", "keep", "kept_file", "record_costs", "run"]

WEEKDAY_HELP: Final = "About half of the time is that of one law in seven; 1 is Monday."
ON_HELP: Final = "Compare each fault with this commit; only new ones fail."

SAME: Final = 1.5
"""Ratio of milliseconds up to which a recorded cost stays as it is."""


def _today() -> int:
    return int(datetime.now(UTC).strftime("%Y%m%d"))


def _laws_of(words: tuple[str, ...]) -> list[str]:
    """Return the laws whose names begin with one of some words, by default all.

    Raises:
        UsageError: if there is none.
    """
    laws = [law for law in LAWS if not words or law.startswith(words)]
    if not laws:
        raise click.UsageError(f"no law begins with {' or '.join(words)}; see run --list")
    return laws


def _case_of(words: tuple[str, ...]) -> Case:
    try:
        return Case.parse(" ".join(words))
    except InputError as error:
        raise click.UsageError(str(error)) from None


@click.command("run", context_settings=HELP)
@click.argument("words", nargs=-1, metavar="[LAW]...")
@click.option("--seconds", type=click.FloatRange(min=0), help="Processor time; by default 60.")
@click.option("--tier", type=click.Choice(list(TIERS)), help="The cases of a tier, by number.")
@click.option("--seed", type=int, help="Seed of the cases; by default the date.")
@click.option("--shrink", default=20.0, show_default=True, help="Seconds for each kind of fault.")
@click.option("--on", "on", metavar="COMMIT", help=ON_HELP)
@click.option("--weekday", type=click.IntRange(1, 7), help=WEEKDAY_HELP)
@click.option("--list", "is_list", is_flag=True, help="Only list the laws.")
def run(
    words: tuple[str, ...], seconds: float | None, tier: str | None, seed: int | None,
    shrink: float, on: str | None, weekday: int | None, *, is_list: bool,
) -> None:  # fmt: skip
    """Check cases of the laws whose names begin with LAW, by default of all laws.

    Each kind of fault is reported once, in the smallest scene found, with the command that repeats
    it. The table has the outcomes of each law. With --on, each fault is repeated with the laws and
    the package of another commit, such as the one before a change. A fault that is there, too, is
    reported as "there before", and only one that is new fails the run.

    \b
    Examples:
      python -m fuzz run --seconds 600
      python -m fuzz run --seconds 120 --on main
      python -m fuzz run tiling space --seed 7
      python -m fuzz run --tier full --seed 0
    """
    if seconds is not None and tier is not None:
        raise click.UsageError("--seconds and --tier exclude each other; leave one of them out")
    if weekday is not None and tier is not None:
        raise click.UsageError("--weekday and --tier exclude each other; leave one of them out")
    laws = _laws_of(words)
    if is_list:
        click.echo("\n".join(f"{law:26}{LAWS[law].meaning}" for law in laws))
        return
    for law in laws:
        if not LAWS[law].is_runnable:
            click.echo(f"{law} is left out: {LAWS[law].needs} is not built")
    laws = runnable(laws)
    seed = _today() if seed is None else seed
    click.echo(f"{len(laws)} laws, seed {seed}")
    if tier is None:
        favoured = [] if weekday is None else laws[weekday - 1 :: 7]
        looked = run_for(laws, seed, 60.0 if seconds is None else seconds, favour(favoured))
    else:
        looked = (look(case) for law in laws for case in cases_of(law, seed, count_of(law, tier)))
    tally, reports, is_interrupted = Tally(), _Reports(shrink), False
    with _base_of(on) as reports.base:
        try:
            for one in looked:
                tally.add(one)
                if one.fault is not None and reason_of(str(one.case)) is None:
                    reports.add(one.fault)
        except KeyboardInterrupt:
            is_interrupted = True
    click.echo("\n".join(tally.table()))
    healed = [] if is_interrupted else _healed(laws)
    for case in healed:
        click.echo(f"holds, and is known to be broken (fuzz/laws/known.py): {case}")
    if is_interrupted:
        sys.exit(INTERRUPTED)
    sys.exit(FAILED if reports.has_new or healed else 0)


def _base_of(commit: str | None) -> AbstractContextManager[Base | None]:
    """Return the other commit, opened; None if none is named.

    Raises:
        UsageError: if the repository has no such commit.
    """
    if commit is None:
        return nullcontext()
    try:
        return Base(commit)
    except InputError as error:
        raise click.UsageError(f"--on: {error}") from None


class _Reports:
    """Reports each kind of fault once, and once more if it is new where the first one was not.

    Attributes:
        base: the commit with which faults are compared; None for none: all of them are new.
        has_new: True if a fault was new.
    """

    def __init__(self, shrink: float) -> None:
        self.base: Base | None = None
        self.has_new = False
        self._shrink = shrink
        self._reported = set[tuple[str, str, bool]]()

    def add(self, fault: Fault) -> None:
        """Report a fault, unless its kind has been reported."""
        kind = fault.case.law, fault.signature
        if (*kind, True) in self._reported:
            return
        if (*kind, False) in self._reported and not self._verdict(fault).is_new:
            return
        smaller = shrunk(fault, self._shrink)
        verdict = self._verdict(fault, smaller)
        self._reported.add((*kind, verdict.is_new))
        self.has_new |= verdict.is_new
        click.echo(smaller.report)
        if self.base is not None:
            click.echo(f"  {verdict}")

    def _verdict(self, fault: Fault, smaller: Fault | None = None) -> Verdict:
        if self.base is None:
            return Verdict(is_new=True, why="")
        return self.base.verdict(fault, smaller)


def _healed(laws: list[str]) -> list[str]:
    """Return the known cases of some laws that are not broken any more."""
    cases = [Case.parse(known.case) for known in KNOWN]
    return [str(case) for case in cases if case.law in laws and look(case).fault is None]


@click.command("again", context_settings=HELP)
@click.argument("words", nargs=-1, required=True, metavar="LAW SOURCE:SEED:NUMBER")
@click.option("--shrink", default=20.0, show_default=True, help="Seconds for shrinking.")
@click.option("--on", "on", metavar="COMMIT", help=ON_HELP)
def again(words: tuple[str, ...], shrink: float, on: str | None) -> None:
    """Repeat a case; report the fault in the smallest scene found.

    With --on, the case is repeated on the same scene with the laws and the package of another
    commit, too. The exit code is 1 if the law is broken, unless that commit breaks it in the same
    way.

    \b
    Examples:
      python -m fuzz again 'first contact/reference' 'corpus:0:13'
      python -m fuzz again 'first contact/reference' 'corpus:0:13' --on main
    """
    case = _case_of(words)
    looked = look(case)
    reports = _Reports(shrink)
    with _base_of(on) as base:
        if looked.fault is None:
            click.echo(f"holds: {looked.outcome}")
            scene = scene_of(case)
            if base is not None and scene is not None:
                click.echo(f"  {base.outcome(case, scene)}")
            return
        reports.base = base
        reports.add(looked.fault)
    sys.exit(FAILED if reports.has_new else 0)


@click.command("keep", context_settings=HELP)
@click.argument("words", nargs=-1, required=True, metavar="LAW SOURCE:SEED:NUMBER")
@click.option("--note", default="", help="What was wrong, in a line.")
@click.option("--shrink", default=60.0, show_default=True, help="Seconds for shrinking.")
def keep(words: tuple[str, ...], note: str, shrink: float) -> None:
    """Write a case that breaks a law to tests/cases, in the smallest scene found.

    The tests check the law on that scene from now on.
    """
    case = _case_of(words)
    looked = look(case)
    if looked.fault is None:
        raise click.UsageError(f"{case}: the law holds ({looked.outcome}), nothing to keep")
    path, text = kept_file(shrunk(looked.fault, shrink), note)
    path.parent.mkdir(exist_ok=True)
    write_atomically(path, text)
    click.echo(f"wrote {path}; write into its note what was wrong")


def kept_file(fault: Fault, note: str) -> tuple[Path, str]:
    """Return the file of a kept case, and its text."""
    name = re.sub(r"\W+", "-", str(fault.case)).strip("-")
    text = kept.text_of(
        {
            "note": note or fault.why,
            "law": fault.case.law,
            "case": fault.case.choices,
            "scene": fault.scene.to_json(),
        }
    )
    return kept.FOLDER / f"{name}.json", text


@click.command("costs", context_settings=HELP)
@click.argument("words", nargs=-1, metavar="[LAW]...")
@click.option("--seconds", default=120.0, show_default=True, help="Processor time in all.")
def record_costs(words: tuple[str, ...], seconds: float) -> None:
    """Record the milliseconds of a case of each LAW, from which the tiers' counts follow.

    A cost that is about the recorded one stays as it is, so that the file changes little.
    """
    tally = Tally()
    for looked in run_for(runnable(_laws_of(words)), 0, seconds):
        tally.add(looked)
    before = costs()
    found = {law: _cost(before.get(law), tally.milliseconds(law)) for law in tally.outcomes}
    found = {law: cost for law, cost in (before | found).items() if law in LAWS}
    write_atomically(COSTS, json.dumps(found, indent=1) + "\n")
    click.echo("\n".join(tally.table()))


def _cost(before: float | None, now: float) -> float:
    """Return the cost to record: that of before, if it is about the same."""
    is_same = before is not None and before / SAME <= now <= before * SAME
    return before if is_same and before is not None else round(now, 1)
