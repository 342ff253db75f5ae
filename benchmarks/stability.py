"""The same first contact for extreme input, and the cost of finding it.

One scene is scaled, shifted, given with more digits, reparametrized in time by a polynomial of
higher degree, or combined with a slightly delayed copy of itself. In each case the features
that touch must be the same, and the time must agree exactly.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from random import Random
from statistics import median
from typing import Final, NamedTuple, TypeVar

from benchmarks.output import Output, Row
from benchmarks.plots import series_of
from benchmarks.timing import timed
from exactpt.errors import AuditError
from exactpt.geometry.predicates import Point
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, ZZ, power_of_two
from exactpt.kernel.polynomial import ZERO, Polynomial
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.motion.track import track
from exactpt.pair.contact import Contact
from exactpt.scene.scene import Scene
from exactpt.search.first import first_contact
from exactpt.testing.scenes.shapes import cells, convex_polygon, poly

__all__ = ["FULL", "QUICK", "Sizes", "run"]

METHODS: Final = ("kinetic", "pairs")
TIME: Final = Polynomial([0, 1])
T = TypeVar("T")

AWAY: Final = 10**5
"""A distance larger than the extent of the scene at all times."""


class Sizes(NamedTuple):
    """Size of the benchmark.

    Attributes:
        bodies: number of bodies of the scene.
        scales, shifts: powers of two.
        digits: numbers of digits of numerator and denominator of a factor of all coordinates.
        degrees: degrees of the clock; the degree of the motion is twice that.
        delays: e for a copy delayed by 10^-e.
        runs: number of runs, of which the median counts.
    """

    bodies: int
    scales: Sequence[int]
    shifts: Sequence[int]
    digits: Sequence[int]
    degrees: Sequence[int]
    delays: Sequence[int]
    runs: int


QUICK: Final = Sizes(6, (-1000, 1000), (50, 200), (10, 1000), (1, 2, 6), (10, 300), 1)
FULL: Final = Sizes(
    20,
    (-1000, -300, -100, -10, 10, 100, 300, 1000),
    (30, 50, 100, 200),
    (10, 100, 1000, 10_000),
    tuple(range(1, 7)),
    (10, 16, 100, 300, 1000),
    3,
)


class _Mover(NamedTuple):
    """A body of the scene: its outline and its translation."""

    name: str
    outline: list[Point]
    x: Polynomial
    y: Polynomial


class _Case(NamedTuple):
    """A modification of the scene.

    Attributes:
        what, by: a description and the amount, in words.
        scene: makes a new copy of the modified scene, without cached values.
        clock: the time of the original scene as a function of the time of the modified one.
    """

    what: str
    by: str
    scene: Callable[[], Scene]
    clock: Polynomial


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Find the first contact of every modified scene.

    Raises:
        AuditError: if a result differs.
    """
    movers = _movers(sizes.bodies, seed)
    for method in METHODS:  # imports on first use are not timed
        first_contact(_scene(movers), method=method)
    rows: list[Row] = []
    for method in METHODS:
        base: tuple[Contact, float] | None = None
        for case in _cases(movers, sizes, Random(f"stability:{seed}")):
            output.progress(f"{method}: {case.what} {case.by}")
            contact, seconds = _ask(case, method, sizes.runs)
            if base is None:
                base = contact, seconds
            _demand_equal(base[0], contact, case)
            rows.append(
                {
                    "what": case.what,
                    "by": case.by,
                    "method": method,
                    "same answer": "yes",
                    "seconds": seconds,
                    "ratio": seconds / base[1],
                }
            )
    output.table("stability", rows)
    for what, axis in (("digits", "digits"), ("degree", "degree of the motion")):
        series = series_of((r for r in rows if r["what"] == what), "method", "by", "ratio")
        output.lines(f"stability-{what}", f"Cost against {axis}", (axis, "times the cost"), series)


def _ask(case: _Case, method: str, runs: int) -> tuple[Contact, float]:
    """The contact, and the median of the seconds."""
    asked = [timed(partial(first_contact, case.scene(), method=method)) for _ in range(runs)]
    contact = asked[0][0]
    if contact is None:
        raise AuditError(f"stability, {case.what} {case.by}: no contact")
    return contact, median(seconds for _, seconds in asked)


def _demand_equal(base: Contact, contact: Contact, case: _Case) -> None:
    """Check that the same features touch, at a time that the clock maps to the original one."""
    features = [
        [(p.body, p.vertex, p.other, p.edge, p.other_vertex) for p in found.pairs]
        for found in (base, contact)
    ]
    if features[0] != features[1] or not _is_image(base.time, contact.time, case.clock):
        raise AuditError(f"stability, {case.what} {case.by}: {contact} is not {base}")


