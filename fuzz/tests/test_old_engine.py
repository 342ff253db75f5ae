"""The old engine: a process that answers, ends, hangs or is another one; scenes left out."""

import json
import subprocess
from pathlib import Path

import pytest
from click.testing import CliRunner

import exactpt
from exactpt import (
    AlgebraicNumber,
    Body,
    EnclosedContact,
    InputError,
    Scene,
    Spin,
    Translation,
)
from exactpt.errors import AuditError
from exactpt.kernel.numbers import QQ
from exactpt.kernel.square_root import RootBounds
from exactpt.testing.scenes import EVERY
from fuzz import __main__ as command
from fuzz import commits
from fuzz.cases import LEFT_OUT, Case, Scenes, run_case
from fuzz.changes.excerpts import scene_of
from fuzz.old_engine import build
from fuzz.old_engine.answers import QUESTIONS, answer_to
from fuzz.old_engine.compare import Compared, compared
from fuzz.old_engine.process import Answer, OtherEngine
from fuzz.witnesses import OLD, WITNESSES, Difference, LeftOutError, tilings_of

BOX = Body("box", [(0, 0), (2, 0), (2, 1), (0, 1)], Translation([0, "1/2"]))
WALL = Body("wall", [(4, -5), (5, -5), (5, 5), (4, 5)])
TWO = Scene([BOX, WALL], time=(0, 10))
"""The box moves by 1/2 a unit of time, 2 units to the wall: they touch at t = 4."""


@pytest.fixture
def engine(tmp_path):
    """The package of this checkout in the place of the old one: the same answers."""
    (tmp_path / "exactpt").symlink_to(Path(exactpt.__file__).parent)
    running = OtherEngine(tmp_path)
    yield running
    running.close()


def package(folder, text):
    """Write a package that is imported in the place of the old one."""
    (folder / "exactpt").mkdir()
    (folder / "exactpt" / "__init__.py").write_text(
        "import exactpt.real as real\n"
        "from exactpt.real import AlgebraicNumber, InputError, Scene\n" + text
    )
    (folder / "exactpt" / "real.py").write_text(
        "class InputError(Exception): ...\n"
        "class AlgebraicNumber: ...\n"
        "class Scene:\n"
        "    @classmethod\n"
        "    def from_json(cls, data): return cls()\n"
    )
    return OtherEngine(folder)


def test_old_engine_asked_for_the_first_contact_says_it_as_json(engine):
    answer = engine.ask("first contact", TWO)

    assert answer.kind == "said"
    assert '"low": "4", "high": "4"' in answer.text
    assert answer == Answer.of(answer_to("first contact", TWO, {}))


def test_all_questions_about_a_scene_have_the_same_answers(engine):
    asked = list(compared(TWO, tilings_of(TWO), None, engine))

    assert {a.question for a in asked} == set(QUESTIONS) - {"run"}  # events have another form
    assert [a for a in asked if a.new != a.old] == []
    assert [a for a in asked if a.is_left_out] == []


def test_every_family_has_the_same_answers(engine):
    for turn, family in enumerate(EVERY):
        scene = scene_of(family, 1)
        for asked in compared(scene, tilings_of(scene), turn, engine):
            assert asked.new == asked.old, (family, asked)


def bounds(low, high):
    """Return the answer that an enclosed contact is between two times, or not certain (None)."""
    upper = None if high is None else AlgebraicNumber(high)
    found = EnclosedContact(AlgebraicNumber(low), upper, (("a", "b"),))
    return Answer("said", json.dumps(found.to_json()))


NO_CONTACT = Answer("said", "null")


@pytest.mark.parametrize(
    "new, old",
    [
        (bounds("3/2", 2), bounds(1, 2)),  # narrower
        (bounds(1, 3), bounds(1, 2)),
        (bounds(2, 3), bounds(1, 2)),  # t = 2 is possible by both
        (bounds(1, None), bounds(1, 2)),
        (bounds(1, 2), bounds(1, None)),
        (NO_CONTACT, bounds(1, None)),
    ],
)
def test_bounds_that_can_be_of_one_time_agree(new, old):
    assert Compared("enclosed contact", {}, new, old, are_bounds=True).agrees
    assert not Compared("enclosed contact", {}, new, old, are_bounds=False).agrees


@pytest.mark.parametrize(
    "new, old",
    [
        (bounds(3, 4), bounds(1, 2)),
        (bounds(3, None), bounds(1, 2)),
        (NO_CONTACT, bounds(1, 2)),
        (bounds(1, 2), NO_CONTACT),
        (bounds(1, None), NO_CONTACT),  # the old version excludes what this one does not
        (bounds(1, 3), bounds(2, 3)),  # an earlier lower bound: bodies are displaced further
        (Answer("refused", "no scene"), bounds(1, 2)),
    ],
)
def test_bounds_of_no_common_time_or_wider_ones_are_a_difference(new, old):
    assert not Compared("enclosed contact", {}, new, old, are_bounds=True).agrees


def test_only_bounds_of_bodies_that_spin_are_compared_as_bounds(engine):
    spinning = Body("blade", [(0, 0), (2, 0)], Spin(1, error="1/1000"))
    scene = Scene([spinning, WALL], time=(0, 2))

    asked = list(compared(scene, tilings_of(scene), None, engine))

    assert {a.question for a in asked if a.are_bounds} == {"enclosed contact"}
    assert not any(a.are_bounds for a in compared(TWO, tilings_of(TWO), None, engine))


