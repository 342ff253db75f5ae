"""Pairs of bodies that turn: the first contacts that a filter finds, by bisection of time.

With points as complex numbers and a = 1 + i h for the half turn h, a body that turns takes its
vertex q (relative to the pivot, in its first orientation) to c + a^2 q / |a|^2, where c is the path
of the pivot. Let the second body have b instead of a, and c be the difference of the two paths. As
the second one sees it, q is at N / W about its pivot, where
    N = T + E q,  T = conj(b)^2 |a|^2 c,  E = conj(b)^2 a^2,  W = |a|^2 |b|^2.
On the line of its edge from p to p + u, Z = conj(u) (N - W p) is real; and q is inside the edge
where also Re Z > 0 and |u|^2 W - Re Z > 0. These three, f, g and h, are polynomials of degree 6.
Each is between the least and the greatest of its Bernstein coefficients on a span of time.

The bound. Products of Bernstein coefficients are means with weights that sum to 1, so sizes and
relative errors multiply and add up as those of numbers. With T the largest size of a time,
    A = 1 + |h0| + |h1| T,  C = |px| + |py| + sum of (|xk| + |yk|) T^k,  R = |x| + |y| + |px| + |py|
bound a, c and the vertex q; the coefficients are off by at most 4 U A, 8 U C and 16 U R, and those
of a product by 16 U more: a complex product is off by 4 U, the weight and its product by 2, the sum
of at most three terms by 3. So T, E and W, of at most six factors, are off by 128 U of A^2 B^2 C,
A^2 B^2 and A^2 B^2, where C is that of both bodies. A coefficient of Z, or of |u|^2 W, is off by at
most 256 U of S = A^2 B^2 V (C + Q + P + V), where Q, P and V are the R of q, of p, and the sum of
those of both ends; and |u|^2 W - Re Z by 512 U S. Each halving takes six sums, of 6 U S: fewer than
50 halvings together 300 U S. So `UNIT` times S bounds all errors, those of the bound itself too;
`TINY` covers underflow where S and its factors are at most `MOST`.
"""

from __future__ import annotations

from math import comb
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from exactpt.arrays.answers import record_edges, record_overlaps
from exactpt.arrays.blocks import CHUNK, LARGEST
from exactpt.arrays.candidates import Candidates, all_candidates
from exactpt.arrays.contacts import Contacts
from exactpt.arrays.motions import relative_motions
from exactpt.arrays.outlines import Outlines, outlines_of
from exactpt.arrays.spans import Spans
from exactpt.arrays.starts import at_start
from exactpt.filters.rounding import SLACK, TINY, U
from exactpt.geometry.ragged import ranges
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Flags, Floats, Indices, native
from exactpt.scene.body_arrays import BodyArrays

Complex = NDArray[np.complex128]

UNIT: Final = 1024.0 * U
MOST: Final = 2.0**400
DEPTH: Final = 44
"""Number of halvings."""
FEW: Final = 64
"""Maximum number of spans of a pair of bodies that are open at the same time."""
BEYOND: Final = 1.0 / 97.0
"""Part of a span by which it is lengthened, so that halvings are at no plain times."""


class Poses(NamedTuple):
    """The motions of pairs of bodies during their spans, see above.

    Attributes:
        moved, turned: T and E, shape (2, m, 7): of vertices of the first body, then of the second.
        weight: W, shape (m, 7).
        size, reach: A^2 B^2, and C of both bodies.
        start, length: the spans.
    """

    moved: Complex
    turned: Complex
    weight: Complex
    size: Floats
    reach: Floats
    start: Floats
    length: Floats


@np.errstate(all="ignore")
def record_turning(
    bodies: BodyArrays, o: Outlines, turns: Floats, spans: Spans, contacts: Contacts
) -> None:
    """Record the first contacts of the pairs (0, 1), (2, 3), ...; open ones are ``exact``.

    Args:
        bodies: in doubles nearest to the exact numbers.
        o: their outlines.
        turns: shape (n, 6), likewise: for each body two coefficients of its half turn, its pivot,
            and the cosine and the sine of its first orientation.
        spans: of each pair the start, exactly, and an end that is not before the exact one.
        contacts: of which the times are bounds, and perhaps after the span.
    """
    m = len(bodies) // 2
    i, j = np.arange(2 * m).reshape(-1, 2).T
    poses, (places, radii) = _poses_of(bodies, turns, spans), _places_of(bodies, turns)
    overlaps, unclear = _at_start(bodies, turns, spans, places, radii)
    record_overlaps(contacts, np.flatnonzero(overlaps), spans.start[overlaps])
    counts = o.vertex_count[i] * o.edge_count[j] + o.vertex_count[j] * o.edge_count[i]
    contacts.exact[unclear | (counts > LARGEST)] = True
    left = np.flatnonzero(~(overlaps | contacts.exact))
    for first, last in ranges(counts[left], CHUNK):
        k = left[first:last]
        candidates, _ = all_candidates(o, i[k], j[k])
        candidates = candidates._replace(pair=k[candidates.pair])
        polynomials, error = _polynomials(o, poses, candidates, places, radii)
        hits, low, high, open_ = _first_roots(polynomials, error, candidates.pair, m)
        contacts.exact[open_] = True
        found, pair = candidates.take(hits), candidates.pair[hits]
        start, length = poses.start[pair], poses.length[pair]
        off = 8.0 * U * (np.abs(start) + length)
        low = np.maximum(start, start + low * length - off)
        high = start + high * length + off
        record_edges(
            contacts, pair, low, high, found.second, *found.numbered(o, *found.bodies(i, j))
        )


