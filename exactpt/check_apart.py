"""Checks a certificate that no two bodies of a scene share a point in [a, L], and that two do by H.

    python3 -I check_apart.py SCENE CERTIFICATE [--until T] [--partial] [--expect ANSWER] [--work N]

It imports the standard library alone and uses no floats. docs/proofs.md, Certificates, has the
statement, the file format and the whole argument. The reader of scenes is copied from
proof_check.py, without its comments. An item is an edge of a body, or its only vertex.

Exit code: 0 accepted, 1 rejected, or not the statement that was wanted, 2 no certificate of this
scene, 4 not decided: the budget of work is used up.
"""

import sys

if __name__ == "__main__" and not sys.flags.isolated:
    sys.stderr.write("run it as python3 -I FILE SCENE CERTIFICATE: else files nearby take part\n")
    sys.exit(2)

import hashlib
import json
import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from decimal import MAX_EMAX, MAX_PREC, MIN_EMIN, Context, Decimal
from fractions import Fraction
from functools import lru_cache
from itertools import accumulate, chain, dropwhile, pairwise, zip_longest
from math import comb, gcd, isqrt, lcm
from operator import mul, not_
from pathlib import Path
from typing import Any, TextIO, TypeVar

# fmt: off
# ---- Copied from proof_check.py, by .ci/copy_reader.py.
Point = tuple[Fraction, Fraction]; Dart = tuple[int, int]; Json = Any
class NoProofError(Exception): pass
class Rejected(Exception): pass
class Exhausted(Exception): pass
class Work:
    usual = 5 * 10 ** 8
    def __init__(self, left: int) -> None: self.left = left
WORK = ContextVar[Work | None]('WORK', default=None)
def spend(products: int) -> None:
    work = WORK.get()
    if work is not None:
        work.left -= products
        if work.left < 0: raise Exhausted('not decided: the budget of work is used up (see --work)')
@contextmanager
def budget(work: int | None, files: int=0) -> Iterator[Work]:
    of_check = Work(Work.usual + 2000 * files if work is None else work); token = WORK.set(of_check)
    try: yield of_check
    finally: WORK.reset(token)
def require(condition: object, why: str) -> None:
    if not condition: raise Rejected(why)
PIECE = 640; EXACT = Context(prec=MAX_PREC, Emin=MIN_EMIN, Emax=MAX_EMAX)
def integer(text: str) -> int:
    if len(text) <= PIECE: return int(text)
    if text[0] in '+-': return integer(text[1:]) * (-1 if text[0] == '-' else 1)
    ends = range(len(text), 0, -PIECE); pieces = [int(text[max(0, end - PIECE):end]) for end in ends]
    power = 10 ** PIECE
    while len(pieces) > 1:
        above = zip_longest(pieces[::2], pieces[1::2], fillvalue=0)
        pieces = [low + high * power for low, high in above]; power *= power if len(pieces) > 1 else 1
    return pieces[0]
