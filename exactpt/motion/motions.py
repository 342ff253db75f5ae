"""Motions: how a body's rest shape is carried through time.

A motion maps the rest position of a vertex, itself a polynomial in t if the body
deforms, to the vertex's trajectory. Time is the scene's time, not time since a piece began.
"""

from __future__ import annotations

from abc import abstractmethod
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Final, Protocol, TypeAlias, TypeVar, final

from exactpt.brief import call_in_brief
from exactpt.errors import InputError
from exactpt.kernel.numbers import (
    QQ,
    Rational,
    fractions,
    place,
    rational,
    rationals,
    shorten,
    show,
)
from exactpt.kernel.polynomial import ZERO, Polynomial, polynomial
from exactpt.motion.track import Track, track, translated

if TYPE_CHECKING:
    from exactpt.motion.turn import Turn

T = TypeVar("T")

Coefficients: TypeAlias = "Polynomial | Rational | Iterable[Rational]"
"""A polynomial as a caller may write it: coefficients (constant first), or a number."""

Position: TypeAlias = tuple[Polynomial, Polynomial]
"""The coordinates of a vertex in its body's rest frame; constants unless the body deforms."""


def made(kind: Callable[..., T], values: tuple[object, ...], options: dict[str, object]) -> T:
    """Call a constructor with its arguments: what pickles contain, free of gmpy2 types."""
    return kind(*values, **options)


class _Given:
    """Equality, hashing and pickling of motions by the arguments of their constructors."""

    __slots__ = ()

    @abstractmethod
    def _given(self) -> tuple[tuple[object, ...], dict[str, object]]:
        """Return the positional and the keyword arguments of the constructor."""

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _Given):
            return NotImplemented
        return type(self) is type(other) and self._given() == other._given()

    def __hash__(self) -> int:
        values, options = self._given()
        return hash((type(self), values, tuple(options.values())))

    def __reduce__(self) -> tuple[object, ...]:
        return made, (type(self), *self._given())


def _sum(f: Polynomial, g: Polynomial) -> tuple[QQ, ...]:
    """Return the coefficients of f + g, without any object besides if f is a constant."""
    a, b = f.exact_coefficients, g.exact_coefficients
    if not a:
        return b
    if len(a) > 1 or len(b) < 2:
        return (f + g).exact_coefficients
    return (a[0] + b[0], *b[1:])


class SimpleMotion(Protocol):
    """A motion given by one formula for all time."""

    def track(self, position: Position) -> Track:
        """Return the trajectory of the vertex with this position in the rest frame."""
        ...


_UNTURNED: Final = QQ(1), QQ(0)


@final
class Translation(_Given):
    """A translation by (x(t), y(t)), added to every vertex.

    Args:
        x: a number (a constant), or a list of coefficients, constant first.
        y: likewise.

    Raises:
        InputError: if they are neither; for a single pair ``(x, y)`` too, which might be meant as
            a translation by x and y but would be the polynomial x + y t.
    """

    __slots__ = ("x", "y")

    def __init__(self, x: Coefficients = ZERO, y: Coefficients | None = None) -> None:
        if y is None:
            if isinstance(x, tuple) and len(x) == 2:
                raise InputError(
                    f"Translation({shorten(x)}): to shift by a pair write Translation(*pair); "
                    f"for the coefficients of x only, a list"
                )
            y = ZERO
        self.x = polynomial(x)
        self.y = polynomial(y)

    def track(self, position: Position) -> Track:
        """Return the trajectory of the vertex with this position in the rest frame."""
        x, y = position
        return translated(_sum(x, self.x), _sum(y, self.y))

    def exact_at(self, t: QQ) -> tuple[QQ, QQ]:
        """Return the displacement at a time."""
        return self.x.exact_at(t), self.y.exact_at(t)

    def exact_map_at(self, t: QQ) -> tuple[QQ, QQ, QQ, QQ]:
        """As `Rigid._map_at`."""
        return *_UNTURNED, self.x.exact_at(t), self.y.exact_at(t)

    def _given(self) -> tuple[tuple[object, ...], dict[str, object]]:
        return (self.x, self.y), {}

    def __repr__(self) -> str:
        return call_in_brief("Translation", x=self.x, y=self.y)


REST: Final = Translation()


