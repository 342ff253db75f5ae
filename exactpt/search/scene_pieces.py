"""The motion pieces of a scene in linear motion, with their boxes, made when they are needed.

A body becomes a piece, with the rationals and lists that exact decisions need, when it comes near
another body; until then, doubles in arrays are enough where these are exact. The box of a rounded
body is grown.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Floats, native
from exactpt.kernel.numbers import enclosing_floats
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.motion.outline import Outline, rest_outline, straight_pieces
from exactpt.scene.body_arrays import BodyArrays
from exactpt.scene.scene import Scene
from exactpt.search.boxes import PieceBoxes, radius_above
from exactpt.search.pieces import MotionPiece, ScenePieces


class _OnDemand(dict[int, MotionPiece]):
    """The piece of each body of a scene, in its single piece of motion."""

    def __init__(self, scene: Scene) -> None:
        super().__init__()
        self._scene = scene

    def __missing__(self, k: int) -> MotionPiece:
        ((straight, _),) = straight_pieces(self._scene.bodies[k]) or []
        piece = self[k] = MotionPiece(k, straight, self._scene.exact_start, self._scene.exact_end)
        return piece


def pieces_on_demand(scene: Scene, margin: float = 0.0) -> ScenePieces | None:
    """Return the pieces of a scene; None unless all are linear and exact in doubles.

    Their boxes are grown by a margin.
    """
    bodies, start, end = scene.bodies, scene.exact_start, scene.exact_end
    numbers = _of_arrays(bodies) if isinstance(bodies, BodyArrays) else _of_bodies(bodies)
    if numbers is None:
        return None
    if margin:  # a sum is rounded to a nearest double: the next one is at least the exact sum
        numbers[:, 8] = np.nextafter(numbers[:, 8] + margin, np.inf)
    numbers[:, 11], numbers[:, 12] = enclosing_floats(start)[0], enclosing_floats(end)[1]

    def outline(k: int) -> Outline:
        shape = rest_outline(bodies[k])
        assert shape is not None  # noqa: S101 - its numbers are doubles
        return shape

    boxes = PieceBoxes(np.arange(len(bodies)), numbers, outline)
    return ScenePieces(_OnDemand(scene), start, end, boxes)


@np.errstate(all="ignore")
def _of_arrays(bodies: BodyArrays) -> Floats | None:
    """Return the numbers of `PieceBoxes` but times; None unless all are linear."""
    if bodies.coefficients[:, :, 2:].any():
        return None
    first = native(bodies.offsets[:-1])
    numbers = np.zeros((len(bodies), 13))
    numbers[:, 0:4:2] = np.minimum.reduceat(bodies.vertices, first)
    numbers[:, 1:4:2] = np.maximum.reduceat(bodies.vertices, first)
    for k in range(min(2, bodies.coefficients.shape[2])):
        numbers[:, 4 + 2 * k : 6 + 2 * k] = bodies.coefficients[:, :, k]
    numbers[:, 8] = bodies.radii
    return numbers


def _of_bodies(bodies: Sequence[Body]) -> Floats | None:
    """Return the same of bodies one by one; None also if doubles are not exact."""
    numbers: list[tuple[float, ...]] = []
    for body in bodies:
        check_budget()
        known = _doubles_of(body)
        if known is None:
            return None
        numbers.append(known)
    return np.pad(np.array(numbers).reshape(-1, 9), ((0, 0), (0, 4)))


def _doubles_of(body: Body) -> tuple[float, ...] | None:
    """Return the numbers of a body in straight motion; None unless doubles are exact."""
    doubles = body.exact_shape.doubles
    if doubles is None or type(body.motion) is not Translation:
        return None
    x, y = body.motion.x.exact_doubles, body.motion.y.exact_doubles
    if x is None or y is None or len(x) > 2 or len(y) > 2:
        return None
    (low_x, high_x), (low_y, high_y) = ((min(f), max(f)) for f in doubles)
    (cx, vx, *_), (cy, vy, *_) = (*x, 0.0, 0.0), (*y, 0.0, 0.0)
    return (low_x, high_x, low_y, high_y, cx, cy, vx, vy, radius_above(body))
