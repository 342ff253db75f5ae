"""Shapes in doubles: the vertices of a body that does not deform, and its straight motions."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple, final

from exactpt.filters.rounding import TINY, U
from exactpt.geometry.simple import is_surely_simple
from exactpt.kernel.numbers import QQ, nearest_float, of_double
from exactpt.kernel.polynomial import Polynomial
from exactpt.kernel.square_root import nearest_square_root
from exactpt.motion.body import Body
from exactpt.motion.motions import (
    Motion,
    Pieces,
    Piecewise,
    Rigid,
    SimpleMotion,
    Translation,
    formulas_of,
)
from exactpt.motion.shape import are_constant


class Outline(NamedTuple):
    """Vertices in doubles.

    Attributes:
        xs, ys: finite coordinates.
        error: a bound on the errors of all coordinates: 0, or at least U times the largest.
        low_x, high_x, low_y, high_y: the bounding box of the doubles.
    """

    xs: list[float]
    ys: list[float]
    error: float
    low_x: float
    high_x: float
    low_y: float
    high_y: float


def pieces_during(motion: Motion, start: QQ, end: QQ) -> list[tuple[SimpleMotion, QQ | None]]:
    """Return the motions by one formula that it consists of in a span, each with its end."""
    if isinstance(motion, Piecewise):
        return motion.exact_pieces_during(start, end)
    return [(motion, None)]


def is_rigid(body: Body) -> bool:
    """Return True if a body surely keeps its shape: it does not deform, and translates or turns."""
    return bool(body.vertices) and are_constant(body.vertices) and _translates_or_turns(body.motion)


def _translates_or_turns(motion: Motion) -> bool:
    """Return True if all pieces of a motion are translations or rigid motions."""
    return all(isinstance(formula, (Translation, Rigid)) for formula in formulas_of(motion))


def reach_from(body: Body, point: tuple[QQ, QQ]) -> QQ | None:
    """Return a number that is at least the distance of all vertices from a point, at rest.

    It is a double; None if that is out of range.

    Args:
        body: a body whose vertices are constant.
        point: a point of the frame in which it rests.
    """
    px, py = point
    places = [(x.exact_at(QQ(0)), y.exact_at(QQ(0))) for x, y in body.vertices]
    root = nearest_square_root(max((x - px) ** 2 + (y - py) ** 2 for x, y in places))
    reach = math.nextafter(root, math.inf)  # the root is at most half a unit above the nearest
    return QQ(reach) if math.isfinite(reach) else None


def may_touch_itself(body: Body) -> bool:
    """Return True if a body, valid at the start, may come into a contact with itself.

    A body with a radius does not by definition, nor does one with rings that touch: it keeps its
    shape.
    """
    return not (body.exact_radius or is_rigid(body) or body.exact_ring_touches)


def rest_outline(body: Body) -> Outline | None:
    """Return the vertices in the rest frame; None if the body deforms there, or is out of range."""
    near = body.exact_shape.near
    if near is not None:
        return _outline(near.xs, near.ys, exact=near.is_exact)
    points: list[tuple[QQ, QQ]] = []
    for x, y in body.vertices:
        if x.degree > 0 or y.degree > 0:
            return None
        points.append((x.exact_at(QQ(0)), y.exact_at(QQ(0))))
    return _nearest(points) if points else None


def outline_at(body: Body, t: QQ) -> Outline | None:
    """Return an outline congruent to the body at a time: at rest if its motion is rigid."""
    if _translates_or_turns(body.motion):
        shape = rest_outline(body)
        if shape is not None:
            return shape
    return _nearest(body.exact_at(t))


def is_simple_by_doubles(body: Body, t: QQ) -> bool:
    """Return True if a body of one ring or chain certainly is simple at a time, with an area."""
    if body.has_rings:
        return False
    doubles = body.exact_shape.doubles
    if doubles is not None and isinstance(body.motion, (Translation, Rigid)):
        return is_surely_simple(*doubles, closed=body.closed)
    shape = outline_at(body, t)
    return shape is not None and is_surely_simple(
        shape.xs, shape.ys, closed=body.closed, error=shape.error
    )


def _nearest(points: Iterable[tuple[QQ, QQ]]) -> Outline | None:
    xs: list[float] = []
    ys: list[float] = []
    for x, y in points:
        xs.append(nearest_float(x))
        ys.append(nearest_float(y))
    return _outline(xs, ys, exact=False)


def _outline(xs: list[float], ys: list[float], *, exact: bool) -> Outline | None:
    low_x, high_x, low_y, high_y = min(xs), max(xs), min(ys), max(ys)
    size = max(-low_x, high_x, -low_y, high_y)
    if size == math.inf:
        return None
    return Outline(xs, ys, 0.0 if exact else _off(size), low_x, high_x, low_y, high_y)


def _off(size: float) -> float:
    """Return a bound on the distance of a number to its nearest double, of this size at most."""
    return 2.0 * U * size + TINY


@final
class Straight:
    """A body in straight motion: its vertices at c + v t, as doubles and exactly.

    Attributes:
        body: the body.
        shape: its vertices in the rest frame.
        motion: its translation, of degree at most 1.
        edges: its edges, as pairs of vertices; of a point, from the vertex to itself.
        cx, cy, vx, vy: the coefficients of the translation, as doubles.
        c_error, v_error: bounds on the errors of these.

    The exact vertices are made when they are needed, once for all motions of the body.
    """

    __slots__ = (
        "_points", "body", "c_error", "cx", "cy", "edges", "motion", "shape", "v_error", "vx", "vy"
    )  # fmt: skip

    def __init__(
        self,
        body: Body,
        shape: Outline,
        motion: Translation,
        edges: list[tuple[int, int]],
        points: list[tuple[QQ, QQ] | None],
    ) -> None:
        self.body = body
        self.shape = shape
        self.motion = motion
        self.edges = edges
        self._points = points
        self.cx, self.vx, c_error, v_error = _linear(motion.x)
        self.cy, self.vy, c_of_y, v_of_y = _linear(motion.y)
        self.c_error = max(c_error, c_of_y)
        self.v_error = max(v_error, v_of_y)

    def point(self, i: int) -> tuple[QQ, QQ]:
        """Vertex i in the rest frame."""
        point = self._points[i]
        if point is None:
            x, y = self.body.vertices[i]
            self._points[i] = point = x.exact_at(QQ(0)), y.exact_at(QQ(0))
        return point

    def line(self) -> tuple[QQ, QQ, QQ, QQ]:
        """Return the exact coefficients of the translation: c in x and y, v in x and y."""
        x, y = self.motion.x.exact_coefficients, self.motion.y.exact_coefficients
        zero = QQ(0)
        return (
            x[0] if x else zero,
            y[0] if y else zero,
            x[1] if len(x) > 1 else zero,
            y[1] if len(y) > 1 else zero,
        )


class Path(NamedTuple):
    """The relative motion c + w t of the vertices of one body, off by at most the errors."""

    cx: float
    cy: float
    wx: float
    wy: float
    c_error: float
    w_error: float


def _linear(f: Polynomial) -> tuple[float, float, float, float]:
    """Return the coefficients of a polynomial of degree at most 1, and their errors."""
    near = f.exact_doubles
    if near is not None:
        return near[0] if near else 0.0, near[1] if len(near) > 1 else 0.0, 0.0, 0.0
    exact = f.exact_coefficients
    c, c_error = _rounded(exact[0] if exact else QQ(0))
    v, v_error = _rounded(exact[1] if len(exact) > 1 else QQ(0))
    return c, v, c_error, v_error


def _rounded(number: QQ) -> tuple[float, float]:
    """Return the nearest double, and a bound on its error: 0 if it is the number."""
    near = nearest_float(number)
    is_exact = math.isfinite(near) and of_double(near) == number
    return near, 0.0 if is_exact else _off(abs(near))


def straight_pieces(
    body: Body, shape: Outline | None = None
) -> list[tuple[Straight, QQ | None]] | None:
    """Return the straight motions of a body, each with its end; None unless all its motions are.

    Its vertices keep their positions in the rest frame, of which the outline may be given.
    """
    formulas = formulas_of(body.motion)
    for motion in formulas:
        if not isinstance(motion, Translation) or motion.x.degree > 1 or motion.y.degree > 1:
            return None
    ends = (*body.motion.exact_until, None) if isinstance(body.motion, Pieces) else (None,)
    shape = shape or rest_outline(body)
    if shape is None:
        return None
    edges = body.edges or [(0, 0)]
    points: list[tuple[QQ, QQ] | None] = [None] * body.size
    return [
        (Straight(body, shape, motion, edges, points), end)
        for motion, end in zip(formulas, ends, strict=True)
        if isinstance(motion, Translation)
    ]
