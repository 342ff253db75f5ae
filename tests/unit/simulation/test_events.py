"""Events: nothing is computed until somebody looks, and then it is what it was at once."""

import copy
import gc
import json
import pickle
import weakref
from random import Random

import pytest

from exactpt.collision.detector import first_contact
from exactpt.collision.driver import Driver
from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.motion.normalization import Normalization
from exactpt.scene.scene import Scene
from exactpt.simulation.event import RunEvent
from exactpt.simulation.motion_changes import onward
from exactpt.simulation.responses import Bounce
from exactpt.simulation.simulation import Simulation
from exactpt.testing.scenes import FAMILIES, POINTS, generate
from exactpt.tiling.start import TILINGS, start_tiling

CROWDS = ["convex", "ballistic", "stars", "letters", "blobs", "polygons_in_step"]


@pytest.fixture
def computed(monkeypatch):
    """The exact times that have been enclosed in doubles: as each is that is computed."""
    times, enclosure = [], Normalization.enclosure

    def noted(normalization, time):
        times.append(time)
        return enclosure(normalization, time)

    monkeypatch.setattr(Normalization, "enclosure", noted)
    return times


def before_contact(scene):
    """A rational time before the first contact of a scene."""
    contact = first_contact(scene, method="pairs")
    if contact is None:
        return scene.end
    return scene.start + (contact.time.canonical_interval()[0] - scene.start) * QQ(9, 10)


def in_parts(simulation, end):
    """The events of loops that each break off after one."""
    while (event := next(simulation.run(end), None)) is not None:
        yield event


@pytest.mark.parametrize("run", [Simulation.run, in_parts])
@pytest.mark.parametrize("family", CROWDS)
def test_nobody_looks_and_no_exact_time_is_computed_but_the_engine_s(family, run, computed):
    scene = generate(family, 3)
    end = before_contact(scene)
    for tiling in ("greedy", "lazy"):
        kinetic = start_tiling(scene, tiling, scene.start)
        computed.clear()
        count = len(list(Driver(scene, kinetic).events(end)))
        needed = len(computed)
        simulation = Simulation(scene, tiling=tiling)
        computed.clear()
        events = list(run(simulation, end))

        assert len(events) == count
        assert len(computed) == needed
        assert len({event.time for event in events}) >= len(computed) - needed


def test_a_look_computes_the_time_once(computed):
    simulation = Simulation(generate("convex", 3), tiling="greedy")
    computed.clear()
    events = list(simulation.run(1))
    needed = len(computed)

    for event in events:
        assert event.time is event.time
    assert needed + 5 < len(computed) == len({event.time for event in events})
    assert max(computed.count(time) for time in computed) == 1


@pytest.mark.long
@pytest.mark.plain
def test_an_event_keeps_no_tiling():
    simulation = Simulation(generate("convex", 3), tiling="greedy")
    events = [next(simulation.run()) for _ in range(9)]
    at_once = [event.to_json() for event in Simulation(generate("convex", 3)).run()][:9]
    kinetic = weakref.ref(simulation.kinetic)
    del simulation
    gc.collect()

    assert kinetic() is None
    assert [event.to_json() for event in events] == at_once


def journey(scene, tiling, look, path):
    """What a look tells of the events of a run with all that may happen to a simulation."""
    rng, seen = Random(f"{scene}:{tiling}"), []
    simulation = Simulation(scene, tiling=tiling)
    bounce = Bounce()

    def respond(simulation, contact):
        if simulation.contacts < 9 and contact.kind != "self":
            bounce(simulation, contact)

    for k in range(1, 9):
        t = scene.start + (scene.end - scene.start) * k / 9
        seen += map(look, simulation.run(t, on_contact=respond))
        if simulation.contact is not None:
            break
        name = rng.choice([body.name for body in simulation.scene.bodies])
        body = simulation.body(name)
        try:
            if k % 4 == 1:
                simulation.set_motion(name, onward(body, t, (rng.randint(-9, 9), 1)))
            elif k % 4 == 2:
                simulation.remove(name)
                simulation.add(Body(f"{name}'", body.at(t), closed=body.closed))
            elif k % 4 == 3:
                simulation.save(path)
                simulation = Simulation.restore(path)
            else:
                seen += map(look, simulation.copy().step())
                simulation = pickle.loads(pickle.dumps(simulation))
        except InputError:
            pass  # of a motion that has no translation, or of which there is no file
    return seen


def summary(event):
    return json.dumps(event.to_json())


@pytest.mark.long
@pytest.mark.parametrize("family", [*sorted(FAMILIES), *sorted(POINTS)])
def test_looked_at_late_they_are_what_they_were_at_once(family, tmp_path):
    scene = generate(family, 2)
    for tiling in ("incremental",) if family in POINTS else TILINGS:
        at_once = journey(scene, tiling, summary, tmp_path / "run.json")
        late = journey(scene, tiling, lambda event: event, tmp_path / "run.json")

        assert [summary(event) for event in late] == at_once
        assert [summary(event) for event in reversed(late)] == at_once[::-1]


