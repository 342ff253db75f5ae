"""Rounded bodies: crowds, kisses, slides, rolls round corners, and corners that are filled."""

from __future__ import annotations

from random import Random

from exactpt.kernel.numbers import QQ
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.motions import Affine, Motion, Pieces, Rigid, Translation
from exactpt.scene.scene import Scene
from exactpt.testing.scenes.shapes import box, cells, convex_polygon, poly, valid_scene, velocity

TRIPLES = [(3, 4, 5), (5, 12, 13), (8, 15, 17), (1, 0, 1), (0, 2, 2)]
"""Legs and hypotenuse of right triangles."""


def discs(rng: Random) -> Scene:
    """A crowd of discs and capsules with doubles as coordinates, velocities and radii."""
    bodies = []
    for i, (x, y) in enumerate(cells(rng, rng.randint(3, 40), 4)):
        at = float(x) + rng.random(), float(y) + rng.random()
        ends = [at, (at[0] + rng.random(), at[1] + rng.random())][: rng.choice([1, 1, 2])]
        speed = [[0.0, rng.uniform(-1, 1)] for _ in range(2)]
        bodies.append(Body(f"b{i}", ends, Translation(*speed), radius=rng.uniform(0.2, 1.2)))
    return Scene(bodies, (0, 10))


def kissing_discs(rng: Random) -> Scene:
    """Discs that pass each other at just the sum of their radii, or a little more or less."""
    k = rng.randint(1, 4)
    tiny = QQ(1, 10 ** rng.choice([1, 9, 18, 40]))
    bodies = [Body("post", [(0, 0)], radius=rng.choice([QQ(0), QQ(1), QQ(1, 2)]))]
    for i in range(k):
        dx, dy, length = rng.choice(TRIPLES)
        off = rng.choice([QQ(0), QQ(0), tiny, -tiny])
        radius = length - bodies[0].exact_radius + off
        if radius < 0:
            continue
        sx, sy = rng.choice([1, -1]), rng.choice([1, -1])
        # At the time t it is at (dx, dy), on a line across that direction, or on a parabola.
        t, speed = rng.randint(1, 4), rng.choice([1, 2])
        across = rng.choice([0, 0, 1])
        x = Polynomial([sx * dx + sx * dy * speed * t, -sx * dy * speed])
        y = Polynomial([sy * dy - sy * dx * speed * t, sy * dx * speed])
        away = poly(t * t, -2 * t, 1) * poly(across)
        motion = Translation(x + away * poly(sx * dx), y + away * poly(sy * dy))
        bodies.append(Body(f"d{i}", [(0, 0)], motion, radius=radius))
    return Scene(bodies, (0, rng.choice([2, 6])))


def sliding_capsules(rng: Random) -> Scene:
    """Capsules, discs and boxes that slide along others at just their distance, or nearly."""
    tiny = QQ(1, 10 ** rng.choice([1, 12, 40]))
    floor = Body(
        "floor", [(0, 0), (rng.randint(2, 6), 0)], radius=rng.choice([QQ(1), QQ(1, 2), QQ(0)])
    )
    bodies = [floor]
    for i in range(rng.randint(1, 3)):
        radius = rng.choice([QQ(1), QQ(1, 3), QQ(2), QQ(0)])
        gap = rng.choice([QQ(0), QQ(0), tiny, -tiny])
        y = floor.exact_radius + radius + gap
        left, length = -8 - 4 * i, rng.randint(0, 2)
        shape = [(QQ(left), y), (QQ(left + length), y)][: 2 if length else 1]
        if rng.random() < 0.5:
            shape = box(left, y, 1 + length, 1)
        path = rng.choice([poly(0, 1), poly(0, 2), poly(0, 4, QQ(-1, 4))])
        drop = rng.choice([poly(0), poly(0), poly(QQ(9, 4), -3, 1)])
        bodies.append(Body(f"c{i}", shape, Translation(path, drop), radius=radius))
    return Scene(bodies, (0, rng.choice([8, 20])))


def rolling_discs(rng: Random) -> Scene:
    """Discs that roll along an edge of a box and round its corner, at a gap, to another body."""
    radius = rng.choice([QQ(1), QQ(1, 2), QQ(3, 2)])
    gap = rng.choice([QQ(1, 7), QQ(1, 7), QQ(1, 10**20), QQ(1, 10**20), QQ(0), -QQ(1, 10**20)])
    rounded = rng.choice([QQ(0), QQ(0), QQ(1, 2)])
    height = radius + rounded + gap
    table = Body("table", box(-6, -4, 6, 4), radius=rounded)
    # From (-4, h) to (0, h), by a quarter turn about the corner (0, 0) to (h, 0), then down.
    turn = Rigid([4, -1], pivot=(0, 0))
    roll = Pieces(
        [
            (4, Translation([-4, 1])),
            (5, turn),
            (None, Translation([height], [-height + 5, -1])),
        ]
    )
    disc = Body("disc", [(QQ(0), height)], roll, radius=radius)
    bodies = [table, disc]
    side = rng.choice([[(height + 2 * radius, QQ(1))], [(QQ(1), QQ(-3)), (QQ(3), QQ(-3))]])
    if rng.random() < 0.8:
        bodies.append(Body("stop", side, radius=rng.choice([QQ(0), QQ(1, 4), radius])))
    if rng.random() < 0.3:
        other = Translation([-9, 1]) if rng.random() < 0.5 else Translation([-9, 2])
        bodies.append(Body("second", [(QQ(0), height)], other, radius=radius))
    return Scene(bodies, (0, rng.choice([5, 9])))


