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
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import chain, combinations, pairwise
from math import comb, isqrt, lcm
from pathlib import Path
from typing import Any

from exactpt.proof_scene import (
    MAX_BYTES,
    MAX_DIGITS,
    Body,
    Dart,
    Exhausted,
    Format,
    NoProofError,
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


FORMAT = Format(FORMS, ORDER, is_bounded)


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
    """Return two linear forms of (w x, w y, w t, w), one for each side of a moving line.

    Paths that are below the first one, and not below the second one, are farther than r from the
    line on both sides, and than r + far on the second.
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
        """Return the number of a body, a vertex or an item."""
        require(int(word) < len(things), f"not a number from 0 to {len(things) - 1}: {word}")
        return int(word)

    def count(self, bodies: set[int]) -> bool:
        """Return True if two of these bodies are a pair that counts."""
        if not self.named:
            return len({self.group[i] for i in bodies}) > 1
        return any(self.group[i] != self.group[j] for i, j in self.named if {i, j} <= bodies)

    def has_all_that_count(self) -> bool:
        """Return True if all pairs that count in the scene count in the certificate.

        The certificate may have more: bodies that the scene ignores, and are apart nevertheless.
        """
        everybody = range(len(self.group))
        left_out: Iterable[Dart]
        if not self.selection:
            return True
        if self.named:  # no other pairs count in the certificate
            left_out = (pair for pair in combinations(everybody, 2) if not self.is_named(*pair))
        else:  # all pairs do, but for those of one group of the certificate
            of_group: dict[int, list[int]] = {}
            for i in everybody:
                of_group.setdefault(self.group[i], []).append(i)
            left_out = chain.from_iterable(combinations(some, 2) for some in of_group.values())
        return not any(self.scene.do_count(i, j) for i, j in left_out)

    def is_named(self, i: int, j: int) -> bool:
        """Return True if a pair is among the named ones, and not of one group."""
        spend(10)
        return (i, j) in self.named and self.group[i] != self.group[j]

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
        """Return the name of a vertex, or of the edge that begins there."""
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
            shown = "contact at the start"
            text = f"two bodies {what or 'share a point'} at the start t = {written(a)}: {how}"
        else:
            require(not found or low < high, "a contact before the end of the span")
            self.check_outside()
            self.check_apart()
            shown = "first contact" if found else "no contact"
            event = f"time {what}" if what else "contact"
            text = f"first {event} of two bodies in ({written(low)}, {written(high)}]: {how}"
        if not found:
            text = f"no two bodies {f'are {what}' if what else 'share a point'} "
            text += f"in [{written(a)}, {written(low)}]" if a < low else f"at t = {written(a)}"
            text += ", the whole span" * (not rest)
        if rest:
            span = f"[{written(first)}, {written(end)}]"
            text += f"; the span of the scene is {span}: nothing is said of {' and '.join(rest)}"
        chosen = sorted({*bodies, *self.chosen})
        said = ", ".join(f"b{i} is {self.scene.bodies[i].name!a}" for i in chosen)
        names = f" ({said})" if said else ""
        of_bodies = about(is_modelled=self.scene.is_modelled)
        proved = Proved(f"{accepted}{of_bodies}{text}{self.selection}{names}")
        proved.low, proved.until, proved.meets = low, high, kind != "none" and not self.distance
        proved.kind = shown
        is_of_scene = not bodies or self.scene.do_count(*bodies)
        proved.is_of_all = is_of_scene and self.has_all_that_count() and a == first
        proved.whole = not rest and proved.is_of_all
        return proved


def check(scene_file: bytes, certificate: bytes, work: int | None = None) -> Proved:
    """Check a certificate; return its statement. May raise an exception as `proof_check.check`."""
    line, checker = 0, None
    with budget(work, len(scene_file) + len(certificate)):
        try:
            size = max(len(scene_file), len(certificate))
            need(size <= MAX_BYTES, "or the certificate: too many bytes")
            text, digest = scene_file.decode("utf-8-sig"), hashlib.sha256(scene_file).hexdigest()
            many = certificate.startswith(b"exactpt-apart-rows 1\n")
            rows = [] if many else read(certificate, FORMAT)
            head = f"exactpt-apart-rows 1\nscenes sha256 {digest}\n".encode()
            if not certificate.startswith(head) if many else rows[1][1][2] != digest:
                raise NoProofError(
                    "the certificate was made for a different scene: the hashes differ"
                )
            accepted = f"accepted: {digest[:16]} "
            if many:
                return check_rows(accepted, text.split("\n"), certificate.decode().split("\n")[2:])
            scene, line = Scene(text, are_records_verified=False), rows[2][0]
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
    is_modelled = False  # in one of the scenes
    for k, (scene, row) in enumerate(zip(scenes, rows, strict=True), 1):
        made, kind = Scene(scene, are_records_verified=False), "open"
        is_modelled |= made.is_modelled
        if row != "open":
            lines_of_row = row.replace(";", "\n")
            lines = read(f"exactpt-apart 1\nscene sha256 -\n{lines_of_row}".encode(), FORMAT)
            try:
                checker = Checker(made, lines)
                require(len(made.bodies) > 1 and not checker.distance, "no contacts of two bodies")
                proved = checker.run()
                require(proved.whole, f"only a part is proved: {proved}")
            except Rejected as why:
                raise Rejected(f"row {k}: {why}") from None
            kind = proved.kind
        found[kind] += 1
    said = ", ".join(f"{kind} in {n}" for kind, n in found.items() if n)
    text = f"{len(rows)} rows, each of two or more bodies in the whole span: {said}"
    proved = Proved(f"{accepted}{about(is_modelled=is_modelled)}{text}")
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
