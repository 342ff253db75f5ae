"""The order of parallel bitangents, made total by the perturbation.

Two bitangents that are parallel at an instant are compared just after it; if they stay
parallel for all times, by the change of their slopes under the perturbation of
`exactpt.certificates.perturbation`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import final

from exactpt.kernel.integer_polynomial import IntPoly, add, multiply, negate, scale, subtract
from exactpt.kernel.numbers import ZZ
from exactpt.motion.track import difference
from exactpt.motion.vertex import Vertex


@final
class Slope:
    """The direction of a segment from left to right, and its perturbation.

    Attributes:
        x, y: the difference of its ends, times ``w``.
        w: the common denominator, positive.
        inflation: h(b) - h(a) for discs of radius 1 around the ends, where h is +1 for a
            body below the line and -1 for a body above it.
        bulge: the same for the part -|v|^2 of the radius, times w^2.
        length: a measure of the length, times ``w``: the width, or the height if vertical.
    """

    def __init__(self, a: Vertex, b: Vertex, sides: tuple[int, int], *, upright: bool) -> None:
        p, q = a.track, b.track
        self.x = difference(p.x, p.w, q.x, q.w)
        self.y = difference(p.y, p.w, q.y, q.w)
        self.w = multiply(p.w, q.w)
        # A body on the left of the line (side 1) is above it.
        self.inflation: IntPoly = scale((ZZ(1),), ZZ(sides[0] - sides[1]))
        at_a = multiply(add(multiply(p.x, p.x), multiply(p.y, p.y)), multiply(q.w, q.w))
        at_b = multiply(add(multiply(q.x, q.x), multiply(q.y, q.y)), multiply(p.w, p.w))
        self.bulge = subtract(scale(at_b, ZZ(sides[1])), scale(at_a, ZZ(sides[0])))

        self.length: IntPoly = negate(self.y) if upright else self.x


def slope_terms(s: Slope, t: Slope) -> Iterator[IntPoly]:
    """Yield the terms of a sum, negative iff theta(s) < theta(t), in decreasing size.

    theta(s) < theta(t) iff s x t < 0. Inflation changes a slope by (h(b) - h(a)) / L, and the
    larger slope has the smaller theta.
    """
    yield subtract(multiply(s.x, t.y), multiply(s.y, t.x))
    # h / L with L = length / w, brought to a common denominator; then bulge / w^2 / L.
    yield subtract(
        multiply(multiply(t.inflation, t.w), s.length),
        multiply(multiply(s.inflation, s.w), t.length),
    )
    yield subtract(
        multiply(multiply(t.bulge, s.length), s.w),
        multiply(multiply(s.bulge, t.length), t.w),
    )
