"""Motions and bodies: every kind of motion of every kind of shape, against `Fraction`."""

import json
import pickle
from fractions import Fraction
from itertools import pairwise

import gmpy2
import numpy as np
import pytest
from folding import every
from hypothesis import given
from hypothesis import strategies as st
from strategies import as_rational, body_data, fractions

from exactpt import (
    Affine,
    Body,
    InputError,
    Pieces,
    Polynomial,
    Rigid,
    Spin,
    Translation,
    in_local_time,
)
from exactpt.kernel.numbers import QQ
from exactpt.motion.motions import REST
from exactpt.scene.format import loads
from exactpt.testing.reference.positions import body_at, motion_at
from fuzz.references.real_roots import exact

times = st.one_of(fractions, st.builds(Fraction, st.integers(-99, 99), st.integers(1, 99)))
points = st.tuples(fractions, fractions)
orientations = st.sampled_from([(1, 0), (0, 1), (-1, 0), ("3/5", "4/5"), ("-5/13", "-12/13")])
polys = st.lists(fractions, max_size=3)


def body_of(data):
    """The body of JSON data. As a scene of its own, at a time at which it is simple."""
    scene = {"exactpt": 1, "time": [0, 1], "bodies": [data]}
    return loads(json.dumps(scene)).bodies[0]


def positions(body, t):
    return [(exact(x), exact(y)) for x, y in body.at(as_rational(t))]


@pytest.mark.long
@given(data=body_data(), t=times)
def test_a_body_is_where_the_contract_says(data, t):
    """Translations, turns, affine maps, pieces; rest, own polynomials, keyframes; all mixed."""
    assert positions(body_of(data), t) == body_at(data, t)


@pytest.mark.long
@given(data=body_data(), t=times)
def test_the_piece_after_a_time_holds_until_its_end(data, t):
    body = body_of(data)
    piece = body.exact_piece_after(as_rational(t))
    end = exact(piece.until) if piece.until is not None else t + 7

    assert end > t
    for time in (t, (t + end) / 2, end):
        at = [track.at(as_rational(time)) for track in piece.tracks]
        assert [(exact(x), exact(y)) for x, y in at] == body_at(data, time)


@pytest.mark.long
@given(data=body_data())
def test_breakpoints_are_the_times_at_which_formulas_change(data):
    body = body_of(data)
    written = {frame["t"] for frame in data.get("keyframes", [])}
    pieces = data.get("motion", {}).get("pieces", [])
    written |= {piece["until"] for piece in pieces if "until" in piece}

    assert [exact(t) for t in body.breakpoints] == sorted({Fraction(str(t)) for t in written})
    assert body.size == len(body_at(data, Fraction(0)))


@pytest.mark.long
@given(data=body_data(), t=times)
def test_denominators_of_tracks_are_positive_and_all_is_integer(data, t):
    kind = type(gmpy2.mpz())

    for track in body_of(data).exact_piece_after(as_rational(t)).tracks:
        w = sum(int(c) * t**i for i, c in enumerate(track.w))
        assert w > 0
        assert {type(c) for part in (track.x, track.y, track.w) for c in part} <= {kind}
        assert all(part[-1] != 0 for part in (track.x, track.y, track.w) if part)


@pytest.mark.long
@given(
    shapes=st.lists(st.tuples(points, points), min_size=2, max_size=3),
    turn=st.sampled_from([[], ["1/2"], [0, 1], ["1/3", "1/2", 1]]),
    pivots=st.lists(points, min_size=2, max_size=2),
    shift=polys,
    drift=polys,
)
def test_tracks_of_one_frame_keep_their_distances(shapes, turn, pivots, shift, drift):
    """Equal frames: translating together, or turning together; at every time, as far apart."""
    motions = [
        Translation(shift, drift),
        Translation(drift, shift),
        Affine([[2, 0], [1, 1]], x=shift),
    ]
    motions += [Rigid(turn, pivot=pivot, x=shift, y=drift) for pivot in pivots]
    tracks = [
        track
        for motion in motions
        for i, shape in enumerate(shapes)
        for track in Body(f"b{i}", shape, motion).exact_piece_after(QQ(0)).tracks
    ]
    by_motion = {}
    for track in tracks:
        if track.motion is not None:
            by_motion.setdefault(track.motion, []).append(track)

    for together in by_motion.values():
        for a, b in pairwise(together):
            assert len({distance2(a, b, t) for t in (-2, 0, Fraction(1, 3), 1, 5)}) == 1


