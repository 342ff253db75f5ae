"""Turning at a constant rate: the path whose angle is omega t, for all times.

The cosine and the sine of omega t are not rational functions of t. A `Spin` consists of pieces,
each a `Rigid` motion that leads from one rational unit vector to the next. They are made and proved
as those of a `PosePath` (`exactpt.motion.pose_pieces`, `exactpt.motion.path_error`), but for the
grid of times on which they begin.

**The grid.** It is fixed at time 0: piece k holds from k S to (k + 1) S, for all integers k. The
step S is the longest time j 2^e, 8 <= j < 16, in which the body turns by an angle a with

    a <= 1/4    and    a^5 <= 1200 error.

So S is a function of omega and the error alone, and a piece of these, the pivot, the translation
and k. A piece is made when it is needed for the first time, and nothing about it depends on what
was needed before. (Pieces of more than 1/4 radian are fewer, but slower to search.)

**Every piece is within the error.** Its half turn interpolates f(s) = tan(a s / 2) at 0, 3/10,
7/10 and 1. As a / 2 <= 1/8, the fourth derivative of f is at most 16.73 (a / 2)^5; the product of
the distances of s from the four nodes is at most 0.01103 in [0, 1]. So the interpolating cubic is
within d = 16.73 (a / 2)^5 0.01103 / 24 < 2.41 10^-4 a^5 of f. The bound that is proved of a piece
is |e(0)| + max |E| (1 + 2 max |h| max |h'|), where E, from 0 on, has the derivative 2 h' - a (1 +
h^2), which is 0 for h = f. So

    |E| <= (2 + 2 a max |h|) d < 2.07 d,    1 + 2 max |h| max |h'| < 1.04,

which makes less than 5.2 10^-4 a^5. With Bernstein coefficients on eight equal parts in place of
the maximum it is less than 5.6 10^-4 a^5, at most 0.68 of the error. Rounding adds to it. The unit
vectors at both ends are off by at most 1/32 of the error, and the values at the nodes by less; so
e(0) is at most 1/32, h changes by at most 1/16, and E by at most 1/8 of the error. Together this
is less than 0.87 of the error. (No result depends on this derivation: each piece is proved when it
is made. It says that no proof fails.)
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Final, final

from exactpt.brief import call_in_brief
from exactpt.errors import InputError
from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import (
    QQ,
    Rational,
    ceil,
    exponent,
    floor,
    fraction,
    nearest_float,
    place,
    power_of_two,
    rational,
    rationals,
    show,
)
from exactpt.kernel.polynomial import ZERO, Polynomial, polynomial
from exactpt.motion.motions import Coefficients, Pieces, Piecewise, Rigid, SimpleMotion
from exactpt.motion.pose_path import PosePath
from exactpt.motion.pose_pieces import DEGREE, MOST, PieceMaker
from exactpt.motion.turned_angle import bits_for

_LARGEST_ANGLE: Final = QQ(1, 4)
_FIFTH_POWER: Final = QQ(1200)
_VECTORS: Final = QQ(1, 4)
"""The part of the error within which unit vectors are found: they are eight times as near."""


@final
class Spin(Piecewise):
    """A turn about a pivot at a constant rate, for all times: by the angle omega t at the time t.

    The body turns in rational pieces. Their angle differs from omega t by at most the error, at
    every time, so a point at a distance r from the pivot is at most r times the error from where it
    should be. A piece is a function of omega, the error, the pivot, the translation and its number;
    it is made when it is needed. A scene file has those that cover the time span of the scene.

    Every point stays at its distance from the pivot, which is at the time t at pivot + (x(t),
    y(t)): this encloses a body without any piece.

    >>> wheel = Spin(2, (1, 1), error="1/1000")
    >>> wheel.angle(10), wheel.error
    (Fraction(20, 1), Fraction(1, 1000))
    >>> [until for until, _ in wheel.pieces_during(0, "1/4").pieces]
    [Fraction(0, 1), Fraction(1, 8), Fraction(1, 4), None]

    Args:
        omega: the angle by which the body turns in one unit of time, in radians, counter-clockwise.
        pivot: the centre of rotation.
        error: the largest error of the angle, in radians.
        x: a translation, as in `Translation`, applied last.
        y: likewise.

    Attributes:
        angle: omega t, a polynomial.
        x, y: the translation, polynomials.

    Raises:
        InputError: if an argument is invalid.
    """

    __slots__ = (
        "_made",
        "_maker",
        "angle",
        "exact_error",
        "exact_omega",
        "exact_pivot",
        "exact_step",
        "x",
        "y",
    )

    def __init__(
        self,
        omega: Rational,
        pivot: Sequence[Rational] = (0, 0),
        *,
        error: Rational = "1/1000000",
        x: Coefficients = ZERO,
        y: Coefficients = ZERO,
    ) -> None:
        self.exact_omega, self.exact_error = rational(omega), rational(error)
        if self.exact_error <= 0:
            raise InputError(f"an error is positive: {show(self.exact_error)}")
        bits_for(self.exact_error, QQ(0))  # raises if the error is too small
        px, py = rationals(pivot, 2, "a pivot has two coordinates")
        self.exact_pivot: Point = (px, py)
        self.x, self.y = polynomial(x), polynomial(y)
        self.angle = Polynomial([0, self.exact_omega])
        self.exact_step = _step(self.exact_omega, self.exact_error)
        self._maker = PieceMaker(
            self.exact_error, QQ(0), self.exact_pivot, vector_error=self.exact_error * _VECTORS
        )
        self._made: dict[int, Rigid] = {}

    @property
    def omega(self) -> Fraction:
        """The angle by which the body turns in one unit of time, in radians."""
        return fraction(self.exact_omega)

    @property
    def pivot(self) -> tuple[Fraction, Fraction]:
        """The centre of rotation."""
        return place(self.exact_pivot)

    @property
    def error(self) -> Fraction:
        """The largest error of the angle, in radians."""
        return fraction(self.exact_error)

    def pieces_during(self, start: Rational, end: Rational) -> Pieces:
        """Return the pieces that cover a span, as a motion of its own.

        They begin at a time of the grid, at the start or before it, and end at one, at the end or
        after it. Before and after them the body does not turn.

        Args:
            start: the start of the span.
            end: its end, after the start.

        Raises:
            InputError: if the span is empty, or more than 100,000 pieces are needed.
        """
        since, until = rational(start), rational(end)
        if since >= until:
            raise InputError(f"a span ends after it starts: {show(since)}, then {show(until)}")
        if self.exact_step is None:
            ends, turns = [since, until], [self._piece(0)]
        else:
            first, last = floor(since / self.exact_step), ceil(until / self.exact_step)
            self._check_count(last - first)
            numbers = range(int(first), int(last))
            turns = [self._piece(k) for k in numbers]
            ends = [k * self.exact_step for k in range(int(first), int(last) + 1)]
        before, after = (self._at_rest(t) for t in (ends[0], ends[-1]))
        return Pieces(list(zip([*ends, None], [before, *turns, after], strict=True)))

    def with_translation(self, x: Coefficients, y: Coefficients) -> Spin:
        """Return the same turn with another translation."""
        return Spin(self.exact_omega, self.exact_pivot, error=self.exact_error, x=x, y=y)

    @property
    def exact_formulas(self) -> Sequence[SimpleMotion]:
        """See `Piecewise.exact_formulas`: one that stands for all."""
        half_turn = Polynomial([0, *[0] * (DEGREE - 1), 1]) if self.exact_omega else ZERO
        return (Rigid(half_turn, pivot=self.exact_pivot, x=self.x, y=self.y),)

    @property
    def exact_breakpoints(self) -> Sequence[QQ]:
        """See `Piecewise.exact_breakpoints`: without end, unless omega is 0."""
        if self.exact_step is None:
            return ()
        raise InputError(
            f"there is no end of the pieces of {self!r}: give a span, by Body.breakpoints_between"
        )

    def exact_breakpoints_between(self, start: QQ, end: QQ) -> Sequence[QQ]:
        """See `Piecewise.exact_breakpoints_between`: times of the grid, without the pieces."""
        step = self.exact_step
        if step is None or start >= end:
            return ()
        first, last = floor(start / step) + 1, ceil(end / step)
        self._check_count(last - first)
        return [k * step for k in range(int(first), int(last))]

    def exact_last_breakpoint_before(self, t: QQ) -> QQ | None:
        """See `Piecewise.exact_last_breakpoint_before`: a time of the grid."""
        step = self.exact_step
        return None if step is None else (ceil(t / step) - 1) * step

    def exact_is_breakpoint(self, t: QQ) -> bool:
        """See `Piecewise.exact_is_breakpoint`."""
        return self.exact_step is not None and (t / self.exact_step).denominator == 1

    def exact_formula_after(self, t: QQ) -> tuple[Rigid, QQ | None]:
        """See `Piecewise.exact_formula_after`."""
        if self.exact_step is None:
            return self._piece(0), None
        k = int(floor(t / self.exact_step))
        return self._piece(k), (k + 1) * self.exact_step

    def _check_count(self, count: int) -> None:
        if count > MOST:
            raise InputError(
                f"more than {MOST} pieces are needed for an error of "
                f"{nearest_float(self.exact_error):.6g} in this span"
            )

    def _piece(self, k: int) -> Rigid:
        """Return piece k; made and proved on first access."""
        made = self._made.get(k)
        if made is None:
            made = self._made.setdefault(k, self._make(k))
        return made

    def _make(self, k: int) -> Rigid:
        step = self.exact_step
        if step is None:
            return self._at_rest(QQ(0))
        turn, _ = self._maker.piece(k * step, (k + 1) * step, (self.x, self.y, self.angle))
        assert turn is not None  # noqa: S101 - derived above
        return turn

    def _at_rest(self, t: QQ) -> Rigid:
        """Return the motion without turning that is where the pieces are at a time of the grid."""
        vector = self._maker.vector(t, self.angle)
        return Rigid(ZERO, pivot=self.exact_pivot, x=self.x, y=self.y, orientation=vector)

    def _given(self) -> tuple[tuple[object, ...], dict[str, object]]:
        pivot = (str(self.exact_pivot[0]), str(self.exact_pivot[1]))
        given: dict[str, object] = {"error": str(self.exact_error), "x": self.x, "y": self.y}
        return (str(self.exact_omega), pivot), given

    def __repr__(self) -> str:
        given, options = self._given()
        moves = {key: f for key, f in options.items() if key == "error" or f != ZERO}
        return call_in_brief("Spin", *given, **moves)


def spin_of_pieces(
    pieces: Sequence[tuple[Rational | None, SimpleMotion]],
    omega: Rational,
    error: Rational,
    span: tuple[QQ, QQ],
) -> Spin | PosePath:
    """Return the motion in pieces that are said to turn by omega t, after a proof.

    It is a `Spin` if they are pieces of one, and cover the span. Otherwise it is the path of poses
    that the pieces follow: of the angle omega t from the end of the first piece to the beginning of
    the last one, before and after which the body does not turn, but is translated as ever.

    Args:
        pieces: as for `Pieces`: rigid motions about one pivot with one translation, the first and
            the last without a turn.
        omega: see `Spin`.
        error: see `Spin`.
        span: the time span of the scene.

    Raises:
        InputError: if the pieces are of another kind, or their angle differs from omega t by more
            than the error.
    """
    given = Pieces(pieces)
    turns = [turn for turn in given.motions if isinstance(turn, Rigid)]
    kinds = {(turn.exact_pivot, turn.x, turn.y) for turn in turns}
    if len(turns) < max(len(given.motions), 3) or len(kinds) > 1 or _turns_at_ends(turns):
        raise InputError(
            f"the pieces do not turn by {show(rational(omega))} t: they must be at least three "
            f"rigid motions with one pivot, x and y, and the first and the last must not turn"
        )
    (pivot, x, y), (first, last) = kinds.pop(), (given.exact_until[0], given.exact_until[-1])
    spin = Spin(omega, pivot, error=error, x=x, y=y)
    if first <= span[0] and span[1] <= last and _are_of(spin, given):
        return spin
    return _path_of(spin, given, span)


def _turns_at_ends(turns: Sequence[Rigid]) -> bool:
    return max(turns[0].half_turn.degree, turns[-1].half_turn.degree) > 0


def _are_of(spin: Spin, given: Pieces) -> bool:
    """Return True if pieces are successive ones of a spin, with rest before and after them."""
    ends = given.exact_until
    step = spin.exact_step
    if step is not None:
        is_on_grid = spin.exact_is_breakpoint(ends[0])
        if not is_on_grid or ends != tuple(ends[0] + k * step for k in range(len(ends))):
            return False  # without making a piece
    return spin.pieces_during(ends[0], ends[-1]) == given


def _path_of(spin: Spin, given: Pieces, span: tuple[QQ, QQ]) -> PosePath:
    """Return the path of poses that pieces follow, up to times beyond the span.

    Raises:
        InputError: if they do not follow it.
    """
    first, last = given.exact_until[0], given.exact_until[-1]
    before, after = given.motions[0], given.motions[-1]
    times, angles = [first, last], [spin.angle]
    pieces = list(zip(given.exact_until[1:], given.motions[1:-1], strict=True))
    if span[0] < first:
        times, angles = [span[0], *times], [Polynomial([spin.angle.exact_at(first)]), *angles]
        pieces = [(first, before), *pieces]
    if last < span[1]:
        times, angles = [*times, span[1]], [*angles, Polynomial([spin.angle.exact_at(last)])]
        pieces = [*pieces, (span[1], after)]
    poses = []
    for begin, angle in zip(times, angles, strict=False):
        since = Polynomial([begin, 1])
        poses.append([f(since) for f in (spin.x, spin.y, angle)])
    rests = [_rest_at(turn, t) for turn, t in ((before, times[0]), (after, times[-1]))]
    rows = [(times[0], rests[0]), *pieces, (None, rests[1])]
    try:
        return PosePath.of_pieces(rows, times, poses, spin.exact_error, pivot=spin.exact_pivot)
    except InputError:
        raise InputError(
            f"the pieces do not turn by {show(spin.exact_omega)} t within {show(spin.exact_error)}"
        ) from None


def _rest_at(turn: SimpleMotion, t: QQ) -> Rigid:
    """Return rest where a rigid motion is at a time."""
    assert isinstance(turn, Rigid)  # noqa: S101 - seen by the caller
    x, y = turn.x.exact_at(t), turn.y.exact_at(t)
    half_turn, turned = turn.half_turn.exact_at(t), turn.exact_orientation
    return Rigid(half_turn, pivot=turn.exact_pivot, x=x, y=y, orientation=turned)


def _step(omega: QQ, error: QQ) -> QQ | None:
    """Return the duration of pieces, as derived above; None without a turn."""
    if not omega:
        return None
    limit = min(_LARGEST_ANGLE**5, _FIFTH_POWER * error) / abs(omega) ** 5  # of the fifth power
    e = exponent(limit) // 5 + 1
    while (8 * power_of_two(e)) ** 5 > limit:
        e -= 1
    steps = (j * power_of_two(e) for j in range(15, 7, -1))
    return next(step for step in steps if step**5 <= limit)
