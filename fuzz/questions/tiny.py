"""Scenes of tiny bodies with small integers, in which ties and touches are frequent."""

from __future__ import annotations

from random import Random
from typing import Final, TypeAlias

from exactpt import Affine, Body, InputError, Pieces, Rigid, Scene, Translation
from exactpt.motion.motions import Motion

__all__ = ["pair_scene", "touching_scene"]

Ring: TypeAlias = list[tuple[int, int]]

SHAPES: Final[tuple[Ring, ...]] = (
    [(0, 0)],
    [(0, 0), (2, 1)],
    [(0, 0), (2, 0), (0, 2)],
    [(0, 0), (2, 0), (2, 2), (1, 1)],
)
RINGED: Final[tuple[list[list[Ring]], ...]] = (
    [[[(-1, -1), (5, -1), (-1, 5)], [(0, 0), (2, 0), (0, 2)]]],
    [[[(-2, -2), (2, -2), (2, 2), (-2, 2)], [(-1, -1), (-1, 1), (1, 0)]]],
    [[[(0, 0), (2, 0), (0, 2)]], [[(2, 2), (1, 2), (2, 1)]]],
)
"""For each body its parts; for each of these its rings."""

FRAME: Final[Ring] = [(-4, -4), (6, -4), (6, 7), (-4, 7)]
WINDOWS: Final[tuple[Ring, ...]] = (
    [(-3, -3), (5, -3), (5, 5), (-3, 5)],
    [(0, 0), (4, 0), (4, 4), (0, 4)],
    [(0, 0), (2, 0), (2, 2), (0, 2)],
)
"""A frame around other bodies, and holes in it in which they may be, or be stuck."""


def pair_scene(random: Random) -> Scene:
    """Two tiny bodies that pass each other: chains, segments, points, polygons."""
    return Scene([_passing(random, "a"), _passing(random, "b")], time=(0, 4))


def _passing(random: Random, name: str) -> Body:
    """A tiny body near the origin."""
    dx = random.randint(-3, 3)
    dy = random.randint(-3, 3)
    parts = [[_shifted(ring, dx, dy) for ring in rings] for rings in _parts(random)]
    rest = Translation([0])
    forward = Translation([0, 1])
    motions: list[Motion] = [
        rest,
        Translation([0, random.randint(-2, 2)], [0, random.randint(-2, 2)]),
        Translation([0, -2, 1], [0, random.randint(-1, 1)]),
        Translation([1, -2, 1], [0, 0, 1]),
        Rigid([0, 1], pivot=(dx, dy)),
        Pieces([(1, forward), (None, Translation([2, -1]))]),
        Pieces([(1, forward), (None, Translation([0, 1], [-1, 1]))]),
        Pieces([(2, rest), (None, Translation([0], [2, -1]))]),
        Affine([[[1, "-1/2"], [0]], [[0], [1]]]),  # flat at t = 2
    ]
    motion = random.choice(motions)
    is_closed = random.random() < 0.6
    if len(parts) == 1 and len(parts[0]) == 1:
        (outline,) = parts[0]
        return Body(name, outline, motion, closed=is_closed)
    return Body(
        name,
        motion=motion,
        parts=[{"vertices": outline, "holes": holes} for outline, *holes in parts],
    )


def _shifted(ring: Ring, dx: int, dy: int) -> Ring:
    """A ring in another place."""
    return [(x + dx, y + dy) for x, y in ring]


def _parts(random: Random) -> list[list[Ring]]:
    """The rings of each part of a tiny shape."""
    has_rings = random.random() < 0.2
    return random.choice(RINGED) if has_rings else [[random.choice(SHAPES)]]


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
    rest = Translation([0])
    motions: list[Motion] = [
        rest,
        rest,
        there,
        Translation([0, 2 * u, -u], [0, 2 * v, -v]),
        Translation([0, 0, u], [0, 0, v]),
        Translation([0, -u, u], [0, v]),
        Rigid([0, random.choice([1, -1])], pivot=(u, v)),
        Affine([[[1, "1/2"], [0]], [[0], [1]]]),
        Pieces([(later, rest), (None, Translation([-later * u, u]))]),
        Pieces([(later, there), (None, Translation([later * u], [later * v]))]),
        Pieces([(later, there), (None, back)]),
    ]
    return random.choice(motions)


def _tiles(random: Random) -> list[Ring]:
    """Some cells of a map: triangles and quadrilaterals that share borders and corners."""
    cells = [
        [(0, 0), (2, 0), (2, 2), (0, 2)],
        [(2, 0), (4, 0), (4, 2), (2, 2)],
        [(0, 2), (2, 2), (1, 4)],
        [(2, 2), (4, 2), (4, 4), (1, 4)],
        [(2, 0), (2, -2), (4, 0)],
    ]
    return random.sample(cells, random.choice([2, 2, 3]))


def _stack(random: Random) -> list[Ring]:
    """Boxes on a floor, or on each other, flush or not."""
    floor = [(-3, -1), (5, -1), (5, 0), (-3, 0)]
    boxes = [floor]
    bottom = 0
    for _ in range(random.choice([1, 1, 2])):
        left = random.randint(-2, 3)
        right = left + 2
        height = random.randint(1, 2)
        top = bottom + height
        boxes.append([(left, bottom), (right, bottom), (right, top), (left, top)])
        bottom += random.choice([0, height, height])
    return boxes


def _nest(random: Random) -> list[Ring]:
    """A body in another one, inside or at its border."""
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    triangle = [(0, 0), (5, 0), (0, 5)]
    dart = [(0, 0), (4, 0), (2, 2), (0, 4)]
    outer = random.choice([square, triangle, dart])
    dx = random.randint(0, 2)
    dy = random.randint(0, 2)
    inner = _shifted(random.choice(SHAPES), dx, dy)
    return [outer, inner]


def _neighbours(random: Random) -> list[Ring]:
    """Two or three shapes near each other."""
    shapes: list[Ring] = []
    for _ in range(random.choice([2, 2, 3])):
        dx = random.randint(-2, 2)
        dy = random.randint(-2, 2)
        shapes.append(_shifted(random.choice(SHAPES), dx, dy))
    return shapes
