"""The command that makes mistakes, and says which of them the laws find, and which some tests."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random
from typing import Final

import click
import pytest

from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten
from fuzz.laws.runner import runnable
from fuzz.laws.scenes import made
from fuzz.laws.table import LAWS
from fuzz.options import FAILED, HELP, INTERRUPTED
from fuzz.power.hunt import Found, TestHunt, by_laws, refuse_compiled
from fuzz.power.mistakes import Mistake, of_mutant, planted
from fuzz.power.mutants import PARTS, mutants, named_mutant
from fuzz.power.reached import Reached

__all__ = ["power"]

LEFT_OUT: Final = "not slow and not browser"
"""The marks of the tests that are collected."""

COPY: Final = "compiled copy"
"""A program that has no planted mistake, but would have each real one: it finds too much."""


@dataclass(frozen=True, slots=True)
class Row:
    """A mistake, and what has found it.

    Attributes:
        mistake: its name.
        place: the changed line.
        is_masked: True if no answer can show it.
        laws, tests: what the laws and the tests have found; None if they were not asked.
    """

    mistake: str
    place: str
    is_masked: bool
    laws: Found | None = None
    tests: Found | None = None

    def to_json(self) -> str:
        """Return the row as a line of JSON."""
        data = {
            "mistake": self.mistake,
            "place": self.place,
            "masked": self.is_masked,
            "laws": self.laws and self.laws._asdict(),
            "tests": self.tests and self.tests._asdict(),
        }
        return json.dumps(data)

    @classmethod
    def parse(cls, line: str) -> Row:
        """Return the row of a line of JSON."""
        data = json.loads(line)
        laws, tests = (data[key] and Found(**data[key]) for key in ("laws", "tests"))
        return cls(data["mistake"], data["place"], data["masked"], laws, tests)

    @property
    def is_found(self) -> bool:
        """True if a law or a test finds it."""
        return any(found is not None and found.by for found in (self.laws, self.tests))

    @property
    def has_escaped(self) -> bool:
        """True if no law finds it though an answer can show it; or one does though none can."""
        return self.laws is not None and bool(self.laws.by) == self.is_masked

    @property
    def text(self) -> str:
        """The row as it is printed."""
        lines = [f"{self.mistake}  ({self.place})"]
        for hunter, found in (("laws", self.laws), ("tests", self.tests)):
            if found is not None:
                by = found.by or ("masked" if self.is_masked else "NOTHING")
                lines.append(
                    f"  {hunter:6}{found.seconds:6.1f} s {found.tried:6} of {found.reaching:3}"
                    f"  {' '.join([by, found.case])}: {found.why}"
                )
        return "\n".join(lines)


Hunt = Callable[[Mistake], Found]
"""Hunts a mistake."""


@click.command("power", context_settings=HELP)
@click.argument("words", nargs=-1, metavar="[WORD]...")
@click.option("--mutants", "count", type=click.IntRange(min=1), help="Mutants, not planted ones.")
@click.option("--mutant-seed", type=int, default=0, show_default=True)
@click.option("--again", "escaped", type=click.Path(exists=True, dir_okay=False, path_type=Path),
              help="The mutants of this file of results that nothing found.")  # fmt: skip
@click.option("--part", "parts", multiple=True, help="A folder of exactpt to be changed.")
@click.option("--laws/--no-laws", "is_by_laws", default=True, help="Hunt by the laws.")
@click.option("--law", "chosen", multiple=True, help="Only laws whose names begin so.")
@click.option("--tests", multiple=True, type=click.Path(exists=True), help="Hunt by these, too.")
@click.option("--seconds", default=60.0, show_default=True, help="Processor time a hunt.")
@click.option("--seed", type=int, default=0, show_default=True, help="Seed of the cases.")
@click.option("--reached", "databases", multiple=True, type=click.Path(path_type=Path),
              help="Recorded coverage: only tests that run the changed line.")  # fmt: skip
@click.option("--results", type=click.Path(dir_okay=False, path_type=Path),
              help="JSON lines; a run that was stopped goes on.")  # fmt: skip
def power(
    words: tuple[str, ...], count: int | None, mutant_seed: int, parts: tuple[str, ...],
    chosen: tuple[str, ...], tests: tuple[str, ...], seconds: float, seed: int,
    databases: tuple[Path, ...], results: Path | None, escaped: Path | None, *, is_by_laws: bool,
) -> None:  # fmt: skip
    """Make mistakes one at a time, and count the seconds until a law is broken, or a test fails.

    The mistakes are those of fuzz/planted.py, or mutants of random places of the package; those
    with a WORD in their names. Each is made in a process of its own. The laws whose cases run the
    changed line most often have most of the time. A few mistakes are masked: no answer can show
    them. One of these that is found counts as one that has escaped. Tests that start the command
    in a new process do not see the mistake.

    \b
    Examples:
      python -m fuzz power --seconds 20
      python -m fuzz power --mutants 40 --part pair --part search --results search.jsonl
      python -m fuzz power --again search.jsonl --results again.jsonl
      python -m fuzz power --mutants 40 --part search --tests tests/unit/search \\
        --reached .coverage --results search.jsonl
    """
    named = [law for law in LAWS if not chosen or law.startswith(chosen)]
    laws = [law for law in runnable(named) if LAWS[law].needs != COPY]
    if not laws:
        raise click.UsageError(f"--law: no law begins with {' or '.join(chosen)}; see run --list")
    if parts and count is None:
        raise click.UsageError("--part is for mutants; add --mutants")
    if escaped is not None and count is not None:
        raise click.UsageError("--again and --mutants exclude each other; leave one of them out")
    if escaped is not None and results is not None and escaped.resolve() == results.resolve():
        raise click.UsageError("--again and --results are one file; write to another one")
    if not is_by_laws and not tests:
        raise click.UsageError("--no-laws leaves nothing to hunt by; add --tests")
    try:
        refuse_compiled()
        if escaped is not None:
            drawn = [of_mutant(named_mutant(name)) for name in _escaped(escaped)]
        elif count is not None:
            drawn = [of_mutant(mutant) for mutant in mutants(count, mutant_seed, parts or PARTS)]
        else:
            drawn = planted()
        reached = Reached(databases)
        done = _read(results) if results is not None and results.exists() else {}
    except InputError as error:
        raise click.UsageError(str(error)) from None
    mistakes = [one for one in drawn if not words or any(word in one.name for word in words)]
    made("scope", Random(0))  # the small scope is numbered once, before processes are made

    def hunt_by_laws(mistake: Mistake) -> Found:
        return by_laws(mistake, laws, seed, seconds)

    rows: list[Row] = []

    def hunt(hunt_by_tests: Hunt | None) -> None:
        laws_too = hunt_by_laws if is_by_laws else None
        with suppress(KeyboardInterrupt):
            for row in _rows(mistakes, laws_too, hunt_by_tests, done, results):
                rows.append(row)
                click.echo(row.text)

    if tests:
        _collected(tests, reached, seconds, hunt)
    else:
        hunt(None)
    click.echo("\n".join(_summary(rows)))
    if len(rows) < len(mistakes):
        goes_on = "" if results is None else "; the same command goes on"
        click.echo(f"interrupted{goes_on}", err=True)
        sys.exit(INTERRUPTED)
    sys.exit(FAILED if any(row.has_escaped for row in rows) else 0)


def _read(results: Path) -> dict[str, Row]:
    """Return the rows of a file of results; the last one of each mistake.

    Raises:
        InputError: if a line is not one that `Row.to_json` has written.
    """
    rows: dict[str, Row] = {}
    for number, line in enumerate(results.read_text(encoding="utf-8").splitlines(), start=1):
        try:
            row = Row.parse(line)
        except (ValueError, KeyError, TypeError):
            raise InputError(
                f"{results}: line {number}: expected a row of results, got {shorten(line)}"
            ) from None
        rows[row.mistake] = row
    return rows


def _escaped(results: Path) -> list[str]:
    """Return the names of the mistakes of a file that nothing found."""
    return [name for name, row in _read(results).items() if not row.is_found]


def _rows(
    mistakes: Sequence[Mistake], laws: Hunt | None, tests: Hunt | None, done: Mapping[str, Row],
    results: Path | None,
) -> Iterator[Row]:  # fmt: skip
    """Yield the row of each mistake, and add it to a file of results.

    Args:
        mistakes: the mistakes.
        laws: hunts by the laws, or None.
        tests: hunts by tests, or None.
        done: the rows of that file so far, which are not hunted again.
        results: the file; None for none.
    """
    for mistake in mistakes:
        before = done.get(mistake.name)
        row = before or Row(mistake.name, str(mistake.lines), mistake.is_masked)
        if laws is not None and row.laws is None:
            row = replace(row, laws=laws(mistake))
        if tests is not None and row.tests is None:
            row = replace(row, tests=tests(mistake))
        if results is not None and row != before:
            with results.open("a", encoding="utf-8") as file:
                file.write(f"{row.to_json()}\n")
        yield row


def _collected(
    paths: Sequence[str], reached: Reached, seconds: float, hunt: Callable[[Hunt], None]
) -> None:
    """Collect tests, and hunt by them.

    Raises:
        UsageError: if they cannot be collected.
    """

    class Loop:
        """A plugin of pytest: instead of running the tests once, they are run on each mistake."""

        has_begun = False

        @pytest.hookimpl(tryfirst=True)
        def pytest_runtestloop(self, session: pytest.Session) -> bool:
            self.has_begun = True
            tests = TestHunt(session.items)

            def hunt_by_tests(mistake: Mistake) -> Found:
                return tests.find(mistake, reached.among(tests.files, mistake.lines), seconds)

            hunt(hunt_by_tests)
            return True

    loop = Loop()
    quiet = ["-q", "--no-header", "--no-summary", "-s", "-p", "no:cacheprovider"]
    pytest.main([*paths, *quiet, "-m", LEFT_OUT], [loop])
    if not loop.has_begun:
        raise click.UsageError("--tests: pytest cannot collect them; see its output above")


def _summary(rows: Sequence[Row]) -> list[str]:
    """Return the numbers of mistakes that the laws and the tests have found."""
    is_open = [row for row in rows if not row.is_masked]
    lines = [f"{len(rows)} mistakes, {len(rows) - len(is_open)} of them masked"]
    if any(row.laws for row in rows):
        found = sum(bool(row.laws and row.laws.by) for row in is_open)
        lines.append(f"found by the laws: {found}")
    if any(row.tests for row in rows):
        found = sum(bool(row.tests and row.tests.by) for row in is_open)
        lines.append(f"found by the tests: {found}")
    if any(row.laws and row.tests for row in rows):
        only = [row.mistake for row in is_open if row.tests and row.tests.by
                and not (row.laws and row.laws.by)]  # fmt: skip
        lines += [f"found by the tests only: {len(only)}", *(f"  {name}" for name in only)]
    nothing = [row.mistake for row in is_open if not row.is_found]
    lines += [f"found by nothing: {len(nothing)}", *(f"  {name}" for name in nothing)]
    return lines
