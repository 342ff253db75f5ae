"""The reader of both checkers: numbers, polynomials and their roots, and the scene.

Both `exactpt.proof_check`, of proofs by tilings, and `exactpt.check_apart`, of certificates, import
this module. A checker that is handed out (`exactpt check --write-checker` and `--write-apart`) is
one file, in which the text of this module takes the place of the import.

It imports the standard library alone and uses no floats. A scene is read as docs/scene-grammar.md
states, and whatever is not understood is refused.
"""

import json
import re
from bisect import bisect_right
from calendar import monthrange
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from decimal import MAX_EMAX, MAX_PREC, MIN_EMIN, Context, Decimal
from fractions import Fraction
from functools import lru_cache
from itertools import accumulate, chain, dropwhile, pairwise, zip_longest
from math import comb, floor, gcd, lcm
from operator import mul, not_
from pathlib import Path
from typing import Any, TextIO, TypeVar

Point = tuple[Fraction, Fraction]
Dart = tuple[int, int]
Json = Any


class NoProofError(Exception):
    """The files are not a scene or not a proof in the format, or the proof is of another scene."""


class Rejected(Exception):  # noqa: N818 - a verdict
    """A line of the proof does not hold."""


class Exhausted(Exception):  # noqa: N818 - no verdict
    """The budget of work is used up."""


class Work:
    """The work that is left of one check: products of two words of 64 bits, by estimate."""

    usual = 5 * 10**8

    def __init__(self, left: int) -> None:
        self.left = left
        # Results that are computed once in each check: no other check profits from them.
        self.turn = lru_cache(100_000)(counted_turn)
        self.pi_bounds = lru_cache(100)(pi_by_machin)


WORK = ContextVar[Work | None]("WORK", default=None)  # of this thread's check


def spend(products: int) -> None:
    """Count some work of this check; outside of a check nothing is counted."""
    work = WORK.get()
    if work is not None:
        work.left -= products
        if work.left < 0:
            raise Exhausted("not decided: the budget of work is used up (see --work)")


@contextmanager
def budget(work: int | None, files: int = 0) -> Iterator[Work]:
    """Set the budget of a check: by default the usual work, and 2,000 for each byte of files."""
    of_check = Work(Work.usual + 2000 * files if work is None else work)
    token = WORK.set(of_check)
    try:
        yield of_check
    finally:
        WORK.reset(token)


def require(condition: object, why: str) -> None:
    """Reject unless the condition holds."""
    if not condition:
        raise Rejected(why)


# ---- Long integers, in pieces: Python's limit on digits is one of the process, and stays as it is.

PIECE = 640  # digits; no limit is below
EXACT = Context(prec=MAX_PREC, Emin=MIN_EMIN, Emax=MAX_EMAX)  # no integer is rounded


def integer(text: str) -> int:
    """Return the integer that a sign and digits denote."""
    if len(text) <= PIECE:
        return int(text)
    if text[0] in "+-":
        return integer(text[1:]) * (-1 if text[0] == "-" else 1)
    ends = range(len(text), 0, -PIECE)
    pieces = [int(text[max(0, end - PIECE) : end]) for end in ends]  # the lowest one first
    power = 10**PIECE
    while len(pieces) > 1:  # two pieces become one: of a few large products, not of many small ones
        above = zip_longest(pieces[::2], pieces[1::2], fillvalue=0)
        pieces = [low + high * power for low, high in above]
        power *= power if len(pieces) > 1 else 1
    return pieces[0]


