"""The campaign of certificates: right ones are accepted, wrong ones rejected, or true."""

import json

import pytest
from click.testing import CliRunner

import exactpt
from exactpt import check_apart
from exactpt.scene.scene import Scene
from fuzz.proofs import apart
from fuzz.proofs.apart import is_true
from fuzz.proofs.command import certificates

pytestmark = pytest.mark.cgal


@pytest.fixture(autouse=True)
def _program(program, monkeypatch):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(program))


def run(folder, count, start=0):
    words = ["--cases", count, "--start", start, "--jobs", 0, "--keep", folder / "found"]
    return CliRunner().invoke(certificates, list(map(str, words)))


def test_a_few_families(tmp_path):
    done = run(tmp_path, 3, start=4)
    assert done.exit_code == 0, done.output
    assert "a node left out: " in done.output
    assert "3 cases in" in done.output


@pytest.mark.parametrize("check", ["check_apart", "check_outside"])
def test_a_checker_without_a_check_is_found(tmp_path, monkeypatch, check):
    monkeypatch.setattr(check_apart.Checker, check, lambda _: None)
    numbers = {"check_apart": 4, "check_outside": 8}
    if check == "check_outside":  # a point inside a body from the start on
        inner = exactpt.Body("b", [(1, 1)])
        scene = exactpt.Scene([exactpt.Body("a", [(0, 0), (3, 0), (0, 3)]), inner], time=(0, 1))
        monkeypatch.setattr(apart, "generate", lambda *_: scene)
        monkeypatch.setattr(apart, "first_contact", lambda *_, **__: None)
    done = run(tmp_path, 1, start=numbers[check])
    assert done.exit_code == 1, done.output
    assert list((tmp_path / "found").iterdir())


def test_truth_by_all_pairs():
    box = [(0, 0), (1, 0), (1, 1), (0, 1)]
    fast = exactpt.Body("b", [(x + 5, y) for x, y in box], exactpt.Translation([0, -1]))
    scene = exactpt.Scene([exactpt.Body("a", box), fast], time=(0, 8))
    made = Scene.from_json(json.loads(exactpt.certify(scene).scene))
    lines = ["exactpt-apart 1", "scene sha256 0", "span 0 3"]
    assert is_true(made, [*lines, "none"])
    assert is_true(made, [*lines, "distance 1/2", "none"])
    assert not is_true(made, [*lines, "distance 2", "none"])
    assert is_true(made, [*lines, "meet 4 0 0"])
    assert not is_true(made, [*lines, "meet 7/2 0 0"])
    assert not is_true(made, [*lines[:2], "span 0 5", "none"])
    assert is_true(made, [*lines[:2], "span 0 5", "between 0 0", "none"])
    assert is_true(made, [*lines[:2], "span 0 5", "ignoring 0 1", "none"])
