"""First roots and comparisons of times: exactpt beside SymPy and python-flint, in one run.

    python benchmarks/kernel.py [--polynomials 40] [--seed 0]

Every row is one degree and one coefficient size. Each program is asked for the first
root in (0, 2] of the same random polynomials (those that have one), in microseconds a
polynomial; then for the order of neighbouring pairs of these roots. The filter gets
doubles with error bounds, and its share of decided questions is shown. A second table
sets the filters of degree 1 and 2 beside their batch, by the size of the batch. Machines differ
and other programs run beside: the ratios last, the times do not.
"""

from __future__ import annotations

import argparse
import gc
import platform
import random
import statistics
import sys
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from time import perf_counter
from typing import TypeAlias, TypeVar

import flint
import gmpy2
import numpy as np
import sympy

sys.path.insert(0, str(Path(__file__).parents[1]))

from exactpt.kernel import batch, filters
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import IntPoly
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import roots_after

DEGREES = [1, 2, 4, 6, 12]
BITS = [32, 64, 256, 2048]
BATCHES = [10, 30, 100, 1000, 10_000]
END = 2
T = sympy.Symbol("t")

A = TypeVar("A")
B = TypeVar("B")
Image: TypeAlias = "tuple[list[float], list[float]]"
Made: TypeAlias = "tuple[IntPoly, QQ, QQ]"


def polynomials(rng: random.Random, degree: int, bits: int, count: int) -> list[IntPoly]:
    """Random integer polynomials with a root in (0, END]."""
    found = []
    while len(found) < count:
        f = [rng.randint(-(2**bits), 2**bits) for _ in range(degree)] + [rng.randint(1, 2**bits)]
        p = tuple(map(ZZ, f))
        if next(roots_after(p, AlgebraicNumber(0), QQ(END)), None):
            found.append(p)
    return found


def microseconds(ask: Callable[[A], B], questions: list[A]) -> tuple[float, list[B]]:
    """The median over three passes of the time a question, and the last answers."""
    times, answers = [], []
    for _ in range(3):
        gc.collect()
        start = perf_counter()
        answers = [ask(q) for q in questions]
        times.append((perf_counter() - start) / len(questions) * 1e6)
    return statistics.median(times), answers


def exact_first(f: IntPoly) -> AlgebraicNumber:
    """The exact path, as if the filter had been unsure."""
    return next(roots_after(f, AlgebraicNumber(0), QQ(END))).time


def filter_image(f: IntPoly) -> Image:
    """The polynomial divided by a power of two, in doubles; a unit in the last place for bounds."""
    shift = max(c.bit_length() for c in f)
    c = [float(QQ(x, ZZ(1) << shift)) for x in f]
    return c, [abs(x) * 2.0**-53 for x in c]


def filter_first(image: Image) -> filters.Answer:
    """The filter's answer from 0 to END."""
    c, e = image
    if len(c) == 2:
        return filters.linear(*c, *e, 0.0, 0.0, float(END), at_root=False)
    if len(c) == 3:
        return filters.quadratic(*c, *e, 0.0, 0.0, float(END), at_root=False)
    return filters.polynomial(c, e, 0.0, 0.0, float(END), at_root=False)


def sympy_first(poly: sympy.Poly) -> object:
    """The isolating intervals in [0, END], of which the first counts."""
    return poly.intervals(inf=0, sup=END)[0]


def flint_first(poly: flint.fmpz_poly) -> flint.arb:
    """FLINT encloses all complex roots; the least real one in (0, END] counts."""
    reals = (r.real for r, _ in poly.complex_roots() if r.imag == 0)
    return min((r for r in reals if r > 0 and r <= END), key=float)


def sympy_numbers(polys: list[sympy.Poly]) -> list[sympy.Expr]:
    """The first roots as numbers that SymPy compares."""
    return [next(r for r in p.real_roots() if 0 < r <= END) for p in polys]


def compare_exact(pair: tuple[Made, Made]) -> int:
    """The order of two numbers made anew, so that no refinement is shared."""
    (f, low, high), (g, left, right) = pair
    return AlgebraicNumber.root(f, low, high).compare(AlgebraicNumber.root(g, left, right))


