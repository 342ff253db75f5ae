"""Two pieces in straight motion, without radius: when may a vertex be on an edge of the other?

Relative to the second piece, all vertices of the first one are displaced by c + w t at time t, with
the same c and w. Let z = p - q + c for a vertex at the place p and an edge from q to q + u::

                    * z + w t          f(t) = u x (z + w t) = c0 + c1 t
                   /                   c0 = u x z,  c1 = u x w
                  /
      q o--------/-------> q + u       on the line of the edge:  f(t) = 0, at t = -c0 / c1
                * z                    between its ends:         0 <= u . (z + w t) <= u . u

So the orientation f of the vertex and the edge is linear in t: they touch at one time at most,
unless the vertex moves in parallel to the edge.

What is proved. A vertex and an edge that are dropped certainly do not touch in the window. A
candidate does not touch in the window before its ``low``, nor after its ``high``. A *sure*
candidate certainly touches between the two, at a time when both pieces exist, so that
`Candidates.limit` may fall to ``high``. Every drop and every "sure" needs a comparison that is
false for NaN: if something overflows or is unknown, the pair is a candidate, which may touch in the
whole window.

Errors. z, w, u, c0, c1, t are doubles; exact values have a prime. |z| means |zx| + |zy|, and K is
`ROUNDING`, 16 U. Each line below needs at most 8 U of the terms that it has K times. The rest of K,
and `SLACK`, cover the rounding of the bounds themselves, and products of two errors of which one is
U. `TINY` covers underflow: that of a product that is multiplied once more is in d, which is at
least `TINY`.

*Motion.* The table bounds the errors of coordinates of places, paths and speeds. The difference of
two doubles is off by U of itself. So w is off by w_error = the sum of two speed errors + 2 U |w|,
which is no number if w is none; and c by c_error = the sum of two path errors, and U |c|.

*Vertex.* z is rounded twice: p - q, which is at most |z| + |c|, and the sum. So each coordinate of
z is off by at most 2 U of itself and
    d = 2 (two place errors + c_error) + K |c| + TINY.

*Edge.* Both ends are off by a place error: a coordinate of u by U of itself and d.

*Coefficients.* With u' = u + du, z' = z + dz the error of u x z is u x dz + du x z + du x dz and
the rounding of two products and a difference, so at most
    e0 = K (|ux zy| + |uy zx|) + d (|u| + |z| + 2 d),
and that of u x w is in the same way at most
    e1 = K (|ux wy| + |uy wx|) + d |w| + w_error (|u| + 2 d).

*Time.* Let |c1| > e1, so that c1' is not 0. f'(t) is at most e0 + e1 |t|, as f(t) = 0, and f' has a
slope of at least |c1| - e1. So the zero t' of f' is as near to t as
    r = (e0 + e1 |t|) / (|c1| - e1),
which covers the rounding of the quotient and of t - r, t + r, as e1 has 8 U |c1| to spare.
If |c1| <= e1, the vertex may move in parallel to the edge. In a window of times up to T it does not
come to its line if |c0| > e0 + (|c1| + e1) T.

*Foot.* At the time t' the vertex is at m' = z' + w' t', and m = z + w t is off by at most
    s = d + |w| r + w_error (|t| + r) + K (|z| + |w t|)
in each coordinate. So m . u is off by s (|u| + 2 d) + d |m|, and u . u by 2 d (2 |u| + d), apart
from the rounding, of at most K (|m| |u| + u . u).

*When both exist.* Formulas go on before the start and behind the end of a piece. `Table.start` is
the last double that is not after the exact start, and `Table.end` the first one that is not before
the exact end: a double after the one and before the other is a time of the piece.

The bound for the zero of a linear function is that of `exactpt.certificates.first_root.linear`.
"""

from __future__ import annotations

from typing import Final

from librt.vecs import append, vec
from mypy_extensions import i64

