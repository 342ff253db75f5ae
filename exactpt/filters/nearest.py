"""The features of two pieces that may be nearest at one time, and the edges that may cross.

The distance of two disjoint pieces is that of a vertex of one from a vertex or from the interior of
an edge of the other. Of each piece the edges, in their order, are the leaves of a binary tree of
boxes, and both trees are descended together, the nearer of two boxes first::

            [        ]                      [        ]
         [    ]   [     ]     <------->  [    ]   [    ]      two boxes farther from each other
        [ ] [ ]  [ ] [  ]               [ ] [ ]  [ ] [ ]      than the least distance so far have
                                                              no nearest features: they are left
                                                              out with all that is in them

What is left are all pairs of features that are nearest, few others, and all pairs of edges that
meet or may meet. If two edges certainly cross, only features that may touch are left.

*Errors.* With half = 0 a window (`exactpt.filters.windows`) has the vertices at one time, each
within rho of its row, in x and in y; below, rho is the sum of those of both pieces. A point of an
edge is out of place as its ends are at most, so a distance in the rows is off the true one by at
most sqrt(2) rho.

*Rounding.* Let M be the size of the largest coordinate in the rows, so that no vector between
points is longer than 2^1.5 M. Let v be a vertex, ab an edge, w = v - a, u = b - a.

* The product w . u, of rounded differences, is off by less than 4.1 U |w| |u|, and |u|^2 by less
  than 4.1 U |u|^2. So a foot that seems to be inside of the edge, or beyond an end, is in truth so
  but for a part of the edge shorter than 8.2 U (|w| + |u|), and by no more is the distance off.
* u x w is off by less than 4.1 U |w| |u|; divided by |u| and squared, it stands for a distance that
  is off by less than 8.2 U |w|. Of two points the distance is off by less than 3 U |w|.
* An edge with |u|^2 < 2^-300, where products may underflow, counts as its end a: by that, and by
  underflow elsewhere, a distance is off by less than 2^-149.

In all a distance is off by less than 24.6 U 2^1.5 M + 2^-149 < 70 U M + 2^-149. As rho is at least
16 U M, that and the errors together are less than E = 6 rho + 2^-149 (`margin`). A pair is left out
if its distance exceeds the least one, as computed, by more than 2 E; distances of boxes are off by
less. A product w . u is off by less than 3 rho (|w| + |u| + 3 rho) + 17 U |w| |u|, errors and
rounding together: if it is less than that below 0, the foot is certainly beyond the end a.

M must be below 2^200, and rho is larger otherwise than 2^148; then, as if rho is NaN, E is
infinite, and all pairs are left.

*Edges* cross or do not by the signs of `exactpt.filters.starts`. Whether a piece is inside of the
other is decided there, too. It is needed that no edges meet while all vertices move straight from
their rows to where they truly are. If no two edges cross in the rows, and no vertex is nearer to an
edge than 2 E, as computed, it is farther from it than 5 rho, and it stays so by 3 rho on the way.
"""

from typing import Final

from librt.vecs import append, vec
from mypy_extensions import i64

from exactpt.filters.boxes import zeros
from exactpt.filters.candidates import NO_EDGE, Features, two_vertices, vertex_on_edge
from exactpt.filters.rounding import INFINITY, SLACK, TINY, U, as_upper
from exactpt.filters.rows import BOTTOM, BOX, LEFT, RIGHT, TOP, Box, Table, append_box
from exactpt.filters.starts import APART, CROSSING, Pair, Snapshot
from exactpt.filters.windows import ROW, Y0

LEAF: Final[i64] = 4
"""Number of edges of a leaf."""
SHORT: Final = 2.0**-300
"""Square of the length below which an edge counts as its end."""
UNDERFLOW: Final = 2.0**-149
LARGEST_ERROR: Final = 2.0**148
"""An error that is not below it may be one of coordinates so large that products overflow."""


