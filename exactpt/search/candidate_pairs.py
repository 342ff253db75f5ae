"""The pairs of bodies that come near each other, and when: for questions about all pairs."""

from __future__ import annotations

from itertools import combinations
from typing import Final, TypeAlias

from exactpt.kernel.numbers import QQ
from exactpt.scene.scene import Scene
from exactpt.search.reading import rows_of_scene
from exactpt.search.sweep_search import AllPairs, Slabs

FEW: Final = 4
"""Maximum number of bodies of which all pairs are named at once, if none changes its motion."""
SLABS: Final = 64.0
"""Minimum number of slabs in the time span."""


Spans: TypeAlias = "list[tuple[QQ, QQ]]"
"""Disjoint closed spans of time, but for their ends, in order."""


def candidate_pairs(scene: Scene, reach: QQ) -> dict[tuple[int, int], Spans]:
    """Return the pairs i < j of bodies whose boxes, grown to this reach, intersect, and when.

    A superset of those whose distance in the maximum norm is ever at most the reach, in order,
    and of the times at which it is. (The radii of rounded bodies are added to it.)
    """
    bodies, start, end = scene.bodies, scene.exact_start, scene.exact_end
    if len(bodies) <= FEW and not any(b.exact_breakpoints_between(start, end) for b in bodies):
        return {pair: [(start, end)] for pair in combinations(range(len(bodies)), 2)}
    found: dict[tuple[int, int], set[tuple[QQ, QQ]]] = {}
    rows = rows_of_scene(scene, reach / 2)
    table, spans, time = rows.table, rows.spans, rows.units.exact_time
    longest = (rows.span.high - rows.span.low) / SLABS
    for slab in Slabs(rows, AllPairs(rows, with_themselves=False), longest):
        low, high = time(slab.low), time(slab.high)
        for one, two in slab.pairs.rows():
            i, j = sorted((int(table.body[one]), int(table.body[two])))
            begin = max(start, low, spans[one][0], spans[two][0])
            until = min(end, high, spans[one][1], spans[two][1])
            if begin <= until:  # doubles around two spans may meet where the spans do not
                found.setdefault((i, j), set()).add((begin, until))
    return {pair: sorted(found[pair]) for pair in sorted(found)}