def _is_image(base: AlgebraicNumber, time: AlgebraicNumber, clock: Polynomial) -> bool:
    """Return True if clock(time) is base, the only root of its polynomial in its interval."""
    image = ZERO
    for c in reversed(base.exact_polynomial):
        image = image * clock + Polynomial([c])
    low, high = base.exact_canonical_interval()
    signs = [_sign(image, time), _sign(clock - poly(low), time), _sign(poly(high) - clock, time)]
    return signs[0] == 0 and min(signs) >= 0


def _sign(f: Polynomial, time: AlgebraicNumber) -> int:
    return time.sign_of(track(f, ZERO, None, None).x)


def _movers(count: int, seed: int) -> list[_Mover]:
    """Convex bodies on parabolas, with a first contact at an irrational time in (0, 1)."""
    for attempt in range(1000):
        rng = Random(f"stability:{seed}:{attempt}")
        movers = []
        for i, c in enumerate(cells(rng, count, 100)):
            outline = convex_polygon(rng, c, 40, 6)
            x, y = (poly(0, rng.randint(-80, 80), rng.randint(-20, 20)) for _ in range(2))
            movers.append(_Mover(f"b{i}", outline, x, y))
        contact = first_contact(_scene(movers))
        if contact is not None and contact.kind != "initial" and not contact.time.is_rational:
            return movers
    raise AuditError("no scene has a contact at an irrational time")


def _scene(movers: Sequence[_Mover]) -> Scene:
    bodies = [Body(m.name, m.outline, Translation(m.x, m.y)) for m in movers]
    return Scene(bodies, (0, 1))


def _cases(movers: Sequence[_Mover], sizes: Sizes, rng: Random) -> Iterator[_Case]:
    yield _Case("nothing", "", partial(_scene, movers), TIME)
    for e in sizes.scales:
        yield _Case("scale", f"2^{e}", _changed(_scaled, movers, power_of_two(e)), TIME)
    for e in sizes.shifts:
        yield _Case("shift", f"2^{e}", _changed(_shifted, movers, power_of_two(e)), TIME)
    for n in sizes.digits:
        p, q = (rng.randrange(10 ** (n - 1), 10**n) for _ in range(2))
        yield _Case("digits", str(n), _changed(_scaled, movers, QQ(ZZ(p), ZZ(q))), TIME)
    for d in sizes.degrees:
        clock = _clock(d)
        yield _Case("degree", str(2 * d), _changed(_retimed, movers, clock), clock)
    for e in sizes.delays:
        late = QQ(ZZ(1), ZZ(10) ** e)
        yield _Case("late copy", f"10^-{e}", _changed(_doubled, movers, late), TIME)


def _changed(
    change: Callable[[Sequence[_Mover], T], list[_Mover]], movers: Sequence[_Mover], by: T
) -> Callable[[], Scene]:
    return lambda: _scene(change(movers, by))


def _clock(degree: int) -> Polynomial:
    """The increasing map (t^d + t) / 2 of [0, 1] to itself."""
    return poly(0, 1) if degree == 1 else Polynomial([0, "1/2", *[0] * (degree - 2), "1/2"])


def _scaled(movers: Sequence[_Mover], factor: QQ) -> list[_Mover]:
    f = Polynomial([factor])
    return [
        _Mover(m.name, [(x * factor, y * factor) for x, y in m.outline], m.x * f, m.y * f)
        for m in movers
    ]


def _shifted(movers: Sequence[_Mover], by: QQ) -> list[_Mover]:
    return [_Mover(m.name, [(x + by, y - by) for x, y in m.outline], m.x, m.y) for m in movers]


def _retimed(movers: Sequence[_Mover], clock: Polynomial) -> list[_Mover]:
    return [_Mover(m.name, m.outline, _composed(m.x, clock), _composed(m.y, clock)) for m in movers]


def _doubled(movers: Sequence[_Mover], late: QQ) -> list[_Mover]:
    """The scene preceded by a copy of it that is delayed and far away."""
    clock = poly(-late, 1)
    copies = [
        _Mover(f"late {m.name}", [(x + AWAY, y) for x, y in m.outline], m.x, m.y) for m in movers
    ]
    return [*_retimed(copies, clock), *movers]


def _composed(f: Polynomial, clock: Polynomial) -> Polynomial:
    """The composition f(clock(t))."""
    value = ZERO
    for c in reversed(f.exact_coefficients):
        value = value * clock + Polynomial([c])
    return value
