"""The pairs of features of two bodies that may be nearest during a time interval: a float filter.

During an interval, let vertex i be within r_i of a point c_i. A point of an edge, at the same ratio
of its ends, is then within the larger r of its ends of a point of the segment of their c. So the
distance of two features is that of their points and segments c, up to R, the sum of the two
radii. A pair whose distance is always larger than that of another pair at the same time is not
nearest: one whose least distance, d - R, exceeds the least of all d + R. The others are kept, among
them all that are nearest at any time of the closed interval. The foot of a perpendicular is surely
beyond an end of an edge where the scalar product of u, along the edge from there, and w, to the
vertex, is below -(|u| r_w + |w| r_u + r_u r_w) for their bounds r_u, r_w: then another pair, that
of the end, is as near, and this one does not hold (`FeaturePair.holds_after`), even just after.

Rounding. Let M be the largest size of a coordinate of the c, below 2^400. For a vertex at w and an
edge along u from one of its ends, at most 2^1.5 M long both, (w . u) / |u|^2 is off by less than
14 U |w| / |u|, so the foot, which stays on the edge, by less than 40 U M; computing it and the
distance adds less than 30 U M. An edge shorter than 2^-150 counts as its end. So distances are off
by less than 128 U M + 2^-149; `SLACK` covers the rounding of R and of the sums. A scalar product is
off by less than 8 U |u| |w|, of which 16 U are taken, and 2^-900 for underflow.

Translations. If each body translates, the vectors z between points of the two bodies are z + s
after the middle of the interval, with one s for all of them and |s| <= r. Let z be the vector of
the pair that seems nearest, u a unit vector near its direction, a = u . z and b = |u x z|. Its
distance is at most u . (z + s) + (b + r)^2 / (2 (a - r)), as sqrt(x^2 + y^2) <= x + y^2 / (2 x),
that of another pair is at least u . (z' + s), the least of its ends: it is always larger if
u . z' - a exceeds the quotient, which is of second order in r. Let e bound how far all vertices are
off their places in the middle. |u| is off 1 by less than 4 U and u . x by less than 8 U M; so
128 U M + 4 e + 2^-149 covers all sums, and is added to b and to r too.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Final, final

import numpy as np

from exactpt.cached_property import cached_property
from exactpt.filters.rounding import SLACK, U, check_rounding
from exactpt.geometry.boxes import Boxes, crossing_pairs, grown
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Flags, Floats, Indices
from exactpt.kernel.numbers import QQ, enclosing_floats, power_of_two
from exactpt.motion.body import Body
from exactpt.motion.enclosures import Enclosures
from exactpt.motion.normalization import Normalization, normalization_for
from exactpt.motion.swept import SweptBoxes
from exactpt.motion.track import Track
from exactpt.pair.features import FeaturePair, feature_pairs
from exactpt.pair.pieces_of_two import PiecePair

ENOUGH: Final = 16
"""Number of pairs of features that are compared exactly."""
LARGEST: Final = 2.0**400
PARTS: Final = 32
"""Number of parts of a time interval in which boxes are compared."""
SHORT: Final = 2.0**-300
"""Square of the length below which an edge counts as its end."""


@final
class NearFeatures:
    """The pairs of features of two bodies in a time interval, numbered as in `feature_pairs`."""

    def __init__(self, a: Body, b: Body, piece_pair: PiecePair) -> None:
        check_rounding()
        self._two = a, b
        self._piece_pair = piece_pair
        p, q = piece_pair.first, piece_pair.second
        places = [track.exact_at(piece_pair.begin) for track in (*p, *q)]
        normalization = normalization_for(places, piece_pair.begin, piece_pair.end)
        scale = max(normalization.scale)  # one for both axes: distances are compared
        self._normalization = Normalization(
            normalization.center, (scale, scale), normalization.origin, normalization.time_scale
        )
        enclosures = Enclosures(self._normalization)
        self._boxes = SweptBoxes(enclosures.float_tracks([*p, *q]), enclosures.errors)
        self._pairs: dict[int, FeaturePair] = {}
        self._translates = all(map(_translate, (p, q)))

    @cached_property
    def all(self) -> Indices:
        """The numbers, in increasing order, of all pairs that may be nearest in the interval."""
        n, m = len(self._piece_pair.first), len(self._piece_pair.second)
        first, second = np.ones(n, np.bool_), np.ones(m, np.bool_)
        if self._translates:
            begin, end = self._piece_pair.begin, self._piece_pair.end
            boxes, there = self._during(begin, end), self._between(begin, end)
            x, y = there[:, 0], there[:, 2]
            i, j = 0, n
            for _ in range(ENOUGH):  # vertices that are near each other
                i = _nearest(x[:n], y[:n], x[j], y[j])
                j = n + _nearest(x[n:], y[n:], x[i], y[i])
            along, bound = _beyond(boxes, there, np.array([j]), np.array([i]), np.array([i]))
            first = ~(along[n:].min() - along[:n] > bound)
            second = ~(along[n:] - along[:n].max() > bound)
        edges = [np.array(body.edges, np.int64).reshape(-1, 2) for body in self._two]
        e, f = (
            np.flatnonzero(near[at].any(axis=1))
            for near, at in zip((first, second), edges, strict=True)
        )
        p, q, start = first.nonzero()[0], second.nonzero()[0], (n + len(edges[0])) * m
        products = (p * m, q), ((n + e) * m, q), (start + p * len(edges[1]), f)
        return np.concatenate([np.add.outer(*two).ravel() for two in products])

    @cached_property
    def _ends(self) -> tuple[Indices, Indices, Indices]:
        """The vertex and the ends of the edge of each pair; of a vertex, twice the vertex.

        Vertices of the second body are numbered after those of the first one.
        """
        n, m = len(self._piece_pair.first), len(self._piece_pair.second)
        e = np.concatenate([np.arange(n).repeat(2), np.array(self._two[0].edges, int).ravel()])
        f = n + np.array(self._two[1].edges, int).reshape(-1, 2)
        of_second = self.all >= len(e) // 2 * m
        i, j = np.divmod(self.all[~of_second], m)
        k, g = np.divmod(self.all[of_second] - len(e) // 2 * m, max(1, len(f)))
        ends = np.concatenate([e.reshape(-1, 2)[i], f[g]])
        return np.concatenate([n + j, k]), ends[:, 0], ends[:, 1]

    def _during(self, begin: QQ, end: QQ) -> Boxes:
        """Return the boxes of all vertices during an interval."""
        return self._boxes.during(
            self._normalization.time(begin)[0], self._normalization.time(end)[1]
        )

    def _between(self, begin: QQ, end: QQ) -> Boxes:
        """Return the boxes of all vertices in the middle of an interval."""
        middle = 0.5 * (self._normalization.time(begin)[0] + self._normalization.time(end)[1])
        return self._boxes.during(middle, middle)

    def pairs(self, numbers: Indices) -> list[FeaturePair]:
        """Return the pairs with these numbers, each made once."""
        made, new = self._pairs, [k for k in numbers.tolist() if k not in self._pairs]
        if new:
            of_new = feature_pairs(*self._two, self._piece_pair.first, self._piece_pair.second, new)
            made.update(zip(new, of_new, strict=True))
        return [made[k] for k in numbers.tolist()]

    def within(self, reach: QQ, parts: int = PARTS) -> Indices:
        """Return the pairs whose features may come within a distance of each other.

        They do only where their boxes do, during one of so many equal parts of the interval.
        """
        by = enclosing_floats(reach * power_of_two(-self._normalization.scale[0]))[1]
        low, high = (
            self._normalization.time(self._piece_pair.begin)[0],
            self._normalization.time(self._piece_pair.end)[1],
        )
        n, m = len(self._piece_pair.first), len(self._piece_pair.second)
        (e, e_to), (f, f_to) = (np.array(body.edges, int).reshape(-1, 2).T for body in self._two)
        found: list[Indices] = []
        for first, last in pairwise(np.linspace(low, high, parts + 1).tolist()):
            check_budget()
            boxes = self._boxes.during(first, last)
            p, q = grown(boxes[:n], by), boxes[n:]
            found += [i * m + j for i, j in crossing_pairs(p, q)]
            edges = joined(p[e], p[e_to])
            found += [n * m + i * m + j for i, j in crossing_pairs(edges, q)]
            edges = joined(q[f], q[f_to])
            start = (n + len(e)) * m
            found += [start + i * len(f) + j for i, j in crossing_pairs(p, edges)]
        return np.unique(np.concatenate(found))

    def nearest(self, numbers: Indices, low: QQ, high: QQ) -> Indices:
        """Return those pairs that may be nearest of these pairs at a time from low to high."""
        check_budget()
        at = np.searchsorted(self.all, numbers)
        v, a, b = (ends[at] for ends in self._ends)
        boxes = self._during(low, high)
        kept = np.flatnonzero(may_be_least(boxes, v, a, b))
        if self._translates and len(kept) > ENOUGH:
            v, a, b = v[kept], a[kept], b[kept]
            along, bound = _beyond(boxes, self._between(low, high), v, a, b)
            side = np.where(v < a, -1.0, 1.0)
            gaps = np.minimum(side * (along[v] - along[a]), side * (along[v] - along[b]))
            kept = kept[~(gaps > bound)]
        return numbers[kept]


def joined(some: Boxes, others: Boxes) -> Boxes:
    """Return for each two boxes the least box that contains both."""
    boxes = np.maximum(some, others)
    boxes[:, ::2] = np.minimum(some[:, ::2], others[:, ::2])
    return boxes


@np.errstate(all="ignore")
def may_be_least(boxes: Boxes, v: Indices, a: Indices, b: Indices) -> Flags:
    """Return which pairs of a vertex and an edge may be nearest; see the module."""
    x, y = 0.5 * (boxes[:, 0] + boxes[:, 1]), 0.5 * (boxes[:, 2] + boxes[:, 3])
    off_x = np.maximum(boxes[:, 1] - x, x - boxes[:, 0])
    off_y = np.maximum(boxes[:, 3] - y, y - boxes[:, 2])
    radius = np.hypot(off_x, off_y) * SLACK
    size = max(np.abs(x).max(), np.abs(y).max())
    if not size < LARGEST:
        return np.ones(len(v), np.bool_)
    ux, uy, wx, wy = x[b] - x[a], y[b] - y[a], x[v] - x[a], y[v] - y[a]
    square = ux * ux + uy * uy
    at = np.clip((ux * wx + uy * wy) / np.maximum(square, SHORT), 0.0, 1.0)
    at[square < SHORT] = 0.0
    d = np.hypot(wx - at * ux, wy - at * uy)
    off = (radius[v] + np.maximum(radius[a], radius[b]) + 128.0 * U * size + 2.0**-149) * SLACK
    is_far = d - off > (d + off).min() * SLACK
    off_edge = radius[a] + radius[b]
    from_b = x[v] - x[b], y[v] - y[b]
    for along, (zx, zy), end in ((1.0, (wx, wy), a), (-1.0, from_b, b)):
        off_w, length, far = radius[v] + radius[end], np.hypot(ux, uy), np.hypot(zx, zy)
        error = length * off_w + far * off_edge + off_edge * off_w + 16.0 * U * length * far
        is_far |= (a != b) & (along * (ux * zx + uy * zy) < -(error * SLACK + 2.0**-900))
    kept: Flags = ~is_far
    return kept


@np.errstate(all="ignore")
def _beyond(boxes: Boxes, there: Boxes, v: Indices, a: Indices, b: Indices) -> tuple[Floats, float]:
    """Return u . x of all vertices, and a bound of u . z for pairs of bodies that translate.

    Pairs of which it is always larger are not nearest (see the module); u points from the first to
    the second body, along the pair of a vertex v and an edge from a to b that is nearest of those
    given. A bound of NaN excludes none. Boxes are of the vertices, during the interval and in the
    middle of it.
    """
    x, y = 0.5 * (there[:, 0] + there[:, 1]), 0.5 * (there[:, 2] + there[:, 3])
    size = max(np.abs(x).max(), np.abs(y).max())
    away = np.maximum(
        np.abs(boxes[:, ::2] - there[:, 1::2]), np.abs(boxes[:, 1::2] - there[:, ::2])
    )
    error = 4.0 * (there[:, 1::2] - there[:, ::2]).max() + 128.0 * U * size + 2.0**-149
    ux, uy, wx, wy = x[b] - x[a], y[b] - y[a], x[v] - x[a], y[v] - y[a]
    at = np.clip((ux * wx + uy * wy) / np.maximum(ux * ux + uy * uy, SHORT), 0.0, 1.0)
    zx, zy = wx - at * ux, wy - at * uy
    best = int(np.argmin(np.hypot(zx, zy)))
    length = math.hypot(zx[best], zy[best])
    ux, uy = zx[best] / length, zy[best] / length
    r = (np.hypot(*away[v[best]]) + np.hypot(*away[a[best]]) + error) * SLACK
    beside = abs(ux * zy[best] - uy * zx[best]) + r + error
    bound = (length + 0.5 * beside**2 / (length - r) + error) * SLACK
    side = -1.0 if v[best] < a[best] else 1.0
    return side * (ux * x + uy * y), bound if length > 2.0 * r and size < LARGEST else math.nan


@np.errstate(all="ignore")
def _nearest(xs: Floats, ys: Floats, x: float, y: float) -> int:
    """Return the number of a point that is about nearest to (x, y)."""
    return int(np.argmin(np.hypot(xs - x, ys - y)))


def _translate(tracks: tuple[Track, ...]) -> bool:
    """Return True if the vertices of a body surely translate together."""
    motion = tracks[0].motion
    return motion is not None and all(t.motion == motion and len(t.w) == 1 for t in tracks)
