"""Cases: a scene of a family and a seed, the verdicts of the witnesses, and their times."""

from __future__ import annotations

import contextlib
import json
import time as clock
import traceback
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

from exactpt.errors import InputError
from exactpt.scene.format import loads
from exactpt.scene.scene import Scene
from exactpt.scene.written import to_json
from exactpt.testing.shrinking import shrink_data
from exactpt.workers import work
from fuzz.limits import HANGS, TimeIsUp, TooSlow, limit, patience_of
from fuzz.questions.checks import checked
from fuzz.subscene import scene_of
from fuzz.witnesses import WITNESSES, Difference

__all__ = [
    "QUESTION",
    "Case",
    "Failure",
    "Outcome",
    "Step",
    "failure_of",
    "left_by",
    "run_case",
    "shrunk",
    "stopped",
]


QUESTION: Final = "questions/"
"""What the family of a case begins with if it is no scene, but one of `fuzz.questions`."""


PATIENCE: Final = 60.0
"""Seconds after which a question counts as hanging."""

SEVERAL, LONG = 8, ("runs", "spin")
"""Number of questions in a case, and those that are long enough one by one."""


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


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result of a case.

    Attributes:
        case: the case.
        seconds: time of each witness, by name.
        failures: the failures found.
        complete: whether all witnesses have answered before the end of the campaign.
    """

    case: Case
    seconds: dict[str, float]
    failures: tuple[Failure, ...]
    complete: bool = True


@dataclass(frozen=True, slots=True)
class Step:
    """What is done next with a case.

    Attributes:
        witness: name of the witness.
        seconds: limit of its time, or of the time for shrinking.
        scene: the scene as JSON.
        failure: the failure that is being shrunk.
    """

    witness: str
    seconds: float
    scene: str
    failure: Failure | None = None


def run_case(
    case: Case,
    tell: Callable[[Step], None] = lambda _: None,
    *,
    witnesses: Sequence[str],
    shrink_seconds: float = 60.0,
    ends: float | None = None,
) -> Outcome:
    """Have witnesses check a case; each failure is shrunk for at most ``shrink_seconds``.

    Args:
        case: the case.
        tell: called before each step.
        witnesses: names of the witnesses.
        shrink_seconds: time limit for shrinking a failure.
        ends: the time (of ``time.time``) at which the campaign is over; None if it has no end.
    """
    if case.question is not None:
        return _run_question(case, case.question, tell, ends)
    try:
        scene = scene_of(case.family, case.seed)
    except InputError as error:
        return Outcome(
            case, {}, (_failure("generator", "InputError", str(error), Scene([], (0, 1))),)
        )
    seconds: dict[str, float] = {}
    failures: list[Failure] = []
    most, text = patience_of(scene), json.dumps(to_json(scene))
    for name in witnesses:
        tell(Step(name, most, text))
        began = clock.perf_counter()
        try:
            failure = failure_of(name, scene, case.seed, most, ends)
        except TimeIsUp:
            return Outcome(case, seconds, tuple(failures), complete=False)
        seconds[name] = clock.perf_counter() - began
        if failure is not None:
            # A failure that takes little time takes little time in a smaller scene, too.
            patience = most if failure.signature == HANGS else min(most, 2.0 + 4.0 * seconds[name])
            tell(Step(name, shrink_seconds + patience, text, failure))
            failures.append(shrunk(failure, case.seed, shrink_seconds, patience, ends))
    return Outcome(case, seconds, tuple(failures))


def _run_question(
    case: Case, question: str, tell: Callable[[Step], None], ends: float | None
) -> Outcome:
    """Have some questions answered and compared with their definitions; nothing is shrunk."""
    failures: list[Failure] = []
    began = clock.perf_counter()
    several = 1 if question in LONG else SEVERAL
    for number in range(several * case.number, several * (case.number + 1)):
        tell(Step(question, PATIENCE, "null"))
        try:
            with limit(PATIENCE, ends):
                found = checked(question, case.seed, number)
            if found.fault is None:
                continue
            signature, why, data = "difference", found.fault, found.to_json()
        except TimeIsUp:
            return Outcome(case, {}, tuple(failures), complete=False)
        except TooSlow:
            signature, why, data = HANGS, f"{HANGS}: no answer within {PATIENCE:.0f} s", None
        except Exception as error:  # any exception is a finding
            (signature, why), data = _signed(error), None
        again = f"--question {question} --seed {case.seed} --start {number} --cases 1"
        why += f"\n  again: python -m fuzz questions {again}"
        failures.append(Failure(question, signature, why, json.dumps(data)))
    return Outcome(case, {"questions": clock.perf_counter() - began}, tuple(failures))


def stopped(case: Case, step: Step | None, what: str) -> Outcome:
    """The outcome of a case whose process was stopped: what it was shrinking, or that it hangs."""
    if step is None:
        failure = _failure("generator", what, f"{what} before the first witness", Scene([], (0, 1)))
    elif step.failure is not None:
        failure = step.failure
    else:
        failure = Failure(step.witness, what, f"{what}, where no limit interrupts it", step.scene)
    return Outcome(case, {}, (failure,))


def left_by(case: Case, step: work.Step | None, why: str) -> Outcome | None:
    """What is left by a process that was stopped: None if its case only is not finished."""
    last = step if isinstance(step, Step) else None
    if why == work.UNFINISHED and (last is None or last.failure is None):
        return None
    return stopped(case, last, why)


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
    seconds = patience_of(scene) if patience is None else patience
    try:
        with limit(seconds, ends):
            WITNESSES[name](scene, turn)
    except TooSlow:
        return _failure(name, HANGS, f"{HANGS}: no answer within {seconds:.1f} s", scene)
    except Difference as found:
        return _failure(name, found.kind, str(found), scene)
    except Exception as error:  # any exception is a finding
        return _failure(name, *_signed(error), scene)
    return None


def _signed(error: Exception) -> tuple[str, str]:
    """The signature of an exception, and its description."""
    where = traceback.extract_tb(error.__traceback__)[-1]
    signature = f"{type(error).__name__} in {where.name}"
    return signature, f"{signature}: {error}"


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
