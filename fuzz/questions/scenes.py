"""Scenes of a few bodies whose distance has grazes, ties, and equal values for ever; crowds."""

from __future__ import annotations

from random import Random
from typing import Final

from exactpt import Body, Pieces, Rigid, Scene, Translation
from exactpt.kernel.numbers import QQ
from exactpt.motion.motions import Motion
from fuzz.questions.tiny import pair_scene, touching_scene
from fuzz.rings import parts_of

__all__ = ["arc_scene", "chevrons", "crowded_scene", "distant_scene", "meeting_scene", "relay"]

Shape = list[tuple[int, int]]

CHEVRONS: Final = 72
"""Number of bodies of which no box, however it is turned, is apart from that of another one."""


TIMES: Final = (QQ(1), QQ(1, 3), QQ(3, 7), QQ(5, 9), QQ(10, 13), QQ(3, 2))


def distant_scene(random: Random) -> Scene:
    """A pair of any kind; or one that keeps or grazes its distance, with breakpoints."""
    kind = random.randrange(4)
    if kind == 0:
        return pair_scene(random)
    if kind == 1:
        return _orbit(random)
    shapes = [_axis_parallel(random, 0), _axis_parallel(random, random.randint(2, 6))]
    bodies = [
        Body(name, shape, _along_axis(random), closed=random.random() < 0.7)
        for name, shape in zip("ab", shapes, strict=True)
    ]
    return Scene(bodies, time=(0, 4))


def crowded_scene(random: Random) -> Scene:
    """Three bodies, or some that touch at the start."""
    if random.random() < 0.3:
        return touching_scene(random)
    scenes = [distant_scene(random), distant_scene(random)]
    bodies = [
        Body(f"{body.name}{i}", motion=body.motion, parts=parts_of(body, body.vertices))
        if body.has_rings
        else Body(f"{body.name}{i}", body.vertices, body.motion, closed=body.closed)
        for i, scene in enumerate(scenes)
        for body in scene.bodies[: 2 - i]
    ]
    return Scene(bodies, time=(0, 2))


def meeting_scene(random: Random) -> Scene:
    """Two bodies that are likely to meet."""
    if random.random() < 0.5:
        return pair_scene(random)
    scene = touching_scene(random)
    return Scene(scene.bodies[:2], (scene.start, scene.end))


def _orbit(random: Random) -> Scene:
    """A body that turns about a point, or about a corner of another body."""
    x, y = random.randint(-1, 3), random.randint(-1, 3)
    arm = [(x + 2, y), (x + random.choice([3, 4]), y + random.choice([0, 1]))]
    moved: Motion = Rigid([0, random.choice([1, -1, 2])], pivot=(x, y))
    hub = [(x, y)] if random.random() < 0.4 else _axis_parallel(random, random.choice([0, x]))
    return Scene([Body("a", arm[: random.choice([1, 2])], moved), Body("b", hub)], time=(-2, 2))


def _axis_parallel(random: Random, x: int) -> Shape:
    w, h = random.randint(1, 3), random.randint(1, 3)
    return random.choice(
        [
            [(x, 0)],
            [(x, 0), (x, h)],
            [(x, 0), (x + w, 0)],
            [(x, 0), (x + w, 0), (x + w, h), (x, h)],
            [(x, 0), (x + w, h), (x, 2 * h)],
        ]
    )


def _along_axis(random: Random) -> Motion:
    """Slides, parabolas with a turning point at an integer time, stops and changes of lane."""
    u, at = random.choice([1, -1, 2]), random.choice([1, 2, 3])
    slide, back = Translation([0], [0, u]), Translation([0], [2 * at * u, -u])
    motions: list[Motion] = [
        Translation([0]),
        slide,
        Translation([0, u]),
        Translation([u * at * at, -2 * u * at, u]),  # u (t - at)^2
        Translation([u * at * at, -2 * u * at, u], [0, 1]),
        Translation([0, -at, 1]),
        Pieces([(at, slide), (None, back)]),
        Pieces([(at, slide), (None, Translation([0], [u * at]))]),
        Pieces([(at, Translation([0, u])), (None, Translation([2 * u * at, -u]))]),
    ]
    return random.choice(motions)


def chevrons(random: Random) -> Scene:
    """Return nested angles that move almost alike and never touch: all pairs must be compared."""
    bodies = []
    for k in range(CHEVRONS):
        motion = Translation([0, 1 + QQ(k, 1024)], [0, QQ(random.randint(-3, 3), 1024)])
        bodies.append(Body(f"b{k}", [(k + 40, 40), (k, 0), (k + 40, -40)], motion, closed=False))
    return Scene(bodies, (0, 1))


def arc_scene(random: Random) -> Scene:
    """Return an arc of points, beside which two others change places time and again.

    Each time the chain along the arc is walked along, until it has been made searchable. Points of
    the arc leave it slowly.
    """
    size, swaps = random.choice([8, 30]), 40
    arc = []
    for i in range(-size, size + 1):
        slow = Translation([0], [0, QQ(random.choice([-1, 0, 0, 1]), 10)])
        arc.append(Body(f"a{i}", [(-i * i, 2 * i)], slow))
    beside = 6 * size * size
    there_and_back: list[tuple[int | None, Translation]] = []
    for k in range(swaps):
        x = [-1 - 2 * k, 2] if k % 2 == 0 else [1 + 2 * k, -2]
        there_and_back.append((k + 1 if k < swaps - 1 else None, Translation(x, [0])))
    pair = [
        Body("p", [(beside, 3 * size)]),
        Body("q", [(beside, -3 * size)], Pieces(there_and_back)),
    ]
    return Scene([*arc, *pair], (0, swaps))


def relay(random: Random) -> Scene:
    """Return walls and boxes that all turn back at one time, when some of them touch their walls.

    That time is the contact, and the start of pieces whose boxes already meet. So it is known to
    the last double of which pairs are compared before, and of which after it.
    """
    time = random.choice(TIMES)
    bodies: list[Body] = []
    for k in range(random.randint(6, 9)):
        y = 10 * k
        bodies.append(Body(f"wall{k}", [(0, y), (1, y + 2), (0, y + 4), (2, y + 4), (2, y)]))
        u = random.choice([QQ(1), QQ(2), QQ(1, 3), QQ(5, 7)])
        v = random.choice([QQ(0), QQ(0), QQ(1, 9)])
        gap = random.choice([QQ(0), QQ(1, 100), QQ(1, 7)])  # at that time, from the tip of the box
        tip = (-gap, y + 1) if random.random() < 0.5 else (1 - gap, y + 2)
        x0, y0 = tip[0] - u * time, tip[1] - v * time
        there = Translation([0, u], [0, v])
        back = Translation([2 * u * time, -u], [2 * v * time, -v])
        shape = [(x0, y0), (x0 - 1, y0 + QQ(1, 8)), (x0 - 1, y0 - QQ(1, 8))]
        bodies.append(Body(f"box{k}", shape, Pieces([(time, there), (None, back)])))
    random.shuffle(bodies)
    return Scene(bodies, (0, 2 * time))
