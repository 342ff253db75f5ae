"""The first contact of two bodies in linear motion: candidates by a filter, then exactly."""

from __future__ import annotations

import math
from typing import NamedTuple

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.counters import Counters
from exactpt.kernel.numbers import QQ, nearest_float
from exactpt.motion.incidence import Touch
from exactpt.motion.outline import Straight
from exactpt.pairs.features import Feature, FeaturePair
from exactpt.pairs.filters import candidates_of
from exactpt.pairs.rational import (
    Candidate,
    Meeting,
    Span,
    earliest,
    first_incidence,
    touch_of,
)

__all__ = ["ContactDistance", "first_meeting"]


class ContactDistance(NamedTuple):
    """The distance of two cores at which they count as touching; it is positive.

    Attributes:
        squared: its square, exactly.
        nearest: a positive double, off by at most 2 U of it and 2^-1074.
    """

    squared: QQ
    nearest: float

    @classmethod
    def of(cls, squared: QQ, root: QQ) -> ContactDistance:
        """Return the distance with a square, given its root, off by at most 2^-60 of it."""
        return cls(squared, nearest_float(root) or math.ulp(0.0))


def first_meeting(
    a: Straight,
    b: Straight,
    span: Span,
    before: float = math.inf,
    distance: ContactDistance | None = None,
    counters: Counters | None = None,
) -> Meeting | None:
    """Return the first contact of two bodies in (start, end]; None if there is none.

    Args:
        a: a body.
        b: another body; the two are disjoint at the start, or farther apart than the distance.
        span: the start and the end.
        before: contacts certainly later than this do not count.
        distance: the contact distance of the cores; None if it is 0.
        counters: counts whether the filter or exact arithmetic decides.
    """
    nearest = 0.0 if distance is None else distance.nearest
    candidates = candidates_of(a, b, span, before, nearest)
    if counters is not None:
        counters.exact += bool(candidates)
        counters.filtered += not candidates
    if not candidates:
        return None
    if distance is None:
        return first_incidence(a, b, span, candidates)
    return _first_at_distance(a, b, span, candidates, distance.squared)


def _first_at_distance(
    a: Straight, b: Straight, span: Span, candidates: list[Candidate], squared: QQ
) -> Meeting | None:
    """Return the first time in (start, end] at which features are at a distance, exactly.

    Incidences with a foot at an end of an edge are those of that vertex.
    """
    p, q = a.body._piece_after(span.start), b.body._piece_after(span.start)
    begin = AlgebraicNumber(span.start)

    def first(
        candidate: Candidate, best: AlgebraicNumber | None
    ) -> tuple[AlgebraicNumber, Touch | None] | None:
        _, _, of_first, vertex, edge, end = candidate
        one, other, edges = (p, q, b.edges) if of_first else (q, p, a.edges)
        ends = (end,) if edge < 0 else edges[edge]
        features = Feature(vertex, None), Feature(None, edge)
        pair = FeaturePair(features, one.track(vertex), tuple(other.track(k) for k in ends))
        until = span.end if best is None else min(span.end, best._high)
        time = pair.first_time(squared, begin, until)
        if time is None:
            return None
        return time, touch_of(candidate, edge, end) if pair.is_inside(time) else None

    return earliest(candidates, first)
