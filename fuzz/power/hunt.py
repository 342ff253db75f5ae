"""Hunt a mistake by the laws, or by tests: what finds it first, and how soon."""

from __future__ import annotations

import json
import time as clock
from collections.abc import Sequence
from typing import Final, NamedTuple

import pytest
from _pytest.runner import runtestprotocol

from exactpt.certificates import first_root as filters
from exactpt.errors import InputError
from fuzz.laws.known import reason_of
from fuzz.laws.runner import PATIENCE, cost_of, run_for
from fuzz.power.forked import Say, in_a_process
from fuzz.power.mistakes import Mistake
from fuzz.power.probe import PROBE

__all__ = ["DIED", "Found", "Reach", "TestHunt", "by_laws", "refuse_compiled"]

DIED: Final = "the process"
"""What finds a mistake by which a process ends without a result."""

SLOWEST: Final = 40.0
"""Seconds of processor time that a test which is begun may take beyond the limit of all."""


UNKNOWN: Final = 0.1
"""The part of a case that counts as one which runs the changed line, before there are any: a law
without such a case gets less time, but is not left out."""


class Found(NamedTuple):
    """What was found of a mistake.

    Attributes:
        by: the law that is broken, or the test that fails; "" if there is none.
        case: the case of the law.
        why: the fault.
        tried: the number of cases, or tests.
        seconds: processor time.
        reaching: the number of laws with a case that ran the changed line, or of files of tests
            that may reach it.
        is_whole: True if everything there is was tried, False if the time was over.
    """

    by: str = ""
    case: str = ""
    why: str = ""
    tried: int = 0
    seconds: float = 0.0
    reaching: int = 0
    is_whole: bool = False


def refuse_compiled() -> None:
    """Refuse a compiled package.

    Raises:
        InputError: if the package is compiled: compiled functions cannot be changed.
    """
    if not filters.__file__.endswith(".py"):
        raise InputError("mistakes are planted in the plain package only; run make plain")


class Reach:
    """How often the cases of each law have run the changed line, and the turns that follow.

    A law about another question never runs it, and one in which the line is rare hides it among
    other cases. So a law has the more time, the larger the part of its cases that run the line.
    """

    def __init__(self, laws: Sequence[str]) -> None:
        """Begin with laws that have no case so far.

        Args:
            laws: the laws.
        """
        self.laws = sorted(laws, key=cost_of)  # quick ones first: each has a case soon
        self._cases = dict.fromkeys(laws, 0)
        self._reaching = dict.fromkeys(laws, 0)

    @property
    def tried(self) -> int:
        """The number of cases."""
        return sum(self._cases.values())

    @property
    def number(self) -> int:
        """The number of laws with a case that has run the line."""
        return sum(reaching > 0 for reaching in self._reaching.values())

    def add(self, law: str, *, is_reached: bool) -> None:
        """Count a case."""
        self._cases[law] += 1
        self._reaching[law] += is_reached

    def worth(self, law: str) -> float:
        """Return the part of the cases of a law that run the line, as far as it is known."""
        return (self._reaching[law] + UNKNOWN) / (self._cases[law] + 1)


def by_laws(mistake: Mistake, laws: Sequence[str], seed: int, seconds: float) -> Found:
    """Check cases of laws in a process in which a mistake is made, until a law is broken.

    Args:
        mistake: the mistake.
        laws: the laws, which have their turns by the time for their share and `Reach.worth`.
        seed: the seed of the cases.
        seconds: the limit of processor time.
    """
    if not laws:
        return Found(is_whole=True)

    def work(say: Say) -> None:
        began = clock.process_time()
        mistake.make()
        reach = Reach(laws)
        for tried, looked in enumerate(run_for(reach.laws, seed, seconds, reach.worth), start=1):
            reach.add(looked.case.law, is_reached=PROBE.take())
            fault = looked.fault
            if fault is not None and reason_of(str(looked.case)) is None:
                why = fault.why[:200]
                spent = clock.process_time() - began
                law, place = fault.case.law, fault.case.place
                say(json.dumps(Found(law, place, why, tried, spent, reach.number)))
                return
        spent = clock.process_time() - began
        say(json.dumps(Found(tried=reach.tried, seconds=spent, reaching=reach.number)))

    ended = in_a_process(work, seconds + 2 * PATIENCE)
    if ended.status == 0 and ended.lines:
        return Found(*json.loads(ended.lines[-1]))
    why = " ".join(ended.lines[-1:]) or f"it ended without a result, status {ended.status}"
    return Found(DIED, "", why, 0, ended.seconds)


