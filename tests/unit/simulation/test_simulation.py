"""Simulations: time moves forward, budgets hold, snapshots are refused where there are none."""

import json

import pytest

from exactpt import Body, BudgetExceeded, InputError, Scene, Simulation, Translation
from exactpt.kernel.numbers import QQ
from exactpt.simulation.tile import tile_at
from exactpt.testing import reference
from exactpt.testing.scenes import generate
from exactpt.tiling.start import TILINGS


def meeting(gap=4):
    """Two segments; one reaches the other after ``gap``."""
    return Scene(
        [
            Body("a", [(0, 0), (0, 2)], Translation([0, 1])),
            Body("b", [(gap, 1), (gap + 1, 1)]),
            Body("c", [(2, 5), (3, 5), (2, 6)]),
        ],
        (0, 9),
    )


@pytest.mark.parametrize("tiling", TILINGS)
def test_run_ends_with_the_contact_and_stays_there(tiling):
    simulation = Simulation(meeting(), tiling=tiling)

    events = list(simulation.run())

    assert events[-1].kind == "contact"
    assert simulation.now == simulation.contact.time == 4
    assert list(simulation.run()) == []
    assert simulation.run_to_contact() is simulation.contact
    with pytest.raises(InputError, match="one before it, where run"):
        simulation.snapshot()


@pytest.mark.parametrize("tiling", TILINGS)
def test_it_does_not_matter_where_the_run_is_interrupted(tiling):
    scene = generate("mixed_shapes", 0)
    whole = [event.to_json() for event in Simulation(scene, tiling=tiling).run()]
    simulation = Simulation(scene, tiling=tiling)

    parts = [
        event.to_json()
        for i in range(1, 8)
        for event in simulation.run(scene.end * QQ(i, 7) if i < 7 else None)
    ]

    assert parts == whole
    assert simulation.now == scene.end


def test_until_may_lie_beyond_the_end():
    simulation = Simulation(meeting(20))

    list(simulation.run(1000))

    assert simulation.now == 9
    assert simulation.contact is None
    assert simulation.snapshot().at == 9


def test_bodies_that_touch_at_the_start():
    simulation = Simulation(meeting(0))

    assert simulation.now == 0
    assert [event.kind for event in simulation.run()] == ["contact"]
    assert list(simulation.run()) == []
    assert simulation.contact.kind == "initial"
    assert simulation.stats["events"] == 0


@pytest.mark.parametrize("most", [0, 1, 5, 20])
def test_the_number_of_events_is_bounded(most):
    scene = generate("mixed_shapes", 0)
    simulation = Simulation(scene, max_events=most)

    with pytest.raises(BudgetExceeded) as spent:
        for _ in simulation.run():
            pass

    reached = spent.value.reached
    assert scene.start <= reached <= scene.end
    assert reference.first_contact(scene.until(max(reached, QQ(1, 10**9)))) is None


def test_the_time_is_bounded():
    with pytest.raises(BudgetExceeded, match="time limit exceeded"):
        list(Simulation(generate("mixed_shapes", 0), max_seconds=0).run())


@pytest.mark.long
@pytest.mark.parametrize("family", ["mixed_shapes", "small_grid", "turning", "pieces"])
@pytest.mark.parametrize("tiling", sorted(set(TILINGS) - {"lazy"}))
def test_a_canonical_tiling_is_the_same_built_and_reached(family, tiling):
    scene = generate(family, 0)
    assert reference.first_contact(scene) is None
    for i in range(4):
        t = scene.start + (scene.end - scene.start) * QQ(i, 3)
        built = tile_at(scene, t, tiling=tiling).to_json()
        assert tile_at(scene, t, tiling=tiling, by_running=True).to_json() == built


def test_a_tiling_is_refused_outside_the_span_and_after_the_contact():
    for t in (QQ(-1), QQ(10)):
        with pytest.raises(InputError, match="outside the time span"):
            tile_at(meeting(), t)
    for by_running in (False, True):
        with pytest.raises(InputError, match="the first contact is at"):
            tile_at(meeting(), QQ(5), by_running=by_running)


def test_a_tiling_at_a_time_that_is_not_rational_is_refused():
    scene = Scene(
        [
            Body("a", [(0, 0), (1, 0), (0, 1)], Translation([0, 0, 1])),
            Body("b", [(2, 9), (3, 9), (2, 10)]),
        ],
        (0, 3),
    )
    simulation = Simulation(scene)
    irrational = 0
    for event in simulation.run():
        if not event.time.is_rational and simulation.now == event.time:
            irrational += 1
            with pytest.raises(InputError, match="not rational"):
                simulation.snapshot()

    assert irrational


def test_events_are_json():
    events = [event.to_json() for event in Simulation(meeting()).run()]

    assert json.loads(json.dumps(events)) == events
    assert {"time", "kind", "removed", "added"} == set(events[0])
