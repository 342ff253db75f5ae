"""The commands of the laws: run them, repeat a case, keep one, record costs."""

from __future__ import annotations

import json
import re
import sys
from datetime import UTC, datetime
from pathlib import Path
from typing import Final

import click

from exactpt.errors import InputError
from exactpt.files import write_atomically
from fuzz.laws import kept
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
    look,
    run_for,
    runnable,
    shrunk,
)
from fuzz.laws.table import LAWS
from fuzz.options import FAILED, HELP, INTERRUPTED

__all__ = ["again", "keep", "kept_file", "record_costs", "run"]

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
@click.option("--list", "is_list", is_flag=True, help="Only list the laws.")
def run(
    words: tuple[str, ...], seconds: float | None, tier: str | None, seed: int | None,
    shrink: float, *, is_list: bool,
) -> None:  # fmt: skip
    """Check cases of the laws whose names begin with LAW, by default of all laws.

    Each kind of fault is reported once, in the smallest scene found, with the command that repeats
    it. The table has the outcomes of each law.

    \b
    Examples:
      python -m fuzz run --seconds 600
      python -m fuzz run tiling space --seed 7
      python -m fuzz run --tier full --seed 0
    """
    if seconds is not None and tier is not None:
        raise click.UsageError("--seconds and --tier exclude each other; leave one of them out")
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
        looked = run_for(laws, seed, 60.0 if seconds is None else seconds)
    else:
        looked = (look(case) for law in laws for case in cases_of(law, seed, count_of(law, tier)))
    tally, reported, is_interrupted = Tally(), set(), False
    try:
        for one in looked:
            tally.add(one)
            fault = one.fault
            if fault is None or reason_of(str(one.case)) is not None:
                continue
            if (one.case.law, fault.signature) not in reported:
                reported.add((one.case.law, fault.signature))
                click.echo(shrunk(fault, shrink).report)
    except KeyboardInterrupt:
        is_interrupted = True
    click.echo("\n".join(tally.table()))
    healed = [] if is_interrupted else _healed(laws)
    for case in healed:
        click.echo(f"holds, and is known to be broken (fuzz/laws/known.py): {case}")
    if is_interrupted:
        sys.exit(INTERRUPTED)
    sys.exit(FAILED if reported or healed else 0)


def _healed(laws: list[str]) -> list[str]:
    """Return the known cases of some laws that are not broken any more."""
    cases = [Case.parse(known.case) for known in KNOWN]
    return [str(case) for case in cases if case.law in laws and look(case).fault is None]


@click.command("again", context_settings=HELP)
@click.argument("words", nargs=-1, required=True, metavar="LAW SOURCE:SEED:NUMBER")
@click.option("--shrink", default=20.0, show_default=True, help="Seconds for shrinking.")
def again(words: tuple[str, ...], shrink: float) -> None:
    """Repeat a case; report the fault in the smallest scene found."""
    looked = look(_case_of(words))
    if looked.fault is None:
        click.echo(f"holds: {looked.outcome}")
        return
    click.echo(shrunk(looked.fault, shrink).report)
    sys.exit(FAILED)


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