class Tree:
    """The edges of a piece at one time, in a binary tree of boxes.

    Each edge stands for itself and for its first vertex; a vertex at which no edge begins is an
    edge without a number, to itself. So each vertex is there once.

    Attributes:
        begins, ends: the vertices at the ends of each edge.
        edges: its number in the piece, or `NO_EDGE`.
        lengths: bounds of their lengths from above.
        leaves: the number of leaves, a power of 2. Node 1 is the root, 2 k and 2 k + 1 are the
            children of node k, and leaf l, with the edges from `LEAF` l on, is node ``leaves`` + l.
        boxes: `BOX` numbers a node, from node 0 on, which is none.
    """

    def __init__(self, table: Table, piece: i64, rows: vec[float]) -> None:
        self.begins = vec[i64]()
        self.ends = vec[i64]()
        self.edges = vec[i64]()
        self.lengths = vec[float]()
        self.boxes = vec[float]()
        self._add_edges(table, piece, rows)
        leaves: i64 = 1
        while leaves * LEAF < len(self.begins):
            leaves *= 2
        self.leaves = leaves
        self._make_boxes(rows)

    def _add_edges(self, table: Table, piece: i64, rows: vec[float]) -> None:
        begins_edge = zeros(table.size[piece])
        first = table.edge[piece]
        number: i64 = 0
        while number < table.edges[piece]:
            a, b = table.begins[first + number], table.ends[first + number]
            begins_edge[a] = 1
            self._add(rows, a, b, number if a != b else NO_EDGE)
            number += 1
        v: i64 = 0
        while v < table.size[piece]:
            if begins_edge[v] == 0:
                self._add(rows, v, v, NO_EDGE)
            v += 1

    def _add(self, rows: vec[float], a: i64, b: i64, number: i64) -> None:
        self.begins = append(self.begins, a)
        self.ends = append(self.ends, b)
        self.edges = append(self.edges, number)
        x, y = rows[ROW * b] - rows[ROW * a], rows[ROW * b + Y0] - rows[ROW * a + Y0]
        self.lengths = append(self.lengths, (x * x + y * y) ** 0.5 * SLACK)

    def _make_boxes(self, rows: vec[float]) -> None:
        boxes = vec[float]()
        node: i64 = 0
        while node < self.leaves:
            boxes = append_box(boxes, 0.0, 0.0, 0.0, 0.0)
            node += 1
        leaf: i64 = 0
        while leaf < self.leaves:
            left, right, bottom, top = self._leaf_box(rows, LEAF * leaf)
            boxes = append_box(boxes, left, right, bottom, top)
            leaf += 1
        node = self.leaves - 1
        while node > 0:
            at, one = BOX * node, BOX * 2 * node
            two = one + BOX
            boxes[at + LEFT] = min(boxes[one + LEFT], boxes[two + LEFT])
            boxes[at + RIGHT] = max(boxes[one + RIGHT], boxes[two + RIGHT])
            boxes[at + BOTTOM] = min(boxes[one + BOTTOM], boxes[two + BOTTOM])
            boxes[at + TOP] = max(boxes[one + TOP], boxes[two + TOP])
            node -= 1
        self.boxes = boxes

    def _leaf_box(self, rows: vec[float], first: i64) -> Box:
        """Return the box of the edges of a leaf: one without a point if there are none."""
        left, right, bottom, top = INFINITY, -INFINITY, INFINITY, -INFINITY
        k = first
        end = min(first + LEAF, i64(len(self.begins)))
        while k < end:
            at = ROW * self.begins[k]
            left, right = min(left, rows[at]), max(right, rows[at])
            bottom, top = min(bottom, rows[at + Y0]), max(top, rows[at + Y0])
            if k + 1 == end or self.ends[k] != self.begins[k + 1]:
                at = ROW * self.ends[k]
                left, right = min(left, rows[at]), max(right, rows[at])
                bottom, top = min(bottom, rows[at + Y0]), max(top, rows[at + Y0])
            k += 1
        return left, right, bottom, top

    def extent(self, node: i64) -> float:
        """Return half the circumference of the box of a node."""
        boxes, at = self.boxes, BOX * node
        return (boxes[at + RIGHT] - boxes[at + LEFT]) + (boxes[at + TOP] - boxes[at + BOTTOM])


