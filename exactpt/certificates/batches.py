"""Orientations of many triples at once, in numpy: the filter of linear motions."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import Final, final

import numpy as np
from numpy.typing import NDArray

from exactpt.certificates.coefficients import K
from exactpt.indices import Triple
from exactpt.kernel.rounding import SLACK
from exactpt.kernel.vectorized import Answers, quadratics
from exactpt.motion.image import Image
from exactpt.motion.vertices import Vertices

__all__ = ["linear_orientations", "linear_parts"]

BLOCK: Final = 1 << 13
"""Number of triples whose arrays are in a processor's cache together."""


@final
class _Columns:
    """What the filter needs of all vertices, by id.

    Args:
        vertices: the vertices.
        end: the end of the time span.
    """

    def __init__(self, vertices: Vertices, end: float) -> None:
        every = vertices.all
        images = [v.image for v in every]
        self.errors: list[float] = vertices.enclosures.errors
        self.nodes = np.array(vertices.nodes())
        self.horizons = np.array([min(end, v.horizon) for v in every])
        self.are_linear = np.array([i.degree <= 1 and not i.ws for i in images])
        self.motions = np.array([i.motion for i in images])
        self.values = linear_parts(images)


def linear_orientations(
    vertices: Vertices,
    triples: Sequence[Triple],
    now_low: float,
    now_high: float,
    end: float,
) -> Answers:
    """The filter's answers, up to the time ``end``, for orientations that do not vanish now.

    Unsure unless the three trajectories of a triple are different, and linear.
    """
    columns = _Columns(vertices, end)
    ids = np.fromiter(chain.from_iterable(triples), np.int64, 3 * len(triples)).reshape(-1, 3)
    blocks = [
        _orientations(columns, ids[first : first + BLOCK], now_low, now_high)
        for first in range(0, len(ids), BLOCK)
    ]
    return Answers(*(np.concatenate(parts) for parts in zip(*blocks, strict=True)))


def _orientations(
    columns: _Columns, ids: NDArray[np.int64], now_low: float, now_high: float
) -> Answers:
    a, b, c = columns.nodes[ids].T
    are_linear = columns.are_linear[ids].all(axis=1) & (a != b) & (b != c) & (c != a)
    signs, lows, highs = _linear_orientations(columns, ids, now_low, now_high)
    return Answers(np.where(are_linear, signs, 0), lows, highs)


def linear_parts(images: Sequence[Image]) -> NDArray[np.float64]:
    """The coefficients x0, y0, x1, y1 of each enclosure, one row each."""
    columns = (
        [i.x0 for i in images],
        [i.y0 for i in images],
        [i.x1 for i in images],
        [i.y1 for i in images],
    )
    return np.stack([np.array(column, dtype=np.float64) for column in columns], axis=1)


@np.errstate(all="ignore")
def _linear_orientations(
    columns: _Columns, triples: NDArray[np.int64], now_low: float, now_high: float
) -> Answers:
    """The filter's answers for many triples (rows of ids), none at a root now.

    Only the answers for linear motions are valid.

    They are computed as in `exactpt.certificates.coefficients._three`. If two vertices of a
    triple translate together they become a and b, and the higher coefficient of their
    difference is 0 without error, as in `_pair` there.
    """
    motions, values, errors = columns.motions[triples], columns.values[triples], columns.errors
    rows = np.arange(len(triples))
    together = (motions == np.roll(motions, -1, axis=1)) & (motions >= 0)
    first = np.where(together.any(axis=1), together.argmax(axis=1), 0)
    a, b, c = (values[rows, (first + i) % 3] for i in range(3))
    ux0, uy0, ux1, uy1 = (b - a).T
    vx0, vy0, vx1, vy1 = (c - a).T
    linear = together.any(axis=1)
    ux1, uy1 = np.where(linear, 0.0, ux1), np.where(linear, 0.0, uy1)
    p, q = ux0 * vy0, uy0 * vx0
    c0, e0 = p - q, K * (abs(p) + abs(q))
    p, q, r, s = ux0 * vy1, uy0 * vx1, ux1 * vy0, uy1 * vx0
    c1, e1 = p - q + r - s, K * (abs(p) + abs(q) + abs(r) + abs(s))
    p, q = ux1 * vy1, uy1 * vx1
    c2, e2 = p - q, K * (abs(p) + abs(q))
    d0, d1 = 2.0 * errors[0], 2.0 * errors[1]
    t0 = abs(ux0) + abs(uy0) + abs(vx0) + abs(vy0)
    t1 = abs(ux1) + abs(uy1) + abs(vx1) + abs(vy1)
    e0 = (e0 + d0 * (t0 + 2.0 * d0)) * SLACK
    e1 = (e1 + d1 * t0 + d0 * (t1 + 4.0 * d1)) * SLACK
    e2 = np.where(linear, 0.0, (e2 + d1 * (t1 + 2.0 * d1)) * SLACK)
    at_root = np.zeros(len(triples), dtype=np.bool_)
    horizon = columns.horizons[triples].min(axis=1)
    return quadratics(c0, c1, c2, e0, e1, e2, now_low, now_high, horizon, at_root)
