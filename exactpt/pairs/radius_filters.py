"""When two rounded bodies in straight motion touch: a float filter, then exact arithmetic.

Relative to the other body, a vertex is at z + w t. It is at distance R of a vertex at 0 where
|z + w t|^2 - R^2 = 0, and of the line through 0 and u where (u x (z + w t))^2 - R^2 |u|^2 = 0.
Both are a t^2 + 2 b t + c with a >= 0. Before their first touch T the bodies are farther apart,
so T is the smaller root for each pair of features that touch then, or they have kept their
distance, and the vertex has just come to the side of an end of the edge: then the two vertices
touch. Doubles enclose the smaller root; what may touch is decided exactly, the earliest first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final, NamedTuple

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import ask
from exactpt.kernel.numbers import QQ, nearest_float
from exactpt.kernel.roots import roots_after
from exactpt.kernel.rounding import SLACK, SMALL, TINY, U
from exactpt.motion.outline import Straight
from exactpt.pairs.features import Feature, FeaturePair
from exactpt.pairs.filters import Path, relative, window
from exactpt.pairs.rational import Span

__all__ = ["first_touch"]

U4: Final = 4.0 * U
K: Final = 16.0 * U
"""Relative bound on the rounding of sums of up to eight terms, and of products of two."""


class _Range(NamedTuple):
    """Bounds of the smaller root of a quadratic."""

    low: float
    high: float


class _Reach(NamedTuple):
    """The square of the sum of two radii, a bound of its error, and the size of all times."""

    squared: float
    error: float
    times: float


class _Candidate(NamedTuple):
    """A vertex that may touch a vertex, or the edge between two, not before ``low``."""

    low: float
    of_first: bool
    vertex: int
    others: tuple[int, ...]


_ANY: Final = _Range(-math.inf, math.inf)


def first_touch(
    a: Straight, b: Straight, span: Span, before: float = math.inf
) -> AlgebraicNumber | None:
    """The first time in (start, end] at which two rounded bodies touch; None if there is none.

    Args:
        a: a body; the box of its outline contains its points within the radius, too.
        b: another one; they do not touch at the start.
        span: the start and the end.
        before: touches certainly later than this do not count.
    """
    low, high = window(a, b, span.low, min(span.high, before))
    if low > high:
        return None
    path = relative(a, b)
    back = Path(-path.cx, -path.cy, -path.wx, -path.wy, path.c_error, path.w_error)
    reach = _reach(a, b, max(abs(low), abs(high)))
    found = [
        *_at_vertices(a, b, path, reach),
        *_at_edges(a, b, path, reach, of_first=True),
        *_at_edges(b, a, back, reach, of_first=False),
    ]
    near = sorted(candidate for candidate, last in found if candidate.low <= high and last >= low)
    return _earliest(a, b, span, near) if near else None


def _reach(a: Straight, b: Straight, times: float) -> _Reach:
    value = nearest_float(a.body._radius + b.body._radius)
    return _Reach(value * value, K * value * value + TINY, times)


def _at_vertices(
    a: Straight, b: Straight, path: Path, reach: _Reach
) -> Iterator[tuple[_Candidate, float]]:
    """The pairs of vertices that may touch, each with a time after which they do not first.

    With d and e bounds of the errors of z and w, those of the coefficients are at most
    2 e |w| + 2 e^2, d |w| + e |z| + 2 d e and 2 d |z| + 2 d^2 (and that of R^2), and rounding;
    |.| is the sum of both coordinates here.
    """
    cx, cy, wx, wy, c_error, e = path
    w_size = abs(wx) + abs(wy)
    if w_size == 0.0 == e:
        return
    a2 = wx * wx + wy * wy
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
            c_bound = K * (z2 + reach.squared) + 2.0 * d * (size + d) + reach.error
            c = z2 - reach.squared
            root = _smaller_root(a2, p + q, c, a_error, b_error, c_bound, reach.times)
            if root is not None:
                yield _Candidate(root.low, True, i, (j,)), root.high  # noqa: FBT003


def _at_edges(
    a: Straight, b: Straight, path: Path, reach: _Reach, *, of_first: bool
) -> Iterator[tuple[_Candidate, float]]:
    """The vertices of a and the edges of b that may touch, likewise.

    u x (z + w t) = c0 + c1 t is off as in `exactpt.pairs.filters`, and so is the foot.
    """
    cx, cy, wx, wy, c_error, e = path
    xs, ys = b.shape.xs, b.shape.ys
    w_size = abs(wx) + abs(wy)
    off = 2.0 * (a.shape.error + b.shape.error + c_error) + K * (abs(cx) + abs(cy)) + TINY
    for j, k in b.edges:
        if j == k:
            return
        qx, qy = xs[j], ys[j]
        ux, uy = xs[k] - qx, ys[k] - qy
        u_size, length = abs(ux) + abs(uy), ux * ux + uy * uy
        p, q = ux * wy, uy * wx
        c1 = p - q
        for i, (px, py) in enumerate(zip(a.shape.xs, a.shape.ys, strict=True)):
            zx, zy = (px - qx) + cx, (py - qy) + cy
            z_size = abs(zx) + abs(zy)
            d = off + K * z_size
            e1 = (K * (abs(p) + abs(q)) + d * w_size + e * (u_size + 2.0 * d)) * SLACK + TINY
            if c1 == 0.0 == w_size + e:
                continue
            r, s = ux * zy, uy * zx
            c0 = r - s
            e0 = (K * (abs(r) + abs(s)) + d * (u_size + z_size + 2.0 * d)) * SLACK + TINY
            longest = length * (1.0 + K) + 2.0 * d * (u_size + d)
            least = reach.squared * length
            root = _smaller_root(
                c1 * c1,
                c0 * c1,
                c0 * c0 - least,
                K * c1 * c1 + e1 * (2.0 * abs(c1) + e1),
                K * abs(c0 * c1) + abs(c0) * e1 + abs(c1) * e0 + e0 * e1,
                K * (c0 * c0 + least) + e0 * (2.0 * abs(c0) + e0)
                + reach.squared * (longest - length) + reach.error * longest,
                reach.times,
            )  # fmt: skip
            if root is None:
                continue
            t, spread = 0.5 * (root.low + root.high), 0.5 * (root.high - root.low)
            mx, my = zx + wx * t, zy + wy * t
            m_size, after = abs(mx) + abs(my), abs(t) + spread
            at = d + w_size * spread + e * after + K * (z_size + w_size * after)
            bound = (
                (at * (u_size + 2.0 * d) + d * m_size + 2.0 * d * (2.0 * u_size + d)) * SLACK
                + K * (length + m_size * u_size) + TINY
            )  # fmt: skip
            along = mx * ux + my * uy
            if not (along < -bound or along > length + bound):
                yield _Candidate(root.low, of_first, i, (j, k)), root.high


def _smaller_root(
    a: float, b: float, c: float, a_error: float, b_error: float, c_error: float, times: float
) -> _Range | None:
    """Bounds of the smaller root of a t^2 + 2 b t + c; None if it certainly has none.

    With errors of the coefficients, that of the discriminant D = b^2 - a c is at most
    b_error (2 |b| + b_error) + (a + a_error) c_error + |c| a_error, and rounding; the root is
    (-b - sqrt(D)) / a. Where a may be 0, there is no root of size ``times`` or less if c is larger
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


def _earliest(
    a: Straight, b: Straight, span: Span, candidates: list[_Candidate]
) -> AlgebraicNumber | None:
    """The earliest time in (start, end] at which a candidate touches, exactly."""
    p, q = (straight.body._piece_after(span.start).tracks for straight in (a, b))
    squared: QQ = (a.body._radius + b.body._radius) ** 2
    begin = AlgebraicNumber(span.start)
    best: AlgebraicNumber | None = None
    for low, of_first, vertex, others in candidates:
        if best is not None and low > best.enclosure()[1]:
            break
        ask()
        one, other = (p, q) if of_first else (q, p)
        pair = FeaturePair(
            (Feature(vertex, None), Feature(None, others[0])),
            one[vertex],
            tuple(other[k] for k in others),
        )
        f = pair.at_distance(squared)
        limit = span.end if best is None else min(span.end, best._high)
        for root in roots_after(f, begin, limit) if f else ():
            if pair.holds(root.time):
                best = root.time if best is None else min(best, root.time)
                break
    return best
