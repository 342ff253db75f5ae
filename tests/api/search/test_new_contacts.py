"""New contacts, some pairs alone, and a later start: by hand, on the command line, and refused.

The laws `new contact/...`, `contacts/choices` and `first contact/choices` have the definitions.
"""

import json

import pytest
from commands import code_of

from exactpt import (
    Affine,
    Body,
    BudgetExceeded,
    InputError,
    Pieces,
    Polynomial,
    Rigid,
    Scene,
    Translation,
    contacts,
    first_contact,
    first_within,
)

FLOOR = Body("floor", [(-9, -1), (19, -1), (19, 0), (-9, 0)])
CORNERS = [(0, 0), (2, 0), (2, 2), (0, 2)]
NOTCHED = Body("n", [(0, 0), (8, 0), (8, 8), (0, 8)], holes=[[(4, 0), (5, 2), (3, 2)]])
"""Its hole, a triangle, touches its outline at (4, 0)."""


def box(name, motion=None, x=0, y=0):
    return Body(name, [(x + u, y + v) for u, v in CORNERS], motion or Translation([0]))


def new(*bodies, time=(0, 20), **options):
    """The time and the pairs of the first new contact."""
    contact = first_contact(Scene(bodies, time), after_start=True, **options)
    if contact is None:
        return None
    return float(contact.time), {tuple(sorted((p.body, p.other))) for p in contact.pairs}


def test_new_contact_of_a_stack_that_rests_is_none():
    assert first_contact(Scene([box("box"), FLOOR])).kind == "initial"
    assert new(box("low"), box("high", y=2), FLOOR) is None


def test_new_contact_of_a_box_that_slides_is_with_the_next_one():
    slider = box("slider", Translation([0, 1]))

    assert new(slider, box("other", x=5), FLOOR) == (3, {("other", "slider")})
    assert new(slider, FLOOR) is None


def test_new_contact_of_a_box_that_jumps_is_when_it_lands_again():
    scene = Scene([box("box", Translation([0], [0, 3, -1])), FLOOR], (0, 9))
    contact = first_contact(scene, after_start=True)

    assert contact.time == 3
    assert contact.kind == "vertex-edge"
    assert [(p.body, p.vertex, p.other, p.edge) for p in contact.pairs] == [
        ("box", 0, "floor", 2),
        ("box", 1, "floor", 2),
    ]
    assert contact.pairs[0].normal == (0, 1)
    assert contact.initial_pairs == ()
    assert new(box("box", Translation([0], [0, 3, -1])), FLOOR, time=(0, 2)) is None


def test_new_contact_of_a_box_that_is_pressed_down_is_when_that_begins():
    at_once = box("box", Translation([0], [0, -1]))
    contact = first_contact(Scene([at_once, FLOOR]), after_start=True)

    assert (contact.time, contact.kind) == (0, "initial")
    assert contact.initial_pairs == (("box", "floor"),)
    later = Pieces([(3, Translation([0, 1])), (None, Translation([0, 1], [3, -1]))])
    assert new(box("box", later), FLOOR) == (3, {("box", "floor")})


def test_new_contact_of_bodies_that_overlap_at_the_start_is_after_they_have_parted():
    """It is out of the floor at t = 2 - sqrt(3), and back at 2 + sqrt(3)."""
    sunk = box("sunk", Translation([0], [0, 4, -1]), y=-1)

    time, pairs = new(sunk, FLOOR)
    assert time == pytest.approx(2 + 3**0.5)
    assert pairs == {("floor", "sunk")}
    assert new(sunk, FLOOR, time=(0, 3)) is None


def test_new_contact_of_a_nested_body_is_when_it_comes_back():
    """Out at x = 9 where (t - 4)^2 = 7, first at 4 - sqrt(7), back at 4 + sqrt(7)."""
    outer = Body("outer", [(-9, -9), (9, -9), (9, 9), (-9, 9)])
    inner = box("inner", Translation([0, 8, -1]))

    assert new(inner, outer) == (4 + 7**0.5, {("inner", "outer")})
    assert new(inner, outer, time=(0, 6)) is None


def test_new_contact_of_corners_that_touch_is_none_if_one_slides_along_the_other():
    corner = box("corner", x=2, y=2)
    along, into = Translation([0, -1]), Translation([0, -1], [0, -1])

    assert new(box("box"), corner.with_motion(along)) is None
    assert new(box("box"), corner.with_motion(into)) == (0, {("box", "corner")})


def test_new_contact_of_a_body_that_grows_into_its_neighbour_is_at_once():
    grow = box("grow", Affine([[[1, "1/2"], [0]], [[0], [1]]]))

    assert new(grow, box("beside", x=2), time=(0, 3)) == (0, {("beside", "grow")})
    assert new(grow, box("above", y=2), time=(0, 3)) is None


