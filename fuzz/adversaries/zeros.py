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

from collections.abc import Callable
from math import inf
from random import Random
from typing import Final, TypeAlias

from librt.vecs import vec

from exactpt.filters.rounding import TINY, U
from exactpt.filters.zeros import NONE, SURE, Zero
from exactpt.kernel.numbers import QQ, enclosing_floats, nearest_float, of_double, sign
from fuzz.adversaries.report import Part, Report, run

__all__ = ["PARTS"]

Coordinate: TypeAlias = tuple[QQ, QQ, QQ]
"""The coefficients of 1, s, s^2."""
Moving: TypeAlias = tuple[Coordinate, Coordinate]
"""x and y of a vertex."""

LENGTHS: Final = ((3, 4, 5), (-4, 3, 5), (5, -12, 13), (1, 0, 1), (0, 1, 1), (-8, 15, 17))
"""Vectors of rational length, and these."""


def at(f: Coordinate, s: QQ) -> QQ:
    """Return a coordinate at s."""
    return f[0] + s * (f[1] + s * f[2])


def place(v: Moving, s: QQ) -> tuple[QQ, QQ]:
    """Return the place of a vertex at s."""
    return at(v[0], s), at(v[1], s)


def through(s: QQ, value: QQ, slope: QQ, bend: QQ) -> Coordinate:
    """Return the quadratic with a value and a slope at s, and a coefficient of s^2."""
    linear = slope - 2 * s * bend
    return value - s * (linear + s * bend), linear, bend


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


def row_of(v: Moving, off: tuple[QQ, QQ]) -> tuple[list[float], QQ]:
    """Return the doubles that stand for a vertex, off by ``off``, and their largest error."""
    row, worst = list[float](), QQ(0)
    for (c0, c1, c2), o in zip(v, off, strict=True):
        near = [nearest_float(c0 - o), nearest_float(c1), nearest_float(c2)]
        errors = [abs(c - of_double(d)) for c, d in zip((c0, c1, c2), near, strict=True)]
        row += near
        worst = max(worst, sum(errors, QQ(0)))
    return row, worst


class Search:
    """A vertex v, the edge from a to b, and the distance at which they touch at s*."""

    def __init__(self, v: Moving, a: Moving, b: Moving, distance: QQ) -> None:
        self.v = v
        self.a = a
        self.b = b
        self.distance = distance

    def value(self, s: QQ, side: int) -> int:
        """Return the sign of u x z - side R |u| at s."""
        (ax, ay), (bx, by), (vx, vy) = (place(p, s) for p in (self.a, self.b, self.v))
        ux, uy = bx - ax, by - ay
        f = ux * (vy - ay) - uy * (vx - ax)
        line = self.distance**2 * (ux * ux + uy * uy)
        if not line:
            return sign(f)
        order = sign(f * f - line)  # of |f| and R |u|
        if side > 0:
            return order if f > 0 else -1
        return -order if f < 0 else 1

    def has_foot(self, s: QQ) -> bool:
        """Return whether the foot of the vertex is on the edge at s."""
        (ax, ay), (bx, by), (vx, vy) = (place(p, s) for p in (self.a, self.b, self.v))
        ux, uy = bx - ax, by - ay
        along = ux * (vx - ax) + uy * (vy - ay)
        return 0 <= along <= ux * ux + uy * uy


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
    for r in roots:
        f = [QQ(0), *f]
        for k in range(len(f) - 1):
            f[k] -= r * f[k + 1]
    return f + [QQ(0)] * (5 - len(f))


def polynomials(rows: int, seed: int) -> Report:
    """Check polynomials of degree 4 without a foot: simple, double, quadruple and close roots."""
    report, rng, zero = Report(), Random(seed), Zero()
    while report.rows < rows:
        s = instant(rng)
        kind = rng.choice(["simple", "double", "double", "close", "four", "sum", "sum"])
        if kind == "sum":
            f = [QQ(0), *(number(rng) * rng.choice([1, 1, 8]) for _ in range(4))]
            f[0] = -sum((f[k] * s**k for k in range(1, 5)), QQ(0))
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
            return sign(sum((c * t**k for k, c in enumerate(f)), QQ(0)))

        judge(report, zero, s, value, None, (kind, near_f, zero.error))
    return report


