"""Scenes of families before witnesses, and questions between them: the campaign by default."""

from __future__ import annotations

import contextlib
import json
import time as clock
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

from exactpt import InputError, Scene
from exactpt.scene.format import loads
from exactpt.scene.written import to_json
from exactpt.testing.shrinking import shrink_data
from exactpt.workers.work import HANGS
from fuzz.campaign import FOUND, Check, Counts, Finding, Item, Result, Step, Tell
from fuzz.changes.excerpts import scene_of
from fuzz.laws import kept
from fuzz.limits import TimeIsUp, TooSlow, limit, patience_of, signed
from fuzz.questions.command import KEPT, ask
from fuzz.witnesses import OLD, WITNESSES, Difference, LeftOutError

__all__ = ["QUESTION", "Case", "Failure", "Scenes", "failure_of", "run_case", "shrunk"]


QUESTION: Final = "questions/"
"""What the family of a case begins with if it is no scene, but one of `fuzz.questions`."""

LEFT_OUT: Final = "left out"
"""The column of the numbers of scenes about which a witness could say nothing."""

WHILE_ANOTHER_WORKS: Final = 4.0
"""Factor of the patience with a witness that waits for another process, on a busy machine."""

USUAL: Final = 8
SEVERAL: Final = {
    "runs": 1,
    "spin": 1,
    "path": 1,
    "stated": 2,
    "touching-rings": 2,
    "flips": 4,
    "small-scope": 60,
}
"""Number of questions in a case, for about the same time each; `USUAL` of all others."""


class Case(NamedTuple):
    """A scene or a question to be checked: the ``number``-th of its campaign."""

    number: int
    family: str
    seed: int

    @property
    def question(self) -> str | None:
        """The name of the question; None if the case is a scene."""
        return self.family.removeprefix(QUESTION) if self.family.startswith(QUESTION) else None


@dataclass(frozen=True, slots=True)
class Failure:
    """A failure found by a witness.

    Attributes:
        witness: name of the witness.
        signature: type of the failure, the same for the same fault in another scene.
        why: description of the failure.
        scene: the scene as JSON, shrunk if there was time.
    """

    witness: str
    signature: str
    why: str
    scene: str

    def of(self, case: Case) -> Finding:
        """Return the finding of a case, with the file of the kept case."""
        number, family, seed = case
        note = f"fuzz {self.witness}, {family} {seed}: {self.why}"
        files = kept.file_of_finding(self.witness, json.loads(self.scene), note)
        return Finding(family, self.signature, f"case {number}, {family} {seed}: {self.why}", files)


@dataclass(frozen=True)
class Scenes(Check):
    """The check of scenes by witnesses.

    Attributes:
        families: names of families and questions (`QUESTION`), taken in turn.
        witnesses: names of the witnesses that check every scene.
        seed: the seed of the first scene of each family.
        shrink_seconds: time limit for shrinking each failure.
    """

    families: Sequence[str]
    witnesses: Sequence[str]
    seed: int = 0
    shrink_seconds: float = 60.0
    name = "scenes"

    @property
    def about(self) -> object:
        """The families, the witnesses and the seed."""
        return [list(self.families), list(self.witnesses), self.seed]

    def case(self, number: int) -> Case:
        """Return a case by its number."""
        turn, k = divmod(number, len(self.families))
        return Case(number, self.families[k], self.seed + turn)

    def run(self, item: Item, tell: Tell, ends: float | None) -> Result:
        """Check a case."""
        (number,) = item.numbers
        return run_case(
            self.case(number), tell, witnesses=self.witnesses,
            shrink_seconds=self.shrink_seconds, ends=ends,
        )  # fmt: skip

    def table(self, counts: Counts) -> list[str]:
        """One line for each family: cases, cases per second, failures, seconds by witness."""
        rows = sorted({row for row, _ in counts})
        columns = list(dict.fromkeys(column for _, column in counts))
        timed = [column for column in columns if column not in ("cases", FOUND, LEFT_OUT)]
        total = defaultdict[str, float](int)
        for (_, column), n in counts.items():
            total[column] += n
        lines = [f"{'family':22}{'cases':>8}{'a second':>10}{'failures':>10}"
                 + "".join(map("{:>11}".format, timed))]  # fmt: skip
        for row in [*rows, "all"]:
            line = (
                total if row == "all" else {c: counts[row, c] for c in (*columns, "cases", FOUND)}
            )
            seconds = sum(line[column] for column in timed)
            rate = line["cases"] / seconds if seconds else 0.0
            lines.append(f"{row:22}{line['cases']:>8}{rate:>10.1f}{line[FOUND]:>10}"
                         + "".join(f"{line[column]:>9.1f} s" for column in timed))  # fmt: skip
        if total[LEFT_OUT]:
            lines.append(f"{total[LEFT_OUT]} cases left out, of which a witness can say nothing")
        return lines


