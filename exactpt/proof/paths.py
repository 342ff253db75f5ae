"""The paths of vertices, and moving lines between them, in certificates (docs/proofs.md)."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from fractions import Fraction
from math import frexp, lcm
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias, final

import numpy as np

from exactpt.cached_property import cached_property
from exactpt.kernel.doubles import Floats
from exactpt.kernel.numbers import QQ, ZZ, rational

if TYPE_CHECKING:
    from exactpt.motion.body import Body
    from exactpt.motion.shape import Places
    from exactpt.proof_scene import Whole

Items: TypeAlias = "np.ndarray[Any, np.dtype[np.intp]]"
Place: TypeAlias = tuple[float, float]

DIRECTIONS: Final = np.array([(1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (1, 2), (2, -1), (1, -2)])
"""The usual directions, in which extents are compared before others are tried."""


class Plane(NamedTuple):
    """A moving line x p_x + y p_y = c + v t."""

    x: int
    y: int
    c: QQ
    v: QQ

    def line(self) -> str:
        """Return the node that begins with it."""
        return f"c {self.x} {self.y} {self.c}" + (f" {self.v}" if self.v else "")


class Item(NamedTuple):
    """An edge of a body, or the only vertex of one, twice.

    Attributes:
        body: the number of the body.
        u, v: the numbers of the ends among the vertices of all bodies.
    """

    body: int
    u: int
    v: int

    @property
    def ends(self) -> tuple[int, int]:
        """The numbers of both ends."""
        return self.u, self.v


class Moved(NamedTuple):
    """A body that translates along a line, in doubles.

    Attributes:
        shape: its vertices, without the motion.
        first, last: where the shape is moved at the start and at the end.
    """

    shape: Places
    first: Place
    last: Place


class Shapes(NamedTuple):
    """The shapes of all bodies, without their motions, in doubles.

    Attributes:
        low, high: the least and the largest values of each in the usual directions.
        vertices: the vertices of all.
        size: the largest of their coordinates.
    """

    low: Floats
    high: Floats
    vertices: Floats
    size: float


class Breaks(NamedTuple):
    """The times, within a span, at which the formulas of a body change."""

    breaks: Sequence[Fraction]


@final
class Paths:
    """The vertices of bodies, numbered through, with what `exactpt.check_apart.Interval` needs.

    Attributes:
        bodies: the bodies.
        items: the edges of all bodies, and vertices that have none.
        body_of: the body of each vertex.
        first: the number of the first vertex of each body.
        first_item: the number of the first item of each body, and the number of all.
        breaks: the breakpoints of each body, within the span.
        radii: the radius of each body.
        distance: a number below the distances to be certified.
        body: the body of each item.
        wide: the radius of the body of each item, in doubles.
        wide_bodies: the radius of each body, in doubles.
        widest: the largest of them.
        extra: the distance, in doubles.
        is_round: whether there is a radius or a distance.
    """

    def __init__(
        self, bodies: Sequence[Body], distance: Fraction, span: tuple[Fraction, Fraction]
    ) -> None:
        self.bodies = bodies
        self.distance = distance
        self.extra = float(distance)
        self.breaks = [Breaks(body.breakpoints_between(*span)) for body in bodies]
        self.radii = [body.radius for body in bodies]
        self.items: list[Item] = []
        self.body_of: list[int] = []
        self.first: list[int] = []
        self.first_item = [0]
        for i, body in enumerate(bodies):
            first = len(self.body_of)
            self.first.append(first)
            self.body_of += [i] * body.size
            edges = body.edges or [(0, 0)]
            self.items += [Item(i, first + u, first + v) for u, v in edges]
            self.first_item.append(len(self.items))
        self.body = np.array([item.body for item in self.items], dtype=np.intp)
        wide = [float(radius) for radius in self.radii]
        self.wide_bodies = np.array(wide)
        self.widest = max(wide, default=0.0)
        self.wide = self.wide_bodies[self.body]
        self.is_round = bool(self.widest or self.extra)
        self._made = dict[tuple[int, int], Any]()

    @cached_property
    def shapes(self) -> Shapes:
        """The shapes of all bodies; one that has no doubles is at the origin."""
        xs: list[float] = []
        ys: list[float] = []
        for body in self.bodies:
            near = body.exact_shape.near
            at_origin = [0.0] * body.size
            xs += at_origin if near is None else near.xs
            ys += at_origin if near is None else near.ys
        vertices = np.array([xs, ys]).T
        along = vertices @ DIRECTIONS.T
        return Shapes(
            low=np.minimum.reduceat(along, self.first),
            high=np.maximum.reduceat(along, self.first),
            vertices=vertices,
            size=float(np.abs(vertices).max()),
        )

    def translation(self, body: int, start: QQ, end: QQ) -> Moved | None:
        """Return how a body translates from a start to an end.

        None if it does not translate by one linear formula, or its shape has no doubles.
        """
        piece = self.bodies[body].exact_piece_after(start)
        translation = piece.translation
        ends_before = piece.until is not None and piece.until < end
        if translation is None or ends_before:
            return None
        shape, motion = translation
        if not (motion.x.degree <= 1 and motion.y.degree <= 1):
            return None
        x_start, y_start = motion.x.exact_at(start), motion.y.exact_at(start)
        x_end, y_end = motion.x.exact_at(end), motion.y.exact_at(end)
        return Moved(
            shape,
            first=(float(x_start), float(y_start)),
            last=(float(x_end), float(y_end)),
        )

    def of(self, v: int) -> Breaks:
        """Return the body of a vertex."""
        return self.breaks[self.body_of[v]]

    def track(self, v: int, after: Fraction) -> Any:  # noqa: ANN401 - polynomials of check_apart
        """Return the path of a vertex just after a time."""
        body = self.body_of[v]
        vertex = v - self.first[body]
        breaks = self.breaks[body].breaks
        piece = bisect_right(breaks, after) if breaks else 0
        if (v, piece) not in self._made:
            track = self.bodies[body].exact_piece_after(after).track(vertex)
            polynomials = (track.x, track.y, track.w)
            self._made[v, piece] = tuple([int(c) for c in f] for f in polynomials)
        return self._made[v, piece]

    def place(self, v: int, t: Fraction) -> Whole:
        """Return where a vertex is at a time: integers x, y and their common denominator."""
        body = self.body_of[v]
        vertex = v - self.first[body]
        time = rational(t)
        x, y = self.bodies[body].exact_piece_after(time).position(vertex, time)
        below_x = int(x.denominator)
        below_y = int(y.denominator)
        w = lcm(below_x, below_y)
        return int(x.numerator) * (w // below_x), int(y.numerator) * (w // below_y), w


def short(x: QQ, unit: float) -> QQ:
    """Return a number near x with few digits: a multiple of a power of two not above the unit."""
    if not unit > 0:
        return x
    power = frexp(unit)[1] - 1
    if power < 0:
        return QQ(_nearest(x.numerator << -power, x.denominator), 1 << -power)
    return QQ(_nearest(x.numerator, x.denominator << power) << power)


def _nearest(n: ZZ, d: ZZ) -> ZZ:
    """Return the integer nearest to n / d, the larger of two."""
    return (2 * n + d) // (2 * d)
