"""Every witness accepts small scenes of every family, and all scenes of the corpus."""

import json

import pytest
from folding import every

from exactpt.scene.generate import FAMILIES, POINTS, RINGS, ROUNDED
from exactpt.scene.scene import Scene
from exactpt.tiling.start import TILINGS
from fuzz import corpus
from fuzz.cases import failure_of
from fuzz.statics import run_and_audit
from fuzz.subscene import scene_of
from fuzz.witnesses import WITNESSES

GENERIC = ("convex", "mixed_shapes", "ballistic", "turning", "deforming", "pieces", "keyframed")
QUICK = ("reference", "static", "filters")


@pytest.mark.parametrize("family", [*FAMILIES, *POINTS])
def test_no_witness_objects(family):
    for seed in (1, 2, 3):
        scene = scene_of(family, seed)
        for witness in QUICK:
            assert failure_of(witness, scene, seed) is None


@pytest.mark.parametrize("family", [*ROUNDED, *RINGS])
def test_variants_of_rounded_bodies_and_rings_have_the_image_of_the_contact(family):
    """Bug: of discs that just touch, the contact was missed 2^60 from the origin."""
    for seed in range(1, 21):
        assert failure_of("symmetry", scene_of(family, seed), seed) is None


@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize("family", GENERIC)
def test_what_is_generic_needs_no_rebuild(family, tiling):
    """A repair that is left out or done wrongly would be made good by one, and go unseen."""
    events = 0
    for seed in range(1, 9):
        run = run_and_audit(scene_of(family, seed), tiling, middle=False)
        if run is not None:
            stats = run.kinetic.stats
            events += stats.total
            assert (stats.rebuilds, stats.flips) == (0, 0)

    assert events


@pytest.mark.slow
@pytest.mark.cgal
@pytest.mark.parametrize("family", [*FAMILIES, *POINTS])
def test_no_witness_objects_to_more(family, program):
    for seed in range(4, 24):
        scene = scene_of(family, seed)
        for witness in WITNESSES:
            assert failure_of(witness, scene, seed) is None


FILES = corpus.files()
BY_CGAL = {"cgal", "proof"}
ALL = [pytest.param(name, marks=pytest.mark.cgal if name in BY_CGAL else ()) for name in WITNESSES]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
@pytest.mark.parametrize("witness", ALL)
def test_what_once_failed_does_not(path, witness):
    assert failure_of(witness, Scene.load(path), patience=20.0) is None


@every("path", FILES)
def test_every_scene_of_the_corpus_has_a_note(path):
    assert path.with_suffix(".txt").read_text(encoding="utf-8").strip()
    assert json.loads(path.read_text(encoding="utf-8"))["exactpt"] == 1
