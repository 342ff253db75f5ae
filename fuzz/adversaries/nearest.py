"""The nearest features of two pieces at one time: what the filter leaves, against rationals.

``python -m fuzz.adversaries.nearest --rows 10000 --seed 1``. The rows are those of
`fuzz.adversaries.starts`: most pieces touch, overlap or are nested, but for a few roundings. All
nearest pairs of features have to be left, or all at the distance 0 if edges cross; edges that are
said to cross have to do so, edges that cross have to be left, and pieces that are said to be
outside of each other have no common point. The counts say how often the filter says so.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from itertools import product
from random import Random
from typing import TypeAlias

from exactpt.filters.nearest import Nearest
from exactpt.filters.starts import snapshot_of
from exactpt.geometry.predicates import orientation
from exactpt.kernel.numbers import QQ, enclosing_floats
from exactpt.pair.nearest_at import squared_from_interior, squared_length
from fuzz.adversaries.pieces import KINDS
from fuzz.adversaries.report import Report, run
from fuzz.adversaries.starts import Row, Shape, drawn, share_a_point

__all__ = ["attack"]

Names: TypeAlias = tuple[int, int, int, int]
"""0 or 1, the piece of a vertex; the vertex; an edge of the other one, or its vertex, or -1."""


def attack(kind: int, rows: int, seed: int) -> Report:
    """Attack with a piece of one kind of motion and one of any kind."""
    report, rng = Report(), Random(seed)
    for row in drawn(kind, rows, seed):
        report.rows += 1
        squares = dict(_all_squares(row.first, row.second))
        least = min(squares.values())
        within = rng.choice((None, None, None, least, least * QQ(9, 8), QQ(0)))
        report.wrong += [f"{fault}: {row}" for fault in _faults(report, row, squares, within)]
    return report


def _faults(report: Report, row: Row, squares: dict[Names, QQ], within: QQ | None) -> Iterator[str]:
    """Yield what is wrong in the answers of the filter about a row."""
    first, second = (snapshot_of(row.table, piece, row.t) for piece in (row.i, row.j))
    limit = math.inf if within is None else enclosing_floats(within)[1]
    near = Nearest(first, second, limit)
    found = near.features()
    left = {(int(f.one != row.i), f.vertex, f.edge, max(f.other_vertex, -1)) for f in found}
    left = {(one, v, edge, -1 if edge >= 0 else w) for one, v, edge, w in left}
    least = min(squares.values())
    if (within is None or least <= within) and (not near.cross or not least):
        lost = {names for names, squared in squares.items() if squared == least} - left
        if lost:
            yield f"nearest features {lost} are lost"
    if len(found) != len(left):
        yield "features twice"
    crossing = set(_crossing(row.first, row.second))
    if near.cross and not crossing:
        yield "no edges cross"
    met = list(near.met)
    if not near.cross and not crossing <= set(zip(met[::2], met[1::2], strict=True)):
        yield "edges that cross are lost"
    if near.is_outside():
        report.count("outside")
        if share_a_point(row.first, row.second):
            yield "a common point"
    elif row.is_random:
        report.count("random and not outside")
    report.count("cross" if near.cross else "no certain crossing")
    report.counts["pairs left"] = report.counts.get("pairs left", 0) + len(left)
    report.counts["of"] = report.counts.get("of", 0) + len(squares)


def _all_squares(p: Shape, q: Shape) -> Iterator[tuple[Names, QQ]]:
    """Yield the squared distances of all pairs of features that have a common perpendicular."""
    for (i, u), (j, v) in product(enumerate(p.points), enumerate(q.points)):
        yield (0, i, -1, j), squared_length(u, v)
    for one, (a, b) in enumerate(((p, q), (q, p))):
        for (i, v), (e, (k, l)) in product(enumerate(a.points), enumerate(b.edges)):
            squared = squared_from_interior(v, b.points[k], b.points[l])
            if squared is not None:
                yield (one, i, e, -1), squared


def _crossing(p: Shape, q: Shape) -> Iterator[tuple[int, int]]:
    """Yield the edges that cross: each has its ends strictly on both sides of the other."""
    for (e, (i, j)), (f, (k, l)) in product(enumerate(p.edges), enumerate(q.edges)):
        a, b, c, d = p.points[i], p.points[j], q.points[k], q.points[l]
        if (
            orientation(a, b, c) * orientation(a, b, d) < 0
            and orientation(c, d, a) * orientation(c, d, b) < 0
        ):
            yield e, f


if __name__ == "__main__":
    run({name: partial(attack, kind) for name, kind in KINDS.items()}, __doc__ or "")
