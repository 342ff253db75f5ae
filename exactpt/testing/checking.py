"""check: anyone's time of impact against the truth, with shrunken counterexamples."""

from __future__ import annotations

import pprint
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, Generic, Protocol, TypeAlias, TypeVar, final

from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, Rational, shorten
from exactpt.testing.comparing import TOLERANCE, VERDICTS, bound, shown_time, verdict
from exactpt.testing.families import FAMILIES, make_question
from exactpt.testing.questions import Name, Question
from exactpt.testing.shrinking import shrink_question
from exactpt.testing.table import Table
from exactpt.testing.truth import Truth, truths


class Checked(Protocol):
    """A test question: in the plane (`Question`) or in space (`SpaceQuery`)."""

    @property
    def name(self) -> Name:
        """The name "family:seed:number"."""

    @property
    def size(self) -> int:
        """A number by which questions are compared before one is shrunken."""

    @property
    def summary(self) -> str:
        """A description of a few words."""

    def to_json(self) -> dict[str, object]:
        """Return the question as a JSON object."""


Q = TypeVar("Q", bound=Checked)
Toi: TypeAlias = Callable[[Question], object]


@dataclass(frozen=True, slots=True)
class Subject(Generic[Q]):
    """A kind of test questions.

    Attributes:
        families: the names of its families.
        make: returns the question of a family, a seed and a number.
        truths: returns the truths of questions, in their order.
        shrink: returns a smaller question for which a condition on it and its truth still holds.
        imports: the names that a pytest file imports from the testing kit.
        assertion: the assertion of a pytest file, with a place for the tolerance.
    """

    families: Sequence[str]
    make: Callable[[str, int, int], Q]
    truths: Callable[[Sequence[Q]], list[Truth]]
    shrink: Callable[[Q, Callable[[Q, Truth], bool]], Q]
    imports: str
    assertion: str

    def __repr__(self) -> str:
        return record_in_brief(self)


_PLANE: Final[Subject[Question]] = Subject(
    families=tuple(FAMILIES),
    make=make_question,
    truths=truths,
    shrink=shrink_question,
    imports="from exactpt.testing import Question, assert_same_contact",
    assertion="assert_same_contact(question.scene, toi(question), tolerance={tolerance!r})",
)

CHUNK: Final = 1000
"""Number of questions whose truths are found at once."""


@final
@dataclass(frozen=True, slots=True)
class Counterexample(Generic[Q]):
    """A question with a wrong answer, shrunken.

    Attributes:
        verdict: the kind of error: "missed", "invented", "early", "late" or "crashed".
        question: the question; its ``name`` is that of the question that was shrunken.
        answer: the wrong answer, or the exception.
        truth: the right one.
    """

    verdict: str
    question: Q
    answer: object
    truth: Truth

    def __repr__(self) -> str:
        return record_in_brief(self)

    def __str__(self) -> str:
        time = self.truth.time
        right = "no contact" if time is None else f"a contact at t = {shown_time(time)}"
        said = "no contact" if self.answer is None else repr(self.answer)
        name = f"{self.question.name}, {self.question.summary}"
        return f"{self.verdict} ({name}): {said}; the truth is {right}"


@final
@dataclass(frozen=True, slots=True)
class Report(Generic[Q]):
    """What `check` has found. ``str(report)`` is the table and a line for each counterexample.

    Attributes:
        table: the verdicts, by family.
        counterexamples: the smallest one found for each family and each way to be wrong in it.
    """

    table: Table
    counterexamples: tuple[Counterexample[Q], ...]
    _module: str
    _function: str
    _tolerance: float
    _subject: Subject[Q]

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def ok(self) -> bool:
        """True if all answers are right."""
        return self.table.ok

    def pytest_file(self) -> str:
        """Return the text of a pytest file with a test for each counterexample."""
        known = self._module != "__main__" and self._function.isidentifier()
        imported = f"from {self._module} import {self._function} as toi"
        other = "from my_module import toi  # the place of your function"
        head = [
            '"""Questions that were answered wrong, found by exactpt.testing."""\n',
            f"{self._subject.imports}\n",
            imported if known else other,
        ]
        return "\n".join([*head, *map(self._test, self.counterexamples)]) + "\n"

    def _test(self, example: Counterexample[Q]) -> str:
        data = {**example.question.to_json(), "id": example.question.name}
        written = pprint.pformat(data, indent=1, width=92, sort_dicts=False)
        family = _family(example.question)
        return (
            f"\n\ndef test_{family}_{example.verdict}():\n"
            f'    """{_one_line(str(example))}"""\n'
            f"    question = {type(example.question).__name__}.from_json(\n"
            f"{_indented(written, 8)}\n    )\n"
            f"    {self._subject.assertion.format(tolerance=self._tolerance)}"
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
    accept: Callable[[Question], bool] | None = None,
) -> Report[Question]:
    """Compare a function's times of impact with the exact ones.

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
        tolerance: the largest error of a time that counts as right. It forgives no contact that is
            missed or invented, however near.
        accept: the domain of ``toi``: True for the questions that it is made for, such as
            ``lambda question: question.convex and question.time[0] == 0``. It gets no others,
            also while a counterexample is shrunken; a family without such questions is left out.

    Raises:
        InputError: if ``toi`` is not a function, a family does not exist, the tolerance or the
            number of questions is negative, or ``accept`` refuses all questions.
    """
    return check_subject(_PLANE, toi, cases, seed, families, tolerance, accept)


