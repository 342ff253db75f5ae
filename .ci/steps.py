"""The one command of continuous integration: make targets, about 15 minutes on two idle cores.

* ``make test``: lint, the tests of the package, with CGAL, and the laws by seed 0.
* ``make turn``: laws by the seed of the date. A law that the base breaks as well fails nothing.
* ``make test-compiled`` and ``make test-lowest``: quick tests and a minute of the laws, on the
  compiled package, and on the lowest versions of what is needed.
* ``make test-docs`` and ``make test-tools``: the tests of the pages, and of those tools of which a
  file differs from the base.

The base is the commit at which this branch has left main, or the one that BASE names. Where there
is none, everything is tested. What takes longer runs at night: ``make night night-tests``.

With arguments it makes these instead: ``.ci/run quick "test-tools TOOLS=fuzz"``.

A step that fails does not keep the others from running. At the end there is a line for each step:
the minutes of the clock, and the processor time, by two. CGAL tests that were skipped fail the
run. So does a run that takes longer than LIMIT minutes of processor time, by two, where the
environment names such a LIMIT: how long a run takes depends on the machine as well.
"""

from __future__ import annotations

import os
import re
import resource
import shlex
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
CORES = 2
SHARED = ("conftest.py", "pyproject.toml", "Makefile", "tests/helpers/")
"""What all tests are run by."""

WATCHED = {
    "fuzz": ("fuzz/",),
    "benchmarks": ("benchmarks/",),
    ".ci": (".ci/", ".github/"),
}
"""The tools, with the beginnings of the names of their files."""

SKIPPED = re.compile(r"^SKIPPED.*cgal")
"""A line of pytest about CGAL tests that were skipped."""


class Took(NamedTuple):
    """What a step took, in seconds: of the clock, and of all processors."""

    name: str
    clock: float
    processor: float

    def __str__(self) -> str:
        return f"{_minutes(self.clock):>6}  {_minutes(self.processor / CORES):>6}  {self.name}"


def _minutes(seconds: float) -> str:
    return f"{int(seconds) // 60}:{int(seconds) % 60:02d}"


def git(*words: str) -> list[str] | None:
    """Return the lines that git prints; None if it fails, or there is no git."""
    try:
        done = subprocess.run(
            ["git", *words], cwd=ROOT, capture_output=True, text=True, check=False
        )
    except FileNotFoundError:
        return None
    return done.stdout.splitlines() if done.returncode == 0 else None


def base_of_branch() -> str | None:
    """Return the commit with which this checkout is compared; None if there is none."""
    if named := os.environ.get("BASE"):
        return named
    head = git("rev-parse", "HEAD")
    for main in ("origin/main", "main"):
        base = git("merge-base", "HEAD", main)
        if base and base != head:
            return base[0]
    return None


def changed_since(base: str | None) -> list[str] | None:
    """Return the files that differ from the base; None if that cannot be told."""
    if base is None:
        return None
    changed = git("diff", "--name-only", "--relative", base, "--")
    new = git("ls-files", "--others", "--exclude-standard")
    return None if changed is None or new is None else [*changed, *new]


def tools_to_test(changed: list[str] | None) -> list[str]:
    """Return the tools of which a file has changed; all of them if that cannot be told."""
    return [
        tool
        for tool, names in WATCHED.items()
        if changed is None or any(file.startswith((*SHARED, *names)) for file in changed)
    ]


def steps(base: str | None) -> list[list[str]]:
    """Return the arguments of make for each step."""
    turn = ["turn"] if base is None else ["turn", f"BASE={base}"]
    tools = tools_to_test(changed_since(base))
    tested = [["test-tools", f"TOOLS={' '.join(tools)}"]] if tools else []
    return [["test"], turn, ["test-compiled"], ["test-lowest"], ["test-docs"], *tested]


def made(words: list[str]) -> tuple[Took, list[str]]:
    """Make a target; return what it took, and the lines of failures."""
    name = " ".join(["make", *words])
    began, used = time.monotonic(), _processor_seconds()
    failures = []
    with subprocess.Popen(
        ["make", *words], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True, errors="replace", env={**os.environ, **ENVIRONMENT},
    ) as making:  # fmt: skip
        for line in making.stdout or ():
            print(line, end="", flush=True)
            if SKIPPED.match(line):
                failures.append(f"CGAL tests were skipped: {line.strip()}")
    if making.returncode != 0:
        failures.append(f"FAILED STEP {name}")
    took = Took(name, time.monotonic() - began, _processor_seconds() - used)
    return took, failures


def _processor_seconds() -> float:
    """Return the processor time of all processes that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


ENVIRONMENT = {
    "HYPOTHESIS_PROFILE": "ci",  # the same examples in each run
    "CMAKEFLAGS": "-DCMAKE_COMPILE_WARNING_AS_ERROR=ON",  # of this compiler; others warn otherwise
}


def main(targets: list[str]) -> int:
    """Make some targets, by default all steps; return the exit code."""
    took, failures = list[Took](), list[str]()
    for words in map(shlex.split, targets) if targets else steps(base_of_branch()):
        one, failed = made(words)
        took.append(one)
        failures += failed
    total = Took("in all", sum(t.clock for t in took), sum(t.processor for t in took))
    print(f"\n clock  processor / {CORES}, in minutes")
    print(*took, total, sep="\n")
    each = total.processor / CORES
    limit = 60 * float(os.environ.get("LIMIT") or "inf")  # empty is not set
    if each > limit:
        failures.append(f"{_minutes(each)} minutes; the limit is {_minutes(limit)}")
    for failure in failures:
        print(failure, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
