"""The Euclidean distance of two bodies as a function of time.

While two bodies are disjoint, one pair of features is nearest, from one algebraic time to the
next; the squared distance is then a quotient of two polynomials. Let f be nearest just after a
time, and g another pair. g becomes nearer only at a time at which the numerator of g - f
vanishes: where the foot of g's perpendicular comes onto its edge, g is as far as a pair of
vertices, so not nearer than f. f itself ends where its foot leaves its edge. At each such time
the pairs are compared anew, just after it, by signs of polynomials.

The distance of rounded bodies is that of their cores less the sum of the radii, so it has the
same pieces, up to the times at which they intersect.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cmp_to_key, lru_cache
from itertools import zip_longest
from typing import Final, NamedTuple, final

from exactpt.brief import counted, record_in_brief
from exactpt.cached_property import cached_property
from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.algebraic_value import quotient_at, quotient_range, square_root
from exactpt.kernel.budget import check_budget
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    derivative,
    evaluate,
    multiply,
    negate,
    positive_remainder,
    quotient,
    scale,
    subtract,
)
from exactpt.kernel.numbers import QQ, ZZ, Rational, fraction, power_of_two, rational, shorten, show
from exactpt.kernel.roots import roots_after
from exactpt.kernel.square_root import nearest_root_less
from exactpt.motion.body import Body
from exactpt.pair.distance import squared_gap
from exactpt.pair.features import Feature, FeaturePair
from exactpt.pair.near_features import ENOUGH, NearFeatures
from exactpt.pair.pieces_of_two import PiecePair, piece_pairs, two_bodies
from exactpt.scene.scene import Scene
from exactpt.search.intervals import intervals

CLOSE: Final = power_of_two(-30)
"""Width, as a part of the upper one, of the bounds by which most squared distances are compared."""
IN_VAIN: Final = 5
"""Number of halvings in a row, each leaving more than three quarters, after which they end."""

_in_order = cmp_to_key(AlgebraicNumber.compare)


class ClearancePiece(NamedTuple):
    """A time interval in which one pair of features is nearest.

    Attributes:
        start, end: the closed interval.
        features: of the first and the second body; None while the bodies intersect. An edge has its
            ends: where the foot of the perpendicular comes to an end of it and turns back, the
            pair stays the same, though at this single time `distance` has the vertex instead.
        numerator, denominator: polynomials with integer coefficients, the constant first, whose
            quotient is the square of the distance plus `Clearance.radius`. Where both vanish,
            which they do at single times, it is the limit.
    """

    start: AlgebraicNumber
    end: AlgebraicNumber
    features: tuple[Feature, Feature] | None
    numerator: tuple[int, ...]
    denominator: tuple[int, ...]

    def __repr__(self) -> str:
        return f"<ClearancePiece from t = {self.start:.6g} to {self.end:.6g}>"


class Minimum(NamedTuple):
    """The least distance; ``float`` gives the nearest double.

    Attributes:
        time: the first time of the least distance.
        squared: its square, exactly.
    """

    time: AlgebraicNumber
    squared: AlgebraicNumber

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def distance(self) -> AlgebraicNumber:
        """The least distance, exactly."""
        return square_root(self.squared)

    def __float__(self) -> float:
        return float(self.distance)


class CloseInterval(NamedTuple):
    """A maximal closed interval of time in which two bodies are within a distance.

    Attributes:
        a, b: the names of the bodies.
        start, end: the exact ends; equal if the bodies come to the distance at one time only.
        pieces: the parts of the pieces of the `Clearance` in it, with the nearest features.
    """

    a: str
    b: str
    start: AlgebraicNumber
    end: AlgebraicNumber
    pieces: tuple[ClearancePiece, ...]

    def __repr__(self) -> str:
        names = f"{shorten(self.a, 30)} and {shorten(self.b, 30)}"
        return f"<CloseInterval of {names} from t = {self.start:.6g} to {self.end:.6g}>"


@final
@dataclass(frozen=True)
class Clearance:
    """The distance of two bodies over a time span.

    Attributes:
        a, b: the names of the bodies.
        pieces: from the start of the span to its end, each beginning where the last one ends.
        radius: the sum of the radii.
    """

    a: str
    b: str
    pieces: tuple[ClearancePiece, ...]
    radius: Fraction = Fraction(0)

    def __repr__(self) -> str:
        names = f"{shorten(self.a, 30)} and {shorten(self.b, 30)}"
        start, end = self.pieces[0].start, self.pieces[-1].end
        pieces = counted(len(self.pieces), "piece")
        return f"<Clearance of {names}: {pieces} from t = {start:.6g} to {end:.6g}>"

    def squared(self, at: Rational) -> Fraction:
        """Return the squared distance at a rational time.

        Raises:
            InputError: if the time is outside of the time span, or the square is irrational, which
                only that of rounded bodies can be.
        """
        return squared_gap(self.squared_with_radius(at), self.radius)

    def squared_with_radius(self, at: Rational) -> Fraction:
        """Return the square of the sum of the distance and the radius, at a rational time.

        While bodies with radii intersect it is the square of the radius, and not, as
        `Distance.core_squared`, that of the distance of their cores.

        Raises:
            InputError: if the time is outside of the time span.
        """
        t = rational(at)
        for piece in self.pieces:
            if piece.start.compare_rational(t) <= 0 <= piece.end.compare_rational(t):
                below = evaluate(_poly(piece.denominator), t)
                if below:
                    return fraction(evaluate(_poly(piece.numerator), t) / below)
        raise InputError(f"the time {show(t)} is outside of the time span")

    def __call__(self, at: Rational) -> float:
        """Return the double nearest to the distance at a rational time."""
        return nearest_root_less(QQ(self.squared_with_radius(at)), QQ(self.radius))

    def below(self, distance: Rational) -> tuple[CloseInterval, ...]:
        """Return the maximal closed intervals in which the bodies are at most a distance apart.

        Raises:
            InputError: if the distance is negative.
        """
        limit = (a_distance(distance) + QQ(self.radius)) ** 2
        found: list[list[ClearancePiece]] = []
        for part in (part for piece in self.pieces for part in _parts_within(piece, limit)):
            continues = bool(found) and found[-1][-1].end == part.start
            if continues and found[-1][-1].start < part.start:
                if part.start < part.end:
                    found[-1].append(part)
            elif continues:  # a single time before
                found[-1] = [part]
            else:
                found.append([part])
        return tuple(
            CloseInterval(self.a, self.b, parts[0].start, parts[-1].end, tuple(parts))
            for parts in found
        )

    @cached_property
    def minimum(self) -> Minimum:
        """The least distance in the time span, and the first time at which it occurs."""
        for piece in self.pieces:
            if piece.features is None:
                return Minimum(piece.start, AlgebraicNumber(0))
        best: tuple[AlgebraicNumber, AlgebraicNumber] | None = None
        last = self.pieces[-1]
        times = [(piece, time) for piece in self.pieces for time in _candidates(piece)]
        places = [
            (_poly(piece.numerator), _poly(piece.denominator), time)
            for piece, time in [*times, (last, last.end)]
        ]
        ranges = [quotient_range(*place, CLOSE) for place in places]
        most = min(high for _, high in ranges)
        for (n, d, time), (low, _) in zip(places, ranges, strict=True):
            if low <= most:
                value = quotient_at(n, d, time)
                if best is None or value.compare(best[1]) < 0:
                    best = time, value
        assert best is not None  # noqa: S101 - there is a piece
        return Minimum(best[0], _squared_gap(best[1], self.radius))


def clearance_of_two(scene: Scene, a: str, b: str) -> Clearance:
    """Return the distance of two bodies over the time span of a scene.

    Raises:
        InputError: if a body does not exist, or both are the same.
    """
    first, second = two_bodies(scene, a, b)
    now = AlgebraicNumber(scene.exact_start)
    radius = first.radius + second.radius
    meeting = (int(radius.numerator**2),) if radius else (), (int(radius.denominator**2),)
    pieces: list[ClearancePiece] = []
    for start, end in [*intervals(first, second, scene.exact_start, scene.exact_end), (None, None)]:
        stop = AlgebraicNumber(scene.exact_end) if start is None else start
        pieces += _apart(first, second, now, stop)
        if start is not None and end is not None:
            pieces.append(ClearancePiece(start, end, None, *meeting))
            now = end
    return Clearance(a, b, tuple(pieces), radius)


def a_distance(given: Rational) -> QQ:
    """Return a distance as a rational number.

    Raises:
        InputError: if it is negative.
    """
    distance = rational(given)
    if distance < 0:
        raise InputError(f"a distance must be at least 0, got {show(distance)}")
    return distance


def _squared_gap(core_squared: AlgebraicNumber, radius: Fraction) -> AlgebraicNumber:
    """(sqrt(core_squared) - radius)^2."""
    if not radius:
        return core_squared
    n, d = ZZ(radius.numerator), ZZ(radius.denominator)
    root = square_root(core_squared)
    # (d y - n)^2 / d^2 at the root y.
    return quotient_at((n * n, -2 * n * d, d * d), (d * d,), root)


def _apart(a: Body, b: Body, begin: AlgebraicNumber, end: AlgebraicNumber) -> list[ClearancePiece]:
    """Return the pieces of the distance between two times; between them the bodies are disjoint."""
    pieces: list[ClearancePiece] = []
    now = begin
    for piece_pair in piece_pairs(a, b, begin.exact_low, end.exact_high):
        until = min(AlgebraicNumber(piece_pair.end), end)
        if now < until:
            pieces += _in_piece_pair(NearFeatures(a, b, piece_pair), piece_pair, now, until)
            now = until
    return pieces


def _in_piece_pair(
    near: NearFeatures, piece_pair: PiecePair, now: AlgebraicNumber, until: AlgebraicNumber
) -> Iterator[ClearancePiece]:
    """Return the pieces from a time in a piece pair until a later one."""
    nearest: FeaturePair | None = None
    for low, high, pairs in _windows(near, piece_pair.begin, piece_pair.end):
        if now.compare_rational(high) >= 0:
            continue
        nearest = nearest or _nearest_after(pairs, now)
        after = max(now, AlgebraicNumber(low))
        while True:
            check_budget()
            stop = _first_change(nearest, pairs, after, until, min(high, until.exact_high))
            if stop is None:
                break
            yield _piece(now, stop, nearest)
            now = after = stop
            nearest = _nearest_after(pairs, now)  # also at the end of a window, which is closed
        if until.compare_rational(high) <= 0:
            break
    assert nearest is not None  # noqa: S101 - a window contains now
    yield _piece(now, until, nearest)


def _windows(near: NearFeatures, begin: QQ, end: QQ) -> Iterator[tuple[QQ, QQ, list[FeaturePair]]]:
    """Return closed intervals from begin to end, with the pairs that may be nearest in each.

    An interval is halved until few pairs are left, or halving it does not leave out many.
    """
    waiting = [(begin, end, near.all, 0)]
    while waiting:
        low, high, numbers, in_vain = waiting.pop()
        kept = near.nearest(numbers, low, high)
        in_vain = in_vain + 1 if 4 * len(kept) > 3 * len(numbers) else 0
        if len(kept) <= ENOUGH or in_vain > IN_VAIN:
            yield low, high, near.pairs(kept)
        else:
            middle = (low + high) / 2
            waiting += [(middle, high, kept, in_vain), (low, middle, kept, in_vain)]


def _piece(start: AlgebraicNumber, end: AlgebraicNumber, pair: FeaturePair) -> ClearancePiece:
    n, d = (tuple(map(int, f)) for f in pair.lowest)
    return ClearancePiece(start, end, pair.features, n, d)


def _nearest_after(pairs: list[FeaturePair], now: AlgebraicNumber) -> FeaturePair:
    """Return the nearest pair just after a time; of equal ones the first, vertices before edges."""
    holding = [pair for pair in pairs if pair.holds_after(now)]
    nearest = holding[0]
    for pair in holding[1:]:
        if now.sign_after(_lead(pair, nearest)) < 0:
            nearest = pair
    return nearest


def _lead(g: FeaturePair, f: FeaturePair) -> IntPoly:
    """Return a polynomial with the sign of the difference of the squared distances of g and f."""
    (n, d), (m, e) = g.lowest, f.lowest
    if len(d) < len(e):
        return negate(_lead(f, g))
    over = _over(d, e) if len(e) > 1 else None
    if over is None:
        return subtract(multiply(n, e), multiply(m, d))
    by, rest = over
    return subtract(scale(n, by), multiply(m, rest))


@lru_cache(64)
def _over(d: IntPoly, e: IntPoly) -> tuple[ZZ, IntPoly] | None:
    """Return c > 0 and c d / e, both in integers, if e divides d; neither is ever negative.

    Pairs of features of rigid bodies have few denominators.
    """
    if positive_remainder(d, e):
        return None
    over = quotient(d, e)
    factor = QQ(d[-1], e[-1] * over[-1])
    return ZZ(factor.denominator), scale(over, ZZ(factor.numerator))


def _first_change(
    nearest: FeaturePair,
    pairs: list[FeaturePair],
    now: AlgebraicNumber,
    until: AlgebraicNumber,
    above: QQ,
) -> AlgebraicNumber | None:
    """Return the first time in (now, above], before until, of another nearest pair."""
    times: list[tuple[AlgebraicNumber, FeaturePair | None]] = []
    for f in filter(None, nearest.limits):
        times += [(root.time, None) for root in roots_after(f, now, above)]
    for other in pairs:
        lead = _lead(other, nearest) if other is not nearest else ()
        if lead:
            times += [(root.time, other) for root in roots_after(lead, now, above)]
    for time, pair in sorted(times, key=lambda found: _in_order(found[0])):
        if time >= until:
            break
        if pair is None:
            if not nearest.holds_after(time):
                return time
        elif pair.holds_after(time) and time.sign_after(_lead(pair, nearest)) < 0:
            return time
    return None


def _parts_within(piece: ClearancePiece, limit: QQ) -> Iterator[ClearancePiece]:
    """Return the maximal parts of a piece in which its quotient is at most a limit.

    The distance is finite, so without a common factor the denominator d is positive: the sign of
    n - limit d at a time is that of n / d - limit.
    """
    n, d = _poly(piece.numerator), _poly(piece.denominator)
    f = subtract(scale(n, ZZ(limit.denominator)), scale(d, ZZ(limit.numerator)))
    if not f:
        yield piece
        return
    times = [piece.start]
    if piece.start < piece.end:
        roots = roots_after(f, piece.start, piece.end.exact_high)
        times += [root.time for root in roots if root.time < piece.end]
        times.append(piece.end)
    for time, following in zip_longest(times, times[1:]):
        if following is not None and time.sign_after(f) < 0:
            yield piece._replace(start=time, end=following)
        elif time.sign_of(f) <= 0:
            yield piece._replace(start=time, end=time)


def _candidates(piece: ClearancePiece) -> Iterator[AlgebraicNumber]:
    """Yield the times before its end at which the distance may be least in a piece, in order."""
    yield piece.start
    n, d = _poly(piece.numerator), _poly(piece.denominator)
    slope = subtract(multiply(derivative(n), d), multiply(n, derivative(d)))
    if slope and piece.start < piece.end:
        for root in roots_after(slope, piece.start, piece.end.exact_high):
            if root.time < piece.end:
                yield root.time


def _poly(coefficients: tuple[int, ...]) -> IntPoly:
    return tuple(map(ZZ, coefficients))
