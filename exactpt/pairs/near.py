"""The pairs of bodies that come near each other: a filter for questions about all pairs."""

from __future__ import annotations

from itertools import combinations
from typing import Final

import numpy as np

from exactpt.geometry.boxes import grown, overlapping_pairs
from exactpt.kernel.numbers import QQ, enclosing_floats, power_of_two
from exactpt.motion.swept_edges import SweptEdges
from exactpt.pairs.boxes import PieceBoxes
from exactpt.pairs.pieces import ScenePieces, linear_pieces
from exactpt.scene.scene import Scene

FEW: Final = 4
"""Maximum number of bodies of which all pairs are named at once."""
SLABS: Final = 64
"""Number of slabs in the time span; each piece of motion has one at least."""


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
    width = (scene._end - scene._start) / SLABS
    found: set[tuple[int, int]] = set()
    now = scene._start
    while now < scene._end:
        later = min(now + width, swept.until())
        boxes = swept.of_bodies(swept.during(now, later))
        for first, second in overlapping_pairs(grown(boxes, by) if by.any() else boxes):
            found.update(zip(first.tolist(), second.tolist(), strict=True))
        now = later
        swept.enter_pieces(now)
    return sorted(found)
