"""Groups of a scene: their names and patterns, what refuses them, and what keeps them."""

import copy
import json
import pickle

import numpy as np
import pytest
from click.testing import CliRunner

import exactpt
import exactpt.testing
from exactpt import Body, InputError, Scene, Translation, first_contact
from exactpt.cli import cli
from exactpt.simulation.store import sealed

SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]


def tile(name, x, motion=None):
    corners = [(x + u, v) for u, v in SQUARE]
    return Body(name, corners, motion or Translation())


ROW = [
    tile("tile 1", 0),
    tile("tile 2", 1),
    tile("tile 3", 2),
    tile("boat", 9, Translation([0, -1])),
]


def row(*groups):
    return Scene(ROW, (0, 20), ignoring=groups)


def counted_at_start(scene):
    """Return the pairs that touch at the start and count."""
    contact = first_contact(scene)
    if contact is None or contact.time > 0:
        return set()
    return {"".join(sorted(name[-1] for name in pair)) for pair in contact.initial_pairs}


@pytest.mark.parametrize(
    ("groups", "counted"),
    [
        ([], {"12", "13", "23"}),
        ([("tile 1", "tile 2")], {"13", "23"}),
        ([("tile 1", "tile 2"), ("tile 2", "tile 3")], {"13"}),  # not transitive
        ([("tile 2", "tile 1", "tile 1"), ("tile 1", "tile 2")], {"13", "23"}),
        ([("tile*",)], set()),
        ([("tile 1*", "tile 3")], {"12", "23"}),
        ([("*",)], set()),
    ],
)
def test_groups_of_names_and_patterns_ignore_their_pairs(groups, counted):
    of_scene, of_call = row(*groups), row()

    assert counted_at_start(of_scene) == counted
    contact = first_contact(of_call, ignoring=groups)
    assert contact == first_contact(of_scene)
    for k in range(len(groups)):
        part = row(*groups[:k])
        assert first_contact(part, ignoring=groups[k:]) == contact


def test_name_that_ends_in_a_star_is_no_pattern():
    bodies = [tile("a*", 0), tile("ab", 1), tile("c", 1)]

    scene = Scene(bodies, ignoring=[("a*", "c")])
    assert {frozenset(pair) for pair in first_contact(scene).initial_pairs} == {
        frozenset(("a*", "ab")), frozenset(("ab", "c"))
    }  # fmt: skip
    # without the body of this name nothing of the group is left: it does not become a pattern
    assert scene.going_on(bodies[1:], scene.exact_start).ignoring == ()


def test_body_of_a_group_counts_with_itself():
    """The end of the chain, at (4, 3 - t), reaches the first edge, y = 0, at t = 3."""
    hook = [(0, 0), (5, 0), (5, 9), (4, 9), ([4], [3, -1])]
    scene = Scene(
        [Body("hook", hook, closed=False), tile("tile", 1)], (0, 9), ignoring=[("hook", "tile")]
    )
    assert (first_contact(scene).kind, first_contact(scene).time) == ("self", 3)


@pytest.mark.parametrize(
    ("groups", "message"),
    [
        ([("tile 1", "tile 4")], "ignoring[0]: there is no body 'tile 4'"),
        ([("tile*",), ("til", "boat")], "ignoring[1]: there is no body 'til'"),
        ([("tile 1", "ship*")], "ignoring[0]: no body has a name of the pattern 'ship*'"),
        ([("boat",)], "ignoring[0]: a group needs at least two bodies, got ['boat']"),
        ([("boat", "bo*")], "ignoring[0]: a group needs at least two bodies, got ['boat', 'bo*']"),
        ([()], "ignoring[0]: a group needs at least two bodies, got []"),
        (["tile*"], "ignoring[0]: a group of names is needed, got 'tile*'"),
        ("tile*", "ignoring: groups of names are needed, got 'tile*'"),
        ([5], "ignoring[0]: a group of names is needed, got 5"),
        ([("boat", 1)], "ignoring[0]: a name or a pattern is a text, got 1"),
    ],
)
def test_wrong_group_is_refused_in_one_line(groups, message):
    for ask in (
        lambda: Scene(ROW, (0, 20), ignoring=groups),
        lambda: first_contact(row(), ignoring=groups),
        lambda: exactpt.contacts(row(), ignoring=groups),
        lambda: exactpt.first_within(row(), distance=1, ignoring=groups),
        lambda: exactpt.certify(row(), ignoring=groups),
        lambda: exactpt.first_contact_enclosed(row(), ignoring=groups),
    ):
        with pytest.raises(InputError) as caught:
            ask()
        assert str(caught.value) == message


