"""Which bodies contain others, by the boxes of their rings; and how few pairs are compared."""

from random import Random

import numpy as np
import pytest

from exactpt import Body, Scene, Translation
from exactpt.kernel.numbers import QQ
from exactpt.motion.inside import covers, nested_pairs
from exactpt.motion.swept_edges import SweptEdges


def square(x, y, side):
    return [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]


@pytest.mark.parametrize("offset", [0, 10**30])
def test_pairs_are_those_in_which_a_body_covers_a_vertex(offset):
    """Plates with a hole and an isle in it, and small bodies in a part, a hole or an isle."""
    random = Random(offset)
    plates, small = [], []
    for x in range(offset, offset + 160, 40):
        outer = {"vertices": square(x, 0, 30), "holes": [square(x + 5, 5, 20)]}
        plates.append(Body(f"p{x}", parts=[outer, square(x + 11, 11, 6)]))
    for i in range(60):
        x, y = random.randrange(3200) + QQ(1, 5), random.randrange(-5, 35) + QQ(1, 3)
        small.append(Body(f"s{i}", square(offset + x / 20, y, QQ(1, 40))))
    bodies = {i: (body, body._at(QQ(0))) for i, body in enumerate([*plates, *small])}
    apart = [(i, j) for j in bodies for i in range(4) if i < j and random.random() < 0.9]
    expected = {
        (i, j) for i, j in apart
        if any(covers(*bodies[i], bodies[j][1][ring.start]) for ring in bodies[j][0].rings)
    }  # fmt: skip
    assert nested_pairs(bodies, apart) == expected
    assert len(expected) > 10


def test_vertices_are_not_compared_with_edges_of_their_own_rigid_body():
    """Two boxes with many vertices on the sides that face each other slide past each other."""
    n = 200
    top = [*((QQ(i, n), 1) for i in range(n + 1)), (1, 2), (0, 2)]
    bottom = [*((QQ(i, n), 0) for i in range(n + 1)), (1, -1), (0, -1)]
    scene = Scene([Body("a", top, Translation([0, 1])), Body("b", bottom)], time=(-2, 2))
    swept = SweptEdges(scene.bodies, scene._start, scene._end)
    boxes = swept.during(scene._start, scene._end)
    found = list(swept.meeting(boxes, swept.around(boxes)))
    assert np.concatenate([v for v, _ in found]).size == 0
