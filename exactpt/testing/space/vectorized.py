"""First contacts of many queries in space at once: a float filter, then exact arithmetic.

The filter decides that no contact exists. All its conditions are about vectors d between a
vertex of one set and a vertex of the other: the sets share a point at t if and only if the origin
is in the convex hull of the d(t), which are (1 - t) d(0) + t d(1).

**Boxes.** Comparisons of doubles are exact.

**Directions.** If the dot products of a fixed direction with all d(0) and d(1) are positive, then
with all d(t), and the origin is not in their hull. The direction has entries -1, 0, 1. With M the
largest component of the computed d: each component has a relative error of at most U, and two
additions one each, so the error of the dot product is at most 3 M ((1 + U)^3 - 1) (1 + U), less
than 9.1 U M. Differences and sums do not underflow; an infinity or a NaN fails the test.

**Cubic.** At a contact the determinant of three such vectors e, f, g vanishes. Its Bernstein
coefficients on [0, 1] are sums of determinants [e, f, g] of the vectors at 0 and 1: of one for the
first and the last, of three, divided by 3, for the others. If all have one strict sign, so has the
determinant on [0, 1]. A product of three components has three relative errors of the components,
two of multiplications, and (as a term of a determinant) one of a subtraction and two of additions;
two more additions for sums of three determinants. With E, F, G the largest components of the three
vectors, at 0 or 1, there are 18 terms of at most E F G each, so the error is at most
18 ((1 + U)^10 - 1) E F G (1 + U)^3, less than 181 U E F G. Underflow of a product adds at most
2^-1074 times a third factor, or 2^-1074: together less than 36 (1 + E + F + G) 2^-1074.

**Subdivision.** De Casteljau's algorithm halves the interval of the coefficients. An average
(a + b) / 2 has one rounding (halving is exact, but for underflow, at most 2^-1074), so a level of
three averages, one upon another, adds at most 3 U S + 3 2^-1074 to errors that do not grow
otherwise, S being the largest coefficient.
"""

from __future__ import annotations

from typing import Final, Literal, final

import numpy as np
from numpy.typing import ArrayLike

from exactpt.errors import InputError
from exactpt.filters.rounding import TINY, U, check_rounding
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Flags, Floats
from exactpt.kernel.numbers import shorten
from exactpt.testing.space.exact import SpaceContact, first_contact_of
from exactpt.testing.space.queries import Kind

BLOCK: Final = 4096
"""Number of queries in one pass of the filter; its arrays fit the cache."""
HALVINGS: Final = 3
"""Number of times that [0, 1] is halved for the cubic."""
DIRECTIONS: Final = np.array(
    [
        (i, j, k)
        for i in (-1, 0, 1)
        for j in (-1, 0, 1)
        for k in (-1, 0, 1)
        if (i, j, k) > (0, 0, 0)
    ],
    dtype=np.float64,
)

Errors = Literal["raise", "mask"]


