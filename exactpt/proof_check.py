"""Checks a proof that a scene has its first contact at a time T, or none.

    python3 -I proof_check.py SCENE PROOF [--until T | --partial]

This file imports the standard library alone, uses no floats to decide anything, and is made
to be read. The statement, the file format and the complete argument are in docs/proofs.md.

The proof describes a planar map on the vertices of the scene, and its changes at certain times.
In each open interval between two of these, every angle of a face stays convex, reflex or
straight: orientations of three vertices do not vanish, and these are polynomials in time. By
counting angles, the map is drawn without crossings then, and no two bodies touch. At the times
themselves, a touch can only be among faces with an angle that vanishes just then.

A proof of "no contact" may end before the span of the scene does. It is accepted then if that is
what is wanted: --until T, where T is not after its end, or --partial, whatever its end.

Without -I, Python runs a file called fractions.py that lies in the current folder or beside this
one; so this file refuses to run then. (-I does not keep away what the installation of Python
itself starts, such as sitecustomize.)

Exit code: 0 accepted, 1 rejected (with the first line that fails), 2 no proof of this scene.
"""

import sys

if __name__ == "__main__" and not sys.flags.isolated:
    sys.stderr.write("run it as python3 -I FILE SCENE PROOF: without -I, files nearby take part\n")
    sys.exit(2)

import hashlib
import json
import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import cmp_to_key, lru_cache
from itertools import accumulate, pairwise, zip_longest
from math import floor, gcd, inf, lcm
from typing import Any, TextIO

Point = tuple[Fraction, Fraction]
Dart = tuple[int, int]
Angle = tuple[int, int, int]
Face = tuple[Dart, ...]
Json = Any


class NoProofError(Exception):
    """The files are no scene, not in the format of proofs, or the proof is of another scene."""


class Rejected(Exception):  # noqa: N818 - a verdict
    """A line of the proof does not hold."""


class Proved(str):
    """What is proved, in words.

    Attributes:
        until: of a proof of no contact, the end of its span; else that of the scene.
        whole: whether the answer is that of the whole span of the scene.
    """

    until: Fraction
    whole: bool

    def __new__(cls, text: str, until: Fraction, *, whole: bool) -> "Proved":  # noqa: D102
        proved = super().__new__(cls, text)
        proved.until, proved.whole = until, whole
        return proved


def require(condition: object, why: str) -> None:
    """Reject unless the condition holds."""
    if not condition:
        raise Rejected(why)


# ---- Polynomials, and their real roots.