def run_case(
    case: Case,
    tell: Tell = lambda _: None,
    *,
    witnesses: Sequence[str],
    shrink_seconds: float = 60.0,
    ends: float | None = None,
) -> Result:
    """Have witnesses check a case; each failure is shrunk for at most ``shrink_seconds``.

    Args:
        case: the case.
        tell: called before each step.
        witnesses: names of the witnesses.
        shrink_seconds: time limit for shrinking a failure.
        ends: the time (of ``time.time``) at which the campaign is over; None if it has no end.

    Raises:
        TimeIsUp: at this time, if nothing has been found.
    """
    counts = Counts({(case.family, "cases"): 1})
    if case.question is not None:
        return _ask_several(case, case.question, counts, tell, ends)
    try:
        scene = scene_of(case.family, case.seed)
    except InputError as error:
        nothing = Scene([], (0, 1))
        return Result(counts, [_failure("generator", "InputError", str(error), nothing).of(case)])
    found: list[Finding] = []
    for name in witnesses:
        most = patience_of(scene) * (WHILE_ANOTHER_WORKS if name == OLD else 1.0)
        tell(Step(most, _failure(name, HANGS, name, scene).of(case)))
        began = clock.perf_counter()
        try:
            failure = _judged(name, scene, case.seed, most, ends)
        except LeftOutError:
            counts[case.family, LEFT_OUT] += 1
            failure = None
        except TimeIsUp:
            if not found:
                raise
            break
        counts[case.family, name] = seconds = clock.perf_counter() - began
        if failure is not None:
            # A failure that takes little time takes little time in a smaller scene, too.
            patience = most if failure.signature == HANGS else min(most, 2.0 + 4.0 * seconds)
            tell(Step(shrink_seconds + patience, failure.of(case), is_found=True))
            found.append(shrunk(failure, case.seed, shrink_seconds, patience, ends).of(case))
    return Result(counts, found)


def _ask_several(
    case: Case, question: str, counts: Counts, tell: Tell, ends: float | None
) -> Result:
    """Have some questions answered and compared with their definitions; nothing is shrunk."""
    several = SEVERAL.get(question, USUAL)
    found: list[Finding] = []
    began = clock.perf_counter()
    for number in range(several * case.number, several * (case.number + 1)):
        try:
            asked = ask(question, case.seed, number, tell, ends, keep=KEPT)
        except TimeIsUp:
            if not found:
                raise
            break
        found += (finding._replace(row=case.family) for finding in asked.findings)
    counts[case.family, "questions"] = clock.perf_counter() - began
    return Result(counts, found)


def failure_of(
    name: str,
    scene: Scene,
    turn: int | None = None,
    patience: float | None = None,
    ends: float | None = None,
) -> Failure | None:
    """The failure that a witness finds in a scene, or None; for ``turn`` see `Witness`.

    Raises:
        TimeIsUp: at the end of the campaign.
    """
    try:
        return _judged(name, scene, turn, patience, ends)
    except LeftOutError:
        return None


def _judged(
    name: str, scene: Scene, turn: int | None, patience: float | None, ends: float | None
) -> Failure | None:
    """Return the same.

    Raises:
        LeftOutError: if the witness can say nothing.
        TimeIsUp: at the end of the campaign.
    """
    seconds = patience_of(scene) if patience is None else patience
    try:
        with limit(seconds, ends):
            WITNESSES[name](scene, turn)
    except TooSlow:
        return _failure(name, HANGS, f"{HANGS}: no answer within {seconds:.1f} s", scene)
    except Difference as found:
        return _failure(name, found.kind, str(found), scene)
    except LeftOutError:
        raise
    except Exception as error:  # any exception is a finding
        return _failure(name, *signed(error), scene)
    return None


def _failure(name: str, signature: str, why: str, scene: Scene) -> Failure:
    return Failure(name, signature, why, json.dumps(to_json(scene)))


def shrunk(
    failure: Failure, turn: int, seconds: float, patience: float, ends: float | None = None
) -> Failure:
    """The same failure in the smallest scene found within the time limit."""
    best = failure

    def still_fails(data: object) -> bool:
        nonlocal best
        try:
            scene = loads(json.dumps(data))
        except InputError:
            return False
        found = failure_of(failure.witness, scene, turn, patience, ends)
        if found is None or found.signature != failure.signature:
            return False
        best = found
        return True

    with contextlib.suppress(TimeIsUp):
        shrink_data(json.loads(failure.scene), still_fails, seconds)
    return best
