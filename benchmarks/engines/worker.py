"""The process of an engine in Python: a line with what it is, then an answer for each question.

Run as a script with the path of an adapter; it imports nothing of exactpt, so that an adapter
works without it. A question is a line ``{"question", "way"}``. `worker.mjs` is the same for engines
in JavaScript.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import json
import runpy
import sys
import time
import warnings
from collections.abc import Callable
from typing import Any


def main(path: str) -> None:
    """Answer the questions on standard input, one line of JSON each."""
    adapter = runpy.run_path(path)
    about = adapter["ABOUT"]
    try:
        importlib.import_module(about["module"])
    except ImportError as error:
        say({"about": about, "missing": str(error)})
        return
    say({"about": about, "version": _version(about["package"])})
    for line in sys.stdin:
        say(_answered(adapter["answer"], **json.loads(line)))


def _version(package: str) -> str:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:  # the module came with another package
        return "unknown"


def _answered(
    answer: Callable[[dict[str, Any], str], float | None], question: dict[str, Any], way: str
) -> dict[str, Any]:
    start = time.perf_counter()
    try:
        found = answer(question, way)
    except Exception as error:
        return {"error": f"{type(error).__name__}: {error}"}
    return {"time": found, "seconds": time.perf_counter() - start}


def say(line: dict[str, Any]) -> None:
    """Write a line of JSON."""
    sys.stdout.write(json.dumps(line) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    main(*sys.argv[1:])
