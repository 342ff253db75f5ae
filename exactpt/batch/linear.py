"""Contacts of which filters have found the features: their exact time, point and normal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

from exactpt.batch.two_bodies import Moving, Raw, TwoBodies, exact
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, finite, nearest_float, of_double
from exactpt.kernel.roots import roots_after
from exactpt.motion.track import Incidence
from exactpt.pair.contact import contact_of
from exactpt.pair.features import FeaturePair
from exactpt.scene.scene import Scene

Answer = dict[str, object]
Vector = tuple[QQ, QQ]

SMALLEST: Final = 2.0**-200
LARGEST: Final = 2.0**200
"""Sizes of a coordinate between which factors of at most 2^200 change no rounding."""


def is_linear(scene: TwoBodies) -> bool:
    """Return True if both bodies move straight, at constant velocities."""
    return not (scene.turns or any(scene.coefficients[2::3]))


def initial_contact(scene: TwoBodies) -> Answer:
    """Return the contact of two bodies that overlap at the start without an incidence, as JSON."""
    names = [body.name for body in scene.bodies]
    time = AlgebraicNumber(exact(scene.time[0]))
    return {"time": time.to_json(), "kind": "initial", "pairs": [], "overlaps": [names]}


def linear_contact(scene: TwoBodies, side: int, vertex: int, edge: int) -> Answer | None:
    """Return the contact of one vertex with the inside of one edge, as JSON; None after the span.

    With p - a = w + d t and b - a = u for the vertex p and the edge ab, u x w + (u x d) t
    vanishes at the time. u x d is positive if p comes from the right of ab.

    Args:
        scene: two bodies that move straight, whose first contact this is unless the span ends
            before.
        side: 0 or 1 as the vertex is of the first or the second body.
        vertex: its number.
        edge: the number of the edge of the other body.
    """
    mine, other = scene.bodies[side], scene.bodies[1 - side]
    (px, vx), (py, vy) = _path(mine, vertex)
    (ax, wx), (ay, wy) = _path(other, edge)
    bx, by = map(exact, other.vertices[(edge + 1) % len(other.vertices)])
    cx, cy = map(exact, other.vertices[edge])
    ux, uy = bx - cx, by - cy
    slope = ux * (vy - wy) - uy * (vx - wx)
    time = (uy * (px - ax) - ux * (py - ay)) / slope
    if time > exact(scene.time[1]):
        return None
    point = [finite(nearest_float(px + vx * time)), finite(nearest_float(py + vy * time))]
    return {
        "time": AlgebraicNumber(time).to_json(),
        "kind": "vertex-edge",
        "pairs": [
            {
                "kind": "vertex-edge",
                "a": {"body": mine.name, "vertex": vertex},
                "b": {"body": other.name, "edge": edge},
                "point": point,
                "normal": _normal(ux, uy, slope),
            }
        ],
    }


def contact_between(scene: Scene, touch: Incidence, low: float, high: float) -> Answer | None:
    """Return the contact of a vertex with the inside of an edge, as JSON; None after the span.

    Args:
        scene: two bodies, whose first contact this is unless the span ends before.
        touch: the vertex and the edge. In (low, high] the vertex crosses the edge's line once.
        low: a time before the contact, not before the start.
        high: a time not before it.
    """
    pieces = [body.exact_piece_after(scene.exact_start) for body in scene.bodies]
    one, other = pieces[touch.body], pieces[touch.other]
    ends = touch.edge, scene.bodies[touch.other].end_of_edge(touch.edge)
    pair = FeaturePair(touch, one.track(touch.vertex), tuple(map(other.track, ends)))
    until = min(of_double(high), scene.exact_end)
    f = pair.at_distance(QQ(0))
    root = next(roots_after(f, AlgebraicNumber(of_double(low)), until), None)
    return None if root is None else contact_of(scene, root.time, [touch]).to_json()


def _path(body: Moving, vertex: int) -> tuple[Vector, Vector]:
    """Return the position at t = 0 and the velocity of a vertex, in x and in y."""
    x, y = map(exact, body.vertices[vertex])
    (x0, vx), (y0, vy) = map(_start, body.motion)
    return (x + x0, vx), (y + y0, vy)


def _start(axis: Sequence[Raw]) -> Vector:
    """Return the first two coefficients."""
    first, second, *_ = *axis, 0, 0
    return exact(first), exact(second)


def _normal(ux: QQ, uy: QQ, slope: QQ) -> list[float]:
    """Return the unit normal of an edge to the side from which the vertex comes.

    As `exactpt.pair.contact` rounds it: coordinates of the edge are scaled by a power of
    two there, which cancels unless one becomes tiny.
    """
    x, y = nearest_float(ux), nearest_float(uy)
    if any(not SMALLEST < abs(c) < LARGEST for c in (x, y) if c):
        scale = max(abs(ux), abs(uy))
        x, y = nearest_float(ux / scale), nearest_float(uy / scale)
    length = math.hypot(x, y)
    out = 1 if slope > 0 else -1
    return [out * y / length + 0.0, -out * x / length + 0.0]
