"""Running: steps, interrupted loops, questions on the way, contacts that go on."""

import json
import sys
from pathlib import Path
from random import Random

import pytest

from exactpt.errors import BudgetExceeded, InputError
from exactpt.kernel.numbers import QQ, power_of_two
from exactpt.motion.body import Body
from exactpt.motion.motions import Affine, Pieces, Rigid, Translation
from exactpt.pairs.start import initial_touches
from exactpt.scene.scene import Scene
from exactpt.simulation.motion_changes import onward, round_to_grid, translation_at
from exactpt.simulation.responses import Bounce, stop
from exactpt.simulation.simulation import Simulation
from exactpt.testing.scenes import FAMILIES, generate

sys.path.append(str(Path(__file__).parents[3] / "examples"))


def lines(events):
    return [json.dumps(event.to_json()) for event in events]


@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_steps_are_the_run(family):
    """`step` after `step`, or loops that break off, give the events of one loop."""
    scene = generate(family, 1)
    whole = lines(Simulation(scene).run())
    simulation, steps = Simulation(scene), []
    while events := simulation.step():
        steps += lines(events)
    broken, parts, more = Simulation(scene), [], True
    while more:
        more = False
        for event in broken.run():
            parts += lines([event])
            more = True
            break

    assert steps == parts == whole
    assert simulation.now == broken.now


def two_points():
    """A point that meets another one at t = 3."""
    return Scene([Body("a", [(0, 0)], Translation([0, 1])), Body("b", [(3, 0)])], (0, 10))


def test_the_time_before_a_contact_is_as_near_as_asked():
    for margin in (None, QQ(1, 2), QQ(1, 3), power_of_two(-2000)):
        times = []

        def respond(simulation, contact, times=times):
            times.append(simulation.now.low)
            simulation.set_motion("a", Translation([2 * simulation.now.low, -1]))

        simulation = Simulation(two_points())
        kinds = [event.kind for event in simulation.run(on_contact=respond, margin=margin)]

        assert kinds == ["contact", "motion"]
        assert 0 < 3 - times[0] <= (power_of_two(-70) if margin is None else margin)
    with pytest.raises(InputError, match="margin"):
        next(Simulation(two_points()).run(margin=0))


def test_a_contact_without_new_plans_ends_the_run():
    met = []
    simulation = Simulation(two_points())
    events = list(simulation.run(on_contact=lambda _, contact: met.append(contact)))

    assert [event.kind for event in events] == ["contact"]
    assert simulation.now == simulation.contact.time == met[0].time == 3
    assert simulation.contacts == 1
    assert list(simulation.run()) == simulation.step() == []


def test_what_stops_stays_for_ever():
    simulation = Simulation(two_points())
    assert [e.kind for e in simulation.run(on_contact=stop)] == ["contact", "motion", "motion"]
    assert simulation.now == 10
    gap = 3 - simulation.scene.at(10)["a"][0][0]
    assert 0 < gap < power_of_two(-70)


def test_contacts_are_within_the_budget():
    """Plans that lead to the same contact again do not run for ever."""

    def closer(simulation, contact):
        t = simulation.now.low
        simulation.set_motion("a", Translation([0, 1]))
        assert t < 3

    simulation = Simulation(two_points(), max_events=50)
    with pytest.raises(BudgetExceeded) as spent:
        list(simulation.run(on_contact=closer))
    assert spent.value.reached < 3


def test_questions_between_events():
    scene = generate("convex", 3)
    simulation = Simulation(scene)
    simulation.step()
    with pytest.raises(InputError, match="next event"):
        simulation.space(scene.end)
    at = (simulation.kinetic.next_number().low + simulation.now.high) / 2
    space = simulation.space(at)
    assert space.at == at
    assert space is simulation.space(at)
    name, points = next(iter(scene.at(at).items()))
    assert space.locate(points[0]).body == name


def test_questions_are_wired():
    boxes = [Body(f"b{i}", [(4 * i, 0), (4 * i + 2, 0), (4 * i + 2, 2)]) for i in range(3)]
    simulation = Simulation(Scene(boxes, (0, 1)))
    assert simulation.locate((1, QQ(1, 2))).body == "b0"
    assert simulation.ray_cast((3, 1), (1, 0)).body == "b1"
    assert not simulation.is_free((3, 1), (7, 1))
    assert simulation.path((3, 1), (7, 1)).bends in ((("b1", 0), ("b1", 1)), (("b1", 2),))
    assert simulation.shorten([(3, 1), (3, QQ(3, 2))]).length == 0.5
    assert len(simulation.hull()) == 9
    assert simulation.relative_hull("b1") == [("b1", 0), ("b1", 1), ("b1", 2)]
    assert simulation.neighbours("b0") == ["b1"]
    assert simulation.tiling == simulation.snapshot()


