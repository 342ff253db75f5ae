"""The motion pieces of a scene in linear motion, with their boxes, made when they are needed.

A body becomes a piece, with the rationals and lists that exact decisions need, when it comes near
another one; until then, doubles in arrays are enough where these are exact. The box of a rounded
body is grown.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from exactpt.kernel.budget import ask
from exactpt.kernel.doubles import native
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.motion.outline import Outline, Straight, far_origin, rest_outline, straight_pieces
from exactpt.pairs.boxes import PieceBoxes, candidate_pairs, pairs_at, radius_above
from exactpt.pairs.pieces import MOST_VERTICES, MotionPiece, pieces_during
from exactpt.scene.body_arrays import BodyArrays
from exactpt.scene.scene import Scene

__all__ = ["ScenePieces", "boxed", "boxed_pieces_of"]

Floats: TypeAlias = NDArray[np.float64]


@final
class ScenePieces:
    """The pieces of all bodies of a scene.

    Args:
        scene: the scene.
        boxes: the boxes of the pieces.
        rows: the pieces; those of a body's single piece of motion are made on demand, if None.
    """

    def __init__(self, scene: Scene, boxes: PieceBoxes, rows: list[MotionPiece] | None) -> None:
        self._scene = scene
        self._boxes = boxes
        self._rows: dict[int, MotionPiece] = dict(enumerate(rows or ()))

    def near_at_start(self) -> list[tuple[int, int]]:
        """The pairs i < j of bodies whose boxes meet at the start."""
        return sorted({(i, j) for i, j in pairs_at(self._boxes, self._scene._start) if i != j})

    def near(self) -> Iterator[tuple[float, int, int]]:
        """The pairs of pieces that come near each other; see `candidate_pieces`."""
        return candidate_pairs(self._boxes, self._scene._start, self._scene._end)

    def body(self, k: int) -> int:
        """The body of a piece."""
        return int(self._boxes.body[k])

    def __getitem__(self, k: int) -> MotionPiece:
        row = self._rows.get(k)
        if row is None:
            pieces = _pieces(self._scene.bodies[k])
            start, end = self._scene._start, self._scene._end
            row = self._rows[k] = MotionPiece(k, (pieces or [])[0][0], start, end)
        return row


def boxed_pieces_of(scene: Scene) -> ScenePieces | None:
    """The pieces of a scene; None unless all bodies move straight and none is large."""
    bodies = scene.bodies
    numbers = _of_arrays(bodies) if isinstance(bodies, BodyArrays) else _of_bodies(bodies)
    if numbers is not None:

        def outline(k: int) -> Outline:
            shape = rest_outline(bodies[k])
            assert shape is not None  # noqa: S101 - its numbers are doubles
            return shape

        boxes = PieceBoxes.of_doubles(numbers, scene._start, scene._end, outline)
        return ScenePieces(scene, boxes, None)
    rows: list[MotionPiece] = []
    origin = far_origin(scene.bodies)
    for i, body in enumerate(scene.bodies):
        ask()
        pieces = _pieces(body, origin)
        if pieces is None:
            return None
        rows += pieces_during(i, pieces, scene._start, scene._end)
    return boxed(scene, rows)


def boxed(scene: Scene, rows: list[MotionPiece]) -> ScenePieces:
    """The given pieces of a scene."""
    return ScenePieces(scene, PieceBoxes(rows), rows)


@np.errstate(all="ignore")
def _of_arrays(bodies: BodyArrays) -> Floats | None:
    """The box, c, v and radius of each body; None unless all move straight and none is large."""
    bends = bodies.coefficients[:, :, 2:].any()
    if bends or np.diff(bodies.offsets).max(initial=0) > MOST_VERTICES:
        return None
    first = native(bodies.offsets[:-1])
    numbers = np.zeros((len(bodies), 9))
    numbers[:, 0:4:2] = np.minimum.reduceat(bodies.vertices, first)
    numbers[:, 1:4:2] = np.maximum.reduceat(bodies.vertices, first)
    for k in range(min(2, bodies.coefficients.shape[2])):
        numbers[:, 4 + 2 * k : 6 + 2 * k] = bodies.coefficients[:, :, k]
    numbers[:, 8] = bodies.radii
    return numbers


def _of_bodies(bodies: Sequence[Body]) -> Floats | None:
    """The same of bodies one by one; None also if doubles are not exact."""
    numbers: list[tuple[float, ...]] = []
    for body in bodies:
        ask()
        known = _doubles_of(body)
        if known is None:
            return None
        numbers.append(known)
    return np.array(numbers).reshape(-1, 9)


def _doubles_of(body: Body) -> tuple[float, ...] | None:
    """The numbers of a body in straight motion; None unless doubles are exact."""
    doubles = body._shape.doubles
    if doubles is None or type(body.motion) is not Translation or body.size > MOST_VERTICES:
        return None
    x, y = body.motion.x._doubles, body.motion.y._doubles
    if x is None or y is None or len(x) > 2 or len(y) > 2:
        return None
    (low_x, high_x), (low_y, high_y) = ((min(f), max(f)) for f in doubles)
    (cx, vx, *_), (cy, vy, *_) = (*x, 0.0, 0.0), (*y, 0.0, 0.0)
    return (low_x, high_x, low_y, high_y, cx, cy, vx, vy, radius_above(body))


def _pieces(
    body: Body, origin: tuple[QQ, QQ] | None = None
) -> list[tuple[Straight, QQ | None]] | None:
    """Return the linear motions of a body that is not large; None of another one."""
    return None if body.size > MOST_VERTICES else straight_pieces(body, origin=origin)
