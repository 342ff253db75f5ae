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
from itertools import chain, dropwhile, pairwise, zip_longest
from math import comb, floor, gcd, lcm
from operator import mul, not_
from pathlib import Path
from typing import Any, NamedTuple, TextIO, TypeVar

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
    for_each_byte = 2000

    def __init__(self, left: int) -> None:
        self.left = left
        # Results that are computed once in each check: no other check profits from them.
        self.turn = lru_cache(100_000)(counted_turn)
        self.pi_bounds = lru_cache(100)(pi_by_machin)


WORK = ContextVar[Work | None]("WORK", default=None)  # of this thread's check


def spend(products: int) -> None:
    """Count some work of this check; outside of a check nothing is counted."""
    work = WORK.get()
    if work is None:
        return
    work.left -= products
    if work.left < 0:
        raise Exhausted("not decided: the budget of work is used up (see --work)")


@contextmanager
def budget(work: int | None, files: int = 0) -> Iterator[Work]:
    """Set the budget of a check: by default the usual work, and some for each byte of files."""
    if work is None:
        work = Work.usual + Work.for_each_byte * files
    of_check = Work(work)
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
BITS_OF_PIECE = 2000  # such an integer has less than 640 digits
EXACT = Context(prec=MAX_PREC, Emin=MIN_EMIN, Emax=MAX_EMAX)  # no integer is rounded


def integer(text: str) -> int:
    """Return the integer that a sign and digits denote."""
    if len(text) <= PIECE:
        return int(text)
    if text[0] in "+-":
        sign = -1 if text[0] == "-" else 1
        return sign * integer(text[1:])
    ends = range(len(text), 0, -PIECE)
    pieces = [int(text[max(0, end - PIECE) : end]) for end in ends]  # the lowest one first
    power = 10**PIECE
    while len(pieces) > 1:  # two pieces become one: of a few large products, not of many small ones
        pairs = zip_longest(pieces[::2], pieces[1::2], fillvalue=0)
        pieces = [low + high * power for low, high in pairs]
        if len(pieces) > 1:
            power *= power
    return pieces[0]


