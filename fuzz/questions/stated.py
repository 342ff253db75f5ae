"""Contacts at the start of bodies whose places are known within a stated error.

**The law.** A result at the start is certain only if it is so after every rigid move by the
stated errors. Let E be the sum of the errors of two bodies. Moves of both by at most their errors
move one against the other by any vector of at most the length E, so only this one is moved here, by
E in the direction of normals of edges and in directions all around. After each of these moves the
bodies must touch, by the definition of `exactpt.testing.reference`.

For convex bodies at places with rational normals the law holds in the other direction, too. If the
bodies overlap by E or more in the direction of every normal of an edge, they touch after all of
these moves (see `exactpt.pair.sure`), and the result must be certain. So with convex bodies
"certain" and "touches after each of these moves" are the same.

Scenes are made with the places and the errors at hand: an error is stated by
`PosePath.with_place_error`, or by the constructor; paths go on from the start in all ways that have
the angle 0 there; the scene begins with the path or later; an error may be at one body or at both.
Bodies touch, overlap by less than E, by E and by more, are inside each other, or are a little
apart.

One error is read from the motion. The constructor has one number for the error of fitting and the
stated one, so what it states is the part that the fit does not need, `assumed_place_error`, not all
of the number. (The fit needs a part even of a path at rest: the places of its pieces are rounded.)

**Later**, if both bodies are moved by constant vectors of the lengths of their errors, their first
contact is between the bounds. It is computed by `fuzz.references.true_turns`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import pairwise
from math import isqrt
from random import Random
from typing import Any, Final, NamedTuple

import mpmath

from exactpt.kernel.numbers import rational
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.motion.pose_path import PosePath
from exactpt.scene.scene import Scene
from exactpt.scene.written import to_json
from exactpt.search.enclosed import EnclosedContact, first_contact_enclosed
from exactpt.testing import reference
from fuzz.references.true_turns import DIGITS, Truth, UndecidedError, real

__all__ = ["Stated", "Wrong", "stated_case", "wrong_after_moves", "wrong_at_the_start"]

Point = tuple[Fraction, Fraction]

UNITS: Final = [
    (x * a, y * b)
    for u, v, w in ((3, 4, 5), (5, 12, 13), (8, 15, 17), (0, 1, 1))
    for a, b in ((Fraction(u, w), Fraction(v, w)), (Fraction(v, w), Fraction(u, w)))
    for x in (1, -1)
    for y in (1, -1)
]
"""Rational unit vectors all around."""

SQUARE: Final = [(-2, -2), (2, -2), (2, 2), (-2, 2)]
SHAPES: Final = {
    "point": [(0, 0)],
    "segment": [(-3, 0), (3, 0)],
    "upright segment": [(0, -3), (0, 3)],
    "square": SQUARE,
    "bar": [(-4, -1), (4, -1), (4, 1), (-4, 1)],
    "triangle": [(-3, -2), (5, -2), (5, 4)],
    "tilted square": [(-1, -7), (7, -1), (1, 7), (-7, 1)],
    "angle": [(-4, -4), (4, -4), (4, -2), (-2, -2), (-2, 4), (-4, 4)],
    "chain": [(-3, 2), (0, 0), (3, 2)],
}
"""Rest shapes; unit normals of their edges are rational, but for those of the chain."""
OPEN: Final = {"chain"}
CONVEX: Final = {*SHAPES} - {"angle", "chain"}


class Stated(NamedTuple):
    """A scene of two bodies with stated errors.

    Attributes:
        scene: the scene.
        at_start: the two bodies at rest, where they are at the start without the errors.
        errors: their stated errors.
        is_convex: whether both are convex, without a radius.
        is_all: whether no other error than the stated ones is left at the start.
    """

    scene: Scene
    at_start: tuple[Body, Body]
    errors: tuple[Fraction, Fraction]
    is_convex: bool
    is_all: bool

    @property
    def error(self) -> Fraction:
        """The sum of the stated errors."""
        return sum(self.errors, Fraction(0))


class Path(NamedTuple):
    """A motion with a stated error of its place.

    Attributes:
        motion: the motion.
        stated: the stated error.
        is_all: whether no other error than the stated one is left at the start.
    """

    motion: PosePath | Translation
    stated: Fraction
    is_all: bool


class Wrong(NamedTuple):
    """The kind of a case, and the fault of its result; None without one."""

    kind: str
    fault: str | None


def stated_case(random: Random) -> Stated:
    """Return two bodies that touch or nearly touch at the start, with stated errors."""
    start = random.choice([*[Fraction(0)] * 3, Fraction(1), Fraction(3, 2), Fraction(-1, 3)])
    end = start + random.choice([1, 2])
    errors = [Fraction(random.randint(1, 12), random.choice([8, 10, 1000])) for _ in range(2)]
    if random.random() < 0.5:
        errors[1] = Fraction(0)
    total = sum(errors, Fraction(0))
    first, second = (random.choice(sorted(SHAPES)) for _ in range(2))
    radius = Fraction(random.choice([0, 0, 0, 1]), 2)
    gap = radius + total * Fraction(random.choice([0, 0, -1, -2, -4, 1, 4]), 2)
    gap += Fraction(random.choice([0, 0, 0, 1, -1]), 10**9)
    at = _beside(random, first, second, gap)
    if random.random() < 0.15:
        at = Fraction(random.randint(-2, 2), 2), Fraction(random.randint(-2, 2), 2)
    shift = Fraction(random.randint(-9, 9), 3), Fraction(random.randint(-9, 9), 7)
    places = [shift, (shift[0] + at[0], shift[1] + at[1])]
    paths = [
        _path(random, place, error, start, end) for place, error in zip(places, errors, strict=True)
    ]
    radii = [radius, Fraction(0)]
    names = [first, second]
    bodies = [
        Body(f"{i} {name}", SHAPES[name], path.motion, closed=name not in OPEN, radius=r)
        for i, (name, path, r) in enumerate(zip(names, paths, radii, strict=True))
    ]
    resting = [
        Body(body.name, _moved(SHAPES[name], place), closed=name not in OPEN, radius=r)
        for body, name, place, r in zip(bodies, names, places, radii, strict=True)
    ]
    if random.random() < 0.3:
        bodies.append(Body("far", [(99, 99), (100, 99)], Translation([0, 1])))
    if random.random() < 0.5:
        bodies.reverse()
    is_convex = CONVEX.issuperset(names) and not radius
    return Stated(
        Scene(bodies, time=(start, end)),
        (resting[0], resting[1]),
        (paths[0].stated, paths[1].stated),
        is_convex,
        all(path.is_all for path in paths),
    )


def wrong_after_moves(random: Random, case: Stated) -> str | None:
    """Return the fault of the bounds for the bodies after moves by their errors; None if none."""
    bounds = first_contact_enclosed(case.scene)
    x, y = random.choice(UNITS)
    moves = {
        body.name: (x * error, y * error)
        for body, error in zip(case.at_start, (case.errors[0], -case.errors[1]), strict=True)
    }
    bodies = [_moved_path(body, moves.get(body.name)) for body in case.scene.bodies]
    scene = Scene(bodies, time=(case.scene.start, case.scene.end))
    try:
        time = Truth(scene).first_contact()
    except UndecidedError:
        return None
    with mpmath.workdps(DIGITS):
        tiny = mpmath.mpf(10) ** -(DIGITS - 20)
        if bounds is None:
            return None if time is None else f"none, but they touch at {time} after moves {moves}"
        for bound in (bounds.low, bounds.high):
            if bound is not None:
                bound.refine_to(rational(Fraction(1, 10**DIGITS)))
        if time is not None and time < real(bounds.low.low) - tiny:
            return f"{bounds}, but they touch at {time} after moves {moves}"
        if bounds.high is not None and (time is None or time > real(bounds.high.high) + tiny):
            return f"{bounds}, but they touch at {time} after moves {moves}"
    return None


def _moved_path(body: Body, move: Point | None) -> Body:
    """Return a body whose path is moved, without a stated error."""
    motion = body.motion
    if move is None or not isinstance(motion, PosePath):
        return body
    poses = [(x + move[0], y + move[1], angle) for x, y, angle in motion.exact_poses]
    fitted = Fraction(1, 1000)  # of polynomials of high degrees
    return body.with_motion(PosePath(motion.times, poses, error=fitted, place_error=fitted))


def wrong_at_the_start(case: Stated) -> Wrong:
    """Compare the result at the start with the bodies after moves by the stated errors."""
    found = first_contact_enclosed(case.scene)
    again = Scene.from_json(to_json(case.scene))
    is_certain = found is not None and found.high == case.scene.start
    kind = "certain" if is_certain else "not certain"
    if _summary(first_contact_enclosed(again)) != _summary(found):
        return Wrong(kind, f"{found}, but {first_contact_enclosed(again)} read from its file")
    fixed, moved = case.at_start
    touches = _touch(fixed, moved)
    if touches and (found is None or found.low != case.scene.start):
        return Wrong(kind, f"{found}, but they touch at the start")
    kind += ", touching" if touches else ", apart"
    parting = next((v for v in _moves(case) if not _touch(fixed, _moved_body(moved, v))), None)
    if is_certain and parting is not None:
        return Wrong(kind, f"certain at the start, but they are apart after a move by {parting}")
    if not is_certain and parting is None and case.is_convex and case.is_all:
        return Wrong(kind, "not certain at the start, but they touch after every move")
    if not is_certain and parting is None:
        kind += ", no move that parts them was found"
    return Wrong(kind, None)


def _summary(found: EnclosedContact | None) -> object:
    return found and (found.low, found.high, found.pairs)


def _path(random: Random, place: Point, error: Fraction, start: Fraction, end: Fraction) -> Path:
    """Return a motion that has a place and the angle 0 at the start, and its stated error.

    Args:
        random: the random choices.
        place: the place at the start.
        error: the error to state; 0 for a motion without one.
        start: the start of the scene.
        end: its end.
    """
    x, y = place
    vx, vy, turn = (Fraction(random.randint(-4, 4), 4) for _ in range(3))
    if not error:
        return Path(Translation([x - vx * start, vx], [y - vy * start, vy]), error, is_all=True)
    kind = random.choice(["rest", "moves", "turns", "bends", "before", "fitted", "constructor"])
    if kind == "rest":
        path = PosePath([start, end], [(x, y, 0)])
    elif kind == "moves":
        path = PosePath([start, end], [([x, vx], [y, vy], 0)])
    elif kind == "bends":
        path = PosePath([start, end], [([x, vx, 1], [y, 0, vy], [0, turn, 1])], error="1/1000")
    elif kind == "before":  # the scene begins later than the path, at the end of a piece
        poses: list[Any] = [([x - vx, vx], y, [-turn, turn]), ([x, vy], y, [0, turn])]
        path = PosePath([start - 1, start, end], poses, error="1/1000")
    elif kind == "fitted":  # by cubics that are exact where they begin
        poses = [([x, vx, 0, 0, 1, Fraction(1, 3)], [y, vy], [0, turn])]
        path = PosePath([start, end], poses, error="1/1000", place_error="1/1000")
        return Path(path.with_place_error(error), error, is_all=False)
    elif kind == "constructor":  # a part of its error is that of fitting: see the module
        path = PosePath([start, end], [(x, y, [0, turn])], error="1/1000", place_error=error)
        return Path(path, path.assumed_place_error, is_all=True)
    else:
        path = PosePath([start, end], [([x, vx], [y, vy], [0, turn])], error="1/1000")
    return Path(path.with_place_error(error), error, is_all=True)


def _beside(random: Random, first: str, second: str, gap: Fraction) -> Point:
    """Return where the second shape is so that it is at a distance beside the first one."""
    x, y = random.choice([unit for unit in UNITS if 0 in unit] * 2 + UNITS)
    front = max(x * u + y * v for u, v in SHAPES[first])
    back = min(x * u + y * v for u, v in SHAPES[second])
    along = front - back + gap
    aside = Fraction(random.choice([0, 0, 1, -1, random.randint(-6, 6)]), random.choice([1, 2]))
    return x * along - y * aside, y * along + x * aside


def _moves(case: Stated) -> Iterator[Point]:
    """Yield vectors of the length of the error: along normals of edges, and all around."""
    for x, y in (*UNITS, *_unit_normals(case.at_start)):
        yield x * case.error, y * case.error


def _unit_normals(bodies: Iterable[Body]) -> Iterator[Point]:
    """Yield the unit normals of edges on both sides, those that are rational."""
    for body in bodies:
        corners = body.at(0)
        for (ax, ay), (bx, by) in pairwise([*corners, corners[0]]):
            x, y = by - ay, ax - bx
            length = _rational_root(x * x + y * y)
            if length:
                yield x / length, y / length
                yield -x / length, -y / length


def _rational_root(square: Fraction) -> Fraction | None:
    """Return the square root of a number if it is rational."""
    root = Fraction(isqrt(square.numerator), isqrt(square.denominator))
    return root if root * root == square else None


def _touch(a: Body, b: Body) -> bool:
    """Return True if two bodies at rest touch, by the definition."""
    squared = reference.nearest(a, b, 0).core_squared
    reach = rational(a.radius + b.radius)
    return bool(squared <= reach * reach)


def _moved(shape: Iterable[tuple[int, int]], by: Point) -> list[Point]:
    return [(x + by[0], y + by[1]) for x, y in shape]


def _moved_body(body: Body, by: Point) -> Body:
    return body.with_motion(Translation([by[0]], [by[1]]))
