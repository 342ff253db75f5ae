"""Saved and restored at any moment, a run goes on as if nothing had happened."""

import json
from random import Random

import pytest

from exactpt.errors import InputError
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.scene.generate import FAMILIES, generate
from exactpt.scene.scene import Scene
from exactpt.simulation.responses import Bounce
from exactpt.simulation.simulation import Simulation


def line(event):
    return json.dumps(event.to_json())


def interrupted(simulation, moments, path):
    """The log of a run that is saved and restored after some of its events."""
    log = []
    while True:
        for event in simulation.run():
            log.append(line(event))
            if len(log) in moments:
                simulation.save(path)
                simulation = Simulation.restore(path)
                break
        else:
            return log, simulation


def check(scene, tiling, rng, path, times, *, exact_only=False):
    whole = Simulation(scene, tiling=tiling, exact_only=exact_only)
    log = [line(event) for event in whole.run()]
    moments = {rng.randint(1, len(log)) for _ in range(times)} if log else set()
    again, last = interrupted(
        Simulation(scene, tiling=tiling, exact_only=exact_only), moments, path
    )
    assert again == log
    assert last.now == whole.now
    assert (last.contact is None) == (whole.contact is None)
    if whole.contact is not None:
        assert last.contact.to_json() == whole.contact.to_json()
    mine, theirs = last.stats, whole.stats
    decisions = ("exact", "filtered", "reasons")  # a time that is saved has been resolved
    assert {k: mine[k] for k in mine if k not in decisions} == {
        k: theirs[k] for k in theirs if k not in decisions
    }
    return len(moments)


@pytest.mark.parametrize("family", sorted(FAMILIES))
@pytest.mark.parametrize("tiling", ["greedy", "mixed", "lazy"])
def test_a_restored_run_has_the_same_log(family, tiling, tmp_path):
    rng = Random(f"{family}:{tiling}")
    check(generate(family, 1), tiling, rng, tmp_path / "run.json", 2)


@pytest.mark.slow
@pytest.mark.parametrize("tiling", ["greedy", "mixed", "lazy"])
def test_a_restored_run_has_the_same_log_at_a_hundred_moments(tiling, tmp_path):
    rng = Random(tiling)
    moments = seed = 0
    while moments < 100:
        for family in FAMILIES:
            scene, exact_only = generate(family, seed), seed % 4 == 3
            path = tmp_path / "run.json"
            moments += check(scene, tiling, rng, path, 3, exact_only=exact_only)
        seed += 1


def test_a_file_that_is_saved_twice_is_the_same(tmp_path):
    simulation = Simulation(generate("stars", 2))
    for _ in range(5):
        simulation.step()
    simulation.save(tmp_path / "one.json")
    Simulation.restore(tmp_path / "one.json").save(tmp_path / "two.json")

    assert (tmp_path / "one.json").read_bytes() == (tmp_path / "two.json").read_bytes()


def bouncing(seed):
    rng = Random(seed)
    bodies = [
        Body(f"b{i}", [(9 * i, 0), (9 * i + rng.randint(1, 5), 0), (9 * i + 2, 3)])
        for i in range(5)
    ]
    moved = [
        Body(b.name, b.vertices, Translation([0, rng.randint(-5, 5)], [0, rng.randint(-1, 1)]))
        for b in bodies
    ]
    walls = [Body("west", [(-9, -50), (-8, -50), (-8, 50)]), Body("east", [(59, -50), (59, 50)])]
    return Scene([*moved, *walls], (0, 10))


def test_contacts_that_go_on_are_saved(tmp_path):
    """A bounce before and after the interruption; plans that were set on the way."""
    respond = Bounce(("west", "east"))
    logs = []
    for stops in (set(), {3, 9, 20}):
        simulation, log, more = Simulation(bouncing(1)), [], True
        while more:
            more = False
            for event in simulation.run(on_contact=respond):
                log.append(line(event))
                if len(log) in stops:
                    simulation.save(tmp_path / "run.json")
                    simulation = Simulation.restore(tmp_path / "run.json")
                    more = True
                    break
        logs.append(log)
        assert simulation.contacts > 3

    assert logs[0] == logs[1]


def test_a_contact_at_the_start_is_saved(tmp_path):
    scene = Scene([Body("a", [(0, 0), (2, 0), (0, 2)]), Body("b", [(1, 0), (3, 0), (3, 2)])])
    simulation = Simulation(scene)
    simulation.save(tmp_path / "run.json")
    again = Simulation.restore(tmp_path / "run.json")

    assert [line(e) for e in again.run()] == [line(e) for e in simulation.run()]
    assert again.contact.kind == "initial"


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"exactpt-simulation": 1}', '{"exactpt-simulation": 4}',
     '{"exactpt-simulation": 4, "tiling": "auto", "exact_only": false, "scene": {}}'],
)  # fmt: skip
def test_other_files_are_refused(text, tmp_path):
    path = tmp_path / "run.json"
    path.write_text(text)
    with pytest.raises(InputError, match=r"run\.json"):
        Simulation.restore(path)
    with pytest.raises(InputError, match="cannot be read"):
        Simulation.restore(tmp_path / "none.json")
