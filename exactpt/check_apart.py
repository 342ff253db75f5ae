"""Checks a certificate that no two bodies of a scene share a point in [a, L], and that two do by H.

    python3 -I check_apart.py SCENE CERTIFICATE [--until T | --partial] [--work N]

This file imports the standard library alone, and uses no floats. The statement, the file format
and the complete argument are in docs/proofs.md, Certificates. The reader of scenes is a copy of
that of proof_check.py without its comments.

An item is an edge of a body, or its only vertex. A node of the certificate shows that items of
two bodies that count have no common point in [s, e] (with a distance D: are farther apart):
    t [Q]            the nodes of [s, Q] and of [Q, e]; Q is the middle if it is missing
    c NX NY C [V]    by the moving line n.p = C + V t: the nodes of all items that are not certain
                     to be above it, and of all that are not certain to be below it
    s BODY K         the nodes of all items without the items >= K of this body, and without the
                     others of this body
Nodes are in prefix order; those without two bodies that count are not written. A vertex with its
time is in the convex hull of a few points (`hull`), so a line in motion is a plane.

Exit code: 0 accepted, 1 rejected, or not the statement that was wanted, 2 no certificate of this scene, 4 not
decided: the budget of work is used up.
"""

import sys

if __name__ == "__main__" and not sys.flags.isolated:
    sys.stderr.write(
        "run it as python3 -I FILE SCENE CERTIFICATE: without -I, files nearby take part\n"
    )
    sys.exit(2)

import hashlib
import json
import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import accumulate, pairwise, zip_longest
from math import comb, floor, gcd, isqrt, lcm
from pathlib import Path
from typing import Any, TextIO, TypeVar

# fmt: off
# ---- Copied from proof_check.py, by .ci/copy_reader.py.
Point = tuple[Fraction, Fraction]
Dart = tuple[int, int]
Json = Any
class NoProofError(Exception): pass
class Rejected(Exception): pass
class Exhausted(Exception): pass
class Work:
    usual = left = 5 * 10 ** 8
    def start(self, work: int | None, files: int) -> None:
        self.left = self.usual + 2000 * files if work is None else work
    def spend(self, products: int) -> None:
        self.left -= products
        if self.left < 0: raise Exhausted('not decided: the budget of work is used up (see --work)')
WORK = Work()
def require(condition: object, why: str) -> None:
    if not condition: raise Rejected(why)
def words(n: int) -> int: return (n.numerator.bit_length() + n.denominator.bit_length() >> 6) + 1
def most_words(f: Iterable[Any]) -> int: return max(map(words, f), default=1)
class Poly(tuple[Any, ...]):
    def __new__(cls, coefficients: Iterable[Any]=()) -> 'Poly':
        f = list(coefficients)
        while f and (not f[-1]): f.pop()
        return super().__new__(cls, f)
    def __add__(self, g: 'Poly') -> 'Poly': return Poly([a + b for a, b in zip_longest(self, g, fillvalue=0)])
    def __sub__(self, g: 'Poly') -> 'Poly': return Poly([a - b for a, b in zip_longest(self, g, fillvalue=0)])
    def __mul__(self, g: 'Poly') -> 'Poly':
        if len(self) == 1: return g if self[0] == 1 else Poly([self[0] * b for b in g])
        if len(self) * len(g) > 8: WORK.spend(len(self) * len(g) * most_words(self) * most_words(g))
        product = [0] * (len(self) + len(g) - 1) if self and g else []
        for i, a in enumerate(self):
            for j, b in enumerate(g): product[i + j] += a * b
        return Poly(product)
    def scaled(self, t: Fraction) -> tuple[int, int]:
        n, d, power, total = (t.numerator, t.denominator, 1, 0)
        if (n | d) >> 64: WORK.spend(len(self) ** 2 * words(d) * (words(n) + most_words(self)))
        for c in reversed(self):
            total = total * n + c * power; power *= d
        WORK.spend(len(self) * words(total)); return (total * d, power)
    def value(self, t: Fraction) -> Fraction: return Fraction(*self.scaled(t))
    def along(self, a: Fraction, b: Fraction) -> 'Poly':
        f, n = (Poly(), len(self)); WORK.spend(n * n * (300 + 2 * (most_words(self) + n * most_words((a, b))) ** 2))
        for c in reversed(self): f = f * Poly([a, b - a]) + Poly([c])
        return f
    def derivative(self) -> 'Poly': return Poly([i * c for i, c in enumerate(self)][1:])
    def bound(self, a: Fraction, b: Fraction) -> Fraction:
        f = self.along(a, b); n, found = (len(f) - 1, Fraction(0))
        WORK.spend(len(f) ** 2 * (300 + 2 * most_words(f) ** 2))
        for j in range(n + 1):
            c = sum((c * comb(j, i) / comb(n, i) for i, c in enumerate(f[:j + 1])), Fraction(0))
            found = max(found, abs(c))
        return found
Track = tuple[Poly, Poly, Poly]
Whole = tuple[int, int, int]
Entry = TypeVar('Entry', int, Poly)
Triple = tuple[Entry, Entry, Entry]
Turn = tuple[Poly, Point, Json]
def vector_of(a: Triple[Entry], b: Triple[Entry]) -> tuple[Entry, Entry]:
    return (b[0] * a[2] - a[0] * b[2], b[1] * a[2] - a[1] * b[2])
def turn(a: Triple[Entry], b: Triple[Entry], c: Triple[Entry]) -> Entry:
    f = a[0] * (b[1] * c[2] - c[1] * b[2]) + b[0] * (c[1] * a[2] - a[1] * c[2])
    return f + c[0] * (a[1] * b[2] - b[1] * a[2])
def dot_of(a: Triple[Entry], v: Triple[Entry], b: Triple[Entry]) -> Entry:
    (px, py), (qx, qy) = (vector_of(v, a), vector_of(v, b)); return px * qx + py * qy
