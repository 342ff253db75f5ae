"""First roots and the order of times: exactpt in comparison with SymPy, FLINT and mpmath.

Each program computes the first root in (0, 2] of the same random polynomials (those that have
one), then the order of consecutive pairs of these roots. A second table compares the filters of
degree 1 and 2 with their vectorized forms, a third the filtered certificates of three moving
points with exact ones.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from random import Random
from typing import Any, Final, NamedTuple

import numpy as np

from benchmarks.output import Output, Row
from benchmarks.plots import series_of
from benchmarks.root_finders import END, EXACT, FILTER, FINDERS, Finder, exact_first
from benchmarks.timing import microseconds
from exactpt import AlgebraicNumber, AuditError, Body, Translation
from exactpt.certificates import first_root as filters
from exactpt.certificates.certifier import Certifier
from exactpt.indices import VertexId
from exactpt.kernel import vectorized
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import roots_after
from exactpt.motion.vertices import Vertices

__all__ = ["FULL", "QUICK", "Sizes", "run"]

NEAR: Final = 1e-9
"""Maximum relative error of a right answer."""

POINTS: Final = 200
SPAN: Final = 100
"""Number of moving points for certificates, and the end of their time span."""


class Sizes(NamedTuple):
    """Size of the benchmark.

    Attributes:
        polynomials: number for each degree and coefficient size.
        degrees: degrees of polynomials.
        bits: bit lengths of their coefficients.
        batches: numbers of polynomials in a batch.
        certificates: number for each degree of motion.
    """

    polynomials: int
    degrees: Sequence[int]
    bits: Sequence[int]
    batches: Sequence[int]
    certificates: int


QUICK: Final = Sizes(5, (1, 2, 4, 12), (32, 256), (10, 100, 1000), 50)
FULL: Final = Sizes(40, (1, 2, 4, 6, 12), (32, 64, 256, 2048), (10, 30, 100, 1000, 10_000), 5000)


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Give every program the same questions.

    Raises:
        AuditError: if results of exactpt contradict each other, or SymPy's order of roots.
    """
    rng = Random(f"kernel:{seed}")
    finders = [f for f in FINDERS if f.package is None or output.has(f.package)]
    rows: list[Row] = []
    for degree in sizes.degrees:
        for bits in sizes.bits:
            output.progress(f"degree {degree}, {bits} bits")
            rows += _rows(finders, degree, bits, _polynomials(rng, degree, bits, sizes.polynomials))
    output.table("kernel", rows)
    batches = [_batch_row(rng, d, n) for d in (1, 2) for n in sizes.batches]
    output.table("kernel-batches", batches)
    certificates = [_certificate_row(rng, d, sizes.certificates) for d in (1, 2, 3)]
    output.table("kernel-certificates", certificates)
    for bits in (sizes.bits[0], sizes.bits[-1]):
        of_size = [row for row in rows if row["bits"] == bits]
        series = series_of(of_size, "program", "degree", "us first root")
        title = f"First root, coefficients of {bits} bits"
        output.lines(f"kernel-{bits}", title, ("degree", "microseconds"), series)


def _polynomials(rng: Random, degree: int, bits: int, count: int) -> list[IntPoly]:
    """Random integer polynomials with a root in (0, END]."""
    found: list[IntPoly] = []
    while len(found) < count:
        f = [rng.randint(-(2**bits), 2**bits) for _ in range(degree)] + [rng.randint(1, 2**bits)]
        p = tuple(map(ZZ, f))
        if next(roots_after(p, AlgebraicNumber(0), QQ(END)), None):
            found.append(p)
    return found


def _rows(finders: Sequence[Finder], degree: int, bits: int, fs: Sequence[IntPoly]) -> list[Row]:
    truth = [exact_first(f) for f in fs]
    order = [x.compare(y) < 0 for x, y in pairwise(truth)]
    equal, same = microseconds(
        lambda f: AlgebraicNumber.root(*f).compare(AlgebraicNumber.root(*f)),
        [(x.exact_polynomial, x.exact_low, x.exact_high) for x in truth],
    )
    if any(same):
        raise AuditError("a number is not equal to itself")
    rows: list[Row] = []
    for finder in finders:
        polys = [finder.convert(f) for f in fs]
        cost, answers = microseconds(finder.first, polys)
        right = _right(finder, answers, truth)
        decided = [answer is not None for answer in answers]
        if right is not None and (
            (finder is EXACT and right < len(fs)) or (finder is FILTER and right < sum(decided))
        ):
            raise AuditError(f"degree {degree}, {bits} bits: {finder.name} is wrong")
        comparing = _order(finder, polys, order)
        rows.append(
            {
                "degree": degree,
                "bits": bits,
                "program": finder.name,
                "us first root": cost,
                "answered": sum(decided) / len(fs),
                "to 1e-9": None if right is None else right / len(fs),
                "us order": comparing,
                "us equal": equal if finder is EXACT else None,
            }
        )
    return rows


