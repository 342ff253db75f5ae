"""Families of a point and a segment whose ends move straight, each at its own velocity.

All coordinates at both ends of the time span [0, 1] are integers below 2^52 in units of a power of
two. So positions and velocities are doubles, in three dimensions too, and nothing is rounded.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Final, NamedTuple, TypeAlias

from benchmarks.collision_set.places import Corners, Place, cross, mean, minus, plus, shifted, times
from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten

FINE: Final = 40
"""Number of binary places of a hair."""
EIGHTHS: Final = 8
"""Number of steps of a passage whose contact is at a multiple of 1/8."""


class Passage(NamedTuple):
    """A point and the two ends of a segment at the times 0 and 1.

    Attributes:
        start, end: the point, the first and the last end, in units of 2^-bits.
        bits: the number of binary places.
    """

    start: Corners
    end: Corners
    bits: int = 0


Family: TypeAlias = Callable[[Random], Passage]


def onto_end(rng: Random) -> Passage:
    """A point aimed at an end of a segment that translates."""
    return _towards(rng, _steps(rng), along=0)


def onto_inside(rng: Random) -> Passage:
    """A point aimed at the midpoint or a quarter of a segment that translates."""
    return _towards(rng, _steps(rng), along=rng.randint(1, 3))


def past_end(rng: Random) -> Passage:
    """A point that misses or hits an end by a hair, 2^-40 to 2^-10."""
    return _moved_point(_towards(rng, _steps(rng), along=0), _hair(rng))


def along(rng: Random) -> Passage:
    """A point on the line of a segment, which moves along that line, towards an end or away."""
    way, at = _direction(rng), rng.choice([-2, -1, 5, 6, 7])
    speed = rng.choice([-4, -2, -1, 1, 2, 4, 8])
    start = (times(way, at), (0, 0), times(way, 4))
    return Passage(start, (times(way, at + speed), *start[1:]))


def beside(rng: Random) -> Passage:
    """A point that moves along a segment at the distance of a hair, or on it."""
    return _moved_point(along(rng), rng.choice([(0, 0), _hair(rng), _hair(rng)]))


def at_start(rng: Random) -> Passage:
    """A point on the segment at the start, or a hair from it, which parts, slides or goes on."""
    passage = _towards(rng, 0, along=rng.randint(0, 4))
    return _moved_point(passage, rng.choice([(0, 0), (0, 0), _hair(rng)]))


def at_end(rng: Random) -> Passage:
    """A point that reaches the segment at the end of the time span, or a hair after it."""
    passage = _towards(rng, EIGHTHS, along=rng.randint(0, 4))
    return _moved_point(passage, rng.choice([(0, 0), (0, 0), _hair(rng)]))


def far_away(rng: Random) -> Passage:
    """A point aimed at a segment, far from the origin."""
    p = _towards(rng, _steps(rng), along=rng.randint(0, 4))
    x, y = (rng.choice([-1, 1]) * (1 << rng.randint(20, 48)) for _ in range(2))
    start, end = (shifted(corners, (x, y)) for corners in (p.start, p.end))
    return Passage(start, end, rng.randint(0, 20))


def fast(rng: Random) -> Passage:
    """A point that flies a million times the length of the segment."""
    p, steps = _towards(rng, 0, along=rng.randint(0, 4)), _steps(rng)
    (at, a, b), flight = p.start, _place(rng, 1 << 20)
    first, last = (minus(at, times(flight, k)) for k in (steps, steps - EIGHTHS))
    return Passage((first, a, b), (last, a, b))


def together(rng: Random) -> Passage:
    """A point and a segment at rest to each other: apart, in touch, or on one line."""
    way, off = _direction(rng), _hair(rng, zero=True)
    at = times(way, rng.randint(-2, 6))
    corners = at, (0, 0), times(way, 4)
    return _moved_point(Passage(corners, corners), off)


def tangent(rng: Random) -> Passage:
    """A segment that turns and is touched by the point at a double root, mostly inside."""
    return _touched(rng)


def nearly_tangent(rng: Random) -> Passage:
    """The same but for a hair: two roots next to each other, or none."""
    return _moved_point(_touched(rng), _hair(rng))


def two_roots(rng: Random) -> Passage:
    """A point that crosses the line of a segment that turns twice, on the segment or beside it."""
    while True:
        passage = _anywhere(rng, 8)
        c0, c1, c2 = polynomial(passage)
        ends = c0 * (c0 + c1 + c2) > 0
        if ends and 0 < -c1 * c2 < 2 * c2 * c2 and c1 * c1 > 4 * c0 * c2:
            return passage


def level(rng: Random) -> Passage:
    """A segment that turns, with a polynomial whose leading coefficient vanishes."""
    p, way = _anywhere(rng, 8), _direction(rng)
    speeds = [times(way, rng.randint(-3, 3)) for _ in range(2)]
    a = minus(p.end[1], p.start[1])
    ends = [plus(plus(corner, a), v) for corner, v in zip(p.start[::2], speeds, strict=True)]
    return Passage(p.start, (ends[0], p.end[1], ends[1]))


def lattice(rng: Random) -> Passage:
    """Small integers: most of what happens, happens at an end, at the start or for ever."""
    return _anywhere(rng, 2)


def straight(rng: Random) -> Passage:
    """A segment that translates, 50 random bits each."""
    p = _anywhere(rng, 1 << 50)
    by = minus(p.end[1], p.start[1])
    return Passage(p.start, (p.end[0], p.end[1], plus(p.start[2], by)), 50)


def turning(rng: Random) -> Passage:
    """Three corners on ways of their own, 50 random bits each."""
    return _anywhere(rng, 1 << 50)._replace(bits=50)


def aimed(rng: Random) -> Passage:
    """Three corners on ways of their own, which meet near a random time."""
    p = _anywhere(rng, 1 << 46)
    late, share = rng.randint(1, 15), rng.randint(1, 15)
    (_, a0, b0), (_, a1, b1) = p.start, p.end
    a, b = (mean(f, g, late) for f, g in ((a0, a1), (b0, b1)))
    at, flight = mean(a, b, share), _place(rng, 1 << 44)
    first, last = (minus(at, times(flight, k)) for k in (late, late - 16))
    return Passage((first, a0, b0), (last, a1, b1), 50)


def single_precision(rng: Random) -> Passage:
    """Three corners on ways of their own, at places that single precision holds."""
    return _anywhere(rng, 1 << 19)._replace(bits=19)


DEGENERATE: Final[dict[str, Family]] = {
    f.__name__: f
    for f in (
        onto_end, onto_inside, past_end, along, beside, at_start, at_end, far_away, fast, together,
        tangent, nearly_tangent, two_roots, level, lattice,
    )
}  # fmt: skip
"""Families whose passages are nearly or fully degenerate."""

GENERIC: Final[dict[str, Family]] = {
    f.__name__: f for f in (straight, turning, aimed, single_precision)
}
"""Families of random numbers."""

FAMILIES: Final[dict[str, Family]] = {**DEGENERATE, **GENERIC}
"""All families of a point and a segment."""


def make_passage(family: str, number: int) -> Passage:
    """The passage of a family, the same on every machine, whose segment is never a point.

    Raises:
        InputError: if there is no such family.
    """
    if family not in FAMILIES:
        raise InputError(f"no family {shorten(family)}; there are: {', '.join(FAMILIES)}")
    rng = Random(f"{family}:{number}")
    while True:
        passage = _disguised(rng, FAMILIES[family](rng))
        if not _is_once_a_point(passage):
            return passage


def polynomial(passage: Passage) -> tuple[int, int, int]:
    """(b - a) x (p - a) as a polynomial in t, the constant first, in units of 2^(-2 bits)."""
    (p0, a0, b0), (p1, a1, b1) = passage.start, passage.end
    u, w = minus(b0, a0), minus(p0, a0)
    du, dw = minus(minus(b1, a1), u), minus(minus(p1, a1), w)
    return cross(u, w), cross(u, dw) + cross(du, w), cross(du, dw)


def _is_once_a_point(passage: Passage) -> bool:
    """Return True if the segment's ends coincide at a time of [0, 1]."""
    u, v = (minus(c[2], c[1]) for c in (passage.start, passage.end))
    # u (1 - t) + v t vanishes for a t in [0, 1] iff u and v are opposite, or one is 0.
    return cross(u, v) == 0 and u[0] * v[0] + u[1] * v[1] <= 0


