"""Oriented boxes in numpy: separating axes for long bodies whose bounding boxes overlap.

Two disjoint segments are on different sides of the line of one of them, or lie on one line. So
the axes across the two bodies separate most pairs of long thin bodies, at any angle.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Final, final

import numpy as np

from exactpt.filters.rounding import SLACK, TINY, U
from exactpt.kernel.doubles import Floats, Indices
from exactpt.motion.outline import Outline

U4: Final = 4.0 * U
K: Final = 16.0 * U
"""Relative bound on the rounding of sums of up to eight terms."""
CHUNK: Final = 1 << 13
"""Number of pairs that are compared at once, so that their numbers stay in the cache."""


@final
class OrientedBoxes:
    """Rectangles with sides in any direction around bodies that move at c + v t.

    Args:
        outlines: the vertices of the bodies at rest.
        motions: shape (7, n): c and v in x and y, bounds on the errors of a vertex and of v in each
            coordinate, and the reach of the body beyond its vertices.
    """

    def __init__(self, outlines: Iterable[Outline], motions: Floats) -> None:
        rectangles = np.array([_rectangle(outline.xs, outline.ys) for outline in outlines])
        self._columns = np.concatenate((rectangles.T, motions))

    @np.errstate(all="ignore")
    def narrow(self, i: Indices, j: Indices, low: Floats, high: Floats) -> None:
        """Narrow times to those at which the rectangles of two bodies intersect, for many pairs.

        Args:
            i: the first body of each pair.
            j: the second one.
            low: the starts of the times, increased in place.
            high: the ends, decreased; less than the starts where the rectangles are disjoint.
        """
        for k in range(0, len(i), CHUNK):
            some = slice(k, k + CHUNK)
            a, b = self._columns[:, i[some]], self._columns[:, j[some]]
            _across(a, b, low[some], high[some])
            _across(b, a, low[some], high[some])


def _rectangle(xs: list[float], ys: list[float]) -> tuple[float, ...]:
    """Return a rectangle m + s d + t n with |s| <= S, |t| <= T: m and d by x, y, S, T.

    d is a vector of doubles along the body, with ||d| - 1| < 10^-12, and n = (-dy, dx). Let e be
    p - m in doubles, for a vertex p. The exact |d|^2 s is the exact (p - m) . d, from which the
    computed e . d is off by at most 4U (|ex| + |ey|); `SLACK` covers |d|^2. The same holds for t.
    """

    def farthest(k: int) -> int:
        return max(range(len(xs)), key=lambda i: math.hypot(xs[i] - xs[k], ys[i] - ys[k]))

    def coordinates(x: float, y: float) -> tuple[list[float], list[float], float]:
        e = [(p - x, q - y) for p, q in zip(xs, ys, strict=True)]
        along, across = ([p * u + q * v for p, q in e] for u, v in ((dx, dy), (-dy, dx)))
        return along, across, sum(abs(p) + abs(q) for p, q in e)

    first = farthest(0)
    last = farthest(first)
    x, y = xs[first], ys[first]
    dx, dy = xs[last] - x, ys[last] - y
    length = math.hypot(dx, dy)
    dx, dy = (dx / length, dy / length) if length > 0.0 else (1.0, 0.0)
    if not abs(math.hypot(dx, dy) - 1.0) < 1e-13:  # underflow, overflow
        dx, dy = 1.0, 0.0
    along, across, _ = coordinates(x, y)
    s, t = 0.5 * (min(along) + max(along)), 0.5 * (min(across) + max(across))
    x, y = x + s * dx - t * dy, y + s * dy + t * dx
    along, across, size = coordinates(x, y)
    if not size < math.inf:
        return x, y, dx, dy, math.inf, math.inf
    sides = (max(map(abs, values)) for values in (along, across))
    return x, y, dx, dy, *((side + K * size) * SLACK + TINY for side in sides)


def _across(a: Floats, b: Floats, low: Floats, high: Floats) -> None:
    """Narrow times, in place, to those at which two rectangles overlap along n across the first.

    At such a time, |n . (z + w t)| <= R, where z is the difference of the m + c, w that of the v,
    and R the sum of the reaches and of the extents of the rectangles on the axis: T of the first;
    T |d . d'| + S |n . d'| of the second, of which the products are off by at most 4U + `TINY`.
    As |nx| + |ny| < 2, n . z is off by at most 2 of the errors of c, and 4U times the sum of what
    z is made of; n . w is off by 2 of the errors of v, 4U (|wx| + |wy|) and `TINY`. A double that
    is off by K of the size of n . z and of the bound is off by more than rounding below.
    """
    x, y, dx, dy, _, thin, cx, cy, vx, vy, c_error, v_error, reach = a
    mx, my, ex, ey, long, wide, ox, oy, ux, uy, c_off, v_off, far = b
    x, y, cx, cy, wx, wy = x - mx, y - my, cx - ox, cy - oy, vx - ux, vy - uy
    size = np.abs(x) + np.abs(y) + np.abs(cx) + np.abs(cy)
    at = dx * (y + cy) - dy * (x + cx)
    w = dx * wy - dy * wx
    taken = thin + np.abs(dx * ex + dy * ey) * wide + np.abs(dx * ey - dy * ex) * long
    w_error = 2.0 * (v_error + v_off) + K * (np.abs(wx) + np.abs(wy)) + TINY
    margin = taken + reach + far + K * (wide + long + size) + 2.0 * (c_error + c_off)
    margin += w_error * np.maximum(np.abs(low), np.abs(high))
    margin = (margin * SLACK + TINY) * (1.0 + K) + K * np.abs(at)
    enter, leave = times_between(-margin - at, margin - at, w)
    # fmax and fmin take the other number instead of a NaN, which excludes no time.
    np.fmax(low, enter, out=low)
    np.fmin(high, leave, out=high)


def times_between(begin: Floats, end: Floats, w: Floats) -> tuple[Floats, Floats]:
    """Return bounds of the times t with begin <= w t <= end, where begin <= end.

    The first bound is infinite without such a time, as w is 0. NaN stands for no bound.
    """
    enter, leave = begin / w, end / w
    enter, leave = np.minimum(enter, leave), np.maximum(enter, leave)
    enter -= U4 * np.abs(enter) + TINY
    leave += U4 * np.abs(leave) + TINY
    still = w == 0.0
    if still.any():
        enter[still], leave[still] = -np.inf, np.inf
        enter[still & ((begin > 0.0) | (end < 0.0))] = np.inf
    return enter, leave
