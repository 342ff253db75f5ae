"""Certain contacts of two bodies whose points are known within an error.

Let each point of the core of body A be at most e_A from its true place, of B at most e_B, and let
E = e_A + e_B, r the sum of the radii, m = E - r. The true bodies touch if the true cores are within
r of each other. This is sure

* if m <= 0 and the cores are within -m of each other: two nearest points are then true within r;
* if m > 0 and an edge P of one crosses an edge Q of the other, each end of P being at least m from
  Q, and each end of Q from P;
* if m > 0 and a vertex of one is inside the other, a polygon, and at least m from its boundary.

*Proof of the last two.* Parametrise P by s and Q by u, both in [0, 1], and let F(s, u) = P(s) -
Q(u); in the last case P is the vertex, and Q the boundary. Crossing edges: F is affine and
regular and is 0 at one inner point of the square, so on its boundary F winds once around 0. A
vertex inside: F(u) winds around 0 an odd number of times, all rings of the boundary taken
together. On these curves |F| >= m. Let F' be the same of the true places, so |F' - F| <= E, and
suppose that the true bodies do not touch: |F'| > r. Then |F| + |F'| > E >= |F - F'|, so F and F'
are nowhere opposite, and h F + (1 - h) F' is not 0 for any h in [0, 1]: F' winds around 0 as F
does, on each ring. Of edges, F' then is 0 in the square, and of a vertex, it is inside the true
polygon: contradictions.

Points correspond along edges, since a rotation maps edges to edges. Where cores intersect but
none of the above holds, the true bodies may miss each other.

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
from typing import TypeAlias

from exactpt.geometry.polygon import segments_meet
from exactpt.geometry.predicates import Point, orientation
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ
from exactpt.kernel.roots import roots_after
from exactpt.motion.body import Body
from exactpt.motion.inside import covers
from exactpt.motion.track import Touch
from exactpt.pairs.distance import squared_distance, squared_from_interior
from exactpt.pairs.features import FeaturePair
from exactpt.pairs.piece_pairs import piece_pairs, segments_of

Segment: TypeAlias = "tuple[Point, Point]"


def surely_meet(a: Body, b: Body, t: QQ, error: QQ) -> bool:
    """Return True if two bodies provably touch at a time; exact if the error is 0.

    Args:
        a: a body.
        b: another body.
        t: a rational time.
        error: the sum of the two distances by which a point of either may be out of place.
    """
    margin = error - a._radius - b._radius
    if margin <= 0:
        return squared_distance(a, b, t) <= margin * margin
    p, q = a._at(t), b._at(t)
    least = margin * margin
    return (
        any(_is_deep(v, b, q, least) for v in p)
        or any(_is_deep(v, a, p, least) for v in q)
        or any(_cross_far(e, f, least) for e in _segments(a, p) for f in _segments(b, q))
    )


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
    margin = error - point._radius - other._radius
    ends = other.edges[edge]
    if margin <= 0:
        return False
    sides = []
    for t in (begin, end):
        v, a, b = point._at(t)[0], other._at(t)[ends[0]], other._at(t)[ends[1]]
        if _squared(v, (a, b)) < margin * margin:
            return False
        sides.append(orientation(a, b, v))
    if sides[0] * sides[1] >= 0:
        return False
    for piece_pair in piece_pairs(point, other, begin, end):
        track, over = piece_pair.first[0], (piece_pair.second[ends[0]], piece_pair.second[ends[1]])
        ends_apart = (FeaturePair(Touch(0, 0, 1, -1, k), track, (over[k],)) for k in (0, 1))
        positive = [pair.at_distance(margin * margin) for pair in ends_apart]
        positive += FeaturePair(Touch(0, 0, 1, edge, -1), track, over).limits
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
        _squared(v, edge) >= least for edge in _segments(body, points)
    )


def _cross_far(e: Segment, f: Segment, least: QQ) -> bool:
    """Return True if segments cross, all ends at least a squared distance from the other."""
    return (
        segments_meet(*e, *f)
        and all(_squared(v, f) >= least for v in e)
        and all(_squared(v, e) >= least for v in f)
    )


def _squared(v: Point, segment: Segment) -> QQ:
    """Return the squared distance of a point from a segment."""
    inside = squared_from_interior(v, *segment)
    return min((v[0] - x) ** 2 + (v[1] - y) ** 2 for x, y in segment) if inside is None else inside
