"""Repairs: their order at one time, and that they are enough."""

from collections import Counter

import pytest

from exactpt.certificates.perturbation import comes_first
from exactpt.collision.driver import Driver
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.scene.families.shapes import box
from exactpt.scene.generate import generate
from exactpt.scene.scene import Scene
from exactpt.simulation.simulation import Simulation
from exactpt.tiling.repairs import Repairs
from exactpt.tiling.start import start_tiling
from fuzz.statics import run_and_audit

pytestmark = pytest.mark.plain


def new_sign(certified, h):
    return -1 if certified.mesh.corner[h] else 1


def scene_triple(certified, h):
    return {(v.body, v.index) for v in certified.vertices_of(h)}


@pytest.mark.parametrize(
    "family, seed, tiling",
    [
        ("chains", 2, "greedy"),
        ("pieces", 0, "greedy"),
        # Here the sign that a bend gets decides.
        ("chains", 1, "lazy"),
    ],
)
def test_the_copies_of_one_triple_are_mended_in_perturbed_order(monkeypatch, family, seed, tiling):
    """First the triple of the least half-edge; of its copies none that changes after another."""
    choose, moved = Repairs.first_violated, []

    def checked(repairs):
        repaired = repairs.certified
        due = sorted(repaired.table.angles)
        chosen = choose(repairs)
        triple = scene_triple(repaired, due[0])
        assert scene_triple(repaired, chosen) == triple
        this = repaired.vertices_of(chosen), new_sign(repaired, chosen)
        for h in due:
            if scene_triple(repaired, h) == triple:
                other = repaired.vertices_of(h), new_sign(repaired, h)
                assert not comes_first(*other, *this, repaired.certifier.exact_now)
        moved.append(chosen != due[0])
        return chosen

    monkeypatch.setattr(Repairs, "first_violated", checked)
    for _ in Simulation(generate(family, seed), tiling=tiling).run():
        pass

    assert any(moved)


@pytest.mark.parametrize("tiling", ["greedy", "mixed", "lazy"])
def test_what_happens_one_by_one_is_repaired_and_not_built_anew(tiling):
    done = Counter()
    for family in ("convex", "ballistic", "turning", "deforming", "blobs", "stars"):
        simulation = Simulation(generate(family, 1), tiling=tiling)
        done.update(event.kind for event in simulation.run())
        assert simulation.stats["rebuilds"] == 0

    assert done["corner"] > 5
    assert done["reflex"] > 5
    assert done["hull"] > 5


@pytest.mark.parametrize("tiling, least", [("greedy", 20), ("lazy", 3)])
def test_repairs_at_one_time_are_checked_unless_they_are_apart(monkeypatch, tiling, least):
    """Where the check is left out, it would have found nothing and changed nothing."""
    done = Counter()
    settle = Repairs.repair_all

    def settled(repairs):
        settle(repairs)
        repaired, failure_group = repairs.certified, repairs.certified.failure_group
        if failure_group.needs_check(repaired.mesh):
            done["checked"] += 1
        elif failure_group._repair > 1:
            done["apart"] += 1
            before = sorted(map(repaired.mesh.ends, repaired.mesh.diagonals()))
            repairs.check_batch()
            assert sorted(map(repaired.mesh.ends, repaired.mesh.diagonals())) == before

    monkeypatch.setattr(Repairs, "repair_all", settled)
    for family, seed in [("concentric", 0), ("grids_passing", 3), ("mirrored", 2)]:
        for _ in Simulation(generate(family, seed), tiling=tiling).run():
            pass

    assert done["apart"] >= least
    assert done["checked"] > 10


@pytest.mark.long
def test_a_batch_of_more_repairs_than_are_pending_is_no_reason_to_build_anew():
    """Squares that rise in step through a grid, all at once: what fails then is all there is."""
    grid = [Body(f"{i},{j}", box(4 * i, 4 * j, 1, 1)) for i in range(70) for j in range(2)]
    rise = Translation(0, [0, 1])
    row = [Body(f"r{i}", box(4 * i + 2, -3, 1, 1), rise) for i in range(70)]
    scene = Scene([*grid, *row], (0, 14))
    kinetic = start_tiling(scene, "lazy", QQ(0))

    assert sum(1 for _ in Driver(scene, kinetic).events(scene.end)) > 1000
    assert kinetic.stats.rebuilds == 0


@pytest.mark.parametrize("seed, flips", [(0, 0), (4, 2), (7, 2), (36, 3)])
def test_pairs_exchanged_on_one_vertical_line_are_no_reason_to_build_anew(seed, flips):
    """Rings in step: a diagonal that has to give way is not there yet (4, 36), or a bitangent
    that enters finds none to replace (0, 7, 36). What the check flips is the static tiling.
    """
    stats = run_and_audit(generate("concentric", seed), "greedy").kinetic.stats

    assert stats.rebuilds == 0
    assert stats.flips == flips
