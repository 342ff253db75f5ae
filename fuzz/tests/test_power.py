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
from fuzz.power.hunt import DIED, Found, Reach, by_laws
from fuzz.power.mistakes import Mistake, planted
from fuzz.power.mutants import _sites, mutants, named_mutant
from fuzz.power.probe import NAME, PROBE, insert_probe, probed
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


def test_mutant_of_a_name_is_the_one_that_was_drawn():
    for one in mutants(6, 1, ["planar", "query"]):
        again = named_mutant(one.name)
        assert (again.name, again.lines) == (one.name, one.lines)


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("exactpt.planar.pears.peel[0]: 0 -> 1", "no such place"),
        ("exactpt.planar.halfedge.twin[999]: 0 -> 1", "no such place"),
        ("exactpt.planar.halfedge.twin[0]: 0 -> 1", "the place is now 'exactpt.planar.halfedge."),
        ("pears[0]: 0 -> 1", "no place of exactpt"),
        ("events dropped", "no place of exactpt"),
    ],
)
def test_mutant_whose_place_has_changed_is_refused(name, why):
    with pytest.raises(InputError, match=why):
        named_mutant(name)


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


# Probes


PROBED = """
def parity(n):
    if n < 0:
        n = -n
    for _ in range(n):
        if n % 2:
            return 1
        else:
            n = n
    return 0
"""


@pytest.mark.parametrize(
    ("line", "reaching"),
    [(3, [-1, 0, 1, 2]), (4, [-1]), (6, [-1, 1, 2]), (7, [-1, 1]), (9, [2]), (10, [0, 2])],
)
def test_probe_says_whether_the_statement_of_a_line_has_been_run(line, reaching):
    """`n = -n` is run for -1 only, the loop for all but 0, `else` for 2 only."""
    tree = ast.parse(PROBED)
    insert_probe(tree.body[0], line)
    names = {NAME: PROBE}
    exec(compile(tree, "<test>", "exec"), names)
    found, answers = [], {}
    for n in (-1, 0, 1, 2):
        PROBE.take()
        answers[n] = names["parity"](n)
        if PROBE.take():
            found.append(n)

    assert found == reaching
    assert answers == {-1: 1, 0: 0, 1: 1, 2: 0}


def test_probed_function_does_the_same():
    PROBE.take()

    assert probed(max)(3, 7, key=lambda n: -n) == 3
    assert PROBE.take()
    assert not PROBE.take()


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


def test_law_whose_cases_run_the_changed_line_has_most_of_the_time(monkeypatch):
    """Of three laws of equal cost, one never runs it, and one in one case of ten.

    In 1000 turns that go to the least number for the worth, the others have a few.
    """
    monkeypatch.setattr("fuzz.power.hunt.cost_of", {"never": 3.0, "rarely": 2.0, "always": 1.0}.get)
    reach = Reach(["never", "rarely", "always"])
    counts = dict.fromkeys(reach.laws, 0)

    for _ in range(1000):
        law = min(counts, key=lambda name: counts[name] / reach.worth(name))
        counts[law] += 1
        reach.add(law, is_reached=law == "always" or (law == "rarely" and counts[law] % 10 == 1))

    assert reach.laws == ["always", "rarely", "never"]  # quick ones first
    assert (reach.tried, reach.number) == (1000, 2)
    assert 0 < counts["never"] < 30 < counts["rarely"] < 200
    assert counts["always"] > 800


def test_laws_that_reach_a_mistake_are_counted():
    """Only the laws of budgets ask what a search has reached: of two, one reaches the mistake."""
    mistake = the_planted("no contact for a double too long")

    found = by_laws(mistake, ["exchange/results", "budget/searches"], 0, 1.5)

    assert found.reaching == 1


# What reaches a line


@pytest.fixture
def database(tmp_path):
    """Lines 1 and 2 of a file are run by one test of a file, line 2 by another file."""
    path = tmp_path / "some.coverage"
    data = coverage.CoverageData(str(path))
    data.set_context("tests/unit/test_one.py::test_a|run")
    data.add_lines({"/elsewhere/exactpt/brief.py": [1, 2]})
    data.set_context("tests/unit/test_two.py")
    data.add_lines({"/elsewhere/exactpt/brief.py": [2], "/elsewhere/exactpt/files.py": [9]})
    data.write()
    return path


@pytest.mark.parametrize(
    ("first", "last", "reaching"),
    [
        (1, 1, ["tests/unit/test_one.py", "test_new.py"]),
        (2, 2, ["tests/unit/test_one.py", "tests/unit/test_two.py", "test_new.py"]),
        (3, 9, ["test_new.py"]),
    ],
)
def test_line_is_reached_by_those_who_ran_it_and_those_not_recorded(
    database, first, last, reaching
):
    files = ["tests/unit/test_one.py", "tests/unit/test_two.py", "test_new.py"]

    found = Reached([database]).among(files, Lines("exactpt/brief.py", first, last))

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


def test_only_mutants_that_nothing_found_are_hunted_again(tmp_path):
    one, other = mutants(2, 0, ["planar"])
    results = tmp_path / "results.jsonl"
    found = Found("a law", "a case", "a reason", 7, 3.0, 5)
    rows = [
        command.Row(one.name, str(one.lines), is_masked=False, laws=found),
        command.Row(other.name, str(other.lines), is_masked=False, laws=Found()),
    ]
    results.write_text("".join(f"{row.to_json()}\n" for row in rows), encoding="utf-8")
    words = ["--again", str(results), "--law", "distance/order", "--seconds", "0.1"]

    result = CliRunner().invoke(command.power, words)

    assert "1 mistakes, 0 of them masked" in result.output
    assert other.name in result.output
    assert one.name not in result.output


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
        (["--again", __file__, "--mutants", "1"], "--again and --mutants exclude each other"),
        (["--again", __file__, "--results", __file__], "--again and --results are one file"),
        (["--again", __file__], "test_power.py: line 1: expected a row of results, got"),
        (["--results", __file__], "test_power.py: line 1: expected a row of results, got"),
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
