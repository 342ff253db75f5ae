"""New motions on the way: the tiling is still the static one, and the work is local."""

from random import Random

import pytest
from tiling.audits import audit_at

import exactpt
from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.motions import Pieces, Rigid, Translation
from exactpt.scene.families.shapes import convex_polygon
from exactpt.scene.families.simple import star
from exactpt.scene.scene import Scene
from exactpt.simulation.plans import onward
from exactpt.simulation.simulation import Simulation


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


def some_plan(rng, body, t, *, deform=False):
    """Another velocity; or a turn about a vertex; or, to deform, each vertex for itself."""
    kind = rng.randrange(8)
    v = rng.randint(-20, 20), rng.randint(-20, 20)
    if kind == 0:
        return stopped(body, t)
    rest = body.at(t)
    if kind == 1 and body.size > 1:
        pivot = rest[0]
        shape = [(round(x - pivot[0]), round(y - pivot[1])) for x, y in rest]
        del shape
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


def rounded_rest(body, t):
    return body


def audit(simulation):
    """The tiling just after now is the one that is built there."""
    kinetic = simulation.kinetic
    following = kinetic.next_time()
    end = AlgebraicNumber(simulation.scene.end)
    if following is not None:
        end = following.exact or kinetic.certifier.resolve(following)
    if kinetic.now.compare(end) < 0:
        audit_at(kinetic, rational_between(kinetic.now, end))


def change_plans(scene, tiling, rng, changes, audits, *, deform=False):
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
        plan = some_plan(rng, simulation.body(name), t, deform=deform)
        simulation.set_motion(name, plan)
        if simulation.kinetic.certifier is certifier:
            touched.append(certifier.made + certifier.skipped - before)
        if i % (changes // audits) == 0:
            audit(simulation)
    assert not simulation.scene.end < t
    return simulation, sum(touched) / len(touched)


@pytest.mark.parametrize("tiling", ["greedy", "lazy", "mixed"])
@pytest.mark.parametrize("stars", [False, True], ids=["convex", "stars"])
@pytest.mark.parametrize("deform", [False, True], ids=["rigid", "deforming"])
def test_after_new_plans_the_tiling_is_the_static_one(tiling, stars, deform):
    for seed in range(2):
        rng = Random(f"plans:{seed}")
        scene = crowd(rng, 12, stars=stars)
        simulation, _ = change_plans(scene, tiling, rng, 60, 30, deform=deform)
        assert simulation.stats["plans"] >= 60
