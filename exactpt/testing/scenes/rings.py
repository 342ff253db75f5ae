"""Bodies with holes and several parts, and bodies in their holes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from random import Random

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Affine, Motion, Pieces, Position, Rigid, Translation
from exactpt.motion.rings import PartLike
from exactpt.scene.scene import Scene
from exactpt.testing.scenes.shapes import (
    box,
    cells,
    convex_polygon,
    hull,
    is_valid,
    poly,
    shape,
    valid_scene,
    velocity,
)
from exactpt.testing.scenes.simple import star

QUARTER = [(5, 0), (4, 3), (3, 4)]
"""Directions of length 5 from the first axis to the second one."""


def lakes(rng: Random) -> Scene:
    """Islands with lakes and islets, with bodies in the lakes; they move, turn and deform."""
    bodies: list[Body] = []
    for x, y in cells(rng, rng.randint(1, 3), 27):
        outline, lake = _loop(rng, (x, y), 9, 12), _loop(rng, (x, y), 5, 7)
        part: PartLike = {"vertices": outline, "holes": [lake]}
        inner = rng.randrange(4)
        parts = [part]
        if inner == 0:
            parts.append(box(x - 1, y - 1, 2, 2))
        elif inner == 1:
            islet = {"vertices": box(x - 3, y - 2, 6, 4), "holes": [box(x - 2, y - 1, 4, 2)]}
            parts.append(islet)
        bodies.append(_moved(rng, f"island{len(bodies)}", parts, (x, y)))
        if inner == 1:
            bodies.append(Body(f"stone{len(bodies)}", [(x, y)], velocity(rng, 1)))
        elif inner == 2:
            atoll = {"vertices": box(x - 3, y - 3, 6, 6), "holes": [box(x - 1, y - 1, 2, 2)]}
            bodies.append(_moved(rng, f"atoll{len(bodies)}", [atoll], (x, y)))
            bodies.append(Body(f"stone{len(bodies)}", [(x, y)], velocity(rng, 1)))
        elif inner == 3:
            for side in (-2, 2):
                ship = convex_polygon(rng, (x + side, y), 1, 5)
                bodies.append(_moved(rng, f"ship{len(bodies)}", [ship], (x, y)))
    return Scene(bodies, (0, rng.choice([2, 4, 8])))


def _loop(rng: Random, center: Point, low: int, high: int) -> list[Point]:
    """A ring of 8 to 12 vertices around a center, at distances from ``low`` to ``high``.

    Its angles seen from the center are at most 54 degrees, so it is nowhere nearer to the center
    than 0.89 times ``low``.
    """
    ring: list[Point] = []
    cos, sin = 1, 0
    for _ in range(4):
        for a, b in QUARTER[: rng.choice([2, 3])]:
            r = QQ(rng.randint(4 * low, 4 * high), 20)
            ring.append((center[0] + r * (cos * a - sin * b), center[1] + r * (sin * a + cos * b)))
        cos, sin = -sin, cos
    return ring if rng.random() < 0.5 else ring[::-1]


def _moved(
    rng: Random, name: str, parts: Sequence[PartLike], center: Point, *, deforms: bool = True
) -> Body:
    """The body of some parts with a random motion; perhaps its vertices move by their own."""
    motion: Motion = velocity(rng, 2)
    kind = rng.randrange(6 if deforms else 4)
    if kind == 1:
        motion = Rigid(poly(0, QQ(rng.choice([-1, 1]), rng.choice([2, 4]))), pivot=center)
    elif kind == 2:
        (x, y), k = center, QQ(rng.choice([-1, 1]), 16)
        shear = QQ(rng.choice([-1, 0, 1]), 16)
        matrix = [[poly(1, k), poly(0, shear)], [poly(0), poly(1, k)]]
        motion = Affine(matrix, x=poly(0, -k * x - shear * y), y=poly(0, -k * y))
    elif kind == 3:
        back = Rigid(poly(0, 1, -1), pivot=center)  # at t = 1 where it was
        motion = Pieces([(1, back), (None, Translation([-1, 1], [1, -1]))])
    elif kind > 3:
        parts = [_deforming(rng, part) for part in parts]
    return Body(name, motion=motion, parts=parts)


def _deforming(rng: Random, part: PartLike) -> PartLike:
    """A part of which some vertices have slow velocities of their own."""
    if isinstance(part, Mapping):
        holes: Iterable[Sequence[Point]] = part.get("holes", ())  # type: ignore[assignment]
        return {
            "vertices": _deformed(rng, part["vertices"]),  # type: ignore[arg-type]
            "holes": [_deformed(rng, hole) for hole in holes],
        }
    return _deformed(rng, part)  # type: ignore[arg-type]


def _deformed(rng: Random, ring: Iterable[Point]) -> list[Position]:
    return [(poly(x, _slow(rng)), poly(y, _slow(rng))) for x, y in ring]


def _slow(rng: Random) -> QQ:
    return QQ(rng.randint(-2, 2), 4) if rng.random() < 0.4 else QQ(0)


def touching_rings(rng: Random) -> Scene:
    """Valid bodies whose rings touch each other in points, and small bodies in and around them."""
    bodies: list[Body] = []
    for x, y in cells(rng, rng.randint(1, 2), 16):
        parts = touching_parts(rng, (x, y))
        bodies.append(_moved(rng, f"body{len(bodies)}", as_parts(parts), (x, y), deforms=False))
        holes = [hole for _, *holes in parts for hole in holes]
        for hole in rng.sample(holes, min(len(holes), rng.randint(0, 2))):
            bodies.append(Body(f"inner{len(bodies)}", [middle_of(hole)], velocity(rng, 2)))
        if rng.random() < 0.6:
            stray = convex_polygon(rng, (x + rng.choice([-9, 9]), y), 2, 5)
            bodies.append(Body(f"stray{len(bodies)}", stray, velocity(rng, 3)))
    return Scene(bodies, (0, rng.choice([2, 4])))


def touching_parts(rng: Random, center: Point) -> list[list[list[Point]]]:
    """The rings of parts, outlines first, that touch each other, on a grid around a center.

    Random rings are added to a box one by one, each as a hole or as a part, while the body stays
    valid; most of those that touch no other ring are left out.
    """
    x, y = center
    size = rng.randint(2, 4)
    parts = [[box(x - size, y - size, 2 * size, 2 * size)]]
    touches = 0
    for _ in range(rng.randint(8, 24)):
        ring = [(x + u, y + v) for u, v in _grid_ring(rng, size)][:: rng.choice([1, -1])]
        added = [[*rings] for rings in parts]
        if rng.random() < 0.3:
            added.append([ring])
        else:
            rng.choice(added).append(ring)
        body = Body("b", parts=as_parts(added))
        if not is_valid(body):
            continue
        if len(body.exact_ring_touches) > touches or rng.random() < 0.1:
            parts, touches = added, len(body.exact_ring_touches)
    return parts


def as_parts(parts: Sequence[Sequence[Sequence[Point]]]) -> list[PartLike]:
    """Parts as a `Body` takes them, from their rings, the outlines first."""
    return [{"vertices": outline, "holes": holes} for outline, *holes in parts]


def middle_of(ring: Sequence[Point]) -> Point:
    """The mean of the vertices of a ring."""
    xs, ys = zip(*ring, strict=True)
    return sum(xs, QQ(0)) / len(xs), sum(ys, QQ(0)) / len(ys)


def _grid_ring(rng: Random, size: int) -> list[Point]:
    """A small ring of integer vertices, at most ``size`` + 1 from the origin in x and y."""
    u, v = (rng.randint(-size, size) for _ in range(2))
    kind = rng.randrange(4)
    if kind == 0:
        return box(u, v, rng.randint(1, 2), rng.randint(1, 2))
    if kind == 1:
        return [(QQ(p), QQ(q)) for p, q in ((u - 1, v), (u, v - 1), (u + 1, v), (u, v + 1))]
    return convex_polygon(rng, (QQ(u), QQ(v)), 2 if kind == 2 else 1, rng.randint(3, 5))


def frames(rng: Random) -> Scene:
    """Boxes with box-shaped holes on a small grid, one in another, in ties and touches."""
    bodies: list[Body] = []
    for k in range(rng.randint(1, 2)):
        size = rng.randint(5, 12), rng.randint(5, 12)
        _add_frame(rng, bodies, (QQ(14 * k), QQ(rng.randint(-2, 2))), size, 0)
    if rng.random() < 0.5:
        bodies.append(Body("stray", box(-3, rng.randint(0, 6), 1, 1), velocity(rng, 2)))
    return Scene(bodies, (0, rng.choice([1, 3, 6])))


def walls(rng: Random) -> Scene:
    """Bodies of any shape within a wall whose teeth point inwards, or reach in between them."""
    inner = []
    for i, c in enumerate(cells(rng, rng.randint(1, 4), 20)):
        outline = star(rng, c, 9, rng.randint(4, 12)) if rng.random() < 0.6 else shape(rng, c, 8)
        inner.append((f"b{i}", outline, c))
    points = [p for _, outline, _ in inner for p in outline]
    low, high = (tuple(f(p[k] for p in points) for k in (0, 1)) for f in (min, max))
    gap = rng.choice([2, 5, 9])
    corners = box(
        low[0] - gap, low[1] - gap, high[0] - low[0] + 2 * gap, high[1] - low[1] + 2 * gap
    )
    hole = [p for a, b in pairwise([*corners, corners[0]]) for p in _toothed(rng, a, b, gap)]
    outer = hull([(x + QQ(dx), y + QQ(dy)) for x, y in corners for dx in (-3, 3) for dy in (-3, 3)])
    middle = (low[0] + high[0]) / 2, (low[1] + high[1]) / 2
    bodies = [_moved(rng, "wall", [{"vertices": outer, "holes": [hole]}], middle)]
    for name, outline, c in inner:
        if len(outline) > 2:
            bodies.append(_moved(rng, name, [outline], c))
        else:
            bodies.append(Body(name, outline, velocity(rng, 3)))
    return valid_scene(bodies, (0, rng.choice([1, 4])))


def _toothed(rng: Random, a: Point, b: Point, gap: int) -> list[Point]:
    """A side of a hole from a to before b, with up to three teeth on its left."""
    (dx, dy), count = (b[0] - a[0], b[1] - a[1]), rng.randint(0, 3)
    length = abs(dx) + abs(dy)
    side = [a]
    for i in range(count):
        depth = QQ(rng.randint(1, 6 * gap), 4) / length
        at, width = QQ(4 * i + rng.randint(1, 3), 4 * count + 1), QQ(1, 4 * count + 1)
        side.append((a[0] + at * dx, a[1] + at * dy))
        tip = at + width / 2
        side.append((a[0] + tip * dx - depth * dy, a[1] + tip * dy + depth * dx))
        side.append((a[0] + (at + width) * dx, a[1] + (at + width) * dy))
    return side


def _add_frame(
    rng: Random, bodies: list[Body], at: Point, size: tuple[int, int], depth: int
) -> None:
    """Add a box with one or two holes, and bodies in these."""
    (x, y), (width, height) = at, size
    name = f"frame{len(bodies)}"
    bodies.append(Body(name, [(0, 0)]))  # its place is before its contents
    place = len(bodies) - 1
    cuts = [0, width]
    if width >= 6 and rng.random() < 0.6:
        cuts.insert(1, rng.randint(3, width - 3))
    holes: list[Sequence[Point]] = []
    parts: list[PartLike] = []
    for low, high in pairwise(cuts):
        left, inner = x + low + 1, (high - low - (1 if high < width else 2), height - 2)
        if inner[0] < 1:
            continue
        holes.append(box(left, y + 1, *inner))
        parts += _add_in_hole(rng, bodies, (left, y + 1), inner, depth)
    ring: Sequence[Point] = box(x, y, width, height)
    if rng.random() < 0.3:
        ring = [*ring[:1], (x + QQ(width, 2), y), *ring[1:]]  # a straight angle
    whole: list[PartLike] = [{"vertices": ring, "holes": holes}, *parts]
    motion: Motion = velocity(rng, 1)
    if rng.random() < 0.4:
        whole = [_deforming(rng, part) for part in whole]
    bodies[place] = Body(name, motion=motion, parts=whole)


def _add_in_hole(
    rng: Random, bodies: list[Body], at: Point, size: tuple[int, int], depth: int
) -> list[PartLike]:
    """Add bodies in a hole; returns the parts of the body around it that are in the hole."""
    (x, y), (width, height) = at, size
    kind = rng.randrange(5)
    if kind == 0 and width >= 5 and height >= 5 and depth < 2:
        _add_frame(rng, bodies, (x + 1, y + 1), (width - 2, height - 2), depth + 1)
    elif kind == 1 and min(width, height) >= 3:
        return [box(x + 1, y + 1, width - 2, height - 2)]
    elif kind > 1:
        name, motion = f"inner{len(bodies)}", velocity(rng, 1)
        px, py = x + QQ(rng.randint(1, 2 * width - 1), 2), y + QQ(rng.randint(1, 2 * height - 1), 2)
        if kind == 2:
            bodies.append(Body(name, [(px, py)], motion))
        elif kind == 3:
            end = px, y + QQ(height, 4)
            bodies.append(Body(name, [(px, py), end][: 1 + (py != end[1])], motion))
        else:
            bodies.append(Body(name, box(px - QQ(1, 4), py - QQ(1, 4), 1, 1)[:3], motion))
    return []
