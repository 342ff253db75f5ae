"""Simple polygons of any shape: stars, combs, spirals, clamps, blobs that deform."""

from __future__ import annotations

from random import Random

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.motions import Motion, Rigid, Translation
from exactpt.scene.scene import Scene
from exactpt.testing.scenes.shapes import box, cells, poly, shape, valid_scene, velocity

# Directions around a circle in order, exact and of about equal length.
_CIRCLE = [
    (100, 0), (92, 38), (71, 71), (38, 92), (0, 100), (-38, 92), (-71, 71), (-92, 38),
    (-100, 0), (-92, -38), (-71, -71), (-38, -92), (0, -100), (38, -92), (71, -71), (92, -38),
]  # fmt: skip


def star(rng: Random, center: Point, radius: int, size: int) -> list[Point]:
    """A star-shaped polygon of 4 to 16 vertices around a center, counter-clockwise."""
    directions = sorted(rng.sample(range(16), max(4, min(size, 16))))
    points = []
    for d in directions:
        r = QQ(rng.randint(radius // 4, radius), 100)
        points.append((center[0] + r * _CIRCLE[d][0], center[1] + r * _CIRCLE[d][1]))
    return points


def stars(rng: Random) -> Scene:
    """Star-shaped polygons among convex bodies, in linear motion."""
    k = rng.randint(2, 8)
    bodies = []
    for i, c in enumerate(cells(rng, k, 100)):
        outline = star(rng, c, 48, rng.randint(4, 16)) if rng.random() < 0.7 else shape(rng, c, 40)
        bodies.append(Body(f"b{i}", outline, velocity(rng, 50)))
    return valid_scene(bodies, (0, rng.choice([1, 2, 4])))


def turning_stars(rng: Random) -> Scene:
    """Star-shaped polygons that turn."""
    k = rng.randint(2, 5)
    bodies = []
    for i, c in enumerate(cells(rng, k, 100)):
        move = velocity(rng, 30)
        turn = poly(rng.randint(-1, 1), QQ(rng.randint(-4, 4), 4))
        motion: Motion = Rigid(turn, pivot=c, x=move.x, y=move.y) if i % 3 else move
        bodies.append(Body(f"b{i}", star(rng, c, 48, rng.randint(4, 10)), motion))
    return valid_scene(bodies, (0, rng.choice([1, 2])))


def blobs(rng: Random) -> Scene:
    """Star-shaped polygons whose vertices move independently along lines."""
    k = rng.randint(1, 4)
    bodies = []
    speed = rng.choice([10, 40])
    for i, c in enumerate(cells(rng, k, 100)):
        outline = star(rng, c, 45, rng.randint(4, 12))
        vertices = [
            (
                Polynomial([x, rng.randint(-speed, speed)]),
                Polynomial([y, rng.randint(-speed, speed)]),
            )
            for x, y in outline
        ]
        bodies.append(Body(f"b{i}", vertices, Translation()))
    return valid_scene(bodies, (0, rng.choice([1, 2])))


def chains(rng: Random) -> Scene:
    """Open chains that translate, turn or bend, among other bodies."""
    k = rng.randint(2, 6)
    bodies = []
    for i, c in enumerate(cells(rng, k, 100)):
        move = velocity(rng, 40)
        if rng.random() < 0.3:
            bodies.append(Body(f"b{i}", shape(rng, c, 40), move))
            continue
        line = star(rng, c, 45, rng.randint(4, 9))
        if rng.random() < 0.3:  # an angle of pi at one vertex
            line.insert(1, ((line[0][0] + line[1][0]) / 2, (line[0][1] + line[1][1]) / 2))
        kind = rng.randrange(3)
        if kind == 0:
            bodies.append(Body(f"b{i}", line, move, closed=False))
        elif kind == 1:
            turn = Rigid(poly(0, QQ(rng.randint(-3, 3), 4)), pivot=c, x=move.x, y=move.y)
            bodies.append(Body(f"b{i}", line, turn, closed=False))
        else:
            paths = [
                (Polynomial([x, rng.randint(-8, 8)]), Polynomial([y, rng.randint(-8, 8)]))
                for x, y in line
            ]
            bodies.append(Body(f"b{i}", paths, move, closed=False))
    return valid_scene(bodies, (0, rng.choice([1, 2])))


def combs(rng: Random) -> Scene:
    """Two interlocking combs; one moves along the teeth, across them, or both."""
    teeth = rng.randint(2, 5)
    gap, width, depth = 8, rng.choice([2, 3]), rng.randint(4, 9)
    lower: list[Point] = [(QQ(-2), QQ(-2)), (QQ(gap * teeth), QQ(-2))]
    for i in reversed(range(teeth)):
        x = QQ(gap * i)
        lower += [(x + width, QQ(0)), (x + width, QQ(depth)), (x, QQ(depth)), (x, QQ(0))]
    lower[2:2] = [(QQ(gap * teeth), QQ(0))]
    lower.append((QQ(-2), QQ(0)))
    top = QQ(depth + rng.randint(1, 3))
    shift = QQ(gap, 2)  # each tooth midway between two
    if rng.random() < 0.5:
        shift = QQ(rng.randint(3 * width + 1, 3 * (gap - width) - 1), 3)
    upper = [(x + shift, top - y) for x, y in reversed(lower)]
    motion = Translation(
        [0, rng.choice([QQ(-1), QQ(0), QQ(0), QQ(1, 8)])],
        [0, rng.choice([QQ(-1, 3), QQ(0), QQ(1, 3), QQ(2)])],
    )
    bodies = [Body("lower", lower, Translation()), Body("upper", upper, motion)]
    return valid_scene(bodies, (0, rng.choice([2, 5])))


def spirals(rng: Random) -> Scene:
    """Two interlocked rectangular spirals, one of which moves a little."""
    turns = rng.randint(1, 3)
    pitch = 4
    points: list[Point] = []
    x = y = QQ(0)
    outer: list[Point] = [(x, y)]
    length = QQ(pitch)
    for i in range(4 * turns):
        dx, dy = ((1, 0), (0, 1), (-1, 0), (0, -1))[i % 4]
        x, y = x + dx * length, y + dy * length
        outer.append((x, y))
        length += QQ(pitch) * (i % 2)
    points = _thicken(outer, QQ(1, 2))
    other = [(-a + 2, -b + 2) for a, b in points]
    motion = Translation([0, QQ(rng.randint(-2, 2), 4)], [0, QQ(rng.randint(-2, 2), 4)])
    bodies = [Body("still", points, Translation()), Body("moving", other, motion)]
    return valid_scene(bodies, (0, 8))


def _thicken(path: list[Point], half: QQ) -> list[Point]:
    """A rectilinear path of constant width around a rectilinear center line that turns left."""
    left, right = [], []
    for i, (x, y) in enumerate(path):
        before = path[i - 1] if i else None
        after = path[i + 1] if i + 1 < len(path) else None
        (ux, uy) = _unit(before, (x, y)) if before else _unit((x, y), after or (x, y))
        (vx, vy) = _unit((x, y), after) if after else (ux, uy)
        nx, ny = -(uy + vy), ux + vx
        if before and after:
            left.append((x + half * nx, y + half * ny))
            right.append((x - half * nx, y - half * ny))
        else:
            left.append((x + half * nx / 2, y + half * ny / 2))
            right.append((x - half * nx / 2, y - half * ny / 2))
    return right + left[::-1]


def _unit(a: Point, b: Point) -> tuple[int, int]:
    return (b[0] > a[0]) - (b[0] < a[0]), (b[1] > a[1]) - (b[1] < a[1])


def clamps(rng: Random) -> Scene:
    """A jaw that closes on itself, perhaps with a body in between."""
    n = rng.randint(2, 6)
    bottom = [(Polynomial([200 * i]), Polynomial([rng.randint(0, 90)])) for i in range(n)]
    top = [
        (
            Polynomial([200 * i, rng.randint(-20, 20)]),
            Polynomial([rng.randint(300, 500), rng.randint(-80, -20)]),
        )
        for i in range(n)
    ]
    end = Polynomial([200 * n])
    back = Polynomial([-200])
    outline = [
        (back, Polynomial([-100])),
        (end, Polynomial([-100])),
        *reversed(bottom),
        (Polynomial([-100]), Polynomial([100])),
        *top,
        (end, Polynomial([700, -20])),
        (back, Polynomial([700, -20])),
    ]
    bodies = [Body("jaw", outline, Translation())]
    if rng.random() < 0.5:
        bodies.append(Body("prey", shape(rng, (QQ(300), QQ(190)), 40), velocity(rng, 15)))
    return valid_scene(bodies, (0, rng.choice([2, 6])))


_LETTERS = {
    "L": [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)],
    "T": [(1, 0), (2, 0), (2, 2), (3, 2), (3, 3), (0, 3), (0, 2), (1, 2)],
    "U": [(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)],
    "H": [(0, 0), (1, 0), (1, 1), (2, 1), (2, 0), (3, 0), (3, 3), (2, 3), (2, 2), (1, 2), (1, 3),
          (0, 3)],
    "S": [(0, 0), (2, 0), (2, 1), (3, 1), (3, 3), (1, 3), (1, 2), (0, 2)],
    "I": [(1, 0), (2, 0), (2, 3), (1, 3)],
}  # fmt: skip


def letters(rng: Random) -> Scene:
    """Rectilinear letters on a grid with integer velocities, some sliding into each other."""
    k = rng.randint(2, 7)
    bodies = []
    for i, (x, y) in enumerate(cells(rng, k, rng.choice([4, 5]))):
        outline: list[Point] = [(x + a, y + b) for a, b in _LETTERS[rng.choice(sorted(_LETTERS))]]
        bodies.append(Body(f"b{i}", outline, velocity(rng, 1)))
    if rng.random() < 0.3:
        bodies.append(Body("u", [(a - 20, b) for a, b in _LETTERS["U"]]))
        bodies.append(
            Body(
                "key",
                [(x - 20, y) for x, y in box(QQ(5, 4), 6, 1, 2)][:3],
                Translation([], [0, -1]),
            )
        )
    return Scene(bodies, (0, rng.choice([1, 4])))


def flat(rng: Random) -> Scene:
    """Shapes with straight angles, within a body or among bodies that move together."""
    k = rng.randint(1, 4)
    bodies = []
    for i, (x, y) in enumerate(cells(rng, k, 8)):
        outline = [(x + a, y + b) for a, b in _LETTERS[rng.choice(sorted(_LETTERS))]]
        split: list[Point] = []
        for (a, b), (c, d) in zip(outline, [*outline[1:], outline[0]], strict=True):
            split.append((a, b))
            cuts = rng.choice([0, 0, 1, 2, 4])
            split += [
                (a + (c - a) * j / (cuts + 1), b + (d - b) * j / (cuts + 1))
                for j in range(1, cuts + 1)
            ]
        bodies.append(Body(f"b{i}", split, velocity(rng, 1)))
        if rng.random() < 0.5:
            drop = box(x + QQ(rng.randint(0, 6), 2), y + 4, rng.randint(1, 2), rng.randint(1, 2))
            size = rng.choice([1, 2, 4])
            bodies.append(Body(f"d{i}", drop[:size], Translation([], [0, -1])))
    return Scene(bodies, (0, rng.choice([2, 6])))


def nested(rng: Random) -> Scene:
    """Nested square brackets around a box, which slide through their openings."""
    k = rng.randint(1, 4)
    bodies = [Body("core", box(-1, -1), velocity(rng, 1))]
    for i in range(1, k + 1):
        outer, inner = QQ(3 * i + 1), QQ(3 * i)
        gap = rng.choice([QQ(1), QQ(2), inner])
        outline: list[Point] = [
            (outer, gap), (outer, outer), (-outer, outer), (-outer, -outer), (outer, -outer),
            (outer, -gap), (inner, -gap), (inner, -inner), (-inner, -inner), (-inner, inner),
            (inner, inner), (inner, gap),
        ]  # fmt: skip
        outline = list(dict.fromkeys(outline))
        if rng.random() < 0.5:
            outline = [(-x, -y) for x, y in outline]
        if rng.random() < 0.5:
            outline = [(-y, x) for x, y in outline]
        bodies.append(Body(f"ring{i}", outline, velocity(rng, 1)))
    return valid_scene(bodies, (0, rng.choice([1, 8])))
