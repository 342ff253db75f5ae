"""The first time in a window at which a vertex may touch an edge or another vertex.

Time runs as s in [-1, 1]. With models of all vertices (`exactpt.filters.windows`), z = v - a from
an end of the edge to the vertex and u = b - a along the edge are quadratics in s:

                   v
                 . |
              z .  | f / |u|           f = u x z = ux zy - uy zx    is the orientation
               .   |
              a----+------->b          0 <= z . u <= u . u          if the foot is on the edge
                 foot   u

So f is of degree 4. There are three questions, each a zero of such a polynomial:

* the vertex is on the edge: f = 0, and the foot is on the edge;
* it is at the distance R of the edge: f = R |u| or f = -R |u|, and the foot is on the edge;
* two vertices are at the distance R: z . z - R^2 = 0. There is no foot.

Errors. |z| is the sum of the sizes of all six coefficients of z. A coefficient of z is a
difference of two rows: off by U of it. Let dz be the error of z in x and in y: the sum of two rho,
and 2 U |z|. Likewise for u. Then u x z is off by at most

    |u| dz + |z| du + 2 du dz + 16 U |u| |z|    for all s in [-1, 1].

The last term is rounding: a coefficient of f is a sum of at most six products, each of which goes
through 4 operations, and the sizes of all products in all coefficients add up to at most |u| |z|.

* In a rigid piece |u| is constant, and within 2 du of |u(0)|. Otherwise |u(s)| is within
  |u1| + |u2| + 2 du of it, with |u1| the sum of the sizes in x and in y. Times R this is an error
  of f.
* R is a sum of two radii, each larger by at most 2 U of it (`Table.radius`). Were they off by 5 U,
  and R by 6 U, R |u(0)| would be off by at most 9 U of it with the operations that follow, and R^2
  by 14 U. Both are in a term of 16 U.
* z . z is off by at most 2 |z| dz + 2 dz^2, and by 16 U (|z|^2 + R^2) for rounding.

Underflow: rho, and so dz and du, are at least `TINY`, which covers it.

What is excluded is certain: a part of a window is excluded by positive tests alone, which a NaN
fails.
"""

from math import sqrt
from typing import Final

from librt.vecs import vec
from mypy_extensions import i64

from exactpt.filters.models import ROUNDING
from exactpt.filters.rounding import INFINITY, SLACK, TINY, U2, U4, U8
from exactpt.filters.windows import ROW, X0, X1, X2, Y0, Y1, Y2

NONE: Final[i64] = 0
"""There is certainly no zero."""
MAYBE: Final[i64] = 1
"""There may be one, in [low, high] first."""
SURE: Final[i64] = 2
"""There certainly is one, in [low, high] first."""
OPEN: Final[i64] = 3
"""A part must be halved to say more."""

EVALUATION: Final = 4.0 * ROUNDING
"""Error of a polynomial and its derivatives, relative to the sum of its coefficients."""
MOST_STEPS: Final[i64] = 400
NARROWEST: Final = 2.0**-38
"""Width at which parts are halved no more: a double zero of error U is about as wide."""
NARROWINGS: Final[i64] = 6
POINT: Final = 1e-14
"""Width of a zero that no step makes much narrower."""


