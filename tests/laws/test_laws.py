"""The laws under pytest: one test for each of them, with the cases of a tier.

With --quick it is the tier "quick", else "full". The number of cases follows from recorded costs,
so the same cases are checked on every machine. `python -m fuzz run` checks others.
"""

import pytest

from fuzz.laws.known import KNOWN, reason_of
from fuzz.laws.runner import Case, Tally, cases_of, count_of, look, shrunk
from fuzz.laws.table import LAWS

SEED = 0
SHRINKING = 5.0  # seconds


def marked(law):
    """A law with its marks: of CGAL, which `make test` demands, and of what may be not built."""
    one = LAWS[law]
    if one.needs == "cgal":
        return pytest.param(law, marks=pytest.mark.cgal)
    reason = f"{one.needs} is not built"
    return pytest.param(law, marks=pytest.mark.skipif(not one.is_runnable, reason=reason))


@pytest.mark.parametrize("law", [marked(law) for law in LAWS])
def test_law(law, tier):
    tally = Tally()
    for case in cases_of(law, SEED, count_of(law, tier)):
        looked = look(case)
        tally.add(looked)
        if looked.fault is not None and reason_of(str(case)) is None:
            pytest.fail(shrunk(looked.fault, SHRINKING).report, pytrace=False)
    if tier == "full" and not tally.said(law):
        pytest.fail(f"the law says nothing: {tally.table()[1]}", pytrace=False)


def test_known_cases_are_broken_still():
    healed = [known for known in KNOWN if look(Case.parse(known.case)).fault is None]

    assert healed == [], "to be removed from fuzz/laws/known.py"