def _places_of(bodies: BodyArrays, turns: Floats) -> tuple[Complex, Floats]:
    """Return q and R of each vertex."""
    of = np.repeat(np.arange(len(bodies)), native(np.diff(bodies.offsets)))
    pivots, of_first = turns[:, 2] + 1j * turns[:, 3], turns[:, 4] + 1j * turns[:, 5]
    at = bodies.vertices[:, 0] + 1j * bodies.vertices[:, 1]
    radii = np.abs(bodies.vertices).sum(axis=1) + np.abs(turns[of, 2:4]).sum(axis=1)
    return (at - pivots[of]) * of_first[of], radii


def _poses_of(bodies: BodyArrays, turns: Floats, spans: Spans) -> Poses:
    """Return the motions during the spans, which are lengthened by `BEYOND`."""
    start = spans.start
    length = (spans.end - start) * (1.0 + BEYOND)
    times = np.repeat(np.stack((start, start + length), axis=1), 2, axis=0)
    most = np.abs(times).max(axis=1)
    a = np.asarray(1.0 + 1j * (turns[:, :1] + turns[:, 1:2] * times), dtype=np.complex128)
    size = 1.0 + np.abs(turns[:, 0]) + np.abs(turns[:, 1]) * most
    c = bodies.coefficients[:, 0] + 1j * bodies.coefficients[:, 1]
    c[:, 0] += turns[:, 2] + 1j * turns[:, 3]
    ends = times[:, [0, 0, 1]], times[:, [0, 1, 1]]
    path = c[:, :1] + c[:, 1:2] * (0.5 * (ends[0] + ends[1])) + c[:, 2:] * (ends[0] * ends[1])
    powers = np.abs(bodies.coefficients).sum(axis=1) * most[:, None] ** np.arange(3)
    reach = powers.sum(axis=1) + np.abs(turns[:, 2:4]).sum(axis=1)
    square, length_of, (p, q) = _product(a, a), _product(a, a.conj()), (path[::2], path[1::2])
    one, other = slice(0, None, 2), slice(1, None, 2)
    flat = np.ones((len(p), 3))
    turned = _product(square[one], square[other].conj())
    moved = [
        _product(_product(square[f].conj(), length_of[g]), d)
        for f, g, d in ((other, one, p - q), (one, other, q - p))
    ]
    back = _product(turned, flat)
    return Poses(
        np.stack(moved),
        np.stack((back, back.conj())),
        _product(_product(length_of[one], length_of[other]), flat),
        (size[one] * size[other]) ** 2,
        reach[one] + reach[other],
        start,
        length,
    )


def _product(f: Complex, g: Complex | Floats) -> Complex:
    """Return the Bernstein coefficients of a product, in rows."""
    m, n = f.shape[1] - 1, g.shape[1] - 1
    product = np.zeros((len(f), m + n + 1), dtype=np.complex128)
    for i in range(m + 1):
        for j in range(n + 1):
            product[:, i + j] += comb(m, i) * comb(n, j) / comb(m + n, i + j) * (f[:, i] * g[:, j])
    return product


def _at_start(
    bodies: BodyArrays, turns: Floats, spans: Spans, places: Complex, radii: Floats
) -> tuple[Flags, Flags]:
    """Return which pairs surely overlap at the start, without an incidence, and which are open.

    A vertex is off by at most 64 U A (C + R) at that time.
    """
    sizes = native(np.diff(bodies.offsets))
    t = np.repeat(spans.start, 2)
    a = 1.0 + 1j * (turns[:, 0] + turns[:, 1] * t)
    c, powers = bodies.coefficients, t[:, None] ** np.arange(3)
    path = ((c[:, 0] + 1j * c[:, 1]) * powers).sum(axis=1) + turns[:, 2] + 1j * turns[:, 3]
    at = np.repeat(path, sizes) + places * np.repeat(a / a.conj(), sizes)
    reach = (np.abs(c).sum(axis=1) * np.abs(powers)).sum(axis=1) + np.abs(turns[:, 2:4]).sum(axis=1)
    size = 1.0 + np.abs(turns[:, 0]) + np.abs(turns[:, 1] * t)
    size *= reach + np.maximum.reduceat(radii, native(bodies.offsets[:-1]))
    moderate = size < MOST
    at[~np.repeat(moderate, sizes)] = 0.0
    off = np.where(moderate, 64.0 * U * size * SLACK + TINY, np.inf)
    still = BodyArrays(np.stack((at.real, at.imag), axis=1), bodies.offsets, closed=bodies.closed)
    i, j = np.arange(len(bodies)).reshape(-1, 2).T
    motions = relative_motions(still.coefficients, i, j, spans, off)
    return at_start(outlines_of(still), i, j, motions)


