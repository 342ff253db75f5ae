"""Wrong signs, event orders and structures by number type, as degeneracy grows.

Signs: orientations of points whose distance from a common line is about the degeneracy. Orders:
two events whose times differ by the degeneracy. Structures: convex hulls of points that close to
a line. All coordinates are rationals without a finite binary expansion.
"""

from __future__ import annotations

from collections.abc import Sequence
from random import Random
from typing import Final, NamedTuple, TypeVar

from benchmarks.number_types import ARITHMETICS, EXACT, Arithmetic, MovingPoint, Triple, hull
from benchmarks.output import Output, Row
from benchmarks.timing import microseconds
from exactpt.errors import AuditError
from exactpt.kernel.numbers import QQ, ZZ

__all__ = ["FULL", "QUICK", "Sizes", "run"]

UNIT: Final = 1009
"""Denominator of all coordinates, a prime."""

T = TypeVar("T")


class Sizes(NamedTuple):
    """Size of the benchmark.

    Attributes:
        questions: number of questions of each kind for each degeneracy.
        points: number of points of each structure.
        exponents: e for degeneracy 10^-e; None for degeneracy 0.
    """

    questions: int
    points: int
    exponents: Sequence[int | None]


QUICK: Final = Sizes(20, 8, (2, 16, 100, 300, None))
FULL: Final = Sizes(200, 16, (2, 5, 10, 14, 16, 18, 20, 30, 50, 100, 150, 200, 300, None))


class _Asked(NamedTuple):
    """The results for all questions of one degeneracy, and microseconds per question."""

    signs: list[int]
    orders: list[int]
    hulls: list[tuple[int, ...]]
    cost: tuple[float, float, float]


class _Input(NamedTuple):
    """The points; triples of them for signs, pairs of triples for orders, lists for hulls."""

    points: list[MovingPoint]
    signs: list[Triple]
    orders: list[tuple[Triple, Triple]]
    hulls: list[list[int]]


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Compute the same questions in all arithmetics.

    Raises:
        AuditError: if the filter and exact arithmetic disagree.
    """
    rows: list[Row] = []
    fields: dict[str, list[list[float | None]]] = {"signs": [], "orders": [], "structures": []}
    labels = ["0" if e is None else f"10^-{e}" for e in sizes.exponents]
    for exponent, label in zip(sizes.exponents, labels, strict=True):
        output.progress(f"degeneracy {label}")
        tiny = QQ(0) if exponent is None else QQ(ZZ(1), ZZ(10) ** exponent)
        given = _make(sizes, tiny, Random(f"arithmetic:{label}:{seed}"))
        truth = _ask(EXACT, given)
        lines: dict[str, list[float | None]] = {kind: [] for kind in fields}
        for arithmetic in ARITHMETICS:
            asked = truth if arithmetic is EXACT else _ask(arithmetic, given)
            shares = (
                _share_wrong(asked.signs, truth.signs),
                _share_wrong(asked.orders, truth.orders),
                _share_wrong(asked.hulls, truth.hulls),
            )
            if "filter" in arithmetic.name and any(shares):
                raise AuditError(f"degeneracy {label}: the filter is wrong: {shares}")
            rows.append(_row(label, arithmetic, shares, asked.cost))
            for line, share in zip(lines.values(), shares, strict=True):
                line.append(share)
        for kind, line in lines.items():
            fields[kind].append(line)
    output.table("arithmetic", rows)
    names = [arithmetic.name for arithmetic in ARITHMETICS]
    for kind, field in fields.items():
        output.shares(f"arithmetic-{kind}", f"Share of wrong {kind}", labels, names, field)


def _ask(arithmetic: Arithmetic, given: _Input) -> _Asked:
    with arithmetic.context():
        questions = arithmetic.load(given.points)
        sign_cost, signs = microseconds(questions.sign, given.signs)
        order_cost, orders = microseconds(lambda pair: questions.order(*pair), given.orders)
        hull_cost, hulls = microseconds(lambda line: hull(questions, line), given.hulls)
    return _Asked(signs, orders, hulls, (sign_cost, order_cost, hull_cost))


def _share_wrong(answers: Sequence[T], truth: Sequence[T]) -> float:
    return sum(a != b for a, b in zip(answers, truth, strict=True)) / len(truth)


def _row(
    label: str,
    arithmetic: Arithmetic,
    shares: tuple[float, float, float],
    cost: tuple[float, float, float],
) -> Row:
    return {
        "degeneracy": label,
        "arithmetic": arithmetic.name,
        "wrong signs": shares[0],
        "wrong orders": shares[1],
        "wrong structures": shares[2],
        "us a sign": cost[0],
        "us an order": cost[1],
        "us a structure": cost[2],
    }


def _make(sizes: Sizes, tiny: QQ, rng: Random) -> _Input:
    points: list[MovingPoint] = []

    def add(some: Sequence[MovingPoint]) -> list[int]:
        points.extend(some)
        return list(range(len(points) - len(some), len(points)))

    def triple(tiny: QQ, time: QQ) -> Triple:
        a, b, c = add(_collinear(rng, 3, tiny, time))
        return a, b, c

    signs = [triple(tiny, QQ(0)) for _ in range(sizes.questions)]
    orders = []
    for _ in range(sizes.questions):
        time = QQ(rng.randint(1, 2 * UNIT), UNIT)
        pair = [triple(QQ(0), time), triple(QQ(0), time + tiny)]
        rng.shuffle(pair)
        orders.append((pair[0], pair[1]))
    hulls = [
        sorted(add(_collinear(rng, sizes.points, tiny, QQ(0))), key=lambda i: points[i].x)
        for _ in range(max(1, sizes.questions // 5))
    ]
    return _Input(points, signs, orders, hulls)


def _collinear(rng: Random, count: int, tiny: QQ, time: QQ) -> list[MovingPoint]:
    """Points that lie on one line at a time, up to five times the degeneracy."""

    def some() -> QQ:
        return QQ(rng.randint(-5 * UNIT, 5 * UNIT), UNIT)

    x, y, dx, dy = some(), some(), abs(some()) + 1, some()
    made = []
    for s in rng.sample(range(-UNIT, UNIT), count):
        off, vx, vy = tiny * some(), some(), some()
        px, py = x + dx * s / UNIT - dy * off, y + dy * s / UNIT + dx * off
        made.append(MovingPoint(px - vx * time, py - vy * time, vx, vy))
    return made
