"""Bodies with deep and winding pockets, and what may come into them."""

from __future__ import annotations

from random import Random
from typing import Final

from exactpt import Body, Scene
from exactpt.kernel.numbers import QQ
from exactpt.testing.reference.shapes import bodies_meet

__all__ = ["pocket_scene"]

Outline = list[tuple[int, int]]

GUESTS: Final = 8
"""Number of guests that are tried in a scene."""

CORNERS: Final = 12
"""Number of corners of the wall of the longest spiral."""


def pocket_scene(random: Random) -> Scene:
    """Return jars, a well, a comb or a spiral with small bodies in and around the pockets."""
    make = random.choice([_jars, _jars, _well, _comb, _spiral])
    bodies = make(random)
    xs = [int(x) for body in bodies for x, _ in body.at(0)]
    ys = [int(y) for body in bodies for _, y in body.at(0)]
    for number in range(GUESTS):
        x = random.randint(min(xs) - 2, max(xs) + 2)
        y = random.randint(min(ys) - 2, max(ys) + 2)
        guest = Body(f"guest {number}", _small(random, x, y))
        if not any(_meet(guest, body) for body in bodies):
            bodies.append(guest)
    return Scene(bodies, (0, 9))


def _meet(a: Body, b: Body) -> bool:
    """Return True if two bodies have a common point at the start."""
    start = QQ(0)
    return bodies_meet(a, a.exact_at(start), b, b.exact_at(start))


def _small(random: Random, x: int, y: int) -> Outline:
    """Return a point, a segment, a triangle, or a small jar."""
    kind = random.randrange(4)
    if kind == 3:
        width = random.randint(6, 16)
        depth = random.randint(5, 25)
        return _jar(random, (x, y), width=width, depth=depth, steps=2)
    other = x + random.randint(1, 9), y + random.randint(-9, 9)
    triangle = [(x, y), other, (x, y + 3)]
    return triangle[: kind + 1]


def _jar(random: Random, corner: tuple[int, int], *, width: int, depth: int, steps: int) -> Outline:
    """Return a jar with uneven walls, open above; its inside begins at a corner."""
    left: Outline = []
    right: Outline = []
    for i in range(1, steps + 1):
        level = depth - depth * (i - 1) // steps
        left.append((random.randint(-3, width // 3), level))
        right.append((width - random.randint(-3, width // 3), level))
    top = depth + 2
    downward = right  # along the right wall of the inside
    upward = left[::-1]
    outline = [(-10, -5), (width + 10, -5), (width + 10, top), *downward, *upward, (-10, top)]
    corner_x, corner_y = corner
    return [(x + corner_x, y + corner_y) for x, y in outline]


def _jars(random: Random) -> list[Body]:
    """Return two jars beside each other, and sometimes a lid over them, open below."""
    jars = []
    for i in range(2):
        corner = 70 * i, random.randint(-30, 30)
        jars.append(_jar(random, corner, width=40, depth=100, steps=random.randint(1, 9)))
    if random.random() < 0.5:
        lid = _jar(random, (0, 0), width=70, depth=60, steps=8)
        bottom = random.randint(140, 160)
        upside_down = [(x + 20, bottom + 60 - y) for x, y in reversed(lid)]
        jars.append(upside_down)
    return [Body(f"jar {i}", outline) for i, outline in enumerate(jars)]


def _well(random: Random) -> list[Body]:
    """Return a deep pocket with walls like saws: its relative hull has few vertices if empty."""
    shift = random.randint(0, 4)
    down = [(2 + 5 * (k % 2), 90 - 10 * k) for k in range(9)]
    up = [(x - 4, y + shift) for x, y in reversed(down)]
    return [Body("well", [*up, (-9, 96), (-9, -1), (14, -1), (14, 91), *down])]


def _comb(random: Random) -> list[Body]:
    """Return a comb with gaps of width 6, open above."""
    teeth = random.randint(2, 6)
    outline = [(0, 0), (8 * teeth + 2, 0)]
    for i in reversed(range(teeth + 1)):
        outline += [(8 * i + 2, 2), (8 * i + 2, 20), (8 * i, 20), (8 * i, 2)]
    return [Body("comb", outline[:2] + outline[3:-1])]


def _spiral(random: Random) -> list[Body]:
    """Return a corridor of width 6 between walls of width 2, wound around the origin."""
    corners = random.randint(4, CORNERS)
    inner = _side(3)[:corners]
    outer = _side(5)[:corners]
    outline = [*outer, *reversed(inner)]
    start = random.randrange(len(outline))
    return [Body("spiral", outline[start:] + outline[:start])]


def _side(distance: int) -> Outline:
    """Return one side of the wall of a spiral: its first piece is at this height.

    Each turn of the spiral, of four corners, is 8 farther out.
    """
    side: Outline = [(4, distance)]
    reach = distance
    while len(side) < CORNERS:
        side += [(-reach, reach), (-reach, -reach), (reach + 8, -reach), (reach + 8, reach + 8)]
        reach += 8
    return side[:CORNERS]
