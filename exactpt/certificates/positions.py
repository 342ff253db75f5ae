"""Positions of vertices now, in doubles with proven bounds, cached until time advances."""

from __future__ import annotations

from typing import Final, final

import numpy as np

from exactpt.filters.rounding import INFINITY, SLACK, SMALL, TINY, U
from exactpt.indices import VertexId
from exactpt.kernel.doubles import Floats, view
from exactpt.motion.float_track import FloatTrack
from exactpt.motion.vertex import Vertex
from exactpt.motion.vertices import HORIZON, MOTION, OTHER_MOTION, WIDTH, Vertices

K: Final = 8.0 * U
"""Relative bound on the rounding of a 2 x 2 determinant of differences; see
`exactpt.certificates.coefficients`."""


@np.errstate(all="ignore")
def positions_at(vertices: Vertices, low: float, high: float) -> tuple[Floats, Floats, float]:
    """x and y of all vertices at a time given by its enclosure, and one bound on all errors.

    Coordinates without a bound are NaN. Trajectories of degree 1 are evaluated in numpy, by
    the formula of `Positions` (at the time 0 itself nothing is rounded).
    """
    errors = vertices.enclosures.errors
    places = view(vertices.places).reshape(-1, WIDTH)
    x0, y0, x1, y1 = places[:, :HORIZON].T
    if low == high == 0.0:
        x, y, error = x0.copy(), y0.copy(), np.full(len(places), errors[0])
    else:
        m, r = 0.5 * (low + high), high - low
        reach = abs(m) + r
        slope = np.maximum(abs(x1), abs(y1))
        bound = slope * reach + np.maximum(abs(x0), abs(y0))
        x, y = x1 * m + x0, y1 * m + y0
        of_image = errors[0] + errors[1] * reach
        error = (16.0 * U * bound + of_image + r * slope) * SLACK + TINY
    single = Positions(vertices)
    single.move_to(low, high)
    for k in np.flatnonzero(places[:, MOTION] == OTHER_MOTION).tolist():
        vertex = vertices.all[VertexId(k)]
        if vertex.float_track.degree > 1 or vertex.float_track.ws:
            single.find(vertex)
            x[k], y[k], error[k] = vertex.x, vertex.y, vertex.error
    unknown = ~(np.isfinite(x) & np.isfinite(y) & np.isfinite(error))
    x[unknown] = y[unknown] = np.nan
    return x, y, float(np.max(error[~unknown], initial=0.0))


