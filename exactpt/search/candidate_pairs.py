"""The pairs of bodies that come near each other: a filter for questions about all pairs."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Final, TypeAlias

import numpy as np

from exactpt.geometry.boxes import grown, overlapping_pairs
from exactpt.kernel.numbers import QQ, enclosing_floats, power_of_two
from exactpt.motion.slabs import Near, Slab
from exactpt.motion.swept_edges import SweptEdges
from exactpt.pair.straight import span_of
from exactpt.scene.scene import Scene
from exactpt.search.reading import Rows, straight_rows
from exactpt.search.sweep_search import SlabsOfAll

FEW: Final = 4
"""Maximum number of bodies of which all pairs are named at once, if none changes its motion."""
SLABS: Final = 64
"""Minimum number of slabs in the time span, of motions that are not linear."""


Spans: TypeAlias = "list[tuple[QQ, QQ]]"
"""Disjoint closed spans of time, but for their ends, in order."""


def candidate_pairs(scene: Scene, reach: QQ) -> dict[tuple[int, int], Spans]:
    """Return the pairs i < j of bodies whose swept boxes, grown to this reach, intersect, and when.

    A superset of those whose distance in the maximum norm is ever at most the reach, in order,
    and of the times at which it is. (The radii of rounded bodies are added to it.)
    """
    bodies, start, end = scene.bodies, scene.exact_start, scene.exact_end
    if len(bodies) <= FEW and not any(b.exact_breakpoints_between(start, end) for b in bodies):
        return {pair: [(start, end)] for pair in combinations(range(len(bodies)), 2)}
    found: dict[tuple[int, int], Spans] = {}
    rows = straight_rows(bodies, span_of(start, end), reach / 2)
    if rows is not None:
        found = _near_rows(rows)
    else:
        for now, later, (i, j) in _near_slabs(scene, reach):
            for pair in zip(i.tolist(), j.tolist(), strict=True):
                found.setdefault(pair, []).append((now, later))
    return {pair: sorted(found[pair]) for pair in sorted(found)}


def _near_rows(rows: Rows) -> dict[tuple[int, int], Spans]:
    """Return the pairs of bodies that have rows which come near each other, and when both last."""
    body, spans = rows.table.body, rows.spans
    near = {rows for slab in SlabsOfAll(rows) for rows in slab.pairs.rows()}
    found: dict[tuple[int, int], Spans] = {}
    for one, two in near:
        i, j = int(body[one]), int(body[two])
        start = max(spans[one].start, spans[two].start)
        end = min(spans[one].end, spans[two].end)
        if start <= end:  # doubles around two spans may meet where the spans do not
            found.setdefault((min(i, j), max(i, j)), []).append((start, end))
    return found


def _near_slabs(scene: Scene, reach: QQ) -> Iterator[Slab]:
    """Yield slabs of time, with the pairs of bodies whose grown boxes intersect in each."""
    swept = SweptEdges(scene.bodies, scene.exact_start, scene.exact_end)
    units = [power_of_two(-scale) for scale in swept.vertices.normalization.scale]
    halves = [reach / 2 + body.exact_radius for body in scene.bodies]
    by = np.array([[enclosing_floats(r * unit)[1] for unit in units] for r in halves])

    def near(now: QQ, later: QQ) -> Near:
        boxes = swept.of_bodies(swept.during(now, later))
        i, j = zip(*overlapping_pairs(grown(boxes, by) if by.any() else boxes), strict=True)
        return np.concatenate(i), np.concatenate(j)

    longest, many = (scene.exact_end - scene.exact_start) / SLABS, 8 * len(scene.bodies) + 64
    return swept.slabs(near, longest, many, bodies_of=lambda pairs: pairs)
