"""Another copy of the package, old or compiled: scenes in, answers out, in a process of its own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from pathlib import Path
from select import select
from typing import Final, NamedTuple, final

from exactpt import Scene
from exactpt.errors import AuditError, InputError
from exactpt.scene.written import to_json
from fuzz import compiled_copy
from fuzz.old_engine.build import SITE, is_built

__all__ = ["Answer", "OtherEngine", "compiled_engine", "old_engine"]

PATIENCE: Final = 60.0
"""Seconds in which a question is answered; a process without an answer is ended."""

SCRIPT: Final = Path(__file__).with_name("answers.py")


class Answer(NamedTuple):
    """An answer of either version, see `fuzz.old_engine.answers`.

    Attributes:
        kind: "said", "refused" or "failed".
        text: the answer, the reason, or the exception.
    """

    kind: str
    text: str

    @classmethod
    def of(cls, reply: Mapping[str, str]) -> Answer:
        """Return the answer of a reply, a JSON object with one member."""
        ((kind, text),) = reply.items()
        return cls(kind, text)


@final
class OtherEngine:
    """The process: it is started when it is needed, and again after it has ended.

    Args:
        site: the folder with the other package.
        name: what it is, for messages.
    """

    def __init__(self, site: Path, name: str = "the old engine") -> None:
        self._site = site
        self._name = name
        self._process: subprocess.Popen[str] | None = None

    def ask(self, question: str, scene: Scene, **arguments: object) -> Answer:
        """Ask one of the questions of `fuzz.old_engine.answers`.

        Raises:
            AuditError: if the process ends, or does not answer in time.
            InputError: if another package than that one answers.
        """
        request = {"question": question, "scene": to_json(scene), "arguments": arguments}
        try:
            line = self._exchange(json.dumps(request))
            return Answer.of(json.loads(line))
        except BaseException:  # an answer that nobody waits for would be taken for the next one
            self.close()
            raise

    def close(self) -> None:
        """End the process."""
        if self._process is not None:
            self._process.kill()
            with suppress(BrokenPipeError):  # of a request that was not read
                self._process.communicate()
            self._process = None

    def _exchange(self, request: str) -> str:
        if self._process is not None and self._process.poll() is not None:
            self.close()
        if self._process is None:
            self._start()
        assert self._process is not None  # noqa: S101
        assert self._process.stdin is not None  # noqa: S101
        with suppress(BrokenPipeError):  # it has just ended: no line follows
            self._process.stdin.write(request + "\n")
            self._process.stdin.flush()
        return self._line()

    def _start(self) -> None:
        """Start the process, and check that it runs the other package and no third one."""
        # -P: the folder of the script is not searched. PYTHONPATH comes before what is installed.
        self._process = subprocess.Popen(
            [sys.executable, "-P", str(SCRIPT)],
            env={**os.environ, "PYTHONPATH": str(self._site)},
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            text=True, encoding="utf-8",
            start_new_session=True,  # a Ctrl-C is for the campaign; the end of stdin ends this
        )  # fmt: skip
        where = Path(json.loads(self._line())["where"])
        if not where.is_relative_to(self._site):
            raise InputError(f"{self._name}: {where} answers instead of {self._site}")

    def _line(self) -> str:
        assert self._process is not None  # noqa: S101
        assert self._process.stdout is not None  # noqa: S101
        if not select([self._process.stdout], [], [], PATIENCE)[0]:
            raise AuditError(f"{self._name}: no answer in {PATIENCE:g} seconds")
        line = self._process.stdout.readline()
        if not line.endswith("\n"):
            raise AuditError(f"{self._name}: the process has ended")
        return line


def old_engine() -> OtherEngine:
    """Return the old engine of this process: a forked one has its own.

    Raises:
        InputError: if it is not built.
    """
    if not is_built():
        raise InputError("the old engine is not built: make old-engine")
    return _engine_of(os.getpid(), SITE, "the old engine")


def compiled_engine() -> OtherEngine:
    """Return the compiled copy of this checkout for this process: a forked one has its own.

    Raises:
        InputError: if it is not built, or of other sources.
    """
    if not compiled_copy.is_built():
        raise InputError("the sources of the compiled copy are not these: make compiled-copy")
    return _engine_of(os.getpid(), compiled_copy.FOLDER, "the compiled copy")


@cache
def _engine_of(process: int, site: Path, name: str) -> OtherEngine:  # noqa: ARG001
    return OtherEngine(site, name)
