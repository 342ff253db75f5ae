"""Models of functions against their exact values: is each within its remainder?

A row is a model made by one operation and a rational s in [-1, 1]. The functions that go into it
are as far from their own models as their remainders allow, and on the side on which the error of
the result grows. The error is that of the model at s, relative to its remainder.
"""

from __future__ import annotations

from itertools import product
from random import Random
from typing import Final

from librt.vecs import vec

from exactpt.filters import models
from exactpt.filters.models import Model
from exactpt.filters.rounding import INFINITY, U
from exactpt.kernel.numbers import QQ, nearest_float, of_double, sign
from fuzz.adversaries.report import Part, Report, run

__all__ = ["PARTS"]

UNIT: Final = of_double(U)


def coefficient(rng: Random) -> float:
    """Return a double of one of several kinds."""
    kind = rng.random()
    if kind < 0.15:
        return 0.0
    if kind < 0.4:
        return float(rng.randint(-9, 9))
    if kind < 0.8:
        return rng.uniform(-1.0, 1.0)
    return rng.uniform(-1.0, 1.0) * 2.0 ** rng.randint(-60, 60)


def instant(rng: Random) -> QQ:
    """Return s in [-1, 1]."""
    kind = rng.random()
    if kind < 0.4:
        return QQ(rng.choice([-1, 1]))
    if kind < 0.5:
        return QQ(0)
    return of_double(rng.uniform(-1.0, 1.0))


def window(rng: Random) -> tuple[float, float]:
    """Return a middle and half a width: 1 to 2^-40 of the middle, or beside 0."""
    middle = rng.choice([0.0, 1.0, 2.0 ** rng.randint(-30, 30)]) * rng.uniform(-1.0, 1.0)
    scale = abs(middle) or 1.0
    return middle, rng.choice([0.0, 1.0, 2.0 ** -rng.randint(0, 40), rng.random()]) * scale


def value_of(f: Model, s: QQ) -> QQ:
    """Return the quadratic of a model at s."""
    c0, c1, c2, _ = f
    return of_double(c0) + s * (of_double(c1) + s * of_double(c2))


def measure(report: Report, f: Model, s: QQ, exact: QQ, what: object) -> None:
    """Compare a model with an exact value."""
    rest = models.rest_of(f)
    if not rest < INFINITY:
        report.count("no model")
        return
    ratio = abs(value_of(f, s) - exact) / of_double(rest)
    report.measure(nearest_float(ratio))
    if ratio > 1:
        report.wrong.append(f"{nearest_float(ratio):.4f} {what} {f} s = {s}")


def off_most(f: Model, s: QQ, terms: list[QQ]) -> QQ:
    """Return the sum of terms, each off by U to the side on which the model is worse."""
    total = sum(terms, QQ(0))
    off = value_of(f, s) - total
    return total - sign(off) * UNIT * sum(map(abs, terms))


def polynomials(rows: int, seed: int) -> Report:
    """Check models of polynomials whose coefficients are off by U."""
    report = Report()
    rng = Random(seed)
    while report.rows < rows:
        c = [coefficient(rng) for _ in range(4)]
        middle, half = window(rng)
        s = instant(rng)
        t = of_double(middle) + of_double(half) * s
        terms = [of_double(x) * t**k for k, x in enumerate(c)]
        f = models.of_polynomial(vec[float](c), 0, middle, half)
        measure(report, f, s, off_most(f, s, terms), (c, middle, half))
    return report


def long_polynomials(rows: int, seed: int) -> Report:
    """Check models of polynomials of any degree whose coefficients are off by U."""
    report = Report()
    rng = Random(seed)
    while report.rows + report.counts.get("no model", 0) < rows:
        c = [coefficient(rng) for _ in range(rng.randint(1, 9))]
        middle, half = window(rng)
        s = instant(rng)
        t = of_double(middle) + of_double(half) * s
        terms = [of_double(x) * t**k for k, x in enumerate(c)]
        f = models.of_long_polynomial(vec[float](c), 0, len(c), middle, half)
        measure(report, f, s, off_most(f, s, terms), (c, middle, half))
    return report


def drawn(rng: Random, scale: float = 1.0) -> Model:
    """Return a model: quadratic, and a remainder of any size."""
    c0, c1, c2 = (coefficient(rng) for _ in range(3))
    change = rng.choice([1.0, 2.0 ** -rng.randint(0, 40)]) * scale
    size = abs(c0) + abs(c1) + abs(c2)
    rest = rng.choice([0.0, U, 2.0 ** -rng.randint(0, 50)]) * size * scale
    return c0, c1 * change, c2 * change * change, rest


def farthest(results: list[QQ], f: Model, s: QQ) -> QQ:
    """Return the result that is farthest from a model."""
    at_s = value_of(f, s)
    return max(results, key=lambda exact: abs(exact - at_s))


