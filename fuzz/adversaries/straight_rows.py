"""Rows for the adversary of the filter for straight motion, most of them aimed at a tie.

A row is a vertex and an edge in relative motion, as doubles, the errors that the table states, and
exact numbers within these errors: often at their ends. It is aimed at a tie of a decision, off by
up to twice its bound: the time of contact at an end of the window or of the span of a piece, the
foot of the vertex at an end of the edge, a motion almost in parallel, a slope about its error.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Final, NamedTuple

from exactpt.filters.rows import EXACT, Errors
from fuzz.adversaries.exact_times import as_integers

__all__ = [
    "AIMS",
    "KINDS",
    "THIRDS",
    "Row",
    "U",
    "bounds_of",
    "grid_number",
    "make_row",
    "random_number",
    "stated",
    "with_unknown",
]  # fmt: skip

U: Final = 2.0**-53
NUMBERS: Final = 14
"""Of a row: px, py, qx, qy, rx, ry, then cx, cy, wx, wy of the vertex and of the edge."""
THIRDS: Final = 21
"""Exact numbers are integers by this: doubles are such, and so are thirds and sevenths."""


@dataclass(frozen=True)
class Row:
    """A vertex, an edge, and a window of time.

    Attributes:
        kind, aim: how the row was made.
        doubles: `NUMBERS` doubles, those of the table.
        exact: the exact numbers, multiplied by one power of two and by `THIRDS`.
        errors: of the piece of the vertex, and of that of the edge.
        low, high: the window.
        start, end: the times between which both pieces exist, rounded outward.
    """

    kind: str
    aim: str
    doubles: tuple[float, ...]
    exact: tuple[int, ...] = ()
    errors: tuple[Errors, Errors] = (EXACT, EXACT)
    low: float = 0.0
    high: float = 1.0
    start: float = -math.inf
    end: float = math.inf


class Bounds(NamedTuple):
    """The values of the derivation in `exactpt.filters.straight`, from which rows are aimed."""

    t: float
    r: float
    c0: float
    c1: float
    e0: float
    e1: float
    along: float
    length: float
    foot: float


def bounds_of(row: Row) -> Bounds:
    """Return the values of the derivation; NaN where there is no time."""
    px, py, qx, qy, rx, ry, ax, ay, avx, avy, bx, by, bvx, bvy = row.doubles
    of_a, of_b = row.errors
    cx, cy, wx, wy = ax - bx, ay - by, avx - bvx, avy - bvy
    c_error = of_a.path + of_b.path
    w_error = of_a.speed + of_b.speed + 2 * U * (abs(wx) + abs(wy))
    ux, uy, zx, zy = rx - qx, ry - qy, px - qx + cx, py - qy + cy
    u, z, w = abs(ux) + abs(uy), abs(zx) + abs(zy), abs(wx) + abs(wy)
    d = 2 * (of_a.place + of_b.place + c_error) + 16 * U * (abs(cx) + abs(cy)) + 2.0**-500
    c0, c1 = ux * zy - uy * zx, ux * wy - uy * wx
    e0 = 16 * U * (abs(ux * zy) + abs(uy * zx)) + d * (u + z + 2 * d)
    e1 = 16 * U * (abs(ux * wy) + abs(uy * wx)) + d * w + w_error * (u + 2 * d)
    if not abs(c1) > e1:
        return Bounds(math.nan, math.nan, c0, c1, e0, e1, math.nan, math.nan, math.nan)
    t = -c0 / c1
    r = (e0 + e1 * abs(t)) / (abs(c1) - e1)
    mx, my = zx + wx * t, zy + wy * t
    m = abs(mx) + abs(my)
    s = d + w * r + w_error * (abs(t) + r) + 16 * U * (z + w * abs(t))
    along, length = mx * ux + my * uy, ux * ux + uy * uy
    foot = s * (u + 2 * d) + d * m + 2 * d * (2 * u + d) + 16 * U * (m * u + length)
    return Bounds(t, r, c0, c1, e0, e1, along, length, foot)


def random_number(rng: random.Random) -> float:
    """Return a number of 53 bits, of any sign, and of a size about 1."""
    return rng.uniform(-2.0, 2.0) * 2.0 ** rng.randint(-3, 3)


def grid_number(rng: random.Random) -> float:
    """Return a small integer."""
    return float(rng.randint(-6, 6))


def any_path(rng: random.Random, number: Callable[[random.Random], float]) -> list[float]:
    """Return cx, cy, wx, wy of two pieces; often one of them rests."""
    path = [number(rng) for _ in range(8)]
    if rng.random() < 0.3:
        path[4:] = [0.0] * 4
    if rng.random() < 0.3:
        path[0] = path[1] = path[4] = path[5] = 0.0
    return path


def placed(
    rng: random.Random, number: Callable[[random.Random], float], time: float, foot: float
) -> list[float]:
    """Return the numbers of a vertex that comes about at a time to a place along an edge."""
    qx, qy, rx, ry = (number(rng) for _ in range(4))
    path = any_path(rng, number)
    cx, cy, wx, wy = (path[k] - path[k + 4] for k in range(4))
    px = qx + foot * (rx - qx) - cx - wx * time
    py = qy + foot * (ry - qy) - cy - wy * time
    return [px, py, qx, qy, rx, ry, *path]


def nearly_parallel(rng: random.Random, row: list[float]) -> list[float]:
    """Return numbers of which the relative speed is almost along the edge."""
    ux, uy = row[4] - row[2], row[5] - row[3]
    along, off = rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0) * 2.0 ** -rng.randint(20, 60)
    row[12] = row[13] = 0.0
    row[8], row[9] = along * ux - off * uy, along * uy + off * ux
    time, foot = rng.uniform(-2.0, 2.0), rng.uniform(-0.5, 1.5)
    cx, cy = row[6] - row[10], row[7] - row[11]
    row[0] = row[2] + foot * ux - cx - row[8] * time
    row[1] = row[3] + foot * uy - cy - row[9] * time
    return row


def far(rng: random.Random, row: list[float]) -> list[float]:
    """Return numbers relative to a far origin, in the places or in the paths."""
    x, y = rng.uniform(-1.0, 1.0) * 2.0**40, rng.uniform(-1.0, 1.0) * 2.0**40
    in_places = rng.random() < 0.5
    for k in (0, 2, 4) if in_places else (6, 10):
        row[k], row[k + 1] = row[k] + x, row[k + 1] + y
    return row


def scaled(rng: random.Random, row: list[float], least: int, most: int) -> list[float]:
    """Return numbers multiplied by a power of two."""
    factor = 2.0 ** rng.randint(least, most)
    return [x * factor for x in row]


def stated(rng: random.Random, kind: str) -> Errors:
    """Return errors of a piece."""
    if kind == "thirds":  # as a reader rounds them, for numbers of a size up to 64
        return Errors(*(2 * U * 64.0 + 2.0**-500 for _ in range(3)))
    scale = 2.0 ** -rng.randint(8, 50)
    if rng.random() < 0.5:
        alone = rng.randrange(3)
        return Errors(*(scale if k == alone else 0.0 for k in range(3)))
    return Errors(
        *(rng.choice([0.0, rng.random(), rng.random() * 2.0**-20]) * scale for _ in "123")
    )


KINDS: Final = (
    "random", "grid", "parallel", "far", "tiny", "subnormal", "near zero", "huge", "stated",
    "thirds", "point",
)  # fmt: skip
AIMS: Final = ("none", "window", "span", "foot", "line", "slope")


def raw_row(rng: random.Random, kind: str, aim: str) -> Row:
    """Return a row that is not aimed yet: its exact numbers are missing."""
    is_grid = kind in {"grid", "point"} or (kind == "parallel" and rng.random() < 0.5)
    number = grid_number if is_grid else random_number
    time = rng.choice([0.0, 1.0, 0.5, rng.uniform(-2.0, 2.0)])
    foot = rng.choice([0.0, 1.0]) if aim == "foot" else rng.uniform(-0.2, 1.2)
    row = placed(rng, number, time, foot)
    if kind == "parallel" or aim in {"line", "slope"}:
        row = nearly_parallel(rng, row)
    if kind == "far":
        row = far(rng, row)
    if rng.random() < 0.15:  # upright or level, so that some products are 0
        axis = rng.randrange(2)
        row[4 + axis] = row[2 + axis]
        if rng.random() < 0.5:
            row[axis], row[6 + axis], row[10 + axis] = row[2 + axis], 0.0, 0.0
    if kind == "tiny":
        row = scaled(rng, row, -160, -60)
    if kind == "subnormal":
        row = scaled(rng, row, -1070, -400)
    if kind == "near zero":  # z is subnormal, u and w are not
        row = [0.0, 0.0, *row[2:6], 0.0, 0.0, *row[8:10], 0.0, 0.0, *row[12:]]
        row[2], row[3] = (number(rng) * 2.0 ** -rng.randint(1060, 1072) for _ in range(2))
    if kind == "huge":
        row = scaled(rng, row, 90, 515)
    if kind == "point":
        row[4], row[5] = row[2], row[3]
        row[0], row[1] = (
            row[2 + k] + row[10 + k] - row[6 + k] + (row[12 + k] - row[8 + k]) * time
            for k in (0, 1)
        )
    errors = EXACT, EXACT
    if kind in {"stated", "thirds"}:
        errors = stated(rng, kind), stated(rng, kind)
    size = 3.0 if rng.random() < 0.8 else rng.choice([0.0, 2.0**-40, 2.0**20])
    low, high = sorted((rng.uniform(-size, size), rng.uniform(-size, size)))
    if kind == "point" and rng.random() < 0.8:
        low, high = rng.choice([(time, time + 1.0), (time - 1.0, time), (time, time)])
        errors = powers(rng), powers(rng)
    return Row(kind, aim, tuple(row), (), errors, low, high)


def aimed(rng: random.Random, row: Row) -> Row:
    """Return a row at a tie of what it is aimed at, off by up to twice the bound."""
    off = rng.uniform(-2.0, 2.0) if rng.random() < 0.7 else rng.uniform(-0.1, 0.1)
    known = bounds_of(row)
    numbers = list(row.doubles)
    ux, uy = numbers[4] - numbers[2], numbers[5] - numbers[3]
    squared = ux * ux + uy * uy
    if row.aim == "window" and known.r < 1e300:
        low, high = known.t - rng.random(), known.t + rng.random()
        if rng.random() < 0.5:
            return replace(row, low=known.t + off * known.r, high=max(high, low))
        return replace(row, high=known.t + off * known.r, low=min(low, known.t - 3.0 * known.r))
    if row.aim == "span" and known.r < 1e300:
        bound = known.t + off * known.r
        low, high = known.t - 1.0, known.t + 1.0
        if rng.random() < 0.5:
            return replace(row, start=bound, low=max(bound, low), high=high)
        return replace(row, end=bound, high=min(bound, high), low=low)
    if row.aim == "foot" and squared > 0.0 and known.foot < 1e300:
        numbers[0] += off * known.foot / squared * ux
        numbers[1] += off * known.foot / squared * uy
        return replace(row, doubles=tuple(numbers), low=known.t - 1.0, high=known.t + 1.0)
    if row.aim == "slope" and squared > 0.0:
        more = (1.0 + abs(off)) * known.e1 - known.c1  # a slope of one or two errors
        numbers[8] -= more * uy / squared
        numbers[9] += more * ux / squared
        return replace(row, doubles=tuple(numbers))
    if row.aim == "line" and squared > 0.0:
        times = max(abs(row.low), abs(row.high))
        bound = known.e0 + (abs(known.c1) + known.e1) * times
        more = off * bound - known.c0
        numbers[0] -= more * uy / squared
        numbers[1] += more * ux / squared
        return replace(row, doubles=tuple(numbers))
    return row


def with_exact(rng: random.Random, row: Row) -> Row:
    """Return a row with exact numbers within the errors: at their ends, or thirds and sevenths."""
    if not all(map(math.isfinite, row.doubles)):
        return row
    if row.kind == "thirds":
        steps = 1 << 40
        doubles: list[float] = []
        exact: list[int] = []
        for x in row.doubles:
            n = round(x * steps * THIRDS)
            doubles.append(n / (steps * THIRDS))
            exact.append(n << 1034)
        return replace(row, doubles=tuple(doubles), exact=tuple(exact))
    if row.kind == "point":
        return with_wrong_doubles(rng, row)
    of = errors_of(row)
    signs = [rng.choice((-THIRDS, THIRDS)) for _ in of]
    if rng.random() < 0.2:
        signs = [rng.randint(-THIRDS, THIRDS) for _ in of]
    elif row.kind == "stated":
        signs = worst_signs(rng, row, of)
    integers, _ = as_integers([*row.doubles, *of])
    exact = [
        x * THIRDS + error * sign
        for x, error, sign in zip(integers[:NUMBERS], integers[NUMBERS:], signs, strict=True)
    ]
    return replace(row, exact=tuple(exact))


def errors_of(row: Row) -> list[float]:
    """Return the error of each number of a row."""
    of = [row.errors[0].place] * 2 + [row.errors[1].place] * 4
    for errors in row.errors:
        of += [errors.path] * 2 + [errors.speed] * 2
    return of


def with_wrong_doubles(rng: random.Random, row: Row) -> Row:
    """Return a row whose doubles are moved by the errors; its numbers become the exact ones.

    For two points come together by exact numbers alone.
    """
    of = errors_of(row)
    of[4:6] = of[2:4]
    doubles = [x + rng.choice((-error, error)) for x, error in zip(row.doubles, of, strict=True)]
    doubles[4:6] = doubles[2:4]
    integers, _ = as_integers([*row.doubles, *doubles])
    exact = tuple(x * THIRDS for x in integers[:NUMBERS])
    return replace(row, doubles=tuple(doubles), exact=exact)


def powers(rng: random.Random) -> Errors:
    """Return errors that are powers of two: integers are moved by them without rounding."""
    sizes = [rng.choice([0.0, 2.0 ** -rng.randint(2, 40)]) for _ in range(3)]
    return Errors(*sizes)


def worst_signs(rng: random.Random, row: Row, errors: list[float]) -> list[int]:
    """Return signs of errors that all move the aim of a row to one side, where that is visible."""
    side = rng.choice((-THIRDS, THIRDS))
    base = aim_of(row.aim, row.doubles)
    signs: list[int] = []
    for k, error in enumerate(errors):
        moved = list(row.doubles)
        moved[k] += error
        signs.append(side if aim_of(row.aim, moved) >= base else -side)
    return signs


def aim_of(aim: str, numbers: Sequence[float]) -> float:
    """Return what a row is aimed at: the place of the foot, f, its slope, or the time."""
    px, py, qx, qy, rx, ry, ax, ay, avx, avy, bx, by, bvx, bvy = numbers
    ux, uy, zx, zy = rx - qx, ry - qy, px - qx + ax - bx, py - qy + ay - by
    wx, wy = avx - bvx, avy - bvy
    c0, c1 = ux * zy - uy * zx, ux * wy - uy * wx
    if aim == "line" or not c1:
        return abs(c0)
    if aim == "slope":
        return c1
    t = -c0 / c1
    if aim != "foot":
        return t
    return ((zx + wx * t) * ux + (zy + wy * t) * uy) / (ux * ux + uy * uy)


def make_row(rng: random.Random, kind: str) -> Row:
    """Return a row of a kind, with any aim."""
    row = raw_row(rng, kind, rng.choice(AIMS))
    if row.aim != "none":
        row = aimed(rng, row)
    return with_exact(rng, row)


UNKNOWN: Final = (math.nan, math.inf, -math.inf)


def with_unknown(rng: random.Random, row: Row) -> Row:
    """Return a row with a number that is NaN or infinite, or with such an error."""
    numbers = list(row.doubles)
    if rng.random() < 0.7:
        numbers[rng.randrange(NUMBERS)] = rng.choice(UNKNOWN)
        return replace(row, doubles=tuple(numbers), exact=())
    errors = Errors(*(rng.choice([math.nan, math.inf]) for _ in range(3)))
    return replace(row, errors=(errors, row.errors[1]), exact=())
