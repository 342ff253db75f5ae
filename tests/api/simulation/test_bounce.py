"""Bounces with restitution and masses, by hand: momentum and energy of two bodies on a line.

That contacts of a run that bounces are those by definition is the law `simulation/bounces`.
"""

import pickle
import sys
from fractions import Fraction
from pathlib import Path

import pytest
from folding import every

from exactpt import (
    Affine,
    Body,
    Bounce,
    InputError,
    Pieces,
    Rigid,
    Scene,
    Simulation,
    Translation,
    Velocity,
    onward,
)

sys.path.append(str(Path(__file__).parents[3] / "examples"))

BOX = [(0, 0), (1, 0), (1, 1), (0, 1)]
EXACT = 2.0**-19  # velocities are rounded to the grid of 2^-20


def velocities_after(bounce, u=2, v=-1):
    """The velocities of two boxes that meet on the x axis, after their first contact."""
    left = Body("left", BOX, Velocity(u, 0))
    right = Body("right", [(x + 10, y) for x, y in BOX], Velocity(v, 0))
    simulation = Simulation(Scene([left, right], time=(0, 20)))
    list(simulation.run(5, on_contact=bounce))
    assert simulation.contacts == 1
    now = Fraction(5)
    return [
        float(simulation.body(name).at(now + 1)[0][0] - simulation.body(name).at(now)[0][0])
        for name in ("left", "right")
    ]


def test_equal_masses_exchange_their_velocities():
    assert velocities_after(Bounce()) == pytest.approx([-1, 2], abs=EXACT)


def test_momentum_and_energy_of_unequal_masses_are_kept():
    u, v = velocities_after(Bounce(masses={"left": 3, "right": "1/2"}))

    assert 3 * u + v / 2 == pytest.approx(3 * 2 - 1 / 2, abs=4 * EXACT)
    assert 3 * u * u + v * v / 2 == pytest.approx(3 * 4 + 1 / 2, abs=20 * EXACT)
    assert u < v


def test_restitution_is_the_ratio_of_speeds():
    u, v = velocities_after(Bounce(restitution="1/4"))

    assert v - u == pytest.approx(3 / 4, abs=2 * EXACT)
    assert u + v == pytest.approx(1, abs=2 * EXACT)


def test_without_restitution_bodies_part_slowly():
    u, v = velocities_after(Bounce(restitution=0, slowest="1/8"))

    assert v - u == pytest.approx(1 / 8, abs=2 * EXACT)


def test_a_fixed_body_is_infinitely_heavy():
    u, v = velocities_after(Bounce(fixed=["right"], masses={"left": 100}), v=0)

    assert (u, v) == (pytest.approx(-2, abs=EXACT), 0)


def test_a_bounce_that_was_pickled_is_the_same():
    bounce = Bounce(restitution="1/2", masses={"left": 3})

    assert velocities_after(pickle.loads(pickle.dumps(bounce))) == velocities_after(bounce)


@every(
    "options, message",
    [
        ({"restitution": 2}, "restitution: not between 0 and 1: 2"),
        ({"restitution": "-1/2"}, "restitution: not between 0 and 1"),
        ({"masses": {"left": 0}}, "the mass of 'left': not positive: 0"),
        (
            {"masses": {"left": "1e-400"}},
            "the mass of 'left': beyond the range of doubles: '1e-400'",
        ),
        ({"masses": {"left": "1e400"}}, "the mass of 'left': beyond the range of doubles"),
        ({"masses": {"left": 10**5000}}, "beyond the range of doubles: 1000000"),
        ({"slowest": "1e-400"}, "slowest: beyond the range of doubles"),
        ({"fastest": "1e400"}, "fastest: beyond the range of doubles"),
    ],
)
def test_options_out_of_range_are_refused(options, message):
    with pytest.raises(InputError, match=message):
        Bounce(**options)


@pytest.mark.parametrize("mass", [5e-324, 1e-308, 1, 1e308])
def test_bug_only_the_ratio_of_masses_matters(mass):
    """Neither the inverse of the least double is a double, nor twice the largest."""
    assert velocities_after(Bounce(masses={"left": mass, "right": mass})) == [-1, 2]


@pytest.mark.parametrize("light, heavy", [(5e-324, 1), (1, 1e308), (5e-324, 1e308)])
def test_bug_a_body_much_heavier_than_another_goes_on(light, heavy):
    assert velocities_after(Bounce(masses={"left": light, "right": heavy})) == [-4, -1]
    assert velocities_after(Bounce(masses={"left": heavy, "right": light})) == [2, 5]


def test_bug_a_velocity_beyond_the_doubles_is_told():
    size = 10**308
    left = Body("left", [(x * size, y * size) for x, y in BOX], Velocity(size, 0))
    right = Body("right", [((x + 10) * size, y * size) for x, y in BOX], Velocity(-size, 0))
    simulation = Simulation(Scene([left, right], time=(0, 20)))

    with pytest.raises(InputError, match="body 'left': its velocity after the bounce is beyond"):
        list(simulation.run(on_contact=Bounce()))


