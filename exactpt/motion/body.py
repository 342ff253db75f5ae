"""Bodies: a name, a shape and its motion, which give the trajectories of the vertices."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Final, Literal, NamedTuple, TypeAlias, final

from exactpt.errors import InputError
from exactpt.extensions import extension
from exactpt.geometry.polygon import edges
from exactpt.kernel.budget import ask
from exactpt.kernel.numbers import (
    QQ,
    Rational,
    as_doubles,
    fraction,
    fractions,
    place,
    rational,
    shorten,
    show,
)
from exactpt.kernel.polynomial import Polynomial, polynomial
from exactpt.motion.motions import (
    REST,
    Coefficients,
    Motion,
    Pieces,
    Position,
    SimpleMotion,
    Translation,
    made,
)
from exactpt.motion.track import Track

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["Body", "BodyPiece", "Keyframe", "VertexLike", "is_text", "refuse_rounded"]

VertexLike: TypeAlias = (
    "Sequence[Rational] | Mapping[str, Coefficients] | tuple[Polynomial, Polynomial]"
)
"""A vertex as a caller may write it: (x, y), or {"x": polynomial, "y": polynomial}."""


_PAIRS: Final = (tuple, list)
_PLAIN: Final = (int, float)
_SHARP: Final = QQ(0)
_SHAPE: Final = (
    "_doubles", "_keyframes", "_positions", "_radius", "_shapes", "_size", "closed", "name"
)  # fmt: skip


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


class Keyframe(NamedTuple):
    """The shape of a deforming body at one time."""

    t: Fraction
    vertices: tuple[tuple[Fraction, Fraction], ...]


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
            may be in either orientation.
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
        "_doubles",
        "_keyframes",
        "_last",
        "_pieces",
        "_positions",
        "_radius",
        "_shapes",
        "_size",
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
        keyframes: Sequence[tuple[Rational, Sequence[Sequence[Rational]]]] | None = None,
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
        self._keyframes: tuple[Keyframe, ...] = ()
        self._doubles: tuple[list[float], list[float]] | None = None
        self._positions: tuple[Position, ...] | None = None
        if keyframes is not None:
            self._keyframes = _read_keyframes(name, keyframes)
            self._positions = ()
            self._size = len(self._keyframes[0].vertices)
        else:
            given = _listed(name, "vertices", vertices)
            self._doubles = _read_doubles(given)
            if self._doubles is None:
                self._positions = tuple(_read_vertex(name, i, v) for i, v in enumerate(given))
            self._size = len(given)
        self._shapes = self._shape_pieces() if self._keyframes else []
        if not self._size:
            raise InputError(f"body {shorten(name)}: at least one vertex is needed")
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

    def with_motion(self, motion: Motion) -> Body:
        """A body of the same name and shape with another motion.

        Raises:
            InputError: if it is no motion, or jumps.
        """
        _check_motion(self.name, motion)
        other = Body.__new__(Body)
        for name in _SHAPE:
            setattr(other, name, getattr(self, name))
        other._set_motion(motion)  # noqa: SLF001
        return other

    def _set_motion(self, motion: Motion) -> None:
        self.motion = motion
        ends = {frame.t for frame in self._keyframes}
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
        return self._size

    @property
    def radius(self) -> Fraction:
        """The body is all points within this distance of its core; 0 unless it is rounded."""
        return fraction(self._radius)

    @property
    def vertices(self) -> tuple[Position, ...]:
        """The positions in the body's rest frame; none if the body was given by keyframes."""
        if self._positions is None:
            xs, ys = self._doubles or ([], [])
            self._positions = tuple(
                (Polynomial([x]), Polynomial([y])) for x, y in zip(xs, ys, strict=True)
            )
        return self._positions

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
            for frame in self._keyframes
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
            tracks = self._tracks(self._shape_after(t), self._motion_after(t))
            self._pieces[end] = BodyPiece(end, tracks)
        return self._pieces[end]

    def at(self, t: Rational) -> list[tuple[Fraction, Fraction]]:
        """The exact positions of the vertices at a rational time."""
        return list(map(place, self._at(rational(t))))

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

    def _shape_pieces(self) -> list[tuple[Position, ...]]:
        """The shape before the first keyframe, between each two, and after the last."""
        frames = self._keyframes
        between = [_between(*pair) for pair in pairwise(frames)]
        return [_at_rest(frames[0]), *between, _at_rest(frames[-1])]

    def _shape_after(self, t: QQ) -> tuple[Position, ...]:
        if not self._keyframes:
            return self.vertices
        return self._shapes[bisect_right(self._keyframes, t, key=lambda frame: frame.t)]

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
            shape = self._shape_after(t)
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
            and (self._keyframes, self.motion) == (other._keyframes, other.motion)
        )

    def __hash__(self) -> int:
        return hash((self.name, self.closed, self.size))

    def __reduce__(self) -> tuple[object, ...]:
        shape: dict[str, object]
        if self._doubles is not None:
            shape = {"vertices": tuple(zip(*self._doubles, strict=True))}
        else:
            shape = {"vertices": tuple(map(_given, self.vertices))}
        if self._keyframes:
            shape = {"keyframes": tuple(
                (str(frame.t), tuple((str(x), str(y)) for x, y in frame.vertices))
                for frame in self._keyframes
            )}  # fmt: skip
        if self._radius:
            shape["radius"] = str(self._radius)
        return made, (Body, (self.name,), shape | {"motion": self.motion, "closed": self.closed})

    def __repr__(self) -> str:
        what = {1: "point", 2: "segment"}.get(self.size, "polygon" if self.closed else "chain")
        rounded = f", radius {show(self._radius)}" if self._radius else ""
        return f"<Body {self.name!r}: {what} of {self.size} vertices{rounded}>"