def test_rounded_is_the_nearest_multiple():
    rng = Random(0)
    for _ in range(200):
        value, grid = QQ(rng.randint(-99, 99), rng.randint(1, 9)), QQ(1, rng.randint(1, 8))
        near = round_to_grid(value, grid)
        assert (near / grid).denominator == 1
        assert abs(near - value) <= grid / 2


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
def test_onward_goes_on_from_where_the_body_is(motion):
    body = Body("b", [(0, 0), (2, 0), (0, 1)], motion)
    for t in (QQ(1, 2), QQ(2), QQ(5, 2), QQ(7)):
        new = Body("b", body.vertices, onward(body, t, (QQ(1, 3), -2), grid=QQ(1, 4)))
        assert new.at(t) == body.at(t)


def no_overlap(simulation):
    return not initial_touches(simulation.scene)[1]


def run_box(bodies, deforming, contacts, tiling):
    """A box of bouncing bodies; the largest numbers in the first and in the last quarter."""
    from bouncing_box import PULSES, WALLS, box, digits, pulsing

    simulation = Simulation(box(bodies, deforming, 1, 10**6), tiling=tiling)
    bounce = Bounce(WALLS, fastest=16)
    sizes = []

    def respond(simulation, contact):
        bounce(simulation, contact)
        assert no_overlap(simulation)
        sizes.append((digits(simulation.scene, simulation.now.low), len(simulation.kinetic.queue)))

    t = 0
    while simulation.contacts < contacts:
        t += PULSES
        for _ in simulation.run(t, on_contact=respond):
            pass
        assert simulation.contact is None
        plans = {}
        for i in range(deforming):
            x, y = translation_at(simulation.body(f"jelly {i}"), QQ(t))
            plans[f"jelly {i}"] = pulsing(x.coefficients, y.coefficients, QQ(t))
        simulation.set_motions(plans)
    quarter = len(sizes) // 4
    return [
        [max(size[k] for size in part) for k in (0, 1)]
        for part in (sizes[:quarter], sizes[-quarter:])
    ]


@pytest.mark.long
@pytest.mark.parametrize("tiling", ["greedy", "lazy"])
def test_bouncing_bodies_never_overlap(tiling):
    """Checked exactly after every bounce; the numbers do not grow."""
    first, last = run_box(6, 2, 40, tiling)

    assert last[0] <= first[0] + 16


@pytest.mark.slow
def test_a_box_of_bouncing_bodies():
    """60 convex bodies and 6 that deform; 1,000 contacts."""
    first, last = run_box(60, 6, 1000, "lazy")

    assert last[0] <= first[0] + 16
    assert last[1] <= 2 * first[1]


@pytest.mark.parametrize("tiling", ["lazy", "greedy", "mixed"])
def test_a_contact_at_a_breakpoint_can_be_gone_back_from(tiling):
    """AuditError: there is no contact to go back from; a second look had found it."""
    motion = Translation([1, -2, 1], [0, -1])
    chain = Body(
        "g", [(0, 0), (3, 0), (0, -2)], Pieces([(1, motion), (None, motion)]), closed=False
    )
    scene = Scene([chain, Body("o", [(0, -3), (0, -4)])], (0, 3))

    simulation = Simulation(scene, tiling=tiling)
    events = list(simulation.run(on_contact=stop))

    assert [event.time for event in events if event.kind == "contact"] == [1]
    assert simulation.contact is None


@pytest.mark.parametrize("tiling", ["greedy", "mixed", "lazy"])
@pytest.mark.parametrize("run_out", [Simulation.run_to_contact, lambda s: list(s.run())])
def test_tiling_at_a_contact_at_an_irrational_time_is_refused(tiling, run_out):
    """The vertex (0, 1 + t^2) meets the line y = 3 at t = sqrt 2: no tiling holds there."""
    rising = Body("rising", [(0, 0), (1, 0), (0, 1)], Translation([0], [0, 0, 1]))
    wall = Body("wall", [(-9, 3), (9, 3), (0, 4)])
    simulation = Simulation(Scene([rising, wall], (0, 3)), tiling=tiling)
    run_out(simulation)

    assert simulation.now.polynomial == (-2, 0, 1)
    for question in (lambda: simulation.tiling, simulation.snapshot, simulation.space):
        with pytest.raises(InputError, match=r"no tiling: the first contact is at t = 1\.41421356"):
            question()