@pytest.mark.parametrize(
    ("written", "message"),
    [
        ({}, '"ignoring": not a list'),
        (["tile 1"], '"ignoring"[0]: not a list'),
        ([["tile 1", 2]], '"ignoring"[0]: a name or a pattern is a text, got 2'),
        ([["tile 1", None]], '"ignoring"[0]: a name or a pattern is a text, got null'),
        ([["tile 1", "x"]], "ignoring[0]: there is no body 'x'"),
        ([["tile 1"]], "ignoring[0]: a group needs at least two bodies, got ['tile 1']"),
    ],
)
def test_wrong_group_in_a_file_is_refused_with_the_name_of_the_file(tmp_path, written, message):
    path = tmp_path / "row.json"
    path.write_text(json.dumps({**row().to_json(), "ignoring": written}))

    with pytest.raises(InputError) as caught:
        Scene.load(path)

    assert str(caught.value).startswith(f"{path}: {message}")
    assert "\n" not in str(caught.value)


def test_file_has_the_texts_of_the_groups_as_they_were_given(tmp_path):
    groups = [["tile 2", "tile 1", "tile 1"], ["tile*", "boat"]]
    scene = row(*groups)
    scene.save(tmp_path / "row.json")

    assert json.loads((tmp_path / "row.json").read_text())["ignoring"] == groups
    assert Scene.load(tmp_path / "row.json") == scene
    assert scene.ignoring == tuple(map(tuple, groups))


def test_file_of_a_scene_without_groups_has_no_key():
    data = row().to_json()
    assert "ignoring" not in data
    assert Scene.from_json({**data, "ignoring": []}).to_json() == data


def test_copies_pickles_and_other_spans_keep_groups():
    scene = row(("tile*",), ("tile 3", "boat"))

    for same in (copy.copy(scene), copy.deepcopy(scene), pickle.loads(pickle.dumps(scene))):
        assert same == scene
        assert same.ignoring == scene.ignoring
    for other in (scene.until(3), scene.since(3)):
        assert other.ignoring == scene.ignoring
    assert scene != row()
    assert scene != row(("tile*",))
    assert hash(scene) == hash(row(("tile*",), ("tile 3", "boat")))
    assert repr(scene) == "<Scene: 4 bodies, 16 vertices, 2 ignoring groups, t in [0, 20]>"


def test_other_bodies_keep_what_is_left_of_groups():
    scene = row(("tile 1", "tile 2"), ("tile*", "boat"), ("tile 3", "boa*"))
    one, two, three, boat = ROW

    def groups(*bodies):
        return scene.going_on(bodies, scene.exact_start).ignoring

    assert groups(*ROW) == scene.ignoring
    assert groups(one, two) == (("tile 1", "tile 2"), ("tile*",))
    assert groups(one, boat) == (("tile*", "boat"),)
    assert groups(boat) == groups() == ()
    assert groups(tile("tile 9", 50), three) == (("tile*",),)  # a new body matches the pattern