def digits(n: int) -> str:
    """Return the digits of an integer, after a sign if it is negative."""
    if n.bit_length() <= BITS_OF_PIECE:
        return str(n)
    size = 128  # bytes of a piece
    raw = abs(n).to_bytes(n.bit_length() // 8 + 1, "little")
    parts = [raw[start : start + size] for start in range(0, len(raw), size)]
    pieces = [Decimal(int.from_bytes(part, "little")) for part in parts]  # the lowest one first
    power = Decimal(1 << (8 * size))
    while len(pieces) > 1:
        pairs = zip_longest(pieces[::2], pieces[1::2], fillvalue=Decimal(0))
        pieces = [EXACT.fma(high, power, low) for low, high in pairs]
        if len(pieces) > 1:
            power = EXACT.multiply(power, power)
    sign = "-" if n < 0 else ""
    return sign + str(pieces[0])


def written(q: Fraction | int) -> str:
    """Return a rational number as it is written in a proof."""
    over, under = digits(q.numerator), digits(q.denominator)
    return over if under == "1" else f"{over}/{under}"


# ---- Polynomials, and their real roots.

PRIME = 2**61 - 1


def words(n: int | Fraction) -> int:
    """Return the number of 64-bit words of a number, its denominator's included."""
    bits = n.numerator.bit_length() + n.denominator.bit_length()
    return (bits >> 6) + 1


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
            highest_first = dropwhile(not_, f[::-1])
            f = tuple.__new__(cls, [*highest_first][::-1])
        return f

    def __add__(self, g: "Poly") -> "Poly":  # type: ignore[override]
        if not self:
            return g
        if not g:
            return self
        return Poly([a + b for a, b in zip_longest(self, g, fillvalue=0)])

    def __sub__(self, g: "Poly") -> "Poly":
        return Poly([a - b for a, b in zip_longest(self, g, fillvalue=0)])

    def __mul__(self, g: "Poly") -> "Poly":  # type: ignore[override]
        if not self or not g:
            return ZERO
        if len(self) == 1:
            factor = self[0]
            return g if factor == 1 else Poly([factor * b for b in g])
        products = len(self) * len(g)
        if products > 8:
            spend(products * most_words(self) * most_words(g))
        product = [0] * (len(self) + len(g) - 1)
        for i, a in enumerate(self):
            for j, b in enumerate(g):
                product[i + j] += a * b
        return Poly(product)

    def scaled(self, t: Fraction) -> tuple[int, int]:
        """Return d^k times the value at n / d, with k the number of coefficients; and d^k."""
        n, d = t.numerator, t.denominator
        if (n | d) >> 64:
            spend(len(self) ** 2 * words(d) * (words(n) + most_words(self)))
        total, power = 0, 1
        for c in reversed(self):
            total = total * n + c * power
            power *= d
        spend(len(self) * words(total))
        return total * d, power

    def value(self, t: Fraction) -> Fraction:
        """Return the value at a time."""
        over, under = self.scaled(t)
        return Fraction(over, under)

    def sign_at(self, t: Fraction) -> int:
        """Return the sign of the value at a time."""
        value, _ = self.scaled(t)
        return (value > 0) - (value < 0)

    def along(self, a: Fraction, b: Fraction) -> "Poly":
        """Return the polynomial in s whose value is that of this one at the time a + (b - a) s."""
        n = len(self)
        size = most_words(self) + n * most_words((a, b))
        spend(n * n * (300 + 2 * size**2))
        time = Poly([a, b - a])
        f = Poly()
        for c in reversed(self):
            f = f * time + Poly([c])
        return f

    def derivative(self) -> "Poly":
        """Return the derivative."""
        slopes = [i * c for i, c in enumerate(self)]
        return Poly(slopes[1:])

    def bound(self, a: Fraction, b: Fraction) -> Fraction:
        """Return the largest absolute value of the Bernstein coefficients on [a, b].

        On [0, 1] the j-th coefficient of a polynomial of degree n is the sum, over i <= j, of its
        i-th coefficient times C(j, i) / C(n, i).
        """
        f = self.along(a, b)
        n = len(f) - 1
        spend(len(f) ** 2 * (300 + 2 * most_words(f) ** 2))
        largest = Fraction(0)
        for j in range(n + 1):
            terms = (c * comb(j, i) / comb(n, i) for i, c in enumerate(f[: j + 1]))
            largest = max(largest, abs(sum(terms, Fraction(0))))
        return largest

    def primitive(self) -> "Poly":
        """Return the primitive part, with a positive leading coefficient."""
        if not self:
            return self
        content = gcd(*self)
        if self[-1] < 0:
            content = -content
        spend(len(self) * most_words(self) * words(content))
        return Poly([c // content for c in self])

    def divided(self, g: "Poly") -> tuple["Poly", "Poly"]:
        """Return (q, r) with c f = q g + r, a number c that is not 0, and deg r < deg g."""
        rest = list(self)
        quotient = [0] * max(0, len(self) - len(g) + 1)
        spend(len(quotient) * len(self) * most_words(self) * most_words(g))
        leading, others = g[-1], g[:-1]
        for i in range(len(self) - len(g), -1, -1):
            top = rest.pop()
            rest = [leading * c for c in rest]
            quotient = [leading * c for c in quotient]
            quotient[i] = top
            for j, c in enumerate(others):
                rest[i + j] -= top * c
        return Poly(quotient), Poly(rest)

    def is_prime_to(self, g: "Poly") -> bool:
        """Return True if both are coprime modulo a prime that keeps the degree of a divisor."""
        a = [c % PRIME for c in self]
        b = Poly(c % PRIME for c in g)
        if not a or not a[-1]:
            return False
        while len(b) > 1:  # Euclid's algorithm: a becomes its remainder by b
            spend(len(b) * len(a))
            inverse = pow(b[-1], -1, PRIME)
            for i in range(len(a) - len(b), -1, -1):
                factor = a[i + len(b) - 1] * inverse % PRIME
                if not factor:
                    continue
                for j, c in enumerate(b):
                    a[i + j] = (a[i + j] - factor * c) % PRIME
            remainder = Poly(a[: len(b) - 1])
            a, b = list(b), remainder
        return len(b) == 1

    def common_divisor(self, g: "Poly") -> "Poly":
        """Return the greatest common divisor, by Euclid's algorithm."""
        if self.is_prime_to(g):
            return Poly([1])
        f = self
        while g:
            _, remainder = f.divided(g)
            f, g = g, remainder.primitive()
        return f.primitive()

    def square_free(self) -> "Poly":
        """Return the polynomial with the same roots, all of them simple."""
        if len(self) < 3:
            return self.primitive()
        repeated = self.common_divisor(self.derivative())
        quotient, _ = self.divided(repeated)
        return quotient.primitive()

    def variations(self, low: Fraction, high: Fraction) -> int:
        """Return an upper bound of the number of roots in (low, high), exact if it is 0 or 1.

        Descartes' rule of signs for (1 + x)^n f((high + low x) / (1 + x)), x > 0.
        """
        d = lcm(low.denominator, high.denominator)
        spend(len(self) ** 2 * words(d) * (most_words(self) + len(self) * words(d)))
        start, width = int(low * d), int((high - low) * d)
        g: list[int] = []  # of s: d^n f(low + (high - low) s)
        power = 1
        for c in reversed(self):
            g = [start * a + width * b for a, b in zip([*g, 0], [0, *g], strict=True)]
            g[0] += c * power
            power *= d
        # Its coefficients in reverse order, and x + 1 for x.
        g.reverse()
        for i in range(len(g) - 1):
            for j in range(len(g) - 2, i - 1, -1):
                g[j] += g[j + 1]
        signs = [c > 0 for c in g if c]
        return sum(a != b for a, b in pairwise(signs))

    def roots(self, low: Fraction, high: Fraction, depth: int = -1) -> "Iterator[Time]":
        """Yield the roots in [low, high], all of them simple; low < high. Depth -1: no limit."""
        for end in (low, high):
            if self.sign_at(end) == 0:
                yield Time(end)
        todo = [(low, high, depth)]
        while todo:  # halve intervals, until each root is alone in one
            a, b, left = todo.pop()
            count = self.variations(a, b)
            if count == 0:
                continue
            if count == 1 and self.sign_at(a) and self.sign_at(b):
                yield Time(a, b, self)
                continue
            ends = f"{written(low):.200} and {written(high):.200}"
            require(left, f"the roots of a polynomial between {ends} are too near")
            middle = (a + b) / 2
            todo += [(a, middle, left - 1), (middle, b, left - 1)]
            if self.sign_at(middle) == 0:
                yield Time(middle)


ZERO = Poly()
ONE = Poly([Fraction(1)])


class Time:
    """A number: low = high; or the only root, a simple one, of f between low and high."""

    def __init__(self, low: Fraction, high: Fraction | None = None, f: Poly = ZERO) -> None:
        self.low = low
        self.high = low if high is None else high
        self.f = f

    def refine(self) -> None:
        """Halve the interval."""
        self.compare_rational((self.low + self.high) / 2)

    def compare_rational(self, q: Fraction) -> int:
        """Return -1, 0 or 1 if the time is before, at or after q."""
        if self.high < q or self.low > q or self.low == self.high:
            return (self.low > q) - (self.low < q)
        sign = self.f.sign_at(q)
        if sign == 0:
            self.low = self.high = q
            return 0
        if sign == self.f.sign_at(self.low):  # no change before q
            self.low = q
            return 1
        self.high = q
        return -1

    def compare(self, other: "Time") -> int:
        """Return -1, 0 or 1 if the time is before, at or after the other one."""
        if other.low == other.high:
            return self.compare_rational(other.low)
        if self.compare_rational(other.low) <= 0:
            return -1
        if self.compare_rational(other.high) >= 0:
            return 1
        sign = self.sign_of(other.f)  # which has but one root there
        if sign == 0:
            return 0
        return -1 if sign == other.f.sign_at(other.low) else 1

    def sign_of(self, g: Poly) -> int:
        """Return the sign of g at this time."""
        differ = False  # whether g is known not to vanish at this time
        while self.low < self.high and g:
            sign = g.sign_at(self.low)
            is_same = sign and sign == g.sign_at(self.high)
            if is_same and g.variations(self.low, self.high) == 0:
                return sign
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
        if self.low == self.high:
            return written(self.low)
        return f"{twelve_digits(self)}..."


def twelve_digits(time: Time) -> str:
    """Return the first twelve digits of a number, without the digits after them."""
    sign = time.compare_rational(Fraction(0))
    if sign == 0:
        return "0"
    while time.low * time.high <= 0 or abs(time.high - time.low) * 10**16 > abs(time.low):
        time.refine()
    size = min(abs(time.low), abs(time.high))
    bits = size.numerator.bit_length() - size.denominator.bit_length()
    exponent = bits * 30103 // 100000 - 2  # 0.30103 is about log10 of 2
    unit = Fraction(10) ** (exponent - 11)  # of which the number is between 10^11 and 10^15
    n = floor(size / unit)
    is_above_next = time.compare_rational(sign * (n + 1) * unit) * sign >= 0
    n += is_above_next
    shown, exponent = str(n)[:12], exponent + len(str(n)) - 12
    minus = "-" if sign < 0 else ""
    if 0 <= exponent < 11:
        return f"{minus}{shown[: exponent + 1]}.{shown[exponent + 1 :]}"
    if -5 <= exponent < 0:
        zeros_after_point = "0" * (-exponent - 1)
        return f"{minus}0.{zeros_after_point}{shown}"
    return f"{minus}{shown[0]}.{shown[1:]}e{exponent}"


def between(a: Time, b: Time, start: Fraction, unit: Fraction) -> Fraction:
    """Return a rational number with few digits between two times.

    There must be a number between them that is the start plus a multiple of the unit.
    """
    near = unit * 2 ** (APART - 64)  # times that are nearer may be one: a root of both
    while b.low - a.high < unit:
        require(b.high > a.low, "times do not increase")
        width = max(a.high - a.low, b.high - b.low)
        do_overlap = a.low < a.high and b.low < min(a.high, b.high)
        if width < near and do_overlap:
            near = Fraction(0)  # this is asked once
            common = a.f.common_divisor(b.f)
            low, high = max(a.low, b.low), min(a.high, b.high)
            is_one_root = common.sign_at(low) * common.sign_at(high) < 0
            require(not is_one_root, "times do not increase")
        if width * 2 < unit:
            q = start + (floor((a.low - start) / unit) + 1) * unit  # the first one after a.low
            if a.compare_rational(q) >= 0:
                q += unit
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
    roots = f.square_free().roots(low, high)
    orders = [root.compare(end) for root in roots if root.compare(start) > 0]
    return -1 in orders, 0 in orders


# ---- Tracks: a vertex is at (x / w, y / w), polynomials, w > 0; its place is three integers.

Track = tuple[Poly, Poly, Poly]
Whole = tuple[int, int, int]
Rows = list[Whole]  # of a vertex at (x / z, y / z): coefficients of x, y and z, by powers of t
Entry = TypeVar("Entry", int, Poly)
Triple = tuple[Entry, Entry, Entry]


def vector_of(a: Triple[Entry], b: Triple[Entry]) -> tuple[Entry, Entry]:
    """Return a positive multiple of b - a."""
    return b[0] * a[2] - a[0] * b[2], b[1] * a[2] - a[1] * b[2]


def turn(a: Triple[Entry], b: Triple[Entry], c: Triple[Entry]) -> Entry:
    """Return the determinant: positive where a, b, c turn left, 0 where they are on one line."""
    of_a = a[0] * (b[1] * c[2] - c[1] * b[2])
    of_b = b[0] * (c[1] * a[2] - a[1] * c[2])
    of_c = c[0] * (a[1] * b[2] - b[1] * a[2])
    return of_a + of_b + of_c


def orientation_of(a: Track, b: Track, c: Track) -> Poly:
    """Return the polynomial of a turn, computed once in a check."""
    work = WORK.get()
    return work.turn(a, b, c) if work else counted_turn(a, b, c)


def counted_turn(a: Track, b: Track, c: Track) -> Poly:
    """Return the polynomial of a turn; its short products are counted here."""
    bits = max(map(int.bit_length, chain(*a, *b, *c)))
    spend(40 * ((bits >> 6) + 1) ** 2)
    return turn(a, b, c)


def dot_of(a: Triple[Entry], v: Triple[Entry], b: Triple[Entry]) -> Entry:
    """Return a positive multiple of the dot product (a - v) . (b - v)."""
    (px, py), (qx, qy) = vector_of(v, a), vector_of(v, b)
    return px * qx + py * qy


def values(polynomials: Sequence[Poly], t: Fraction) -> list[int]:
    """Return the values of polynomials in integers at a time, times one positive number."""
    terms = max(map(len, polynomials))
    if terms < 2:
        return [*map(sum, polynomials)]
    n, d = t.numerator, t.denominator
    if (n | d) >> 64:
        size = words(d) * (terms * words(n) + longest(chain(*polynomials)))
        spend(len(polynomials) * terms**2 * size)
    # At 0 all powers but the first vanish: it is left at that.
    powers = [n**i * d ** (terms - 1 - i) for i in range(terms if n else 1)]
    found = [sum(map(mul, f, powers)) for f in polynomials]
    bits = sum(map(int.bit_length, found))
    spend(terms * (len(found) + (bits >> 6)))
    return found


def are_opposite(p: int, q: int) -> bool:
    """Return True if one number is positive and the other one negative."""
    return p > 0 > q or p < 0 < q


def meet(a: Whole, b: Whole, c: Whole, d: Whole) -> bool:
    """Return True if the closed segments ab and cd have a point in common."""
    of_c, of_d = turn(a, b, c), turn(a, b, d)
    of_a, of_b = turn(c, d, a), turn(c, d, b)
    if are_opposite(of_c, of_d) and are_opposite(of_a, of_b):
        return True
    # Otherwise an end of one of them is on the other one.
    ends = ((of_c, c, a, b), (of_d, d, a, b), (of_a, a, c, d), (of_b, b, c, d))
    return any(side == 0 and dot_of(x, v, y) <= 0 for side, v, x, y in ends)


def are_same(points: Sequence[Whole], others: Sequence[Whole]) -> bool:
    """Return True if points, as many of both, are equal."""
    return all(vector_of(p, q) == (0, 0) for p, q in zip(points, others, strict=True))


def is_simple(points: Sequence[Whole], edges: Iterable[Dart], first: int) -> bool:
    """Return True if edges (numbers of vertices, counted from the first) meet only at joints.

    Only edges whose boxes overlap are compared: a sweep from left to right. A box is of integers,
    multiples of 2^-256 rounded down, which keep their order.
    """
    product = longest(chain(*points)) ** 2
    rounded = [((x << 256) // w, (y << 256) // w) for x, y, w in points]
    boxes: list[tuple[int, int, int, int, int, int]] = []
    for one, other in edges:
        spend(4 * product)
        u, v = one - first, other - first
        if vector_of(points[u], points[v]) == (0, 0):
            return False
        (x, y), (z, w) = rounded[u], rounded[v]
        boxes.append((min(x, z), max(x, z), min(y, w), max(y, w), u, v))
    boxes.sort()
    for k, (_, right, bottom, top, a, b) in enumerate(boxes):
        for j in range(k + 1, len(boxes)):
            left, _, low, high, c, d = boxes[j]
            if left > right:
                break
            spend(200)
            if low > top or high < bottom:
                continue
            spend(2000 + 60 * product)
            if not are_apart_or_joined(points, (a, b), (c, d)):
                return False
    return True


def are_apart_or_joined(points: Sequence[Whole], one: Dart, other: Dart) -> bool:
    """Return True if edges meet nowhere, or where one ends and the other begins, and only there."""
    (a, b), (c, d) = one, other
    if b == c:
        before, joint, after = a, b, d
    elif d == a:
        before, joint, after = c, d, b
    else:
        return not meet(points[a], points[b], points[c], points[d])
    p, q, r = points[before], points[joint], points[after]
    do_turn = turn(p, q, r) != 0
    return do_turn or dot_of(p, q, r) < 0


def surrounds(ring: Sequence[Whole], p: Whole) -> bool:
    """Return True if a ray from p to the right crosses a polygon an odd number of times."""
    spend(len(ring) * (300 + 15 * longest((*p, *ring[0])) ** 2))
    is_above = [q[1] * p[2] > p[1] * q[2] for q in ring]
    is_odd = False
    for i, a in enumerate(ring):
        if is_above[i] == is_above[i - 1]:
            continue
        before = ring[i - 1]
        side = turn(before, a, p) if is_above[i] else turn(a, before, p)
        if side > 0:
            is_odd = not is_odd
    return is_odd


# ---- The values of JSON. What is not understood is refused.

NUMBER = re.compile(r"([+-]?)(\d*+)(?:/(\d++)|\.?(\d*+)(?:[eE]([+-]?\d{1,18}))?)", re.ASCII)
MAX_BITS = 33_220  # of a numerator or denominator in a scene: 10,000 digits
MAX_DIGITS = 10_000  # of one in a proof
MAX_DEGREE = 64  # of a coordinate of a vertex, in homogeneous coordinates
MAX_EXPONENT = 100_000  # of a decimal
MAX_LEVELS = 30  # of lists and objects in the properties of a body
SURROGATES = re.compile("[\ud800-\udfff]")  # without another one beside them: no text


class Bare(str):
    """A number of JSON, as it is written: not one in quotes."""

    __slots__ = ()


def need(condition: object, what: str, data: Json = "") -> None:
    """Refuse the scene unless the condition holds."""
    if not condition:
        raise NoProofError(f"the scene: {what} {data!r:.60}")


def read_json(text: str) -> Json:
    """Return the data of a text in JSON, with numbers as they are written."""

    def unique(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
        found = dict(pairs)
        need(len(found) == len(pairs), "a key is there twice:", pairs)
        return found

    return json.loads(text, parse_int=Bare, parse_float=Bare, object_pairs_hook=unique)


def is_text(data: Json) -> bool:
    """Return True for a text of JSON, and not for a number."""
    return isinstance(data, str) and not isinstance(data, Bare)


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
    sign, units, under, decimals, exponent = match.groups("") if match else [""] * 5
    need(units or decimals, "not a number:", data)
    need(not under or under.strip("0"), "a denominator is zero:", data)
    power = int(exponent or 0)
    need(abs(power) <= MAX_EXPONENT, f"an exponent beyond {MAX_EXPONENT:,}:", data)
    n = integer(sign + units + decimals)
    power = power - len(decimals) if n else 0
    if under:
        q = Fraction(n, integer(under))
    elif power < 0:
        q = Fraction(n, 10**-power)
    else:
        q = Fraction(n * 10**power)
    bits = max(q.numerator.bit_length(), q.denominator.bit_length())
    need(bits <= MAX_BITS, "more than 10,000 digits:", data)
    return q


def keys(data: Json, required: Sequence[str] = (), optional: Sequence[str] = ()) -> Json:
    """Return a JSON object with all of the required keys, and no others but the optional ones."""
    need(isinstance(data, dict), "not an object:", data)
    unknown = sorted(data.keys() - {*required, *optional})
    need(not unknown, "an object with other keys:", unknown)
    missing = [key for key in required if key not in data]
    need(not missing, "an object without keys:", missing)
    return data


def entries(data: Json, length: int | None = None) -> Json:
    """Return a JSON list, of this length if one is given."""
    need(isinstance(data, list) and length in (None, len(data)), "not a list as needed:", data)
    return data


def check_json(data: Json, levels: int) -> None:
    """Check a value that has no meaning here, and how deep it is."""
    if isinstance(data, str):
        is_right = data.isascii() or not SURROGATES.search(data)
        need(is_right, "a text with half a character:", data)
        return
    need(not isinstance(data, float), "a number that is none:", data)
    if isinstance(data, (dict, list)):
        need(levels, "nested too deeply:", None)
        inner = [*data, *data.values()] if isinstance(data, dict) else data
        for value in inner:
            check_json(value, levels - 1)


def polynomial(data: Json) -> Poly:
    """Return the polynomial that a list of numbers is."""
    return Poly([number(c) for c in entries(data)])


def point(data: Json) -> Point:
    """Return the point that a list of two numbers is."""
    x, y = entries(data, 2)
    return number(x), number(y)


def error_of(data: Json, key: str) -> Fraction:
    """Return an error, the value of a key: a number that is not negative."""
    error = number(data)
    need(error >= 0, f"a negative {key}:", data)
    return error


def degree(*polynomials: Poly) -> int:
    """Return the highest degree; that of 0 is 0."""
    return max(1, *map(len, polynomials)) - 1


def cleared(*given: Poly) -> tuple[Poly, ...]:
    """Return polynomials times their common denominator, and this number."""
    ratios = [[q.as_integer_ratio() for q in f] for f in given]
    m = lcm(*[d for f in ratios for _, d in f])
    spend(words(m) ** 2 * sum(map(len, given)))
    whole = [Poly([n * (m // d) for n, d in f]) for f in ratios]
    return *whole, Poly([m])


# ---- The scene (docs/scene-grammar.md). All of it is read: first, motions by one formula.

MOTION_KEYS = {  # required, and optional
    "": ([], ["x", "y"]),
    "affine": (["matrix"], ["x", "y"]),
    "rigid": (["half_turn"], ["x", "y", "pivot", "orientation"]),
}
Form = tuple[Poly, ...]  # a, b, c, d, e, f, w: (x, y) goes to (a x + b y + e, c x + d y + f) / w


@dataclass(frozen=True)
class Turn:
    """A rigid motion: a turn about a pivot, and then a translation.

    Attributes:
        half_turn: the tangent of half the angle.
        orientation: the unit vector (cosine, sine) of a turn that is applied first.
        pivot: the point of the rest frame about which the body turns.
        x: the translation.
        y: the same, in the other direction.
    """

    half_turn: Poly
    orientation: Point
    pivot: Point
    x: Poly
    y: Poly

    def form(self) -> Form:
        """Return the formula of the motion.

        A turn by the angle a with tan(a / 2) = h: (1 - h^2, 2 h) / (1 + h^2) is (cos, sin). The
        pivot p goes to p + (x, y), so that is the translation of the turn about the origin, less
        the turned p.
        """
        h = self.half_turn
        w, cosine, sine = ONE + h * h, ONE - h * h, h + h
        c, s = (Poly([k]) for k in self.orientation)
        a, b = cosine * c - sine * s, sine * c + cosine * s
        p, q = (Poly([k]) for k in self.pivot)
        e = w * (p + self.x) - a * p + b * q
        f = w * (q + self.y) - b * p - a * q
        return a, ZERO - b, b, a, e, f, w


class Motion:
    """A motion by one formula.

    Attributes:
        form: the formula, in integers.
        rigid: the turn that it is, if it is one.
        keeps_lengths: whether it only translates and turns.
    """

    def __init__(self, data: Json, of_shape: int) -> None:
        kinds = {"rigid", "affine"} & data.keys() if isinstance(data, dict) else set[str]()
        kind = next(iter(kinds), "")
        given = keys(data, [kind])[kind] if kind else data
        given = keys(given, *MOTION_KEYS[kind])
        x, y = polynomial(given.get("x", [])), polynomial(given.get("y", []))
        self.rigid: Turn | None = None
        self.keeps_lengths = kind != "affine"
        if kind == "affine":
            matrix = [polynomial(p) for row in entries(given["matrix"], 2) for p in entries(row, 2)]
            need_degree(max(of_shape + degree(*matrix), degree(x, y)))
            *whole, _ = cleared(*matrix, x, y, ONE)
            self.form: Form = tuple(whole)
        elif kind == "rigid":
            half_turn = polynomial(given["half_turn"])
            need_degree(max(of_shape, degree(x, y)) + 2 * degree(half_turn))
            self.rigid = turn_of(given, half_turn, x, y)
            *whole, _ = cleared(*self.rigid.form())
            self.form = tuple(whole)
        else:
            need_degree(max(of_shape, degree(x, y)))
            e, f, w = cleared(x, y)
            self.form = w, ZERO, ZERO, w, e, f, w
        self.columns = [*zip_longest(*self.form, fillvalue=0)]  # by powers of t
        terms, size = sum(map(len, self.form)), longest(chain(*self.form))
        self.cost = terms * (300 + 2 * size**2)

    def track(self, rows: Rows) -> Track:
        """Return the track of a vertex."""
        size = longest(chain(*rows)) if len(rows) > 1 else 1
        spend(self.cost * 2 * len(rows) * size)
        xs, ys, ws = ([0] * (len(self.columns) + len(rows) - 1) for _ in "xyw")
        for i, (p, q, r) in enumerate(rows):
            for j, (a, b, c, d, e, f, w) in enumerate(self.columns, i):
                xs[j] += a * p + b * q + e * r
                ys[j] += c * p + d * q + f * r
                ws[j] += w * r
        common = gcd(*xs, *ys, *ws)
        x, y, w = (Poly([k // common for k in f]) for f in (xs, ys, ws))
        return x, y, w


def need_degree(highest: int) -> None:
    """Refuse coordinates of too high a degree."""
    need(highest <= MAX_DEGREE, f"a degree above {MAX_DEGREE}")


def turn_of(given: Json, half_turn: Poly, x: Poly, y: Poly) -> Turn:
    """Return a turn with its orientation and pivot."""
    cosine, sine = orientation = point(given.get("orientation", ["1", "0"]))
    is_unit = cosine * cosine + sine * sine == 1
    need(is_unit, "an orientation that is no unit vector:", given.get("orientation"))
    return Turn(half_turn, orientation, point(given.get("pivot", ["0", "0"])), x, y)


# ---- Bodies.

BODY_KEYS = [
    *("motion", "closed", "holes", "radius", "properties", "vertices", "keyframes", "parts"),
    *("place_error", "angle_error", "shape_error", "pivot"),
]
Frame = tuple[Fraction, list[Point]]  # a time, and where the vertices are


class Ring(NamedTuple):
    """A ring of a body: the numbers of its vertices, and whether it bounds a hole."""

    vertices: range
    is_hole: bool


class Body:
    """A body: the tracks of its vertices, in each piece of its motion.

    ``breaks`` are the times at which formulas change: piece k ends at breaks[k]. In ``parts``, the
    outline of each part is before its holes. ``at_start`` are the places of the vertices at the
    start. The body ``is_modelled`` if the true body may differ from it.
    """

    def __init__(
        self, data: Json, first: int, start: Fraction, *, are_records_verified: bool
    ) -> None:
        body = keys(data, ["name"], BODY_KEYS)
        self.name = body["name"]
        need(is_text(self.name) and self.name, "a name:", self.name)
        self.radius = number(body.get("radius", "0"))
        need(self.radius >= 0, "a radius:", body.get("radius"))
        properties = body.get("properties", {})
        need(isinstance(properties, dict), "properties:", self.name)
        check_json([self.name, properties], MAX_LEVELS)
        closed = body.get("closed", True)
        need(isinstance(closed, bool), "closed:", closed)
        sizes = self.read_shape(body, closed=closed)
        self.read_motion(body.get("motion", {}), are_records_verified=are_records_verified)
        self.read_errors(body)
        self.first = first
        self.vertices = range(first, first + self.size)
        self.closed = closed and self.size > 2
        self.number_rings(sizes)
        self.breaks = sorted({*self.ends, *dict(self.frames)})
        self.tracks = dict[tuple[int, int], Track]()  # by vertex and piece
        self.at_start = self.places(start)
        self.check_simple(self.at_start)

    def read_shape(self, body: Json, *, closed: bool) -> list[list[int]]:
        """Read the vertices; return how many there are in each ring, for each part."""
        shapes = [key for key in ("vertices", "keyframes", "parts") if key in body]
        need(len(shapes) == 1, "vertices or keyframes or parts:", self.name)
        need("holes" not in body or "vertices" in body, "holes without vertices:", self.name)
        parts = [body]
        if "parts" in body:
            parts = [keys(part, ["vertices"], ["holes"]) for part in entries(body["parts"])]
            need(parts, "no parts:", self.name)
        rings: list[list[Json]] = []  # for each part
        for part in parts:
            outline, holes = part.get("vertices", []), entries(part.get("holes", []))
            rings.append([entries(ring) for ring in (outline, *holes)])
        every = [ring for part in rings for ring in part]
        are_rings = "parts" in body or len(every) > 1
        need(not are_rings or closed, "an open chain with rings:", self.name)
        need(not are_rings or min(map(len, every)) > 2, "a ring of fewer than three:", self.name)
        self.frames = keyframes(body["keyframes"]) if "keyframes" in body else list[Frame]()
        self.shape = [vertex(data) for ring in every for data in ring]
        self.size = len(self.frames[0][1] if self.frames else self.shape)
        need(self.size, "no vertices:", self.name)
        if not are_rings:
            return [[self.size]]
        return [[len(ring) for ring in part] for part in rings]

    def number_rings(self, sizes: list[list[int]]) -> None:
        """Give numbers to the vertices of rings, from the first one on, and list the edges."""
        self.parts: list[list[range]] = []
        first = self.first
        for part in sizes:
            self.parts.append([])
            for size in part:
                self.parts[-1].append(range(first, first + size))
                first += size
        self.rings: list[Ring] = []
        self.edges: list[Dart] = []
        for outline, *holes in self.parts:
            self.rings.append(Ring(outline, is_hole=False))
            self.rings += [Ring(hole, is_hole=True) for hole in holes]
        for ring, _ in self.rings:
            last = [ring[0]] if self.closed else []
            self.edges += pairwise([*ring, *last])

    def read_motion(self, data: Json, *, are_records_verified: bool) -> None:
        """Read the motions, which follow one upon the other at the times ``ends``."""
        of_shape = 1 if self.frames else max(map(len, self.shape)) - 1
        self.ends: list[Fraction] = []
        self.path: PathRecord | None = None
        if not isinstance(data, dict) or "pieces" not in data:
            self.motions = [Motion(data, of_shape)]
            return
        records = ["spin", "path", "spline"]
        given = keys(data, ["pieces"], records)
        need(
            sum(key in given for key in records) < 2, "both a spin and a path (or a spline):", data
        )
        pieces = [keys(piece, ["motion"], ["until"]) for piece in entries(given["pieces"])]
        need(pieces, "a motion of no pieces:", self.name)
        *others, last = pieces
        have_ends = all("until" in piece for piece in others) and "until" not in last
        need(have_ends, '"until" belongs to all pieces but the last:', data)
        self.ends = [number(piece["until"]) for piece in others]
        need(do_increase(self.ends), "pieces not in order:", data)
        self.motions = [Motion(piece["motion"], of_shape) for piece in pieces]
        self.check_jumps()
        if "spin" in given:
            spin = spin_of(given["spin"], self.motions)
            is_so = not are_records_verified or turns_by(self.ends, self.motions, spin)
            need(is_so, "not such a spin:", data)
        if "path" in given:
            self.path = path_of(given["path"])
            is_so = not are_records_verified or follows(self.ends, self.motions, self.path)
            need(is_so, "not such a path:", data)
        if "spline" in given:
            check_spline(given["spline"])

    def check_jumps(self) -> None:
        """Check that no vertex jumps where a motion ends and the next one begins."""
        for t, (before, after) in zip(self.ends, pairwise(self.motions), strict=True):
            one, other = values(before.form, t), values(after.form, t)
            if [c * other[-1] for c in one] == [c * one[-1] for c in other]:
                continue  # one map of the plane: no vertex has to be looked at
            is_one_place = are_same(self.places(t, before), self.places(t, after))
            need(is_one_place, f"{self.name!a:.200} jumps at t = {written(t):.200}")

    def read_errors(self, body: Json) -> None:
        """Read by how much the true body may differ from the modelled one, which is the one here.

        An error of the angle is a turn about a reference point: the one about which the motion
        turns the body, or else the "pivot" of the body.
        """
        place = error_of(body.get("place_error", "0"), "place_error")
        angle = error_of(body.get("angle_error", "0"), "angle_error")
        outward, inward = entries(body.get("shape_error", ["0", "0"]), 2)
        shape = error_of(outward, "shape_error") + error_of(inward, "shape_error")
        self.is_modelled = place + angle + shape > 0
        has_pivot = "pivot" in body
        if has_pivot:
            point(body["pivot"])
        if angle == 0:
            need(not has_pivot, "a pivot without an angle_error:", self.name)
            return
        turned_about = {motion.rigid.pivot for motion in self.motions if motion.rigid}
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
        (start, before), (end, after) = self.around(t)
        coordinates: list[Poly] = []
        for a, b in zip(before[i], after[i], strict=True):
            slope = (b - a) / (end - start) if end > start else Fraction(0)
            coordinates.append(Poly([a - slope * start, slope]))
        return rows_of(*coordinates)

    def around(self, t: Fraction) -> tuple[Frame, Frame]:
        """Return the frames before and after a time."""
        k = bisect_right(self.frames, t, key=lambda frame: frame[0])
        return self.frames[max(k - 1, 0)], self.frames[min(k, len(self.frames) - 1)]

    def places(self, t: Fraction, motion: Motion | None = None) -> list[Whole]:
        """Return where the vertices are at a time, by a motion or the one just after that time."""
        if motion is None:
            motion = self.motions[bisect_right(self.ends, t)]
        a, b, c, d, e, f, w = form = values(motion.form, t)
        spend(self.size * (1000 + 30 * longest(form)))
        shape = [self.rows(i, t) for i in range(self.size)] if self.frames else self.shape
        at = [value_of(rows, t) for rows in shape]
        return [(a * x + b * y + e * z, c * x + d * y + f * z, w * z) for x, y, z in at]

    def check_simple(self, places: Sequence[Whole]) -> None:
        """Check that edges meet only where joined, and that holes and parts are in place."""
        simple = is_simple(places, self.edges, self.first)
        need(simple, f"{self.name!a:.200} is not simple at the start")
        if len(self.rings) == 1:
            return
        points = {ring: [places[v - self.first] for v in ring] for ring, _ in self.rings}

        def is_in(ring: range, other: range) -> bool:
            first_point = points[ring][0]  # as rings do not meet, all of it is where this one is
            return surrounds(points[other], first_point)

        amiss = f"{self.name!a:.200}: a hole or part is where none can be"
        for outline, *holes in self.parts:
            for hole in holes:
                need(is_in(hole, outline), amiss)
                need(not any(is_in(hole, other) for other in holes if other != hole), amiss)
            for around, *its_holes in self.parts:
                if around != outline and is_in(outline, around):
                    need(any(is_in(outline, hole) for hole in its_holes), amiss)

    def track(self, i: int, after: Fraction) -> Track:
        """Return the track of vertex i just after a time."""
        piece = bisect_right(self.breaks, after)
        if (i, piece) not in self.tracks:
            motion = self.motions[bisect_right(self.ends, after)]
            self.tracks[i, piece] = motion.track(self.rows(i, after))
        return self.tracks[i, piece]

    def keeps_lengths(self, t: Fraction) -> bool:
        """Return True if the body is only translated and rotated just after a time."""
        motion = self.motions[bisect_right(self.ends, t)]
        return motion.keeps_lengths and self.keeps_shape(t)

    def keeps_shape(self, t: Fraction) -> bool:
        """Return True if its shape is only translated just after a time, before its motion."""
        if self.frames:
            (_, before), (_, after) = self.around(t)
            spend(self.size * (500 + 8 * most_words(chain(*before, *after)) ** 2))
            moves = {(c - a, d - b) for (a, b), (c, d) in zip(before, after, strict=True)}
            return len(moves) == 1
        (f, g, h), *others = ([*map(Poly, zip(*rows, strict=True))] for rows in self.shape)
        spend(self.size * (500 + 8 * most_words(chain(f, g, h)) ** 2))
        # The differences of coordinates from those of the first vertex are constant.
        same_x = all((f * w)[1:] == (x * h)[1:] for x, _, w in others)
        return same_x and all((g * w)[1:] == (y * h)[1:] for _, y, w in others)


def do_increase(numbers: Iterable[Fraction]) -> bool:
    """Return True if each of some numbers is above the one before it."""
    return all(before < after for before, after in pairwise(numbers))


def rows_of(x: Poly, y: Poly) -> Rows:
    """Return the rows of a vertex at (x, y)."""
    return [*zip_longest(*cleared(x, y), fillvalue=0)]


def value_of(rows: Rows, t: Fraction) -> Sequence[int]:
    """Return where a vertex with these rows is at a time, before its motion."""
    if len(rows) == 1:
        return rows[0]
    x, y, z = zip(*rows, strict=True)
    return values([Poly(x), Poly(y), Poly(z)], t)


def vertex(data: Json) -> Rows:
    """Return the rows of a vertex: two numbers, or polynomials x and y."""
    if isinstance(data, dict):
        given = keys(data, optional=["x", "y"])
        return rows_of(polynomial(given.get("x", [])), polynomial(given.get("y", [])))
    (p, d), (q, e) = (c.as_integer_ratio() for c in point(data))
    m = lcm(d, e)
    return [(p * (m // d), q * (m // e), m)]


def keyframes(data: Json) -> list[Frame]:
    """Return the times and the places of keyframes; between them all is linear."""
    frames: list[Frame] = []
    for entry in entries(data):
        frame = keys(entry, ["t", "vertices"])
        places = [point(place) for place in entries(frame["vertices"])]
        frames.append((number(frame["t"]), places))
    sizes = {len(places) for _, places in frames}
    need(len(sizes) == 1, "no keyframes, or of different sizes:", data)
    need(do_increase(t for t, _ in frames), "keyframes not in order:", data)
    return frames


# ---- The records that may stand beside the pieces of a motion: what these pieces approximate.


@dataclass(frozen=True)
class SpinRecord:
    """The record of a spin: pieces turn by the angle omega t, but for an error."""

    omega: Fraction
    error: Fraction


def spin_of(data: Json, motions: Sequence[Motion]) -> SpinRecord:
    """Return the record of a spin; a pivot that it names is that of all motions."""
    spin = keys(data, ["omega", "error"], ["pivot"])
    omega, error = number(spin["omega"]), number(spin["error"])
    need(error > 0, "a spin's error:", data)
    if "pivot" in spin:
        pivot = point(spin["pivot"])
        is_of_all = all(motion.rigid and motion.rigid.pivot == pivot for motion in motions)
        need(is_of_all, "a spin about another pivot:", data)
    return SpinRecord(omega, error)


def check_spline(data: Json) -> None:
    """Check the error of a spline, which is assumed: pieces are taken as they are."""
    spline = keys(data, ["error"])
    error_of(spline["error"], "error")


class Pose(NamedTuple):
    """A place and an angle in radians, polynomials of the time since the pose began."""

    x: Poly
    y: Poly
    angle: Poly


@dataclass(frozen=True)
class PathRecord:
    """The record of a path: poses, which the pieces of a motion follow within errors.

    Attributes:
        pivot: the point of the rest frame about which the poses turn.
        angle_error: the verified part of the error of the angle; the rest is assumed.
        place_error: the error of the translation.
        times: where poses begin and end, one more than poses.
        poses: the poses.
        does_rest: whether the body rests before and after the path; otherwise it does not turn
            there.
    """

    pivot: Point
    angle_error: Fraction
    place_error: Fraction
    times: list[Fraction]
    poses: list[Pose]
    does_rest: bool = True


def path_of(data: Json) -> PathRecord:
    """Return the record of a path."""
    required = ["error", "place_error", "times", "poses"]
    path = keys(data, required, ["assumed_angle_error", "pivot"])
    assumed = error_of(path.get("assumed_angle_error", "0"), "assumed_angle_error")
    verified = number(path["error"]) - assumed
    need(verified > 0, "an error of the angle that is not above the assumed one:", data)
    off = error_of(path["place_error"], "place_error")
    times = [number(t) for t in entries(path["times"])]
    poses: list[Pose] = []
    for entry in entries(path["poses"]):
        row = keys(entry, ["x", "y", "angle"])
        poses.append(Pose(*(polynomial(row[key]) for key in ("x", "y", "angle"))))
    need(len(times) == len(poses) + 1 > 1, "not one pose for each two times:", data)
    need(do_increase(times), "the times of a path do not increase:", data)
    pivot = point(path.get("pivot", ["0", "0"]))
    return PathRecord(pivot, verified, off, times, poses)


# ---- A path: pieces that turn by an angle theta, but for an error; that of a spin is omega t. With
# h and theta polynomials of the part s of a piece, the error e of the angle has the derivative w N,
# where w = 1 / (1 + h^2) and N = 2 h' - theta' (1 + h^2). With E the primitive of N from 0 on, by
# parts, |e(s)| <= |e(0)| + max |E| (1 + 2 max |h| max |h'|), since |w'| <= 2 |h h'|.

SAMPLES = 8  # equal parts of a piece
MAX_ANGLE_BITS = 512
MORE_BITS = 8  # with which arc tangents are taken
Bounds = tuple[Fraction, Fraction]
WHOLE_PART: Bounds = (Fraction(0), Fraction(1))


def turns_by(ends: Sequence[Fraction], motions: Sequence[Motion], spin: SpinRecord) -> bool:
    """Return True if motions are seen to turn by omega t, from the first end to the last.

    They follow a path of one pose, and all of them have its translation.
    """
    turns = [motion.rigid for motion in motions if motion.rigid]
    if len(turns) < max(len(motions), 3):
        return False
    pivot, x, y = turns[0].pivot, turns[0].x, turns[0].y
    if any((turn.pivot, turn.x, turn.y) != (pivot, x, y) for turn in turns):
        return False
    start, end = ends[0], ends[-1]
    pose = Pose(*(f.along(start, start + 1) for f in (x, y, Poly([0, spin.omega]))))
    path = PathRecord(pivot, spin.error, Fraction(0), [start, end], [pose], does_rest=False)
    return follows(ends, motions, path)


def largest_gap(gaps: Sequence[Bounds], bits: int) -> Fraction:
    """Return a bound of differences of angles, but for the full turns that are next to one."""
    low, high = pi_bounds(bits)
    first, _ = gaps[0]
    k = 2 * floor(first / (2 * low) + Fraction(1, 2))
    least, most = sorted((k * low, k * high))
    return max(max(q - least, most - p) for p, q in gaps)


def bits_for(error: Fraction, angle: Fraction) -> int:
    """Return the bits after the binary point of a small part of an error, next to an angle."""
    of_error = 5 - error.numerator.bit_length() + error.denominator.bit_length()
    of_angle = floor(abs(angle)).bit_length()
    return max(8, of_error) + of_angle


def follows(ends: Sequence[Fraction], motions: Sequence[Motion], path: PathRecord) -> bool:
    """Return True if motions are seen to follow a path within its errors."""
    times, poses = path.times, path.poses
    turns = [motion.rigid for motion in motions if motion.rigid]
    if len(turns) < max(len(motions), 3):
        return False
    if (ends[0], ends[-1]) != (times[0], times[-1]):
        return False
    for (start, end), (before, after) in zip(pairwise(times), pairwise(poses), strict=False):
        at_end = [f.value(end - start) for f in before]
        if at_end != [f.value(Fraction(0)) for f in after]:
            return False
    spans = pairwise([ends[0], *ends, ends[-1]])  # at rest before and after the path: of no length
    for turn, (start, end) in zip(turns, spans, strict=True):
        k = min(bisect_right(times, start), len(poses)) - 1
        if end > times[k + 1]:
            return False
        pose = Pose(*(f.along(start - times[k], end - times[k]) for f in poses[k]))
        if not is_near(turn, (start, end), pose, path):
            return False
    return True


def is_near(turn: Turn, span: Bounds, pose: Pose, path: PathRecord) -> bool:
    """Return True if one piece is shown to be near a pose of the part s of its span.

    The pieces and the poses turn about one point, so the translations can be compared.
    """
    if turn.pivot != path.pivot:
        return False
    fixed = (turn.half_turn, turn.x, turn.y) if path.does_rest else (turn.half_turn,)
    if span[0] == span[1] and degree(*fixed) > 0:
        return False
    dx = (turn.x.along(*span) - pose.x).bound(*WHOLE_PART)
    dy = (turn.y.along(*span) - pose.y).bound(*WHOLE_PART)
    if dx**2 + dy**2 > path.place_error**2:
        return False
    angle = pose.angle.value(Fraction(0))
    bits = bits_for(path.angle_error, angle)
    if bits > MAX_ANGLE_BITS:
        return False
    bits += MORE_BITS
    h = turn.half_turn.along(*span)
    low, high = angle_of(turned(turn.orientation, h.value(Fraction(0))), bits)
    at_start = largest_gap([(low - angle, high - angle)], bits)
    slope = h.derivative()
    rate = slope + slope - pose.angle.derivative() * (ONE + h * h)
    primitive = Poly([0, *(c / (i + 1) for i, c in enumerate(rate))])
    parts = pairwise(Fraction(i, SAMPLES) for i in range(SAMPLES + 1))
    change = max(primitive.bound(*part) for part in parts)
    factor = 1 + 2 * h.bound(*WHOLE_PART) * slope.bound(*WHOLE_PART)
    return at_start + change * factor <= path.angle_error


def turned(direction: Point, half_turn: Fraction) -> Point:
    """Return a unit vector, turned by the angle of a half turn."""
    c, s = direction
    unit = 1 + half_turn * half_turn
    cosine, sine = (1 - half_turn * half_turn) / unit, 2 * half_turn / unit
    return c * cosine - s * sine, c * sine + s * cosine


# ---- Bounds of angles and arc tangents.


def angle_of(direction: Point, bits: int) -> Bounds:
    """Return bounds of the angle of a unit vector."""
    c, s = direction
    quarters = 0
    while c <= 0 or abs(s) > c:
        c, s = s, -c
        quarters += 1
    low, high = arctan(s / (1 + c), bits)  # of half the angle
    p, q = pi_bounds(bits)
    return 2 * low + quarters * p / 2, 2 * high + quarters * q / 2


def pi_bounds(bits: int) -> Bounds:
    """Return bounds of pi, computed once in a check."""
    work = WORK.get()
    return work.pi_bounds(bits) if work else pi_by_machin(bits)


def pi_by_machin(bits: int) -> Bounds:
    """Return bounds of pi, by Machin's formula."""
    a, b = series(Fraction(1, 5), bits + 6)
    c, d = series(Fraction(1, 239), bits + 6)
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
    unit = 2**n
    power = floor(x * unit)
    square = (power * power) >> n
    total, terms = 0, 0
    while power:
        term = power // (2 * terms + 1)
        total += term if terms % 2 == 0 else -term
        power = (power * square) >> n
        terms += 1
    off = 3 * terms + 4
    return Fraction(total - off, unit), Fraction(total + off, unit)


# ---- Beside the bodies: those that ignore each other, and what the numbers mean to people.

UNITS_OF_DATES = ("ns", "us", "ms", "s", "min", "h", "day")
MAX_UNIT = 32  # characters
CONTROLS = re.compile("[\0-\x1f\x7f-\x9f\u2028\u2029]")  # and line breaks
CLOCK = r"([01]\d|2[0-3]):[0-5]\d"
DATE = r"(?P<year>\d{4})-(?P<month>\d\d)-(?P<day>\d\d)"
EPOCH = re.compile(rf"{DATE}[Tt ]{CLOCK}:[0-5]\d(\.\d{{1,30}})?([Zz]|[+-]{CLOCK})", re.ASCII)


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
        spend(100 * len(matching))  # a short pattern may stand for many bodies
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
    if match is None:
        raise NoProofError(f"the scene: epoch: not a date and time with a zone: {data!r:.60}")
    year, month, day = int(match["year"]), int(match["month"]), int(match["day"])
    need(year >= 1, "epoch: no such year:", data)
    need(1 <= month <= 12, "epoch: no such month:", data)
    _, days = monthrange(year, month)
    need(1 <= day <= days, "epoch: no such day:", data)
    is_of_dates = units.get("time") in UNITS_OF_DATES
    need(is_of_dates, "epoch: it needs units with a time in", UNITS_OF_DATES)


# ---- The whole scene.


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
        self.places_at = self.start  # the time at which places are known
        self.known_places = dict[int, Point]()

    def read(self, data: Json, *, are_records_verified: bool) -> None:
        """Read all of it."""
        top = keys(data, ["exactpt", "time", "bodies"], ["ignoring", "units", "epoch"])
        version = top["exactpt"]
        need(version == "1" and isinstance(version, Bare), "not of format 1:", version)
        self.start, self.end = point(top["time"])
        need(self.start < self.end, "an empty time span:", top["time"])
        self.bodies = list[Body]()
        self.body_of = list[int]()  # of each vertex
        for i, entry in enumerate(entries(top["bodies"])):
            first = len(self.body_of)
            body = Body(entry, first, self.start, are_records_verified=are_records_verified)
            self.bodies.append(body)
            self.body_of += [i] * body.size
        # A true body may differ from the one that is read here, the modelled one.
        self.is_modelled = any(body.is_modelled for body in self.bodies)
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

    def do_count(self, i: int, j: int) -> bool:
        """Return True if two bodies count as a pair: no group has both."""
        spend(20 + len(self.groups_of[i]))
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
        if self.places_at != t:
            self.places_at = t
            self.known_places = {}
        if v not in self.known_places:
            x, y, w = self.place(v, t)
            spend(200 * most_words((x, y, w)) ** 2)  # uses of it, too
            self.known_places[v] = Fraction(x, w), Fraction(y, w)
        return self.known_places[v]

    def breaks_in(self, vertices: Iterable[int], low: Fraction, high: Fraction) -> set[Fraction]:
        """Return the times in (low, high] at which formulas of some vertices change."""
        found = set[Fraction]()
        for v in vertices:
            breaks = self.of(v).breaks
            if breaks:
                found.update(breaks[bisect_right(breaks, low) : bisect_right(breaks, high)])
        return found

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
        corners = corners_of(body)
        pieces = [t for t in (self.start, *body.breaks) if self.start <= t < end]
        for t in pieces:
            if body.keeps_lengths(t):
                continue
            for corner in corners:
                a, v, b = (self.track(u, t) for u in corner)
                if not is_constant(a, v, b, t):
                    return False
        return True


def corners_of(body: Body) -> list[tuple[int, int, int]]:
    """Return each vertex between its neighbours; of a segment, an end with the other one, twice."""
    path = body.vertices
    n = len(path)
    if body.closed:
        return [(path[k - 1], path[k], path[(k + 1) % n]) for k in range(n)]
    if n > 2:
        return [(path[k - 1], path[k], path[k + 1]) for k in range(1, n - 1)]
    return [(v, path[0], v) for v in path[1:]]


def is_constant(a: Track, v: Track, b: Track, t: Fraction) -> bool:
    """Return True if lengths, dot and cross product of a - v and b - v are as at a time."""
    of_a, of_b = a[2] * v[2], b[2] * v[2]  # the denominators of a - v and b - v
    quotients = [
        (dot_of(a, v, a), of_a * of_a),
        (dot_of(b, v, b), of_b * of_b),
        (dot_of(a, v, b), of_a * of_b),
        (orientation_of(a, v, b), of_a * b[2]),
    ]
    return all(f * Poly([g.value(t)]) == g * Poly([f.value(t)]) for f, g in quotients)


# ---- Proofs and certificates, as files of lines.

APART = 2048  # between times are multiples of the span / 2^APART
MAX_BYTES = 10**9
MAX_LINE_BYTES = 10**8
R = r"-?[0-9]++(/[0-9]++)?"  # a rational
V = "[0-9]{1,9}"  # a vertex or body


def is_rational(word: str) -> bool:
    """Return True if a word is a rational of at most `MAX_DIGITS` digits above and below."""
    over, _, under = word.removeprefix("-").partition("/")
    if max(len(over), len(under)) > MAX_DIGITS or not re.fullmatch(R, word):
        return False
    return "/" not in word or bool(under.strip("0"))


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
    rows: list[tuple[int, list[str]]] = []
    for i, line in enumerate(proof.split(b"\n"), 1):
        if len(line) > MAX_LINE_BYTES:
            raise NoProofError(f"line {i} is too long")
        row = re.findall(r"[^ \t\r]+", line.decode())
        if not row or line.startswith(b"#"):
            continue
        form = file_format.forms.get(row[0], file_format.forms["none"])
        if not form.fullmatch(" ".join(row)) or not file_format.is_bounded(row):
            raise NoProofError(f"line {i} is not in the format")
        rows.append((i, row))
    kinds = " ".join(row[0] for _, row in rows)
    if not re.fullmatch(file_format.order, kinds):
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
