"""The order of repairs at one time."""

import pytest

from exactpt.scene.generate import generate
from exactpt.simulation.simulation import Simulation
from exactpt.tiling.exact import comes_first
from exactpt.tiling.repairs import RepairedTiling

pytestmark = pytest.mark.plain


def new_sign(tiling, h):
    return -1 if tiling.mesh.corner[h] else 1


def scene_triple(tiling, h):
    return {(v.body, v.index) for v in tiling._vertices_of(h)}


@pytest.mark.parametrize(
    "family, seed", [("chains", 2), ("chains", 3), ("chains", 11), ("pieces", 0)]
)
def test_the_copies_of_one_triple_are_mended_in_perturbed_order(monkeypatch, family, seed):
    """First the triple of the least slot; of its copies none that changes after another."""
    choose, moved = RepairedTiling._first_due, []

    def checked(tiling):
        due = sorted(tiling._due)
        chosen = choose(tiling)
        triple = scene_triple(tiling, due[0])
        assert scene_triple(tiling, chosen) == triple
        this = tiling._vertices_of(chosen), new_sign(tiling, chosen)
        for h in due:
            if scene_triple(tiling, h) == triple:
                other = tiling._vertices_of(h), new_sign(tiling, h)
                assert not comes_first(*other, *this, tiling.now)
        moved.append(chosen != due[0])
        return chosen

    monkeypatch.setattr(RepairedTiling, "_first_due", checked)
    for _ in Simulation(generate(family, seed), tiling="greedy").run():
        pass

    assert any(moved)
