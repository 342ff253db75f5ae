"""All pairs of a vertex of one body and an edge of the other, for some pairs of bodies."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from exactpt.arrays.motions import Motions
from exactpt.arrays.outlines import Outlines
from exactpt.arrays.relative import Relative
from exactpt.arrays.sharpening import ExactRelative, Plane2
from exactpt.filters.rounding import SLACK, U
from exactpt.geometry.ragged import spread
from exactpt.kernel.double_double import exact_difference
from exactpt.kernel.doubles import Floats, Indices
from exactpt.motion.track import Incidence
from exactpt.pair.straight import Candidate


class Candidates(NamedTuple):
    """Pairs of a vertex and an edge.

    Attributes:
        pair: the number of their pair of bodies.
        second: whether the vertex is of the second body, and the edge of the first.
        vertex, edge: their numbers in the arrays of all vertices and edges.
        corner: -1; or a vertex of the second body instead of an edge.
    """

    pair: Indices
    second: Indices
    vertex: Indices
    edge: Indices
    corner: Indices

    def take(self, index: Indices) -> Candidates:
        """Return the entries at the given places."""
        return Candidates(*(column[index] for column in self))

    def relative(self, o: Outlines, motions: Motions) -> Relative:
        """Return the vertices relative to the edges; ``motions`` are those of the pairs of bodies.

        The difference of a vertex and an end of the edge is off by one unit, and its sum with a
        displacement by another.
        """
        e, v, pair = self.edge, self.vertex, self.pair
        ux, uy, length = o.ux[e], o.uy[e], None
        off_u = None if motions.edges is None else motions.edges[pair]
        if o.points:
            point = o.edges.first[e] == o.edges.last[e]
            uy[point] = 1.0
            length = np.where(point, 0.0, 1.0)
            off_u = None if off_u is None else off_u * length
        sign = np.where(self.second, -1.0, 1.0)
        wx, wy = o.x[v] - o.ax[e], o.y[v] - o.ay[e]
        c = motions.coefficients
        count = c.shape[2]
        moved = [(c[:, 0, n][pair] * sign, c[:, 1, n][pair] * sign) for n in range(count)]
        if motions.plain:
            off: tuple[Floats | None, ...] = (None,) * count
        else:
            offs = [motions.off[:, n][pair] for n in range(count)]
            wx, wy, offs[0] = shifted(wx, wy, *moved[0], offs[0])
            off = tuple(offs)
        return Relative(((ux, uy),), ((wx, wy), *moved[1:]), (off_u,), off, length)

    def exact(
        self, o: Outlines, coefficients: Floats, a: Indices, b: Indices, count: int
    ) -> ExactRelative:
        """Return the same without rounding, as polynomials in t of ``count`` coefficients.

        Args:
            o: the outlines.
            coefficients: the motions of all bodies.
            a: the bodies of the vertices.
            b: the bodies of the edges.
            count: all further coefficients of the motions are the same for a and b.
        """
        first, last = o.edges.first[self.edge], o.edges.last[self.edge]
        u = _differences((o.x[last], o.y[last]), (o.x[first], o.y[first]))
        start = _differences((o.x[self.vertex], o.y[self.vertex]), (o.x[first], o.y[first]))
        shift, *moved = (
            _differences(coefficients[a, :, n].T, coefficients[b, :, n].T)
            for n in range(min(count, coefficients.shape[2]))
        )
        return ExactRelative((u,), (start, *moved), shift)

    def listed(
        self, o: Outlines, i: Indices, j: Indices, low: Floats, high: Floats
    ) -> list[Candidate]:
        """Return their records, with bounds of their times; features by number in their bodies."""
        columns = (low, high, self.second, *self.numbered(o, *self.bodies(i, j)))
        rows = zip(*(column.tolist() for column in columns), strict=True)
        return [Candidate(a, b, Incidence(i, v, 1 - i, e, w)) for a, b, i, v, e, w in rows]

    def bodies(self, i: Indices, j: Indices) -> tuple[Indices, Indices]:
        """Return the bodies of the vertices and those of the edges, of pairs (i, j) of bodies."""
        i, j = i[self.pair], j[self.pair]
        second = self.second == 1
        return np.where(second, j, i), np.where(second, i, j)

    def numbered(self, o: Outlines, a: Indices, b: Indices) -> tuple[Indices, Indices, Indices]:
        """Return vertices, edges and corners by number in their bodies a, b; -1 for none."""
        is_edge = self.corner < 0
        edge = np.where(is_edge, self.edge - o.first_edge[b], -1)
        corner = np.where(is_edge, -1, self.corner - o.first_vertex[b])
        return self.vertex - o.first_vertex[a], edge, corner

    def joined(self, other: Candidates) -> Candidates:
        """Return these, followed by others."""
        return Candidates(*map(np.concatenate, zip(self, other, strict=True)))


def all_candidates(o: Outlines, i: Indices, j: Indices) -> tuple[Candidates, Indices]:
    """Return all pairs of a vertex of i and an edge of j, then the reverse, with their starts.

    The latter has two entries for each pair of bodies: first those of all pairs with a vertex of
    the first body, then those of all pairs with a vertex of the second.
    """
    a, b = np.concatenate((i, j)), np.concatenate((j, i))
    counts = o.vertex_count[a] * o.edge_count[b]
    owner, position = spread(counts)
    across = o.edge_count[b][owner]
    v = position // across
    e = position - v * across
    v += o.first_vertex[a][owner]
    e += o.first_edge[b][owner]
    second = (owner >= len(i)).astype(np.int64)
    corner = np.full(len(v), -1)
    return Candidates(owner - second * len(i), second, v, e, corner), np.cumsum(counts) - counts


def vertex_candidates(o: Outlines, i: Indices, j: Indices) -> tuple[Candidates, Indices]:
    """Return all pairs of a vertex of i and one of j, with the starts of each pair of bodies."""
    counts = o.vertex_count[i] * o.vertex_count[j]
    owner, position = spread(counts)
    across = o.vertex_count[j][owner]
    v = position // across
    w = position - v * across + o.first_vertex[j][owner]
    none = np.zeros_like(v)
    vertex = v + o.first_vertex[i][owner]
    return Candidates(owner, none, vertex, none, w), np.cumsum(counts) - counts


def _differences(p: Iterable[Floats], q: Iterable[Floats]) -> Plane2:
    x, y = (exact_difference(c, d) for c, d in zip(p, q, strict=True))
    return x, y


def shifted(
    wx: Floats, wy: Floats, x: Floats, y: Floats, off: Floats
) -> tuple[Floats, Floats, Floats]:
    """(wx + x, wy + y), and a bound on the absolute error of both coordinates.

    wx and wy have relative errors of at most U, x and y absolute ones of at most ``off``.
    """
    size = np.abs(wx) + np.abs(wy) + (np.abs(x) + np.abs(y))
    return wx + x, wy + y, (2.0 * U * size + off) * SLACK
