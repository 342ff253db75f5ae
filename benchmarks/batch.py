"""`exactpt batch` on scenes of two bodies: time, memory, and the same scenes one by one.

The scenes are those of examples/many_scenes.py; the command is a process of its own, with two
workers.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final, NamedTuple

from benchmarks.output import Output
from benchmarks.timing import timed
from exactpt import AuditError, Contact, first_contact
from exactpt.scene.format import loads

__all__ = ["FULL", "QUICK", "Sizes", "check", "run"]

JOBS: Final = 2
EXAMPLE: Final = Path(__file__).parents[1] / "examples" / "many_scenes.py"


class Sizes(NamedTuple):
    """Number of scenes, and of those that are also computed one by one."""

    scenes: int
    alone: int


QUICK: Final = Sizes(2000, 200)
FULL: Final = Sizes(200_000, 5000)


def run(output: Output, sizes: Sizes, _: int) -> None:
    """Measure one batch."""
    with TemporaryDirectory() as folder:
        scenes, results = Path(folder) / "scenes.jsonl", Path(folder) / "results.jsonl"
        with scenes.open("wb") as file:
            subprocess.run([sys.executable, EXAMPLE, str(sizes.scenes)], stdout=file, check=True)
        with scenes.open(encoding="utf-8") as file:
            texts = [next(file) for _ in range(sizes.alone)]
        output.progress(f"a batch of {sizes.scenes} scenes")
        before, began = os.times(), time.monotonic()
        command = ("batch", str(scenes), "-o", str(results), "--jobs", str(JOBS), "--quiet")
        subprocess.run([sys.executable, "-m", "exactpt", *command], check=True)
        after, wall = os.times(), time.monotonic() - began
        used = sum(after[2:4]) - sum(before[2:4])
        contacts, alone = timed(lambda: [first_contact(loads(text)) for text in texts])
        with results.open(encoding="utf-8") as file:
            check(file, contacts)
        row = {
            "scenes": sizes.scenes,
            "processes": JOBS,
            "MB of scenes": scenes.stat().st_size / 1e6,
            "MB of results": results.stat().st_size / 1e6,
            "seconds": wall,
            "processor seconds": used,
            "us a scene": 1e6 * used / sizes.scenes,
            "us one by one": 1e6 * alone / sizes.alone,
            "MB of a process": resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024,
        }
    output.table("batch", [row])


def check(lines: Iterable[str], contacts: Iterable[Contact | None]) -> None:
    """Compare the results of the first scenes with those of `first_contact`.

    Raises:
        AuditError: if they differ.
    """
    for k, (line, contact) in enumerate(zip(lines, contacts, strict=False)):
        if json.loads(line)["contact"] != (contact and contact.to_json()):
            raise AuditError(f"the batch and first_contact disagree about scene {k}")
