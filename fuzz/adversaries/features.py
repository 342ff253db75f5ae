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
from typing import Final, TypeAlias

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

Key: TypeAlias = tuple[int, int, int, int, int]
"""Piece and vertex, the other piece, its edge and its vertex."""

SQUARE: Final[tuple[tuple[int, int], ...]] = ((0, 0), (1, 0), (1, 1), (0, 1))
DIRECTIONS: Final = ((1, 0), (0, 1), (3, 4), (-4, 3), (5, 12), (-1, 0), (0, -1))
"""With rational lengths."""


def exact_pairs(one: Moving, two: Moving) -> Iterator[tuple[Key, FeaturePair]]:
    """Yield all pairs of features that matter, under the names that candidates have."""
    p, q = tracks(one), tracks(two)
    has_radius = one.radius + two.radius > 0
    for a, b, vs, ws, edges in ((0, 1, p, q, two.edges), (1, 0, q, p, one.edges)):
        for v, vertex in enumerate(vs):
            for e, (i, j) in enumerate(edges):
                if i == j and has_radius:
                    continue
                ends = (ws[i],) if i == j else (ws[i], ws[j])
                incidence = Incidence(a, v, b, e, -1)
                yield (a, v, b, e, NO_VERTEX), FeaturePair(incidence, vertex, ends)
    if has_radius:
        for v, vertex in enumerate(p):
            for w, other in enumerate(q):
                incidence = Incidence(0, v, 1, -1, w)
                yield (0, v, 1, NO_EDGE, w), FeaturePair(incidence, vertex, (other,))


def is_before(t: float, time: AlgebraicNumber) -> bool:
    """Return whether a double is before a time; one that is no number is not."""
    return t < math.inf and (t == -math.inf or time > of_double(t))


def check(one: Moving, two: Moving, report: Report) -> None:
    """Check the candidates of two pieces during the common part of their spans."""
    table = Table()
    add_row(table, 0, one)
    add_row(table, 1, two)
    low, high = max(table.start), min(table.end)
    begin, end = max(one.start, two.start), min(one.end, two.end)
    if not low < high:
        return
    found = Candidates(math.inf)
    search = Filter(table)
    search.collect(0, 1, low, high, low, found)
    sharper = search.sharpen(found, low)
    squared = (one.radius + two.radius) ** 2
    exact = dict(exact_pairs(one, two))
    start = AlgebraicNumber(begin)
    times = {key: pair.first_time(squared, start, end) for key, pair in exact.items()}
    certain = [t for t in times.values() if t is not None]
    report.rows += len(times)
    for name, rows in (("collect", found), ("sharpen", sharper)):
        if rows.limit < math.inf and not any(not is_before(rows.limit, t) for t in certain):
            report.wrong.append(f"{name}: no contact up to {rows.limit}: {one} {two}")
        kept: dict[Key, list[tuple[float, float]]] = {}
        for k in range(len(rows.low)):
            key = rows.one[k], rows.vertex[k], rows.other[k], rows.edge[k], rows.other_vertex[k]
            kept.setdefault(key, []).append((rows.low[k], rows.until[k]))
            if rows.sure[k]:
                report.count("sure")
                after = AlgebraicNumber(of_double(rows.low[k]))
                if exact[key].first_time(squared, after, of_double(rows.high[k])) is None:
                    report.wrong.append(f"{name}: not sure: {key} {one} {two}")
        for key, t in times.items():
            if t is None or is_before(rows.limit, t):
                continue
            spans = kept.get(key, [])
            if not any(is_before(first, t) and not is_before(last, t) for first, last in spans):
                report.wrong.append(f"{name}: lost {key} at {float(t)}: {one} {two}")
    report.count("contacts" if certain else "none")
    if found.limit < math.inf:
        report.count("limited")
    for key in set(times):
        if times[key] is None and any(c == key for c in keys_of(sharper)):
            report.count("candidates in vain")