def set_polynomial(zero: Zero, f: list[QQ], near: list[float]) -> None:
    """Set a polynomial as computed, and the bound of its error."""
    zero.f0, zero.f1, zero.f2, zero.f3, zero.f4 = near
    errors = [abs(c - of_double(d)) for c, d in zip(f, near, strict=True)]
    zero.error = upward(sum(errors, QQ(0))) + TINY
    zero.has_foot = False


def misses(rows: int, seed: int) -> Report:
    """Check polynomials without a zero in [-1, 1]: none is sure.

    A row is c (s - s*)^2 (1 + d (s - q)^2) + lift, or c (s - r) (1 + d (s - q)^2) with r beside
    [-1, 1]. As computed it is off by its error, to the other side, and often has a zero. The error
    in the table is the least size of the polynomial, relative to the bound: about 2.5 at most.
    """
    report, rng, zero = Report(), Random(seed), Zero()
    while report.rows < rows:
        s, q, scale = instant(rng), number(rng), abs(number(rng)) or QQ(1)
        small = QQ(rng.randint(1, 10**6), 2 ** rng.randint(20, 60))
        bend = scale * rng.choice([0, 1])
        if rng.random() < 0.5:
            end = rng.choice([-1, 1])
            roots = [end * (1 + small)]
            f = added(expanded(roots, scale), expanded([*roots, q, q], bend))
            least = sum((c * end**k for k, c in enumerate(f)), QQ(0))
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


def edge(rng: Random, s: QQ, *, is_rigid: bool) -> tuple[Moving, Moving, tuple[QQ, QQ], QQ]:
    """Return two ends of an edge, the edge at s and its length there."""
    scale = abs(number(rng)) or QQ(1)
    x, y, length = rng.choice(LENGTHS)
    ux, uy = x * scale, y * scale
    change = rng.choice([QQ(1), QQ(1, 2 ** rng.randint(0, 40))])
    a = tuple(through(s, number(rng), number(rng) * change, number(rng) * change**2) for _ in "xy")
    grow = [QQ(0)] * 4 if is_rigid else [number(rng) * change for _ in range(4)]
    b = (
        through(s, at(a[0], s) + ux, a[0][1] + 2 * s * a[0][2] + grow[0], a[0][2] + grow[1]),
        through(s, at(a[1], s) + uy, a[1][1] + 2 * s * a[1][2] + grow[2], a[1][2] + grow[3]),
    )
    return (a[0], a[1]), b, (ux, uy), length * scale


def vertex(
    rng: Random, s: QQ, a: Moving, u: tuple[QQ, QQ], foot: QQ, away: tuple[QQ, QQ]
) -> Moving:
    """Return a vertex that is beside an edge at s: a + foot u + away; it crosses or goes along."""
    x, y = at(a[0], s) + foot * u[0] + away[0], at(a[1], s) + foot * u[1] + away[1]
    vx, vy = (c[1] + 2 * s * c[2] for c in a)
    bend_x, bend_y = a[0][2], a[1][2]
    along = number(rng)
    change = rng.choice([QQ(1), QQ(1, 2 ** rng.randint(0, 40))])
    how = rng.choice(["crosses", "crosses", "touches", "along", "at rest"])
    if how == "crosses":
        vx, vy = number(rng) * change, number(rng) * change
        bend_x, bend_y = number(rng) * change, number(rng) * change
    elif how != "at rest":
        vx, vy = vx + along * u[0] * change, vy + along * u[1] * change
        if how == "touches":
            bend_x, bend_y = number(rng) * change, number(rng) * change
    return through(s, x, vx, bend_x), through(s, y, vy, bend_y)


