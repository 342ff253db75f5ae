"""The power of laws and tests: mistakes are drawn, made in processes of their own, and hunted."""

import ast
import gc
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import coverage
import pytest
from click.testing import CliRunner

from exactpt import InputError
from exactpt.tiling.repairs import Repairs
from fuzz.planted import PLANTED
from fuzz.power import command
from fuzz.power.edits import Edit, Lines
from fuzz.power.forked import in_a_process
from fuzz.power.hunt import DIED, Found, by_laws
from fuzz.power.mistakes import Mistake, planted
from fuzz.power.mutants import _sites, mutants
from fuzz.power.reached import Reached

pytestmark = pytest.mark.plain

ROOT = Path(__file__).parents[2]
NOWHERE = Lines("exactpt/brief.py", 1, 1)


def the_planted(words):
    (mistake,) = [one for one in planted() if words in one.name]
    return mistake


def text_of(lines):
    text = (ROOT / lines.file).read_text(encoding="utf-8").splitlines()
    return "\n".join(text[lines.first - 1 : lines.last])


# Mistakes


def test_mutants_of_a_seed_are_the_same_and_of_the_folders_asked_for():
    first, again = (mutants(8, 3, ["query", "planar"]) for _ in range(2))

    assert [one.name for one in first] == [one.name for one in again]
    assert len({one.name for one in first}) == 8
    assert {one.lines.file.split("/")[1] for one in first} <= {"query", "planar"}
    assert mutants(8, 4, ["query", "planar"]) != first


def test_lines_of_a_mutant_have_its_old_text():
    for one in mutants(12, 0, ["planar"]):
        change = one.name.split(": ", 1)[1].removeprefix("if ").removeprefix("not ")
        old = change.split(" -> ")[0].split(" and ")[0].split(" or ")[0]
        assert old.strip("()") in text_of(one.lines).replace("\n", " ")


SOURCE = """
def least(values, most):
    found: int = 7
    for k, value in enumerate(values):
        if value < found and k != most:
            found = value + 1
    if found > 9:
        raise ValueError(f"{found} > 9")
    return found
"""


def changed(k):
    tree = ast.parse(SOURCE)
    site = _sites(tree.body[0])[k]
    return site.change(), (site.first, ast.unparse(tree))


def test_each_change_is_of_one_place_and_of_no_message_or_annotation():
    """The lines are those of the statement: `if` is in line 5, its value in line 6."""
    number = len(_sites(ast.parse(SOURCE).body[0]))
    found = dict(changed(k) for k in range(number))

    assert {text: first for text, (first, _) in found.items()} == {
        "7 -> 8": 3, "value < found -> value <= found": 5, "k != most -> k == most": 5,
        "if not (value < found and k != most)": 5,
        "value < found and k != most -> value < found or k != most": 5,
        "1 -> 2": 6, "value + 1 -> value - 1": 6,
        "9 -> 10": 7, "found > 9 -> found >= 9": 7, "if not found > 9": 7,
    }  # fmt: skip
    plain = ast.unparse(ast.parse(SOURCE))
    assert len({tree for _, tree in found.values()} | {plain}) == number + 1


def test_mutants_of_no_folder_are_refused():
    with pytest.raises(InputError, match="mutants: no folder of exactpt, got 'pears'"):
        mutants(1, 0, ["pears"])


def test_more_mutants_than_places_are_refused():
    with pytest.raises(InputError, match=r"mutants: planar have \d+, got 100000; ask for less"):
        mutants(100_000, 0, ["planar"])


def test_lines_of_an_edit_are_those_of_the_text_it_replaces():
    """`if side > 0` is once in the function; the edit of two lines begins with its first."""
    one = PLANTED["the wrong end of a corner gives way"].change
    assert one.lines.first == one.lines.last
    assert "if side > 0" in text_of(one.lines)
    two = PLANTED["a loop that does not look at the clock"].change
    assert two.lines.last == two.lines.first + 1
    assert text_of(two.lines).strip().startswith("check_budget()")


def test_edit_whose_text_is_not_there_is_refused():
    with pytest.raises(InputError, match="_repair_corner has 0 times the text 'no such text'"):
        Edit(Repairs, "_repair_corner", "no such text", "").lines.file  # noqa: B018


def test_bug_mistake_of_an_edited_function_stays_made():
    """Its context was closed as soon as nobody referred to it: the mistake was never made."""
    mistake = the_planted("the wrong end of a corner")
    right = Repairs._repair_corner.__code__
    try:
        mistake.make()
        gc.collect()
        assert Repairs._repair_corner.__code__ is not right
    finally:
        Repairs._repair_corner.__code__ = right


# Processes


def test_process_sends_lines_and_the_error_by_which_it_ends():
    def work(say):
        say("a line\nof two")
        raise InputError("the end")

    ended = in_a_process(work, 5.0)

    assert ended.lines == ["a line of two", "exactpt.errors.InputError: the end"]
    assert ended.status != 0


def test_process_that_computes_for_ever_is_ended():
    def work(say):
        say("begun")
        while True:
            pass

    ended = in_a_process(work, 0.5)

    assert ended.lines == ["begun"]
    assert 0.5 <= ended.seconds < 8


def test_process_that_waits_for_ever_is_ended_with_its_children():
    def work(say):
        sleeper = subprocess.Popen(["sleep", "60"])
        say(str(sleeper.pid))
        sleeper.wait()

    began = time.monotonic()
    ended = in_a_process(work, 0.5)

    assert time.monotonic() - began < 20
    time.sleep(0.2)
    state = Path(f"/proc/{ended.lines[0]}/stat")
    assert not state.exists() or " Z " in state.read_text()


