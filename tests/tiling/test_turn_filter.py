"""The filter of cross products of directions, against exact signs."""

from hypothesis import given
from hypothesis import strategies as st

from exactpt.kernel.integer_polynomial import sign_at
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Rigid, Translation
from exactpt.motion.vertices import Vertices
from exactpt.tiling import coefficients
from exactpt.tiling.exact import cross

small = st.integers(-3, 3)
numbers = small | st.integers(-(10**9), 10**9) | st.builds(QQ, st.integers(-99, 99), st.just(7))
paths = st.lists(numbers, min_size=1, max_size=4)


@st.composite
def segments(draw):
    """A segment that translates or turns; both its vertices move as one."""
    start = draw(numbers), draw(numbers)
    step = draw(st.tuples(numbers, numbers).filter(any))
    end = start[0] + step[0], start[1] + step[1]
    if draw(st.booleans()):
        half = draw(st.integers(1, 5)) * draw(st.sampled_from((-1, 1)))
        return [start, end], Rigid([0, QQ(half, 4)], x=draw(paths), y=draw(paths))
    return [start, end], Translation(draw(paths), draw(paths))


def ends_of(vertices):
    """One vertex of the ring for each vertex of the two segments."""
    first = {(v.body, v.index): v.id for v in reversed(vertices.all)}
    return [first[body, index] for body in (0, 1) for index in (0, 1)]


@given(s=segments(), t=segments(), time=st.sampled_from([QQ(0), QQ(1, 3), QQ(2)]))
def test_what_is_decided_is_right(s, t, time):
    bodies = [
        Body(name, points, motion) for name, (points, motion) in zip("st", (s, t), strict=True)
    ]
    vertices = Vertices.of(bodies, QQ(0), QQ(4))
    low, high = vertices.frame.time(time)
    ends = ends_of(vertices)
    for a, b, c, d in (ends, [ends[0], ends[2], ends[1], ends[3]], [ends[0], ends[2], *ends[2:]]):
        four = [vertices.all[v] for v in (a, b, c, d)]

        found, _, _ = coefficients.turn(
            *(v.image for v in four), vertices.frame.errors, low, high, high + 1e-9
        )

        exact = sign_at(cross(*(v.track for v in four)), time)
        assert found in (0, exact)


def test_it_decides_what_is_clear():
    bodies = [
        Body("s", [(0, 0), (4, 1)], Translation([0, 1], [0, 2])),
        Body("t", [(9, 0), (9, 5)], Rigid([0, QQ(1, 4)])),
    ]
    vertices = Vertices.of(bodies, QQ(0), QQ(4))
    images = [vertices.all[v].image for v in ends_of(vertices)]

    assert coefficients.turn(*images, vertices.frame.errors, 0.0, 0.0, 1e-9)[0] == 1
    assert (
        coefficients.turn(*images[2:], *images[:2], vertices.frame.errors, 0.0, 0.0, 1e-9)[0] == -1
    )
