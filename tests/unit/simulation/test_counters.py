"""Counts belong to a run: other runs, before, in between and in other threads, do not matter."""

import sys
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import pytest

import exactpt
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.pairs.features_sweep import PairsSearch
from exactpt.scene.generate import generate
from exactpt.scene.scene import Scene
from exactpt.simulation.simulation import Simulation

COUNTS = ("exact", "filtered", "reasons")
SCENES = [generate("convex", 3), generate("small_grid", 3)]


@pytest.fixture(autouse=True)
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


def test_bug_another_run_afterwards_changes_no_counts():
    simulation = Simulation(SCENES[0])
    list(simulation.run())
    before = simulation.stats

    assert alone(SCENES[1])["exact"] > 0
    assert simulation.stats == before


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


def test_bug_two_runs_in_two_threads_count_for_themselves():
    scenes = [SCENES[0], SCENES[1], SCENES[0], SCENES[1]]
    expected = [alone(scene) for scene in scenes]
    barrier = Barrier(len(scenes))

    def at_once(scene):
        barrier.wait()
        return alone(scene)

    with ThreadPoolExecutor(len(scenes)) as pool:
        assert list(pool.map(at_once, scenes)) == expected


def test_bug_runs_in_threads_may_share_a_track():
    body = Body("b", [(0, 0), (3, 1), (1, 2)], Translation([0, 1], [0, "1/3"]))
    track = body._piece_after(0).tracks[1]
    packed = {width: track.packed(width) for width in (16, 24, 32, 40)}

    def ask(_):
        return all(track.packed(w) == packed[w] for _ in range(5_000) for w in packed)

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(ask, range(4)))


def test_bug_a_search_by_pairs_counts_for_itself():
    search = PairsSearch(SCENES[1])
    search.run_to_contact()
    before = search.stats

    assert decisions(alone(SCENES[0])) > 0
    assert search.stats == before
    assert decisions(before) > 0


@pytest.mark.parametrize("size", [1, 4])
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