from exactpt.filters.blocks import FEW, Blocks, next_near
from exactpt.filters.boxes import strips
from exactpt.filters.candidates import Candidates, vertex_on_edge
from exactpt.filters.models import ROUNDING
from exactpt.filters.rounding import INFINITY, SLACK, SMALL, TINY, U2
from exactpt.filters.rows import FRAME, PATH_X, PATH_Y, Table

FEW_PAIRS: Final[i64] = 24
"""Number of pairs of features of two pieces up to which all of them are compared."""
MANY_PAIRS: Final[i64] = 4096
"""Number of pairs of features above which their boxes are swept."""
SPEED: Final[i64] = 1
"""In a path, the number of w after that of c."""

BESIDE_EDGE: Final[i64] = 0
"""The foot of the vertex is certainly not on the edge."""
MAYBE_ON_EDGE: Final[i64] = 1
ON_EDGE: Final[i64] = 2
"""The foot is certainly between the ends of the edge."""


class RelativeMotion:
    """The motion c + w t of one piece relative to another one.

    Attributes:
        cx, cy, wx, wy: the coefficients.
        c_error: a bound on the errors of cx and cy, their rounding aside.
        w_error: a bound on the errors of wx and wy; infinite or NaN if wx or wy is.
    """

    def __init__(
        self, cx: float, cy: float, wx: float, wy: float, c_error: float, w_error: float
    ) -> None:
        self.cx = cx
        self.cy = cy
        self.wx = wx
        self.wy = wy
        self.c_error = c_error
        self.w_error = w_error

    def reversed(self) -> RelativeMotion:
        """Return the motion of the other piece relative to the one."""
        return RelativeMotion(-self.cx, -self.cy, -self.wx, -self.wy, self.c_error, self.w_error)


def relative_motion(table: Table, a: i64, b: i64) -> RelativeMotion:
    """Return the motion of piece a relative to piece b."""
    cx, wx = relative_path(table, a, b, PATH_X)
    cy, wy = relative_path(table, a, b, PATH_Y)
    c_error = table.path_error[a] + table.path_error[b]
    w_error = table.speed_error[a] + table.speed_error[b] + U2 * (abs(wx) + abs(wy))
    return RelativeMotion(cx, cy, wx, wy, c_error, w_error)


def relative_path(table: Table, a: i64, b: i64, axis: i64) -> tuple[float, float]:
    """Return c and w of piece a relative to piece b, along one axis."""
    frames, i, j = table.frames, FRAME * a + axis, FRAME * b + axis
    return frames[i] - frames[j], frames[i + SPEED] - frames[j + SPEED]


def meeting(table: Table, a: i64, b: i64, low: float, high: float) -> tuple[float, float]:
    """Return bounds of the times in [low, high] at which the boxes of two pieces intersect.

    The first bound is larger than the second if they do not intersect at all. With R, the sum of
    the radii, the boxes intersect along x while
        (left of b - right of a) - R <= cx + wx t <= (right of b - left of a) + R.
    The error is that of two places, of c, and of w times |t|. The two bounds are 2 R or more apart,
    so their sizes add up to 2 R at least: of these sizes `while_between` takes `ROUNDING`, which
    covers the rounding of the differences with R, too.
    """
    cx, wx = relative_path(table, a, b, PATH_X)
    cy, wy = relative_path(table, a, b, PATH_Y)
    c_error = table.path_error[a] + table.path_error[b]
    w_error = table.speed_error[a] + table.speed_error[b] + U2 * (abs(wx) + abs(wy))
    error = table.place_error[a] + table.place_error[b] + c_error + w_error * larger_size(low, high)
    reach = (table.radius[a] + table.radius[b]) * SLACK
    left_a, right_a, bottom_a, top_a = table.box(a)
    left_b, right_b, bottom_b, top_b = table.box(b)
    first_x, last_x = (left_b - right_a) - reach, (right_b - left_a) + reach
    first_y, last_y = (bottom_b - top_a) - reach, (top_b - bottom_a) + reach
    low, high = while_between(cx, wx, first_x, last_x, error, low, high)
    return while_between(cy, wy, first_y, last_y, error, low, high)


