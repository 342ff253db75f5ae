"""Kept cases under every law that suits them: one test for each file of tests/cases.

In the tier "quick" a case is checked by the law that it once broke, and by some others, which its
name decides. A law that says nothing about a scene leaves it out by itself.
"""

from zlib import crc32

import pytest

from fuzz.laws.kept import PREFIX, kept, names
from fuzz.laws.known import reason_of
from fuzz.laws.law import PROGRAMS
from fuzz.laws.runner import Case, laws_of_cases, look, shrunk

SHRINKING = 5.0  # seconds
DRAWS = {"quick": 1, "full": 2}  # random choices of a law in a scene
QUICK = 4  # laws of a case in the tier "quick"


def laws_of(name, case, needs, tier):
    """Return the laws under which a case is checked."""
    laws = [law for law in laws_of_cases(needs) if law not in case.skip]
    if tier == "full":
        return laws
    broken = [law for law in laws if law == case.law]
    others = [law for law in laws if law != case.law]
    others.sort(key=lambda law: crc32(f"{name} {law}".encode()))
    return broken + others[:QUICK]


def check(name, tier, needs=""):
    case = kept(name)
    for law in laws_of(name, case, needs, tier):
        for number in range(DRAWS[tier]):
            one = Case(law, f"{PREFIX}{name}", 0, number)
            fault = look(one).fault
            if fault is not None and reason_of(str(one)) is None:
                report = shrunk(fault, SHRINKING).report
                pytest.fail(f"{name}: {case.note}\n{report}", pytrace=False)


@pytest.mark.parametrize("name", names())
def test_laws_hold_in_a_kept_case(name, tier):
    check(name, tier)


@pytest.mark.cgal
@pytest.mark.parametrize("name", names())
def test_cgal_confirms_a_kept_case(name, tier):
    check(name, tier, needs="cgal")


@pytest.mark.parametrize("needs", [needs for needs in PROGRAMS if needs != "cgal"])
def test_another_program_confirms_kept_cases(needs, tier):
    if not PROGRAMS[needs]():
        pytest.skip(f"{needs} is not built")
    for name in names():
        check(name, tier, needs)
