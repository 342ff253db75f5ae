"""Scattered bodies, and tilings of them that no construction makes."""

from exactpt.motion.body import Body
from exactpt.pseudotriangulation.flip import flip
from exactpt.pseudotriangulation.shadow import shadow
from exactpt.testing.scenes.shapes import convex_polygon


def scattered(rng, count):
    """Small convex polygons in far too large a square, so that tiles are long and bent."""
    cells = rng.sample(range(400), count)
    return [
        Body(f"b{i}", convex_polygon(rng, (40 * (c % 20), 40 * (c // 20)), 15, rng.randint(3, 6)))
        for i, c in enumerate(cells)
    ]


def flipped_at_random(mesh, instant, rng, count):
    """Another tiling of the same bodies, canonical in no way."""
    for _ in range(count):
        h = rng.choice([h for h in mesh.diagonals() if not mesh.is_hull(h)])
        visits = shadow(mesh, h, instant)
        if visits is not None:
            flip(mesh, h, visits, instant)
