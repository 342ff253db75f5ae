"""What the tiers of the tests stand on: cases in a loop, budgets, and a case for every package."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from folding import every

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
