"""What reads hostile files: every command and reader, and how each ends."""

from __future__ import annotations

import contextlib
import io
import os
import time as clock
import warnings
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from random import Random
from typing import Final, NamedTuple

from exactpt import (
    BudgetExceeded,
    ExactPTError,
    Simulation,
    check_apart,
    proof_check,
    read_shapes,
)
from exactpt.cli import main
from exactpt.errors import AuditError
from fuzz.hostile.files import SCENES, Hostile, batch_files, scene_text
from fuzz.limits import TooSlow, limit

__all__ = ["Ended", "read"]

SECONDS: Final = 2
"""Budget of time of every command."""

PATIENCE: Final = 6.0
"""Seconds of processor time in which a command with that budget has ended."""

LONGEST: Final = 1500
"""Maximum number of characters of a refusal."""

COMMANDS: Final = (
    "collide {0} --json",
    "collide {0} --method pairs --stats",
    "collide {0} --tiling greedy",
    "collide {0} --tiling mixed --exact-only",
    "collide {0} --proof out.proof",
    "simulate {0} --verbose",
    "simulate {0} --events out.jsonl --tiling lazy",
    "tile {0} --at 1/2",
    "tile {0} --run -o out.json",
    "draw {0} -o out.svg",
    "draw {0} -o out.html --at contact",
    "convert {0} out.geojson",
    "convert {0} out.wkt --at 1/3",
    "convert {0} out.svg",
    "convert {0} out.json",
    "convert {0} out.mfjson",
)
CONVERSIONS: Final = (
    "convert {0} out.json",
    "convert {0} out.json --holes fill --skip-invalid",
    "convert {0} out.svg --tolerance 0.01",
    "convert {0} out.geojson --skip-invalid --quiet",
)


class Ended(NamedTuple):
    """How the reading of a file has ended.

    Attributes:
        reader: the command or the reader.
        outcome: "read", "refused", "spent" (out of budget), "broken" (a forged state of which the
            checksum is right), or "FAULT".
        seconds: processor time.
        fault: the fault; empty without one.
    """

    reader: str
    outcome: str
    seconds: float
    fault: str = ""


def read(kind: str, file: Hostile, rng: Random, folder: Path) -> Ended:
    """Have one command or reader, chosen at random, read a file in an empty folder."""
    path = Path(f"file.{'json' if kind in (*SCENES, 'saved') else kind}")
    with _inside(folder):
        path.write_bytes(file.content)
        reader = _reader_of(kind, rng)
        began = clock.process_time()
        try:
            with limit(PATIENCE), warnings.catch_warnings():
                warnings.simplefilter("always")
                outcome, fault = reader.read(file, path)
        except TooSlow:
            outcome, fault = "FAULT", "hangs"
        except Exception as error:  # any exception is a finding
            outcome, fault = "FAULT", f"{type(error).__name__}: {error}"
        taken = clock.process_time() - began
        for left in Path().iterdir():
            left.unlink()
    return Ended(reader.name, "FAULT" if fault else outcome, taken, fault)


@contextlib.contextmanager
def _inside(folder: Path) -> Iterator[None]:
    here = Path.cwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(here)


class _Reader(NamedTuple):
    name: str
    read: Callable[[Hostile, Path], tuple[str, str]]


def _reader_of(kind: str, rng: Random) -> _Reader:
    if kind == "saved":
        return _Reader("restore", _restored)
    if kind == "proof":
        return _Reader("proof_check", partial(_checked, proof_check.main))
    if kind == "apart":
        return _Reader("check_apart", partial(_checked, check_apart.main))
    if kind in ("journal", "part"):
        return _Reader(f"batch {kind}", partial(_went_on, kind))
    if kind not in SCENES and rng.random() < 0.2:
        return _Reader("read_shapes", _shapes)
    line = rng.choice(COMMANDS if kind in SCENES else CONVERSIONS)
    return _Reader(line.split("{0}")[0].strip(), lambda _, path: _run(line, path))


