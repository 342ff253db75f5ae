"""Certain contacts of two bodies whose points are known within an error.

Let each point of the core of body A be at most e_A from its true place, of B at most e_B, and let
E = e_A + e_B, r the sum of the radii, m = E - r. The true bodies touch if the true cores are within
r of each other. This is sure

* if m <= 0 and the cores are within -m of each other: two nearest points are true within r;
* if m > 0 and a convex part P of one and a convex part Q of the other overlap by at least m: for
  each unit vector n, the largest n.p of a point p of P exceeds the least n.q of a point q of Q by
  at least m;
* if m > 0 and a point of one is in the other, a polygon, and its distances from the boundaries of
  both add up to at least m (the first of them is 0 for a vertex, and for a point of a chain).

An edge is convex, and so is a body that is a point, a segment or a convex polygon. Otherwise the
true bodies may miss each other.

*Convex parts.* For a convex set P let h_P(n) be the largest n.p of a point p of P, its support in
the direction n. Let g(n) = h_P(n) + h_-Q(n), the overlap in the direction n: the support of the
set P - Q of all differences. The distance of P and Q is the largest -g(n), or 0 if g >= 0
everywhere. The true places P' and Q' are congruent to P and Q, so they are convex, too. Their
points are out of place by at most e_A and e_B, so g' >= g - E >= m - E = -r for all n: the distance
of the true parts is at most r.

*This is necessary for convex bodies.* If g(n) < m for one unit vector n, let A be moved by -e_A n
and B by e_B n. These are rigid moves by the errors. Then g'(n) = g(n) - E < -r: the bodies are more
than r apart. So an overlap of convex bodies is certain if and only if it is one after every rigid
move by the errors; the first condition of the three is this one with m <= 0.

*The least overlap.* If g >= m > 0 everywhere, P - Q is a convex polygon that contains the disc of
radius m around 0. The point of its boundary that is nearest to 0 is on an edge, and an edge of
P - Q is parallel to one of P or of Q. So only normals of edges of P and of Q are tested, on both
sides. If P - Q has no area, they include one with g(n) <= 0, unless both are points.

*A point in both.* Let x be in A at a distance a from its boundary, and in B at a distance b, with
a + b >= m; on a chain the distance is 0. First let both be polygons with a, b > 0. For w in the
unit disc, p = x + a w is in A and q = x - b w in B. Let F(w) = p - q = (a + b) w, and F' the
same of the true places of p and q, so |F' - F| <= E. On the unit circle F winds once around 0, and
|F| >= m. Suppose that the true bodies do not touch: |F'| > r everywhere. Then |F| + |F'| > E >=
|F - F'| on the circle, so F and F' are nowhere opposite, and h F + (1 - h) F' is not 0 for any h in
[0, 1]: F' winds around 0 as F does. But F' is continuous and not 0 in the disc: a contradiction. If
a = 0, x is a point of A, and F runs over the boundary of B instead, u -> x - B(u). It winds around
0 an odd number of times, all rings taken together, since x is inside; and |F| >= b >= m. As before
F' winds as F does, so the true point is inside the true polygon: a contradiction. Such points are
sought in the vertices; if one of two polygons is not convex, also by `exactpt.pair.depth`.

Points correspond along edges and in polygons, since a rotation is a map of the plane.

A point is never sure to touch a thin body at a given time, but it may be sure to have passed
through an edge ab between two times: if m > 0, the foot of the perpendicular from it is inside
the edge all the time, it is at least m from a and from b all the time, and from the line at both
times, on opposite sides. *Proof.* Let F(u, t) be from the point to the point u of the edge. In
coordinates along the edge and across it, F is on the left where u = 0, on the right where u = 1,
above at one of the times and below at the other: on the boundary of the rectangle it winds once
around 0, and so it does in fixed coordinates, since the rotation from these depends continuously
on t alone. There |F| >= m; the rest is as above.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple, TypeAlias, final

from exactpt.geometry.polygon import is_convex
from exactpt.geometry.predicates import Point, orientation
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ
from exactpt.kernel.roots import roots_after
from exactpt.motion.body import Body
from exactpt.motion.inside import covers
from exactpt.motion.track import Incidence
from exactpt.pair.depth import have_deep_point
from exactpt.pair.distance import compare_distance
from exactpt.pair.features import FeaturePair
from exactpt.pair.nearest_at import squared_from_segment
from exactpt.pair.pieces_of_two import piece_pairs, segments_of

Segment: TypeAlias = "tuple[Point, Point]"


def surely_meet(a: Body, b: Body, t: QQ, error: QQ) -> bool:
    """Return True if two bodies provably touch at a time; exact if the error is 0.

    Args:
        a: a body.
        b: another body.
        t: a rational time.
        error: the sum of the two distances by which a point of either may be out of place.
    """
    margin = error - a.exact_radius - b.exact_radius
    if margin <= 0:
        return compare_distance(a, b, t, margin * margin) <= 0
    p, q = a.exact_at(t), b.exact_at(t)
    first, second = convex_parts(a, p), convex_parts(b, q)
    if any(overlap_everywhere(c, d, margin) for c in first for d in second):
        return True
    if len(first) == len(second) == 1:
        return False
    least = margin * margin
    return (
        any(_is_deep(v, b, q, least) for v in p)
        or any(_is_deep(v, a, p, least) for v in q)
        or have_deep_point(a, p, b, q, margin)
    )


@final
class ConvexPart(NamedTuple):
    """A convex set that a body contains: a point, a segment or a polygon.

    Attributes:
        corners: its corners, in order.
        low: the least x and y of a corner.
        high: the largest x and y of a corner.
    """

    corners: Sequence[Point]
    low: Point
    high: Point

    @classmethod
    def of(cls, corners: Sequence[Point]) -> ConvexPart:
        """Return the part with these corners."""
        xs, ys = zip(*corners, strict=True)
        return cls(corners, (min(xs), min(ys)), (max(xs), max(ys)))


def convex_parts(body: Body, points: Sequence[Point]) -> list[ConvexPart]:
    """Return convex sets that a body contains: itself if it is convex, else its edges.

    Args:
        body: the body.
        points: the places of its vertices.
    """
    if body.has_interior:
        is_whole = not body.has_rings and is_convex(points)
    else:
        is_whole = body.size <= 2
    return [ConvexPart.of(part) for part in ([points] if is_whole else _segments(body, points))]


def overlap_everywhere(p: ConvexPart, q: ConvexPart, depth: QQ) -> bool:
    """Return True if two convex sets overlap by a length in every direction.

    Args:
        p: a convex set.
        q: a convex set.
        depth: the length, which is positive.
    """
    for k in (0, 1):  # directions along the axes need no products, and refuse most pairs
        if p.high[k] - q.low[k] < depth or q.high[k] - p.low[k] < depth:
            return False
    if len(p.corners) == len(q.corners) == 1:
        return False
    least = depth * depth
    return all(
        overlap > 0 and overlap * overlap >= least * (x * x + y * y)
        for two in ((p.corners, q.corners), (q.corners, p.corners))
        for x, y, overlap in _overlaps(*two)
    )


def _overlaps(p: Sequence[Point], q: Sequence[Point]) -> Iterator[tuple[QQ, QQ, QQ]]:
    """Yield both normals of each edge of p, and the overlap of p with q in their directions.

    The overlap is multiplied by the length of the normal. It must be large enough in every
    direction, so the inner normals of a polygon do no harm.
    """
    for (ax, ay), (bx, by) in pairwise([*p, *p[:1]]):
        for x, y in ((ay - by, bx - ax), (by - ay, ax - bx)):
            if x or y:
                yield x, y, max(x * u + y * v for u, v in p) - min(x * u + y * v for u, v in q)


def surely_passed(point: Body, other: Body, edge: int, begin: QQ, end: QQ, error: QQ) -> bool:
    """Return True if a point has provably touched an edge of another body between two times.

    Args:
        point: a body of one vertex.
        other: another body.
        edge: the number of its edge.
        begin: a rational time.
        end: a later one.
        error: as in `surely_meet`.
    """
    margin = error - point.exact_radius - other.exact_radius
    ends = other.edges[edge]
    if margin <= 0:
        return False
    sides = []
    for t in (begin, end):
        v, a, b = point.exact_at(t)[0], other.exact_at(t)[ends[0]], other.exact_at(t)[ends[1]]
        if squared_from_segment(v, (a, b)) < margin * margin:
            return False
        sides.append(orientation(a, b, v))
    if sides[0] * sides[1] >= 0:
        return False
    for piece_pair in piece_pairs(point, other, begin, end):
        track, over = piece_pair.first[0], (piece_pair.second[ends[0]], piece_pair.second[ends[1]])
        ends_apart = (FeaturePair(Incidence(0, 0, 1, -1, k), track, (over[k],)) for k in (0, 1))
        positive = [pair.at_distance(margin * margin) for pair in ends_apart]
        positive += FeaturePair(Incidence(0, 0, 1, edge, -1), track, over).limits
        if not all(_is_positive(f, piece_pair.begin, piece_pair.end) for f in positive):
            return False
    return True


def _is_positive(f: IntPoly, begin: QQ, end: QQ) -> bool:
    """Return True if a polynomial is positive in a closed interval."""
    start = AlgebraicNumber(begin)
    return start.sign_of(f) > 0 and next(iter(roots_after(f, start, end)), None) is None


def _segments(body: Body, points: Sequence[Point]) -> Iterator[Segment]:
    return ((points[i], points[j]) for i, j in segments_of(body))


def _is_deep(v: Point, body: Body, points: Sequence[Point], least: QQ) -> bool:
    """Return True if v is in a polygon, at least at a squared distance from its boundary."""
    return covers(body, points, v) and all(
        squared_from_segment(v, edge) >= least for edge in _segments(body, points)
    )
