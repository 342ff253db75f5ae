"""Cases: a scene of a family and a seed, the verdicts of the witnesses, and their times."""

from __future__ import annotations

import contextlib
import json
import signal
import threading
import time as clock
import traceback
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from types import FrameType
from typing import Final, NamedTuple, NoReturn

from exactpt.errors import InputError
from exactpt.scene.format import loads, to_json
from exactpt.scene.scene import Scene
from fuzz.shrink import shrink
from fuzz.subscene import scene_of
from fuzz.witnesses import WITNESSES, Difference

__all__ = ["HANGS", "Case", "Failure", "Outcome", "failure_of", "limit", "run_case", "shrunk"]

HANGS: Final = "hangs"
PATIENCE: Final = 60.0
"""Seconds of processor time after which a witness counts as hanging."""


class Case(NamedTuple):
    """A scene to be checked: the ``number``-th of its campaign."""

    number: int
    family: str
    seed: int


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
    """

    case: Case
    seconds: dict[str, float]
    failures: tuple[Failure, ...]


def run_case(case: Case, witnesses: Sequence[str], shrink_seconds: float = 60.0) -> Outcome:
    """Have witnesses check a case; each failure is shrunk for at most ``shrink_seconds``."""
    try:
        scene = scene_of(case.family, case.seed)
    except InputError as error:
        return Outcome(
            case, {}, (_failure("generator", "InputError", str(error), Scene([], (0, 1))),)
        )
    seconds: dict[str, float] = {}
    failures = []
    for name in witnesses:
        began = clock.perf_counter()
        failure = failure_of(name, scene, case.seed)
        seconds[name] = clock.perf_counter() - began
        if failure is not None:
            # A failure that takes little time takes little time in a smaller scene, too.
            hangs = failure.signature == HANGS
            patience = 15.0 if hangs else min(PATIENCE, 2.0 + 4.0 * seconds[name])
            failures.append(shrunk(failure, case.seed, shrink_seconds, patience))
    return Outcome(case, seconds, tuple(failures))


def failure_of(
    name: str, scene: Scene, turn: int | None = None, patience: float = PATIENCE
) -> Failure | None:
    """The failure that a witness finds in a scene, or None; for ``turn`` see `Witness`."""
    try:
        with limit(patience):
            WITNESSES[name](scene, turn)
    except Difference as found:
        return _failure(name, found.kind, str(found), scene)
    except Exception as error:  # any exception is a finding
        where = traceback.extract_tb(error.__traceback__)[-1]
        signature = f"{type(error).__name__} in {where.name}"
        return _failure(name, signature, f"{signature}: {error}", scene)
    return None


def _failure(name: str, signature: str, why: str, scene: Scene) -> Failure:
    return Failure(name, signature, why, json.dumps(to_json(scene)))


def shrunk(failure: Failure, turn: int, seconds: float, patience: float) -> Failure:
    """The same failure in the smallest scene found within the time limit."""
    best = failure

    def still_fails(data: object) -> bool:
        nonlocal best
        try:
            scene = loads(json.dumps(data))
        except InputError:
            return False
        found = failure_of(failure.witness, scene, turn, patience)
        if found is None or found.signature != failure.signature:
            return False
        best = found
        return True

    shrink(json.loads(failure.scene), still_fails, seconds)
    return best


class _TooSlow(Difference):
    pass


@contextlib.contextmanager
def limit(seconds: float) -> Iterator[None]:
    """Interrupt what takes longer; only in the main thread, where signals are delivered."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def interrupt(signum: int, frame: FrameType | None) -> NoReturn:  # noqa: ARG001
        raise _TooSlow(HANGS, f"no answer within {seconds:.0f} s")

    old = signal.signal(signal.SIGPROF, interrupt)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, old)
