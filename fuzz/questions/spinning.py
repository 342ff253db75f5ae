"""Bounds of the first contact of bodies that turn, or move on paths, against its true time.

The width is compared with what error and speed allow. Let E be the sum of the errors of the two
bodies that meet: a point may be out of place by its distance from the pivot times the error of
the angle, and the place error of a path. Let v be the least speed, between the bounds, at which
they approach: that of a vertex to the line of the edge to which it comes, or to another vertex. So
long as bodies are within E they may be in contact, and that lasts E / v before the contact; the
width may be 4 E / v. Bodies *may graze* if they are within E at the start, if the vertex does not
approach all the time (v <= 0), if an end of the edge is within 2 E of the foot, or if other
vertices and edges are within E, too, before the contact; without an upper bound also if the vertex
does not go on into the body until 4 E / v after the lower bound.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, pairwise
from random import Random
from typing import Final, NamedTuple

import mpmath

from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.local_time import Velocity
from exactpt.motion.motions import Translation
from exactpt.motion.pose_path import PosePath
from exactpt.motion.spin import Spin
from exactpt.scene.scene import Scene
from exactpt.search.enclosed import EnclosedContact, first_contact_enclosed
from exactpt.testing.scenes import SPINNING
from fuzz.references.true_turns import DIGITS, Approach, Real, Truth, UndecidedError, real

__all__ = ["Case", "case_of", "path_scene", "spinning_scene"]

SAMPLES: Final = 16
MOST: Final = 4
"""How many times as wide as E / v bounds may be."""
PARTS: Final = 4
"""Widths are counted in parts of E / v: so many make one."""


class Case(NamedTuple):
    """Return the kind of a scene, and the fault of the bounds of its first contact."""

    kind: str
    fault: str | None


def spinning_scene(random: Random) -> Scene:
    """A scene of gears, mills or orbits."""
    return SPINNING[random.choice(sorted(SPINNING))](random)


def path_scene(random: Random) -> Scene:
    """Robots that turn along paths of one to three pieces, among obstacles at rest or in flight.

    The pieces of x and y are linear, cubic or, with a place error, quintic.
    """
    end = Fraction(random.randint(1, 4))
    bodies = [_robot(random, f"robot {i}", end) for i in range(random.choice([1, 1, 2]))]
    bodies += [_obstacle(random, f"b{i}") for i in range(random.randint(2, 5))]
    return Scene(bodies, time=(0, end))


def _obstacle(random: Random, name: str) -> Body:
    """Some corners of a square, perhaps rounded, at rest or in flight."""
    left = Fraction(random.randint(-30, 30), 8)
    bottom = Fraction(random.randint(-30, 30), 8)
    size = Fraction(random.randint(1, 8), 8)
    right = left + size
    top = bottom + size
    square = [(left, bottom), (right, bottom), (right, top), (left, top)]
    flight = Velocity(_number(random), _number(random))
    motion = random.choice([Translation(), flight])
    radius = Fraction(random.choice([0, 0, 1]), 5)
    corners = random.choice([1, 2, 3, 4])
    return Body(name, square[:corners], motion, radius=radius)


def _robot(random: Random, name: str, end: Fraction) -> Body:
    """A rectangle, an angle or a rounded segment on a path whose angle may make whole turns."""
    cuts = sorted(Fraction(random.randint(1, 15), 16) * end for _ in range(random.randint(0, 2)))
    times = sorted({Fraction(0), *cuts, end})
    degree = random.choice([1, 3, 3, 5])
    degrees = degree, degree, min(degree, 3)  # of x, y and the angle
    x = Fraction(random.randint(-24, 24), 8)
    y = Fraction(random.randint(-24, 24), 8)
    begins_at = [x, y, Fraction(0)]
    poses: list[list[list[Fraction]]] = []
    for begin, until in pairwise(times):
        pose = [
            _going_on(random, first, top) for first, top in zip(begins_at, degrees, strict=True)
        ]
        begins_at = [_value(f, until - begin) for f in pose]
        poses.append(pose)
    error = random.choice(["1/50", "1/1000", "1e-6", "1e-6", "1e-9"])
    place_error = error if degree > 3 else 0
    path = PosePath(times, poses, error=error, place_error=place_error)
    w = Fraction(random.randint(2, 8), 8)
    h = Fraction(random.randint(1, 4), 8)
    shapes: list[Body] = [
        Body(name, [(-w, -h), (w, -h), (w, h), (-w, h)], path),
        Body(name, [(w, 0), (0, 0), (0, 2 * h)], path, closed=False),
        Body(name, [(0, 0), (2 * w, 0)], path, radius=h / 2),
    ]
    return shapes[random.randrange(3)]


def _going_on(random: Random, first: Fraction, degree: int) -> list[Fraction]:
    """A polynomial with a first value, whose terms of high degree are small."""
    return [first, *(2 * _number(random) / (j * j) for j in range(1, degree + 1))]


def _value(f: list[Fraction], t: Fraction) -> Fraction:
    """The value of a polynomial."""
    return sum((c * t**j for j, c in enumerate(f)), Fraction(0))


def _number(random: Random) -> Fraction:
    """A number from -1 to 1."""
    return Fraction(random.randint(-512, 512), 512)


def case_of(scene: Scene) -> Case:
    """Return True if the true time is between the bounds, and these are near enough."""
    bounds = first_contact_enclosed(scene)
    if bounds is not None and any(name == other for name, other in bounds.pairs):
        return Case("a body and itself", None)  # the truth is about two bodies
    truth = Truth(scene)
    try:
        time = truth.first_contact()
    except UndecidedError:
        return Case("the truth grazes", None)
    with mpmath.workdps(DIGITS):
        return _compared(scene, truth, bounds, time)


def _compared(scene: Scene, truth: Truth, bounds: EnclosedContact | None, time: Real) -> Case:
    if bounds is None:
        return Case("never", None if time is None else f"none, but they meet at {time}")
    tiny = mpmath.mpf(10) ** -(DIGITS - 20)
    bounds.low.refine_to(scene.exact_end / 10**DIGITS)
    if time is not None and time < real(bounds.low.low) - tiny:
        return Case("too late", f"low {float(bounds.low)!r}, but they meet at {time}")
    if bounds.high is None:
        if time is not None and _allowed(scene, truth, bounds, time) is not None:
            return Case("not certain", f"no upper bound, but they meet at {time}")
        return Case("may graze, and does not" if time is None else "may graze, and meets", None)
    bounds.high.refine_to(scene.exact_end / 10**DIGITS)
    high = real(bounds.high.high)
    if time is None or time > high + tiny:
        return Case("too early", f"high {float(bounds.high)!r}, but they meet at {time}")
    if bounds.low == bounds.high:
        return Case("at the start" if bounds.low == scene.start else "exact", None)
    allowed = _allowed(scene, truth, bounds, time)
    if allowed is None:
        return Case("certain, and may graze", None)
    width = (high - real(bounds.low.low)) / allowed
    if width > MOST:
        return Case("certain, and wide", f"{mpmath.nstr(width, 6)} E / v wide")
    bound = int(mpmath.ceil(width * PARTS)) / PARTS
    return Case(f"certain, at most {bound} E / v wide", None)


def _allowed(scene: Scene, truth: Truth, bounds: EnclosedContact, time: Real) -> Real:
    """E / v; None if bodies may graze."""
    errors = [_error(body) for body in scene.bodies]
    low = real(bounds.low.low)
    near = {pair for t in _times(low, time) for pair in _near(truth, errors, float(t))}
    if len(near) != 1 or bounds.low == scene.start:
        return None
    (pair,) = near
    error = errors[pair.i] + errors[pair.j]
    if bounds.high is not None:
        return _time_within(truth, pair, error, low, time, real(bounds.high.high))
    first = _time_within(truth, pair, error, low, time, time)
    if first is None or low + MOST * first > truth.end:
        return None
    last = low + MOST * first
    return _time_within(truth, pair, error, low, last, last)


def _time_within(
    truth: Truth, pair: Approach, error: Real, low: Real, inner: Real, high: Real
) -> Real:
    """E / v; None if the vertex does not approach up to one time, or comes near an end before."""
    if any(not _is_inner(truth, pair, t, 2 * error) for t in _times(low, inner)):
        return None
    gaps = [truth.gap(pair, t) for t in _times(low, high)]
    towards = 1 if gaps[0] > 0 else -1
    speed = min(towards * (a - b) * SAMPLES / (high - low) for a, b in pairwise(gaps))
    return error / speed if speed > 0 else None


def _times(begin: Real, end: Real) -> list[Real]:
    """Times from a begin to an end, both included."""
    return [begin + (end - begin) * k / SAMPLES for k in range(SAMPLES + 1)]


def _error(body: Body) -> Real:
    """A bound on how far points of a body are out of place."""
    motion = body.motion
    if not isinstance(motion, (Spin, PosePath)):
        return mpmath.mpf(0)
    place_error = real(motion.place_error) if isinstance(motion, PosePath) else mpmath.mpf(0)
    pivot_x, pivot_y = motion.pivot
    pivot = mpmath.mpc(real(pivot_x), real(pivot_y))
    longest = max(_arm(x, y, pivot) for x, y in body.vertices)
    return longest * real(motion.error) + place_error


def _arm(x: Polynomial, y: Polynomial, pivot: Real) -> Real:
    """A bound on the distance of a vertex from a pivot up to t = 2: the sizes of its terms."""
    arm = mpmath.mpf(0)
    for k in range(max(x.degree, y.degree) + 1):
        term = mpmath.mpc(real(x[k]), real(y[k]))
        arm += abs(term - pivot if k == 0 else term) * 2**k
    return arm


def _near(truth: Truth, errors: list[Real], t: float) -> set[Approach]:
    """The vertices and edges of bodies that are within twice the sum of their errors."""
    found = set()
    for i, j in combinations(range(len(errors)), 2):
        reach = 2 * float(errors[i] + errors[j]) * 1.0001
        found |= {pair for pair in truth.approaches(t, reach) if {pair.i, pair.j} == {i, j}}
    return found


def _is_inner(truth: Truth, pair: Approach, t: Real, away: Real) -> bool:
    """Return True if the foot of a perpendicular is so far from the ends of an edge."""
    first, second = pair.ends
    places = truth.bodies[pair.j].places(t)
    p = places[first]
    q = places[second]
    if p == q:
        return True
    v = truth.bodies[pair.i].places(t)[pair.vertex]
    length = abs(q - p)
    along = ((q - p).conjugate() * (v - p)).real / length
    return bool(away <= along <= length - away)
