"""The pairs of bodies that come near each other: a filter for questions about all pairs."""

from __future__ import annotations

from itertools import combinations
from typing import Final

import numpy as np

from exactpt.geometry.boxes import Boxes, overlapping_pairs
from exactpt.kernel.numbers import QQ, enclosing_floats, power_of_two
from exactpt.motion.frame import Frame
from exactpt.motion.swept_edges import SweptEdges
from exactpt.pairs.boxes import candidate_pieces
from exactpt.pairs.pieces import linear_pieces
from exactpt.scene.scene import Scene

__all__ = ["pairs_that_come_near"]

FEW: Final = 4
"""Maximum number of bodies of which all pairs are named at once."""
SLABS: Final = 64
"""Number of slabs in the time span; each piece of motion has one at least."""


def pairs_that_come_near(scene: Scene, reach: QQ) -> list[tuple[int, int]]:
    """The pairs i < j of bodies whose swept boxes, grown to this reach, meet.

    A superset of those whose distance in the maximum norm is ever at most the reach. (The radii
    of rounded bodies are added to it.)
    """
    if len(scene.bodies) <= FEW:
        return list(combinations(range(len(scene.bodies)), 2))
    rows = linear_pieces(scene)
    if rows is not None:
        near = candidate_pieces(rows, scene._start, scene._end, enclosing_floats(reach / 2)[1])
        bodies = (sorted((rows[k].body, rows[l].body)) for _, k, l in near)
        return sorted({(i, j) for i, j in bodies})
    swept = SweptEdges(scene.bodies, scene._start, scene._end)
    halves = [reach / 2 + body._radius for body in scene.bodies]
    width = (scene._end - scene._start) / SLABS
    found: set[tuple[int, int]] = set()
    now = scene._start
    while now < scene._end:
        later = min(now + width, swept.until())
        boxes = swept.of_bodies(swept.during(now, later))
        for first, second in overlapping_pairs(_widened(boxes, halves, swept.vertices.frame)):
            found.update(zip(first.tolist(), second.tolist(), strict=True))
        now = later
        swept.enter_pieces(now)
    return sorted(found)


@np.errstate(all="ignore")
def _widened(boxes: Boxes, halves: list[QQ], frame: Frame) -> Boxes:
    """The boxes of bodies, normalised, widened by lengths; the rounding is outward."""
    if not any(halves):
        return boxes
    wide = boxes.copy()
    for axis in (0, 1):
        unit = power_of_two(-frame.scale[axis])
        by = np.array([enclosing_floats(r * unit)[1] for r in halves])
        low, high = 2 * axis, 2 * axis + 1
        wide[:, low] = np.nextafter(boxes[:, low] - by, -np.inf)
        wide[:, high] = np.nextafter(boxes[:, high] + by, np.inf)
    return wide