def _disguised(rng: Random, p: Passage) -> Passage:
    """The passage mirrored, at another place, in another frame, and with the ends swapped."""
    across, swapped = rng.random() < 0.5, rng.random() < 0.5
    flips = [rng.choice([-1, 1]) for _ in range(2)]
    unit = 1 << min(p.bits, FINE)
    place, drift = (
        (rng.randint(-8, 8) * unit, rng.randint(-8, 8) * unit) if rng.random() < 0.5 else (0, 0)
        for _ in range(2)
    )

    def seen(corners: Corners, offset: Place) -> Corners:
        turned = [(x * flips[0], y * flips[1]) for x, y in corners]
        q, a, b = [(y, x) for x, y in turned] if across else turned
        return shifted((q, b, a) if swapped else (q, a, b), offset)

    return Passage(seen(p.start, place), seen(p.end, plus(place, drift)), p.bits)


def _towards(rng: Random, steps: int, *, along: int) -> Passage:
    """A point that is at a place of the segment, in fourths of it, after so many eighths."""
    way, flight = _direction(rng), _direction(rng)
    at = times(way, along)
    first, last = (minus(at, times(flight, k)) for k in (steps, steps - EIGHTHS))
    return Passage((first, (0, 0), times(way, 4)), (last, (0, 0), times(way, 4)))


