"""How far pieces of rigid motion are from a path of poses: a proof for any pieces.

On a piece [a, b] let s = (t - a) / (b - a), h the half turn, theta the angle of the path, which are
polynomials in s, u the orientation, and w = 1 / (1 + h^2). The error of the angle is, but for full
turns,

    e(s) = arg u + 2 arctan h(s) - theta(s),    e' = w N,    N = 2 h' - theta' (1 + h^2).

Let E be the primitive of N with E(0) = 0. By parts, e(s) - e(0) = E(s) w(s) - (the integral of E w'
from 0 to s); 0 < w <= 1 and |w'| = |2 h h'| / (1 + h^2)^2 <= 2 |h h'|. So

    |e(s)| <= |e(0)| + max |E| (1 + 2 max |h| max |h'|).

The maxima are bounded by Bernstein coefficients, those of E by the coefficients on eight equal
parts; e(0) is enclosed in rational bounds, at the unit vector u turned by h(0). How a half turn was
found does not matter, and no error of one piece is carried to the next.

The body is turned about its pivot, then translated: a point at a distance r from the pivot,
turned by angles that differ by e, gets to places 2 r sin(|e| / 2) <= r |e| apart.
"""

from __future__ import annotations

from typing import Final

from exactpt.kernel.arctangents import pi_bounds
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, floor
from exactpt.kernel.polynomial import ONE, Polynomial
from exactpt.motion.motions import Rigid
from exactpt.motion.turned_angle import angle_of, bits_for, bound_on, bounds_on_parts

Pose = tuple[Polynomial, Polynomial, Polynomial]
"""x, y and the angle in radians."""

_HALVINGS: Final = 3
"""Of the interval into parts: the coefficients of E are taken on each of eight."""
_FIRST: Final = QQ(0)
_LAST: Final = QQ(1)


def angle_error(turn: Rigid, a: QQ, b: QQ, angle: Polynomial, error: QQ) -> QQ:
    """Return a bound on the error of the angle of a motion in [a, b], a <= b.

    Args:
        turn: the motion.
        a: the beginning.
        b: the end.
        angle: the angle at the time t, in radians.
        error: the error that is allowed: the arc tangent and pi are bounded for a small part of it.

    Raises:
        InputError: if the error is too small for angles of this size.
    """
    check_budget()
    unit = Polynomial([a, b - a])
    h, theta = turn.half_turn(unit), angle(unit)
    slope = h.derivative()
    change = _primitive(2 * slope - theta.derivative() * (ONE + h * h))
    most = max(bounds_on_parts(change, _HALVINGS))
    factor = 1 + 2 * bound_on(h, _FIRST, _LAST) * bound_on(slope, _FIRST, _LAST)
    return _error_at(turn, a, angle.exact_at(a), error) + most * factor


def _error_at(turn: Rigid, t: QQ, angle: QQ, error: QQ) -> QQ:
    """Return a bound on the error of the angle at a time."""
    bits = bits_for(error, angle) + 8
    h, (c, s) = turn.half_turn.exact_at(t), turn.exact_orientation
    cos, sin = (1 - h * h) / (1 + h * h), 2 * h / (1 + h * h)
    low, high = angle_of((c * cos - s * sin, c * sin + s * cos), bits)
    full = tuple(2 * bound for bound in pi_bounds(bits))
    k = floor((low - angle) / full[0] + QQ(1, 2))
    least, most = sorted((k * full[0], k * full[1]))
    return max(abs(low - angle - most), abs(high - angle - least))


def place_error_squared(turn: Rigid, a: QQ, b: QQ, x: Polynomial, y: Polynomial) -> QQ:
    """Return a bound on the squared error of the translation in [a, b]."""
    return bound_on(turn.x - x, a, b) ** 2 + bound_on(turn.y - y, a, b) ** 2


def _primitive(f: Polynomial) -> Polynomial:
    return Polynomial([0, *(c / (i + 1) for i, c in enumerate(f.exact_coefficients))])
