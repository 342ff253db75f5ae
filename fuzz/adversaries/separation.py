"""An adversary of lines that separate two pieces in straight motion (`exactpt.filters.separation`).

Two pieces are placed so that their hulls nearly touch at an end of the window: each lies in a half
plane with the origin on its border, and one is moved by a few units in the last place, towards the
other or away from it, and along the border. If the filter says "separated", the hulls are disjoint
at both ends of the window and between them, by rationals: some line through two points separates
them. The numbers that doubles stand for are off by exactly the stated errors.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import chain, combinations
from math import copysign
from random import Random
from typing import Final, TypeAlias

from exactpt.filters.rows import EXACT, STRAIGHT, Errors, Piece, Table
from exactpt.filters.separation import Gap, are_separated
from exactpt.filters.straight import relative_motion
from fuzz.adversaries.report import Report, run

__all__ = ["attack"]

Point: TypeAlias = tuple[Fraction, Fraction]
Places: TypeAlias = list[tuple[float, float]]

ULP: Final = 2.0**-52
SCALES: Final = (1.0, 1.0, 1.0, 1.0, 2.0**40, 2.0**-300, 2.0**-1060, 2.0**511, 2.0**513, 1e300)
"""Sizes of all coordinates."""
STATED: Final = Errors(2.0**-40, 2.0**-40, 2.0**-40)


def half_plane(rng: Random, n: tuple[float, float], side: int) -> Places:
    """Return some points with n . p of a sign, or 0, and the origin."""
    points: Places = [(0.0, 0.0)]
    while len(points) < rng.randint(1, 4):
        x, y = rng.uniform(-4.0, 4.0), rng.uniform(-4.0, 4.0)
        if rng.random() < 0.7:  # on the border, up to rounding
            factor = rng.uniform(-3.0, 3.0)
            x, y = -n[1] * factor, n[0] * factor
        if side * (n[0] * x + n[1] * y) < 0.0:
            x, y = -x, -y
        points.append((x, y))
    return points


def add_piece(table: Table, places: Places, path: list[float], errors: Errors) -> None:
    """Add a piece; its edges are those of a ring of its places, or of a point."""
    xs, ys = map(list, zip(*places, strict=True))
    frame = [0.0] * 24
    frame[0], frame[4], frame[1], frame[5] = path
    size = len(xs)
    piece = Piece(
        body=table.count(),
        kind=STRAIGHT,
        start=-4.0,
        end=4.0,
        place=table.add_places(xs, ys),
        size=size,
        edge=table.add_ring(size),
        edges=size,
        frame=frame,
        box=(min(xs), max(xs), min(ys), max(ys)),
        errors=errors,
        radius=0.0,
        deforms=False,
    )
    table.add_piece(piece)


def are_apart(a: list[Point], b: list[Point]) -> bool:
    """Return True if a line separates the hulls of some points, without touching either."""
    pairs = chain(combinations(a, 2), combinations(b, 2), [(p, q) for p in a for q in b])
    for (px, py), (qx, qy) in pairs:
        along, across = (qx - px, qy - py), (py - qy, qx - px)
        for nx, ny in (along, across):
            of_a = [nx * x + ny * y for x, y in a]
            of_b = [nx * x + ny * y for x, y in b]
            if max(of_a) < min(of_b) or max(of_b) < min(of_a):
                return True
    return False


def positions(
    rng: Random,
    places: Places,
    path: list[float],
    errors: Errors,
    towards: tuple[float, float],
    times: list[Fraction],
) -> list[list[Point]]:
    """Return the true points of a piece at some times.

    All numbers are off by their errors in a direction at the first of the times, or none is.
    """
    share = rng.choice([0, 1, 1])
    signs = [copysign(share, towards[0]), copysign(share, towards[1])]
    later = copysign(1.0, times[0])
    cx, cy = (Fraction(c) + Fraction(s * errors.path) for c, s in zip(path, signs, strict=False))
    wx, wy = (
        Fraction(w) + Fraction(s * later * errors.speed)
        for w, s in zip(path[2:], signs, strict=True)
    )
    true = [
        (
            Fraction(x) + Fraction(signs[0] * errors.place),
            Fraction(y) + Fraction(signs[1] * errors.place),
        )
        for x, y in places
    ]
    return [[(x + cx + wx * t, y + cy + wy * t) for x, y in true] for t in times]


def attack(pairs: int, seed: int) -> Report:
    """Try the filter on pairs of pieces.

    Args:
        pairs: the number of pairs.
        seed: of the random numbers.
    """
    rng = Random(f"separation {seed}")
    report = Report()
    for _ in range(pairs):
        _try(rng, report)
    return report


def _try(rng: Random, report: Report) -> None:
    scale = rng.choice(SCALES)
    errors = EXACT if scale != 1.0 or rng.random() < 0.5 else STATED
    n = rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)
    low, high = sorted(rng.randint(-48, 48) / 16.0 for _ in range(2))
    time = rng.choice([low, high])
    a, b = half_plane(rng, n, -1), half_plane(rng, n, 1)
    speed = rng.choice([0.0, rng.uniform(-2.0, 2.0)])  # at rest, the error of w hides no rounding
    w = [-n[1] * speed, n[0] * speed]  # along the border
    if rng.random() < 0.3:  # they part, or come nearer, from the time on
        sign = rng.choice([-1.0, 1.0])
        w = [w[0] + sign * n[0], w[1] + sign * n[1]]
    most = rng.choice([2, 2, 24, 100])
    off = rng.randint(-most, most) * (ULP if errors is EXACT else STATED.place)
    along = rng.choice([0.0, rng.uniform(-2.0, 2.0)])
    c = [off * n[0] - n[1] * along - w[0] * time, off * n[1] + n[0] * along - w[1] * time]
    path_a = [*(scale * v for v in c), *(scale * v for v in w)]
    path_b = [0.0, 0.0, 0.0, 0.0]
    a = [(scale * x, scale * y) for x, y in a]
    b = [(scale * x, scale * y) for x, y in b]

    table = Table()
    add_piece(table, a, path_a, errors)
    add_piece(table, b, path_b, errors)
    said = are_separated(table, 0, 1, low, high)
    tie, other = Fraction(time), Fraction(low + high - time)
    times = [tie, other, (2 * tie + other) / 3]
    there = positions(rng, a, path_a, errors, n, times)
    still = positions(rng, b, path_b, errors, (-n[0], -n[1]), times)
    truly = all(are_apart(p, q) for p, q in zip(there, still, strict=True))
    if said and not truly:
        report.wrong.append(f"{a} {path_a} {b} {errors} [{low!r}, {high!r}]")
    report.count("separated" if said else "not separated" if truly else "touching")
    report.measure(_ratio(table, n, off * scale, low, high) if said else 0.0)


def _ratio(table: Table, n: tuple[float, float], off: float, low: float, high: float) -> float:
    """Return the margin by the gap that a pair was placed with, at most 1: the bound is as near."""
    gap = Gap(table, relative_motion(table, 0, 1), 0, 1, low, high)
    margin = (abs(n[0]) + abs(n[1])) * gap.margin
    width = abs(off) * (n[0] * n[0] + n[1] * n[1])
    return min(1.0, margin / width) if width > 0.0 else 0.0


if __name__ == "__main__":
    run({"separated": attack}, __doc__ or "")
