"""What filters find: pairs of features that may touch, and from when on.

A *feature* is a vertex or an edge of a piece. Bodies touch where a vertex is on an edge; if they
have radii, where a vertex is at a distance of an edge or of a vertex. So a candidate is a vertex of
one piece, an edge or a vertex of the other (or of the same one, if it deforms), and times::

      low           high             until
    ---|=============|- - - - - - - - -|--->  t
       may touch      may touch too      end of the window in which the filter looked
       from here on

They certainly do not touch before ``low``. That is all that is promised, unless the candidate is
sure: then they certainly touch at or before ``high``. `Candidates.limit` is the least ``high`` of
those that are sure: what is first is found among the candidates with ``low <= limit``.
"""

from typing import Final, NamedTuple

from librt.vecs import append, vec
from mypy_extensions import i64

from exactpt.filters.rounding import INFINITY, as_lower, as_upper

NO_EDGE: Final[i64] = -1
NO_VERTEX: Final[i64] = -1


class Candidate(NamedTuple):
    """A candidate for exact arithmetic.

    Attributes:
        low: the two certainly do not touch before.
        high: they may touch in [low, high] first; a sure candidate certainly does.
        one, vertex: a vertex, by its number in its piece.
        other: the piece that it may touch, perhaps the same.
        edge: an edge of that piece, or -1.
        other_vertex: a vertex of that piece, or -1.
        until: the end of the window; after ``high``, and up to this, they may touch too.
    """

    low: float
    high: float
    one: int
    vertex: int
    other: int
    edge: int
    other_vertex: int
    until: float


class Features:
    """A vertex of a piece, and what it may touch; the names are those of `Candidate`."""

    def __init__(self, one: i64, vertex: i64, other: i64, edge: i64, other_vertex: i64) -> None:
        self.one = one
        self.vertex = vertex
        self.other = other
        self.edge = edge
        self.other_vertex = other_vertex


def vertex_on_edge(one: i64, vertex: i64, other: i64, edge: i64) -> Features:
    """Return the features of a vertex that may touch an edge."""
    return Features(one, vertex, other, edge, NO_VERTEX)


def two_vertices(one: i64, vertex: i64, other: i64, other_vertex: i64) -> Features:
    """Return the features of two vertices that may touch."""
    return Features(one, vertex, other, NO_EDGE, other_vertex)


class Candidates:
    """Candidates, as vectors, and the time up to which a contact is certain.

    Attributes:
        low, high, one, vertex, other, edge, other_vertex, until: as in `Candidate`.
        sure: 1 if the two certainly touch at or before ``high``, else 0.
        limit: no candidate that begins later matters; some pair certainly touches at or before it.
        compared: how many pairs of features were compared; the two sides of an edge count twice if
            there are radii. It is at least the number of candidates.
        pairs: how many pairs of pieces were.
    """

    def __init__(self, limit: float) -> None:
        self.low = vec[float]()
        self.high = vec[float]()
        self.one = vec[i64]()
        self.vertex = vec[i64]()
        self.other = vec[i64]()
        self.edge = vec[i64]()
        self.other_vertex = vec[i64]()
        self.until = vec[float]()
        self.sure = vec[i64]()
        self.limit = limit
        self.compared: i64 = 0
        self.pairs: i64 = 0

    def count(self) -> int:
        """Return the number of candidates."""
        return len(self.low)

    def add(
        self, features: Features, low: float, high: float, until: float, *, is_sure: bool = False
    ) -> None:
        """Add a candidate.

        A bound that is NaN says nothing: ``low`` becomes -infinity, the others infinity, and the
        candidate is not sure.
        """
        is_bounded = high < INFINITY
        self.low = append(self.low, as_lower(low))
        self.high = append(self.high, as_upper(high))
        self.one = append(self.one, features.one)
        self.vertex = append(self.vertex, features.vertex)
        self.other = append(self.other, features.other)
        self.edge = append(self.edge, features.edge)
        self.other_vertex = append(self.other_vertex, features.other_vertex)
        self.until = append(self.until, as_upper(until))
        self.sure = append(self.sure, i64(1) if is_sure and is_bounded else i64(0))

    def features(self, k: i64) -> Features:
        """Return the features of candidate k."""
        return Features(
            self.one[k], self.vertex[k], self.other[k], self.edge[k], self.other_vertex[k]
        )

    def rows(self) -> list[Candidate]:
        """Return the candidates that matter, in the order of ``low``, then of the rest."""
        found: list[Candidate] = []
        k: i64 = 0
        n: i64 = len(self.low)
        while k < n:
            if self.low[k] <= self.limit:
                found.append(self._row(k))
            k += 1
        found.sort()
        return found

    def _row(self, k: i64) -> Candidate:
        return Candidate(
            self.low[k],
            self.high[k],
            int(self.one[k]),
            int(self.vertex[k]),
            int(self.other[k]),
            int(self.edge[k]),
            int(self.other_vertex[k]),
            self.until[k],
        )
