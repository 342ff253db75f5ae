"""Bodies whose rings touch: whether they are valid, and what they touch, by cutting them up.

The trapezoids of a valid body (`exactpt.testing.reference.valid`) are simple convex bodies: its
contacts, distances and intervals are the first, least and joined ones of theirs. Nothing here uses
points of touches, nor rings in a search.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import product
from random import Random
from typing import Final

from exactpt import (
    Affine,
    AlgebraicNumber,
    Body,
    InputError,
    Pieces,
    Planner,
    Polynomial,
    PosePath,
    Rigid,
    Scene,
    Spin,
    Translation,
    clearance,
    contact_intervals,
    contacts,
    distance,
    first_contact,
    first_contact_enclosed,
    first_within,
)
from exactpt.kernel.numbers import QQ, rational
from exactpt.motion.motions import Motion
from exactpt.pair.comparison import contrast
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from exactpt.testing.reference import new_contact
from exactpt.testing.reference.valid import Point, dissected, is_valid
from exactpt.testing.scenes.rings import as_parts, middle_of, touching_parts

__all__ = [
    "random_parts", "threaded", "touching_pair", "wrong_answer", "wrong_validity",
]  # fmt: skip

ATTEMPTS = 12
"""Number of random sets of rings in a case."""


def wrong_validity(random: Random) -> tuple[Scene | None, str | None]:
    """Return the last valid one of random sets of rings, as a scene, and a fault."""
    scene: Scene | None = None
    for _ in range(ATTEMPTS):
        parts = random_parts(random)
        expected = is_valid(parts)
        try:
            found = Scene([Body("b", parts=as_parts(parts))], (0, 1))
        except InputError as error:
            if expected:
                return scene, f"valid, but refused: {error}: {parts}"
            continue
        scene = found
        if not expected:
            return scene, "not valid, but accepted"
    return scene, None


def random_parts(random: Random) -> list[list[list[Point]]]:
    """Return the rings of a valid body; mostly with one ring more, as a part or as a hole."""
    parts = touching_parts(random, (QQ(0), QQ(0)))
    kind = random.randrange(3)
    if kind == 0:
        return parts
    more = touching_parts(random, (QQ(random.randint(-2, 2)), QQ(random.randint(-2, 2))))
    ring = random.choice([ring for rings in more for ring in rings])
    if kind == 1:
        return [*parts, [ring]]
    random.choice(parts).append(ring)
    return parts


def touching_pair(random: Random) -> Scene:
    """Two bodies, one or both with rings that touch, in motions that keep their shapes."""
    while True:
        parts = touching_parts(random, (QQ(0), QQ(0)))
        a = Body("a", parts=as_parts(parts), motion=_motion(random), radius=_radius(random))
        if a.exact_ring_touches:
            break
    if random.random() < 0.3:
        x, y = random.randint(-2, 6), random.randint(-2, 6)
        others = as_parts(touching_parts(random, (QQ(x), QQ(y))))
        b = Body("b", parts=others, motion=_motion(random), radius=_radius(random))
    else:
        b = Body("b", _thing(random, a), _motion(random), closed=random.random() < 0.7,
                 radius=_radius(random))  # fmt: skip
    try:
        return Scene([a, b], (0, 2))
    except InputError:  # a chain that is flat, and meets itself as a polygon
        return touching_pair(random)


def threaded(random: Random) -> Scene:
    """A body whose rings touch, and a segment or chain that leads through one of these points.

    The thread may be in a hole on both sides of it, in the interior, or outside.
    """
    while True:
        body = Body("b", parts=as_parts(touching_parts(random, (QQ(0), QQ(0)))))
        thread = _thread(random, body)
        if thread is not None:
            break
    return Scene([body, Body("thread", thread, _slide(random), closed=False)], (0, 2))


def _thread(random: Random, body: Body) -> list[Point] | None:
    """Return a path through a point in which rings touch; None if there is none, or it is flat."""
    if not body.exact_ring_touches:
        return None
    x, y = random.choice(body.exact_ring_touches)
    step = QQ(1, random.choice([4, 40]))
    u, v, w, z = (step * random.randint(-3, 3) for _ in range(4))
    first, middle, last = (x + u, y + v), (x, y), (x + w, y + z)
    if u * z == v * w:
        return None
    return [first, middle, last] if random.random() < 0.5 else [first, (x - u, y - v)]


def _slide(random: Random) -> Motion:
    u, v = random.randint(-1, 1), random.randint(-1, 1)
    return random.choice([Translation([0]), Translation([0, u], [0, v])])


def _radius(random: Random) -> str:
    return random.choice(["0", "0", "0", "1/2", "1/3"])


_THROUGH_THE_MIDDLE: Final = [
    [(0, -1), (0, 1)],
    [(-1, 0), (1, 0)],
    [(-1, -4), (1, 4)],
    [(-1, 4), (0, 0), (1, 4)],
    [(0, -4), (0, 0), (1, 4)],
]
"""Segments and chains that lead through a point in which rings touch, if they are put there."""


def _thing(random: Random, around: Body) -> list[Point]:
    """Return a point, segment or polygon in a hole, at a touch, or anywhere near a body."""
    x, y = QQ(random.choice([-6, -5, 5, 6])), QQ(random.randint(-10, 10), 2)
    kind = random.randrange(5)
    if kind == 0:
        x, y = random.choice(around.exact_ring_touches)
    holes = [hole for _, *holes in around.parts for hole in holes]
    if kind > 1 and holes:
        place = around.exact_at(QQ(0))
        x, y = middle_of([place[i] for i in random.choice(holes)])
    half = QQ(1, random.choice([4, 6, 7]))
    shape = random.choice(
        [
            [(0, 0)],
            [(0, 0)],
            [(0, 0), (1, 0)],
            [(0, 0), (1, 1)],
            [(0, 0), (1, 0), (0, 1)],
            [(0, 0), (1, 0), (1, 1), (0, 1)],
        ]
    )
    if kind == 0 and random.random() < 0.5:
        shape = random.choice(_THROUGH_THE_MIDDLE)
    return [(x + half * u, y + half * v) for u, v in shape]


def _motion(random: Random) -> Motion:
    u, v = random.randint(-3, 3), random.randint(-3, 3)
    there = Translation([0, u], [0, v])
    motions: list[Callable[[], Motion]] = [
        lambda: Translation([0]),
        lambda: there,
        lambda: there,
        lambda: Translation([0, 2 * u, -u], [0, v]),
        lambda: Rigid([0, random.choice([QQ(1), QQ(-1), QQ(1, 2)])], pivot=(u, v)),
        lambda: Affine([[Polynomial([1, "1/2"]), 0], [Polynomial([0, u]), 1]], x=[0, v]),
        lambda: Affine([[-1, Polynomial([0, 1])], [0, 1]], y=[0, v]),
        lambda: Pieces([(1, there), (None, Translation([2 * u, -u], [v]))]),
        lambda: Spin(u or 1, pivot=(v, u), error="1/100"),
        lambda: PosePath([0, 2], [([0, u], [0, v], [0, 1])], error="1/100"),
    ]
    return random.choice(motions)()


def wrong_answer(random: Random, scene: Scene) -> tuple[str, str | None]:
    """Return what kind of contact a pair has, and a difference from its pieces."""
    contact = first_contact(scene)
    kind = "no contact" if contact is None else contact.kind
    return kind, next(_differences(random, scene), None)


def _differences(random: Random, scene: Scene) -> Iterator[str]:
    """Yield differences of answers from those of the reference, and from those of the pieces."""
    a, b = scene.bodies
    pieces = [Scene(two, scene.time) for two in product(dissected(a), dissected(b))]
    contact, expected = first_contact(scene), reference.first_contact(scene)
    if difference := disagreement(expected, contact):
        yield f"first_contact: {difference}"
    times = [met.time for two in pieces if (met := first_contact(two)) is not None]
    time = None if contact is None else contact.time
    if time != min(times, default=None):
        yield f"first_contact: {time}, but that of the pieces {min(times, default=None)}"
    exact = first_contact(scene, exact_only=True)
    if what := contrast(contact, exact):
        yield f"exact_only: {what}: {exact}, not {contact}"
    planned = Planner([a], scene.time).first_contact(b, b.motion)
    if what := contrast(contact, planned):
        yield f"Planner: {what}: {planned}, not {contact}"
    alone = Scene([b], scene.time)
    if first_contact(alone) is not None or (contact is not None and contact.kind == "self"):
        yield "a contact of a body with itself"
    # The definition of new contacts takes long for motions of many pieces.
    if not (_is_approximated(a) or _is_approximated(b)):
        new, new_expected = first_contact(scene, after_start=True), new_contact(a, b, scene.time)
        if (None if new is None else new.time) != new_expected:
            yield f"after_start: {new}, not {new_expected}"
    yield from _wrong_intervals(scene, pieces)
    yield from _wrong_distances(random, scene, pieces)
    yield from _wrong_bounds(scene, time)


def _is_approximated(body: Body) -> bool:
    """Return True if pieces approximate the motion of a body."""
    return isinstance(body.motion, (Spin, PosePath))


def _wrong_intervals(scene: Scene, pieces: Sequence[Scene]) -> Iterator[str]:
    found = [(i.start, i.end) for i in contact_intervals(scene, "a", "b")]
    every = [(i.start, i.end) for two in pieces for i in contacts(two)]
    joined: list[tuple[AlgebraicNumber, AlgebraicNumber]] = []
    for start, end in sorted(every):
        if joined and start <= joined[-1][1]:
            joined[-1] = joined[-1][0], max(joined[-1][1], end)
        else:
            joined.append((start, end))
    if found != joined:
        yield f"intervals {found}, but those of the pieces {joined}"


def _wrong_distances(random: Random, scene: Scene, pieces: Sequence[Scene]) -> Iterator[str]:
    at = scene.start + (scene.end - scene.start) * QQ(random.randint(0, 12), 12)
    d = QQ(random.choice([1, 1, 2, 3]), random.choice([1, 2, 3]))
    squares: list[Fraction] = []
    times: list[AlgebraicNumber] = []
    for two in pieces:
        a, b = (body.name for body in two.bodies)
        squares.append(distance(two, a, b, at=at).core_squared)
        time = first_within(two, a, b, d)
        if time is not None:
            times.append(time)
    found, least = distance(scene, "a", "b", at=at).core_squared, min(squares)
    if found != least:
        yield f"the distance at {at}: {found}, but that of the pieces {least}"
    within = first_within(scene, "a", "b", d)
    if within != min(times, default=None):
        yield f"within {d}: {within}, but the pieces {min(times, default=None)}"
    if scene.has_radius:  # the cores decide, as above
        return
    gap = clearance(scene, "a", "b")
    if gap.squared(at) != least or gap.minimum.squared.compare_rational(rational(least)) > 0:
        yield f"the clearance at {at}: {gap.squared(at)}, at least {gap.minimum}, but {least}"


def _wrong_bounds(scene: Scene, time: AlgebraicNumber | None) -> Iterator[str]:
    bounds = first_contact_enclosed(scene)
    if any(map(_is_approximated, scene.bodies)):
        if time is not None and (bounds is None or bounds.low > time):
            yield f"enclosed: {bounds}, although the pieces of motion touch at {time}"
        return
    if (None if bounds is None else (bounds.low, bounds.high)) != (time and (time, time)):
        yield f"enclosed: {bounds}, not {time}"
