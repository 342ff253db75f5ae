"""Engines and the truth: verdicts by family, and the worst answer of each, shrunken."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median
from typing import Any, Final, NamedTuple, final

from benchmarks.engines.domain import as_asked, from_zero, why_not
from benchmarks.engines.engine import Engine
from benchmarks.engines.promise import WITHIN, fault, leeway
from exactpt.testing import FAMILIES, Question, Truth, make_question, truths
from exactpt.testing.shrinking import shrink_question
from exactpt.testing.truth import truth_of

__all__ = ["COLUMNS", "WRONG", "Asked", "Finding", "Result", "ask", "questions"]

WRONG: Final = ("missed", "late", "invented", "early", "crashed")
"""The verdicts about wrong answers, the worst first."""
COLUMNS: Final = ("right", WITHIN, *WRONG, "not asked")
FAR: Final = 1000.0
"""Coordinates above this are far from the origin."""
CLEARLY: Final = 10.0
"""An answer is clearly wrong if a promise that is weaker by this factor is broken, too."""


class Asked(NamedTuple):
    """A question of a family from time 0 on, and its truth; None if it has no such form."""

    family: str
    question: Question | None
    truth: Truth


@final
@dataclass(frozen=True, slots=True)
class Finding:
    """A wrong answer.

    Attributes:
        verdict: how it is wrong, one of `WRONG`.
        clear: whether it is wrong by far, see `CLEARLY`.
        question, truth: the question, and the truth.
        answer: the answer.
    """

    verdict: str
    clear: bool
    question: Question
    truth: Truth
    answer: object

    @property
    def order(self) -> tuple[bool, int, bool, int]:
        """The key of findings: the worst first, then those that are near, then the smallest."""
        bodies = self.question.a, self.question.b
        reach = max(abs(c) for body in bodies for vertex in body.vertices for c in vertex)
        return not self.clear, WRONG.index(self.verdict), reach > FAR, self.question.size


@final
@dataclass(slots=True)
class Result:
    """The answers of an engine, called in one way.

    Attributes:
        name: the engine and the way.
        about: the description by its adapter.
        way: the way.
        version: its version.
        rows: by family, the number of answers of each of `COLUMNS`.
        reasons: why questions were left out, with their number.
        seconds: how long each answer took.
        error: the largest error of a time that keeps the promise; None if there is none.
        worst: the worst finding, shrunken; None if there is none.
    """

    name: str
    about: Mapping[str, Any]
    way: str
    version: str
    rows: dict[str, dict[str, int]] = field(default_factory=dict)
    reasons: dict[str, int] = field(default_factory=dict)
    seconds: list[float] = field(default_factory=list)
    error: float | None = None
    worst: Finding | None = None

    @property
    def promises(self) -> list[tuple[str, str]]:
        """The promise of the engine in this way: its words, and where they stand."""
        about, way = self.about, self.about["ways"][self.way]
        return [(words, where) for words, where in way.get("promises") or about["promises"]]

    def count(self, family: str, column: str) -> None:
        """Count one question."""
        self.rows.setdefault(family, dict.fromkeys(COLUMNS, 0))[column] += 1

    @property
    def total(self) -> dict[str, int]:
        """The number of answers of each of `COLUMNS` in all families."""
        return {c: sum(row[c] for row in self.rows.values()) for c in COLUMNS}

    @property
    def microseconds(self) -> float | None:
        """The median time of an answer."""
        return 1e6 * median(self.seconds) if self.seconds else None


def questions(count: int, seed: int) -> list[Asked]:
    """Questions of every family with their truths."""
    made = [(f, make_question(f, seed, i)) for f in FAMILIES for i in range(count)]
    shifted = [from_zero(question) for _, question in made]
    known = iter(truths([q for q in shifted if q is not None]))
    return [
        Asked(family, q, Truth(None) if q is None else next(known))
        for (family, _), q in zip(made, shifted, strict=True)
    ]


def ask(
    engine: Engine, way: str, asked: Sequence[Asked], *, seconds: float,
    progress: Callable[[str], None] = lambda _: None,
) -> Result:  # fmt: skip
    """Put all questions that it takes to an engine, in one way.

    Args:
        engine: the engine.
        way: one of its ways.
        asked: the questions.
        seconds: the time limit for shrinking the worst finding.
        progress: called with a line about the current step.
    """
    name = f"{engine.about['name']}, {way}" if way else str(engine.about["name"])
    takes = takes_of(engine, way)
    result = Result(name, engine.about, way, engine.version)
    worst: Finding | None = None
    for family, question, truth in asked:
        why = "numbers that are no doubles" if question is None else None
        why = why or (question and why_not(takes, question, truth))
        if question is None or why:
            result.count(family, "not asked")
            result.reasons[str(why)] = result.reasons.get(str(why), 0) + 1
            continue
        reply = engine.ask(as_asked(question), way)
        if reply.seconds is not None:
            result.seconds.append(reply.seconds)
        found = _judged(engine, way, question, truth, reply.answer)
        result.count(family, found if isinstance(found, str) else found.verdict)
        if found == WITHIN and truth.time is not None and isinstance(reply.answer, float):
            result.error = max(result.error or 0.0, abs(reply.answer - float(truth.time)))
        if isinstance(found, Finding) and (worst is None or found.order < worst.order):
            worst = found
    if worst is not None:
        progress(f"{name}: shrinking {worst.question.name}")
        result.worst = _shrunken(engine, way, worst, seconds)
    return result


def takes_of(engine: Engine, way: str) -> dict[str, Any]:
    """What an engine takes in a way, see `why_not`."""
    return {**engine.about["takes"], **engine.about["ways"][way].get("takes", {})}


def _judged(
    engine: Engine, way: str, question: Question, truth: Truth, answer: object
) -> Finding | str:
    """A finding, or the column of an answer that is none."""
    allowed = leeway(engine.about["ways"][way]["allows"], question)
    found = fault(question, truth, answer, allowed)
    if found not in WRONG:
        return found
    clear = fault(question, truth, answer, allowed.times(CLEARLY)) in WRONG
    return Finding(found, clear, question, truth, answer)


def _shrunken(engine: Engine, way: str, worst: Finding, seconds: float) -> Finding:
    """The smallest question found that is answered wrong in the same way, and as clearly."""

    def judged(question: Question, truth: Truth) -> Finding | None:
        at_zero = question.time[0] == 0.0 and not any(
            any(f[:1]) for body in (question.a, question.b) for f in (body.x, body.y)
        )
        if not at_zero or why_not(takes_of(engine, way), question, truth):
            return None
        answer = engine.ask(as_asked(question), way).answer
        found = _judged(engine, way, question, truth, answer)
        return found if isinstance(found, Finding) else None

    def fails(question: Question, truth: Truth) -> bool:
        found = judged(question, truth)
        return found is not None and (found.verdict, found.clear) == (worst.verdict, worst.clear)

    small = shrink_question(worst.question, fails, seconds=seconds)
    return judged(small, truth_of(small)) or worst