def test_new_contact_of_cells_of_a_map_is_with_a_ship():
    cells = [box(f"cell {i} {j}", x=2 * i, y=2 * j) for i in range(4) for j in range(3)]
    ship = Body("ship", [(-5, 3), (-4, "5/2"), (-4, "7/2")], Translation([0, 1]))

    assert new(*cells) is None
    assert new(*cells, ship) == (4, {("cell 0 1", "ship")})
    assert new(*(body.with_motion(Rigid([0, 1])) for body in cells)) is None


def test_new_contacts_at_one_time_are_found_together():
    """The second pair begins to overlap at the very time at which the first one meets."""
    press = Pieces([(3, Translation([0])), (None, Translation([0], [3, -1]))])
    bodies = [box("runner", Translation([0, 1]), y=9), box("goal", x=5, y=9), box("press", press)]

    assert new(*bodies, FLOOR) == (3, {("goal", "runner"), ("floor", "press")})


def test_new_contact_of_a_body_that_closes_on_itself_counts():
    """Its upper lip comes down by 1 in a unit of time, from 3 onto the lower one at 1."""
    lips = [(-1, 0), (4, 0), (4, 1), (0, 1), (0, 3), {"x": [4], "y": [3, -1]}, (4, 4), (-1, 4)]
    jaw, beside = Body("jaw", lips), Body("beside", [(4, 0)])

    assert first_contact(Scene([jaw, beside], (0, 9))).kind == "initial"
    contact = first_contact(Scene([jaw, beside], (0, 9)), after_start=True)
    assert (contact.time, contact.kind) == (2, "self")


@pytest.mark.parametrize(
    "thread, velocity, expected",
    [
        ([(4, -1), (4, 0)], (0, 1), 2),  # in the hole from 1 on, at its upper edge at 2
        ([(4, -1), (4, 1)], (0, 1), 1),  # then its upper end goes into the solid above the hole
        ([(4, -1), (4, 1)], (1, 0), 0),  # it goes into the solid beside the hole at once
        ([(4, -1), (4, 1)], (0, -1), None),  # it leaves
        ([(4, -1), (4, 1)], (0, 0), None),
        ([(3, -1), (5, 1)], (0, 1), None),  # it overlaps from the start to the end
    ],
)
def test_thread_through_a_point_in_which_rings_touch_overlaps_nothing(thread, velocity, expected):
    """It crosses the outline there, but is in the hole beyond: an open wedge of slopes over 2."""
    body = Body("thread", thread, Translation([0, velocity[0]], [0, velocity[1]]))

    found = new(NOTCHED, body, time=(0, 3))

    assert found == (None if expected is None else (expected, {("n", "thread")}))


# Some pairs alone, and a later start


def test_contact_between_some_pairs_passes_over_others():
    bodies = [box("a", Translation([0, 1])), box("b", x=4), box("c", x=4, y=1), box("d", x=9)]
    scene = Scene(bodies, (0, 20))

    assert first_contact(scene).kind == "initial"
    assert first_contact(scene, between=[("a", "d")]).time == 7
    contact = first_contact(scene, between=[("d", "a"), ("c", "a"), ("a", "c")])
    assert contact.time == 2
    assert {(p.body, p.other) for p in contact.pairs} <= {("a", "c"), ("c", "a")}
    assert first_contact(scene, between=[("c", "d")]) is None
    assert first_contact(scene, between=[]) is None
    assert first_contact(scene, between=[("b", "c"), ("a", "d")]).initial_pairs == (("b", "c"),)
    assert first_contact(scene, between=[("b", "c")], after_start=True) is None
    assert first_contact(scene, between=[("a", "d")], ignoring=[("a", "c")]).time == 7


def test_contact_since_a_later_time_may_be_at_that_time():
    scene = Scene([box("a", Translation([0, 1])), box("b", x=4), box("c", x=9)], (0, 20))

    assert first_contact(scene, since=1).time == 2
    late = first_contact(scene, since=3)
    assert (late.time, late.kind, late.initial_pairs) == (3, "initial", (("a", "b"),))
    assert first_contact(scene, since=3, after_start=True).time == 7
    assert first_contact(scene, since=3, method="kinetic").kind == "initial"
    assert first_contact(scene, since=-5).time == 2
    assert scene.since("5/2").start == 5 / 2
    assert first_contact(scene, since=12) is None


# What is refused


