"""Checks a certificate that no two bodies of a scene share a point in [a, L], and that two do by H.

    python3 -I FILE SCENE CERTIFICATE [--until T] [--partial] [--expect ANSWER] [--work N]

It imports the standard library alone and uses no floats. docs/proofs.md, Certificates, has the
statement, the file format and the whole argument. Numbers and the scene are read by
`exactpt.proof_scene`; `exactpt check --write-apart FILE` joins both into one file. An item is an
edge of a body, or its only vertex.

Exit code: 0 accepted, 1 rejected, or not the statement that was wanted, 2 no certificate of this
scene, 4 not decided: the budget of work is used up.
"""

import sys

if __name__ == "__main__" and not sys.flags.isolated:
    sys.stderr.write("run it as python3 -I FILE SCENE CERTIFICATE: else files nearby take part\n")
    sys.exit(2)

import hashlib
import re
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import chain, combinations, pairwise
from math import comb, isqrt, lcm
from pathlib import Path
from typing import Any, NamedTuple

from exactpt.proof_scene import (
    MAX_BYTES,
    MAX_DIGITS,
    Body,
    Dart,
    Exhausted,
    Format,
    NoProofError,
    Point,
    Poly,
    R,
    Rejected,
    Scene,
    Track,
    V,
    Whole,
    about,
    budget,
    check_json,
    dot_of,
    entries,
    file_bytes,
    integer,
    is_rational,
    meet,
    most_words,
    need,
    number,
    rational,
    read,
    read_json,
    require,
    say,
    spend,
    surrounds,
    turn,
    values,
    words,
    written,
)