def _right(finder: Finder, answers: Sequence[Any], truth: Sequence[AlgebraicNumber]) -> int | None:
    """Return the number of results close to the root; None if the program returns no values."""
    value = finder.value
    if value is None:
        return None
    return sum(
        answer is not None and abs(value(answer) - float(x)) <= NEAR * abs(float(x))
        for answer, x in zip(answers, truth, strict=True)
    )


def _order(finder: Finder, polys: Sequence[Any], truth: Sequence[bool]) -> float | None:
    """Microseconds per comparison of two roots; None if the program cannot compare them."""
    numbers, before = finder.numbers, finder.before
    if numbers is None or before is None:
        return None
    values = [numbers(f) for f in polys]
    if any(value is None for value in values):
        return None
    cost, answers = microseconds(lambda pair: before(*pair), list(pairwise(values)))
    if finder.name in ("exactpt, exact", "SymPy") and answers != truth:
        raise AuditError(f"{finder.name} orders roots in another way")
    return cost


def _batch_row(rng: Random, degree: int, count: int) -> Row:
    """Microseconds per polynomial, by the scalar filter and by the vectorized one."""
    ask: Callable[..., filters.Answer] = filters.linear if degree == 1 else filters.quadratic
    ask_all: Callable[..., vectorized.Answers] = (
        vectorized.linears if degree == 1 else vectorized.quadratics
    )
    rows = []
    for _ in range(count):
        c = [rng.uniform(-1, 1) for _ in range(degree + 1)]
        rows.append((*c, *(abs(x) * 2.0**-50 for x in c), 0.0, 0.0, float(END), False))
    columns = [np.array(column) for column in zip(*rows, strict=True)]
    one, answers = microseconds(lambda row: ask(*row), rows)
    together, results = microseconds(lambda c: ask_all(*c), [columns] * max(1, 2000 // count))
    if [s for s, _, _ in answers] != results[0].signs.tolist():
        raise AuditError("the batch and the scalar filter disagree")
    return {"degree": degree, "batch": count, "us scalar": one, "us batch": together / count}


def _certificate_row(rng: Random, degree: int, count: int) -> Row:
    """Microseconds per certificate of three points in motion of a degree, filtered and exact."""
    bodies = [_random_point(rng, i, degree) for i in range(POINTS)]
    triples = [[VertexId(v) for v in rng.sample(range(POINTS), 3)] for _ in range(count)]
    vertices = Vertices.of(bodies, QQ(0), QQ(SPAN), plain=True)
    filtered = Certifier(vertices, QQ(0), QQ(SPAN), exact_only=False)
    exact = Certifier(vertices, QQ(0), QQ(SPAN), exact_only=True)
    answers = [filtered.orientation(*triple) for triple in triples]
    decided = vertices.counters.filtered
    cost, _ = microseconds(lambda triple: filtered.orientation(*triple), triples)
    exact_cost, truth = microseconds(lambda triple: exact.orientation(*triple), triples)
    if [(s, t is None) for s, t in answers] != [(s, t is None) for s, t in truth]:
        raise AuditError("the filter and exact arithmetic disagree on a certificate")
    return {
        "degree of motion": degree,
        "certificates": count,
        "us filtered": cost,
        "us exact": exact_cost,
        "decided by the filter": decided / count,
    }


def _random_point(rng: Random, i: int, degree: int) -> Body:
    """A point in polynomial motion whose terms have the same size at the end of the span."""
    sizes = (10**4, 200, 3)[:degree]
    x, y = ([0, *(rng.randint(-size, size) for size in sizes)] for _ in range(2))
    return Body(f"p{i}", [(rng.randint(0, 10**6), rng.randint(0, 10**6))], Translation(x, y))
