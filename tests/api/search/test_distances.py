"""Distances, approaches and clearances by hand, with their derivations, and what is refused.

The laws `distance/...` and `first within/...` compare them with the definitions.
"""

import math
import pickle
from fractions import Fraction

import pytest

import exactpt
from exactpt import (
    AlgebraicNumber,
    Body,
    InputError,
    Pieces,
    PosePath,
    Scene,
    Translation,
    clearance,
    contact_intervals,
    distance,
    first_within,
)

TIP = [(0, 0), (-3, 1), (-3, -1)]
"""A wedge that points to the right."""
WALL = Body("wall", [(10, -9), (10, 9)])
BOX = Body("box", [(0, 0), (5, 0), (5, 9), (0, 9)])
SMALL_BOX = Body("small box", [(0, 0), (2, 0), (2, 2), (0, 2)])


def within(a, b, d=None, time=(0, 20), **options):
    return first_within(Scene([a, b], time), a.name, b.name, d, **options)


def gap_of(body, time=(0, 20)):
    return clearance(Scene([body, SMALL_BOX], time), body.name, "small box")


def room():
    """A point that flies by a box, with far bodies, one of which moves towards it."""
    ball = Body("ball", [(-9, 3)], Translation([0, 1]))
    box = Body("box", [(0, 0), (2, 0), (2, 2), (0, 2)])
    far = Body("far", [(0, 99), (1, 99), (1, 100)], Translation([0], [0, -1]))
    posts = [Body(f"post {k}", [(k, -50)]) for k in range(3)]
    return Scene([ball, box, far, *posts], time=(0, 20))


# At a time


def test_distance_of_a_point_and_an_edge_has_its_features():
    point = Body("point", [(-20, 5)], Translation([0, 1]))
    there = distance(Scene([point, BOX], time=(0, 30)), "point", "box", at="37/2")

    assert there.squared == Fraction(9, 4)
    assert float(there) == 1.5
    assert there.features == (((0, None), (None, 3)),)


def test_distance_at_an_exact_number_is_that_at_its_value():
    scene = Scene([WALL, BOX], time=(0, 1))

    assert distance(scene, "wall", "box", at=AlgebraicNumber(1)).squared == 25


def test_distance_at_wrong_times_is_refused():
    scene = Scene([WALL, BOX], time=(0, 1))
    root = AlgebraicNumber.root((-2, 0, 9), 0, 1)
    with pytest.raises(InputError, match=r"irrational time: use \.low, \.high or float"):
        distance(scene, "wall", "box", at=root)
    with pytest.raises(InputError, match="outside of"):
        distance(scene, "wall", "box", at=2)


# The first time within a distance


@pytest.mark.parametrize("d, time", [(0, 10), (3, 7), ("1/3", "29/3"), (10, 0), (12, 0)])
def test_first_within_of_a_tip_and_a_wall_is_when_it_is_so_near(d, time):
    assert within(Body("tip", TIP, Translation([0, 1])), WALL, d) == Fraction(time)


def test_first_within_of_a_corner_is_on_the_circle_around_it():
    """Not on the square: from (-20, -20) on the diagonal, (t - 20)^2 * 2 = 1."""
    point = Body("point", [(-20, -20)], Translation([0, 1], [0, 1]))

    assert within(point, BOX, 1).polynomial == (799, -80, 2)
    assert within(point, BOX, distance_squared=2) == 19


def test_first_within_of_a_point_that_passes_a_corner_is_a_root_of_degree_4():
    """It passes the corner (9, 0) at a distance of 1 in x, at the height t^2 - 20.

    It is within 3/2 of the corner when (t^2 - 20)^2 = 9/4 - 1.
    """
    point = Body("point", [(10, -20)], Translation([0], [0, 0, 1]))
    box = Body("box", [(0, 0), (9, 0), (9, 5), (0, 5)])

    assert within(point, box, "3/2").polynomial == (1595, 0, -160, 0, 4)
    assert within(point, box, "1/2") is None


def test_first_within_counts_a_graze_of_the_offset_curve():
    """The parabola y = (t - 3)^2 + 10 comes to distance 1 of the top edge once."""
    grazing = Body("grazing", [(-3, 10)], Translation([0, 1], [9, -6, 1]))

    assert within(grazing, BOX, 1) == 3
    assert within(grazing, BOX, "999/1000") is None


def test_first_within_of_bodies_that_keep_their_distance_is_the_start_or_never():
    first = Body("first", [(0, 0), (1, 0), (0, 1)], Translation([0, 1]))
    second = Body("second", [(4, 0), (5, 0), (4, 1)], Translation([0, 1]))

    assert within(first, second, 3) == 0
    assert within(first, second, "299/100") is None


