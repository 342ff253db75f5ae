"""CGAL on tilings of bodies with holes and parts."""

import pytest

from exactpt import Simulation
from exactpt.cgal import BodyShape, CgalCheck
from exactpt.check import check_scene
from exactpt.pairs.start import initial_touches
from exactpt.scene.generate import RINGS, generate
from exactpt.tiling.start import TILINGS

pytestmark = pytest.mark.cgal


@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize("family", sorted(RINGS))
def test_runs_are_verified(family, tiling):
    """Proof, tilings, event times, and the search over pairs."""
    tilings = 0
    for seed in range(4):
        report = check_scene(generate(family, seed), tiling=tiling)
        assert report.ok, (seed, report.lines())
        tilings += report.tilings
    assert tilings > 4


@pytest.mark.parametrize("family", sorted(RINGS))
def test_both_witnesses_agree(family):
    with CgalCheck() as witness:
        for seed in range(6):
            scene = generate(family, seed)
            if initial_touches(scene)[1]:
                continue
            tile = Simulation(scene).tiling.to_json()
            shapes = BodyShape.of_scene(scene)
            verdict = witness.check_tiling(tile, shapes, deep=True)
            assert verdict.ok, (seed, verdict.reason)
            assert verdict.stats["polygons"] == sum(
                len(body.parts) for body in scene.bodies if body.has_interior
            )
            swapped = [  # the outline of each part for the last of its holes
                shape._replace(parts=[part[::-1] for part in shape.parts]) for shape in shapes
            ]
            if any(shape.parts for shape in swapped):
                reported = witness.check_tiling(tile, swapped).reason
                assert "is clockwise" in reported or "is not one region" in reported