def keys_of(rows: Candidates) -> set[Key]:
    """Return the names of the candidates up to the limit."""
    return {
        (rows.one[k], rows.vertex[k], rows.other[k], rows.edge[k], rows.other_vertex[k])
        for k in range(len(rows.low))
        if rows.low[k] <= rows.limit
    }


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


def shape(rng: Random, size: QQ) -> tuple[tuple[Place, ...], tuple[tuple[int, int], ...]]:
    """Return places and edges: a point, a segment, a triangle or a square."""
    n = rng.choice([1, 1, 2, 3, 4])
    k = rng.randint(0, 3)
    corners = [SQUARE[(i + k) % 4] for i in range(n)]
    turn = rng.choice(DIRECTIONS)
    cosine, sine = turn
    places = tuple(
        (size * (cosine * x - sine * y), size * (sine * x + cosine * y)) for x, y in corners
    )
    if n == 1:
        return places, ((0, 0),)
    if n == 2:
        return places, ((0, 1),)
    return places, tuple((i, (i + 1) % n) for i in range(n))


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
    degree = {STRAIGHT: 1, CURVED: rng.choice([2, 3]), OWN: rng.choice([1, 2, 3])}.get(kind, 1)
    path = polynomial(number, degree, length), polynomial(number, degree, length)
    frame: tuple[Polynomial, ...] = ()
    own: tuple[tuple[Polynomial, Polynomial], ...] = ()
    if kind == TURNING:
        frame = (Polynomial([QQ(rng.randint(-2, 2), 3), QQ(rng.randint(-3, 3), 2) / length]),)
    elif kind == AFFINE:
        frame = tuple(
            Polynomial([rng.randint(-2, 2), QQ(rng.randint(-2, 2), 2) / length]) for _ in range(4)
        )
    elif kind == OWN:
        x, y = path
        small = [polynomial(lambda: number() / 8, degree, length) for _ in range(2 * len(places))]
        own = tuple(
            (x + dx + small[2 * v], y + dy + small[2 * v + 1]) for v, (dx, dy) in enumerate(places)
        )
        places = ()
    blur = size * rng.choice([QQ(0), QQ(0), QQ(1, 2 ** rng.randint(10, 50))])
    turn = rng.choice(TURNS) if kind == TURNING else TURNS[0]
    return Moving(kind, start, end, places, path, frame, own, edges, radius, blur, turn)


def tied(rng: Random, one: Moving, two: Moving, length: QQ) -> Moving:
    """Return the second piece moved so that two vertices meet at the distance of the radii."""
    if one.kind != STRAIGHT or two.kind != STRAIGHT:
        return two
    t = QQ(rng.randint(0, 6), 6) * length
    (x, y), (p, q) = rng.choice(one.places), rng.choice(two.places)
    reach = one.radius + two.radius
    ux, uy = rng.choice(DIRECTIONS)
    unit = QQ(1, {1: 1, 5: 5, 7: 5, 17: 13}[abs(ux) + abs(uy)])
    how = rng.choice(["tangent", "corner", "together", "at the end"])
    vx, vy = (f.exact_at(QQ(1)) - f.exact_at(QQ(0)) for f in one.path)
    if how == "tangent":
        speed = QQ(rng.randint(1, 3)) / length
        vx, vy = vx - uy * speed, vy + ux * speed
    elif how != "together":
        speed = QQ(rng.randint(-3, 3)) / length
        vx, vy = vx + ux * speed, vy + rng.choice([uy, -uy, 0]) * speed
    if how == "at the end":
        t = min(one.end, two.end)
    at_x = one.path[0].exact_at(t) + x + reach * ux * unit - p
    at_y = one.path[1].exact_at(t) + y + reach * uy * unit - q
    path = Polynomial([at_x - vx * t, vx]), Polynomial([at_y - vy * t, vy])
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
        report, pairs = Report(), pairs_of(kinds, Random(seed))
        while report.rows < rows:
            check(*next(pairs), report)
        return report

    return part


if __name__ == "__main__":
    run({name: checked(kinds) for name, kinds in KINDS.items()}, __doc__ or "")