def discs_in_corners(rng: Random) -> Scene:
    """Discs that run into corners, slots and notches where they touch several edges at once."""
    r = rng.choice([QQ(1), QQ(2), QQ(1, 2)])
    wall = [(-9, -9), (9, -9), (9, 9), (5, 9), (5, -5), (-5, -5), (-5, 9), (-9, 9)]
    notch = [(-9, -9), (9, -9), (9, 3), (0, -6), (-9, 3)]
    bodies = [Body("wall", rng.choice([wall, notch]), closed=rng.random() < 0.8)]
    down = rng.choice([poly(0, -1), poly(0, -2), poly(0, 0, -1)])
    across = rng.choice([poly(0), poly(0, 1), poly(0, -1)])
    bodies.append(Body("disc", [(0, 6)], Translation(across, down), radius=r))
    if rng.random() < 0.5:
        fits = Body(
            "fits", [(0, 2)], Translation([0], [0, -1]), radius=rng.choice([r, QQ(1), QQ(4)])
        )
        bodies.append(fits)
    if rng.random() < 0.3:
        bodies.append(Body("bar", [(-2, 8), (2, 8)], Translation([0], [0, -3]), radius=r))
    return Scene(bodies, (0, rng.choice([6, 12])))


def rounded_grid(rng: Random) -> Scene:
    """Small shapes with and without small radii, small integers everywhere: ties are frequent."""
    outlines = [
        [(0, 0)],
        [(0, 0), (2, 1)],
        [(0, 0), (2, 0)],
        [(0, 0), (2, 0), (0, 2)],
        [(0, 0), (2, 0), (2, 2), (1, 1)],
        [(0, 0), (3, 0), (3, 3), (0, 3)],
    ]
    bodies = []
    for i, (x, y) in enumerate(cells(rng, rng.randint(2, 5), 5)):
        outline = [(x + p, y + q) for p, q in rng.choice(outlines)]
        radius = rng.choice([QQ(0), QQ(0), QQ(1), QQ(1), QQ(1, 2), QQ(2)])
        closed = rng.random() < 0.7
        bodies.append(Body(f"b{i}", outline, _small(rng, x, y), closed=closed, radius=radius))
    return Scene(bodies, (0, rng.choice([3, 6])))


def _small(rng: Random, x: QQ, y: QQ) -> Motion:
    """A motion with small integers."""
    kind = rng.randrange(8)
    if kind == 0:
        return Rigid([0, rng.choice([1, -1])], pivot=(x, y))
    if kind == 1:
        return Translation([0, -2, 1], [0, rng.randint(-1, 1)])
    if kind == 2:
        return Pieces([(1, Translation([0, 1])), (None, Translation([0, 1], [-1, 1]))])
    return velocity(rng, 2)


def rounded_motions(rng: Random) -> Scene:
    """Rounded polygons, capsules and discs that turn, deform, stretch, follow keyframes."""
    bodies: list[Body] = []
    for i, (x, y) in enumerate(cells(rng, rng.randint(2, 6), 6)):
        shape = convex_polygon(rng, (x, y), 2, rng.randint(3, 6))
        shape = shape[: rng.choice([1, 2, len(shape), len(shape)])]
        radius = rng.choice([QQ(0), QQ(rng.randint(1, 20), 10), QQ(1)])
        name, closed = f"b{i}", rng.random() < 0.8
        kind = rng.randrange(5)
        if kind == 0:
            moved = [(u + rng.randint(-3, 3), v + rng.randint(-3, 3)) for u, v in shape]
            frames = [(1, shape), (4, moved)]
            body = Body(name, closed=closed, keyframes=frames, radius=radius)
        elif kind == 1:
            vertices = [
                (poly(u, QQ(rng.randint(-2, 2), 2)), poly(v, QQ(rng.randint(-2, 2), 2)))
                for u, v in shape
            ]
            body = Body(name, vertices, velocity(rng, 1), closed=closed, radius=radius)
        elif kind == 2:
            turn = Rigid([0, QQ(1, rng.randint(1, 3))], pivot=(x, y), x=[0, rng.randint(-1, 1)])
            body = Body(name, shape, turn, closed=closed, radius=radius)
        elif kind == 3:
            grow = [[poly(1, QQ(1, 9)), poly(0)], [poly(0, QQ(1, 5)), poly(1)]]
            body = Body(name, shape, Affine(grow), closed=closed, radius=radius)
        else:
            fall = Translation([0, rng.randint(-2, 2)], [0, rng.randint(0, 3), -1])
            body = Body(name, shape, fall, closed=closed, radius=radius)
        bodies.append(body)
    return valid_scene(bodies, (0, 5))
