"""What tests of predicates draw: vertices that move, many of them alike, and where they are."""

from fractions import Fraction

from hypothesis import strategies as st
from strategies import as_rational, fractions

from exactpt import Affine, Body, Rigid, Translation
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices

START, END = QQ(0), QQ(4)
SHAPES = (
    [(0, 0)],
    [(0, 0), (1, 0)],
    [(0, 0), (0, 2)],
    [(0, 0), (2, 0), (0, 1)],
    [(0, 0), (1, 0), (1, 1), (0, 1)],
)
paths = st.lists(fractions, max_size=2)
linear = st.builds(Translation, paths, paths)
parabolic = st.builds(Translation, st.lists(fractions, max_size=4), paths)
turning = st.builds(lambda h, x: Rigid([0, h], x=x), st.sampled_from([1, -1, 2]), paths)
affine = st.builds(lambda p, x: Affine([[[1], p], [0, [1]]], x=x), paths, paths)
times = st.fractions(0, 4, max_denominator=8).map(as_rational)


@st.composite
def vertices(draw, motions=linear, least=3):
    """Bodies that may overlap, with few different motions."""
    pool = draw(st.lists(motions, min_size=1, max_size=3))
    bodies = []
    for i in range(draw(st.integers(least, 5))):
        dx, dy = draw(fractions), draw(fractions)
        shape = [(x + dx, y + dy) for x, y in draw(st.sampled_from(SHAPES))]
        bodies.append(Body(f"b{i}", shape, draw(st.sampled_from(pool))))
    return Vertices.of(bodies, START, END)


def place(vertex, t):
    """Where a vertex is."""
    x, y = vertex.track.at(t)
    return Fraction(int(x.numerator), int(x.denominator)), Fraction(
        int(y.numerator), int(y.denominator)
    )


def sign(x):
    """1, 0 or -1."""
    return (x > 0) - (x < 0)


def turn(vertices_, t):
    """The sign of the orientation of three vertices at a time."""
    p, q, r = (place(v, t) for v in vertices_)
    return sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))
