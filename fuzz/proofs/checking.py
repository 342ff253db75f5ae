"""A running ``cgal_check proofs``, which verifies one proof after the other."""

from __future__ import annotations

import re
import subprocess
from contextlib import suppress
from functools import cache
from pathlib import Path
from select import select
from tempfile import TemporaryDirectory
from typing import Final, final

from exactpt.cgal import find_program
from exactpt.errors import AuditError

__all__ = ["Checker", "checker", "is_geometric"]

MAP: Final = re.compile(
    "twice|face on one side|not one cycle|not connected|V - E|has no edge|is not there|is of a body"
    "|nothing to change|no angle of|is there already|have no place|come directly before|runs inside"
    "|inside of a rigid|not a vertex|fewer than two|time span is|not those of|no map|has vertex"
)
"""The reasons of rejections in the reading of a proof and in its map (docs/proofs.md, step 2)."""

PATIENCE: Final = 60.0
"""Seconds in which a proof is verified."""


def is_geometric(answer: str) -> bool:
    """Return True if a proof has been rejected, though its lines and its map are in order."""
    return answer.startswith("rejected: ") and MAP.search(answer) is None


@final
class Checker:
    """The process; it is started when it is needed, and again if it has ended.

    A process without an answer for `PATIENCE` seconds is ended.
    """

    def __init__(self) -> None:
        self._folder = TemporaryDirectory()
        self._process: subprocess.Popen[str] | None = None

    def verdict(self, scene: bytes, proof: bytes) -> str:
        """The answer about a proof, a line.

        Raises:
            AuditError: if the program fails, or does not answer in time.
        """
        paths = [Path(self._folder.name) / name for name in ("scene.json", "proof")]
        for path, content in zip(paths, (scene, proof), strict=True):
            path.write_bytes(content)
        try:
            answer = self._ask("".join(f"{path}\n" for path in paths))
        except BaseException:  # an answer that nobody waits for would be taken for the next one
            self.close()
            raise
        if not answer.startswith(("accepted: ", "rejected: ", "no proof: ", "not decided: ")):
            self.close()
            raise AuditError(f"cgal_check: {answer or 'the process has ended'}")
        return answer

    def close(self) -> None:
        """End the process."""
        if self._process is not None:
            self._process.kill()
            with suppress(BrokenPipeError):  # of a question that was not read
                self._process.communicate()
            self._process = None

    def _ask(self, question: str) -> str:
        if self._process is not None and self._process.poll() is not None:
            self.close()
        if self._process is None:
            command = [str(find_program()), "proofs"]
            pipe = subprocess.PIPE
            self._process = subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True)
        assert self._process.stdin is not None  # noqa: S101
        assert self._process.stdout is not None  # noqa: S101
        with suppress(BrokenPipeError):  # it has just ended: no line follows
            self._process.stdin.write(question)
            self._process.stdin.flush()
        if not select([self._process.stdout], [], [], PATIENCE)[0]:
            raise AuditError(f"cgal_check: no answer in {PATIENCE:g} seconds")
        return self._process.stdout.readline().rstrip("\n")


@cache
def checker() -> Checker:
    """The checker of this process."""
    return Checker()
