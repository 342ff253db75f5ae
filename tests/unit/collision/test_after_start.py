"""New contacts after a touching start, some pairs alone, a later start: against the definition."""

import json
from random import Random

import pytest
from folding import every

from benchmarks.shapes import clamp, crowd
from exactpt import (
    Affine,
    Body,
    BudgetExceeded,
    InputError,
    Pieces,
    Rigid,
    Scene,
    Translation,
    first_contact,
)
from exactpt.cli import main
from exactpt.kernel.numbers import QQ
from exactpt.pairs import candidate_pairs
from exactpt.pairs.overlap import overlap
from exactpt.testing import reference
from exactpt.testing.agreement import plain_contact
from exactpt.testing.scenes import generate
from exactpt.testing.scenes.rings import as_parts, touching_parts
from fuzz.questions.tiny import pair_scene, touching_scene

FLOOR = Body("floor", [(-9, -1), (19, -1), (19, 0), (-9, 0)])
BOX = [(0, 0), (2, 0), (2, 2), (0, 2)]


def box(name, motion=None, x=0, y=0):
    return Body(name, [(x + u, y + v) for u, v in BOX], motion or Translation([0]))


def new(*bodies, time=(0, 20), **options):
    """The time and the pairs of the first new contact."""
    contact = first_contact(Scene(bodies, time), after_start=True, **options)
    if contact is None:
        return None
    return float(contact.time), {tuple(sorted((p.body, p.other))) for p in contact.pairs}


NOTCHED = Body("n", [(0, 0), (8, 0), (8, 8), (0, 8)], holes=[[(4, 0), (5, 2), (3, 2)]])
"""Its hole, a triangle, touches its outline at (4, 0)."""


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
def test_a_thread_through_a_point_in_which_rings_touch_overlaps_nothing(thread, velocity, expected):
    """It crosses the outline there, but is in the hole beyond: an open wedge of slopes over 2."""
    body = Body("thread", thread, Translation([0, velocity[0]], [0, velocity[1]]))

    found = new(NOTCHED, body, time=(0, 3))

    assert found == (None if expected is None else (expected, {("n", "thread")}))


def test_thin_bodies_through_touches_overlap_as_by_the_definition():
    """Segments and chains through a random touch of rings, compared along vertical lines."""
    random, overlapping = Random(5), 0
    for _ in range(150):
        body = Body("b", parts=as_parts(touching_parts(random, (QQ(0), QQ(0)))))
        if not body.exact_ring_touches:
            continue
        x, y = random.choice(body.exact_ring_touches)
        step = QQ(1, random.choice([4, 40]))
        u, v, w, z = (step * random.randint(-3, 3) for _ in range(4))
        ends = [(x + u, y + v), (x, y), (x + w, y + z)]
        thin = ends if random.random() < 0.5 else [ends[0], (x - u, y - v)]
        if len(set(thin)) < len(thin) or u * z == v * w:
            continue
        thread = Body("thread", thin, closed=False)

        assert overlap(body, thread, QQ(0)) == reference.overlap(body, thread, QQ(0))
        assert overlap(thread, body, QQ(0)) == overlap(body, thread, QQ(0))
        overlapping += overlap(body, thread, QQ(0))
    assert overlapping > 20


def test_a_stack_that_rests_is_in_no_new_contact():
    assert first_contact(Scene([box("box"), FLOOR])).kind == "initial"
    assert new(box("low"), box("high", y=2), FLOOR) is None


def test_a_box_slides_along_the_floor_into_another():
    slider = box("slider", Translation([0, 1]))

    assert new(slider, box("other", x=5), FLOOR) == (3, {("other", "slider")})
    assert new(slider, FLOOR) is None


