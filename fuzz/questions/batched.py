"""Pairs of turning bodies in a batch, whose filters decide most of them, and each by itself.

The bodies touch at the start, far from the pivots about which they turn. So the places there are
rounded far more coarsely than the shapes, and doubles are off by as much as the bounds allow for.
"""

from __future__ import annotations

import json
from random import Random
from typing import Final, TypeAlias

from exactpt import Body, Rigid, Scene, first_contact
from exactpt.batch.answering import answers
from exactpt.kernel.numbers import QQ, rational
from exactpt.scene.written import to_json
from fuzz.changes.awkward import TURNS, awkward_number

__all__ = ["touching_while_turning", "wrong_in_batch"]

Point: TypeAlias = tuple[QQ, QQ]

TOGETHER: Final = 32
"""Number of pairs in a call."""

FAR: Final = (1, 1000, 10**5, 10**6)
"""Distances from the pivots."""

HALF_TURNS: Final = ("1/3", "-1/7", "1/1000", "-1/3000", "2/999", "-1/701")
"""Half turns at the start: the smaller one is, the less the bounds exceed the errors."""


def wrong_in_batch(random: Random) -> tuple[Scene, str, str | None]:
    """Return a scene, what happens in it, and the fault of the batch; a right one is the first."""
    scenes = [touching_while_turning(random) for _ in range(TOGETHER)]
    together = list(answers(json.dumps(to_json(scene)) for scene in scenes))
    singly = [first_contact(scene) for scene in scenes]
    for scene, answer, contact in zip(scenes, together, singly, strict=True):
        expected = None if contact is None else contact.to_json()
        found = answer.get("contact", answer)
        if json.dumps(found) != json.dumps(expected):
            return scene, "wrong", f"in a batch {found}, by itself {expected}"
    first = singly[0]
    return scenes[0], "none" if first is None else first.kind, None


def touching_while_turning(random: Random) -> Scene:
    """Return a wall and a small triangle, a corner of which is on the wall near one of its ends.

    In some cases it is a little beside the wall. The filters' bounds grow with the edges, so that
    a short one shows errors best. The time span is short: only the start matters.
    """
    cosine, sine = random.choice(TURNS)
    far = random.choice(FAR) * (1 + abs(awkward_number(random, 1)))
    middle = far * cosine, far * sine
    # The direction of the wall; the triangle is on its left.
    u, v = random.choice([(QQ(1), QQ(0)), (QQ(0), QQ(1)), (sine, -cosine)])

    def at(along: QQ, across: QQ) -> Point:
        return middle[0] + along * u - across * v, middle[1] + along * v + across * u

    gap = QQ(random.choice([0, 0, 0, 0, 0, 0, 1, -1])) / 2 ** random.choice([30, 40, 50, 54])
    size = abs(awkward_number(random, 1)) / 8 + QQ(1, 20)
    where = abs(awkward_number(random, 1)) / 8 + QQ(1, 20)
    wall = [at(QQ(0), QQ(0)), at(QQ(2), QQ(0))]
    if random.random() < 0.5:
        wall.append(at(QQ(1), QQ(-1)))
    corner = [at(where, gap), at(where + size, gap + size), at(where - size / 2, gap + size)]
    turn = cosine, sine
    return Scene(
        [_turning(random, "a", wall, turn), _turning(random, "b", corner, turn)], (0, "1/1000")
    )


def _turning(random: Random, name: str, places: list[Point], orientation: Point) -> Body:
    """Return a body that is at its places at the start, t = 0, and turns from there on."""
    first, rate = rational(random.choice(HALF_TURNS)), awkward_number(random, 1)
    pivot = path = (QQ(0), QQ(0))
    if random.random() < 0.1:
        pivot = awkward_number(random, 4), awkward_number(random, 4)
        path = awkward_number(random, 3), awkward_number(random, 3)
    # At t = 0 a body is turned by its half turn and by its orientation: by (c, s) in all.
    square = 1 + first * first
    c, s = (1 - first * first) / square, 2 * first / square
    c, s = c * orientation[0] - s * orientation[1], s * orientation[0] + c * orientation[1]
    vertices = []
    for x, y in places:
        u, v = x - pivot[0] - path[0], y - pivot[1] - path[1]
        vertices.append((c * u + s * v + pivot[0], c * v - s * u + pivot[1]))
    velocity = awkward_number(random, 2), awkward_number(random, 2)
    motion = Rigid(
        [first, rate], pivot=pivot, x=[path[0], velocity[0]], y=[path[1], velocity[1]],
        orientation=orientation,
    )  # fmt: skip
    return Body(name, vertices, motion)
