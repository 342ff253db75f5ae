"""One simulation, several threads: one at a time, the others are refused in one line."""

import threading

import pytest

from exactpt import Body, Scene, Simulation, Translation
from exactpt.errors import InputError
from exactpt.scene.generate import generate

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
