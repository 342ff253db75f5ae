"""Vertices in windows of time: is each within rho of its model, and in the box of the window?

A row is a coordinate of a vertex at a rational time of a window, against its exact value. Windows
are as wide as a span of time or 2^-40 of it, beside 0 or far from it. The error is that of the
model, relative to rho.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Final

from mypy_extensions import i64

from exactpt.filters.rounding import INFINITY
from exactpt.filters.rows import Table
from exactpt.filters.windows import ROW, X0, Y0, Window
from exactpt.kernel.numbers import QQ, nearest_float, of_double
from fuzz.adversaries.pieces import KINDS, STYLES, Piece, made
from fuzz.adversaries.report import Part, Report, run

__all__ = ["PARTS"]

INSTANTS = 4  # of a window


def span(rng: Random) -> tuple[float, float]:
    """Return the middle of a window and half its width."""
    middle = rng.choice([0.0, 1.0, 1.0, 2.0 ** rng.randint(-20, 20)]) * rng.uniform(-1.0, 1.0)
    return middle, rng.choice([0.0, 1.0, 2.0 ** -rng.randint(0, 40)]) * (abs(middle) or 1.0)


def value_of(window: Window, at: int, s: QQ) -> QQ:
    """Return a coordinate at s, by the model."""
    c0, c1, c2 = (of_double(window.rows[i64(at + k)]) for k in range(3))
    return c0 + s * (c1 + s * c2)


def check(piece: Piece, rng: Random, report: Report) -> None:
    """Check a piece in a window at some times."""
    table, window = Table(), Window()
    middle, half = span(rng)
    if rng.random() < 0.5:
        middle += piece.origin
    number = piece.add_to(table, 0, middle - half, middle + half)
    window.fill(table, i64(number), middle, half)
    if not window.rho < INFINITY:
        report.count("no model")
        report.rows += 1
        return
    rho = of_double(window.rho)
    for _ in range(INSTANTS):
        s = QQ(rng.choice([-1, 1])) if rng.random() < 0.6 else of_double(rng.uniform(-1.0, 1.0))
        places = piece.at(of_double(middle) + of_double(half) * s)
        for v, exact in enumerate(places):
            for first, coordinate in zip((X0, Y0), exact, strict=True):
                off = abs(value_of(window, int(ROW) * v + int(first), s) - coordinate)
                report.measure(nearest_float(off / rho) if rho else 0.0)
                if off > rho:
                    report.wrong.append(f"vertex {v} at {s} of {middle} {half}: {piece}")
            if not is_inside(window, exact):
                report.wrong.append(f"box: vertex {v} at {s} of {middle} {half}: {piece}")


def is_inside(window: Window, place: tuple[QQ, QQ]) -> bool:
    """Return whether a place is not certainly outside the box of a window."""
    sides = (window.left, window.right, window.bottom, window.top)
    if not all(abs(side) < INFINITY for side in sides):
        return True
    left, right, bottom, top = map(of_double, sides)
    return left <= place[0] <= right and bottom <= place[1] <= top


def checked(kind: int) -> Callable[[int, int], Report]:
    """Return the check of pieces of a kind."""

    def part(rows: int, seed: int) -> Report:
        report, rng = Report(), Random(seed)
        while report.rows < rows:
            check(made(rng, kind, rng.choice(STYLES), rng.randint(1, 4)), rng, report)
        return report

    return part


PARTS: Final[dict[str, Part]] = {name: checked(kind) for name, kind in KINDS.items()}

if __name__ == "__main__":
    run(PARTS, __doc__ or "")
