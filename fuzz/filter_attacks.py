"""Hostile cases for the float filters, and the exact judge of their answers.

A case is a true polynomial, doubles near its coefficients with bounds on their errors,
a time now with an enclosure, and a horizon. Whatever a filter decides must hold for the
true polynomial; the judge asks the exact kernel, which is itself tested against SymPy.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import lcm
from random import Random
from typing import Any, Final, TypeAlias

import numpy as np

from exactpt.certificates import first_root as filters
from exactpt.kernel import vectorized
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly, primitive, sign_at, trimmed
from exactpt.kernel.numbers import (
    QQ,
    ZZ,
    enclosing_floats,
    nearest_float,
    power_of_two,
    rational,
)
from exactpt.kernel.roots import roots_after
from exactpt.kernel.sturm import cauchy_bound, count_roots, sturm_sequence

__all__ = [
    "Case",
    "answer",
    "answers",
    "as_primitive",
    "asked",
    "certificate",
    "extreme",
    "generic",
    "hostile",
    "judge",
    "times",
    "variants",
]

Made: TypeAlias = tuple[list[QQ], list[QQ]]
"""A polynomial, and its roots or times of interest."""

SMALLEST, LARGEST = 2.0**-460, 2.0**460
ULP = 2.0**-52


@dataclass(frozen=True)
class Case:
    """``true[i]`` lies in [c[i] - e[i], c[i] + e[i]]; ``now`` in [now_low, now_high]."""

    true: tuple[QQ, ...]
    c: tuple[float, ...]
    e: tuple[float, ...]
    now: QQ | AlgebraicNumber
    now_low: float
    now_high: float
    horizon: float
    at_root: bool

    def instant(self) -> AlgebraicNumber:
        """Now, as a number whose refinement nobody shares."""
        if isinstance(self.now, AlgebraicNumber):
            return AlgebraicNumber.root(self.now.polynomial, self.now.low, self.now.high)
        return AlgebraicNumber(self.now)

    def to_json(self) -> dict[str, object]:
        """Return the case as a JSON object; rationals and numbers as text."""
        return {
            "true": list(map(str, self.true)),
            "c": self.c,
            "e": self.e,
            "now": str(self.now),
            "enclosure": [self.now_low, self.now_high],
            "horizon": self.horizon,
            "at_root": self.at_root,
        }


def as_primitive(coefficients: Sequence[QQ]) -> IntPoly:
    """Return the kernel's primitive positive multiple of a polynomial over the rationals."""
    denominator = ZZ(lcm(*(int(c.denominator) for c in coefficients)))
    return primitive(trimmed(ZZ(c * denominator) for c in coefficients))


def answer(case: Case) -> filters.Answer:
    """Return the result of the filter of the case's degree."""
    c, e, times = case.c, case.e, (case.now_low, case.now_high, case.horizon)
    if len(c) == 2:
        return filters.linear(c[0], c[1], e[0], e[1], *times, case.at_root)
    if len(c) == 3:
        return filters.quadratic(c[0], c[1], c[2], e[0], e[1], e[2], *times, case.at_root)
    return filters.polynomial(list(c), list(e), *times, case.at_root)


def answers(cases: Sequence[Case]) -> list[filters.Answer]:
    """Return the results of the filters in arrays for cases of one degree, 1 or 2."""
    columns = [np.array(c) for c in zip(*(case.c + case.e for case in cases), strict=True)]
    times = [np.array([getattr(q, k) for q in cases]) for k in ("now_low", "now_high", "horizon")]
    ask: Any = vectorized.linears if len(columns) == 4 else vectorized.quadratics
    said = ask(*columns, *times, np.array([case.at_root for case in cases]))
    return [tuple(row) for row in zip(*(column.tolist() for column in said), strict=True)]


