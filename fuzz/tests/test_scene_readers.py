"""Damaged scenes: the package and both checkers accept one, or all of them refuse it."""

import re

import pytest
from click.testing import CliRunner

from exactpt import proof_scene
from fuzz.proofs import readers
from fuzz.proofs.command import scene_readers

pytestmark = pytest.mark.cgal


@pytest.fixture(autouse=True)
def _program(program, monkeypatch):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(program))


def run(folder, *, cases=150, seed=5):
    words = ["--cases", str(cases), "--seed", str(seed), "--keep", str(folder), "--jobs", "0"]
    return CliRunner().invoke(scene_readers, words, catch_exceptions=False)


def test_all_readers_agree_on_damaged_scenes(tmp_path):
    done = run(tmp_path / "found")
    assert done.exit_code == 0, done.output
    counts = dict(re.findall(r"(read|refused): (\d+) scenes", done.output))
    assert int(counts["read"]) > 20
    assert int(counts["refused"]) > 60
    assert not (tmp_path / "found").exists()


def test_a_reader_that_accepts_everything_is_found(tmp_path, monkeypatch):
    monkeypatch.setattr(readers, "by_cpp", lambda *_, **__: "")
    done = run(tmp_path / "found", cases=30)
    assert done.exit_code == 1
    kept = list((tmp_path / "found").iterdir())
    assert kept
    for path in kept:
        with pytest.raises(proof_scene.NoProofError):
            proof_scene.Scene(path.read_text(encoding="utf-8"), are_records_verified=False)


@pytest.fixture(scope="module")
def damaged():
    """Scenes, and why they are refused."""
    scenes = [readers.damaged_scene(2, number) for number in range(900)]
    return [
        (scene, readers.by_python(scene, are_records_verified=True)) for scene in scenes if scene
    ]


@pytest.mark.parametrize(
    "key, words",
    [
        ("ignoring", ["fewer than two", "no such body", "no body matches"]),
        ("units", ["control character", "neither a length"]),
        ("epoch", ["not a date", "no such", "it needs units"]),
        ("angle_error", ["without a pivot", "negative angle_error"]),
        ("pivot", ["without an angle_error", "two pivots"]),
    ],
)
def test_damages_are_of_every_class(damaged, key, words):
    found = {reason for scene, reason in damaged if key.encode() in scene}
    assert "" in found
    for word in words:
        assert any(word in reason for reason in found), word


def test_a_dressed_scene_is_read():
    for number in range(readers.BASES):
        text = readers.base(number)
        if text:
            assert readers.by_python(text.encode(), are_records_verified=True) == "", number