def test_scene_from_arrays_has_groups_of_its_names():
    corners = np.array([(0, 0), (2, 0), (0, 2), (1, 0), (3, 0), (1, 2), (5.0, 0.0)])
    offsets = [0, 3, 6, 7]
    scene = Scene.from_arrays(corners, offsets, ignoring=[("0", "1")])

    assert first_contact(scene) is None
    assert first_contact(Scene.from_arrays(corners, offsets)).initial_pairs == (("0", "1"),)
    assert pickle.loads(pickle.dumps(scene)) == scene
    named = Scene.from_arrays(corners, offsets, names=["a1", "a2", "b"], ignoring=[("a*",)])
    assert first_contact(named) is None
    with pytest.raises(InputError, match=r"^ignoring\[0\]: there is no body 'a1'$"):
        Scene.from_arrays(corners, offsets, ignoring=[("a1", "0")])


def test_many_bodies_in_overlapping_groups_have_the_first_contact_that_counts():
    """Fifty neighbours overlap in a row; the last one meets the first one at t = 95.

    Body k covers [2 k, 2 k + 3], so it overlaps k - 1 and k + 1 alone. The last one, k = 49, moves
    back by 1 in a unit of time and ignores all but the first one: from x = 98 to 3.
    """
    count = 50
    outline = [(0, 0), (3, 0), (3, 1), (0, 1)]
    bodies = [Body(f"b{k}", [(x + 2 * k, y) for x, y in outline]) for k in range(count)]
    bodies[-1] = bodies[-1].with_motion(Translation([0, -1]))
    neighbours = [(f"b{k}", f"b{k + 1}") for k in range(count - 1)]
    passed = [(f"b{k}", f"b{count - 1}") for k in range(1, count - 1)]
    scene = Scene(bodies, (0, 200), ignoring=[*neighbours, *passed])

    contact = first_contact(scene)

    assert contact.time == 2 * (count - 1) - 3
    assert contact.bodies == ("b0", f"b{count - 1}")
    assert first_contact(scene, exact_only=True) == contact
    turning = exactpt.Rigid([0, 0, 1], pivot=(50, 999))  # not linear: another search
    beside = Body("far", [(50, 999)], turning)
    assert first_contact(Scene([*bodies, beside], (0, 200), ignoring=scene.ignoring)) == contact


def test_rounded_bodies_in_overlapping_groups_count_as_others_do():
    """Discs with radius 1 at x = 0, 1, 2: neighbours ignore each other, the ends touch at once."""
    discs = [Body(f"d{k}", [(k, 0)], radius=1) for k in range(3)]
    scene = Scene(discs, ignoring=[("d0", "d1"), ("d1", "d2")])

    for options in ({}, {"exact_only": True}):
        contact = first_contact(scene, **options)
        assert (contact.time, contact.initial_pairs) == (0, (("d0", "d2"),))
        assert first_contact(scene, ignoring=[("d0", "d2")], **options) is None


def test_pair_that_the_scene_ignores_is_not_brought_back():
    scene = row(("tile 1", "tile 2"))
    message = "between: bodies 'tile 1' and 'tile 2' ignore each other in this scene"

    for ask in (first_contact, exactpt.contacts, exactpt.certify, exactpt.first_contact_enclosed):
        with pytest.raises(InputError, match=f"^{message}; leave this pair out$"):
            ask(scene, between=[("tile 2", "tile 3"), ("tile 2", "tile 1")])
    assert first_contact(scene, between=[("tile 3", "boat")]).time == 5


def test_certificate_of_overlapping_groups_names_the_pairs_that_count():
    groups = [("tile 1", "tile 2"), ("tile 2", "tile 3"), ("tile 1", "tile 3", "boat")]
    proof = exactpt.certify(row(), ignoring=groups)

    assert "; between b1 b3 (" in proof.check()
    assert proof.contact.time == 6  # the boat from x = 9 to 3
    lines = exactpt.certify(row(*groups)).text.splitlines()
    assert lines[:1] + lines[2:] == proof.text.splitlines()[:1] + proof.text.splitlines()[2:]


def test_certificate_of_equal_groups_states_one_group():
    proof = exactpt.certify(row(("tile*",)), ignoring=[("tile 1", "tile 3", "tile 2")])
    assert b"\nignoring 0 1 2\n" in proof.text


