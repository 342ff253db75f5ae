"""Boxes of pieces against exact positions, and the pairs of boxes that meet against all pairs.

``python -m fuzz.adversaries.boxes --rows 10000000 --seed 1``. A row is a coordinate of a vertex at
a rational time of the window: it must lie inside the box of its piece, at least the radius away
from its sides. For pairs, a row is a pair of boxes.

The bound is that of rounding: 16 U of the sizes of all terms. Windows end at times that are asked,
errors are as large as stated, and drifts are far larger than velocities, or equal to them: so
many coordinates are as near a side as the bound allows.
"""

from __future__ import annotations

import argparse
import math
import sys
from dataclasses import dataclass
from random import Random
from typing import Final, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt
from librt.vecs import vec

from exactpt.filters import boxes
from exactpt.filters.rounding import U
from exactpt.filters.rows import AFFINE, GENERAL, OWN, PATH_X, PATH_Y, TURNING, Table
from exactpt.kernel.numbers import QQ, nearest_float, rational
from fuzz.adversaries.pieces import KINDS, STYLES, Piece, made

__all__ = ["Found", "attack_pieces", "attack_strips"]

Truths: TypeAlias = npt.NDArray[np.bool_]

UNIT: Final = 16.0 * U
"""The bound of rounding, relative to the sizes of all terms."""
AXES: Final = (int(PATH_X), int(PATH_Y))
"""Where the polynomials of x and y begin, in a frame and in the row of a vertex (`OWN_Y`)."""
TERMS: Final = 4
"""Coefficients of each of them."""


@dataclass
class Found:
    """What an attack found.

    Attributes:
        rows: how many were checked.
        near: how many of them were nearer to the side of the box than two bounds.
        least: the least distance from a side, by the bound.
        wrong: how many answers were wrong.
        first: the first of these.
    """

    rows: int = 0
    near: int = 0
    least: float = math.inf
    wrong: int = 0
    first: str = ""

    def fail(self, text: str) -> None:
        """Count a wrong answer."""
        self.wrong += 1
        self.first = self.first or text

    def line(self, name: str) -> str:
        """Return a line of the table."""
        return f"{name:26}{self.rows:>12,}{self.near:>12,}{self.least:>10.4f}{self.wrong:>7}"


class Drift(NamedTuple):
    """What is common to all bodies along one axis, and taken away.

    Attributes:
        speed: the coefficient of t.
        bend: that of t^2.
    """

    speed: float
    bend: float

    def at(self, t: QQ) -> QQ:
        """Return where it is at a time."""
        return (rational(self.speed) + rational(self.bend) * t) * t

    def size(self, latest: float) -> float:
        """Return the sum of the sizes of its terms up to a time."""
        return (abs(self.speed) + abs(self.bend) * latest) * latest


def attack_pieces(kind: int, rows: int, seed: int) -> Found:
    """Attack the boxes of pieces of one kind."""
    rng = Random(seed)
    found = Found()
    while found.rows < rows:
        style = rng.choice(STYLES)
        piece = made(rng, kind, style, rng.choice((1, 2, 3, 4, 6)))
        for _ in range(3):
            _attack_window(rng, piece, style, found)
    return found


def _attack_window(rng: Random, piece: Piece, style: str, found: Found) -> None:
    """Attack the box of one piece in one window."""
    low = rng.choice((0.0, rng.uniform(-9, 9), float(rng.randint(-9, 9))))
    if style == "random" and rng.random() < 0.2:
        low = rng.uniform(-1, 1) * 2.0 ** rng.randint(10, 30)
    if rng.random() < 0.5:
        low += piece.origin
    high = low + rng.choice((0.0, 1.0, rng.random())) * 2.0 ** -rng.randint(0, 45)
    drift_x = _drift(rng, piece, 0)
    drift_y = _drift(rng, piece, 1)
    drift = boxes.Drift(drift_x.speed, drift_y.speed, drift_x.bend, drift_y.bend)
    table = Table()
    k = piece.add_to(table, 0, low, high)
    radius = rng.choice((0.0, 0.0, 1.0 / 3.0))
    table.radius[k] = radius
    left, right, bottom, top = boxes.of_piece(table, k, low, high, drift)
    first = rational(low)
    last = rational(high)
    between = first + (last - first) * rng.randint(1, 9) / 10
    latest = max(abs(low), abs(high))
    since = max(abs(low - piece.origin), abs(high - piece.origin))
    for t in (first, last, between):
        for v, (x, y) in enumerate(piece.at(t)):
            size_x = _size(piece, v, 0, since) + 2.0 * drift_x.size(latest)
            size_y = _size(piece, v, 1, since) + 2.0 * drift_y.size(latest)
            _check(x - drift_x.at(t), left, right, radius, size_x, found)
            _check(y - drift_y.at(t), bottom, top, radius, size_y, found)


def _drift(rng: Random, piece: Piece, axis: int) -> Drift:
    """Return a common velocity and bend: none, those of the piece, or much larger ones."""
    own = Drift(0.0, 0.0)
    if piece.kind != GENERAL:
        numbers = piece.near_own if piece.kind == OWN else piece.near_frame
        polynomial = numbers[AXES[axis] : AXES[axis] + TERMS]
        own = Drift(speed=polynomial[1], bend=polynomial[2])
    speed = rng.choice((0.0, own.speed, rng.uniform(-9, 9), rng.uniform(-1, 1) * 2.0**40))
    bend = rng.choice((0.0, own.bend, rng.uniform(-9, 9), rng.uniform(-1, 1) * 2.0**30))
    return Drift(speed, bend)