@final
class SpaceContacts:
    """The first contacts of many queries in space.

    Attributes:
        hit: True if there is a contact in [0, 1].
        low, high: doubles that enclose the time: equal if the time is a double, else neighbours;
            both infinite without a contact, NaN for refused queries.
        exact: True if exact arithmetic has decided the query; else the float filter has.
        refused: True for queries with a number that is not finite; these have no hit.
    """

    __slots__ = ("_kind", "_points", "exact", "high", "hit", "low", "refused")

    def __init__(self, kind: Kind, points: Floats, refused: Flags) -> None:
        self._kind, self._points, self.refused = kind, points, refused
        self.hit: Flags = np.zeros(len(points), dtype=np.bool_)
        self.exact: Flags = np.zeros(len(points), dtype=np.bool_)
        self.low: Floats = np.where(refused, np.nan, np.inf)
        self.high: Floats = self.low.copy()

    def __len__(self) -> int:
        return len(self.hit)

    @property
    def exact_share(self) -> float:
        """The fraction of queries that exact arithmetic has decided, from 0 to 1."""
        return float(self.exact.mean()) if len(self) else 0.0

    def reasons(self) -> list[tuple[int, str]]:
        """Return the index of each refused query with one line about it."""
        return [(int(i), _reason(self._points[i])) for i in np.nonzero(self.refused)[0]]

    def contact(self, i: int) -> SpaceContact | None:
        """Return the exact contact of query i, as `vertex_face` and `edge_edge` do.

        Raises:
            IndexError: if the query does not exist.
            InputError: if the query is refused.
        """
        k = range(len(self))[i]
        if self.refused[k]:
            raise InputError(f"query {k}: {_reason(self._points[k])}")
        return self._decide(k) if self.hit[k] else None

    def _decide(self, k: int) -> SpaceContact | None:
        points = self._points[k].tolist()
        return first_contact_of(self._kind, points[:4], points[4:])

    def _decide_block(self, first: int, last: int) -> None:
        candidates = ~self.refused[first:last]
        candidates[candidates] = _may_touch(self._kind, self._points[first:last][candidates])
        for k in (np.nonzero(candidates)[0] + first).tolist():
            check_budget()
            self.exact[k] = True
            contact = self._decide(k)
            if contact is not None:
                self.hit[k] = True
                self.low[k], self.high[k] = contact.time.enclosure()

    def __repr__(self) -> str:
        return (
            f"<SpaceContacts: {int(self.hit.sum())} of {len(self)} queries have a contact, "
            f"{int(self.exact.sum())} decided exactly>"
        )


def vertex_face_array(points: ArrayLike, *, errors: Errors = "raise") -> SpaceContacts:
    """Return the first contacts of vertices and triangles that move linearly during [0, 1].

    Args:
        points: doubles of shape (n, 8, 3), taken at their exact values: the vertex and the three
            vertices of the triangle at t = 0, then the same at t = 1.
        errors: "raise", or "mask" to flag the queries with numbers that are not finite in
            `SpaceContacts.refused`.

    Raises:
        InputError: for another shape, or for a query that is not finite, unless masked.
    """
    return _decide("vertex-face", points, errors)


def edge_edge_array(points: ArrayLike, *, errors: Errors = "raise") -> SpaceContacts:
    """Return the first contacts of segments that move linearly during [0, 1].

    Args:
        points: doubles of shape (n, 8, 3), taken at their exact values: the ends of the first
            segment and the ends of the second at t = 0, then the same at t = 1.
        errors: as in `vertex_face_array`.

    Raises:
        InputError: as `vertex_face_array`.
    """
    return _decide("edge-edge", points, errors)


