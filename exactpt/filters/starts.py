"""Whether two pieces are certainly disjoint at one time: at the start of a search.

The idea: most pairs whose boxes meet at the start are disjoint, and doubles can tell. Two pieces
have no common point if

1. their boxes are apart; or
2. a line along an edge of one of them separates them: small convex pieces end here; or
3. no edge of one meets an edge of the other, and nothing of one is inside the other::

       +---------+         The parts of a piece, which are chains or rings, do not cross the edges
       |  +---+  |         of the other piece. So each of them is inside of it or outside as a
       |  | *------->      whole, and one point * of it tells which: it is outside if a ray from it
       |  +---+  |         crosses an even number of edges. Rings of holes count like others. A
       +---------+         piece that has no ring contains nothing.

With radii, two pieces are disjoint if their cores are farther apart than R, the sum of the radii.
Then no two edges come within R of each other, and nothing of one is inside the other. Two edges
do not if their boxes are more than R apart; if one is on one side of the line of the other, or
beyond an end of it, by more than R; for two points, if their distance is larger. A corner beside a
corner may be left to exact arithmetic.

*Errors.* With half = 0 a window (`exactpt.filters.windows`) has the vertices at one time, each
within rho of its row, in x and in y. Below, rho is the sum of those of both pieces. Then an edge
u = b - a is off by du <= 2 rho, and z = v - a, for a vertex v of the other piece, by dz <= rho. So
the orientation u x z is off by at most

    |u| dz + |z| du + 2 du dz    with |.| the sum of the sizes of x and y,

and by 8 U of the sizes of its two products, which are rounded after two differences. So is the
product u . z. A vertex is farther than R from the line of u if |u x z| is larger than R times the
length of u, which is at most 3 rho longer than computed (each coordinate is off by 2 rho). A
product with a normal n is off by |n| rho, whatever the normal, and by 4 U of the sizes of its two
terms. The length of n is at most |n|. The distance of two points is off by less than 2 rho.

*What is inside* is decided with the rows, as if they were exact. For let all vertices move straight
from their rows to where they truly are. They stay within rho, so that, by 3, no edges meet on the
way: no vertex crosses a ring. So what is inside or outside by the rows is so in truth. The heights
of a vertex and of the ends of an edge are doubles, and compared without an error.

Each test is positive: it fails for a NaN. So a piece that is out of range is disjoint from none.
"""

import math
from typing import Final

from librt.vecs import append, vec
from mypy_extensions import i64

from exactpt.filters.blocks import FEW, Blocks, next_near
from exactpt.filters.boxes import strips, zeros
from exactpt.filters.rounding import INFINITY, SLACK, TINY, U
from exactpt.filters.rows import Table, append_box
from exactpt.filters.windows import ROW, Y0, Window, are_apart, edge_box

APART: Final[i64] = -1
NOT_CERTAIN: Final[i64] = 0
CROSSING: Final[i64] = 1
"""What is certain of two edges: no common point; nothing; a point inside of both."""
FEW_FEATURE_PAIRS: Final[i64] = 24
"""Number of pairs of a vertex and an edge up to which separating lines are tried."""
FEW_EDGE_PAIRS: Final[i64] = 256
"""Number of pairs of edges up to which all of them are compared; more are compared by strips."""


class Starts:
    """Pieces at one time. What was computed of a piece serves all pairs of it in a row.

    Args:
        table: the pieces.
        t: the time.
    """

    def __init__(self, table: Table, t: float) -> None:
        self._first = Snapshot(table, t)
        self._second = Snapshot(table, t)

    def are_disjoint(self, i: i64, j: i64) -> bool:
        """Return True if two pieces certainly have no common point at the time."""
        first, second = self._first, self._second
        first.take(i)
        second.take(j)
        table = first.table
        distance = table.radius[i] + table.radius[j]
        if are_apart(first.window, second.window, distance):
            return True
        pair, swapped = Pair(first, second), Pair(second, first)
        is_small = table.size[i] * table.size[j] <= FEW_FEATURE_PAIRS
        if is_small and (pair.has_line_between() or swapped.has_line_between()):
            return True
        if pair.edges_may_meet():
            return False
        return pair.is_second_outside() and swapped.is_second_outside()


