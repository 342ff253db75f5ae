"""The union of bodies: one body without common edges, or a reason why not."""

from itertools import combinations
from random import Random

import pytest

import exactpt
from exactpt import (
    Affine,
    Body,
    InputError,
    Pieces,
    PosePath,
    Rigid,
    Scene,
    Simulation,
    Spin,
    Translation,
)
from exactpt.kernel.numbers import QQ

FIRST = Body("first", [(0, 0), (2, 0), (0, 2)])
SECOND = Body("second", [(2, 0), (2, 2), (0, 2)])
SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]
OTHER = [(1, 1), (3, 1), (3, 3), (1, 3)]


def test_union_of_two_with_a_common_edge_is_a_square():
    both = exactpt.union([FIRST, SECOND], name="both")

    assert (both.name, both.at(0), both.has_rings) == ("both", SQUARE, False)
    path = Simulation(Scene([both], time=(0, 1))).shortest_path((-1, 1), (3, 1))
    assert path.length == pytest.approx(2 * 2**0.5 + 2)


@pytest.mark.parametrize(
    "motion",
    [
        Translation([0, 1], [0, 0, "1/3"]),
        Rigid([0, 1], pivot=(1, 1)),
        Spin(2, (1, 1), error="1/100"),
        PosePath([0, 2], [([0, 1], 0, [0, 1])], error="1/1000"),
    ],
)
def test_union_has_the_motion_of_the_bodies(motion):
    """Each vertex is where that of its body is."""
    first, second = (Body(name, at, motion) for name, at in (("a", SQUARE), ("b", OTHER)))

    both = exactpt.union([first, second], name="ab")

    assert both.motion == motion
    assert both.vertices[0] == first.vertices[0]
    assert both.at(1)[0] == first.at(1)[0]
    assert both.size == 8


def test_bodies_at_rest_may_be_placed_by_different_motions():
    moved = Body("b", SQUARE, Translation(1, 1))
    frames = Body("c", keyframes=[(0, OTHER)])

    assert exactpt.union([Body("a", SQUARE), moved], name="u").size == 8
    assert exactpt.union([Body("a", SQUARE), frames], name="u").size == 8
    assert exactpt.union([moved, Body("b", OTHER)], name="u").at(0) == OTHER


SHIFT = Translation([0, 1], [0, 0, "1/3"])


@pytest.mark.parametrize(
    "written",
    [
        Affine([[1, 0], [0, 1]], x=[0, 1], y=[0, 0, "1/3"]),
        Rigid(0, x=[0, 1], y=[0, 0, "1/3"], pivot=(5, 7)),
        Pieces([(3, SHIFT), (None, Rigid([], x=SHIFT.x, y=SHIFT.y))]),
    ],
)
def test_equal_motions_that_are_written_differently_are_equal(written):
    """Each of them adds (t, t^2 / 3) to every point."""
    both = exactpt.union([Body("a", SQUARE, SHIFT), Body("b", OTHER, written)], name="u")

    assert both.motion == SHIFT
    assert both.at(3)[0] == (3, 3)


@pytest.mark.parametrize(
    "other",
    [
        Pieces([(3, SHIFT), (None, Translation([3], [3]))]),  # equal up to t = 3
        Pieces([(3, Translation([0, 1], [3])), (None, SHIFT)]),  # equal from t = 3 on
        Affine([[1, 0], [0, [1, 1]]], x=[0, 1], y=[0, 0, "1/3"]),  # equal on the x-axis
        Affine([[[1, 1], 0], [0, 1]], x=[0, 1], y=[0, 0, "1/3"]),  # equal on the y-axis
    ],
)
def test_motions_that_are_equal_in_part_are_not_equal(other):
    with pytest.raises(InputError, match="move differently"):
        exactpt.union([Body("a", SQUARE, SHIFT), Body("b", OTHER, other)], name="u")


def test_rest_that_is_known_within_an_error_is_not_united_with_rest():
    """The union would be at rest exactly: a touch of it would be certain, though it is not."""
    resting = PosePath([0, 2], [(0, 0, 0)]).with_place_error("1/10")
    bodies = [Body("a", SQUARE), Body("b", OTHER, resting)]

    with pytest.raises(InputError, match="body 'b' has an error, which would be lost"):
        exactpt.union(bodies, name="u")
    alike = exactpt.union([body.with_motion(resting) for body in bodies], name="u")
    assert alike.motion.place_error == QQ(1, 10)


@pytest.mark.parametrize("motion", [Translation(), Translation([0, 1])])
def test_each_ring_begins_with_the_vertex_that_came_first_whichever_way_it_was_given(motion):
    clockwise = Body(
        "c", [(0, 0), (0, 9), (9, 9), (9, 0)], motion, holes=[[(1, 1), (3, 1), (2, 2)]]
    )

    rings = exactpt.union([clockwise], name="u")

    assert rings.at(0)[:4] == [(0, 0), (9, 0), (9, 9), (0, 9)]
    assert rings.at(0)[4:] == [(1, 1), (2, 2), (3, 1)]


