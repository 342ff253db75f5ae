"""The float filter for two bodies in linear motion: the candidates of their first contact.

Relative to the second body, a vertex of the first one is at z + w t, with the same w for all.
Its orientation with an edge from q to q + u, u x (z - q) + t u x w, is linear in t: so the time
at which it can lie on the edge is rational. A float filter rules out most pairs of a vertex and
an edge; the others are decided exactly, the earliest first.

All incidences at the first contact T, before which the bodies are disjoint, are found in this
way. A vertex inside an edge at T does not move along that edge's line, or it would have been on
the edge just before; so T is the one zero of its orientation. Let two vertices coincide at T.
If w is not parallel to one of the edges at one of them, T is the zero for that edge. Otherwise
take an edge at one of them: the other end moves along its line, and does not come along the
edge, so it enters the edge at T, at that end. `exactpt.pair.straight` finds both. (The edge
of a point is a single point, with the orientation 0.)

Bodies with radii touch where the distance of their cores is R, the sum of the radii. The vertex is
at distance R of the edge's line where |c0 + c1 t| = h = R |u|. Before the first contact T the cores
are farther apart, so T is the smaller root, that of (c0 + sgn(c1) h) + c1 t: the same equation,
with another constant. All features that come to distance R at T are found in this way, and by
`exactpt.search.vertex_filter` for two vertices: a vertex whose foot is inside an edge at T, at a
distance that is constant, was as near just before T; so the distance is not constant.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

from exactpt.filters.rounding import SLACK, SMALL, TINY, U
from exactpt.motion.outline import Outline, Path, Straight
from exactpt.motion.track import Incidence
from exactpt.pair.straight import Candidate, Span

U2: Final = 2.0 * U
U4: Final = 4.0 * U
K: Final = 16.0 * U
"""Relative bound on the rounding of sums of up to eight terms, and of products of two."""
FEW: Final = 24
"""Maximum number of pairs of a vertex and an edge that are all tested."""


class _Limits(NamedTuple):
    """Bounds of the times to consider, and a double not before the start of the span."""

    low: float
    high: float
    after: float


def candidates_of(
    a: Straight, b: Straight, span: Span, before: float = math.inf, distance: float = 0.0
) -> list[Candidate]:
    """Return the incidences that may be the first in (start, end], in the order of ``low``.

    Args:
        a: a body.
        b: another body; the cores of the two are farther apart than the distance at the start.
        span: the start and the end.
        before: contacts certainly later than this do not count.
        distance: the contact distance, off by at most U of it and `TINY`; 0 only if it is 0.
    """
    path = relative(a, b)
    low, high = _window(a.shape, b.shape, path, span.low, min(span.high, before), distance)
    if low > high:
        return []
    back = Path(-path.cx, -path.cy, -path.wx, -path.wy, path.c_error, path.w_error)
    candidates: list[Candidate] = []
    limits = _Limits(low, high, span.after)
    high = _collect(a, b, path, limits, candidates, distance, 0)
    limits = _Limits(low, high, span.after)
    high = _collect(b, a, back, limits, candidates, distance, 1)
    candidates = [candidate for candidate in candidates if candidate.low <= high]
    if distance:
        from exactpt.search.vertex_filter import vertex_candidates

        candidates += vertex_candidates(a, b, path, low, high, distance)
    candidates.sort()
    return candidates


def window(
    a: Straight, b: Straight, low: float, high: float, distance: float = 0.0
) -> tuple[float, float]:
    """Return bounds of the times in [low, high] at which two boxes are within a distance.

    The distance is the larger of those in x and in y. If the boxes are never within it, the first
    bound is larger than the second.
    """
    return _window(a.shape, b.shape, relative(a, b), low, high, distance)


def relative(a: Straight, b: Straight) -> Path:
    """Return the motion of a relative to b."""
    cx, cy, wx, wy = a.cx - b.cx, a.cy - b.cy, a.vx - b.vx, a.vy - b.vy
    return Path(
        cx,
        cy,
        wx,
        wy,
        a.c_error + b.c_error + U2 * (abs(cx) + abs(cy)),
        a.v_error + b.v_error + U2 * (abs(wx) + abs(wy)),
    )


def _window(
    a: Outline, b: Outline, path: Path, low: float, high: float, distance: float
) -> tuple[float, float]:
    """Return the bounds of `window`.

    Along x this means b.low_x - a.high_x - R <= c + w t <= b.high_x - a.low_x + R. Both ends are
    moved outward by the errors of the coordinates, of c, of w t and of R, and by the rounding of
    the numerators below; `U4` is for the quotient. A NaN excludes no time.
    """
    cx, cy, wx, wy, c_error, w_error = path
    off = (a.error + b.error + c_error + w_error * max(abs(low), abs(high))) * SLACK + TINY
    for c, w, least, most in (
        (cx, wx, b.low_x - a.high_x, b.high_x - a.low_x),
        (cy, wy, b.low_y - a.high_y, b.high_y - a.low_y),
    ):
        margin = 2.0 * off + K * (abs(c) + abs(least) + abs(most) + distance)
        first, last = least - distance - margin - c, most + distance + margin - c
        if w == 0.0:
            if first > 0.0 or last < 0.0:
                return 1.0, 0.0
            continue
        enter, leave = (first / w, last / w) if w > 0.0 else (last / w, first / w)
        low = max(low, enter - U4 * abs(enter) - TINY)
        high = min(high, leave + U4 * abs(leave) + TINY)
    return low, high


def _collect(
    a: Straight,
    b: Straight,
    path: Path,
    limits: _Limits,
    candidates: list[Candidate],
    distance: float,
    one: int,
) -> float:
    """Add the pairs of a vertex of a and an edge of b that may touch between the limits.

    Let d bound the error of z = (p - q) + c and, its rounding aside, of u. The errors of the
    coefficients of the orientation c0 + c1 t are at most
        e0 = K (|ux| |zy| + |uy| |zx|) + d (|ux| + |uy| + |zx| + |zy| + 2 d),
        e1 = K (|ux| |wy| + |uy| |wx|) + d (|wx| + |wy|) + w_error (|ux| + |uy| + 2 d),
    and that of its zero is bounded as in `exactpt.certificates.first_root.linear`. At that time,
    known up to r, the vertex is at m = z + w t, off by at most
        s = d + |w| r + w_error (|t| + r) + K (|z| + |w t|);
    m . u is off by s (|ux| + |uy| + 2 d) + d (|mx| + |my|) and its rounding, and u . u by
    2 d (|ux| + |uy|) + 2 d^2 and its rounding. The vertex is on the edge, or its foot is, if
    0 <= m . u <= u . u.

    With a distance R, the constant is c0 + sgn(c1) h; the sign is known where a root is computed.
    R, |u| and their product in doubles are off by at most 5 U of h, and by `TINY` |u| where R
    is not normal; |u| itself by 2 d, as both ends of the edge by d; the sum by U (|c0| + h), of
    which the first part is in e0, whose terms are 3 U of |ux zy| and |uy zx|. So the bound is
        e0 + K h + 2 R d + TINY (|ux| + |uy|),
    and 0.0 is added everywhere if R is 0.

    Returns:
        The upper limit, or a time up to which one of the pairs certainly touches.
    """
    cx, cy, wx, wy, c_error, w_error = path
    low, high, after = limits
    xs, ys = b.shape.xs, b.shape.ys
    vertices, edges = _near(a, b, path, limits, distance)
    times = max(abs(low), abs(high))
    off = 2.0 * (a.shape.error + b.shape.error + c_error) + K * (abs(cx) + abs(cy)) + TINY
    w_size = abs(wx) + abs(wy)
    for number, i, j in edges:
        if i == j and distance:
            continue  # a point: two vertices
        qx, qy = xs[i], ys[i]
        ux, uy = xs[j] - qx, ys[j] - qy
        u_size, length = abs(ux) + abs(uy), ux * ux + uy * uy
        p, q = ux * wy, uy * wx
        c1 = p - q
        h = h_error = twice = 0.0
        if distance:
            h, twice = distance * math.hypot(ux, uy), 2.0 * distance
            h_error = K * h + TINY * u_size
        for vertex, px, py in vertices:
            zx, zy = (px - qx) + cx, (py - qy) + cy
            z_size = abs(zx) + abs(zy)
            d = off + K * z_size
            e1 = (K * (abs(p) + abs(q)) + d * w_size + w_error * (u_size + 2.0 * d)) * SLACK + TINY
            r, s = ux * zy, uy * zx
            c0 = r - s
            e0 = (K * (abs(r) + abs(s)) + d * (u_size + z_size + 2.0 * d)) * SLACK + TINY
            if distance:
                e0 += h_error + twice * d
            gap = abs(c1) - e1
            if not gap > SMALL:
                if not abs(c0) - h > (e0 + (abs(c1) + e1) * times) * SLACK + TINY:
                    touch = Incidence(one, vertex, 1 - one, number, -1)
                    candidates.append(Candidate(low, math.inf, touch))
                continue
            time = -(c0 + h if c1 > 0.0 else c0 - h) / c1
            size = abs(time)
            error = ((e0 + e1 * size) / gap + U4 * size) * SLACK + TINY
            first, last = time - error, time + error
            if first > high or last < low:
                continue
            mx, my = zx + wx * time, zy + wy * time
            along, m_size = mx * ux + my * uy, abs(mx) + abs(my)
            at = d + w_size * error + w_error * (size + error) + K * (z_size + w_size * size)
            bound = (
                (at * (u_size + 2.0 * d) + d * m_size + 2.0 * d * (2.0 * u_size + d)) * SLACK
                + K * (length + m_size * u_size) + TINY
            )  # fmt: skip
            if along < -bound or along > length + bound:
                continue
            if not error < math.inf:
                first, last = low, math.inf
            elif bound < along < length - bound and first > after:
                high = min(high, last)
            candidates.append(Candidate(first, last, Incidence(one, vertex, 1 - one, number, -1)))
    return high


def _near(
    a: Straight, b: Straight, path: Path, limits: _Limits, distance: float
) -> tuple[list[tuple[int, float, float]], list[tuple[int, int, int]]]:
    """Return the vertices of a, with their coordinates c + p, and the edges of b that may touch.

    A vertex moves by a displacement between two bounds; it must come into the box of b, and
    the box of a to the edge, or within the distance of them.
    """
    of_a, of_b = a.shape, b.shape
    vertices = list(zip(range(len(of_a.xs)), of_a.xs, of_a.ys, strict=True))
    edges = [(number, i, j) for number, (i, j) in enumerate(b.edges)]
    if len(vertices) * len(edges) <= FEW:
        return vertices, edges
    off = of_a.error + of_b.error + path.c_error
    of_x = max(abs(of_b.low_x), abs(of_b.high_x), abs(of_a.low_x), abs(of_a.high_x))
    of_y = max(abs(of_b.low_y), abs(of_b.high_y), abs(of_a.low_y), abs(of_a.high_y))
    least_x, most_x = _displacement(path.cx, path.wx, path.w_error, limits, off, of_x, distance)
    least_y, most_y = _displacement(path.cy, path.wy, path.w_error, limits, off, of_y, distance)
    low_x, high_x = of_b.low_x - most_x, of_b.high_x - least_x
    low_y, high_y = of_b.low_y - most_y, of_b.high_y - least_y
    met = [
        v for v in vertices if not (v[1] < low_x or v[1] > high_x or v[2] < low_y or v[2] > high_y)
    ]
    low_x, high_x = of_a.low_x + least_x, of_a.high_x + most_x
    low_y, high_y = of_a.low_y + least_y, of_a.high_y + most_y
    xs, ys = of_b.xs, of_b.ys
    crossed = [
        (number, i, j)
        for number, i, j in edges
        if not (
            (xs[i] < low_x and xs[j] < low_x)
            or (xs[i] > high_x and xs[j] > high_x)
            or (ys[i] < low_y and ys[j] < low_y)
            or (ys[i] > high_y and ys[j] > high_y)
        )
    ]
    return met, crossed


def _displacement(
    c: float, w: float, w_error: float, limits: _Limits, off: float, size: float, distance: float
) -> tuple[float, float]:
    """Return bounds of c + w t, moved outward by the distance and the errors of coordinates.

    The coordinates are of the given size at most.
    """
    times = max(abs(limits.low), abs(limits.high))
    size += distance
    margin = 2.0 * (off + w_error * times) + K * (abs(c) + abs(w) * times + size) + TINY
    margin += distance
    ends = c + w * limits.low, c + w * limits.high
    return min(ends) - margin, max(ends) + margin