def test_a_mass_of_no_body_is_refused():
    with pytest.raises(InputError, match="Bounce: masses: there is no body 'lfet'"):
        velocities_after(Bounce(masses={"lfet": 2}))


def test_a_ball_comes_back_from_a_corner_of_a_frame():
    wide = [(-25, -25), (25, -25), (25, 25), (-25, 25)]
    narrow = [(-21, -21), (21, -21), (21, 21), (-21, 21)]
    ball = Body("ball", [(-5, -4), (-3, -3)], Translation([0, 3], [0, 3]))
    simulation = Simulation(Scene([ball, Body("frame", wide, holes=[narrow])], time=(0, 20)))
    contacts = [
        e for e in simulation.run(on_contact=Bounce(fixed=["frame"])) if e.kind == "contact"
    ]

    assert [e.time for e in contacts] == [8]
    motion = simulation.body("ball").motion
    assert (motion.x.coefficients[1], motion.y.coefficients[1]) == (-3, -3)


@pytest.mark.parametrize(
    "at, velocity, after",
    [((-40, 15), (3, 0), (-5, 0)), ((-20, 10), (-3, 0), (1, 0))],
    ids=["outline", "hole"],
)
def test_bug_the_last_edge_of_a_ring_ends_at_its_first_vertex(at, velocity, after):
    """The frame grows: each coordinate 25 by 1 a second, each 21 of its hole too.

    So the last edges of the rings, at x = -25 and x = -21, move to the left with speed 1 in each of
    their points. A ball with velocity u on the axis leaves with -2 - u. The hole's last edge taken
    to end at another vertex would have another velocity beside the ball.
    """
    rings = [
        [{"x": [x * size, x], "y": [y * size, y]} for x, y in [(-1, -1), (1, -1), (1, 1), (-1, 1)]]
        for size in (25, 21)
    ]
    frame = Body("frame", rings[0], holes=[rings[1]])
    ball = Body("ball", [at], Velocity(*velocity))
    simulation = Simulation(Scene([frame, ball], (0, 9)))
    events = simulation.run(on_contact=Bounce(fixed=["frame"]))

    assert next(events).kind == "contact"
    now = simulation.now.low
    found = simulation.body("ball").velocity_at(now)[0]
    assert found == pytest.approx(after, abs=EXACT)


@pytest.mark.long
@pytest.mark.parametrize("tiling", ["greedy", "lazy"])
def test_numbers_do_not_grow_from_bounce_to_bounce(tiling):
    from bouncing_box import WALLS, box, digits

    simulation = Simulation(box(8, 0, 1, 10**6), tiling=tiling)
    bounce, sizes = Bounce(WALLS, fastest=16), []

    def respond(run, contact):
        bounce(run, contact)
        sizes.append(digits(run.scene, run.now.low))

    time = 0
    while simulation.contacts < 100:
        time += 1
        list(simulation.run(time, on_contact=respond))
        assert simulation.contact is None
    quarter = len(sizes) // 4

    assert max(sizes[-quarter:]) <= max(sizes[quarter : 2 * quarter]) + 16


def test_velocities_are_exact_also_of_vertices_that_turn():
    ball = Body("ball", BOX, Translation([0, 1, "1/3"], [5, -2]))
    wheel = Body("wheel", BOX, Rigid([0, 1], x=[0, 3]))

    assert ball.velocity_at(2) == [(Fraction(7, 3), -2)] * 4
    # Half the angle has the tangent t: the body turns by 2 radians a second at t = 0.
    assert wheel.velocity_at(0) == [(3, 0), (3, 2), (1, 2), (1, 0)]
    h = Fraction(1, 10**9)
    before, after = wheel.at(1 - h)[2], wheel.at(1 + h)[2]
    for k in (0, 1):
        assert abs((after[k] - before[k]) / (2 * h) - wheel.velocity_at(1)[2][k]) < 10 * h


def test_momentum_and_kinetic_energy_have_the_masses_of_a_bounce():
    bodies = [
        Body("left", BOX, Velocity(2, 1)),
        Body("right", [(x + 10, y) for x, y in BOX], Velocity(-1, 1)),
        Body("wall", [(30, -9), (30, 9)], Velocity(-1, 0)),
    ]
    bounce = Bounce(["wall"], masses={"left": 3, "right": "1/2"})
    simulation = Simulation(Scene(bodies, time=(0, 20)))

    assert bounce.momentum(simulation) == (Fraction(11, 2), Fraction(7, 2))
    assert bounce.kinetic_energy(simulation) == Fraction(15, 2) + Fraction(1, 2)

    list(simulation.run(5, on_contact=bounce))
    assert simulation.contacts == 1
    assert float(bounce.momentum(simulation)[0]) == pytest.approx(5.5, abs=4 * EXACT)
    assert float(bounce.kinetic_energy(simulation)) == pytest.approx(8, abs=20 * EXACT)


