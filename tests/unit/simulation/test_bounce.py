"""Bounces with restitution and masses: momentum and energy of two bodies on a line."""

import pickle
from fractions import Fraction
from random import Random

import pytest
from folding import every

from exactpt import (
    Body,
    Bounce,
    InputError,
    Rigid,
    Scene,
    Simulation,
    Translation,
    Velocity,
    first_contact,
)
from exactpt.kernel.numbers import QQ
from exactpt.simulation.responses import _velocity_beside
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement

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


SHAPES = {
    "point": [(0, 0)],
    "segment": [(0, 0), (3, 1)],
    "square": [(0, 0), (4, 0), (4, 4), (0, 4)],
    "triangle": [(0, 0), (5, 1), (1, 3)],
    "L": [(0, 0), (9, 0), (9, 2), (2, 2), (2, 9), (0, 9)],
    "hook": [(0, 0), (6, 0), (6, 5)],
    "star": [(0, 6), (-1, 1), (-6, 0), (-1, -1), (0, -6), (1, -1), (6, 0), (1, 1)],
}


def vertex_on_vertex(random):
    """A body of which a vertex comes to a vertex of a wall at t = 8; None if it comes elsewhere."""
    (a, p), (b, q) = (random.choice(list(SHAPES.items())) for _ in range(2))
    u, v = (random.choice((-3, -2, -1, 1, 2, 3)) for _ in range(2))
    (x, y), (z, w) = random.choice(p), random.choice(q)
    path = [(px - x + z - 8 * u, py - y + w - 8 * v) for px, py in p]
    scene = Scene(
        [
            Body("body", path, Translation([0, u], [0, v]), closed=a != "hook"),
            Body("wall", q, closed=b != "hook"),
        ],
        time=(0, 20),
    )
    contact = first_contact(scene)
    alone = contact and [pair.kind for pair in contact.pairs] == ["vertex-vertex"]
    return scene if alone and contact.time == 8 else None


@pytest.mark.long
def test_a_vertex_that_meets_a_vertex_goes_on():
    """At the end of a wall, in an inner corner, corner on corner."""
    random = Random(1)
    scenes = [scene for _ in range(300) if (scene := vertex_on_vertex(random))]

    assert len(scenes) > 60
    for scene in scenes:
        simulation = Simulation(scene)
        for _ in simulation.run(on_contact=Bounce(fixed=["wall"])):
            pass
        assert simulation.contact is None
        assert simulation.now == 20


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


@pytest.mark.parametrize("edge, at", [(3, (-25, 10)), (7, (-21, -20)), (1, (25, 7))])
def test_bug_the_last_edge_of_a_ring_ends_at_its_first_vertex(edge, at):
    """Turning at one radian a second, the point (x, y) of an edge has the velocity (-y, x)."""
    wide = [(-25, -25), (25, -25), (25, 25), (-25, 25)]
    narrow = [(-21, -21), (21, -21), (21, 21), (-21, 21)]
    frame = Body("frame", wide, Rigid([0, "1/2"]), holes=[narrow])
    ball = Body("ball", [at, (0, 0)])

    assert _velocity_beside(frame, edge, (ball, 0), QQ(0)) == (-at[1], at[0])


WALLS = [
    Body("floor", [(-1, -1), (9, -1)]),
    Body("ceiling", [(-1, 9), (9, 9)]),
    Body("left wall", [(-2, 0), (-2, 8)]),
    Body("right wall", [(10, 0), (10, 8)]),
]


def room(rng):
    """Return four bodies in a room of four walls with open corners."""
    bodies = []
    for i, (x, y) in enumerate([(0, 0), (5, 0), (0, 5), (5, 5)]):
        shape = rng.choice([[(0, 0)], [(0, 0), (2, 1)], BOX, [(0, 0), (2, 0), (0, 2)]])
        velocity = Velocity(rng.randint(-3, 3), rng.randint(-3, 3))
        bodies.append(Body(f"b{i}", [(x + u, y + v) for u, v in shape], velocity))
    return Scene([*WALLS, *bodies], (0, 3))


@pytest.mark.long
@pytest.mark.parametrize("tiling", ["lazy", "greedy"])
def test_each_contact_of_a_run_is_that_of_all_pairs(tiling):
    """Of the scene that goes on from the last response."""
    contacts = 0
    for seed in range(6):
        simulation = Simulation(room(Random(seed)), tiling=tiling)
        bounce, ahead = Bounce(fixed=[wall.name for wall in WALLS]), [simulation.scene]

        def respond(run, contact, ahead=ahead, bounce=bounce):
            expected = reference.first_contact(ahead.pop())
            assert disagreement(expected, contact) is None
            bounce(run, contact)
            ahead.append(Scene(run.scene.bodies, (run.now, run.scene.end)))

        list(simulation.run(on_contact=respond))
        contacts += simulation.contacts
        assert reference.first_contact(ahead.pop()) is None
    assert contacts > 30


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
