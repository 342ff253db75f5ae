"""Fill rules and unions of closed rings, exactly: the arrangement of their edges.

The rings may cross, touch, overlap and repeat points. Their edges are cut at all points that they
have in common; pieces that coincide become one, with the number of rings that run along it to the
right less the number of those that run to the left (its *step*). The winding number of a face,
the number of turns of all rings around its points, is 0 outside, and grows by the step of a piece
from below the piece to above it. A *rule* says by the winding number which faces are filled.

The boundary of the filled faces consists of the pieces that have a filled face on one side only.
It is given as parts, valid in the sense of OGC Simple Features: the inside of a part is connected;
no ring crosses or touches itself, and two rings meet in single points only. So parts that meet in
a single point stay apart, and so do a hole and the ring that it touches.

Vertices are ordered by x, then by y, as if the plane were turned a little: so a vertical piece
begins at its lower end, and the face to the left of it counts as the one above it.

Doubles decide first, within proved bounds (`exactpt.geometry.simple`, `exactpt.geometry.ragged`);
rational numbers decide the rest. New points are exact crossings of two edges.

Source: M. de Berg, O. Cheong, M. van Kreveld, M. Overmars, *Computational Geometry*, 3rd ed.,
chapter 2 (sweep, overlay of subdivisions).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cmp_to_key
from itertools import chain, combinations, pairwise
from typing import Final, NamedTuple, TypeAlias, final

from exactpt.errors import InputError
from exactpt.filters.rounding import LARGEST, TINY, U
from exactpt.geometry.polygon import is_counter_clockwise
from exactpt.geometry.predicates import Point, between, crossing_of_lines, orientation
from exactpt.geometry.simple import are_apart, cross_sign
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, exponent, nearest_float, power_of_two, relative_doubles

FEW: Final = 20
"""Maximum number of edges of which all pairs are compared here, without numpy."""

SHORT: Final = 500
"""Number of pieces of a line of which one is found by its number faster than by its place."""
MAX_CUTS: Final = 400_000
"""Maximum number of points, counted for each edge, in which edges are cut; about 300 MB."""

Rule: TypeAlias = Callable[[int], bool]
"""A function that returns True if faces with a winding number are filled."""


class Part(NamedTuple):
    """A polygon with a connected inside.

    Attributes:
        outline: its outer ring; counter-clockwise if it is a result.
        holes: the rings of its holes; clockwise if they are a result.
    """

    outline: Sequence[Point]
    holes: Sequence[Sequence[Point]] = ()

    @property
    def rings(self) -> list[Sequence[Point]]:
        """The outline, then the holes."""
        return [self.outline, *self.holes]


def nonzero(rings: Sequence[Sequence[Point]]) -> list[Part]:
    """Return the parts of the plane around which the rings turn, counted with their directions.

    Each ring of the result begins with the vertex that comes first in the rings given, and parts
    are in the order of these vertices. Where the boundary is straight, a point is a vertex if a
    given edge along it begins or ends there.

    >>> square = [(QQ(x), QQ(y)) for x, y in [(0, 0), (9, 0), (9, 9), (0, 9)]]
    >>> triangle = [(QQ(x), QQ(y)) for x, y in [(3, 3), (6, 3), (3, 6)]]
    >>> [len(part.holes) for rule in (nonzero, evenodd) for part in rule([square, triangle])]
    [0, 1]

    Args:
        rings: the vertices of closed rings; a first one may be repeated at the end.

    Raises:
        InputError: if the edges cross or touch in too many points (`MAX_CUTS`).
    """
    return _filled(rings, lambda winding: winding != 0)


def evenodd(rings: Sequence[Sequence[Point]]) -> list[Part]:
    """Return the parts of the plane that an odd number of the rings' turns surrounds.

    The result is as that of `nonzero`.

    Args:
        rings: as in `nonzero`.
    """
    return _filled(rings, lambda winding: winding % 2 == 1)


def union(parts: Iterable[Part]) -> list[Part]:
    """Return the union of parts, which may overlap and touch.

    The result is as that of `nonzero`.

    Args:
        parts: each valid by itself, with rings of either orientation.
    """
    given: list[Sequence[Point]] = []
    turned: list[Sequence[Point]] = []
    for part in parts:
        given += part.rings
        turned.append(_turned(part.outline, is_left=True))
        turned += (_turned(hole, is_left=False) for hole in part.holes)
    # Points are numbered as they were given: in a ring turned round, the last one would be first.
    return _filled(turned, lambda winding: winding != 0, numbering=given)


def as_given(parts: Iterable[Part], rings: Iterable[Sequence[Point]]) -> list[Part]:
    """Return the parts with each ring that is unchanged replaced by the ring that was given.

    A ring is unchanged if it has the same vertices in the same cyclic order, in either direction.
    The one that was given has its own first vertex and orientation, so vertices keep their numbers.
    """
    given: dict[tuple[Point, ...], Sequence[Point]] = {}
    for ring in rings:
        given.setdefault(_cycle(ring), ring)

    def original(ring: Sequence[Point]) -> Sequence[Point]:
        return given.get(_cycle(ring), ring)

    return [Part(original(outline), list(map(original, holes))) for outline, holes in parts]


def _cycle(ring: Sequence[Point]) -> tuple[Point, ...]:
    """Return the vertices of a ring, the same for the ring turned and begun elsewhere."""
    points = [p for p, before in zip(ring, [*ring[-1:], *ring[:-1]], strict=True) if p != before]
    first = min(range(len(points)), key=points.__getitem__, default=0)
    turned = points[first:] + points[:first]
    reverse = turned[:1] + turned[:0:-1]
    return tuple(min(turned, reverse))


def _turned(ring: Sequence[Point], *, is_left: bool) -> Sequence[Point]:
    """Return a ring that does not cross itself, counter-clockwise (``is_left``) or clockwise."""
    return ring if is_counter_clockwise(ring) == is_left else ring[::-1]


def _filled(
    rings: Sequence[Sequence[Point]],
    is_filled: Rule,
    *,
    numbering: Sequence[Sequence[Point]] | None = None,
) -> list[Part]:
    """Return the parts that a rule fills.

    Args:
        rings: as in `nonzero`.
        is_filled: the rule.
        numbering: the same points, in the order that decides which is first; by default ``rings``.
    """
    if not any(rings):
        return []
    arrangement = _Arrangement(rings, rings if numbering is None else numbering)
    return _Boundary(arrangement, _Sweep(arrangement), is_filled).parts()


class _Piece(NamedTuple):
    """A piece of edges between two vertices; ``left`` < ``right``, and see the module."""

    left: int
    right: int
    step: int


@final
class _Arrangement:
    """The edges of rings, cut at all points that they have in common.

    Attributes:
        points: the vertices, in their order.
        given: for each vertex the number of other points that come first in the numbering; of
            crossings, that of all points given.
        neighbours: for each vertex the other ends of the edges at it.
        pieces: the pieces of edges with a step that is not 0, in no order.
    """

    def __init__(
        self, rings: Sequence[Sequence[Point]], numbering: Sequence[Sequence[Point]]
    ) -> None:
        self._numbers: dict[Point, int] = {}
        self._unsorted: list[Point] = []
        for ring in numbering:
            for point in ring:
                self._number_of(point)
        edges = [
            edge
            for numbers in [[self._number_of(p) for p in ring] for ring in rings]
            for edge in zip(numbers, numbers[1:] + numbers[:1], strict=True)
            if edge[0] != edge[1]
        ]
        size = len(self._unsorted)
        cuts = self._cuts(edges)
        order = _in_order(self._unsorted)
        rank = [0] * len(order)
        for k, number in enumerate(order):
            rank[number] = k
        self.points: list[Point] = [self._unsorted[number] for number in order]
        self.given: list[int] = [min(number, size) for number in order]
        self.neighbours: list[list[int]] = [[] for _ in order]
        for first, last in edges:
            self.neighbours[rank[first]].append(rank[last])
            self.neighbours[rank[last]].append(rank[first])
        self.pieces: list[_Piece] = _pieces(edges, cuts, rank)
        self._near = _near(self.points)

    def _number_of(self, point: Point) -> int:
        """Return the number of a point, which is the same for equal points."""
        number = self._numbers.setdefault(point, len(self._unsorted))
        if number == len(self._unsorted):
            self._unsorted.append(point)
        return number

    def _cuts(self, edges: Sequence[tuple[int, int]]) -> dict[int, set[int]]:
        """Return the points that cut edges, by the number of the edge; add the crossings."""
        cuts: dict[int, set[int]] = {}
        count = 0
        for i, j in _open_pairs(self._unsorted, edges):
            check_budget()
            common = list(self._common_points(edges[i], edges[j]))
            if common:
                cuts.setdefault(i, set()).update(common)
                cuts.setdefault(j, set()).update(common)
                count += 2 * len(common)
            if count > MAX_CUTS:
                raise InputError(f"its edges cross or touch in more than {MAX_CUTS // 2} points")
        return cuts

    def _common_points(self, e: tuple[int, int], f: tuple[int, int]) -> Iterator[int]:
        """Yield the common point of two edges, or the ends of their common piece."""
        a, b, c, d = (self._unsorted[k] for k in (*e, *f))
        of_c, of_d = orientation(a, b, c), orientation(a, b, d)
        of_a, of_b = orientation(c, d, a), orientation(c, d, b)
        if of_c * of_d < 0 and of_a * of_b < 0:
            yield self._number_of(crossing_of_lines(a, b, c, d))
            return
        if of_c == 0 and between(a, b, c):
            yield f[0]
        if of_d == 0 and between(a, b, d):
            yield f[1]
        if of_a == 0 and between(c, d, a):
            yield e[0]
        if of_b == 0 and between(c, d, b):
            yield e[1]

    def orientation(self, a: int, b: int, c: int) -> int:
        """Return the orientation of three vertices."""
        x, y, error = self._near
        certain = cross_sign(x[b] - x[a], y[b] - y[a], x[c] - x[a], y[c] - y[a], error)
        return certain or orientation(self.points[a], self.points[b], self.points[c])


class _Near(NamedTuple):
    """Points in doubles, along each axis perhaps relative to one of them, or to another scale.

    Neither changes an orientation.
    """

    x: list[float]
    y: list[float]
    error: float
    """A bound on the errors of all coordinates; 0 if they are exact."""


def _near(points: Sequence[Point]) -> _Near:
    axes: list[list[float]] = []
    is_exact = True
    for values in zip(*points, strict=True):
        scaled = _in_range(values)
        near, origin = relative_doubles(scaled)
        is_exact &= all(x == value - origin for x, value in zip(near, scaled, strict=True))
        axes.append(near)
    x, y = axes
    # The nearest double is off by at most U times its size; TINY covers underflow.
    error = 0.0 if is_exact else U * max(map(abs, chain(x, y))) + TINY
    return _Near(x, y, error)


def _in_range(values: Sequence[QQ]) -> Sequence[QQ]:
    """Return the values, times a power of two if products of their doubles might leave the range.

    Then the bounds of the filters (`TINY`, and infinite ones) would leave everything open.
    """
    largest = max(map(abs, values))
    if not largest or 1.0 / LARGEST <= nearest_float(largest) <= LARGEST:
        return values
    factor = power_of_two(-exponent(largest))
    return [value * factor for value in values]


def _in_order(points: Sequence[Point]) -> list[int]:
    """Return the numbers of points, sorted by x, then by y.

    The nearest doubles of coordinates are in their order, or equal.
    """
    keys = [(nearest_float(x), x, nearest_float(y), y) for x, y in points]
    return sorted(range(len(points)), key=keys.__getitem__)


def _open_pairs(
    points: Sequence[Point], edges: Sequence[tuple[int, int]]
) -> Iterator[tuple[int, int]]:
    """Yield the pairs i < j of edges that may have more in common than an end of both."""
    near = _near(points)
    if len(edges) > FEW:
        from exactpt.geometry.ragged import unclear_pairs

        yield from unclear_pairs(near.x, near.y, edges, near.error)
        return
    for (i, e), (j, f) in combinations(enumerate(edges), 2):
        if not _meet_in_ends_only(near, e, f):
            yield i, j


def _meet_in_ends_only(near: _Near, e: tuple[int, int], f: tuple[int, int]) -> bool:
    """Return True if two edges surely are disjoint, or have one end in common and no more."""
    x, y, error = near
    (a, b), (c, d) = e, f
    if {a, b}.isdisjoint(f):
        return are_apart((x[a], y[a], x[b], y[b]), (x[c], y[c], x[d], y[d]), error)
    return cross_sign(x[b] - x[a], y[b] - y[a], x[d] - x[c], y[d] - y[c], error) != 0


def _pieces(
    edges: Sequence[tuple[int, int]], cuts: Mapping[int, set[int]], rank: Sequence[int]
) -> list[_Piece]:
    """Return the pieces of edges that are cut, see `_Arrangement`."""
    steps: dict[tuple[int, int], int] = {}
    for number, (first, last) in enumerate(edges):
        a, b = rank[first], rank[last]
        inner = sorted(rank[cut] for cut in cuts.get(number, ()) if cut not in (first, last))
        left_to_right = [min(a, b), *inner, max(a, b)]
        for piece in pairwise(left_to_right):
            steps[piece] = steps.get(piece, 0) + (1 if a < b else -1)
    return [_Piece(left, right, step) for (left, right), step in steps.items() if step]


@final
class _Sweep:
    """A sweep over the pieces of an arrangement by a line from left to right.

    Attributes:
        pieces: the pieces in the order in which the line reaches them, those that begin at one
            vertex from below upward.
        below: for each piece the next piece below its left end; -1 if there is none.
        stars: for each vertex the pieces at it, counter-clockwise from the direction downward.
    """

    def __init__(self, arrangement: _Arrangement) -> None:
        self._orientation = arrangement.orientation
        self.pieces: list[_Piece] = []
        self.below: list[int] = []
        self.stars: list[list[int]] = []
        beginning: list[list[_Piece]] = [[] for _ in arrangement.points]
        for piece in arrangement.pieces:
            beginning[piece.left].append(piece)
        self._line: list[int] = []
        """The pieces that the line crosses, from below upward."""
        self._ending: list[list[int]] = [[] for _ in arrangement.points]
        """For each vertex the pieces of the line that end there."""
        for vertex, pieces in enumerate(beginning):
            check_budget()
            self._pass(vertex, pieces)

    def _pass(self, vertex: int, beginning: list[_Piece]) -> None:
        """Replace the pieces that end at a vertex by those that begin at it."""
        count = len(self._ending[vertex])
        if count and len(self._line) <= SHORT:
            first = min(map(self._line.index, self._ending[vertex]))
        else:
            first = self._count_below(vertex)
        last = first + count
        ending = self._line[first:last]
        if len(beginning) > 1:
            beginning.sort(key=cmp_to_key(self._compare))
        begun = list(range(len(self.pieces), len(self.pieces) + len(beginning)))
        beneath = self._line[first - 1] if first else -1
        for number, piece in zip(begun, beginning, strict=True):
            self._ending[piece.right].append(number)
        self.pieces += beginning
        self.below += [beneath, *begun][: len(begun)]
        self.stars.append(begun + ending[::-1])
        self._line[first:last] = begun

    def _count_below(self, vertex: int) -> int:
        """Return the number of pieces of the line that are below a vertex."""
        low, high = 0, len(self._line)
        while low < high:
            middle = (low + high) // 2
            piece = self.pieces[self._line[middle]]
            ends_there = piece.right == vertex
            if not ends_there and self._orientation(piece.left, piece.right, vertex) > 0:
                low = middle + 1
            else:
                high = middle
        return low

    def _compare(self, one: _Piece, other: _Piece) -> int:
        """Compare two pieces that begin at one vertex, from below upward."""
        return -self._orientation(one.left, one.right, other.right)


@final
class _Boundary:
    """The boundary of the filled faces of an arrangement."""

    def __init__(self, arrangement: _Arrangement, sweep: _Sweep, is_filled: Rule) -> None:
        self._arrangement, self._sweep = arrangement, sweep
        self._is_bounding: list[bool] = []
        """For each piece of the sweep, True if it has a filled face on one side only."""
        self._goes_right: list[bool] = []
        """For each piece of the boundary, True if it is followed to the right: filled above."""
        above: list[int] = []  # the winding numbers
        for piece, below in zip(sweep.pieces, sweep.below, strict=True):
            winding = above[below] if below >= 0 else 0
            above.append(winding + piece.step)
            self._goes_right.append(is_filled(above[-1]))
            self._is_bounding.append(is_filled(winding) != is_filled(above[-1]))

    def parts(self) -> list[Part]:
        """Return the parts that it bounds."""
        nearest = self._nearest_bounding()
        part_of: dict[int, int] = {}
        """The part that a piece of the boundary bounds."""
        parts: list[list[list[int]]] = []
        for ring in sorted(self._rings(), key=min):
            # The lower one of the two pieces at its leftmost vertex: above it the ring is inside.
            lowest = min(ring)
            if self._goes_right[lowest]:
                number = len(parts)
                parts.append([])
            else:  # a hole, below which the part is; the sweep came to the piece there before
                number = part_of[nearest[self._sweep.below[lowest]]]
            part_of |= dict.fromkeys(ring, number)
            parts[number].append(self._vertices(ring))
        for rings in parts:
            rings[1:] = sorted(rings[1:], key=lambda ring: self._place(ring[0]))
        parts.sort(key=lambda rings: self._place(rings[0][0]))
        points = self._arrangement.points
        found = [[[points[vertex] for vertex in ring] for ring in rings] for rings in parts]
        return [Part(outline, holes) for outline, *holes in found]

    def _nearest_bounding(self) -> list[int]:
        """Return for each piece itself, if it bounds, or the next bounding piece below it, or -1.

        There is none in between, at the left end of the piece. Further right there may be other
        ones, but the faces above the result and around the piece stay connected.
        """
        nearest: list[int] = []
        for piece, below in enumerate(self._sweep.below):
            if self._is_bounding[piece]:
                nearest.append(piece)
            else:
                nearest.append(nearest[below] if below >= 0 else -1)
        return nearest

    def _rings(self) -> Iterator[list[int]]:
        """Yield the rings of the boundary, each as its pieces, with the filled face to the left."""
        following = self._following()
        while following:
            first, piece = following.popitem()
            walk = [first]
            while piece != first:
                walk.append(piece)
                piece = following.pop(piece)
            yield from self._simple_rings(walk)

    def _following(self) -> dict[int, int]:
        """Return for each piece of the boundary the next one around the same filled face.

        That is the next one clockwise at its end: the filled face to its left is between them.
        """
        following: dict[int, int] = {}
        for vertex, star in enumerate(self._sweep.stars):
            bounding = [piece for piece in star if self._is_bounding[piece]]
            clockwise = bounding[-1:] + bounding[:-1]
            pairs = zip(bounding, clockwise, strict=True)
            following |= {piece: after for piece, after in pairs if self._end(piece) == vertex}
        return following

    def _simple_rings(self, walk: list[int]) -> Iterator[list[int]]:
        """Yield the rings of a walk around a filled face, cut where it comes to a vertex again.

        The face is connected, so at most one of them has it inside: the others are its holes.
        """
        ring: list[int] = []
        place: dict[int, int] = {}
        for piece in walk:
            vertex = self._start(piece)
            if vertex in place:
                first = place[vertex]
                closed = ring[first:]
                del ring[first:]
                for other in closed:
                    del place[self._start(other)]
                yield closed
            place[vertex] = len(ring)
            ring.append(piece)
        yield ring

    def _start(self, piece: int) -> int:
        left, right, _ = self._sweep.pieces[piece]
        return left if self._goes_right[piece] else right

    def _end(self, piece: int) -> int:
        left, right, _ = self._sweep.pieces[piece]
        return right if self._goes_right[piece] else left

    def _vertices(self, ring: list[int]) -> list[int]:
        """Return the vertices of a ring, first the one that comes first in the rings given.

        Points in which others only touch or cross it are left out.
        """
        every = [self._start(piece) for piece in ring]
        pairs = zip(every[-1:] + every[:-1], every, every[1:] + every[:1], strict=True)
        kept = [vertex for before, vertex, after in pairs if self._is_vertex(before, vertex, after)]
        first = min(range(len(kept)), key=lambda k: self._place(kept[k]))
        return kept[first:] + kept[:first]

    def _is_vertex(self, before: int, vertex: int, after: int) -> bool:
        """Return True if the boundary bends there, or an edge along it begins or ends there."""
        orientation = self._arrangement.orientation
        return bool(orientation(before, vertex, after)) or any(
            orientation(before, vertex, end) == 0 for end in self._arrangement.neighbours[vertex]
        )

    def _place(self, vertex: int) -> tuple[int, int]:
        """Return the place of a vertex in the rings given; of crossings behind all of these."""
        return self._arrangement.given[vertex], vertex
