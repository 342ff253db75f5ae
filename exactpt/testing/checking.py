"""check: anyone's time of impact against the truth, with shrunken counterexamples."""

from __future__ import annotations

import pprint
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias, final

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, Rational, shorten
from exactpt.testing.comparing import TOLERANCE, VERDICTS, bound, shown_time, verdict
from exactpt.testing.families import FAMILIES, make_question
from exactpt.testing.questions import Question
from exactpt.testing.shrinking import shrink_question
from exactpt.testing.table import Table
from exactpt.testing.truth import Truth, truth_of, truths

__all__ = ["Counterexample", "Report", "check"]

Toi: TypeAlias = Callable[[Question], object]

CHUNK: Final = 1000
"""Number of questions whose truths are found at once."""


@final
@dataclass(frozen=True, slots=True)
class Counterexample:
    """A question that is answered wrong, shrunken.

    Attributes:
        verdict: what is wrong: "missed", "invented", "early", "late" or "crashed".
        question: the question; its ``name`` is that of the question that was shrunken.
        answer: the wrong answer, or the exception.
        truth: the right one.
    """

    verdict: str
    question: Question
    answer: object
    truth: Truth

    def __str__(self) -> str:
        time = self.truth.time
        right = "no contact" if time is None else f"a contact at t = {shown_time(time)}"
        sizes = f"{len(self.question.a.vertices)} and {len(self.question.b.vertices)} vertices"
        said = "no contact" if self.answer is None else repr(self.answer)
        return f"{self.verdict} ({self.question.name}, {sizes}): {said}; the truth is {right}"


@final
@dataclass(frozen=True, slots=True)
class Report:
    """What `check` has found. ``str(report)`` is the table and a line for each counterexample.

    Attributes:
        table: the verdicts, by family.
        counterexamples: at most one for each way to be wrong.
    """

    table: Table
    counterexamples: tuple[Counterexample, ...]
    _module: str
    _function: str
    _tolerance: float

    @property
    def ok(self) -> bool:
        """Whether all answers are right."""
        return self.table.ok

    def pytest_file(self) -> str:
        """The text of a pytest file with a test for each counterexample."""
        known = self._module != "__main__" and self._function.isidentifier()
        imported = f"from {self._module} import {self._function} as toi"
        other = "from my_module import toi  # the place of your function"
        head = [
            '"""Questions that were answered wrong, found by exactpt.testing."""\n',
            "from exactpt.testing import Question, assert_same_contact\n",
            imported if known else other,
        ]
        return "\n".join([*head, *map(self._test, self.counterexamples)]) + "\n"

    def _test(self, example: Counterexample) -> str:
        data = {**example.question.to_json(), "id": example.question.name}
        written = pprint.pformat(data, indent=1, width=92, sort_dicts=False)
        return (
            f"\n\ndef test_{example.verdict}():\n"
            f'    """{_one_line(str(example))}"""\n'
            f"    question = Question.from_json(\n{_indented(written, 8)}\n    )\n"
            f"    assert_same_contact("
            f"question.scene, toi(question), tolerance={self._tolerance!r})"
        )

    def __str__(self) -> str:
        return "\n".join([str(self.table), *map(str, self.counterexamples)])


def check(
    toi: Toi,
    *,
    cases: int = 1000,
    seed: int = 0,
    families: Sequence[str] | None = None,
    tolerance: Rational = TOLERANCE,
) -> Report:
    """Ask a function for times of impact, and compare its answers with the truth.

    >>> from exactpt.testing import check
    >>> report = check(lambda question: None, cases=4, families=["edge_to_edge"])
    >>> report.table.total["missed"], report.ok
    (4, False)

    Args:
        toi: takes a `Question`, and returns the time of the first contact (a float, an integer,
            a Fraction), or None if there is none in the closed time span. Whatever else it
            returns or raises counts as crashed.
        cases: the number of questions, dealt to the families in turn.
        seed: the seed of the questions.
        families: names of `FAMILIES`; all if not given.
        tolerance: the largest error of a time that is none. It forgives no contact that is
            missed or invented, however near.

    Raises:
        InputError: if ``toi`` is no function, there is no such family, or the tolerance or the
            number of questions is negative.
    """
    if not callable(toi):
        raise InputError(f"toi: not a function: {shorten(toi)}")
    number: object = cases
    if not isinstance(number, int) or number < 0:
        raise InputError(f"cases: not a number of questions: {shorten(number)}")
    table, worst, exact = Table(), _Worst(), bound(tolerance)
    names = list(FAMILIES if families is None else families)
    if not names:
        raise InputError("families: none is named")
    asked = [make_question(names[i % len(names)], seed, i // len(names)) for i in range(cases)]
    for question, truth in _with_truths(asked):
        found, _ = _judged(toi, question, truth, exact)
        table.count(str(question.name).partition(":")[0], found)
        worst.see(found, question)
    examples = tuple(_shrunken(toi, found, q, exact) for found, q in worst.in_order())
    module, function = (getattr(toi, key, "") for key in ("__module__", "__qualname__"))
    return Report(table, examples, module, function, float(exact))


def _with_truths(asked: Sequence[Question]) -> Iterator[tuple[Question, Truth]]:
    for first in range(0, len(asked), CHUNK):
        some = asked[first : first + CHUNK]
        yield from zip(some, truths(some), strict=True)


class _Worst:
    """The smallest question of each verdict."""

    def __init__(self) -> None:
        self._smallest: dict[str, Question] = {}

    def see(self, found: str, question: Question) -> None:
        before = self._smallest.get(found)
        if before is None or question.size < before.size:
            self._smallest[found] = question

    def in_order(self) -> list[tuple[str, Question]]:
        return [(v, self._smallest[v]) for v in VERDICTS[1:] if v in self._smallest]


def _judged(toi: Toi, question: Question, truth: Truth, tolerance: QQ) -> tuple[str, object]:
    """The verdict about an answer, and the answer, which may be an exception."""
    try:
        answer = toi(question)
    except Exception as error:  # what a wrong function does is a finding
        return "crashed", error
    return verdict(truth.time, answer, tolerance), answer


def _shrunken(toi: Toi, found: str, question: Question, tolerance: QQ) -> Counterexample:
    """The smallest question found that is wrong in the same way."""
    smallest = shrink_question(
        question, lambda smaller, truth: _judged(toi, smaller, truth, tolerance)[0] == found
    )
    truth = truth_of(smallest)
    return Counterexample(found, smallest, _judged(toi, smallest, truth, tolerance)[1], truth)


def _one_line(text: str) -> str:
    return " ".join(text.split()).replace("\\", "\\\\").replace('"', "'")


def _indented(text: str, width: int) -> str:
    return "\n".join(" " * width + line for line in text.splitlines())