class TestHunt:
    """Collected tests, which are run on one mistake after the other.

    A test that fails without a mistake too does not count.
    """

    __test__ = False  # it is no class of tests

    def __init__(self, items: Sequence[pytest.Item]) -> None:
        """Begin with tests whose seconds are not known."""
        self._by_file: dict[str, list[pytest.Item]] = {}
        for item in items:
            self._by_file.setdefault(item.nodeid.split("::")[0], []).append(item)
        self._seconds: dict[str, float] = {}
        self._is_right: dict[str, bool] = {}

    @property
    def files(self) -> list[str]:
        """The files of the tests."""
        return list(self._by_file)

    def find(self, mistake: Mistake, files: Sequence[str], seconds: float) -> Found:
        """Run tests on a mistake, the quickest files first, up to the first failure.

        Args:
            mistake: the mistake.
            files: the files whose tests are run.
            seconds: the limit of processor time.
        """
        items = self._ordered(files)
        tried, spent = 0, 0.0
        while True:
            ended = self._run(items, mistake, seconds - spent)
            tried += ended.tried
            spent += ended.seconds
            if not ended.by or self._fails_only_with(ended.by):
                return ended._replace(tried=tried, seconds=spent, reaching=len(files))
            names = [item.nodeid for item in items]
            items = items[names.index(ended.by) + 1 :]  # those before it have passed

    def _ordered(self, files: Sequence[str]) -> list[pytest.Item]:
        """Return the tests that are right, those of the quickest files first."""
        right = {
            file: [item for item in self._by_file[file] if self._is_right.get(item.nodeid, True)]
            for file in files
        }

        def seconds(file: str) -> float:
            return sum(self._seconds.get(item.nodeid, 0.0) for item in right[file])

        return [item for file in sorted(right, key=seconds) for item in right[file]]

    def _fails_only_with(self, test: str) -> bool:
        """Return True if a test passes where no mistake is made."""
        if test not in self._is_right:
            (item,) = [i for items in self._by_file.values() for i in items if i.nodeid == test]
            self._is_right[test] = not self._run([item], None, 2 * SLOWEST).by
        return self._is_right[test]

    def _run(self, items: Sequence[pytest.Item], mistake: Mistake | None, seconds: float) -> Found:
        """Run tests up to the first failure; one that is begun and never ends has failed."""

        def work(say: Say) -> None:
            began = clock.process_time()
            if mistake is not None:
                mistake.make()
            for item, following in zip(items, [*items[1:], None], strict=True):
                before = clock.process_time()
                if before - began > seconds:
                    return
                say(json.dumps(["begins", item.nodeid, 0.0]))
                reports = runtestprotocol(item, log=False, nextitem=following)
                failed = [report for report in reports if report.failed]
                kind = "fails" if failed else "passes"
                say(json.dumps([kind, item.nodeid, clock.process_time() - before]))
                if failed:
                    say(failed[0].longreprtext.strip().splitlines()[-1])
                    return
            say(json.dumps(["all", "", 0.0]))

        ended = in_a_process(work, seconds + SLOWEST)
        return self._read(ended.lines, ended.seconds)

    def _read(self, lines: Sequence[str], spent: float) -> Found:
        """Return what the lines of a process say, and keep the seconds of its tests."""
        passed, begun = 0, ""
        for k, line in enumerate(lines):
            if not line.startswith("["):
                break  # the error by which the process ended
            kind, test, seconds = json.loads(line)
            if kind == "all":
                return Found(tried=passed, seconds=spent, is_whole=True)
            if kind == "begins":
                begun = test
            elif kind == "passes":
                passed, begun = passed + 1, ""
                self._seconds[test] = seconds
            else:
                why = " ".join(lines[k + 1 :])[:200]
                return Found(test, "", why, passed + 1, spent)
        if begun:
            return Found(begun, "", "the test does not end", passed + 1, spent)
        return Found(tried=passed, seconds=spent)