def judge(case: Case, said: filters.Answer) -> str:
    """Return the fault of an answer; empty if it is right."""
    s, low, high = said
    if s == 0:
        return ""
    f, now = as_primitive(case.true), case.instant()
    expected = now.sign_after(f)
    if s != expected:
        return f"sign {s}, not {expected}"
    horizon = rational(case.horizon)
    if math.isinf(low):
        root = next(roots_after(f, now, horizon), None)
        return "" if root is None else f"no root, but there is one near {float(root.time)!r}"
    if math.isinf(high):
        high = 2.0 * max(abs(low), abs(case.horizon), 1.0)
    root = next(roots_after(f, now, max(horizon, rational(high))), None)
    if root is None:
        return f"a root in [{low!r}, {high!r}], but there is none"
    if not rational(low) <= root.time <= rational(high):
        return f"the root in [{low!r}, {high!r}], but it is near {float(root.time)!r}"
    if not root.crossing:
        return "a crossing, but the root is even"
    alone = count_roots(sturm_sequence(f), rational(low), rational(high)) <= 1
    if not alone or (root.time != rational(low) and sign_at(f, rational(low)) == 0):
        return f"the root in [{low!r}, {high!r}], but another one is there too"
    return ""


# Hostile cases


def hostile(rng: Random, degree: int) -> Case:
    """A case of the degree: structure, scales, roundings, now and horizon chosen to hurt."""
    make = rng.choice(_MAKERS)
    true, roots = make(rng, degree)
    true, roots = _rescaled(rng, true, roots)
    c, e = _image(rng, true)
    return asked(rng, true, roots, c, e)


def asked(
    rng: Random, true: Sequence[QQ], roots: Sequence[QQ], c: tuple[float, ...], e: tuple[float, ...]
) -> Case:
    """The question about a polynomial: now and a horizon, next to its roots or anywhere."""
    now = _now(rng, true, roots)
    number = AlgebraicNumber(now) if not isinstance(now, AlgebraicNumber) else now
    now_low, now_high = number.enclosure()
    for _ in range(rng.choice([0, 0, 0, 1, 3, 40])):
        now_low = math.nextafter(now_low, -math.inf)
    for _ in range(rng.choice([0, 0, 0, 1, 3, 40])):
        now_high = math.nextafter(now_high, math.inf)
    if rng.random() < 0.1:
        width = 2.0 ** -rng.randint(0, 40)
        now_low, now_high = now_low - width * rng.random(), now_high + width * rng.random()
    vanishes = number.sign_of(as_primitive(true)) == 0 and any(true)
    at_root = vanishes and rng.random() < 0.7
    horizon = _horizon(rng, number, now_low, now_high, roots)
    return Case(tuple(true), c, e, now, now_low, now_high, horizon, at_root)


def variants(rng: Random, case: Case, said: filters.Answer) -> Iterator[Case]:
    """The same question for other polynomials in the box: corners that push roots the most.

    At a point x the polynomial is pushed up by the corner with the signs of x^i. Where
    it must vanish now, the constant term is chosen so that it does (if the box allows).
    """
    if said[0] == 0 or not any(case.e):
        return
    points = [x for x in (case.now_low, case.now_high, said[1], said[2]) if math.isfinite(x)]
    for x in {rng.choice(points), rng.choice(points)}:
        for up in (1, -1):
            true = []
            for i, (a, b) in enumerate(zip(case.c, case.e, strict=True)):
                side = up if x >= 0 or i % 2 == 0 else -up
                true.append(rational(a) + side * rational(b))
            if case.at_root:
                if isinstance(case.now, AlgebraicNumber):
                    return
                rest = QQ(0)
                for q in reversed(true[1:]):
                    rest = (rest + q) * case.now
                true[0] = -rest
                if abs(true[0] - rational(case.c[0])) > rational(case.e[0]):
                    continue
            yield replace(case, true=tuple(true))


