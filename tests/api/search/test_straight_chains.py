"""Degenerate scenes: the battery, and contacts in the middle of chains that are straight."""

import pytest

from exactpt import Body, Scene, Translation, first_contact
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from exactpt.tiling.start import TILINGS
from fuzz.battery import BATTERY, play, table
from fuzz.changes.variants import VARIANTS

FALL = Translation([], [0, -1])
FLAT = [(0, 0), (10, 0), (10, 5), (8, 5), (6, 5), (4, 5), (2, 5), (0, 5)]
SLIDING = [{"x": [x, v], "y": [5]} for x, v in ((8, "1/9"), (6, "-1/5"), (4, "1/7"), (2, "1/8"))]
U = [(-20, 0), (-17, 0), (-18, 3), (-19, 1), (-19, 3), (-20, 3)]
SCENES = {
    "a point on an edge with flat vertices": [
        Body("plate", FLAT),
        Body("drop", [(5, 9)], FALL),
    ],
    "a segment on an edge with flat vertices": [
        Body("plate", FLAT),
        Body("stick", [("9/2", 9), ("11/2", 9)], FALL),
    ],
    "a long segment on an edge with flat vertices": [
        Body("plate", FLAT),
        Body("stick", [(-5, 9), (15, 9)], FALL),
    ],
    "a box on an edge with flat vertices": [
        Body("plate", FLAT),
        Body("box", [(1, 9), (9, 9), (9, 10), (7, 10), (3, 10), (1, 10)], FALL),
    ],
    "a stick on an edge with vertices that slide along it": [
        Body("plate", [(0, 0), (10, 0), (10, 5), *SLIDING, (0, 5)]),
        Body("stick", [("9/2", 9), ("11/2", 9)], FALL),
    ],
    "a box on a plate with vertices that slide along it": [
        Body("plate", [(0, 0), (10, 0), (10, 5), *SLIDING, (0, 5)]),
        Body("box", [(1, 9), (9, 9), (9, 10), (1, 10)], FALL),
    ],
    "a bar on a row of boxes that slide apart": [
        *(
            Body(f"b{i}", [(3 * i, 0), (3 * i + 2, 0), (3 * i + 1, 2)], Translation([0, f"{i}/7"]))
            for i in range(5)
        ),
        Body("bar", [(4, 9), (10, 9), (10, 10), (4, 10)], FALL),
    ],
    "a box on a row of boxes": [
        *(Body(f"b{i}", [(3 * i, 0), (3 * i + 2, 0), (3 * i + 1, 2)]) for i in range(5)),
        Body("box", [(3, 9), (9, 9), (9, 10), (3, 10)], FALL),
    ],
    "a segment on the tops of a U": [
        Body("u", U),
        Body("key", [("-75/4", 6), ("-71/4", 6)], FALL),
    ],
    "a stick on a comb": [
        Body("comb", [(0, 0), (9, 0), (8, 3), (7, 1), (6, 3), (5, 1), (4, 3), (3, 1), (2, 3)]),
        Body("stick", [(3, 9), (5, 9)], FALL),
    ],
}


@pytest.mark.long
@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("name", SCENES)
def test_bug_a_straight_angle_of_one_body_ended_the_search_for_touches(name, variant):
    """fuzz symmetry, letters 7: a contact was missed behind a rigid straight angle."""
    if variant == "backwards":
        return
    scene = VARIANTS[variant].scene(Scene(SCENES[name], (0, 9)))
    expected = reference.first_contact(scene)
    assert expected is not None

    for tiling in TILINGS:
        found = first_contact(scene, tiling=tiling)
        assert disagreement(expected, found) is None


# The battery of degenerate scenes: every tiling against the reference and CGAL

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
