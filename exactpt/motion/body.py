"""Bodies: a name, a shape and its motion, which give the trajectories of the vertices."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Final, Literal, final, overload

from exactpt.brief import counted, in_brief
from exactpt.errors import InputError
from exactpt.extensions import extension
from exactpt.geometry.simple import edges
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.approximation import decimal_quotient
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
from exactpt.motion.course import Course, NearPositions, Piece
from exactpt.motion.motions import (
    REST,
    Motion,
    Piecewise,
    Position,
    is_affine,
    made,
)
from exactpt.motion.shape import Keyframe, Keyframes, Shape, VertexLike, listed
from exactpt.motion.stated_errors import NONE_STATED, StatedErrors, read_stated_errors

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from exactpt.motion.rings import Outline, PartLike, Parts
    from exactpt.motion.track import Track

_PLAIN: Final = (int, float)
_SHARP: Final = QQ(0)
_NO_HOLES: Final = ()
_NO_ERROR: Final = 0
_SAME_SHAPE: Final = (0, 0)


def _has_texts(properties: object) -> bool:
    return isinstance(properties, Mapping) and all(isinstance(key, str) for key in properties)


def is_text(name: object) -> bool:
    """Return True if it is a nonempty string that can be encoded: without unpaired surrogates."""
    try:
        return isinstance(name, str) and bool(name.encode())
    except UnicodeEncodeError:
        return False


@final
class Body:
    """A closed set that moves: a point, a segment, an open chain, or a simple polygon.

    A polygon may have holes, and a body several parts that move together: then vertices and
    edges are numbered through its rings, part by part, each outline before its holes. A hole is
    open: a body may be in it, and touches at its edges. Rings may touch each other in single
    points, if the body keeps its shape and the inside of each part is connected: this is no
    contact.

    >>> notched = Body("b", [(0, 0), (8, 0), (8, 8), (0, 8)], holes=[[(4, 0), (5, 2), (3, 2)]])
    >>> notched.rings, notched.edges[4]
    ((range(0, 4), range(4, 7)), (4, 5))

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
        holes: the outlines of holes in the polygon, inside of it: disjoint, or touching it and
            each other in single points. Either orientation is accepted.
        parts: instead of vertices, the parts of the body, disjoint or touching each other in
            single points: outlines, or mappings with "vertices" and "holes".
        radius: a number >= 0.
        place_error: the largest distance >= 0, at every time, by which the true body is moved from
            where it is modelled. Questions about the modelled bodies do not use this error, nor
            the next ones (docs/howto/motions.md#stated-errors).
        angle_error: the largest angle >= 0, in radians, by which it is turned.
        shape_error: two distances >= 0: the largest one of a point of the true shape from the
            modelled shape, and of a point of the modelled shape from the true one.
        pivot: the reference point of the angle error, in the rest frame. Needed with an angle error
            above 0, if the motion has no pivot of its own; not allowed otherwise.
        properties: further data, such as those of a GeoJSON feature, see `properties`.

    Raises:
        InputError: if the arguments do not describe a body, or the motion jumps.
    """

    __slots__ = (
        "_course",
        "_known_touches",
        "_parts",
        "_properties",
        "closed",
        "exact_errors",
        "exact_radius",
        "exact_shape",
        "name",
    )  # fmt: skip

    def __init__(
        self,
        name: str,
        vertices: Iterable[VertexLike] | None = None,
        motion: Motion = REST,
        *,
        closed: bool = True,
        keyframes: Keyframes | None = None,
        holes: Iterable[Outline] = _NO_HOLES,
        parts: Iterable[PartLike] | None = None,
        radius: Rational = 0,
        place_error: Rational = _NO_ERROR,
        angle_error: Rational = _NO_ERROR,
        shape_error: Sequence[Rational] = _SAME_SHAPE,
        pivot: Sequence[Rational] | None = None,
        properties: Mapping[str, object] | None = None,
    ) -> None:
        if not is_text(name):
            raise InputError(f"a body's name is a text that is not empty: {shorten(name)}")
        _check_motion(name, motion)
        plain = parts is None and holes is _NO_HOLES
        if not plain or (vertices is None) == (keyframes is None):
            _check_sorts(name, vertices, keyframes, parts)
        self.name = name
        self.closed = closed
        self.exact_radius = _read_radius(name, radius)
        self._parts: Parts | None = None
        self._known_touches: tuple[tuple[QQ, QQ], ...] | None = None
        if properties is not None and not _has_texts(properties):
            raise InputError(f"body {shorten(name)}: properties: not a mapping of texts to data")
        self._properties = dict(properties) if properties else None
        try:
            if plain:
                self.exact_shape = Shape(vertices, keyframes, ring=closed)
            else:
                self._read_rings(vertices, keyframes, listed("holes", holes), parts)
            self._course = Course(self.exact_shape, motion)
            self.exact_errors = NONE_STATED
            is_unstated = (  # by identity, which takes no time: most bodies state nothing
                place_error is _NO_ERROR
                and angle_error is _NO_ERROR
                and shape_error is _SAME_SHAPE
                and pivot is None
            )
            if not is_unstated:
                self.exact_errors = read_stated_errors(
                    motion, place_error, angle_error, shape_error, pivot
                )
        except InputError as error:
            raise InputError(f"body {shorten(name)}: {error}") from None

    def _read_rings(
        self,
        vertices: Iterable[VertexLike] | None,
        keyframes: Keyframes | None,
        holes: Sequence[Outline],
        parts: Iterable[PartLike] | None,
    ) -> None:
        if parts is None and not holes:
            self.exact_shape = Shape(vertices, keyframes, ring=self.closed)
            return
        if not self.closed:
            raise InputError("an open chain has neither holes nor parts")
        if holes and vertices is None:
            raise InputError("holes are for a body of vertices; a part has holes of its own")
        from exactpt.motion.rings import read_rings

        self.exact_shape, self._parts = read_rings(vertices, holes, parts)

    @classmethod
    def from_shapely(
        cls,
        geometry: BaseGeometry,
        name: str,
        motion: Motion = REST,
        *,
        holes: Literal["keep", "refuse", "fill"] = "keep",
        radius: Rational = 0,
    ) -> Body:
        """Return the body of a shapely point, line or polygon, with its doubles exactly.

        Args:
            geometry: a geometry of one part, or a MultiPolygon; `Scene.from_shapely` takes all.
            name: the name of the body.
            motion: the motion of the shape; at rest if not given.
            holes: "keep" the holes of a polygon, "refuse" it, or "fill" them.
            radius: the radius of the body.

        Raises:
            InputError: if the geometry cannot be a body.
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
        """Return the body that has a shape at a time, and moves with a constant velocity.

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
        from exactpt.motion.local_time import Velocity

        vx, vy = rationals(velocity, 2, "a velocity has two coordinates")
        return cls(name, shape, Velocity(vx, vy, since=at), closed=closed, radius=radius)

    def with_motion(self, motion: Motion) -> Body:
        """Return a body of the same name and shape with another motion.

        An angle error is about the same reference point as before.

        Raises:
            InputError: if it is not a motion, or jumps; or if the body has an angle error, and the
                motion turns about another point than the reference point.
        """
        _check_motion(self.name, motion)
        other = self._copied()
        try:
            other._course = Course(self.exact_shape, motion)  # noqa: SLF001
            other.exact_errors = self.exact_errors.with_motion(self.motion, motion)
        except InputError as error:
            raise InputError(f"body {shorten(self.name)}: {error}") from None
        return other

    def halted(self, t: Rational) -> Body:
        """Return a body of the same name and kind at rest, as this one is at a rational time.

        It is where the rational pieces of its motion are, without the error by which these are
        fitted to a path or a spin. Errors that are stated of the body stay, and what is assumed of
        its motion, such as by `PosePath.with_place_error`, becomes an error of the body: it is not
        known better because it stands.

        >>> from exactpt import PosePath
        >>> path = PosePath([0, 4], [([0, 1], 0, 0)]).with_place_error("1/10")
        >>> halted = Body("probe", [(0, 0)], path).halted(3)
        >>> halted.at(3), halted.place_error
        ([(Fraction(3, 1), Fraction(0, 1))], Fraction(1, 10))
        """
        now = rational(t)
        points = self.exact_at(now)
        if self._parts is None:
            body = Body(self.name, points, closed=self.closed, radius=str(self.exact_radius))
        else:
            from exactpt.motion.rings import parts_given

            given = parts_given(self._parts, points)
            body = Body(self.name, radius=str(self.exact_radius), **given)  # type: ignore[arg-type]
        body._properties = self._properties
        assumed = self.exact_errors.plus_assumed_of(self.motion)
        body.exact_errors = assumed.halted(self.motion, self.exact_piece_after(now).motion, now)
        return body

    def with_radius(self, radius: Rational) -> Body:
        """Return a body of the same name, shape and motion with another radius.

        Raises:
            InputError: if it is not a number >= 0.
        """
        other = self._copied()
        other.exact_radius = _read_radius(self.name, radius)
        return other

    def with_errors(
        self,
        *,
        place_error: Rational = _NO_ERROR,
        angle_error: Rational = _NO_ERROR,
        shape_error: Sequence[Rational] = _SAME_SHAPE,
        pivot: Sequence[Rational] | None = None,
    ) -> Body:
        """Return a body of the same name, shape and motion with these stated errors alone.

        >>> box = Body("box", [(0, 0), (2, 0), (2, 1), (0, 1)])
        >>> measured = box.with_errors(place_error="1/100", angle_error="1/1000", pivot=(1, "1/2"))
        >>> measured.place_error, measured.reference_point
        (Fraction(1, 100), (Fraction(1, 1), Fraction(1, 2)))

        Args:
            place_error: see `Body`.
            angle_error: see `Body`.
            shape_error: see `Body`.
            pivot: see `Body`.

        Raises:
            InputError: see `Body`.
        """
        try:
            stated = read_stated_errors(self.motion, place_error, angle_error, shape_error, pivot)
        except InputError as error:
            raise InputError(f"body {shorten(self.name)}: {error}") from None
        return self.exact_with_errors(stated)

    def exact_with_errors(self, errors: StatedErrors) -> Body:
        """Return a body of the same name, shape and motion with errors that were read before."""
        other = self._copied()
        other.exact_errors = errors
        return other

    def _copied(self) -> Body:
        other = Body.__new__(Body)
        for name in Body.__slots__:
            setattr(other, name, getattr(self, name))
        return other

    @property
    def properties(self) -> dict[str, object]:
        """A copy of the data that come with the body and its copies of another motion or radius.

        `read_shapes` keeps those of GeoJSON and MF-JSON features, and `write_shapes` writes them.
        Scene files keep those that are JSON. They have no part in equality.
        """
        return dict(self._properties or {})

    @property
    def motion(self) -> Motion:
        """The motion of the shape."""
        return self._course.motion

    @property
    def size(self) -> int:
        """The number of vertices."""
        return self.exact_shape.size

    @property
    def radius(self) -> Fraction:
        """The body is all points within this distance of its core; 0 unless it is rounded."""
        return fraction(self.exact_radius)

    @property
    def place_error(self) -> Fraction:
        """The largest distance by which the true body is moved from the modelled place; stated."""
        return fraction(self.exact_errors.place)

    @property
    def angle_error(self) -> Fraction:
        """The largest angle, in radians, by which the true body is turned; stated."""
        return fraction(self.exact_errors.angle)

    @property
    def shape_error(self) -> tuple[Fraction, Fraction]:
        """The largest distances between the true shape and the modelled one; stated.

        That of a point of the true shape from the modelled one, then that of a point of the
        modelled shape from the true one.
        """
        return place(self.exact_errors.shape)

    @property
    def pivot(self) -> tuple[Fraction, Fraction] | None:
        """The reference point as it was given; None if the motion has it. See `reference_point`."""
        return None if self.exact_errors.pivot is None else place(self.exact_errors.pivot)

    @property
    def reference_point(self) -> tuple[Fraction, Fraction] | None:
        """The point of the rest frame about which the angle error turns the body.

        It is the pivot of the motion, or else of the body; None without an angle error.
        """
        point = self.exact_errors.reference_point(self.motion)
        return None if point is None else place(point)

    @property
    def vertices(self) -> tuple[Position, ...]:
        """The positions in the body's rest frame; none if the body was given by keyframes."""
        return self.exact_shape.positions

    @property
    def edges(self) -> list[tuple[int, int]]:
        """The edges as pairs of vertices; edge i starts at vertex i, and a point has none."""
        if self._parts is not None:
            from exactpt.motion.rings import ring_edges

            return ring_edges(self._parts)
        return edges(self.size, closed=self.closed)

    def end_of_edge(self, edge: int) -> int:
        """Return the vertex at which an edge ends."""
        if self._parts is not None:
            return next(r.start + (edge + 1 - r.start) % len(r) for r in self.rings if edge in r)
        return edge + 1 if edge + 1 < self.size else 0

    @property
    def parts(self) -> Parts:
        """For each part, the numbers of the vertices of its rings, the outline first."""
        return ((range(self.size),),) if self._parts is None else self._parts

    @property
    def rings(self) -> tuple[range, ...]:
        """The numbers of the vertices of each ring."""
        if self._parts is None:
            return (range(self.size),)
        return tuple(ring for rings in self.parts for ring in rings)

    @property
    def has_rings(self) -> bool:
        """True if the body has more than one ring: holes, or several parts."""
        return self._parts is not None

    @property
    def exact_ring_touches(self) -> tuple[tuple[QQ, QQ], ...]:
        """The points in which rings touch, in the rest frame; none if the rings are disjoint.

        A scene holds a body with such points only if the body keeps its shape
        (`exactpt.scene.valid`): its rings touch there at all times, and nowhere else. This is no
        contact. Rings of a body with vertices that deform are disjoint at the start.
        """
        if self._parts is None:
            return ()
        if self._known_touches is None:
            from exactpt.motion.rings import rest_touches

            self._known_touches = rest_touches(self.vertices, self.edges, self.rings)
        return self._known_touches if is_affine(self.motion) else ()

    @property
    def has_interior(self) -> bool:
        """True if the body is a polygon: not a point, a segment or an open chain."""
        return self.closed and self.size > 2

    @property
    def keyframes(self) -> tuple[Keyframe, ...]:
        """The keyframes, if the body was given by them."""
        return tuple(
            Keyframe(fraction(frame.t), tuple(map(place, frame.vertices)))
            for frame in self.exact_shape.keyframes
        )

    @property
    def breakpoints(self) -> tuple[Fraction, ...]:
        """The rational times at which the formulas of the trajectories change, in order.

        Raises:
            InputError: if there is no end of them, as of a `Spin`; see `breakpoints_between`.
        """
        return fractions(self.exact_breakpoints)

    def breakpoints_between(self, start: Rational, end: Rational) -> tuple[Fraction, ...]:
        """Return the times at which the formulas of the trajectories change, in order.

        >>> from exactpt import Spin
        >>> Body("blade", [(0, 0), (1, 0)], Spin(1)).breakpoints_between(0, 1)
        (Fraction(1, 4), Fraction(1, 2), Fraction(3, 4))

        Args:
            start: a time; a change at it is not included.
            end: a later time; likewise.

        Raises:
            InputError: if there are more than 100,000 of them.
        """
        return fractions(self.exact_breakpoints_between(rational(start), rational(end)))

    @property
    def exact_breakpoints(self) -> tuple[QQ, ...]:
        """`breakpoints` as rationals of GMP."""
        return self._course.breakpoints

    def exact_breakpoints_between(self, start: QQ, end: QQ) -> tuple[QQ, ...]:
        """`breakpoints_between` as rationals of GMP."""
        return self._course.breakpoints_between(start, end)

    def exact_is_breakpoint(self, t: QQ) -> bool:
        """Return True if the formulas of the trajectories change at a time."""
        return self._course.is_breakpoint(t)

    def exact_last_breakpoint(
        self, time: AlgebraicNumber, start: QQ, *, before: bool = False
    ) -> QQ:
        """Return the last time from a start to another time at which formulas change, or the start.

        Args:
            time: the time, at the start or later.
            start: the start.
            before: True for the last change before the time, False if one at it counts, too. Of
                the start itself it is the last change before that, if there is one: a body has
                moved before it, too.
        """
        course, high = self._course, time.exact_high
        change = high if course.is_breakpoint(high) else course.last_breakpoint_before(high)
        least = 1 if before else 0
        while change is not None and time.compare_rational(change) < least:
            change = course.last_breakpoint_before(change)
        if change is None:
            return start
        is_before_start = before and time.compare_rational(start) == 0
        return change if is_before_start else max(change, start)

    def exact_piece_after(self, t: QQ) -> Piece:
        """Return the piece of the motion that is valid from a time on."""
        return self._course.after(t)

    def exact_at(self, t: QQ) -> list[tuple[QQ, QQ]]:
        """Return the places of the vertices at a time as rationals of GMP."""
        return self._course.at(t)

    def exact_place_at(self, vertex: int, t: QQ) -> tuple[QQ, QQ]:
        """Return the place of a vertex at a time; that of a few costs less than all of them."""
        return self._course.place(vertex, t)

    def near_places_at(self, t: QQ, origin: tuple[QQ, QQ]) -> NearPositions:
        """Return the places of the vertices at a time in doubles, relative to an origin."""
        return self._course.after(t).near_positions(t, origin)

    @overload
    def at(self, t: Rational) -> list[tuple[Fraction, Fraction]]: ...
    @overload
    def at(self, t: Rational | AlgebraicNumber, digits: int) -> list[tuple[Decimal, Decimal]]: ...
    def at(
        self, t: Rational | AlgebraicNumber, digits: int | None = None
    ) -> list[tuple[Fraction, Fraction]] | list[tuple[Decimal, Decimal]]:
        """Return the positions of the vertices at a time: exact, or correctly rounded decimals.

        Args:
            t: the time; without ``digits``, a rational one.
            digits: the number of significant digits of each coordinate.

        Raises:
            InputError: if the time is irrational and no digits are given.
        """
        if digits is None:
            return list(map(place, self.exact_at(rational(t))))
        time = t if isinstance(t, AlgebraicNumber) else AlgebraicNumber(t)
        return [
            (
                decimal_quotient(p.x, p.w, time, digits),
                decimal_quotient(p.y, p.w, time, digits),
            )
            for p in self.exact_tracks_just_after(time)
        ]

    def exact_tracks_just_after(self, time: AlgebraicNumber) -> tuple[Track, ...]:
        """Return the tracks of the vertices on a short interval that begins at a time."""
        return self.exact_piece_after(self.exact_last_breakpoint(time, time.exact_low)).tracks

    def velocity_at(self, t: Rational) -> list[tuple[Fraction, Fraction]]:
        """Return the velocities of the vertices just after a rational time, exactly."""
        now = rational(t)
        return [place(track.velocity(now)) for track in self.exact_piece_after(now).tracks]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Body):
            return NotImplemented
        return (
            (self.name, self.closed, self.size) == (other.name, other.closed, other.size)
            and (self.exact_radius, self._parts) == (other.exact_radius, other._parts)
            and self.vertices == other.vertices
            and self.exact_shape.keyframes == other.exact_shape.keyframes
            and self.exact_errors == other.exact_errors
            and self.motion == other.motion
        )

    def __hash__(self) -> int:
        return hash((self.name, self.closed, self.size))

    def __reduce__(self) -> tuple[object, ...]:
        options: dict[str, object] = {"motion": self.motion, "closed": self.closed}
        if self.exact_radius:
            options["radius"] = str(self.exact_radius)
        options |= self.exact_errors.given()
        if self._properties:
            options["properties"] = self._properties
        given = self.exact_shape.given()
        if self._parts is not None:
            from exactpt.motion.rings import parts_given

            options |= parts_given(self._parts, given["vertices"])
            return made, (Body, (self.name,), options)
        return made, (Body, (self.name,), given | options)

    def __repr__(self) -> str:
        what = {1: "point", 2: "segment"}.get(self.size, "polygon" if self.closed else "chain")
        rounded = f", radius {show(self.exact_radius)}" if self.exact_radius else ""
        rings = f" in {counted(len(self.rings), 'ring')}" if self.has_rings else ""
        vertices = counted(self.size, "vertex")
        within = ", with stated errors" if any(self.exact_errors.sizes) else ""
        return f"<Body {in_brief(self.name, 60)}: {what} of {vertices}{rings}{rounded}{within}>"


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


def _check_sorts(name: str, *given: object) -> None:
    """Check that there are vertices, keyframes or parts, but one of these alone."""
    if sum(one is not None for one in given) != 1:
        raise InputError(f"body {shorten(name)}: give either vertices or keyframes or parts")


def _check_motion(name: str, motion: object) -> None:
    if not (isinstance(motion, Piecewise) or hasattr(motion, "track")):
        raise InputError(f"body {shorten(name)}: not a motion: {shorten(motion)}")
