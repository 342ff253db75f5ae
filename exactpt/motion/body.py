"""Bodies: a name, a shape and its motion, which give the trajectories of the vertices."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Sequence
from decimal import Decimal
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Final, Literal, NamedTuple, final, overload

from exactpt.errors import InputError
from exactpt.extensions import extension
from exactpt.geometry.polygon import edges
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import ask
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
from exactpt.motion.local_time import Velocity
from exactpt.motion.motions import (
    REST,
    Motion,
    Pieces,
    Position,
    SimpleMotion,
    Translation,
    made,
)
from exactpt.motion.shape import Keyframe, Keyframes, Shape, VertexLike
from exactpt.motion.track import Track

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["Body", "BodyPiece", "is_text", "refuse_rounded"]

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


class BodyPiece(NamedTuple):
    """The motion of a body up to a time.

    Attributes:
        until: the last time of the piece; None if it has no end.
        tracks: the trajectory of each vertex, in the order of the scene.
    """

    until: QQ | None
    tracks: tuple[Track, ...]


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

    __slots__ = (
        "_breakpoints",
        "_last",
        "_pieces",
        "_radius",
        "_shape",
        "closed",
        "motion",
        "name",
    )

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
        except InputError as error:
            raise InputError(f"body {shorten(name)}: {error}") from None
        self._set_motion(motion)

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
        other._set_motion(motion)  # noqa: SLF001
        return other

    def _set_motion(self, motion: Motion) -> None:
        self.motion = motion
        ends = {frame.t for frame in self._shape.keyframes}
        if isinstance(motion, Pieces):
            ends.update(motion._until)
        self._breakpoints: tuple[QQ, ...] = tuple(sorted(ends))
        self._pieces: dict[QQ | None, BodyPiece] = {}
        self._last: tuple[QQ, list[tuple[QQ, QQ]]] | None = None
        if isinstance(motion, Pieces):
            self._check_continuity(motion)

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

    def _piece_after(self, t: QQ) -> BodyPiece:
        """The piece of motion just after a rational time."""
        ended = bisect_right(self._breakpoints, t)
        end = self._breakpoints[ended] if ended < len(self._breakpoints) else None
        if end not in self._pieces:
            tracks = self._tracks(self._shape.after(t), self._motion_after(t))
            self._pieces[end] = BodyPiece(end, tracks)
        return self._pieces[end]

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

    def _at(self, t: QQ) -> list[tuple[QQ, QQ]]:
        """The positions at a time; those at the last time asked for are cached."""
        last = self._last  # one read: other threads may share the body
        if last is None or last[0] != t:
            self._last = last = t, [track._at(t) for track in self._piece_after(t).tracks]
        return last[1][:]

    def _tracks(self, shape: Sequence[Position], motion: SimpleMotion) -> tuple[Track, ...]:
        tracks = []
        for position in shape:
            ask()
            tracks.append(motion.track(position))
        return tuple(tracks)

    def _motion_after(self, t: QQ) -> SimpleMotion:
        if not isinstance(self.motion, Pieces):
            return self.motion
        return self.motion.motions[bisect_right(self.motion._until, t)]

    def _check_continuity(self, motion: Pieces) -> None:
        for t, (before, after) in zip(motion._until, pairwise(motion.motions), strict=True):
            if (
                isinstance(before, Translation)
                and isinstance(after, Translation)
                and before._at(t) == after._at(t)
            ):
                continue
            shape = self._shape.after(t)
            for i, (a, b) in enumerate(
                zip(self._tracks(shape, before), self._tracks(shape, after), strict=True)
            ):
                if a._at(t) != b._at(t):
                    raise InputError(
                        f"body {shorten(self.name)}: vertex {i} jumps at t = {show(t)} "
                        f"from {show(*a._at(t))} to {show(*b._at(t))}"
                    )

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
