"""The pairs of bodies that come near each other: a filter for questions about all pairs."""

from __future__ import annotations

from itertools import combinations, pairwise
from typing import Final

import numpy as np

from exactpt.geometry.boxes import overlapping_pairs
from exactpt.kernel.numbers import QQ, enclosing_floats, power_of_two
from exactpt.motion.swept import SweptBoxes
from exactpt.motion.vertices import Vertices
from exactpt.scene.scene import Scene

__all__ = ["pairs_that_come_near"]

FEW: Final = 4
"""Maximum number of bodies of which all pairs are named at once."""
SLABS: Final = 64
"""Number of slabs into which each piece of motion is cut: boxes are swept through one slab."""


def pairs_that_come_near(scene: Scene, reach: QQ) -> list[tuple[int, int]]:
    """The pairs i < j of bodies whose swept boxes, grown to this reach, meet.

    A superset of those whose distance in the maximum norm is ever at most the reach.
    """
    if len(scene.bodies) <= FEW:
        return list(combinations(range(len(scene.bodies)), 2))
    vertices = Vertices.of(scene.bodies, scene._start, scene._end, plain=True)
    cuts = {t for body in scene.bodies for t in body._breakpoints}
    inner = sorted(t for t in cuts if scene._start < t < scene._end)
    found: set[tuple[int, int]] = set()
    for begin, end in pairwise((scene._start, *inner, scene._end)):
        for i, moving in enumerate(vertices.bodies):
            if moving.until == begin:
                vertices.enter_piece(i, begin)
        found |= _near_during(vertices, begin, end, reach)
    return sorted(found)


def _near_during(vertices: Vertices, begin: QQ, end: QQ, reach: QQ) -> set[tuple[int, int]]:
    """The pairs whose boxes meet in one of the slabs between two changes of motion."""
    images = [vertices.all[v].image for moving in vertices.bodies for v in moving.ring]
    sizes = [len(moving.ring) for moving in vertices.bodies]
    firsts = np.cumsum([0, *sizes[:-1]])
    swept = SweptBoxes(images, vertices.enclosures.errors)
    half = [enclosing_floats(reach * power_of_two(-s - 1))[1] for s in vertices.frame.scale]
    found: set[tuple[int, int]] = set()
    width = (end - begin) / SLABS
    for k in range(SLABS):
        low = vertices.frame.time(begin + k * width)[0]
        high = vertices.frame.time(begin + (k + 1) * width)[1]
        boxes = swept.during(low, high)
        boxes[:, ::2] = np.repeat(np.minimum.reduceat(boxes[:, ::2], firsts), sizes, axis=0)
        boxes[:, 1::2] = np.repeat(np.maximum.reduceat(boxes[:, 1::2], firsts), sizes, axis=0)
        of_bodies = boxes[firsts]
        of_bodies[:, ::2] = np.nextafter(of_bodies[:, ::2] - half, -np.inf)
        of_bodies[:, 1::2] = np.nextafter(of_bodies[:, 1::2] + half, np.inf)
        for first, second in overlapping_pairs(of_bodies):
            found.update(zip(first.tolist(), second.tolist(), strict=True))
    return found