def _dyadic(rng: Random, bits: int = 20) -> QQ:
    return QQ(rng.randint(-(2**bits), 2**bits), 2 ** rng.randint(0, bits))


def _small_integers(rng: Random, degree: int) -> Made:
    f = [QQ(rng.randint(-4, 4)) for _ in range(degree + 1)]
    return f, [QQ(rng.randint(-4, 4))]


def _with_roots(rng: Random, degree: int) -> Made:
    """Roots in a cluster 2^-k wide, complex pairs near the real line, others anywhere."""
    centre = rng.choice([QQ(0), QQ(1), QQ(rng.randint(-9, 9), rng.randint(1, 9)), _dyadic(rng)])
    width = power_of_two(-rng.choice([2, 10, 24, 25, 26, 27, 28, 48, 50, 52, 53, 54, 60, 100]))
    f, roots = [rng.choice([QQ(1), QQ(-1), QQ(3), QQ(-1, 3), _dyadic(rng) or QQ(1)])], []
    while len(f) <= degree:
        kind = rng.random()
        if kind < 0.25 and len(f) < degree:
            r, s = centre + rng.randint(-1, 1) * width, width * rng.randint(0, 2)
            f = times(f, [r * r + s * s, -2 * r, QQ(1)])
            roots.append(r)
        else:
            far = rng.random() < 0.4
            r = _dyadic(rng, 6) if far else centre + rng.randint(-3, 3) * width
            f = times(f, [-r, QQ(1)])
            roots.append(r)
    return f, roots


def _flat(rng: Random, degree: int) -> Made:
    """Leading or constant coefficients that nearly or quite vanish."""
    f, roots = _with_roots(rng, degree)
    for i in rng.sample(range(degree + 1), rng.randint(1, 2)):
        f[i] *= rng.choice([QQ(0), power_of_two(-50), power_of_two(-53), power_of_two(-90)])
    return f, roots


def _nearly_double(rng: Random, degree: int) -> Made:
    """A quadratic factor whose discriminant is a few units in the last place off zero."""
    c1 = rational(rng.uniform(-2, 2)) or QQ(1)
    c2 = rational(rng.uniform(0.01, 2) * rng.choice([1, -1]))
    c0 = nearest_float(c1 * c1 / (4 * c2))
    for _ in range(rng.randint(0, 3)):
        c0 = math.nextafter(c0, rng.choice([math.inf, -math.inf]))
    f, roots = [rational(c0), c1, c2], [-c1 / (2 * c2)]
    if degree == 1:
        return [c1, c2], [-c1 / c2]
    while len(f) <= degree:
        r = _dyadic(rng, 6)
        f = times(f, [-r, QQ(1)])
        roots.append(r)
    return f, roots


def _wide(rng: Random, degree: int) -> Made:
    """Doubles of any size."""
    f = [
        rational(rng.uniform(-1, 1) * 2.0 ** rng.randint(-98, 98)) * (rng.random() < 0.8)
        for _ in range(degree + 1)
    ]
    return f, [_dyadic(rng)]


