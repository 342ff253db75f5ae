"""Bodies with radii by hand: first and new contacts, distances, intervals, and what is refused.

The laws compare them with the definitions, in the sources `tiny/rounded` and `radii`.
"""

import json
import pickle
from fractions import Fraction

import pytest

from exactpt import (
    Body,
    BudgetExceeded,
    InputError,
    Pieces,
    Rigid,
    Scene,
    Simulation,
    Translation,
    clearance,
    contact_intervals,
    contacts,
    distance,
    first_contact,
    first_within,
    prove,
)

RIGHT = Translation([0, 1])
WALL = Body("wall", [(10, -9), (10, 9)])
BOX = Body("box", [(0, 0), (5, 0), (5, 9), (0, 9)])
JAW = [(-1, 0), (4, 0), (4, 1), (0, 1), (0, 3), {"x": [4], "y": [3, -1]}, (4, 4), (-1, 4)]
"""Its upper lip comes down onto the lower one at t = 2."""


def disc(name="disc", at=(0, 0), radius=1, motion=RIGHT):
    return Body(name, [at], motion, radius=radius)


def met(*bodies, time=(0, 20), **options):
    return first_contact(Scene(bodies, time), **options)


# The first contact


def test_contact_of_two_discs_has_a_normal_between_their_centres():
    contact = met(disc(), disc("other", (5, 1), "1/2", Translation()))
    (pair,) = contact.pairs

    assert contact.time.polynomial == (95, -40, 4)  # (5 - t)^2 + 1 = (3/2)^2
    assert contact.kind == pair.kind == "vertex-vertex"
    assert (pair.body, pair.vertex, pair.other, pair.other_vertex) == ("disc", 0, "other", 0)
    assert pair.normal == (-(1.25**0.5) / 1.5, -2 / 3)
    assert pair.point == pytest.approx((float(contact.time) - pair.normal[0], 2 / 3), abs=1e-15)


def test_contact_of_a_disc_and_a_wall_is_of_its_edge():
    contact = met(disc(), WALL)
    (pair,) = contact.pairs

    assert contact.time == 9
    assert (pair.kind, pair.other, pair.edge) == ("vertex-edge", "wall", 0)
    assert (pair.point, pair.normal) == ((10.0, 0.0), (-1.0, 0.0))


def test_contact_point_of_two_rounded_bodies_is_on_both_boundaries():
    """Neither on a core nor in the middle: the wall's boundary is at x = 10 - 1/4."""
    contact = met(disc(), Body("wall", WALL.vertices, radius="1/4"))

    assert (contact.time, contact.pairs[0].point) == (Fraction(35, 4), (9.75, 0.0))


def test_contact_with_the_corner_of_a_box_is_of_two_vertices():
    """(-4 + t)^2 + (-3 + t)^2 = (5/2)^2."""
    contact = met(disc(at=(-4, -3), radius="5/2", motion=Translation([0, 1], [0, 1])), BOX)

    assert contact.pairs[0].kind == "vertex-vertex"
    assert contact.time.polynomial == (75, -56, 8)


@pytest.mark.parametrize("gap, time", [(0, 5), ("1e-40", None), ("-1e-40", 5)])
def test_contact_of_discs_that_pass_at_the_sum_of_their_radii_is_a_graze(gap, time):
    contact = met(disc(radius=1), disc("post", (5, 2), 1 - Fraction(gap), Translation()))

    if time is None:
        assert contact is None
    else:
        assert float(contact.time) == pytest.approx(time)
        assert (contact.time == 5) == (gap == 0)


def test_contact_of_a_slide_begins_at_the_end_of_the_capsule():
    """The distance of the lines is that of a touch for all times."""
    floor = Body("floor", [(0, 0), (6, 0)], radius=1)
    slider = Body("slider", [(-8, 2), (-6, 2)], RIGHT, radius=1)
    contact = met(floor, slider)

    assert contact.time == 6
    assert [(p.kind, p.vertex, p.other_vertex) for p in contact.pairs] == [("vertex-vertex", 0, 1)]


def test_contact_of_a_disc_that_fills_a_corner_is_of_both_walls():
    corner = Body("corner", [(-9, 0), (0, 0), (0, 9)], closed=False)
    contact = met(corner, disc(at=(-5, 5), motion=Translation([0, 1], [0, -1])))

    assert contact.time == 4
    assert [(p.other, p.edge) for p in contact.pairs] == [("corner", 0), ("corner", 1)]


def test_disc_that_rolls_round_a_corner_keeps_its_gap_until_it_meets_a_stop():
    """On the arc it is as far from the corner for all times."""
    table = Body("table", [(-6, -4), (0, -4), (0, 0), (-6, 0)])
    motion = Pieces([(4, Translation([-4, 1])), (None, Rigid([4, -1]))])
    rolling = disc(at=(0, 2), motion=motion)

    assert met(table, rolling, time=(0, 5)) is None
    assert met(table, disc(at=(0, 2), radius=2, motion=motion), time=(0, 5)).kind == "initial"
    stop = Body("stop", [("7/2", 0)], radius="1/2")
    contact = met(table, stop, rolling, time=(0, 5))
    assert (contact.time, contact.pairs[0].point) == (5, (3.0, 0.0))