@final
class Rigid(_Given):
    """A rotation about ``pivot`` by a(t), where tan(a / 2) = half_turn(t), then a translation.

    With h = half_turn, cos a = (1 - h^2) / (1 + h^2) and sin a = 2 h / (1 + h^2): the
    coordinates are rational functions with the positive denominator 1 + h^2.

    Args:
        half_turn: the tangent of half the angle, a polynomial in the time.
        pivot: the centre of rotation.
        x: a translation, as in `Translation`, applied last.
        y: likewise.
        orientation: the cosine and the sine, rational, of a constant angle by which the body is
            turned about the pivot first; so pieces can begin at any angle, and pass 180 degrees.

    Raises:
        InputError: if an argument is invalid, such as an orientation that is not a unit vector.
    """

    __slots__ = ("_turn", "exact_orientation", "exact_pivot", "half_turn", "x", "y")

    def __init__(
        self,
        half_turn: Coefficients,
        *,
        pivot: Sequence[Rational] = (0, 0),
        x: Coefficients = ZERO,
        y: Coefficients = ZERO,
        orientation: Sequence[Rational] = (1, 0),
    ) -> None:
        px, py = rationals(pivot, 2, "a pivot has two coordinates")
        self.exact_pivot: tuple[QQ, QQ] = (px, py)
        c, s = rationals(orientation, 2, "an orientation is a cosine and a sine")
        if c * c + s * s != 1:
            raise InputError(f"an orientation is a unit vector: {show(c, s)}")
        self.exact_orientation: tuple[QQ, QQ] = (c, s)
        self.half_turn = polynomial(half_turn)
        self.x = polynomial(x)
        self.y = polynomial(y)
        self._turn: Turn | None = None

    @property
    def pivot(self) -> tuple[Fraction, Fraction]:
        """The centre of rotation."""
        return place(self.exact_pivot)

    @property
    def orientation(self) -> tuple[Fraction, Fraction]:
        """The cosine and the sine of the angle by which the body is turned first."""
        return place(self.exact_orientation)

    def track(self, position: Position) -> Track:
        """Return the trajectory of the vertex with this position in the rest frame."""
        if self._turn is None:
            from exactpt.motion.turn import turn_of

            path = (
                Polynomial([self.exact_pivot[0]]) + self.x,
                Polynomial([self.exact_pivot[1]]) + self.y,
            )
            self._turn = turn_of(self.half_turn, self.exact_pivot, path, self.exact_orientation)
        return self._turn.track(position)

    def exact_map_at(self, t: QQ) -> tuple[QQ, QQ, QQ, QQ]:
        """Return the map at a time: cosine and sine, then where it takes the origin."""
        (c, s), h, (px, py) = self.exact_orientation, self.half_turn.exact_at(t), self.exact_pivot
        w = 1 + h * h
        cosine, sine = (c * (2 - w) - 2 * s * h) / w, (s * (2 - w) + 2 * c * h) / w
        x, y = px - cosine * px + sine * py, py - sine * px - cosine * py
        return cosine, sine, x + self.x.exact_at(t), y + self.y.exact_at(t)

    def _given(self) -> tuple[tuple[object, ...], dict[str, object]]:
        pivot = (str(self.exact_pivot[0]), str(self.exact_pivot[1]))
        given: dict[str, object] = {"pivot": pivot, "x": self.x, "y": self.y}
        if self.exact_orientation[0] != 1:
            given["orientation"] = (str(self.exact_orientation[0]), str(self.exact_orientation[1]))
        return (self.half_turn,), given

    def __repr__(self) -> str:
        (half_turn,), given = self._given()
        return call_in_brief("Rigid", half_turn, **given)


@final
class Affine(_Given):
    """The map (u, v) -> M(t) (u, v) + (x(t), y(t)), with a 2 x 2 matrix of polynomials."""

    __slots__ = ("matrix", "x", "y")

    def __init__(
        self,
        matrix: Sequence[Sequence[Coefficients]],
        *,
        x: Coefficients = ZERO,
        y: Coefficients = ZERO,
    ) -> None:
        try:
            first, second = matrix
            (a, b), (c, d) = first, second
        except (TypeError, ValueError):
            raise InputError(f"an affine motion has a 2 x 2 matrix: {shorten(matrix)}") from None
        if isinstance(first, str) or isinstance(second, str):  # "10" is no row 1, 0
            raise InputError(f"a row of a matrix is a list: {shorten(matrix)}")
        self.matrix = ((polynomial(a), polynomial(b)), (polynomial(c), polynomial(d)))
        self.x = polynomial(x)
        self.y = polynomial(y)

    def track(self, position: Position) -> Track:
        """Return the trajectory of the vertex with this position in the rest frame."""
        (a, b), (c, d) = self.matrix
        u, v = position
        return track(a * u + b * v + self.x, c * u + d * v + self.y, None, None)

    def _given(self) -> tuple[tuple[object, ...], dict[str, object]]:
        return (self.matrix,), {"x": self.x, "y": self.y}

    def __repr__(self) -> str:
        return call_in_brief("Affine", self.matrix, x=self.x, y=self.y)


