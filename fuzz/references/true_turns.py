"""Bodies that turn by exactly omega t, or on paths of poses: their first contact, to 200 digits.

`exactpt` serves to read the scene only, and no polynomial takes part: positions are complex
numbers, by the cosine and sine of the angle. Up to a distance of `NEAR` time advances by
distance over speed, in doubles, so that nothing is passed over; there the vertices and edges that
are near are followed by mpmath.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import combinations, pairwise, product
from typing import Any, Final, NamedTuple, TypeAlias, final

import mpmath
import numpy as np
from numpy.typing import NDArray

from exactpt import Body, Polynomial, PosePath, Scene, Spin, Translation

__all__ = ["DIGITS", "Approach", "Real", "Truth", "UndecidedError", "real"]

DIGITS: Final = 200
NEAR: Final = 1e-8
"""The distance from which on roots are sought; that of doubles is right to 1e-12 here."""
TIME: Final = 1e-6
"""The longest step while bodies are that near."""


Real: TypeAlias = Any
"""A real number of mpmath, which declares no types."""
Places: TypeAlias = "NDArray[np.complex128]"


class UndecidedError(Exception):
    """Bodies come too near for the question whether they touch to be decided in this way."""


class Approach(NamedTuple):
    """A vertex of body i, and an edge, or a vertex twice, of body j."""

    i: int
    vertex: int
    j: int
    ends: tuple[int, int]


def real(value: Real) -> Real:
    """A rational as a number of mpmath."""
    return mpmath.mpf(int(value.numerator)) / int(value.denominator)


class _Piece(NamedTuple):
    """Coefficients of the translation and the angle, by the time since the piece began."""

    begin: Real
    path: list[Any]
    angle: list[Any]


@final
class _Turning:
    """A body by its definition; the motion is a `Spin`, a `PosePath` or a translation."""

    def __init__(self, body: Body, end: float) -> None:
        motion: Any = body.motion
        self.radius = real(body.radius)
        self.edges = body.edges or [(0, 0)]
        self.rings = body.rings if body.has_interior else ()
        self.starts = [outline.start for outline, *_ in body.parts]
        self.pivot = zero = mpmath.mpf(0)
        self.span = (-mpmath.inf, mpmath.inf)  # before a path and after it, the body rests
        long = end
        if isinstance(motion, Spin):
            self.pivot = mpmath.mpc(*map(real, motion.pivot))
            path = _coefficients(motion.x, motion.y)
            self.pieces = [_Piece(zero, path, [zero, real(motion.omega)])]
        elif isinstance(motion, PosePath):
            self.pivot = mpmath.mpc(*map(real, motion.pivot))
            times = list(map(real, motion.times))
            self.span = times[0], times[-1]
            self.pieces = [
                _Piece(begin, _coefficients(x, y), [c.real for c in _coefficients(angle, angle)])
                for begin, (x, y, angle) in zip(times, motion.exact_poses, strict=False)
            ]
            long = float(max(b - a for a, b in pairwise(times)))
        elif isinstance(motion, Translation):
            self.pieces = [_Piece(zero, _coefficients(motion.x, motion.y), [zero])]
        else:
            raise TypeError(f"a motion without a truth: {motion!r}")
        self.rest = [_coefficients(x, y) for x, y in body.vertices]
        self._rest = [np.array(c, np.complex128) for c in self.rest]
        arms = [sum(abs(c) * max(1, end**k) for k, c in enumerate(v)) for v in self.rest]
        arm = max(arms) + abs(self.pivot)
        own = max(_rate(v, end) for v in self.rest)
        self.speed = float(
            own + max(_rate(p.path, long) + arm * _rate(p.angle, long) for p in self.pieces)
        )

    def _piece(self, t: Real) -> tuple[_Piece, Real]:
        """The piece at a time, and the time since it began."""
        t = min(max(t, self.span[0]), self.span[1])
        piece = next((p for p in self.pieces[:0:-1] if p.begin <= t), self.pieces[0])
        return piece, t - piece.begin

    def places(self, t: Real) -> list[Any]:
        """The vertices at a time."""
        piece, since = self._piece(t)
        turn = mpmath.expj(mpmath.polyval(piece.angle[::-1], since))
        by = mpmath.polyval(piece.path[::-1], since) + self.pivot
        return [by + turn * (mpmath.polyval(v[::-1], t) - self.pivot) for v in self.rest]

    def doubles(self, t: float) -> Places:
        """The vertices at a time, as complex doubles."""
        piece, since = self._piece(t)
        by, angle = (
            np.polynomial.polynomial.polyval(float(since), np.array(c, np.complex128))
            for c in (piece.path, piece.angle)
        )
        rest = np.array([np.polynomial.polynomial.polyval(t, c) for c in self._rest])
        pivot = complex(self.pivot)
        places: Places = by + pivot + np.exp(1j * angle.real) * (rest - pivot)
        return places


def _rate(coefficients: list[Any], end: float) -> Real:
    """A bound on the speed along a polynomial, for times of at most this size."""
    return sum(k * abs(c) * end ** (k - 1) for k, c in enumerate(coefficients) if k)


def _coefficients(x: Polynomial, y: Polynomial) -> list[Any]:
    return [
        mpmath.mpc(*(real(f.coefficients[k]) if k <= f.degree else 0 for f in (x, y)))
        for k in range(max(x.degree, y.degree, 0) + 1)
    ]


@final
class Truth:
    """The true motion of a scene.

    Attributes:
        bodies: the bodies.
    """

    def __init__(self, scene: Scene) -> None:
        with mpmath.workdps(DIGITS + 20):
            self.start, self.end = real(scene.start), real(scene.end)
            last = max(abs(float(self.start)), abs(float(self.end)))
            self.bodies = [_Turning(body, last) for body in scene.bodies]

    def first_contact(self) -> Real:
        """The time of the first contact; None if there is none.

        Raises:
            UndecidedError: if bodies graze, or nearly.
        """
        with mpmath.workdps(DIGITS + 20):
            t, end = float(self.start), float(self.end)
            while True:
                step, gap = self._advance(t)
                if gap < 0 and t > float(self.start):
                    raise UndecidedError
                if gap < 0:
                    return self.start
                if gap >= NEAR:
                    t += step
                else:
                    found = self._root_after(t, min(t + TIME, end))
                    if found is not None:
                        return found
                    t += TIME
                if t > end:
                    return None

    def _advance(self, t: float) -> tuple[float, float]:
        """A time for which no bodies meet, and the least distance; -1 if bodies overlap."""
        places = [body.doubles(t) for body in self.bodies]
        step, least = np.inf, np.inf
        for i, j in combinations(range(len(self.bodies)), 2):
            a, b = self.bodies[i], self.bodies[j]
            gap = _distance(a, b, places[i], places[j]) - float(a.radius + b.radius)
            if gap < -1e-12 or _overlap(a, b, places[i], places[j]):
                return 0.0, -1.0
            least = min(least, gap)
            step = min(step, gap / max(a.speed + b.speed, 1e-300))
        return float(step), float(least)

    def approaches(self, t: float, within: float) -> Iterator[Approach]:
        """The pairs of a vertex and an edge or a vertex that are within a distance."""
        places = [body.doubles(t) for body in self.bodies]
        for i, j in product(range(len(self.bodies)), repeat=2):
            if i == j:
                continue
            a, b = self.bodies[i], self.bodies[j]
            reach = float(a.radius + b.radius) + within
            p, q = places[i], places[j]
            for e in b.edges:
                near = _from_segment(p, q[e[0]], q[e[1]]) <= reach
                for v in np.flatnonzero(near):
                    yield Approach(i, int(v), j, e)

    def gap(self, pair: Approach, t: Real) -> Real:
        """The distance of a vertex from the line of an edge, or from a vertex, less the radii.

        From a line, if there are no radii, it has a sign: that of the left of the edge.
        """
        a, b = self.bodies[pair.i], self.bodies[pair.j]
        v, (p, q) = a.places(t)[pair.vertex], (b.places(t)[k] for k in pair.ends)
        radius = a.radius + b.radius
        if pair.ends[0] == pair.ends[1]:
            return abs(v - p) - radius
        height = ((q - p).conjugate() * (v - p)).imag / abs(q - p)
        return abs(height) - radius if radius else height

    def _root_after(self, begin: float, end: float) -> Real:
        """The first time in a short interval at which a vertex comes to an edge or a vertex."""
        found = []
        seen: set[Approach] = set()
        for pair in self.approaches(begin, 100 * NEAR):
            ends = [pair.ends, *((k, k) for k in pair.ends)]
            seen.update(pair._replace(ends=e) for e in (ends if self._reach(pair) else ends[:1]))
        for pair in seen:
            low, high = self.gap(pair, mpmath.mpf(begin)), self.gap(pair, mpmath.mpf(end))
            if low * high > 0:
                continue
            t = mpmath.findroot(
                partial(self.gap, pair), (begin, end), solver="anderson",
                tol=mpmath.mpf(10) ** (-2 * DIGITS), maxsteps=200, verify=False,
            )  # fmt: skip
            if self._is_on(pair, t):
                found.append(t)
        return min(found, default=None)

    def _reach(self, pair: Approach) -> Real:
        return self.bodies[pair.i].radius + self.bodies[pair.j].radius

    def _is_on(self, pair: Approach, t: Real) -> bool:
        """Return True if the foot of the perpendicular is on the edge."""
        p, q = (self.bodies[pair.j].places(t)[k] for k in pair.ends)
        v = self.bodies[pair.i].places(t)[pair.vertex]
        along = ((q - p).conjugate() * (v - p)).real
        return bool(p == q or 0 <= along <= abs(q - p) ** 2)


def _from_segment(v: Places, a: Places, b: Places) -> NDArray[np.float64]:
    d = b - a
    length = abs(d) ** 2
    along = np.clip(((v - a) * np.conj(d)).real / length, 0, 1) if length else 0.0
    return np.abs(v - a - along * d)


def _distance(a: _Turning, b: _Turning, p: Places, q: Places) -> float:
    """The least distance of a vertex of one from an edge of the other."""
    return min(
        *(float(_from_segment(p, q[k], q[l]).min()) for k, l in b.edges),
        *(float(_from_segment(q, p[k], p[l]).min()) for k, l in a.edges),
    )


def _overlap(a: _Turning, b: _Turning, p: Places, q: Places) -> bool:
    """Return True if edges cross, or one core contains a part of the other."""
    for (i, j), (k, l) in product(a.edges, b.edges):
        if (
            _side(p[i], p[j], q[k]) * _side(p[i], p[j], q[l]) < 0
            and _side(q[k], q[l], p[i]) * _side(q[k], q[l], p[j]) < 0
        ):
            return True
    return any(_contains(b, q, p[v]) for v in a.starts) or any(
        _contains(a, p, q[v]) for v in b.starts
    )


def _contains(body: _Turning, places: Places, v: complex) -> bool:
    """Return True if a point is in a body: around it are an odd number of its rings."""
    around = [_winds(places[ring.start : ring.stop], v) for ring in body.rings]
    return sum(around) % 2 == 1


def _side(a: complex, b: complex, c: complex) -> float:
    return ((b - a).conjugate() * (c - a)).imag


def _winds(ring: Places, v: complex) -> bool:
    if v in ring:
        return False
    turned = np.angle((np.roll(ring, -1) - v) / (ring - v)).sum()
    return bool(abs(turned) > 3)
