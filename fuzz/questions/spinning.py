"""Bounds of the first contact of bodies that turn at a constant rate, against its true time.

The width is compared with what error and speed allow. Let E be the sum of the errors of the two
bodies that meet: a point may be out of place by its distance from the pivot times the error of
the angle. Let v be the least speed, between the bounds, at which they approach: that of a vertex
to the line of the edge to which it comes, or to another vertex. So long as bodies are within E
they may be in contact, and that lasts E / v before the contact; the width may be 4 E / v. Bodies
*may graze* if they are within E at the start, if the vertex does not approach all the time (v <=
0), if an end of the edge is within 2 E of the foot, or if other vertices and edges are within E,
too, before the contact; without an upper bound also if the vertex does not go on into the body
until 4 E / v after the lower bound.
"""

from __future__ import annotations

from itertools import combinations, pairwise
from random import Random
from typing import Any, Final, NamedTuple

import mpmath

from exactpt.collision.enclosed import EnclosedContact, first_contact_enclosed
from exactpt.motion.body import Body
from exactpt.motion.spin import Spin
from exactpt.scene.generate import SPINNING
from exactpt.scene.scene import Scene
from fuzz.questions.true_turns import DIGITS, Approach, Real, Truth, UndecidedError, real

__all__ = ["Case", "case_of", "spinning_scene"]

SAMPLES: Final = 16
MOST: Final = 4
"""How many times as wide as E / v bounds may be."""


class Case(NamedTuple):
    """What happens in a scene, and what is wrong with the bounds of its first contact."""

    kind: str
    fault: str | None


def spinning_scene(random: Random) -> Scene:
    """A scene of gears, mills or orbits."""
    return SPINNING[random.choice(sorted(SPINNING))](random)


def case_of(scene: Scene) -> Case:
    """Whether the true time is between the bounds, and these are near enough."""
    bounds = first_contact_enclosed(scene)
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
    bounds.low.refine_to(scene._end / 10**DIGITS)
    if time is not None and time < real(bounds.low.low) - tiny:
        return Case("too late", f"low {float(bounds.low)!r}, but they meet at {time}")
    if bounds.high is None:
        if time is not None and _allowed(scene, truth, bounds, time) is not None:
            return Case("not certain", f"no upper bound, but they meet at {time}")
        return Case("may graze, and does not" if time is None else "may graze, and meets", None)
    bounds.high.refine_to(scene._end / 10**DIGITS)
    high = real(bounds.high.high)
    if time is None or time > high + tiny:
        return Case("too early", f"high {float(bounds.high)!r}, but they meet at {time}")
    if bounds.low == bounds.high:
        return Case("at the start" if bounds.low == scene.start else "exact", None)
    allowed = _allowed(scene, truth, bounds, time)
    if allowed is None:
        return Case("certain, and may graze", None)
    width = (high - real(bounds.low.low)) / allowed
    return Case("certain", None if width <= MOST else f"{mpmath.nstr(width, 6)} E / v wide")


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
    return [begin + (end - begin) * k / SAMPLES for k in range(SAMPLES + 1)]


def _error(body: Body) -> Real:
    """A bound on how far points of a body are out of place."""
    motion = body.motion
    if not isinstance(motion, Spin):
        return mpmath.mpf(0)
    turn: Any = motion.motions[0]
    pivot = mpmath.mpc(*map(real, turn.pivot))
    arms = [
        sum(abs(mpmath.mpc(*(real(f.coefficients[k]) if k <= f.degree else 0 for f in v))
                - (0 if k else pivot)) * 2**k for k in range(max(f.degree for f in v) + 1))
        for v in body.vertices
    ]  # fmt: skip
    return max(arms) * real(motion.error)


def _near(truth: Truth, errors: list[Real], t: float) -> set[Approach]:
    """The vertices and edges of bodies that are within twice the sum of their errors."""
    found = set()
    for i, j in combinations(range(len(errors)), 2):
        reach = 2 * float(errors[i] + errors[j]) * 1.0001
        found |= {pair for pair in truth.approaches(t, reach) if {pair.i, pair.j} == {i, j}}
    return found


def _is_inner(truth: Truth, pair: Approach, t: Real, away: Real) -> bool:
    """Whether the foot of a perpendicular is so far from the ends of an edge."""
    p, q = (truth.bodies[pair.j].places(t)[k] for k in pair.ends)
    if p == q:
        return True
    v = truth.bodies[pair.i].places(t)[pair.vertex]
    along = ((q - p).conjugate() * (v - p)).real / abs(q - p)
    return bool(away <= along <= abs(q - p) - away)