def _polynomials(
    o: Outlines, poses: Poses, candidates: Candidates, places: Complex, radii: Floats
) -> tuple[Floats, Floats]:
    """Return f, g and h, shape (7, 3, rows), and bounds on the errors of their coefficients.

    The edge of a point has the direction (1, 0) and the length 0: h is -g.
    """
    k, second, v = candidates.pair, candidates.second, candidates.vertex
    first, last = o.edges.first[candidates.edge], o.edges.last[candidates.edge]
    p, u = places[first], places[last] - places[first]
    square = u.real * u.real + u.imag * u.imag
    u[first == last] = 1.0
    weight = poses.weight[k]
    at = poses.moved[second, k] + poses.turned[second, k] * places[v][:, None] - weight * p[:, None]
    z = (at * u.conj()[:, None]).T
    h = (weight.real * square[:, None]).T - z.real
    both = np.where(first == last, 1.0, radii[first] + radii[last])
    size = poses.size[k] * both * (poses.reach[k] + radii[v] + radii[first] + both)
    moderate = (1.0 + poses.size[k]) * (1.0 + both) * (1.0 + size) < MOST
    error = np.where(moderate, UNIT * size + TINY, np.inf)
    return np.stack((z.imag, z.real, h), axis=1), error


def _first_roots(
    p: Floats, error: Floats, pair: Indices, count: int
) -> tuple[Indices, Floats, Floats, Flags]:
    """Return the rows that are the first in their pair where a vertex is on its edge.

    That is sure when one row and one span of it are left, with a root of f inside the edge, of
    which f is monotone there. Rows are left out after the first such root in their pair.

    Args:
        p: f, g and h of each row.
        error: the bounds on the errors of the coefficients.
        pair: the pair of each row.
        count: the number of pairs.

    Returns:
        The rows, the bounds of their times as parts of the span, and which pairs are open.
    """
    row, low, width = np.arange(len(pair)), np.zeros(len(pair)), 1.0
    open_ = np.zeros(count, dtype=np.bool_)
    found: list[tuple[Indices, Floats, Floats]] = [(row[:0], low[:0], low[:0])]
    for _ in range(DEPTH):
        check_budget()
        e, most = error[row], p.max(axis=0)
        may = ~((p[:, 0].min(axis=0) > e) | (most < -e).any(axis=0))
        row, low, p = row[may], low[may], p[:, :, may]
        sure = _is_sure(p, error[row])
        best = np.full(count, np.inf)
        np.minimum.at(best, pair[row[sure]], low[sure] + width)
        left = (low < best[pair[row]]) & ~open_[pair[row]]
        row, low, p, sure = row[left], low[left], p[:, :, left], sure[left]
        counts = np.bincount(pair[row], minlength=count)
        open_ |= counts > FEW
        alone = sure & (counts[pair[row]] == 1)
        found.append((row[alone], low[alone], low[alone] + width))
        row, low, p = row[~alone], low[~alone], p[:, :, ~alone]
        if not len(row):
            break
        width *= 0.5
        row, low = np.concatenate((row, row)), np.concatenate((low, low + width))
        p = _halved(p)
    open_[pair[row]] = True
    rows, lows, highs = (np.concatenate(columns) for columns in zip(*found, strict=True))
    return rows, lows, highs, open_


def _is_sure(p: Floats, error: Floats) -> Flags:
    """Return where f surely has one root, and g and h are positive."""
    f = p[:, 0]
    slope = np.diff(f, axis=0)
    rising = (slope.min(axis=0) > 4.0 * error) & (f[0] < -error) & (f[-1] > error)
    falling = (slope.max(axis=0) < -4.0 * error) & (f[0] > error) & (f[-1] < -error)
    sure: Flags = (rising | falling) & (p[:, 1:].min(axis=(0, 1)) > error)
    return sure


def _halved(p: Floats) -> Floats:
    """Return the coefficients on the first halves of the spans, then those on the second ones."""
    n = len(p)
    halves = np.empty((n, 3, 2, p.shape[2]))
    for k in range(n):
        halves[k, :, 0], halves[n - 1 - k, :, 1] = p[0], p[-1]
        p = 0.5 * (p[:-1] + p[1:])
    return halves.reshape(n, 3, -1)