def _run(line: str, path: Path) -> tuple[str, str]:
    """Run a command; return its outcome and its fault."""
    budget = ["--max-seconds", str(SECONDS)]
    if not line.startswith("convert"):
        budget += ["--max-events", "200"]
    code, out, err = _captured(lambda: main([*line.format(path).split(), *budget]))
    written = sorted(file.name for file in Path().iterdir() if file != path)
    return {0: "read", 2: "refused", 4: "spent"}.get(code, "FAULT"), _fault(code, out, err, written)


def _captured(call: Callable[[], object]) -> tuple[int, str, str]:
    """Return the exit code of a call, and the text that it has written."""
    streams = [io.TextIOWrapper(io.BytesIO(), encoding="utf-8") for _ in range(2)]
    code: object = 0
    with contextlib.redirect_stdout(streams[0]), contextlib.redirect_stderr(streams[1]):
        try:
            code = call()
        except SystemExit as end:
            code = end.code
    texts = []
    for stream in streams:
        stream.flush()
        texts.append(stream.buffer.getvalue().decode())
    return code if isinstance(code, int) else 0, texts[0], texts[1]


def _fault(code: int, out: str, err: str, written: Sequence[str]) -> str:
    """What breaks the promises about exit codes, messages and files."""
    if code not in (0, 2, 4):
        return f"exit code {code}: {err.strip()[-300:]}"
    if not (out + err).replace("\n", "").isprintable():
        return f"not printable: {out + err!r}"
    if any(".exactpt-" in name for name in written) or (code and written):
        return f"exit code {code}, but written: {', '.join(written)}"
    if code and not (err.startswith("exactpt: ") and err.endswith("\n") and err.count("\n") == 1):
        return f"exit code {code}, but not one line: {err[:300]!r}"
    if code == 2 and (out or len(err) > LONGEST):
        return f"refused in {len(err)} characters, after {out[:300]!r}"
    if "Warning" in err:
        return f"a warning: {err[:300]!r}"
    return ""


def _shapes(_: Hostile, path: Path) -> tuple[str, str]:
    try:
        read_shapes(path, holes="fill", skipped=lambda _: None)
    except ExactPTError as error:
        return "refused", "" if str(error).isprintable() else f"not printable: {str(error)!r}"
    return "read", ""


def _restored(file: Hostile, path: Path) -> tuple[str, str]:
    """Restore a saved run and go on; a forged state may break, but not its budget."""
    try:
        simulation = Simulation.restore(path, max_events=50, max_seconds=SECONDS)
    except BudgetExceeded:
        return "spent", ""
    except ExactPTError as error:
        if not str(error).isprintable():
            return "refused", f"not printable: {str(error)!r}"
        return "refused", str(error) if "Error: " in str(error) else ""
    try:
        for _ in simulation.run():
            pass
    except BudgetExceeded:
        return "spent", ""
    except AuditError as error:
        return "broken", "" if file.wound == "value" else f"{type(error).__name__}: {error}"
    return "read", ""


def _went_on(kind: str, file: Hostile, path: Path) -> tuple[str, str]:
    """Have a batch go on with a damaged file; a refusal changes no file."""
    files = batch_files(file.seed)
    result = Path("answers.jsonl")
    path.rename(f"{result}.{kind}")
    for name, content in files.items():
        if not Path(name).exists() and name != result.name:
            Path(name).write_text(content, encoding="utf-8")
    before = _contents()
    code, out, err = _captured(lambda: main(["batch", "scenes.jsonl", "-o", str(result), "-q"]))
    if code == 0:
        same = result.read_text(encoding="utf-8") == files[result.name]
        return "read", "" if same else "the results are other ones"
    changed = [] if _contents() == before else ["a file was changed"]
    return "refused" if code == 2 else "FAULT", _fault(code, out, err, changed)


def _contents() -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in Path().iterdir()}


def _checked(checker: Callable[[list[str]], int], file: Hostile, path: Path) -> tuple[str, str]:
    scene = Path("scene.json")
    scene.write_text(scene_text(file.seed), encoding="utf-8")
    code, out, err = _captured(lambda: checker([str(scene), str(path)]))
    if code not in (0, 1, 2, 4) or (out + err).count("\n") != 1:
        return "FAULT", f"exit code {code}: {(out + err)[-300:]!r}"
    if not (out + err).replace("\n", "").isprintable():
        return "FAULT", f"not printable: {out + err!r}"
    return "read" if code == 0 else "refused", ""
