"""Every scene that the fuzzer ever broke something with, before all witnesses, for ever."""

import json

import pytest
from folding import every

from exactpt.scene.scene import Scene
from fuzz import corpus
from fuzz.cases import failure_of
from fuzz.witnesses import WITNESSES

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
