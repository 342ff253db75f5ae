"""Coefficients that no double holds: their boxes are the whole plane, never nothing."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest

from exactpt import Body, Scene, Translation, contacts, first_contact, first_within
from exactpt.arrays import first_contacts
from exactpt.certificates.coincidence import boxes_now
from exactpt.kernel.numbers import QQ
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement


def comb_on_a_wall(teeth, path):
    """A comb that comes down on a wall with all its teeth at once."""
    tips = [p for i in range(teeth) for p in ((2 * i + 1, 1), (2 * i + 2, 5))][:-1]
    comb = Body("comb", [(0, 10), *tips, (2 * teeth, 10)], Translation(0, path))
    wall = Body("wall", [(-5, -1), (75, -1), (75, 0), (-5, 0)])
    return Scene([comb, wall], (0, 3))


GRAZE = [0, -2 + QQ(1, 10**40), 1 - QQ(2, 10**40), QQ(1, 10**40)]
"""(1 + 10^-40 t) (t - 1)^2 - 1: down at t = 1, and up again."""
CROSSING = [0, -1 - QQ(1, 10**40), 0, QQ(1, 10**40)]
"""-t + 10^-40 (t^3 - t): down at t = 1."""


@pytest.mark.parametrize("path", [GRAZE, CROSSING], ids=["graze", "crossing"])
@pytest.mark.parametrize("teeth", [5, 28])
@pytest.mark.parametrize("how", ["pairs", "lazy", "mixed", "greedy"])
def test_many_touch_at_once_by_immoderate_motions(path, teeth, how):
    scene = comb_on_a_wall(teeth, path)
    asked = {"method": "pairs"} if how == "pairs" else {"tiling": how}

    contact = first_contact(scene, **asked)

    assert contact is not None
    assert contact.time == 1
    assert contact.kind == "vertex-edge"
    assert len(contact.pairs) == teeth


def test_the_reference_agrees():
    scene = comb_on_a_wall(5, GRAZE)
    assert disagreement(reference.first_contact(scene), first_contact(scene)) is None


@pytest.mark.plain
def test_a_box_that_is_not_known_is_the_whole_plane():
    positions = SimpleNamespace(find=lambda _: None)
    nowhere = SimpleNamespace(x=np.nan, y=np.nan, error=np.inf)

    boxes = boxes_now(SimpleNamespace(positions=positions), [nowhere])

    assert boxes.tolist() == [[-np.inf, np.inf, -np.inf, np.inf]]


LARGEST = sys.float_info.max


@pytest.mark.parametrize("radius", [0.0, 1.0, LARGEST])
def test_bug_no_warning_at_the_largest_doubles(radius):
    """Infinity is what comes after the largest double, as a bound; the answers are exact."""
    corners, speeds = [(0.0, 0.0), (LARGEST, LARGEST), (LARGEST, 0.0)], [(1.0, 0.0), (0.0, 0.0)]
    offsets, radii, time = [0, 1, 3], [0.0, radius], (1.0, LARGEST)
    scene = Scene.from_arrays(corners, offsets, velocities=speeds, radii=radii, time=time)
    one_by_one = Scene(list(scene.bodies), time)
    arrival = 1 if radius == LARGEST else QQ(LARGEST) - QQ(radius)

    for asked in (scene, one_by_one):
        assert first_contact(asked).time == arrival
        assert first_contact(asked, exact_only=True).time == arrival
        assert first_within(asked, distance=LARGEST).time == 1
        assert [interval.start for interval in contacts(asked)] == [arrival]
    found = first_contacts(
        corners, offsets, [(0, 1)] * 2, velocities=speeds, radii=radii, time=[time, (0.0, LARGEST)]
    )
    assert found.found.all()
    assert found.low[0] <= arrival <= found.high[0]