class Vector:
    """The difference of two vertices in a window: x0 + x1 s + x2 s^2 and y0 + y1 s + y2 s^2.

    Attributes:
        x0, ..., y2: the coefficients, as computed.
        size: the sum of their sizes.
        way: a bound of the speed in x and in y: of the derivatives in [-1, 1].
        off: bounds the error of x and of y in [-1, 1].
    """

    def __init__(self) -> None:
        self.x0 = 0.0
        self.x1 = 0.0
        self.x2 = 0.0
        self.y0 = 0.0
        self.y1 = 0.0
        self.y2 = 0.0
        self.size = 0.0
        self.way = 0.0
        self.off = 0.0

    def set(self, p: vec[float], v: i64, q: vec[float], a: i64, rho: float) -> None:
        """Set the vector from vertex a of q to vertex v of p.

        Args:
            p: rows of a window.
            v: the number of a vertex there.
            q: rows of a window.
            a: the number of a vertex there.
            rho: the sum of the errors of both.
        """
        i, j = ROW * v, ROW * a
        x0, x1, x2 = p[i + X0] - q[j + X0], p[i + X1] - q[j + X1], p[i + X2] - q[j + X2]
        y0, y1, y2 = p[i + Y0] - q[j + Y0], p[i + Y1] - q[j + Y1], p[i + Y2] - q[j + Y2]
        self.x0, self.x1, self.x2 = x0, x1, x2
        self.y0, self.y1, self.y2 = y0, y1, y2
        self.size = abs(x0) + abs(x1) + abs(x2) + abs(y0) + abs(y1) + abs(y2)
        self.way = max(abs(x1) + 2.0 * abs(x2), abs(y1) + 2.0 * abs(y2))
        self.off = rho + U2 * self.size

    def is_far(self, distance: float) -> bool:
        """Return True if x or y is certainly larger than a distance during the window."""
        d = (distance + self.off + ROUNDING * self.size) * SLACK + TINY
        x_way, y_way = abs(self.x1) + abs(self.x2), abs(self.y1) + abs(self.y2)
        return abs(self.x0) > x_way + d or abs(self.y0) > y_way + d


