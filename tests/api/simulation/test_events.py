"""An event of a run as a value: copied, pickled, matched, not changed.

That events read late are what they were at once is the law `simulation/events`.
"""

import copy
import gc
import json
import pickle
import weakref

import pytest

from exactpt import AlgebraicNumber, Body, RunEvent, Scene, Simulation
from exactpt.testing.scenes import generate


def summary(event):
    return json.dumps(event.to_json())


@pytest.mark.parametrize(
    "way", [copy.copy, copy.deepcopy, lambda event: pickle.loads(pickle.dumps(event))]
)
def test_event_is_copied_and_pickled_with_its_time(way):
    simulation = Simulation(generate("convex", 3), tiling="greedy")
    event = next(simulation.run())
    other = way(event)
    list(simulation.run())

    assert summary(other) == summary(event)
    assert repr(other) == repr(event)
    assert repr(event).startswith(
        "RunEvent(time=AlgebraicNumber('37/327'), kind='hull', removed=(("
    )


def test_event_cannot_be_changed():
    event = next(Simulation(generate("convex", 3)).run())

    for name in ("time", "kind", "removed", "added", "colour"):
        with pytest.raises(AttributeError):
            setattr(event, name, None)


def test_event_is_matched_by_its_parts():
    event = next(Simulation(generate("convex", 3)).run())

    match event:
        case RunEvent(time, kind, removed, added):
            assert (time, kind, removed, added) == (
                event.time, event.kind, event.removed, event.added)  # fmt: skip


def test_time_of_an_event_is_computed_once():
    event = next(Simulation(generate("convex", 3)).run())

    assert event.time is event.time
    assert isinstance(event.time, AlgebraicNumber)


@pytest.mark.plain
def test_event_keeps_no_tiling():
    simulation = Simulation(generate("convex", 3), tiling="greedy")
    events = [next(simulation.run()) for _ in range(9)]
    at_once = [summary(event) for event in Simulation(generate("convex", 3)).run()][:9]
    tiling = weakref.ref(simulation.kinetic)
    del simulation
    gc.collect()

    assert tiling() is None
    assert list(map(summary, events)) == at_once


@pytest.mark.parametrize("tiling", ["greedy", "lazy", "mixed"])
def test_events_of_a_removal_name_what_was_removed(tiling):
    """Of the body between two others; a body that comes may have the numbers of its vertices."""
    triangle = [(0, 0), (4, 0), (0, 4)]

    def edges(*, used_again):
        bodies = [Body(name, [(x + 9 * i, y) for x, y in triangle]) for i, name in enumerate("abc")]
        simulation = Simulation(Scene(bodies, (0, 9)), tiling=tiling)
        simulation.remove("b")
        if used_again:
            simulation.add(Body("new", [(x, y + 9) for x, y in triangle]))
        return [edge for event in simulation.step() for edge in event.removed + event.added]

    at_once = edges(used_again=False)

    assert any(end.startswith("b:") for edge in at_once for end in edge)
    assert edges(used_again=True)[: len(at_once)] == at_once
