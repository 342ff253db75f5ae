"""Which vertices touch which edges now: the touches as they are told."""

from folding import every

from exactpt.certificates.certifier import Certifier
from exactpt.certificates.incidences import FEW, touches
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.incidence import Touch
from exactpt.motion.vertices import Vertices

SQUARE = Body("square", [(0, 0), (2, 0), (2, 2), (0, 2)])
ON_EDGE = Touch(1, 0, 0, 1, -1)
ON_VERTEX = Touch(0, 2, 1, -1, 0)


def touches_now(*bodies):
    vertices = Vertices.of(bodies, QQ(0), QQ(1))
    certifier = Certifier(vertices, QQ(0), QQ(1), exact_only=False)
    return touches(certifier, vertices, vertices.ids())


@every("others", [0, FEW])
@every(
    "body, expected",
    [
        (Body("on an edge", [(2, 1)]), [ON_EDGE]),
        (Body("on the last edge", [(0, 1)]), [Touch(1, 0, 0, 3, -1)]),
        (Body("on a vertex", [(2, 2)]), [ON_VERTEX]),
        (Body("on a line", [(2, 3)]), []),
        (Body("tip on an edge", [(2, 1), (4, 1), (4, 2)]), [ON_EDGE]),
        (Body("last edge on a vertex", [(3, 1), (3, 2), (1, 3)]), [Touch(0, 2, 1, 2, -1)]),
        (Body("edge on a vertex", [(1, 3), (3, 1), (3, 3)]), [Touch(0, 2, 1, 0, -1)]),
        (Body("segment", [(2, 1), (4, 1)]), [ON_EDGE]),
        (
            Body("open chain", [(3, 0), (4, 1), (3, 4), (1, 3), (3, 1)], closed=False),
            [Touch(0, 2, 1, 3, -1)],
        ),
    ],
)
def test_touches(body, expected, others):
    """With many points, boxes choose the pairs."""
    far = [Body(str(i), [(10 + i, 10)]) for i in range(others)]

    assert touches_now(SQUARE, body, *far) == expected


def test_neighbours_touch_where_their_edge_has_shrunk_to_a_point():
    body = Body("b", [(0, 0), {"x": [0, 1], "y": [0]}, (3, 3)], closed=False)

    assert touches_now(body) == [Touch(0, 0, 0, -1, 1)]