class Snapshot:
    """A piece at one time, with what does not depend on the piece beside it.

    Args:
        table: the pieces.
        t: the time.

    Attributes:
        table: as given.
        piece: the number of the piece.
        window: its window.
    """

    def __init__(self, table: Table, t: float) -> None:
        self.table = table
        self.piece: i64 = -1
        self.window = Window()
        self._t = t
        self._blocks: Blocks | None = None
        self._parts: vec[i64] | None = None
        self._has_ring: bool | None = None

    def take(self, piece: i64) -> None:
        """Become that of another piece."""
        if piece == self.piece:
            return
        self.piece = piece
        self.window.fill(self.table, piece, self._t, 0.0)
        self._blocks, self._parts, self._has_ring = None, None, None

    def has_ring(self) -> bool:
        """See `has_ring`."""
        if self._has_ring is None:
            self._has_ring = has_ring(self.table, self.piece)
        return self._has_ring

    def vertices_of_parts(self) -> vec[i64]:
        """See `vertices_of_parts`."""
        if self._parts is None:
            self._parts = vertices_of_parts(self.table, self.piece)
        return self._parts

    def edges_near(self, left: float, right: float, bottom: float, top: float) -> vec[i64]:
        """Return the edges whose blocks may meet a box; all edges, if they are few.

        The box of a block contains those of `edge_box`, with their margins.
        """
        found = vec[i64]()
        count = self.table.edges[self.piece]
        blocks = self._edge_blocks() if count > FEW else None
        edge = next_near(blocks, 0, left, right, bottom, top)
        while edge < count:
            found = append(found, edge)
            edge = next_near(blocks, edge + 1, left, right, bottom, top)
        return found

    def _edge_blocks(self) -> Blocks:
        """Return the blocks of all edges."""
        blocks = self._blocks
        if blocks is None:
            blocks = Blocks()
            table, rows, off = self.table, self.window.rows, 2.0 * self.window.rho
            edge = table.edge[self.piece]
            after = edge + table.edges[self.piece]
            while edge < after:
                left, right, bottom, top = edge_box(rows, table.begins[edge], table.ends[edge], off)
                blocks.add(left, right, bottom, top)
                edge += 1
            self._blocks = blocks
        return blocks


def snapshot_of(table: Table, piece: i64, t: float) -> Snapshot:
    """Return a piece at a time."""
    made = Snapshot(table, t)
    made.take(piece)
    return made