def _decide(kind: Kind, points: ArrayLike, errors: str) -> SpaceContacts:
    check_rounding()
    if errors not in ("raise", "mask"):
        raise InputError(f'errors: expected "raise" or "mask", got {shorten(errors)}')
    try:
        rows = np.ascontiguousarray(points, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError("points: not an array of numbers") from None
    if rows.ndim != 3 or rows.shape[1:] != (8, 3):
        raise InputError(f"points: expected the shape (n, 8, 3), got {rows.shape}")
    refused: Flags = np.logical_not(np.isfinite(rows).reshape(-1, 24).all(1))
    if errors == "raise" and refused.any():
        i = int(refused.argmax())
        raise InputError(f"points: query {i}: {_reason(rows[i])}")
    contacts = SpaceContacts(kind, rows, refused)
    for first in range(0, len(rows), BLOCK):
        contacts._decide_block(first, min(first + BLOCK, len(rows)))  # noqa: SLF001
    return contacts


def _reason(points: Floats) -> str:
    i, k = np.argwhere(~np.isfinite(points))[0].tolist()
    return f"coordinate {'xyz'[k]} of vertex {i % 4} at t = {i // 4} is {points[i, k]}"


def _may_touch(kind: Kind, points: Floats) -> Flags:
    """Return False for queries that certainly have no contact; proofs are above."""
    count = 1 if kind == "vertex-face" else 2
    two = points.reshape(-1, 2, 4, 3)
    one, other = two[:, :, :count], two[:, :, count:]
    lows, highs = one.min((1, 2)), one.max((1, 2))
    undecided: Flags = ((lows <= other.max((1, 2))) & (other.min((1, 2)) <= highs)).all(1)
    with np.errstate(all="ignore"):
        for step in (_has_side, _may_be_coplanar):
            undecided[undecided] = step(kind, two[undecided])
    return undecided


def _has_side(kind: Kind, two: Floats) -> Flags:
    """Return False if some direction separates the two sets at all times."""
    count = 1 if kind == "vertex-face" else 2
    d = (two[:, :, count:, None] - two[:, :, None, :count]).reshape(
        len(two), 6 if count == 1 else 8, 3
    )
    dots = d @ DIRECTIONS.T
    bound = (10 * U) * np.abs(d).max((1, 2))[:, None]
    apart: Flags = ((dots.min(1) > bound) | (dots.max(1) < -bound)).any(1)
    return ~apart


def _may_be_coplanar(kind: Kind, two: Floats) -> Flags:
    """Return False if the cubic has no root in [0, 1], by its Bernstein coefficients."""
    base = (1, 1, 1) if kind == "vertex-face" else (0, 2, 0)
    tips = (2, 3, 0) if kind == "vertex-face" else (1, 3, 2)
    (e, ee), (f, ff), (g, gg) = (
        (two[:, 0, i] - two[:, 0, j], two[:, 1, i] - two[:, 1, j])
        for i, j in zip(tips, base, strict=True)
    )
    n0, n1, n2 = _cross(e, f), _cross(ee, f) + _cross(e, ff), _cross(ee, ff)
    rows = np.stack(
        [
            _dot(n0, g),
            (_dot(n1, g) + _dot(n0, gg)) / 3,
            (_dot(n2, g) + _dot(n1, gg)) / 3,
            _dot(n2, gg),
        ]
    )
    sizes = [np.maximum(np.abs(p).max(1), np.abs(q).max(1)) for p, q in ((e, ee), (f, ff), (g, gg))]
    # The bound of the proof, with one more relative error of U for each division by 3.
    error = (200 * U) * (sizes[0] * sizes[1] * sizes[2]) + TINY * (1 + sum(sizes))
    apart: Flags = _has_one_sign(rows, error)
    undecided = np.nonzero(~apart)[0]
    pieces, left = [rows[:, undecided]], error[undecided]
    for _ in range(HALVINGS):
        pieces = [half for piece in pieces for half in _halves(piece)]
        left = left + (3 * U) * np.abs(rows[:, undecided]).max(0) + TINY
    roots = ~np.logical_and.reduce([_has_one_sign(piece, left) for piece in pieces])
    result: Flags = ~apart
    result[undecided] = roots
    return result


def _has_one_sign(rows: Floats, error: Floats) -> Flags:
    return np.asarray((rows.min(0) > error) | (rows.max(0) < -error))


def _halves(rows: Floats) -> tuple[Floats, Floats]:
    """Return the Bernstein coefficients of a cubic on the two halves of its interval."""
    a, b, c, d = rows
    ab, bc, cd = (a + b) / 2, (b + c) / 2, (c + d) / 2
    abc, bcd = (ab + bc) / 2, (bc + cd) / 2
    middle = (abc + bcd) / 2
    return np.stack([a, ab, abc, middle]), np.stack([middle, bcd, cd, d])


def _cross(p: Floats, q: Floats) -> Floats:
    x, y, z = p.T
    u, v, w = q.T
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u], 1)


def _dot(p: Floats, q: Floats) -> Floats:
    return np.asarray(p[:, 0] * q[:, 0] + p[:, 1] * q[:, 1] + p[:, 2] * q[:, 2])
