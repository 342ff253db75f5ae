"""The shape of a body: its vertices in the rest frame, where they may deform."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import chain, pairwise
from typing import Any, Final, Literal, NamedTuple, TypeAlias, final

from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.filters.rounding import LARGEST, SMALLEST
from exactpt.kernel.numbers import (
    QQ,
    Rational,
    as_doubles,
    nearest_float,
    of_double,
    rational,
    shorten,
    show,
)
from exactpt.kernel.polynomial import Polynomial, polynomial
from exactpt.motion.motions import Coefficients, Position

VertexLike: TypeAlias = (
    "Sequence[Rational] | Mapping[str, Coefficients] | tuple[Polynomial, Polynomial]"
)
"""A vertex as a caller may write it: (x, y), or {"x": polynomial, "y": polynomial}."""

Keyframes: TypeAlias = "Sequence[tuple[Rational, Sequence[Sequence[Rational]]]]"
"""Keyframes as a caller may write them: pairs (t, vertices)."""

_PAIRS: Final = (tuple, list)
_ZERO: Final = QQ(0)


class Keyframe(NamedTuple):
    """The shape of a deforming body at one time."""

    t: Fraction
    vertices: tuple[tuple[Fraction, Fraction], ...]

    def __repr__(self) -> str:
        return record_in_brief(self)


class Places(NamedTuple):
    """Points in doubles.

    Attributes:
        xs, ys: the coordinates.
        is_exact: whether all of them are exact; else they are the nearest doubles.
    """

    xs: list[float]
    ys: list[float]
    is_exact: bool


@final
class Shape:
    """Vertices in the rest frame: constant, polynomials in t, or interpolated linearly.

    Vertices given as doubles are kept, and become rationals when these are needed.

    Args:
        vertices: as in `Body`.
        keyframes: as in `Body`.
        ring: whether a last vertex that repeats the first, of more than three, is dropped.

    Attributes:
        size: the number of vertices.
        doubles: the coordinates x and y, if all were given as doubles.
        keyframes: in the order of time; none if vertices were given.
    """

    __slots__ = ("_near", "_pieces", "_positions", "doubles", "keyframes", "size")

    def __init__(
        self,
        vertices: Iterable[VertexLike] | None,
        keyframes: Keyframes | None = None,
        *,
        ring: bool = False,
    ) -> None:
        self.doubles: tuple[list[float], list[float]] | None = None
        self.keyframes: tuple[Keyframe, ...] = ()
        self._pieces: Sequence[tuple[Position, ...]] = ()
        self._positions: tuple[Position, ...] | None = None
        self._near: Places | Literal[False] | None = False
        if keyframes is not None:
            self.keyframes = frames = _read_keyframes(keyframes)
            between = [_between(*pair) for pair in pairwise(frames)]
            self._pieces = [_at_rest(frames[0]), *between, _at_rest(frames[-1])]
            self._positions = ()
            self.size = len(frames[0].vertices)
        else:
            given = listed("vertices", vertices)
            self.doubles = _read_doubles(given)
            if self.doubles is None:
                self._positions = tuple(_read_vertex(i, v) for i, v in enumerate(given))
            self.size = len(given)
            if ring and self.size > 3:
                self._drop_closing_point()
        if not self.size:
            raise InputError("at least one vertex is needed")

    def _drop_closing_point(self) -> None:
        if self._positions is not None:
            if self._positions[0] != self._positions[-1]:
                return
            self._positions = self._positions[:-1]
        elif self.doubles is not None:
            xs, ys = self.doubles
            if (xs[0], ys[0]) != (xs[-1], ys[-1]):
                return
            self.doubles = xs[:-1], ys[:-1]
        self.size -= 1

    @property
    def is_exact(self) -> bool:
        """True if the rational positions are known; those of doubles are made on first access."""
        return self._positions is not None

    @property
    def positions(self) -> tuple[Position, ...]:
        """The vertices; none if the shape was given by keyframes."""
        if self._positions is None:
            xs, ys = self.doubles or ([], [])
            self._positions = tuple(
                (Polynomial([x]), Polynomial([y])) for x, y in zip(xs, ys, strict=True)
            )
        return self._positions

    def rest_place(self, vertex: int) -> tuple[QQ, QQ]:
        """Return a vertex that keeps its place in the rest frame."""
        if self._positions is None and self.doubles is not None:
            xs, ys = self.doubles
            return of_double(xs[vertex]), of_double(ys[vertex])
        x, y = self.positions[vertex]
        return x.exact_at(_ZERO), y.exact_at(_ZERO)

    @property
    def near(self) -> Places | None:
        """The vertices in doubles; None if they are not constant, or out of range."""
        if self._near is False:
            known = self.doubles
            self._near = (
                _near(self._positions or ()) if known is None else Places(*known, is_exact=True)
            )
        return self._near

    @property
    def near_differences(self) -> tuple[list[float], list[float]] | None:
        """The differences of the vertices from the first one, each rounded once.

        None if they are not constant, or out of range.
        """
        near = self.near
        if near is None:
            return None
        xs, ys = near.xs, near.ys
        if near.is_exact:
            return [x - xs[0] for x in xs], [y - ys[0] for y in ys]
        places = [self.rest_place(vertex) for vertex in range(self.size)]
        x0, y0 = places[0]
        dxs = [nearest_float(x - x0) for x, _ in places]
        dys = [nearest_float(y - y0) for _, y in places]
        return dxs, dys

    def after(self, t: QQ) -> tuple[Position, ...]:
        """Return the motion just after a time; it rests outside the keyframes."""
        if not self.keyframes:
            return self.positions
        return self._pieces[bisect_right(self.keyframes, t, key=lambda frame: frame.t)]

    def given(self) -> dict[str, tuple[object, ...]]:
        """Return the keyword arguments from which a body of this shape can be made."""
        if self.keyframes:
            return {"keyframes": tuple(
                (str(frame.t), tuple((str(x), str(y)) for x, y in frame.vertices))
                for frame in self.keyframes
            )}  # fmt: skip
        if self.doubles is not None:
            return {"vertices": tuple(zip(*self.doubles, strict=True))}
        return {"vertices": tuple(map(_given, self.positions))}


def _near(positions: Sequence[Position]) -> Places | None:
    """Return vertices in doubles; None if not constant, out of range, or not given."""
    coordinates, is_exact = list[float](), True
    for coordinate in chain.from_iterable(positions):
        coefficients = coordinate.exact_coefficients
        value = coefficients[0] if coefficients else _ZERO
        near = nearest_float(value)
        coordinates.append(near)
        if len(coefficients) > 1:
            return None
        if near != value:
            if not SMALLEST <= abs(near) <= LARGEST:
                return None
            is_exact = False
    return Places(coordinates[::2], coordinates[1::2], is_exact) if positions else None


def _given(vertex: Position) -> tuple[object, object]:
    """Return a vertex as an argument of the constructor; constants if it does not deform."""
    if vertex[0].degree > 0 or vertex[1].degree > 0:
        return vertex
    x, y = (f.exact_at(QQ(0)) for f in vertex)
    return str(x), str(y)


def are_constant(vertices: Sequence[Position]) -> bool:
    """Return True if vertices keep their places in the rest frame.

    >>> from exactpt import Body
    >>> are_constant(Body("b", [(0, 0), (1, 0)]).vertices)
    True
    >>> are_constant(Body("b", [(0, 0), {"x": [1, 1], "y": 0}]).vertices)
    False
    """
    return all(f.degree <= 0 for vertex in vertices for f in vertex)


def listed(what: str, values: object) -> list[Any]:
    """Return the entries of an iterable that is neither a text nor a mapping.

    Those of an array of numbers are Python's, with equal values.

    Raises:
        InputError: if it is not one.
    """
    if type(values) in _PAIRS:
        return list(values)  # type: ignore[call-overload, no-any-return]
    if _is_array_of_numbers(values):
        listed: list[Any] = values.tolist()  # type: ignore[attr-defined]
        return listed
    if isinstance(values, Iterable) and not isinstance(values, (str, Mapping)):
        try:
            return list(values)
        except TypeError:  # an array without dimension
            pass
    raise InputError(f"{what}: not a list: {shorten(values)}")


def _is_array_of_numbers(values: object) -> bool:
    """Return True for a numpy array of floats or integers, without importing numpy."""
    if type(values).__module__ != "numpy":
        return False
    of_numbers: bool = values.ndim > 0 and values.dtype.kind in "fiu"  # type: ignore[attr-defined]
    return of_numbers


def _pair(point: object) -> tuple[Any, Any]:
    coordinates = list(point) if isinstance(point, Iterable) else []
    if isinstance(point, str) or len(coordinates) != 2:
        raise InputError(f"a vertex has two coordinates: {shorten(point)}")
    return coordinates[0], coordinates[1]


def _read_doubles(vertices: Sequence[object]) -> tuple[list[float], list[float]] | None:
    """Return the coordinates x and y of vertices; None unless all are pairs of doubles."""
    flat: list[Any] = []
    for vertex in vertices:
        if type(vertex) not in _PAIRS or len(vertex) != 2:  # type: ignore[arg-type]
            return None
        flat += vertex  # type: ignore[arg-type]
    near = as_doubles(flat)
    return None if near is None else (near[::2], near[1::2])


def _read_vertex(index: int, vertex: VertexLike) -> Position:
    try:
        if isinstance(vertex, Mapping):
            unknown = set(vertex) - {"x", "y"}
            if unknown:
                raise InputError(f"unknown key {min(unknown)!r}")
            return polynomial(vertex.get("x", ())), polynomial(vertex.get("y", ()))
        x, y = _pair(vertex)
        return polynomial(x), polynomial(y)
    except InputError as error:
        raise InputError(f"vertex {index}: {error}") from None


def _read_keyframes(keyframes: Keyframes) -> tuple[Keyframe, ...]:
    frames: list[Keyframe] = []
    for i, keyframe in enumerate(listed("keyframes", keyframes)):
        if not isinstance(keyframe, Sequence) or len(keyframe) != 2:
            raise InputError(f"keyframe {i}: not (t, vertices): {shorten(keyframe)}")
        frame = _read_keyframe(i, *keyframe)
        if frames and frame.t <= frames[-1].t:
            raise InputError(f"keyframe {i}: t = {show(frame.t)} is not after {show(frames[-1].t)}")
        if frames and len(frame.vertices) != len(frames[0].vertices):
            raise InputError(
                f"keyframe {i}: {len(frame.vertices)} vertices, "
                f"but keyframe 0 has {len(frames[0].vertices)}"
            )
        frames.append(frame)
    if not frames:
        raise InputError("at least one keyframe is needed")
    return tuple(frames)


def _read_keyframe(i: int, t: Rational, vertices: object) -> Keyframe:
    pairs = map(_pair, listed(f"keyframe {i}", vertices))
    try:
        points = tuple((rational(x), rational(y)) for x, y in pairs)
        return Keyframe(rational(t), points)
    except InputError as error:
        raise InputError(f"keyframe {i}: {error}") from None


def _at_rest(frame: Keyframe) -> tuple[Position, ...]:
    return tuple((Polynomial([x]), Polynomial([y])) for x, y in frame.vertices)


def _between(before: Keyframe, after: Keyframe) -> tuple[Position, ...]:
    """Return the linear interpolation a + (b - a) (t - t0) / (t1 - t0) of each vertex."""
    span = after.t - before.t

    def line(a: QQ, b: QQ) -> Polynomial:
        slope = (b - a) / span
        return Polynomial([a - slope * before.t, slope])

    return tuple(
        (line(x0, x1), line(y0, y1))
        for (x0, y0), (x1, y1) in zip(before.vertices, after.vertices, strict=True)
    )
