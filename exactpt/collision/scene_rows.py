"""The straight motions of all bodies of a scene: rows in boxes, and which come near each other.

A body becomes a row, with the rationals and lists that exact decisions need, when it comes near
another one; until then, doubles in arrays are enough where these are exact. The box of a rounded
body is grown.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from exactpt.collision.row_boxes import RowBoxes, near_boxes, pairs_at
from exactpt.collision.straight_search import MOST_VERTICES, Row, rows_during
from exactpt.kernel.budget import ask
from exactpt.kernel.numbers import QQ, nearest_float
from exactpt.kernel.rounding import TINY, U
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.motion.outline import Outline, Straight, rest_outline, straight_pieces
from exactpt.scene.body_arrays import BodyArrays
from exactpt.scene.scene import Scene

__all__ = ["SceneRows", "boxed", "scene_rows"]

Floats: TypeAlias = NDArray[np.float64]

ROUNDED_UP: Final = 1.0 + 4.0 * U
"""Factor by which a rounded number becomes one that is not less."""


@final
class SceneRows:
    """The rows of all bodies of a scene.

    Args:
        scene: the scene.
        boxes: the boxes of the rows.
        rows: the rows; those of a body's single piece of motion are made on demand, if None.
    """

    def __init__(self, scene: Scene, boxes: RowBoxes, rows: list[Row] | None) -> None:
        self._scene = scene
        self._boxes = boxes
        self._rows: dict[int, Row] = dict(enumerate(rows or ()))

    def near_at_start(self) -> list[tuple[int, int]]:
        """The pairs i < j of bodies whose boxes meet at the start."""
        return sorted({(i, j) for i, j in pairs_at(self._boxes, self._scene._start) if i != j})

    def near(self) -> Iterator[tuple[float, int, int]]:
        """The pairs of rows that come near each other; see `near_rows`."""
        return near_boxes(self._boxes, self._scene._start, self._scene._end)

    def body(self, k: int) -> int:
        """The body of a row."""
        return int(self._boxes.body[k])

    def __getitem__(self, k: int) -> Row:
        row = self._rows.get(k)
        if row is None:
            pieces = _pieces(self._scene.bodies[k])
            start, end = self._scene._start, self._scene._end
            row = self._rows[k] = Row(k, (pieces or [])[0][0], start, end)
        return row


def scene_rows(scene: Scene) -> SceneRows | None:
    """The rows of a scene; None unless all bodies move straight and none is large."""
    bodies = scene.bodies
    numbers = _of_arrays(bodies) if isinstance(bodies, BodyArrays) else _of_bodies(bodies)
    if numbers is not None:
        return SceneRows(scene, RowBoxes.of_doubles(numbers, scene._start, scene._end), None)
    rows: list[Row] = []
    for i, body in enumerate(scene.bodies):
        ask()
        pieces = _pieces(body)
        if pieces is None:
            return None
        rows += rows_during(i, pieces, scene._start, scene._end)
    return boxed(scene, rows)


def boxed(scene: Scene, rows: list[Row]) -> SceneRows:
    """The given rows of a scene."""
    return SceneRows(scene, RowBoxes(rows), rows)


def _of_arrays(bodies: BodyArrays) -> Floats | None:
    """The grown box, c and v of each body; None unless all move straight and none is large."""
    bends = bodies.coefficients[:, :, 2:].any()
    if bends or np.diff(bodies.offsets).max(initial=0) > MOST_VERTICES:
        return None
    low = np.minimum.reduceat(bodies.vertices, bodies.offsets[:-1])
    high = np.maximum.reduceat(bodies.vertices, bodies.offsets[:-1])
    radii = np.where(bodies.radii, bodies.radii * ROUNDED_UP + TINY, 0.0)[:, None]
    straight = np.zeros((len(bodies), 2, 2))
    straight[:, :, : bodies.coefficients.shape[2]] = bodies.coefficients[:, :, :2]
    return np.hstack((low - radii, high + radii, straight[:, :, 0], straight[:, :, 1]))


def _of_bodies(bodies: Sequence[Body]) -> Floats | None:
    """The same of bodies one by one; None also if doubles are not exact."""
    numbers: list[tuple[float, ...]] = []
    for body in bodies:
        ask()
        known = _doubles_of(body)
        if known is None:
            return None
        numbers.append(known)
    return np.array(numbers).reshape(-1, 8)


def _doubles_of(body: Body) -> tuple[float, ...] | None:
    """The grown box, c and v of a body in straight motion; None unless doubles are exact."""
    doubles = body._shape.doubles
    if doubles is None or type(body.motion) is not Translation or body.size > MOST_VERTICES:
        return None
    x, y = body.motion.x._doubles, body.motion.y._doubles
    if x is None or y is None or len(x) > 2 or len(y) > 2:
        return None
    xs, ys = doubles
    radius = _above(body._radius)
    low_x, low_y, high_x, high_y = min(xs), min(ys), max(xs), max(ys)
    (cx, vx, *_), (cy, vy, *_) = (*x, 0.0, 0.0), (*y, 0.0, 0.0)
    return (low_x - radius, low_y - radius, high_x + radius, high_y + radius, cx, cy, vx, vy)


def _above(radius: QQ) -> float:
    """A double that is not less; 0 for 0."""
    return nearest_float(radius) * ROUNDED_UP + TINY if radius else 0.0


def _pieces(body: Body) -> list[tuple[Straight, QQ | None]] | None:
    """The straight motions of a body that is not large, its box grown; None of another one."""
    shape = rest_outline(body)
    if shape is None or body.size > MOST_VERTICES:
        return None
    return straight_pieces(body, _grown(body, shape))


def _grown(body: Body, shape: Outline) -> Outline:
    """An outline with a box that contains the points within the radius, apart from rounding.

    Bounds made of boxes allow for the rounding of a sum of sides.
    """
    radius = _above(body._radius)
    return shape._replace(
        low_x=shape.low_x - radius,
        high_x=shape.high_x + radius,
        low_y=shape.low_y - radius,
        high_y=shape.high_y + radius,
    )
