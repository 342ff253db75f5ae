"""What an engine promises: how near bodies count as touching, and what a step may skip.

An answer that is not the truth keeps the promise if it is explained by

* a distance d: bodies at most d apart may count as touching, and bodies that sink into each other
  by at most d as apart;
* a lateness: a contact may be reported so much later;
* a brevity: a contact that lasts for less may be skipped.

Distances at the times that are answered, and depths, are compared exactly with d, which is itself
a double, as are its products with the sizes of a question.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Final, NamedTuple

from benchmarks.engines.domain import kind_of
from exactpt import ContactInterval, contact_intervals, distance
from exactpt.kernel.numbers import QQ, rational
from exactpt.testing import Moving, Question, Truth
from exactpt.testing.comparing import TOLERANCE, verdict

__all__ = ["WITHIN", "Leeway", "fault", "leeway"]

WITHIN: Final = "within"
"""The verdict about an answer that is not the truth, but keeps the promise."""

_SLACK: Final = rational(TOLERANCE)


class Leeway(NamedTuple):
    """The promise about a question: a distance, a lateness and a brevity."""

    distance: float
    late: float
    brief: float

    def times(self, factor: float) -> Leeway:
        """A leeway that is larger by a factor."""
        return Leeway(factor * self.distance, factor * self.late, factor * self.brief)


def leeway(allows: Mapping[str, float], question: Question) -> Leeway:
    """Return the promise about a question from time 0 on.

    Args:
        allows: the sum of "distance", "of_extent" (a share of the width or height of all that
            the bodies pass) and "of_coordinates" (a share of the largest coordinate) is the
            distance; "late" and "brief" are shares of the time span. 0 by default.
        question: the question.
    """
    span = question.time[1]
    extents, largest = [], 0.0
    for k in (0, 1):
        ends = [end for body in (question.a, question.b) for end in _reach(body, k, span)]
        extents.append(max(ends) - min(ends))
        largest = max(largest, *map(abs, ends))
    reach = allows.get("of_extent", 0.0) * max(extents)
    near = allows.get("distance", 0.0) + reach + allows.get("of_coordinates", 0.0) * largest
    return Leeway(near, allows.get("late", 0.0) * span, allows.get("brief", 0.0) * span)


def _reach(body: Moving, k: int, span: float) -> Iterator[float]:
    """Bounds of a coordinate; each power of t counts as if it went as far as it can."""
    path = (body.x, body.y)[k]
    terms = [c * span**i for i, c in enumerate(path)]
    for vertex in body.vertices:
        yield vertex[k] + sum(min(0.0, c) for c in terms)
        yield vertex[k] + sum(max(0.0, c) for c in terms)


def fault(question: Question, truth: Truth, answer: object, allowed: Leeway) -> str:
    """How an answer is wrong, or "right" or `WITHIN`; see `exactpt.testing.comparing.VERDICTS`."""
    found = verdict(truth.time, answer, _SLACK)
    if found in ("right", "crashed"):
        return found
    scene = question.scene
    spans = contact_intervals(scene, "a", "b")
    end = rational(question.time[1])
    until = end if answer is None else rational(answer)  # type: ignore[arg-type]  # verdict read it
    if answer is not None:
        if not 0 <= until <= end:
            return found
        late = rational(allowed.late) + _SLACK
        seen = any(_during(s, until - late, until) for s in spans)
        gap = distance(scene, "a", "b", Fraction(until)).core_squared
        if not seen and gap > Fraction(allowed.distance) ** 2:
            return found
        until -= late
    latest = 0 if answer is None else -1  # a contact at the very end is missed, too
    for s in spans:
        skipped = s.start.compare_rational(until) <= latest and not _is_brief(s, allowed.brief)
        if skipped and _sinks(question, allowed.distance, s, until):
            return found
    return WITHIN


def _during(span: ContactInterval, low: QQ, high: QQ) -> bool:
    """Return True if bodies touch at a time of an interval."""
    return span.start.compare_rational(high) <= 0 and span.end.compare_rational(low) >= 0


def _is_brief(span: ContactInterval, brief: float) -> bool:
    return span.end.compare_rational(rational(float(span.start)) + rational(brief)) < 0


def _sinks(question: Question, depth: float, span: ContactInterval, until: QQ) -> bool:
    """Return True if bodies sink into each other by more than a depth in a contact, before a time.

    The depth of two convex bodies is the least overlap of their projections, over the normals of
    all edges (for segments on one line: and the directions of edges); each is linear in time, so
    that it exceeds a number in an interval of time. For other bodies, and if the depth is 0, so
    that a touch counts, it is True.
    """
    if depth == 0.0:
        return True
    bodies = question.a, question.b
    if any(kind_of(m) not in ("convex", "segment", "point") or any(map(any, (m.x[2:], m.y[2:])))
           for m in bodies):  # fmt: skip
        return True
    low = rational(float(span.start))
    high = min(until, rational(float(span.end)))
    for nx, ny in _axes(bodies):
        ends = [[nx * rational(x) + ny * rational(y) for x, y in m.vertices] for m in bodies]
        speeds = [nx * rational(m.velocity[0]) + ny * rational(m.velocity[1]) for m in bodies]
        # The overlap at time t is over + speed t; it has to exceed the depth times |n|.
        over = max(ends[0]) - min(ends[1]) - rational(depth * math.hypot(nx, ny))
        speed = speeds[0] - speeds[1]
        if speed == 0:
            if over <= 0:
                return False
        elif speed > 0:
            low = max(low, -over / speed)
        else:
            high = min(high, -over / speed)
    return low < high


def _axes(bodies: tuple[Moving, Moving]) -> Iterator[tuple[QQ, QQ]]:
    for body in bodies:
        n = len(body.vertices)
        for i in range(n):
            (px, py), (qx, qy) = body.vertices[i - 1], body.vertices[i]
            x, y = rational(qx) - rational(px), rational(qy) - rational(py)
            yield from ((x, y), (-x, -y), (y, -x), (-y, x))
    yield from ((QQ(1), QQ(0)), (QQ(-1), QQ(0)), (QQ(0), QQ(1)), (QQ(0), QQ(-1)))
