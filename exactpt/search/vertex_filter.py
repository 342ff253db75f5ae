"""The float filter for two vertices in linear motion that come to a distance of each other.

Relative to the other vertex, a vertex is at z + w t. It is at distance R of it where
|z + w t|^2 - R^2 = 0, a quadratic a t^2 + 2 b t + c with a >= 0. Before the first contact of two
bodies their vertices are farther apart, so it is the smaller root. Doubles enclose that.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final, NamedTuple

from exactpt.filters.rounding import SLACK, SMALL, TINY, U
from exactpt.motion.outline import Path, Straight
from exactpt.motion.track import Incidence
from exactpt.pair.straight import Candidate

K: Final = 16.0 * U
"""Relative bound on the rounding of sums of up to eight terms, and of products of two."""


class _Range(NamedTuple):
    """Bounds of the smaller root of a quadratic."""

    low: float
    high: float


_ANY: Final = _Range(-math.inf, math.inf)


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
    a2, squared, times = wx * wx + wy * wy, distance * distance, max(abs(low), abs(high))
    a_error = K * a2 + 2.0 * e * (w_size + e)
    off = 2.0 * (a.shape.error + b.shape.error + c_error) + K * (abs(cx) + abs(cy)) + TINY
    for j, (qx, qy) in enumerate(zip(b.shape.xs, b.shape.ys, strict=True)):
        for i, (px, py) in enumerate(zip(a.shape.xs, a.shape.ys, strict=True)):
            zx, zy = (px - qx) + cx, (py - qy) + cy
            size = abs(zx) + abs(zy)
            d = off + K * size
            p, q = zx * wx, zy * wy
            z2 = zx * zx + zy * zy
            b_error = K * (abs(p) + abs(q)) + d * w_size + e * (size + 2.0 * d)
            c_bound = K * (z2 + 2.0 * squared) + 2.0 * d * (size + d) + TINY
            root = _smaller_root(a2, p + q, z2 - squared, a_error, b_error, c_bound, times)
            if root is not None and root.low <= high and root.high >= low:
                yield Candidate(root.low, root.high, Incidence(0, i, 1, -1, j))


def _smaller_root(
    a: float, b: float, c: float, a_error: float, b_error: float, c_error: float, times: float
) -> _Range | None:
    """Return bounds of the smaller root of a t^2 + 2 b t + c; None if it certainly has none.

    With errors of the coefficients, that of the discriminant D = b^2 - a c is at most
    b_error (2 |b| + b_error) + (a + a_error) c_error + |c| a_error, and rounding; the root is
    (-b - sqrt(D)) / a. Where a may be 0, no root of size ``times`` or less exists if c is larger
    than 2 |b| times that: a t^2 is not negative.
    """
    a_error, b_error, c_error = (x * SLACK + TINY for x in (a_error, b_error, c_error))
    d = b * b - a * c
    d_error = b_error * (2.0 * abs(b) + b_error) + (a + a_error) * c_error + abs(c) * a_error
    d_error = (d_error + K * (b * b + a * abs(c))) * SLACK + TINY
    if d < -d_error:
        return None
    if not a - a_error > SMALL:
        rest = (2.0 * (abs(b) + b_error) * times + c_error) * SLACK + TINY
        return None if c > rest else _ANY
    margin = b_error + K * (abs(b) + b_error)
    high_root, low_root = math.sqrt(d + d_error), math.sqrt(max(d - d_error, 0.0))
    least = -b - margin - high_root * (1.0 + K)
    most = -b + margin - low_root * (1.0 - K)
    low = least / (a + a_error if least > 0.0 else a - a_error)
    high = most / (a - a_error if most > 0.0 else a + a_error)
    low, high = low - K * abs(low) - TINY, high + K * abs(high) + TINY
    return _Range(low, high) if -math.inf < low <= high < math.inf else _ANY