def offsets(rng: Random, u: tuple[QQ, QQ], z: tuple[QQ, QQ], reach: QQ) -> list[tuple[QQ, QQ]]:
    """Return errors of v, a and b, in x and in y; often those that change u x z the most."""
    size = rng.choice([QQ(0), QQ(1, 2 ** rng.randint(8, 60)), QQ(1, 2 ** rng.randint(40, 60))])
    size *= reach
    if rng.random() < 0.3:
        signs = [rng.choice([-1, 1]) for _ in range(6)]
    else:
        side = rng.choice([-1, 1])
        dz = -side * (sign(u[1]) or 1), side * (sign(u[0]) or 1)
        du = side * (sign(z[1]) or 1), -side * (sign(z[0]) or 1)
        signs = [*dz, -dz[0], -dz[1], *du]
    p, q = rng.choice([QQ(0), size]), size
    off = [error * side for error, side in zip((p, p, q, q, q, q), signs, strict=True)]
    return [(off[0], off[1]), (off[2], off[3]), (off[4], off[5])]


def set_vectors(zero: Zero, search: Search, offs: list[tuple[QQ, QQ]]) -> tuple[float, float]:
    """Set z and u as computed, with the errors of rows; return both rho."""
    v, v_error = row_of(search.v, offs[0])
    a, a_error = row_of(search.a, offs[1])
    b, b_error = row_of(search.b, offs[2])
    p_rho, q_rho = upward(v_error), upward(max(a_error, b_error))
    q = vec[float](a + b)
    zero.z.set(vec[float](v), 0, q, 0, p_rho + q_rho)
    zero.u.set(q, 1, q, 0, 2.0 * q_rho)
    return p_rho, q_rho


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
        v = vertex(rng, s, a, u, foot, (QQ(0), QQ(0)))
        search = Search(v, a, b, QQ(0))
        z = foot * u[0], foot * u[1]
        set_vectors(zero, search, offsets(rng, u, z, abs(u[0]) + abs(u[1])))
        zero.orientation()

        def value(t: QQ, search: Search = search) -> int:
            return search.value(t, 1)

        judge(report, zero, s, value, search.has_foot, vars(search))
    return report


def distances(rows: int, seed: int) -> Report:
    """Check vertices at a distance of edges: R is off by up to 5 U of it, more than a table is."""
    report, rng, zero = Report(), Random(seed), Zero()
    while report.rows < rows:
        s, is_rigid = instant(rng), rng.random() < 0.6
        a, b, u, length = edge(rng, s, is_rigid=is_rigid)
        foot, side = foot_of(rng), rng.choice([-1, 1])
        distance = of_double(nearest_float(abs(number(rng)) or QQ(1)))
        exact = distance / (1 + of_double(U) * rng.choice([0, 5, rng.randint(0, 5)]))
        away = -side * exact * u[1] / length, side * exact * u[0] / length
        v = vertex(rng, s, a, u, foot, away)
        search = Search(v, a, b, exact)
        z = foot * u[0] + away[0], foot * u[1] + away[1]
        set_vectors(zero, search, offsets(rng, u, z, abs(u[0]) + abs(u[1])))
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
        distance = of_double(nearest_float(abs(number(rng)) or QQ(1)))
        exact = distance / (1 + of_double(U) * rng.choice([0, 5, rng.randint(0, 5)]))
        x, y, length = rng.choice(LENGTHS)
        away = exact * x / length, exact * y / length
        a, b, _, _ = edge(rng, s, is_rigid=True)
        across = -away[1] / (exact or 1), away[0] / (exact or 1)  # it passes at the distance
        v = vertex(rng, s, a, across, QQ(0), away)
        search = Search(v, a, b, exact)
        offs = offsets(rng, (-away[1], away[0]), (QQ(0), QQ(0)), abs(away[0]) + abs(away[1]))
        set_vectors(zero, search, offs)
        zero.squared_distance(nearest_float(distance))

        def value(t: QQ, v: Moving = v, a: Moving = a, exact: QQ = exact) -> int:
            (px, py), (qx, qy) = place(v, t), place(a, t)
            return sign((px - qx) ** 2 + (py - qy) ** 2 - exact**2)

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
