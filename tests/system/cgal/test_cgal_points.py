"""CGAL on the incremental pseudo-triangulation and the fan triangulation of moving points."""

import pytest

from exactpt.cgal import BodyShape
from exactpt.check import check_scene
from exactpt.pairs.start import initial_touches
from exactpt.scene.generate import POINTS, generate
from exactpt.simulation.simulation import Simulation
from exactpt.simulation.tile import tile_at

pytestmark = pytest.mark.cgal


@pytest.mark.parametrize("family", sorted(POINTS))
def test_cgal_agrees_all_along(family):
    """Every tiling between two events, and every event time."""
    tilings = 0
    for seed in range(12):
        report = check_scene(generate(family, seed), tiling="incremental")
        assert report.ok, report.lines()
        tilings += report.tilings
    assert tilings > 24


@pytest.mark.parametrize("family", sorted(POINTS))
def test_fan_triangulation(witness, family):
    """At the end of the run, and built there: equal, and triangles all."""
    for seed in range(12):
        scene = generate(family, seed)
        simulation = Simulation(scene, tiling="incremental")
        if initial_touches(scene)[1] or simulation.run_to_contact() is not None:
            continue
        tile = simulation.snapshot().to_json()
        assert tile == tile_at(scene, scene.end, tiling="incremental").to_json()
        verdict = witness.check_triangulation(tile, BodyShape.of_scene(scene))
        assert verdict.ok, verdict.reason
