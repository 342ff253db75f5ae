"""Checks a proof that a scene has its first contact at a time T, or none.

    python -m exactpt.proof_check SCENE PROOF

This file imports nothing of exactpt, nothing but the standard library, uses no floats to
decide anything, and is made to be read. The statement, the file format and the complete
argument are in docs/proofs.md; the comments here say which step of it is where.

What is checked, in a paragraph. The proof describes a planar map on the vertices of the
scene, and its changes at certain times. In each open interval between two of these, every
angle of a face stays convex, reflex or straight: orientations of three vertices do not
vanish, and these are polynomials in time. Faces have three convex angles, vertices are gone
around once, and Euler's formula holds: then, by counting angles, the map is drawn without
crossings, and no two bodies touch. At the times themselves, a touch can only be found among
faces with an angle that vanishes just then.

Exit code: 0 accepted, 1 rejected (with the first line that fails), 2 no proof of this scene.
"""

from __future__ import annotations

import hashlib
import json
import re
import sys
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import pairwise, takewhile
from math import ceil, comb, floor, gcd, lcm
from typing import TypeVar

Poly = tuple[int, ...]
Point = tuple[int, int, int]
Track = tuple[Poly, Poly, Poly]
Dart = tuple[int, int]
Items = tuple[list[Dart], list[tuple[int, ...]], list[Dart]]
N = TypeVar("N", int, Fraction)
RPoly = tuple[Fraction, ...]
FACES = ("face", "inside", "outer")


class NoProofError(Exception):
    """The files are no scene, no proof, or a proof of another scene."""


class Rejected(Exception):  # noqa: N818 - a verdict
    """A line of the proof does not hold."""


def require(condition: object, why: str) -> None:
    """Reject unless the condition holds."""
    if not condition:
        raise Rejected(why)


# ---------------------------------------------------------------------------------------
# Polynomials in t: tuples of numbers, constant term first, no zero at the end; () is 0.
# (Rationals while a scene is read, integers from then on.)


def trimmed(f: Sequence[N]) -> tuple[N, ...]:
    """Without zeros at the end."""
    n = len(f)
    while n and not f[n - 1]:
        n -= 1
    return tuple(f[:n])


def add(f: tuple[N, ...], g: tuple[N, ...]) -> tuple[N, ...]:
    """The sum."""
    if len(f) < len(g):
        f, g = g, f
    return trimmed([a + b for a, b in zip(f, g, strict=False)] + list(f[len(g) :]))


def scale(f: tuple[N, ...], c: N) -> tuple[N, ...]:
    """The product with a number."""
    return tuple([c * a for a in f]) if c else ()


def sub(f: tuple[N, ...], g: tuple[N, ...]) -> tuple[N, ...]:
    """The difference."""
    return add(f, tuple([-c for c in g]))


def mul(f: tuple[N, ...], g: tuple[N, ...]) -> tuple[N, ...]:
    """The product."""
    if not f or not g:
        return ()
    if len(f) == 1:
        return scale(g, f[0])
    if len(g) == 1:
        return scale(f, g[0])
    product = [0 * f[0]] * (len(f) + len(g) - 1)
    for i, a in enumerate(f):
        for j, b in enumerate(g):
            product[i + j] += a * b
    return trimmed(product)


def sign(x: int | Fraction) -> int:
    """-1, 0 or 1."""
    return (x > 0) - (x < 0)


def value_at(f: Poly, n: int, d: int, degree: int) -> int:
    """d^degree f(n / d), for a degree at least that of f."""
    total, power = 0, 1
    for c in reversed(f):
        total = total * n + c * power
        power *= d
    return total * int(d ** (degree - len(f) + 1))


def sign_at(f: Poly, q: Fraction) -> int:
    """The sign of f(q)."""
    return sign(value_at(f, q.numerator, q.denominator, len(f) - 1)) if f else 0


def derivative(f: Poly) -> Poly:
    """The derivative."""
    return tuple([i * c for i, c in enumerate(f)][1:])


