"""Scenes of two tiny bodies with small integers, in which ties and touches are frequent."""

from exactpt import Body, Pieces, Rigid, Scene, Translation


def scene_of(random):
    """Two tiny bodies that pass each other: chains, segments, points, polygons."""
    bodies = []
    for name in ("a", "b"):
        shape = random.choice(
            [
                [(0, 0)],
                [(0, 0), (2, 1)],
                [(0, 0), (2, 0), (0, 2)],
                [(0, 0), (2, 0), (2, 2), (1, 1)],
            ]
        )
        dx, dy = random.randint(-3, 3), random.randint(-3, 3)
        shape = [(x + dx, y + dy) for x, y in shape]
        motion = random.choice(
            [
                Translation([0]),
                Translation([0, random.randint(-2, 2)], [0, random.randint(-2, 2)]),
                Translation([0, -2, 1], [0, random.randint(-1, 1)]),
                Translation([1, -2, 1], [0, 0, 1]),
                Rigid([0, 1], pivot=(dx, dy)),
                Pieces([(1, Translation([0, 1])), (None, Translation([2, -1]))]),
                Pieces([(1, Translation([0, 1])), (None, Translation([0, 1], [-1, 1]))]),
                Pieces([(2, Translation([0])), (None, Translation([0], [2, -1]))]),
            ]
        )
        closed = random.random() < 0.6
        bodies.append(Body(name, shape, motion, closed=closed))
    return Scene(bodies, time=(0, 4))
