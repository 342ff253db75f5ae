"""What a film records of the half-edges that the engine has changed is what it records of all."""

import pytest

from exactpt.collision.driver import Driver
from exactpt.render.tracker import Tracker
from exactpt.scene.generate import generate


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
        scene = generate(family, seed)
        driver = Driver(lambda scene=scene: scene)
        driver.start(tiling)
        node = driver.kinetic.vertices.nodes()
        ours, whole = Tracker(driver.kinetic, node), Tracker(driver.kinetic, node)
        driver.observers.append(ours)
        while steps < 60 * (seed + 1) and (events := driver.advance(scene.end)) is not None:
            if events:
                steps += 1
                whole.on_changed_edges(None)
                ours.update(steps)
                whole.update(steps)
        assert ours.edges == whole.edges
        assert sorted(map(repr, ours.tiles)) == sorted(map(repr, whole.tiles))
    assert steps > 5