class Pair:
    """Two pieces at one time.

    Attributes:
        first, second: the pieces.
        table: the table.
        i, j: the numbers of the pieces.
        p, q: their windows.
        rho: a bound of the errors of both together.
        reach: at least the sum of their radii; 0 if they have none.
    """

    def __init__(self, first: Snapshot, second: Snapshot) -> None:
        self.first = first
        self.second = second
        self.table = first.table
        self.i = first.piece
        self.j = second.piece
        self.p = first.window
        self.q = second.window
        self.rho = self.p.rho + self.q.rho
        self.reach = (self.table.radius[self.i] + self.table.radius[self.j]) * SLACK

    def has_line_between(self) -> bool:
        """Return True if a line along an edge of the first piece certainly separates them."""
        table, p, q = self.table, self.p.rows, self.q.rows
        first = table.edge[self.i]
        size, other_size = table.size[self.i], table.size[self.j]
        e = first
        while e < first + table.edges[self.i]:
            a, b = ROW * table.begins[e], ROW * table.ends[e]
            nx, ny = p[a + Y0] - p[b + Y0], p[b] - p[a]
            low, high, terms = span_along(p, size, nx, ny)
            other_low, other_high, other_terms = span_along(q, other_size, nx, ny)
            off = (abs(nx) + abs(ny)) * self.rho + 4.0 * U * (terms + other_terms)
            margin = (2.0 * off + (abs(nx) + abs(ny)) * self.reach) * SLACK + TINY
            if other_low > high + margin or low > other_high + margin:
                return True
            e += 1
        return False

    def edges_may_meet(self) -> bool:
        """Return True unless all edges of one are certainly apart from all of the other.

        Edges that meet have boxes that meet, and each of them the box of the other piece.
        """
        edges = near_edges(self.first, self.q, self.reach)
        others = near_edges(self.second, self.p, self.reach)
        n: i64 = len(edges)
        m: i64 = len(others)
        if n * m > FEW_EDGE_PAIRS:
            return self._edges_may_meet_by_strips(edges, others)
        k: i64 = 0
        while k < n:
            other: i64 = 0
            while other < m:
                if self.may_meet(edges[k], others[other]):
                    return True
                other += 1
            k += 1
        return False

    def _edges_may_meet_by_strips(self, edges: vec[i64], others: vec[i64]) -> bool:
        boxes = vec[float]()
        off = 2.0 * self.rho + self.reach
        boxes = boxes_of_edges(self.table, self.i, self.p, edges, off, boxes)
        boxes = boxes_of_edges(self.table, self.j, self.q, others, off, boxes)
        n: i64 = len(edges)
        met = strips(boxes, n)
        k: i64 = 0
        while k < len(met):
            if self.may_meet(edges[met[k]], others[met[k + 1] - n]):
                return True
            k += 2
        return False

    def may_meet(self, edge: i64, other: i64) -> bool:
        """Return True unless two edges are certainly apart, by more than the radii."""
        return self.meeting(edge, other) != APART

    def meeting(self, edge: i64, other: i64) -> i64:
        """Return whether two edges are `APART`, or are `CROSSING`, or neither is certain.

        They are apart if the line of one has the other one on one side, or, with radii, if one is
        beyond an end of the other, or two points are far from each other. For edges on one line it
        is their boxes that are apart. They cross if each line has the ends of the other on both
        sides.
        """
        table, p, q = self.table, self.p.rows, self.q.rows
        e, f = table.edge[self.i] + edge, table.edge[self.j] + other
        a, b = table.begins[e], table.ends[e]
        c, d = table.begins[f], table.ends[f]
        of_c, of_d = self.side(p, a, b, q, c, self.reach), self.side(p, a, b, q, d, self.reach)
        if of_c != 0 and of_c == of_d:
            return APART
        of_a, of_b = self.side(q, c, d, p, a, self.reach), self.side(q, c, d, p, b, self.reach)
        if of_a != 0 and of_a == of_b:
            return APART
        if of_a != 0 and of_b != 0 and of_c != 0 and of_d != 0:
            return CROSSING
        if self.reach != 0.0 and (
            self.is_beyond_an_end(p, a, b, q, c, d)
            or self.is_beyond_an_end(q, c, d, p, a, b)
            or (a == b and c == d and self.are_far(a, c))
        ):
            return APART
        off = 2.0 * self.rho + self.reach
        left, right, bottom, top = edge_box(p, a, b, off)
        low_x, high_x, low_y, high_y = edge_box(q, c, d, off)
        if left > high_x or right < low_x or bottom > high_y or top < low_y:
            return APART
        return NOT_CERTAIN

    def side(self, p: vec[float], a: i64, b: i64, q: vec[float], v: i64, reach: float) -> i64:
        """Return the side of an edge on which a vertex is: 1 is left, -1 right, 0 not certain.

        It is on a side only if it is farther from the line than a distance.
        """
        i, j, k = ROW * a, ROW * b, ROW * v
        ux, uy = p[j] - p[i], p[j + Y0] - p[i + Y0]
        zx, zy = q[k] - p[i], q[k + Y0] - p[i + Y0]
        bound = self.bound(ux, uy, zx, zy, abs(ux * zy) + abs(uy * zx), reach)
        across = ux * zy - uy * zx
        if across > bound:
            return 1
        return -1 if across < -bound else 0

    def is_beyond_an_end(
        self, p: vec[float], a: i64, b: i64, q: vec[float], c: i64, d: i64
    ) -> bool:
        """Return True if an edge is certainly beyond one end of another edge, seen along that."""
        first = self.is_behind(p, a, b, q, c) and self.is_behind(p, a, b, q, d)
        return first or (self.is_behind(p, b, a, q, c) and self.is_behind(p, b, a, q, d))

    def is_behind(self, p: vec[float], a: i64, b: i64, q: vec[float], v: i64) -> bool:
        """Return True if a vertex is certainly behind the begin of an edge, by the radii."""
        i, j, k = ROW * a, ROW * b, ROW * v
        ux, uy = p[j] - p[i], p[j + Y0] - p[i + Y0]
        zx, zy = q[k] - p[i], q[k + Y0] - p[i + Y0]
        bound = self.bound(ux, uy, zx, zy, abs(ux * zx) + abs(uy * zy), self.reach)
        return ux * zx + uy * zy < -bound

    def bound(
        self, ux: float, uy: float, zx: float, zy: float, terms: float, reach: float
    ) -> float:
        """Return what the size of a product of u and z must exceed, for its sign to be certain.

        And for the part of z across u, or along u, to be longer than a distance.
        """
        sizes = abs(ux) + abs(uy) + abs(zx) + abs(zy)
        off = 2.0 * self.rho * (sizes + 2.0 * self.rho)
        far = 0.0
        if reach != 0.0:
            far = reach * (math.sqrt(ux * ux + uy * uy) + 3.0 * self.rho)
        return (off + 8.0 * U * terms + far) * SLACK + TINY

    def are_far(self, v: i64, w: i64) -> bool:
        """Return True if two vertices are certainly farther apart than the sum of the radii."""
        p, q = self.p.rows, self.q.rows
        i, j = ROW * v, ROW * w
        dx, dy = q[j] - p[i], q[j + Y0] - p[i + Y0]
        return math.sqrt(dx * dx + dy * dy) > (self.reach + 2.0 * self.rho) * SLACK + TINY

    def is_second_outside(self) -> bool:
        """Return True if all of the second piece is certainly outside of the first one.

        It must be known that no edges meet: then a part is outside if one vertex of it is.
        """
        if not self.first.has_ring():
            return True
        vertices = self.second.vertices_of_parts()
        k: i64 = 0
        while k < len(vertices):
            if not self.is_outside(vertices[k]):
                return False
            k += 1
        return True

    def is_outside(self, v: i64) -> bool:
        """Return True if a vertex of the second piece is certainly outside of the first one.

        An edge crosses the ray to the right of the vertex if one of its ends is above the vertex,
        the other one not, and if the vertex is to the left of the edge as it leads upward.
        """
        table, p, q = self.table, self.p.rows, self.q.rows
        x, y = q[ROW * v], q[ROW * v + Y0]
        # The ray is a box: whatever crosses it has a block that meets it.
        edges = self.first.edges_near(x, INFINITY, y, y)
        is_outside = True
        k: i64 = 0
        while k < len(edges):
            e = table.edge[self.i] + edges[k]
            a, b = table.begins[e], table.ends[e]
            k += 1
            if max(p[ROW * a], p[ROW * b]) < x:
                continue
            is_up = p[ROW * b + Y0] > y
            if is_up == (p[ROW * a + Y0] > y):
                continue
            side = self.side(p, a, b, q, v, 0.0)
            if side == 0:
                return False
            if (side > 0) == is_up:
                is_outside = not is_outside
        return is_outside


