"""The first contact of two bodies in linear motion: candidates by a filter, then exactly."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.counters import Counters
from exactpt.kernel.numbers import QQ, nearest_float
from exactpt.motion.body import Body
from exactpt.motion.incidence import Touch
from exactpt.motion.outline import Straight
from exactpt.pairs.filters import candidates_of
from exactpt.pairs.rational import Candidate, LinearContact, Span, earliest, first_incidence


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


def first_linear_contact(
    a: Straight,
    b: Straight,
    span: Span,
    before: float = math.inf,
    distance: ContactDistance | None = None,
    counters: Counters | None = None,
) -> LinearContact | None:
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
    return first_at_distance((a.body, b.body), *span[:2], candidates, distance.squared)


def first_at_distance(
    bodies: tuple[Body, Body],
    start: QQ,
    end: QQ,
    candidates: Iterable[Candidate],
    squared: QQ,
) -> LinearContact | None:
    """Return the first time in (start, end] at which candidates are at a distance, exactly.

    Args:
        bodies: two bodies, farther apart than the distance at the start.
        start: the start; from there on each body is in one piece of its motion.
        end: the end.
        candidates: in the order of their earliest times. Of vertices and edges alone, if the
            distance is 0.
        squared: the square of the distance.
    """
    from exactpt.pairs.features import FeaturePair
    from exactpt.pairs.piece_pairs import segments_of

    pieces = [body._piece_after(start) for body in bodies]
    begin = AlgebraicNumber(start)

    def first(touch: Touch, until: QQ) -> tuple[AlgebraicNumber, Touch] | None:
        i, vertex, j, edge, other = touch
        ends = (other,) if edge < 0 else segments_of(bodies[j])[edge]
        pair = FeaturePair(touch, pieces[i].track(vertex), tuple(map(pieces[j].track, ends)))
        time = pair.first_time(squared, begin, until)
        return None if time is None else (time, pair.touch_at(time, ends))

    return earliest(candidates, first, end)
