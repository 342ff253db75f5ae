"""When two bodies of which one is rounded touch first, among all such pairs of a scene."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator
from typing import final

import numpy as np
from numpy.typing import NDArray

from exactpt.geometry.boxes import Indices
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from exactpt.motion.incidence import Touch
from exactpt.pairs.approach_search import ApproachSearch, Nearest, near_at_start, within_at_start
from exactpt.pairs.features import feature_pairs
from exactpt.pairs.incidences import tracks_just_before
from exactpt.pairs.radius_filters import first_touch
from exactpt.pairs.rational import Span, span_of
from exactpt.pairs.scene_pieces import SceneRows, scene_rows
from exactpt.pairs.selection import groups_of
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
        self._radii = [body._radius for body in scene.bodies]
        self._groups = groups_of(scene, groups)
        self._group: Indices = np.array(self._groups, dtype=np.int64)
        self._rows = None if exact_only else scene_rows(scene)
        self._is_rounded: NDArray[np.bool_] = np.array([r > 0 for r in self._radii], np.bool_)

    def at_start(self) -> Iterator[tuple[tuple[int, int], bool]]:
        """The pairs that touch or overlap at the start, and whether they overlap."""
        if self._rows is None:
            near = near_at_start(self._scene, self._radii, self._apart)
        else:
            near = filter(self._watched, self._rows.near_at_start())
        return within_at_start(self._scene, self._squared, near)

    def after_start(self, before: AlgebraicNumber | None) -> Nearest | None:
        """The first touches after the start, of bodies that do not touch then.

        Args:
            before: touches later than this need not be found; None for the end.
        """
        if self._rows is not None:
            last = math.inf if before is None else before.enclosure()[1]
            return self._of_rows(self._rows, last)
        end = self._scene._end if before is None else min(self._scene._end, before._high)
        part = self._scene.until(end)
        return ApproachSearch(part, self._squared, self._radii, self._apart).run_after_start()

    def touches(self, pairs: Iterable[tuple[int, int]], time: AlgebraicNumber) -> Iterator[Touch]:
        """All pairs of features of touching bodies that are at their distance at a time."""
        for i, j in pairs:
            squared, two = self._squared(i, j), (self._scene.bodies[i], self._scene.bodies[j])
            p, q = (tracks_just_before(body, time, self._scene._start) for body in two)
            for pair in feature_pairs(*two, p, q):
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

    def _watched(self, ij: tuple[int, int]) -> bool:
        i, j = ij
        return bool(self._radii[i] or self._radii[j]) and self._groups[i] != self._groups[j]

    def _of_rows(self, rows: SceneRows, before: float) -> Nearest | None:
        """As `after_start`, for bodies that all move straight."""
        spans: dict[tuple[QQ, QQ], Span] = {}
        best: AlgebraicNumber | None = None
        pairs: set[tuple[int, int]] = set()
        for enter, k, l in rows.near():
            if enter > before:
                break
            i, j = sorted((rows.body(k), rows.body(l)))
            if not self._watched((i, j)):
                continue
            a, b = rows[k], rows[l]
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
        return None if best is None else Nearest(best, tuple(sorted(pairs)))