def span_along(rows: vec[float], n: i64, nx: float, ny: float) -> tuple[float, float, float]:
    """Return bounds of the products of vertices with a normal, and of the sizes of their terms."""
    low, high, terms = INFINITY, -INFINITY, 0.0
    v: i64 = 0
    while v < n:
        x, y = nx * rows[ROW * v], ny * rows[ROW * v + Y0]
        terms = max(terms, abs(x) + abs(y))
        low, high = min(low, x + y), max(high, x + y)
        v += 1
    return low, high, terms


def near_edges(snapshot: Snapshot, q: Window, reach: float) -> vec[i64]:
    """Return the edges of a piece that come within reach of the box of the other piece.

    Args:
        snapshot: the piece.
        q: the window of the other piece.
        reach: at least the sum of the radii.
    """
    table, p = snapshot.table, snapshot.window
    off = 2.0 * (p.rho + q.rho) + reach
    far = 2.0 * q.rho + reach  # the blocks are grown by the errors of the piece itself
    candidates = snapshot.edges_near(q.left - far, q.right + far, q.bottom - far, q.top + far)
    found = vec[i64]()
    first = table.edge[snapshot.piece]
    k: i64 = 0
    while k < len(candidates):
        e = first + candidates[k]
        left, right, bottom, top = edge_box(p.rows, table.begins[e], table.ends[e], off)
        if not (left > q.right or right < q.left or bottom > q.top or top < q.bottom):
            found = append(found, candidates[k])
        k += 1
    return found


def boxes_of_edges(
    table: Table, k: i64, p: Window, edges: vec[i64], off: float, boxes: vec[float]
) -> vec[float]:
    """Return the boxes, and after them those of some edges of piece k, grown by a distance."""
    n: i64 = 0
    while n < len(edges):
        e = table.edge[k] + edges[n]
        left, right, bottom, top = edge_box(p.rows, table.begins[e], table.ends[e], off)
        boxes = append_box(boxes, left, right, bottom, top)
        n += 1
    return boxes


def has_ring(table: Table, k: i64) -> bool:
    """Return True if the edges of a piece may enclose something: if they are not only chains.

    Edges that all lead from a vertex to the next one, or from a vertex to itself, make no ring.
    """
    e = table.edge[k]
    end = e + table.edges[k]
    while e < end:
        step = table.ends[e] - table.begins[e]
        if step < 0 or step > 1:
            return True
        e += 1
    return False


def vertices_of_parts(table: Table, k: i64) -> vec[i64]:
    """Return a vertex of each part of a piece, or more; parts have no vertex in common.

    To the least vertex of a part no edge leads from the vertex before, as that is in another part.
    So those vertices are found to which no such edge leads.
    """
    n = table.size[k]
    follows = zeros(n)
    e = table.edge[k]
    end = e + table.edges[k]
    while e < end:
        if table.ends[e] == table.begins[e] + 1:
            follows[table.ends[e]] = 1
        e += 1
    found = vec[i64]()
    v: i64 = 0
    while v < n:
        if follows[v] == 0:
            found = append(found, v)
        v += 1
    return found
