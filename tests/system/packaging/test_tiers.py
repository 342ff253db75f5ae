"""Tiers of the tests, and turns of the slow ones."""

import subprocess
import sys
from collections import Counter
from datetime import date, timedelta
from pathlib import Path
from random import Random

import pytest
from folding import every
from rotation import DAYS, parts, turn_of

ROOT = Path(__file__).parents[3]


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


def test_pytest_selects_the_tests_whose_turn_it_is():
    file = "tests/unit/kernel/test_hard_roots.py"
    today = date(2026, 11, 22)

    selected = collected(file, "--rotating", str(today))

    assert selected == [i.nodeid for i in turn_of([Item(n) for n in collected(file)], today)]
    assert len(selected) > 5
