"""Motions with a contact of a given order at a given time.

A motion is a function of a local time s that vanishes at the contact: t - 1, t^2 - 2, ...
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Final, NamedTuple, TypeAlias

from exactpt.kernel.numbers import QQ
from exactpt.kernel.polynomial import ONE, ZERO, Polynomial
from exactpt.motion.body import Body
from exactpt.motion.motions import REST, Motion, Pieces, Rigid, SimpleMotion, Translation
from fuzz.small_scope.placements import DIRECTIONS
from fuzz.small_scope.shapes import Vector

__all__ = [
    "DRIFTS",
    "ORDERS",
    "SLOTS",
    "TIMES",
    "Approach",
    "Clock",
    "Path",
    "Points",
    "approaches",
    "deforming",
    "drifting",
    "motion_of",
]

Points: TypeAlias = list[tuple[QQ, QQ]]
Path: TypeAlias = tuple[Polynomial, Polynomial]

POWERS: Final = {"linear": 1, "square": 2, "cube": 3, "fourth": 4}
COMPANIONS: Final = {
    "linear": (),
    "square": ("linear",),
    "cube": ("linear", "square"),
    "fourth": ("linear", "square"),
}
"""Possible motions in the other coordinate; linear with a square equals a square with linear."""

ORDERS: Final = ("rest", *POWERS, "turn", "deform")
"""How bodies come into contact: at rest, by a power of the time, a rotation, a moving vertex."""


class Clock(NamedTuple):
    """The time of the planned contact.

    Attributes:
        time: its name.
        local: the local time; of two entries the second one holds from t = 1 on.
        span: the time span of the scene.
    """

    time: str
    local: tuple[Polynomial, ...]
    span: tuple[int, int]


MIDDLE: Final = Polynomial([-1, 1])
SLOTS: Final = (
    Clock("middle", (MIDDLE,), (0, 3)),
    Clock("root", (Polynomial([-2, 0, 1]),), (1, 2)),
    Clock("break", (MIDDLE, -MIDDLE), (0, 3)),
    Clock("end", (MIDDLE,), (0, 1)),
    Clock("start", (Polynomial([0, 1]),), (0, 2)),
)
"""Times of contact, used in turn. At a break bodies touch, and separate as they came."""

TIMES: Final = ("start", "middle", "root", "break", "end")

DRIFTS: Final[tuple[Path, ...]] = (
    (ZERO, ZERO),
    (ZERO, ZERO),
    (Polynomial([0, 1]), Polynomial([0, "-1/2"])),
    (Polynomial([0, -1]), Polynomial([1, 0, 1])),
)
"""Motions shared by all bodies."""


class Approach(NamedTuple):
    """A motion of a given order of contact.

    Attributes:
        companion: the motion in the other coordinate: "alone" for motion along a line, otherwise
            "linear" or "square". For a rotation or a moving vertex: "alone" if the motion
            continues, "square" if it turns back.
        direction: the index of the direction in which the body is before the contact.
        part: for a rotation, the side of the pivot; for a deforming body, the vertex.
    """

    companion: str
    direction: int
    part: int = 0


def approaches(order: str, free: int, parts: Sequence[int]) -> list[Approach]:
    """The motions with an order of contact that arrive from the free directions.

    There is at least one for each free direction; ``parts`` are the vertices that may deform.
    """
    open_directions = [i for i in range(len(DIRECTIONS)) if free >> i & 1]
    if order == "rest":
        return [Approach("alone", 0)]
    if order in POWERS:
        curved = [
            Approach(c, i)
            for i in open_directions
            if _is_curved(DIRECTIONS[i])
            for c in COMPANIONS[order]
        ]
        return [Approach("alone", i) for i in open_directions] + curved
    chosen = (0, 1) if order == "turn" else parts
    return [Approach(c, i, k) for i in open_directions for c in ("alone", "square") for k in chosen]


def _is_curved(step: Vector) -> bool:
    """Return True if it represents directions next to an axis, where parabolas begin."""
    return 8 in map(abs, step)


def _unit(step: Vector) -> tuple[QQ, QQ]:
    """A direction scaled to about the length of an edge."""
    size = max(map(abs, step))
    scale = 4 if size == 8 else 2 if size == 3 else 1
    return QQ(step[0], scale), QQ(step[1], scale)


@cache
def _path(power: int, companion: str, step: Vector, local: Polynomial) -> Path:
    """A displacement that vanishes at local time 0, and is in direction ``step`` before it."""
    f = _power(local, power)
    f = -f if power % 2 else f
    if companion == "alone":
        x, y = _unit(step)
        return _times(f, x), _times(f, y)
    along = -local if companion == "linear" else local * local
    u, v = ((s > 0) - (s < 0) for s in step)
    parts = (f, along) if abs(step[0]) < abs(step[1]) else (along, f)
    return _times(parts[0], QQ(u)), _times(parts[1], QQ(v))


def _power(f: Polynomial, n: int) -> Polynomial:
    return ONE if n == 0 else f * _power(f, n - 1)


def _times(f: Polynomial, factor: QQ) -> Polynomial:
    return f * Polynomial([factor])


def _in_pieces(motions: Sequence[SimpleMotion]) -> Motion:
    return motions[0] if len(motions) == 1 else Pieces([(1, motions[0]), (None, motions[1])])


def drifting(drift: Path) -> Motion:
    """The motion of a body that has only the shared motion."""
    return Translation(*drift) if drift != (ZERO, ZERO) else REST


def motion_of(
    order: str, approach: Approach, step: Vector, clock: Clock, drift: Path, pivot: tuple[QQ, QQ]
) -> Motion:
    """The motion of a rigid body; at the contact it is in its rest position.

    Args:
        order: the order of contact.
        approach: the motion.
        step: its direction, after the symmetry of the presentation.
        clock: the time of contact.
        drift: the shared motion.
        pivot: a point of contact; a rotation is about a point beside it.
    """
    if order == "rest":
        return drifting(drift)
    if order == "turn":
        return _in_pieces([_turn(approach, step, local, drift, pivot) for local in clock.local])
    paths = [_path(POWERS[order], approach.companion, step, local) for local in clock.local]
    return _in_pieces([Translation(drift[0] + x, drift[1] + y) for x, y in paths])


def _turn(
    approach: Approach, step: Vector, local: Polynomial, drift: Path, touched: tuple[QQ, QQ]
) -> Rigid:
    """A quarter turn in a unit of local time, which moves the point of contact sideways."""
    half_turn = local * local if approach.companion == "square" else -local
    x, y = _unit(step)
    side = -2 if approach.part else 2
    pivot = (touched[0] - side * y, touched[1] + side * x)
    half_turn = _times(half_turn, QQ(side, 2))
    return Rigid(half_turn, pivot=pivot, x=drift[0], y=drift[1])


def deforming(
    name: str, points: Points, vertex: int, approach: Approach, step: Vector, clock: Clock,
    drift: Path, factor: QQ, *, closed: bool,
) -> Body:  # fmt: skip
    """A body with one moving vertex, in its given shape at the contact.

    Args:
        name: the name of the body.
        points: its vertices at the contact.
        vertex: the index of the moving one.
        approach: its motion.
        step: the direction of that, after the symmetry of the presentation.
        clock: the time of contact.
        drift: the shared motion.
        factor: scale of the motion of the vertex.
        closed: whether the body is a polygon.
    """
    power = 2 if approach.companion == "square" else 1
    path = _path(power, "alone", step, clock.local[0])

    def place(displacement: tuple[Polynomial, Polynomial]) -> Path:
        x, y = points[vertex]
        return (
            Polynomial([x]) + _times(displacement[0], factor),
            Polynomial([y]) + _times(displacement[1], factor),
        )

    motion = drifting(drift)
    if len(clock.local) == 1:
        tracks: list[Path] = [(Polynomial([x]), Polynomial([y])) for x, y in points]
        tracks[vertex] = place(path)
        return Body(name, tracks, motion, closed=closed)
    x, y = place(path)
    away = [*points]
    away[vertex] = (x(0), y(0))
    frames = [(0, away), (1, points), (3, away)]
    return Body(name, motion=motion, closed=closed, keyframes=frames)
