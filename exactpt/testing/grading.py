"""Answers in a file against the truth, by the table of `check`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Final

from exactpt.errors import InputError
from exactpt.kernel.numbers import Rational, shorten
from exactpt.testing.comparing import bound, verdict
from exactpt.testing.families import FAMILIES, make_question
from exactpt.testing.questions import Asked, Name, double, objects, read_question
from exactpt.testing.table import Table
from exactpt.testing.truth import truths

CHUNK: Final = 4096
NO_ANSWER: Final = object()
"""The answer to a question that has none, or an error."""


def grade(
    answers: Iterable[bytes], asked: dict[Name, Asked] | None, tolerance: Rational
) -> tuple[Table, list[str]]:
    """Return the table of answers, and a line for each wrong one.

    Args:
        answers: lines of JSON with "id" and "time", see docs/testing.md.
        asked: the questions by id, of which those without an answer count as crashed; None for
            the questions of `make_question` that the ids name.
        tolerance: the largest error of a time that still counts as right.

    Raises:
        InputError: if a line is not an answer, or answers no question or one a second time; or if
            the tolerance is negative.
    """
    exact = bound(tolerance)
    given: dict[Name, object] = {}
    for number, line in enumerate(answers, 1):
        if line.strip():
            try:
                name, answer = _answer(objects(line))
                if name in given:
                    raise InputError(f"a second answer to {shorten(name)}")
                if asked is not None and name not in asked:
                    raise InputError(f"no question {shorten(name)}")
                given[name] = answer
            except InputError as error:
                raise InputError(f"line {number}: {error}") from None
    questions = {n: _named(n) for n in given} if asked is None else asked
    table, wrong, names = Table(), list[str](), list(questions)
    for first in range(0, len(names), CHUNK):
        some = names[first : first + CHUNK]
        try:
            right = truths([questions[n] for n in some])
        except InputError as error:
            raise InputError(f"among its questions: {error}") from None
        for name, truth in zip(some, right, strict=True):
            answer = given.get(name, NO_ANSWER)
            found = verdict(truth.time, answer, exact)
            table.count(_family(name), found)
            if found != "right":
                wrong.append(f"{name}: {found}")
    return table, wrong


def questions_in(lines: Sequence[bytes]) -> dict[Name, Asked]:
    """Return the questions of lines of JSON, by id; the number of the line if it has none.

    Raises:
        InputError: if a line is not a question, or two have one id.
    """
    asked: dict[Name, Asked] = {}
    for number, line in enumerate(lines, 1):
        if line.strip():
            try:
                name, question = read_question(line)
            except InputError as error:
                raise InputError(f"line {number}: {error}") from None
            name = number if name is None else name
            if name in asked:
                raise InputError(f"line {number}: a second question {shorten(name)}")
            asked[name] = question
    return asked


def _named(name: Name) -> Asked:
    """Return the question that `make_question` has named so."""
    family, *rest = str(name).split(":")
    if family not in FAMILIES or len(rest) != 2:
        raise InputError(f"no question of a family: {shorten(name)} (name the questions)")
    try:
        seed, number = map(int, rest)
    except ValueError:
        raise InputError(f"no question of a family: {shorten(name)}") from None
    return make_question(family, seed, number)


def _family(name: Name) -> str:
    family = str(name).partition(":")[0]
    return family if family in FAMILIES else "others"


def _answer(data: dict[str, object]) -> tuple[Name, object]:
    """Return the id of an answer, and its time, None for no contact, or `NO_ANSWER`."""
    name = data.get("id")
    if isinstance(name, bool) or not isinstance(name, str | int):
        raise InputError(f'"id": neither a text nor an integer: {shorten(name)}')
    if "error" in data:
        return name, NO_ANSWER
    if "time" not in data:
        raise InputError('the key "time" is missing')
    time = data["time"]
    if time is None:
        return name, None
    return name, double(time.get("approx") if isinstance(time, dict) else time, '"time"')