def primitive(f: Poly) -> Poly:
    """F divided by what its coefficients have in common, with a positive leading one."""
    if not f:
        return f
    content = gcd(*f) * sign(f[-1])
    return tuple([c // content for c in f])


def divided(f: Poly, g: Poly) -> tuple[Poly, Poly]:
    """(q, r) with c f = q g + r for a number c that is not 0, and deg r < deg g."""
    rest, quotient = list(f), [0] * max(0, len(f) - len(g) + 1)
    for i in range(len(f) - len(g), -1, -1):
        top = rest.pop()
        rest, quotient = [g[-1] * c for c in rest], [g[-1] * c for c in quotient]
        quotient[i] = top
        for j, c in enumerate(g[:-1]):
            rest[i + j] -= top * c
    return trimmed(quotient), trimmed(rest)


def common_divisor(f: Poly, g: Poly) -> Poly:
    """The greatest common divisor, by Euclid."""
    while g:
        f, g = g, primitive(divided(f, g)[1])
    return primitive(f)


def square_free(f: Poly) -> Poly:
    """The polynomial with the same roots, all of them simple."""
    if len(f) < 3:
        return primitive(f)
    return primitive(divided(f, common_divisor(f, derivative(f)))[0])


def on_unit(f: Poly, low: Fraction, high: Fraction) -> tuple[list[int], int]:
    """g with g(s) = d^n f(low + (high - low) s), n the degree of f; and d^n."""
    d = lcm(low.denominator, high.denominator)
    start, width = int(low * d), int((high - low) * d)
    g, power = [f[-1]], 1
    for c in reversed(f[:-1]):
        power *= d
        g = [start * a + width * b for a, b in zip([*g, 0], [0, *g], strict=True)]
        g[0] += c * power
    return g, power


def variations(f: Poly, low: Fraction, high: Fraction) -> int:
    """At least the number of roots of f strictly between low and high; it if 0 or 1.

    Descartes' rule of signs for (1 + x)^n f((high + low x) / (1 + x)), x > 0. (These
    coefficients are those of f in the Bernstein basis, times binomials.)
    """
    g, _ = on_unit(f, low, high)
    g.reverse()
    n = len(g)
    for i in range(n - 1):
        for j in range(n - 2, i - 1, -1):
            g[j] += g[j + 1]
    signs = [c > 0 for c in g if c]
    return sum(a != b for a, b in pairwise(signs))


def bounds(f: Poly, low: Fraction, high: Fraction) -> tuple[Fraction, Fraction]:
    """An interval that contains f on [low, high]: the range of the Bernstein coefficients."""
    if not f:
        return Fraction(0), Fraction(0)
    g, power = on_unit(f, low, high)
    n = len(g) - 1
    b = [
        sum(Fraction(comb(j, i) * g[i], comb(n, i) * power) for i in range(j + 1))
        for j in range(n + 1)
    ]
    return Fraction(min(b)), Fraction(max(b))


def roots_in(f: Poly, low: Fraction, high: Fraction) -> Iterator[Time]:
    """The roots in [low, high] of a polynomial that has none but simple ones, in order."""
    if sign_at(f, low) == 0:
        yield Time(low)
    if low == high:
        return
    yield from _roots_inside(f, low, high)
    if sign_at(f, high) == 0:
        yield Time(high)


def _roots_inside(f: Poly, low: Fraction, high: Fraction) -> Iterator[Time]:
    count = variations(f, low, high)
    if count == 1 and sign_at(f, low) and sign_at(f, high):
        yield Time(low, high, f)
    elif count:
        middle = (low + high) / 2
        yield from _roots_inside(f, low, middle)
        if sign_at(f, middle) == 0:
            yield Time(middle)
        yield from _roots_inside(f, middle, high)


# ---------------------------------------------------------------------------------------
# Times: rationals, or roots of polynomials.


class Time:
    """A number: low = high; or the only root of f between low and high, where f is not 0.

    f has simple roots alone; so its signs at low and high differ.
    """

    def __init__(self, low: Fraction, high: Fraction | None = None, f: Poly = ()) -> None:
        self.low = low
        self.high = low if high is None else high
        self.f = f

    @property
    def is_rational(self) -> bool:
        """Whether it is known to be."""
        return self.low == self.high

    def refine(self) -> None:
        """Halve the interval."""
        self.compare_rational((self.low + self.high) / 2)

    def compare_rational(self, q: Fraction) -> int:
        """-1, 0 or 1 as the time is before, at or after q."""
        if self.high < q or self.low > q or self.low == self.high:
            return sign(self.low - q)
        s = sign_at(self.f, q)
        if s == 0:
            self.low = self.high = q
        elif s == sign_at(self.f, self.low):
            self.low = q
            return 1
        else:
            self.high = q
            return -1
        return 0

    def compare(self, other: Time) -> int:
        """-1, 0 or 1 as the time is before, at or after the other."""
        differ = False
        while not (self.is_rational or other.is_rational):
            low, high = max(self.low, other.low), min(self.high, other.high)
            if low >= high:
                return sign(self.low - other.low)
            if not differ:
                # f and g have one root each in their intervals; the greatest common
                # divisor has a root between low and high if and only if it is the same.
                # It is not 0 at low or high, for one of f and g is not.
                common = self.f if self.f == other.f else common_divisor(self.f, other.f)
                if sign_at(common, low) * sign_at(common, high) < 0:
                    return 0
                differ = True
            self.refine()
            other.refine()
        if other.is_rational:
            return self.compare_rational(other.low)
        return -other.compare_rational(self.low)

    def sign_of(self, f: Poly) -> int:
        """The sign of f at this time."""
        differ = False
        while not self.is_rational and f:
            s = sign_at(f, self.low)
            if s and s == sign_at(f, self.high) and variations(f, self.low, self.high) == 0:
                return s
            if not differ:
                common = common_divisor(self.f, f)
                if sign_at(common, self.low) * sign_at(common, self.high) < 0:
                    return 0
                differ = True
            self.refine()
        return sign_at(f, self.low)

    def __str__(self) -> str:
        if self.is_rational:
            return str(self.low)
        return f"{float(self.low):.12g} (between {self.low} and {self.high})"


def between(a: Time, b: Time) -> Fraction:
    """A rational number between two different times: one with few digits."""
    while a.high >= b.low:
        a.refine()
        b.refine()
    power = 1
    while floor(a.high * power) + 1 >= b.low * power:
        power *= 2
    return Fraction(floor(a.high * power) + 1, power)


def zeros(f: Poly, start: Time, end: Time) -> tuple[bool, bool]:
    """Whether f vanishes strictly between two times; whether at the second one."""
    low, high = start.low, end.high
    if variations(f, low, high) == 0:
        return False, end.is_rational and sign_at(f, high) == 0
    for root in roots_in(square_free(f), low, high):
        if root.compare(start) > 0:
            order = root.compare(end)
            return order < 0, order == 0
    return False, False


# ---------------------------------------------------------------------------------------
# Points and tracks in homogeneous coordinates (x, y, w), w > 0: integers at a rational time,
# integer polynomials for all times of a piece of motion. One formula serves both.


def orientation(a: Point, b: Point, c: Point) -> int:
    """Positive if a, b, c turn left; 0 if they are on one line."""
    return (
        a[0] * (b[1] * c[2] - c[1] * b[2])
        + b[0] * (c[1] * a[2] - a[1] * c[2])
        + c[0] * (a[1] * b[2] - b[1] * a[2])
    )


def vector(a: Point, b: Point) -> tuple[int, int]:
    """A positive multiple of b - a."""
    return b[0] * a[2] - a[0] * b[2], b[1] * a[2] - a[1] * b[2]


def dot(a: Point, v: Point, b: Point) -> int:
    """A positive multiple of (a - v) . (b - v)."""
    (px, py), (qx, qy) = vector(v, a), vector(v, b)
    return px * qx + py * qy


def orientation_of(a: Track, b: Track, c: Track) -> Poly:
    """As `orientation`, of tracks."""
    f = mul(a[0], sub(mul(b[1], c[2]), mul(c[1], b[2])))
    g = mul(b[0], sub(mul(c[1], a[2]), mul(a[1], c[2])))
    h = mul(c[0], sub(mul(a[1], b[2]), mul(b[1], a[2])))
    return add(add(f, g), h)


def vector_of(a: Track, b: Track) -> tuple[Poly, Poly]:
    """As `vector`, of tracks."""
    return sub(mul(b[0], a[2]), mul(a[0], b[2])), sub(mul(b[1], a[2]), mul(a[1], b[2]))


def dot_of(a: Track, v: Track, b: Track) -> Poly:
    """As `dot`, of tracks."""
    (px, py), (qx, qy) = vector_of(v, a), vector_of(v, b)
    return add(mul(px, qx), mul(py, qy))


def angle_half(d: tuple[int, int]) -> int:
    """0 for directions in [0, pi), 1 for those in [pi, 2 pi)."""
    return 0 if d[1] > 0 or (d[1] == 0 and d[0] > 0) else 1


def comes_before(d: tuple[int, int], e: tuple[int, int]) -> bool:
    """Whether d has a smaller angle than e, both in [0, 2 pi)."""
    if angle_half(d) != angle_half(e):
        return angle_half(d) < angle_half(e)
    return d[0] * e[1] - d[1] * e[0] > 0


# ---------------------------------------------------------------------------------------
# The scene (docs/format.md). What is not understood is refused.

NUMBER = re.compile(r"[+-]?(\d+(/\d+)?|(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,6})?)", re.ASCII)
Shape = list[tuple[RPoly, RPoly]]


def number(data: object) -> Fraction:
    """The rational that a text, or a number of JSON, denotes."""
    if not isinstance(data, str) or not NUMBER.fullmatch(data):
        raise NoProofError(f"the scene has no number where one is needed: {data!r}")
    try:
        return Fraction(data)
    except ZeroDivisionError:
        raise NoProofError(f"the scene has a denominator 0: {data}") from None


def keys(data: object, *allowed: str) -> dict[str, object]:
    """A JSON object with these keys at most."""
    if not isinstance(data, dict) or not set(data) <= set(allowed):
        raise NoProofError(f"the scene: not an object with keys {', '.join(allowed)}: {data!r:.99}")
    return data


def entries(data: object, length: int | None = None) -> list[object]:
    """A JSON list."""
    if not isinstance(data, list) or (length is not None and len(data) != length):
        raise NoProofError(f"the scene: not a list as needed: {data!r:.99}")
    return data


def polynomial(data: object = ()) -> RPoly:
    """The polynomial that a list of numbers is; none stands for 0."""
    return trimmed([number(c) for c in entries(data)] if data != () else [])  # type: ignore[no-any-return]


def pair(data: object) -> tuple[Fraction, Fraction]:
    """Two numbers."""
    x, y = entries(data, 2)
    return number(x), number(y)


class Body:
    """A body: the tracks of its vertices, in each piece of its motion.

    Attributes:
        breaks: the times at which the formulas change; piece k ends at breaks[k].
        first: the number of its first vertex in the scene.
        size: how many vertices it has.
        closed: whether it is a polygon with its inside.
    """

    def __init__(self, data: object, first: int) -> None:
        body = keys(data, "name", "vertices", "motion", "closed", "keyframes")
        if ("vertices" in body) == ("keyframes" in body) or not isinstance(body.get("name"), str):
            raise NoProofError(f"the scene: a body needs a name, and vertices or keyframes: {data}")
        self.name, self.first = str(body["name"]), first
        self.shapes: list[tuple[Fraction | None, Shape]] = list(_shapes(body))
        self.motions = list(_motions(body.get("motion", {})))
        self.size = len(self.shapes[0][1])
        if body.get("closed", True) not in (True, False) or not self.size:
            raise NoProofError(f"the scene: body {self.name!r}: closed, or without vertices")
        self.closed = bool(body.get("closed", True)) and self.size > 2
        ends = {until for until, _ in [*self.shapes, *self.motions] if until is not None}
        self.breaks = sorted(ends)
        self._tracks: dict[tuple[int, int], Track] = {}

    def track(self, i: int, piece: int) -> Track:
        """The track of vertex i in a piece."""
        if (i, piece) not in self._tracks:
            last = self.breaks[piece] if piece < len(self.breaks) else None
            shape = _piece_up_to(self.shapes, last)
            self._tracks[i, piece] = moved(_piece_up_to(self.motions, last), shape[i])  # type: ignore[index,arg-type]
        return self._tracks[i, piece]

    def edges(self) -> list[Dart]:
        """The edges, as numbers of vertices in the scene."""
        path = list(range(self.first, self.first + self.size))
        return [*pairwise(path), *([(path[-1], path[0])] if self.closed else [])]


def _shapes(body: dict[str, object]) -> Iterator[tuple[Fraction | None, Shape]]:
    if "vertices" in body:
        yield None, [_rest(v) for v in entries(body["vertices"])]
        return
    frames = [keys(f, "t", "vertices") for f in entries(body["keyframes"])]
    times = [number(f.get("t")) for f in frames]
    shapes = [[pair(v) for v in entries(f.get("vertices"))] for f in frames]
    increasing = all(s < t for s, t in pairwise(times))
    if not frames or not increasing or len(set(map(len, shapes))) > 1:
        raise NoProofError("the scene: keyframes at increasing times, of one number of vertices")
    yield times[0], [((x,), (y,)) for x, y in shapes[0]]
    for k in range(len(frames) - 1):
        s, span = times[k], times[k + 1] - times[k]
        lines: Shape = []
        for p, q in zip(shapes[k], shapes[k + 1], strict=True):
            slopes = [(b - a) / span for a, b in zip(p, q, strict=True)]
            x, y = ((a - m * s, m) for a, m in zip(p, slopes, strict=True))
            lines.append((trimmed(x), trimmed(y)))
        yield times[k + 1], lines
    yield None, [((x,), (y,)) for x, y in shapes[-1]]


def _rest(data: object) -> tuple[RPoly, RPoly]:
    if isinstance(data, dict):
        vertex = keys(data, "x", "y")
        return polynomial(vertex.get("x", ())), polynomial(vertex.get("y", ()))
    x, y = pair(data)
    return trimmed((x,)), trimmed((y,))


def _motions(data: object) -> Iterator[tuple[Fraction | None, dict[str, object]]]:
    if not isinstance(data, dict) or "pieces" not in data:
        yield None, keys(data, "x", "y", "rigid", "affine")
        return
    pieces = [keys(p, "until", "motion") for p in entries(keys(data, "pieces")["pieces"])]
    ends = [number(p["until"]) for p in pieces[:-1] if "until" in p]
    increasing = all(s < t for s, t in pairwise(ends))
    if len(ends) != len(pieces) - 1 or "until" in pieces[-1] or not increasing:
        raise NoProofError('the scene: "until" belongs to all pieces but the last, and increases')
    for end, piece in zip([*ends, None], pieces, strict=True):
        yield end, keys(piece.get("motion"), "x", "y", "rigid", "affine")


def _piece_up_to(pieces: Sequence[tuple[Fraction | None, object]], last: Fraction | None) -> object:
    """Of pieces (until, what): the one that holds just before a time; None: at the end."""
    return next(p for end, p in pieces if end is None or (last is not None and end >= last))


def moved(motion: dict[str, object], vertex: tuple[RPoly, RPoly]) -> Track:
    """The track of a vertex, carried by a motion of the scene file."""
    one: RPoly = (Fraction(1),)
    w, data = one, motion
    x, y = vertex
    if "rigid" in motion:
        # A turn by the angle a with tan(a / 2) = h: (1 - h^2, 2 h) / (1 + h^2) is (cos, sin).
        data = keys(keys(motion, "rigid")["rigid"], "half_turn", "pivot", "x", "y")
        h = polynomial(data.get("half_turn"))
        px, py = pair(data["pivot"]) if "pivot" in data else (Fraction(0), Fraction(0))
        w, cosine, sine = add(one, mul(h, h)), sub(one, mul(h, h)), add(h, h)
        dx, dy = sub(x, (px,)), sub(y, (py,))
        x = add(sub(mul(cosine, dx), mul(sine, dy)), scale(w, px))
        y = add(add(mul(sine, dx), mul(cosine, dy)), scale(w, py))
    elif "affine" in motion:
        data = keys(keys(motion, "affine")["affine"], "matrix", "x", "y")
        rows = [entries(row, 2) for row in entries(data.get("matrix"), 2)]
        (a, b), (c, d) = ([polynomial(p) for p in row] for row in rows)
        x, y = add(mul(a, x), mul(b, y)), add(mul(c, x), mul(d, y))
    x = add(x, mul(w, polynomial(data.get("x", ()))))
    y = add(y, mul(w, polynomial(data.get("y", ()))))
    m = lcm(*(c.denominator for f in (x, y, w) for c in f))
    of_x, of_y, of_w = (tuple([int(c * m) for c in f]) for f in (x, y, w))
    m = gcd(*of_x, *of_y, *of_w)
    return (
        tuple([c // m for c in of_x]),
        tuple([c // m for c in of_y]),
        tuple([c // m for c in of_w]),
    )


class Scene:
    """All bodies; their vertices are numbered through."""

    def __init__(self, text: str) -> None:
        def unique(pairs: list[tuple[str, object]]) -> dict[str, object]:
            if len({k for k, _ in pairs}) < len(pairs):
                raise NoProofError("the scene: a key is there twice")
            return dict(pairs)

        try:
            data = json.loads(text, parse_int=str, parse_float=str, object_pairs_hook=unique)
        except (ValueError, RecursionError) as error:
            raise NoProofError(f"the scene is not JSON: {error}") from None
        top = keys(data, "exactpt", "time", "bodies")
        if top.get("exactpt") != "1":
            raise NoProofError("the scene is not of format 1")
        self.start, self.end = pair(top.get("time"))
        self.bodies: list[Body] = []
        self.body_of: list[int] = []
        for i, entry in enumerate(entries(top.get("bodies"))):
            self.bodies.append(Body(entry, len(self.body_of)))
            self.body_of += [i] * self.bodies[-1].size
        if self.start >= self.end or len({b.name for b in self.bodies}) < len(self.bodies):
            raise NoProofError("the scene: an empty time span, or a name that is there twice")
        self._at: tuple[Fraction, dict[int, Point]] = self.start, {}

    def of(self, v: int) -> Body:
        """The body of a vertex."""
        return self.bodies[self.body_of[v]]

    def name(self, v: int) -> str:
        """The name of a vertex."""
        return f"{self.of(v).name} vertex {v - self.of(v).first}"

    def track(self, v: int, after: Fraction) -> Track:
        """The track of a vertex just after a rational time."""
        body = self.of(v)
        return body.track(v - body.first, bisect_right(body.breaks, after))

    def at(self, v: int, t: Fraction) -> Point:
        """Where a vertex is at a rational time."""
        if self._at[0] != t:
            self._at = t, {}
        known = self._at[1]
        if v not in known:
            x, y, w = self.track(v, t)
            n, d, degree = t.numerator, t.denominator, max(len(x), len(y), len(w)) - 1
            known[v] = tuple(value_at(f, n, d, degree) for f in (x, y, w))  # type: ignore[assignment]
        return known[v]

    def place(self, v: int, t: Fraction) -> tuple[Fraction, Fraction]:
        """Where a vertex is at a rational time, as two coordinates."""
        x, y, w = self.at(v, t)
        return Fraction(x, w), Fraction(y, w)

    def breaks(self, vertices: Iterable[int], start: Time, end: Time) -> list[Fraction]:
        """The breakpoints of some vertices strictly between two times."""
        found = {q for i in {self.body_of[v] for v in vertices} for q in self.bodies[i].breaks}
        if not found:
            return []
        inside = (q for q in found if start.compare_rational(q) < 0 < end.compare_rational(q))
        return sorted(inside)

    def pieces(
        self, vertices: Sequence[int], start: Time, end: Time
    ) -> Iterator[tuple[Time, Time, list[Track]]]:
        """The time between start and end, cut at breakpoints: from, to, and the tracks then."""
        breaks = [Time(q) for q in self.breaks(vertices, start, end)]
        for a, b in pairwise([start, *breaks, end]):
            # No breakpoint is after a.low and before a: `breaks` has compared them.
            yield a, b, [self.track(v, a.low) for v in vertices]

    def tracks_at(self, vertices: Sequence[int], time: Time) -> list[Track]:
        """Tracks of some vertices that hold at a time."""
        while any(time.low < q < time.high for v in vertices for q in self.of(v).breaks):
            time.refine()
        return [self.track(v, time.low) for v in vertices]

    def is_rigid(self, body: Body, end: Fraction) -> bool:
        """Whether lengths, dot and cross products of successive edges are constant.

        Then the shape is, up to a motion of the plane: it never changes, nor is it mirrored.
        """
        n = body.size
        pieces = [self.start, *(q for q in body.breaks if self.start < q < end)]
        return all(self._keeps_shape(body, k % n, t) for t in pieces for k in range(n))

    def _keeps_shape(self, body: Body, k: int, t: Fraction) -> bool:
        vertices = [body.first + (k + i) % body.size for i in range(3)]
        if not body.closed and k + 2 >= body.size:
            vertices = vertices[: max(0, body.size - k)]
        if len(vertices) < 2:
            return True
        tracks = [self.track(v, t) for v in vertices]
        a, v, b = tracks[0], tracks[1], tracks[-1]
        w = mul(mul(a[2], b[2]), mul(v[2], v[2]))
        square = mul(a[2], v[2])
        forms = [(dot_of(a, v, a), mul(square, square))]
        if len(tracks) == 3:
            # `orientation` has the denominator w(a) w(v) w(b).
            forms += [(dot_of(a, v, b), w), (orientation_of(a, v, b), mul(mul(a[2], v[2]), b[2]))]
        for f, g in forms:
            n, d = t.numerator, t.denominator
            degree = max(len(f), len(g), 1) - 1
            if sub(scale(f, value_at(g, n, d, degree)), scale(g, value_at(f, n, d, degree))):
                return False
        return True


# ---------------------------------------------------------------------------------------
# Planar maps: half-edges (u, v), and which one follows which around the face on the left.


class PlanarMap:
    """Half-edges with their order around faces, and so around vertices. No coordinates.

    Attributes:
        after, before: of each half-edge, the next and the previous one around its face.
        out: of each vertex, the vertices to which it has an edge.
        faces: the half-edges of each face, by a number; face_of: of each half-edge, its face.
    """

    def __init__(self, vertices: int) -> None:
        self.after: dict[Dart, Dart] = {}
        self.before: dict[Dart, Dart] = {}
        self.out: list[set[int]] = [set() for _ in range(vertices)]
        self.faces: dict[int, list[Dart]] = {}
        self.face_of: dict[Dart, int] = {}
        self._faces_made = 0

    def add_face(self, face: list[Dart]) -> int:
        """Add a face; its number."""
        self._faces_made += 1
        self.faces[self._faces_made] = face
        for d in face:
            self.face_of[d] = self._faces_made
        return self._faces_made

    def begin(self, cycles: Iterable[list[int]]) -> None:
        """Make the map of these faces; all of step 2 but for bodies."""
        for cycle in cycles:
            face = list(pairwise([*cycle, cycle[0]])) if len(cycle) > 1 else []
            for d, e in pairwise([*face, *face[:1]]):
                require(d not in self.after, f"the half-edge {d} is in two faces, or twice in one")
                require(d[0] != d[1], f"an edge from {d[0]} to itself")
                self.after[d], self.before[e] = e, d
                self.out[d[0]].add(d[1])
            self.add_face(face)
        for u, v in self.after:
            require((v, u) in self.after, f"the edge {u} {v} has a face on one side alone")
        for v, around in enumerate(self.out):
            require(not around or len(self.clockwise(v)) == len(around), f"two fans at vertex {v}")
        self.check_euler()
        reached, todo = {0}, [0]
        while todo:
            new = self.out[todo.pop()] - reached
            reached |= new
            todo += new
        require(len(reached) == len(self.out), "the map is not connected")

    def check_euler(self) -> None:
        """V - E + F = 2."""
        v, e, f = len(self.out), len(self.after) // 2, len(self.faces)
        require(v - e + f == 2, f"{v} vertices, {e} edges, {f} faces: V - E + F is not 2")

    def clockwise(self, v: int) -> list[int]:
        """The vertices to which v has an edge, in order, clockwise."""
        order: list[int] = []
        u = next(iter(self.out[v]), -1)
        while u >= 0 and (not order or u != order[0]):
            order.append(u)
            u = self.after[u, v][1]
        return order

    def change(
        self, removed: list[Dart], added: list[tuple[int, ...]]
    ) -> tuple[set[Dart], list[Dart]]:
        """Change the map, all but its faces.

        Returns:
            The half-edges that have gone, and those with another one before or after them;
            and of the latter, those with another one before.
        """
        fans = {v: self.clockwise(v) for d in [*removed, *(i[:2] for i in added)] for v in d}
        touched: set[Dart] = set()
        for u, v in removed:
            require((u, v) in self.after, f"there is no edge {u} {v} that could go")
            for d in ((u, v), (v, u)):
                fans[d[0]].remove(d[1])
                self.out[d[0]].remove(d[1])
                del self.after[d], self.before[d]
                touched.add(d)
        waiting: dict[int, list[Dart]] = {}
        for u, v, w, x in added:
            require(u != v and v not in self.out[u], f"the edge {u} {v} is there, or no edge")
            self.out[u].add(v)
            self.out[v].add(u)
            waiting.setdefault(v, []).append((u, w))
            waiting.setdefault(u, []).append((v, x))
        for v, new in waiting.items():
            self._insert(fans[v], new)
        changed: list[Dart] = []
        for v, fan in fans.items():
            for u, w in pairwise([*fan, *fan[:1]]):
                if self.after.get((u, v)) != (v, w) or self.before.get((v, w)) != (u, v):
                    self.after[u, v], self.before[v, w] = (v, w), (u, v)
                    touched |= {(u, v), (v, w)}
                    changed.append((v, w))
        for u, v, w, x in added:
            placed = self.after[u, v] == (v, w) and self.after[v, u] == (u, x)
            require(placed, f"the edge {u} {v} cannot stand where its item says")
        for u, v in removed:
            require(self._joined(u, v), f"without the edge {u} {v} the map is not connected")
        return touched, changed

    @staticmethod
    def _insert(fan: list[int], new: list[Dart]) -> None:
        """Put each new one directly before the one that it names, which may be new itself."""
        if not fan:
            fan.append(new.pop()[0])
        while new:
            ready = [(u, w) for u, w in new if w in fan]
            require(ready, f"new edges to {[u for u, _ in new]} name no place around their vertex")
            for u, w in ready:
                fan.insert(fan.index(w), u)
                new.remove((u, w))

    def _joined(self, u: int, v: int) -> bool:
        """Whether a path joins two vertices; searched for from both ends in turn."""
        seen, fronts = [{u}, {v}], [[u], [v]]
        while fronts[0] and fronts[1]:
            if not seen[0].isdisjoint(seen[1]):
                return True
            for known, front in zip(seen, fronts, strict=True):
                new = {y for x in front for y in self.out[x]} - known
                known.update(new)
                front[:] = new
        return not seen[0].isdisjoint(seen[1])

    def make_faces(self, touched: set[Dart]) -> list[int]:
        """Make the faces around half-edges that have changed anew."""
        old = {self.face_of[d] for d in touched if d in self.face_of}
        pool = {d for f in old for d in self.faces.pop(f)} | touched
        for d in pool - self.after.keys():
            self.face_of.pop(d, None)
        pool &= self.after.keys()
        made = []
        while pool:
            first = d = min(pool)
            face: list[Dart] = []
            while not face or d != first:
                face.append(d)
                d = self.after[d]
            pool -= set(face)
            made.append(self.add_face(face))
        return made


# ---------------------------------------------------------------------------------------
# The checker. Steps are those of docs/proofs.md.

CONVEX, REFLEX, FLAT, FULL = "convex", "reflex", "flat", "full"


class Life:
    """The life of the angle of a half-edge v -> w, with u -> v before it.

    Attributes:
        u: where the half-edge before it starts.
        since: when the life has begun; line: by which line.
        kind: one of four, from the sample on.
    """

    def __init__(self, u: int, since: Time, line: int) -> None:
        self.u, self.since, self.line, self.kind = u, since, line, ""


class Checker:
    """Goes through a proof, interval by interval."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self.end = scene, scene.end
        self.line = 0
        self.now = Time(scene.start)
        self.map = PlanarMap(len(scene.body_of))
        self.body_darts = {d for b in scene.bodies for u, v in b.edges() for d in ((u, v), (v, u))}
        self.ahead: dict[int, int] = {}
        self.behind: dict[int, int] = {}
        self.rigid: list[bool] = []
        self.solid: set[Dart] = set()
        self.life: dict[Dart, Life] = {}
        self.new_angles: set[Dart] = set()
        self.new_faces: set[int] = set()
        self.outer: set[int] = set()
        size = max(abs(x) for v in range(len(scene.body_of)) for x in scene.place(v, scene.start))
        bits = size.numerator.bit_length() - size.denominator.bit_length()
        self.grid = Fraction(2) ** (40 - bits)

    # The lines, and step 7: times increase.

    def check_rows(self, rows: list[tuple[int, list[str]]]) -> str:
        """Check the lines of a proof from the third on; what is proved."""
        self.line, words = rows[0]
        require(len(words) == 3 and words[0] == "span", "the time span is missing")
        start, self.end = rational(words[1]), rational(words[2])
        within = start == self.scene.start < self.end <= self.scene.end
        require(within, "the time span is not one of the scene")
        self.read_bodies()
        cycles: list[list[int]] = []
        for self.line, words in takewhile(lambda r: r[1][0] in FACES, rows[1:]):
            cycles.append([integer(w) for w in words[1:]])
            require(cycles[-1], "a face without vertices")
            self.check_numbers(cycles[-1])
        if not cycles:
            return self.check_start_alone(rows[1:])
        self.begin(cycles)
        for number, words in rows[1 + len(cycles) :]:
            made, self.line = self.line, number
            final = words[0] != "event"
            require(final == (number == rows[-1][0]), f"{words[0]} is not where it belongs")
            time, rest = (Time(self.end), []) if words == ["none"] else self.read_time(words[1:])
            require(self.now.compare(time) < 0, "times do not increase")
            self.line = made
            self.look_at(between(self.now, time))
            if self.now.compare_rational(start) == 0:
                self.check_start()
            self.line = number
            if not final:
                self.event(time, read_items(rest))
                continue
            require(time.compare_rational(self.end) <= 0, "the contact is after the time span")
            self.end_lives(set(self.life), time, at_end=words == ["none"])
            if words == ["none"]:
                return f"accepted: no contact from t = {start} to t = {self.end}"
            require(words[0] == "contact", f"a line of an unknown kind: {words[0]}")
            what = self.check_contact(rest, time)
            return f"accepted: no contact before T = {time}; contact of {what} at T"
        raise Rejected("the last line is missing")

    def check_start_alone(self, rows: list[tuple[int, list[str]]]) -> str:
        """Check a contact at the start, which needs no map."""
        self.line, words = rows[0]
        require(words[0] == "contact" and len(rows) == 1, "neither faces nor a contact")
        time, rest = self.read_time(words[1:])
        require(time.compare_rational(self.scene.start) == 0, "without faces, T is the start")
        what = self.check_contact(rest, time)
        return f"accepted: no contact before T = {time}, the start; contact of {what} at T"

    def read_time(self, words: list[str]) -> tuple[Time, list[str]]:
        """The time at the beginning of these words, and what is left of them."""
        require(len(words) >= 2, "a time is missing")
        low, high = rational(words[0]), rational(words[1])
        named = words[2:3] == ["@"]
        first = last = 3 if named else 2
        while last < len(words) and re.fullmatch(r"-?\d+", words[last], re.ASCII):
            last += 1
        numbers = [integer(w) for w in words[first:last]]
        if low == high:
            return Time(low), words[last:]
        require(low < high, f"no interval: from {low} to {high}")
        f = self.polynomial_of(numbers, low, high) if named else trimmed(numbers)
        require(f, "no time is named by what is 0 always")
        roots = list(roots_in(square_free(f), low, high))
        require(len(roots) == 1, f"{len(roots)} roots between {low} and {high}, not one")
        while not roots[0].is_rational and (roots[0].high - roots[0].low) * 2**20 > self.end:
            roots[0].refine()
        return roots[0], words[last:]

    def polynomial_of(self, v: list[int], low: Fraction, high: Fraction) -> Poly:
        """What vanishes at a time that is named by vertices."""
        scene = self.scene
        self.check_numbers(v)
        require(len(v) in (2, 3), "a time is named by two vertices, or three")
        breaks = scene.breaks(v, Time(low), Time(high))
        require(not breaks, f"a breakpoint, {breaks[:1]}, is between {low} and {high}")
        tracks = [scene.track(u, low) for u in v]
        return orientation_of(*tracks) if len(v) == 3 else vector_of(*tracks)[0]

    # Step 1: the scene.

    def read_bodies(self) -> None:
        """Look at each body by itself."""
        self.rigid = [self.scene.is_rigid(body, self.end) for body in self.scene.bodies]
        for body, rigid in zip(self.scene.bodies, self.rigid, strict=True):
            self.read_body(body, rigid=rigid)

    def read_body(self, body: Body, *, rigid: bool) -> None:
        """Look at a body by itself."""
        start, every = self.scene.start, range(body.first, body.first + body.size)
        for q in (q for q in body.breaks if start < q <= self.end):
            k = body.breaks.index(q)
            for i in range(body.size):
                # The track of the piece before, minus that of the piece after.
                difference = vector_of(body.track(i, k), body.track(i, k + 1))
                if any(sign_at(f, q) for f in difference):
                    raise NoProofError(f"the scene: {body.name} vertex {i} jumps at t = {q}")
        points = [self.scene.at(v, start) for v in every]
        if not body.closed:
            return
        places = [self.scene.place(v, start) for v in every]
        area = sum(p[0] * q[1] - p[1] * q[0] for p, q in pairwise([*places, places[0]]))
        require(area, f"body {body.name} has no area at the start")
        ring = body.edges() if area > 0 else [(v, u) for u, v in body.edges()]
        self.ahead.update(ring)
        self.behind.update((v, u) for u, v in ring)
        if rigid:
            self.solid.update(ring)
            require(is_simple(points), f"body {body.name} is not simple at the start")

    # Step 2: the map, and its changes.

    def begin(self, cycles: list[list[int]]) -> None:
        """Take the faces at the start."""
        solid = []
        for body, rigid in zip(self.scene.bodies, self.rigid, strict=True):
            if body.closed and rigid:
                ring = [body.first]
                while len(ring) < body.size:
                    ring.append(self.ahead[ring[-1]])
                solid.append(ring)
        self.map.begin([*cycles, *solid])
        for u, v in self.body_darts:
            require((u, v) in self.map.after, f"the body edge {u} {v} is missing")
        for v in self.ahead:
            self.check_inside(v)
        self.new_faces = set(self.map.faces)
        self.begin_lives(self.map.after)

    def check_inside(self, v: int) -> None:
        """See that edges from v into the inside of its body lead to that body."""
        order = self.map.clockwise(v)
        i, n = order.index(self.behind[v]), len(order)
        while order[i % n] != self.ahead[v]:
            other = order[i % n]
            same = self.scene.body_of[other] == self.scene.body_of[v]
            require(same, f"the edge {v} {other} runs inside a body to another one")
            i += 1

    def begin_lives(self, darts: Iterable[Dart]) -> None:
        """Let the lives of angles begin now."""
        for d in darts:
            if d not in self.solid:
                self.life[d] = Life(self.map.before[d][0], self.now, self.line)
                self.new_angles.add(d)

    def event(self, time: Time, items: Items) -> None:
        """Let all that happens at one time happen."""
        removed, added, renewed = items
        for u, v in [*removed, *(i[:2] for i in added)]:
            require((u, v) not in self.body_darts, f"the body edge {u} {v} cannot go or come")
        for d in renewed:
            require(d in self.life, f"there is no angle {d[0]} {d[1]} to be taken anew")
        touched, changed = self.map.change(removed, added)
        for d in touched & self.solid:
            require(self.map.after[d] in self.solid, f"an edge inside a rigid body, at {d[0]}")
        # Angles that end, with the faces of the map before: steps 3 and 6.
        gone = touched - self.map.after.keys()
        self.end_lives({*gone, *changed, *renewed} & self.life.keys(), time, at_end=True)
        self.now = time
        self.new_faces.update(self.map.make_faces(touched))
        renewed = [d for d in renewed if d in self.map.after]
        self.new_faces.update(self.map.face_of[d] for d in renewed)
        self.outer.intersection_update(self.map.faces)
        self.map.check_euler()
        for v in {d[0] for d in changed if d[0] in self.ahead}:
            self.check_inside(v)
        self.begin_lives([*changed, *renewed])

    # Steps 3, 4, 5: the interval after now.

    def look_at(self, sample: Fraction) -> None:
        """See what is new at a rational time inside the interval that begins now."""
        for v, w in self.new_angles:
            self.life[v, w].kind = self.kind_of(self.life[v, w].u, v, w, sample)
        for f in self.new_faces:
            self.check_face(f, sample)
        require(len(self.outer) == 1, f"{len(self.outer)} faces without a convex angle, not one")
        for v in {d[0] for d in self.new_angles}:
            self.check_star(v, sample)
        self.new_angles.clear()
        self.new_faces.clear()

    def kind_of(self, u: int, v: int, w: int, sample: Fraction) -> str:
        """Which kind an angle has at the sample."""
        a, p, b = (self.scene.at(x, sample) for x in (u, v, w))
        if u == w:
            require(dot(a, p, b) > 0, f"the edge {u} {v} has no length at t = {sample}")
            return FULL
        turn = orientation(a, p, b)
        if turn:
            return CONVEX if turn > 0 else REFLEX
        require(dot(a, p, b) < 0, f"the angle {u} {v} {w} is 0 at t = {sample}")
        return FLAT

    def check_face(self, f: int, sample: Fraction) -> None:
        """Step 4."""
        self.outer.discard(f)
        face = self.map.faces[f]
        if face and face[0] in self.solid:
            return
        kinds = [self.life[d].kind for d in face]
        convex = kinds.count(CONVEX)
        shown = " ".join(str(d[0]) for d in face)
        if convex == 0:
            self.outer.add(f)
            return
        require(convex >= 3, f"the face {shown} has {convex} convex angles")
        require(FULL not in kinds, f"the face {shown} has a dead end")
        if convex > 3:
            require(REFLEX not in kinds, f"the face {shown} has {convex} convex angles, not three")
            d = [self.direction(u, v, sample) for u, v in face]
            # The edges turn left, or not at all: count how often they pass the direction 0.
            turns = sum(comes_before(e, d[i - 1]) for i, e in enumerate(d))
            require(turns == 1, f"the face {shown} turns {turns} times")

    def check_star(self, v: int, sample: Fraction) -> None:
        """Step 5: the next direction counter-clockwise passes the direction 0 once in all."""
        d = [self.direction(v, u, sample) for u in reversed(self.map.clockwise(v))]
        passes = sum(not comes_before(d[i - 1], e) for i, e in enumerate(d))
        require(passes == 1, f"the edges of vertex {v} go around it {passes} times")

    def direction(self, u: int, v: int, t: Fraction) -> tuple[int, int]:
        """The direction from u to v at a rational time."""
        return vector(self.scene.at(u, t), self.scene.at(v, t))

    def end_lives(self, darts: Iterable[Dart], time: Time, *, at_end: bool) -> None:
        """Step 3 for lives that end at a time; and with ``at_end`` step 6 for that time."""
        vanishing = {self.map.face_of[d] for d in sorted(darts) if self.end_life(d, time)}
        if at_end:
            self.check_clusters(vanishing, time)

    def end_life(self, d: Dart, time: Time) -> bool:
        """Check the life of an angle that ends at a time; whether the angle vanishes then."""
        life = self.life.pop(d)
        angle = (life.u, *d)
        i = self.scene.body_of[d[0]]
        if self.rigid[i] and all(self.scene.body_of[v] == i for v in angle):
            return False
        shown = f"the {life.kind} angle {life.u} {d[0]} {d[1]} of line {life.line}"
        vanishes = False
        for start, end, (a, p, b) in self.scene.pieces(angle, life.since, time):
            f = () if life.kind == FULL else orientation_of(a, p, b)
            if life.kind in (FLAT, FULL):
                require(not f, f"{shown} is not straight throughout its life")
                f = dot_of(a, p, b)
            require(f, f"{shown} vanishes throughout a piece of its life")
            inside, vanishes = zeros(f, start, end)
            vanish_within = inside or (vanishes and end is not time)
            require(not vanish_within, f"{shown} vanishes during its life")
        return vanishes

    # Step 6: a touch at a time between intervals.

    def check_start(self) -> None:
        """Step 6 at the start."""
        found = set()
        for (v, w), life in self.life.items():
            a, p, b = (self.scene.at(x, self.scene.start) for x in (life.u, v, w))
            straight = life.kind in (FLAT, FULL)
            if (dot(a, p, b) if straight else orientation(a, p, b)) == 0:
                found.add(self.map.face_of[v, w])
        self.check_clusters(found, self.now)

    def check_clusters(self, faces: set[int], time: Time) -> None:
        """See that there is no contact in the clusters of these faces."""
        left = set(faces)
        while left:
            todo = [left.pop()]
            cluster: set[Dart] = set()
            while todo:
                face = self.map.faces[todo.pop()]
                cluster.update(face)
                across = {self.map.face_of.get((v, u)) for u, v in set(face) - self.body_darts}
                todo += across & left  # type: ignore[arg-type]
                left -= across  # type: ignore[arg-type]
            self.check_apart(cluster, time)

    def check_apart(self, cluster: set[Dart], time: Time) -> None:
        """See that no vertex of a cluster is on another one, or on a body edge."""
        edges = sorted({(min(d), max(d)) for d in cluster & self.body_darts})
        vertices = sorted({v for d in cluster for v in d})
        for _ in range(30):
            time.refine()
        tracks = dict(zip(vertices, self.scene.tracks_at(vertices, time), strict=True))
        boxes = {v: self.box(track, time) for v, track in tracks.items()}
        vertices.sort(key=lambda v: boxes[v][0])
        for i, v in enumerate(vertices):
            for u in vertices[i + 1 :]:
                if boxes[u][0] > boxes[v][1]:
                    break
                if boxes[u][2] <= boxes[v][3] and boxes[v][2] <= boxes[u][3]:
                    same = is_on(time, tracks[v], tracks[u], tracks[u])
                    require(not same, f"vertices {v} and {u} coincide at t = {time}")
        for u, w in edges:
            (a, b, c, d), (e, f, g, h) = boxes[u], boxes[w]
            a, b, c, d = min(a, e), max(b, f), min(c, g), max(d, h)
            for v in vertices:
                left, right, bottom, top = boxes[v]
                if left > b:
                    break
                if right >= a and bottom <= d and top >= c and v not in (u, w):
                    touching = is_on(time, tracks[v], tracks[u], tracks[w])
                    require(not touching, f"vertex {v} is on the edge {u} {w} at t = {time}")

    def box(self, track: Track, time: Time) -> tuple[int, int, int, int]:
        """Integers that enclose x and y, times the grid, at a time."""
        while (of_w := bounds(track[2], time.low, time.high))[0] <= 0:
            time.refine()
        box: list[int] = []
        for f in track[:2]:
            low, high = bounds(f, time.low, time.high)
            box.append(floor(low / of_w[low > 0] * self.grid))
            box.append(ceil(high / of_w[high < 0] * self.grid))
        return box[0], box[1], box[2], box[3]

    # Step 8: the contact.

    def check_contact(self, words: list[str], time: Time) -> str:
        """See that the contact is there at a time; what it is, in words."""
        kind = tuple(w for w in words if not w.isdigit())
        v = [integer(w) for w in words if w.isdigit()]
        start = self.scene.start
        at_start = time.compare_rational(start) == 0
        if kind == ("vertex", "inside") and len(v) == 2 and at_start:
            require(v[1] < len(self.scene.bodies), f"there is no body {v[1]}")
            body = self.scene.bodies[v[1]]
            self.check_numbers(v[:1])
            corners = [
                self.scene.place(u, start) for u in range(body.first, body.first + body.size)
            ]
            inside = body.closed and is_inside(self.scene.place(v[0], start), corners)
            other = self.scene.of(v[0]) is not body
            require(inside and other, f"vertex {v[0]} is not inside body {v[1]}")
            return f"{self.scene.name(v[0])} inside {body.name}"
        self.check_numbers(v)
        if kind == ("vertex", "vertex") and len(v) == 2:
            a, b = self.scene.tracks_at(v, time)
            require(v[0] != v[1] and is_on(time, a, b, b), f"vertices {v} are apart at T")
            return f"{self.scene.name(v[0])} with {self.scene.name(v[1])}"
        if kind == ("vertex", "edge") and len(v) == 3:
            self.check_edge(v[1], v[2])
            tracks = self.scene.tracks_at(v, time)
            touching = v[0] not in v[1:] and is_on(time, *tracks)
            require(touching, f"vertex {v[0]} is not on the edge {v[1]} {v[2]} at T")
            return f"{self.scene.name(v[0])} with the edge from {self.scene.name(v[1])}"
        known = kind == ("edge", "edge") and len(v) == 4 and at_start
        require(known, f"a contact of an unknown kind: {' '.join(words)}")
        self.check_edge(v[0], v[1])
        self.check_edge(v[2], v[3])
        meeting = meet(*(self.scene.at(u, start) for u in v))
        apart = self.scene.of(v[0]) is self.scene.of(v[2]) or not meeting
        require(not apart, f"edges {v[:2]} and {v[2:]} of different bodies do not meet")
        return f"edges from {self.scene.name(v[0])} and {self.scene.name(v[2])}"

    def check_numbers(self, vertices: Iterable[int]) -> None:
        """See that vertices are there."""
        n = len(self.scene.body_of)
        require(all(0 <= v < n for v in vertices), f"there are vertices 0 to {n - 1}")

    def check_edge(self, u: int, v: int) -> None:
        """See that it is a body edge."""
        require((u, v) in self.body_darts, f"{u} {v} is no body edge")


def is_on(time: Time, v: Track, a: Track, b: Track) -> bool:
    """Whether v is in the closed segment ab at a time."""
    return time.sign_of(orientation_of(v, a, b)) == 0 and time.sign_of(dot_of(a, v, b)) <= 0


def meet(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Whether the closed segments ab and cd have a point in common."""
    s = [sign(orientation(*t)) for t in ((a, b, c), (a, b, d), (c, d, a), (c, d, b))]
    if s[0] * s[1] < 0 and s[2] * s[3] < 0:
        return True
    ends = ((a, c, b), (a, d, b), (c, a, d), (c, b, d))
    return any(o == 0 and dot(*e) <= 0 for o, e in zip(s, ends, strict=True))


def is_simple(p: list[Point]) -> bool:
    """Whether the edges of a polygon meet where they are joined, and nowhere else."""
    n = len(p)
    ends = [sorted(Fraction(q[0], q[2]) for q in (p[i - 1], p[i])) for i in range(n)]
    order = sorted(range(n), key=lambda i: ends[i])
    for k, i in enumerate(order):
        for j in order[k + 1 :]:
            if ends[j][0] > ends[i][1]:
                break
            if (j - i) % n == 1 or (i - j) % n == 1:
                e = i if (j - i) % n == 1 else j  # edge e ends at vertex e, where the next begins
                a, v, b = p[e - 1], p[e], p[(e + 1) % n]
                if orientation(a, v, b) == 0 and dot(a, v, b) >= 0:
                    return False
            elif meet(p[i - 1], p[i], p[j - 1], p[j]):
                return False
    return True


def is_inside(q: tuple[Fraction, Fraction], p: list[tuple[Fraction, Fraction]]) -> bool:
    """Whether a point is inside a polygon: a ray to the right leaves it an odd number of times."""
    inside = False
    for a, b in pairwise([*p, p[0]]):
        if (a[1] > q[1]) != (b[1] > q[1]):
            inside ^= a[0] + (q[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]) > q[0]
    return inside


# ---------------------------------------------------------------------------------------
# The file.


def integer(word: str) -> int:
    """The number that a word is."""
    require(re.fullmatch(r"-?\d+", word, re.ASCII), f"not an integer: {word}")
    return int(word)


def rational(word: str) -> Fraction:
    """The rational that a word is."""
    require(re.fullmatch(r"-?\d+(/0*[1-9]\d*)?", word, re.ASCII), f"not a rational: {word}")
    return Fraction(word)


def read_items(words: list[str]) -> Items:
    """What goes, comes, and is taken anew."""
    removed: list[Dart] = []
    added: list[tuple[int, ...]] = []
    renewed: list[Dart] = []
    i = 0
    while i < len(words):
        sort, size = words[i], 4 if words[i] == "+" else 2
        require(sort in ("-", "+", "="), f"an item of an unknown kind: {sort}")
        require(i + size < len(words), f"an item that is not complete: {' '.join(words[i:])}")
        n = [integer(w) for w in words[i + 1 : i + 1 + size]]
        i += 1 + size
        if sort == "+":
            added.append(tuple(n))
        else:
            (removed if sort == "-" else renewed).append((n[0], n[1]))
    return removed, added, renewed


def check(scene_file: bytes, proof_file: bytes) -> str:
    """Check a proof; what it proves.

    Raises:
        Rejected: the first line that does not hold, and why.
        NoProofError: if the files are no scene, or no proof of it.
    """
    try:
        text, lines = scene_file.decode("utf-8-sig"), proof_file.decode().splitlines()
    except UnicodeDecodeError:
        raise NoProofError("a file is not UTF-8") from None
    rows = [(i, line.split()) for i, line in enumerate(lines, 1)]
    rows = [(i, words) for i, words in rows if words and not words[0].startswith("#")]
    if not rows or rows[0][1] != ["exactpt-proof", "1"]:
        raise NoProofError("the first line is not: exactpt-proof 1")
    if len(rows) < 4 or rows[1][1] != ["scene", "sha256", hashlib.sha256(scene_file).hexdigest()]:
        raise NoProofError("the proof is of another scene: the hash of the file is not the same")
    checker = Checker(Scene(text))
    try:
        return checker.check_rows(rows[2:])
    except Rejected as verdict:
        raise Rejected(f"rejected: line {checker.line}: {verdict}") from None


def main(arguments: list[str]) -> int:
    """Check a file; the exit code."""
    if len(arguments) != 2:
        sys.stderr.write("usage: python -m exactpt.proof_check SCENE PROOF\n")
        return 2
    sys.set_int_max_str_digits(0)
    try:
        with open(arguments[0], "rb") as scene, open(arguments[1], "rb") as proof:
            answer, code = check(scene.read(), proof.read()), 0
    except Rejected as verdict:
        answer, code = str(verdict), 1
    except (NoProofError, OSError) as error:
        sys.stderr.write(f"{error}\n")
        return 2
    sys.stdout.write(f"{answer}\n")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