def whole(p: Point) -> Whole:
    w = lcm(p[0].denominator, p[1].denominator); x, y = (c.numerator * (w // c.denominator) for c in p)
    return (x, y, w)
def meet(a: Whole, b: Whole, c: Whole, d: Whole) -> bool:
    p, q, r, s = (turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b))
    if (p > 0 > q or p < 0 < q) and (r > 0 > s or r < 0 < s): return True
    ends = ((p, c, a, b), (q, d, a, b), (r, a, c, d), (s, b, c, d))
    return any((f == 0 and dot_of(x, v, y) <= 0 for f, v, x, y in ends))
def is_simple(places: Sequence[Point], edges: Iterable[Dart], first: int) -> bool:
    points = [whole(p) for p in places]; spans = []
    for u, v in edges:
        (x, y), (z, w) = (places[u - first], places[v - first])
        if (x, y) == (z, w): return False
        spans.append((min(x, z), max(x, z), min(y, w), max(y, w), u - first, v - first))
    spans.sort()
    for k, (_, right, bottom, top, a, b) in enumerate(spans):
        for j in range(k + 1, len(spans)):
            left, _, low, high, c, d = spans[j]
            if left > right: break
            WORK.spend(200)
            if low > top or high < bottom: continue
            WORK.spend(2000)
            if b == c or d == a:
                p, q, r = (points[i] for i in ((a, b, d) if b == c else (c, d, b)))
                if turn(p, q, r) == 0 and dot_of(p, q, r) >= 0: return False
            elif meet(points[a], points[b], points[c], points[d]): return False
    return True
def surrounds(ring: Sequence[Point], p: Point) -> bool:
    odd = False; WORK.spend(300 * len(ring))
    for a, b in pairwise([*ring, *ring[:1]]):
        if (a[1] > p[1]) != (b[1] > p[1]): odd ^= a[0] + (p[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]) > p[0]
    return odd
NUMBER = re.compile('([+-]?\\d++)(?:/(\\d++))?|([+-]?)(\\d*+)\\.?(\\d*+)(?:[eE]([+-]?\\d{1,18}))?', re.ASCII)
MOST_BITS = 33220
MOST_DIGITS = 10000
MOST_DEGREE = 64
class Bare(str): __slots__ = ()
def need(condition: object, what: str, data: Json='') -> None:
    if not condition: raise NoProofError(f'the scene: {what} {data!r:.60}')
def number(data: Json) -> Fraction:
    is_short = isinstance(data, str) and len(data) <= 3 * MOST_DIGITS
    match = NUMBER.fullmatch(data) if is_short else None
    if match is None: raise NoProofError(f'the scene: not a number: {data!r:.60}')
    whole, under, minus, units, decimals, exponent = match.groups()
    if whole is not None:
        need(under is None or under.strip('0'), 'a denominator is zero:', data)
        q = Fraction(int(whole), int(under or 1))
    else:
        need(units or decimals, 'not a number:', data); power, n = (int(exponent or 0), int(minus + units + decimals))
        need(abs(power) <= 100000, 'an exponent beyond 100,000:', data); power = power - len(decimals) if n else 0
        q = Fraction(n * 10 ** power) if power >= 0 else Fraction(n, 10 ** (-power))
    bits = max(q.numerator.bit_length(), q.denominator.bit_length())
    need(bits <= MOST_BITS, 'more than 10,000 digits:', data); return q
def keys(data: Json, required: Sequence[str]=(), optional: Sequence[str]=()) -> dict[str, Json]:
    known = isinstance(data, dict) and set(required) <= set(data) <= {*required, *optional}
    need(known, f'not an object with {required}, {optional}:', data); return dict(data)
def entries(data: Json, length: int | None=None) -> list[Json]:
    need(isinstance(data, list) and length in (None, len(data)), 'not a list as needed:', data); return list(data)
def check_json(data: Json, levels: int) -> None:
    need(not isinstance(data, float), 'a number that JSON has not:', data)
    is_text = not isinstance(data, str) or not re.search('[\ud800-\udfff]', data)
    need(is_text, 'an unpaired surrogate:', data)
    if isinstance(data, (dict, list)):
        need(levels, 'nested too deeply:', None)
        for value in [*data, *data.values()] if isinstance(data, dict) else data: check_json(value, levels - 1)
def polynomial(data: Json) -> Poly: return Poly([number(c) for c in entries(data)])
def degree(*polynomials: Poly) -> int: return max(1, *map(len, polynomials)) - 1
class Motion:
    def __init__(self, data: Json, of_shape: int) -> None:
        one, zero = (c_(Fraction(1)), Poly()); self.rigid: Turn | None = None
        kind = next((k for k in ('rigid', 'affine') if isinstance(data, dict) and k in data), '')
        optional = ['pivot', 'orientation'] if kind == 'rigid' else []
        required = {'rigid': ['half_turn'], 'affine': ['matrix'], '': []}[kind]
        given = keys(keys(data, [kind])[kind] if kind else data, required, ['x', 'y', *optional])
        x, y = (polynomial(given.get(k, [])) for k in 'xy')
        m, high = ([one, zero, zero, one], max(of_shape, degree(x, y)))
        if kind == 'affine':
            m = [polynomial(p) for row in entries(given['matrix'], 2) for p in entries(row, 2)]
            high = max(of_shape + degree(*m), degree(x, y))
        h = polynomial(given.get('half_turn', []))
        need(high + 2 * degree(h) <= MOST_DEGREE, f'a degree above {MOST_DEGREE}')
        self.keeps_lengths, self.form = (kind != 'affine', (*m, x, y, one))
        if kind == 'rigid':
            c, s = turned = point(given.get('orientation', ['1', '0']))
            need(c * c + s * s == 1, 'an orientation that is no unit vector:', data)
            p, q = map(c_, point(given.get('pivot', ['0', '0']))); self.rigid = (h, turned, (p, q, x, y))
            w, cosine, sine = (one + h * h, one - h * h, h + h)
            a, b = (cosine * c_(c) - sine * c_(s), sine * c_(c) + cosine * c_(s))
            e, f = (w * (p + x) - a * p + b * q, w * (q + y) - b * p - a * q); self.form = (a, zero - b, b, a, e, f, w)
        self.cost = sum((len(f) * (300 + 2 * most_words(f) ** 2) for f in self.form))
    def at(self, t: Fraction) -> tuple[Fraction, ...]:
        *values, w = (f.value(t) for f in self.form); return tuple((v / w for v in values))
    def track(self, x: Poly, y: Poly) -> Track:
        WORK.spend(self.cost * (len(x) + len(y))); a, b, c, d, e, f, w = self.form
        found = (a * x + b * y + e, c * x + d * y + f, w); m = lcm(*(q.denominator for g in found for q in g))
        whole = [[k.numerator * (m // k.denominator) for k in g] for g in found]
        m = gcd(*(k for g in whole for k in g)); x, y, w = (Poly([k // m for k in g]) for g in whole); return (x, y, w)
def c_(value: Fraction) -> Poly: return Poly([value])
class Body:
    def __init__(self, data: Json, first: int, start: Fraction) -> None:
        shape = ('vertices', 'keyframes', 'parts')
        body = keys(data, ['name'], ['motion', 'closed', 'holes', 'radius', 'properties', *shape])
        need(sum((key in body for key in shape)) == 1, 'vertices or keyframes or parts:', data)
        need('holes' not in body or 'vertices' in body, 'holes without vertices:', data)
        self.name, closed = (body['name'], body.get('closed', True))
        is_text = isinstance(self.name, str) and (not isinstance(self.name, Bare)) and self.name
        need(is_text and (not re.search('[\ud800-\udfff]', self.name)), 'a name:', self.name)
        need(isinstance(closed, bool), 'closed:', closed); self.radius = number(body.get('radius', '0'))
        need(self.radius >= 0, 'a radius:', body.get('radius'))
        need(isinstance(body.get('properties', {}), dict), 'properties:', self.name)
        check_json(body.get('properties'), 29)
        parts = [keys(p, ['vertices'], ['holes']) for p in entries(body.get('parts', []))]
        need(parts or 'parts' not in body, 'no parts:', data)
        rings = [[entries(r) for r in (part.get('vertices', []), *entries(part.get('holes', [])))] for part in parts or [body]]
        flat = [ring for part in rings for ring in part]; several = 'parts' in body or len(flat) > 1
        need(not several or (closed and min(map(len, flat)) > 2), 'rings:', data)
        self.shape: list[tuple[Poly, Poly]] = []; self.frames: list[tuple[Fraction, list[Point]]] = []
        if 'keyframes' in body: self.frames = keyframes(body['keyframes'])
        else: self.shape = [vertex(data) for ring in flat for data in ring]
        self.first, self.size = (first, len(self.frames[0][1] if self.frames else self.shape))
        need(self.size, 'no vertices:', self.name); self.read_motion(body.get('motion', {}))
        self.vertices, self.closed = (range(first, first + self.size), closed and self.size > 2)
        self.breaks = sorted({*self.ends, *(t for t, _ in self.frames)}); self.parts = list[list[range]]()
        for part in rings if several else [[self.vertices]]:
            bounds = accumulate(map(len, part), initial=first)
            self.parts.append([range(i, j) for i, j in pairwise(bounds)]); first = self.parts[-1][-1].stop
        self.rings = [(ring, k > 0) for part in self.parts for k, ring in enumerate(part)]
        self.edges = [edge for ring, _ in self.rings for edge in [*pairwise(ring), *[(ring[-1], ring[0])][:self.closed]]]
        self.tracks: dict[tuple[int, int], Track] = {}; self.check_simple(self.places(start))
    def read_motion(self, data: Json) -> None:
        of_shape = 1 if self.frames else degree(*(f for pair in self.shape for f in pair))
        rows, given = ([{'motion': data}], dict[str, Json]())
        if isinstance(data, dict) and 'pieces' in data:
            given = keys(data, ['pieces'], ['spin', 'path']); need(len(given) < 3, 'both a spin and a path:', data)
            rows = [keys(p, ['motion'], ['until']) for p in entries(given['pieces'])]
        whole = rows and 'until' not in rows[-1] and all(('until' in p for p in rows[:-1]))
        need(whole, '"until" belongs to all pieces but the last:', data)
        self.ends = [number(p['until']) for p in rows[:-1]]
        need(all((s < t for s, t in pairwise(self.ends))), 'pieces not in order:', data)
        self.motions = [Motion(p['motion'], of_shape) for p in rows]
        for t, (before, after) in zip(self.ends, pairwise(self.motions), strict=True):
            same = before.at(t) == after.at(t) or self.places(t, before) == self.places(t, after)
            need(same, f'{self.name!a} jumps at t = {t}')
        for name, shows in (('spin', turns_by), ('path', follows)):
            right = name not in given or shows(self.ends, self.motions, given[name])
            need(right, f'not such a {name}:', data)
    def coordinates(self, i: int, t: Fraction) -> tuple[Poly, Poly]:
        if not self.frames: return self.shape[i]
        k = bisect_right(self.frames, t, key=lambda frame: frame[0])
        (s, p), (e, q) = (self.frames[max(k - 1, 0)], self.frames[min(k, len(self.frames) - 1)])
        x, y = (line(s, e, a, b) for a, b in zip(p[i], q[i], strict=True)); return (x, y)
    def places(self, t: Fraction, motion: Motion | None=None) -> list[Point]:
        WORK.spend(1000 * self.size); a, b, c, d, e, f = (motion or self.motions[bisect_right(self.ends, t)]).at(t)
        shape = (self.coordinates(i, t) for i in range(self.size))
        points = ((x.value(t), y.value(t)) for x, y in shape)
        return [(a * x + b * y + e, c * x + d * y + f) for x, y in points]
    def check_simple(self, places: Sequence[Point]) -> None:
        need(is_simple(places, self.edges, self.first), f'{self.name!a} is not simple at the start')
        if len(self.rings) == 1: return
        outlines = {ring: [places[v - self.first] for v in ring] for ring, _ in self.rings}
        def is_in(ring: range, other: range) -> bool: return surrounds(outlines[other], outlines[ring][0])
        for one, *holes in self.parts:
            wrong = any((not is_in(k, one) for k in holes))
            wrong |= any((is_in(k, m) for k in holes for m in holes if k != m))
            for other, *others in self.parts:
                within = other != one and is_in(one, other)
                wrong |= within and (not any((is_in(one, hole) for hole in others)))
            need(not wrong, f'{self.name!a}: a hole or part is where none can be')
    def track(self, i: int, after: Fraction) -> Track:
        key = (i, bisect_right(self.breaks, after))
        if key not in self.tracks:
            motion = self.motions[bisect_right(self.ends, after)]
            self.tracks[key] = motion.track(*self.coordinates(i, after))
        return self.tracks[key]
def line(s: Fraction, e: Fraction, a: Fraction, b: Fraction) -> Poly:
    slope = (b - a) / (e - s) if a != b else Fraction(0); return Poly([a - slope * s, slope])
def point(data: Json) -> Point:
    x, y = map(number, entries(data, 2)); return (x, y)
def vertex(data: Json) -> tuple[Poly, Poly]:
    if isinstance(data, dict):
        given = keys(data, optional=['x', 'y'])
        return (polynomial(given.get('x', [])), polynomial(given.get('y', [])))
    x, y = point(data); return (c_(x), c_(y))
def keyframes(data: Json) -> list[tuple[Fraction, list[Point]]]:
    frames = [keys(f, ['t', 'vertices']) for f in entries(data)]
    path = [(number(f['t']), [*map(point, entries(f['vertices']))]) for f in frames]
    need(len({len(points) for _, points in path}) == 1, 'keyframes:', data)
    need(all((s < t for (s, _), (t, _) in pairwise(path))), 'keyframes not in order:', data); return path
SAMPLES, MOST_ANGLE_BITS = (8, 512)
Bounds = tuple[Fraction, Fraction]
def turns_by(ends: Sequence[Fraction], motions: Sequence[Motion], data: Json) -> bool:
    omega, error = map(number, keys(data, ['error', 'omega']).values())
    turns = [motion.rigid for motion in motions if motion.rigid]
    if error <= 0 or len(turns) < max(len(motions), 3): return False
    if degree(turns[0][0], turns[-1][0]) > 0 or any((turn[2] != turns[0][2] for turn in turns)): return False
    spans = zip(turns[1:-1], pairwise(ends), strict=True)
    return all((turns_in(turn, span, omega, error) for turn, span in spans))
def turns_in(turn: Turn, span: Bounds, omega: Fraction, error: Fraction) -> bool:
    (h, turned, _), (a, b) = (turn, span)
    slope = Poly([2 * i * c for i, c in enumerate(h)][1:]) - c_(omega) * (c_(Fraction(1)) + h * h)
    between = slope.bound(a, b) * (b - a) / (2 * SAMPLES)
    times = [a + (b - a) * i / SAMPLES for i in range(SAMPLES + 1)]
    bits = bits_for(error, omega * max(abs(a), abs(b)))
    if bits > MOST_ANGLE_BITS or between > error or any((abs(h.value(t)) > 1 for t in times)): return False
    (low, high), gaps = (angle_of(turned, bits + 8), list[Bounds]())
    for t in times:
        p, q = arctan(h.value(t), bits + 8); gaps.append((low + 2 * p - omega * t, high + 2 * q - omega * t))
    return largest_gap(gaps, bits + 8) + between <= error
def largest_gap(gaps: Sequence[Bounds], bits: int) -> Fraction:
    low, high = pi_bounds(bits); k = 2 * floor(gaps[0][0] / (2 * low) + Fraction(1, 2))
    least, most = sorted((k * low, k * high)); return max((max(q - least, most - p) for p, q in gaps))
def bits_for(error: Fraction, angle: Fraction) -> int:
    bits = max(8, 5 - error.numerator.bit_length() + error.denominator.bit_length())
    return bits + floor(abs(angle)).bit_length()
def follows(ends: Sequence[Fraction], motions: Sequence[Motion], data: Json) -> bool:
    path = keys(data, ['error', 'place_error', 'times', 'poses'])
    errors = (number(path['error']), number(path['place_error'])); times = [number(t) for t in entries(path['times'])]
    rows = [keys(row, ['x', 'y', 'angle']) for row in entries(path['poses'])]
    poses = [[polynomial(row[key]) for key in ('x', 'y', 'angle')] for row in rows]
    turns = [motion.rigid for motion in motions if motion.rigid]
    if not (errors[0] > 0 and errors[1] >= 0 and (len(times) == len(poses) + 1 > 1) and all((s < t for s, t in pairwise(times))) and (len(turns) == len(motions) > 2) and ((ends[0], ends[-1]) == (times[0], times[-1]))):
        return False
    for (s, t), (before, after) in zip(pairwise(times), pairwise(poses), strict=False):
        if [f.value(t - s) for f in before] != [f.value(Fraction(0)) for f in after]: return False
    for turn, span in zip(turns, pairwise([ends[0], *ends, ends[-1]]), strict=True):
        k = min(bisect_right(times, span[0]), len(poses)) - 1
        pose = [f.along(*(t - times[k] for t in span)) for f in poses[k]]
        if span[1] > times[k + 1] or not is_near(turn, span, pose, *errors): return False
    return True
def is_near(turn: Turn, span: Bounds, pose: Sequence[Poly], error: Fraction, off: Fraction) -> bool:
    (h, (c, s), (p, q, x, y)), all_of_it = (turn, (Fraction(0), Fraction(1)))
    if p or q or (span[0] == span[1] and degree(h, x, y) > 0): return False
    dx, dy, h = (x.along(*span) - pose[0], y.along(*span) - pose[1], h.along(*span))
    u, angle = (h.value(Fraction(0)), pose[2].value(Fraction(0))); bits = bits_for(error, angle)
    if bits > MOST_ANGLE_BITS or dx.bound(*all_of_it) ** 2 + dy.bound(*all_of_it) ** 2 > off ** 2: return False
    slope, parts = (h.derivative(), [Fraction(i, SAMPLES) for i in range(SAMPLES + 1)])
    rate = slope + slope - pose[2].derivative() * (c_(Fraction(1)) + h * h)
    change = Poly([0, *(f / (i + 1) for i, f in enumerate(rate))])
    cosine, sine = ((1 - u * u) / (1 + u * u), 2 * u / (1 + u * u))
    low, high = angle_of((c * cosine - s * sine, c * sine + s * cosine), bits + 8)
    at_start = largest_gap([(low - angle, high - angle)], bits + 8)
    factor = 1 + 2 * h.bound(*all_of_it) * slope.bound(*all_of_it)
    return at_start + max((change.bound(*part) for part in pairwise(parts))) * factor <= error
def angle_of(direction: Point, bits: int) -> Bounds:
    (c, s), quarters = (direction, 0)
    while c <= 0 or abs(s) > c: c, s, quarters = (s, -c, quarters + 1)
    (low, high), (p, q) = (arctan(s / (1 + c), bits), pi_bounds(bits))
    return (2 * low + quarters * p / 2, 2 * high + quarters * q / 2)
@lru_cache
def pi_bounds(bits: int) -> Bounds:
    (a, b), (c, d) = (series(Fraction(1, n), bits + 6) for n in (5, 239)); return (16 * a - 4 * d, 16 * b - 4 * c)
def arctan(x: Fraction, bits: int) -> Bounds:
    if x < 0:
        low, high = arctan(-x, bits); return (-high, -low)
    if 2 * x <= 1: return series(x, bits)
    low, high = series((1 - x) / (1 + x), bits + 1); p, q = pi_bounds(bits + 1); return (p / 4 - high, q / 4 - low)
def series(x: Fraction, bits: int) -> Bounds:
    n = bits + 16; WORK.spend(100 * n); power = floor(x * 2 ** n); square = power * power >> n; total, terms = (0, 0)
    while power:
        total += (-1) ** terms * (power // (2 * terms + 1)); power, terms = (power * square >> n, terms + 1)
    return (Fraction(total - 3 * terms - 4, 2 ** n), Fraction(total + 3 * terms + 4, 2 ** n))
class Scene:
    def __init__(self, text: str) -> None:
        def unique(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
            need(len({k for k, _ in pairs}) == len(pairs), 'a key is there twice:', pairs); return dict(pairs)
        try:
            data = json.loads(text, parse_int=Bare, parse_float=Bare, object_pairs_hook=unique); self.read(data)
        except (ValueError, RecursionError) as error:
            raise NoProofError(f'the scene is not JSON, or nested too deeply: {error}') from None
        self.known: tuple[Fraction, dict[int, Point]] = (self.start, {})
    def read(self, data: Json) -> None:
        top = keys(data, ['exactpt', 'time', 'bodies']); version = top['exactpt']
        need(version == '1' and isinstance(version, Bare), 'not of format 1:', version)
        self.start, self.end = point(top['time']); need(self.start < self.end, 'an empty time span:', top['time'])
        self.bodies: list[Body] = []; self.body_of: list[int] = []
        for i, entry in enumerate(entries(top['bodies'])):
            self.bodies.append(Body(entry, len(self.body_of), self.start)); self.body_of += [i] * self.bodies[-1].size
        need(len({body.name for body in self.bodies}) == len(self.bodies), 'a name is there twice')
    def of(self, v: int) -> Body: return self.bodies[self.body_of[v]]
    def track(self, v: int, after: Fraction) -> Track:
        body = self.of(v); return body.track(v - body.first, after)
    def at(self, v: int, t: Fraction) -> Point:
        if self.known[0] != t: self.known = (t, {})
        if v not in self.known[1]:
            x, y, w = (f.value(t) for f in self.track(v, t)); self.known[1][v] = (x / w, y / w)
        return self.known[1][v]
MOST_BYTES, MOST_IN_LINE = (10 ** 9, 10 ** 8)
def is_rational(word: str) -> bool:
    over, _, under = word.removeprefix('-').partition('/')
    return bool(re.fullmatch(R, word) and max(len(over), len(under)) <= MOST_DIGITS and ('/' not in word or under.strip('0')))
def read(proof: bytes) -> list[tuple[int, list[str]]]:
    rows = []
    for i, line in enumerate(proof.decode().split('\n'), 1):
        if len(line) > MOST_IN_LINE: raise NoProofError(f'line {i} is too long')
        row = re.findall('[^ \\t\\r]+', line)
        if row and (not line.startswith('#')):
            form = FORMS.get(row[0], 'none')
            if not re.fullmatch(form, ' '.join(row)) or not is_bounded(row):
                raise NoProofError(f'line {i} is not in the format')
            rows.append((i, row))
    if not re.fullmatch(ORDER, ' '.join((row[0] for _, row in rows))):
        raise NoProofError('the file is no proof, or the order of its lines is another one')
    return rows
def file_bytes(path: Path) -> bytes:
    with path.open('rb') as file: return file.read(MOST_BYTES + 1)
def say(text: str, code: int, file: TextIO) -> int:
    shown = (c if c.isascii() and c.isprintable() else ascii(c)[1:-1] for c in text); file.write(''.join(shown) + '\n')
    return code
# ---- End of the copy.
# fmt: on

R, V, Z = r"-?[0-9]++(/[0-9]++)?", "[0-9]{1,9}", "-?[0-9]++"  # a rational, a number, an integer
FORMS = {  # of lines, by their first words
    "exactpt-apart": "exactpt-apart 1",
    "scene": "scene sha256 [^ ]+",
    "span": f"span {R} {R}",
    "between": f"between {V} {V}",
    "ignoring": f"ignoring {V}( {V})+",
    "distance": f"distance {R}",
    "t": f"t( {R})?",
    "c": f"c {Z} {Z} {R}( {R})?",
    "s": f"s {V} {V}",
    "none": "none",
    "meet": f"meet {R} {V} {V}",
    "inside": f"inside {R} {V} {V}",
    "cross": f"cross {R} {R} {V} {V}",
}
ORDER = "exactpt-apart scene span( between)*+( ignoring)*+( distance)?( [tcs](?= ))*+ (none|meet|inside|cross)"
Hull = list[tuple[int, int, int, int]]


def is_bounded(row: list[str]) -> bool:
    """Return True if the numbers of a line are small enough."""
    return row[0] in ("exactpt-apart", "scene") or all(map(is_rational, row[1:]))


class Interval:
    """A closed interval of time, and hulls of paths of vertices in it."""

    def __init__(self, start: Fraction, end: Fraction) -> None:
        self.start, self.end, self.hulls = start, end, dict[int, Hull]()
        self.grid = on_grid(start, end)

    def hull(self, scene: Scene, v: int) -> Hull:
        """The points of `hull` of all pieces of a vertex's path."""
        if v not in self.hulls:
            breaks = scene.of(v).breaks
            inside = [q for q in breaks if self.start < q < self.end] if breaks else []
            if inside:
                times = pairwise([self.start, *inside, self.end])
                pieces = [hull(scene.track(v, s), *on_grid(s, e)) for s, e in times]
                self.hulls[v] = [p for points in pieces for p in points]
            else:
                self.hulls[v] = hull(scene.track(v, self.start), *self.grid)
        return self.hulls[v]


def on_grid(s: Fraction, e: Fraction) -> tuple[int, int, int]:
    """Return integers a, b, m with s = a / m and e = b / m."""
    m = lcm(s.denominator, e.denominator)
    return int(s * m), int(e * m), m


def spread(f: Poly, d: int, a: int, b: int, m: int) -> list[int]:
    """Return positive multiples of the coefficients of f in the Bernstein basis of [a / m, b / m].

    They are those of (1 - u)^(d - k) u^k in m^d f(t), t = (a (1 - u) + b u) / m, by Horner's rule.
    """
    c = [*f, *[0] * (d + 1 - len(f))]
    if d < 2:
        return [c[0] * m + c[1] * a, c[0] * m + c[1] * b] if d else c
    WORK.spend(d * d * most_words((a, b, m)) * (most_words(c) + d * most_words((a, b, m))))
    g, power = [c[d]], 1
    for j in range(1, d + 1):
        power *= m
        g = [a * p + b * q for p, q in zip([*g, 0], [0, *g], strict=True)]
        g = [p + c[d - j] * power * comb(j, k) for k, p in enumerate(g)]
    return g


def hull(track: Track, a: int, b: int, m: int) -> Hull:
    """Return (w x, w y, w t, w) of points (x, y, t) whose convex hull has a path in [a / m, b / m].

    For each linear f, the values w f(x, y, t) are positive multiples of the coefficients in the
    Bernstein basis of the interval of a polynomial: of f along the path, times its denominator.
    Its degree is that of the track plus 1. (Where a w is not positive there is no such point, but
    these multiples have that meaning.)
    """
    d = max(map(len, track)) - 1
    WORK.spend(8 + words(a) + words(b) + words(m))
    x, y, w = (spread(f, d, a, b, m) for f in track)
    return [
        (m * (p + q), m * (r + s), a * t + b * u, m * (t + u))
        for p, q, r, s, t, u in zip(
            [*x, 0], [0, *x], [*y, 0], [0, *y], [*w, 0], [0, *w], strict=True
        )
    ]


def planes_of(
    x: int, y: int, c: Fraction, v: Fraction, r: Fraction, far: Fraction
) -> list[list[int]]:
    """Two linear forms of (w x, w y, w t, w): below the first one, and not below the second one,
    paths are farther than r from a moving line on both sides, and than r + far on the second.
    """
    norm = Fraction(isqrt((x * x + y * y) << 128) + 1, 1 << 64)  # more than the length of (x, y)
    limits = (c - norm * r, c + norm * (r + far)) if r or far else (c, c)
    d = lcm(v.denominator, *(q.denominator for q in limits))
    return [[d * x, d * y, int(-d * v), int(-d * q)] for q in limits]


def side_of(points: Hull, low: list[int], high: list[int]) -> int:
    """-1 if points are below a first plane, 1 if none of them is below a second one, else 0."""
    a, b, t, c = low
    if all(a * x + b * y + t * z + c * w < 0 for x, y, z, w in points):
        return -1
    a, b, t, c = high
    return int(all(a * x + b * y + t * z + c * w >= 0 for x, y, z, w in points))


def are_near(places: Sequence[Point], far: Fraction) -> bool:
    """Return True if the closed segments between two and two points are at most so far apart."""
    a, b, c, d = places
    if meet(*map(whole, (a, b, c, d))):
        return True
    for p, q, r in ((a, c, d), (b, c, d), (c, a, b), (d, a, b)):
        x, y, z, w = r[0] - q[0], r[1] - q[1], p[0] - q[0], p[1] - q[1]
        k = min(max((x * z + y * w) / ((x * x + y * y) or 1), Fraction(0)), Fraction(1))
        if (z - k * x) ** 2 + (w - k * y) ** 2 <= far * far:
            return True
    return False


def require_passage(tracks: Sequence[Track], s: Fraction, t: Fraction) -> None:
    """See that a vertex is on an edge at a time in [s, t].

    The sign of its orientation with the edge changes, and it is beside the edge all the time: that
    it is between the ends, strictly, excludes an edge without a length.
    """
    v, a, b = tracks
    f = turn(v, a, b)
    require(f.scaled(s)[0] * f.scaled(t)[0] <= 0, "it stays on one side of the edge")
    for g in (dot_of(v, a, b), dot_of(v, b, a)):
        beside = spread(g, max(len(g) - 1, 0), *on_grid(s, t))
        require(min(beside) > 0, "it may pass beside the edge")


class Proved(str):
    """The statement: up to ``until``, of all pairs or not; the ``whole`` scene or not."""

    until: Fraction
    is_of_all: bool
    whole: bool


class Checker:
    """Goes through a certificate. ``line`` is the one that is looked at."""

    def __init__(self, scene: Scene, rows: list[tuple[int, list[str]]]) -> None:
        self.scene, (self.line, span), self.last = scene, rows[2], rows[-1]
        self.items = [
            (i, *d) for i, b in enumerate(scene.bodies) for d in b.edges or [(b.first,) * 2]
        ]
        self.start, self.until = Fraction(span[1]), Fraction(span[2])
        require(scene.start <= self.start <= self.until <= scene.end, "not a span of the scene")
        self.distance, self.group, self.named = (
            Fraction(0),
            [*range(len(scene.bodies))],
            set[Dart](),
        )
        self.selection, self.nodes, grouped = "", list[tuple[int, list[str]]](), set[int]()
        self.chosen = set[int]()
        for self.line, row in rows[3:-1]:
            if row[0] == "distance":
                self.distance = Fraction(row[1])
                require(self.distance >= 0, "a distance below 0")
            elif row[0] in ("between", "ignoring"):
                some = [self.index(w, self.group) for w in row[1:]]
                require(
                    len({*some}) == len(some) and not grouped & {*some}, "a body is there twice"
                )
                self.chosen |= {*some}
                self.selection += f"; {row[0]} {' '.join(f'b{i}' for i in some)}"
                if row[0] == "between":
                    self.named.add((min(some), max(some)))
                    continue
                grouped |= {*some}
                for i in some:
                    self.group[i] = some[0]
            else:
                self.nodes.append((self.line, row))

    def index(self, word: str, things: Sequence[Any]) -> int:
        """The number of a body, a vertex or an item."""
        require(int(word) < len(things), f"not a number from 0 to {len(things) - 1}: {word}")
        return int(word)

    def count(self, bodies: set[int]) -> bool:
        """Return True if two of these bodies are a pair that counts."""
        if not self.named:
            return len({self.group[i] for i in bodies}) > 1
        return any(self.group[i] != self.group[j] for i, j in self.named if {i, j} <= bodies)

    def check_apart(self) -> None:
        """See that no two items of bodies that count have a common point from start to end."""
        nodes, todo = (
            iter(self.nodes),
            [([*range(len(self.items))], Interval(self.start, self.until))],
        )
        while todo:
            items, time = todo.pop()
            WORK.spend(20 * (len(items) + len(self.named)))
            if not self.count({self.items[i][0] for i in items}):
                continue
            self.line, row = next(nodes, (self.last[0], ["none"]))
            require(row != ["none"], "a node is missing: two bodies are left together")
            if row[0] == "t":
                q = Fraction(row[1]) if len(row) > 1 else (time.start + time.end) / 2
                require(
                    time.start < q < time.end, f"{q} is not between {time.start} and {time.end}"
                )
                todo += [(items, Interval(q, time.end)), (items, Interval(time.start, q))]
                continue
            if row[0] == "c":
                below, above = self.beyond(items, row, time)
            else:
                body, k = self.index(row[1], self.group), int(row[2])
                below = {i for i in items if self.items[i][0] == body and i < k}
                above = {i for i in items if self.items[i][0] == body and i >= k}
            todo += [([i for i in items if i not in out], time) for out in (below, above)]
        require(next(nodes, None) is None, "there are more nodes than are needed")

    def beyond(self, items: list[int], row: list[str], time: Interval) -> tuple[set[int], set[int]]:
        """The items that are below a moving line, and those above it by more than the distance."""
        line = int(row[1]), int(row[2]), Fraction(row[3]), Fraction([*row, "0"][4])
        require(line[:2] != (0, 0), "a line without a direction")
        sides, planes = dict[int, int](), dict[Fraction, list[list[int]]]()
        for body, *ends in (self.items[i] for i in items):
            r = self.scene.bodies[body].radius
            if r not in planes:
                planes[r] = planes_of(*line, r, self.distance)
            for u in ends:
                if u not in sides:
                    points = time.hull(self.scene, u)
                    WORK.spend(len(points) * 4 * words(points[0][3]) * words(planes[r][0][3]))
                    sides[u] = side_of(points, *planes[r])
        found = [
            {i for i in items if {sides[u] for u in self.items[i][1:]} == {k}} for k in (-1, 1)
        ]
        return found[0], found[1]

    def check_outside(self) -> None:
        """See that at the start no ring is inside a body that counts with its own body."""
        at = [self.scene.at(v, self.start) for v in range(len(self.scene.body_of))]
        firsts = sorted(
            (*at[ring[0]], j) for j, b in enumerate(self.scene.bodies) for ring, _ in b.rings
        )
        for i, body in enumerate(self.scene.bodies):
            xs = [at[v][0] for v in body.vertices]
            low = bisect_left(firsts, min(xs), key=lambda p: p[0])
            for x, y, j in firsts[low : bisect_right(firsts, max(xs), key=lambda p: p[0])]:
                WORK.spend(20 * len(self.named))
                if body.closed and self.count({i, j}):
                    inside = self.is_inside(body, (x, y), self.start)
                    require(not inside, f"b{j} has a ring inside b{i} at the start")

    def is_inside(self, body: Body, p: Point, t: Fraction) -> bool:
        """Return True if a ray from a point crosses the rings of a closed body an odd number of times."""
        rings = ([self.scene.at(v, t) for v in ring] for ring, _ in body.rings)
        return body.closed and sum(surrounds(ring, p) for ring in rings) % 2 == 1

    def check_contact(self, kind: str, words: list[str]) -> tuple[Fraction, str, list[int]]:
        """Check the last line: the time of a contact, its kind, and the bodies."""
        scene, times = self.scene, [Fraction(w) for w in words[:-2]]
        s, t = min(times), max(times)
        require(self.start <= s and t <= scene.end, "a time outside of the span")
        if kind == "meet":
            i, a, b = self.items[self.index(words[-2], self.items)]
            j, c, d = self.items[self.index(words[-1], self.items)]
            far = self.distance + scene.bodies[i].radius + scene.bodies[j].radius
            near = are_near([scene.at(v, t) for v in (a, b, c, d)], far)
            require(near, "these are not near each other then")
            text = f"{self.short(a)} and {self.short(c)} at t = {t}"
        else:
            v = self.index(words[-2], scene.body_of)
            i = scene.body_of[v]
            if kind == "inside":
                j = self.index(words[-1], scene.bodies)
                require(self.is_inside(scene.bodies[j], scene.at(v, t), t), "it is not inside then")
                text = f"{self.short(v)} inside b{j} at t = {t}"
            else:
                j, a, b = self.items[self.index(words[-1], self.items)]
                breaks = {q for k in (i, j) for q in scene.bodies[k].breaks if s < q < t}
                require(times == [s, t] and s < t and not breaks, "not a time of one formula")
                require_passage([scene.track(u, s) for u in (v, a, b)], s, t)
                text = f"{self.short(v)} through {self.short(a)} in [{s}, {t}]"
        require(i != j and self.count({i, j}), "bodies that do not count as a pair")
        return t, text, [i, j]

    def short(self, v: int) -> str:
        """A vertex, or the edge that begins there."""
        return f"b{self.scene.body_of[v]}.{v - self.scene.of(v).first}"

    def run(self) -> Proved:
        """Check everything, and return the statement."""
        self.line, (kind, *row) = self.last
        a, low, end, whole = self.start, self.until, self.scene.end, self.start == self.scene.start
        what = f"within {self.distance}" if self.distance else ""
        high, how, bodies = self.check_contact(kind, row) if kind != "none" else (low, "", [])
        if kind != "none" and high == a:
            require(low == a and not self.nodes, "there is a contact at the start")
            text = f"two bodies {what or 'share a point'} at the start t = {a}: {how}"
        else:
            require(kind == "none" or low < high, "a contact before the end of the span")
            self.check_outside()
            self.check_apart()
            text = f"first {f'time {what}' if what else 'contact'} of two bodies in ({low}, {high}]: {how}"
            if kind == "none":
                text = f"no two bodies {f'are {what}' if what else 'share a point'} in [{a}, {low}]"
                text = text if a < low else text.replace(f"in [{a}, {low}]", f"at t = {a}")
        rest = [f"[{self.scene.start}, {a})"] * (not whole)
        if kind == "none":
            rest += [f"({low}, {end}]"] * (low < end)
            whole = not rest
            text += ", the whole span" * whole
        if rest:
            text += f"; the span of the scene is [{self.scene.start}, {end}]: nothing is said of "
            text += " and ".join(rest)
        text += self.selection
        names = ", ".join(
            f"b{i} is {self.scene.bodies[i].name!a}" for i in sorted({*bodies, *self.chosen})
        )
        proved = Proved(text + (f" ({names})" if names else ""))
        proved.until, proved.is_of_all = high, not self.selection and a == self.scene.start
        proved.whole = not rest and proved.is_of_all
        return proved


def check(scene_file: bytes, certificate: bytes, work: int | None = None) -> Proved:
    """Check a certificate; return its statement. Raises `Rejected`, `NoProofError`, or `Exhausted`."""
    digits, line, checker, many = sys.get_int_max_str_digits(), 0, None, False
    sys.set_int_max_str_digits(0)  # lengths have bounds of their own
    WORK.start(work, len(scene_file) + len(certificate))
    try:
        need(
            max(len(scene_file), len(certificate)) <= MOST_BYTES,
            "or the certificate: too many bytes",
        )
        text, digest = scene_file.decode("utf-8-sig"), hashlib.sha256(scene_file).hexdigest()
        head = certificate[:100].decode("ascii", "replace").split("\n")
        many = head[0] == "exactpt-apart-rows 1"
        rows = [] if many else read(certificate)
        named = head[1:2] == [f"scenes sha256 {digest}"] if many else rows[1][1][2] == digest
        if not named:
            raise NoProofError("the certificate was made for a different scene: the hashes differ")
        if many:
            proved = check_rows(text.split("\n"), certificate.decode().split("\n")[2:])
        else:
            scene, line = Scene(text), rows[2][0]
            checker = Checker(scene, rows)
            proved = checker.run()
        verdict = Proved(f"accepted: {digest[:16]} {proved}")
        verdict.__dict__.update(proved.__dict__)
        return verdict
    except UnicodeDecodeError:
        raise NoProofError("a file is not UTF-8") from None
    except Rejected as why:
        where = "" if many else f"line {checker.line if checker else line}: "
        raise Rejected(f"rejected: {where}{why}") from None
    finally:
        sys.set_int_max_str_digits(digits)
        WORK.left = Work.usual


def check_rows(scenes: list[str], rows: list[str]) -> Proved:
    """Check a certificate of many scenes, a line each, with ; between its lines; or only "open"."""
    ends = [scenes.pop(), rows.pop()] if scenes and rows else ["no line"]
    need(ends == ["", ""], "or the certificate: a last line without an end:", ends)
    need(len(scenes) == len(rows), "the numbers of scenes and of rows differ:", len(rows))
    found = dict.fromkeys(("no contact", "first contact", "contact at the start", "open"), 0)
    for k, (scene, row) in enumerate(zip(scenes, rows, strict=True), 1):
        made = Scene(scene)
        if row == "open":
            found["open"] += 1
            continue
        try:
            lines = read(f"exactpt-apart 1\nscene sha256 -\n{row.replace(';', chr(10))}".encode())
            checker = Checker(made, lines)
            require(len(made.bodies) > 1 and not checker.distance, "no contacts of two bodies")
            proved = checker.run()
        except Rejected as why:
            raise Rejected(f"row {k}: {why}") from None
        require(proved.whole, f"row {k}: only a part is proved: {proved}")
        start = {"no": "no contact", "first": "first contact"}
        found[start.get(proved.split()[0], "contact at the start")] += 1
    said = ", ".join(f"{kind} in {n}" for kind, n in found.items() if n)
    proved = Proved(f"{len(rows)} rows, each of two or more bodies in the whole span: {said}")
    proved.until, proved.is_of_all, proved.whole = Fraction(0), False, not found["open"]
    return proved


USAGE = "usage: python3 -I check_apart.py SCENE CERTIFICATE [--until T | --partial] [--work N]"


def main(arguments: list[str]) -> int:
    """Check a file; the exit code."""
    paths, given, rest = list[Path](), dict[str, str](), iter(arguments)
    try:
        if arguments == ["--version"]:
            return say(hashlib.sha256(Path(__file__).read_bytes()).hexdigest(), 0, sys.stdout)
        for word in rest:
            if word in ("--partial", "--until", "--work"):
                given[word] = "" if word == "--partial" else next(rest, "-")
            else:
                paths.append(Path(word))
        until, work = given.get("--until", "0"), given.get("--work")
        fits = is_rational(until) and re.fullmatch("[0-9]{1,18}", work or "0") and len(paths) == 2
        if not fits or {"--partial", "--until"} <= {*given}:
            raise NoProofError(USAGE)
        proved = check(
            file_bytes(paths[0]), file_bytes(paths[1]), None if work is None else int(work)
        )
        is_enough = "--until" in given and proved.is_of_all and Fraction(until) <= proved.until
        is_enough |= proved.whole or "--partial" in given
        require(is_enough, f"rejected: proved is only a part (see --until, --partial): {proved}")
        return say(proved, 0, sys.stdout)
    except Rejected as verdict:
        return say(str(verdict), 1, sys.stdout)
    except Exhausted as verdict:
        return say(str(verdict), 4, sys.stdout)
    except (NoProofError, OSError, ValueError) as error:
        return say(str(error), 2, sys.stderr)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
