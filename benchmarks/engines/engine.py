"""Engines: adapters, what these say of themselves, and the processes that answer.

An adapter is one file in `benchmarks/programs` (or anywhere): ``with_NAME.py`` with ``ABOUT`` and
``answer(question, way)``, or ``with_NAME.mjs`` with ``about``, ``load()`` and
``answer(engine, question, way)``. It answers with the time of the first contact, or null, and knows
nothing of exactpt: a reproducer is a copy of it with a question.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from select import select
from time import monotonic
from typing import Any, Final, NamedTuple, final

from exactpt.errors import InputError

__all__ = ["ADAPTERS", "Crash", "Engine", "Missing", "Reply", "all_adapters", "node_modules"]

HERE: Final = Path(__file__).parent
ADAPTERS: Final = HERE.parent / "programs"
PATIENCE: Final = 60.0
"""Seconds after which a process that does not answer is taken for crashed."""
LOADING: Final = 60.0
"""Seconds in which a process loads its engine."""


class Missing(Exception):  # noqa: N818 - an outcome
    """The engine is not installed; the message has the command that installs it."""


@final
@dataclass(frozen=True, slots=True)
class Crash:
    """No answer: an exception, or the end of the process; the reason."""

    reason: str

    def __str__(self) -> str:
        return self.reason


@final
class Reply(NamedTuple):
    """An answer.

    Attributes:
        answer: the time of the first contact, None for no contact, or a `Crash`.
        seconds: how long it took; None if there is no answer.
    """

    answer: object
    seconds: float | None = None


def all_adapters(folder: Path = ADAPTERS) -> list[Path]:
    """The adapters in a folder, by name."""
    return sorted(p for p in folder.iterdir() if p.name.startswith("with_") and _command(p))


def _command(adapter: Path) -> list[str] | None:
    """What runs an adapter; None if it is none."""
    if adapter.suffix == ".py":
        return [sys.executable, "-P", str(HERE / "worker.py")]
    return ["node", str(HERE / "worker.mjs")] if adapter.suffix == ".mjs" else None


@final
@dataclass(slots=True)
class Engine:
    """An engine in a process of its own.

    Closes by `close`, or as a context manager. A process that ends, or is silent for `PATIENCE`
    seconds, is counted as a crash and begun anew.

    Args:
        adapter: the file.
        modules: for JavaScript, a folder ``node_modules``; None if there is none.

    Attributes:
        about: the description by the adapter.
        version: the version of the engine.

    Raises:
        Missing: if the engine is not installed.
        InputError: if the adapter does not begin as one does.
    """

    adapter: Path
    modules: Path | None = None
    about: Mapping[str, Any] = field(init=False)
    version: str = field(init=False)
    _process: subprocess.Popen[bytes] = field(init=False)
    _folder: tempfile.TemporaryDirectory[str] = field(init=False)

    def __post_init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="exactpt-engine-")
        try:
            self._start()
        except BaseException:
            self._folder.cleanup()
            raise

    def __enter__(self) -> Engine:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End the process."""
        self._stop()
        self._folder.cleanup()

    def ask(self, question: Mapping[str, object], way: str) -> Reply:
        """The engine's answer to a question, see `benchmarks.engines.domain.as_asked`."""
        stdin = self._process.stdin
        assert stdin is not None  # noqa: S101 - it is a pipe
        if stdin.closed and (failure := self._failure()):
            return Reply(Crash(failure))
        process = self._process
        assert process.stdin is not None  # noqa: S101 - it is a pipe
        try:
            process.stdin.write(json.dumps({"question": question, "way": way}).encode() + b"\n")
            process.stdin.flush()
        except OSError:
            return Reply(self._crashed())
        line = self._line(PATIENCE)
        if line is None:
            return Reply(self._crashed())
        if "error" in line:
            return Reply(Crash(str(line["error"])))
        return Reply(line["time"], float(line["seconds"]))

    def _start(self) -> None:
        command = _command(self.adapter)
        if command is None:
            raise InputError(f"{self.adapter}: an adapter ends with .py or .mjs")
        if shutil.which(command[0]) is None:
            raise Missing(f"{self.adapter.stem}: {command[0]} is not installed")
        self._process = subprocess.Popen(
            [*command, str(self._placed())],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        line = self._line(LOADING)
        if line is None or "about" not in line:
            self._stop()
            raise InputError(f"{self.adapter}: it does not begin as an adapter does")
        self.about = line["about"]
        if "missing" in line:
            self._stop()
            raise Missing(f"{self.about['name']} is not installed ({self.about['install']})")
        self.version = line["version"]

    def _placed(self) -> Path:
        """The path of the adapter; for node, of a copy next to the modules, where it seeks them."""
        if self.adapter.suffix == ".py":
            return self.adapter
        copy = Path(self._folder.name) / self.adapter.name
        shutil.copyfile(self.adapter, copy)
        link = copy.with_name("node_modules")
        if self.modules is not None and not link.exists():
            link.symlink_to(self.modules.resolve(), target_is_directory=True)
        return copy

    def _line(self, seconds: float) -> dict[str, Any] | None:
        """Return the next message of the worker; None at the end, or if it is not in time."""
        out = self._process.stdout
        assert out is not None  # noqa: S101 - it is a pipe
        deadline, text = monotonic() + seconds, b""
        while (left := deadline - monotonic()) > 0 and select([out], [], [], left)[0]:
            piece = os.read(out.fileno(), 1 << 16)
            if not piece:
                break
            *lines, text = (text + piece).split(b"\n")
            for line in lines:
                if (found := _said(line)) is not None:
                    return found
        return None

    def _crashed(self) -> Crash:
        process = self._process
        try:
            code = process.wait(1.0)
        except subprocess.TimeoutExpired:
            reason = f"no answer in {PATIENCE:g} seconds"
        else:
            reason = f"the process ended: {f'signal {-code}' if code < 0 else f'exit code {code}'}"
        self._stop()
        failure = self._failure()
        return Crash(f"{reason}; {failure}" if failure else reason)

    def _failure(self) -> str:
        """Begin the process anew, and return why that fails; empty if it does not."""
        try:
            self._start()
        except (Missing, InputError) as error:
            return f"it does not begin anew: {error}"
        return ""

    def _stop(self) -> None:
        process = self._process
        process.kill()
        process.wait()
        for pipe in (process.stdin, process.stdout):
            if pipe is not None:
                with suppress(OSError):  # the rest, which was not read
                    pipe.close()


def _said(line: bytes) -> dict[str, Any] | None:
    """Return the message of a worker in a line; None if the engine itself has printed it."""
    try:
        found = json.loads(line)
    except ValueError:
        return None
    known = isinstance(found, dict) and not found.keys().isdisjoint({"about", "time", "error"})
    return found if known else None


def node_modules(named: str | None, start: Path) -> Path | None:
    """The folder of npm packages: a named one, or the nearest above a place, as node seeks it.

    Raises:
        InputError: if the named folder is none.
    """
    if named:
        for folder in (Path(named), Path(named) / "node_modules"):
            if folder.name == "node_modules" and folder.is_dir():
                return folder
        raise InputError(f"{named}: no folder node_modules")
    places: Sequence[Path] = (start, *start.parents)
    return next(_folders(places), None)


def _folders(places: Sequence[Path]) -> Iterator[Path]:
    return (p / "node_modules" for p in places if (p / "node_modules").is_dir())
