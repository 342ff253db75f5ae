"""Where two rounded bodies touch, and the normal there, as quotients of polynomials in time.

Let v be the nearest vertex of one core, f the nearest point of the other core, and r, s the radii.
At the time of a touch |v - f| = r + s =: R is rational, so the unit normal (v - f) / R and the
common point f + s (v - f) / R are rational functions of the coordinates of v and f.

On an edge ab, f = a + e (e . g) / (e . e) with e = b - a and g = v - a. With trajectories
(x / w, y / w), E = w_a w_b e and G = w_a w_v g, its coordinates are
(x_a (E . E) w_v + E_x (E . G)) / (w_a (E . E) w_v), and likewise in y.
"""

from __future__ import annotations

from typing import NamedTuple

from exactpt.kernel.integer_polynomial import IntPoly, add, multiply, scale
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.motion.track import Track, dot, vector


class TouchPoint(NamedTuple):
    """The point and the unit normal of a touch, with denominators that are positive at its time.

    Attributes:
        x, y, w: the point (x / w, y / w).
        normal_x, normal_y, normal_w: the normal, out of the body of the other feature.
    """

    x: IntPoly
    y: IntPoly
    w: IntPoly
    normal_x: IntPoly
    normal_y: IntPoly
    normal_w: IntPoly


def touch_point(v: Track, ends: tuple[Track, ...], radius: QQ, other_radius: QQ) -> TouchPoint:
    """Return the point where a vertex touches a vertex, or the edge between two, by the radii."""
    foot = ends[0] if len(ends) == 1 else _foot(v, *ends)
    reach = radius + other_radius
    dx, dy = vector(foot, v)
    w = multiply(foot.w, v.w)
    share = other_radius / reach
    of_foot, of_v = ZZ(share.denominator), ZZ(share.numerator)
    x, y = (
        add(scale(multiply(at, v.w), of_foot), scale(gap, of_v))
        for at, gap in ((foot.x, dx), (foot.y, dy))
    )
    normal_w = scale(w, ZZ(reach.numerator))
    n_x, n_y = (scale(gap, ZZ(reach.denominator)) for gap in (dx, dy))
    return TouchPoint(x, y, scale(w, of_foot), n_x, n_y, normal_w)


def _foot(v: Track, a: Track, b: Track) -> Track:
    """Return the foot of the perpendicular from v on the line ab; w is 0 if a = b."""
    edge = vector(a, b)
    along, length = dot(edge, vector(a, v)), multiply(dot(edge, edge), v.w)
    x, y = (
        add(multiply(at, length), multiply(e, along))
        for at, e in zip((a.x, a.y), edge, strict=True)
    )
    return Track(x, y, multiply(a.w, length), None)
