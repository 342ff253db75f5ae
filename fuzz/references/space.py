"""First contacts in space by their definition, on python-flint; no module of `exactpt` is used.

A contact at t is a pair (x, y) in a polygon (the triangle x, y >= 0, x + y <= 1 for a face, the
unit square for two edges) that satisfies three linear equations. So it is the intersection of a
bounded polygon and lines; if it is not empty, it has a vertex: the intersection of two of the
lines (equations and edges of the polygon) that are not parallel, which satisfies all others.
Whether such a point exists depends on the signs of the determinants of two and of three of these
lines and can change only at roots of those that are not identically zero. All these roots are the
candidates; at each of them, the vertices are enumerated.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations
from typing import Final, NamedTuple

import flint

__all__ = ["Moment", "coplanarity", "first_contact", "least_coordinates"]

Line = tuple[flint.fmpz_poly, flint.fmpz_poly, flint.fmpz_poly]
"""a x + b y = c; for an edge of the polygon, a x + b y <= c."""

BITS: Final = 128

TRIANGLE: Final = ((-1, 0, 0), (0, -1, 0), (1, 1, 1))
SQUARE: Final = ((-1, 0, 0), (1, 0, 1), (0, -1, 0), (0, 1, 1))


class Moment(NamedTuple):
    """A root of an irreducible polynomial: the least real one, the second, ...: orders 0, 1, ..."""

    polynomial: flint.fmpz_poly
    order: int

    @property
    def rational(self) -> Fraction | None:
        """The number, if it is rational."""
        if self.polynomial.degree() > 1:
            return None
        return Fraction(-int(self.polynomial[0]), int(self.polynomial[1]))

    def enclosure(self, bits: int = BITS) -> flint.arb:
        """Return a real ball that contains the number."""
        before = flint.ctx.prec
        flint.ctx.prec = bits
        try:
            return _real_roots(self.polynomial)[self.order]
        finally:
            flint.ctx.prec = before

    def sign(self, f: flint.fmpz_poly) -> int:
        """Return the sign of a polynomial at the number."""
        q = self.rational
        if q is not None:
            value = f(flint.fmpq(q.numerator, q.denominator))
            return int(value > 0) - int(value < 0)
        if not flint.fmpq_poly(f) % flint.fmpq_poly(self.polynomial):
            return 0
        bits = BITS
        while True:
            root = self.enclosure(bits)
            before = flint.ctx.prec
            flint.ctx.prec = bits
            value = flint.arb_poly(f)(root)
            flint.ctx.prec = before
            if value > 0 or value < 0:
                return 1 if value > 0 else -1
            bits *= 2


def first_contact(
    kind: str, start: Sequence[Sequence[int]], end: Sequence[Sequence[int]]
) -> Moment | None:
    """Return the time of the first contact in [0, 1] of integer vertices; None without one."""
    equations, edges = _lines(kind, start, end)
    for moment in _candidates([*equations, *edges]):
        if any(True for _ in _vertices(equations, edges, moment)):
            return moment
    return None


def least_coordinates(
    kind: str, start: Sequence[Sequence[int]], end: Sequence[Sequence[int]], moment: Moment
) -> tuple[Fraction, Fraction]:
    """Return the lexicographically least coordinates of a contact at a rational time."""
    equations, edges = _lines(kind, start, end)
    t = moment.rational
    assert t is not None  # noqa: S101 - the caller's part
    at = flint.fmpq(t.numerator, t.denominator)
    return min(
        (_fraction(x(at) / d(at)), _fraction(y(at) / d(at)))
        for x, y, d in _vertices(equations, edges, moment)
    )


def coplanarity(
    kind: str, start: Sequence[Sequence[int]], end: Sequence[Sequence[int]]
) -> flint.fmpz_poly:
    """Return the determinant of the three equations, for tables; it decides nothing here."""
    (one, two, (a, b, c)), _ = _lines(kind, start, end)
    x, y, d = _intersection(one, two)
    return a * x + b * y - c * d


def _fraction(q: flint.fmpq) -> Fraction:
    return Fraction(int(q.p), int(q.q))


def _lines(
    kind: str, start: Sequence[Sequence[int]], end: Sequence[Sequence[int]]
) -> tuple[list[Line], list[Line]]:
    """Return the equations and the edges of the polygon."""
    p, a, b, c = (
        [flint.fmpz_poly([u, v - u]) for u, v in zip(q, r, strict=True)]
        for q, r in zip(start, end, strict=True)
    )
    equations: list[Line]
    if kind == "vertex-face":  # a + x (b - a) + y (c - a) = p
        equations = [(b[k] - a[k], c[k] - a[k], p[k] - a[k]) for k in range(3)]
    else:  # p + x (a - p) = b + y (c - b)
        equations = [(a[k] - p[k], b[k] - c[k], b[k] - p[k]) for k in range(3)]
    rows = TRIANGLE if kind == "vertex-face" else SQUARE
    edges: list[Line] = [
        (flint.fmpz_poly([i]), flint.fmpz_poly([j]), flint.fmpz_poly([k])) for i, j, k in rows
    ]
    return equations, edges


def _candidates(lines: Sequence[Line]) -> Iterator[Moment]:
    """Yield 0 and the roots in (0, 1] of all determinants that are not identically zero."""
    yield Moment(flint.fmpz_poly([0, 1]), 0)
    factors: dict[str, flint.fmpz_poly] = {}
    for f in _determinants(lines):
        if f.degree() > 0:
            for factor, _ in f.factor()[1]:
                factors[str(factor)] = factor
    found = []
    for factor in factors.values():
        for order, root in enumerate(_real_roots(factor)):
            if root > 0 and (root <= 1 or _is_one(factor)):
                found.append((root, Moment(factor, order)))
    # Balls of 128 bits around roots of polynomials of small integers are disjoint.
    found.sort(key=lambda item: float(item[0].mid()) if not item[1].rational else item[1].rational)
    yield from (moment for _, moment in found)


def _is_one(factor: flint.fmpz_poly) -> bool:
    return bool(factor.degree() == 1 and factor(1) == 0)


def _determinants(lines: Sequence[Line]) -> Iterator[flint.fmpz_poly]:
    for one, two in combinations(lines, 2):
        yield one[0] * two[1] - one[1] * two[0]
        yield one[0] * two[2] - one[2] * two[0]
        yield one[1] * two[2] - one[2] * two[1]
    for one, two, (a, b, c) in combinations(lines, 3):
        x, y, d = _intersection(one, two)
        yield a * x + b * y - c * d


def _intersection(one: Line, two: Line) -> tuple[flint.fmpz_poly, flint.fmpz_poly, flint.fmpz_poly]:
    """Return x, y and d: the intersection of two lines is (x / d, y / d)."""
    (a, b, c), (p, q, r) = one, two
    return c * q - b * r, a * r - c * p, a * q - b * p


def _vertices(
    equations: Sequence[Line], edges: Sequence[Line], moment: Moment
) -> Iterator[tuple[flint.fmpz_poly, flint.fmpz_poly, flint.fmpz_poly]]:
    """Yield the intersections of two lines that are on all lines and in the polygon."""
    for one, two in combinations([*equations, *edges], 2):
        x, y, d = _intersection(one, two)
        s = moment.sign(d)
        if (
            s
            and all(moment.sign(a * x + b * y - c * d) == 0 for a, b, c in equations)
            and all(moment.sign(a * x + b * y - c * d) * s <= 0 for a, b, c in edges)
        ):
            yield x, y, d


def _real_roots(f: flint.fmpz_poly) -> list[flint.arb]:
    """Return balls around the real roots of an irreducible polynomial, from left to right."""
    roots = [root.real for root, _ in f.complex_roots() if root.imag == 0]
    return sorted(roots, key=lambda root: float(root.mid()))
