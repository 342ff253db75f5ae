"""Points, segments, chains, flat triangles: scenes in which these once went wrong."""

import pytest

from exactpt import Body, Scene, Simulation, Translation, first_contact
from exactpt.kernel.numbers import QQ
from exactpt.simulation.tile import tile_at
from exactpt.testing.audits import audit_at, run_and_audit
from exactpt.tiling.start import TILINGS


def on(x, y):
    """A vertex with paths of its own."""
    return {"x": x, "y": y}


@pytest.mark.parametrize("tiling", TILINGS)
def test_a_vertex_on_the_line_of_a_chains_last_edge(tiling):
    """Neither angle at a pointed end was a corner: there was no tiling."""
    chain = Body("chain", [(0, 0), (10, 5), (20, 0)], closed=False)
    wedge = Body("wedge", [(24, -2), (40, -20), (40, 10)])
    scene = Scene([chain, wedge], (0, 1))

    snapshot = tile_at(scene, scene.start, tiling=tiling)

    assert all(len(face.corners) == 3 for face in snapshot.faces)
    run_and_audit(scene, tiling)


@pytest.mark.parametrize("tiling", TILINGS)
def test_a_triangle_of_two_copies_closes_on_the_nearer_one(tiling):
    """At t = 1/2 the ends' copies and the far end are on one line; any copy did for its middle."""
    bent = Body("bent", [on([7, 1], [2, 1]), on([4, 1], [0, 1]), on([8, 1], [1])], closed=False)
    other = Body(
        "other", [(6, 6), (3, 5), (1, 7), (0, 7)], Translation([0, -1], [0, 1]), closed=False
    )

    run_and_audit(Scene([bent, other], (0, 4)), tiling)


@pytest.mark.parametrize("tiling", TILINGS)
def test_copies_that_turn_beside_a_vertex_in_the_same_motion(tiling):
    """They move as the point does, but their segment turns: the angle is not rigid."""
    segment = Body("segment", [on([3], ["-1/2", "1/2"]), (4, -1)])
    point = Body("point", [(5, 3)], Translation([0], [0, "1/2"]))

    run_and_audit(Scene([segment, point], (0, 1)), tiling)


@pytest.mark.parametrize("tiling", TILINGS)
def test_a_turn_for_ever_vertical_at_a_breakpoint(tiling):
    """At t = 2 the point comes to rest above a vertical edge, a little late for the flip."""
    frames = [(0, [(2, 6)]), (1, [(2, 7)]), (2, [(-1, 10)])]
    point = Body("point", keyframes=frames)
    triangle = Body("triangle", [(-1, 4), (-1, 6), (-2, 4)])

    run_and_audit(Scene([point, triangle], (0, 4)), tiling)


@pytest.mark.parametrize("tiling", TILINGS)
def test_a_triangle_that_becomes_flat_beside_a_chain_that_is_straight_for_ever(tiling):
    """The chain hid one end of the edge that a vertex of the triangle comes to lie on."""
    triangle = Body("triangle", [on([1, 5], [0, 1]), on([4, 1], [1]), on([4, 1], [2, -1])])
    segment = Body("segment", [(0, 0), on([0, 9], [9])])
    point = Body("point", [(4, 0)], Translation([0, 1]))

    contact = first_contact(Scene([triangle, segment, point], (0, 1)), tiling=tiling)

    assert contact is not None
    assert contact.time.compare_rational(QQ(3, 4)) == 0


@pytest.mark.parametrize("tiling", TILINGS)
def test_a_straight_chain_that_bends_later(tiling):
    """It was taken for a convex body, and refused when it bent."""
    straight, there, bent = (
        [(0, 0), (2, 0), (4, 0)],
        [(0, 1), (2, 1), (4, 1)],
        [(0, 1), (2, 2), (4, 1)],
    )
    chain = Body("chain", keyframes=[(0, straight), (1, there), (2, bent)], closed=False)
    triangle = Body("triangle", [(9, 0), (12, 1), (11, 4)])

    run_and_audit(Scene([chain, triangle], (0, 4)), tiling)


@pytest.mark.parametrize("tiling", TILINGS)
def test_a_straight_chain_with_a_plan_to_bend(tiling):
    """The plan was refused, and half of it done."""
    chain = Body("chain", [(0, 0), (2, 0), (4, 0)], closed=False)
    simulation = Simulation(Scene([chain, Body("p", [(9, 1)])], (0, 4)), tiling=tiling)

    simulation.set_motion("chain", Body("chain", [(0, 0), on([2], [0, 1]), (4, 0)], closed=False))
    for _ in simulation.run():
        pass

    audit_at(simulation.kinetic, QQ(4))
