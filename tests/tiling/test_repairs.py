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
    "family, seed, tiling",
    [
        ("chains", 2, "greedy"),
        ("pieces", 0, "greedy"),
        # A bend that straightens before a corner closes, though it has the larger slot.
        ("chains", 1, "lazy"),
    ],
)
def test_the_copies_of_one_triple_are_mended_in_perturbed_order(monkeypatch, family, seed, tiling):
    """First the triple of the least slot; of its copies none that changes after another."""
    choose, moved = RepairedTiling._first_due, []

    def checked(repaired):
        due = sorted(repaired._due)
        chosen = choose(repaired)
        triple = scene_triple(repaired, due[0])
        assert scene_triple(repaired, chosen) == triple
        this = repaired._vertices_of(chosen), new_sign(repaired, chosen)
        for h in due:
            if scene_triple(repaired, h) == triple:
                other = repaired._vertices_of(h), new_sign(repaired, h)
                assert not comes_first(*other, *this, repaired.now)
        moved.append(chosen != due[0])
        return chosen

    monkeypatch.setattr(RepairedTiling, "_first_due", checked)
    for _ in Simulation(generate(family, seed), tiling=tiling).run():
        pass

    assert any(moved)
