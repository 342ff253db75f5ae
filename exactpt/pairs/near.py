"""The pairs of bodies that come near each other: a filter for questions about all pairs."""

from __future__ import annotations

from itertools import combinations
from typing import Final

import numpy as np

from exactpt.geometry.boxes import grown, overlapping_pairs
from exactpt.kernel.numbers import QQ, enclosing_floats, power_of_two
from exactpt.motion.slabs import Near
from exactpt.motion.swept_edges import SweptEdges
from exactpt.pairs.boxes import PieceBoxes
from exactpt.pairs.pieces import ScenePieces, linear_pieces
from exactpt.scene.scene import Scene

FEW: Final = 4
"""Maximum number of bodies of which all pairs are named at once."""
SLABS: Final = 64
"""Minimum number of slabs in the time span, of motions that are not linear."""


def pairs_that_come_near(scene: Scene, reach: QQ) -> list[tuple[int, int]]:
    """Return the pairs i < j of bodies whose swept boxes, grown to this reach, intersect.

    A superset of those whose distance in the maximum norm is ever at most the reach. (The radii
    of rounded bodies are added to it.)
    """
    if len(scene.bodies) <= FEW:
        return list(combinations(range(len(scene.bodies)), 2))
    rows = linear_pieces(scene)
    if rows is not None:
        grown_boxes = PieceBoxes(rows, enclosing_floats(reach / 2)[1])
        near = ScenePieces(rows, scene._start, scene._end, grown_boxes).near()
        return sorted({(min(a.body, b.body), max(a.body, b.body)) for _, a, b in near})
    swept = SweptEdges(scene.bodies, scene._start, scene._end)
    units = [power_of_two(-scale) for scale in swept.vertices.frame.scale]
    halves = [reach / 2 + body._radius for body in scene.bodies]
    by = np.array([[enclosing_floats(r * unit)[1] for unit in units] for r in halves])
    found: set[tuple[int, int]] = set()

    def near_bodies(now: QQ, later: QQ) -> Near:
        boxes = swept.of_bodies(swept.during(now, later))
        i, j = zip(*overlapping_pairs(grown(boxes, by) if by.any() else boxes), strict=True)
        return np.concatenate(i), np.concatenate(j)

    longest, many = (scene._end - scene._start) / SLABS, 8 * len(scene.bodies) + 64
    for _, _, (i, j) in swept.slabs(near_bodies, longest, many):
        found.update(zip(i.tolist(), j.tolist(), strict=True))
    return sorted(found)
