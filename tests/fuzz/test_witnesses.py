"""Every witness is content with small scenes of every family; more come with every campaign."""

import pytest

from exactpt.scene.generate import FAMILIES, POINTS
from fuzz.cases import failure_of
from fuzz.excerpt import scene_of
from fuzz.witnesses import WITNESSES

QUICK = ("reference", "static", "filters")


@pytest.mark.parametrize("family", [*FAMILIES, *POINTS])
def test_no_witness_objects(family):
    for seed in (1, 2, 3):
        scene = scene_of(family, seed)
        for witness in QUICK:
            assert failure_of(witness, scene, seed) is None


@pytest.mark.slow
@pytest.mark.cgal
@pytest.mark.parametrize("family", [*FAMILIES, *POINTS])
def test_no_witness_objects_to_more(family, program):
    for seed in range(4, 24):
        scene = scene_of(family, seed)
        for witness in WITNESSES:
            assert failure_of(witness, scene, seed) is None
