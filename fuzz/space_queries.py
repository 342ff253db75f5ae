"""First contacts in space, compared with the answers of a public benchmark in CSV files."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

import numpy as np

from benchmarks.peers import is_installed
from benchmarks.space import engines, score
from exactpt.errors import InputError
from exactpt.testing.space import (
    SpaceContact,
    edge_edge,
    edge_edge_array,
    vertex_face,
    vertex_face_array,
)
from exactpt.testing.space.queries import Kind, SpaceQuery

__all__ = ["compare_public_queries", "score_engines"]

Points = list[list[Fraction]]


class Public(NamedTuple):
    """A query of a file: its kind, eight points, and the stated answer."""

    kind: str
    points: Points
    answer: bool


def compare_public_queries(folder: Path, count: int | None, say: Callable[[str], None]) -> int:
    """Print the differences, counts and rates; return the number of differences.

    Args:
        folder: the folder of CSV files.
        count: the number of queries to which each kind is repeated for the arrays.
        say: prints a line.

    Raises:
        InputError: if a file is not in the format.
    """
    differences = hits = irrational = 0
    queries = list(_read(folder))
    begin = clock.process_time()
    for query in queries:
        found = _decide(query)
        differences += (found is not None) != query.answer
        hits += found is not None
        irrational += found is not None and not found.time.is_rational
    microseconds = (clock.process_time() - begin) / max(1, len(queries)) * 1e6
    say(
        f"{len(queries)} queries, {differences} differences, {hits} contacts, {irrational} of them "
        f"at irrational times, {microseconds:.0f} us a query"
    )
    for kind, decide in (("vertex-face", vertex_face_array), ("edge-edge", edge_edge_array)):
        chosen = [query for query in queries if query.kind == kind]
        if not chosen:
            continue
        points = np.array([[[float(c) for c in p] for p in q.points] for q in chosen])
        answers = np.array([query.answer for query in chosen])
        repeats = max(1, (count or 0) // len(chosen))
        begin = clock.process_time()
        contacts = decide(np.tile(points, (repeats, 1, 1)))
        rate = len(contacts) / (clock.process_time() - begin)
        wrong = int((contacts.hit != np.tile(answers, repeats)).sum())
        differences += wrong
        say(
            f"{kind}: {len(contacts)} in arrays, {wrong} differences, "
            f"{contacts.exact_share:.1%} decided exactly, {rate:,.0f} a second"
        )
    return differences


def score_engines(folder: Path, say: Callable[[str], None]) -> None:
    """Print for each engine of `python -m benchmarks space` its row, one value a line."""
    queries = []
    for number, query in enumerate(_read(folder)):
        points = [(float(x), float(y), float(z)) for x, y, z in query.points]
        kind: Kind = "vertex-face" if query.kind == "vertex-face" else "edge-edge"
        queries.append(SpaceQuery(kind, tuple(points[:4]), tuple(points[4:]), number))
    for row, missed in score(queries, engines(has_ipctk=is_installed("ipctk")), lambda _: None):
        say("  ".join(f"{key}: {value}" for key, value in row.items() if value is not None))
        if missed is not None:
            say(f"  first missed: query {missed.name}")


def _decide(query: Public) -> SpaceContact | None:
    first_contact = vertex_face if query.kind == "vertex-face" else edge_edge
    return first_contact(query.points[:4], query.points[4:])


def _read(folder: Path) -> Iterator[Public]:
    for path in sorted(folder.glob("*.csv")):
        kind = "vertex-face" if "vertex-face" in path.name else "edge-edge"
        try:
            rows = [list(map(int, line.split(","))) for line in path.read_text().splitlines()]
            for first in range(0, len(rows), 8):
                points = [
                    [Fraction(row[k], row[k + 1]) for k in (0, 2, 4)]
                    for row in rows[first : first + 8]
                ]
                yield Public(kind, points, bool(rows[first][6]))
        except (ValueError, IndexError, ZeroDivisionError):
            raise InputError(f"{path}: not eight rows of seven integers a query") from None