def test_bug_masses_that_are_no_doubles_count_exactly_in_momentum_and_energy():
    """They were rounded to doubles first."""
    scene = Scene([Body("left", BOX, Velocity(3, 0))], time=(0, 20))
    bounce = Bounce(masses={"left": "1/3"})

    for one in (bounce, pickle.loads(pickle.dumps(bounce))):
        assert one.momentum(Simulation(scene)) == (1, 0)
        assert one.kinetic_energy(Simulation(scene)) == Fraction(3, 2)


def test_bug_an_event_time_of_degree_three_that_is_rational_counts_as_rational():
    """It was refused as irrational, as it had not been recognised yet."""
    rising = Body("rising", [(0, 0)], Translation([0], [0, -1, 0, 1]))
    others = [Body("left", [(-5, "80/27")]), Body("right", [(5, "80/27")])]
    simulation = Simulation(Scene([rising, *others], time=(0, 2)))
    simulation.step()

    assert Bounce().momentum(simulation) == (0, Fraction(22, 3))
    assert simulation.now == Fraction(5, 3)


def test_energy_at_an_irrational_time_needs_constant_velocities():
    falling = Body("falling", BOX, Translation([0, 0], [0, 0, -1]))
    floor = Body("floor", [(-9, -2), (9, -2)])
    linear = Scene([Body("ball", BOX, Velocity(1, 0)), Body("far", BOX, Velocity(1, 9))], (0, 1))
    bounce = Bounce(["floor"])
    simulation = Simulation(Scene([falling, floor], time=(0, 20)))
    contact = simulation.run_to_contact()

    assert not contact.time.is_rational
    with pytest.raises(InputError, match=r"'falling': its velocity at the irrational time 1\.414"):
        bounce.kinetic_energy(simulation)
    assert Bounce().momentum(Simulation(linear)) == (2, 9)


@pytest.mark.parametrize("exponent", [-200, 200])
def test_bounces_at_sizes_whose_squares_are_no_doubles(exponent):
    size = Fraction(10) ** exponent
    shape = [(0, size), (size, 2 * size), (-size, 2 * size)]
    ball = Body("ball", shape, Translation(0, [0, -size]))
    floor = Body("floor", [(-5 * size, 0), (5 * size, 0)])
    simulation = Simulation(Scene([ball, floor], (0, 4)))
    bounce = Bounce(fixed=["floor"], slowest=size / 16, grid=size / 2**20)

    events = list(simulation.run(on_contact=bounce))

    assert [event.kind for event in events] == ["contact", "motion"]
    assert simulation.body("ball").motion.y.derivative()(2) > 0


def test_push_on_an_edge_far_away_is_where_it_touches():
    """A board that tilts, at 10^20, where doubles are 16384 apart: hit at three quarters.

    That is at t = 12/5, the edge as (4, -12/5), where its point has the velocity (0, -3/4).
    """
    far = 10**20
    board = Body("board", [(far, 0), {"x": [far + 4], "y": [0, -1]}])
    ball = Body("ball", [(far + 3, 3), (far + 4, 4), (far + 2, 4)], Translation(0, [0, -2]))
    simulation = Simulation(Scene([board, ball], (0, 9)))

    list(simulation.run("5/2", on_contact=Bounce(fixed=["board"])))

    assert simulation.contacts == 1
    vx, vy = map(float, simulation.body("ball").velocity_at(3)[0])
    length = (4**2 + 2.4**2) ** 0.5
    nx, ny = 2.4 / length, 4 / length
    assert nx * vx + ny * (vy + 0.75) == pytest.approx(ny * 1.25, rel=1e-4)


@pytest.mark.parametrize("time", ["1/2", 2, "5/2", 7])
@pytest.mark.parametrize(
    "motion",
    [
        Translation([1, 2, 3], [0, 1]),
        Rigid([0, 1], pivot=(1, 1), x=[0, 1]),
        Affine([[[1, 1], [0]], [[0], [1, 1]]], x=[0, 5]),
        Pieces([(2, Translation([0, 1])), (3, Translation([2])), (None, Translation([-1, 1]))]),
    ],
    ids=["translation", "rigid", "affine", "pieces"],
)
def test_onward_goes_on_from_where_the_body_is(motion, time):
    """With a velocity on the grid of 1/4: 1/3 becomes 1/4, of which it is 1/12 away."""
    body = Body("b", [(0, 0), (2, 0), (0, 1)], motion)

    new = body.with_motion(onward(body, time, ("1/3", -2), grid="1/4"))

    assert new.at(time) == body.at(time)
    if not isinstance(motion, (Rigid, Affine)):
        assert new.velocity_at(time) == [(Fraction(1, 4), -2)] * 3