@final
class Positions:
    """Normalised positions at the current time, which is given by its enclosure.

    Args:
        vertices: the vertices.
    """

    def __init__(self, vertices: Vertices) -> None:
        self._vertices: Vertices = vertices
        self._errors: list[float] = vertices.enclosures.errors
        self._middle: float = 0.0
        self._width: float = 0.0
        self._now: object = object()

    def move_to(self, low: float, high: float) -> None:
        """Set the enclosure [low, high] of the current time."""
        self._middle, self._width = 0.5 * (low + high), high - low
        self._now = object()

    def find(self, vertex: Vertex) -> None:
        """Set ``x``, ``y`` and ``error`` of a vertex to its position now and an error bound.

        The bound is infinite if there is none. A vertex that enters another piece of its
        motion at the current time keeps its position, so the cached one stays valid.
        """
        if vertex.seen is not self._now:
            places, at = self._vertices.places, WIDTH * vertex.id
            if places[at + MOTION] == OTHER_MOTION and (
                vertex.float_track.degree > 1 or vertex.float_track.ws
            ):
                self._find_any(vertex, vertex.float_track)
            else:
                vertex.x, vertex.y, vertex.error = linear_position(
                    places[at],
                    places[at + 1],
                    places[at + 2],
                    places[at + 3],
                    self._middle,
                    self._width,
                    self._errors[0],
                    self._errors[1],
                )
            vertex.seen = self._now

    def _find_any(self, vertex: Vertex, float_track: FloatTrack) -> None:
        x, dx = self._value(float_track.xs)
        y, dy = self._value(float_track.ys)
        if float_track.ws:
            w, dw = self._value(float_track.ws)
            x, dx = _quotient(x, dx, w, dw)
            y, dy = _quotient(y, dy, w, dw)
        vertex.x, vertex.y, vertex.error = x, y, min(INFINITY, max(dx, dy))

    def orientation(self, a: Vertex, b: Vertex, c: Vertex) -> int:
        """Return the sign of the orientation now, or 0 if it is not certain.

        With errors of the coordinates of at most da, db, dc, those of the differences
        u = b - a, v = c - a are at most du = da + db, dv = da + dc plus their own rounding,
        and that of their determinant is at most du (|vx| + |vy|) + dv (|ux| + |uy|) +
        2 du dv.
        """
        now = self._now  # `find` checks this too, but most positions are cached
        if a.seen is not now:
            self.find(a)
        if b.seen is not now:
            self.find(b)
        if c.seen is not now:
            self.find(c)
        x, y, d = a.x, a.y, a.error
        return cross_sign(b.x - x, b.y - y, d + b.error, c.x - x, c.y - y, d + c.error)

    def cross_sign(self, a: Vertex, b: Vertex, c: Vertex, d: Vertex) -> int:
        """Return the sign of (b - a) x (d - c) now, or 0 if it is not certain."""
        self.find(a)
        self.find(b)
        self.find(c)
        self.find(d)
        du, dv = a.error + b.error, c.error + d.error
        return cross_sign(b.x - a.x, b.y - a.y, du, d.x - c.x, d.y - c.y, dv)

    def order(self, a: Vertex, b: Vertex, axis: int) -> int:
        """Return the sign of x(b) - x(a) (axis 0) or y(b) - y(a) (axis 1) now; 0 if undecided."""
        self.find(a)
        self.find(b)
        difference = b.y - a.y if axis else b.x - a.x
        bound = a.error + b.error + K * abs(difference)
        return 1 if difference > bound else -1 if difference < -bound else 0

    def _value(self, cs: list[float]) -> tuple[float, float]:
        """Return the value of a polynomial now, and a bound on its error anywhere in [low, high].

        Horner's rule at the middle m of the enclosure, with errors of the coefficients of at
        most errors[i] (and one unit), has an error of sum((4n + 8) u |c_i| + errors[i]) |m|^i;
        within the enclosure, of width r, the value changes by less than
        r sum(i |c_i| T^(i-1)), T = |m| + r. Any underflow is far below TINY.
        """
        errors = self._errors
        m, r = self._middle, self._width
        reach = abs(m) + r
        value, bound, slope, error = 0.0, 0.0, 0.0, 0.0
        for i in range(len(cs) - 1, -1, -1):
            slope = slope * reach + bound
            value = value * m + cs[i]
            bound = bound * reach + abs(cs[i])
            error = error * reach + errors[i]
        unit = (4 * len(cs) + 8) * U
        return value, (unit * bound + error + r * slope) * SLACK + TINY


def linear_position(
    x0: float, y0: float, x1: float, y1: float, m: float, r: float, error0: float, error1: float
) -> tuple[float, float, float]:
    """Return x and y of a vertex in linear translation, and a bound on the errors of both.

    The errors of the coefficients x0, y0, and x1, y1, are at most error0, and error1; m is the
    middle of the enclosure of the time, and r its width. The formula is `Positions._value`.
    """
    reach = abs(m) + r
    start, start_y, slope, slope_y = abs(x0), abs(y0), abs(x1), abs(y1)
    if start_y > start:  # noqa: PLR1730 - `max` is a call in plain Python
        start = start_y
    if slope_y > slope:  # noqa: PLR1730
        slope = slope_y
    error = 16.0 * U * (slope * reach + start) + (error0 + error1 * reach) + r * slope
    error = error * SLACK + TINY
    return x1 * m + x0, y1 * m + y0, min(INFINITY, error)


def _quotient(x: float, dx: float, w: float, dw: float) -> tuple[float, float]:
    """x / w for w > 0, and a bound on its error.

    |(x + d) / (w + e) - x / w| <= (|d| + |x / w| |e|) / (w - |e|).
    """
    if not (w > 2.0 * dw and w > SMALL):
        return 0.0, INFINITY
    q = x / w
    return q, ((dx + abs(q) * dw) / (w - dw) + 4.0 * U * abs(q)) * SLACK + TINY


def cross_sign(ux: float, uy: float, du: float, vx: float, vy: float, dv: float) -> int:
    """Return the sign of u x v, or 0 if it is not certain.

    u and v are rounded differences, with errors of at most du and dv in each coordinate
    besides that rounding.
    """
    p, q = ux * vy, uy * vx
    det = p - q
    bound = (
        K * (abs(p) + abs(q)) + du * (abs(vx) + abs(vy)) + dv * (abs(ux) + abs(uy) + 2.0 * du)
    ) * SLACK + TINY
    return 1 if det > bound else -1 if det < -bound else 0