def ends(f: Model, s: QQ) -> tuple[QQ, QQ]:
    """Return the least and the largest value of the functions of a model at s."""
    at_s = value_of(f, s)
    rest = of_double(models.rest_of(f))
    return at_s - rest, at_s + rest


def sums(rows: int, seed: int) -> Report:
    """Check sums and differences."""
    report = Report()
    rng = Random(seed)
    while report.rows < rows:
        f = drawn(rng)
        g = drawn(rng)
        s = instant(rng)
        total = models.plus(f, g)
        difference = models.minus(f, g)
        pairs = list(product(ends(f, s), ends(g, s)))
        totals = [x + y for x, y in pairs]
        differences = [x - y for x, y in pairs]
        measure(report, total, s, farthest(totals, total, s), (f, g))
        measure(report, difference, s, farthest(differences, difference, s), (f, g))
    return report


def products(rows: int, seed: int) -> Report:
    """Check products."""
    report = Report()
    rng = Random(seed)
    while report.rows < rows:
        f = drawn(rng)
        g = drawn(rng)
        s = instant(rng)
        of_both = models.times(f, g)
        exact = [x * y for x, y in product(ends(f, s), ends(g, s))]
        measure(report, of_both, s, farthest(exact, of_both, s), (f, g))
    return report


def inverses(rows: int, seed: int) -> Report:
    """Check inverses of functions that are nearly constant, and of others."""
    report = Report()
    rng = Random(seed)
    while report.rows + report.counts.get("no model", 0) < rows:
        c0, c1, c2, rest = drawn(rng, 0.3)
        constant = (c0 or 1.0) * rng.choice([1.0, 2.0, 8.0])
        w = constant, c1, c2, rest
        s = instant(rng)
        inverse = models.inverse(w)
        if not models.rest_of(inverse) < INFINITY:
            report.count("no model")
            continue
        exact = [1 / x for x in ends(w, s)]
        measure(report, inverse, s, farthest(exact, inverse, s), w)
    return report


def turns(rows: int, seed: int) -> Report:
    """Check the cosine and the sine of an angle by the tangent of its half."""
    report = Report()
    rng = Random(seed)
    while report.rows < rows:
        h = drawn(rng, rng.choice([1.0, 0.1]))
        s = instant(rng)
        cosine, sine = models.turn(h)
        tangents = ends(h, s)
        cosines = [(1 - x * x) / (1 + x * x) for x in tangents]
        sines = [2 * x / (1 + x * x) for x in tangents]
        if models.rest_of(cosine) == 1.0:
            report.count("coarse")
        measure(report, cosine, s, farthest(cosines, cosine, s), h)
        measure(report, sine, s, farthest(sines, sine, s), h)
    return report


def constant_turns(rows: int, seed: int) -> Report:
    """Check the cosine and the sine of an angle and a constant one, whose numbers are off by U."""
    report = Report()
    rng = Random(seed)
    while report.rows < rows:
        f = drawn(rng)
        g = drawn(rng)
        s = instant(rng)
        c = coefficient(rng)
        d = coefficient(rng)
        first, second = models.turned(f, g, c, d)
        cosines: list[QQ] = []
        sines: list[QQ] = []
        for x, y in product(ends(f, s), ends(g, s)):
            for true_c, true_d in product(off_by_unit(c), off_by_unit(d)):
                cosines.append(x * true_c - y * true_d)
                sines.append(y * true_c + x * true_d)
        measure(report, first, s, farthest(cosines, first, s), (f, g, c, d))
        measure(report, second, s, farthest(sines, second, s), (f, g, c, d))
    return report


def scalings(rows: int, seed: int) -> Report:
    """Check models times a number that is off by U."""
    report = Report()
    rng = Random(seed)
    while report.rows < rows:
        f = drawn(rng)
        s = instant(rng)
        c = coefficient(rng)
        scaled = models.scaled(f, c)
        exact = [x * true_c for x in ends(f, s) for true_c in off_by_unit(c)]
        measure(report, scaled, s, farthest(exact, scaled, s), (f, c))
    return report


def shifts(rows: int, seed: int) -> Report:
    """Check models of functions and a number."""
    report = Report()
    rng = Random(seed)
    while report.rows < rows:
        f = drawn(rng)
        s = instant(rng)
        c = coefficient(rng)
        moved = models.moved(f, c)
        exact = [x + of_double(c) for x in ends(f, s)]
        measure(report, moved, s, farthest(exact, moved, s), (f, c))
    return report


def off_by_unit(c: float) -> tuple[QQ, QQ]:
    """Return the numbers that are U of a double below and above it."""
    return of_double(c) * (1 - UNIT), of_double(c) * (1 + UNIT)


PARTS: Final[dict[str, Part]] = {
    "polynomials": polynomials,
    "long polynomials": long_polynomials,
    "constant turns": constant_turns,
    "scalings": scalings,
    "shifts": shifts,
    "sums": sums,
    "products": products,
    "inverses": inverses,
    "turns": turns,
}

if __name__ == "__main__":
    run(PARTS, __doc__ or "")
