"""New motions on the way: the tiling is still the static one, and the work is local."""

from random import Random

import pytest

from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.motions import Pieces, Rigid, Translation
from exactpt.scene.scene import Scene
from exactpt.simulation.motion_changes import onward
from exactpt.simulation.simulation import Simulation
from exactpt.testing.audits import audit_at
from exactpt.testing.scenes.shapes import convex_polygon
from exactpt.testing.scenes.simple import star


def crowd(rng, count, *, stars=False, spacing=100, end=1000):
    """Bodies at rest on a square grid of cells."""
    width = 1
    while width * width < count:
        width += 1
    bodies = []
    for i in range(count):
        c = (QQ(spacing * (i % width)), QQ(spacing * (i // width)))
        size = rng.randint(3, 8)
        if stars and i % 2:
            outline = star(rng, c, 40, size + 1)
            try:
                Scene([Body("x", outline)])
            except InputError:
                outline = convex_polygon(rng, c, 30, size)
        elif i % 7 == 3:
            outline = [c]
        elif i % 7 == 5:
            outline = [c, (c[0] + rng.randint(5, 30), c[1] + rng.randint(-30, 30))]
        else:
            outline = convex_polygon(rng, c, 30, size)
        bodies.append(Body(f"b{i}", outline))
    return Scene(bodies, (0, end))


def turn_back(simulation, contact):
    """Whatever touches goes back the way it came."""
    t = simulation.now.low
    plans = {}
    for pair in contact.pairs:
        for name in (pair.body, pair.other):
            body = simulation.body(name)
            if isinstance(body.motion, Translation):
                v = [f.derivative()(t) for f in (body.motion.x, body.motion.y)]
                plans[name] = onward(body, t, (-v[0], -v[1]))
            else:
                plans[name] = stopped(body, t)
    simulation.set_motions(plans)


def stopped(body, t):
    """The body at rest where it is."""
    return Body(body.name, body.at(t), closed=body.closed)


def some_plan(rng, body, t, *, deform=False, rigid=False):
    """Another velocity; or a turn about a vertex; or, to deform, each vertex for itself."""
    kind = rng.randrange(8)
    v = rng.randint(-20, 20), rng.randint(-20, 20)
    if kind == 0:
        return stopped(body, t)
    rest = body.at(t)
    if kind == 1 and body.size > 1 and not rigid:
        pivot = rest[0]
        half = Polynomial([-t * QQ(1, 8), QQ(1, 8)])
        x, y = Polynomial([-v[0] * t, v[0]]), Polynomial([-v[1] * t, v[1]])
        return Body(body.name, rest, Rigid(half, pivot=pivot, x=x, y=y), closed=body.closed)
    if kind == 2 and deform and body.size > 2:
        vertices = []
        for x, y in rest:
            a, b = rng.randint(-3, 3) + v[0], rng.randint(-3, 3) + v[1]
            vertices.append((Polynomial([x - a * t, a]), Polynomial([y - b * t, b])))
        return Body(body.name, vertices, closed=body.closed)
    if kind == 3:
        end = t + QQ(rng.randint(1, 8), 4)
        line = Translation([-v[0] * t, v[0]], [-v[1] * t, v[1]])
        reach = line.x(end), line.y(end)
        back = Translation([reach[0] + v[0] * end, -v[0]], [reach[1] + v[1] * end, -v[1]])
        return Body(body.name, rest, Pieces([(end, line), (None, back)]), closed=body.closed)
    line = Translation([-v[0] * t, v[0]], [-v[1] * t, v[1]])
    return Body(body.name, rest, line, closed=body.closed)


def audit(simulation):
    """The tiling just after now is the one that is built there."""
    kinetic = simulation.kinetic
    end = kinetic.next_number() or AlgebraicNumber(simulation.scene.end)
    if kinetic.now.compare(end) < 0:
        audit_at(kinetic, rational_between(kinetic.now, end))


def change_motions(scene, tiling, rng, changes, audits, *, deform=False, rigid=False):
    """Random changes at random times, some at one time; the mean of certificates touched."""
    simulation = Simulation(scene, tiling=tiling)
    names = [body.name for body in scene.bodies]
    t = scene.start
    touched = []
    for i in range(changes):
        if rng.random() < 0.7:
            t += QQ(rng.randint(1, 16), 64)
        for _ in simulation.run(t, on_contact=turn_back):
            pass
        assert simulation.contact is None
        certifier = simulation.kinetic.certifier
        before = certifier.made + certifier.skipped
        name = rng.choice(names)
        plan = some_plan(rng, simulation.body(name), t, deform=deform, rigid=rigid)
        simulation.set_motion(name, plan)
        if simulation.kinetic.certifier is certifier:
            touched.append(certifier.made + certifier.skipped - before)
        if i % (changes // audits) == 0:
            audit(simulation)
    assert not simulation.scene.end < t
    return simulation, sum(touched) / len(touched)


@pytest.mark.long(
    "rigid-convex-mixed",
    "rigid-stars-greedy",
    "rigid-stars-mixed",
    "deforming-convex-mixed",
    "deforming-stars-mixed",
)
@pytest.mark.parametrize("tiling", ["greedy", "lazy", "mixed"])
@pytest.mark.parametrize("stars", [False, True], ids=["convex", "stars"])
@pytest.mark.parametrize("deform", [False, True], ids=["rigid", "deforming"])
def test_after_new_plans_the_tiling_is_the_static_one(tiling, stars, deform):
    """Of any kind, at any time; several at one time; after contacts, too."""
    rng = Random("plans")
    simulation, _ = change_motions(crowd(rng, 9, stars=stars), tiling, rng, 24, 12, deform=deform)

    assert simulation.stats["plans"] >= 24


@pytest.mark.slow
@pytest.mark.parametrize("tiling", ["greedy", "lazy", "mixed"])
def test_after_many_new_plans_the_tiling_is_the_static_one(tiling):
    """Stars among convex bodies, deforming and turning, bouncing off each other."""
    contacts = 0
    for seed in range(6):
        rng = Random(f"many:{seed}")
        scene = crowd(rng, 10, stars=seed % 2 == 0, spacing=80)
        simulation, _ = change_motions(scene, tiling, rng, 100, 50, deform=seed % 3 == 0)
        contacts += simulation.contacts

    assert contacts > 10


@pytest.mark.slow
def test_ten_thousand_new_plans_of_two_hundred_bodies():
    """The structure equals the static one after 500 of them."""
    rng = Random("ten thousand")
    scene = crowd(rng, 200, end=10**6)
    simulation, mean = change_motions(scene, "greedy", rng, 10_000, 500, rigid=True)

    print(f"{mean:.1f} certificates touched a change;", simulation.stats)  # noqa: T201
    assert simulation.stats["plans"] >= 10_000
    assert mean < 100


@pytest.mark.long
@pytest.mark.parametrize("tiling", ["greedy", "lazy", "mixed"])
def test_a_new_plan_costs_what_the_body_has_in_certificates(tiling):
    """Locality: a larger scene does not make a change dearer."""
    means = []
    for count in (9, 49):
        rng = Random(f"locality:{count}")
        _, mean = change_motions(crowd(rng, count, end=10**4), tiling, rng, 24, 1)
        means.append(mean)

    assert means[1] < 2 * means[0]


def two_boxes():
    left = Body("left", [(0, 0), (1, 0), (1, 1), (0, 1)], Translation([0, 1]))
    right = Body("right", [(9, 0), (10, 0), (10, 1), (9, 1)])
    return Simulation(Scene([left, right], (0, 100)))


def at(simulation, t):
    for _ in simulation.run(t):
        pass
    return simulation


def test_a_plan_that_jumps_is_refused():
    simulation = at(two_boxes(), 2)
    with pytest.raises(InputError, match=r"vertex 0 jumps at t = 2 from \(2, 0\) to \(0, 0\)"):
        simulation.set_motion("left", Translation())
    simulation.set_motion("left", Translation([2]))
    assert simulation.run_to_contact() is None


def test_plans_that_are_for_another_body_are_refused():
    simulation = at(two_boxes(), 2)
    with pytest.raises(InputError, match="no body 'middle'"):
        simulation.set_motion("middle", Translation())
    with pytest.raises(InputError, match="is not a motion of"):
        simulation.set_motion("left", Body("left", [(0, 0), (1, 0), (1, 1)]))


def test_plans_change_at_rational_times_before_the_end_only():
    simulation = at(two_boxes(), 100)
    with pytest.raises(InputError, match="ended with a contact"):
        simulation.set_motion("left", Translation())
    fall = Body("fall", [(0, 9)], Translation([0, 1], [1, 0, -1]))
    simulation = Simulation(Scene([fall, Body("low", [(0, 7)]), Body("high", [(6, 7)])], (0, 3)))
    while simulation.now.is_rational:
        assert simulation.step()
    with pytest.raises(InputError, match="rational times only"):
        simulation.set_motion("low", Translation())
    with pytest.raises(InputError, match="is not rational: give a rational time after it"):
        simulation.locate((0, 0))
    with pytest.raises(InputError, match="end of the time span"):
        at(simulation, 3).set_motion("low", Translation())


def test_a_contact_after_a_new_plan_is_exact():
    """From 2 at speed 1/3: at 9 - 1 after 18 more."""
    simulation = at(two_boxes(), 2)
    simulation.set_motion("left", Translation([QQ(4, 3), QQ(1, 3)]))

    assert simulation.run_to_contact().time == 20
    assert simulation.contact.kind == "vertex-vertex"
    assert [event.kind for event in simulation.run()] == ["motion", "contact"]


@pytest.mark.long("mixed")
@pytest.mark.parametrize("tiling", ["greedy", "lazy", "mixed"])
def test_bodies_come_and_go(tiling):
    rng = Random("come and go")
    scene = crowd(rng, 9, stars=True)
    simulation = Simulation(scene, tiling=tiling)
    bodies = {body.name: body for body in scene.bodies}
    for i in range(12):
        at(simulation, i)
        name = f"b{i % 9}"
        if i % 2:
            simulation.add(Body(name, bodies[name].vertices))
        else:
            simulation.remove(name)
            name = f"b{(i + 1) % 9}"
            if name in {body.name for body in simulation.scene.bodies}:
                simulation.remove(name)
            simulation.add(Body(name, bodies[name].vertices))
            simulation.add(Body(f"b{i % 9}", bodies[f"b{i % 9}"].vertices))
            simulation.remove(f"b{(i + 1) % 9}")
        audit(simulation)

    assert simulation.stats["plans"] >= 24


def test_what_is_added_must_be_apart():
    simulation = at(two_boxes(), 2)
    with pytest.raises(InputError, match="body 'new' touches body 'left' at t = 2"):
        simulation.add(Body("new", [(3, 0), (4, -1), (4, 1)]))
    with pytest.raises(InputError, match="taken"):
        simulation.add(Body("left", [(30, 0)]))
    with pytest.raises(InputError, match="not a simple polygon"):
        simulation.add(Body("bow", [(30, 0), (40, 1), (40, 0), (30, 1)]))
    simulation.add(Body("new", [(5, 0)]))
    assert simulation.run_to_contact().time == 4


def plates():
    """A plate with a hole that holds 9 bodies, two holes beside each other, and a wall."""
    inside = crowd(Random("plates"), 9, stars=True).bodies
    plate = Body(
        "plate", [(-99, -99), (300, -99), (300, 300), (-99, 300)],
        holes=[[(-60, -60), (260, -60), (260, 260), (-60, 260)]],
    )  # fmt: skip
    two = Body(
        "two", [(500, 0), (800, 0), (800, 300), (500, 300)],
        holes=[[(510, 10), (600, 100), (510, 290)], [(620, 10), (790, 10), (790, 290)]],
    )  # fmt: skip
    return Scene([plate, two, *inside, Body("wall", [(450, 0), (451, 200), (440, 99)])], (0, 9))


@pytest.mark.long("mixed")
@pytest.mark.parametrize("tiling", ["greedy", "lazy", "mixed"])
def test_bodies_come_and_go_beside_holes(tiling):
    """Only the mixed tiling is built anew, where geodesics of a hole change."""
    new = Body("new", [(98, 145), (102, 147), (100, 149)], Translation([0, "1/64"]))
    alone = Body("alone", [(700, 50), (720, 50), (720, 60)])
    simulation = Simulation(plates(), tiling=tiling)
    seen = []
    for i, body in enumerate([new, alone, simulation.body("b4"), simulation.body("wall")]):
        at(simulation, i)
        before = simulation.stats["rebuilds"]
        for _ in range(2):
            if any(b.name == body.name for b in simulation.scene.bodies):
                simulation.remove(body.name)
            else:
                simulation.add(body)
            audit(simulation)
        seen.append(simulation.stats["rebuilds"] - before)

    assert seen == ([0, 2, 0, 0] if tiling == "mixed" else [0, 0, 0, 0])


def test_a_body_added_in_a_plate_touches_it():
    simulation = Simulation(plates())
    with pytest.raises(InputError, match="touches body 'plate' at t = 0"):
        simulation.add(Body("new", [(-90, -90), (-80, -90), (-80, -80)]))
    with pytest.raises(InputError, match="touches body 'two' at t = 0"):
        simulation.add(Body("new", [(550, 9), (560, 20), (555, 30)]))
    with pytest.raises(InputError, match="touches body 'plate' at t = 0"):
        simulation.add(Body("new", [(-500, -500), (900, -500), (900, 900), (-500, 900)]))
