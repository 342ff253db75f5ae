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
"""

from __future__ import annotations

from itertools import pairwise
from typing import Final, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from exactpt.geometry.boxes import Boxes, Indices, crossing_pairs, grown
from exactpt.kernel.budget import ask
from exactpt.kernel.numbers import QQ, enclosing_floats, power_of_two
from exactpt.kernel.rounding import SLACK, U, check_rounding
from exactpt.motion.body import Body
from exactpt.motion.enclosures import Enclosures
from exactpt.motion.frame import Frame, frame_for
from exactpt.motion.swept import SweptBoxes
from exactpt.pairs.features import FeaturePair, feature_pairs
from exactpt.pairs.stretches import Stretch

Floats: TypeAlias = NDArray[np.float64]

LARGEST: Final = 2.0**400
PARTS: Final = 32
"""Number of parts of a stretch in which boxes are compared."""
SHORT: Final = 2.0**-300
"""Square of the length below which an edge counts as its end."""


@final
class NearFeatures:
    """The pairs of features of two bodies in a stretch of time, numbered as in `feature_pairs`.

    Attributes:
        all: the numbers of all pairs.
    """

    def __init__(self, a: Body, b: Body, stretch: Stretch) -> None:
        check_rounding()
        self._two = a, b
        self._stretch = stretch
        p, q = stretch.first, stretch.second
        places = [track._at(stretch.begin) for track in (*p, *q)]
        frame = frame_for(places, stretch.begin, stretch.end)
        scale = max(frame.scale)  # one for both axes: distances are compared
        self._frame = Frame(frame.center, (scale, scale), frame.origin, frame.time_scale)
        enclosures = Enclosures(self._frame)
        self._boxes = SweptBoxes(enclosures.images([*p, *q]), enclosures.errors)
        self._pairs: dict[int, FeaturePair] = {}
        self._vertex, self._from, self._to = _ends(a, b, len(p), len(q))
        self.all: Indices = np.arange(len(self._vertex))

    def pairs(self, numbers: Indices) -> list[FeaturePair]:
        """Return the pairs with these numbers, each made once."""
        made, new = self._pairs, [k for k in numbers.tolist() if k not in self._pairs]
        if new:
            of_new = feature_pairs(*self._two, self._stretch.first, self._stretch.second, new)
            made.update(zip(new, of_new, strict=True))
        return [made[k] for k in numbers.tolist()]

    def within(self, reach: QQ) -> Indices:
        """Return the pairs whose features may come within a distance of each other.

        They do only where their boxes do, during one of the parts of the stretch.
        """
        by = enclosing_floats(reach * power_of_two(-self._frame.scale[0]))[1]
        low, high = self._frame.time(self._stretch.begin)[0], self._frame.time(self._stretch.end)[1]
        n, m = len(self._stretch.first), len(self._stretch.second)
        (e, e_to), (f, f_to) = (np.array(body.edges, int).reshape(-1, 2).T for body in self._two)
        found: list[Indices] = []
        for first, last in pairwise(np.linspace(low, high, PARTS + 1).tolist()):
            ask()
            boxes = self._boxes.during(first, last)
            p, q = grown(boxes[:n], by), boxes[n:]
            found += [i * m + j for i, j in crossing_pairs(p, q)]
            edges = _joined(p[e], p[e_to])
            found += [n * m + i * m + j for i, j in crossing_pairs(edges, q)]
            edges = _joined(q[f], q[f_to])
            start = (n + len(e)) * m
            found += [start + i * len(f) + j for i, j in crossing_pairs(p, edges)]
        return np.unique(np.concatenate(found))

    def nearest(self, numbers: Indices, low: QQ, high: QQ) -> Indices:
        """Return those pairs that may be nearest of these pairs at a time from low to high."""
        ask()
        boxes = self._boxes.during(self._frame.time(low)[0], self._frame.time(high)[1])
        ends = self._vertex[numbers], self._from[numbers], self._to[numbers]
        return numbers[_may_be_least(boxes, *ends)]


def _joined(some: Boxes, others: Boxes) -> Boxes:
    """Return for each two boxes the least box that contains both."""
    boxes = np.maximum(some, others)
    boxes[:, ::2] = np.minimum(some[:, ::2], others[:, ::2])
    return boxes


@np.errstate(all="ignore")
def _may_be_least(boxes: Boxes, v: Indices, a: Indices, b: Indices) -> NDArray[np.bool_]:
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
    kept: NDArray[np.bool_] = ~is_far
    return kept


def _ends(a: Body, b: Body, n: int, m: int) -> tuple[Indices, Indices, Indices]:
    """Return the vertex and the ends of the edge of all pairs; of a vertex, twice the vertex.

    Vertices of the second body are numbered from n on.
    """
    first, second = np.arange(n), n + np.arange(m)
    e = np.array(a.edges, np.int64).reshape(-1, 2)
    f = np.array(b.edges, np.int64).reshape(-1, 2) + n
    vertex = [np.tile(second, n), np.tile(second, len(e)), np.repeat(first, len(f))]
    start = [np.repeat(first, m), np.repeat(e[:, 0], m), np.tile(f[:, 0], n)]
    stop = [start[0], np.repeat(e[:, 1], m), np.tile(f[:, 1], n)]
    return np.concatenate(vertex), np.concatenate(start), np.concatenate(stop)
