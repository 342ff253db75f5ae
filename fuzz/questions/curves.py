"""Motions along curves of SciPy: which are refused, and how far a motion is from the given curve.

A curve is random polynomials, of which each begins where the one before ends, but for some ulps of
the largest term there, or for a real jump. It is evaluated here as it is given, with its jumps.
The motion of `spline` or `PosePath.of_curve` must be within its errors of that, and the errors must
be the required one and the largest running sum of the jumps.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from random import Random
from typing import Any, Final, final

import mpmath
import numpy as np

from exactpt.errors import InputError
from exactpt.motion.body import Body
from exactpt.motion.local_time import Spline, spline
from exactpt.motion.motions import Rigid
from exactpt.motion.pose_path import PosePath
from exactpt.scene.scene import Scene
from exactpt.scene.written import to_json
from fuzz.references.true_turns import real

__all__ = ["Curve", "random_curve", "wrong_along"]

ALLOWED: Final = 8
"""Ulps of the largest term by which a curve may jump."""
ERROR: Final = Fraction(1, 1000)
DIGITS: Final = 50


@final
@dataclass
class Curve:
    """The attributes of SciPy's ``PPoly``: coefficients, the highest power first, and times."""

    c: np.ndarray
    x: list[float]

    def at(self, piece: int, t: Fraction) -> list[Fraction]:
        """Return the values of all columns at a time, by one of the pieces."""
        s = t - Fraction(self.x[piece])
        return [
            sum((Fraction(c) * s**k for k, c in enumerate(reversed(column))), Fraction(0))
            for column in self.c[:, piece].T.tolist()
        ]

    def jumps(self) -> list[list[Fraction]]:
        """Return the jumps of all columns at the beginning of each piece but the first."""
        return [
            [b - a for a, b in zip(self.at(i, t), self.at(i + 1, t), strict=True)]
            for i in range(len(self.x) - 2)
            for t in [Fraction(self.x[i + 1])]
        ]

    def largest_terms(self, piece: int) -> list[Fraction]:
        """Return the largest of the terms in each column at the end of a piece, on both sides."""
        h = Fraction(self.x[piece + 1]) - Fraction(self.x[piece])
        return [
            max(
                abs(Fraction(begin)),
                *(abs(Fraction(c)) * h**k for k, c in enumerate(reversed(column))),
            )
            for column, begin in zip(
                self.c[:, piece].T.tolist(), self.c[-1, piece + 1].tolist(), strict=True
            )
        ]


def random_curve(random: Random, columns: int) -> Curve:
    """Return a curve that jumps by some ulps, or by more."""
    pieces, degree = random.randint(1, 4), random.choice([0, 1, 3, 3, 5])
    scale = 10.0 ** random.randint(-3, 3)
    times = [random.choice([0.0, -1.5, 100.0])]
    for _ in range(pieces):
        times.append(times[-1] + random.choice([0.5, 1.0, 0.1, 0.7]))
    c = np.array([
        [[random.uniform(-1, 1) * (scale if k < 2 else 1) for k in range(columns)]
         for _ in range(pieces)]
        for _ in range(degree + 1)
    ])  # fmt: skip
    curve = Curve(c, times)
    most = random.choice([0, 1, 3, 7, 8, 9, 30])
    for i in range(1, pieces):
        for k, end in enumerate(curve.at(i - 1, Fraction(times[i]))):
            c[-1, i, k] = float(end)
            c[-1, i, k] += random.randint(-most, most) * math.ulp(c[:, i - 1, k].max())
    if random.random() < 0.1:
        c[-1, -1, random.randrange(columns)] += random.choice([1e-9, 1.0, -100.0])
    return curve