def check_subject(
    subject: Subject[Q],
    toi: Callable[[Q], object],
    cases: int,
    seed: int,
    families: Sequence[str] | None,
    tolerance: Rational,
    accept: Callable[[Q], bool] | None = None,
) -> Report[Q]:
    """Compare the answers of a function with the truth about questions of one subject.

    The arguments are those of `check`.
    """
    for what, given in (("toi", toi), ("accept", callable if accept is None else accept)):
        if not callable(given):
            raise InputError(f"{what}: not a function: {shorten(given)}")
    number: object = cases
    if not isinstance(number, int) or number < 0:
        raise InputError(f"cases: not a number of questions: {shorten(number)}")
    table, exact = Table(), bound(tolerance)
    smallest: dict[tuple[str, str], Q] = {}  # of each family and verdict
    names = list(subject.families if families is None else families)
    if not names:
        raise InputError("families: none is named")
    asked = list(_accepted(subject, cases, seed, names, accept))
    for question, truth in _with_truths(subject, asked):
        found, _ = _grade(toi, question, truth, exact)
        key = _family(question), found
        table.count(*key)
        if key not in smallest or question.size < smallest[key].size:
            smallest[key] = question
    examples = tuple(
        _shrunken(subject, toi, v, smallest[family, v], exact, accept)
        for family in table.rows
        for v in VERDICTS[1:]
        if (family, v) in smallest
    )
    module, function = (getattr(toi, key, "") for key in ("__module__", "__qualname__"))
    return Report(table, examples, module, function, float(exact), subject)


def _accepted(
    subject: Subject[Q],
    cases: int,
    seed: int,
    names: Sequence[str],
    accept: Callable[[Q], bool] | None,
) -> Iterator[Q]:
    """Yield questions of the families in turn, of each family the first ones that are accepted.

    A family has no more questions if `CHUNK` of them, one after the other, are refused.

    Raises:
        InputError: if all questions are refused.
    """
    left, numbers, given = list(names), dict.fromkeys(names, 0), 0
    while left and given < cases:
        for name in left[: cases - given]:
            for _ in range(CHUNK):
                question = subject.make(name, seed, numbers[name])
                numbers[name] += 1
                if accept is None or accept(question):
                    given += 1
                    yield question
                    break
            else:
                left.remove(name)
    if cases and not given:
        raise InputError("accept: it refuses all questions")


def _family(question: Checked) -> str:
    return str(question.name).partition(":")[0]


def _with_truths(subject: Subject[Q], asked: Sequence[Q]) -> Iterator[tuple[Q, Truth]]:
    for first in range(0, len(asked), CHUNK):
        some = asked[first : first + CHUNK]
        yield from zip(some, subject.truths(some), strict=True)


def _grade(
    toi: Callable[[Q], object], question: Q, truth: Truth, tolerance: QQ
) -> tuple[str, object]:
    """Return the verdict about an answer, and the answer, which may be an exception."""
    try:
        answer = toi(question)
    except Exception as error:  # an exception of a wrong function is a finding
        return "crashed", error
    return verdict(truth.time, answer, tolerance), answer


def _shrunken(
    subject: Subject[Q],
    toi: Callable[[Q], object],
    found: str,
    question: Q,
    tolerance: QQ,
    accept: Callable[[Q], bool] | None,
) -> Counterexample[Q]:
    """Return the smallest question found that is accepted, and wrong in the same way."""

    def fails(smaller: Q, truth: Truth) -> bool:
        if accept is not None and not accept(smaller):
            return False
        return _grade(toi, smaller, truth, tolerance)[0] == found

    smallest = subject.shrink(question, fails)
    (truth,) = subject.truths([smallest])
    return Counterexample(found, smallest, _grade(toi, smallest, truth, tolerance)[1], truth)


def _one_line(text: str) -> str:
    return " ".join(text.split()).replace("\\", "\\\\").replace('"', "'")


def _indented(text: str, width: int) -> str:
    return "\n".join(" " * width + line for line in text.splitlines())
