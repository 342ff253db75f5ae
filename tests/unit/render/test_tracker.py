"""What a film records of the half-edges that the engine has changed is what it records of all."""

import pytest

from exactpt import Simulation
from exactpt.render.tracker import Tracker
from exactpt.scene.generate import generate


class Unknown:
    """A tiling that does not report which half-edges it has changed."""

    def __init__(self, kinetic):
        self.mesh_after = kinetic.mesh_after

    def changes(self):
        return None


@pytest.mark.parametrize(
    "family, tiling",
    [
        ("convex", "lazy"),
        ("convex", "greedy"),
        ("convex", "mixed"),
        ("deforming", "lazy"),
        ("grids_passing", "greedy"),
        ("grids_passing", "lazy"),
        ("ballistic_points", "incremental"),
    ],
)
def test_changes_of_the_engine_make_the_film_of_a_comparison_of_all(family, tiling):
    steps = 0
    for seed in range(2):
        run = Simulation(generate(family, seed), tiling=tiling)
        kinetic, node = run.kinetic, run.kinetic.vertices.nodes()
        ours, whole = Tracker(kinetic, node), Tracker(Unknown(kinetic), node)
        for step, _ in zip(range(1, 60), run.run(), strict=False):
            ours.update(step)
            whole.update(step)
            steps += 1
        assert ours.edges == whole.edges
        assert sorted(map(repr, ours.tiles)) == sorted(map(repr, whole.tiles))
    assert steps > 5
