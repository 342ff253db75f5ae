"""The base of a change: whether a law was broken there before.

The laws of the base check the same case on the same scene, with the package of the base, in a
process of its own. So a law or a package that has changed since does not count.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from contextlib import ExitStack, suppress
from pathlib import Path
from tempfile import TemporaryDirectory, TemporaryFile
from types import TracebackType
from typing import IO, Final, NamedTuple, Self, TypeAlias, cast

from exactpt import Scene
from exactpt.cgal import find_program
from fuzz.commits import unpack
from fuzz.laws.law import PROGRAMS
from fuzz.laws.runner import Case, Fault
from fuzz.old_engine.build import FOLDER

__all__ = ["Base", "Verdict"]

_SERVICE: Final = """\
import json, sys
from exactpt import InputError, Scene
from fuzz.laws.runner import Case, look

for line in sys.stdin:
    text, data = json.loads(line)
    try:
        case, scene = Case.parse(text), Scene.from_json(data)
    except InputError as error:
        answer = {"refused": str(error)}
    else:
        looked = look(case, scene)
        fault = looked.fault
        answer = {"outcome": looked.outcome, "signature": fault and fault.signature}
    print("answer", json.dumps(answer), flush=True)
"""
"""Answers lines of JSON in the folder of the base."""

_ANSWER: Final = "answer "
"""The beginning of an answer; laws may print other lines."""

_Answer: TypeAlias = dict[str, str | None]
"""The outcome and the signature of the fault, or why the case was refused."""


class Verdict(NamedTuple):
    """What the base says about a fault.

    Attributes:
        is_new: False if the base breaks the same law in the same way.
        why: the result in the base, in a line.
    """

    is_new: bool
    why: str

    def __str__(self) -> str:
        return f"{'new' if self.is_new else 'there before'}: {self.why}"


class Base:
    """Another commit, whose files are in a folder of their own as long as it is open."""

    def __init__(self, commit: str) -> None:
        """Unpack the commit.

        Args:
            commit: what names a commit to git, such as a hash or a branch.

        Raises:
            InputError: if the repository has no such commit.
        """
        self.commit = commit
        self._process: subprocess.Popen[str] | None = None
        with ExitStack() as opened:
            self._folder = Path(opened.enter_context(TemporaryDirectory(prefix="exactpt-base-")))
            self._errors = opened.enter_context(TemporaryFile(mode="w+", encoding="utf-8"))
            unpack(commit, self._folder)
            self._opened = opened.pop_all()
        if FOLDER.is_dir():
            (self._folder / FOLDER.name).symlink_to(FOLDER)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:  # fmt: skip
        self._end()
        self._opened.close()

    def verdict(self, fault: Fault, smaller: Fault | None = None) -> Verdict:
        """Return whether a fault is new.

        Args:
            fault: the fault, in the scene of its case.
            smaller: the same fault in a smaller scene; the base must break the law there, too.
        """
        verdict = self._verdict_on(fault)
        if smaller is None or verdict.is_new:
            return verdict
        return self._verdict_on(smaller)

    def outcome(self, case: Case, scene: Scene) -> str:
        """Return what the law of a case says in the base about a scene, in a line."""
        return self._in_words(self._ask(case, scene))

    def _verdict_on(self, fault: Fault) -> Verdict:
        answer = self._ask(fault.case, fault.scene)
        is_same = answer.get("signature") == fault.signature
        return Verdict(not is_same, self._in_words(answer))

    def _in_words(self, answer: _Answer) -> str:
        if "refused" in answer:
            return f"not compared with {self.commit}: {answer['refused']}"
        if answer["signature"] is None:
            return f"in {self.commit} the law holds ({answer['outcome']})"
        return f"in {self.commit} the law is broken: {answer['signature']}"

    def _ask(self, case: Case, scene: Scene) -> _Answer:
        """Return the answer of the base about a case."""
        if self._process is None:
            self._process = self._started()
        questions = cast("IO[str]", self._process.stdin)
        answers = cast("IO[str]", self._process.stdout)
        try:
            questions.write(json.dumps([str(case), scene.to_json()]) + "\n")
            questions.flush()
        except BrokenPipeError:
            return {"refused": self._end()}
        for line in answers:
            if line.startswith(_ANSWER):
                answer: _Answer = json.loads(line.removeprefix(_ANSWER))
                return answer
        return {"refused": self._end()}

    def _started(self) -> subprocess.Popen[str]:
        """Start the process of the base: its files precede all that is installed."""
        environment = {**os.environ, "PYTHONPATH": str(self._folder)}
        if PROGRAMS["cgal"]():
            environment["EXACTPT_CGAL_CHECK"] = str(find_program())
        self._errors.seek(0)
        self._errors.truncate()
        return subprocess.Popen(
            [sys.executable, "-c", _SERVICE], cwd=self._folder, env=environment, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors,
        )  # fmt: skip

    def _end(self) -> str:
        """End the process, if there is one; return the last line of its errors."""
        if self._process is None:
            return ""
        with suppress(BrokenPipeError), self._process:
            pass  # its pipes are closed, at which it ends
        self._process = None
        self._errors.seek(0)
        lines = self._errors.read().strip().splitlines()
        return lines[-1] if lines else "its process ended"
