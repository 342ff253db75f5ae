"""Vertices relative to edges, in arrays: orientations and positions, with error bounds.

Each entry of the arrays is one vertex p and one edge ab. Time is the time s since the start. All
bounds are for the exact doubles that were given, and cover overflow (an infinity or NaN fails
every test, since all tests are positive) and underflow (`TINY`).
"""

from __future__ import annotations

from typing import Final, NamedTuple, TypeAlias

import numpy as np

from exactpt.filters.rounding import SLACK, TINY, U
from exactpt.kernel.doubles import Flags, Floats, Indices

K: Final = 8.0 * U
"""Relative bound on the rounding of a coefficient of an orientation: see `orientations`."""

Plane: TypeAlias = tuple[Floats, Floats]
Coefficient: TypeAlias = tuple[Floats, Floats]
"""A coefficient, and a bound on its error."""


class Relative(NamedTuple):
    """A vertex p and an edge ab, as polynomials in s.

    Attributes:
        u: the coefficients of b - a, in x and y: one if the edge keeps its direction, or two. A
            point stands for an edge of length 0 of direction (0, 1).
        w: the coefficients of p - a.
        off_u, off_w: for each coefficient a bound on its absolute error in x and in y, beside a
            relative error of at most U in each; None for 0.
        length: 0 for points and 1 for edges; None if there are only edges.
    """

    u: tuple[Plane, ...]
    w: tuple[Plane, ...]
    off_u: tuple[Floats | None, ...]
    off_w: tuple[Floats | None, ...]
    length: Floats | None

    def take(self, index: Indices) -> Relative:
        """Return the entries at the given places."""
        return Relative(
            tuple((x[index], y[index]) for x, y in self.u),
            tuple((x[index], y[index]) for x, y in self.w),
            tuple(None if off is None else off[index] for off in self.off_u),
            tuple(None if off is None else off[index] for off in self.off_w),
            None if self.length is None else self.length[index],
        )


def orientations(r: Relative) -> list[Coefficient]:
    """Return the coefficients of u x w, and bounds on their errors.

    A coefficient is the sum of at most four products of coefficients of u and w (of degree 1
    both, or of degrees 0 and any). The relative errors of the two factors, of the product and of
    at most two sums after the first difference make six units; two more cover the rounding of
    the bound. Absolute errors du, dw of the factors add |u| dw + |w| du + du dw, summed over x
    and y.

    An error of at most 2^-1074 by underflow of each product is below `TINY`. A coefficient of
    which each product has a factor that is exactly 0 is exactly 0: its bound is 0.
    """
    found: list[Coefficient] = []
    for k in range(len(r.u) + len(r.w) - 1):
        terms = [(i, k - i) for i in range(len(r.u)) if 0 <= k - i < len(r.w)]
        value, size, more = _product(r, *terms[0])
        for i, j in terms[1:]:
            other = _product(r, i, j)
            value = value + other[0]
            size = size + other[1]
            more = more + other[2]
        error = size * K + TINY + more * SLACK
        zero = np.flatnonzero(size == 0.0)
        if len(zero):
            error[zero[_is_zero(r.take(zero), k)]] = 0.0
        found.append((value, error))
    return found


def _product(r: Relative, i: int, j: int) -> tuple[Floats, Floats, Floats | float]:
    """u_i x w_j, the sum of the sizes of its products, and the part of absolute errors."""
    (ux, uy), (wx, wy) = r.u[i], r.w[j]
    p, q = ux * wy, uy * wx
    return p - q, np.abs(p) + np.abs(q), _off_product(r, i, j)


def _off_product(r: Relative, i: int, j: int) -> Floats | float:
    (ux, uy), (wx, wy) = r.u[i], r.w[j]
    du, dw = r.off_u[i], r.off_w[j]
    off: Floats | float = 0.0
    if du is not None:
        off = off + du * (np.abs(wx) + np.abs(wy))
    if dw is not None:
        off = off + dw * (np.abs(ux) + np.abs(uy))
    if du is not None and dw is not None:
        off = off + 2.0 * du * dw
    return off


def _is_zero(r: Relative, k: int) -> Flags:
    """Return True if each product in coefficient k has a factor that is exactly 0."""
    zero: Flags = np.ones(len(r.u[0][0]), dtype=np.bool_)
    for i in range(len(r.u)):
        if 0 <= k - i < len(r.w):
            u, w = (_exact_zeros(f, off) for f, off in (
                (r.u[i], r.off_u[i]), (r.w[k - i], r.off_w[k - i])
            ))  # fmt: skip
            zero &= (u[0] | w[1]) & (u[1] | w[0])
    return zero


def _exact_zeros(f: Plane, off: Floats | None) -> tuple[Flags, Flags]:
    x, y = f[0] == 0.0, f[1] == 0.0
    return (x, y) if off is None else (x & (off == 0.0), y & (off == 0.0))


def sides(r: Relative, low: Floats, high: Floats) -> tuple[Flags, Flags]:
    """Where a vertex surely is inside its edge, and where surely not, at any s in [low, high].

    Inside if it is on the line. It is inside the edge if and only if g = u . w > 0 and
    h = u . (u - w) > 0, and not on the closed edge if one of them is negative; for a point, h is
    -g (so that a vertex is surely not there if it differs in y).

    At the middle m the computed u and w are off by at most du and dw in each coordinate
    (`_at`). With |u|, |w| the sums of the absolute values of their coordinates, g is off by at
    most du |w| + dw |u| + 2 du dw, and u . u by at most 2 du |u| + 2 du^2, beside rounding: at most
    3 units of |u| |w| and of |u|^2, and one of the difference h = u . u - g.
    """
    middle = 0.5 * (low + high)
    reach = (0.5 * (high - low) + 2.0 * U * middle) * SLACK
    ux, uy, du = _at(r.u, r.off_u, middle, reach)
    wx, wy, dw = _at(r.w, r.off_w, middle, reach)
    g = ux * wx + uy * wy
    square = ux * ux + uy * uy
    if r.length is not None:
        square *= r.length
    h = square - g
    size_u, size_w = np.abs(ux) + np.abs(uy), np.abs(wx) + np.abs(wy)
    both = 2.0 * size_u + size_w
    error = du * (both + 2.0 * (du + dw)) + dw * size_u + K * size_u * both
    error = error * SLACK + TINY
    return (g > error) & (h > error), (g < -error) | (h < -error)


def _at(
    f: tuple[Plane, ...], off: tuple[Floats | None, ...], m: Floats, reach: Floats
) -> tuple[Floats, Floats, Floats]:
    """Return the value at m >= 0, and a bound on how far it is off at any s within ``reach`` of m.

    Horner's rule for degree n takes 2 n operations; with the error of the coefficients that is
    at most (2 n + 1) units of sum |c_i| m^i. Within ``reach`` the exact value changes by at most
    sum i |c_i| (m + reach)^(i - 1) reach.
    """
    n = len(f) - 1
    x, y = f[n]
    size = np.abs(x) + np.abs(y)
    slope = np.zeros_like(size)
    error = _or_zero(off[n])
    far = m + reach
    for i in range(n - 1, -1, -1):
        slope = slope * far + size
        x, y = x * m + f[i][0], y * m + f[i][1]
        size = size * far + (np.abs(f[i][0]) + np.abs(f[i][1]))
        error = error * far + _or_zero(off[i])
    return x, y, ((2 * n + 2) * U * size + slope * reach + error) * SLACK + TINY


def _or_zero(off: Floats | None) -> Floats | float:
    return 0.0 if off is None else off
