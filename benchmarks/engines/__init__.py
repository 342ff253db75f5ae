"""Engines under test: what other programs answer to hard questions, and what they promise."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Final, NamedTuple

from benchmarks.engines.asking import Asked, Result, ask, questions
from benchmarks.engines.engine import ADAPTERS, Engine, Missing, all_adapters, node_modules
from benchmarks.engines.page import page
from benchmarks.engines.reproducer import reproducer, reproducer_name
from benchmarks.machine import machine
from benchmarks.output import Output, Row

__all__ = ["FULL", "MODULES", "QUICK", "Sizes", "run"]

MODULES: Final = "EXACTPT_NODE_MODULES"
"""The environment variable that names the folder of npm packages."""


class Sizes(NamedTuple):
    """Size of the benchmark: questions of each family; seconds for shrinking a finding."""

    questions: int
    seconds: float


QUICK: Final = Sizes(5, 2.0)
FULL: Final = Sizes(50, 15.0)


def run(output: Output, sizes: Sizes, seed: int, folder: Path = ADAPTERS) -> None:
    """Ask every engine that is installed; write the table, a page and the reproducers.

    Args:
        output: the destination.
        sizes: the size.
        seed: the seed of the questions.
        folder: the folder of adapters.

    Raises:
        InputError: if an adapter is none, or the folder of npm packages is none.
    """
    asked = questions(sizes.questions, seed)
    results = list(_results(output, sizes, asked, folder))
    if not results:
        output.say("no engine is installed")
        return
    output.table("engines", _rows(results), [_total(result) for result in results])
    sources = {}
    for result, adapter in results:
        if result.worst is not None:
            name = reproducer_name(result, result.worst, adapter)
            sources[result.name] = name
            output.write(name, reproducer(result, result.worst, adapter))
    processor = machine()[0].rpartition(",")[0]
    found = [result for result, _ in results]
    output.write("README.md", page(found, sources, sizes.questions, seed, processor))


def _results(
    output: Output, sizes: Sizes, asked: list[Asked], folder: Path
) -> Iterator[tuple[Result, Path]]:
    modules = node_modules(os.environ.get(MODULES), Path.cwd())
    for adapter in all_adapters(folder):
        try:
            with Engine(adapter, modules) as engine:
                for way in engine.about["ways"]:
                    output.progress(f"{engine.about['name']} {way}")
                    yield (
                        ask(engine, way, asked, seconds=sizes.seconds, progress=output.progress),
                        adapter,
                    )
        except Missing as missing:
            output.say(f"skipped: {missing}")


def _rows(results: list[tuple[Result, Path]]) -> list[Row]:
    return [
        {"engine": result.name, "version": result.version, "family": family, **row}
        for result, _ in results
        for family, row in result.rows.items()
    ]


def _total(found: tuple[Result, Path]) -> Row:
    result, _ = found
    return {"engine": result.name, **result.total, "microseconds": result.microseconds}