def digits(n: int) -> str:
    """Return the digits of an integer, after a sign if it is negative."""
    if n.bit_length() <= 2000:  # less than 640 digits
        return str(n)
    size, raw = 128, abs(n).to_bytes(n.bit_length() // 8 + 1, "little")
    parts = [raw[start : start + size] for start in range(0, len(raw), size)]
    pieces = [Decimal(int.from_bytes(part, "little")) for part in parts]  # the lowest one first
    power = Decimal(1 << (8 * size))
    while len(pieces) > 1:
        above = zip_longest(pieces[::2], pieces[1::2], fillvalue=Decimal(0))
        pieces = [EXACT.fma(high, power, low) for low, high in above]
        power = EXACT.multiply(power, power) if len(pieces) > 1 else power
    return "-" * (n < 0) + str(pieces[0])


def written(q: Fraction | int) -> str:
    """Return a rational number as it is written in a proof."""
    below = q.denominator
    return digits(q.numerator) if below == 1 else f"{digits(q.numerator)}/{digits(below)}"


# ---- Polynomials, and their real roots.

PRIME, TEN = 2**61 - 1, Fraction(10)


def words(n: int) -> int:
    """Return the number of 64-bit words of a number, its denominator's included."""
    return ((n.numerator.bit_length() + n.denominator.bit_length()) >> 6) + 1


def most_words(f: Iterable[Any]) -> int:
    """Return the number of words of the longest of some numbers."""
    return max(map(words, f), default=1)


def longest(integers: Iterable[int]) -> int:
    """Return the number of words of the longest of some integers."""
    return words(max(map(abs, integers)))


class Poly(tuple[Any, ...]):
    """A polynomial in t: coefficients, constant term first, none for 0.

    Coefficients are rational while a scene is read, integers from then on.
    """

    __slots__ = ()

    def __new__(cls, coefficients: Iterable[Any] = ()) -> "Poly":  # noqa: D102
        f = tuple.__new__(cls, coefficients)
        if f and not f[-1]:
            f = tuple.__new__(cls, [*dropwhile(not_, f[::-1])][::-1])
        return f

    def __add__(self, g: "Poly") -> "Poly":  # type: ignore[override]
        both = self and g
        return Poly([a + b for a, b in zip_longest(self, g, fillvalue=0)]) if both else self or g

    def __sub__(self, g: "Poly") -> "Poly":
        return Poly([a - b for a, b in zip_longest(self, g, fillvalue=0)])

    def __mul__(self, g: "Poly") -> "Poly":  # type: ignore[override]
        if len(self) < 2 or not g:
            return g if self == (1,) or not g else Poly([a * b for a in self for b in g])
        if len(self) * len(g) > 8:
            spend(len(self) * len(g) * most_words(self) * most_words(g))
        product = [0] * (len(self) + len(g) - 1)
        for i, a in enumerate(self):
            for j, b in enumerate(g):
                product[i + j] += a * b
        return Poly(product)

    def scaled(self, t: Fraction) -> tuple[int, int]:
        """Return d^k times the value at n / d, with k the number of coefficients; and d^k."""
        n, d, power, total = t.numerator, t.denominator, 1, 0
        if (n | d) >> 64:
            spend(len(self) ** 2 * words(d) * (words(n) + most_words(self)))
        for c in reversed(self):
            total = total * n + c * power
            power *= d
        spend(len(self) * words(total))
        return total * d, power

    def value(self, t: Fraction) -> Fraction:
        """Return the value at a time."""
        return Fraction(*self.scaled(t))

    def along(self, a: Fraction, b: Fraction) -> "Poly":
        """Return the polynomial in s whose value is that of this one at the time a + (b - a) s."""
        f, n = Poly(), len(self)
        spend(n * n * (300 + 2 * (most_words(self) + n * most_words((a, b))) ** 2))
        for c in reversed(self):
            f = f * Poly([a, b - a]) + Poly([c])
        return f

    def derivative(self) -> "Poly":
        """Return the derivative."""
        return Poly([i * c for i, c in enumerate(self)][1:])

    def bound(self, a: Fraction, b: Fraction) -> Fraction:
        """Return the largest absolute value of the Bernstein coefficients on [a, b]."""
        f = self.along(a, b)
        n, found = len(f) - 1, Fraction(0)
        spend(len(f) ** 2 * (300 + 2 * most_words(f) ** 2))
        for j in range(n + 1):
            c = sum((c * comb(j, i) / comb(n, i) for i, c in enumerate(f[: j + 1])), Fraction(0))
            found = max(found, abs(c))
        return found

    def sign_at(self, t: Fraction) -> int:
        """Return the sign of the value at a time."""
        value, _ = self.scaled(t)
        return (value > 0) - (value < 0)

    def primitive(self) -> "Poly":
        """Return the primitive part, with a positive leading coefficient."""
        content = gcd(*self) * (-1 if self[-1] < 0 else 1) if self else 1
        spend(len(self) * most_words(self) * words(content))
        return Poly([c // content for c in self])

    def divided(self, g: "Poly") -> tuple["Poly", "Poly"]:
        """Return (q, r) with c f = q g + r, a number c that is not 0, and deg r < deg g."""
        rest, quotient = list(self), [0] * max(0, len(self) - len(g) + 1)
        spend(len(quotient) * len(self) * most_words(self) * most_words(g))
        for i in range(len(self) - len(g), -1, -1):
            top = rest.pop()
            rest, quotient = [g[-1] * c for c in rest], [g[-1] * c for c in quotient]
            quotient[i] = top
            for j, c in enumerate(g[:-1]):
                rest[i + j] -= top * c
        return Poly(quotient), Poly(rest)

    def is_prime_to(self, g: "Poly") -> bool:
        """Return True if both are coprime modulo a prime that keeps the degree of a divisor."""
        a, b = [c % PRIME for c in self], Poly(c % PRIME for c in g)
        if not a or not a[-1]:
            return False
        while len(b) > 1:
            spend(len(b) * len(a))
            inverse = pow(b[-1], -1, PRIME)
            for i in range(len(a) - len(b), -1, -1):
                q = a[i + len(b) - 1] * inverse % PRIME
                for j, c in enumerate(b if q else []):
                    a[i + j] = (a[i + j] - q * c) % PRIME
            a, b = list(b), Poly(a[: len(b) - 1])
        return len(b) == 1

    def common_divisor(self, g: "Poly") -> "Poly":
        """Return the greatest common divisor, by Euclid's algorithm."""
        if self.is_prime_to(g):
            return Poly([1])
        f = self
        while g:
            f, g = g, f.divided(g)[1].primitive()
        return f.primitive()

    def square_free(self) -> "Poly":
        """Return the polynomial with the same roots, all of them simple."""
        if len(self) < 3:
            return self.primitive()
        return self.divided(self.common_divisor(self.derivative()))[0].primitive()

    def variations(self, low: Fraction, high: Fraction) -> int:
        """Return an upper bound of the number of roots in (low, high), exact if it is 0 or 1.

        Descartes' rule of signs for (1 + x)^n f((high + low x) / (1 + x)), x > 0.
        """
        d = lcm(low.denominator, high.denominator)
        spend(len(self) ** 2 * words(d) * (most_words(self) + len(self) * words(d)))
        start, width, power = int(low * d), int((high - low) * d), 1
        g: list[int] = []  # of s: d^n f(low + (high - low) s)
        for c in reversed(self):
            g = [start * a + width * b for a, b in zip([*g, 0], [0, *g], strict=True)]
            g[0] += c * power
            power *= d
        g.reverse()
        for i in range(len(g) - 1):
            for j in range(len(g) - 2, i - 1, -1):
                g[j] += g[j + 1]
        return sum(a != b for a, b in pairwise(c > 0 for c in g if c))

    def roots(self, low: Fraction, high: Fraction, depth: int = -1) -> "Iterator[Time]":
        """Yield the roots in [low, high], all of them simple; low < high. Depth -1: no limit."""
        yield from (Time(q) for q in (low, high) if self.sign_at(q) == 0)
        todo = [(low, high, depth)]
        while todo:  # halve intervals, until each root is alone in one
            a, b, left = todo.pop()
            count, middle = self.variations(a, b), (a + b) / 2
            if count == 1 and self.sign_at(a) and self.sign_at(b):
                yield Time(a, b, self)
            elif count:
                ends = f"{written(low):.200} and {written(high):.200}"
                require(left, f"the roots of a polynomial between {ends} are too near")
                todo += [(a, middle, left - 1), (middle, b, left - 1)]
                if self.sign_at(middle) == 0:
                    yield Time(middle)


class Time:
    """A number: low = high; or the only root, a simple one, of f between low and high."""

    def __init__(self, low: Fraction, high: Fraction | None = None, f: Poly = Poly()) -> None:  # noqa: B008
        self.low, self.high, self.f = low, low if high is None else high, f

    def refine(self) -> None:
        """Halve the interval."""
        self.compare_rational((self.low + self.high) / 2)

    def compare_rational(self, q: Fraction) -> int:
        """Return -1, 0 or 1 if the time is before, at or after q."""
        if self.high < q or self.low > q or self.low == self.high:
            return (self.low > q) - (self.low < q)
        s = self.f.sign_at(q)
        order = 0 if s == 0 else 1 if s == self.f.sign_at(self.low) else -1
        if order >= 0:
            self.low = q
        if order <= 0:
            self.high = q
        return order

    def compare(self, other: "Time") -> int:
        """Return -1, 0 or 1 if the time is before, at or after the other one."""
        if other.low == other.high:
            return self.compare_rational(other.low)
        if self.compare_rational(other.low) <= 0:
            return -1
        if self.compare_rational(other.high) >= 0:
            return 1
        s = self.sign_of(other.f)  # which has but one root there
        return 0 if s == 0 else -1 if s == other.f.sign_at(other.low) else 1

    def sign_of(self, g: Poly) -> int:
        """Return the sign of g at this time."""
        differ = False
        while self.low < self.high and g:
            s = g.sign_at(self.low)
            if s and s == g.sign_at(self.high) and g.variations(self.low, self.high) == 0:
                return s
            if not differ:
                # g vanishes if and only if its common divisor with f has a root here: then
                # a simple one, the only one, and none at the ends, where f has none.
                common = self.f.common_divisor(g)
                if common.sign_at(self.low) * common.sign_at(self.high) < 0:
                    return 0
                differ = True
            self.refine()
        return g.sign_at(self.low)

    def __str__(self) -> str:
        return written(self.low) if self.low == self.high else f"{twelve_digits(self)}..."


def twelve_digits(time: Time) -> str:
    """Return the first twelve digits of a number, without the digits after them."""
    sign = time.compare_rational(Fraction(0))
    if sign == 0:
        return "0"
    while time.low * time.high <= 0 or abs(time.high - time.low) * 10**16 > abs(time.low):
        time.refine()
    size = min(abs(time.low), abs(time.high))
    k = (size.numerator.bit_length() - size.denominator.bit_length()) * 30103 // 100000 - 2
    unit = TEN ** (k - 11)  # of which the number is between 10^11 and 10^15
    n = floor(size / unit)
    n += time.compare_rational(sign * (n + 1) * unit) * sign >= 0
    digits, k = str(n)[:12], k + len(str(n)) - 12
    if 0 <= k < 11:
        shown = f"{digits[: k + 1]}.{digits[k + 1 :]}"
    elif -5 <= k < 0:
        shown = f"0.{'0' * (-k - 1)}{digits}"
    else:
        shown = f"{digits[0]}.{digits[1:]}e{k}"
    return "-" * (sign < 0) + shown


def between(a: Time, b: Time, start: Fraction, unit: Fraction) -> Fraction:
    """Return a rational number with few digits between two times.

    There must be a number between them that is the start plus a multiple of the unit.
    """
    near = unit * 2 ** (APART - 64)  # times that are nearer may be one: a root of both
    while b.low - a.high < unit:
        require(b.high > a.low, "times do not increase")
        width = max(a.high - a.low, b.high - b.low)
        if width < near and a.low < a.high and b.low < min(a.high, b.high):
            near, both = Fraction(0), a.f.common_divisor(b.f)
            signs = [both.sign_at(q) for q in (max(a.low, b.low), min(a.high, b.high))]
            require(signs[0] * signs[1] >= 0, "times do not increase")
        if width * 2 < unit:
            q = start + (floor((a.low - start) / unit) + 1) * unit  # the first one after a.low
            q += unit * (a.compare_rational(q) >= 0)
            require(b.compare_rational(q) > 0, "times do not increase, or by too little")
            return q
        for time in (a, b):
            time.refine()
    power = 1
    while floor(a.high * power) + 1 >= b.low * power:
        power *= 2
    return Fraction(floor(a.high * power) + 1, power)


def zeros(f: Poly, start: Time, end: Time) -> tuple[bool, bool]:
    """Return whether f vanishes strictly between two times, and whether at the second one."""
    low, high = start.low, end.high
    if f.variations(low, high) == 0:
        return False, end.low == high and f.sign_at(high) == 0
    after = [r.compare(end) for r in f.square_free().roots(low, high) if r.compare(start) > 0]
    return -1 in after, 0 in after


# ---- Tracks: a vertex is at (x / w, y / w), polynomials, w > 0; its place is three integers.

Track = tuple[Poly, Poly, Poly]
Whole = tuple[int, int, int]
Rows = list[Whole]  # of a vertex at (x / z, y / z): coefficients of x, y and z, by powers of t
Entry = TypeVar("Entry", int, Poly)
Triple = tuple[Entry, Entry, Entry]
# The half turn, the orientation, and the pivot with the translation.
Turn = tuple[Poly, Point, tuple[Point, Poly, Poly]]
ONE, ZERO = Poly([Fraction(1)]), Poly()


def vector_of(a: Triple[Entry], b: Triple[Entry]) -> tuple[Entry, Entry]:
    """Return a positive multiple of b - a."""
    return b[0] * a[2] - a[0] * b[2], b[1] * a[2] - a[1] * b[2]


def turn(a: Triple[Entry], b: Triple[Entry], c: Triple[Entry]) -> Entry:
    """Return the determinant: positive where a, b, c turn left, 0 where they are on one line."""
    f = a[0] * (b[1] * c[2] - c[1] * b[2]) + b[0] * (c[1] * a[2] - a[1] * c[2])
    return f + c[0] * (a[1] * b[2] - b[1] * a[2])


def orientation_of(a: Track, b: Track, c: Track) -> Poly:
    """Return the polynomial of a turn, computed once in a check."""
    work = WORK.get()
    return work.turn(a, b, c) if work else counted_turn(a, b, c)


def counted_turn(a: Track, b: Track, c: Track) -> Poly:
    """Return the polynomial of a turn; its short products are counted here."""
    spend(40 * ((max(map(int.bit_length, chain(*a, *b, *c))) >> 6) + 1) ** 2)
    return turn(a, b, c)


def dot_of(a: Triple[Entry], v: Triple[Entry], b: Triple[Entry]) -> Entry:
    """Return a positive multiple of the dot product (a - v) . (b - v)."""
    (px, py), (qx, qy) = vector_of(v, a), vector_of(v, b)
    return px * qx + py * qy


def values(polynomials: Sequence[Poly], t: Fraction) -> list[int]:
    """Return the values of polynomials in integers at a time, times one positive number."""
    n, d, k = t.numerator, t.denominator, max(map(len, polynomials))
    if k < 2:
        return [*map(sum, polynomials)]
    if (n | d) >> 64:
        size = words(d) * (k * words(n) + longest(chain(*polynomials)))
        spend(len(polynomials) * k**2 * size)
    powers = [n**i * d ** (k - 1 - i) for i in range(k if n else 1)]
    found = [sum(map(mul, f, powers)) for f in polynomials]
    spend(k * (len(found) + (sum(map(int.bit_length, found)) >> 6)))
    return found


def meet(a: Whole, b: Whole, c: Whole, d: Whole) -> bool:
    """Return True if the closed segments ab and cd have a point in common."""
    p, q, r, s = turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b)
    if ((p > 0 > q) or (p < 0 < q)) and ((r > 0 > s) or (r < 0 < s)):
        return True
    ends = ((p, c, a, b), (q, d, a, b), (r, a, c, d), (s, b, c, d))
    return any(f == 0 and dot_of(x, v, y) <= 0 for f, v, x, y in ends)


def are_same(points: Sequence[Whole], others: Sequence[Whole]) -> bool:
    """Return True if points, as many of both, are equal."""
    return all(vector_of(p, q) == (0, 0) for p, q in zip(points, others, strict=True))


def is_simple(points: Sequence[Whole], edges: Iterable[Dart], first: int) -> bool:
    """Return True if edges (numbers of vertices, counted from the first) meet only at joints."""
    spans, near = [], [((x << 256) // w, (y << 256) // w) for x, y, w in points]
    product = longest(chain(*points)) ** 2
    for u, v in edges:
        spend(4 * product)
        if vector_of(points[u - first], points[v - first]) == (0, 0):
            return False
        (x, y), (z, w) = near[u - first], near[v - first]
        spans.append((min(x, z), max(x, z), min(y, w), max(y, w), u - first, v - first))
    spans.sort()
    for k, (_, right, bottom, top, a, b) in enumerate(spans):
        for j in range(k + 1, len(spans)):
            left, _, low, high, c, d = spans[j]
            if left > right:
                break
            spend(200)
            if low > top or high < bottom:
                continue
            spend(2000 + 60 * product)
            if b == c or d == a:  # one of them ends where the other begins
                p, q, r = (points[i] for i in ((a, b, d) if b == c else (c, d, b)))
                if turn(p, q, r) == 0 and dot_of(p, q, r) >= 0:
                    return False
            elif meet(points[a], points[b], points[c], points[d]):
                return False
    return True


def surrounds(ring: Sequence[Whole], p: Whole) -> bool:
    """Return True if a ray from p to the right crosses a polygon an odd number of times."""
    spend(len(ring) * (300 + 15 * longest((*p, *ring[0])) ** 2))
    above, odd = [q[1] * p[2] > p[1] * q[2] for q in ring], False
    for i, a in enumerate(ring):
        if above[i] != above[i - 1]:
            odd ^= (turn(ring[i - 1], a, p) if above[i] else turn(a, ring[i - 1], p)) > 0
    return odd


# ---- The scene (docs/scene-grammar.md). All of it is read; what is not understood is refused.

NUMBER = re.compile(r"([+-]?)(\d*+)(?:/(\d++)|\.?(\d*+)(?:[eE]([+-]?\d{1,18}))?)", re.ASCII)
MAX_BITS = 33_220  # of a numerator or denominator in a scene: 10,000 digits
MAX_DIGITS = 10_000  # of one in a proof
MAX_DEGREE = 64  # of a coordinate of a vertex, in homogeneous coordinates


BODY_KEYS = [
    *("motion", "closed", "holes", "radius", "properties", "vertices", "keyframes", "parts"),
    *("place_error", "angle_error", "shape_error", "pivot"),
]
MOTION_KEYS = {  # required, and optional
    "": ([], ["x", "y"]),
    "affine": (["matrix"], ["x", "y"]),
    "rigid": (["half_turn"], ["x", "y", "pivot", "orientation"]),
}


class Bare(str):
    """A number of JSON, as it is written: not one in quotes."""

    __slots__ = ()


def need(condition: object, what: str, data: Json = "") -> None:
    """Refuse the scene unless the condition holds."""
    if not condition:
        raise NoProofError(f"the scene: {what} {data!r:.60}")


def number(data: Json) -> Fraction:
    """Return the rational that a text, or a number of JSON, denotes."""
    need(isinstance(data, str) and len(data) <= 3 * MAX_DIGITS, "not a number:", data)
    return rational(data)


@lru_cache(1000)
def rational(data: str) -> Fraction:
    """Return the rational that a text of few characters denotes; many are there several times."""
    if data.removeprefix("-").isdecimal() and data.isascii() and len(data) <= MAX_DIGITS:
        return Fraction(integer(data))
    match = NUMBER.fullmatch(data)
    minus, units, under, decimals, exponent = match.groups("") if match else [""] * 5
    need(units or decimals, "not a number:", data)
    need(not under or under.strip("0"), "a denominator is zero:", data)
    power, n = int(exponent or 0), integer(minus + units + decimals)
    need(abs(power) <= 100_000, "an exponent beyond 100,000:", data)
    power = power - len(decimals) if n else 0
    is_whole = power >= 0 and not under
    q = (
        Fraction(n * 10**power)
        if is_whole
        else Fraction(n, integer(under) if under else 10**-power)
    )
    bits = max(q.numerator.bit_length(), q.denominator.bit_length())
    need(bits <= MAX_BITS, "more than 10,000 digits:", data)
    return q


def keys(data: Json, required: Sequence[str] = (), optional: Sequence[str] = ()) -> Json:
    """Return a JSON object with all of the required keys, and no others but the optional ones."""
    known = isinstance(data, dict) and {*required} <= data.keys() <= {*required, *optional}
    need(known, "not an object, or with other keys:", data)
    return data


def entries(data: Json, length: int | None = None) -> Json:
    """Return a JSON list, of this length if one is given."""
    need(isinstance(data, list) and length in (None, len(data)), "not a list as needed:", data)
    return data


def check_json(data: Json, levels: int) -> None:
    """Check a value that has no meaning here, and how deep it is."""
    is_text = isinstance(data, str) and (data.isascii() or not re.search("[\ud800-\udfff]", data))
    need(is_text or not isinstance(data, (str, float)), "a number or text that is none:", data)
    if isinstance(data, (dict, list)):
        need(levels, "nested too deeply:", None)
        for value in [*data, *data.values()] if isinstance(data, dict) else data:
            check_json(value, levels - 1)


def polynomial(data: Json) -> Poly:
    """Return the polynomial that a list of numbers is."""
    return Poly([number(c) for c in entries(data)])


def degree(*polynomials: Poly) -> int:
    """Return the highest degree; that of 0 is 0."""
    return max(1, *map(len, polynomials)) - 1


class Motion:
    """A motion by one formula, ``form``: (x, y) goes to (a x + b y + e, c x + d y + f) / w."""

    def __init__(self, data: Json, of_shape: int) -> None:
        self.rigid: Turn | None = None
        self.pivot: Point | None = None  # of a rigid motion
        kind = next(iter({"rigid", "affine"} & data.keys()), "") if isinstance(data, dict) else ""
        given = keys(keys(data, [kind])[kind] if kind else data, *MOTION_KEYS[kind])
        x, y = polynomial(given.get("x", [])), polynomial(given.get("y", []))
        m, high = [ONE, ZERO, ZERO, ONE], max(of_shape, degree(x, y))
        if kind == "affine":
            m = [polynomial(p) for row in entries(given["matrix"], 2) for p in entries(row, 2)]
            high = max(of_shape + degree(*m), degree(x, y))
        h = polynomial(given["half_turn"]) if kind == "rigid" else ZERO
        need(high + 2 * degree(h) <= MAX_DEGREE, f"a degree above {MAX_DEGREE}")
        self.keeps_lengths = kind != "affine"
        form = *m, x, y, ONE
        if kind == "rigid":
            c, s = point(given.get("orientation", ["1", "0"]))
            need(c * c + s * s == 1, "an orientation that is no unit vector:", data)
            self.pivot = point(given.get("pivot", ["0", "0"]))
            p, q = (Poly([k]) for k in self.pivot)
            self.rigid = h, (c, s), (self.pivot, x, y)
            # A turn by the angle a with tan(a / 2) = h: (1 - h^2, 2 h) / (1 + h^2) is (cos, sin).
            w, cosine, sine = ONE + h * h, ONE - h * h, h + h
            a, b = cosine * Poly([c]) - sine * Poly([s]), sine * Poly([c]) + cosine * Poly([s])
            e, f = w * (p + x) - a * p + b * q, w * (q + y) - b * p - a * q
            form = a, ZERO - b, b, a, e, f, w
        e, f, w = cleared(x, y)
        self.form = cleared(*form)[:7] if kind else (w, ZERO, ZERO, w, e, f, w)
        self.columns = [*zip_longest(*self.form, fillvalue=0)]
        self.cost = sum(map(len, self.form)) * (300 + 2 * longest(chain(*self.form)) ** 2)

    def track(self, rows: Rows) -> Track:
        """Return the track of a vertex."""
        spend(self.cost * 2 * len(rows) * (longest(chain(*rows)) if len(rows) > 1 else 1))
        xs, ys, ws = ([0] * (len(self.columns) + len(rows) - 1) for _ in "xyw")
        for i, (p, q, r) in enumerate(rows):
            for j, (a, b, c, d, e, f, w) in enumerate(self.columns, i):
                xs[j] += a * p + b * q + e * r
                ys[j] += c * p + d * q + f * r
                ws[j] += w * r
        m = gcd(*xs, *ys, *ws)
        x, y, w = [Poly([k // m for k in f]) for f in (xs, ys, ws)]
        return x, y, w


def cleared(*given: Poly) -> tuple[Poly, ...]:
    """Return polynomials times their common denominator, and this number."""
    ratios = [[q.as_integer_ratio() for q in f] for f in given]
    m = lcm(*[d for f in ratios for _, d in f])
    spend(words(m) ** 2 * sum(map(len, given)))
    return *[Poly([n * (m // d) for n, d in f]) for f in ratios], Poly([m])


class Body:
    """A body: the tracks of its vertices, in each piece of its motion.

    ``breaks`` are the times at which formulas change: piece k ends at breaks[k]. ``rings`` are the
    numbers of vertices of each, with whether it bounds a hole; in ``parts`` outlines are first.
    ``at_start`` are the places of the vertices at the start.
    """

    def __init__(
        self, data: Json, first: int, start: Fraction, *, are_records_verified: bool
    ) -> None:
        body = keys(data, ["name"], BODY_KEYS)
        shapes = ("vertices" in body) + ("keyframes" in body) + ("parts" in body)
        need(shapes == 1, "vertices or keyframes or parts:", data)
        need("holes" not in body or "vertices" in body, "holes without vertices:", data)
        self.name, closed = body["name"], body.get("closed", True)
        need(type(self.name) is str and self.name, "a name:", self.name)
        need(isinstance(closed, bool), "closed:", closed)
        self.radius = number(body.get("radius", "0"))
        need(self.radius.numerator >= 0, "a radius:", body.get("radius"))
        need(isinstance(body.get("properties", {}), dict), "properties:", self.name)
        check_json([self.name, body.get("properties")], 30)
        parts = [keys(p, ["vertices"], ["holes"]) for p in entries(body.get("parts", []))]
        need(parts or "parts" not in body, "no parts:", data)
        of = [(p.get("vertices", []), *entries(p.get("holes", []))) for p in parts or [body]]
        rings = [[*map(entries, part)] for part in of]
        flat = [ring for part in rings for ring in part]
        several = "parts" in body or len(flat) > 1
        need(not several or (closed and min(map(len, flat)) > 2), "rings:", data)
        self.frames = keyframes(body["keyframes"]) if "keyframes" in body else []
        self.shape = [vertex(data) for ring in flat for data in ring]
        self.first, self.size = first, len(self.frames[0][1] if self.frames else self.shape)
        need(self.size, "no vertices:", self.name)
        self.read_motion(body.get("motion", {}), are_records_verified=are_records_verified)
        self.read_errors(body)
        self.vertices, self.closed = range(first, first + self.size), closed and self.size > 2
        self.breaks = sorted({*self.ends, *dict(self.frames)})
        self.parts: list[list[range]] = []
        for part in rings if several else [[self.vertices]]:
            bounds = accumulate(map(len, part), initial=first)
            self.parts.append([range(i, j) for i, j in pairwise(bounds)])
            first = self.parts[-1][-1].stop
        self.rings = [(ring, k > 0) for part in self.parts for k, ring in enumerate(part)]
        self.edges = [e for r, _ in self.rings for e in pairwise([*r, *r[: self.closed]])]
        self.tracks, self.at_start = dict[tuple[int, int], Track](), self.places(start)
        self.check_simple(self.at_start)

    def read_motion(self, data: Json, *, are_records_verified: bool) -> None:
        """Read the motions, which follow one upon the other at the times ``ends``."""
        of_shape = 1 if self.frames else max(map(len, self.shape)) - 1
        self.ends: list[Fraction] = []
        self.path: PathRecord | None = None
        if not isinstance(data, dict) or "pieces" not in data:
            self.motions = [Motion(data, of_shape)]
            return
        given = keys(data, ["pieces"], ["spin", "path", "spline"])
        need(len(given) < 3, "both a spin and a path (or a spline):", data)
        rows = [keys(p, ["motion"], ["until"]) for p in entries(given["pieces"])]
        whole = rows and "until" not in rows[-1] and all("until" in p for p in rows[:-1])
        need(whole, '"until" belongs to all pieces but the last:', data)
        self.ends = [number(p["until"]) for p in rows[:-1]]
        need(all(s < t for s, t in pairwise(self.ends)), "pieces not in order:", data)
        self.motions = [Motion(p["motion"], of_shape) for p in rows]
        for t, (before, after) in zip(self.ends, pairwise(self.motions), strict=True):
            u, v = values(before.form, t), values(after.form, t)
            if [c * v[6] for c in u] != [c * u[6] for c in v]:
                same = are_same(self.places(t, before), self.places(t, after))
                need(same, f"{self.name!a:.200} jumps at t = {written(t):.200}")
        if "spin" in given:
            spin = spin_of(given["spin"], self.motions)
            right = not are_records_verified or turns_by(self.ends, self.motions, spin)
            need(right, "not such a spin:", data)
        if "path" in given:
            self.path = path_of(given["path"])
            right = not are_records_verified or follows(self.ends, self.motions, self.path)
            need(right, "not such a path:", data)
        if "spline" in given:
            check_spline(given["spline"])

    def read_errors(self, body: Json) -> None:
        """Read by how much the true body may differ from the modelled one, which is the one here.

        An error of the angle is a turn about a reference point: the one about which the motion
        turns the body, or else the "pivot" of the body.
        """
        place, angle = (error_of(body.get(k, "0"), k) for k in ("place_error", "angle_error"))
        both = entries(body.get("shape_error", ["0", "0"]), 2)
        shape = [error_of(error, "shape_error") for error in both]
        self.is_modelled = any([place, angle, *shape])
        has_pivot = "pivot" in body
        if has_pivot:
            point(body["pivot"])
        if not angle:
            need(not has_pivot, "a pivot without an angle_error:", self.name)
            return
        turned_about = {motion.pivot for motion in self.motions if motion.pivot}
        if self.path:
            turned_about = {self.path.pivot}
        several = " and ".join(f"({written(x)}, {written(y)})" for x, y in sorted(turned_about))
        need(len(turned_about) < 2, f"an angle_error, and turns about {several:.200}:", self.name)
        need(has_pivot or turned_about, "an angle_error without a pivot:", self.name)
        need(not (has_pivot and turned_about), "two pivots, of the body and its motion:", self.name)

    def rows(self, i: int, t: Fraction) -> Rows:
        """Return the rows of vertex i before motions; off frames it is at rest."""
        if not self.frames:
            return self.shape[i]
        (s, p), (e, q) = self.around(t)
        slopes = [(b - a) / (e - s) if e > s else 0 for a, b in zip(p[i], q[i], strict=True)]
        xy = (Poly([a - v * s, v]) for a, v in zip(p[i], slopes, strict=True))
        return [*zip_longest(*cleared(*xy), fillvalue=0)]

    def around(self, t: Fraction) -> list[tuple[Fraction, list[Point]]]:
        """Return the frames before and after a time."""
        k = bisect_right(self.frames, t, key=lambda frame: frame[0])
        return [self.frames[max(k - 1, 0)], self.frames[min(k, len(self.frames) - 1)]]

    def places(self, t: Fraction, motion: Motion | None = None) -> list[Whole]:
        """Return where the vertices are at a time, by a motion or the one just after that time."""
        motion = motion or self.motions[bisect_right(self.ends, t)]
        a, b, c, d, e, f, w = form = values(motion.form, t)
        spend(self.size * (1000 + 30 * longest(form)))
        shape = [self.rows(i, t) for i in range(self.size)] if self.frames else self.shape
        at = [k[0] if len(k) < 2 else values([*map(Poly, zip(*k, strict=True))], t) for k in shape]
        return [(a * x + b * y + e * z, c * x + d * y + f * z, w * z) for x, y, z in at]

    def check_simple(self, places: Sequence[Whole]) -> None:
        """Check that edges meet only where joined, and that holes and parts are in place."""
        need(
            is_simple(places, self.edges, self.first),
            f"{self.name!a:.200} is not simple at the start",
        )
        if len(self.rings) == 1:
            return
        outlines = {ring: [places[v - self.first] for v in ring] for ring, _ in self.rings}

        def is_in(ring: range, other: range) -> bool:
            return surrounds(outlines[other], outlines[ring][0])

        for one, *holes in self.parts:
            wrong = any(not is_in(k, one) for k in holes)
            wrong |= any(is_in(k, m) for k in holes for m in holes if k != m)
            for other, *others in self.parts:
                within = other != one and is_in(one, other)
                wrong |= within and not any(is_in(one, hole) for hole in others)
            need(not wrong, f"{self.name!a:.200}: a hole or part is where none can be")

    def track(self, i: int, after: Fraction) -> Track:
        """Return the track of vertex i just after a time."""
        key = i, bisect_right(self.breaks, after)
        if key not in self.tracks:
            motion = self.motions[bisect_right(self.ends, after)]
            self.tracks[key] = motion.track(self.rows(i, after))
        return self.tracks[key]

    def keeps_lengths(self, t: Fraction) -> bool:
        """Return True if the body is only translated and rotated just after a time."""
        keeps = self.motions[bisect_right(self.ends, t)].keeps_lengths
        if self.frames:
            (_, p), (_, q) = self.around(t)
            spend(self.size * (500 + 8 * most_words(chain(*p, *q)) ** 2))
            return keeps and len({(c - a, d - b) for (a, b), (c, d) in zip(p, q, strict=True)}) == 1
        (f, g, h), *others = ([*map(Poly, zip(*rows, strict=True))] for rows in self.shape)
        spend(self.size * (500 + 8 * most_words(chain(f, g, h)) ** 2))
        same = all((f * w)[1:] == (x * h)[1:] and (g * w)[1:] == (y * h)[1:] for x, y, w in others)
        return keeps and same


def point(data: Json) -> Point:
    """Return the point that a list of two numbers is."""
    x, y = map(number, entries(data, 2))
    return x, y


def vertex(data: Json) -> Rows:
    """Return the rows of a vertex: two numbers, or polynomials x and y."""
    if isinstance(data, dict):
        xy = (polynomial(keys(data, optional=["x", "y"]).get(k, [])) for k in "xy")
        return [*zip_longest(*cleared(*xy), fillvalue=0)]
    (p, d), (q, e) = (x.as_integer_ratio() for x in point(data))
    m = lcm(d, e)
    return [(p * (m // d), q * (m // e), m)]


def keyframes(data: Json) -> list[tuple[Fraction, list[Point]]]:
    """Return the times and the places of keyframes; between them all is linear."""
    frames = [keys(f, ["t", "vertices"]) for f in entries(data)]
    path = [(number(f["t"]), [*map(point, entries(f["vertices"]))]) for f in frames]
    need(len({len(points) for _, points in path}) == 1, "keyframes:", data)
    need(all(s < t for (s, _), (t, _) in pairwise(path)), "keyframes not in order:", data)
    return path


def error_of(data: Json, key: str) -> Fraction:
    """Return an error, the value of a key: a number that is not negative."""
    error = number(data)
    need(error >= 0, f"a negative {key}:", data)
    return error


def spin_of(data: Json, motions: Sequence["Motion"]) -> Point:
    """Return the rate and the error of a spin; a pivot that it names is that of all motions."""
    spin = keys(data, ["omega", "error"], ["pivot"])
    omega, error = number(spin["omega"]), number(spin["error"])
    need(error > 0, "a spin's error:", data)
    if "pivot" in spin:
        pivot = point(spin["pivot"])
        need(all(motion.pivot == pivot for motion in motions), "a spin about another pivot:", data)
    return omega, error


def check_spline(data: Json) -> None:
    """Check the error of a spline, which is assumed: pieces are taken as they are."""
    error_of(keys(data, ["error"])["error"], "error")


@dataclass(frozen=True)
class PathRecord:
    """The record of a path: poses, which the pieces of a motion follow within errors.

    Attributes:
        pivot: the point of the rest frame about which the poses turn.
        angle_error: the verified part of the error of the angle; the rest is assumed.
        place_error: the error of the translation.
        times: where poses begin and end, one more than poses.
        poses: x, y and the angle, polynomials of the time since the pose began.
    """

    pivot: Point
    angle_error: Fraction
    place_error: Fraction
    times: list[Fraction]
    poses: list[list[Poly]]


def path_of(data: Json) -> PathRecord:
    """Return the record of a path."""
    required = ["error", "place_error", "times", "poses"]
    path = keys(data, required, ["assumed_angle_error", "pivot"])
    assumed = error_of(path.get("assumed_angle_error", "0"), "assumed_angle_error")
    error = number(path["error"]) - assumed
    need(error > 0, "an error of the angle that is not above the assumed one:", data)
    times = [number(t) for t in entries(path["times"])]
    rows = [keys(row, ["x", "y", "angle"]) for row in entries(path["poses"])]
    poses = [[polynomial(row[k]) for k in ("x", "y", "angle")] for row in rows]
    need(len(times) == len(poses) + 1 > 1, "not one pose for each two times:", data)
    need(all(s < t for s, t in pairwise(times)), "the times of a path do not increase:", data)
    pivot = point(path.get("pivot", ["0", "0"]))
    off = error_of(path["place_error"], "place_error")
    return PathRecord(pivot, error, off, times, poses)


# ---- A spin: pieces that turn by the angle omega t, but for an error. Of the angle of a piece, p +
# 2 arctan h(t), |h| <= 1, the difference from omega t is bounded at nine times; between these it
# changes by at most the largest slope, (2 h' - omega (1 + h^2)) / (1 + h^2), times half a step.

SAMPLES, MAX_ANGLE_BITS = 8, 512
Bounds = tuple[Fraction, Fraction]


def turns_by(ends: Sequence[Fraction], motions: Sequence[Motion], spin: Point) -> bool:
    """Return True if motions are seen to turn by omega t, from the first end to the last."""
    turns = [motion.rigid for motion in motions if motion.rigid]
    if len(turns) < max(len(motions), 3):
        return False
    if degree(turns[0][0], turns[-1][0]) > 0 or any(turn[2] != turns[0][2] for turn in turns):
        return False
    spans = zip(turns[1:-1], pairwise(ends), strict=True)
    return all(turns_in(turn, span, *spin) for turn, span in spans)


def turns_in(turn: Turn, span: Bounds, omega: Fraction, error: Fraction) -> bool:
    """Return True if this shows it of one piece and its span."""
    spend(1000 * most_words((omega,)) ** 2)
    (h, turned, _), (a, b) = turn, span
    slope = Poly([2 * i * c for i, c in enumerate(h)][1:]) - Poly([omega]) * (ONE + h * h)
    between = slope.bound(a, b) * (b - a) / (2 * SAMPLES)
    times = [a + (b - a) * i / SAMPLES for i in range(SAMPLES + 1)]
    bits = bits_for(error, omega * max(abs(a), abs(b)))
    if bits > MAX_ANGLE_BITS or between > error or any(abs(h.value(t)) > 1 for t in times):
        return False
    low, high = angle_of(turned, bits + 8)
    arcs = ((t, *arctan(h.value(t), bits + 8)) for t in times)
    gaps = [(low + 2 * p - omega * t, high + 2 * q - omega * t) for t, p, q in arcs]
    return largest_gap(gaps, bits + 8) + between <= error


def largest_gap(gaps: Sequence[Bounds], bits: int) -> Fraction:
    """Return a bound of differences of angles, but for the full turns that are next to one."""
    low, high = pi_bounds(bits)
    k = 2 * floor(gaps[0][0] / (2 * low) + Fraction(1, 2))
    least, most = sorted((k * low, k * high))
    return max(max(q - least, most - p) for p, q in gaps)


def bits_for(error: Fraction, angle: Fraction) -> int:
    """Return the bits after the binary point of a small part of an error, next to an angle."""
    bits = max(8, 5 - error.numerator.bit_length() + error.denominator.bit_length())
    return bits + floor(abs(angle)).bit_length()


# ---- A path: pieces that turn by an angle theta, but for an error. With h and theta polynomials
# of the part s of a piece, the error e of the angle has the derivative w N, where w = 1 / (1 + h^2)
# and N = 2 h' - theta' (1 + h^2). With E the primitive of N from 0 on, by parts, |e(s)| <= |e(0)| +
# max |E| (1 + 2 max |h| max |h'|), since |w'| <= 2 |h h'|.


def follows(ends: Sequence[Fraction], motions: Sequence[Motion], path: PathRecord) -> bool:
    """Return True if motions are seen to follow a path within its errors."""
    times, poses = path.times, path.poses
    turns = [motion.rigid for motion in motions if motion.rigid]
    if not len(turns) == len(motions) > 2 or (ends[0], ends[-1]) != (times[0], times[-1]):
        return False
    for (s, t), (before, after) in zip(pairwise(times), pairwise(poses), strict=False):
        if [f.value(t - s) for f in before] != [f.value(Fraction(0)) for f in after]:
            return False
    for turn, span in zip(turns, pairwise([ends[0], *ends, ends[-1]]), strict=True):
        k = min(bisect_right(times, span[0]), len(poses)) - 1
        pose = [f.along(*(t - times[k] for t in span)) for f in poses[k]]
        if span[1] > times[k + 1] or not is_near(turn, span, pose, path):
            return False
    return True


def is_near(turn: Turn, span: Bounds, pose: Sequence[Poly], path: PathRecord) -> bool:
    """Return True if one piece is shown to be near a pose of the part s of its span.

    The pieces and the poses turn about one point, so the translations can be compared.
    """
    (h, (c, s), (pivot, x, y)), all_of_it = turn, (Fraction(0), Fraction(1))
    error, off = path.angle_error, path.place_error
    if pivot != path.pivot or (span[0] == span[1] and degree(h, x, y) > 0):
        return False
    dx, dy, h = x.along(*span) - pose[0], y.along(*span) - pose[1], h.along(*span)
    u, angle = h.value(Fraction(0)), pose[2].value(Fraction(0))
    bits = bits_for(error, angle)
    if bits > MAX_ANGLE_BITS or dx.bound(*all_of_it) ** 2 + dy.bound(*all_of_it) ** 2 > off**2:
        return False
    slope, parts = h.derivative(), [Fraction(i, SAMPLES) for i in range(SAMPLES + 1)]
    rate = slope + slope - pose[2].derivative() * (ONE + h * h)
    change = Poly([0, *(f / (i + 1) for i, f in enumerate(rate))])
    cosine, sine = (1 - u * u) / (1 + u * u), 2 * u / (1 + u * u)
    low, high = angle_of((c * cosine - s * sine, c * sine + s * cosine), bits + 8)
    at_start = largest_gap([(low - angle, high - angle)], bits + 8)
    factor = 1 + 2 * h.bound(*all_of_it) * slope.bound(*all_of_it)
    return at_start + max(change.bound(*part) for part in pairwise(parts)) * factor <= error


def angle_of(direction: Point, bits: int) -> Bounds:
    """Return bounds of the angle of a unit vector."""
    (c, s), quarters = direction, 0
    while c <= 0 or abs(s) > c:
        c, s, quarters = s, -c, quarters + 1
    (low, high), (p, q) = arctan(s / (1 + c), bits), pi_bounds(bits)
    return 2 * low + quarters * p / 2, 2 * high + quarters * q / 2


def pi_bounds(bits: int) -> Bounds:
    """Return bounds of pi, computed once in a check."""
    work = WORK.get()
    return work.pi_bounds(bits) if work else pi_by_machin(bits)


def pi_by_machin(bits: int) -> Bounds:
    """Return bounds of pi, by Machin's formula."""
    (a, b), (c, d) = (series(Fraction(1, n), bits + 6) for n in (5, 239))
    return 16 * a - 4 * d, 16 * b - 4 * c


def arctan(x: Fraction, bits: int) -> Bounds:
    """Return bounds of the arc tangent of x, |x| <= 1."""
    if x < 0:
        low, high = arctan(-x, bits)
        return -high, -low
    if 2 * x <= 1:
        return series(x, bits)
    low, high = series((1 - x) / (1 + x), bits + 1)  # pi / 4 is the sum of both arc tangents
    p, q = pi_bounds(bits + 1)
    return p / 4 - high, q / 4 - low


def series(x: Fraction, bits: int) -> Bounds:
    """Return bounds of the arc tangent of x, 0 <= x <= 1/2, by its series.

    In units of 2^-n: a power of x is too small by less than 2 (its error e becomes less than
    e / 4 + 3 / 2 with the next factor x^2 <= 1/4), a term by less than 3, and what is left
    out is less than 3 when powers are below 1.
    """
    n = bits + 16
    spend(100 * n)
    power = floor(x * 2**n)
    square = (power * power) >> n
    total, terms = 0, 0
    while power:
        total += (-1) ** terms * (power // (2 * terms + 1))
        power, terms = (power * square) >> n, terms + 1
    return Fraction(total - 3 * terms - 4, 2**n), Fraction(total + 3 * terms + 4, 2**n)


def read_json(text: str) -> Json:
    """Return the data of a text in JSON, with numbers as they are written."""

    def unique(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
        need(len({k for k, _ in pairs}) == len(pairs), "a key is there twice:", pairs)
        return dict(pairs)

    return json.loads(text, parse_int=Bare, parse_float=Bare, object_pairs_hook=unique)


# ---- Beside the bodies: those that ignore each other, and what the numbers mean to people.

UNITS_OF_DATES = ("ns", "us", "ms", "s", "min", "h", "day")
MAX_UNIT = 32  # characters
CONTROLS = re.compile("[\0-\x1f\x7f-\x9f\u2028\u2029]")  # and line breaks
EPOCH = re.compile(
    r"(?P<year>\d{4})-(?P<month>\d\d)-(?P<day>\d\d)[Tt ]"
    r"([01]\d|2[0-3]):[0-5]\d:[0-5]\d(\.\d{1,30})?"
    r"([Zz]|[+-]([01]\d|2[0-3]):[0-5]\d)",
    re.ASCII,
)


def is_text(data: Json) -> bool:
    """Return True for a text of JSON, and not for a number."""
    return isinstance(data, str) and not isinstance(data, Bare)


def group_of(data: Json, number_of: dict[str, int]) -> frozenset[int]:
    """Return the numbers of the bodies of a group, which ignore each other.

    A text that is the name of a body is that body. Otherwise it ends in a star, and stands for all
    bodies whose names begin with what is before the star.
    """
    group = set[int]()
    for text in entries(data):
        need(is_text(text), "ignoring: not a name:", text)
        if text in number_of:
            group.add(number_of[text])
            continue
        need(text.endswith("*"), "ignoring: no such body:", text)
        beginning = text[:-1]
        spend(len(number_of))
        matching = [i for name, i in number_of.items() if name.startswith(beginning)]
        need(matching, "ignoring: no body matches", text)
        group.update(matching)
    need(len(group) > 1, "ignoring: a group of fewer than two bodies:", data)
    return frozenset(group)


def units_of(data: Json) -> dict[str, str]:
    """Return the units of length and time, or of one of both."""
    units: dict[str, str] = keys(data, optional=["length", "time"])
    need(units, "units: neither a length nor a time:", data)
    for unit in units.values():
        need(is_text(unit) and 0 < len(unit) <= MAX_UNIT, "units: not a short text:", unit)
        check_json(unit, 0)
        need(not CONTROLS.search(unit), "units: a line break or a control character:", unit)
    return units


def check_epoch(data: Json, units: dict[str, str]) -> None:
    """Check the date of time 0, which needs a unit of time that can be added to a date."""
    match = EPOCH.fullmatch(data) if is_text(data) else None
    need(match, "epoch: not a date and time with a zone:", data)
    year, month, day = (
        (int(match[part]) for part in ("year", "month", "day")) if match else (0,) * 3
    )
    need(year > 0 and 1 <= month <= 12, "epoch: no such date:", data)
    need(1 <= day <= monthrange(year, month)[1], "epoch: no such date:", data)
    need(
        units.get("time") in UNITS_OF_DATES, "epoch: it needs units with a time in", UNITS_OF_DATES
    )


class Scene:
    """All bodies; their vertices are numbered through.

    ``groups`` are the numbers of bodies that ignore each other.

    A proof states that the pieces of a motion follow the record of a spin or a path beside them,
    so that record is verified. A certificate is about the pieces alone.
    """

    def __init__(self, text: str, *, are_records_verified: bool = True) -> None:
        try:
            self.read(read_json(text), are_records_verified=are_records_verified)
        except (ValueError, RecursionError) as error:
            raise NoProofError(f"the scene is not JSON, or nested too deeply: {error}") from None
        self.known: tuple[Fraction, dict[int, Point]] = self.start, {}

    def read(self, data: Json, *, are_records_verified: bool) -> None:
        """Read all of it."""
        top = keys(data, ["exactpt", "time", "bodies"], ["ignoring", "units", "epoch"])
        version = top["exactpt"]
        need(version == "1" and isinstance(version, Bare), "not of format 1:", version)
        self.start, self.end = point(top["time"])
        need(self.start < self.end, "an empty time span:", top["time"])
        self.bodies, self.body_of = list[Body](), list[int]()
        for i, entry in enumerate(entries(top["bodies"])):
            first = len(self.body_of)
            body = Body(entry, first, self.start, are_records_verified=are_records_verified)
            self.bodies.append(body)
            self.body_of += [i] * self.bodies[-1].size
        number_of = {body.name: i for i, body in enumerate(self.bodies)}
        need(len(number_of) == len(self.bodies), "a name is there twice")
        self.groups = [group_of(names, number_of) for names in entries(top.get("ignoring", []))]
        self.groups_of = [set[int]() for _ in self.bodies]  # of each body, the numbers of them
        for k, group in enumerate(self.groups):
            for i in group:
                self.groups_of[i].add(k)
        units = units_of(top["units"]) if "units" in top else {}
        if "epoch" in top:
            check_epoch(top["epoch"], units)

        # A true body may differ from the one that is read here, the modelled one.
        self.is_modelled = any(body.is_modelled for body in self.bodies)

    def do_count(self, i: int, j: int) -> bool:
        """Return True if two bodies count as a pair: no group has both."""
        spend(20)
        return self.groups_of[i].isdisjoint(self.groups_of[j])

    def of(self, v: int) -> Body:
        """Return the body of a vertex."""
        return self.bodies[self.body_of[v]]

    def track(self, v: int, after: Fraction) -> Track:
        """Return the track of a vertex just after a rational time."""
        body = self.of(v)
        return body.track(v - body.first, after)

    def place(self, v: int, t: Fraction) -> Whole:
        """Return where a vertex is at a rational time, in integers."""
        x, y, w = values(self.track(v, t), t)
        return x, y, w

    def at(self, v: int, t: Fraction) -> Point:
        """Return where a vertex is at a rational time."""
        if self.known[0] != t:
            self.known = t, {}
        if v not in self.known[1]:
            x, y, w = self.place(v, t)
            spend(200 * most_words((x, y, w)) ** 2)  # uses of it, too
            self.known[1][v] = Fraction(x, w), Fraction(y, w)
        return self.known[1][v]

    def breaks_in(self, vertices: Iterable[int], low: Fraction, high: Fraction) -> set[Fraction]:
        """Return the times in (low, high] at which formulas of some vertices change."""
        every = (self.of(v).breaks for v in vertices)
        return {q for b in every if b for q in b[bisect_right(b, low) : bisect_right(b, high)]}

    def pieces(
        self, vertices: Sequence[int], start: Time, end: Time
    ) -> list[tuple[Time, Time, list[Track]]]:
        """Return the intervals between start, breakpoints and end, with the tracks in each."""
        found = self.breaks_in(vertices, start.low, end.high)
        inside = [q for q in found if start.compare_rational(q) < 0 < end.compare_rational(q)]
        times = [start, *map(Time, sorted(inside)), end]
        # Comparing has seen to it that no breakpoint is after a.low and before a.
        return [(a, b, [self.track(v, a.low) for v in vertices]) for a, b in pairwise(times)]

    def tracks_at(self, vertices: Iterable[int], time: Time) -> dict[int, Track]:
        """Return tracks of some vertices that hold at a time."""
        for q in self.breaks_in(vertices, time.low, time.high):
            time.compare_rational(q)  # so that no breakpoint is inside the interval of the time
        return {v: self.track(v, time.low) for v in vertices}

    def is_rigid(self, body: Body, end: Fraction) -> bool:
        """Return True if lengths, dot and cross products of successive edges are constant."""
        n, path, low = body.size, body.vertices, self.start
        triples = [(path[k - 1], path[k], path[(k + 1) % n]) for k in range(n)]
        if not body.closed:
            triples = triples[1:-1] if n > 2 else [(v, path[0], v) for v in path[1:]]
        for t in (q for q in [low, *body.breaks] if low <= q < end and not body.keeps_lengths(q)):
            for a, v, b in ([self.track(u, t) for u in triple] for triple in triples):
                of_a, of_b = a[2] * v[2], b[2] * v[2]  # the denominators of a - v and b - v
                forms = [(dot_of(a, v, a), of_a * of_a), (dot_of(b, v, b), of_b * of_b)]
                forms += [(dot_of(a, v, b), of_a * of_b), (orientation_of(a, v, b), of_a * b[2])]
                if any(f * Poly([g.value(t)]) != g * Poly([f.value(t)]) for f, g in forms):
                    return False
        return True


APART = 2048  # between times are multiples of the span / 2^APART
MAX_BYTES, MAX_LINE_BYTES = 10**9, 10**8
R, V = r"-?[0-9]++(/[0-9]++)?", "[0-9]{1,9}"  # a rational, and a vertex or body


def is_rational(word: str) -> bool:
    """Return True if a word is a rational of at most `MAX_DIGITS` digits above and below."""
    over, _, under = word.removeprefix("-").partition("/")
    is_short = max(len(over), len(under)) <= MAX_DIGITS
    return bool(is_short and re.fullmatch(R, word) and ("/" not in word or under.strip("0")))


@dataclass(frozen=True)
class Format:
    """The format of the lines of a file.

    Attributes:
        forms: for each first word of a line, a pattern of the whole line.
        order: a pattern of the first words of all lines.
        is_bounded: whether the numbers of a line are small enough.
    """

    forms: dict[str, re.Pattern[str]]
    order: str
    is_bounded: Callable[[list[str]], bool]


def read(proof: bytes, file_format: Format) -> list[tuple[int, list[str]]]:
    """Return the numbers and words of the lines of a proof, all of which are in the format."""
    rows = []
    for i, line in enumerate(proof.split(b"\n"), 1):
        if len(line) > MAX_LINE_BYTES:
            raise NoProofError(f"line {i} is too long")
        row = re.findall(r"[^ \t\r]+", line.decode())
        if row and not line.startswith(b"#"):
            form = file_format.forms.get(row[0], file_format.forms["none"])
            if not form.fullmatch(" ".join(row)) or not file_format.is_bounded(row):
                raise NoProofError(f"line {i} is not in the format")
            rows.append((i, row))
    if not re.fullmatch(file_format.order, " ".join(row[0] for _, row in rows)):
        raise NoProofError("the file is no proof, or the order of its lines is another one")
    return rows


def about(*, is_modelled: bool) -> str:
    """Return the words before a statement that is about the modelled bodies, not the true ones."""
    return "modelled bodies: " if is_modelled else ""


def file_bytes(path: Path) -> bytes:
    """Return the bytes of a file, at most one more than allowed."""
    with path.open("rb") as file:
        return file.read(MAX_BYTES + 1)


def say(text: str, code: int, file: TextIO) -> int:
    """Print a line in ASCII, controls of names escaped; return the exit code."""
    shown = (c if c.isascii() and c.isprintable() else ascii(c)[1:-1] for c in text)
    file.write("".join(shown) + "\n")
    return code
