"""Two pieces of any motion: candidates against the exact first times of all pairs of features.

Of each pair of a vertex and an edge or a vertex the exact time T is known from which on they touch,
or are at the distance of the sum of the radii. The filter must not lose it: there is a candidate
with low < T <= until, unless a certain contact is before T. Where it says "sure" there must be one.
Pieces are made to tie: grids, discs that pass at the distance of their radii, corners that meet
corners, equal velocities, spans that end at thirds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from random import Random
from typing import Final, NamedTuple

from exactpt.filters.candidates import NO_EDGE, NO_VERTEX, Candidates
from exactpt.filters.features import Filter
from exactpt.filters.rows import AFFINE, CURVED, GENERAL, OWN, STRAIGHT, TURNING, Table
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, nearest_float, of_double
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.track import Incidence
from exactpt.pair.features import FeaturePair
from fuzz.adversaries.moving import Moving, Place, add_row, tracks
from fuzz.adversaries.pieces import TURNS
from fuzz.adversaries.report import Report, run

__all__ = ["KINDS", "check", "pairs_of"]


class Key(NamedTuple):
    """A pair of features, under the name that candidates have.

    Attributes:
        piece, vertex: the vertex of one piece.
        other: the other piece.
        edge: its edge, or `NO_EDGE`.
        other_vertex: its vertex, or `NO_VERTEX`.
    """

    piece: int
    vertex: int
    other: int
    edge: int
    other_vertex: int


class Shape(NamedTuple):
    """Places, and the edges between them."""

    places: tuple[Place, ...]
    edges: tuple[tuple[int, int], ...]


SQUARE: Final[tuple[tuple[int, int], ...]] = ((0, 0), (1, 0), (1, 1), (0, 1))
DIRECTIONS: Final = ((1, 0), (0, 1), (3, 4), (-4, 3), (5, 12), (-1, 0), (0, -1))
"""With rational lengths."""


def exact_pairs(one: Moving, two: Moving) -> Iterator[tuple[Key, FeaturePair]]:
    """Yield all pairs of features that matter."""
    of_one = tracks(one)
    of_two = tracks(two)
    has_radius = one.radius + two.radius > 0
    for piece, other, vertices, others, edges in (
        (0, 1, of_one, of_two, two.edges),
        (1, 0, of_two, of_one, one.edges),
    ):
        for v, vertex in enumerate(vertices):
            for e, (i, j) in enumerate(edges):
                is_point = i == j
                if is_point and has_radius:
                    continue  # a pair of two vertices, below
                ends = (others[i],) if is_point else (others[i], others[j])
                incidence = Incidence(piece, v, other, e, -1)
                yield Key(piece, v, other, e, NO_VERTEX), FeaturePair(incidence, vertex, ends)
    if has_radius:
        for v, vertex in enumerate(of_one):
            for w, other_vertex in enumerate(of_two):
                incidence = Incidence(0, v, 1, -1, w)
                yield Key(0, v, 1, NO_EDGE, w), FeaturePair(incidence, vertex, (other_vertex,))


def is_before(t: float, time: AlgebraicNumber) -> bool:
    """Return whether a double is before a time; one that is no number is not."""
    return t < math.inf and (t == -math.inf or time > of_double(t))


def check(one: Moving, two: Moving, report: Report) -> None:
    """Check the candidates of two pieces during the common part of their spans."""
    table = Table()
    add_row(table, 0, one)
    add_row(table, 1, two)
    low = max(table.start)
    high = min(table.end)
    if not low < high:
        return
    found = Candidates(math.inf)
    search = Filter(table)
    search.collect(0, 1, low, high, low, found)
    sharper = search.sharpen(found, low)
    truth = Truth(one, two)
    report.rows += len(truth.times)
    for name, rows in (("collect", found), ("sharpen", sharper)):
        for fault in faults_of(rows, truth, report):
            report.wrong.append(f"{name}: {fault}: {one} {two}")
    report.count("contacts" if truth.contacts else "none")
    if found.limit < math.inf:
        report.count("limited")
    kept = {key_of(sharper, k) for k in range(len(sharper.low)) if sharper.low[k] <= sharper.limit}
    for key, time in truth.times.items():
        if time is None and key in kept:
            report.count("candidates in vain")


class Truth:
    """The exact pairs of features of two pieces, and their times.

    Attributes:
        pairs: all pairs of features that matter.
        times: the first time of each within both spans, or None.
        contacts: those that there are.
        squared: the square of the distance at which features touch.
    """

    def __init__(self, one: Moving, two: Moving) -> None:
        begin = AlgebraicNumber(max(one.start, two.start))
        end = min(one.end, two.end)
        self.squared = (one.radius + two.radius) ** 2
        self.pairs = dict(exact_pairs(one, two))
        self.times = {
            key: pair.first_time(self.squared, begin, end) for key, pair in self.pairs.items()
        }
        self.contacts = [time for time in self.times.values() if time is not None]

    def touch_within(self, key: Key, low: float, high: float) -> bool:
        """Return True if a pair touches after one time, up to another one."""
        after = AlgebraicNumber(of_double(low))
        return self.pairs[key].first_time(self.squared, after, of_double(high)) is not None


def faults_of(rows: Candidates, truth: Truth, report: Report) -> Iterator[str]:
    """Yield what is wrong with the candidates of two pieces; count those that are sure."""
    is_contact_by_limit = any(not is_before(rows.limit, time) for time in truth.contacts)
    if rows.limit < math.inf and not is_contact_by_limit:
        yield f"no contact up to {rows.limit}"
    spans: dict[Key, list[tuple[float, float]]] = {}
    for k in range(len(rows.low)):
        key = key_of(rows, k)
        spans.setdefault(key, []).append((rows.low[k], rows.until[k]))
        if rows.sure[k]:
            report.count("sure")
            if not truth.touch_within(key, rows.low[k], rows.high[k]):
                yield f"not sure: {key}"
    for key, time in truth.times.items():
        if time is None or is_before(rows.limit, time):
            continue
        is_kept = any(
            is_before(low, time) and not is_before(until, time) for low, until in spans.get(key, [])
        )
        if not is_kept:
            yield f"lost {key} at {float(time)}"


def key_of(rows: Candidates, k: int) -> Key:
    """Return the name of a candidate."""
    return Key(rows.one[k], rows.vertex[k], rows.other[k], rows.edge[k], rows.other_vertex[k])


# Pieces


def numbers(rng: Random) -> Callable[[], QQ]:
    """Return a source of small numbers, of one of several kinds."""
    scale = rng.choice([QQ(1)] * 4 + [QQ(1, 3), QQ(1, 7), QQ(1, 10), QQ(2**30), QQ(1, 2**40)])
    kind = rng.choice(["grid", "grid", "halves", "doubles"])

    def number() -> QQ:
        if kind == "doubles":
            return of_double(rng.uniform(-3.0, 3.0)) * scale
        return QQ(rng.randint(-6, 6), 2 if kind == "halves" else 1) * scale

    return number


def shape(rng: Random, size: QQ) -> Shape:
    """Return a point, a segment, a triangle or a square."""
    n = rng.choice([1, 1, 2, 3, 4])
    first = rng.randint(0, 3)
    corners = [SQUARE[(first + i) % 4] for i in range(n)]
    cosine, sine = rng.choice(DIRECTIONS)
    places = tuple(
        (size * (cosine * x - sine * y), size * (sine * x + cosine * y)) for x, y in corners
    )
    if n == 1:
        return Shape(places, ((0, 0),))
    if n == 2:
        return Shape(places, ((0, 1),))
    return Shape(places, tuple((i, (i + 1) % n) for i in range(n)))


def span(rng: Random, length: QQ) -> tuple[QQ, QQ]:
    """Return a span of time; some end at thirds."""
    if rng.random() < 0.5:
        return QQ(0), length
    return QQ(rng.randint(-2, 1), 3) * length, QQ(rng.randint(2, 5), 3) * length


def polynomial(number: Callable[[], QQ], degree: int, length: QQ) -> Polynomial:
    """Return a polynomial that changes about as much as its numbers in a length of time."""
    return Polynomial([number() / length**k for k in range(degree + 1)])


def moving(rng: Random, kind: int, number: Callable[[], QQ], length: QQ, radius: QQ) -> Moving:
    """Return a piece of a kind."""
    if kind == GENERAL:
        other = rng.choice((CURVED, TURNING, AFFINE, OWN))
        piece = moving(rng, other, number, length, radius)
        return replace(piece, is_general=True, blur=QQ(0))
    size = abs(number()) / 5 or QQ(1)
    places, edges = shape(rng, size)
    start, end = span(rng, length)
    degrees = {STRAIGHT: 1, CURVED: rng.choice([2, 3]), OWN: rng.choice([1, 2, 3])}
    degree = degrees.get(kind, 1)
    path = polynomial(number, degree, length), polynomial(number, degree, length)
    frame: tuple[Polynomial, ...] = ()
    own: tuple[tuple[Polynomial, Polynomial], ...] = ()
    if kind == TURNING:
        half_turn = Polynomial([QQ(rng.randint(-2, 2), 3), QQ(rng.randint(-3, 3), 2) / length])
        frame = (half_turn,)
    elif kind == AFFINE:
        frame = tuple(
            Polynomial([rng.randint(-2, 2), QQ(rng.randint(-2, 2), 2) / length]) for _ in range(4)
        )
    elif kind == OWN:
        x, y = path
        small = [polynomial(lambda: number() / 8, degree, length) for _ in range(2 * len(places))]
        own = tuple(
            (x + dx + small_x, y + dy + small_y)
            for (dx, dy), small_x, small_y in zip(places, small[::2], small[1::2], strict=True)
        )
        places = ()
    blur = size * rng.choice([QQ(0), QQ(0), QQ(1, 2 ** rng.randint(10, 50))])
    turn = rng.choice(TURNS) if kind == TURNING else TURNS[0]
    return Moving(
        kind=kind,
        start=start,
        end=end,
        places=places,
        path=path,
        frame=frame,
        own=own,
        edges=edges,
        radius=radius,
        blur=blur,
        turn=turn,
    )


def tied(rng: Random, one: Moving, two: Moving, length: QQ) -> Moving:
    """Return the second piece moved so that two vertices meet at the distance of the radii."""
    if one.kind != STRAIGHT or two.kind != STRAIGHT:
        return two
    t = QQ(rng.randint(0, 6), 6) * length
    one_x, one_y = rng.choice(one.places)
    two_x, two_y = rng.choice(two.places)
    direction_x, direction_y = rng.choice(DIRECTIONS)
    direction_length = math.isqrt(direction_x**2 + direction_y**2)
    reach = (one.radius + two.radius) / direction_length
    how = rng.choice(["tangent", "corner", "together", "at the end"])
    path_x, path_y = one.path
    speed_x = path_x.exact_at(QQ(1)) - path_x.exact_at(QQ(0))
    speed_y = path_y.exact_at(QQ(1)) - path_y.exact_at(QQ(0))
    if how == "tangent":
        across = QQ(rng.randint(1, 3)) / length
        speed_x -= direction_y * across
        speed_y += direction_x * across
    elif how != "together":
        along = QQ(rng.randint(-3, 3)) / length
        speed_x += direction_x * along
        speed_y += rng.choice([direction_y, -direction_y, 0]) * along
    if how == "at the end":
        t = min(one.end, two.end)
    at_x = path_x.exact_at(t) + one_x + reach * direction_x - two_x
    at_y = path_y.exact_at(t) + one_y + reach * direction_y - two_y
    path = (
        Polynomial([at_x - speed_x * t, speed_x]),
        Polynomial([at_y - speed_y * t, speed_y]),
    )
    return replace(two, path=path)


def with_origin(rng: Random, piece: Moving) -> Moving:
    """Return a piece, or the same with a row of polynomials in the time since its middle."""
    if piece.kind == STRAIGHT or rng.random() < 0.4:
        return piece
    middle = of_double(nearest_float((piece.start + piece.end) / 2))
    return replace(piece, origin=middle)


def shifted(piece: Moving, later: QQ) -> Moving:
    """Return a piece that moves as another one did before."""
    before = Polynomial([-later, 1])
    x, y = piece.path
    return replace(
        piece,
        start=piece.start + later,
        end=piece.end + later,
        path=(x(before), y(before)),
        frame=tuple(f(before) for f in piece.frame),
        own=tuple((x(before), y(before)) for x, y in piece.own),
    )


KINDS: Final = {
    "straight": (STRAIGHT,),
    "curved": (STRAIGHT, CURVED),
    "turning": (STRAIGHT, TURNING),
    "affine": (STRAIGHT, AFFINE),
    "own": (STRAIGHT, OWN),
    "general": (STRAIGHT, GENERAL),
    "mixed": (STRAIGHT, CURVED, TURNING, AFFINE, OWN, GENERAL),
}


def pairs_of(kinds: tuple[int, ...], rng: Random) -> Iterator[tuple[Moving, Moving]]:
    """Yield pairs of pieces of some kinds."""
    while True:
        number = numbers(rng)
        length = rng.choice([QQ(1), QQ(8), QQ(1, 3), QQ(2) ** rng.randint(-40, 40)])
        radii = [QQ(0)] * 2
        if rng.random() < 0.7:
            radii = [abs(number()) / rng.choice([1, 2, 3]) for _ in range(2)]
        one, two = (moving(rng, rng.choice(kinds), number, length, radius) for radius in radii)
        if rng.random() < 0.6:
            two = tied(rng, one, two, length)
        if rng.random() < 0.2:
            later = length * rng.choice([QQ(-3), QQ(1, 3), QQ(1000), QQ(2**20)])
            one, two = shifted(one, later), shifted(two, later)
        yield with_origin(rng, one), with_origin(rng, two)


def checked(kinds: tuple[int, ...]) -> Callable[[int, int], Report]:
    """Return the check of a number of rows: pairs of features."""

    def part(rows: int, seed: int) -> Report:
        report = Report()
        pairs = pairs_of(kinds, Random(seed))
        while report.rows < rows:
            check(*next(pairs), report)
        return report

    return part


if __name__ == "__main__":
    run({name: checked(kinds) for name, kinds in KINDS.items()}, __doc__ or "")
