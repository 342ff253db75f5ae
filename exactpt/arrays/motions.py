"""The motion of the first body of each pair relative to the second, since the start."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from exactpt.arrays.spans import Spans
from exactpt.filters.rounding import SLACK, TINY, U
from exactpt.kernel.doubles import Floats, Indices


class Motions(NamedTuple):
    """Translations as polynomials in the time s since the start.

    Attributes:
        coefficients: shape (m, 2, d + 1), those of s^0 to s^d.
        off: shape (m, d + 1), bounds on their absolute errors in x and in y.
        plain: whether the constant terms are 0 and the relative errors of all others at most U;
            then ``off`` is not needed.
        edges: where vertices are rounded, bounds on the absolute errors of the differences of two
            of a body, in x and in y; those of vertices are in ``off`` of the constant terms.
    """

    coefficients: Floats
    off: Floats
    plain: bool
    edges: Floats | None = None

    @property
    def degree(self) -> int:
        """The degree d."""
        return int(self.coefficients.shape[2]) - 1

    def take(self, index: Indices) -> Motions:
        """Return the entries at the given places."""
        edges = None if self.edges is None else self.edges[index]
        return Motions(self.coefficients[index], self.off[index], self.plain, edges)


@np.errstate(all="ignore")
def relative_motions(
    coefficients: Floats, i: Indices, j: Indices, spans: Spans, rounded: Floats | None = None
) -> Motions:
    """Return the motions of the bodies i relative to the bodies j; d is at least 1.

    Where ``rounded`` is given, coefficients are the doubles nearest to the exact ones, and it
    bounds the errors of the vertices of each body. Then a difference of coefficients is off by
    one more unit of the sum of their absolute values, and equal ones may differ.

    A difference of doubles has a relative error of at most U. The substitution t = start + s, by
    Horner's scheme with at most 2 d operations for each coefficient, adds at most 2 d + 1 units
    of the same scheme for absolute values. A coefficient is exact if it and all higher ones are 0.

    From degree 2 on, powers of times beyond 2^(400 / d), or below 2^(-400 / d), could make an
    underflow larger than `TINY`: the bounds are infinite there, so nothing is decided.
    """
    c = coefficients[i] - coefficients[j]
    size = np.abs(c)
    if rounded is not None:
        size = np.abs(coefficients[i]) + np.abs(coefficients[j])
    while c.shape[2] > 2 and not size[:, :, -1].any():
        c, size = c[:, :, :-1], size[:, :, :-1]
    if c.shape[2] == 1:
        c, size = (np.concatenate((f, np.zeros_like(f)), axis=2) for f in (c, size))
    d = c.shape[2] - 1
    plain = rounded is None and not spans.shifted and not c[:, :, 0].any()
    moves = (size != 0.0).any(axis=1)
    if spans.shifted:
        start = spans.start[:, None]
        for k in range(d):
            for n in range(d - 1, k - 1, -1):
                c[:, :, n] += start * c[:, :, n + 1]
                size[:, :, n] += np.abs(start) * size[:, :, n + 1]
        moves = np.logical_or.accumulate(moves[:, ::-1], axis=1)[:, ::-1]
    units = 2 * d + (3 if rounded is None else 4)
    off = np.where(moves, units * U * size.sum(axis=1) * SLACK + TINY, 0.0)
    edges = None
    if rounded is not None:
        both = (rounded[i] + rounded[j]) * SLACK
        off[:, 0] += both
        edges = 2.0 * both
    if d > 1:
        most = 2.0 ** (400 // d)
        times = np.maximum(np.abs(spans.start), spans.length.high)
        immoderate = ~((times < most) & (spans.length.high > 1.0 / most))
        if immoderate.any():
            off[immoderate] = np.inf
            plain = False
    return Motions(c, off, plain, edges)


def reaches(motions: Motions, length: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the least and the greatest displacement, shape (m, 2), and a bound on their errors.

    Each term c s^k is between 0 and c length^k, of which the computed value has a relative error
    of at most k + 1 units beside that of c; the sums take d more operations.
    """
    c = motions.coefficients
    d = motions.degree
    least, most, size = c[:, :, 0].copy(), c[:, :, 0].copy(), np.abs(c[:, :, 0])
    off = motions.off[:, 0].copy()
    power = np.ones_like(length)
    for k in range(1, d + 1):
        power = power * length
        term = c[:, :, k] * power[:, None]
        least += np.minimum(term, 0.0)
        most += np.maximum(term, 0.0)
        size += np.abs(term)
        off += motions.off[:, k] * power
    error = ((2 * d + 4) * U * size + off[:, None]) * SLACK + TINY
    return least, most, error
