"""The intervals in which bodies meet, by hand. The laws `contacts/...` have the definition."""

import pytest

from exactpt import (
    Body,
    InputError,
    Pieces,
    Rigid,
    Scene,
    Spin,
    Translation,
    contact_intervals,
    contacts,
)
from exactpt.pair.features import FeaturePair

SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]
WALL = Body("wall", [(10, -9), (10, 9)])


def times(intervals):
    return [(float(i.start), float(i.end)) for i in intervals]


def of(first, second, time=(0, 20)):
    return times(contact_intervals(Scene([first, second], time), first.name, second.name))


def test_interval_of_a_square_that_passes_through_a_wall_is_its_width():
    assert of(Body("square", SQUARE, Translation([0, 1])), WALL) == [(8, 10)]


def test_interval_of_a_square_that_turns_back_in_a_wall_is_one():
    there = Translation([0, 1])
    back = Translation([20, -1])
    square = Body("square", SQUARE, Pieces([(10, there), (None, back)]))

    assert of(square, WALL) == [(8, 12)]


def test_interval_of_a_touch_has_no_length():
    """A parabola that touches the wall, and is gone."""
    point = Body("point", [(0, 0)], Translation([9, 2, -1]))

    assert of(point, WALL) == [(1, 1)]


def test_interval_of_nested_bodies_is_the_time_span():
    inner = Body("inner", [(0, 0), (1, 0), (0, 1)], Rigid([0, 1], pivot=("1/3", "1/3")))
    outer = Body("outer", [(-9, -9), (9, -9), (9, 9), (-9, 9)])

    assert of(inner, outer) == [(0, 20)]
    assert of(inner, Body("far", [(50, 0), (51, 0), (50, 1)])) == []


def test_interval_of_a_body_that_is_swallowed_lasts_until_it_leaves():
    """In between only its interior is in the other one: no edges cross."""
    dot = Body("dot", [(-1, 4)], Translation([0, 1]))
    box = Body("box", [(0, 0), (5, 0), (5, 9), (0, 9)])

    assert of(dot, box) == [(1, 6)]
    assert of(box, dot) == [(1, 6)]


def test_interval_of_a_segment_that_slides_along_its_line_is_while_they_share_points():
    """All orientations vanish for all times."""
    first = Body("first", [(0, 0), (2, 0)], Translation([0, 1]))
    second = Body("second", [(5, 0), (6, 0)])

    assert of(first, second) == [(3, 6)]


def test_interval_of_a_segment_that_lifts_ends_at_the_change_of_motion():
    """Nothing vanishes at the time of the change that did not vanish before."""
    lift = Pieces([(4, Translation([0, 1])), (None, Translation([0, 1], [-4, 1]))])
    first = Body("first", [(0, 0), (2, 0)], lift)
    second = Body("second", [(-9, 0), (9, 0)])

    assert of(first, second) == [(0, 4)]


def test_points_that_meet_twice_have_two_intervals():
    first = Body("first", [(0, 0)], Translation([0, 3, -1]))
    second = Body("second", [(2, 0)])

    assert of(first, second) == [(1, 1), (2, 2)]


def test_interval_at_an_end_of_the_time_span_counts():
    square = Body("square", SQUARE, Translation([0, 1]))

    assert of(square, WALL, time=(0, 8)) == [(8, 8)]
    assert of(square, WALL, time=(8, 9)) == [(8, 9)]
    assert of(square, WALL, time=(10, 11)) == [(10, 10)]
    assert of(square, WALL, time=("21/2", 11)) == []


def test_intervals_of_wrong_names_are_refused():
    scene = Scene([Body("square", SQUARE), WALL], time=(0, 1))
    with pytest.raises(InputError, match="got 'wall' twice"):
        contact_intervals(scene, "wall", "wall")
    with pytest.raises(InputError, match="nobody"):
        contact_intervals(scene, "wall", "nobody")


def test_contacts_of_all_pairs_are_in_order():
    scene = Scene(
        [
            Body("slow", SQUARE, Translation([0, 1], [5])),
            Body("fast", SQUARE, Translation([0, 2])),
            WALL,
            Body("idle", [(0, 50), (1, 50), (0, 51)]),
        ],
        time=(0, 20),
    )

    found = [(i.a, i.b, float(i.start), float(i.end)) for i in contacts(scene)]

    assert found == [("fast", "wall", 4, 5), ("slow", "wall", 8, 10)]


def test_bug_the_order_of_the_names_changed_names_and_polynomials():
    """The times are roots of x^2 - 2, found for a vertex of each body."""
    fall = Translation([0], [0, 0, -1])
    scene = Scene(
        [Body("a", [(0, 2), (1, 2), (0, 3)], fall), Body("b", [(-5, 0), (5, 0), (0, -1)])]
    )
    wide = Scene(scene.bodies, time=(0, 2))
    forth, back = (contact_intervals(wide, *names) for names in (("a", "b"), ("b", "a")))

    assert [i.to_json() for i in back] == [i.to_json() for i in forth]
    assert [i.to_json() for i in contacts(wide)] == [i.to_json() for i in forth]
    assert forth == back
    assert (back[0].a, back[0].b) == ("a", "b")


def test_a_rounded_bar_that_turns_touches_a_disc_when_it_points_at_it():
    """The end of the bar is at a distance of 2 from its pivot, 1 from a disc's centre 3 above it.

    That is the sum of the radii, when half the angle is 45 degrees: its tangent t is 1.
    """
    bar = Body("bar", [(0, 0), (2, 0)], Rigid([0, 1]), radius="1/2")
    disc = Body("disc", [(0, 3)], radius="1/2")

    assert of(bar, disc, time=(0, 9)) == [(1, 1)]


def test_features_of_bodies_that_turn_are_compared_exactly_only_where_they_are_near(monkeypatch):
    """Squares turn beside each other: 16 pairs of vertices, 32 of a vertex and an edge.

    The left one takes a quarter of a turn about its corner (0, 0) into y <= 0, while the right one
    stays in y >= 1 (its lowest vertex there is its pivot). Exact comparisons took 20 s of such a
    turn.
    """
    compared = []
    exactly = FeaturePair.at_distance
    monkeypatch.setattr(
        FeaturePair, "at_distance", lambda pair, d: compared.append(pair) or exactly(pair, d)
    )
    left = Body("left", [(0, 0), (1, 0), (1, -1), (0, -1)], Spin(-1, (0, 0)), radius="1/9")
    right = Body("right", [(1, 1), (2, 1), (2, 2), (1, 2)], Spin(1, (1, 1)), radius="1/9")
    scene = Scene([left, right], time=(0, "3/2"))

    assert contact_intervals(scene, "left", "right") == []
    pieces = len({*left.breakpoints_between(0, "3/2"), *right.breakpoints_between(0, "3/2")}) + 1
    assert len(compared) < pieces * (16 + 32) / 4
