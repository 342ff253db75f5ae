"""Positions now in doubles: every certain sign is the exact one."""

from itertools import permutations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from exactpt import Affine, AlgebraicNumber, Body, Rigid, Translation
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.perturbation import cross
from exactpt.certificates.queue import EventTime
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.motion.track import difference
from exactpt.motion.track import orientation_polynomial as orientation_of_tracks
from exactpt.motion.vertices import Vertices

small = st.integers(-3, 3)
fractions = st.builds(QQ, st.integers(-99, 99), st.just(7))
numbers = small | fractions | st.integers(-(10**9), 10**9)
paths = st.lists(numbers, min_size=1, max_size=4)
halves = st.builds(QQ, st.integers(-9, 9), st.just(4))


@st.composite
def motions(draw):
    path = {"x": draw(paths), "y": draw(paths)}
    kind = draw(st.sampled_from(["translation", "rigid", "affine"]))
    if kind == "translation":
        return Translation(**path)
    if kind == "rigid":
        return Rigid([draw(halves), draw(halves)], **path)
    return Affine([[[1], [0, draw(small)]], [[0, draw(small)], [1]]], **path)


@st.composite
def four_points(draw):
    """Four points, some of them near or on a line with others, some of them one motion's."""
    places = [draw(st.tuples(numbers, numbers)) for _ in range(2)]
    (x, y), (u, v) = places
    for _ in range(2):
        t, off = draw(halves), draw(st.sampled_from([0, 0, QQ(1, 10**14), 1]))
        places.append((x + t * (u - x), y + t * (v - y) + off))
    shared = [draw(motions()) for _ in range(2)]
    bodies = [
        Body(str(i), [place], draw(st.sampled_from(shared))) for i, place in enumerate(places)
    ]
    return Vertices.of(bodies, QQ(0), QQ(4), plain=True)


times = st.one_of(
    st.sampled_from([QQ(0), QQ(1, 3), QQ(2), QQ(*(0.7).as_integer_ratio())]).map(AlgebraicNumber),
    st.just(AlgebraicNumber.root((ZZ(-2), ZZ(0), ZZ(1)), QQ(1), QQ(2))),
)


@pytest.mark.long
@given(vertices=four_points(), time=times)
def test_a_certain_sign_is_the_exact_one(vertices, time):
    certifier = Certifier(vertices, QQ(0), QQ(4), exact_only=False)
    low, high = vertices.normalization.enclosure(time)
    certifier.move_to(EventTime(low, high, -1, -1, -1, time), [])
    positions = certifier.positions
    a, b, c, d = vertices.all
    p, q, r, s = (v.track for v in vertices.all)

    assert positions.orientation(a, b, c) in (0, time.sign_of(orientation_of_tracks(p, q, r)))
    assert positions.cross_sign(a, b, c, d) in (0, time.sign_of(cross(p, q, r, s)))
    for axis, (f, g) in enumerate(((p.x, q.x), (p.y, q.y))):
        assert positions.order(a, b, axis) in (0, time.sign_of(difference(f, p.w, g, q.w)))


def test_what_is_clear_is_decided():
    bodies = [
        Body("a", [(0, 0)], Translation([0, 1], [0, 2])),
        Body("b", [(4, 1)], Rigid([0, "1/4"])),
        Body("c", [(0, 5)]),
        Body("d", [(1, 5)], Affine([[[1, 1], [0]], [[0], [1]]])),
    ]
    vertices = Vertices.of(bodies, QQ(0), QQ(4), plain=True)
    positions = Certifier(vertices, QQ(0), QQ(4), exact_only=False).positions
    a, b, c, d = vertices.all

    assert positions.orientation(a, b, c) == 1 == -positions.orientation(b, a, c)
    assert positions.cross_sign(a, b, c, d) == -1 == -positions.cross_sign(c, d, a, b)
    assert positions.order(a, b, 0) == 1 == positions.order(a, c, 1)
    assert positions.order(a, c, 0) == 0