@pytest.mark.parametrize(
    "outline, rebuilds",
    [([(0, 0), (4, 0), (0, 4)], 0), ([(0, 0), (8, 0), (1, 1), (0, 8)], 1)],
    ids=["ids used again", "built anew"],
)
def test_the_names_are_those_of_then(outline, rebuilds):
    def run():
        scene = Scene(
            [
                Body("old", [(0, 0), (4, 0), (0, 4)], Translation([0, 1])),
                Body("far", [(9, 30), (13, 30), (9, 34)], Translation([0, "1/3"], [30, 0, -1])),
                Body("high", [(-9, 60), (-5, 60), (-9, 64)], Translation([0, "7/3"])),
            ],
            (0, 20),
        )
        simulation = Simulation(scene)
        yield from simulation.run(3)
        ring = list(simulation.kinetic.vertices.bodies[0].ring)
        simulation.remove("old")
        yield from simulation.run(4)
        simulation.add(Body("new", [(x - 200, y) for x, y in outline], Translation([0, 9])))
        assert simulation.stats["rebuilds"] == rebuilds
        assert set(ring) <= set(simulation.kinetic.vertices.bodies[-1].ring) or rebuilds
        yield from simulation.run(8)

    at_once = [summary(event) for event in run()]

    assert [summary(event) for event in list(run())] == at_once
    assert any("old" in line for line in at_once)
    assert any("new" in line for line in at_once)


def test_a_file_does_not_tell_who_has_looked():
    scene = generate("stars", 2)
    plain, looked = Simulation(scene), Simulation(scene)
    for _ in range(9):
        events = [simulation.step() for simulation in (plain, looked)]
        assert all(event.time == looked.now for event in events[1])
        assert json.dumps(plain.to_json()) == json.dumps(looked.to_json())
        assert all(event.time == plain.now for event in events[0])


@pytest.mark.parametrize(
    "way", [copy.copy, copy.deepcopy, lambda event: pickle.loads(pickle.dumps(event))]
)
def test_an_event_is_copied_and_pickled_with_its_time(way):
    simulation = Simulation(generate("convex", 3), tiling="greedy")
    event = next(simulation.run())
    other = way(event)
    list(simulation.run())

    assert summary(other) == summary(event)
    assert repr(other) == repr(event)
    assert repr(event).startswith(
        "RunEvent(time=AlgebraicNumber('37/327'), kind='hull', removed=(("
    )


def test_an_event_is_not_changed():
    event = next(Simulation(generate("convex", 3)).run())

    for name in ("time", "kind", "removed", "added", "colour"):
        with pytest.raises(AttributeError):
            setattr(event, name, None)
    match event:
        case RunEvent(time, kind, removed, added):
            assert (time, kind, removed, added) == (
                event.time, event.kind, event.removed, event.added)  # fmt: skip


@pytest.mark.parametrize("tiling", ["greedy", "lazy"])
@pytest.mark.parametrize("family", ["convex", "small_grid", "turning"])
def test_whether_a_time_is_over_is_decided_exactly(family, tiling):
    """For times beside an event, between the doubles that enclose it, and the event itself."""
    scene = generate(family, 3)
    kinetic = start_tiling(scene, tiling, scene.start)
    normalization, end, tight = kinetic.vertices.normalization, before_contact(scene), 0
    while kinetic.advance(end) is not None:
        now = kinetic.certifier.now
        times = [normalization.exact_time(x) for x in (now.low, now.high)]
        times += [sum(times) / 2, times[0] - 1, times[1] + 1]
        asked = [kinetic.is_after(t) for t in times]
        low, high = kinetic.now.canonical_interval()
        times += [QQ(low), QQ(high)]

        assert asked == [kinetic.now.compare_rational(t) > 0 for t in times[:5]]
        assert [kinetic.is_after(t) for t in times] == [
            kinetic.now.compare_rational(t) > 0 for t in times
        ]
        tight += len(set(asked)) == 2
    assert tight > 3


@pytest.mark.parametrize("tiling", TILINGS)
def test_the_events_of_a_removal_name_what_was_removed(tiling):
    triangle = [(0, 0), (4, 0), (0, 4)]

    def edges(*, used_again):
        bodies = [Body(name, [(x + 9 * i, y) for x, y in triangle]) for i, name in enumerate("abc")]
        simulation = Simulation(Scene(bodies, (0, 9)), tiling=tiling)
        ring = list(simulation.kinetic.vertices.bodies[1].ring)
        simulation.remove("b")
        if used_again:
            simulation.add(Body("new", [(x, y + 9) for x, y in triangle]))
            assert sorted(simulation.kinetic.vertices.bodies[-1].ring) == sorted(ring)
        return [edge for event in simulation.step() for edge in event.removed + event.added]

    at_once = edges(used_again=False)

    assert any(end.startswith("b:") for edge in at_once for end in edge)
    assert edges(used_again=True)[: len(at_once)] == at_once