def test_first_within_of_a_body_inside_of_another_is_the_start():
    ring = Body("ring", [(0, 0), (20, 0), (20, 20), (0, 20)])

    assert within(ring, Body("dot", [(10, 10)]), 1) == 0


def test_first_within_after_a_change_of_motion():
    """Along the wall at distance 2 until t = 4, then nearer by 1 in a unit of time."""
    motion = Pieces([(4, Translation([0], [0, 1])), (None, Translation([-4, 1], [0, 1]))])
    tip = Body("tip", [(8, 0), (7, 1)], motion)

    assert within(tip, WALL, 2) == 0
    assert within(tip, WALL, "3/2") == Fraction(9, 2)


@pytest.mark.parametrize(
    "arguments, options, message",
    [
        (("wall", "tip", -1), {}, "a distance is not negative: -1"),
        (("wall", "nobody", 1), {}, "there is no body 'nobody'"),
        (("wall", "wall", 1), {}, "expected two different bodies"),
        (("wall", "tip"), {}, "either a distance or its square"),
        (("wall", "tip", 1), {"distance_squared": 1}, "either a distance or its square"),
        (("wall", "tip", 1), {"between": [("wall", "tip")]}, "not supported for two named bodies"),
        (("wall", "tip", 1), {"ignoring": [("wall", "tip")]}, "not supported for two named bodies"),
    ],
)
def test_first_within_of_a_wrong_question_is_refused(arguments, options, message):
    scene = Scene([WALL, Body("tip", TIP)])

    with pytest.raises(InputError, match=message):
        first_within(scene, *arguments, **options)


@pytest.mark.parametrize("digits", [300, 400, 2000])
def test_bug_axes_of_which_one_is_out_of_the_range_of_doubles_beside_the_other(digits):
    floor = Body("floor", [(-(10**digits), 0), (10**digits, 0)])
    wide = [floor, Body("point", [(0, 5)], Translation([0], [0, -1]))]
    round_one = [floor, Body("disc", [(0, 5)], Translation([0], [0, -1]), radius=1)]

    assert exactpt.first_contact(Scene(round_one, (0, 9))).time == 4
    assert first_within(Scene(wide, (0, 9)), distance="1/2").time == Fraction(9, 2)


# The distance over time


def test_clearance_of_a_point_that_passes_a_box_has_three_pieces():
    gap = gap_of(Body("point", [(-9, 3)], Translation([0, 1])))

    assert [(float(p.start), float(p.end), p.features) for p in gap.pieces] == [
        (0, 9, ((0, None), (3, None))),
        (9, 11, ((0, None), (None, 2))),
        (11, 20, ((0, None), (2, None))),
    ]
    assert gap.minimum == (9, 1)


def test_clearance_of_bodies_that_meet_has_a_piece_without_features():
    gap = gap_of(Body("point", [(-9, 1)], Translation([0, 1])))

    assert [p.features for p in gap.pieces].count(None) == 1
    assert gap.squared(10) == 0
    assert gap.minimum == (9, 0)
    assert gap(12) == 1.0


def test_clearance_of_edges_that_stay_parallel_is_one_piece():
    gap = gap_of(Body("other", [(5, 0), (7, 0), (7, 2), (5, 2)], Translation([0, 1])))

    assert len(gap.pieces) == 1
    assert gap.minimum == (0, 9)


def test_bug_at_a_time_at_which_the_foot_turns_back_at_an_end_the_edge_stays_nearest():
    """The end of the edge is at (3 + (t - 1)^2, 0), the point at (3, 1): at t = 1 it is above it.

    The distance is 1 at all times. `distance` has the interior of the edge, and so the end alone
    at t = 1; the piece has the edge with its ends, and is not cut there.
    """
    point = Body("point", [(3, 1)])
    edge = Body("edge", [(4, 0), (0, 0)], Translation([0, -2, 1]))
    scene = Scene([point, edge], time=(0, 2))
    point_and_edge, point_and_end = ((0, None), (None, 0)), ((0, None), (0, None))

    gap = clearance(scene, "point", "edge")

    assert [(p.start, p.end, p.features) for p in gap.pieces] == [(0, 2, point_and_edge)]
    assert gap.minimum == (0, 1)
    at_times = [distance(scene, "point", "edge", at=t).features for t in (0, 1, 2)]
    assert at_times == [(point_and_edge,), (point_and_end,), (point_and_edge,)]


@pytest.mark.parametrize("path", [[3], [3, 1], [3, -1]])
def test_clearance_of_a_point_that_stays_above_an_end_is_of_two_vertices(path):
    """The foot is at the end for all t, which is not a single time: two vertices are nearest."""
    point = Body("point", [(0, 0)], Translation([5], path))

    gap = clearance(Scene([point, Body("edge", [(5, 0), (0, 0)])], time=(0, 2)), "point", "edge")

    assert [piece.features for piece in gap.pieces] == [((0, None), (0, None))]


