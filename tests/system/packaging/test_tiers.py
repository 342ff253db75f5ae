"""Tiers of the tests, turns of the slow ones, and the worth of the quick ones."""

import ast
import os
import re
import subprocess
import sys
from collections import Counter
from datetime import date, timedelta
from pathlib import Path
from random import Random

import pytest
from folding import every
from rotation import DAYS, parts, seconds_of, turn_of

from fuzz.quick_worth import _changes, _exchange, mutants, planted

ROOT = Path(__file__).parents[3]
QUICK = ("unit", "api")


def test_cases_in_a_loop_all_run_and_every_miss_is_reported():
    seen = []

    @every("a, b", [(1, 1), (1, 2), (3, 3), (4, 5)])
    @every("c", [7, 8])
    def check(a, b, c, fixture):
        seen.append((a, b, c, fixture))
        if c == 8:
            assert a == b
        elif a == 4:
            pytest.fail("four")

    with pytest.raises(BaseExceptionGroup, match="2 of 4 cases") as caught:
        check(fixture="x")

    assert seen == [(a, b, c, "x") for a, b in ((1, 1), (1, 2), (3, 3), (4, 5)) for c in (7, 8)]
    assert [group.__notes__ for group in caught.value.exceptions] == [
        ["case: 1, 2"],
        ["case: 4, 5"],
    ]
    assert [len(group.exceptions) for group in caught.value.exceptions] == [1, 2]


def run(tmp_path, text, *options):
    """Run a file of tests in this checkout's configuration."""
    (tmp_path / "test_tried.py").write_text(text)
    program = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-c"]
    program += [ROOT / "pyproject.toml", "--rootdir", ROOT, "--confcutdir", ROOT]
    return subprocess.run(
        [*program, "-p", "conftest", tmp_path / "test_tried.py", *options],
        cwd=ROOT / "tests", env={**os.environ, "QUICK_BUDGET": "0.25"},
        capture_output=True, text=True, check=False,
    ).stdout  # fmt: skip


def test_the_budget_of_the_quick_tier(tmp_path):
    text = """
import time, pytest

def spend():
    began = time.process_time()
    while time.process_time() < began + 0.3:
        pass

def test_spends():
    spend()

@pytest.mark.long
def test_spends_and_says_so():
    spend()

@pytest.mark.long("b")
@pytest.mark.parametrize("case", ["a", "b"])
def test_one_case(case):
    assert case == "a"
"""
    quick = run(tmp_path, text, "--quick")

    assert "1 failed, 1 passed, 2 deselected" in quick
    assert re.search(r"0\.\d+ s of processor time: mark it long, or make it shorter", quick)
    assert "1 failed, 3 passed" in run(tmp_path, text)


def test_every_package_has_tests_in_the_quick_tier():
    packages = {path.parent.name for path in (ROOT / "exactpt").glob("*/__init__.py")}
    tested = {
        folder.name
        for tier in QUICK
        for folder in (ROOT / "tests" / tier).iterdir()
        if any(folder.glob("test_*.py"))
    }

    assert packages - tested == {"cgal", "workers"}  # these are about other processes: tests/system


def test_tests_are_in_tiers_and_what_they_share_is_in_one_folder():
    files = [path.relative_to(ROOT / "tests") for path in (ROOT / "tests").rglob("*.py")]
    tests = [path for path in files if path.name.startswith("test_")]

    assert {path.parts[0] for path in tests} == {"unit", "api", "system", "campaign"}
    assert all(len(path.parts) == 3 for path in tests)
    assert len({path.name for path in tests}) == len(tests)
    assert {path.parts[0] for path in set(files) - set(tests)} == {
        "conftest.py", "rotation.py", "helpers",
    }  # fmt: skip


# The slow tests take turns: each of them within any fortnight, in parts of about equal time


class Item:
    def __init__(self, nodeid, group=None):
        self.nodeid = nodeid
        self.group = group

    def get_closest_marker(self, _):
        return pytest.mark.xdist_group(self.group).mark if self.group else None


def collected(*options):
    """The slow tests that pytest selects."""
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", "-m", "slow", *options]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return [line for line in listed.splitlines() if "::" in line]


def fortnight(first):
    return [first + timedelta(days) for days in range(DAYS)]


@pytest.mark.parametrize("first", [date(2026, 11, 22), date(2027, 12, 25)])
def test_every_test_has_its_turn_within_a_fortnight(first):
    items = [Item(f"test_{i}", group="one" if i % 10 == 0 else None) for i in range(200)]

    turns = [turn_of(items, day) for day in fortnight(first)]

    assert Counter(item.nodeid for turn in turns for item in turn) == Counter(
        item.nodeid for item in items
    )
    assert [len({item.group for item in turn} & {"one"}) for turn in turns].count(1) == 1


def test_a_part_has_at_most_one_test_more_than_its_share():
    seconds = {f"{i}": Random(i).expovariate(0.1) for i in range(500)}

    sums = [sum(map(seconds.get, part)) for part in parts(seconds)]

    assert max(sums) <= sum(seconds.values()) / DAYS + max(seconds.values())


def test_the_slow_tests_that_exist_take_at_most_five_minutes_on_two_cores_a_day():
    """By the seconds that are written down; a test that is not in the list counts a minute."""
    items = [Item(nodeid) for nodeid in collected()]
    today = date(2026, 11, 22)

    turns = [turn_of(items, day) for day in fortnight(today)]

    assert len(items) > 400
    assert {item.nodeid for turn in turns for item in turn} == {item.nodeid for item in items}
    assert max(sum(seconds_of(item.nodeid) for item in turn) for turn in turns) < 2 * 300 - 60


def test_pytest_selects_the_tests_whose_turn_it_is():
    file = "tests/unit/kernel/test_hard_roots.py"
    today = date(2026, 11, 22)

    selected = collected(file, "--rotating", str(today))

    assert selected == [i.nodeid for i in turn_of([Item(n) for n in collected(file)], today)]
    assert len(selected) > 5


# Mutants for the worth of the quick tier: what is changed, and how

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
    text = _changes(tree.body[0])[k]()
    return text, ast.unparse(tree)


def test_each_change_is_of_one_place_and_of_no_message_or_annotation():
    number = len(_changes(ast.parse(SOURCE).body[0]))
    found = dict(changed(k) for k in range(number))

    assert set(found) == {
        "7 -> 8", "1 -> 2", "9 -> 10", "value + 1 -> value - 1", "found > 9 -> found >= 9",
        "value < found -> value <= found", "k != most -> k == most", "if not found > 9",
        "if not (value < found and k != most)",
        "value < found and k != most -> value < found or k != most",
    }  # fmt: skip
    plain = ast.unparse(ast.parse(SOURCE))
    assert len(set(found.values()) | {plain}) == number + 1


def test_a_mutant_is_another_code_of_a_function_of_the_package():
    for fault in mutants(5, 1):
        assert fault.make.func is _exchange
        function, code = fault.make.args
        assert function.__module__ == fault.module
        assert function.__code__.co_name == code.co_name
        assert function.__code__ != code
    assert [fault.name for fault in mutants(5, 1)] == [fault.name for fault in mutants(5, 1)]


def test_each_planted_mistake_is_a_fault():
    assert {"planted: events dropped", "planted: swept boxes too small"} <= {
        fault.name for fault in planted()
    }