def test_bug_bounds_of_a_rational_arm_were_compared_as_texts(monkeypatch):
    """The old version took 1 + 2^-24 for the arm of this tip, 1: its bound is earlier."""
    tip = Body("tip", [(1, 0)], Spin(1, error=1))
    question = "enclosed contact", Scene([tip, Body("post", [(0, 1)])], time=(0, 3)), {}
    new = Answer.of(answer_to(*question))
    arm = RootBounds(QQ(1), 1 + QQ(1, 2**24))
    monkeypatch.setattr("exactpt.motion.displacement.root_bounds", lambda _: arm)
    old = Answer.of(answer_to(*question))

    assert new != old
    assert Compared("enclosed contact", {}, new, old, are_bounds=True).agrees
    assert not Compared("enclosed contact", {}, old, new, are_bounds=True).agrees


def test_what_the_old_engine_refuses_is_left_out(engine):
    answer = engine.ask("first contact", TWO, method="by magic")

    assert answer.kind == "refused"
    assert engine.ask("first contact", TWO).kind == "said"


def test_old_engine_that_was_killed_is_started_again(engine):
    engine.ask("first contact", TWO)
    engine._process.kill()
    engine._process.wait()

    assert engine.ask("first contact", TWO).kind == "said"


def test_old_engine_that_ends_while_it_is_asked_is_an_error_and_started_again(tmp_path):
    engine = package(tmp_path, "import os\ndef first_contact(scene): os._exit(3)\n")

    for _ in range(2):
        with pytest.raises(AuditError, match="the process has ended"):
            engine.ask("first contact", TWO)


def test_old_engine_without_an_answer_is_ended(tmp_path, monkeypatch):
    engine = package(tmp_path, "import time\ndef first_contact(scene): time.sleep(60)\n")
    monkeypatch.setattr("fuzz.old_engine.process.PATIENCE", 2.0)

    with pytest.raises(AuditError, match="no answer in 2 seconds"):
        engine.ask("first contact", TWO)
    assert engine._process is None


def test_another_package_than_the_old_one_is_refused(tmp_path):
    """Without a package in its folder, the process would find the checkout that is installed."""
    engine = OtherEngine(tmp_path)

    with pytest.raises((InputError, AuditError), match="the old engine: "):
        engine.ask("first contact", TWO)


def test_an_answer_that_has_changed_is_a_difference(monkeypatch, engine):
    monkeypatch.setattr("fuzz.witnesses.old_engine", lambda: engine)
    WITNESSES[OLD](TWO, None)

    monkeypatch.setitem(QUESTIONS, "distance", lambda *_: "another")
    with pytest.raises(Difference, match="distance: said"):
        WITNESSES[OLD](TWO, None)


def test_a_scene_that_is_left_out_is_counted(monkeypatch):
    def says_nothing(*_):
        raise LeftOutError

    monkeypatch.setitem(WITNESSES, OLD, says_nothing)
    result = run_case(Case(0, "row", 1), witnesses=[OLD])

    assert result.findings == []
    assert result.counts["row", LEFT_OUT] == 1
    assert Scenes(("row",), (OLD,)).table(result.counts)[-1].startswith("1 cases left out")


def test_old_engine_that_is_not_built_is_left_out_with_a_line(monkeypatch):
    monkeypatch.setattr(command, "is_built", lambda: False)

    done = CliRunner().invoke(command.fuzz, ["--cases", "1", "--jobs", "0", "row", "--shrink", "0"])

    assert "the witness old is left out: it is not built (make old-engine)" in done.output
    assert "witnesses reference, static, filters, symmetry, cgal, proof\n" in done.output
    assert done.exit_code == 0


def test_old_engine_that_is_not_built_is_refused_if_it_is_asked_for(monkeypatch):
    monkeypatch.setattr(command, "is_built", lambda: False)

    done = CliRunner().invoke(command.fuzz, ["--cases", "1", "--witness", "old"])

    assert done.exit_code == 2
    assert "the witness old is not built; to build it: make old-engine" in done.output


def test_families_that_spin_are_refused_by_the_other_witnesses():
    done = CliRunner().invoke(command.fuzz, ["gears", "--witness", "reference"])

    assert done.exit_code == 2
    assert "gears: bodies that spin are for --witness old alone" in done.output


@pytest.mark.slow
def test_the_old_engine_is_built_of_its_commit_and_says_its_version(tmp_path, monkeypatch):
    known = subprocess.run(
        ["git", "-C", commits.ROOT, "cat-file", "-e", build.COMMIT],
        check=False,
        capture_output=True,
    )
    if known.returncode != 0:
        pytest.skip("no repository with this commit")
    monkeypatch.setattr(build, "FOLDER", tmp_path / "old")
    monkeypatch.setattr(build, "SITE", tmp_path / "old" / "site")
    monkeypatch.setattr(build, "_BUILT", tmp_path / "old" / "commit.txt")

    assert not build.is_built()
    wheel = build.build()

    assert build.is_built()
    assert wheel.name == "exactpt-0.2.0-py3-none-any.whl"
    engine = OtherEngine(build.SITE)
    assert '"low": "4"' in engine.ask("first contact", TWO).text
    engine.close()


def test_a_commit_that_is_not_there_is_an_error_of_one_line(tmp_path, monkeypatch):
    monkeypatch.setattr(build, "FOLDER", tmp_path / "old")
    monkeypatch.setattr(commits, "ROOT", tmp_path)

    with pytest.raises(InputError, match="the old engine: no commit c49c20d6") as error:
        build.build()
    assert "\n" not in str(error.value)