def test_clearance_along_a_parabola_is_least_at_an_irrational_time():
    """Past the corner (2, 2): the squared distance is of degree 4, its derivative a cubic."""
    gap = gap_of(Body("point", [(6, -1)], Translation([0, -1], [0, "1/2", "1/7"])), time=(0, 9))

    assert not gap.minimum.time.is_rational
    assert gap(float(gap.minimum.time)) == pytest.approx(float(gap.minimum), abs=1e-12)


def test_clearance_of_a_path_of_poses_has_bounds_of_its_least_distance():
    """Exact values of such a high degree take seconds each: only the one that is shown has one."""
    path = PosePath([0, 1], [([0, 3], [0, 0, 1], [0, 1])], error="1/9")
    arm = Body("arm", [(-1, 0), (1, 0)], path)
    gap = clearance(Scene([arm, Body("post", [(3, -2)])], time=(0, 1)), "arm", "post")

    assert len(gap.pieces) > 2
    assert len(gap.below(3)) == 1
    assert 2 < float(gap.minimum) < 3


def test_clearance_outside_of_the_span_is_refused():
    with pytest.raises(InputError, match="outside of the time span"):
        gap_of(Body("point", [(5, 5)])).squared(21)


# When bodies are within a distance


def test_below_a_distance_that_is_reached_at_one_time_is_one_time():
    point = Body("point", [(-5, 1)], Translation([0, 1]))
    scene = Scene([point, Body("origin", [(0, 0)])], time=(0, 10))

    (touch,) = clearance(scene, "point", "origin").below(1)

    assert (touch.start, touch.end) == (AlgebraicNumber(5), AlgebraicNumber(5))
    assert clearance(scene, "point", "origin").below("0.999") == ()
    assert clearance(scene, "point").below("0.999") == ()


def test_below_zero_are_the_contacts():
    ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]), radius="1/4")
    scene = Scene([ball, Body("wall", [(9, -5), (9, 5)])], time=(0, 10))
    (expected,) = contact_intervals(scene, "ball", "wall")

    (found,) = clearance(scene, "ball").below(0)

    assert (found.start, found.end) == (expected.start, expected.end)


# One body and all others


def test_surroundings_have_the_nearest_body():
    around = clearance(room(), "ball")

    assert around.minimum.body == "box"
    assert [i.b for i in around.below(1)] == ["box"]
    assert around.nearest(0)[0] == "box"
    assert around(10) == 1.0
    assert around.others == ("box", "far", "post 0", "post 1", "post 2")
    assert repr(around) == "<Surroundings of 'ball': 5 other bodies>"
    assert pickle.loads(pickle.dumps(around)).minimum == around.minimum


@pytest.mark.parametrize("height", [0, 1])
def test_bug_of_equal_distances_the_minimum_was_not_the_earliest(height):
    """The later one is first in the scene; both touch, or both pass at a distance of 1."""
    ball = Body("ball", [(0, height)], Translation([0, 1]))
    posts = [Body(f"post {x}", [(x, 0)]) for x in (9, 5, 7)]

    found = clearance(Scene([ball, *posts], time=(0, 10)), "ball").minimum

    assert (found.body, found.time, found.squared) == ("post 5", 5, height)


def test_bug_a_distance_beyond_the_range_of_doubles_had_no_minimum():
    far = 10**400
    points = [Body(f"p{i}", [(i * far, 0)], Translation([0, i])) for i in range(1, 7)]

    around = clearance(Scene([Body("a", [(0, 0)]), *points], time=(0, 1)), "a")

    assert (around.minimum.body, around.minimum.squared) == ("p1", far**2)
    assert around(0) == math.inf


def test_surroundings_of_unusable_names_and_distances_are_refused():
    scene = room()
    with pytest.raises(InputError, match="nobody"):
        clearance(scene, "nobody")
    with pytest.raises(InputError, match="no body but 'ball'"):
        clearance(Scene(scene.bodies[:1], time=(0, 1)), "ball")
    with pytest.raises(InputError, match="at least 0, got -1"):
        clearance(scene, "ball").below(-1)
    with pytest.raises(InputError, match="at least 0, got -1"):
        clearance(scene, "ball", "box").below(-1)


def test_bug_a_least_distance_that_was_read_again_and_again_doubled_its_digits():
    """It is least at the root of 2 t^3 - 3 t^2 + 4 t - 1, which is not rational."""
    moving = Body("moving", [(0, 0)], Translation([0, 1], [1, -1, 1]))
    least = clearance(Scene([Body("a", [(0, 0)]), moving], time=(-2, 2)), "a", "moving").minimum
    distances = [least.distance for _ in range(40)]

    assert len(set(distances)) == 1
    assert float(distances[0]) == pytest.approx(0.8449890002893246)
    assert least.squared.low.denominator.bit_length() < 2000
