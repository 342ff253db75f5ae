"""Damaged proofs and scenes get one exit code, and one statement, from both checkers."""

import re
from random import Random

import pytest
from click.testing import CliRunner

from fuzz.proofs import both
from fuzz.proofs.command import proof_both

pytestmark = pytest.mark.cgal


def test_both_checkers_agree_on_what_is_damaged(program, monkeypatch, tmp_path):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(program))
    words = ["--cases", "60", "--seed", "7", "--keep", str(tmp_path / "found"), "--jobs", "0"]
    done = CliRunner().invoke(proof_both, words, catch_exceptions=False)
    assert done.exit_code == 0, done.output
    assert done.output.endswith(": 0 differences\n")
    assert sum(int(n) for n in re.findall(r": (\d+) proofs", done.output)) == 60
    assert not (tmp_path / "found").exists()


def test_another_statement_is_a_disagreement(program, monkeypatch, tmp_path):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(program))
    verdicts = [
        ((0, "accepted: 1"), (0, "accepted: 2")),
        ((1, "a"), (2, "b")),
        ((1, "a"), (1, "b")),
    ]
    found = iter(verdicts)
    monkeypatch.setattr(both, "verdicts", lambda *_: next(found))
    words = ["--cases", "3", "--keep", str(tmp_path / "found"), "--jobs", "0"]
    done = CliRunner().invoke(proof_both, words)
    assert done.exit_code == 1
    assert ": 2 differences" in done.output
    assert len(list((tmp_path / "found").iterdir())) == 4


def test_damages_are_of_every_class():
    pairs = [pair for number in range(200) if (pair := both.damaged(3, number))]
    assert len(pairs) > 40
    codes = [both.verdicts(*pair)[0][0] for pair in pairs[:40]]
    assert {0, 1, 2} <= set(codes)


def test_bug_a_line_that_a_damage_had_emptied_ended_the_campaign():
    random = Random(0)
    for _ in range(400):  # every damage of a line without words
        assert both._lines(["exactpt-proof 1", "scene", "span 0 1", "", ""], random)