def while_between(
    c: float, w: float, least: float, most: float, error: float, low: float, high: float
) -> tuple[float, float]:
    """Return bounds of the times in [low, high] at which least <= c + w t <= most, up to an error.

    The first bound is larger than the second if there are none. The margin is twice the error, and
    `ROUNDING` times the sizes for the rounding of c, of the given differences, of two more, and of
    the quotient; `TINY` is for its underflow. A NaN excludes no time: as the second argument of
    ``max`` or ``min`` it is ignored.
    """
    margin = 2.0 * error + ROUNDING * (abs(c) + abs(least) + abs(most)) + TINY
    least, most = (least - margin) - c, (most + margin) - c
    if w > 0.0:
        enter, leave = least / w, most / w
    elif w < 0.0:
        enter, leave = most / w, least / w
    elif least > 0.0 or most < 0.0:
        return INFINITY, -INFINITY
    else:
        return low, high
    return max(low, enter - TINY), min(high, leave + TINY)


def collect(
    table: Table, a: i64, b: i64, low: float, high: float, after: float, found: Candidates
) -> None:
    """Add the candidates of two pieces in [low, high], and lower the limit by the sure ones.

    Args:
        table: the pieces.
        a: a piece in straight motion, without radius.
        b: another one.
        low: the begin of a window, not NaN, within the spans of both pieces.
        high: its end.
        after: the two are disjoint up to this time.
        found: the candidates; later times than its limit do not matter.
    """
    motion = relative_motion(table, a, b)
    there = Passage(table, motion, a, b, after)
    there.collect(low, high, found)
    back = Passage(table, motion.reversed(), b, a, after)
    back.collect(low, high, found)