def _certificate(rng: Random, degree: int) -> Made:
    """The orientation of three points on polynomial paths, nearly or quite collinear."""
    d = max(1, degree // 2)
    f = certificate(rng, d, grid=rng.choice([2, 4, 1000, 2**26]), collinear=rng.random() < 0.5)
    f = (f + [QQ(0)] * (degree + 1))[: degree + 1]
    return f, [QQ(rng.randint(0, 5))]


_MAKERS: Final[list[Callable[[Random, int], Made]]] = [
    _small_integers,
    _with_roots,
    _with_roots,
    _flat,
    _nearly_double,
    _wide,
    _certificate,
]


def certificate(rng: Random, d: int, *, grid: int, collinear: bool = False) -> list[QQ]:
    """(b - a) x (c - a) for three points whose coordinates have degree d on a grid."""

    def path() -> list[QQ]:
        return [QQ(rng.randint(-grid, grid), rng.choice([1, 1, 3])) for _ in range(d + 1)]

    a, b, c = ((path(), path()) for _ in range(3))
    if collinear:  # c = a + k (b - a), and a grain
        k = QQ(rng.randint(-3, 3), 2)
        x, y = ([p + k * (q - p) for p, q in zip(a[i], b[i], strict=True)] for i in (0, 1))
        c = x, y
        x[0] += rng.choice([QQ(0), power_of_two(-40), power_of_two(-52)])
    u = [[q - p for p, q in zip(a[i], b[i], strict=True)] for i in (0, 1)]
    v = [[q - p for p, q in zip(a[i], c[i], strict=True)] for i in (0, 1)]
    return [p - q for p, q in zip(times(u[0], v[1]), times(u[1], v[0]), strict=True)]


def times(f: Sequence[QQ], g: Sequence[QQ]) -> list[QQ]:
    """Return the product of two polynomials."""
    product = [QQ(0)] * (len(f) + len(g) - 1)
    for i, a in enumerate(f):
        for j, b in enumerate(g):
            product[i + j] += a * b
    return product


def _rescaled(rng: Random, f: list[QQ], roots: list[QQ]) -> Made:
    """f(t) to 2^a f(2^b t), coefficients staying within 2^±460."""
    a = rng.choice([0, 0, rng.randint(-98, 98)])
    b = rng.choice([0, 0, rng.randint(-30, 30)])
    g = [c * power_of_two(a + b * i) for i, c in enumerate(f)]
    if any(c and not SMALLEST <= abs(c) <= LARGEST for c in g):
        return f, roots
    return g, [r * power_of_two(-b) for r in roots]


def _image(rng: Random, true: Sequence[QQ]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Doubles near the coefficients, and bounds on their errors: exact, tight, loose, blind."""
    style = rng.choice(["nearest", "nearest", "off", "loose"])
    blind = rng.randrange(len(true)) if rng.random() < 0.2 else None
    c, e = [], []
    for i, q in enumerate(true):
        x = nearest_float(q)
        if style == "off":
            for _ in range(rng.randint(0, 4)):
                x = math.nextafter(x, rng.choice([math.inf, -math.inf]))
        elif style == "loose":
            x += x * rng.uniform(-1, 1) * 2.0 ** -rng.randint(20, 53)
        if i == blind:  # the sign of this one is not known
            x *= rng.choice([0.0, 0.0, 2.0**-10, 0.4, 0.51, -0.5])
        if x and abs(x) < SMALLEST:
            x = 0.0
        bound = enclosing_floats(abs(q - rational(x)))[1]
        if style == "loose" and rng.random() < 0.5:
            bound = max(bound, abs(x) * 2.0 ** -rng.randint(20, 53))
        c.append(x)
        e.append(max(bound, SMALLEST) if bound else 0.0)
    return tuple(c), tuple(e)


def _now(rng: Random, true: Sequence[QQ], roots: Sequence[QQ]) -> QQ | AlgebraicNumber:
    """A root, a neighbour of one, an algebraic root of the polynomial or another; or any time."""
    kind = rng.random()
    if kind < 0.25:
        return rng.choice(roots)
    if kind < 0.5:
        x = nearest_float(rng.choice(roots))
        for _ in range(rng.choice([0, 1, 1, 2, 5, 100])):
            x = math.nextafter(x, rng.choice([math.inf, -math.inf]))
        return rational(x)
    if kind < 0.75:
        f = as_primitive(true)
        if len(f) > 1:
            bound = cauchy_bound(f)
            found = [r.time for r in roots_after(f, AlgebraicNumber(-bound), bound)]
            if found:
                return rng.choice(found)
    if kind < 0.85:
        centre = abs(rng.choice(roots)) + 1
        surd = as_primitive([-centre * centre * QQ(rng.randint(90, 110), 100), QQ(0), QQ(1)])
        later = next(roots_after(surd, AlgebraicNumber(0), 2 * centre), None)
        if later is not None:
            return later.time
    return rng.choice([QQ(0), _dyadic(rng), rng.choice(roots) - abs(_dyadic(rng, 8))])


def _horizon(
    rng: Random, number: AlgebraicNumber, now_low: float, now_high: float, roots: Sequence[QQ]
) -> float:
    """At least now: just after it, near a root, or far away."""
    x = rng.choice(
        [
            math.nextafter(now_high, math.inf),
            now_high + abs(now_high) * 2.0**-20,
            now_high + 1.0,
            now_high + 1.0,
            2.0 * abs(now_high) + 2.0 ** rng.randint(-30, 40),
            nearest_float(rng.choice(roots)),
            math.nextafter(nearest_float(rng.choice(roots)), rng.choice([math.inf, -math.inf])),
            (now_low + now_high) / 2,
        ]
    )
    return x if number <= x else math.nextafter(now_high, math.inf)


# Extreme cases: any doubles at all


def extreme(rng: Random, degree: int) -> Case:
    """Coefficients, bounds and times of any size, subnormal to nearly infinite."""
    spread = rng.choice([4, 60, 300, 1073])
    centres = [rng.randint(-1073, 1022) for _ in range(3)]

    def double(centre: int) -> float:
        exponent = max(-1074, min(1023, centre + rng.randint(-spread, spread)))
        return math.ldexp(
            rng.choice([1.0, -1.0]) * rng.uniform(1, 2), exponent - (exponent == 1023)
        )

    step = centres[1] if rng.random() < 0.7 else rng.randint(-5, 5)  # time's scale
    c = [double(centres[0] - i * step) * (rng.random() < 0.9) for i in range(degree + 1)]
    e = [
        0.0 if rng.random() < 0.5 else abs(double(centres[0] - i * step - 52))
        for i in range(degree + 1)
    ]
    if rng.random() < 0.5:
        e = [min(b, abs(a) * 2.0 ** -rng.randint(1, 50)) for a, b in zip(c, e, strict=True)]
    true = [rational(a) + rational(b) * rng.choice([-1, 0, 1]) for a, b in zip(c, e, strict=True)]
    now = rng.choice([0.0, double(step), double(step), double(centres[2])])
    if degree == 1 and true[1] and rng.random() < 0.3:
        now = nearest_float(-true[0] / true[1])
        now = now if math.isfinite(now) else 0.0
    now_low, now_high = now, now
    for _ in range(rng.choice([0, 0, 1, 2])):
        now_low = math.nextafter(now_low, -math.inf)
        now_high = math.nextafter(now_high, math.inf)
    horizon = max(now_high, rng.choice([double(step), double(step), double(centres[2]), 1.0]))
    vanishes = any(true) and sum(q * rational(now) ** i for i, q in enumerate(true)) == 0
    return Case(
        tuple(true), tuple(c), tuple(e), rational(now), now_low, now_high, horizon, vanishes
    )


# Generic cases: what a simulation asks


def generic(rng: Random, d: int) -> Case:
    """A certificate of three random points on paths of degree d, now another's root."""
    f = certificate(rng, d, grid=10**6)
    other = as_primitive(certificate(rng, d, grid=10**6))
    start = AlgebraicNumber(QQ(rng.randint(0, 10**6), 10**6))
    found = next(roots_after(other, start, QQ(10)), None)
    if found:
        low, high = found.time.enclosure()
        now: QQ | AlgebraicNumber = found.time
    else:
        now = plain = QQ(rng.randint(0, 10**6), 10**6)
        low, high = enclosing_floats(plain)
    c = [nearest_float(q) for q in f]
    size = max(map(abs, c))
    e = [8 * ULP * size for _ in c]
    return Case(tuple(f), tuple(c), tuple(e), now, low, high, 10.0, at_root=False)