def _size(piece: Piece, v: int, axis: int, latest: float) -> float:
    """Return the sum of the sizes of all terms of a coordinate, without the drift."""
    if piece.kind == OWN:
        return _reach(piece.own[v][axis], latest)
    if piece.kind == GENERAL:  # w is about 1 at most times at which there is a model
        anchor = piece.near_frame[AXES[axis]]
        return _reach(piece.general[v][axis], latest) + abs(anchor)
    path = _reach(piece.frame[axis], latest)
    largest_x = max(abs(x) for x, _ in piece.near_places)
    largest_y = max(abs(y) for _, y in piece.near_places)
    if piece.kind == AFFINE:
        a, b, c, d = piece.frame[2:]
        of_x, of_y = (a, b) if axis == 0 else (c, d)
        return path + _reach(of_x, latest) * largest_x + _reach(of_y, latest) * largest_y
    if piece.kind == TURNING:
        return path + math.hypot(largest_x, largest_y)
    return path + (largest_x if axis == 0 else largest_y)


def _reach(f: tuple[QQ, ...], latest: float) -> float:
    """Return the sum of the sizes of the terms of a polynomial up to a time."""
    return sum(abs(nearest_float(c)) * latest**i for i, c in enumerate(f))


def _check(x: QQ, low: float, high: float, radius: float, size: float, found: Found) -> None:
    """Check that a coordinate is inside, a radius away from both sides."""
    found.rows += 1
    if low == -math.inf or high == math.inf:
        return
    exact_radius = rational(radius)
    above_low = x - exact_radius - rational(low)
    below_high = rational(high) - x - exact_radius
    gap = min(above_low, below_high)
    if gap < 0:
        found.fail(f"{x} is outside of [{low!r}, {high!r}] by {nearest_float(-gap)}")
    bound = UNIT * size
    if bound > 1e-300:
        ratio = nearest_float(gap) / bound
        found.least = min(found.least, ratio)
        found.near += ratio < 2.0


def attack_strips(rows: int, seed: int) -> Found:
    """Attack the pairs of boxes that meet; near are those that have only a side in common."""
    rng = Random(seed)
    found = Found()
    while found.rows < rows:
        sides = _sides(rng)
        split = rng.choice((0, 0, rng.randrange(len(sides) + 1)))
        flat = vec[float](sides.ravel().tolist())
        pairs = list(boxes.strips(flat, split))
        claimed = list(zip(pairs[::2], pairs[1::2], strict=True))
        meet, touch = _meeting(sides)
        if split > 0:
            is_first = np.arange(len(sides)) < split
            meet &= is_first[:, None] != is_first[None, :]
        right = {(int(i), int(j)) for i, j in np.argwhere(np.triu(meet, 1))}
        found.rows += len(sides) * (len(sides) - 1) // 2
        found.near += int(np.triu(meet & touch, 1).sum())
        has_repeated = len(claimed) != len(set(claimed))
        lost = right - set(claimed)
        more = set(claimed) - right
        if has_repeated or lost or more:
            found.fail(f"{len(sides)} boxes, split {split}: lost {lost}, more {more}")
    return found


def _sides(rng: Random) -> npt.NDArray[np.float64]:
    """Return boxes: of integers, of doubles, equal, nested, flat, unbounded, undefined."""
    numbers = np.random.default_rng(rng.getrandbits(32))
    n = rng.choice((1, 2, 5, 40, 128, 129, 300, 900))
    scale = 2.0 ** rng.choice((0, 0, 0, 100, -300, -1060))
    extent = rng.choice((3, 30, 300))
    if rng.random() < 0.5:
        corner = numbers.integers(-extent, extent, (n, 2)).astype(float)
        sizes = numbers.integers(0, 4, (n, 2)).astype(float)
    else:
        corner = numbers.uniform(-extent, extent, (n, 2))
        sizes = numbers.exponential(rng.choice((0.1, 1.0, 30.0)), (n, 2))
    if rng.random() < 0.2:
        sizes *= 10.0 ** numbers.uniform(-6, 3, (n, 1))  # nested ones
    if rng.random() < 0.2:
        corner[:, rng.randrange(2)] = 1.0  # all in one row
    ends = corner + sizes
    sides = np.stack((corner[:, 0], ends[:, 0], corner[:, 1], ends[:, 1]), axis=1) * scale
    if rng.random() < 0.3:
        odd = numbers.random((n, 4)) < 0.05
        outward = np.array([-math.inf, math.inf, -math.inf, math.inf])
        sides = np.where(odd, rng.choice((outward, np.full(4, math.nan))), sides)
    if rng.random() < 0.1:
        sides[: n // 2] = sides[0]
    return sides


def _meeting(sides: npt.NDArray[np.float64]) -> tuple[Truths, Truths]:
    """Return which boxes are not apart, and which of these have only a side in common."""
    left, right, bottom, top = sides.T
    is_beyond = (left[:, None] > right) | (bottom[:, None] > top)
    is_beside = (left[:, None] == right) | (bottom[:, None] == top)
    are_apart = is_beyond | is_beyond.T
    have_side = is_beside | is_beside.T
    return ~are_apart, have_side


def main() -> None:
    """Attack, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rows", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    each = options.rows // (len(KINDS) + 1)
    show(f"{'':26}{'rows':>12}{'near':>12}{'least':>10}{'wrong':>7}")
    for name, kind in KINDS.items():
        found = attack_pieces(kind, each, options.seed)
        show(f"{found.line(f'boxes, {name}')} {found.first}")
    found = attack_strips(each, options.seed)
    found.least = 0.0
    show(f"{found.line('pairs of boxes')} {found.first}")


def show(line: str) -> None:
    """Print a line at once."""
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