class Passage:
    """The vertices of one piece that pass the edges of another one.

    Attributes:
        table: the pieces.
        a, b: the piece of the vertices, and that of the edges.
        motion: that of a relative to b.
        d: a bound on the errors of z and u, their rounding aside.
        w_size: |wx| + |wy|.
        exist_after, exist_before: both pieces exist at each double between these two, and are not
            known to be disjoint.
        low, high: the window.
        times: the largest |t| in the window.
        least_x, most_x, least_y, most_y: bounds of the displacement c + w t in the window, moved
            outward by the errors of the places of two features.
    """

    def __init__(self, table: Table, motion: RelativeMotion, a: i64, b: i64, after: float) -> None:
        self.table = table
        self.motion = motion
        self.a = a
        self.b = b
        errors = table.place_error[a] + table.place_error[b] + motion.c_error
        self.d = 2.0 * errors + ROUNDING * (abs(motion.cx) + abs(motion.cy)) + TINY
        self.w_size = abs(motion.wx) + abs(motion.wy)
        start = max(table.start[a], table.start[b])
        self.exist_after = max(after, start)
        self.exist_before = min(table.end[a], table.end[b])
        self.low = 0.0
        self.high = 0.0
        self.times = 0.0
        self.least_x = -INFINITY
        self.most_x = INFINITY
        self.least_y = -INFINITY
        self.most_y = INFINITY

    def collect(self, low: float, high: float, found: Candidates) -> None:
        """Add the candidates in a window."""
        self.set_window(low, min(high, found.limit))
        vertices_count, edges_count = self.table.size[self.a], self.table.edges[self.b]
        if vertices_count * edges_count <= FEW_PAIRS:
            edge: i64 = 0
            while edge < edges_count:
                vertex: i64 = 0
                while vertex < vertices_count:
                    self.compare(vertex, edge, found)
                    vertex += 1
                edge += 1
            return
        self.bound_displacement()
        vertices, edges = self.near_vertices(), self.near_edges()
        if len(vertices) * len(edges) <= MANY_PAIRS:
            k: i64 = 0
            while k < len(edges):
                j: i64 = 0
                while j < len(vertices):
                    self.compare(vertices[j], edges[k], found)
                    j += 1
                k += 1
            return
        pairs = self.near_pairs(vertices, edges)
        k = 0
        while k < len(pairs):
            self.compare(pairs[k], pairs[k + 1], found)
            k += 2

    def set_window(self, low: float, high: float) -> None:
        """Set the window."""
        self.low = low
        self.high = high
        self.times = larger_size(low, high)

    def bound_displacement(self) -> None:
        """Bound the displacement c + w t in the window."""
        table, motion = self.table, self.motion
        places = table.place_error[self.a] + table.place_error[self.b]
        error = places + motion.c_error + motion.w_error * self.times
        self.least_x, self.most_x = self.displacement(motion.cx, motion.wx, error)
        self.least_y, self.most_y = self.displacement(motion.cy, motion.wy, error)

    def displacement(self, c: float, w: float, error: float) -> tuple[float, float]:
        """Return bounds of c + w t in the window, moved outward by an error and by rounding.

        If the margin is NaN, so is a bound. The sum or difference of a bound and a coordinate may
        be compared with another coordinate: rounding is monotonic, so it does not change the sign.
        """
        begin, end = c + w * self.low, c + w * self.high
        margin = 2.0 * error + ROUNDING * (abs(c) + abs(w) * self.times) + TINY
        return min(begin, end) - margin, max(begin, end) + margin

    def near_vertices(self) -> vec[i64]:
        """Return the vertices that may come into the box of the other piece in the window."""
        table = self.table
        xs, ys = table.xs, table.ys
        left, right, bottom, top = table.box(self.b)
        left, right = left - self.most_x, right - self.least_x
        bottom, top = bottom - self.most_y, top - self.least_y
        near = vec[i64]()
        place, count = table.place[self.a], table.size[self.a]
        blocks = blocks_of_vertices(table, self.a)
        vertex = next_near(blocks, 0, left, right, bottom, top)
        while vertex < count:
            x, y = xs[place + vertex], ys[place + vertex]
            if not (x < left or x > right or y < bottom or y > top):
                near = append(near, vertex)
            vertex = next_near(blocks, vertex + 1, left, right, bottom, top)
        return near

    def near_edges(self) -> vec[i64]:
        """Return the edges to whose boxes the box of the piece of the vertices may come."""
        table = self.table
        xs, ys = table.xs, table.ys
        left, right, bottom, top = table.box(self.a)
        left, right = left + self.least_x, right + self.most_x
        bottom, top = bottom + self.least_y, top + self.most_y
        near = vec[i64]()
        place, first, count = table.place[self.b], table.edge[self.b], table.edges[self.b]
        blocks = blocks_of_edges(table, self.b)
        edge = next_near(blocks, 0, left, right, bottom, top)
        while edge < count:
            i, j = place + table.begins[first + edge], place + table.ends[first + edge]
            is_apart_in_x = (xs[i] < left and xs[j] < left) or (xs[i] > right and xs[j] > right)
            is_apart_in_y = (ys[i] < bottom and ys[j] < bottom) or (ys[i] > top and ys[j] > top)
            if not (is_apart_in_x or is_apart_in_y):
                near = append(near, edge)
            edge = next_near(blocks, edge + 1, left, right, bottom, top)
        return near

    def near_pairs(self, vertices: vec[i64], edges: vec[i64]) -> vec[i64]:
        """Return pairs of a vertex and an edge, one number after the other, that may touch.

        These are the pairs whose boxes intersect, each vertex being swept by the displacement.
        """
        table = self.table
        xs, ys = table.xs, table.ys
        boxes = vec[float]()
        place = table.place[self.a]
        count: i64 = len(vertices)
        k: i64 = 0
        while k < count:
            vertex = place + vertices[k]
            x, y = xs[vertex], ys[vertex]
            boxes = add_side(boxes, x + self.least_x, x + self.most_x)
            boxes = add_side(boxes, y + self.least_y, y + self.most_y)
            k += 1
        place, first = table.place[self.b], table.edge[self.b]
        k = 0
        while k < len(edges):
            i, j = place + table.begins[first + edges[k]], place + table.ends[first + edges[k]]
            boxes = add_side(boxes, xs[i], xs[j])
            boxes = add_side(boxes, ys[i], ys[j])
            k += 1
        met = strips(boxes, count)
        k = 0
        while k < len(met):
            met[k] = vertices[met[k]]
            met[k + 1] = edges[met[k + 1] - count]
            k += 2
        return met

    def compare(self, vertex: i64, edge: i64, found: Candidates) -> None:
        """Add a vertex and an edge as a candidate, unless they do not touch in the window.

        The names are those of the derivation above.
        """
        found.compared += 1
        high = min(self.high, found.limit)
        p, q, end = self.places(vertex, edge)
        xs, ys = self.table.xs, self.table.ys
        zx, zy = (xs[p] - xs[q]) + self.motion.cx, (ys[p] - ys[q]) + self.motion.cy
        if q == end:
            self.compare_with_point(zx, zy, vertex, edge, found)
            return
        ux, uy = xs[end] - xs[q], ys[end] - ys[q]

        c1, e1 = self.slope(ux, uy)
        c0, e0 = self.orientation(ux, uy, zx, zy)
        least_slope = abs(c1) - e1
        if not least_slope > SMALL:  # perhaps in parallel to the edge
            if self.may_come_to_line(c0, e0, c1, e1):
                features = vertex_on_edge(self.a, vertex, self.b, edge)
                found.add(features, self.low, high, high)
            return

        t = -c0 / c1
        r = (e0 + e1 * abs(t)) / least_slope * SLACK + TINY
        first, last = t - r, t + r
        if first > high or last < self.low:
            return
        foot = self.foot(ux, uy, zx, zy, t, r)
        if foot == BESIDE_EDGE:
            return

        is_sure = foot == ON_EDGE and first > self.exist_after and last < self.exist_before
        if is_sure and last < found.limit:
            found.limit = last
        features = vertex_on_edge(self.a, vertex, self.b, edge)
        begin = max(self.low, first)  # in this order, a NaN is ignored
        found.add(features, begin, last, high, is_sure=is_sure)

    def places(self, vertex: i64, edge: i64) -> tuple[i64, i64, i64]:
        """Return the numbers of the places of a vertex, and of the ends of an edge."""
        table = self.table
        of_edges, number = table.place[self.b], table.edge[self.b] + edge
        begin, end = of_edges + table.begins[number], of_edges + table.ends[number]
        return table.place[self.a] + vertex, begin, end

    def slope(self, ux: float, uy: float) -> tuple[float, float]:
        """Return c1 = u x w and e1, which bounds its error."""
        motion, d = self.motion, self.d
        left, right = ux * motion.wy, uy * motion.wx
        u_size = abs(ux) + abs(uy)
        rounding = ROUNDING * (abs(left) + abs(right))
        e1 = rounding + d * self.w_size + motion.w_error * (u_size + 2.0 * d)
        return left - right, e1 * SLACK + TINY

    def orientation(self, ux: float, uy: float, zx: float, zy: float) -> tuple[float, float]:
        """Return c0 = u x z and e0, which bounds its error."""
        d = self.d
        left, right = ux * zy, uy * zx
        u_size, z_size = abs(ux) + abs(uy), abs(zx) + abs(zy)
        e0 = ROUNDING * (abs(left) + abs(right)) + d * (u_size + z_size + 2.0 * d)
        return left - right, e0 * SLACK + TINY

    def may_come_to_line(self, c0: float, e0: float, c1: float, e1: float) -> bool:
        """Return False if a vertex certainly does not come to the line of an edge in the window."""
        farthest = (e0 + (abs(c1) + e1) * self.times) * SLACK + TINY
        return not abs(c0) > farthest

    def foot(self, ux: float, uy: float, zx: float, zy: float, t: float, r: float) -> i64:
        """Return where the foot of the vertex is at the time t', which is within r of t.

        Returns:
            `BESIDE_EDGE`, `MAYBE_ON_EDGE` or `ON_EDGE`.
        """
        motion, d, w_size = self.motion, self.d, self.w_size
        mx, my = zx + motion.wx * t, zy + motion.wy * t
        u_size, z_size, m_size = abs(ux) + abs(uy), abs(zx) + abs(zy), abs(mx) + abs(my)
        t_size = abs(t)
        s = d + w_size * r + motion.w_error * (t_size + r) + ROUNDING * (z_size + w_size * t_size)
        along, length = mx * ux + my * uy, ux * ux + uy * uy
        bound = s * (u_size + 2.0 * d) + d * m_size + 2.0 * d * (2.0 * u_size + d)
        bound = bound * SLACK + ROUNDING * (m_size * u_size + length) + TINY
        if along < -bound or along > length + bound:
            return BESIDE_EDGE
        return ON_EDGE if bound < along < length - bound else MAYBE_ON_EDGE

    def compare_with_point(
        self, zx: float, zy: float, vertex: i64, point: i64, found: Candidates
    ) -> None:
        """Add a vertex and an edge that is one point, unless they do not touch in the window.

        They touch when z' + w' t = 0, in x and in y.
        """
        motion = self.motion
        error = self.d + motion.w_error * self.times
        until = min(self.high, found.limit)
        low, high = while_between(zx, motion.wx, 0.0, 0.0, error, self.low, until)
        low, high = while_between(zy, motion.wy, 0.0, 0.0, error, low, high)
        if not low > high:
            found.add(vertex_on_edge(self.a, vertex, self.b, point), low, high, until)


