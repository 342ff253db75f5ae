"""Hostile cases for the predicates of moving vertices: with filters, without them, by definition.

A case is a few bodies, which may overlap, with few motions, and a time. Vertices are on one line,
a hair beside it, in one place, or so far away that doubles do not tell them apart; the time is
that of a tie as often as any other. By definition a predicate is the sign of a polynomial at that
time, just before it or just after it; the exact kernel decides that, and is tested by itself.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from random import Random
from typing import Final, TypeAlias

import numpy as np

from exactpt import Affine, AlgebraicNumber, Body, Rigid, Translation
from exactpt.certificates import coincidence
from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certifier import Certifier, least_first
from exactpt.certificates.one_sided import OneSided
from exactpt.certificates.perturbation import cross, orientation_polynomial, x_order, x_order_terms
from exactpt.certificates.predicates import Predicates
from exactpt.certificates.queue import EventTime
from exactpt.filters.rounding import INFINITY
from exactpt.kernel.integer_polynomial import IntPoly, evaluate
from exactpt.kernel.numbers import QQ, sign
from exactpt.kernel.roots import common_roots, roots_after
from exactpt.motion.motions import Motion
from exactpt.motion.track import difference
from exactpt.motion.track import orientation_polynomial as orientation_of_tracks
from exactpt.motion.vertex import Vertex
from exactpt.motion.vertices import Vertices

__all__ = ["Attack", "hostile", "wrong"]

Triple: TypeAlias = tuple[Vertex, Vertex, Vertex]

START: Final = QQ(0)
END: Final = QQ(4)

TRIPLES: Final = 12
"""Number of triples of vertices that are asked about in a case."""

SHAPES: Final = (
    [(0, 0)],
    [(0, 0)],
    [(0, 0), (1, 0)],
    [(0, 0), (0, 2)],
    [(0, 0), (2, 0), (0, 1)],
    [(0, 0), (1, 0), (1, 1), (0, 1)],
)
HAIRS: Final = (QQ(0), QQ(0), QQ(0), QQ(1), QQ(1, 3), QQ(1, 10**14), QQ(1, 10**16), QQ(1, 2**60))
FAR: Final = (QQ(0), QQ(0), QQ(0), QQ(-(10**6)), QQ(2**53 + 1), QQ(10**17), QQ(10**40))


class _WrongError(Exception):
    """A predicate is not as defined."""


@dataclass(frozen=True)
class Attack:
    """Moving vertices, and a time.

    Attributes:
        bodies: the bodies.
        time: the time, in the span from `START` to `END`.
        widened: how much wider the enclosure of the time is than it could be.
    """

    bodies: tuple[Body, ...]
    time: AlgebraicNumber
    widened: float = 0.0

    def __str__(self) -> str:
        bodies = [(body.size, body.motion, body.at(0)) for body in self.bodies]
        return f"{bodies} at t = {self.time!r}, the enclosure wider by {self.widened!r}"

    @cached_property
    def vertices(self) -> Vertices:
        """The moving vertices, copies of points and ends included."""
        return Vertices.of(self.bodies, START, END)

    def certifier(self, *, exact_only: bool) -> Certifier:
        """Return a certifier at the time."""
        certifier = Certifier(self.vertices, START, END, exact_only=exact_only)
        low, high = self.vertices.normalization.enclosure(self.time)
        event = EventTime(low, high + self.widened, -1, -1, -1, self.time)
        certifier.move_to(event, [])
        return certifier


# Cases


def hostile(random: Random) -> Attack:
    """Return a case."""
    motions = [_motion(random) for _ in range(random.randint(1, 3))]
    origin = random.choice(FAR), random.choice(FAR)
    step = QQ(random.randint(-9, 9), 7), QQ(random.randint(-9, 9), 7) or QQ(1)
    bodies = []
    for k in range(random.randint(3, 5)):
        along = QQ(random.randint(-9, 9), random.choice([1, 1, 4]))
        beside = random.choice(HAIRS), random.choice(HAIRS)
        x, y = (o + along * s + b for o, s, b in zip(origin, step, beside, strict=True))
        shape = [(x + u, y + v) for u, v in random.choice(SHAPES)]
        bodies.append(Body(f"b{k}", shape, random.choice(motions)))
    attack = Attack(tuple(bodies), AlgebraicNumber(_rational_time(random)))
    if random.random() < 0.6:
        attack = Attack(attack.bodies, _time_of_a_tie(random, attack))
    widened = random.choice([0.0, 0.0, 2.0**-40, 2.0**-20])
    return Attack(attack.bodies, attack.time, widened)


def _rational_time(random: Random) -> QQ:
    return QQ(random.randint(0, 32), 8) if random.random() < 0.7 else QQ(random.randint(0, 11), 3)


def _time_of_a_tie(random: Random, attack: Attack) -> AlgebraicNumber:
    """Return a time at which three vertices are on one line, if there is one."""
    for _ in range(5):
        a, b, c = random.sample(list(attack.vertices.all), 3)
        f = orientation_of_tracks(a.track, b.track, c.track)
        roots = [r.time for r in roots_after(f, AlgebraicNumber(START), END)] if f else []
        if roots:
            return random.choice(roots)
    return attack.time


def _motion(random: Random) -> Motion:
    kind = random.randrange(5)
    x, y = (_path(random, 3 if kind == 1 else 2) for _ in "xy")
    if kind <= 2:
        return Translation(x, y)
    half = random.choice([QQ(1), QQ(-1), QQ(1, 4)])
    if kind == 3:
        return Rigid([random.randint(-1, 1), half], pivot=(random.randint(-2, 2), 0), x=x, y=y)
    return Affine([[[1], [0, half]], [[0, random.randint(-1, 1)], [1]]], x=x, y=y)


def _path(random: Random, most: int) -> list[QQ]:
    return [_number(random) for _ in range(random.randint(0, most))]


def _number(random: Random) -> QQ:
    size = random.choice([3, 3, 3, 10**6])
    return QQ(random.randint(-size, size), random.choice([1, 1, 2, 7]))


# Definitions


@dataclass(frozen=True, slots=True)
class _Definition:
    """Predicates by definition: at a time (side 0), just before it (-1) or just after it (1)."""

    time: AlgebraicNumber
    side: int

    def sign(self, f: IntPoly) -> int:
        """Return the sign of a polynomial."""
        if not f:
            return 0
        if self.side == 0:
            return self.time.sign_of(f)
        return self.time.sign_after(f) if self.side > 0 else self.time.sign_before(f)

    def orientation(self, a: Vertex, b: Vertex, c: Vertex) -> int:
        return self.sign(orientation_polynomial(a, b, c))

    def is_left(self, a: Vertex, b: Vertex) -> bool:
        if self.side:
            return self.sign(x_order(a, b)) > 0
        return next((s for f in x_order_terms(a, b) if (s := self.sign(f))), 0) > 0

    def cross_sign(self, a: Vertex, b: Vertex, c: Vertex, d: Vertex) -> int:
        return self.sign(cross(a.track, b.track, c.track, d.track))

    def order(self, a: Vertex, b: Vertex, axis: int) -> int:
        """Return the sign of the difference of a coordinate, from a to b."""
        p, q = a.track, b.track
        f = difference(p.y, p.w, q.y, q.w) if axis else difference(p.x, p.w, q.x, q.w)
        return self.sign(f)


def wrong(random: Random, attack: Attack) -> tuple[str, str]:
    """Return the outcome of a case in words, and what is wrong; empty if nothing is."""
    vertices = list(attack.vertices.all)
    triples = [_sampled(random, vertices) for _ in range(TRIPLES)]
    before = attack.vertices.counters.now()
    try:
        for exact_only in (False, True):
            _check_certifier(attack, triples, exact_only=exact_only)
        _check_vectorized(attack, triples)
        _check_positions(attack, triples)
        if attack.time.simplified().is_rational:
            _check_at_time(attack, triples)
    except _WrongError as error:
        return "wrong", str(error)
    counted = attack.vertices.counters.now()
    exact, filtered = counted.exact - before.exact, counted.filtered - before.filtered
    share = round(10 * filtered / max(1, exact + filtered))
    return f"{10 * share} % by filters", ""


def _sampled(random: Random, vertices: list[Vertex]) -> Triple:
    a, b, c = random.sample(vertices, 3)
    return a, b, c


def _expect(what: str, found: object, expected: object, *about: Vertex) -> None:
    if found != expected:
        names = ", ".join(f"{v.body}:{v.index} (id {v.id})" for v in about)
        raise _WrongError(f"{what} of {names}: {found!r}, by definition {expected!r}")


# Predicates of the tilings


def _check_predicates(
    name: str, predicates: Predicates, defined: _Definition, triples: Iterable[Triple]
) -> None:
    """Compare orientations, orders from left to right, and turns of directions."""
    for a, b, c in triples:
        found = predicates.orientation(a.id, b.id, c.id)
        _expect(f"{name}: orientation", found, defined.orientation(a, b, c), a, b, c)
        left = predicates.left_of(a.id, b.id)
        _expect(f"{name}: left_of", left, defined.is_left(a, b), a, b)
        for four in ((a, b, a, c), (a, b, c, b), (a, b, c, a), (a, b, b, c)):
            turn = predicates.cross_sign(*(v.id for v in four))
            _expect(f"{name}: cross_sign", turn, defined.cross_sign(*four), *four)


def _check_at_time(attack: Attack, triples: list[Triple]) -> None:
    """Check the predicates at a rational time and just after it."""
    time = attack.time.simplified().exact_low
    for after in (False, True):
        defined = _Definition(attack.time, 1 if after else 0)
        fast, exact = (
            PredicatesAt(attack.vertices, time, after=after, exact_only=exact_only)
            for exact_only in (False, True)
        )
        for name, predicates in (("filtered", fast), ("exact", exact)):
            _check_predicates(f"{name} at a time", predicates, defined, triples)
        ids = [(a.id, b.id, c.id) for a, b, c in triples]
        for name, predicates in (("filtered", fast), ("exact", exact)):
            for triple, found in zip(triples, predicates.signs(ids), strict=True):
                _expect(f"{name} signs", found, defined.orientation(*triple), *triple)
        every = [v.id for v in attack.vertices.all]
        _expect("order by x", fast.sorted_by_x(every), exact.sorted_by_x(every))
    _check_descents(attack, triples, time)


def _check_descents(attack: Attack, triples: list[Triple], time: QQ) -> None:
    """Check that lines in the order of their descents are not steeper from one to the next."""
    fast, exact = (
        PredicatesAt(attack.vertices, time, after=False, exact_only=exact_only)
        for exact_only in (False, True)
    )
    steep: list[tuple[tuple[int, QQ], float]] = []
    for a, b, _ in triples:
        (ax, ay), (bx, by) = a.track.at(time), b.track.at(time)
        if ax > bx or (ax == bx and ay == by):
            continue
        descent = fast.descent(a.id, b.id)
        _expect("descent", descent, exact.descent(a.id, b.id), a, b)
        vertical = 1 if ay > by else -1
        slope = (0, (ay - by) / (bx - ax)) if ax < bx else (vertical, QQ(0))
        steep.append((slope, descent))
    steep.sort()
    descents = [descent for _, descent in steep]
    _expect("order of descents", descents, sorted(descents))


# Certificates, and places at the time


def _check_certifier(attack: Attack, triples: list[Triple], *, exact_only: bool) -> None:
    """Check certificates and places, and the predicates just before and just after the time."""
    name = "exact" if exact_only else "filtered"
    certifier = attack.certifier(exact_only=exact_only)
    for side, moment in ((-1, "before"), (1, "after")):
        one_sided = OneSided(certifier, before=side < 0)
        _check_predicates(f"{name}, {moment}", one_sided, _Definition(attack.time, side), triples)
    for a, b, c in triples:
        if not _coincide_for_all_times(a, b, c):
            _check_orientation(attack, certifier, name, (a, b, c))
            _check_x_order(attack, certifier, name, a, b)
        _check_places(certifier, _Definition(attack.time, 0), name, (a, b, c))


def _coincide_for_all_times(*vertices: Vertex) -> bool:
    """Return True if two vertices of the scene are in one place at all times, so bodies touch."""
    return any(
        (u.body, u.index) != (v.body, v.index)
        and not difference(u.track.x, u.track.w, v.track.x, v.track.w)
        and not difference(u.track.y, u.track.w, v.track.y, v.track.w)
        for u, v in combinations(vertices, 2)
    )


def _check_orientation(attack: Attack, certifier: Certifier, name: str, abc: Triple) -> None:
    """Check the sign of an orientation just after the time, and its first zero later."""
    side, event = certifier.orientation(*(v.id for v in abc))
    expected = _Definition(attack.time, 1).orientation(*abc)
    _expect(f"{name} certificate: sign", side, expected, *abc)
    zero = min(_zeros(attack, *abc), default=None)
    _expect(f"{name} certificate: zero", _number_of(certifier, event), zero, *abc)


def _zeros(attack: Attack, *abc: Vertex) -> Iterator[AlgebraicNumber]:
    """Yield the zeros of an orientation, and if it is always zero, times of coincidence."""
    base = orientation_of_tracks(*(v.track for v in abc))
    if base:
        yield from (root.time for root in roots_after(base, attack.time, END))
        return
    if of_copies := orientation_polynomial(*abc):
        yield from (root.time for root in roots_after(of_copies, attack.time, END))
    for u, v in combinations(abc, 2):
        p, q = u.track, v.track
        if u.float_track.motion == v.float_track.motion >= 0 or u.is_copy_of(v):
            continue
        dx, dy = difference(p.x, p.w, q.x, q.w), difference(p.y, p.w, q.y, q.w)
        yield from (root.time for root in common_roots(dx, dy, attack.time, END))


def _check_x_order(attack: Attack, certifier: Certifier, name: str, a: Vertex, b: Vertex) -> None:
    """Check which of two vertices is on the left just after the time, and until when."""
    f = x_order(a, b)
    if not f:
        return
    side, event = certifier.x_order(a.id, b.id)
    _expect(f"{name} x-order", side, _Definition(attack.time, 1).sign(f), a, b)
    roots = roots_after(f, attack.time, END)
    passes = min((root.time for root in roots if root.crossing), default=None)
    _expect(f"{name} x-order: end", _number_of(certifier, event), passes, a, b)


def _number_of(certifier: Certifier, event: EventTime | None) -> AlgebraicNumber | None:
    """Return the time of an event; None if it is after the end, which doubles need not decide."""
    if event is None:
        return None
    number = event.exact or certifier.resolve(event)
    return number if number.compare_rational(END) <= 0 else None


def _check_places(certifier: Certifier, now: _Definition, name: str, abc: Triple) -> None:
    """Check orders along axes and along a line, and incidences, at the time itself."""
    a, p, b = abc
    for axis in (0, 1):
        found = coincidence.coordinate_order(certifier, a, b, axis)
        _expect(f"{name} order along axis {axis}", found, now.order(a, b, axis), a, b)
    together = all(now.order(a, b, axis) == 0 for axis in (0, 1))
    _expect(f"{name} coincide", coincidence.coincide(certifier, a, b), together, a, b)
    is_on_line = now.sign(orientation_of_tracks(a.track, p.track, b.track)) == 0
    steps = [(now.order(a, p, axis), now.order(p, b, axis)) for axis in (0, 1)]
    lies_on = is_on_line and all(u * v >= 0 for u, v in steps)
    _expect(f"{name} lies_on", coincidence.lies_on(certifier, p, a, b), lies_on, p, a, b)
    if not (a.is_copy_of(p) or p.is_copy_of(b) or a.is_copy_of(b)):
        if is_on_line:
            _check_along_line(certifier, now, name, abc)
    elif a.is_copy_of(b) and not a.is_copy_of(p) and now.time.simplified().is_rational:
        _check_copies(certifier, now, name, abc)


def _check_along_line(certifier: Certifier, now: _Definition, name: str, abc: Triple) -> None:
    """Check the order of three vertices on one line."""
    a, p, b = abc
    steps = [(now.order(a, p, axis), now.order(p, b, axis)) for axis in (0, 1)]
    between = all(u == v for u, v in steps) and any(u for u, _ in steps)
    found = coincidence.strictly_between(certifier, a, p, b)
    _expect(f"{name} strictly_between", found, between, a, p, b)
    if any(u * v > 0 for u, v in steps):
        return  # a and b are on different sides of p
    ahead = [(now.order(a, b, axis), now.order(p, b, axis)) for axis in (0, 1)]
    apart = [(u, v) for u, v in ahead if u]
    nearer = 0 if not apart else 1 if apart[0][0] == apart[0][1] else -1
    _expect(f"{name} nearer", coincidence.nearer(certifier, p, a, b), nearer, p, a, b)


def _check_copies(certifier: Certifier, now: _Definition, name: str, abc: Triple) -> None:
    """Check which of two copies of a vertex, a or b, is displaced further towards p."""
    a, p, b = abc
    time = now.time.simplified().exact_low
    (x, y), (px, py) = a.track.at(time), p.track.at(time)
    ahead = QQ(0)
    for k, step in enumerate((px - x, py - y)):
        of_a, of_b = (evaluate(v.offset[k], time) if v.offset else QQ(0) for v in (a, b))
        ahead += (of_a - of_b) * step
    found = coincidence.nearer_copy(certifier, p, a, b)
    _expect(f"{name} nearer_copy", found, sign(ahead), p, a, b)
    if ahead:
        near, other = (a, b) if ahead > 0 else (b, a)
        for u, v, w in ((near, p, other), (p, near, other), (other, near, p), (near, other, p)):
            found_between = coincidence.strictly_between(certifier, u, v, w)
            _expect(f"{name} strictly_between", found_between, v is near, u, v, w)


def _check_vectorized(attack: Attack, triples: list[Triple]) -> None:
    """Check what numpy decides about many certificates: all signs, and enclosures of zeros."""
    certifier = attack.certifier(exact_only=False)
    rows = np.array([least_first(a.id, b.id, c.id) for a, b, c in triples])
    later = _Definition(attack.time, 1)
    number = dict(enumerate(attack.vertices.all))
    for row, side, low, high in zip(rows.tolist(), *certifier.orientations(rows), strict=True):
        a, b, c = (number[v] for v in row)
        if side == 0:
            continue
        _expect("vectorized certificate: sign", side, later.orientation(a, b, c), a, b, c)
        event = None if low == INFINITY else EventTime(low, high, a.id, b.id, c.id)
        zero = min(_zeros(attack, a, b, c), default=None)
        _expect("vectorized certificate: zero", _number_of(certifier, event), zero, a, b, c)


# Positions in doubles


def _check_positions(attack: Attack, triples: list[Triple]) -> None:
    """Check that signs by positions are those in all of the enclosure of the time."""
    certifier = attack.certifier(exact_only=False)
    positions, normalization = certifier.positions, attack.vertices.normalization
    ends = (normalization.exact_time(t) for t in (certifier.now_low, certifier.now_high))
    inside = [QQ(t) for t in ends if START <= t <= END]
    moments = [_Definition(AlgebraicNumber(t), 0) for t in inside]
    moments.append(_Definition(attack.time, 0))
    for a, b, c in triples:
        asked = {
            "orientation": (positions.orientation(a, b, c), (a, b, c)),
            "turn": (positions.cross_sign(a, b, b, c), (a, b, b, c)),
            "order": (positions.order(a, b, 1), (a, b)),
        }
        for name, (found, about) in asked.items():
            for now in moments if found else ():
                _expect(f"{name} by positions", found, _by_tracks(now, name, about), *about)
    if attack.time.simplified().is_rational:
        _check_boxes(attack, certifier)


def _check_boxes(attack: Attack, certifier: Certifier) -> None:
    """Check that the boxes of vertices contain their positions, normalised."""
    vertices, normalization = list(attack.vertices.all), attack.vertices.normalization
    boxes = coincidence.boxes_now(certifier, vertices)
    for vertex, (left, right, low, high) in zip(vertices, boxes.tolist(), strict=True):
        place = vertex.track.at(attack.time.simplified().exact_low)
        for axis, (least, most) in enumerate(((left, right), (low, high))):
            moved = place[axis] - normalization.center[axis]
            if not least <= moved / QQ(2) ** normalization.scale[axis] <= most:
                raise _WrongError(f"box of {vertex.body}:{vertex.index}: without its position")


def _by_tracks(now: _Definition, name: str, about: tuple[Vertex, ...]) -> int:
    """Return a sign by the trajectories of vertices, without infinitesimal displacements."""
    if name == "orientation":
        return now.sign(orientation_of_tracks(*(v.track for v in about)))
    if name == "turn":
        return now.cross_sign(*about)
    return now.order(about[0], about[1], 1)
