"""The page about engines: the tables, how each was asked, what it promises, its worst answer."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from benchmarks.engines.asking import COLUMNS, WRONG, Result
from benchmarks.engines.reproducer import description
from exactpt.testing import FAMILIES

__all__ = ["page"]

_HEAD: Final = """# Engines under test

Programs that find when moving bodies touch, called with the degenerate and generic questions of [exactpt.testing](../testing.md) and compared with the exact truth. `python -m benchmarks engines -o docs/engines{seed}` writes this page, the table by family ([engines.csv](engines.csv)) and the reproducers; npm packages are found in a folder `node_modules` at or above the current one, or in the one that `EXACTPT_NODE_MODULES` names. {questions} questions of each of the {families} families, seed {number}.

**How to read it.** Most of these programs are made for simulations, where a contact a little early is as good as the exact one; they promise a tolerance, and keeping it is no fault. Most of the questions are degenerate on purpose: the shares do not describe everyday scenes. A result is

* *right*: the truth, or a time within 10^-9 of it;
* *within*: what the engine promises: bodies that are nearer than its tolerance count as touching, bodies that sink in by less as apart, a program that takes steps is late by a step and skips what is shorter than one;
* *missed, late, invented, early*: neither. *Crashed*: no result, an exception, or a result that is marked as a failure;
* *not asked*: a question that the engine is not made for, or whose numbers it cannot represent.

The error is the largest one of a time within the promise (where bodies slide along each other without sinking in, that may be long). The last column is the median time of one call in microseconds, shapes made anew for each, in the engine's own process; a call from Python or JavaScript costs a part of it, so these times compare nothing but orders of magnitude ({machine}).
"""  # noqa: E501 - one line a paragraph

_TAIL: Final = """## Another engine

An adapter is one file next to the others in `benchmarks/programs`: `with_NAME.py` with `ABOUT` and `answer(question, way)`, or `with_NAME.mjs` with `about`, `load()` and `answer(engine, question, way)`. `ABOUT` states how the engine is called, quotes what it promises, which questions it takes and what tolerance it is allowed. Whoever knows an engine better than its adapter does: mend the adapter, and run the command.
"""  # noqa: E501 - one line a paragraph


def page(
    results: Sequence[Result], sources: Mapping[str, str], count: int, seed: int, machine: str
) -> str:
    """The text of the page.

    Args:
        results: what the engines have answered.
        sources: the file of the reproducer of each result that has one, by its name.
        count: the number of questions of each family.
        seed: the seed of the questions.
        machine: the processor.
    """
    head = _HEAD.format(
        questions=count,
        families=len(FAMILIES),
        number=seed,
        seed=f" --seed {seed}" if seed else "",
        machine=machine,
    )
    sections = [line for result in results for line in _section(result, sources)]
    parts = [head, *_totals(results), "", *_families(results), "", *sections, _TAIL]
    return "\n".join(parts)


def _totals(results: Sequence[Result]) -> Iterator[str]:
    yield from _header(["engine", "version", *COLUMNS, "error", "µs"], words=2)
    for r in results:
        time = "-" if r.microseconds is None else f"{r.microseconds:.0f}"
        error = "-" if r.error is None else f"{r.error:.2g}"
        yield _line([r.name, r.version, *(str(r.total[c]) for c in COLUMNS), error, time])


def _families(results: Sequence[Result]) -> Iterator[str]:
    yield "Wrong results by family, of the questions used (blank: none used):"
    yield ""
    yield from _header(["family", *(r.name for r in results)], words=1)
    for family in FAMILIES:
        rows = [r.rows[family] for r in results]
        yield _line([family, *map(_share, rows)])


def _share(row: Mapping[str, int]) -> str:
    asked = sum(row.values()) - row["not asked"]
    return f"{sum(row[v] for v in WRONG)}/{asked}" if asked else ""


def _section(result: Result, sources: Mapping[str, str]) -> Iterator[str]:
    yield f"## {result.name}"
    yield ""
    yield " ".join(filter(None, [result.about["asked"], result.about["ways"][result.way]["asked"]]))
    yield ""
    for words, where in result.promises:
        yield f"> {words} ({where})"
        yield ""
    wrong = [
        f"{family}: {', '.join(f'{row[v]} {v}' for v in WRONG if row[v])}"
        for family, row in result.rows.items()
        if any(row[v] for v in WRONG)
    ]
    yield f"Wrong: {'; '.join(wrong)}." if wrong else "No result is wrong."
    yield ""
    if result.worst is not None:
        name = sources[result.name]
        said = f"{result.worst.verdict}: {description(result.worst)}"
        yield f"The worst, shrunken ([{name}]({name})): {said}."
        yield ""
    if result.reasons:
        reasons = ", ".join(f"{why} ({n})" for why, n in sorted(result.reasons.items()))
        yield f"Not asked: {reasons}."
    yield ""


def _header(cells: Sequence[str], *, words: int) -> Iterator[str]:
    yield _line(cells)
    yield _line(["---"] * words + ["---:"] * (len(cells) - words))


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"