def wrong_along(random: Random) -> tuple[Scene, str, str | None]:
    """Return a scene with a body on a random curve, its kind, and the fault of the motion."""
    columns = random.choice([2, 3])
    curve = random_curve(random, columns)
    is_allowed = all(
        abs(jump) <= ALLOWED * _ulp(largest)
        for i, jumps in enumerate(curve.jumps())
        for jump, largest in zip(jumps, curve.largest_terms(i), strict=True)
    )
    empty = Scene([Body("b", [(1, 0)])], time=(0, 1 + random.random()))
    try:
        motion = spline(curve) if columns == 2 else PosePath.of_curve(curve, error=ERROR)
    except InputError as error:
        expected = " jumps at t = " in str(error) and not is_allowed
        return empty, "refused", None if expected else f"refused: {error}"
    if not is_allowed:
        return empty, "wrong", "it jumps and is not refused"
    scene = Scene([Body("b", [(1, 0)], motion)], time=(curve.x[0], curve.x[-1]))
    if Scene.from_json(to_json(scene)).bodies[0].motion != motion:
        return scene, "wrong", "another motion is read from its file"
    kind = f"{type(motion).__name__}, {'closed up' if any(map(any, curve.jumps())) else 'exact'}"
    return scene, kind, _wrong_errors(curve, motion) or _far(random, curve, motion)


def _ulp(size: Fraction) -> Fraction:
    """Return the unit in the last place of the greatest double up to a number."""
    near = float(size)
    if Fraction(near) > size:
        near = math.nextafter(near, 0)
    return Fraction(math.ulp(near))


def _wrong_errors(curve: Curve, motion: Spline | PosePath) -> str | None:
    """Return the fault of the errors of a motion: they follow from running sums of jumps."""
    sums = [[Fraction(0)] * curve.c.shape[2]]
    for jumps in curve.jumps():
        sums.append([s + jump for s, jump in zip(sums[-1], jumps, strict=True)])
    squared = max(x * x + y * y for x, y, *_ in sums)
    if isinstance(motion, Spline):
        place = motion.error
    else:
        degree = curve.c.shape[0] - 1
        place = motion.place_error - (Fraction(1, 10**6) if degree > 3 else 0)
        angle = max(abs(s) for _, _, s in sums)
        if (motion.error, motion.assumed_angle_error) != (ERROR, angle):
            return f"errors of the angle: {motion.error}, {motion.assumed_angle_error}, not {angle}"
    if not squared <= place * place <= squared * (1 + Fraction(1, 10**6)):
        return f"error of the place {float(place)}, not {math.sqrt(squared)}"
    return None


def _far(random: Random, curve: Curve, motion: Spline | PosePath) -> str | None:
    """Return where a motion is farther from the given curve than its errors."""
    for i, (begin, end) in enumerate(pairwise(map(Fraction, curve.x))):
        for part in (Fraction(0), Fraction(random.randint(1, 99), 100), Fraction(1)):
            t = begin + (end - begin) * part
            x, y, *angle = curve.at(i, t)
            until = next(k for k, at in enumerate((*motion.until, t)) if t <= at)
            piece: Any = motion.motions[until]
            off = (piece.x(t) - x) ** 2 + (piece.y(t) - y) ** 2
            place = motion.error if isinstance(motion, Spline) else motion.place_error
            if off > place * place:
                return f"at t = {t} it is {math.sqrt(off)} from the curve, and the error {place}"
            if angle and _turned_off(piece, t, angle[0]) > real(motion.error):
                return f"at t = {t} its angle is off by more than {motion.error}"
    return None


def _turned_off(piece: Rigid, t: Fraction, angle: Fraction) -> mpmath.mpf:
    """Return the difference of the angle of a rigid motion from a true one."""
    with mpmath.workdps(DIGITS):
        c, s = map(real, piece.orientation)
        there = mpmath.atan2(s, c) + 2 * mpmath.atan(real(piece.half_turn(t))) - real(angle)
        turns = there / (2 * mpmath.pi)
        return abs(turns - mpmath.nint(turns)) * 2 * mpmath.pi