def test_coordinates_that_no_double_holds_are_left_open():
    bodies = [
        Body("a", [(0, QQ(10) ** 400)]),
        Body("b", [(1, 0)]),
        Body("c", [(2, QQ(1, 10**400))]),
    ]
    vertices = Vertices.of(bodies, QQ(0), QQ(1), plain=True)
    positions = Certifier(vertices, QQ(0), QQ(1), exact_only=False).positions

    assert positions.orientation(*vertices.all) in (0, 1)
    assert positions.order(list(vertices.all)[1], vertices.all[2], 1) == 0


large = st.integers(-(10**9), 10**9)
steps = st.integers(-99, 99).filter(bool)


@given(
    place=st.tuples(fractions, fractions),
    step=st.tuples(steps, steps),
    along=st.lists(halves, min_size=4, max_size=4),
    path=st.lists(st.tuples(large, large), min_size=2, max_size=4),
    half=halves,
    time=times,
)
def test_what_is_on_one_line_stays_open(place, step, along, path, half, time):
    """Near each other and far from the origin: the rounding of positions is all there is."""
    xs, ys = zip(*path, strict=True)
    motion = Rigid([0, half], x=xs, y=ys) if half > 0 else Translation(xs, ys)
    bodies = [
        Body(str(i), [(place[0] + t * step[0] / 7, place[1] + t * step[1] / 7)], motion)
        for i, t in enumerate(along)
    ]
    vertices = Vertices.of(bodies, QQ(0), QQ(4), plain=True)
    certifier = Certifier(vertices, QQ(0), QQ(4), exact_only=False)
    low, high = vertices.normalization.enclosure(time)
    certifier.move_to(EventTime(low, high, -1, -1, -1, time), [])

    assert certifier.positions.orientation(*list(vertices.all)[:3]) == 0
    assert certifier.positions.cross_sign(*vertices.all) == 0


@pytest.mark.parametrize("turns", [False, True])
def test_a_sign_holds_in_the_whole_enclosure_of_now(turns):
    """The line is crossed at t = 1, in the enclosure; its middle is before that."""
    moving = Rigid([0, 1], pivot=(1, 0)) if turns else Translation([0], [-1, 1])
    bodies = [
        Body("left", [(-1, 0)]),
        Body("right", [(5, 0)]),
        Body("moving", [(1, 3 if turns else 0)], moving),
    ]
    vertices = Vertices.of(bodies, QQ(0), QQ(4), plain=True)
    certifier = Certifier(vertices, QQ(0), QQ(4), exact_only=False)
    for low, high, known in ((1 - 1e-6, 1 + 1e-9, False), (1 - 1e-6, 1 - 9e-7, True)):
        certifier.move_to(EventTime(low, high, -1, -1, -1), [])

        assert bool(certifier.positions.orientation(*vertices.all)) == known
        assert bool(certifier.positions.order(*list(vertices.all)[1:], 1)) == known


@pytest.mark.parametrize("corner", range(4))
def test_one_position_with_a_large_error_leaves_all_open(corner):
    """It is on the x axis, as the others are, at t = sqrt(2); its error is above 1."""
    far = 10**17
    moving = Translation([0], [0, -2 * far, 0, far])
    bodies = [
        Body(str(i), [(x, 0)], moving if i == corner else Translation())
        for i, x in enumerate((0, 10**6, 3, 10**6 + 5))
    ]
    vertices = Vertices.of(bodies, QQ(0), QQ(4), plain=True)
    certifier = Certifier(vertices, QQ(0), QQ(4), exact_only=False)
    time = AlgebraicNumber.root((ZZ(-2), ZZ(0), ZZ(1)), QQ(1), QQ(2))
    low, high = vertices.normalization.enclosure(time)
    certifier.move_to(EventTime(low, high, -1, -1, -1, time), [])

    for abcd in permutations(vertices.all):
        assert certifier.positions.orientation(*abcd[:3]) == 0
        assert certifier.positions.cross_sign(*abcd) == 0
        assert certifier.positions.order(*abcd[:2], 1) == 0
