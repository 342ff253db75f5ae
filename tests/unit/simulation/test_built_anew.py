"""A change whose region cannot be tiled again: the tiling is built anew, from nothing.

No scene is known in which that happens, so a region is made to fail.
"""

import pytest

from exactpt import AuditError, Body, Scene, Simulation
from exactpt.pseudotriangulation.region import Region
from exactpt.testing import audit

SHAPES = {
    "convex": [(0, 0), (8, 1), (5, 7)],
    "stars": [(0, 0), (8, 1), (4, 2), (5, 9), (3, 3)],
}


@pytest.mark.plain
@pytest.mark.parametrize("tiling", ["greedy", "lazy", "mixed"])
@pytest.mark.parametrize("shape", SHAPES)
def test_region_that_cannot_be_tiled_is_built_anew_with_the_rest(monkeypatch, tiling, shape):
    def refuse(region, predicates):
        raise AuditError

    bodies = [
        Body(f"b{i}", [(x + 20 * (i % 3), y + 20 * (i // 3) + i) for x, y in SHAPES[shape]])
        for i in range(9)
    ]
    simulation = Simulation(Scene(bodies, (0, 9)), tiling=tiling)
    monkeypatch.setattr(Region, "tile", refuse)
    for k in range(3):
        simulation.remove("b4")
        audit(simulation)
        simulation.add(bodies[4])
        audit(simulation)
        assert simulation.stats["rebuilds"] == 2 * k + 2
