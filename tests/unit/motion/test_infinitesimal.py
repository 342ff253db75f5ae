"""Displacements of infinitesimal copies: on one side of both edges at every vertex."""

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st
from strategies import fractions

from exactpt import AlgebraicNumber, Body, Rigid, Translation
from exactpt.kernel.integer_polynomial import add, multiply, sign_at, subtract
from exactpt.kernel.numbers import QQ
from exactpt.kernel.roots import common_roots, roots_after
from exactpt.motion.infinitesimal import displacements, ring_of_copies
from exactpt.motion.track import difference

START, END = QQ(0), QQ(3)
paths = st.lists(fractions, max_size=3)
motions = st.one_of(
    st.builds(Translation, paths, paths), st.builds(lambda h: Rigid([0, h]), fractions)
)


@st.composite
def chains(draw, least=2):
    """The trajectories of an open chain whose vertices may move by polynomials of their own."""
    n = draw(st.integers(least, 5))
    if draw(st.booleans()):
        steps = draw(st.lists(st.tuples(fractions, fractions), min_size=n, max_size=n))
        vertices = [(x + 2 * i, y) for i, (x, y) in enumerate(steps)]
        body = Body("a", vertices, draw(motions), closed=False)
    else:
        vertices = [{"x": [2 * i, *draw(paths)], "y": draw(paths)} for i in range(n)]
        body = Body("a", vertices, closed=False)
    return body.exact_piece_after(START).tracks


def direction(p, q):
    return difference(p.x, p.w, q.x, q.w), difference(p.y, p.w, q.y, q.w)


def cross_sign(d, e, t):
    return sign_at(subtract(multiply(d[0], e[1]), multiply(d[1], e[0])), t)


def first_contact(edges):
    """When an edge first shrinks to a point, or folds back on the one before it; at most END."""
    now, times = AlgebraicNumber(START), [AlgebraicNumber(END)]
    for dx, dy in edges:
        if not dx and not dy:
            return now
        times += [root.time for root in common_roots(dx, dy, now, END)]
    for d, e in pairwise(edges):
        cross = subtract(multiply(d[0], e[1]), multiply(d[1], e[0]))
        along = add(multiply(d[0], e[0]), multiply(d[1], e[1]))
        if cross:
            roots = [root.time for root in roots_after(cross, now, END)]
            times += [t for t in roots if t.sign_of(along) <= 0]
        elif now.sign_after(along) <= 0:
            return now
        else:
            times += [root.time for root in roots_after(along, now, END)]
    return min(times)


@given(chains())
def test_displacements_are_on_their_side_of_both_edges(tracks):
    n = len(tracks)
    offsets = displacements(tracks, START, END)
    ring = ring_of_copies(n)
    edges = [direction(p, q) for p, q in pairwise(tracks)]
    until = END if offsets.until is None else offsets.until
    assert len(ring) == len(offsets.directions)
    assert until > START
    contact = first_contact(edges)
    for k in range(1, 30):
        t = START + (until - START) * QQ(k, 30)
        if contact.compare_rational(t) <= 0:
            return
        for i, (index, offset) in enumerate(zip(ring, offsets.directions, strict=True)):
            sides = {cross_sign(edges[j], offset, t) for j in (index - 1, index) if 0 <= j < n - 1}
            assert sides == {-1 if 1 <= i <= n else 1}


def test_a_ring_goes_out_on_the_right_and_back_on_the_left():
    assert ring_of_copies(1) == [0, 0, 0]
    assert ring_of_copies(2) == [0, 0, 1, 1]
    assert ring_of_copies(4) == [0, 0, 1, 2, 3, 3, 2, 1]


def test_a_point_becomes_a_triangle_around_it():
    track = Body("a", [(3, 4)]).exact_piece_after(START).tracks
    offsets, until = displacements(track, START, END)

    assert until is None
    turns = [cross_sign(offsets[i], offsets[(i + 1) % 3], START) for i in range(3)]
    assert turns == [1, 1, 1]


def test_the_ends_of_a_segment_have_a_left_and_a_right_copy():
    tracks = Body("a", [(0, 0), (2, 1)], Rigid([0, 1])).exact_piece_after(START).tracks
    offsets, until = displacements(tracks, START, END)
    along = direction(*tracks)

    assert until is None
    for t in (QQ(0), QQ(1, 3), QQ(2)):
        assert [cross_sign(along, offset, t) for offset in offsets] == [1, -1, -1, 1]


def test_displacements_at_the_start_of_a_chain_with_a_right_angle_then():
    """It becomes obtuse: the left of the first edge, good from then on, is along the other."""
    tracks = Body(
        "a", [[0, 0], [2, 0], {"x": [2, 1], "y": [2, -1]}], closed=False
    ).exact_piece_after(START)
    left = displacements(tracks.tracks, START, END).directions[5]

    for p, q in pairwise(tracks.tracks):
        assert cross_sign(direction(p, q), left, START) == 1


def test_displacements_end_where_the_chain_has_bent_too_far():
    """A right angle, then straight, then the other way round: one direction is not enough."""
    tracks = Body(
        "a", [[0, 0], {"x": [2], "y": [0]}, {"x": [2, 2, -1], "y": [2, -2]}], closed=False
    ).exact_piece_after(START).tracks  # fmt: skip

    assert displacements(tracks, START, END).until is not None