def distance2(a, b, t):
    (ax, ay), (bx, by) = a.at(QQ(t)), b.at(QQ(t))
    return exact((ax - bx) ** 2 + (ay - by) ** 2)


@given(shape=st.tuples(points, points), shift=polys, drift=polys)
def test_vertices_that_translate_together_have_equal_frames(shape, shift, drift):
    a, b = Body("a", shape, Translation(shift, drift)).exact_piece_after(QQ(0)).tracks
    c = Body("c", [shape[0]], Translation([1, *shift[1:]], [2, *drift[1:]])).exact_piece_after(
        QQ(0)
    )

    assert a.motion is not None
    assert a.motion == b.motion == c.tracks[0].motion


def test_vertices_that_turn_together_have_equal_frames_unless_they_deform():
    turn = Rigid([0, 1], pivot=(1, 2))
    a, b = Body("a", [(0, 0), (5, 5)], turn).exact_piece_after(QQ(0)).tracks
    (c,) = Body("c", [{"x": [0, 1], "y": [0]}], turn).exact_piece_after(QQ(0)).tracks
    (d,) = Body("d", [(0, 0)], Rigid([0, 1], pivot=(1, 1))).exact_piece_after(QQ(0)).tracks

    assert a.motion == b.motion != d.motion
    assert c.motion is None


@given(point=points, turn=polys, pivot=points, x=polys, y=polys, t=times)
def test_a_turn_keeps_the_distance_to_the_moving_pivot(point, turn, pivot, x, y, t):
    body = Body("a", [point, pivot], Rigid(turn, pivot=pivot, x=x, y=y))

    (px, py), (qx, qy) = positions(body, t)

    at_rest = (point[0] - pivot[0]) ** 2 + (point[1] - pivot[1]) ** 2
    assert (px - qx) ** 2 + (py - qy) ** 2 == at_rest


@given(point=points, turn=polys, pivot=points, o=orientations, t=times)
def test_rigid_against_the_formula(point, turn, pivot, o, t):
    rigid = {"half_turn": turn, "pivot": pivot, "orientation": o}
    motion = {"rigid": {key: list(map(str, value)) for key, value in rigid.items()}}

    (found,) = positions(Body("a", [point], Rigid(turn, pivot=pivot, orientation=o)), t)

    assert found == motion_at(motion, *point, t)


@pytest.mark.parametrize("array", [np.array([[0, 0], [1, 2]]), np.array([[0.5, 0.25], [1.0, 2.0]])])
def test_vertices_as_a_numpy_array(array):
    body = Body("a", array)

    assert positions(body, 0) == [tuple(Fraction(float(c)) for c in row) for row in array]


def test_vertices_of_every_kind_of_number():
    body = Body("a", [(1, "1/2"), (Fraction(1, 3), gmpy2.mpq(1, 4)), (0.5, np.int64(7))])

    assert positions(body, 0) == [
        (1, Fraction(1, 2)),
        (Fraction(1, 3), Fraction(1, 4)),
        (Fraction(1, 2), 7),
    ]


def test_a_vertex_of_polynomials():
    body = Body("a", [(Polynomial([0, 1]), Polynomial([2])), {"x": [1, 1]}, {}])

    assert positions(body, 3) == [(3, 2), (4, 0), (0, 0)]


# Continuity


def jump(motion, vertices=((0, 0), (1, 0)), **more):
    with pytest.raises(InputError) as refusal:
        Body("box", None if more else vertices, motion, **more)
    message = str(refusal.value)
    assert "\n" not in message
    return message


def test_a_jump_is_refused_with_both_positions():
    message = jump(Pieces([("3/2", Translation([0, 1])), (None, Translation([0, 2], [5]))]))

    assert message == (
        "body 'box': vertex 0 jumps at t = 3/2 from (1.5, 0) to (3, 5), by 5.22; "
        "see exactpt.in_local_time"
    )


def test_a_jump_of_one_vertex_alone_is_refused():
    """A turn about vertex 0 by some angle, then none."""
    message = jump(Pieces([(1, Rigid([0, 1])), (None, REST)]))

    assert "vertex 1 jumps at t = 1 from (0, 1) to (1, 0), by 1.41;" in message


