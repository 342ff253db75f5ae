"""Scenes of tiny bodies with small integers, in which ties and touches are frequent."""

from __future__ import annotations

from random import Random
from typing import Final

from exactpt import Affine, Body, InputError, Pieces, Rigid, Scene, Translation
from exactpt.motion.motions import Motion

__all__ = ["pair_scene", "touching_scene"]

SHAPES: Final = (
    [(0, 0)],
    [(0, 0), (2, 1)],
    [(0, 0), (2, 0), (0, 2)],
    [(0, 0), (2, 0), (2, 2), (1, 1)],
)
RINGED: Final = (
    [[[(-1, -1), (5, -1), (-1, 5)], [(0, 0), (2, 0), (0, 2)]]],
    [[[(-2, -2), (2, -2), (2, 2), (-2, 2)], [(-1, -1), (-1, 1), (1, 0)]]],
    [[[(0, 0), (2, 0), (0, 2)]], [[(2, 2), (1, 2), (2, 1)]]],
)
"""For each body its parts; for each of these its rings."""

FRAME: Final = [(-4, -4), (6, -4), (6, 7), (-4, 7)]
WINDOWS: Final = (
    [(-3, -3), (5, -3), (5, 5), (-3, 5)],
    [(0, 0), (4, 0), (4, 4), (0, 4)],
    [(0, 0), (2, 0), (2, 2), (0, 2)],
)
"""A frame around other bodies, and holes in it in which they may be, or be stuck."""


def pair_scene(random: Random) -> Scene:
    """Two tiny bodies that pass each other: chains, segments, points, polygons."""
    bodies = []
    for name in ("a", "b"):
        dx, dy = random.randint(-3, 3), random.randint(-3, 3)
        parts = [
            [[(x + dx, y + dy) for x, y in ring] for ring in rings] for rings in _parts(random)
        ]
        motions: list[Motion] = [
            Translation([0]),
            Translation([0, random.randint(-2, 2)], [0, random.randint(-2, 2)]),
            Translation([0, -2, 1], [0, random.randint(-1, 1)]),
            Translation([1, -2, 1], [0, 0, 1]),
            Rigid([0, 1], pivot=(dx, dy)),
            Pieces([(1, Translation([0, 1])), (None, Translation([2, -1]))]),
            Pieces([(1, Translation([0, 1])), (None, Translation([0, 1], [-1, 1]))]),
            Pieces([(2, Translation([0])), (None, Translation([0], [2, -1]))]),
            Affine([[[1, "-1/2"], [0]], [[0], [1]]]),  # flat at t = 2
        ]
        motion, closed = random.choice(motions), random.random() < 0.6
        if len(parts) == len(parts[0]) == 1:
            bodies.append(Body(name, parts[0][0], motion, closed=closed))
        else:
            made = [{"vertices": outline, "holes": holes} for outline, *holes in parts]
            bodies.append(Body(name, motion=motion, parts=made))
    return Scene(bodies, time=(0, 4))


def _parts(random: Random) -> list[list[list[tuple[int, int]]]]:
    """The rings of each part of a tiny shape."""
    return random.choice(RINGED) if random.random() < 0.2 else [[random.choice(SHAPES)]]


def touching_scene(random: Random) -> Scene:
    """Tiles, stacks, nests and neighbours that touch at the start, and move a little."""
    while True:
        place = random.choice([_tiles, _stack, _nest, _neighbours])
        shapes = place(random)
        bodies = [
            Body(f"b{i}", shape, _motion(random), closed=random.random() < 0.8)
            for i, shape in enumerate(shapes)
        ]
        if random.random() < 0.2:
            bodies.append(Body("frame", FRAME, _motion(random), holes=[random.choice(WINDOWS)]))
        start = random.choice([0, 0, 0, 1])  # 1: a breakpoint is at the start
        try:
            return Scene(bodies, time=(start, start + 3))
        except InputError:
            continue  # a chain or a deforming body that meets itself at the start


def _motion(random: Random) -> Motion:
    """Rest, slides, jumps, hops, turns, growth, pieces that begin at 1 or 2."""
    u, v = random.choice([(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (1, -1)])
    later = random.choice([1, 2])
    there = Translation([0, u], [0, v])
    back = Translation([2 * later * u, -u], [2 * later * v, -v])
    motions: list[Motion] = [
        Translation([0]),
        Translation([0]),
        there,
        Translation([0, 2 * u, -u], [0, 2 * v, -v]),
        Translation([0, 0, u], [0, 0, v]),
        Translation([0, -u, u], [0, v]),
        Rigid([0, random.choice([1, -1])], pivot=(u, v)),
        Affine([[[1, "1/2"], [0]], [[0], [1]]]),
        Pieces([(later, Translation([0])), (None, Translation([-later * u, u]))]),
        Pieces([(later, there), (None, Translation([later * u], [later * v]))]),
        Pieces([(later, there), (None, back)]),
    ]
    return random.choice(motions)


def _tiles(random: Random) -> list[list[tuple[int, int]]]:
    """Some cells of a map: triangles and quadrilaterals that share borders and corners."""
    cells = [
        [(0, 0), (2, 0), (2, 2), (0, 2)],
        [(2, 0), (4, 0), (4, 2), (2, 2)],
        [(0, 2), (2, 2), (1, 4)],
        [(2, 2), (4, 2), (4, 4), (1, 4)],
        [(2, 0), (2, -2), (4, 0)],
    ]
    return random.sample(cells, random.choice([2, 2, 3]))


def _stack(random: Random) -> list[list[tuple[int, int]]]:
    """Boxes on a floor, or on each other, flush or not."""
    boxes, y = [[(-3, -1), (5, -1), (5, 0), (-3, 0)]], 0
    for _ in range(random.choice([1, 1, 2])):
        x, height = random.randint(-2, 3), random.randint(1, 2)
        boxes.append([(x, y), (x + 2, y), (x + 2, y + height), (x, y + height)])
        y += random.choice([0, height, height])
    return boxes


def _nest(random: Random) -> list[list[tuple[int, int]]]:
    """A body in another one, inside or at its border."""
    square, triangle = [(0, 0), (4, 0), (4, 4), (0, 4)], [(0, 0), (5, 0), (0, 5)]
    outer = random.choice([square, triangle, [(0, 0), (4, 0), (2, 2), (0, 4)]])
    x, y = random.randint(0, 2), random.randint(0, 2)
    return [outer, [(x + u, y + v) for u, v in random.choice(SHAPES)]]


def _neighbours(random: Random) -> list[list[tuple[int, int]]]:
    """Two or three shapes near each other."""
    shapes = []
    for _ in range(random.choice([2, 2, 3])):
        x, y = random.randint(-2, 2), random.randint(-2, 2)
        shapes.append([(x + u, y + v) for u, v in random.choice(SHAPES)])
    return shapes