class Nearest:
    """The features of two pieces that may be nearest.

    Args:
        first: a piece at one time.
        second: another piece at the same time.
        within: the square of a distance: features that are certainly farther from each other do
            not matter. It may be infinite.

    Attributes:
        cross: whether two edges certainly cross.
        met: the numbers of edges, one of each piece, that may meet; complete if ``cross`` is False.
        compared: how many pairs of edges were compared.
    """

    def __init__(self, first: Snapshot, second: Snapshot, within: float) -> None:
        self.cross = False
        self.met = vec[i64]()
        self.compared: i64 = 0
        self._i = first.piece
        self._j = second.piece
        self._p = first.window.rows
        self._q = second.window.rows
        self._pair = Pair(first, second)
        self._swapped = Pair(second, first)
        self._one = Tree(first.table, first.piece, self._p)
        self._two = Tree(second.table, second.piece, self._q)
        self._rho = first.window.rho + second.window.rho
        margin = 6.0 * self._rho * SLACK + UNDERFLOW
        self.margin = margin if self._rho < LARGEST_ERROR else INFINITY
        self._touching = 2.0 * self.margin * SLACK
        self._least = INFINITY  # of the squares of distances
        self._limit = INFINITY
        self._far = INFINITY
        self._gaps = vec[float]()  # a stack of pairs of nodes
        self._firsts = vec[i64]()
        self._seconds = vec[i64]()
        self._depth: i64 = 0
        self._of_first = vec[i64]()  # pairs of features: 1 if the vertex is of the first piece
        self._vertices = vec[i64]()
        self._edges = vec[i64]()
        self._others = vec[i64]()
        self._squares = vec[float]()
        self._forget_beyond(within)
        self._search()

    def features(self) -> list[Features]:
        """Return the pairs of features that may be nearest, all that are among them, once each.

        If the pieces are farther from each other than ``within``, there may be none.
        """
        found: list[Features] = []
        k: i64 = 0
        while k < len(self._squares):
            if not self._squares[k] > self._limit:
                one, other = self._i, self._j
                if self._of_first[k] == 0:
                    one, other = other, one
                vertex, edge = self._vertices[k], self._edges[k]
                if edge == NO_EDGE:
                    found.append(two_vertices(one, vertex, other, self._others[k]))
                else:
                    found.append(vertex_on_edge(one, vertex, other, edge))
            k += 1
        return found

    def is_outside(self) -> bool:
        """Return True if the pieces certainly have no point in common."""
        if self.cross or len(self.met) > 0 or not self._least > 4.0 * self.margin * self.margin:
            return False
        return self._pair.is_second_outside() and self._swapped.is_second_outside()

    def _forget_beyond(self, squared: float) -> None:
        """Leave out from now on what is certainly farther than a distance, given its square."""
        far = (squared**0.5 + 2.0 * self.margin) * SLACK
        self._far = as_upper(far)
        self._limit = as_upper(far * far * SLACK)

    def _search(self) -> None:
        one, two = self._one, self._two
        self._push(1, 1)
        while self._depth > 0:
            self._depth -= 1
            n = self._depth
            if self._gaps[n] > self._limit:
                continue
            i, j = self._firsts[n], self._seconds[n]
            is_leaf, other_is_leaf = i >= one.leaves, j >= two.leaves
            if is_leaf and other_is_leaf:
                self._compare(LEAF * (i - one.leaves), LEAF * (j - two.leaves))
            elif other_is_leaf or not (is_leaf or one.extent(i) < two.extent(j)):
                self._push_nearer_last(2 * i, j, 2 * i + 1, j)
            else:
                self._push_nearer_last(i, 2 * j, i, 2 * j + 1)

    def _push_nearer_last(self, i: i64, j: i64, k: i64, l: i64) -> None:
        if self._gap(i, j) < self._gap(k, l):
            i, j, k, l = k, l, i, j
        self._push(i, j)
        self._push(k, l)

    def _push(self, i: i64, j: i64) -> None:
        gap = self._gap(i, j)
        if gap > self._limit:
            return
        n = self._depth
        if n == len(self._gaps):
            self._gaps = append(self._gaps, 0.0)
            self._firsts = append(self._firsts, 0)
            self._seconds = append(self._seconds, 0)
        gaps, firsts, seconds = self._gaps, self._firsts, self._seconds
        gaps[n], firsts[n], seconds[n] = gap, i, j
        self._depth = n + 1

    def _gap(self, i: i64, j: i64) -> float:
        """Return the square of the distance of two boxes."""
        a, b = self._one.boxes, self._two.boxes
        k, l = BOX * i, BOX * j
        x = max(a[k + LEFT] - b[l + RIGHT], b[l + LEFT] - a[k + RIGHT])
        y = max(a[k + BOTTOM] - b[l + TOP], b[l + BOTTOM] - a[k + TOP])
        x, y = max(x, 0.0), max(y, 0.0)
        return x * x + y * y

    def _compare(self, first: i64, other_first: i64) -> None:
        """Compare the edges of two leaves, and their first vertices."""
        one, two, p, q = self._one, self._two, self._p, self._q
        end = min(first + LEAF, i64(len(one.begins)))
        other_end = min(other_first + LEAF, i64(len(two.begins)))
        m = first
        while m < end:
            a = one.begins[m]
            n = other_first
            while n < other_end:
                b = two.begins[n]
                x, y = q[ROW * b] - p[ROW * a], q[ROW * b + Y0] - p[ROW * a + Y0]
                squared = x * x + y * y
                lengths = one.lengths[m] + two.lengths[n]
                reach = self._far + lengths
                if not squared > reach * reach * SLACK:
                    self.compared += 1
                    self._add(1, a, NO_EDGE, b, squared)
                    if two.edges[n] != NO_EDGE:
                        self._add_edge(1, p, a, q, b, two.ends[n], two.edges[n])
                    if one.edges[m] != NO_EDGE:
                        self._add_edge(0, q, b, p, a, one.ends[m], one.edges[m])
                    touching = self._touching + lengths
                    if not (self.cross or squared > touching * touching * SLACK):
                        self._look_for_crossing(one.edges[m], two.edges[n])
                n += 1
            m += 1

    def _look_for_crossing(self, edge: i64, other: i64) -> None:
        """Note two edges if they cross or may meet."""
        if min(edge, other) == NO_EDGE:
            return
        meeting = self._pair.meeting(edge, other)
        if meeting == CROSSING:
            self.cross = True
            self._least = 0.0
            self._forget_beyond(0.0)
        elif meeting != APART:
            self.met = append(self.met, edge)
            self.met = append(self.met, other)

    def _add_edge(
        self, of_first: i64, p: vec[float], v: i64, q: vec[float], a: i64, b: i64, edge: i64
    ) -> None:
        """Add a vertex and an edge of the other piece, from a to b, unless its ends are nearer.

        Args:
            of_first: 1 if the vertex is of the first piece, else 0.
            p: the rows of the piece of the vertex.
            v: the vertex.
            q: the rows of the piece of the edge.
            a: its one end.
            b: its other end.
            edge: the edge.
        """
        i, j, k = ROW * a, ROW * b, ROW * v
        ux, uy = q[j] - q[i], q[j + Y0] - q[i + Y0]
        wx, wy = p[k] - q[i], p[k + Y0] - q[i + Y0]
        along, length_squared = ux * wx + uy * wy, ux * ux + uy * uy
        if length_squared < SHORT or along < 0.0:
            squared = wx * wx + wy * wy
        elif along > length_squared:
            x, y = p[k] - q[j], p[k + Y0] - q[j + Y0]
            squared = x * x + y * y
        else:
            cross = ux * wy - uy * wx
            squared = cross * cross / length_squared
        if squared > self._limit:
            return
        u = abs(ux) + abs(uy)
        if self._is_beyond(along, u, abs(wx) + abs(wy)):
            return
        x, y = p[k] - q[j], p[k + Y0] - q[j + Y0]
        if not self._is_beyond(-(ux * x + uy * y), u, abs(x) + abs(y)):
            self._add(of_first, v, edge, 0, squared)

    def _is_beyond(self, along: float, u: float, w: float) -> bool:
        """Return True if a foot is certainly beyond an end, or at it.

        Args:
            along: the product of the vectors from the end along the edge, and to the vertex.
            u: the sum of the sizes of the coordinates of the first vector.
            w: that of the second one.
        """
        off = 3.0 * self._rho
        bound = off * (w + u + off) + 17.0 * U * w * u
        return along < -(bound * SLACK + TINY)

    def _add(self, of_first: i64, vertex: i64, edge: i64, other: i64, squared: float) -> None:
        if squared > self._limit:
            return
        self._of_first = append(self._of_first, of_first)
        self._vertices = append(self._vertices, vertex)
        self._edges = append(self._edges, edge)
        self._others = append(self._others, other)
        self._squares = append(self._squares, squared)
        if squared < self._least:
            self._least = squared
            if squared**0.5 + 2.0 * self.margin < self._far:
                self._forget_beyond(squared)