def digits(n: int) -> str:
    if n.bit_length() <= 2000: return str(n)
    size, raw = (128, abs(n).to_bytes(n.bit_length() // 8 + 1, 'little'))
    parts = [raw[start:start + size] for start in range(0, len(raw), size)]
    pieces = [Decimal(int.from_bytes(part, 'little')) for part in parts]; power = Decimal(1 << 8 * size)
    while len(pieces) > 1:
        above = zip_longest(pieces[::2], pieces[1::2], fillvalue=Decimal(0))
        pieces = [EXACT.fma(high, power, low) for low, high in above]
        power = EXACT.multiply(power, power) if len(pieces) > 1 else power
    return '-' * (n < 0) + str(pieces[0])
def written(q: Fraction | int) -> str:
    below = q.denominator; return digits(q.numerator) if below == 1 else f'{digits(q.numerator)}/{digits(below)}'
def words(n: int) -> int: return (n.numerator.bit_length() + n.denominator.bit_length() >> 6) + 1
def most_words(f: Iterable[Any]) -> int: return max(map(words, f), default=1)
def longest(integers: Iterable[int]) -> int: return words(max(map(abs, integers)))
class Poly(tuple[Any, ...]):
    __slots__ = ()
    def __new__(cls, coefficients: Iterable[Any]=()) -> 'Poly':
        f = tuple.__new__(cls, coefficients)
        if f and (not f[-1]): f = tuple.__new__(cls, [*dropwhile(not_, f[::-1])][::-1])
        return f
    def __add__(self, g: 'Poly') -> 'Poly':
        both = self and g; return Poly([a + b for a, b in zip_longest(self, g, fillvalue=0)]) if both else self or g
    def __sub__(self, g: 'Poly') -> 'Poly': return Poly([a - b for a, b in zip_longest(self, g, fillvalue=0)])
    def __mul__(self, g: 'Poly') -> 'Poly':
        if len(self) < 2 or not g: return g if self == (1,) or not g else Poly([a * b for a in self for b in g])
        if len(self) * len(g) > 8: spend(len(self) * len(g) * most_words(self) * most_words(g))
        product = [0] * (len(self) + len(g) - 1)
        for i, a in enumerate(self):
            for j, b in enumerate(g): product[i + j] += a * b
        return Poly(product)
Track = tuple[Poly, Poly, Poly]; Whole = tuple[int, int, int]; Rows = list[Whole]; Entry = TypeVar('Entry', int, Poly)
Triple = tuple[Entry, Entry, Entry]; ONE, ZERO = (Poly([Fraction(1)]), Poly())
Poses = tuple[Point, list[Fraction], list[list[Poly]]]
def vector_of(a: Triple[Entry], b: Triple[Entry]) -> tuple[Entry, Entry]:
    return (b[0] * a[2] - a[0] * b[2], b[1] * a[2] - a[1] * b[2])
def turn(a: Triple[Entry], b: Triple[Entry], c: Triple[Entry]) -> Entry:
    f = a[0] * (b[1] * c[2] - c[1] * b[2]) + b[0] * (c[1] * a[2] - a[1] * c[2])
    return f + c[0] * (a[1] * b[2] - b[1] * a[2])
def dot_of(a: Triple[Entry], v: Triple[Entry], b: Triple[Entry]) -> Entry:
    (px, py), (qx, qy) = (vector_of(v, a), vector_of(v, b)); return px * qx + py * qy
def values(polynomials: Sequence[Poly], t: Fraction) -> list[int]:
    n, d, k = (t.numerator, t.denominator, max(map(len, polynomials)))
    if k < 2: return [*map(sum, polynomials)]
    if (n | d) >> 64:
        size = words(d) * (k * words(n) + longest(chain(*polynomials))); spend(len(polynomials) * k ** 2 * size)
    powers = [n ** i * d ** (k - 1 - i) for i in range(k if n else 1)]
    found = [sum(map(mul, f, powers)) for f in polynomials]
    spend(k * (len(found) + (sum(map(int.bit_length, found)) >> 6))); return found
def meet(a: Whole, b: Whole, c: Whole, d: Whole) -> bool:
    p, q, r, s = (turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b))
    if (p > 0 > q or p < 0 < q) and (r > 0 > s or r < 0 < s): return True
    ends = ((p, c, a, b), (q, d, a, b), (r, a, c, d), (s, b, c, d))
    return any((f == 0 and dot_of(x, v, y) <= 0 for f, v, x, y in ends))
def are_same(points: Sequence[Whole], others: Sequence[Whole]) -> bool:
    return all((vector_of(p, q) == (0, 0) for p, q in zip(points, others, strict=True)))
def is_simple(points: Sequence[Whole], edges: Iterable[Dart], first: int) -> bool:
    spans, near = ([], [((x << 256) // w, (y << 256) // w) for x, y, w in points])
    product = longest(chain(*points)) ** 2
    for u, v in edges:
        spend(4 * product)
        if vector_of(points[u - first], points[v - first]) == (0, 0): return False
        (x, y), (z, w) = (near[u - first], near[v - first])
        spans.append((min(x, z), max(x, z), min(y, w), max(y, w), u - first, v - first))
    spans.sort()
    for k, (_, right, bottom, top, a, b) in enumerate(spans):
        for j in range(k + 1, len(spans)):
            left, _, low, high, c, d = spans[j]
            if left > right: break
            spend(200)
            if low > top or high < bottom: continue
            spend(2000 + 60 * product)
            if b == c or d == a:
                p, q, r = (points[i] for i in ((a, b, d) if b == c else (c, d, b)))
                if turn(p, q, r) == 0 and dot_of(p, q, r) >= 0: return False
            elif meet(points[a], points[b], points[c], points[d]): return False
    return True
def surrounds(ring: Sequence[Whole], p: Whole) -> bool:
    spend(len(ring) * (300 + 15 * longest((*p, *ring[0])) ** 2))
    above, odd = ([q[1] * p[2] > p[1] * q[2] for q in ring], False)
    for i, a in enumerate(ring):
        if above[i] != above[i - 1]: odd ^= (turn(ring[i - 1], a, p) if above[i] else turn(a, ring[i - 1], p)) > 0
    return odd
NUMBER = re.compile('([+-]?)(\\d*+)(?:/(\\d++)|\\.?(\\d*+)(?:[eE]([+-]?\\d{1,18}))?)', re.ASCII); MAX_BITS = 33220
MAX_DIGITS = 10000; MAX_DEGREE = 64
BODY_KEYS = ['motion', 'closed', 'holes', 'radius', 'properties', 'vertices', 'keyframes', 'parts']
MOTION_KEYS = {'': ([], ['x', 'y']), 'affine': (['matrix'], ['x', 'y']), 'rigid': (['half_turn'], ['x', 'y', 'pivot', 'orientation'])}
class Bare(str): __slots__ = ()
def need(condition: object, what: str, data: Json='') -> None:
    if not condition: raise NoProofError(f'the scene: {what} {data!r:.60}')
def number(data: Json) -> Fraction:
    need(isinstance(data, str) and len(data) <= 3 * MAX_DIGITS, 'not a number:', data); return rational(data)
@lru_cache(1000)
def rational(data: str) -> Fraction:
    if data.removeprefix('-').isdecimal() and data.isascii() and (len(data) <= MAX_DIGITS):
        return Fraction(integer(data))
    match = NUMBER.fullmatch(data); minus, units, under, decimals, exponent = match.groups('') if match else [''] * 5
    need(units or decimals, 'not a number:', data); need(not under or under.strip('0'), 'a denominator is zero:', data)
    power, n = (int(exponent or 0), integer(minus + units + decimals))
    need(abs(power) <= 100000, 'an exponent beyond 100,000:', data); power = power - len(decimals) if n else 0
    is_whole = power >= 0 and (not under)
    q = Fraction(n * 10 ** power) if is_whole else Fraction(n, integer(under) if under else 10 ** (-power))
    bits = max(q.numerator.bit_length(), q.denominator.bit_length())
    need(bits <= MAX_BITS, 'more than 10,000 digits:', data); return q
def keys(data: Json, required: Sequence[str]=(), optional: Sequence[str]=()) -> Json:
    known = isinstance(data, dict) and {*required} <= data.keys() <= {*required, *optional}
    need(known, 'not an object, or with other keys:', data); return data
def entries(data: Json, length: int | None=None) -> Json:
    need(isinstance(data, list) and length in (None, len(data)), 'not a list as needed:', data); return data
def check_json(data: Json, levels: int) -> None:
    is_text = isinstance(data, str) and (data.isascii() or not re.search('[\ud800-\udfff]', data))
    need(is_text or not isinstance(data, (str, float)), 'a number or text that is none:', data)
    if isinstance(data, (dict, list)):
        need(levels, 'nested too deeply:', None)
        for value in [*data, *data.values()] if isinstance(data, dict) else data: check_json(value, levels - 1)
def polynomial(data: Json) -> Poly: return Poly([number(c) for c in entries(data)])
def degree(*polynomials: Poly) -> int: return max(1, *map(len, polynomials)) - 1
class Motion:
    def __init__(self, data: Json, of_shape: int) -> None:
        kind = next(iter({'rigid', 'affine'} & data.keys()), '') if isinstance(data, dict) else ''
        given = keys(keys(data, [kind])[kind] if kind else data, *MOTION_KEYS[kind])
        x, y = (polynomial(given.get('x', [])), polynomial(given.get('y', [])))
        m, high = ([ONE, ZERO, ZERO, ONE], max(of_shape, degree(x, y)))
        if kind == 'affine':
            m = [polynomial(p) for row in entries(given['matrix'], 2) for p in entries(row, 2)]
            high = max(of_shape + degree(*m), degree(x, y))
        h = polynomial(given['half_turn']) if kind == 'rigid' else ZERO
        need(high + 2 * degree(h) <= MAX_DEGREE, f'a degree above {MAX_DEGREE}'); form = (*m, x, y, ONE)
        if kind == 'rigid':
            c, s = point(given.get('orientation', ['1', '0']))
            need(c * c + s * s == 1, 'an orientation that is no unit vector:', data)
            p, q = (Poly([k]) for k in point(given.get('pivot', ['0', '0'])))
            w, cosine, sine = (ONE + h * h, ONE - h * h, h + h)
            a, b = (cosine * Poly([c]) - sine * Poly([s]), sine * Poly([c]) + cosine * Poly([s]))
            e, f = (w * (p + x) - a * p + b * q, w * (q + y) - b * p - a * q); form = (a, ZERO - b, b, a, e, f, w)
        e, f, w = cleared(x, y); self.form = cleared(*form)[:7] if kind else (w, ZERO, ZERO, w, e, f, w)
        self.columns = [*zip_longest(*self.form, fillvalue=0)]
        self.cost = sum(map(len, self.form)) * (300 + 2 * longest(chain(*self.form)) ** 2)
    def track(self, rows: Rows) -> Track:
        spend(self.cost * 2 * len(rows) * (longest(chain(*rows)) if len(rows) > 1 else 1))
        xs, ys, ws = ([0] * (len(self.columns) + len(rows) - 1) for _ in 'xyw')
        for i, (p, q, r) in enumerate(rows):
            for j, (a, b, c, d, e, f, w) in enumerate(self.columns, i):
                xs[j] += a * p + b * q + e * r; ys[j] += c * p + d * q + f * r; ws[j] += w * r
        m = gcd(*xs, *ys, *ws); x, y, w = [Poly([k // m for k in f]) for f in (xs, ys, ws)]; return (x, y, w)
def cleared(*given: Poly) -> tuple[Poly, ...]:
    ratios = [[q.as_integer_ratio() for q in f] for f in given]; m = lcm(*[d for f in ratios for _, d in f])
    spend(words(m) ** 2 * sum(map(len, given)))
    return (*[Poly([n * (m // d) for n, d in f]) for f in ratios], Poly([m]))
class Body:
    def __init__(self, data: Json, first: int, start: Fraction) -> None:
        body = keys(data, ['name'], BODY_KEYS)
        shapes = ('vertices' in body) + ('keyframes' in body) + ('parts' in body)
        need(shapes == 1, 'vertices or keyframes or parts:', data)
        need('holes' not in body or 'vertices' in body, 'holes without vertices:', data)
        self.name, closed = (body['name'], body.get('closed', True))
        need(type(self.name) is str and self.name, 'a name:', self.name)
        need(isinstance(closed, bool), 'closed:', closed); self.radius = number(body.get('radius', '0'))
        need(self.radius.numerator >= 0, 'a radius:', body.get('radius'))
        need(isinstance(body.get('properties', {}), dict), 'properties:', self.name)
        check_json([self.name, body.get('properties')], 30)
        parts = [keys(p, ['vertices'], ['holes']) for p in entries(body.get('parts', []))]
        need(parts or 'parts' not in body, 'no parts:', data)
        of = [(p.get('vertices', []), *entries(p.get('holes', []))) for p in parts or [body]]
        rings = [[*map(entries, part)] for part in of]; flat = [ring for part in rings for ring in part]
        several = 'parts' in body or len(flat) > 1
        need(not several or (closed and min(map(len, flat)) > 2), 'rings:', data)
        self.frames = keyframes(body['keyframes']) if 'keyframes' in body else []
        self.shape = [vertex(data) for ring in flat for data in ring]
        self.first, self.size = (first, len(self.frames[0][1] if self.frames else self.shape))
        need(self.size, 'no vertices:', self.name); self.read_motion(body.get('motion', {}))
        self.vertices, self.closed = (range(first, first + self.size), closed and self.size > 2)
        self.breaks = sorted({*self.ends, *dict(self.frames)}); self.parts: list[list[range]] = []
        for part in rings if several else [[self.vertices]]:
            bounds = accumulate(map(len, part), initial=first)
            self.parts.append([range(i, j) for i, j in pairwise(bounds)]); first = self.parts[-1][-1].stop
        self.rings = [(ring, k > 0) for part in self.parts for k, ring in enumerate(part)]
        self.edges = [e for r, _ in self.rings for e in pairwise([*r, *r[:self.closed]])]
        self.tracks, self.at_start = (dict[tuple[int, int], Track](), self.places(start))
        self.check_simple(self.at_start)
    def read_motion(self, data: Json) -> None:
        of_shape = 1 if self.frames else max(map(len, self.shape)) - 1; self.ends: list[Fraction] = []
        if not isinstance(data, dict) or 'pieces' not in data: self.motions = [Motion(data, of_shape)]; return
        given = keys(data, ['pieces'], ['spin', 'path', 'spline'])
        need(len(given) < 3, 'both a spin and a path (or a spline):', data)
        rows = [keys(p, ['motion'], ['until']) for p in entries(given['pieces'])]
        whole = rows and 'until' not in rows[-1] and all(('until' in p for p in rows[:-1]))
        need(whole, '"until" belongs to all pieces but the last:', data)
        self.ends = [number(p['until']) for p in rows[:-1]]
        need(all((s < t for s, t in pairwise(self.ends))), 'pieces not in order:', data)
        self.motions = [Motion(p['motion'], of_shape) for p in rows]
        for t, (before, after) in zip(self.ends, pairwise(self.motions), strict=True):
            u, v = (values(before.form, t), values(after.form, t))
            if [c * v[6] for c in u] != [c * u[6] for c in v]:
                same = are_same(self.places(t, before), self.places(t, after))
                need(same, f'{self.name!a:.200} jumps at t = {written(t):.200}')
        self.spin = spin_of(given['spin']) if 'spin' in given else None
        self.path = path_of(given['path']) if 'path' in given else None
        self.spline = spline_of(given['spline']) if 'spline' in given else None
    def rows(self, i: int, t: Fraction) -> Rows:
        if not self.frames: return self.shape[i]
        (s, p), (e, q) = self.around(t)
        slopes = [(b - a) / (e - s) if e > s else 0 for a, b in zip(p[i], q[i], strict=True)]
        xy = (Poly([a - v * s, v]) for a, v in zip(p[i], slopes, strict=True))
        return [*zip_longest(*cleared(*xy), fillvalue=0)]
    def around(self, t: Fraction) -> list[tuple[Fraction, list[Point]]]:
        k = bisect_right(self.frames, t, key=lambda frame: frame[0])
        return [self.frames[max(k - 1, 0)], self.frames[min(k, len(self.frames) - 1)]]
    def places(self, t: Fraction, motion: Motion | None=None) -> list[Whole]:
        motion = motion or self.motions[bisect_right(self.ends, t)]
        a, b, c, d, e, f, w = form = values(motion.form, t); spend(self.size * (1000 + 30 * longest(form)))
        shape = [self.rows(i, t) for i in range(self.size)] if self.frames else self.shape
        at = [k[0] if len(k) < 2 else values([*map(Poly, zip(*k, strict=True))], t) for k in shape]
        return [(a * x + b * y + e * z, c * x + d * y + f * z, w * z) for x, y, z in at]
    def check_simple(self, places: Sequence[Whole]) -> None:
        need(is_simple(places, self.edges, self.first), f'{self.name!a:.200} is not simple at the start')
        if len(self.rings) == 1: return
        outlines = {ring: [places[v - self.first] for v in ring] for ring, _ in self.rings}
        def is_in(ring: range, other: range) -> bool: return surrounds(outlines[other], outlines[ring][0])
        for one, *holes in self.parts:
            wrong = any((not is_in(k, one) for k in holes))
            wrong |= any((is_in(k, m) for k in holes for m in holes if k != m))
            for other, *others in self.parts:
                within = other != one and is_in(one, other)
                wrong |= within and (not any((is_in(one, hole) for hole in others)))
            need(not wrong, f'{self.name!a:.200}: a hole or part is where none can be')
    def track(self, i: int, after: Fraction) -> Track:
        key = (i, bisect_right(self.breaks, after))
        if key not in self.tracks:
            motion = self.motions[bisect_right(self.ends, after)]; self.tracks[key] = motion.track(self.rows(i, after))
        return self.tracks[key]
def point(data: Json) -> Point: x, y = map(number, entries(data, 2)); return (x, y)
def vertex(data: Json) -> Rows:
    if isinstance(data, dict):
        xy = (polynomial(keys(data, optional=['x', 'y']).get(k, [])) for k in 'xy')
        return [*zip_longest(*cleared(*xy), fillvalue=0)]
    (p, d), (q, e) = (x.as_integer_ratio() for x in point(data)); m = lcm(d, e)
    return [(p * (m // d), q * (m // e), m)]
def keyframes(data: Json) -> list[tuple[Fraction, list[Point]]]:
    frames = [keys(f, ['t', 'vertices']) for f in entries(data)]
    path = [(number(f['t']), [*map(point, entries(f['vertices']))]) for f in frames]
    need(len({len(points) for _, points in path}) == 1, 'keyframes:', data)
    need(all((s < t for (s, _), (t, _) in pairwise(path))), 'keyframes not in order:', data); return path
def spin_of(data: Json) -> Point:
    omega, error = (number(keys(data, ['omega', 'error'])[k]) for k in ('omega', 'error'))
    need(error > 0, "a spin's error:", data); return (omega, error)
def spline_of(data: Json) -> Fraction:
    error = number(keys(data, ['error'])['error']); need(error >= 0, "a spline's error:", data); return error
def path_of(data: Json) -> Poses:
    path = keys(data, ['error', 'place_error', 'times', 'poses'], ['assumed_angle_error'])
    assumed = number(path.get('assumed_angle_error', Bare('0')))
    error, off = (number(path['error']) - assumed, number(path['place_error']))
    need(assumed >= 0, 'an assumed error of a path:', data); times = [number(t) for t in entries(path['times'])]
    rows = [keys(row, ['x', 'y', 'angle']) for row in entries(path['poses'])]
    poses = [[polynomial(row[k]) for k in ('x', 'y', 'angle')] for row in rows]
    right = error > 0 and off >= 0 and (len(times) == len(poses) + 1 > 1)
    need(right and all((s < t for s, t in pairwise(times))), 'not such a path:', data)
    return ((error, off), times, poses)
def read_json(text: str) -> Json:
    def unique(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
        need(len({k for k, _ in pairs}) == len(pairs), 'a key is there twice:', pairs); return dict(pairs)
    return json.loads(text, parse_int=Bare, parse_float=Bare, object_pairs_hook=unique)
class Scene:
    def __init__(self, text: str) -> None:
        try: self.read(read_json(text))
        except (ValueError, RecursionError) as error:
            raise NoProofError(f'the scene is not JSON, or nested too deeply: {error}') from None
    def read(self, data: Json) -> None:
        top = keys(data, ['exactpt', 'time', 'bodies']); version = top['exactpt']
        need(version == '1' and isinstance(version, Bare), 'not of format 1:', version)
        self.start, self.end = point(top['time']); need(self.start < self.end, 'an empty time span:', top['time'])
        self.bodies, self.body_of = (list[Body](), list[int]())
        for i, entry in enumerate(entries(top['bodies'])):
            self.bodies.append(Body(entry, len(self.body_of), self.start)); self.body_of += [i] * self.bodies[-1].size
        need(len({body.name for body in self.bodies}) == len(self.bodies), 'a name is there twice')
    def of(self, v: int) -> Body: return self.bodies[self.body_of[v]]
    def track(self, v: int, after: Fraction) -> Track: body = self.of(v); return body.track(v - body.first, after)
    def place(self, v: int, t: Fraction) -> Whole: x, y, w = values(self.track(v, t), t); return (x, y, w)
MAX_BYTES, MAX_LINE_BYTES = (10 ** 9, 10 ** 8)
def is_rational(word: str) -> bool:
    over, _, under = word.removeprefix('-').partition('/'); is_short = max(len(over), len(under)) <= MAX_DIGITS
    return bool(is_short and re.fullmatch(R, word) and ('/' not in word or under.strip('0')))
def read(proof: bytes) -> list[tuple[int, list[str]]]:
    rows = []
    for i, line in enumerate(proof.split(b'\n'), 1):
        if len(line) > MAX_LINE_BYTES: raise NoProofError(f'line {i} is too long')
        row = re.findall('[^ \\t\\r]+', line.decode())
        if row and (not line.startswith(b'#')):
            form = FORMS.get(row[0], FORMS['none'])
            if not form.fullmatch(' '.join(row)) or not is_bounded(row):
                raise NoProofError(f'line {i} is not in the format')
            rows.append((i, row))
    if not re.fullmatch(ORDER, ' '.join((row[0] for _, row in rows))):
        raise NoProofError('the file is no proof, or the order of its lines is another one')
    return rows
def file_bytes(path: Path) -> bytes:
    with path.open('rb') as file: return file.read(MAX_BYTES + 1)
def say(text: str, code: int, file: TextIO) -> int:
    shown = (c if c.isascii() and c.isprintable() else ascii(c)[1:-1] for c in text); file.write(''.join(shown) + '\n')
    return code
# ---- End of the copy.
# fmt: on

USAGE = "python3 -I FILE SCENE CERTIFICATE [--until T] [--partial] [--expect ANSWER] [--work N]"
R, V, Z = r"-?[0-9]++(/[0-9]++)?", "[0-9]{1,9}", "-?[0-9]++"  # a rational, a number, an integer
LINES = (
    f"exactpt-apart 1;scene sha256 [^ ]+;span {R} {R};between {V} {V};ignoring {V}( {V})+;none;"
    f"distance {R};t( {R})?;c {Z} {Z} {R}( {R})?;s {V} {V};meet {R} {V} {V};inside {R} {V} {V};"
    f"cross {R} {R} {V} {V}"
)
FORMS = {form.split("(")[0].split()[0]: re.compile(form) for form in LINES.split(";")}
ORDER = (
    "exactpt-apart scene span( between)*+( ignoring)*+( distance)?( [tcs](?= ))*+ "
    "(none|meet|inside|cross)"
)
Plane = tuple[int, int, int, int]
Planes = tuple[Plane, Plane]
Hull = list[Plane]


def is_bounded(row: list[str]) -> bool:
    """Return True if the numbers of a line are small enough."""
    some = [w for w in row[1:] if "/" in w or len(w) > MAX_DIGITS]
    return row[0] in ("exactpt-apart", "scene") or all(map(is_rational, some))


class Interval:
    """A closed interval of time, and hulls of paths of vertices in it."""

    def __init__(self, start: Fraction, end: Fraction) -> None:
        self.start, self.end, self.grid = start, end, on_grid(start, end)
        self.hulls, self.work = dict[int, Hull](), dict[int, int]()

    def hull(self, scene: Scene, v: int) -> Hull:
        """Return the points of `hull` of all pieces of a vertex's path."""
        if v not in self.hulls:
            inside = [q for q in scene.of(v).breaks if self.start < q < self.end]
            points = [] if inside else hull(scene.track(v, self.start), *self.grid)
            for s, e in pairwise([self.start, *inside, self.end] if inside else []):
                points += hull(scene.track(v, s), *on_grid(s, e))
            self.hulls[v], self.work[v] = points, 4 * len(points) * words(points[0][3])
        return self.hulls[v]


def on_grid(s: Fraction, e: Fraction) -> tuple[int, int, int]:
    """Return integers a, b, m with s = a / m and e = b / m."""
    m = lcm(s.denominator, e.denominator)
    return s.numerator * (m // s.denominator), e.numerator * (m // e.denominator), m


def spread(f: Poly, d: int, a: int, b: int, m: int) -> list[int]:
    """Return positive multiples of the coefficients of f in the Bernstein basis of [a / m, b / m].

    They are those of (1 - u)^(d - k) u^k in m^d f(t), t = (a (1 - u) + b u) / m, by Horner's rule.
    """
    c = [*f, *[0] * (d + 1 - len(f))]
    spend(d * d * most_words((a, b, m)) * (most_words(c) + d * most_words((a, b, m))))
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
    Its degree is that of the track plus 1, or 1 if the path is linear: then these are its ends.
    (Where a w is not positive no such point exists, but these multiples have that meaning.)
    """
    f, g, h = track
    spend(10 + words(a * b * m))
    if len(h) == 1 and len(f) < 3 > len(g):
        (x, u), (y, v), n = (*f, 0, 0)[:2], (*g, 0, 0)[:2], h[0]
        return [(x * m + u * t, y * m + v * t, n * t, n * m) for t in (a, b)]
    x, y, w = (spread(f, max(map(len, track)) - 1, a, b, m) for f in track)
    both = zip([*x, 0], [0, *x], [*y, 0], [0, *y], [*w, 0], [0, *w], strict=True)
    return [(m * (p + q), m * (r + s), a * t + b * u, m * (t + u)) for p, q, r, s, t, u in both]


def planes_of(x: int, y: int, c: Fraction, v: Fraction, r: Fraction, far: Fraction) -> Planes:
    """Two linear forms of (w x, w y, w t, w): below the first one, and not below the second one,
    paths are farther than r from a moving line on both sides, and than r + far on the second.
    """
    low = high = c
    if r or far:
        norm = Fraction(isqrt((x * x + y * y) << 128) + 1, 1 << 64)  # above the length of (x, y)
        low, high = c - norm * r, c + norm * (r + far)
    d = lcm(v.denominator, low.denominator, high.denominator)
    z, p, q = (-k.numerator * (d // k.denominator) for k in (v, low, high))
    return (plane := (d * x, d * y, z, p)), plane if p == q else (d * x, d * y, z, q)


def side_of(points: Hull, low: Plane, high: Plane) -> int:
    """-1 if points are below a first plane, 1 if none of them is below a second one, else 0."""
    a, b, t, c = low
    of = [a * x + b * y + t * z + c * w for x, y, z, w in points]
    if max(of) < 0:
        return -1
    return int(min(of) >= 0) if low is high else max(0, side_of(points, high, high))


def are_near(places: Sequence[Whole], far: Fraction) -> bool:
    """Return True if the closed segments between two and two points are at most so far apart."""
    if meet(*places) or not far:
        return meet(*places)
    a, b, c, d = [(Fraction(x, w), Fraction(y, w)) for x, y, w in places]
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
    f = [turn(v, a, b)]
    require(values(f, s)[0] * values(f, t)[0] <= 0, "it stays on one side of the edge")
    for g in (dot_of(v, a, b), dot_of(v, b, a)):
        beside = spread(g, max(len(g) - 1, 0), *on_grid(s, t))
        require(min(beside) > 0, "it may pass beside the edge")


class Proved(str):
    """The statement: apart up to ``low``, in contact by ``until``; of the ``whole`` scene or not."""

    low: Fraction
    until: Fraction
    meets = is_of_all = False  # whether there is a contact, without a distance; of all pairs
    whole: bool


class Checker:
    """Goes through a certificate. ``line`` is the one that is looked at."""

    def __init__(self, scene: Scene, rows: list[tuple[int, list[str]]]) -> None:
        self.scene, (self.line, span), self.last = scene, rows[2], rows[-1]
        edges = [(i, b.edges or [(b.first, b.first)]) for i, b in enumerate(scene.bodies)]
        self.items = [(i, *edge) for i, some in edges for edge in some]
        self.radii = sorted({body.radius for body in scene.bodies})
        kinds = {r: k for k, r in enumerate(self.radii)}
        self.kind = [k for b in scene.bodies for k in [kinds[b.radius]] * b.size]
        self.start, self.until = map(rational, span[1:])
        require(scene.start <= self.start <= self.until <= scene.end, "not a span of the scene")
        self.distance, self.selection, self.named = Fraction(0), "", set[Dart]()
        self.group, self.nodes = [*range(len(scene.bodies))], list[tuple[int, list[str]]]()
        grouped, self.chosen = set[int](), set[int]()
        for self.line, row in rows[3:-1]:
            some = [self.index(w, self.group) for w in row[1:] if row[0] in ("between", "ignoring")]
            if row[0] == "distance":
                self.distance = rational(row[1])
                require(self.distance >= 0, "a distance below 0")
            elif not some:
                self.nodes.append((self.line, row))
            else:
                is_new = len({*some}) == len(some) and not grouped & {*some}
                require(is_new, "a body is there twice")
                self.chosen |= {*some}
                self.selection += f"; {row[0]} {' '.join(f'b{i}' for i in some)}"
                if row[0] == "between":
                    self.named.add((min(some), max(some)))
                    continue
                grouped |= {*some}
                for i in some:
                    self.group[i] = some[0]

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
        nodes, all_items = iter(self.nodes), [*range(len(self.items))]
        todo = [(all_items, Interval(self.start, self.until))]
        while todo:
            items, time = todo.pop()
            spend(20 * (len(items) + len(self.named)))
            if not self.count({self.items[i][0] for i in items}):
                continue
            self.line, (kind, *row) = next(nodes, (self.last[0], ["none"]))
            require(kind != "none", "a node is missing: two bodies are left together")
            if kind == "t":
                s, e = time.start, time.end
                q = rational(row[0]) if row else (s + e) / 2
                require(
                    s < q < e,
                    f"{written(q):.200} is not between {written(s):.200} and {written(e):.200}",
                )
                todo += [(items, Interval(q, e)), (items, Interval(s, q))]
                continue
            if kind == "c":
                sides = self.sides(items, time, row)
            else:
                body, k = self.index(row[0], self.group), int(row[1])
                sides = [self.items[i][0] == body and (i >= k) * 2 - 1 for i in items]
            for side in (-1, 1):
                todo.append(([i for i, k in zip(items, sides, strict=True) if k != side], time))
        require(next(nodes, None) is None, "there are more nodes than are needed")

    def sides(self, items: list[int], time: Interval, row: list[str]) -> list[int]:
        """-1 for items below a moving line, 1 for those above it by more than the distance; 0."""
        x, y, c, v = integer(row[0]), integer(row[1]), rational(row[2]), rational([*row, "0"][3])
        require(x or y, "a line without a direction")
        ends = [self.items[i][1:] for i in items]
        hulls = {u: time.hulls.get(u) or time.hull(self.scene, u) for u in {*chain(*ends)}}
        kinds = {self.kind[u] for u in hulls}
        planes = {k: planes_of(x, y, c, v, self.radii[k], self.distance) for k in kinds}
        most = max(words(low[3]) for low, _ in planes.values())
        spend(most * sum(map(time.work.__getitem__, hulls)))
        sides = {u: side_of(hull, *planes[self.kind[u]]) for u, hull in hulls.items()}
        return [sides[u] if sides[u] == sides[w] else 0 for u, w in ends]

    def check_outside(self) -> None:
        """See that at the start no ring is inside a body that counts with its own body."""
        bodies, is_first = self.scene.bodies, self.start == self.scene.start
        at = [*chain(*(b.at_start if is_first else b.places(self.start) for b in bodies))]
        left = [(x << 256) // w for x, _, w in at]
        firsts = sorted((left[r[0]], r[0], j) for j, b in enumerate(bodies) for r, _ in b.rings)
        for i, body in enumerate(bodies):
            xs = left[body.first : body.first + body.size]
            low, high = bisect_left(firsts, (min(xs),)), bisect_left(firsts, (max(xs) + 1,))
            for _, v, j in firsts[low:high] if body.closed else []:
                spend(20 * len(self.named))
                inside = self.count({i, j}) and self.is_inside(body, at[v], at)
                require(not inside, f"b{j} has a ring inside b{i} at the start")

    def is_inside(self, body: Body, p: Whole, at: Mapping[int, Whole] | list[Whole]) -> bool:
        """Return True if a ray from p crosses the rings of a closed body an odd number of times."""
        crossed = sum(surrounds([at[v] for v in ring], p) for ring, _ in body.rings)
        return body.closed and crossed % 2 == 1

    def check_contact(self, kind: str, words: list[str]) -> tuple[Fraction, str, list[int]]:
        """Check the last line: the time of a contact, its kind, and the bodies."""
        scene, times = self.scene, [*map(rational, words[:-2])]
        s, t = min(times), max(times)
        require(self.start <= s and t <= scene.end, "a time outside of the span")
        if kind == "meet":
            (i, a, b), (j, c, d) = (self.items[self.index(w, self.items)] for w in words[-2:])
            far = self.distance + scene.bodies[i].radius + scene.bodies[j].radius
            near = are_near([scene.place(v, t) for v in (a, b, c, d)], far)
            require(near, "these are not near each other then")
            text = f"{self.short(a)} and {self.short(c)} at t = {written(t)}"
        elif kind == "inside":
            v, j = self.index(words[-2], scene.body_of), self.index(words[-1], scene.bodies)
            i, body = scene.body_of[v], scene.bodies[j]
            at = {u: scene.place(u, t) for u in body.vertices}
            require(self.is_inside(body, scene.place(v, t), at), "it is not inside then")
            text = f"{self.short(v)} inside b{j} at t = {written(t)}"
        else:
            v = self.index(words[-2], scene.body_of)
            i, (j, a, b) = scene.body_of[v], self.items[self.index(words[-1], self.items)]
            breaks = {q for k in (i, j) for q in scene.bodies[k].breaks if s < q < t}
            require(times == [s, t] and s < t and not breaks, "not a time of one formula")
            require_passage([scene.track(u, s) for u in (v, a, b)], s, t)
            text = f"{self.short(v)} through {self.short(a)} in [{written(s)}, {written(t)}]"
        require(i != j and self.count({i, j}), "bodies that do not count as a pair")
        return t, text, [i, j]

    def short(self, v: int) -> str:
        """A vertex, or the edge that begins there."""
        return f"b{self.scene.body_of[v]}.{v - self.scene.of(v).first}"

    def run(self, accepted: str = "") -> Proved:
        """Check everything, and return the statement."""
        self.line, (kind, *row) = self.last
        a, low, first, end = self.start, self.until, self.scene.start, self.scene.end
        what = f"within {written(self.distance)}" if self.distance else ""
        rest = [f"[{written(first)}, {written(a)})"] * (first < a)
        rest += [f"({written(low)}, {written(end)}]"] * (kind == "none" and low < end)
        found = kind != "none"
        high, how, bodies = self.check_contact(kind, row) if found else (low, "", [])
        if found and high == a:
            require(low == a and not self.nodes, "there is a contact at the start")
            text = f"two bodies {what or 'share a point'} at the start t = {written(a)}: {how}"
        else:
            require(not found or low < high, "a contact before the end of the span")
            self.check_outside()
            self.check_apart()
            event = f"time {what}" if what else "contact"
            text = f"first {event} of two bodies in ({written(low)}, {written(high)}]: {how}"
        if not found:
            text = f"no two bodies {f'are {what}' if what else 'share a point'} "
            text += f"in [{written(a)}, {written(low)}]" if a < low else f"at t = {written(a)}"
            text += ", the whole span" * (not rest)
        if rest:
            text += f"; the span of the scene is [{written(first)}, {written(end)}]: nothing is said of {' and '.join(rest)}"
        chosen = sorted({*bodies, *self.chosen})
        said = ", ".join(f"b{i} is {self.scene.bodies[i].name!a}" for i in chosen)
        names = f" ({said})" if said else ""
        proved = Proved(f"{accepted}{text}{self.selection}{names}")
        proved.low, proved.until, proved.meets = low, high, kind != "none" and not self.distance
        proved.is_of_all = not self.selection and a == first
        proved.whole = not rest and proved.is_of_all
        return proved


def check(scene_file: bytes, certificate: bytes, work: int | None = None) -> Proved:
    """Check a certificate; return its statement. Raises `Rejected`, `NoProofError`, or `Exhausted`."""
    line, checker = 0, None
    with budget(work, len(scene_file) + len(certificate)):
        try:
            size = max(len(scene_file), len(certificate))
            need(size <= MAX_BYTES, "or the certificate: too many bytes")
            text, digest = scene_file.decode("utf-8-sig"), hashlib.sha256(scene_file).hexdigest()
            many = certificate.startswith(b"exactpt-apart-rows 1\n")
            rows = [] if many else read(certificate)
            head = f"exactpt-apart-rows 1\nscenes sha256 {digest}\n".encode()
            if not certificate.startswith(head) if many else rows[1][1][2] != digest:
                raise NoProofError(
                    "the certificate was made for a different scene: the hashes differ"
                )
            accepted = f"accepted: {digest[:16]} "
            if many:
                return check_rows(accepted, text.split("\n"), certificate.decode().split("\n")[2:])
            scene, line = Scene(text), rows[2][0]
            checker = Checker(scene, rows)
            return checker.run(accepted)
        except UnicodeDecodeError:
            raise NoProofError("a file is not UTF-8") from None
        except Rejected as why:
            where = f"line {checker.line if checker else line}: " if line else ""
            raise Rejected(f"rejected: {where}{why}") from None


def check_rows(accepted: str, scenes: list[str], rows: list[str]) -> Proved:
    """Check a certificate of many scenes, a line each, with ; between its lines; or only "open"."""
    ends = [scenes.pop(), rows.pop()] if scenes and rows else ["no line"]
    need(ends == ["", ""], "or the certificate: a last line without an end:", ends)
    need(len(scenes) == len(rows), "the numbers of scenes and of rows differ:", len(rows))
    found = dict.fromkeys(("no contact", "first contact", "contact at the start", "open"), 0)
    for k, (scene, row) in enumerate(zip(scenes, rows, strict=True), 1):
        made, kind = Scene(scene), "open"
        if row != "open":
            lines = read(f"exactpt-apart 1\nscene sha256 -\n{row.replace(';', chr(10))}".encode())
            try:
                checker = Checker(made, lines)
                require(len(made.bodies) > 1 and not checker.distance, "no contacts of two bodies")
                proved = checker.run()
                require(proved.whole, f"only a part is proved: {proved}")
            except Rejected as why:
                raise Rejected(f"row {k}: {why}") from None
            start = {"no": "no contact", "first": "first contact"}
            kind = start.get(proved.split()[0], "contact at the start")
        found[kind] += 1
    said = ", ".join(f"{kind} in {n}" for kind, n in found.items() if n)
    text = f"{len(rows)} rows, each of two or more bodies in the whole span: {said}"
    proved = Proved(f"{accepted}{text}")
    proved.until, proved.whole = Fraction(0), not found["open"]
    return proved


def differs(proved: Proved, answer: bytes) -> str:
    """Return how the output of `exactpt collide --json` differs from the statement; "" if not."""
    try:
        check_json(data := read_json(answer.decode("utf-8-sig")), 32)
        if data["contact"] is None:
            return "" if proved.low >= number(data["until"]) else "no contact is the answer of"
        time, kind = data["contact"]["time"], data["contact"]["kind"]
        low, high = (number(time[k]) for k in ("low", "high"))
        terms = entries(time["polynomial"])
        need(all(re.fullmatch("-?[0-9]+", c) for c in terms), "no polynomial:", terms)
        f = Poly(map(integer, terms))
        at_low, at_high = (values([f], t)[0] for t in (low, high))
        if not (low == high and f and at_low == 0) and not (low < high and at_low * at_high < 0):
            raise ValueError("no time")
    except (ValueError, KeyError, TypeError, RecursionError, NoProofError) as error:
        raise NoProofError(f"the answer is none of exactpt collide --json: {error!a:.60}") from None
    if not proved.meets or kind == "self":
        return "a contact that is not certified is the answer of"
    a, b = proved.low, proved.until
    after = low > a or (high > a and values([f], a)[0] * at_low > 0) or low == high == a == b
    before = high <= b or (low < b and values([f], b)[0] * at_high >= 0)
    return "" if after and before else "another time is the answer of"


def main(arguments: list[str]) -> int:
    """Check a file; the exit code."""
    paths, given, rest = list[Path](), dict[str, str](), iter(arguments)
    try:
        if arguments == ["--version"]:
            return say(hashlib.sha256(Path(__file__).read_bytes()).hexdigest(), 0, sys.stdout)
        for word in rest:
            if word in ("--partial", "--until", "--expect", "--work"):
                given[word] = "" if word == "--partial" else next(rest, "-")
            else:
                paths.append(Path(word))
        until, work, answer = (given.get(word) for word in ("--until", "--work", "--expect"))
        fits = is_rational(until or "0") and re.fullmatch("[0-9]{1,18}", work or "0")
        if not fits or len(paths) != 2 or (until and (answer or "--partial" in given)):
            raise NoProofError(f"usage: {USAGE}")
        scene, text = (file_bytes(path) for path in paths)
        if answer and text.startswith(b"exactpt-apart-rows "):
            raise NoProofError("rows have many answers: --expect is for one")
        proved = check(scene, text, None if work is None else int(work))
        is_up_to = answer or (until and rational(until) <= proved.until)
        is_enough = proved.whole or "--partial" in given or (proved.is_of_all and is_up_to)
        require(is_enough, f"rejected: proved is only a part (see --until, --partial): {proved}")
        reason = differs(proved, file_bytes(Path(answer))) if answer else ""
        require(not reason, f"rejected: {reason} {answer!a}; proved is: {proved}")
        return say(proved, 0, sys.stdout)
    except (Rejected, Exhausted) as verdict:
        return say(str(verdict), 1 if isinstance(verdict, Rejected) else 4, sys.stdout)
    except (NoProofError, OSError, ValueError) as error:
        return say(str(error), 2, sys.stderr)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
