"""Bodies: a name, a shape and its motion, which give the trajectories of the vertices."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, final

from exactpt.errors import InputError
from exactpt.extensions import extension
from exactpt.geometry.polygon import edges
from exactpt.kernel.numbers import QQ, Rational, fraction, fractions, place, rational, shorten, show
from exactpt.kernel.polynomial import Polynomial, polynomial
from exactpt.motion.motions import REST, Coefficients, Motion, Pieces, Position, SimpleMotion, made
from exactpt.motion.track import Track

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["Body", "BodyPiece", "Keyframe", "VertexLike", "is_text"]

VertexLike: TypeAlias = (
    "Sequence[Rational] | Mapping[str, Coefficients] | tuple[Polynomial, Polynomial]"
)
"""A vertex as a caller may write it: (x, y), or {"x": polynomial, "y": polynomial}."""


def is_text(name: object) -> bool:
    """Whether it is a nonempty string that can be encoded: without unpaired surrogates."""
    try:
        return isinstance(name, str) and bool(name.encode())
    except UnicodeEncodeError:
        return False


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

    Raises:
        InputError: if the arguments do not describe a body, or the motion jumps.
    """

    __slots__ = (
        "_breakpoints",
        "_keyframes",
        "_last",
        "_pieces",
        "_shapes",
        "closed",
        "motion",
        "name",
        "vertices",
    )

    def __init__(
        self,
        name: str,
        vertices: Iterable[VertexLike] | None = None,
        motion: Motion = REST,
        *,
        closed: bool = True,
        keyframes: Sequence[tuple[Rational, Sequence[Sequence[Rational]]]] | None = None,
    ) -> None:
        if not is_text(name):
            raise InputError(f"a body's name is a text that is not empty: {shorten(name)}")
        if not (isinstance(motion, Pieces) or hasattr(motion, "track")):
            raise InputError(f"body {shorten(name)}: not a motion: {shorten(motion)}")
        if (vertices is None) == (keyframes is None):
            raise InputError(f"body {shorten(name)}: give either vertices or keyframes")
        self.name = name
        self.motion = motion
        self.closed = closed
        self._keyframes: tuple[Keyframe, ...] = ()
        self.vertices: tuple[Position, ...] = ()
        if keyframes is not None:
            self._keyframes = _read_keyframes(name, keyframes)
        else:
            self.vertices = tuple(
                _read_vertex(name, i, v) for i, v in enumerate(_listed(name, "vertices", vertices))
            )
        self._shapes = self._shape_pieces()
        ends = {until for until, _ in self._shapes if until is not None}
        if isinstance(motion, Pieces):
            ends.update(motion._until)
        self._breakpoints: tuple[QQ, ...] = tuple(sorted(ends))
        self._pieces: dict[QQ | None, BodyPiece] = {}
        self._last: tuple[QQ, list[tuple[QQ, QQ]]] | None = None
        if not self._shapes[0][1]:
            raise InputError(f"body {shorten(name)}: at least one vertex is needed")
        self._check_continuity()

    @classmethod
    def from_shapely(
        cls,
        geometry: BaseGeometry,
        name: str,
        motion: Motion = REST,
        *,
        holes: Literal["refuse", "fill"] = "refuse",
    ) -> Body:
        """The body of a shapely point, line or polygon, with the exact values of its doubles.

        Args:
            geometry: a geometry of one part; `Scene.from_shapely` takes several.
            name: the name of the body.
            motion: the motion of the shape; at rest if not given.
            holes: "refuse" a polygon with holes, or "fill" them.

        Raises:
            InputError: if the geometry is not one part, or cannot be a body.
        """
        body: Body = extension("body from shapely")(geometry, name, motion, holes)
        return body

    @property
    def size(self) -> int:
        """The number of vertices."""
        return len(self._shapes[0][1])

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
        end = next((b for b in self._breakpoints if b > t), None)
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
        return tuple(motion.track(position) for position in shape)

    def _shape_pieces(self) -> list[tuple[QQ | None, tuple[Position, ...]]]:
        if not self._keyframes:
            return [(None, self.vertices)]
        first, last = self._keyframes[0], self._keyframes[-1]
        pieces: list[tuple[QQ | None, tuple[Position, ...]]] = [(first.t, _at_rest(first))]
        for before, after in zip(self._keyframes, self._keyframes[1:], strict=False):
            pieces.append((after.t, _between(before, after)))
        pieces.append((None, _at_rest(last)))
        return pieces

    def _shape_after(self, t: QQ) -> tuple[Position, ...]:
        return next(shape for until, shape in self._shapes if until is None or until > t)

    def _motion_after(self, t: QQ) -> SimpleMotion:
        if not isinstance(self.motion, Pieces):
            return self.motion
        for until, motion in zip(self.motion._until, self.motion.motions, strict=False):
            if until > t:
                return motion
        return self.motion.motions[-1]

    def _check_continuity(self) -> None:
        if not isinstance(self.motion, Pieces):
            return
        pairs = zip(self.motion.motions, self.motion.motions[1:], strict=False)
        for t, (before, after) in zip(self.motion._until, pairs, strict=True):
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
        return (self.name, self.closed, self.vertices, self._keyframes, self.motion) == (
            other.name, other.closed, other.vertices, other._keyframes, other.motion
        )  # fmt: skip

    def __hash__(self) -> int:
        return hash((self.name, self.closed, self.size))

    def __reduce__(self) -> tuple[object, ...]:
        shape: dict[str, object] = {"vertices": tuple(map(_given, self.vertices))}
        if self._keyframes:
            shape = {"keyframes": tuple(
                (str(frame.t), tuple((str(x), str(y)) for x, y in frame.vertices))
                for frame in self._keyframes
            )}  # fmt: skip
        return made, (Body, (self.name,), shape | {"motion": self.motion, "closed": self.closed})

    def __repr__(self) -> str:
        what = {1: "point", 2: "segment"}.get(self.size, "polygon" if self.closed else "chain")
        return f"<Body {self.name!r}: {what} of {self.size} vertices>"


def _listed(name: str, what: str, values: object) -> list[Any]:
    if isinstance(values, Iterable) and not isinstance(values, (str, Mapping)):
        return list(values)
    raise InputError(f"body {shorten(name)}: {what}: not a list: {shorten(values)}")


def _pair(point: object) -> tuple[Any, Any]:
    coordinates = list(point) if isinstance(point, Iterable) else []
    if isinstance(point, str) or len(coordinates) != 2:
        raise InputError(f"a vertex has two coordinates: {shorten(point)}")
    return coordinates[0], coordinates[1]


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