def test_certificate_of_too_many_bodies_in_overlapping_groups_is_refused():
    bodies = [Body(f"b{k}", [(k, 0)]) for k in range(201)]
    scene = Scene(bodies, ignoring=[("b1", "b2"), ("b2", "b3")])
    with pytest.raises(InputError, match="at most 200 bodies, got 201; give between="):
        exactpt.certify(scene)
    assert exactpt.certify(scene, between=[("b1", "b3")]).contact is None


def test_saved_run_of_a_scene_with_groups_is_refused(tmp_path):
    path = tmp_path / "run.json"
    apart = Scene([ROW[0], ROW[-1]], (0, 3))
    exactpt.Simulation(apart).save(path)
    data = json.loads(path.read_text())
    del data["exactpt-simulation"], data["sha256"]
    data["scene"]["ignoring"] = [["tile 1", "boat"]]
    path.write_text(json.dumps(sealed(data)))

    with pytest.raises(InputError, match="bodies of this scene ignore each other"):
        exactpt.Simulation.restore(path)


def test_convert_names_groups_as_lost_and_no_ignored_pair_as_touching(tmp_path):
    path = tmp_path / "row.json"
    row(("tile*",)).save(path)

    kept = CliRunner().invoke(cli, ["convert", str(path), str(tmp_path / "kept.json")])
    lost = CliRunner().invoke(cli, ["convert", str(path), str(tmp_path / "lost.geojson")])

    assert "touch at the start" not in kept.stderr
    assert Scene.load(tmp_path / "kept.json") == Scene.load(path)
    assert "lost: ignoring of 1 group, motion of 1 body" in lost.stderr


def test_batch_obeys_groups_of_scenes_and_of_options():
    scene = row(("tile 1", "tile 2"), ("tile 2", "tile 3"))
    text = json.dumps(scene.to_json())
    options = exactpt.batch.Options(ignoring=(("tile 1", "tile 3"),))

    first, second = exactpt.batch.answers([text, json.dumps(row().to_json())], options)

    assert first == {"contact": first_contact(row(("tile*",))).to_json()}
    assert len(second["contact"]["overlaps"]) == 2
    (wrong,) = exactpt.batch.answers([text], exactpt.batch.Options(ignoring=(("boat", "x*"),)))
    assert wrong == {"error": "ignoring[0]: no body has a name of the pattern 'x*'"}


def test_shrinking_keeps_the_groups_that_a_failure_needs():
    def fails(scene):
        return (
            first_contact(scene) is None
            and first_contact(Scene(scene.bodies, scene.time)) is not None
        )

    scene = Scene(ROW[:3], (0, 1), ignoring=[("tile 1", "tile 2"), ("tile*",)])
    smaller = exactpt.testing.shrink(scene, fails, seconds=20)

    assert len(smaller.bodies) == 2
    assert len(smaller.ignoring) == 1


def test_a_scene_in_place_of_its_bodies_is_refused():
    """Its groups would be lost: a and b, which touch at t = 1, ignore each other."""
    scene = Scene(
        [Body("a", [(0, 0)], Translation([0, 1])), Body("b", [(1, 0)])], ignoring=[("a", "b")]
    )

    with pytest.raises(InputError, match="give scene"):
        Scene(scene, scene.time)


@pytest.mark.parametrize(
    "groups",
    [
        [("a", "b", "c")],
        [("a", "b"), ("b", "c"), ("a", "c")],
        [("a", "b", "c"), ("c", "b", "a")],
        [("a", "b"), ("*",)],
    ],
)
def test_certificates_of_equal_groups_are_equal(groups):
    """The same three pairs are ignored, however that is written."""
    bodies = [Body(name, [(0, 0), (1, 0), (0, 1)]) for name in "abc"]

    lines = exactpt.certify(Scene(bodies, ignoring=groups)).text.split(b"\n")

    assert b"ignoring 0 1 2" in lines
    assert b"none" in lines
