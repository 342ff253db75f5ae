"""`every` of tests/helpers/folding.py: many cases in one test."""

import pytest
from folding import every


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
