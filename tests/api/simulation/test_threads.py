"""Counts belong to a run; a simulation is used by one thread at a time, others are refused."""

import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import pytest

import exactpt
from exactpt import Body, InputError, Scene, Simulation, Translation
from exactpt.testing.scenes import generate

COUNTS = ("exact", "filtered", "reasons")
SCENES = [generate("convex", 3), generate("small_grid", 3)]
IN_USE = "the simulation is in use by another thread: wait for it, or use a copy()"
CANNOT_GO_ON = "the run was interrupted in the middle of an event: it cannot go on"


@pytest.fixture(autouse=True)
def _threads_take_turns_often():
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(interval)


def counts(simulation):
    return {key: simulation.stats[key] for key in COUNTS}


def decisions(simulation):
    return simulation.stats["exact"] + simulation.stats["filtered"]


def alone(scene):
    simulation = Simulation(scene)
    list(simulation.run())
    return counts(simulation)


# Counts


def test_bug_two_runs_event_by_event_count_for_themselves():
    expected = [alone(scene) for scene in SCENES]
    simulations = [Simulation(scene) for scene in SCENES]
    going = [True, True]
    while any(going):
        for i, simulation in enumerate(simulations):
            going[i] = going[i] and bool(simulation.step())

    assert list(map(counts, simulations)) == expected
    assert expected[0] != expected[1]


def test_bug_runs_in_threads_count_for_themselves():
    scenes = SCENES * 2
    expected = [alone(scene) for scene in scenes]
    barrier = Barrier(len(scenes))

    def at_once(scene):
        barrier.wait()
        return alone(scene)

    with ThreadPoolExecutor(len(scenes)) as pool:
        assert list(pool.map(at_once, scenes)) == expected


def test_bug_searches_in_threads_may_share_a_body():
    """Numbers of its track are kept in several widths, for whoever is the next to need them."""
    body = Body("b", [(0, 0), (3, 1), (1, 2)], Translation([0, 1], [0, "1/3"]))
    scenes = [
        Scene([body, Body("wall", [(10**k, -(10**k)), (10**k, 10**k)])], (0, 10**k))
        for k in (1, 4, 9, 15)
    ]
    expected = [exactpt.first_contact(scene) for scene in scenes]

    def ask(_):
        return all(
            [exactpt.first_contact(scene) for scene in scenes] == expected for _ in range(25)
        )

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(ask, range(4)))


@pytest.mark.parametrize("size", [1, 4], ids=["points", "a chevron among convex bodies"])
def test_counts_go_on_when_the_tiling_is_built_anew(size):
    chevron = [(0, 0), (4, 0), (1, 1), (0, 4)]
    bodies = [
        Body(f"b{i}", [(10 * i + x, i + y) for x, y in chevron[:: 2 if size > 1 else 4]])
        for i in range(4)
    ]
    bodies[0] = Body("b0", bodies[0].vertices, Translation([0, "-1/7"], [0, -20]))
    simulation = Simulation(Scene(bodies, (0, 9)))
    list(simulation.run(1))
    for i in range(9):
        simulation.set_motion("b1", exactpt.onward(simulation.body("b1"), 1, (0, i)))
    before, decided = simulation.stats, decisions(simulation)
    simulation.add(Body("new", [(200 + x, y) for x, y in chevron[:size]]))

    after = simulation.stats
    assert after["rebuilds"] == before["rebuilds"] + 1
    assert after["exact"] >= before["exact"] > 0
    assert after["filtered"] >= before["filtered"]
    anew = decisions(Simulation(simulation.scene, tiling=simulation.name))
    assert decisions(simulation) > decided + anew / 2 > anew
    assert all(after["reasons"][why] >= n for why, n in before["reasons"].items())


# One simulation, several threads

BALL = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 1]))
WALL = Body("wall", [(5, -9), (5, 9)])


def in_another_thread(call):
    """Call a function in a thread; return the error that it raises, or None."""
    raised = []

    def run():
        try:
            call()
        except InputError as error:
            raised.append(str(error))

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    return raised[0] if raised else None


def test_another_thread_is_refused_during_a_response():
    simulation, said = Simulation(Scene([BALL, WALL], time=(0, 20))), {}
    calls = {
        "step": simulation.step,
        "run": lambda: list(simulation.run()),
        "run_to_contact": simulation.run_to_contact,
        "set_motion": lambda: simulation.set_motion("ball", Translation()),
        "space": simulation.space,
        "copy": simulation.copy,
        "to_json": simulation.to_json,
        "end_proof": simulation.end_proof,
    }

    def respond(_simulation, _contact):
        said.update({name: in_another_thread(call) for name, call in calls.items()})
        simulation.copy()  # this thread may

    events = list(simulation.run(on_contact=respond))

    assert [event.kind for event in events] == ["contact"]
    assert said == dict.fromkeys(calls, IN_USE)


def test_threads_may_take_turns():
    scene = generate("turning", 1)
    whole = [event.to_json() for event in Simulation(scene, tiling="greedy").run()]
    simulation, events = Simulation(scene, tiling="greedy"), []
    while True:
        before = len(events)
        assert in_another_thread(lambda: events.extend(simulation.step())) is None
        if len(events) == before:
            break
    assert [event.to_json() for event in events] == whole


def test_bug_three_threads_never_change_the_events():
    """Of 20 runs one had other events, and one broke an invariant."""
    scene = generate("turning", 1)
    whole = sorted(str(e.to_json()) for e in Simulation(scene, tiling="greedy").run())
    for _ in range(5):
        simulation, events, errors = Simulation(scene, tiling="greedy"), [], []

        def go(simulation=simulation, events=events, errors=errors):
            while True:
                try:
                    found = simulation.step()
                except InputError:  # another thread is inside
                    continue
                except BaseException as error:
                    errors.append(error)
                    return
                if not found:
                    return
                events.extend(found)

        threads = [threading.Thread(target=go) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert errors == []
        assert sorted(str(event.to_json()) for event in events) == whole


class Interrupted:
    """A motion of a caller's own, in whose computation something happens."""

    def __init__(self, error):
        self.error = error

    def track(self, _position):
        raise self.error


@pytest.mark.parametrize("error", [KeyboardInterrupt, MemoryError])
def test_run_interrupted_in_a_change_does_not_go_on(error):
    simulation = Simulation(Scene([BALL, WALL], time=(0, 20)))
    list(simulation.run(1))

    with pytest.raises(error):
        simulation.set_motion("ball", Interrupted(error()))

    for door in (simulation.step, simulation.run_to_contact, simulation.to_json):
        with pytest.raises(InputError, match=CANNOT_GO_ON):
            door()


def test_run_interrupted_in_a_response_goes_on_or_says_that_it_cannot():
    """Nothing was changed in the response, but the contact at t = 4 is not passed."""
    simulation = Simulation(Scene([BALL, WALL], time=(0, 20)))

    def interrupted(_simulation, _contact):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        list(simulation.run(on_contact=interrupted))

    assert simulation.now < 4
    assert simulation.reached() < 4
    assert simulation.run_to_contact().time == 4
