"""Bodies: a name, a shape and its motion, which give the trajectories of the vertices."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Final, Literal, final, overload

from exactpt.errors import InputError
from exactpt.extensions import extension
from exactpt.geometry.polygon import edges
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import (
    QQ,
    Rational,
    fraction,
    fractions,
    place,
    rational,
    rationals,
    shorten,
    show,
)
from exactpt.kernel.quotients import decimal_quotient
from exactpt.motion.course import Course, Piece
from exactpt.motion.local_time import Velocity
from exactpt.motion.motions import (
    REST,
    Motion,
    Pieces,
    Position,
    made,
)
from exactpt.motion.shape import Keyframe, Keyframes, Shape, VertexLike

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["Body", "is_text", "refuse_rounded"]

_PLAIN: Final = (int, float)
_SHARP: Final = QQ(0)


def is_text(name: object) -> bool:
    """Whether it is a nonempty string that can be encoded: without unpaired surrogates."""
    try:
        return isinstance(name, str) and bool(name.encode())
    except UnicodeEncodeError:
        return False


def refuse_rounded(bodies: Iterable[Body]) -> None:
    """Refuse rounded bodies where a tiling is kept, which would keep only their cores apart.

    Raises:
        InputError: if one of them is rounded.
    """
    for body in bodies:
        if body._radius:
            raise InputError(
                f"body {shorten(body.name)} has a radius: no tiling holds rounded bodies; "
                "their contacts are found by pairs (first_contact, collide)"
            )


@final
class Body:
    """A closed set that moves: a point, a segment, an open chain, or a simple polygon.

    With a radius it is rounded: all points within the radius of that set, its core. So a point
    becomes a disc, a segment a capsule.

    Vertices given as doubles are kept, and become rationals when these are needed.

    Args:
        name: unique in its scene.
        vertices: one (a point), two (a segment) or more; each a pair of numbers, or a
            mapping with polynomials "x" and "y" (missing: 0) for a vertex that moves in
            the body's rest frame. A numpy array of shape (n, 2) is accepted. The vertices
            may be in either orientation. A last one that repeats the first is dropped, if
            the body is closed.
        motion: the motion of the shape; at rest if not given.
        closed: False for an open chain.
        keyframes: instead of vertices, pairs (t, vertices) with increasing t; the shape is
            interpolated linearly between them, and rests before the first and after the
            last.
        radius: a number >= 0.

    Raises:
        InputError: if the arguments do not describe a body, or the motion jumps.
    """

    __slots__ = ("_course", "_radius", "_shape", "closed", "name")

    def __init__(
        self,
        name: str,
        vertices: Iterable[VertexLike] | None = None,
        motion: Motion = REST,
        *,
        closed: bool = True,
        keyframes: Keyframes | None = None,
        radius: Rational = 0,
    ) -> None:
        if not is_text(name):
            raise InputError(f"a body's name is a text that is not empty: {shorten(name)}")
        _check_motion(name, motion)
        if (vertices is None) == (keyframes is None):
            raise InputError(f"body {shorten(name)}: give either vertices or keyframes")
        self.name = name
        self.closed = closed
        self._radius = _read_radius(name, radius)
        try:
            self._shape = Shape(vertices, keyframes, ring=closed)
            self._course = Course(self._shape, motion)
        except InputError as error:
            raise InputError(f"body {shorten(name)}: {error}") from None

    @classmethod
    def from_shapely(
        cls,
        geometry: BaseGeometry,
        name: str,
        motion: Motion = REST,
        *,
        holes: Literal["refuse", "fill"] = "refuse",
        radius: Rational = 0,
    ) -> Body:
        """The body of a shapely point, line or polygon, with the exact values of its doubles.

        Args:
            geometry: a geometry of one part; `Scene.from_shapely` takes several.
            name: the name of the body.
            motion: the motion of the shape; at rest if not given.
            holes: "refuse" a polygon with holes, or "fill" them.
            radius: the radius of the body.

        Raises:
            InputError: if the geometry is not one part, or cannot be a body.
        """
        body: Body = extension("body from shapely")(geometry, name, motion, holes, radius)
        return body

    @classmethod
    def launched(
        cls,
        name: str,
        shape: Iterable[VertexLike],
        *,
        at: Rational,
        velocity: Sequence[Rational],
        closed: bool = True,
        radius: Rational = 0,
    ) -> Body:
        """The body that has a shape at a time, and moves with a constant velocity.

        >>> ball = Body.launched("ball", [(0, 0), (1, 0), (0, 1)], at=3, velocity=(2, 0))
        >>> ball.at(3)[0], ball.at(4)[0]
        ((Fraction(0, 1), Fraction(0, 1)), (Fraction(2, 1), Fraction(0, 1)))

        Args:
            name: the name of the body.
            shape: its vertices at that time.
            at: the time.
            velocity: the velocity (x, y).
            closed: False for an open chain.
            radius: the radius of the body.

        Raises:
            InputError: see `Body`.
        """
        vx, vy = rationals(velocity, 2, "a velocity has two coordinates")
        return cls(name, shape, Velocity(vx, vy, since=at), closed=closed, radius=radius)

    def with_motion(self, motion: Motion) -> Body:
        """A body of the same name and shape with another motion.

        Raises:
            InputError: if it is no motion, or jumps.
        """
        _check_motion(self.name, motion)
        other = Body.__new__(Body)
        other.name, other.closed = self.name, self.closed
        other._shape, other._radius = self._shape, self._radius
        try:
            other._course = Course(self._shape, motion)  # noqa: SLF001
        except InputError as error:
            raise InputError(f"body {shorten(self.name)}: {error}") from None
        return other

    def with_radius(self, radius: Rational) -> Body:
        """A body of the same name, shape and motion with another radius.

        Raises:
            InputError: if it is no number >= 0.
        """
        other = Body.__new__(Body)
        other.name, other.closed = self.name, self.closed
        other._shape, other._course = self._shape, self._course  # noqa: SLF001
        other._radius = _read_radius(self.name, radius)
        return other

    @property
    def motion(self) -> Motion:
        """The motion of the shape."""
        return self._course.motion

    @property
    def size(self) -> int:
        """The number of vertices."""
        return self._shape.size

    @property
    def radius(self) -> Fraction:
        """The body is all points within this distance of its core; 0 unless it is rounded."""
        return fraction(self._radius)

    @property
    def vertices(self) -> tuple[Position, ...]:
        """The positions in the body's rest frame; none if the body was given by keyframes."""
        return self._shape.positions

    @property
    def edges(self) -> list[tuple[int, int]]:
        """The edges as pairs of vertices; edge i starts at vertex i, and a point has none."""
        return edges(self.size, closed=self.closed)

    @property
    def has_interior(self) -> bool:
        """Whether the body is a polygon: not a point, a segment or an open chain."""
        return self.closed and self.size > 2

    @property
    def keyframes(self) -> tuple[Keyframe, ...]:
        """The keyframes, if the body was given by them."""
        return tuple(
            Keyframe(fraction(frame.t), tuple(map(place, frame.vertices)))
            for frame in self._shape.keyframes
        )

    @property
    def breakpoints(self) -> tuple[Fraction, ...]:
        """The rational times at which the formulas of the trajectories change, in order."""
        return fractions(self._breakpoints)

    @property
    def _breakpoints(self) -> tuple[QQ, ...]:
        return self._course.breakpoints

    def _piece_after(self, t: QQ) -> Piece:
        return self._course.after(t)

    def _at(self, t: QQ) -> list[tuple[QQ, QQ]]:
        return self._course.at(t)

    @overload
    def at(self, t: Rational) -> list[tuple[Fraction, Fraction]]: ...
    @overload
    def at(self, t: Rational | AlgebraicNumber, digits: int) -> list[tuple[Decimal, Decimal]]: ...
    def at(
        self, t: Rational | AlgebraicNumber, digits: int | None = None
    ) -> list[tuple[Fraction, Fraction]] | list[tuple[Decimal, Decimal]]:
        """The positions of the vertices at a time: exact, or correctly rounded decimals.

        Args:
            t: the time; without ``digits``, a rational one.
            digits: the number of significant digits of each coordinate.

        Raises:
            InputError: if the time is irrational and no digits are given.
        """
        if digits is None:
            return list(map(place, self._at(rational(t))))
        time = t if isinstance(t, AlgebraicNumber) else AlgebraicNumber(t)
        passed = [b for b in self._breakpoints if time.compare_rational(b) >= 0]
        tracks = self._piece_after(passed[-1] if passed else time._low).tracks
        return [
            (
                decimal_quotient(p.x, p.w, time, digits),
                decimal_quotient(p.y, p.w, time, digits),
            )
            for p in tracks
        ]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Body):
            return NotImplemented
        return (
            (self.name, self.closed, self.size) == (other.name, other.closed, other.size)
            and self._radius == other._radius
            and self.vertices == other.vertices
            and self._shape.keyframes == other._shape.keyframes
            and self.motion == other.motion
        )

    def __hash__(self) -> int:
        return hash((self.name, self.closed, self.size))

    def __reduce__(self) -> tuple[object, ...]:
        options: dict[str, object] = {"motion": self.motion, "closed": self.closed}
        if self._radius:
            options["radius"] = str(self._radius)
        return made, (Body, (self.name,), self._shape.given() | options)

    def __repr__(self) -> str:
        what = {1: "point", 2: "segment"}.get(self.size, "polygon" if self.closed else "chain")
        rounded = f", radius {show(self._radius)}" if self._radius else ""
        return f"<Body {self.name!r}: {what} of {self.size} vertices{rounded}>"


def _read_radius(name: str, radius: Rational) -> QQ:
    if type(radius) in _PLAIN and radius == 0:
        return _SHARP
    try:
        exact = rational(radius)
    except InputError as error:
        raise InputError(f"body {shorten(name)}: radius: {error}") from None
    if exact < 0:
        raise InputError(f"body {shorten(name)}: radius: it is negative: {show(exact)}")
    return exact


def _check_motion(name: str, motion: object) -> None:
    if not (isinstance(motion, Pieces) or hasattr(motion, "track")):
        raise InputError(f"body {shorten(name)}: not a motion: {shorten(motion)}")