USAGE = "python3 -I FILE SCENE CERTIFICATE [--until T] [--partial] [--expect ANSWER] [--work N]"
Z = "-?[0-9]++"  # an integer
FORMS = {  # of a line, by its first word
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
ORDER = (
    "exactpt-apart scene span( between)*+( ignoring)*+( distance)?( [tcs](?= ))*+ "
    "(none|meet|inside|cross)"
)
Row = tuple[int, list[str]]  # the number of a line, and its words
Plane = tuple[int, int, int, int]
Planes = tuple[Plane, Plane]
Hull = list[Plane]


def is_bounded(row: list[str]) -> bool:
    """Return True if the numbers of a line are small enough."""
    if row[0] in ("exactpt-apart", "scene"):
        return True
    doubtful = [word for word in row[1:] if "/" in word or len(word) > MAX_DIGITS]
    return all(map(is_rational, doubtful))


FORMAT = Format({kind: re.compile(form) for kind, form in FORMS.items()}, ORDER, is_bounded)


# ---- Paths of vertices in an interval of time, and moving lines.


class Interval:
    """A closed interval of time, and hulls of paths of vertices in it.

    ``work`` is the work of one comparison of the hull of a vertex with a line.
    """

    def __init__(self, start: Fraction, end: Fraction) -> None:
        self.start, self.end = start, end
        self.grid = on_grid(start, end)
        self.hulls = dict[int, Hull]()
        self.work = dict[int, int]()

    def hull(self, scene: Scene, v: int) -> Hull:
        """Return the points of `hull` of all pieces of a vertex's path."""
        if v not in self.hulls:
            points = self.hull_of_pieces(scene, v)
            self.hulls[v] = points
            self.work[v] = 4 * len(points) * words(points[0][3])
        return self.hulls[v]

    def hull_of_pieces(self, scene: Scene, v: int) -> Hull:
        """Return the points of each piece, one after the other."""
        inside = [q for q in scene.of(v).breaks if self.start < q < self.end]
        if not inside:
            return hull(scene.track(v, self.start), *self.grid)
        points: Hull = []
        for start, end in pairwise([self.start, *inside, self.end]):
            points += hull(scene.track(v, start), *on_grid(start, end))
        return points


def on_grid(s: Fraction, e: Fraction) -> tuple[int, int, int]:
    """Return integers a, b, m with s = a / m and e = b / m."""
    m = lcm(s.denominator, e.denominator)
    a = s.numerator * (m // s.denominator)
    b = e.numerator * (m // e.denominator)
    return a, b, m


def spread(f: Poly, d: int, a: int, b: int, m: int) -> list[int]:
    """Return positive multiples of the coefficients of f in the Bernstein basis of [a / m, b / m].

    They are those of (1 - u)^(d - k) u^k in m^d f(t), t = (a (1 - u) + b u) / m, by Horner's rule.
    """
    missing = d + 1 - len(f)
    c = [*f, *[0] * missing]
    size = most_words((a, b, m))
    spend(d * d * size * (most_words(c) + d * size))
    g = [c[d]]
    power = 1
    for j in range(1, d + 1):
        power *= m
        times_t = [a * p + b * q for p, q in zip([*g, 0], [0, *g], strict=True)]
        next_term = c[d - j] * power
        g = [p + next_term * comb(j, k) for k, p in enumerate(times_t)]
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
    is_linear = len(h) == 1 and len(f) <= 2 and len(g) <= 2
    if is_linear:
        (x, x_rate), (y, y_rate) = (*f, 0, 0)[:2], (*g, 0, 0)[:2]
        w = h[0]
        return [(x * m + x_rate * t, y * m + y_rate * t, w * t, w * m) for t in (a, b)]
    d = max(len(f), len(g), len(h)) - 1
    xs, ys, ws = (spread(polynomial, d, a, b, m) for polynomial in track)
    points: Hull = []
    # Of the degree d + 1: each is the sum of two that follow one upon the other; t is from a to b.
    for k in range(d + 2):
        x, y, w = (of[k] if k <= d else 0 for of in (xs, ys, ws))
        x_before, y_before, w_before = (of[k - 1] if k > 0 else 0 for of in (xs, ys, ws))
        wt = a * w + b * w_before
        points.append((m * (x + x_before), m * (y + y_before), wt, m * (w + w_before)))
    return points


def planes_of(x: int, y: int, c: Fraction, v: Fraction, r: Fraction, far: Fraction) -> Planes:
    """Return two linear forms of (w x, w y, w t, w), one for each side of a moving line.

    Paths that are below the first one, and not below the second one, are farther than r from the
    line on both sides, and than r + far on the second. Where both are the same it is one object.
    """
    low = high = c
    if r or far:
        norm = Fraction(isqrt((x * x + y * y) << 128) + 1, 1 << 64)  # above the length of (x, y)
        low = c - norm * r
        high = c + norm * (r + far)
    d = lcm(v.denominator, low.denominator, high.denominator)
    rate, below, above = (-q.numerator * (d // q.denominator) for q in (v, low, high))
    plane = (d * x, d * y, rate, below)
    if below == above:
        return plane, plane
    return plane, (d * x, d * y, rate, above)


def side_of(points: Hull, low: Plane, high: Plane) -> int:
    """-1 if points are below a first plane, 1 if none of them is below a second one, else 0."""
    of_low = values_of(low, points)
    if max(of_low) < 0:
        return -1
    of_high = of_low if low is high else values_of(high, points)
    return 1 if min(of_high) >= 0 else 0


def values_of(plane: Plane, points: Hull) -> list[int]:
    """Return the values of a linear form at points."""
    a, b, t, c = plane
    return [a * x + b * y + t * z + c * w for x, y, z, w in points]


# ---- Two bodies near each other.


def are_near(places: Sequence[Whole], far: Fraction) -> bool:
    """Return True if the closed segments between two and two points are at most so far apart."""
    if meet(*places):
        return True
    if not far:
        return False
    # Segments that do not meet are nearest to each other at an end of one of them.
    a, b, c, d = [(Fraction(x, w), Fraction(y, w)) for x, y, w in places]
    ends = ((a, c, d), (b, c, d), (c, a, b), (d, a, b))
    return any(squared_distance(*end) <= far * far for end in ends)


def squared_distance(p: Point, q: Point, r: Point) -> Fraction:
    """Return the squared distance of a point p from the segment from q to r."""
    x, y = r[0] - q[0], r[1] - q[1]
    z, w = p[0] - q[0], p[1] - q[1]
    length = x * x + y * y  # squared
    part = (x * z + y * w) / length if length else Fraction(0)
    k = min(max(part, Fraction(0)), Fraction(1))  # the nearest point is q + k (r - q)
    return (z - k * x) ** 2 + (w - k * y) ** 2


def require_passage(tracks: Sequence[Track], s: Fraction, t: Fraction) -> None:
    """See that a vertex is on an edge at a time in [s, t].

    The sign of its orientation with the edge changes, and it is beside the edge all the time: that
    it is between the ends, strictly, excludes an edge without a length.
    """
    v, a, b = tracks
    side = [turn(v, a, b)]
    (at_start,), (at_end,) = values(side, s), values(side, t)
    require(at_start * at_end <= 0, "it stays on one side of the edge")
    for g in (dot_of(v, a, b), dot_of(v, b, a)):
        beside = spread(g, max(len(g) - 1, 0), *on_grid(s, t))
        require(min(beside) > 0, "it may pass beside the edge")


# ---- The checks.


class Item(NamedTuple):
    """An edge of a body, from one vertex to another, or its only vertex twice."""

    body: int
    start: int
    end: int


class Met(NamedTuple):
    """Two bodies that are near each other at a time, or by then, in words."""

    time: Fraction
    words: str
    bodies: tuple[int, int]


class Proved(str):
    """The statement, in words.

    Attributes:
        low: the time up to which the pairs of the certificate are apart.
        until: the time by which there is a contact, or ``low`` if none is claimed.
        kind: "no contact", "first contact" or "contact at the start", of two bodies.
        meets: whether there is a contact, without a distance.
        is_of_all: whether it is proved of all pairs that count in the scene, from its start.
        whole: whether it is so up to the end of the scene, or to a contact.
    """

    low: Fraction
    until: Fraction
    kind: str
    meets = is_of_all = False
    whole: bool


class Checker:
    """Goes through a certificate.

    Attributes:
        line: the number of the line that is looked at.
        items: the items of all bodies, in the order of the scene.
        group: for each body, the first one of the ``ignoring`` line with it, or itself.
        named: the pairs of the ``between`` lines.
        nodes: the lines that are nodes.
    """

    def __init__(self, scene: Scene, rows: list[Row]) -> None:
        self.scene = scene
        self.line, span = rows[2]
        self.last = rows[-1]
        self.items: list[Item] = []
        for i, body in enumerate(scene.bodies):
            edges = body.edges or [(body.first, body.first)]
            self.items += [Item(i, *edge) for edge in edges]
        # The radius of the body of each vertex, as a place in the list of all radii.
        self.radii = sorted({body.radius for body in scene.bodies})
        kinds = {radius: k for k, radius in enumerate(self.radii)}
        self.kind: list[int] = []
        for body in scene.bodies:
            self.kind += [kinds[body.radius]] * body.size
        self.start, self.until = rational(span[1]), rational(span[2])
        require(scene.start <= self.start <= self.until <= scene.end, "not a span of the scene")
        self.distance = Fraction(0)
        self.selection = ""  # in words
        self.chosen = set[int]()  # bodies of which these are
        self.grouped = set[int]()
        self.named = set[Dart]()
        self.group = [*range(len(scene.bodies))]
        self.nodes: list[Row] = []
        for self.line, row in rows[3:-1]:
            self.read_line(row)

    def read_line(self, row: list[str]) -> None:
        """Read a line between the span and the last one."""
        kind, *given = row
        if kind == "distance":
            self.distance = rational(given[0])
            require(self.distance >= 0, "a distance below 0")
        elif kind in ("between", "ignoring"):
            self.read_selection(kind, [self.index(word, self.group) for word in given])
        else:
            self.nodes.append((self.line, row))

    def read_selection(self, kind: str, bodies: list[int]) -> None:
        """Read a line that says which pairs count."""
        is_new = len(set(bodies)) == len(bodies) and self.grouped.isdisjoint(bodies)
        require(is_new, "a body is there twice")
        self.chosen.update(bodies)
        self.selection += f"; {kind} {' '.join(f'b{i}' for i in bodies)}"
        if kind == "between":
            self.named.add((min(bodies), max(bodies)))
            return
        self.grouped.update(bodies)
        for i in bodies:
            self.group[i] = bodies[0]

    def index(self, word: str, things: Sequence[Any]) -> int:
        """Return the number of a body, a vertex or an item."""
        require(int(word) < len(things), f"not a number from 0 to {len(things) - 1}: {word}")
        return int(word)

    def item(self, word: str) -> Item:
        """Return the item with a number."""
        return self.items[self.index(word, self.items)]

    def count(self, bodies: set[int]) -> bool:
        """Return True if two of these bodies are a pair that counts."""
        if not self.named:
            return len({self.group[i] for i in bodies}) > 1
        return any(self.group[i] != self.group[j] for i, j in self.named if {i, j} <= bodies)

    def is_named(self, i: int, j: int) -> bool:
        """Return True if a pair is among the named ones, and not of one group."""
        spend(10)
        return (i, j) in self.named and self.group[i] != self.group[j]

    def has_all_that_count(self) -> bool:
        """Return True if all pairs that count in the scene count in the certificate.

        The certificate may have more: bodies that the scene ignores, and are apart nevertheless.
        """
        if not self.selection:
            return True
        return not any(self.scene.do_count(i, j) for i, j in self.left_out())

    def left_out(self) -> Iterator[Dart]:
        """Yield the pairs that do not count in the certificate."""
        everybody = range(len(self.group))
        if self.named:
            for i, j in combinations(everybody, 2):
                if not self.is_named(i, j):
                    yield i, j
            return
        of_group: dict[int, list[int]] = {}
        for i in everybody:
            of_group.setdefault(self.group[i], []).append(i)
        for bodies in of_group.values():
            yield from combinations(bodies, 2)

    def check_apart(self) -> None:
        """See that no two items of bodies that count have a common point from start to end."""
        nodes = iter(self.nodes)
        every = [*range(len(self.items))]
        todo = [(every, Interval(self.start, self.until))]
        while todo:
            items, time = todo.pop()
            spend(20 * (len(items) + len(self.named)))
            if not self.count({self.items[i].body for i in items}):
                continue
            self.line, (kind, *row) = next(nodes, (self.last[0], ["none"]))
            require(kind != "none", "a node is missing: two bodies are left together")
            if kind == "t":
                before, after = self.halves(time, row)
                todo += [(items, after), (items, before)]
                continue
            sides = self.sides(items, time, row) if kind == "c" else self.numbered(items, row)
            both = list(zip(items, sides, strict=True))
            todo.append(([i for i, side in both if side != -1], time))
            todo.append(([i for i, side in both if side != 1], time))
        require(next(nodes, None) is None, "there are more nodes than are needed")

    def halves(self, time: Interval, row: list[str]) -> tuple[Interval, Interval]:
        """Return the parts of an interval before and after a time inside it."""
        s, e = time.start, time.end
        q = rational(row[0]) if row else (s + e) / 2
        ends = f"{written(s):.200} and {written(e):.200}"
        require(s < q < e, f"{written(q):.200} is not between {ends}")
        return Interval(s, q), Interval(q, e)

    def numbered(self, items: list[int], row: list[str]) -> list[int]:
        """-1 for items of a body with numbers below K, 1 for those from K on; 0 of other bodies."""
        body, first = self.index(row[0], self.group), int(row[1])
        sides: list[int] = []
        for i in items:
            of_body = 1 if i >= first else -1
            sides.append(of_body if self.items[i].body == body else 0)
        return sides

    def sides(self, items: list[int], time: Interval, row: list[str]) -> list[int]:
        """-1 for items below a moving line, 1 for those above it by more than the distance; 0."""
        x, y, c = integer(row[0]), integer(row[1]), rational(row[2])
        v = rational(row[3]) if len(row) > 3 else Fraction(0)
        require(x or y, "a line without a direction")
        ends = [self.items[i][1:] for i in items]
        hulls = {u: time.hulls.get(u) or time.hull(self.scene, u) for u in {*chain(*ends)}}
        kinds = {self.kind[u] for u in hulls}
        planes = {k: planes_of(x, y, c, v, self.radii[k], self.distance) for k in kinds}
        size = max(words(low[3]) for low, _ in planes.values())
        spend(size * sum(map(time.work.__getitem__, hulls)))
        sides = {u: side_of(hull, *planes[self.kind[u]]) for u, hull in hulls.items()}
        return [sides[u] if sides[u] == sides[w] else 0 for u, w in ends]

    def check_outside(self) -> None:
        """See that at the start no ring is inside a body that counts with its own body."""
        bodies = self.scene.bodies
        is_first = self.start == self.scene.start
        places = [body.at_start if is_first else body.places(self.start) for body in bodies]
        at = [*chain(*places)]
        left = [(x << 256) // w for x, _, w in at]  # abscissas, rounded down in their order
        firsts: list[tuple[int, int, int]] = []  # of rings, from left to right
        for j, body in enumerate(bodies):
            firsts += [(left[ring[0]], ring[0], j) for ring, _ in body.rings]
        firsts.sort()
        for i, body in enumerate(bodies):
            if not body.closed:
                continue
            xs = left[body.first : body.first + body.size]
            low, high = bisect_left(firsts, (min(xs),)), bisect_left(firsts, (max(xs) + 1,))
            for _, v, j in firsts[low:high]:
                spend(20 * len(self.named))
                is_nested = self.count({i, j}) and self.is_inside(body, at[v], at)
                require(not is_nested, f"b{j} has a ring inside b{i} at the start")

    def is_inside(self, body: Body, p: Whole, at: Mapping[int, Whole] | list[Whole]) -> bool:
        """Return True if a ray from p crosses the rings of a closed body an odd number of times."""
        crossed = sum(surrounds([at[v] for v in ring], p) for ring, _ in body.rings)
        return body.closed and crossed % 2 == 1

    def check_contact(self, kind: str, given: list[str]) -> Met:
        """Check the last line, of a contact."""
        times = [rational(word) for word in given[:-2]]
        in_span = self.start <= min(times) and max(times) <= self.scene.end
        require(in_span, "a time outside of the span")
        one, other = given[-2:]
        if kind == "meet":
            met = self.check_meeting(times[0], one, other)
        elif kind == "inside":
            met = self.check_inside(times[0], one, other)
        else:
            met = self.check_crossing(times[0], times[1], one, other)
        i, j = met.bodies
        require(i != j and self.count({i, j}), "bodies that do not count as a pair")
        return met

    def check_meeting(self, t: Fraction, one: str, other: str) -> Met:
        """Check that two items are near each other at a time."""
        (i, a, b), (j, c, d) = self.item(one), self.item(other)
        bodies = self.scene.bodies
        far = self.distance + bodies[i].radius + bodies[j].radius
        near = are_near([self.scene.place(v, t) for v in (a, b, c, d)], far)
        require(near, "these are not near each other then")
        return Met(t, f"{self.short(a)} and {self.short(c)} at t = {written(t)}", (i, j))

    def check_inside(self, t: Fraction, vertex: str, number: str) -> Met:
        """Check that a vertex is inside a body at a time."""
        scene = self.scene
        v, j = self.index(vertex, scene.body_of), self.index(number, scene.bodies)
        body = scene.bodies[j]
        at = {u: scene.place(u, t) for u in body.vertices}
        require(self.is_inside(body, scene.place(v, t), at), "it is not inside then")
        return Met(t, f"{self.short(v)} inside b{j} at t = {written(t)}", (scene.body_of[v], j))

    def check_crossing(self, s: Fraction, t: Fraction, vertex: str, number: str) -> Met:
        """Check that a vertex passes through an edge in [s, t]."""
        scene = self.scene
        v = self.index(vertex, scene.body_of)
        i, (j, a, b) = scene.body_of[v], self.item(number)
        breaks = {q for k in (i, j) for q in scene.bodies[k].breaks if s < q < t}
        require(s < t and not breaks, "not a time of one formula")
        require_passage([scene.track(u, s) for u in (v, a, b)], s, t)
        when = f"in [{written(s)}, {written(t)}]"
        return Met(t, f"{self.short(v)} through {self.short(a)} {when}", (i, j))

    def short(self, v: int) -> str:
        """Return the name of a vertex, or of the edge that begins there."""
        return f"b{self.scene.body_of[v]}.{v - self.scene.of(v).first}"

    def run(self, accepted: str = "") -> Proved:
        """Check everything, and return the statement, after the words of a verdict."""
        self.line, (last, *given) = self.last
        met = None if last == "none" else self.check_contact(last, given)
        is_at_start = met is not None and met.time == self.start
        if is_at_start:
            alone = self.until == self.start and not self.nodes
            require(alone, "there is a contact at the start")
        else:
            require(met is None or self.until < met.time, "a contact before the end of the span")
            self.check_outside()
            self.check_apart()
        if met is not None:
            does_count = self.scene.do_count(*met.bodies)
            require(does_count, "the contact is one of two bodies that ignore each other")
        unproved = self.unproved(met)
        said = self.in_words(met, is_whole=not unproved)
        if unproved:
            span = f"[{written(self.scene.start)}, {written(self.scene.end)}]"
            rest = " and ".join(unproved)
            said += f"; the span of the scene is {span}: nothing is said of {rest}"
        of_bodies = about(is_modelled=self.scene.is_modelled)
        names = self.names(met)
        proved = Proved(f"{accepted}{of_bodies}{said}{self.selection}{names}")
        proved.low = self.until
        proved.until = met.time if met else self.until
        proved.kind = "first contact" if met else "no contact"
        if is_at_start:
            proved.kind = "contact at the start"
        proved.meets = met is not None and not self.distance
        is_from_start = self.start == self.scene.start
        proved.is_of_all = is_from_start and self.has_all_that_count()
        proved.whole = proved.is_of_all and not unproved
        return proved

    def unproved(self, met: Met | None) -> list[str]:
        """Return the parts of the span of the scene about which nothing is said."""
        first, end = self.scene.start, self.scene.end
        parts: list[str] = []
        if first < self.start:
            parts.append(f"[{written(first)}, {written(self.start)})")
        if met is None and self.until < end:
            parts.append(f"({written(self.until)}, {written(end)}]")
        return parts

    def in_words(self, met: Met | None, *, is_whole: bool) -> str:
        """Return what is proved, without the pairs and the rest of the span."""
        start, until = written(self.start), written(self.until)
        within = f"within {written(self.distance)}" if self.distance else ""
        if met is None:
            what = f"no two bodies {f'are {within}' if within else 'share a point'}"
            when = f"in [{start}, {until}]" if self.start < self.until else f"at t = {start}"
            whole = ", the whole span" if is_whole else ""
            return f"{what} {when}{whole}"
        if met.time == self.start:
            return f"two bodies {within or 'share a point'} at the start t = {start}: {met.words}"
        event = f"time {within}" if within else "contact"
        return f"first {event} of two bodies in ({until}, {written(met.time)}]: {met.words}"

    def names(self, met: Met | None) -> str:
        """Return the names of the bodies that are mentioned."""
        bodies = self.chosen | {*(met.bodies if met else ())}
        if not bodies:
            return ""
        said = [f"b{i} is {self.scene.bodies[i].name!a}" for i in sorted(bodies)]
        return f" ({', '.join(said)})"


# ---- Files, and what is wanted of them.


def check(scene_file: bytes, certificate: bytes, work: int | None = None) -> Proved:
    """Check a certificate; return its statement. May raise an exception as `proof_check.check`."""
    with budget(work, len(scene_file) + len(certificate)):
        size = max(len(scene_file), len(certificate))
        need(size <= MAX_BYTES, "or the certificate: too many bytes")
        try:
            if certificate.startswith(b"exactpt-apart-rows 1\n"):
                return check_rows(scene_file, certificate)
            return check_one(scene_file, certificate)
        except UnicodeDecodeError:
            raise NoProofError("a file is not UTF-8") from None


def require_scene(*, is_it: bool) -> None:
    """Refuse a certificate of another scene than the one that is given."""
    if not is_it:
        raise NoProofError("the certificate was made for a different scene: the hashes differ")


def check_one(scene_file: bytes, certificate: bytes) -> Proved:
    """Check a certificate of one scene."""
    text = scene_file.decode("utf-8-sig")
    rows = read(certificate, FORMAT)
    digest = hashlib.sha256(scene_file).hexdigest()
    _, (_, _, digest_of_scene) = rows[1]
    require_scene(is_it=digest_of_scene == digest)
    scene = Scene(text, are_records_verified=False)
    line, checker = rows[2][0], None
    try:
        checker = Checker(scene, rows)
        return checker.run(f"accepted: {digest[:16]} ")
    except Rejected as why:
        raise Rejected(f"rejected: line {checker.line if checker else line}: {why}") from None


def check_rows(scene_file: bytes, certificate: bytes) -> Proved:
    """Check a certificate of many scenes, a line each, with ; between its lines; or only "open"."""
    scenes = scene_file.decode("utf-8-sig").split("\n")
    digest = hashlib.sha256(scene_file).hexdigest()
    head = f"exactpt-apart-rows 1\nscenes sha256 {digest}\n"
    require_scene(is_it=certificate.startswith(head.encode()))
    rows = certificate.decode().split("\n")[2:]
    ends = [scenes.pop(), rows.pop()] if scenes and rows else ["no line"]
    need(ends == ["", ""], "or the certificate: a last line without an end:", ends)
    need(len(scenes) == len(rows), "the numbers of scenes and of rows differ:", len(rows))
    found = dict.fromkeys(("no contact", "first contact", "contact at the start", "open"), 0)
    is_modelled = False  # in one of the scenes
    for k, (text, row) in enumerate(zip(scenes, rows, strict=True), 1):
        scene = Scene(text, are_records_verified=False)
        is_modelled |= scene.is_modelled
        try:
            found[kind_of_row(scene, row)] += 1
        except Rejected as why:
            raise Rejected(f"rejected: row {k}: {why}") from None
    said = ", ".join(f"{kind} in {n}" for kind, n in found.items() if n)
    of_bodies = about(is_modelled=is_modelled)
    what = f"{len(rows)} rows, each of two or more bodies in the whole span: {said}"
    proved = Proved(f"accepted: {digest[:16]} {of_bodies}{what}")
    proved.until = Fraction(0)
    proved.whole = not found["open"]
    return proved


def kind_of_row(scene: Scene, row: str) -> str:
    """Check a row, which is about the whole of its scene; return what it proves, or "open"."""
    if row == "open":
        return row
    lines = row.replace(";", "\n")
    text = f"exactpt-apart 1\nscene sha256 -\n{lines}"
    checker = Checker(scene, read(text.encode(), FORMAT))
    is_of_contacts = len(scene.bodies) > 1 and not checker.distance
    require(is_of_contacts, "no contacts of two bodies")
    proved = checker.run()
    require(proved.whole, f"only a part is proved: {proved}")
    return proved.kind


class Answer(NamedTuple):
    """An answer of `exactpt collide --json`.

    ``until`` is the end of the span without a contact. With one, its time is between ``low`` and
    ``high``, a root of f, and ``kind`` is that of the contact.
    """

    until: Fraction | None = None
    low: Fraction = Fraction(0)
    high: Fraction = Fraction(0)
    f: Poly = Poly()
    kind: str = ""

    def sign_at(self, t: Fraction) -> int:
        """Return the sign of f at a time."""
        return self.f.sign_at(t)


def read_answer(answer: bytes) -> Answer:
    """Return an answer; refuse what is none."""
    try:
        data = read_json(answer.decode("utf-8-sig"))
        check_json(data, 32)
        if data["contact"] is None:
            return Answer(until=number(data["until"]))
        time, kind = data["contact"]["time"], data["contact"]["kind"]
        low, high = number(time["low"]), number(time["high"])
        terms = entries(time["polynomial"])
        need(all(re.fullmatch("-?[0-9]+", c) for c in terms), "no polynomial:", terms)
        f = Poly(map(integer, terms))
        is_rational_time = low == high and f and f.sign_at(low) == 0
        is_root = low < high and f.sign_at(low) * f.sign_at(high) < 0
        if not is_rational_time and not is_root:
            raise ValueError("no time")
    except (ValueError, KeyError, TypeError, RecursionError, NoProofError) as error:
        raise NoProofError(f"the answer is none of exactpt collide --json: {error!a:.60}") from None
    return Answer(None, low, high, f, kind)


def differs(proved: Proved, given: bytes) -> str:
    """Return how the output of `exactpt collide --json` differs from the statement; "" if not."""
    answer = read_answer(given)
    if answer.until is not None:
        return "" if proved.low >= answer.until else "no contact is the answer of"
    if not proved.meets or answer.kind == "self":
        return "a contact that is not certified is the answer of"
    # The time T of the answer has to be after a and at most b: f changes its sign at T alone.
    a, b, low, high = proved.low, proved.until, answer.low, answer.high
    is_at_start = low == high == a == b
    is_after = low > a or (high > a and answer.sign_at(a) * answer.sign_at(low) > 0)
    is_before = high <= b or (low < b and answer.sign_at(b) * answer.sign_at(high) >= 0)
    is_same = (is_after or is_at_start) and is_before
    return "" if is_same else "another time is the answer of"


class Call(NamedTuple):
    """What is asked for: the files of a scene and a certificate, and what it has to prove."""

    scene: Path
    certificate: Path
    until: Fraction | None = None
    is_partial: bool = False
    answer: str = ""
    work: int | None = None


def call_of(arguments: list[str]) -> Call:
    """Return what is asked for by the words of a command."""
    paths = list[Path]()
    given = dict[str, str]()
    rest = iter(arguments)
    for word in rest:
        if word == "--partial":
            given[word] = ""
        elif word in ("--until", "--expect", "--work"):
            given[word] = next(rest, "-")
        else:
            paths.append(Path(word))
    until, work = given.get("--until"), given.get("--work")
    answer, is_partial = given.get("--expect", ""), "--partial" in given
    are_numbers = is_rational(until or "0") and re.fullmatch("[0-9]{1,18}", work or "0")
    # An end of the span is one wish, the others are another one.
    is_one_wish = not (until and (answer or is_partial))
    if len(paths) != 2 or not are_numbers or not is_one_wish:
        raise NoProofError(f"usage: {USAGE}")
    scene, certificate = paths
    end = rational(until) if until else None
    most_work = None if work is None else int(work)
    return Call(scene, certificate, end, is_partial, answer, most_work)


def answered(call: Call) -> Proved:
    """Return what is proved, if it is what is asked for."""
    scene, text = file_bytes(call.scene), file_bytes(call.certificate)
    if call.answer and text.startswith(b"exactpt-apart-rows "):
        raise NoProofError("rows have many answers: --expect is for one")
    proved = check(scene, text, call.work)
    is_enough = proved.whole or call.is_partial
    if proved.is_of_all and not is_enough:
        is_up_to = call.until is not None and call.until <= proved.until
        is_enough = is_up_to or bool(call.answer)
    require(is_enough, f"rejected: proved is only a part (see --until, --partial): {proved}")
    if call.answer:
        reason = differs(proved, file_bytes(Path(call.answer)))
        require(not reason, f"rejected: {reason} {call.answer!a}; proved is: {proved}")
    return proved


def main(arguments: list[str]) -> int:
    """Check a file; the exit code."""
    try:
        if arguments == ["--version"]:
            return say(hashlib.sha256(Path(__file__).read_bytes()).hexdigest(), 0, sys.stdout)
        return say(answered(call_of(arguments)), 0, sys.stdout)
    except Rejected as verdict:
        return say(str(verdict), 1, sys.stdout)
    except Exhausted as verdict:
        return say(str(verdict), 4, sys.stdout)
    except (NoProofError, OSError, ValueError) as error:
        return say(str(error), 2, sys.stderr)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
