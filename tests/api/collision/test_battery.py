"""The battery of degenerate scenes: every tiling against the reference and CGAL."""

import pytest

from fuzz.battery import BATTERY, play, table

QUICK = ("row", "mirror", "polygons in step, corner")
MAX_REBUILDS = 30


@pytest.mark.long("row end to end", "row, closing in")
@pytest.mark.parametrize(
    "name",
    [
        name if name.startswith(QUICK) else pytest.param(name, marks=pytest.mark.slow)
        for name in BATTERY
    ],
)
def test_battery(name):
    rows = list(play(name, cgal=False))

    print("\n".join(table(rows)))  # noqa: T201 - shown with -s
    assert [row.differences for row in rows] == [[]] * len(rows)
    assert all(row.rebuilds <= MAX_REBUILDS for row in rows)


@pytest.mark.cgal
@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, trial in BATTERY.items() if not trial.large])
def test_battery_with_cgal(name, program):
    for row in play(name):
        assert row.differences == []
        assert row.snapshots == 5 or row.contact.startswith("0 ")
