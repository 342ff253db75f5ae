"""Which of several copies of one triple becomes collinear first: the symbolic perturbation.

The order decides which copy is repaired first, and no law can say it: all orders end in one
tiling. Here it is compared with copies that are displaced by a small number.
"""

from itertools import permutations, product

import pytest

from exactpt import AlgebraicNumber, Body, Rigid, Translation
from exactpt.certificates.perturbation import comes_first
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices

SMALL = QQ(1, 10**9)


def place(vertex, t):
    """Where a vertex is, moved by a small multiple of its offset."""
    x, y = vertex.track.at(t)
    if vertex.offset is None:
        return x, y
    dx, dy = (sum((c * t**i for i, c in enumerate(f)), QQ(0)) for f in vertex.offset)
    return x + SMALL * dx, y + SMALL * dy


def is_left_turn(triple, t):
    p, q, r = (place(v, t) for v in triple)
    return (q[0] - p[0]) * (r[1] - p[1]) > (q[1] - p[1]) * (r[0] - p[0])


def time_of_change(triple, t):
    """The time near t at which they are collinear, by bisection."""
    low, high = t - QQ(1, 1000), t + QQ(1, 1000)
    before, after = is_left_turn(triple, low), is_left_turn(triple, high)
    assert before != after
    for _ in range(50):
        middle = (low + high) / 2
        if is_left_turn(triple, middle) == before:
            low = middle
        else:
            high = middle
    return low, 1 if after else -1


def still(x, y):
    return Body("still", [(x, y)])


SEGMENT = Body("segment", [(0, 0), (4, 2)], Translation([-1, 1], [1, -1]))
TURNING = Body("turning", [(0, 0), (2, 0)], Rigid([0, 1]))
CHAIN = Body("chain", [(-3, 0), (-2, 3), (3, 3)], Translation([0], [-1, 1]), closed=False)
TRIANGLE = Body("triangle", [(1, 3), (2, 4), (1, 4)], Translation([-1, 1], [0]))


@pytest.mark.parametrize(
    "bodies, triple",
    [
        ([still(0, 0), still(1, 2), Body("p", [(2, 4)], Translation([-1, 1], [0]))], [0, 1, 2]),
        ([SEGMENT, Body("p", [(6, 3)])], [0, 1, 2]),
        ([SEGMENT, Body("p", [(2, 1)], Translation([0], [-3, 3]))], [0, 1, 2]),
        ([TURNING, still(-1, 1), still(1, 3)], [1, 2, 3]),
        ([TURNING, TRIANGLE, still(-1, 1)], [1, 2, 5]),
        ([CHAIN, still(5, 3)], [1, 2, 3]),
        ([CHAIN, still(-1, 6)], [0, 1, 3]),
    ],
    ids=["points", "behind", "between", "turning", "no offset", "bend", "edge"],
)
def test_which_copies_of_a_triple_become_collinear_first(bodies, triple):
    """At t = 1 the three vertices of the scene are collinear."""
    vertices = Vertices.of(bodies, QQ(0), QQ(2))
    nodes = vertices.nodes()
    copies = [[v for v in vertices.all if nodes[v.id] == node] for node in triple]
    orders = list(permutations(range(3)))
    changes = []
    for k, chosen in enumerate(product(*copies)):
        abc = tuple(chosen[i] for i in orders[k % 6])
        changes.append((abc, *time_of_change(abc, QQ(1))))
    assert len({time for _, time, _ in changes}) > 1

    for (p, p_time, p_sign), (q, q_time, q_sign) in permutations(changes, 2):
        expected = p_time < q_time - SMALL / 10**5
        assert comes_first(p, p_sign, q, q_sign, AlgebraicNumber(QQ(1))) == expected