def larger_size(x: float, y: float) -> float:
    """Return the larger one of two absolute values."""
    return max(abs(x), abs(y))


def add_side(boxes: vec[float], x: float, y: float) -> vec[float]:
    """Add a side of a box, from x to y or from y to x; the whole line if one of them is NaN."""
    if x <= y:
        return append(append(boxes, x), y)
    if x >= y:
        return append(append(boxes, y), x)
    return append(append(boxes, -INFINITY), INFINITY)


def blocks_of_vertices(table: Table, k: i64) -> Blocks | None:
    """Return the blocks of the places of a piece; None if they are few.

    All pieces of a body have the same places, and so the same blocks.
    """
    if table.size[k] <= FEW:
        return None
    place = table.place[k]
    blocks = table.vertex_blocks.get(int(place))
    if blocks is None:
        blocks = Blocks()
        vertex: i64 = place
        while vertex < place + table.size[k]:
            x, y = table.xs[vertex], table.ys[vertex]
            blocks.add(x, x, y, y)
            vertex += 1
        table.vertex_blocks[int(place)] = blocks
    return blocks


def blocks_of_edges(table: Table, k: i64) -> Blocks | None:
    """Return the blocks of the edges between the places of a piece, as `blocks_of_vertices`."""
    if table.edges[k] <= FEW:
        return None
    place, xs, ys = table.place[k], table.xs, table.ys
    blocks = table.edge_blocks.get(int(place))
    if blocks is None:
        blocks = Blocks()
        edge: i64 = table.edge[k]
        after = edge + table.edges[k]
        while edge < after:
            i, j = place + table.begins[edge], place + table.ends[edge]
            blocks.add(min(xs[i], xs[j]), max(xs[i], xs[j]), min(ys[i], ys[j]), max(ys[i], ys[j]))
            edge += 1
        table.edge_blocks[int(place)] = blocks
    return blocks
