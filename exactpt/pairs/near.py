"""The pairs of bodies that come near each other: a filter for questions about all pairs."""

from __future__ import annotations

from itertools import combinations, pairwise
from typing import Final

import numpy as np

from exactpt.geometry.boxes import Boxes, overlapping_pairs
from exactpt.kernel.numbers import QQ, ceil, enclosing_floats, power_of_two
from exactpt.motion.frame import Frame
from exactpt.motion.swept import SweptBoxes
from exactpt.motion.vertices import Vertices
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
    vertices = Vertices.of(scene.bodies, scene._start, scene._end, plain=True)
    cuts = {t for body in scene.bodies for t in body._breakpoints}
    inner = sorted(t for t in cuts if scene._start < t < scene._end)
    found: set[tuple[int, int]] = set()
    for begin, end in pairwise((scene._start, *inner, scene._end)):
        for i, moving in enumerate(vertices.bodies):
            if moving.until == begin:
                vertices.enter_piece(i, begin)
        halves = [reach / 2 + body._radius for body in scene.bodies]
        slabs = max(1, int(ceil(SLABS * (end - begin) / (scene._end - scene._start))))
        found |= _near_during(vertices, halves, begin, end, slabs)
    return sorted(found)


def _near_during(
    vertices: Vertices, halves: list[QQ], begin: QQ, end: QQ, slabs: int
) -> set[tuple[int, int]]:
    """The pairs whose boxes meet in one of the slabs between two changes of motion."""
    images = [vertices.all[v].image for moving in vertices.bodies for v in moving.ring]
    sizes = [len(moving.ring) for moving in vertices.bodies]
    firsts = np.cumsum([0, *sizes[:-1]])
    swept = SweptBoxes(images, vertices.enclosures.errors)
    found: set[tuple[int, int]] = set()
    width = (end - begin) / slabs
    for k in range(slabs):
        low = vertices.frame.time(begin + k * width)[0]
        high = vertices.frame.time(begin + (k + 1) * width)[1]
        boxes = swept.during(low, high)
        boxes[:, ::2] = np.repeat(np.minimum.reduceat(boxes[:, ::2], firsts), sizes, axis=0)
        boxes[:, 1::2] = np.repeat(np.maximum.reduceat(boxes[:, 1::2], firsts), sizes, axis=0)
        for first, second in overlapping_pairs(_widened(boxes[firsts], halves, vertices.frame)):
            found.update(zip(first.tolist(), second.tolist(), strict=True))
    return found


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