def test_pieces_of_one_rigid_map_are_continuous_without_their_trajectories(monkeypatch):
    """A regression: pieces of a spin computed the trajectories of all vertices, and kept none."""
    turned = Rigid([0, 1], pivot=(2, 1), x=[3], orientation=("3/5", "4/5"))
    h, (px, py), c, s = Fraction(1, 2), (2, 1), Fraction(-7, 25), Fraction(24, 25)
    held = Rigid(0, pivot=(px, py), x=3, orientation=(c, s))
    moved = Rigid(0, x=[px - c * px + s * py + 3], y=[py - s * px - c * py], orientation=(c, s))
    tracks = []
    monkeypatch.setattr(Rigid, "track", lambda *given: tracks.append(given))
    for after in (held, moved):
        Body("box", [(0, 0), (1, 0), (0, 1)], Pieces([(h, turned), (None, after)]))
    Body("box", [(0, 0), (1, 0)], Spin(1, pivot=(5, 3)))

    assert tracks == []


def test_a_jump_at_the_second_break_is_refused():
    pieces = [(1, REST), (2, Translation([-1, 1])), (None, REST)]

    assert "jumps at t = 2 from (1, 0) to (0, 0)" in jump(Pieces(pieces))


def test_a_jump_of_a_body_with_keyframes_is_refused():
    frames = [(0, [(0, 0)]), (2, [(2, 4)])]

    message = jump(Pieces([(1, REST), (None, Translation([1]))]), keyframes=frames)

    assert "vertex 0 jumps at t = 1 from (1, 2) to (2, 2), by 1;" in message


@given(gap=st.sampled_from([Fraction(0), Fraction(1, 10**40), Fraction(-1, 10**40)]), t=times)
def test_the_smallest_jump_is_refused_and_none_is_not(gap, t):
    after = Translation([-2 * t - gap, 3])  # x = 3 t - 2 t0 - gap meets x = t at t0

    pieces = Pieces([(as_rational(t), Translation([0, 1])), (None, after)])

    if gap:
        assert "jumps" in jump(pieces)
    else:
        assert positions(Body("box", [(0, 0)], pieces), t) == [(t, 0)]


@pytest.mark.parametrize(
    "pieces, words",
    [
        ([], "at least one piece"),
        ([(1, REST)], "the last piece has no end"),
        ([(None, REST), (None, REST)], "only the last piece"),
        ([(1, REST), (1, REST), (None, REST)], "increasing order: 1, then 1"),
        ([(2, REST), ("1/2", REST), (None, REST)], "increasing order: 2, then 1/2"),
        ([("x", REST), (None, REST)], "not a number: 'x'"),
    ],
)
def test_pieces_that_are_no_sequence_are_refused(pieces, words):
    with pytest.raises(InputError, match=words):
        Pieces(pieces)


@every(
    "make, words",
    [
        (lambda: Rigid([0, 1], pivot=(1, 2, 3)), "a pivot has two coordinates"),
        (lambda: Rigid([0, 1], pivot=("x", 0)), "not a number: 'x'"),
        (lambda: Rigid(["x"]), "not a number: 'x'"),
        (lambda: Affine([[1, 0]]), "2 x 2 matrix"),
        (lambda: Affine([[1, 0], [0, 1, 2]]), "2 x 2 matrix"),
        (lambda: Affine(["10", "01"]), "a row of a matrix is a list"),
        (lambda: Affine([[1, 0], [0, "y"]]), "not a number: 'y'"),
        (lambda: Translation(None), "not a polynomial"),
        (lambda: Translation([float("nan")]), "not a finite number"),
    ],
)
def test_motions_that_are_none_are_refused(make, words):
    with pytest.raises(InputError, match=words):
        make()


@every(
    "arguments, words",
    [
        ({"name": "", "vertices": [(0, 0)]}, "a text that is not empty"),
        ({"name": "a"}, "'a': give either vertices or keyframes or parts"),
        ({"name": "a", "vertices": [(0, 0)], "keyframes": []}, "'a': give either"),
        ({"name": "a", "vertices": []}, "'a': at least one vertex"),
        ({"name": "a", "vertices": [(0, 0), (1,)]}, "'a': vertex 1: a vertex has two"),
        ({"name": "a", "vertices": ["12"]}, "'a': vertex 0: a vertex has two"),
        ({"name": "a", "vertices": [(0, True)]}, "'a': vertex 0: not an exact number: True"),
        ({"name": "a", "vertices": [(0, float("inf"))]}, "'a': vertex 0: not a finite number"),
        ({"name": "a", "vertices": [{"x": [0], "z": [0]}]}, "'a': vertex 0: unknown key 'z'"),
        ({"name": "a", "keyframes": []}, "'a': at least one keyframe"),
        ({"name": "a", "keyframes": [(0, [])]}, "'a': at least one vertex"),
        ({"name": "a", "keyframes": [(1, [(0, 0)]), (1, [(0, 0)])]}, "keyframe 1: t = 1 is not"),
        ({"name": "a", "keyframes": [(0, [(0, 0)]), (1, [])]}, "keyframe 1: 0 vertices, but"),
        ({"name": "a", "keyframes": [("x", [(0, 0)])]}, "'a': keyframe 0: not a number: 'x'"),
        ({"name": "a", "keyframes": [(0, [(0, "y")])]}, "'a': keyframe 0: not a number: 'y'"),
    ],
)
def test_bodies_that_are_none_are_refused(arguments, words):
    with pytest.raises(InputError, match=words) as refusal:
        Body(**arguments)

    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("point", [(1, 2, 3), (1,), ()])
