"""The paths of vertices, and moving lines between them, in certificates (docs/proofs.md)."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from fractions import Fraction
from itertools import chain
from math import frexp, lcm
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias, final

import numpy as np

from exactpt.cached_property import cached_property
from exactpt.kernel.doubles import Floats
from exactpt.kernel.numbers import QQ, rational

if TYPE_CHECKING:
    from exactpt.motion.body import Body
    from exactpt.proof_scene import Whole

Items: TypeAlias = "np.ndarray[Any, np.dtype[np.intp]]"
Place: TypeAlias = tuple[float, float]
Moved: TypeAlias = tuple[tuple[Sequence[float], Sequence[float], bool], Place, Place]

DIRECTIONS: Final = np.array([(1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (1, 2), (2, -1), (1, -2)])
ZEROS: Final = QQ(0), QQ(0)


class Plane(NamedTuple):
    """A moving line x p_x + y p_y = c + v t."""

    x: int
    y: int
    c: QQ
    v: QQ

    def line(self) -> str:
        """Return the node that begins with it."""
        return f"c {self.x} {self.y} {self.c}" + (f" {self.v}" if self.v else "")


class Breaks(NamedTuple):
    """The times, within a span, at which the formulas of a body change."""

    breaks: Sequence[Fraction]


@final
class Paths:
    """The vertices of bodies, numbered through, with what `exactpt.check_apart.Interval` needs.

    Attributes:
        bodies: the bodies.
        items: of each edge, or of the only vertex of a body: the body and two vertices.
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
        self.bodies, self.distance, self.extra = bodies, distance, float(distance)
        self.breaks = [Breaks(body.breakpoints_between(*span)) for body in bodies]
        self.radii = [body.radius for body in bodies]
        self.items: list[tuple[int, int, int]] = []
        self.body_of: list[int] = []
        self.first: list[int] = []
        self.first_item = [0]
        for i, body in enumerate(bodies):
            first = len(self.body_of)
            self.first.append(first)
            self.body_of += [i] * body.size
            self.items += [(i, first + u, first + v) for u, v in body.edges or [(0, 0)]]
            self.first_item.append(len(self.items))
        self.body = np.array([i for i, _, _ in self.items], dtype=np.intp)
        wide = [float(r) for r in self.radii]
        self.wide_bodies, self.widest = np.array(wide), max(wide, default=0.0)
        self.wide = self.wide_bodies[self.body]
        self.is_round = bool(self.widest or self.extra)
        self._made = dict[tuple[int, int], Any]()

    @cached_property
    def shapes(self) -> tuple[Floats, Floats, Floats, float]:
        """The least and largest values of shapes in the usual directions, vertices, and the size.

        Without the motions, in doubles; a shape that has none is at the origin.
        """
        places = [(body.exact_shape.near or ([0.0] * body.size,) * 2)[:2] for body in self.bodies]
        along = np.array([[*chain(*some)] for some in zip(*places, strict=True)]).T
        values = along @ DIRECTIONS.T
        low, high = (f.reduceat(values, self.first) for f in (np.minimum, np.maximum))
        return low, high, along, float(np.abs(along).max())

    def translation(self, body: int, start: QQ, end: QQ) -> Moved | None:
        """Return the shape of a body in doubles, and where it is moved at the start and the end.

        None if it does not translate by one linear formula, or its shape has no doubles.
        """
        piece = self.bodies[body].exact_piece_after(start)
        moved = piece.translation
        if moved is None or (piece.until is not None and piece.until < end):
            return None
        shape, motion = moved
        x, y = motion.x.exact_coefficients, motion.y.exact_coefficients
        if max(len(x), len(y)) > 2:
            return None
        (a, i), (b, j) = (*x, *ZEROS)[:2], (*y, *ZEROS)[:2]
        first, last = ((float(a + i * t), float(b + j * t)) for t in (start, end))
        return shape, first, last

    def of(self, v: int) -> Breaks:
        """Return the body of a vertex."""
        return self.breaks[self.body_of[v]]

    def track(self, v: int, after: Fraction) -> Any:  # noqa: ANN401 - polynomials of check_apart
        """Return the path of a vertex just after a time."""
        i = self.body_of[v]
        breaks = self.breaks[i].breaks
        key = v, bisect_right(breaks, after) if breaks else 0
        if key not in self._made:
            track = self.bodies[i].exact_piece_after(after).track(v - self.first[i])
            self._made[key] = tuple([*map(int, f)] for f in (track.x, track.y, track.w))
        return self._made[key]

    def place(self, v: int, t: Fraction) -> Whole:
        """Return where a vertex is at a time."""
        i, time = self.body_of[v], rational(t)
        x, y = self.bodies[i].exact_piece_after(time).position(v - self.first[i], time)
        n, k = int(x.denominator), int(y.denominator)
        w = lcm(n, k)
        return int(x.numerator) * (w // n), int(y.numerator) * (w // k), w


def short(x: QQ, unit: float) -> QQ:
    """Return a number near x with few digits: a multiple of a power of two not above the unit."""
    if not unit > 0:
        return x
    power, n, d = frexp(unit)[1] - 1, x.numerator, x.denominator
    n, d = (n << -power, d) if power < 0 else (n, d << power)
    k = (2 * n + d) // (2 * d)
    return QQ(k, 1 << -power) if power < 0 else QQ(k << power)