class Zero:
    """The search for the first zero of a pair of features in a window.

    Attributes:
        z, u: the vectors to the vertex and along the edge.
        f0, ..., f4: the coefficients of a polynomial in s.
        error: bounds the difference from the true function in [-1, 1].
        has_foot: whether the foot must be on the edge.
        low, high: where a zero may be first: the result of `find`.
    """

    def __init__(self) -> None:
        self.z = Vector()
        self.u = Vector()
        self.f0 = 0.0
        self.f1 = 0.0
        self.f2 = 0.0
        self.f3 = 0.0
        self.f4 = 0.0
        self.error = 0.0
        self.has_foot = False
        self.low = -1.0
        self.high = 1.0

    def orientation(self) -> None:
        """Set f = u x z."""
        z, u = self.z, self.u
        zx0, zx1, zx2, zy0, zy1, zy2 = z.x0, z.x1, z.x2, z.y0, z.y1, z.y2
        ux0, ux1, ux2, uy0, uy1, uy2 = u.x0, u.x1, u.x2, u.y0, u.y1, u.y2
        self.f0 = ux0 * zy0 - uy0 * zx0
        self.f1 = (ux0 * zy1 - uy0 * zx1) + (ux1 * zy0 - uy1 * zx0)
        self.f2 = (ux0 * zy2 - uy0 * zx2) + (ux1 * zy1 - uy1 * zx1) + (ux2 * zy0 - uy2 * zx0)
        self.f3 = (ux1 * zy2 - uy1 * zx2) + (ux2 * zy1 - uy2 * zx1)
        self.f4 = ux2 * zy2 - uy2 * zx2
        off = u.size * z.off + z.size * u.off + 2.0 * u.off * z.off
        self.error = (off + ROUNDING * u.size * z.size) * SLACK + TINY
        self.has_foot = True

    def subtract_length(self, distance: float, *, is_rigid: bool) -> None:
        """Subtract distance |u| from f; add it if the distance is negative.

        Args:
            distance: the distance R, or -R.
            is_rigid: whether |u| is constant.
        """
        u = self.u
        length = sqrt(u.x0 * u.x0 + u.y0 * u.y0)
        change = 0.0 if is_rigid else abs(u.x1) + abs(u.x2) + abs(u.y1) + abs(u.y2)
        off = 2.0 * u.off + change + ROUNDING * length
        before = self.f0
        self.f0 = before - distance * length
        rounding = U2 * (abs(before) + abs(distance) * length)
        self.error = (self.error + abs(distance) * off + rounding) * SLACK

    def squared_distance(self, distance: float) -> None:
        """Set f = z . z - distance^2."""
        z = self.z
        x0, x1, x2, y0, y1, y2 = z.x0, z.x1, z.x2, z.y0, z.y1, z.y2
        square = distance * distance
        self.f0 = (x0 * x0 + y0 * y0) - square
        self.f1 = 2.0 * (x0 * x1 + y0 * y1)
        self.f2 = 2.0 * (x0 * x2 + y0 * y2) + (x1 * x1 + y1 * y1)
        self.f3 = 2.0 * (x1 * x2 + y1 * y2)
        self.f4 = x2 * x2 + y2 * y2
        off = 2.0 * z.size * z.off + 2.0 * z.off * z.off
        self.error = (off + ROUNDING * (z.size * z.size + square)) * SLACK + TINY
        self.has_foot = False

    def find(self) -> i64:
        """Find the first part of [-1, 1] in which f may vanish, with the foot on the edge.

        Parts of [-1, 1] are looked at from left to right, and halved if that does not say enough.

        Rounding. f and its Taylor coefficients g1, ..., g4 are evaluated at m for s in [m - r, m +
        r], inside [-1, 1]. All terms of g_k r^k that come from f_i add up to |f_i| (|m| + r)^i <=
        |f_i|. Each goes through at most 8 operations. The bound of the slope has it k <= 4 times.
        So all evaluations are off by at most 8 U (1 + 4) (|f_0| + ... + |f_4|) together; 64 U of
        that sum is added to the error.

        Returns:
            `NONE`, `MAYBE`, or `SURE`: f changes its sign in [low, high], and the foot is inside.
        """
        rest = abs(self.f1) + abs(self.f2) + abs(self.f3) + abs(self.f4)
        if abs(self.f0) > (rest + self.error) * SLACK:
            return NONE
        error = (self.error + EVALUATION * (abs(self.f0) + rest)) * SLACK
        if not error < INFINITY:
            self.low, self.high = -1.0, 1.0
            return MAYBE
        low, width = -1.0, 2.0  # the part to look at
        steps: i64 = 0
        while low < 1.0:
            state = self._look(low, width, error)
            if state in (MAYBE, SURE):
                return state
            steps += 1
            if state == NONE:
                low, width = following(low, width)
            elif steps < MOST_STEPS and width > NARROWEST:
                width *= 0.5
            else:
                self.low, self.high = low, low + width
                return MAYBE
        return NONE

    def _look(self, low: float, width: float, error: float) -> i64:
        """Look for the first zero in [low, low + width].

        |f(s) - f(m)| <= |g1| r + |g2| r^2 + |g3| r^3 + |g4| r^4, for the middle m and half the
        width r. The slope differs from g1 by at most 2 |g2| r + 3 |g3| r^2 + 4 |g4| r^3. If that
        is less than |g1|, f is monotone, and a step of Newton with this bound says where it may
        vanish (`narrow`).

        Returns:
            `NONE`, `MAYBE`, `SURE` or `OPEN`.
        """
        r = 0.5 * width
        m = low + r
        f, g1, g2, g3 = self.taylor(m)
        g4 = self.f4
        spread = (abs(g1) + (abs(g2) + (abs(g3) + abs(g4) * r) * r) * r) * r
        if abs(f) > (spread + error) * SLACK:
            return NONE
        if self.has_foot and self.foot(m, r) == NONE:
            return NONE
        change = (2.0 * abs(g2) + (3.0 * abs(g3) + 4.0 * abs(g4) * r) * r) * r
        least = abs(g1) - change * SLACK
        if not least > 0.0:
            return OPEN
        root = m - f / g1
        off = (error + change * r) / least * SLACK + U8
        begin, end = max(low, root - off), min(low + width, root + off)
        if begin > end:
            return NONE
        if off < 0.125 * width or off < POINT:
            return self._narrow(begin, end, error)
        return OPEN

    def _narrow(self, low: float, high: float, error: float) -> i64:
        """Narrow an interval in which f is monotone, so that it vanishes once, if at all.

        A zero s has f(m) + (s - m) g = 0 for a slope g within ``change`` of g1, but for the error.
        So

            |s - (m - f(m) / g1)| <= (error + change r) / |g1|,

        with the rounding of f(m) and g1 in the error. So |f(m) / g1| is at most r and this bound,
        and the rounding of m - f(m) / g1 is within 8 U.
        """
        k: i64 = 0
        while k < NARROWINGS:
            k += 1
            m, r = middle_of(low, high)
            f, g1, g2, g3 = self.taylor(m)
            change = (2.0 * abs(g2) + (3.0 * abs(g3) + 4.0 * abs(self.f4) * r) * r) * r
            least = abs(g1) - change * SLACK
            if not least > 0.0:
                break
            root = m - f / g1
            off = (error + change * r) / least * SLACK + U8
            begin, end = max(low, root - off), min(high, root + off)
            if begin > end:
                return NONE
            width = high - low
            low, high = begin, end
            if not end - begin < 0.5 * width:
                break
        self.low, self.high = low, high
        if self.has_foot:
            m, r = middle_of(low, high)
            if self.foot(m, r) == NONE:
                return NONE
        if self._vanishes(low, high, error):
            return SURE
        # at the ends f may be within its error; a little outside it is not, unless it is flat
        more = 4.0 * (high - low) + 16.0 * U2
        if self._vanishes(low - more, high + more, error):
            self.high = high + more  # not self.low: before low there is none
            return SURE
        return MAYBE

    def _vanishes(self, low: float, high: float, error: float) -> bool:
        """Return True if f certainly changes its sign in [low, high], with the foot on the edge."""
        if not (low >= -1.0 and high <= 1.0):
            return False
        before, after = self.taylor(low)[0], self.taylor(high)[0]
        if not (abs(before) > error and abs(after) > error):
            return False
        if (before > 0.0) == (after > 0.0):
            return False
        if not self.has_foot:
            return True
        m, r = middle_of(low, high)
        return self.foot(m, r) == SURE

    def taylor(self, m: float) -> tuple[float, float, float, float]:
        """Return f, f', f'' / 2, f''' / 6 at m."""
        f1, f2, f3, f4 = self.f1, self.f2, self.f3, self.f4
        value = self.f0 + m * (f1 + m * (f2 + m * (f3 + m * f4)))
        slope = f1 + m * (2.0 * f2 + m * (3.0 * f3 + m * 4.0 * f4))
        bend = f2 + m * (3.0 * f3 + m * 6.0 * f4)
        return value, slope, bend, f3 + 4.0 * m * f4

    def foot(self, m: float, r: float) -> i64:
        """Return whether the foot of the vertex is on the edge during [m - r, m + r].

        In x and in y, z is off z(m) by at most dz: its way in the time r, its error, and the
        rounding of z(m), which goes through 5 operations; likewise u. Then z . u is off by at most
        |z| du + |u| dz + 2 du dz, and u . u by 2 |u| du + 2 du^2, where |z| is |zx| + |zy| at m.
        The two terms of 16 U also cover the comparisons.

        Returns:
            `NONE`: never; `SURE`: all the time; `MAYBE`.
        """
        z, u = self.z, self.u
        zx, zy = z.x0 + m * (z.x1 + m * z.x2), z.y0 + m * (z.y1 + m * z.y2)
        ux, uy = u.x0 + m * (u.x1 + m * u.x2), u.y0 + m * (u.y1 + m * u.y2)
        dz = z.way * r + z.off + ROUNDING * z.size
        du = u.way * r + u.off + ROUNDING * u.size
        along = zx * ux + zy * uy
        length = ux * ux + uy * uy
        z_size, u_size = abs(zx) + abs(zy), abs(ux) + abs(uy)
        off = z_size * du + u_size * dz + 2.0 * du * dz + ROUNDING * z_size * u_size
        length_off = 2.0 * u_size * du + 2.0 * du * du + ROUNDING * u_size * u_size
        margin = off * SLACK + TINY
        end_margin = margin + length_off * SLACK + TINY
        if along < -margin or along > length + end_margin:
            return NONE
        if along > margin and along < length - end_margin:
            return SURE
        return MAYBE


def middle_of(low: float, high: float) -> tuple[float, float]:
    """Return m and r so that [low, high], which is in [-1, 1], is in [m - r, m + r]."""
    return 0.5 * (low + high), 0.5 * (high - low) + U4


def following(low: float, width: float) -> tuple[float, float]:
    """Return the part after [low, low + width] in [-1, 1]: the widest that halving makes there.

    Args:
        low: the left end; low + 1 is a multiple of the width.
        width: a power of 2. So all sums are exact.

    Returns:
        the left end and the width of the next part; the first is 1 if there is none.
    """
    low += width
    while width < 1.0:
        count = (low + 1.0) / width
        if i64(count) % 2 == 1:
            break
        width *= 2.0
    return low, width