def test_collinear_vertices_stay_and_properties_go():
    first = Body("a", [(0, 0), (1, 0), (2, 0), (2, 2), (0, 2)], properties={"kind": 3})
    second = Body("b", [(2, 0), (4, 0), (4, 2), (2, 2)])

    both = exactpt.union([first, second], name="ab")

    assert both.at(0) == [(0, 0), (1, 0), (2, 0), (4, 0), (4, 2), (2, 2), (0, 2)]
    assert both.properties == {}


def test_parts_of_one_body_may_overlap():
    """Such a body is refused by a scene, with the advice to unite them."""
    overlapping = Body("a", parts=[SQUARE, OTHER])
    with pytest.raises(InputError, match=r"two rings cross: .*exactpt\.union"):
        Scene([overlapping])

    assert exactpt.union([overlapping], name="a").size == 8


@pytest.mark.parametrize(
    "parts",
    [
        [SQUARE, [(2, 0), (4, 0), (4, 2), (2, 2)]],
        [SQUARE, [(2, 1), (4, 0), (4, 2), (2, 2)]],
        [SQUARE, OTHER],
        [[(0, 0), (9, 0), (9, 9), (0, 9)], OTHER],
    ],
)
def test_parts_with_common_points_inside_name_the_union(parts):
    with pytest.raises(InputError, match=r"exactpt\.union joins such parts"):
        Scene([Body("a", parts=parts)])


def test_bodies_that_meet_in_a_point_or_not_at_all_are_parts():
    corner = Body("c", [(2, 0), (4, 0), (4, -2)])
    far = Body("f", [(9, 9), (10, 9), (9, 10)])

    together = exactpt.union([FIRST, corner, far], name="t")

    assert [len(ring) for ring in together.rings] == [3, 3, 3]
    assert Scene([together]).bodies == (together,)


def test_a_bar_divides_the_hole_of_a_frame():
    frame = Body("f", [(0, 0), (9, 0), (9, 9), (0, 9)], holes=[[(1, 1), (8, 1), (8, 8), (1, 8)]])
    bar = Body("b", [(0, 4), (9, 4), (9, 5), (0, 5)])

    both = exactpt.union([frame, bar], name="fb")

    assert [len(ring) for ring in both.rings] == [8, 4, 4]


@pytest.mark.parametrize(
    "bodies, message",
    [
        ([], "at least one body"),
        (5, "bodies: not a list"),
        ([FIRST, SQUARE], "not a body"),
        ([FIRST.with_radius(1)], "'first' has a radius"),
        ([FIRST, Body("p", [(0, 0)])], "'p' has no area"),
        ([Body("s", [(0, 0), (1, 0)])], "'s' has no area"),
        ([Body("c", SQUARE, closed=False)], "'c' has no area"),
        ([FIRST, SECOND.with_motion(Translation([0, 1]))], "'first' and 'second' move differently"),
        ([FIRST.with_motion(Translation([0, 1])), SECOND], "'first' and 'second' move differently"),
        ([Body("d", [{"x": [0, 1]}, (2, 0), (0, 2)])], "'d' deforms"),
        ([Body("k", keyframes=[(0, SQUARE), (1, OTHER)])], "'k' deforms"),
        ([Body("t", [(0, 0), (4, 4), (4, 0), (0, 4)])], "'t': not a simple polygon"),
        ([FIRST, Body("t", [(0, 0), (1, 1), (2, 2)])], "'t': .*"),
    ],
)
def test_other_bodies_are_refused(bodies, message):
    with pytest.raises(InputError, match=message):
        exactpt.union(bodies, name="u")


def test_the_name_of_a_union_is_checked():
    with pytest.raises(InputError, match="name"):
        exactpt.union([FIRST], name="")


@pytest.mark.parametrize("seed", range(20))
def test_union_of_random_bodies_covers_what_they_cover(seed):
    """Of triangles with thirds: a point is in the union if and only if it is in one of them."""
    random = Random(seed)

    def number():
        return QQ(random.randint(0, 12), 3)

    triangles = []
    while len(triangles) < 4:
        a, b, c = ((number(), number()) for _ in range(3))
        if (b[0] - a[0]) * (c[1] - a[1]) != (b[1] - a[1]) * (c[0] - a[0]):
            triangles.append(Body(f"t{len(triangles)}", [a, b, c]))

    whole = exactpt.union(triangles, name="u")

    covered = Scene([whole]).to_shapely(0)["u"]
    each = list(Scene([Body(b.name, b.at(0)) for b in triangles]).to_shapely(0).values())
    total = sum(shape.area for shape in each)
    if not any(a.intersects(b) for a, b in combinations(each, 2)):
        assert covered.area == pytest.approx(total)
    for _ in range(200):
        x, y = number() + QQ(1, 7), number() + QQ(1, 11)
        inside = [_covers(body, x, y) for body in triangles]
        assert _covers(whole, x, y) == any(inside)


def _covers(body, x, y):
    """By crossings of the ray to the right; no vertex is at this height."""
    points = body.at(0)
    crossed = 0
    for i, j in body.edges:
        (ax, ay), (bx, by) = points[i], points[j]
        if (ay > y) != (by > y):
            crossed += ax + (bx - ax) * (y - ay) / (by - ay) > x
    return crossed % 2 == 1
