"""Normals of polygons that may have crossed themselves: out of the body, by the even-odd rule.

The law `first contact/points` has the definition, for all scenes.
"""

import math

import pytest

from exactpt import Affine, Body, Pieces, Planner, Scene, Translation, first_contact

CROSSED = [(-1, 1), {"x": [2], "y": [1, 1]}, (-1, -1), {"x": [-1, 1], "y": [0]}]
"""It crosses itself at t = 1."""


def normals(obstacle, robot, end=3):
    """The first contact of two bodies, asked for in four ways, whose answers are the same."""
    scenes = [Scene([obstacle, robot], (0, end)), Scene([robot, obstacle], (0, end))]
    found = [first_contact(scene, between=[(obstacle.name, robot.name)]) for scene in scenes]
    found.append(Planner([obstacle], (0, end)).first_contact(robot, robot.motion))
    far = Body("far", [(90, 90), (91, 90), (90, 91)])
    found.append(Planner([obstacle, far], (0, end)).first_contact(robot, robot.motion))
    jsons = [contact.to_json() for contact in found]
    assert jsons[1:] == jsons[:-1]
    return found[0]


def test_bug_a_normal_pointed_into_a_polygon_that_had_crossed_itself():
    """At t = 1 + sqrt(2) the edge from (-1, -1) to (t - 1, 0) is over x = 0 at a slope of 1/t."""
    point = Body("p", [(0, -3)], Translation(0, [0, 1]))
    contact = normals(Body("o", CROSSED), point)

    assert float(contact.time) == 1 + math.sqrt(2)
    assert contact.pairs[0].normal == pytest.approx((math.sin(math.pi / 8), -math.cos(math.pi / 8)))


@pytest.mark.parametrize("y", [1, -1])
@pytest.mark.parametrize(
    "flat",
    [
        Body("o", [(0, 0), (4, 0), {"x": [4], "y": [1, -1]}, {"x": [0], "y": [1, -1]}]),
        Body("o", [(0, 0), (4, 0), (4, 1), (0, 1)], Affine([[[1], [0]], [[0], [1, -1]]])),
    ],
    ids=["by vertices", "by a map"],
)
def test_normal_where_both_sides_are_outside_is_that_from_which_the_vertex_came(flat, y):
    """At t = 1 a box is folded to a segment, to which the point comes at that time."""
    contact = normals(flat, Body("p", [(2, 2 * y)], Translation(0, [0, -2 * y])), end=2)

    assert contact.time == 1
    assert {pair.normal for pair in contact.pairs} == {(0, y)}


@pytest.mark.parametrize("x", [1, -1])
def test_normal_of_a_contact_at_the_start_is_that_of_the_motion_before_it(x):
    """A point comes to a wall until t = 1, and rests there; the scene begins at t = 1."""
    stop = Pieces([(0, Translation()), (1, Translation([0, x])), (None, Translation([x]))])
    scene = Scene([Body("point", [(0, 0)], stop), Body("wall", [(x, -1), (x, 1)])], (1, 2))

    (pair,) = first_contact(scene).pairs

    assert pair.normal == (-x, 0)  # it came from the side of the origin