class Piecewise(_Given):
    """A motion by one formula after the other: finitely many (`Pieces`), or without end (`Spin`).

    There may be no first and no last piece, so whoever needs pieces asks for those of a span. A
    piece is a function of the motion and of its place among the pieces: it is the same whatever
    was asked before.
    """

    __slots__ = ()

    @property
    @abstractmethod
    def exact_formulas(self) -> Sequence[SimpleMotion]:
        """Formulas that stand for those of all pieces, which need not be made for it.

        Each piece is of the same kind as one of them: of its class, about its pivot, and with
        polynomials of its degrees.
        """

    @property
    @abstractmethod
    def exact_breakpoints(self) -> Sequence[QQ]:
        """The times at which formulas change, in order.

        Raises:
            InputError: if there is no end of them.
        """

    @abstractmethod
    def exact_breakpoints_between(self, start: QQ, end: QQ) -> Sequence[QQ]:
        """Return the times at which formulas change, between two times, in order.

        Raises:
            InputError: if there are too many.
        """

    @abstractmethod
    def exact_last_breakpoint_before(self, t: QQ) -> QQ | None:
        """Return the last time before another one at which formulas change; None if there is none.

        It is found without those before it: there may be no first one.
        """

    @abstractmethod
    def exact_is_breakpoint(self, t: QQ) -> bool:
        """Return True if formulas change at a time."""

    @abstractmethod
    def exact_formula_after(self, t: QQ) -> tuple[SimpleMotion, QQ | None]:
        """Return the formula that holds just after a time, and its end; None if it has none."""

    def exact_pieces_during(self, start: QQ, end: QQ) -> list[tuple[SimpleMotion, QQ | None]]:
        """Return the formulas that hold in a span, each with its end.

        The first one is valid just after the start; the last one is valid up to the end.
        """
        pieces = [self.exact_formula_after(start)]
        pieces += [self.exact_formula_after(t) for t in self.exact_breakpoints_between(start, end)]
        return pieces

    def exact_assumed_errors(self) -> tuple[QQ, QQ]:
        """Return the errors of the place and of the angle that nothing proves of a motion."""
        return QQ(0), QQ(0)


class Pieces(Piecewise):
    """A sequence of motions: each holds until its time, the last for all times.

    At the end of a piece, every vertex must have the same position under both; the body,
    which knows the vertices, checks this.
    """

    __slots__ = ("exact_until", "motions")

    def __init__(self, pieces: Sequence[tuple[Rational | None, SimpleMotion]]) -> None:
        if not pieces:
            raise InputError("a piecewise motion has at least one piece")
        if pieces[-1][0] is not None:
            raise InputError(f"the last piece has no end: until = {shorten(pieces[-1][0])}")
        ends: list[QQ] = []
        for end, _ in pieces[:-1]:
            if end is None:
                raise InputError("only the last piece may have no end")
            ends.append(rational(end))
        for _, motion in pieces:
            if not hasattr(motion, "track"):
                raise InputError(f"not a motion by one formula: {shorten(motion)}")
        for before, after in pairwise(ends):
            if before >= after:
                raise InputError(
                    f"pieces end in increasing order: {show(before)}, then {show(after)}"
                )
        self.exact_until: tuple[QQ, ...] = tuple(ends)
        self.motions: tuple[SimpleMotion, ...] = tuple(motion for _, motion in pieces)

    @property
    def until(self) -> tuple[Fraction, ...]:
        """The end times of all motions but the last."""
        return fractions(self.exact_until)

    @property
    def pieces(self) -> tuple[tuple[Fraction | None, SimpleMotion], ...]:
        """The motions with their end times, None for the last: the argument of `Pieces`."""
        return tuple(zip([*self.until, None], self.motions, strict=True))

    @property
    def exact_formulas(self) -> Sequence[SimpleMotion]:
        """See `Piecewise.exact_formulas`: all of them."""
        return self.motions

    @property
    def exact_breakpoints(self) -> Sequence[QQ]:
        """See `Piecewise.exact_breakpoints`."""
        return self.exact_until

    def exact_breakpoints_between(self, start: QQ, end: QQ) -> Sequence[QQ]:
        """See `Piecewise.exact_breakpoints_between`."""
        ends = self.exact_until
        return ends[bisect_right(ends, start) : bisect_left(ends, end)]

    def exact_last_breakpoint_before(self, t: QQ) -> QQ | None:
        """See `Piecewise.exact_last_breakpoint_before`."""
        ended = bisect_left(self.exact_until, t)
        return self.exact_until[ended - 1] if ended else None

    def exact_is_breakpoint(self, t: QQ) -> bool:
        """See `Piecewise.exact_is_breakpoint`."""
        return t in self.exact_until

    def exact_formula_after(self, t: QQ) -> tuple[SimpleMotion, QQ | None]:
        """See `Piecewise.exact_formula_after`."""
        ended = bisect_right(self.exact_until, t)
        is_last = ended == len(self.exact_until)
        return self.motions[ended], None if is_last else self.exact_until[ended]

    def _given(self) -> tuple[tuple[object, ...], dict[str, object]]:
        ends = [*map(str, self.exact_until), None]
        return (tuple(zip(ends, self.motions, strict=True)),), {}

    def __repr__(self) -> str:
        ends = [*map(str, self.exact_until), None]
        return call_in_brief("Pieces", list(zip(ends, self.motions, strict=True)))


def is_affine(motion: Motion) -> bool:
    """Return True if a motion is at each time an affine map of the plane, as all of exactpt's are.

    A motion of a caller's own class may map vertices in any way.
    """
    return all(isinstance(formula, (Translation, Rigid, Affine)) for formula in formulas_of(motion))


def formulas_of(motion: Motion) -> Sequence[SimpleMotion]:
    """Return a motion by one formula, or the formulas that stand for all pieces of another one."""
    return motion.exact_formulas if isinstance(motion, Piecewise) else (motion,)


Motion: TypeAlias = "SimpleMotion | Piecewise"
"""The course of a body: the trajectories of its vertices, piece by piece."""
