"""On which side of an edge of a polygon its exterior lies, although it may have crossed itself."""

from __future__ import annotations

from collections.abc import Mapping

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly, multiply, subtract
from exactpt.motion.body import Body
from exactpt.motion.course import Piece
from exactpt.motion.track import Incidence, Track, difference, dot, orientation_polynomial, vector


def exterior_side(
    body: Body, pieces: Mapping[int, Piece], touch: Incidence, time: AlgebraicNumber
) -> int:
    """Return the side of a touched edge on which the exterior lies, by the even-odd rule.

    1 for the right one, -1 for the left one, 0 if both sides are outside, or both inside.

    Let v be the vertex in the interior of the edge ab, u = b - a, n = u turned to the left. The
    points are v + d u + e n and v + d u - e n, for an infinitesimal d and an e that is
    infinitesimal against d: no edge passes between them and ab. A ray to the right from either
    crosses each edge cd for which c and d are on different sides of it in y, and the point is on
    the left of the upward edge; each sign that is 0 at v is that of the first term in d and e
    that is not.
    """
    v, other = pieces[touch.body].track(touch.vertex), pieces[touch.other]
    tracks = {i for edge in body.edges for i in edge}
    along = vector(*(other.track(i) for i in body.edges[touch.edge]))
    slope, height = time.sign_of(along[0]), time.sign_of(along[1])
    above: dict[int, tuple[bool, bool]] = {}
    for i in tracks:
        c = other.track(i)
        sign = time.sign_of(difference(v.y, v.w, c.y, c.w)) or -height
        above[i] = (sign or -slope) > 0, (sign or slope) > 0
    left = right = False
    for i, j in body.edges:
        if above[i] == above[j]:
            continue
        signs = _sides(other.track(i), other.track(j), v, along, time)
        left ^= above[i][0] != above[j][0] and (signs[0] > 0) == above[j][0]
        right ^= above[i][1] != above[j][1] and (signs[1] > 0) == above[j][1]
    return left - right


def _sides(
    c: Track, d: Track, v: Track, along: tuple[IntPoly, IntPoly], time: AlgebraicNumber
) -> tuple[int, int]:
    """Return on which side of cd each of the two points is: 1 for the left one, -1."""
    sign = time.sign_of(orientation_polynomial(c, d, v))
    if sign:
        return sign, sign
    edge = vector(c, d)
    sign = time.sign_of(subtract(multiply(edge[0], along[1]), multiply(edge[1], along[0])))
    if sign:
        return sign, sign
    sign = time.sign_of(dot(edge, along))
    return sign, -sign