def test_contact_where_the_motion_turns_back_counts():
    back = Pieces([(9, RIGHT), (None, Translation([18, -1]))])

    assert met(disc(motion=back), WALL).time == 9
    assert met(disc(motion=back, radius="999/1000"), WALL) is None


@pytest.mark.parametrize(
    "at, pairs",
    [((10, 0), []), ((9, 0), [("wall", 0)]), ((9.5, 0), [])],
    ids=["on it", "touching", "overlapping"],
)
def test_contact_at_the_start_has_incidences_only_if_bodies_just_touch(at, pairs):
    contact = met(disc(at=at), WALL)

    assert (contact.kind, contact.time) == ("initial", 0)
    assert contact.initial_pairs == (("disc", "wall"),)
    assert [(pair.other, pair.edge) for pair in contact.pairs] == pairs


def test_body_inside_of_another_overlaps_it():
    inside = disc(at=(2, 4), radius="1/100")

    assert met(inside, BOX).initial_pairs == (("disc", "box"),)
    assert met(Body("big", BOX.vertices, radius=1), disc(at=(2, 4), radius=0)).kind == "initial"


def test_interior_of_a_chain_that_is_nearly_a_ring_is_free():
    ring = Body("ring", [(-5, -5), (5, -5), (5, 5), (-5, 5), (-5, -4)], closed=False)

    assert met(disc(), ring).time == 4


def test_body_with_a_radius_does_not_touch_itself():
    assert met(Body("jaw", JAW), time=(0, 9)).kind == "self"
    assert met(Body("jaw", JAW, radius="1/9"), time=(0, 9)) is None


def test_bodies_of_one_group_do_not_touch():
    bodies = [disc(), disc("post", (5, 0), 1, Translation()), WALL]

    assert met(*bodies).time == 3
    assert met(*bodies, ignoring=[["disc", "post"]]).time == 9
    assert met(*bodies, ignoring=[["disc", "post", "wall"]]) is None
    assert met(*bodies, between=[("disc", "wall")]).time == 9
    assert met(*bodies, since=4).initial_pairs == (("disc", "post"),)
    assert met(*bodies, since=8).time == 9


def test_bodies_with_and_without_radii_that_touch_at_one_time_are_reported_together():
    point = Body("point", [(0, 5)], RIGHT)

    assert [p.body for p in met(point, disc(), WALL).pairs] == ["disc"]
    both = met(Body("point", [(2, 5)], RIGHT), disc(at=(1, 0)), WALL)
    assert (both.time, [p.body for p in both.pairs]) == (8, ["point", "disc"])


def test_contact_is_written_as_json():
    contact = met(disc(), WALL)

    assert pickle.loads(pickle.dumps(contact)).pairs == contact.pairs
    assert json.loads(json.dumps(contact.to_json()))["pairs"] == [
        {
            "kind": "vertex-edge",
            "a": {"body": "disc", "vertex": 0},
            "b": {"body": "wall", "edge": 0},
            "point": [10.0, 0.0],
            "normal": [-1.0, 0.0],
        }
    ]


def test_radius_below_all_doubles_counts():
    tiny = Fraction(2) ** -1200
    a = Body("a", [(0, 0)], RIGHT, radius=tiny)

    assert met(a, Body("b", [(4, -1), (4, 1)]), time=(0, 9)).time == 4 - tiny


def test_contact_of_a_body_of_many_vertices_is_with_the_tooth_over_the_disc():
    """The tooth at (50, 0) points down at the disc, whose centre is 60 - t^2 below it."""
    saw = [(k, k % 2) for k in range(100)] + [(99, 9), (0, 9)]
    falling = disc(at=(50, -60), motion=Translation([0], [0, 0, 1]))
    contact = met(Body("saw", saw), falling, time=(0, 9))

    assert contact.time.minimal_polynomial() == (-59, 0, 1)
    assert met(Body("saw", saw), falling, time=(0, 9), between=[("saw", "disc")]) == contact
    assert [(p.body, p.vertex, p.other) for p in contact.pairs] == [("saw", 50, "disc")]


def test_new_contact_of_discs_is_when_they_meet_again_or_press():
    """Discs that kiss, part, and meet again; one that presses into another at once; one rolls."""
    hop = Pieces([(2, Translation([2], [0, 1])), (None, Translation([2], [4, -1]))])
    post = disc("post", (0, 0), 1, Translation())

    assert met(post, disc(motion=hop)).kind == "initial"
    assert met(post, disc(motion=hop), after_start=True).time == 4
    pressing = disc("pressing", (2, 0), 1, Translation([0, -1]))
    assert met(post, pressing, after_start=True).time == 0
    rolling = disc("rolling", (2, 0), 1, Rigid([0, 1]))
    assert met(post, rolling, after_start=True) is None
    assert met(post, rolling, WALL, after_start=True, between=[("post", "wall")]) is None