def test_bug_a_vertex_of_a_keyframe_may_have_any_number_of_coordinates(point):
    """(1, 2, 3) was taken as (1, 2); (1,) ended in an IndexError."""
    with pytest.raises(InputError):
        Body("a", keyframes=[(0, [point])])


@pytest.mark.parametrize("vertices", [[5], [None], 7])
def test_bug_vertices_of_a_wrong_type_are_a_type_error(vertices):
    with pytest.raises(InputError):
        Body("a", vertices)


def test_an_orientation_turns_first_and_so_a_turn_passes_180_degrees():
    quarter = Rigid([0, 1])
    steps = [(1, quarter)]
    for i, orientation in enumerate([(0, 1), (-1, 0), (0, -1), (1, 0)]):
        steps.append((i + 2, Rigid([-i - 1, 1], orientation=orientation)))
    round_trip = Body("a", [(2, 0)], Pieces([*steps[:-1], (None, steps[-1][1])]))

    assert [round_trip.at(t)[0] for t in range(5)] == [(2, 0), (0, 2), (-2, 0), (0, -2), (2, 0)]


def test_a_turned_body_turns_with_the_same_motion_elsewhere():
    """Their distance is constant: the identity of a rigid motion is without its orientation."""
    a, b = (Rigid([0, 1], pivot=(1, 2), orientation=o) for o in ((1, 0), ("3/5", "4/5")))
    p, q = (m.track((Polynomial([3]), Polynomial([4]))) for m in (a, b))

    assert p.motion == q.motion
    d = [
        sum((u - v) ** 2 for u, v in zip(p.at(t), q.at(t), strict=True))
        for t in (0, 1, Fraction(1, 3))
    ]
    assert d[0] == d[1] == d[2] != 0


def test_an_orientation_is_kept():
    turn = Rigid([0, 1], pivot=(1, 2), orientation=("3/5", "4/5"))

    assert turn.orientation == (Fraction(3, 5), Fraction(4, 5))
    assert pickle.loads(pickle.dumps(turn)) == turn != Rigid([0, 1], pivot=(1, 2))
    assert eval(repr(turn), {"Rigid": Rigid, "Polynomial": Polynomial}) == turn
    assert "orientation" not in repr(Rigid([0, 1]))
    later = Body("a", [(0, 0)], in_local_time([(1, turn)]))
    assert later.at(0) == Body("a", [(0, 0)], turn).at(0)


@pytest.mark.parametrize("orientation", [(1, 1), (0, 0), (1,), "10", (0.6, 0.8)])
def test_what_is_no_orientation(orientation):
    with pytest.raises(InputError, match="orientation"):
        Rigid([0, 1], orientation=orientation)


QUARTERS = Pieces([*((QQ(k, 4), Rigid(0)) for k in range(1, 9)), (None, Rigid(0))])


def test_breakpoints_in_a_span_are_those_of_the_motion_and_the_shape():
    frames = [(0, [(0, 0), (1, 0)]), ("1/3", [(0, 0), (2, 0)])]
    body = Body("b", keyframes=frames, motion=QUARTERS)

    assert body.breakpoints_between(-1, "3/4") == (0, QQ(1, 4), QQ(1, 3), QQ(1, 2))
    assert body.breakpoints_between(0, "1/4") == ()
    twelfths = [n for n in (0, 1, 3, 4, 5, 6) if body.exact_is_breakpoint(QQ(n, 12))]
    assert twelfths == [0, 3, 4, 6]
    assert body.exact_piece_after(QQ(1, 4)).until == QQ(1, 3)
    assert body.exact_piece_after(QQ(1, 3)).until == QQ(1, 2)