def row(rng: random.Random, degree: int, bits: int, count: int) -> tuple[dict[str, float], float]:
    """The times of one degree and size, by name, and the share that the filter decided."""
    fs = polynomials(rng, degree, bits, count)
    images = [filter_image(f) for f in fs]
    in_sympy = [sympy.Poly([int(c) for c in reversed(f)], T) for f in fs]
    in_flint = [flint.fmpz_poly([int(c) for c in f]) for f in fs]

    times: dict[str, float] = {}
    times["exact"], plain = microseconds(exact_first, fs)
    times["filter"], answers = microseconds(filter_first, images)
    times["sympy"], _ = microseconds(sympy_first, in_sympy)
    times["flint"], _ = microseconds(flint_first, in_flint)
    decided = sum(said[0] != 0 for said in answers) / count

    made = [(x.polynomial, x.low, x.high) for x in plain]
    times["cmp exact"], orders = microseconds(compare_exact, list(pairwise(made)))
    equal = [(m, m) for m in made]
    times["cmp equal"], same = microseconds(compare_exact, equal)
    if any(same):
        raise AssertionError("a number is not equal to itself")
    numbers = sympy_numbers(in_sympy)
    times["cmp sympy"], theirs = microseconds(lambda p: bool(p[0] < p[1]), list(pairwise(numbers)))
    balls = [flint_first(p) for p in in_flint]
    times["cmp flint"], _ = microseconds(lambda p: p[0] < p[1], list(pairwise(balls)))
    if [o < 0 for o in orders] != theirs:
        raise AssertionError(f"exactpt and SymPy disagree at degree {degree}, {bits} bits")
    return times, decided


def batch_row(rng: random.Random, degree: int, count: int) -> tuple[float, float]:
    """Microseconds a polynomial: the scalar filter, and the batch of so many."""
    ask, ask_all = {
        1: (filters.linear, batch.linears),
        2: (filters.quadratic, batch.quadratics),
    }[degree]
    rows = []
    for _ in range(count):
        c = [rng.uniform(-1, 1) for _ in range(degree + 1)]
        rows.append((*c, *(abs(x) * 2.0**-50 for x in c), 0.0, 0.0, float(END), False))
    columns = [np.array(column) for column in zip(*rows, strict=True)]
    one, answers = microseconds(lambda row: ask(*row), rows)
    calls = max(1, 2000 // count)
    together, results = microseconds(lambda c: ask_all(*c), [columns] * calls)
    if [s for s, _, _ in answers] != results[0].signs.tolist():
        raise AssertionError("the batch and the scalar filter disagree")
    return one, together / count


def processor() -> str:
    """The name of the processor, as far as it is known."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--polynomials", type=int, default=40, help="how many a row")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    rng = random.Random(options.seed)

    say = sys.stdout.write
    say(f"{processor()}, {platform.system()}, Python {platform.python_version()}, ")
    say(f"gmpy2 {gmpy2.version()} ({gmpy2.mp_version()}), SymPy {sympy.__version__}, ")
    say(f"python-flint {flint.__version__} (FLINT {flint.__FLINT_VERSION__})\n")
    say(f"{options.polynomials} polynomials a row, first root in (0, {END}]; microseconds each\n\n")
    say(
        f"{'':11}|{'first root':^51}|{'':9}|{'order of two roots':^48}\n"
        f"{'deg':>4}{'bits':>6} |{'exact':>9}{'filter':>8}{'SymPy':>9}{'FLINT':>8}"
        f"{'S/e':>6}{'F/e':>6}{'e/f':>5}|{'decided':>8} |"
        f"{'exact':>8}{'equal':>8}{'SymPy':>9}{'FLINT':>7}{'S/e':>8}{'F/e':>7}\n"
    )
    for degree in DEGREES:
        for bits in BITS:
            t, decided = row(rng, degree, bits, options.polynomials)
            say(
                f"{degree:4}{bits:6} |{t['exact']:9.1f}{t['filter']:8.2f}{t['sympy']:9.0f}"
                f"{t['flint']:8.1f}{t['sympy'] / t['exact']:6.1f}{t['flint'] / t['exact']:6.2f}"
                f"{t['exact'] / t['filter']:5.0f}|{decided:7.0%}  |"
                f"{t['cmp exact']:8.2f}{t['cmp equal']:8.1f}{t['cmp sympy']:9.1f}"
                f"{t['cmp flint']:7.2f}{t['cmp sympy'] / t['cmp exact']:8.1f}"
                f"{t['cmp flint'] / t['cmp exact']:7.2f}\n"
            )
            sys.stdout.flush()
    say(f"\n{'deg':>4}{'batch':>7} |{'scalar':>8}{'batch':>8}{'s/b':>6}\n")
    for degree in (1, 2):
        for count in BATCHES:
            one, together = batch_row(rng, degree, count)
            say(f"{degree:4}{count:7} |{one:8.2f}{together:8.3f}{one / together:6.1f}\n")


if __name__ == "__main__":
    main()
