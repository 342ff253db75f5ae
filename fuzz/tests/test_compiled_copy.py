"""The compiled copy: it is of the sources that are here, and the law sees where it differs."""

import shutil
from random import Random

import pytest

from exactpt import Body, InputError, Scene, Translation
from fuzz import compiled_copy
from fuzz.laws.witnessed import compiled_is_plain
from fuzz.old_engine.process import compiled_engine
from fuzz.witnesses import Difference

SCENE = Scene(
    [
        Body("o", [(0, 0), (1, 0), (0, 1)]),
        Body("p", [(3, 0), (4, 0), (4, 1)], Translation([0, -1])),
    ],
    time=(0, 9),
)


@pytest.fixture
def copy(tmp_path):
    """The sources as a copy that claims to be compiled."""
    left_out = shutil.ignore_patterns("*.so", "__pycache__")
    shutil.copytree(compiled_copy.ROOT / "exactpt", tmp_path / "exactpt", ignore=left_out)
    (tmp_path / "exactpt" / "compiled.txt").write_text("", encoding="utf-8")
    return tmp_path


def test_copy_of_the_same_sources_is_built(copy):
    assert compiled_copy.is_built(copy)


def test_copy_of_other_sources_is_not_built(copy):
    with (copy / "exactpt" / "brief.py").open("a", encoding="utf-8") as file:
        file.write("# edited\n")

    assert not compiled_copy.is_built(copy)


def test_copy_that_was_not_compiled_is_not_built(copy):
    (copy / "exactpt" / "compiled.txt").unlink()

    assert not compiled_copy.is_built(copy)
    assert not compiled_copy.is_built(copy / "nowhere")


def test_law_without_a_copy_is_refused(monkeypatch):
    monkeypatch.setattr(compiled_copy, "is_built", lambda: False)

    with pytest.raises(InputError, match="not these: make compiled-copy"):
        compiled_engine()


def outcomes(copy, monkeypatch):
    monkeypatch.setattr(compiled_copy, "is_built", lambda: True)
    monkeypatch.setattr(compiled_copy, "FOLDER", copy)
    try:
        return {compiled_is_plain(SCENE, Random(k)) for k in range(12)}
    finally:
        compiled_engine().close()


def test_law_holds_for_a_copy_that_answers_the_same(copy, monkeypatch):
    assert {"run, said", "first contact, said"} <= outcomes(copy, monkeypatch)


def test_law_is_broken_by_a_copy_that_answers_otherwise(copy, monkeypatch):
    """The copy gives all events another kind."""
    path = copy / "exactpt" / "simulation" / "event.py"
    text = path.read_text(encoding="utf-8")
    assert text.count('"kind": ') == 1
    path.write_text(text.replace('"kind": ', '"kinds": '), encoding="utf-8")

    with pytest.raises(Difference, match="run, compiled: Answer"):
        outcomes(copy, monkeypatch)