def _touched(rng: Random) -> Passage:
    """A turning segment from the origin, and a point on it at one time, to which it is tangent.

    Let b(s) = 4 (B + W s), where s counts eighths since that time, and p(s) = j B + (j W + m B) s.
    Then b x p = 4 m (W x B) s^2.
    """
    steps, j, m = _steps(rng), rng.randint(0, 4), rng.choice([-2, -1, 1, 2])
    way, turn = _direction(rng), _direction(rng)
    speed = plus(times(turn, j), times(way, m))
    first, last = (
        (plus(times(way, j), times(speed, s)), (0, 0), times(plus(way, times(turn, s)), 4))
        for s in (-steps, EIGHTHS - steps)
    )
    return Passage(first, last)


def _moved_point(p: Passage, hair: Place) -> Passage:
    """The passage in units of 2^-40, its point moved by so many of them."""
    corners = [tuple((x << FINE, y << FINE) for x, y in c) for c in (p.start, p.end)]
    (p0, a0, b0), (p1, a1, b1) = corners
    return Passage((plus(p0, hair), a0, b0), (plus(p1, hair), a1, b1), FINE)


def _hair(rng: Random, *, zero: bool = False) -> Place:
    size = 1 << rng.choice([0, 10, 20, 30])
    if zero and rng.random() < 0.5:
        return 0, 0
    return rng.choice([(size, 0), (-size, 0), (0, size), (0, -size)])


def _anywhere(rng: Random, size: int) -> Passage:
    p, a, b, q, c, d = (_place(rng, size) for _ in range(6))
    return Passage((p, a, b), (q, c, d))


def _place(rng: Random, size: int) -> Place:
    return rng.randint(-size, size), rng.randint(-size, size)


def _direction(rng: Random) -> Place:
    while True:
        way = _place(rng, 4)
        if way != (0, 0):
            return way


def _steps(rng: Random) -> int:
    return rng.randint(1, EIGHTHS - 1)
