"""The float filter for two vertices in linear motion that come to a distance of each other.

Relative to the other vertex, a vertex is at z + w t. It is at distance R of it where
|z + w t|^2 - R^2 = 0, a quadratic a t^2 + 2 b t + c with a >= 0. Before the first contact of two
bodies their vertices are farther apart, so it is the first root. Doubles enclose that.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final, NamedTuple

from exactpt.kernel.filters import quadratic
from exactpt.kernel.rounding import SLACK, TINY, U
from exactpt.motion.incidence import Touch
from exactpt.motion.outline import Straight
from exactpt.pairs.rational import Candidate

__all__ = ["Path", "vertex_candidates"]

K: Final = 16.0 * U
"""Relative bound on the rounding of sums of up to eight terms, and of products of two."""


class Path(NamedTuple):
    """The relative motion c + w t of the vertices of one body, off by at most the errors."""

    cx: float
    cy: float
    wx: float
    wy: float
    c_error: float
    w_error: float


def vertex_candidates(
    a: Straight, b: Straight, path: Path, low: float, high: float, distance: float
) -> Iterator[Candidate]:
    """Yield the pairs of vertices that may first come to a distance of each other in [low, high].

    With d and e bounds of the errors of z and w, those of the coefficients are at most
    2 e |w| + 2 e^2, d |w| + e |z| + 2 d e and 2 d |z| + 2 d^2 (and that of R^2, K R^2 and
    `TINY`), and rounding; |.| is the sum of both coordinates here.
    """
    cx, cy, wx, wy, c_error, e = path
    w_size = abs(wx) + abs(wy)
    if w_size == 0.0 == e:
        return
    w2, squared = wx * wx + wy * wy, distance * distance
    a_error = (K * w2 + 2.0 * e * (w_size + e)) * SLACK + TINY
    off = 2.0 * (a.shape.error + b.shape.error + c_error) + K * (abs(cx) + abs(cy)) + TINY
    for j, (qx, qy) in enumerate(zip(b.shape.xs, b.shape.ys, strict=True)):
        for i, (px, py) in enumerate(zip(a.shape.xs, a.shape.ys, strict=True)):
            zx, zy = (px - qx) + cx, (py - qy) + cy
            size = abs(zx) + abs(zy)
            d = off + K * size
            p, q = zx * wx, zy * wy
            z2 = zx * zx + zy * zy
            b_error = (K * (abs(p) + abs(q)) + d * w_size + e * (size + 2.0 * d)) * SLACK + TINY
            c_error = (K * (z2 + 2.0 * squared) + 2.0 * d * (size + d)) * SLACK + TINY
            sign, first, last = quadratic(
                z2 - squared, 2.0 * (p + q), w2, c_error, 2.0 * b_error, a_error,
                low, low, high, at_root=False,
            )  # fmt: skip
            if first <= high or not sign:
                times = (first, last) if sign else (low, math.inf)
                yield Candidate(*times, Touch(0, i, 1, -1, j))