def test_question_that_needs_a_tiling_is_refused():
    scene = Scene([disc(), WALL], (0, 20))
    told_why = "body 'disc' has a radius: no tiling holds rounded bodies"
    for ask in (
        lambda: Simulation(scene),
        lambda: first_contact(scene, method="kinetic"),
        lambda: first_contact(scene, tiling="lazy"),
        lambda: first_contact(scene, proof="proof"),
        lambda: prove(scene),
        lambda: Simulation(Scene([WALL], (0, 20))).add(disc()),
    ):
        with pytest.raises(InputError, match=told_why):
            ask()


@pytest.mark.parametrize("path", [[0, 1], [0, 0, 1]], ids=["straight", "curved"])
def test_search_without_time_says_how_far_it_came(path):
    bodies = [
        disc(str(i), (3 * i, 0), 1, Translation([0], [c * i for c in path])) for i in range(9)
    ]
    with pytest.raises(BudgetExceeded) as spent:
        met(*bodies, WALL, max_seconds=0)
    assert spent.value.reached in (None, 0)


# Distances and intervals

DISC = disc()
PILL = Body("pill", [(9, -2), (9, 2)], radius="1/2")
SCENE = Scene([DISC, PILL], (0, 20))


def test_distance_of_a_disc_and_a_pill_is_that_of_the_cores_less_the_radii():
    gap = distance(SCENE, "disc", "pill", at=2)

    assert (float(gap), gap.squared, gap.core_squared) == (5.5, Fraction(121, 4), 49)
    assert gap.radius == Fraction(3, 2)
    assert gap.features == (((0, None), (None, 0)),)
    assert float(distance(SCENE, "disc", "pill", at=9)) == 0
    assert first_within(SCENE, "disc", "pill", 2) == Fraction(11, 2)
    (meeting,) = contact_intervals(SCENE, "disc", "pill")
    assert (meeting.start, meeting.end) == (Fraction(15, 2), Fraction(21, 2))
    assert contacts(SCENE) == [meeting]


def test_distance_that_is_irrational_has_no_square():
    """sqrt(10) - 1, whose square is 11 - 2 sqrt(10)."""
    there = distance(Scene([Body("a", [(0, 0)], radius=1), Body("b", [(3, 1)])]), "a", "b", at=0)

    assert float(there) == pytest.approx(10**0.5 - 1, abs=1e-15)
    with pytest.raises(InputError, match="irrational here"):
        _ = there.squared


def test_clearance_of_discs_that_pass_is_least_beside_each_other():
    scene = Scene([DISC, Body("post", [(9, 4)], radius="3/2")], (0, 20))
    gap = clearance(scene, "disc", "post")

    assert gap.minimum == (9, Fraction(9, 4))
    assert gap.minimum.distance == Fraction(3, 2)
    assert gap(6) == 2.5
    assert gap.squared(6) == Fraction(25, 4)
    assert pickle.loads(pickle.dumps(gap)) == gap


def test_clearance_of_discs_that_overlap_is_zero():
    gap = clearance(SCENE, "disc", "pill")

    assert [piece.features is None for piece in gap.pieces] == [False, True, False]
    assert gap(9) == gap.squared(9) == 0
    assert gap.minimum == (Fraction(15, 2), 0)


def test_square_with_the_radius_of_discs_that_overlap_is_that_of_the_radii():
    scene = Scene([Body("a", [(0, 0)], radius=1), Body("b", [(1, 0)], radius=1)], time=(0, 1))

    assert distance(scene, "a", "b", at=0).core_squared == 1
    assert clearance(scene, "a", "b").squared_with_radius(0) == 4


def test_interval_of_a_touch_in_passing_is_one_moment():
    scene = Scene([DISC, Body("post", [(9, 2)], radius=1)], (0, 20))

    assert [(i.start, i.end) for i in contact_intervals(scene, "disc", "post")] == [(9, 9)]


def test_squared_distance_of_rounded_bodies_must_be_a_square():
    with pytest.raises(InputError, match="distance_squared=2: of rounded bodies"):
        first_within(SCENE, "disc", "pill", distance_squared=2)
    assert first_within(SCENE, "disc", "pill", distance_squared=4) == 5.5


def test_bug_whether_a_squared_distance_of_rounded_bodies_was_refused_depended_on_boxes():
    far = [Body(f"b{i}", [(50 * i, 0)], radius=1 if i == 5 else 0) for i in range(6)]
    with pytest.raises(InputError, match="it must be the square of a rational"):
        first_within(Scene(far, time=(0, 1)), distance_squared=2)