def test_a_box_that_jumps_lands_again():
    contact = first_contact(
        Scene([box("box", Translation([0], [0, 3, -1])), FLOOR], (0, 9)), after_start=True
    )

    assert contact.time == 3
    assert contact.kind == "vertex-edge"
    assert [(p.body, p.vertex, p.other, p.edge) for p in contact.pairs] == [
        ("box", 0, "floor", 2),
        ("box", 1, "floor", 2),
    ]
    assert contact.pairs[0].normal == (0, 1)
    assert contact.initial_pairs == ()


def test_a_box_that_is_pressed_down_at_once_and_later():
    at_once = box("box", Translation([0], [0, -1]))
    contact = first_contact(Scene([at_once, FLOOR]), after_start=True)

    assert (contact.time, contact.kind, contact.initial_pairs) == (
        0,
        "initial",
        (("box", "floor"),),
    )
    later = Pieces([(3, Translation([0, 1])), (None, Translation([0, 1], [3, -1]))])
    assert new(box("box", later), FLOOR) == (3, {("box", "floor")})


@pytest.mark.long
def test_cells_of_a_map_that_share_borders_for_ever():
    cells = [box(f"cell {i} {j}", x=2 * i, y=2 * j) for i in range(4) for j in range(3)]
    ship = Body("ship", [(-5, 3), (-4, "5/2"), (-4, "7/2")], Translation([0, 1]))

    assert new(*cells) is None
    assert new(*cells, ship) == (4, {("cell 0 1", "ship")})
    together = [body.with_motion(Rigid([0, 1])) for body in cells]
    assert new(*together) is None


def test_a_nested_body_must_leave_before_it_counts():
    outer = Body("outer", [(-9, -9), (9, -9), (9, 9), (-9, 9)])
    inner = box("inner", Translation([0, 8, -1]))  # out at x = 9, back from 16

    time, pairs = new(inner, outer)
    assert (time, pairs) == (4 + 7**0.5, {("inner", "outer")})
    assert new(inner, outer, time=(0, 6)) is None


def test_a_body_that_closes_on_itself_counts():
    scene = clamp(3, Random(1))
    alone = first_contact(scene)

    assert alone.kind == "self"
    again = first_contact(scene, after_start=True)
    assert (again.time, again.kind, again.pairs) == (alone.time, "self", alone.pairs)
    beside = Body("beside", [scene.bodies[0].exact_at(scene.exact_start)[0]])
    both = Scene([*scene.bodies, beside], (scene.start, scene.end))
    assert first_contact(both).kind == "initial"
    assert first_contact(both, after_start=True).time <= alone.time


def test_pairs_that_begin_to_overlap_at_the_very_time_of_a_contact():
    """The second pair is found only if it is looked at beyond the time of the first."""
    press = Pieces([(3, Translation([0])), (None, Translation([0], [3, -1]))])
    bodies = [box("runner", Translation([0, 1]), y=9), box("goal", x=5, y=9), box("press", press)]

    assert new(*bodies, FLOOR) == (3, {("goal", "runner"), ("floor", "press")})


def test_between_asks_about_some_pairs_alone():
    scene = Scene(
        [box("a", Translation([0, 1])), box("b", x=4), box("c", x=4, y=1), box("d", x=9)], (0, 20)
    )

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
    with pytest.raises(InputError, match=r"^between: bodies 'a' and 'c' ignore each other"):
        first_contact(scene, between=[("a", "d"), ("c", "a")], ignoring=[("a", "c")])


def test_since_a_later_time():
    scene = Scene([box("a", Translation([0, 1])), box("b", x=4), box("c", x=9)], (0, 20))

    assert first_contact(scene, since=1).time == 2
    late = first_contact(scene, since=3)
    assert (late.time, late.kind, late.initial_pairs) == (3, "initial", (("a", "b"),))
    assert first_contact(scene, since=3, after_start=True).time == 7
    assert first_contact(scene, since=3, method="kinetic").kind == "initial"
    assert first_contact(scene, since=-5).time == 2
    assert scene.since("5/2").start == QQ(5, 2)
    assert first_contact(scene, since=12) is None