def _check_motion(name: str, motion: object) -> None:
    if not (isinstance(motion, Pieces) or hasattr(motion, "track")):
        raise InputError(f"body {shorten(name)}: not a motion: {shorten(motion)}")


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


def _listed(name: str, what: str, values: object) -> list[Any]:
    if isinstance(values, Iterable) and not isinstance(values, (str, Mapping)):
        return list(values)
    raise InputError(f"body {shorten(name)}: {what}: not a list: {shorten(values)}")


def _pair(point: object) -> tuple[Any, Any]:
    coordinates = list(point) if isinstance(point, Iterable) else []
    if isinstance(point, str) or len(coordinates) != 2:
        raise InputError(f"a vertex has two coordinates: {shorten(point)}")
    return coordinates[0], coordinates[1]


def _read_doubles(vertices: Sequence[object]) -> tuple[list[float], list[float]] | None:
    """The coordinates x and y of vertices; None unless all are pairs of doubles."""
    flat: list[object] = []
    for vertex in vertices:
        if type(vertex) not in _PAIRS or len(vertex) != 2:  # type: ignore[arg-type]
            return None
        flat += vertex  # type: ignore[arg-type]
    near = as_doubles(flat)
    return None if near is None else (near[::2], near[1::2])


def _read_vertex(name: str, index: int, vertex: VertexLike) -> Position:
    try:
        if isinstance(vertex, Mapping):
            unknown = set(vertex) - {"x", "y"}
            if unknown:
                raise InputError(f"unknown key {min(unknown)!r}")
            return polynomial(vertex.get("x", ())), polynomial(vertex.get("y", ()))
        x, y = _pair(vertex)
        return polynomial(x), polynomial(y)
    except InputError as error:
        raise InputError(f"body {shorten(name)}: vertex {index}: {error}") from None


def _given(vertex: Position) -> tuple[object, object]:
    """A vertex as an argument of the constructor; constants if it does not deform."""
    if vertex[0].degree > 0 or vertex[1].degree > 0:
        return vertex
    x, y = (f._at(QQ(0)) for f in vertex)
    return str(x), str(y)


def _read_keyframes(
    name: str, keyframes: Sequence[tuple[Rational, Sequence[Sequence[Rational]]]]
) -> tuple[Keyframe, ...]:
    frames: list[Keyframe] = []
    for i, keyframe in enumerate(_listed(name, "keyframes", keyframes)):
        if not isinstance(keyframe, Sequence) or len(keyframe) != 2:
            raise InputError(
                f"body {shorten(name)}: keyframe {i}: not (t, vertices): {shorten(keyframe)}"
            )
        t, vertices = keyframe
        pairs = map(_pair, _listed(name, f"keyframe {i}", vertices))
        try:
            points = tuple((rational(x), rational(y)) for x, y in pairs)
            frame = Keyframe(rational(t), points)
        except InputError as error:
            raise InputError(f"body {shorten(name)}: keyframe {i}: {error}") from None
        if frames and frame.t <= frames[-1].t:
            raise InputError(
                f"body {shorten(name)}: keyframe {i}: "
                f"t = {show(frame.t)} is not after {show(frames[-1].t)}"
            )
        if frames and len(points) != len(frames[0].vertices):
            raise InputError(
                f"body {shorten(name)}: keyframe {i}: {len(points)} vertices, "
                f"but keyframe 0 has {len(frames[0].vertices)}"
            )
        frames.append(frame)
    if not frames:
        raise InputError(f"body {shorten(name)}: at least one keyframe is needed")
    return tuple(frames)


def _at_rest(frame: Keyframe) -> tuple[Position, ...]:
    return tuple((Polynomial([x]), Polynomial([y])) for x, y in frame.vertices)


def _between(before: Keyframe, after: Keyframe) -> tuple[Position, ...]:
    """The linear interpolation a + (b - a) (t - t0) / (t1 - t0) of each vertex."""
    span = after.t - before.t

    def line(a: QQ, b: QQ) -> Polynomial:
        slope = (b - a) / span
        return Polynomial([a - slope * before.t, slope])

    return tuple(
        (line(x0, x1), line(y0, y1))
        for (x0, y0), (x1, y1) in zip(before.vertices, after.vertices, strict=True)
    )
