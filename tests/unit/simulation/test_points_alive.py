"""Points whose plans change, that bounce, and whose run is saved: the structure is kept."""

import json
from itertools import combinations
from random import Random

import pytest

from exactpt import Body, Pieces, Scene, Simulation, Translation, onward
from exactpt.kernel.numbers import QQ
from exactpt.testing.scenes import POINTS, generate
from tests.unit.simulation.test_motion_changes import audit, turn_back
from tests.unit.simulation.test_save import check


def swarm(rng, count, *, size=1000, speed=40, end=10**4):
    cells = rng.sample(range(size * size), count)
    bodies = []
    for i, cell in enumerate(cells):
        v = [[0, rng.randint(-speed, speed)] for _ in range(2)]
        bodies.append(Body(f"p{i}", [divmod(cell, size)], Translation(*v)))
    return Scene(bodies, (0, end))


def some_plan(rng, body, t, speed):
    """A new velocity; or a fall; or there and back."""
    (x, y), kind = body.at(t)[0], rng.randrange(4)
    v, w = rng.randint(-speed, speed), rng.randint(-speed, speed)
    line = [x - v * t, v], [y - w * t, w]
    if kind == 0:
        fall = [line[1][0] - t * t, w + 2 * t, -1]
        return Body(body.name, [{"x": line[0], "y": fall}])
    rest = Body(body.name, [(x, y)])
    if kind == 1:
        s = t + QQ(rng.randint(1, 8), 4)
        there = Translation([-v * t, v], [-w * t, w])
        back = Translation([2 * v * s - v * t, -v], [2 * w * s - w * t, -w])
        return Body(body.name, rest.vertices, Pieces([(s, there), (None, back)]))
    return Body(body.name, [{"x": line[0], "y": line[1]}])


def change_motions(scene, rng, changes, audits, *, speed):
    """Random plans at random times; the mean number of certificates touched by one."""
    simulation = Simulation(scene)
    assert simulation.name == "incremental"
    kinetic, t, touched = simulation.kinetic, scene.start, 0
    for i in range(changes):
        if rng.random() < 0.7:
            t += QQ(rng.randint(0, 8), 64)
        for _ in simulation.run(t, on_contact=turn_back_points):
            pass
        assert simulation.contact is None
        name = f"p{rng.randrange(len(scene.bodies))}"
        before = kinetic.certifier.made + kinetic.certifier.skipped
        simulation.set_motion(name, some_plan(rng, simulation.body(name), t, speed))
        touched += kinetic.certifier.made + kinetic.certifier.skipped - before
        if i % (changes // audits) == 0:
            audit(simulation)
    assert simulation.kinetic is kinetic
    return simulation, touched / changes


def turn_back_points(simulation, contact):
    """Whatever touches goes back, or on in another way."""
    t = simulation.now.low
    names = {name for pair in contact.pairs for name in (pair.body, pair.other)}
    plans = {}
    for k, name in enumerate(sorted(names)):
        p = simulation.body(name).at(t)[0]
        plans[name] = Body(name, [{"x": [p[0] - (k - 2) * t, k - 2], "y": [p[1] - k * t, k]}])
    simulation.set_motions(plans)


@pytest.mark.parametrize("size", [6, 1000])
def test_after_new_plans_the_points_are_tiled_as_they_are_statically(size):
    """In a crowded grid (many vanish at one time) and in a wide one."""
    rng = Random(f"points {size}")
    speed = 2 if size == 6 else 400
    simulation, _ = change_motions(
        swarm(rng, 12, size=size, speed=speed), rng, 120, 60, speed=speed
    )  # fmt: skip

    assert simulation.stats["plans"] >= 120
    assert simulation.stats["events"] > 200


@pytest.mark.slow
def test_after_a_thousand_new_plans_the_points_are_tiled_as_they_are_statically():
    for size, count in ((8, 16), (1000, 60)):
        rng = Random(f"many points {size}")
        speed = 2 if size == 8 else 400
        scene = swarm(rng, count, size=size, speed=speed)
        change_motions(scene, rng, 1000, 500, speed=speed)


def test_a_new_plan_of_a_point_costs_what_it_has_in_certificates():
    """Locality: nearly the same among 400 points as among 25."""
    means = []
    for count in (25, 400):
        rng = Random(f"point locality {count}")
        _, mean = change_motions(swarm(rng, count, size=10**5), rng, 40, 1, speed=40)
        means.append(mean)

    assert means[1] < 2 * means[0]
    assert means[1] < 30


def test_points_bounce_and_keep_their_tiling():
    """Before each contact the points are apart, exactly; the tiling is not exchanged."""

    def respond(simulation, contact):
        turn_back(simulation, contact)
        t = simulation.now.low
        places = [tuple(body.at(t)[0]) for body in simulation.scene.bodies]
        assert all(p != q for p, q in combinations(places, 2))
        audit(simulation)

    contacts = 0
    for seed in range(6):
        simulation = Simulation(swarm(Random(f"bouncing {seed}"), 14, size=5, speed=1, end=40))
        list(simulation.run(on_contact=respond))
        assert simulation.name == "incremental"
        assert simulation.now == 40
        contacts += simulation.contacts
    assert contacts > 15


@pytest.mark.long
@pytest.mark.parametrize("family", sorted(POINTS))
def test_a_restored_run_of_points_has_the_same_log(family, tmp_path):
    for seed in range(3):
        rng = Random(f"{family}:{seed}")
        check(generate(family, seed), "incremental", rng, tmp_path / "run.json", 3,
              exact_only=seed == 2)  # fmt: skip


@pytest.mark.slow
def test_a_restored_run_of_points_has_the_same_log_at_a_hundred_moments(tmp_path):
    moments = seed = 0
    while moments < 100:
        for family in POINTS:
            rng = Random(f"{family}:{seed}")
            moments += check(
                generate(family, seed), "incremental", rng, tmp_path / "run.json", 3
            )  # fmt: skip
        seed += 1


@pytest.mark.long
def test_a_run_of_points_with_new_plans_is_saved(tmp_path):
    """Also while chains are searched, after long ones; saved twice, the files are the same."""
    logs = []
    for interrupted in (False, True):
        rng = Random("saved points")
        arc = [Body(f"a{i}", [(-(i * i), 2 * i)]) for i in range(-80, 81)]
        points = [*arc, Body("p", [(40000, 100)]), Body("q", [(39999, -100)])]
        simulation, log = Simulation(Scene(points, (0, 80))), []
        for k in range(40):
            log += [json.dumps(e.to_json()) for e in simulation.run(2 * k)]
            v = -1 if k % 2 else 1
            simulation.set_motion("q", onward(simulation.body("q"), 2 * k, (2 * v, 0)))
            name = f"a{rng.randint(-80, 80)}"
            there = (0, QQ(rng.randint(-1, 1), 400))
            simulation.set_motion(name, onward(simulation.body(name), 2 * k, there))
            if interrupted and k % 7 == 3:
                one, two = tmp_path / "one.json", tmp_path / "two.json"
                simulation.save(one)
                simulation = Simulation.restore(one)
                simulation.save(two)
                assert one.read_bytes() == two.read_bytes()
        log += [json.dumps(e.to_json()) for e in simulation.run()]
        logs.append(log)
        assert simulation.kinetic.chains.kind == "searchable"
    assert logs[0] == logs[1]
