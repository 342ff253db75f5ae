"""The obstacles of a planner, prepared once: their straight motions, and boxes of the others."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby, pairwise
from typing import Final, NamedTuple, final

import numpy as np
from librt.vecs import vec

from exactpt.kernel.doubles import Flags, Floats
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.enclosures import Enclosures
from exactpt.motion.normalization import Normalization, normalization_for
from exactpt.motion.swept import NO_DRIFT, SweptBoxes
from exactpt.pair.straight import span_of
from exactpt.scene.scene import Scene
from exactpt.search.reading import Rows, straight_rows
from exactpt.search.sweep import boxes_during, pairs_with_others
from exactpt.search.sweep_search import Slab

SLABS: Final = 64
"""Number of slabs of time, of equal length."""


class ActiveInterval(NamedTuple):
    """A time during which a body is near some obstacles, by number; before, it is near none."""

    start: QQ
    end: QQ
    obstacles: list[int]


@final
class SlabBoxes:
    """Boxes of bodies during slabs of time, prepared for those that do not change.

    Args:
        bodies: the bodies.
        start: the start of the first slab.
        end: the end of the last one.
    """

    def __init__(self, bodies: Sequence[Body], start: QQ, end: QQ) -> None:
        points = [p for body in bodies for p in body.exact_piece_after(start).corners(start)]
        self._normalization: Normalization = normalization_for(
            points or [(QQ(0), QQ(0))], start, end
        )
        self._enclosures = Enclosures(self._normalization)
        self._cuts = [start + (end - start) * k / SLABS for k in range(SLABS + 1)]
        times = [self._normalization.time(t) for t in self._cuts]
        self._lows = np.array([low for low, _ in times[:-1]])
        self._highs = np.array([high for _, high in times[1:]])
        self._boxes = np.stack([self._of(body) for body in bodies], axis=1)

    def _of(self, body: Body) -> Floats:
        """Return the box of a body during each slab: shape (SLABS, 4)."""
        boxes = np.empty((SLABS, 4))
        boxes[:, ::2], boxes[:, 1::2] = np.inf, -np.inf
        start, end = self._cuts[0], self._cuts[-1]
        inner = body.exact_breakpoints_between(start, end)
        for since, until in pairwise([start, *inner, end]):
            low, high = self._normalization.time(since)[0], self._normalization.time(until)[1]
            during = np.nonzero((self._lows <= high) & (self._highs >= low))[0]
            float_tracks = self._enclosures.of_piece(body.exact_piece_after(since))
            swept = SweptBoxes(float_tracks, self._enclosures.errors, NO_DRIFT)
            lows, highs = np.maximum(self._lows[during], low), np.minimum(self._highs[during], high)
            places = swept.during(lows, highs)
            boxes[during, ::2] = np.minimum(boxes[during, ::2], places[..., ::2].min(axis=1))
            boxes[during, 1::2] = np.maximum(boxes[during, 1::2], places[..., 1::2].max(axis=1))
        return boxes

    def active_intervals(self, body: Body) -> Iterator[ActiveInterval]:
        """Yield the times during which the box of a body intersects prepared boxes, in order."""
        box = self._of(body)[:, None, :]
        others = self._boxes
        beside = np.maximum(box, others)[..., ::2] > np.minimum(box, others)[..., 1::2]
        meets: Flags = ~(beside[..., 0] | beside[..., 1])
        slabs = enumerate(meets.max(axis=1).tolist())
        for near, run in groupby(slabs, key=lambda slab: slab[1]):
            if near:
                numbers = [k for k, _ in run]
                obstacles = np.nonzero(meets[numbers].max(axis=0))[0].tolist()
                yield ActiveInterval(self._cuts[numbers[0]], self._cuts[numbers[-1] + 1], obstacles)


@final
class Obstacles:
    """Obstacles during a time span.

    Args:
        scene: the obstacles and the span.

    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._rows = straight_rows(scene.bodies, span_of(scene.exact_start, scene.exact_end))
        self._boxes: vec[float] | None = None
        self._slab_boxes: SlabBoxes | None = None

    def with_body(self, body: Body) -> tuple[Rows, Slab] | None:
        """Return the rows of the obstacles and of a body, and the pairs that may touch.

        None unless all of them move straight.
        """
        if self._rows is None:
            return None
        rows = self._rows.with_body(body)
        if rows is None:
            return None
        low, high = rows.span.low, rows.span.high
        if self._boxes is None:
            self._boxes = boxes_during(self._rows.table, low, high)
        return rows, Slab(low, high, pairs_with_others(rows.table, self._boxes, low, high))

    def active_intervals(self, body: Body) -> Iterator[ActiveInterval]:
        """Return the times during which a body is near obstacles, in order."""
        scene = self._scene
        if not scene.bodies:
            return iter(())
        if self._slab_boxes is None:
            self._slab_boxes = SlabBoxes(scene.bodies, scene.exact_start, scene.exact_end)
        return self._slab_boxes.active_intervals(body)
