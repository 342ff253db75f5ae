"""Order along a line and coincidence at the current time: every case, filtered and exact."""

import pytest

from exactpt import Body, Rigid, Translation
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.coincidence import (
    coincide,
    coordinate_order,
    lies_on,
    nearer,
    nearer_copy,
    strictly_between,
)
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices

DIRECTIONS = [(1, 0), (0, 1), (1, 2), (-1, 0), (0, -1), (-2, 1)]
HAIR = QQ(1, 10**30)


@pytest.fixture(params=[False, True], ids=["filtered", "exact"])
def certified(request):
    """A certifier at time 0, and the vertices of bodies, one for a point."""

    def make(*bodies):
        vertices = Vertices.of(bodies, QQ(0), QQ(4))
        rings = [m.ring[:1] if m.body.size == 1 else m.ring for m in vertices.bodies]
        chosen = [vertices.all[v] for ring in rings for v in ring]
        return Certifier(vertices, QQ(0), QQ(4), exact_only=request.param), chosen

    return make


def points(places):
    """Points of different motions."""
    return [Body(str(i), [p], Translation([0, i], [0, -i])) for i, p in enumerate(places)]


def on_a_line(multiples, direction):
    """Points at multiples of a direction from a place that is not the origin."""
    return points([(5 + k * direction[0], 7 + k * direction[1]) for k in multiples])


def test_coordinate_order(certified):
    certifier, (a, b) = certified(*points([(0, 0), (HAIR, -HAIR)]))

    assert [coordinate_order(certifier, a, b, axis) for axis in (0, 1)] == [1, -1]
    assert [coordinate_order(certifier, b, a, axis) for axis in (0, 1)] == [-1, 1]
    assert [coordinate_order(certifier, a, a, axis) for axis in (0, 1)] == [0, 0]


def test_what_differs_in_one_coordinate_does_not_coincide(certified):
    certifier, (a, b, c, d) = certified(*points([(1, 1), (1 + HAIR, 1), (1, 1 + HAIR), (1, 1)]))

    assert [coincide(certifier, a, v) for v in (a, b, c, d)] == [True, False, False, True]


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_nearer(certified, direction):
    for a, b, expected in [(1, 2, 1), (2, 1, -1), (1, 1, 0), (0, 1, 1)]:
        certifier, (p, q, r) = certified(*on_a_line([0, a, b], direction))

        assert nearer(certifier, p, q, r) == expected


def test_nearer_of_what_moves_on_one_track(certified):
    """The two copies of an end of a segment are at one place, the other end is not."""
    certifier, (left, right, far, _) = certified(Body("s", [(1, 1), (3, 1)], Rigid([0, 1])))

    assert nearer(certifier, far, left, right) == 0
    assert nearer(certifier, left, right, far) == 1


@pytest.mark.parametrize("end", [(4, 2), (2, 4), (4, 3), (-1, -2)])
def test_of_two_copies_the_one_that_points_to_a_vertex_is_nearer(certified, end):
    """Left and right of a segment from (2, 2), seen from all around."""
    ux, uy = end[0] - 2, end[1] - 2
    around = [(3, -1), (-2, 5), (7, 7), (2, -9), (2 + ux, 2 + uy)]
    segment = Body("s", [(2, 2), end], Translation([0, 1]))
    certifier, (left, right, far, _, *seen) = certified(segment, *points(around))

    for p, (x, y) in zip(seen, around, strict=True):
        turn = ux * (y - 2) - uy * (x - 2)
        expected = (turn > 0) - (turn < 0)
        assert nearer_copy(certifier, p, left, right) == expected
        assert nearer_copy(certifier, p, right, left) == -expected
        assert nearer_copy(certifier, p, left, far) == 0


def test_nearer_copy_leaves_open_what_are_no_copies(certified):
    body = Body("b", [(0, 0), (2, 0), (0, 1)])
    certifier, (a, b, c, p) = certified(body, *points([(9, 9)]))

    assert nearer_copy(certifier, p, a, b) == nearer_copy(certifier, p, c, a) == 0


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_strictly_between(certified, direction):
    inside = [(0, 1, 2), (2, 1, 0)]
    outside = [(1, 0, 2), (0, 2, 1), (0, 0, 1), (0, 1, 1), (0, 0, 0), (0, 1, 0)]
    for places in inside + outside:
        certifier, (a, p, b) = certified(*on_a_line(places, direction))

        assert strictly_between(certifier, a, p, b) == (places in inside)


@pytest.mark.parametrize("direction", [(1, 0), (0, 1)])
def test_the_order_along_an_axis_is_decided_by_doubles(direction):
    """Equal coordinates on the other axis, which only exact arithmetic proves, are not needed."""
    vertices = Vertices.of(on_a_line([0, 1, 2], direction), QQ(0), QQ(4))
    certifier = Certifier(vertices, QQ(0), QQ(4), exact_only=False)
    a, p, b = (vertices.all[body.ring[0]] for body in vertices.bodies)

    assert nearer(certifier, a, p, b) == 1
    assert strictly_between(certifier, a, p, b)
    assert not strictly_between(certifier, p, a, b)
    assert vertices.counters.exact == 0


def test_of_two_copies_the_one_towards_the_third_vertex_is_between(certified):
    certifier, vertices = certified(Body("s", [(1, 1), (3, 1)]), *points([(1, 5), (1, 0)]))
    left, right, above, below = vertices[0], vertices[1], vertices[4], vertices[5]

    for near, other, far in ((left, right, above), (right, left, below)):
        assert strictly_between(certifier, other, near, far)
        assert strictly_between(certifier, far, near, other)
        assert not strictly_between(certifier, near, other, far)
        assert not strictly_between(certifier, far, other, near)
        assert not strictly_between(certifier, near, far, other)
        assert not strictly_between(certifier, near, far, near)


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_lies_on(certified, direction):
    for a, b, v in [*((0, 2, k) for k in range(-1, 4)), (1, 1, 0), (1, 1, 1)]:
        certifier, (p, q, r) = certified(*on_a_line([a, b, v], direction))

        assert lies_on(certifier, r, p, q) == lies_on(certifier, r, q, p) == (a <= v <= b)


def test_what_is_a_hair_beside_a_segment_is_not_on_it(certified):
    certifier, (a, b, beside, on) = certified(*points([(0, 0), (4, 2), (2, 1 + HAIR), (2, 1)]))

    assert not lies_on(certifier, beside, a, b)
    assert lies_on(certifier, on, a, b)
