"""New motions, and bodies that come and go, by hand; the laws `simulation/population` have more."""

import pytest

from exactpt import Body, Scene, Simulation, Translation
from exactpt.testing import audit

TILINGS = ("greedy", "lazy", "mixed")


@pytest.mark.parametrize("tiling", TILINGS)
def test_body_added_in_a_hole_that_soon_leaves_through_the_wall_touches_it(tiling):
    """From (0, 0) with velocity (1, 0) to the edge x = 1: at t = 1.

    The mixed tiling was built anew at a time when the point was inside the plate, where nothing
    is tiled: the point was connected to nothing, and the contact was missed.
    """
    wide, narrow = (
        [(-90, -90), (90, -90), (90, 90), (-90, 90)],
        [(-1, -1), (1, -1), (1, 1), (-1, 1)],
    )
    simulation = Simulation(Scene([Body("plate", wide, holes=[narrow])], (0, 20)), tiling=tiling)

    simulation.add(Body("point", [(0, 0)], Translation([0, 1])))

    audit(simulation)
    assert simulation.neighbours("point") == ["plate"]
    assert simulation.run_to_contact().time == 1