@pytest.mark.parametrize(
    "options, words",
    [
        ({"after_start": True, "method": "kinetic"}, "a tiling watches all bodies"),
        ({"between": [("a", "b")], "tiling": "greedy"}, "a tiling watches all bodies"),
        ({"after_start": True, "proof": "x.proof"}, "a proof is about all bodies"),
        ({"between": [("a", "z")]}, "between: there is no body 'z'"),
        ({"between": [("a", "a")]}, "not the names of two bodies"),
        ({"between": ["ab"]}, "not the names of two bodies: 'ab'"),
        ({"between": [("a", "b", "c")]}, "not the names of two bodies"),
        ({"since": 1}, "the start t = 1 is not before the end t = 1"),
        ({"since": "x"}, "x"),
    ],
)
def test_wrong_call_is_refused(options, words):
    with pytest.raises(InputError, match=words):
        first_contact(Scene([box("a"), box("b", x=5)]), **options)


@pytest.mark.parametrize("question", [first_contact, contacts, first_within])
def test_named_pair_that_is_ignored_is_refused(question):
    bodies = [box("a"), box("b", x=5), box("c", x=9)]
    distance = {"distance": 1} if question is first_within else {}
    grouped = Scene(bodies, ignoring=[("a", "b")])
    message = "^between: bodies 'a' and 'b' ignore each other {}; leave this pair out$"

    with pytest.raises(InputError, match=message.format("in this scene")):
        question(grouped, between=[("b", "a")], **distance)
    with pytest.raises(InputError, match=message.format("by ignoring=")):
        question(Scene(bodies), between=[("a", "b")], ignoring=[("a", "b")], **distance)


def test_later_start_at_which_a_polygon_is_not_simple_is_refused():
    vertices = [{"x": [0]}, {"x": [4]}, {"x": [4], "y": [4, -4]}, {"x": [0], "y": [4, -1]}]
    scene = Scene.from_json(
        {"exactpt": 1, "time": [0, 9], "bodies": [{"name": "fold", "vertices": vertices}]}
    )
    with pytest.raises(InputError, match="body 'fold': "):
        first_contact(scene, since=1)


def test_search_without_time_claims_nothing():
    with pytest.raises(BudgetExceeded) as spent:
        first_contact(Scene([box("box"), FLOOR]), after_start=True, max_seconds=0)
    assert spent.value.reached is None


# The command


@pytest.fixture
def scene_file(tmp_path):
    path = tmp_path / "scene.json"
    Scene([box("a,b", Translation([0, 1])), box("c", x=5), FLOOR], (0, 20)).save(path)
    return str(path)


def run(capsys, *words):
    code = code_of(*words)
    said = capsys.readouterr()
    return code, said.out, said.err


def test_command_with_after_start_and_between_answers(scene_file, capsys):
    assert "kind initial" in run(capsys, "collide", scene_file)[1]
    code, out, _ = run(capsys, "collide", scene_file, "--after-start", "--exit-code")
    first_line = "first new contact at t = 3.0 (3), kind vertex-vertex"
    assert (code, out.splitlines()[0]) == (1, first_line)
    _, out, _ = run(capsys, "collide", scene_file, "--between", '"a,b",c', "--json", "--stats")
    answer = json.loads(out)
    assert answer["contact"]["time"]["low"] == "3"
    assert answer["tiling"] is None
    assert (answer["stats"]["bodies"], answer["stats"]["pairs"]) == (3, 1)
    _, out, _ = run(capsys, "collide", scene_file, "--after-start", "--since", "7/2")
    assert out == "no new contact from t = 7/2 to t = 20\n"


@pytest.mark.parametrize(
    "words, error",
    [
        (["--after-start", "--method", "kinetic"], "a tiling watches all bodies"),
        (["--between", "c"], "--between: not the names of two bodies"),
        (["--between", "c,z"], "between: there is no body 'z'"),
        (["--after-start", "--proof", "x"], "a proof is about all bodies"),
        (["--since", "3", "--proof", "x"], "--since: a proof is about the scene file"),
        (["--since", "30"], "--since: the start t = 30 is not before the end t = 20"),
        (["--all", "--after-start"], "--after-start is supported only for the first contact"),
    ],
)
def test_wrong_words_of_the_command_are_refused_in_one_line(scene_file, capsys, words, error):
    code, out, err = run(capsys, "collide", scene_file, *words)
    assert (code, out) == (2, "")
    assert error in err
    assert err.count("\n") == 1


def test_body_that_is_flat_for_an_instant_while_it_touches_another_one():
    """The vertex (1/2, t - 1/2) of a slides along an edge of b, from the start on.

    At t = 1/2 it is at the height of the two others, so that a is flat: its vertex (0, 0) is on the
    edge between (1/2, 0) and (-1, 0). a and b do not overlap before, nor then.
    """
    a = Body("a", [(-1, 0), (0, 0), ("1/2", Polynomial(["-1/2", 1]))])
    b = Body("b", [(1, 0), ("1/2", -1), ("1/2", 1)])

    contact = first_contact(Scene([a, b], time=(0, 1)), after_start=True)

    assert contact is not None
    assert contact.kind == "self"
    assert contact.time == "1/2"
