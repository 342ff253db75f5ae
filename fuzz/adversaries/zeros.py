"""First zeros of pairs of features in a window, against motions that touch at a known time.

A row is a motion in rationals that touches at a rational s* in [-1, 1], and the doubles that stand
for it. Their errors are as large as the stated bounds allow, and often on the side that hides the
contact. So the polynomial as computed is off by its bound at s*, or nearly so. The filter must not
answer `NONE`, nor that the first zero is after s*. Where it is sure, the exact function has two
signs at the ends of its interval, and the foot is on the edge at both. The error is that of the
polynomial at s*, relative to its bound.

A zero is simple or double; or there are two zeros close together, at an end of [-1, 1], or at an
end of the edge, or the vertex moves along the edge and enters it there.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf
from random import Random
from typing import Final, NamedTuple

from librt.vecs import vec

from exactpt.filters.rounding import TINY, U
from exactpt.filters.zeros import NONE, SURE, Zero
from exactpt.kernel.numbers import QQ, enclosing_floats, nearest_float, of_double, sign
from fuzz.adversaries.report import Part, Report, run

__all__ = ["PARTS"]


class Vector(NamedTuple):
    """A point, or a vector between two, in rationals."""

    x: QQ
    y: QQ


class Coordinate(NamedTuple):
    """c0 + c1 s + c2 s^2."""

    c0: QQ
    c1: QQ
    c2: QQ

    def at(self, s: QQ) -> QQ:
        """Return the value at s."""
        return self.c0 + s * (self.c1 + s * self.c2)

    def slope_at(self, s: QQ) -> QQ:
        """Return the derivative at s."""
        return self.c1 + 2 * s * self.c2


class Moving(NamedTuple):
    """The coordinates of a vertex."""

    x: Coordinate
    y: Coordinate

    def at(self, s: QQ) -> Vector:
        """Return the place at s."""
        return Vector(self.x.at(s), self.y.at(s))


class Edge(NamedTuple):
    """An edge, and what it is at s*.

    Attributes:
        a, b: its ends.
        u: the vector from a to b at s*.
        length: the length of u.
    """

    a: Moving
    b: Moving
    u: Vector
    length: QQ


NOWHERE: Final = Vector(QQ(0), QQ(0))
LENGTHS: Final = ((3, 4, 5), (-4, 3, 5), (5, -12, 13), (1, 0, 1), (0, 1, 1), (-8, 15, 17))
"""Vectors of rational length, and these."""


def through(s: QQ, value: QQ, slope: QQ, bend: QQ) -> Coordinate:
    """Return the quadratic with a value and a slope at s, and a coefficient of s^2."""
    linear = slope - 2 * s * bend
    constant = value - s * (linear + s * bend)
    return Coordinate(constant, linear, bend)


def instant(rng: Random) -> QQ:
    """Return s* in [-1, 1]: an end, the middle, a place where halving stops, or any."""
    kind = rng.random()
    if kind < 0.3:
        return QQ(rng.choice([-1, 1]))
    if kind < 0.5:
        return QQ(rng.randint(-16, 16), 16)
    if kind < 0.6:
        return QQ(rng.choice([-1, 1])) * (1 - QQ(1, 2 ** rng.randint(20, 50)))
    return of_double(rng.uniform(-1.0, 1.0))


def number(rng: Random) -> QQ:
    """Return a number: 0, small and whole, a third, or any; rarely of another size."""
    kind = rng.random()
    if kind < 0.15:
        return QQ(0)
    if kind < 0.4:
        return QQ(rng.randint(-8, 8))
    if kind < 0.55:
        return QQ(rng.randint(-20, 20), rng.choice([3, 7, 10]))
    if kind < 0.9:
        return of_double(rng.uniform(-2.0, 2.0))
    return of_double(rng.uniform(-2.0, 2.0)) * QQ(2) ** rng.randint(-50, 50)


def upward(x: QQ) -> float:
    """Return a double that is not below a number."""
    return enclosing_floats(x)[1]


def row_of(v: Moving, off: Vector) -> tuple[list[float], QQ]:
    """Return the doubles that stand for a vertex, off by ``off``, and their largest error."""
    row: list[float] = []
    worst = QQ(0)
    for exact, off_by in zip(v, off, strict=True):
        aimed_at = exact.c0 - off_by, exact.c1, exact.c2
        near = [nearest_float(c) for c in aimed_at]
        worst = max(worst, error_of(near, exact))
        row += near
    return row, worst


def error_of(near: Sequence[float], exact: Sequence[QQ]) -> QQ:
    """Return a bound of the error of a polynomial in [-1, 1] whose coefficients are doubles."""
    errors = [abs(c - of_double(d)) for c, d in zip(exact, near, strict=True)]
    return sum(errors, QQ(0))


class Search:
    """A vertex v, the edge from a to b, and the distance at which they touch at s*."""

    def __init__(self, v: Moving, a: Moving, b: Moving, distance: QQ) -> None:
        self.v = v
        self.a = a
        self.b = b
        self.distance = distance

    def value(self, s: QQ, side: int) -> int:
        """Return the sign of u x z - side R |u| at s."""
        u, z = self._vectors_at(s)
        cross = u.x * z.y - u.y * z.x
        squared = self.distance**2 * (u.x * u.x + u.y * u.y)  # (R |u|)^2
        if not squared:
            return sign(cross)
        order = sign(cross * cross - squared)  # of |u x z| and R |u|
        if side > 0:
            return order if cross > 0 else -1
        return -order if cross < 0 else 1

    def has_foot(self, s: QQ) -> bool:
        """Return whether the foot of the vertex is on the edge at s."""
        u, z = self._vectors_at(s)
        along = u.x * z.x + u.y * z.y
        return 0 <= along <= u.x * u.x + u.y * u.y

    def _vectors_at(self, s: QQ) -> tuple[Vector, Vector]:
        """Return u, from a to b, and z, from a to the vertex, at s."""
        a = self.a.at(s)
        b = self.b.at(s)
        v = self.v.at(s)
        return Vector(b.x - a.x, b.y - a.y), Vector(v.x - a.x, v.y - a.y)


def polynomial_at(zero: Zero, s: QQ) -> QQ:
    """Return the polynomial as computed, at s."""
    f = QQ(0)
    for c in (zero.f4, zero.f3, zero.f2, zero.f1, zero.f0):
        f = f * s + of_double(c)
    return f


def judge(
    report: Report,
    zero: Zero,
    s: QQ,
    value: Callable[[QQ], int],
    foot: Callable[[QQ], bool] | None,
    what: object,
) -> None:
    """Check the answer of a filter for a function that vanishes at s."""
    if zero.error < inf:
        report.measure(nearest_float(abs(polynomial_at(zero, s)) / of_double(zero.error)))
    else:
        report.rows += 1
    state = zero.find()
    if state == NONE:
        report.wrong.append(f"none: {what} s = {s}")
        return
    report.count("sure" if state == SURE else "maybe")
    if not of_double(zero.low) <= s:
        report.wrong.append(f"after: {zero.low} {what} s = {s}")
    if state == SURE:
        low, high = of_double(zero.low), of_double(zero.high)
        is_sure = low <= s <= high or value(low) * value(high) <= 0
        if is_sure and foot is not None:
            is_sure = foot(low) and foot(high)
        if not is_sure:
            report.wrong.append(f"not sure: [{zero.low}, {zero.high}] {what} s = {s}")


# Polynomials


def expanded(roots: list[QQ], factor: QQ) -> list[QQ]:
    """Return the coefficients of factor (s - r1) (s - r2) ..., five of them."""
    f = [factor]
    for root in roots:
        times_s = [QQ(0), *f]
        times_root = [root * c for c in f] + [QQ(0)]
        f = [a - b for a, b in zip(times_s, times_root, strict=True)]
    return f + [QQ(0)] * (5 - len(f))


def value_at(f: Sequence[QQ], s: QQ) -> QQ:
    """Return a polynomial at s."""
    return sum((c * s**k for k, c in enumerate(f)), QQ(0))


def polynomials(rows: int, seed: int) -> Report:
    """Check polynomials of degree 4 without a foot: simple, double, quadruple and close roots."""
    report, rng, zero = Report(), Random(seed), Zero()
    while report.rows < rows:
        s = instant(rng)
        kind = rng.choice(["simple", "double", "double", "close", "four", "sum", "sum"])
        if kind == "sum":
            f = [QQ(0), *(number(rng) * rng.choice([1, 1, 8]) for _ in range(4))]
            f[0] = -value_at(f, s)
        else:
            near = s + QQ(rng.choice([-1, 1]), 2 ** rng.randint(1, 50))
            roots = {"simple": [s], "double": [s] * 2, "close": [s, near], "four": [s] * 4}[kind]
            roots += [number(rng) for _ in range(rng.randint(0, 4 - len(roots)))]
            f = expanded(roots, number(rng) or QQ(1))
        if not any(f):
            continue
        size = sum(map(abs, f))
        off = size * rng.choice([QQ(0), QQ(0), QQ(1, 2 ** rng.randint(20, 60))])
        off *= rng.choice([-1, 1])
        near_f = [nearest_float(f[0] - off), *map(nearest_float, f[1:])]
        set_polynomial(zero, f, near_f)

        def value(t: QQ, f: list[QQ] = f) -> int:
            return sign(value_at(f, t))

        judge(report, zero, s, value, None, (kind, near_f, zero.error))
    return report


def set_polynomial(zero: Zero, f: list[QQ], near: list[float]) -> None:
    """Set a polynomial as computed, and the bound of its error."""
    zero.f0, zero.f1, zero.f2, zero.f3, zero.f4 = near
    zero.error = upward(error_of(near, f)) + TINY
    zero.has_foot = False


def misses(rows: int, seed: int) -> Report:
    """Check polynomials without a zero in [-1, 1]: none is sure.

    A row is c (s - s*)^2 (1 + d (s - q)^2) + lift, or c (s - r) (1 + d (s - q)^2) with r beside
    [-1, 1]. As computed it is off by its error, to the other side, and often has a zero. The error
    in the table is the least size of the polynomial, relative to the bound: about 2.5 at most.
    """
    report, rng, zero = Report(), Random(seed), Zero()
    while report.rows < rows:
        s = instant(rng)
        q = number(rng)
        scale = abs(number(rng)) or QQ(1)
        small = QQ(rng.randint(1, 10**6), 2 ** rng.randint(20, 60))
        bend = scale * rng.choice([0, 1])
        if rng.random() < 0.5:
            end = rng.choice([-1, 1])
            roots = [end * (1 + small)]
            f = added(expanded(roots, scale), expanded([*roots, q, q], bend))
            least = value_at(f, QQ(end))
        else:
            f = added(expanded([s, s], scale), expanded([s, s, q, q], bend))
            least = sum(map(abs, f)) * small
            f[0] += least
        off = least * QQ(rng.randint(40, 300), 100)
        near = [nearest_float(f[0] - off), *map(nearest_float, f[1:])]
        set_polynomial(zero, f, near)
        report.measure(nearest_float(abs(least) / of_double(zero.error)))
        state = zero.find()
        report.count({int(NONE): "none", int(SURE): "sure"}.get(state, "maybe"))
        if state == SURE:
            report.wrong.append(f"not sure: [{zero.low}, {zero.high}] {near} {zero.error} s = {s}")
    return report


def added(f: list[QQ], g: list[QQ]) -> list[QQ]:
    """Return the coefficients of a sum."""
    return [a + b for a, b in zip(f, g, strict=True)]


# Pairs of features


def edge(rng: Random, s: QQ, *, is_rigid: bool) -> Edge:
    """Return an edge of rational length at s."""
    scale = abs(number(rng)) or QQ(1)
    x, y, length = rng.choice(LENGTHS)
    u = Vector(x * scale, y * scale)
    change = rng.choice([QQ(1), QQ(1, 2 ** rng.randint(0, 40))])

    def of_a() -> Coordinate:
        """Return a coordinate of one end."""
        return through(s, number(rng), number(rng) * change, number(rng) * change**2)

    def of_b(a: Coordinate, along: QQ) -> Coordinate:
        """Return a coordinate that is ``along`` more at s; the edge keeps that or changes it."""
        faster = QQ(0) if is_rigid else number(rng) * change
        bends = QQ(0) if is_rigid else number(rng) * change
        return through(s, a.at(s) + along, a.slope_at(s) + faster, a.c2 + bends)

    a = Moving(of_a(), of_a())
    b = Moving(of_b(a.x, u.x), of_b(a.y, u.y))
    return Edge(a, b, u, length * scale)


def vertex(rng: Random, s: QQ, a: Moving, u: Vector, foot: QQ, away: Vector) -> Moving:
    """Return a vertex that is beside an edge at s: a + foot u + away; it crosses or goes along."""
    end = a.at(s)
    at_s = Vector(end.x + foot * u.x + away.x, end.y + foot * u.y + away.y)
    velocity = Vector(a.x.slope_at(s), a.y.slope_at(s))
    bend = Vector(a.x.c2, a.y.c2)
    along = number(rng)
    change = rng.choice([QQ(1), QQ(1, 2 ** rng.randint(0, 40))])
    how = rng.choice(["crosses", "crosses", "touches", "along", "at rest"])
    if how == "crosses":
        velocity = small_vector(rng, change)
        bend = small_vector(rng, change)
    elif how in {"touches", "along"}:
        velocity = Vector(
            velocity.x + along * u.x * change,
            velocity.y + along * u.y * change,
        )
    if how == "touches":
        bend = small_vector(rng, change)
    return Moving(
        through(s, at_s.x, velocity.x, bend.x),
        through(s, at_s.y, velocity.y, bend.y),
    )


def small_vector(rng: Random, size: QQ) -> Vector:
    """Return two numbers times a size."""
    return Vector(number(rng) * size, number(rng) * size)


class Offsets(NamedTuple):
    """What the rows of a vertex and of the ends of an edge are off."""

    v: Vector
    a: Vector
    b: Vector


def offsets(rng: Random, u: Vector, z: Vector, reach: QQ) -> Offsets:
    """Return errors of v, a and b; often those that change u x z the most.

    u x z = u_x z_y - u_y z_x grows most if z goes by the signs of (-u_y, u_x), and u by those of
    (z_y, -z_x). z is v - a, and u is b - a, of which the end b is moved alone.
    """
    size = rng.choice([QQ(0), QQ(1, 2 ** rng.randint(8, 60)), QQ(1, 2 ** rng.randint(40, 60))])
    size *= reach
    if rng.random() < 0.3:
        signs = [rng.choice([-1, 1]) for _ in range(6)]
    else:
        side = rng.choice([-1, 1])
        z_x = -side * (sign(u.y) or 1)
        z_y = side * (sign(u.x) or 1)
        u_x = side * (sign(z.y) or 1)
        u_y = -side * (sign(z.x) or 1)
        signs = [z_x, z_y, -z_x, -z_y, u_x, u_y]
    v_x, v_y, a_x, a_y, b_x, b_y = signs
    size_of_v = rng.choice([QQ(0), size])
    return Offsets(
        v=Vector(size_of_v * v_x, size_of_v * v_y),
        a=Vector(size * a_x, size * a_y),
        b=Vector(size * b_x, size * b_y),
    )


def set_vectors(zero: Zero, search: Search, off: Offsets) -> None:
    """Set z and u as computed, with the errors of rows."""
    v, v_error = row_of(search.v, off.v)
    a, a_error = row_of(search.a, off.a)
    b, b_error = row_of(search.b, off.b)
    v_rho = upward(v_error)
    edge_rho = upward(max(a_error, b_error))
    of_vertex = vec[float](v)
    of_edge = vec[float](a + b)
    zero.z.set(of_vertex, 0, of_edge, 0, v_rho + edge_rho)
    zero.u.set(of_edge, 1, of_edge, 0, 2.0 * edge_rho)


def distance_of(rng: Random) -> tuple[QQ, QQ]:
    """Return a distance, a double, and the true one that it stands for: 5 U of it off or less."""
    distance = of_double(nearest_float(abs(number(rng)) or QQ(1)))
    units = rng.choice([0, 5, rng.randint(0, 5)])
    return distance, distance / (1 + of_double(U) * units)


def size_of(v: Vector) -> QQ:
    """Return the sum of the sizes of the coordinates."""
    return abs(v.x) + abs(v.y)


def foot_of(rng: Random) -> QQ:
    """Return where on the edge the foot is, from 0 to 1: often at an end."""
    return rng.choice([QQ(0), QQ(1), QQ(1, 2), QQ(1, 2 ** rng.randint(1, 60)), QQ(1, 3)])


def orientations(rows: int, seed: int) -> Report:
    """Check vertices on edges."""
    report, rng, zero = Report(), Random(seed), Zero()
    while report.rows < rows:
        s = instant(rng)
        a, b, u, _ = edge(rng, s, is_rigid=rng.random() < 0.5)
        foot = foot_of(rng)
        v = vertex(rng, s, a, u, foot, NOWHERE)
        search = Search(v, a, b, QQ(0))
        z = Vector(foot * u.x, foot * u.y)
        set_vectors(zero, search, offsets(rng, u, z, size_of(u)))
        zero.orientation()

        def value(t: QQ, search: Search = search) -> int:
            return search.value(t, 1)

        judge(report, zero, s, value, search.has_foot, vars(search))
    return report


def distances(rows: int, seed: int) -> Report:
    """Check vertices at a distance of edges: R is off by up to 5 U of it, more than a table is."""
    report, rng, zero = Report(), Random(seed), Zero()
    while report.rows < rows:
        s = instant(rng)
        is_rigid = rng.random() < 0.6
        a, b, u, length = edge(rng, s, is_rigid=is_rigid)
        foot = foot_of(rng)
        side = rng.choice([-1, 1])
        distance, exact = distance_of(rng)
        away = Vector(-side * exact * u.y / length, side * exact * u.x / length)
        v = vertex(rng, s, a, u, foot, away)
        search = Search(v, a, b, exact)
        z = Vector(foot * u.x + away.x, foot * u.y + away.y)
        set_vectors(zero, search, offsets(rng, u, z, size_of(u)))
        zero.orientation()
        zero.subtract_length(side * nearest_float(distance), is_rigid=is_rigid)

        def value(t: QQ, search: Search = search, side: int = side) -> int:
            return search.value(t, side)

        judge(report, zero, s, value, search.has_foot, (vars(search), side))
    return report


def vertices(rows: int, seed: int) -> Report:
    """Check vertices at a distance of vertices."""
    report, rng, zero = Report(), Random(seed), Zero()
    while report.rows < rows:
        s = instant(rng)
        distance, exact = distance_of(rng)
        x, y, length = rng.choice(LENGTHS)
        away = Vector(exact * x / length, exact * y / length)
        a, b, _, _ = edge(rng, s, is_rigid=True)
        across = Vector(QQ(-y, length), QQ(x, length))  # along it, the vertex passes by
        v = vertex(rng, s, a, across, QQ(0), away)
        search = Search(v, a, b, exact)
        off = offsets(rng, Vector(-away.y, away.x), NOWHERE, size_of(away))
        set_vectors(zero, search, off)
        zero.squared_distance(nearest_float(distance))

        def value(t: QQ, v: Moving = v, a: Moving = a, exact: QQ = exact) -> int:
            p = v.at(t)
            q = a.at(t)
            return sign((p.x - q.x) ** 2 + (p.y - q.y) ** 2 - exact**2)

        judge(report, zero, s, value, None, vars(search))
    return report


PARTS: Final[dict[str, Part]] = {
    "polynomials": polynomials,
    "misses": misses,
    "orientations": orientations,
    "distances": distances,
    "vertices": vertices,
}

if __name__ == "__main__":
    run(PARTS, __doc__ or "")
