"""Counts belong to a run; one simulation in several threads."""

import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import pytest

import exactpt
from exactpt import Body, InputError, Scene, Simulation, Translation
from exactpt.pairs.features_sweep import PairsSearch
from exactpt.testing.scenes import generate

COUNTS = ("exact", "filtered", "reasons")
SCENES = [generate("convex", 3), generate("small_grid", 3)]


@pytest.fixture
def threads_take_turns_often():
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(interval)


def counts(stats):
    return {key: stats[key] for key in COUNTS}


def decisions(stats):
    return stats["exact"] + stats["filtered"]


def alone(scene):
    simulation = Simulation(scene)
    list(simulation.run())
    return counts(simulation.stats)


@pytest.mark.usefixtures("threads_take_turns_often")
def test_bug_another_run_afterwards_changes_no_counts():
    simulation = Simulation(SCENES[0])
    list(simulation.run())
    before = simulation.stats

    assert alone(SCENES[1])["exact"] > 0
    assert simulation.stats == before


@pytest.mark.usefixtures("threads_take_turns_often")
def test_bug_two_runs_event_by_event_count_for_themselves():
    expected = [alone(scene) for scene in SCENES]
    simulations = [Simulation(scene) for scene in SCENES]
    going = [True, True]
    while any(going):
        for i, simulation in enumerate(simulations):
            going[i] = going[i] and bool(simulation.step())

    for simulation, wanted in zip(simulations, expected, strict=True):
        assert counts(simulation.stats) == wanted
    assert expected[0] != expected[1]


@pytest.mark.usefixtures("threads_take_turns_often")
def test_bug_two_runs_in_two_threads_count_for_themselves():
    scenes = [SCENES[0], SCENES[1], SCENES[0], SCENES[1]]
    expected = [alone(scene) for scene in scenes]
    barrier = Barrier(len(scenes))

    def at_once(scene):
        barrier.wait()
        return alone(scene)

    with ThreadPoolExecutor(len(scenes)) as pool:
        assert list(pool.map(at_once, scenes)) == expected


@pytest.mark.usefixtures("threads_take_turns_often")
def test_bug_runs_in_threads_may_share_a_track():
    body = Body("b", [(0, 0), (3, 1), (1, 2)], Translation([0, 1], [0, "1/3"]))
    track = body.exact_piece_after(0).tracks[1]
    packed = {width: track.packed(width) for width in (16, 24, 32, 40)}

    def ask(_):
        return all(track.packed(w) == packed[w] for _ in range(5_000) for w in packed)

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(ask, range(4)))


@pytest.mark.usefixtures("threads_take_turns_often")
def test_bug_a_search_by_pairs_counts_for_itself():
    search = PairsSearch(SCENES[1])
    search.run_to_contact()
    before = search.stats

    assert decisions(alone(SCENES[0])) > 0
    assert search.stats == before
    assert decisions(before) > 0


@pytest.mark.parametrize("size", [1, 4])
@pytest.mark.usefixtures("threads_take_turns_often")
def test_counts_go_on_when_the_tiling_is_built_anew(size):
    """For one more point, or for a chevron among convex bodies."""
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
    before = simulation.stats
    simulation.add(Body("new", [(200 + x, y) for x, y in chevron[:size]]))

    after = simulation.stats
    assert after["rebuilds"] == before["rebuilds"] + 1
    assert after["exact"] >= before["exact"] > 0
    assert after["filtered"] >= before["filtered"]
    anew = decisions(Simulation(simulation.scene, tiling=simulation.name).stats)
    assert decisions(after) > decisions(before) + anew / 2 > anew
    assert all(after["reasons"][why] >= n for why, n in before["reasons"].items())


@pytest.mark.usefixtures("threads_take_turns_often")
def test_counts_go_on_after_restore(tmp_path):
    simulation = Simulation(SCENES[1])
    simulation.step()
    simulation.save(tmp_path / "s.json")
    alone(SCENES[0])
    restored = Simulation.restore(tmp_path / "s.json")

    assert counts(restored.stats) == counts(simulation.stats)
    list(simulation.run())
    list(restored.run())
    assert counts(restored.stats) == counts(simulation.stats)


# One simulation, several threads: one at a time, the others are refused in one line

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


def test_another_thread_is_refused_during_a_callback():
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
    assert list(said) == list(calls)
    assert set(said.values()) == {
        "the simulation is in use by another thread: wait for it, or use a copy()"
    }


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


@pytest.mark.parametrize("error", [KeyboardInterrupt, MemoryError])
def test_a_run_interrupted_in_an_event_does_not_go_on(monkeypatch, error):
    simulation = Simulation(generate("turning", 1), tiling="greedy")
    simulation.step()
    mutable = simulation._run.mutable

    def interrupt(_plans):
        raise error

    monkeypatch.setattr(mutable, "set_motions", interrupt)
    with pytest.raises(error):
        simulation.set_motions({})
    with pytest.raises(InputError, match="interrupted in the middle of an event"):
        simulation.step()
