"""Velocities since a time, motions in local time, splines."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import fractions

from exactpt import (
    Affine,
    Body,
    InputError,
    Polynomial,
    Rigid,
    Scene,
    Simulation,
    Translation,
    Velocity,
    first_contact,
    in_local_time,
    spline,
)

SHAPE = [(0, 0), (2, 0), (0, 1)]
durations = st.fractions("1/8", 5, max_denominator=8)


def moved(points, dx, dy):
    return [(x + dx, y + dy) for x, y in points]


@given(v=st.tuples(fractions, fractions), since=fractions, t=fractions)
def test_a_velocity_moves_a_body_from_where_it_is_put(v, since, t):
    body = Body("b", SHAPE, Velocity(*v, since=since))

    assert body.at(since) == SHAPE
    assert body.at(t) == moved(SHAPE, v[0] * (t - since), v[1] * (t - since))


def test_a_launched_body_is_added_where_it_is_put():
    simulation = Simulation(Scene([Body("wall", [(9, -9), (9, 9)])], time=(0, 20)))
    list(simulation.run(3))
    simulation.add(Body.launched("ball", SHAPE, at=3, velocity=(1, 0)))

    assert simulation.run_to_contact().time == 10


def test_a_launched_chain_is_open():
    assert not Body.launched("c", SHAPE, at=1, velocity=(0, 0), closed=False).closed


@given(steps=st.lists(st.tuples(durations, fractions, fractions), min_size=1, max_size=4),
       start=fractions)  # fmt: skip
def test_steps_add_up(steps, start):
    motion = in_local_time([(d, Velocity(vx, vy)) for d, vx, vy in steps], start=start)
    body, t, x, y = Body("b", SHAPE, motion), start, Fraction(0), Fraction(0)

    assert body.at(start - 1) == SHAPE
    for duration, vx, vy in steps:
        assert body.at(t + duration / 3) == moved(
            SHAPE, x + vx * duration / 3, y + vy * duration / 3
        )
        t, x, y = t + duration, x + vx * duration, y + vy * duration
        assert body.at(t) == moved(SHAPE, x, y)
    assert body.at(t + 7) == moved(SHAPE, x, y)


def test_the_last_step_may_go_on_for_ever():
    body = Body("b", SHAPE, in_local_time([(1, Velocity(1, 0)), (None, Velocity(0, 1))], start=2))

    assert body.at(103) == moved(SHAPE, 1, 100)


def test_a_turn_in_local_time_begins_with_its_step():
    turn = Rigid([0, 1], pivot=(1, 0))
    body = Body("b", SHAPE, in_local_time([(2, Velocity(3, 0)), (1, turn)], start=5))
    alone = Body("b", SHAPE, turn)

    assert body.at("15/2") == moved(alone.at("1/2"), 6, 0)
    assert body.at(9) == moved(alone.at(1), 6, 0)


def test_an_affine_step():
    grow = Affine([[[1, 1], 0], [0, 1]])
    body = Body("b", SHAPE, in_local_time([(1, Velocity(1, 1)), (None, grow)]))

    assert body.at(3) == [(1, 1), (7, 1), (1, 2)]


@pytest.mark.parametrize(
    "steps, message",
    [
        ([], "at least one step"),
        ([(0, Velocity(1, 0))], "step 0: a duration is positive: 0"),
        ([(None, Velocity(1, 0)), (1, Velocity(1, 0))], "step 0: only the last step"),
        ([(1, "east")], "not a motion in local time: 'east'"),
        ([("one", Velocity(1, 0))], "not a number: 'one'"),
    ],
)
def test_what_is_no_step_is_refused(steps, message):
    with pytest.raises(InputError, match=message):
        in_local_time(steps)


def test_turns_that_do_not_fit_are_refused_by_the_body():
    motion = in_local_time([(1, Rigid([0, 1])), (1, Rigid([0, 1]))])

    with pytest.raises(InputError, match="vertex 1 jumps at t = 1"):
        Body("b", SHAPE, motion)


class Curve:
    """The attributes of SciPy's PPoly."""

    def __init__(self, c, x):
        self.c, self.x = np.array(c), np.array(x)


@pytest.mark.long
def test_a_spline_of_scipy_goes_through_its_points():
    interpolate = pytest.importorskip("scipy.interpolate")
    times, places = np.arange(5.0), np.array([(0, 0), (1, 3), (0.1, 0.7), (2, 2), (5, -1)])
    body = Body("b", [(0, 0)], spline(interpolate.CubicSpline(times, places)))

    for t, place in zip(times, places, strict=True):
        assert np.allclose(np.array(body.at(t)[0], dtype=float), place, atol=1e-14)
    assert body.at(-1) == [(0, 0)]
    assert body.at(9) == body.at(4)


def test_a_spline_whose_doubles_do_not_fit_is_continuous_nevertheless():
    """0.1 + 0.2 is not 0.3: the second piece begins where the first ends."""
    curve = Curve([[[0.1, 0.0], [1.0, 1.0]], [[0.2, 0.0], [0.3, 0.0]]], [0.0, 1.0, 2.0])

    body = Body("b", [(0, 0)], spline(curve))

    assert body.at(1) == [(Fraction(0.1) + Fraction(0.2), 0)]
    assert body.at(2) == [(Fraction(0.1) + Fraction(0.2) + 1, 1)]


@pytest.mark.parametrize(
    "curve",
    [None, "a curve", Curve([[1.0]], [0.0, 1.0]), Curve(np.ones((2, 1, 3)), [0.0, 1.0])],
    ids=["nothing", "a text", "a function", "a curve in space"],
)
def test_what_is_no_curve_in_the_plane_is_refused(curve):
    with pytest.raises(InputError, match="not a piecewise polynomial curve in the plane"):
        spline(curve)


def test_three_columns_are_sent_to_the_motion_that_takes_an_angle():
    with pytest.raises(InputError, match=r"PosePath\.of_curve"):
        spline(Curve(np.ones((2, 1, 3)), [0.0, 1.0]))


def test_a_spline_with_a_coefficient_that_is_not_finite_is_refused():
    with pytest.raises(InputError, match="not a finite number"):
        spline(Curve([[[float("nan"), 0.0]]], [0.0, 1.0]))


def test_a_translation_takes_numbers_and_coefficients():
    assert Translation(1, [0, 2]) == Translation([1], [0, 2])
    assert Translation("1/2") == Translation(["1/2"])
    assert Translation((0, 1), (2,)) == Translation([0, 1], [2])


def test_a_translation_by_one_pair_is_refused_with_a_hint():
    with pytest.raises(InputError, match=r"write Translation\(\*pair\)"):
        Translation((1, 2))


def test_a_time_of_contact_that_is_rational_is_a_number():
    scene = Scene([Body("a", SHAPE, Velocity(1, 0)), Body("b", [(5, 0)])], (0, 9))
    contact = first_contact(scene)

    assert scene.at(contact.time)["a"][1] == (5, 0)
    assert Translation(contact.time).x == Polynomial([3])
    assert scene.until(contact.time).end == 3
