"""When two bodies of which one is rounded touch first, among all such pairs of a scene."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from itertools import combinations
from typing import final

import numpy as np
from numpy.typing import NDArray

from exactpt.collision.ignoring import groups_of
from exactpt.collision.meeting import Span, span_of
from exactpt.collision.row_boxes import near_rows
from exactpt.collision.rounded_straight import first_touch
from exactpt.collision.straight_search import FEW, MOST_VERTICES, Row, rows_during
from exactpt.geometry.boxes import Indices
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, enclosing_floats
from exactpt.motion.body import Body
from exactpt.motion.incidence import Touch
from exactpt.motion.outline import Outline, rest_outline, straight_pieces
from exactpt.motion.track import Track
from exactpt.proximity.features import feature_pairs
from exactpt.proximity.search import Approach, ApproachSearch, within_at_start
from exactpt.scene.scene import Scene

__all__ = ["RoundedSearch"]


@final
class RoundedSearch:
    """A search among the pairs of bodies of which one is rounded.

    Args:
        scene: the bodies, their motions and the time span.
        groups: groups of names; contacts within a group are ignored.
        exact_only: whether exact arithmetic decides everything.
    """

    def __init__(
        self, scene: Scene, groups: Iterable[Collection[str]], *, exact_only: bool = False
    ) -> None:
        self._scene = scene
        self._exact_only = exact_only
        self._radii = [body._radius for body in scene.bodies]
        self._group: Indices = np.array(groups_of(scene, groups), dtype=np.int64)
        self._is_rounded: NDArray[np.bool_] = np.array([r > 0 for r in self._radii], np.bool_)

    def at_start(self) -> Iterator[tuple[tuple[int, int], bool]]:
        """The pairs that touch or overlap at the start, and whether they overlap."""
        return within_at_start(self._scene, self._squared, self._radii, self._apart)

    def after_start(self, before: AlgebraicNumber | None) -> Approach | None:
        """The first touches after the start, of bodies that do not touch then.

        Args:
            before: touches later than this need not be found; None for the end.
        """
        rows = None if self._exact_only else _rows_of(self._scene)
        if rows is not None:
            return self._of_rows(rows, math.inf if before is None else before.enclosure()[1])
        end = self._scene._end if before is None else min(self._scene._end, before._high)
        part = self._scene.until(end)
        return ApproachSearch(part, self._squared, self._radii, self._apart).run_after_start()

    def touches(
        self,
        pairs: Iterable[tuple[int, int]],
        tracks: Sequence[Sequence[Track]],
        time: AlgebraicNumber,
    ) -> Iterator[Touch]:
        """All pairs of features of touching bodies that are at their distance at a time."""
        for i, j in pairs:
            a, b, squared = self._scene.bodies[i], self._scene.bodies[j], self._squared(i, j)
            for pair in feature_pairs(a, b, tuple(tracks[i]), tuple(tracks[j])):
                if time.sign_of(pair.at_distance(squared)) == 0 and pair.is_inside(time):
                    first, second = pair.features
                    if first.vertex is None:
                        yield Touch(j, second.vertex or 0, i, first.edge or 0, -1)
                    elif second.vertex is None:
                        yield Touch(i, first.vertex, j, second.edge or 0, -1)
                    else:
                        yield Touch(i, first.vertex, j, -1, second.vertex)

    def _squared(self, i: int, j: int) -> QQ:
        return (self._radii[i] + self._radii[j]) ** 2

    def _apart(self, i: Indices, j: Indices) -> NDArray[np.bool_]:
        one = self._is_rounded[i] | self._is_rounded[j]
        watched: NDArray[np.bool_] = one & (i != j) & (self._group[i] != self._group[j])
        return watched

    def _of_rows(self, rows: Sequence[Row], before: float) -> Approach | None:
        """As `after_start`, for bodies that all move straight."""
        scene, group, rounded = self._scene, self._group.tolist(), self._is_rounded.tolist()
        spans: dict[tuple[QQ, QQ], Span] = {}
        best: AlgebraicNumber | None = None
        pairs: set[tuple[int, int]] = set()
        for enter, a, b in _near(rows, scene._start, scene._end):
            if enter > before:
                break
            i, j = min(a.body, b.body), max(a.body, b.body)
            if i == j or group[i] == group[j] or not (rounded[i] or rounded[j]):
                continue
            key = max(a.start, b.start), min(a.end, b.end)
            if key[0] >= key[1]:
                continue
            span = spans.get(key)
            if span is None:
                span = spans[key] = span_of(*key)
            time = first_touch(a.straight, b.straight, span, before)
            if time is None:
                continue
            order = -1 if best is None else time.compare(best)
            if order < 0:
                best, pairs = time, set()
                before = min(before, time.enclosure()[1])
            if order <= 0:
                pairs.add((i, j))
        return None if best is None else Approach(best, tuple(sorted(pairs)))


def _near(rows: Sequence[Row], start: QQ, end: QQ) -> Iterator[tuple[float, Row, Row]]:
    """The pairs of rows whose boxes meet, with times before which they do not, in their order."""
    if len(rows) <= FEW:
        return ((-math.inf, a, b) for a, b in combinations(rows, 2))
    return ((enter, rows[i], rows[j]) for enter, i, j in near_rows(rows, start, end))


def _rows_of(scene: Scene) -> list[Row] | None:
    """The rows of all bodies, their boxes grown by the radii; None unless all move straight."""
    rows: list[Row] = []
    for i, body in enumerate(scene.bodies):
        shape = rest_outline(body)
        if shape is None or body.size > MOST_VERTICES:
            return None
        pieces = straight_pieces(body, _grown(body, shape))
        if pieces is None:
            return None
        rows += rows_during(i, pieces, scene._start, scene._end)
    return rows


def _grown(body: Body, shape: Outline) -> Outline:
    """An outline with a box that contains the points within the radius, apart from rounding.

    Bounds made of boxes allow for the rounding of a sum of sides.
    """
    radius = enclosing_floats(body._radius)[1]
    return shape._replace(
        low_x=shape.low_x - radius,
        high_x=shape.high_x + radius,
        low_y=shape.low_y - radius,
        high_y=shape.high_y + radius,
    )