# Hunting by laws


def test_planted_mistake_is_found_by_a_law_and_nothing_without_it():
    mistake = the_planted("events dropped")
    nothing = mistake._replace(make=lambda: None)

    found = by_laws(mistake, ["tiling/static"], 0, 10.0)
    unfound = by_laws(nothing, ["tiling/static"], 0, 0.5)

    assert found.by == "tiling/static"
    assert "certificates missing or superfluous" in found.why
    assert found.tried < 20
    assert unfound.by == ""
    assert unfound.tried > 0


def test_process_that_dies_counts_as_found():
    dying = Mistake("dies", NOWHERE, lambda: os._exit(3))

    assert by_laws(dying, ["tiling/static"], 0, 1.0).by == DIED


# What reaches a line


@pytest.fixture
def database(tmp_path):
    """Lines 1 and 2 of a file are run by one test of a file, line 2 by a law."""
    path = tmp_path / "some.coverage"
    data = coverage.CoverageData(str(path))
    data.set_context("tests/unit/test_one.py::test_a|run")
    data.add_lines({"/elsewhere/exactpt/brief.py": [1, 2]})
    data.set_context("tiling/static")
    data.add_lines({"/elsewhere/exactpt/brief.py": [2], "/elsewhere/exactpt/files.py": [9]})
    data.write()
    return path


@pytest.mark.parametrize(
    ("first", "last", "reaching"),
    [
        (1, 1, ["tests/unit/test_one.py", "new law"]),
        (2, 2, ["tests/unit/test_one.py", "tiling/static", "new law"]),
        (3, 9, ["new law"]),
    ],
)
def test_line_is_reached_by_those_who_ran_it_and_those_not_recorded(
    database, first, last, reaching
):
    names = ["tests/unit/test_one.py", "tiling/static", "new law"]

    found = Reached([database]).among(names, Lines("exactpt/brief.py", first, last))

    assert found == reaching


def test_without_recorded_coverage_everything_reaches_a_line():
    assert Reached([]).among(["a", "b"], NOWHERE) == ["a", "b"]


def test_coverage_that_is_not_there_or_has_no_contexts_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"none: no such coverage database"):
        Reached([tmp_path / "none"])
    path = tmp_path / "plain"
    data = coverage.CoverageData(str(path))
    data.add_lines({"/elsewhere/exactpt/brief.py": [1]})
    data.write()
    with pytest.raises(InputError, match=r"plain: no contexts; record with --cov-context=test"):
        Reached([path])


# The command


def test_row_of_results_is_not_hunted_again(tmp_path):
    results = tmp_path / "results.jsonl"
    before = Found("a law", "a case", "a reason", 7, 3.0, 5)
    row = command.Row("events dropped", "some/file.py:1", is_masked=False, laws=before)
    results.write_text(row.to_json() + "\n", encoding="utf-8")

    result = CliRunner().invoke(command.power, ["events dropped", "--results", str(results)])

    assert result.exit_code == 0
    assert "laws     3.0 s      7 of   5  a law a case: a reason" in result.output
    assert "found by the laws: 1" in result.output
    assert results.read_text(encoding="utf-8") == row.to_json() + "\n"


TESTS = """
from exactpt import Body, Scene, Translation, clearance

SCENE = Scene([Body("o", [(0, 0)]), Body("p", [(-2, 1)], Translation([0, 1]))], (0, 4))


def below(distance):
    return [(i.start, i.end) for i in clearance(SCENE, "o", "p").below(distance)]


def test_wrong_without_a_mistake(): assert below(1) == [(3, 3)]

def test_right_with_it(): assert len(below(2)) == 1

def test_wrong_with_it(): assert below(1) == [(2, 2)]
"""


def test_mistake_is_found_by_the_test_that_fails_only_with_it(tmp_path):
    """A point passes the origin along y = 1: it is at the distance 1 at t = 2 only, x = t - 2."""
    path = tmp_path / "test_points.py"
    path.write_text(TESTS, encoding="utf-8")
    results = tmp_path / "results.jsonl"
    words = ["power", "single times left out", "--no-laws", "--tests", str(path)]
    line = [sys.executable, "-m", "fuzz", *words, "--results", str(results)]

    ended = subprocess.run(line, cwd=ROOT, capture_output=True, text=True, check=False)

    (row,) = map(json.loads, results.read_text(encoding="utf-8").splitlines())
    assert ended.returncode == 0, ended.stderr
    assert row["laws"] is None
    assert row["tests"]["by"].endswith("test_points.py::test_wrong_with_it")
    assert row["tests"]["tried"] == 3
    assert "found by the tests: 1" in ended.stdout


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["--part", "pairs"], "--part is for mutants; add --mutants"),
        (["--no-laws"], "--no-laws leaves nothing to hunt by; add --tests"),
        (["--law", "pears"], "--law: no law begins with pears"),
        (["--mutants", "1", "--part", "pears"], "no folder of exactpt, got 'pears'"),
        (["--reached", "nowhere"], "nowhere: no such coverage database"),
    ],
)
def test_option_that_cannot_be_followed_is_refused(words, why):
    result = CliRunner().invoke(command.power, words)

    assert result.exit_code == 2
    assert why in result.output
