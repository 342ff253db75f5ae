"""oracle, questions and judge: the truth for programs in any language."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

import click

from exactpt.cli.options import RATIONAL, bounded, max_bytes, output, within_budget
from exactpt.cli.terminal import print_error, print_output
from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, shorten

_FEW = 10
"""Number of wrong answers that are named."""


@click.command()
@click.argument("file", type=click.File("rb"), default="-", metavar="[FILE]")
@bounded
def oracle(file: BinaryIO, max_seconds: float | None) -> int:
    """Write the exact truth of each question, one line of JSON each, in the same order.

    Questions come from a file or from standard input; whenever no more of them have come, all
    answers so far are written. docs/testing.md explains both. A line that is not a question has an
    answer with the key "error", and the exit code is 2 at the end. --max-bytes bounds a line, by
    default to 2^24.

    \b
    Examples:
      exactpt oracle questions.jsonl
      exactpt questions grazing_corner -n 1000 | exactpt oracle > truths.jsonl
    """
    from exactpt.testing.oracle import Refusals, answers, chunks_of_lines

    refusals, first = Refusals(), 1
    with within_budget(max_seconds):
        for lines in chunks_of_lines(file, max_bytes()):
            output = "\n".join(answers(lines, first, refusals))
            first += len(lines)
            if output:
                click.echo(output)  # it flushes
    if refusals.count:
        raise InputError(f"{refusals.count} of {first - 1} lines refused; {refusals.first}")
    return 0


class _WithQuestions(click.Command):
    """A command whose help ends with a list of the families of questions."""

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the families."""
        super().format_epilog(ctx, formatter)
        from exactpt.testing.families import DEGENERATE, GENERIC

        for heading, families in {"Degenerate": DEGENERATE, "Generic": GENERIC}.items():
            with formatter.section(heading):
                rows = [(name, " ".join((f.__doc__ or "").split())) for name, f in families.items()]
                formatter.write_dl(rows)


@click.command(cls=_WithQuestions)
@click.argument("family")
@click.option(
    "-n", "count", type=click.IntRange(min=0), default=100, show_default=True,
    help="Number of questions, of each family.",
)  # fmt: skip
@click.option("--seed", type=int, default=0, show_default=True, help="Seed of the questions.")
@output("The file of questions; by default standard output.")
def questions(family: str, count: int, seed: int, output: Path | None) -> int:
    """Write questions about two bodies, one line of JSON each: of a family, or of "all".

    They are the same on every machine. Their ids identify them, so that `exactpt judge` needs
    the answers alone.

    \b
    Examples:
      exactpt questions hairs_breadth -n 1000 -o questions.jsonl
      exactpt questions all -n 5 --seed 7
    """
    _write_questions(family, count, seed, output)
    return 0


def _write_questions(family: str, count: int, seed: int, output: Path | None) -> None:
    from exactpt.files import writing
    from exactpt.testing.families import FAMILIES, make_question

    names = list(FAMILIES) if family == "all" else [family]
    if names[0] not in FAMILIES:
        raise InputError(f"no family {shorten(family)}; there are: all, {', '.join(FAMILIES)}")

    def lines() -> Iterator[str]:
        for number in range(count):
            for name in names:
                yield json.dumps(make_question(name, seed, number).to_json())

    if output is None:
        for line in lines():
            click.echo(line)
    else:
        with writing(output) as write:
            for line in lines():
                write(line + "\n")


@click.command()
@click.argument("answers", type=click.Path(path_type=Path), metavar="ANSWERS")
@click.option(
    "--questions", "asked", type=click.Path(path_type=Path),
    help="The file of questions, if `exactpt questions` has not made them; all must be answered.",
)  # fmt: skip
@click.option(
    "--tolerance", type=RATIONAL, default="1e-9", show_default=True,
    help="Largest error of a time that is none.",
)  # fmt: skip
@click.option("--json", "as_json", is_flag=True, help="Print the table as JSON.")
@bounded
def judge(
    answers: Path, asked: Path | None, tolerance: QQ, as_json: bool, max_seconds: float | None
) -> int:
    """Compare answers, one line of JSON each, with the truth: a table of right and wrong ones.

    An answer has the "id" of its question and a "time", null for no contact; docs/testing.md
    explains more. The exit code is 1 if one is wrong.

    \b
    Examples:
      exactpt judge answers.jsonl
      exactpt judge answers.jsonl --tolerance 1e-6 --json
      exactpt judge answers.jsonl --questions questions.jsonl
    """
    from exactpt.files import read_bytes
    from exactpt.testing.grading import grade, questions_in

    with within_budget(max_seconds):
        known = None
        if asked is not None:
            lines = read_bytes(asked, max_bytes()).splitlines()
            try:
                known = questions_in(lines)
            except InputError as error:
                raise InputError(f"{asked}: {error}") from None
        given = read_bytes(answers, max_bytes()).splitlines()
        try:
            table, wrong = grade(given, known, tolerance)
        except InputError as error:
            raise InputError(f"{answers}: {error}") from None
    print_output(*(json.dumps(table.to_json(), indent=1) if as_json else str(table)).split("\n"))
    if wrong:
        more = [f"and {len(wrong) - _FEW} more"] if len(wrong) > _FEW else []
        print_error(*wrong[:_FEW], *more)
    return 0 if table.ok else 1