class Poly(tuple[Any, ...]):
    """A polynomial in t: coefficients, constant term first, none for 0.

    Rational ones while a scene is read, integers from then on.
    """

    __slots__ = ()

    def __new__(cls, coefficients: Iterable[Any] = ()) -> "Poly":  # noqa: D102
        f = list(coefficients)
        while f and not f[-1]:
            f.pop()
        return super().__new__(cls, f)

    def __add__(self, g: "Poly") -> "Poly":  # type: ignore[override]
        return Poly([a + b for a, b in zip_longest(self, g, fillvalue=0)])

    def __sub__(self, g: "Poly") -> "Poly":
        return Poly([a - b for a, b in zip_longest(self, g, fillvalue=0)])

    def __mul__(self, g: "Poly") -> "Poly":  # type: ignore[override]
        if len(self) == 1:
            return Poly([self[0] * b for b in g])
        product = [0] * (len(self) + len(g) - 1) if self and g else []
        for i, a in enumerate(self):
            for j, b in enumerate(g):
                product[i + j] += a * b
        return Poly(product)

    def scaled(self, t: Fraction) -> tuple[int, int]:
        """The value at a time n / d times d^k, k the number of coefficients; and d^k."""
        n, d, power, total = t.numerator, t.denominator, 1, 0
        for c in reversed(self):
            total = total * n + c * power
            power *= d
        return total * d, power

    def sign_at(self, t: Fraction) -> int:
        """The sign of the value at a time."""
        value, _ = self.scaled(t)
        return (value > 0) - (value < 0)

    def primitive(self) -> "Poly":
        """Divided by what the coefficients have in common, with a positive leading one."""
        content = gcd(*self) * (-1 if self[-1] < 0 else 1) if self else 1
        return Poly([c // content for c in self])

    def divided(self, g: "Poly") -> tuple["Poly", "Poly"]:
        """(q, r) with c f = q g + r for a number c that is not 0, and r of lower degree than g."""
        rest, quotient = list(self), [0] * max(0, len(self) - len(g) + 1)
        for i in range(len(self) - len(g), -1, -1):
            top = rest.pop()
            rest, quotient = [g[-1] * c for c in rest], [g[-1] * c for c in quotient]
            quotient[i] = top
            for j, c in enumerate(g[:-1]):
                rest[i + j] -= top * c
        return Poly(quotient), Poly(rest)

    def common_divisor(self, g: "Poly") -> "Poly":
        """The greatest common divisor, by Euclid."""
        f = self
        while g:
            f, g = g, f.divided(g)[1].primitive()
        return f.primitive()

    def square_free(self) -> "Poly":
        """The polynomial with the same roots, all of them simple."""
        derivative = Poly([i * c for i, c in enumerate(self)][1:])
        return self.divided(self.common_divisor(derivative))[0].primitive()

    def variations(self, low: Fraction, high: Fraction) -> int:
        """At least the number of roots strictly between low and high; it, if 0 or 1.

        Descartes' rule of signs for (1 + x)^n f((high + low x) / (1 + x)), x > 0. (These
        coefficients are those of f in the Bernstein basis, times binomials.)
        """
        d = lcm(low.denominator, high.denominator)
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

    def roots(self, low: Fraction, high: Fraction) -> "Iterator[Time]":
        """The roots in [low, high], low < high; all roots must be simple."""
        yield from (Time(q) for q in (low, high) if self.sign_at(q) == 0)
        todo = [(low, high)]
        while todo:  # halve intervals, until each root is alone in one
            a, b = todo.pop()
            count, middle = self.variations(a, b), (a + b) / 2
            if count == 1 and self.sign_at(a) and self.sign_at(b):
                yield Time(a, b, self)
            elif count:
                todo += [(a, middle), (middle, b)]
                if self.sign_at(middle) == 0:
                    yield Time(middle)


class Time:
    """A number: low = high; or the only root of f between low and high, where f is not 0.

    f has simple roots alone; so its signs at low and high differ.
    """

    def __init__(self, low: Fraction, high: Fraction | None = None, f: Poly = Poly()) -> None:  # noqa: B008
        self.low, self.high, self.f = low, low if high is None else high, f

    def refine(self) -> None:
        """Halve the interval."""
        self.compare_rational((self.low + self.high) / 2)

    def compare_rational(self, q: Fraction) -> int:
        """-1, 0 or 1 as the time is before, at or after q."""
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
        """-1, 0 or 1 as the time is before, at or after the other."""
        if other.low == other.high:
            return self.compare_rational(other.low)
        if self.compare_rational(other.low) <= 0:
            return -1
        if self.compare_rational(other.high) >= 0:
            return 1
        s = self.sign_of(other.f)  # which has but one root there
        return 0 if s == 0 else -1 if s == other.f.sign_at(other.low) else 1

    def sign_of(self, g: Poly) -> int:
        """The sign of g at this time."""
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
        if self.low == self.high:
            return str(self.low)
        between = f"(between {self.low} and {self.high})"
        for _ in range(99):  # they may stay apart: on both sides of 0, or of a digit
            if twelve_digits(self.low) == twelve_digits(self.high):
                break
            self.refine()
        return f"{twelve_digits(self.low)} {between}"


def twelve_digits(x: Fraction) -> str:
    """A number rounded to twelve digits."""
    return f"{Decimal(x.numerator) / x.denominator:.12g}"


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
    if f.variations(low, high) == 0:
        return False, end.low == high and f.sign_at(high) == 0
    roots = list(f.square_free().roots(low, high))
    after = [root.compare(end) for root in roots if root.compare(start) > 0]
    return -1 in after, 0 in after


# ---- Tracks: a vertex is at (x / w, y / w), with polynomials x, y and w, the latter positive.

Track = tuple[Poly, Poly, Poly]


def vector_of(a: Track, b: Track) -> tuple[Poly, Poly]:
    """A positive multiple of b - a."""
    return b[0] * a[2] - a[0] * b[2], b[1] * a[2] - a[1] * b[2]


@lru_cache(100_000)
def orientation_of(a: Track, b: Track, c: Track) -> Poly:
    """Positive where a, b, c turn left, 0 where they are on one line: the determinant."""
    f = a[0] * (b[1] * c[2] - c[1] * b[2]) + b[0] * (c[1] * a[2] - a[1] * c[2])
    return f + c[0] * (a[1] * b[2] - b[1] * a[2])


def dot_of(a: Track, v: Track, b: Track) -> Poly:
    """A positive multiple of (a - v) . (b - v)."""
    (px, py), (qx, qy) = vector_of(v, a), vector_of(v, b)
    return px * qx + py * qy


def is_on(time: Time, v: Track, a: Track, b: Track) -> bool:
    """Whether v is in the closed segment ab at a time."""
    return time.sign_of(orientation_of(v, a, b)) == 0 and time.sign_of(dot_of(a, v, b)) <= 0


def meet(time: Time, a: Track, b: Track, c: Track, d: Track) -> bool:
    """Whether the closed segments ab and cd have a point in common at a time."""
    triples = ((a, b, c), (a, b, d), (c, d, a), (c, d, b))
    p, q, r, s = (time.sign_of(orientation_of(*t)) for t in triples)
    ends = is_on(time, c, a, b) or is_on(time, d, a, b)
    return (p * q < 0 and r * s < 0) or ends or is_on(time, a, c, d) or is_on(time, b, c, d)


def is_simple(time: Time, tracks: dict[int, Track], edges: Iterable[Dart]) -> bool:
    """Whether the edges around polygons meet where they are joined, and nowhere else."""
    at = time.low
    x = {v: Fraction(*f.scaled(at)) / Fraction(*w.scaled(at)) for v, (f, _, w) in tracks.items()}
    spans = sorted((min(x[u], x[v]), max(x[u], x[v]), u, v) for u, v in edges)
    for k, (_, right, *e) in enumerate(spans):
        for left, _, *f in spans[k + 1 :]:
            if left > right:
                break
            if e[1] == f[0] or f[1] == e[0]:  # one of them ends where the other begins
                a, v, b = (tracks[u] for u in ((*e, f[1]) if e[1] == f[0] else (*f, e[1])))
                if not time.sign_of(orientation_of(a, v, b)) and time.sign_of(dot_of(a, v, b)) >= 0:
                    return False
            elif meet(time, *(tracks[u] for u in (*e, *f))):
                return False
    return True


def surrounds(ring: Sequence[Point], p: Point) -> bool:
    """Whether a ray from p to the right crosses a polygon an odd number of times."""
    odd = False
    for a, b in pairwise([*ring, *ring[:1]]):
        if (a[1] > p[1]) != (b[1] > p[1]):
            odd ^= a[0] + (p[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]) > p[0]
    return odd


def comes_before(d: Point, e: Point) -> bool:
    """Whether the direction d has a smaller angle than e, both in [0, 2 pi)."""
    p, q = (v[1] < 0 or (v[1] == 0 and v[0] < 0) for v in (d, e))  # the angle is at least pi
    return p < q or (p == q and d[0] * e[1] - d[1] * e[0] > 0)


# ---- The scene (docs/format.md). What is not understood is refused.

NUMBER = re.compile(r"[+-]?(\d+(/0*[1-9]\d*)?|(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,6})?)", re.ASCII)
Until = Fraction | float  # the only float is infinity
Shape = list[tuple[Poly, Poly]]


class Bare(str):
    """A number of JSON, as it is written: not one in quotes."""

    __slots__ = ()


def need(condition: object, what: str, data: Json = "") -> None:
    """Refuse the scene unless the condition holds."""
    if not condition:
        raise NoProofError(f"the scene: {what} {data!r:.60}")


def number(data: Json) -> Fraction:
    """The rational that a text, or a number of JSON, denotes."""
    need(isinstance(data, str) and NUMBER.fullmatch(data), "not a number:", data)
    return Fraction(data)


def keys(data: Json, *allowed: str) -> dict[str, Json]:
    """A JSON object with these keys at most."""
    need(isinstance(data, dict) and set(data) <= set(allowed), f"not of the keys {allowed}:", data)
    return dict(data)


def entries(data: Json, length: int | None = None) -> list[Json]:
    """A JSON list."""
    need(isinstance(data, list) and length in (None, len(data)), "not a list as needed:", data)
    return list(data)


def polynomial(data: Json) -> Poly:
    """The polynomial that a list of numbers is."""
    return Poly([number(c) for c in entries(data)])


class Body:
    """A body: the tracks of its vertices, in each piece of its motion.

    Attributes:
        breaks: the times at which formulas change; piece k ends at breaks[k], the last never.
        vertices: the numbers of its vertices in the scene, from ``first`` on.
        closed: whether it is a polygon with its inside.
        rings: the numbers of the vertices of each ring, and whether it bounds a hole.
    """

    def __init__(self, data: Json, first: int) -> None:
        shape = "vertices", "keyframes", "parts"
        body = keys(data, "name", "motion", "closed", "holes", *shape)
        need(sum(key in body for key in shape) == 1, "vertices or keyframes or parts:", data)
        need("holes" not in body or "vertices" in body, "holes without vertices:", data)
        self.name, closed = body.get("name"), body.get("closed", True)
        need(isinstance(self.name, str) and isinstance(closed, bool), "name or closed:", data)
        parts = [keys(part, "vertices", "holes") for part in entries(body.get("parts", []))]
        rings = [
            (entries(ring), k > 0)
            for part in (parts or [body])
            for k, ring in enumerate([part.get("vertices", []), *entries(part.get("holes", []))])
        ]
        several = "parts" in body or len(rings) > 1
        need(not several or (closed and min(len(r) for r, _ in rings) > 2), "rings:", data)
        flat = [vertex for ring, _ in rings for vertex in ring]
        self.shapes = keyframes(body["keyframes"]) if "keyframes" in body else resting(flat)
        self.motions = motions(body.get("motion", {}))
        self.first, self.size = first, len(self.shapes[0][1])
        need(self.size, "no vertices:", self.name)
        self.vertices, self.closed = range(first, first + self.size), closed and self.size > 2
        ends = {t for t, _ in self.shapes} | {t for t, _ in self.motions}
        self.breaks = sorted(t for t in ends if isinstance(t, Fraction))
        ends_at = [*accumulate(len(ring) for ring, _ in rings)] if several else [self.size]
        spans = pairwise([0, *ends_at])
        self.rings = [(self.vertices[i:j], rings[k][1]) for k, (i, j) in enumerate(spans)]
        self.edges = [
            edge
            for ring, _ in self.rings
            for edge in [*pairwise(ring), *[(ring[-1], ring[0])][: self.closed]]
        ]
        self.tracks: dict[tuple[int, int], Track] = {}

    def track(self, i: int, piece: int) -> Track:
        """The track of vertex i in a piece."""
        if (i, piece) not in self.tracks:
            t = self.breaks[piece - 1] if piece else -inf
            shape = next(shape for end, shape in self.shapes if end > t)
            motion = next(motion for end, motion in self.motions if end > t)
            self.tracks[i, piece] = moved(motion, *shape[i])
        return self.tracks[i, piece]


def resting(vertices: list[Json]) -> list[tuple[Until, Shape]]:
    """One shape for ever: a vertex is two numbers, or an object with polynomials x and y."""
    shape: Shape = []
    for data in vertices:
        given = keys(data, "x", "y") if isinstance(data, dict) else None
        x, y = (
            ([c] for c in entries(data, 2)) if given is None else (given.get(k, []) for k in "xy")
        )
        shape.append((polynomial(x), polynomial(y)))
    return [(inf, shape)]


def keyframes(data: Json) -> list[tuple[Until, Shape]]:
    """Linear between keyframes, at rest before the first and after the last: (until, shape)."""
    path: list[tuple[Fraction, list[list[Fraction]]]] = []
    for frame in (keys(f, "t", "vertices") for f in entries(data)):
        points = [[number(c) for c in entries(p, 2)] for p in entries(frame.get("vertices"))]
        path.append((number(frame.get("t")), points))
    need(len({len(points) for _, points in path}) == 1, "keyframes:", data)
    need(all(s < t for (s, _), (t, _) in pairwise(path)), "keyframes not in order:", data)
    path = [(path[0][0] - 1, path[0][1]), *path, (path[-1][0] + 1, path[-1][1])]
    found: list[tuple[Until, Shape]] = []
    for (s, p), (t, q) in pairwise(path):
        shape: Shape = []
        for a, b in zip(p, q, strict=True):
            m, n = ((d - c) / (t - s) for c, d in zip(a, b, strict=True))
            shape.append((Poly([a[0] - m * s, m]), Poly([a[1] - n * s, n])))
        found.append((t, shape))
    return [*found[:-1], (inf, found[-1][1])]


def motions(data: Json) -> list[tuple[Until, dict[str, Json]]]:
    """The motions of a body, one after the other: (until, motion)."""
    pieces = [{"motion": data}]
    if isinstance(data, dict) and "pieces" in data:
        pieces = [
            keys(p, "until", "motion") for p in entries(keys(data, "pieces", "spin")["pieces"])
        ]
    whole = pieces and "until" not in pieces[-1] and all("until" in p for p in pieces[:-1])
    need(whole, '"until" belongs to all pieces but the last:', data)
    ends: list[Until] = [*(number(p["until"]) for p in pieces[:-1]), inf]
    need(all(s < t for s, t in pairwise(ends)), "pieces not in order:", data)
    found = [keys(p.get("motion"), "x", "y", "rigid", "affine") for p in pieces]
    return list(zip(ends, found, strict=True))


def moved(motion: dict[str, Json], x: Poly, y: Poly) -> Track:
    """The track of a vertex that a motion carries."""
    w = one = Poly([Fraction(1)])
    data = motion
    if "rigid" in motion:
        # A turn by the angle a with tan(a / 2) = h: (1 - h^2, 2 h) / (1 + h^2) is (cos, sin).
        allowed = "half_turn", "pivot", "x", "y", "orientation"
        data = keys(keys(motion, "rigid")["rigid"], *allowed)
        h = polynomial(data.get("half_turn"))
        px, py = (polynomial([c]) for c in entries(data.get("pivot", ["0", "0"]), 2))
        c, s = (polynomial([c]) for c in entries(data.get("orientation", ["1", "0"]), 2))
        need(c * c + s * s == one, "an orientation that is no unit vector:", data)
        w, cosine, sine = one + h * h, one - h * h, h + h
        x, y = x - px, y - py
        x, y = c * x - s * y, s * x + c * y
        x, y = cosine * x - sine * y + w * px, sine * x + cosine * y + w * py
    elif "affine" in motion:
        data = keys(keys(motion, "affine")["affine"], "matrix", "x", "y")
        rows = [entries(row, 2) for row in entries(data.get("matrix"), 2)]
        (a, b), (c, d) = ([polynomial(p) for p in row] for row in rows)
        x, y = a * x + b * y, c * x + d * y
    x, y = x + w * polynomial(data.get("x", [])), y + w * polynomial(data.get("y", []))
    m = lcm(*(c.denominator for f in (x, y, w) for c in f))
    f, g, e = ([int(c * m) for c in f] for f in (x, y, w))
    m = gcd(*f, *g, *e)
    return Poly([c // m for c in f]), Poly([c // m for c in g]), Poly([c // m for c in e])


class Scene:
    """All bodies; their vertices are numbered through."""

    def __init__(self, text: str) -> None:
        def unique(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
            need(len({k for k, _ in pairs}) == len(pairs), "a key is there twice:", pairs)
            return dict(pairs)

        try:
            data = json.loads(text, parse_int=Bare, parse_float=Bare, object_pairs_hook=unique)
        except (ValueError, RecursionError) as error:
            raise NoProofError(f"the scene is not JSON: {error}") from None
        top = keys(data, "exactpt", "time", "bodies")
        version = top.get("exactpt")
        need(version == "1" and isinstance(version, Bare), "not of format 1:", version)
        self.start, self.end = (number(t) for t in entries(top.get("time"), 2))
        need(self.start < self.end, "an empty time span:", top["time"])
        self.bodies: list[Body] = []
        self.body_of: list[int] = []
        for i, entry in enumerate(entries(top.get("bodies"))):
            self.bodies.append(Body(entry, len(self.body_of)))
            self.body_of += [i] * self.bodies[-1].size
        need(len({body.name for body in self.bodies}) == len(self.bodies), "a name is there twice")
        self.known: tuple[Fraction, dict[int, Point]] = self.start, {}

    def of(self, v: int) -> Body:
        """The body of a vertex."""
        return self.bodies[self.body_of[v]]

    def track(self, v: int, after: Fraction) -> Track:
        """The track of a vertex just after a rational time."""
        body = self.of(v)
        return body.track(v - body.first, bisect_right(body.breaks, after))

    def at(self, v: int, t: Fraction) -> Point:
        """Where a vertex is at a rational time."""
        if self.known[0] != t:
            self.known = t, {}
        if v not in self.known[1]:
            x, y, w = (Fraction(*f.scaled(t)) for f in self.track(v, t))
            self.known[1][v] = x / w, y / w
        return self.known[1][v]

    def pieces(
        self, vertices: Sequence[int], start: Time, end: Time
    ) -> list[tuple[Time, Time, list[Track]]]:
        """The time between start and end, cut at breakpoints: from, to, and the tracks then."""
        found = {q for v in vertices for q in self.of(v).breaks}
        inside = [q for q in found if start.compare_rational(q) < 0 < end.compare_rational(q)]
        times = [start, *map(Time, sorted(inside)), end]
        # Comparing has seen to it that no breakpoint is after a.low and before a.
        return [(a, b, [self.track(v, a.low) for v in vertices]) for a, b in pairwise(times)]

    def tracks_at(self, vertices: Iterable[int], time: Time) -> dict[int, Track]:
        """Tracks of some vertices that hold at a time."""
        for q in {q for v in vertices for q in self.of(v).breaks}:
            time.compare_rational(q)  # so that no breakpoint is inside the interval of the time
        return {v: self.track(v, time.low) for v in vertices}

    def is_rigid(self, body: Body, end: Fraction) -> bool:
        """Whether lengths, dot and cross products of successive edges, so shapes, are constant."""
        n, path = body.size, body.vertices
        triples = [(path[k - 1], path[k], path[(k + 1) % n]) for k in range(n)]
        if not body.closed:
            triples = triples[1:-1] if n > 2 else [(v, path[0], v) for v in path[1:]]
        for t in [self.start, *(q for q in body.breaks if self.start < q < end)]:
            for a, v, b in ([self.track(u, t) for u in triple] for triple in triples):
                of_a, of_b = a[2] * v[2], b[2] * v[2]  # the denominators of a - v and b - v
                forms = [(dot_of(a, v, a), of_a * of_a), (dot_of(b, v, b), of_b * of_b)]
                forms += [(dot_of(a, v, b), of_a * of_b), (orientation_of(a, v, b), of_a * b[2])]
                values = [(Fraction(*f.scaled(t)), Fraction(*g.scaled(t))) for f, g in forms]
                if any(
                    f * Poly([d]) != g * Poly([n])
                    for (f, g), (n, d) in zip(forms, values, strict=True)
                ):
                    return False
        return True


# ---- Planar maps: half-edges (u, v), and which one follows which around the face on the left.


class PlanarMap:
    """Half-edges with their order around faces, and so around vertices. No coordinates.

    ``after`` is the next one of each half-edge around its face; ``out`` has the vertices to which
    each vertex has an edge; ``component`` is the number, from 1 on, of the component of each.
    """

    def __init__(self, vertices: int) -> None:
        self.after: dict[Dart, Dart] = {}
        self.out: list[set[int]] = [set() for _ in range(vertices)]
        self.component, self.components = [0] * vertices, 0
        self.faces, self.face_of = set[Face](), dict[Dart, Face]()

    def begin(self, cycles: list[list[int]]) -> None:
        """Make the map of these faces; all of step 2 but for bodies."""
        for cycle in cycles:
            require(len(cycle) > 1 or (len(self.out) == 1 == len(cycles)), "a face of one vertex")
            face = list(pairwise([*cycle, cycle[0]])) if len(cycle) > 1 else []
            for d, e in pairwise([*face, *face[:1]]):
                require(d not in self.after and d[0] != d[1], f"the half-edge {d} is there twice")
                self.after[d] = e
                self.out[d[0]].add(d[1])
        for u, v in self.after:
            require((v, u) in self.after, f"the edge {u} {v} has a face on one side alone")
        for v, around in enumerate(self.out):
            require(len(self.clockwise(v)) == len(around), f"vertex {v} has more than one fan")
        for first in range(len(self.out)):
            todo = [first] * (not self.component[first])
            self.components += len(todo)
            while todo:
                v = todo.pop()
                self.component[v] = self.components
                todo += [u for u in self.out[v] if not self.component[u]]
        if len(self.out) == 1:
            self.faces = {()}  # around a single vertex
        self.make_faces(set(self.after))

    def clockwise(self, v: int) -> list[int]:
        """The vertices to which v has an edge, in order, clockwise."""
        order: list[int] = []
        u = next(iter(self.out[v]), -1)
        while u >= 0 and (not order or u != order[0]):
            order.append(u)
            u = self.after[u, v][1]
        return order

    def change(self, removed: list[Dart], added: list[list[int]]) -> tuple[set[Dart], set[Angle]]:
        """Change the map but for its faces; half-edges that have gone, and angles that come."""
        fans = {v: self.clockwise(v) for d in [*removed, *added] for v in d[:2]}
        gone, come = dict[Dart, Dart](), set[Angle]()  # what followed; an edge may come back
        for u, v in removed:
            require((u, v) in self.after, f"there is no edge {u} {v} that could go")
            for a, b in ((u, v), (v, u)):
                fans[a].remove(b)
                self.out[a].remove(b)
                gone[a, b] = self.after.pop((a, b))
        places: list[tuple[int, int, int]] = []  # at a vertex, the new one stands before another
        for u, v, w, x in added:
            require(u != v and v not in self.out[u], f"the edge {u} {v} is there, or no edge")
            one = self.component[u] == self.component[v]
            require(one, f"the edge {u} {v} joins two components of the map")
            self.out[u].add(v)
            self.out[v].add(u)
            places += [(v, u, w), (u, v, x)]
        while places:
            ready = [(v, u, w) for v, u, w in places if w in fans[v]]
            ready = ready or [p for p in places if not fans[p[0]]][:1]
            require(ready, f"the places {places} of new edges are not there")
            for v, u, w in ready:
                fans[v].insert(fans[v].index(w) if w in fans[v] else 0, u)
                places.remove((v, u, w))
        for v, fan in fans.items():
            for u, w in pairwise([*fan, *fan[:1]]):
                if self.after.get((u, v), gone.get((u, v))) != (v, w):
                    come.add((u, v, w))
                self.after[u, v] = v, w
        for u, v, w, x in added:
            placed = self.after[u, v] == (v, w) and self.after[v, u] == (u, x)
            require(placed, f"the edge {u} {v} does not stand where its item says")
        for u, v in removed:
            require(self.joined(u, v), f"without the edge {u} {v} the map is not connected")
        return {d for d in gone if d not in self.after}, come

    def joined(self, u: int, v: int) -> bool:
        """Whether a path joins two vertices; searched for from both ends in turn."""
        seen, fronts = ({u}, {v}), [{u}, {v}]
        while all(fronts) and seen[0].isdisjoint(seen[1]):
            for i in (0, 1):
                fronts[i] = {y for x in fronts[i] for y in self.out[x]} - seen[i]
                seen[i].update(fronts[i])
        return not seen[0].isdisjoint(seen[1])

    def make_faces(self, touched: set[Dart]) -> set[Face]:
        """Make the faces around half-edges that have changed anew; the new ones."""
        old = {self.face_of[d] for d in touched if d in self.face_of}
        pool = touched.union(*old)
        for d in pool:
            self.face_of.pop(d, None)
        pool = {d for d in pool if d in self.after}
        new = set[Face]()
        while pool:
            face = [min(pool)]
            while (d := self.after[face[-1]]) != face[0]:
                face.append(d)
            pool.difference_update(face)
            new.add(tuple(face))
            self.face_of.update(dict.fromkeys(face, tuple(face)))
        self.faces = (self.faces - old) | new
        v, e, f = len(self.out), len(self.after) // 2, len(self.faces)
        euler = 2 * self.components
        require(v - e + f == euler, f"{v} vertices, {e} edges, {f} faces: V - E + F is not {euler}")
        return new


# ---- The checker. Steps are those of docs/proofs.md.

CONVEX, REFLEX, FLAT, FULL = "convex", "reflex", "flat", "full"


@dataclass
class Life:
    """The life of the angle of a half-edge v -> w, with u -> v before it.

    It has begun at a time, by a line; its kind is known from the sample on.
    """

    u: int
    since: Time
    line: int
    kind: str = ""

    def form(self, a: Track, p: Track, b: Track) -> Poly:
        """What vanishes with the angle."""
        return dot_of(a, p, b) if self.kind in (FLAT, FULL) else orientation_of(a, p, b)


class Checker:
    """Goes through a proof, interval by interval. ``line`` is the one that is looked at."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self.end, self.line = scene, scene.end, 0
        self.now = Time(scene.start)
        self.map = PlanarMap(len(scene.body_of))
        self.body_darts = {d for b in scene.bodies for u, v in b.edges for d in ((u, v), (v, u))}
        self.rings: list[list[int]] = []  # of rigid closed bodies, which are on their left
        self.holes: list[int] = []  # a vertex of each of those that bound holes
        self.ahead: dict[int, int] = {}  # on a ring of a closed body, which is on the left
        self.rigid: list[bool] = []
        self.solid: set[Dart] = set()
        self.life: dict[Dart, Life] = {}
        self.new_angles, self.new_faces, self.outer = set[Dart](), set[Face](), set[Face]()

    # The lines, and step 7: times increase.

    def check_rows(self, rows: list[tuple[int, list[str]]]) -> Proved:
        """Check the lines of a proof from the third on; what is proved."""
        self.line, (_, first, last) = rows[0]
        start, self.end = Fraction(first), Fraction(last)
        within = start == self.scene.start < self.end <= self.scene.end
        require(within, "the time span is not one of the scene")
        for body in self.scene.bodies:
            self.read_body(body)
        faces = [row for row in rows if row[1][0] in ("face", "inside", "outer")]
        cycles, time, k = list[list[int]](), self.now, 0
        for self.line, words in faces:
            cycles.append(self.vertices(words[1:]))
        if cycles:
            self.begin(cycles)
        for number, words in rows[1 + len(faces) :]:
            made, self.line = self.line, number
            k = next((i for i, w in enumerate(words) if w in STARTS), len(words))
            time = self.read_time(words[1:k]) if k > 1 else Time(self.end)
            require(time.compare_rational(self.end) <= 0, "a time after the time span")
            if cycles:
                require(self.now.compare(time) < 0, "times do not increase")
                self.line = made
                self.look_at(between(self.now, time))
                self.line = number
            elif words != ["none"] or self.scene.bodies:
                at_start = words[0] == "contact" and time.compare(self.now) == 0
                require(at_start, "there is no map")
            if words[0] == "event":
                self.event(time, words[k:])
        vanishing = self.end_lives(self.life, time)
        if words == ["none"]:
            self.check_clusters(vanishing, time)
            proved = f"accepted: no contact from t = {start} to t = {self.end}"
            return Proved(proved, self.end, whole=self.end == self.scene.end)
        what = self.check_contact(words[k:], time)
        return Proved(
            f"accepted: no contact before T = {time}; contact of {what} at T", self.end, whole=True
        )

    def read_time(self, words: list[str]) -> Time:
        """The time that these words are."""
        low, high = Fraction(words[0]), Fraction(words[1])
        if words[2:3] == ["@"]:
            v = self.vertices(words[3:])
            breaks = {q for u in v for q in self.scene.of(u).breaks if low < q < high}
            require(not breaks, f"a breakpoint is between {low} and {high}")
            p = [self.scene.track(u, low) for u in v]
            f = orientation_of(*p) if len(p) == 3 else vector_of(*p)[0]
        else:
            f = Poly(map(int, words[2:]))
        if low == high and (len(words) == 2 or (f and f.sign_at(low) == 0)):
            return Time(low)
        require(f, "no time is named by what is always 0")
        roots = list(f.square_free().roots(low, high)) if low < high else []
        require(len(roots) == 1, f"{len(roots)} roots between {low} and {high}, not one")
        while (roots[0].high - roots[0].low) * 2**20 > self.end - self.scene.start:
            roots[0].refine()  # for speed alone
        return roots[0]

    def vertices(self, words: Iterable[str]) -> list[int]:
        """The vertices that these words are."""
        n, found = len(self.scene.body_of), [int(w) for w in words]
        for v in found:
            require(v < n, f"not a vertex, 0 to {n - 1}: {v}")
        return found

    # Step 1: the scene.

    def read_body(self, body: Body) -> None:
        """Look at a body by itself."""
        start, vertices = Time(self.scene.start), [*body.vertices]
        for k, q in enumerate(body.breaks):
            for i in range(body.size if start.low < q <= self.end else 0):
                jump = vector_of(body.track(i, k), body.track(i, k + 1))
                require(
                    not any(f.sign_at(q) for f in jump), f"{body.name}: vertex {i} jumps at {q}"
                )
        self.rigid.append(self.scene.is_rigid(body, self.end))
        if not body.closed:
            return
        places = [[self.scene.at(v, start.low) for v in ring] for ring, _ in body.rings]
        for i, (ring, is_hole) in enumerate(body.rings):
            turns = pairwise([*places[i], places[i][0]])
            area = sum(p[0] * q[1] - p[1] * q[0] for p, q in turns)
            require(area, f"{body.name} has no area at the start")
            cycle = [*ring] if (area > 0) != is_hole else [*ring[::-1]]
            edges = [*pairwise([*cycle, cycle[0]])]
            self.ahead.update(edges)
            if self.rigid[-1]:
                self.rings.append(cycle)
                self.holes += cycle[:1] if is_hole else []
                self.solid.update(edges)
            # Rings are disjoint: nested, they are outlines and holes in turn.
            around = sum(surrounds(other, places[i][0]) for j, other in enumerate(places) if j != i)
            require(around % 2 == is_hole, f"{body.name}: a hole or part is where none can be")
        if self.rigid[-1] or len(places) > 1:
            tracks = {v: self.scene.track(v, start.low) for v in vertices}
            simple = is_simple(start, tracks, body.edges)
            require(simple, f"{body.name} is not simple at the start")

    # Step 2: the map, and its changes.

    def begin(self, cycles: list[list[int]]) -> None:
        """Take the faces at the start."""
        self.map.begin([*cycles, *self.rings])
        for u, v in self.body_darts:
            require((u, v) in self.map.after, f"the body edge {u} {v} is missing")
        # Each component is in a hole of its own of a rigid body, but for one.
        inner = {self.map.component[v] for v in self.holes}
        apart = len(inner) == len(self.holes) == self.map.components - 1
        require(apart, "the map is not connected: a component is not alone in a hole")
        self.outermost = set(self.map.component) - inner
        self.check_insides(self.ahead)
        self.new_faces = self.map.faces.copy()
        self.begin_lives((u, v, w) for (u, v), (_, w) in self.map.after.items())

    def check_insides(self, vertices: Iterable[int]) -> None:
        """See that edges from vertices into the inside of their body lead to that body."""
        for v in vertices:
            # Clockwise from the edge behind v, up to the one ahead, is the inside.
            order = self.map.clockwise(v)
            i = next(i for i, u in enumerate(order) if self.ahead.get(u) == v)
            order = order[i:] + order[:i]
            for u in order[: order.index(self.ahead[v])]:
                same = self.scene.body_of[u] == self.scene.body_of[v]
                require(same, f"the edge {v} {u} runs inside a body to another one")

    def begin_lives(self, angles: Iterable[Angle]) -> None:
        """Let the lives of angles begin now."""
        for u, v, w in angles:
            if (v, w) not in self.solid:
                self.life[v, w] = Life(u, self.now, self.line)
                self.new_angles.add((v, w))

    def event(self, time: Time, words: list[str]) -> None:
        """Let all that happens at one time happen."""
        items: dict[str, list[list[int]]] = {"-": [], "+": [], "=": []}
        item: list[int] = []
        for word in words:
            if word in items:
                item = []
                items[word].append(item)
            else:
                item += self.vertices([word])
        removed, renewed = ([(u, v) for u, v in items[sort]] for sort in "-=")
        for u, v, *_ in [*items["-"], *items["+"]]:
            require((u, v) not in self.body_darts, f"the body edge {u} {v} cannot go or come")
        for d in renewed:
            require(d in self.life, f"there is no angle of {d} to be taken anew")
        gone, come = self.map.change(removed, items["+"])
        for u, v, w in come:
            require((u, v) not in self.solid, f"an edge inside a rigid body, {v} {w}")
        # Angles that end, in the faces of the map before: steps 3 and 6.
        new = {(v, w) for _, v, w in come}
        again = [(self.life[d].u, *d) for d in renewed if d not in gone | new]
        ended = {d for d in [*gone, *new, *renewed] if d in self.life}
        self.check_clusters(self.end_lives(ended, time), time)
        self.now = time
        self.new_faces = self.map.make_faces(gone | new | {(u, v) for u, v, _ in come})
        self.new_faces |= {self.map.face_of[v, w] for _, v, w in again}
        self.outer &= self.map.faces
        self.check_insides({v for _, v, _ in come if v in self.ahead})
        self.begin_lives([*come, *again])

    # Steps 3, 4, 5: the interval after now. Let a face f turn k(f) times, and the angles of a
    # vertex v add up to m(v) full turns. There are two angles an edge: the sum of k is E minus
    # the sum of m. With V - E + F = 2, the sum of m - 1 is the sum of 1 - k, over all faces but
    # the outer one, plus -k(outer) - 1. Here m = 1, and no term on the right is negative: with
    # three convex angles, 2 pi k < 3 pi. So each face turns once. Then it is simple: its chains,
    # seen from a convex angle, lie in two cones that share the apex alone, for the convex angles
    # and the turns of the chains add up to pi. And the faces lie side by side.

    def look_at(self, sample: Fraction) -> None:
        """See what is new at a rational time inside the interval that begins now."""
        for v, w in self.new_angles:
            u = self.life[v, w].u
            tracks = [self.scene.track(x, sample) for x in (u, v, w)]
            turn = orientation_of(*tracks).sign_at(sample)
            along = dot_of(*tracks).sign_at(sample) if turn == 0 else 0
            straight = along > 0 if u == w else along < 0
            require(turn or straight, f"the angle {u} {v} {w} is 0 at t = {sample}")
            kind = CONVEX if turn > 0 else REFLEX if turn < 0 else FULL if u == w else FLAT
            self.life[v, w].kind = kind
        for f in self.new_faces:
            self.check_face(f, sample)
        require(len(self.outer) == 1, f"{len(self.outer)} faces without a convex angle, not one")
        for v in {v for v, _ in self.new_angles}:
            # The next edge counter-clockwise passes the direction 0 once in all.
            d = [self.direction(v, u, sample) for u in reversed(self.map.clockwise(v))]
            passes = sum(not comes_before(d[i - 1], e) for i, e in enumerate(d))
            require(passes == 1, f"the edges of vertex {v} go around it {passes} times")
        self.new_angles.clear()
        if self.now.compare_rational(start := self.scene.start) == 0:
            vanishing = set()
            for (v, w), life in self.life.items():
                tracks = [self.scene.track(x, start) for x in (life.u, v, w)]
                if life.form(*tracks).sign_at(start) == 0:
                    vanishing.add(self.map.face_of[v, w])
            self.check_clusters(vanishing, self.now)

    def check_face(self, face: Face, sample: Fraction) -> None:
        """Step 4."""
        self.outer.discard(face)
        if face and face[0] in self.solid:
            return
        kinds = [self.life[d].kind for d in face]
        convex = kinds.count(CONVEX)
        shown = " ".join(str(u) for u, _ in face)
        if convex == 0:
            within = any(self.map.component[v] not in self.outermost for v, _ in face)
            require(not within, f"the face {shown} of a hole has no convex angle")
            self.outer.add(face)
            return
        require(convex >= 3, f"the face {shown} has {convex} convex angles")
        require(FULL not in kinds, f"the face {shown} has a dead end")
        if convex > 3:
            require(REFLEX not in kinds, f"the face {shown} has {convex} convex angles, not three")
            # The edges turn left, or not at all: count how often they pass the direction 0.
            d = [self.direction(u, v, sample) for u, v in face]
            turns = sum(comes_before(e, d[i - 1]) for i, e in enumerate(d))
            require(turns == 1, f"the face {shown} turns {turns} times")

    def direction(self, u: int, v: int, t: Fraction) -> Point:
        """The direction from u to v at a rational time."""
        p, q = self.scene.at(u, t), self.scene.at(v, t)
        return q[0] - p[0], q[1] - p[1]

    def end_lives(self, darts: Iterable[Dart], time: Time) -> set[Face]:
        """Step 3 for lives that end at a time; the faces with an angle that vanishes then."""
        return {self.map.face_of[d] for d in sorted(darts) if self.end_life(d, time)}

    def end_life(self, d: Dart, time: Time) -> bool:
        """Check the life of an angle that ends at a time; whether the angle vanishes then."""
        life = self.life.pop(d)
        angle = (life.u, *d)
        i = self.scene.body_of[d[0]]
        if self.rigid[i] and all(self.scene.body_of[v] == i for v in angle):
            return False
        shown = f"the {life.kind} angle {life.u} {d[0]} {d[1]} of line {life.line}"
        vanishes = False
        for start, end, tracks in self.scene.pieces(angle, life.since, time):
            if life.kind in (FLAT, FULL):
                straight = not orientation_of(*tracks)
                require(straight, f"{shown} is not straight throughout its life")
            f = life.form(*tracks)
            require(f, f"{shown} vanishes throughout a piece of its life")
            inside, vanishes = zeros(f, start, end)
            within = inside or (vanishes and end is not time)
            require(not within, f"{shown} vanishes during its life")
        return vanishes

    # Step 6: a contact at a time between intervals. Just before, a short segment from a vertex to
    # what it comes to touch crosses diagonals, and shrinks to a point. So each face that it
    # crosses is not simple then, and has an angle that vanishes. The segment stays in a cluster.

    def check_clusters(self, faces: set[Face], time: Time) -> None:
        """See that there is no contact in the clusters of these faces."""
        while faces:
            todo, cluster = [faces.pop()], set[Dart]()
            while todo:
                face = set(todo.pop())
                cluster |= face
                across = {self.map.face_of[v, u] for u, v in face - self.body_darts} & faces
                todo += across
                faces -= across
            self.check_apart(cluster, time)

    def check_apart(self, cluster: set[Dart], time: Time) -> None:
        """See that no vertex of a cluster is on another one, or on a body edge.

        Vertices are put in order: by abscissas at that time, where these are equal by
        ordinates. Then those that coincide are neighbours; and on an edge are those that
        come between its ends and are on its line.
        """
        tracks = self.scene.tracks_at({v for v, _ in cluster}, time)

        def order(u: int, v: int) -> int:
            x, y = vector_of(tracks[v], tracks[u])
            return time.sign_of(x) or time.sign_of(y)

        path = sorted(tracks, key=cmp_to_key(order))
        rank = {v: i for i, v in enumerate(path)}
        for u, v in pairwise(path):
            require(order(u, v), f"vertices {u} and {v} coincide at t = {time}")
        for u, w in cluster & self.body_darts:
            first, last = sorted((rank[u], rank[w]))
            for v in path[first + 1 : last]:
                turn = time.sign_of(orientation_of(tracks[u], tracks[v], tracks[w]))
                require(turn, f"vertex {v} is on the edge {u} {w} at t = {time}")

    # Step 8: the contact.

    def check_contact(self, words: list[str], time: Time) -> str:
        """See that the contact is there at a time; what it is, in words."""
        scene, kind = self.scene, " ".join(w for w in words if w.isalpha())
        numbers = [w for w in words if not w.isalpha()]
        if kind == "vertex inside":
            require(int(numbers[1]) < len(scene.bodies), f"there is no body {numbers[1]}")
            numbers[1:] = map(str, scene.bodies[int(numbers[1])].vertices)
        v = self.vertices(numbers)
        tracks, body, other = scene.tracks_at(v, time), scene.of(v[0]), scene.of(v[-1])
        p = [tracks[u] for u in v]
        edges = {(v[-2], v[-1]), (v[0], v[1])} if kind == "edge edge" else {(v[-2], v[-1])}
        at_start = time.compare_rational(scene.start) == 0 and body is not other
        if kind == "vertex vertex":
            there = v[0] != v[1] and is_on(time, p[0], p[1], p[1])
        elif kind == "vertex edge":
            there = edges <= self.body_darts and v[0] not in v[1:] and is_on(time, *p)
        elif kind == "edge edge":
            there = at_start and edges <= self.body_darts and meet(time, *p)
        else:
            place = {u: scene.at(u, scene.start) for u in v}
            rings = [[place[u] for u in ring] for ring, _ in other.rings]
            inside = sum(surrounds(ring, place[v[0]]) for ring in rings) % 2
            there = bool(inside and at_start and other.closed)
        require(there, f"there is no such contact at t = {time}: {' '.join(words)}")
        names = [f"{scene.of(u).name} vertex {u - scene.of(u).first}" for u in v]
        one = f"the edge {names[0]} - {names[1]}" if kind == "edge edge" else names[0]
        two = f"the edge {names[-2]} - {names[-1]}" if kind.endswith("edge") else names[-1]
        return f"{one} with {f'the inside of {other.name}' if kind == 'vertex inside' else two}"


# ---- The file.

R, V = r"-?[0-9]+(/[0-9]*[1-9][0-9]*)?", "[0-9]{1,9}"  # a rational, and a vertex or body
TIME = f"{R} {R}( @( {V}){{2,3}}|( -?[0-9]+)*)"
ITEM = f" -( {V}){{2}}| =( {V}){{2}}| [+]( {V}){{4}}"
WHAT = f"vertex {V} (vertex|inside|edge {V}) {V}|edge {V} {V} edge {V} {V}"
FORMS = {  # of lines, by their first words
    "exactpt-proof": "exactpt-proof 1",
    "scene": "scene sha256 [^ ]+",
    "span": f"span {R} {R}",
    **{kind: f"{kind}( {V})+" for kind in ("face", "inside", "outer")},
    "event": f"event {TIME}({ITEM})*",
    "contact": f"contact {TIME} ({WHAT})",
    "none": "none",
}
STARTS = ("-", "+", "=", "vertex", "edge")  # of what follows the time in a line
ORDER = "exactpt-proof scene span( face| inside| outer)*( event)* (contact|none)"


def read(proof: bytes) -> list[tuple[int, list[str]]]:
    """The numbers and words of the lines of a proof, all of which are in the format."""
    rows = []
    for i, line in enumerate(proof.decode().split("\n"), 1):
        words = re.findall(r"[^ \t\r]+", line)
        if words and not line.startswith("#"):
            if not re.fullmatch(FORMS.get(words[0], "none"), " ".join(words)):
                raise NoProofError(f"line {i} is not in the format")
            rows.append((i, words))
    if not re.fullmatch(ORDER, " ".join(words[0] for _, words in rows)):
        raise NoProofError("the file is no proof, or the order of its lines is another one")
    return rows


def check(scene_file: bytes, proof_file: bytes) -> Proved:
    """Check a proof; what it proves. Raises `Rejected`, or `NoProofError`."""
    digits = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(0)  # the numbers of a scene are as long as its writer likes
    try:
        return check_files(scene_file, proof_file)
    finally:
        sys.set_int_max_str_digits(digits)


def check_files(scene_file: bytes, proof_file: bytes) -> Proved:
    """Check a proof whose numbers may have any length."""
    try:
        rows, text = read(proof_file), scene_file.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise NoProofError("a file is not UTF-8") from None
    if rows[1][1][2] != hashlib.sha256(scene_file).hexdigest():
        raise NoProofError("the proof is of another scene: the hash of its file is another one")
    checker = Checker(Scene(text))
    try:
        return checker.check_rows(rows[2:])
    except Rejected as verdict:
        raise Rejected(f"rejected: line {checker.line}: {verdict}") from None


USAGE = "usage: python3 -I proof_check.py SCENE PROOF [--until T | --partial]"


def main(arguments: list[str]) -> int:
    """Check a file; the exit code."""
    try:
        paths, until = arguments[:2], arguments[2:]
        wanted = until == ["--partial"] or (len(until) == 2 and until[0] == "--until")
        if len(paths) != 2 or (until and not wanted):
            raise NoProofError(USAGE)
        if until[1:] and not re.fullmatch(R, until[1]):
            raise NoProofError(f"--until: not a number, p or p/q: {until[1]!r:.60}")
        with open(paths[0], "rb") as scene, open(paths[1], "rb") as proof:
            proved = check(scene.read(), proof.read())
        least = Fraction(until[1]) if until[1:] else None if until else inf
        if least is not None and not proved.whole and proved.until < least:
            raise Rejected(f"rejected: proved up to t = {proved.until} only (see --partial)")
        return say(proved, 0, sys.stdout)
    except Rejected as verdict:
        return say(str(verdict), 1, sys.stdout)
    except (NoProofError, OSError) as error:
        return say(str(error), 2, sys.stderr)


def say(text: str, code: int, file: TextIO) -> int:
    """Print a line in ASCII, with escapes: names may hold controls for a terminal."""
    shown = (c if c.isascii() and c.isprintable() else ascii(c)[1:-1] for c in text)
    file.write("".join(shown) + "\n")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
