"""Bodies that come and go in the pockets of others, whose geodesics change: `mixed` tilings."""

from random import Random

import pytest

from exactpt import Body, InputError, Scene, Simulation
from exactpt.kernel.numbers import QQ
from tests.unit.simulation.test_motion_changes import audit


def jar(rng, x, y, *, width=40, depth=100, steps=8, down=False):
    """A jar with uneven walls, open above (or below)."""
    left, right = [], []
    for i in range(1, steps + 1):
        level = depth - depth * (i - 1) // steps
        left.append((rng.randint(-3, width // 3), level))
        right.append((width - rng.randint(-3, width // 3), level))
    outline = [(-10, -5), (width + 10, -5), (width + 10, depth + 2), *right, *left[::-1]]
    outline.append((-10, depth + 2))
    if down:
        outline = [(a, depth - b) for a, b in reversed(outline)]
    return [(a + x, b + y) for a, b in outline]


def small(rng, x, y):
    """A point, a segment, a triangle, a small jar."""
    kind = rng.randrange(4)
    if kind == 3:
        return jar(rng, x, y, width=rng.randint(6, 16), depth=rng.randint(5, 25), steps=2)
    return [(x, y), (x + rng.randint(1, 9), y + rng.randint(-9, 9)), (x, y + 3)][: kind + 1]


def crowd_of_jars(rng, count):
    """Jars beside and over each other, and what may come into them."""
    jars, guests = [], []
    for i in range(count):
        low = rng.randint(-30, 30)
        jars.append(Body(f"jar{i}", jar(rng, 70 * i, low, steps=rng.randint(1, 9))))
        for k in range(9):
            shape = small(rng, QQ(70 * i + rng.randint(0, 40)), QQ(low + rng.randint(1, 120)))
            guests.append(Body(f"guest{i}{k}", shape))
    lid = jar(rng, 20, rng.randint(140, 160), width=70, depth=60, down=True)
    return [*jars, Body("lid", lid)], guests


def come_and_go(rng, jars, guests, changes):
    """Guests come and go at random, jars now and then; all tilings are audited."""
    simulation = Simulation(Scene([], (0, 9)), tiling="mixed")
    for body in jars:
        simulation.add(body)
        audit(simulation)
    out, done = guests, 0
    while done < changes:
        here = simulation.scene.bodies[:]
        if rng.random() < 0.95:
            here = [body for body in here if body.name.startswith("guest")]
        if len(here) > rng.randint(0, 9):
            body = rng.choice(here)
            simulation.remove(body.name)
            out.append(body)
        else:
            body = out.pop(rng.randrange(len(out)))
            try:
                simulation.add(body)
            except InputError:
                out.insert(0, body)
                continue
        audit(simulation)
        done += 1
    return simulation


@pytest.mark.long
@pytest.mark.parametrize(
    ("seeds", "changes"), [(3, 40), pytest.param(20, 100, marks=pytest.mark.slow)]
)
def test_in_pockets_the_tiling_is_the_static_one(seeds, changes):
    for seed in range(seeds):
        rng = Random(f"pockets {seed}")
        simulation = come_and_go(rng, *crowd_of_jars(rng, 2), changes)
        assert simulation.stats["rebuilds"] == 0


def hull(simulation, name):
    """The vertices along the relative hull of a body."""
    vertices, mesh = simulation.kinetic.vertices, simulation.kinetic.mesh
    number = [moving.body.name for moving in vertices.bodies].index(name)
    return [vertices.name(v) for v in mesh.relative_hulls()(number)]


def test_a_relative_hull_goes_down_to_a_guest_and_up_again():
    """Nothing of the long way down is next to the guest: its tiles are found on the way."""
    down = [(2 + 5 * (k % 2), 90 - 10 * k) for k in range(9)]
    up = [(x - 4, y) for x, y in reversed(down)]
    outline = [*up, (-9, 91), (-9, -1), (14, -1), (14, 91), *down]
    simulation = Simulation(Scene([Body("well", outline)], (0, 9)), tiling="mixed")
    empty = hull(simulation, "well")
    assert len(empty) == 4
    for _ in range(2):
        simulation.add(Body("guest", [(0, 11), (1, 12), (0, 12)]))
        audit(simulation)
        visited = hull(simulation, "well")
        assert set(empty) | {"guest:0", "guest:1", "guest:2"} < set(visited)
        assert len(visited) > 12
        simulation.remove("guest")
        audit(simulation)
        assert sorted(hull(simulation, "well")) == sorted(empty)
    assert simulation.stats["rebuilds"] == 0


def spiral(turns):
    """A corridor of width 3 between walls of width 1, wound around the origin."""
    inner = [(2, 1.5), (-1.5, 1.5), (-1.5, -1.5), (5.5, -1.5), (5.5, 5.5), (-5.5, 5.5)]
    outer = [(2, 2.5), (-2.5, 2.5), (-2.5, -2.5), (6.5, -2.5), (6.5, 6.5), (-6.5, 6.5)]
    inner += [(-5.5, -5.5), (9.5, -5.5), (9.5, 9.5), (-9.5, 9.5), (-9.5, -9.5), (13.5, -9.5)]
    outer += [(-6.5, -6.5), (10.5, -6.5), (10.5, 10.5), (-10.5, 10.5), (-10.5, -10.5)]
    outer += [(14.5, -10.5)]
    return [(QQ(x), QQ(y)) for x, y in [*outer[:turns], *inner[:turns][::-1]]]


@pytest.mark.long
@pytest.mark.parametrize("turns", [5, 6, 8, 9, 10, 12])
@pytest.mark.parametrize("start", [0, 1, 5])
def test_a_geodesic_may_wind_around_the_end_of_its_body(turns, start):
    """It passes a vertex twice, the body on its right and on its left.

    What it runs around between the two may go; then it passes there once, or not at all.
    """
    outline = spiral(turns)
    bodies = [
        Body("spiral", outline[start:] + outline[:start]),
        Body("by the end", [("11/4", "11/4"), ("14/5", "27/10")]),
        Body("in a corner", [("-7", "-13/2")]),
        Body("in the midst", [(0, 0), (1, 0), (0, 1)]),
        Body("further out", [(4, 4), ("9/2", 4), (4, "9/2")]),
    ]
    rng = Random(turns)
    simulation = Simulation(Scene([], (0, 9)), tiling="mixed")
    out = [*bodies]
    for _ in range(40):
        here = simulation.scene.bodies
        if len(here) > rng.randint(0, 4):
            out.append(rng.choice(here))
            simulation.remove(out[-1].name)
        else:
            rng.shuffle(out)
            simulation.add(out.pop())
        audit(simulation)
    assert simulation.stats["rebuilds"] == 0


def comb(teeth):
    """A comb with gaps of width 6, open above."""
    outline = [(0, 0), (8 * teeth + 2, 0)]
    for i in reversed(range(teeth + 1)):
        outline += [(8 * i + 2, 2), (8 * i + 2, 20), (8 * i, 20), (8 * i, 2)]
    return outline[:2] + outline[3:-1]


def certificates(teeth):
    """How many there are for a guest in a gap of a comb, when it goes and when it comes."""
    guests = [
        Body(f"guest{i}", [(8 * i + 4, 9), (8 * i + 6, 9), (8 * i + 5, 8)])
        for i in range(1, teeth - 1)
    ]
    simulation = Simulation(Scene([Body("comb", comb(teeth)), *guests], (0, 9)), tiling="mixed")
    certifier = simulation.kinetic.certifier
    counts = []
    for guest in guests[::10]:
        before = certifier.made + certifier.skipped
        simulation.remove(guest.name)
        between = certifier.made + certifier.skipped
        simulation.add(guest)
        counts.append((between - before, certifier.made + certifier.skipped - between))
    audit(simulation)
    assert simulation.stats["rebuilds"] == 0
    return set(counts)


@pytest.mark.long
def test_the_certificates_in_a_pocket_do_not_depend_on_the_rest_of_the_body():
    assert certificates(8) == certificates(60)
