"""`exactpt.arrays`: all pairs of bodies of a scene, each for itself."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations
from math import lcm
from typing import Any, Final

import numpy as np

from benchmarks.methods.method import Answer, Method, UnsuitableScene
from benchmarks.methods.own import in_build
from exactpt import Body, Scene, Translation, first_contact
from exactpt.arrays import first_contacts
from exactpt.kernel.numbers import QQ, nearest_float

__all__ = ["ARRAYS", "FROM_ARRAYS"]


def _arrays(scene: Scene) -> dict[str, Any]:
    """Return the arguments of `Scene.from_arrays`.

    The scene is shifted and stretched by rationals so that all its numbers are doubles. That
    changes no time.
    """
    bodies = scene.bodies
    outlines = [
        [(x.exact_at(QQ(0)), y.exact_at(QQ(0))) for x, y in body.vertices] for body in bodies
    ]
    motions = [_motion(body) for body in bodies]
    corner = outlines[0][0]
    rows = [[p[0] - corner[0], p[1] - corner[1]] for outline in outlines for p in outline]
    numbers = [c for row in rows for c in row] + [c for m in motions for f in m for c in f]
    factor = QQ(lcm(*(int(c.denominator) for c in numbers)))
    width = max(len(f) for m in motions for f in m)
    coefficients = [[[*f, *[QQ(0)] * (width - len(f))] for f in m] for m in motions]
    vertices = np.array([[_double(c * factor) for c in row] for row in rows])
    moved = np.array([[[_double(c * factor) for c in f] for f in m] for m in coefficients])
    offsets = np.cumsum([0, *map(len, outlines)])
    closed = np.array([body.closed for body in bodies])
    time = [_double(scene.exact_start), _double(scene.exact_end)]
    return {
        "vertices": vertices,
        "offsets": offsets,
        "coefficients": moved,
        "closed": closed,
        "time": time,
    }


def _prepare_scene(scene: Scene) -> Callable[[], Answer]:
    given = _arrays(scene)

    def ask() -> Answer:
        contact = first_contact(Scene.from_arrays(**given))
        return None if contact is None else contact.time

    return ask


def _prepare(scene: Scene) -> Callable[[], Answer]:
    given = _arrays(scene)
    pairs = np.array(list(combinations(range(len(scene.bodies)), 2))).reshape(-1, 2)

    def ask() -> Answer:
        contacts = first_contacts(pairs=pairs, **given)
        if not contacts.found.any():
            return None
        first = np.flatnonzero(contacts.low <= contacts.high.min()).tolist()
        found = [contacts.contact(i) for i in first]
        return min((contact.time for contact in found if contact is not None), default=None)

    return ask


def _motion(body: Body) -> tuple[tuple[QQ, ...], tuple[QQ, ...]]:
    """The coefficients of a translation."""
    motion = body.motion
    if not isinstance(motion, Translation) or not body.vertices:
        raise UnsuitableScene(f"body {body.name!r} does more than translate")
    if any(f.degree > 0 for vertex in body.vertices for f in vertex):
        raise UnsuitableScene(f"body {body.name!r} deforms")
    x, y = motion.x.exact_coefficients, motion.y.exact_coefficients
    return x or (QQ(0),), y or (QQ(0),)


def _double(value: QQ) -> float:
    near = nearest_float(value)
    if QQ(*near.as_integer_ratio()) != value:
        raise UnsuitableScene(f"not a double: {value}")
    return near


ARRAYS: Final = Method("exactpt", in_build("arrays"), _prepare)
"""The first contact among the answers for all pairs."""

FROM_ARRAYS: Final = Method("exactpt", in_build("from arrays"), _prepare_scene)
"""The first contact of a scene in arrays, which is built in the same time."""