@every(
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
def test_wrong_calls(options, words):
    with pytest.raises(InputError, match=words):
        first_contact(Scene([box("a"), box("b", x=5)]), **options)


def test_a_later_start_at_which_a_polygon_is_not_simple():
    vertices = [{"x": [0]}, {"x": [4]}, {"x": [4], "y": [4, -4]}, {"x": [0], "y": [4, -1]}]
    scene = Scene.from_json(
        {"exactpt": 1, "time": [0, 9], "bodies": [{"name": "fold", "vertices": vertices}]}
    )
    with pytest.raises(InputError, match="body 'fold': "):
        first_contact(scene, since=1)


def test_a_spent_budget_claims_nothing():
    with pytest.raises(BudgetExceeded) as spent:
        first_contact(crowd(20, Random(1), radius=60, end=2), after_start=True, max_seconds=0)
    assert spent.value.reached is None


def compare(scene, between=None, **options):
    contact = plain_contact(first_contact(scene, after_start=True, between=between, **options))
    expected = reference.first_new_contact(scene, between)
    if contact is None:
        assert expected is None
        return None
    assert (contact.time, contact.names) == expected
    return contact.kind


@pytest.mark.long
@pytest.mark.parametrize(
    "count", [100, pytest.param(4_000, marks=pytest.mark.slow)], ids=["few", "many"]
)
@pytest.mark.parametrize("draw", [touching_scene, pair_scene])
def test_tiny_scenes_against_the_definition(draw, count, monkeypatch):
    random, seen = Random(f"new {count}"), set()
    for k in range(count):
        monkeypatch.setattr(candidate_pairs, "FEW", 4 * (k % 2))
        scene = draw(random)
        between = [[body.name for body in scene.bodies[:2]]] if k % 5 == 0 else None
        seen.add(compare(scene, between, exact_only=k % 3 == 0))
    assert {None, "vertex-edge", "vertex-vertex"} <= seen


@pytest.mark.parametrize("family", ["pieces", "turning", "deforming"])
def test_scenes_that_do_not_touch_at_the_start(family):
    """Then new contacts are contacts."""
    for seed in range(2):
        scene = generate(family, seed)
        plain = first_contact(scene)
        if plain is None or plain.kind != "initial":
            again = first_contact(scene, after_start=True)
            assert (again and again.to_json()) == (plain and plain.to_json())


def test_growth_into_a_neighbour():
    grow = box("grow", Affine([[[1, "1/2"], [0]], [[0], [1]]]))

    assert new(grow, box("beside", x=2), time=(0, 3)) == (0, {("beside", "grow")})
    assert new(grow, box("above", y=2), time=(0, 3)) is None


@pytest.fixture
def scene_file(tmp_path):
    path = tmp_path / "scene.json"
    Scene([box("a,b", Translation([0, 1])), box("c", x=5), FLOOR], (0, 20)).save(path)
    return str(path)


def run(capsys, *words):
    code = 0
    try:
        code = main(list(words))
    except SystemExit as stop:
        code = stop.code
    said = capsys.readouterr()
    return code, said.out, said.err


def test_on_the_command_line(scene_file, capsys):
    assert "kind initial" in run(capsys, "collide", scene_file)[1]
    code, out, _ = run(capsys, "collide", scene_file, "--after-start", "--exit-code")
    assert (code, out.splitlines()[0]) == (
        1,
        "first new contact at t = 3.0 (3), kind vertex-vertex",
    )
    _, out, _ = run(capsys, "collide", scene_file, "--between", '"a,b",c', "--json", "--stats")
    answer = json.loads(out)
    assert answer["contact"]["time"]["low"] == "3"
    assert (answer["tiling"], answer["stats"]) == (
        None,
        {"bodies": 3, "vertices": 12, "events": 0, "pairs": 1},
    )
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
def test_refusals_on_the_command_line(scene_file, capsys, words, error):
    code, out, err = run(capsys, "collide", scene_file, *words)
    assert (code, out) == (2, "")
    assert error in err
    assert err.count("\n") == 1
