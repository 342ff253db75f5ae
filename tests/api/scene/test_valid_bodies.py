"""Bodies that are valid but not simple: what is refused, and every question about them."""

import json
import pickle
from fractions import Fraction

import pytest
from commands import code_of

import exactpt
from exactpt import (
    Affine,
    Body,
    InputError,
    Pieces,
    Planner,
    Polynomial,
    PosePath,
    Rigid,
    Scene,
    Simulation,
    Spin,
    Translation,
    clearance,
    contact_intervals,
    contacts,
    distance,
    first_contact,
    first_contact_enclosed,
    first_within,
)
from exactpt.batch import Options, answers
from exactpt.kernel.numbers import QQ
from exactpt.kernel.stored import Stored
from exactpt.simulation.saved import tiling_from_json, tiling_to_json
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement

SQUARE = [(0, 0), (8, 0), (8, 8), (0, 8)]
NOTCH = [(4, 0), (5, 2), (3, 2)]
"""A hole that touches the square at (4, 0), inside of an edge: x = 4 -+ y / 2 are two sides."""

POINT = Translation([4], [1, Fraction(1, 2)])


def notched(motion=None, **options):
    return Body("notched", SQUARE, motion or Translation(), holes=[NOTCH], **options)


def scene_of(motion=None, other=POINT, time=(0, 9), **options):
    return Scene([notched(motion, **options), Body("point", [(0, 0)], other)], time)


VALID = {
    "a vertex of a hole on an edge": [[SQUARE, NOTCH]],
    "a vertex of a hole on a vertex": [[SQUARE, [(0, 0), (2, 1), (1, 2)]]],
    "a vertex of the outline on a hole": [
        [[*SQUARE[:2], (5, 4), *SQUARE[2:]], [(5, 2), (5, 6), (3, 4)]]
    ],
    "two holes": [[SQUARE, [(2, 2), (4, 4), (2, 4)], [(4, 4), (6, 6), (4, 6)]]],
    "three rings": [[SQUARE, [(0, 0), (2, 1), (3, 2)], [(0, 0), (1, 2), (2, 3)]]],
    "a chain of holes that ends": [[SQUARE, [(0, 4), (2, 3), (4, 4)], [(4, 4), (6, 3), (7, 4)]]],
    "two parts": [[SQUARE], [(8, 8), (9, 8), (9, 9)]],
    "parts that touch twice": [[SQUARE], [(8, 2), (10, 4), (8, 6), (9, 4)]],
    "a part in a hole": [[SQUARE, [(1, 1), (7, 1), (7, 7), (1, 7)]], [(1, 4), (4, 2), (7, 4)]],
    "a part in a hole at its touch": [[SQUARE, NOTCH], [(4, 0), (4, 1), (Fraction(15, 4), 1)]],
}


def given(parts):
    """Parts, of which one without holes may be its outline alone."""
    rings = [part if isinstance(part[0], list) else [part] for part in parts]
    return [{"vertices": outline, "holes": holes} for outline, *holes in rings]


@pytest.mark.parametrize("name", VALID)
def test_a_valid_body_is_accepted_at_every_door(name):
    body = Body("b", parts=given(VALID[name]))
    scene = Scene([body], (0, 1))
    assert body.exact_ring_touches
    assert Scene.from_json(json.loads(json.dumps(scene.to_json()))) == scene
    assert pickle.loads(pickle.dumps(scene)) == scene
    (geometry,) = scene.to_shapely(0).values()
    assert geometry.is_valid
    assert Body.from_shapely(geometry, "b").at(0) == body.at(0)
    assert Scene.from_shapely([geometry]).bodies[0].parts == body.parts
    assert first_contact(scene) is None


INVALID = [
    # The hole touches the outline at (0, 4) and (8, 4): the inside is two pieces.
    ([[SQUARE, [(0, 4), (4, 3), (8, 4)]]], r"not connected: its rings touch at .*\(8, 4\)"),
    ([[SQUARE, [(0, 4), (4, 3), (8, 4)]]], r"its rings touch at .*\(0, 4\)"),
    ([[SQUARE, [(0, 4), (2, 3), (4, 4)], [(4, 4), (6, 3), (8, 4)]]], "the inside is not connected"),
    ([[SQUARE], [(20, 0), (28, 0), (28, 8), (20, 8)],
      [[(40, 0), (48, 0), (44, 8)], [(44, 0), (46, 4), (42, 4)]]], "the inside of part 2 is not"),
    ([[SQUARE, [(8, 8), (9, 10), (10, 9)]]], "a hole is outside of its outline: vertex 4"),
    ([[SQUARE, [(4, 0), (3, -2), (5, -2)]]], "a hole is outside of its outline: vertex 4"),
    ([[SQUARE, [(1, 1), (7, 1), (7, 7), (1, 7)], [(1, 4), (4, 2), (6, 4)]]],
     "a hole is inside another hole: vertex 8"),
    ([[SQUARE], [(0, 4), (4, 2), (7, 4)]], "a part is inside another part: vertex 4"),
    ([[SQUARE], [(8, 4), (7, 5), (9, 5)]], r"two rings cross: edge 1 from \(8, 0\) meets edge"),
    ([[SQUARE, [(8, 2), (8, 4), (6, 3)]]], "two rings have a common piece: edge 1 .* edge 4"),
    ([[SQUARE], [(8, 2), (9, 3), (8, 4)]], "common piece: .*exactpt.union joins such parts"),
    ([[SQUARE, [(1, 1), (3, 3), (5, 1), (3, 3), (3, 5)]]], "edge 4 .* meets edge 6"),
]  # fmt: skip


@pytest.mark.parametrize(("parts", "message"), INVALID)
def test_a_body_that_is_not_valid_is_refused_with_the_places(parts, message):
    body = Body("b", parts=given(parts))
    with pytest.raises(InputError, match=f"body 'b': .*not valid at the start, t = 3: .*{message}"):
        Scene([body], (3, 4))


def test_every_vertex_of_a_ring_may_touch():
    """The hole touches a hole at each vertex: a point half way along an edge tells where it is."""
    middle = [(3, 3), (5, 3), (4, 5)]
    around = [[(3, 3), (2, 2), (1, 3)], [(5, 3), (6, 2), (7, 3)], [(4, 5), (5, 6), (3, 6)]]
    Scene([Body("b", SQUARE, holes=[middle, *around])])
    with pytest.raises(InputError, match="a hole is inside another hole: vertex 4"):
        Scene([Body("b", SQUARE, holes=[middle, [(3, 3), (2, 1), (6, 1), (5, 3), (6, 7), (4, 5),
                                                 (1, 7)]])])  # fmt: skip


SINGULAR_AT_2 = [[1, 0], [0, Polynomial([2, -1])]]
"""A matrix with the determinant 2 - t."""

UNIT = [[1, 0], [0, 1]]

KEPT = {
    "rest": Translation(),
    "translation": Translation([0, 1], [0, 0, 2]),
    "turn": Rigid([0, 1], pivot=(4, 0), x=[0, 1]),
    "affine": Affine([[Polynomial([1, 1]), Polynomial([0, 3])], [0, -1]]),
    "affine that collapses later": Affine(SINGULAR_AT_2),
    "pieces": Pieces([(1, Translation([0, 1])), (None, Rigid([-1, 1], pivot=(0, 0), x=1))]),
    "spin": Spin("3/2", pivot=(4, 4), error="1/100"),
    "path": PosePath([0, 1], [([0, 2], [0], [0, 1])], error="1/100"),
}


@pytest.mark.parametrize("name", KEPT)
def test_a_motion_that_keeps_the_shape_is_accepted_and_the_body_never_touches_itself(name):
    scene = scene_of(KEPT[name], Translation([4], [40, -20]), (0, 1))
    contact, expected = first_contact(scene), reference.first_contact(scene)
    assert disagreement(expected, contact) is None
    assert disagreement(expected, first_contact(scene, exact_only=True)) is None
    alone = Scene(scene.bodies[:1], scene.time)
    assert first_contact(alone) is None
    assert first_contact(alone, method="pairs", after_start=True) is None
    assert first_contact_enclosed(alone) is None
    assert contacts(alone) == []


class Squeeze:
    """A motion of a caller's own class."""

    def track(self, position):
        return Translation().track(position)


class Lower:
    """A motion of a caller's own class, under which the vertex (4, 0) comes down from (4, 1)."""

    def track(self, position):
        is_tip = [f(0) for f in position] == [4, 0]
        return Translation([0], [1, -1] if is_tip else [0]).track(position)


def test_rings_that_touch_at_rest_may_be_apart_under_a_motion_of_another_class():
    """At the start the hole is 1 away from the outline, which it touches at t = 1."""
    body = notched(Lower())
    contact = first_contact(Scene([body], (0, 2)))
    assert (contact.kind, contact.time) == ("self", 1)
    assert first_contact(Scene([body.with_motion(Translation())], (0, 2))) is None
    with pytest.raises(InputError, match="its rings touch"):
        Simulation(Scene([body.with_motion(Translation())], (0, 2)))


def test_numbers_that_are_no_doubles_make_no_tiling_of_a_body_that_is_not_simple():
    """Most numbers are beyond the doubles; a tiling refuses the body, the search has no boxes."""
    far = 10**400
    grown = Affine([[1, ["0", f"1/{far}"]], [["0", f"1/{far}"], 1]], x=[0, far])
    others = [
        Body(f"b{i}", [(20 + i * far, 1), (21 + 9 * i, 0), (20 + 9 * i, 3)], grown) for i in (0, 1)
    ]
    turning = Rigid([0, "1/100"])
    simple = Body("simple", SQUARE, turning, holes=[[(4, 1), (5, 2), (3, 2)]])
    assert first_contact(Scene([simple, *others], (0, 1))) is None
    assert first_contact(Scene([notched(turning), *others], (0, 1))) is None


@pytest.mark.parametrize(
    ("motion", "vertices", "reason"),
    [
        (Affine(SINGULAR_AT_2), SQUARE, "its affine motion collapses at t = 2"),
        (Affine([[1, 0], [0, Polynomial([-2, 0, 1])]]), SQUARE, "collapses at t = about 1.414213"),
        (Affine([[1, 0], [0, Polynomial([4, -4, 1])]]), SQUARE, "collapses at t = 2"),
        (Affine([[1, 0], [0, Polynomial([3, -1])]]), SQUARE, "collapses at t = 3"),
        (Affine([[1, 0], [0, Polynomial([2, -2, -1, 1])]]), SQUARE, "collapses at t = 1:"),
        (Pieces([(1, Affine(UNIT)), (None, Affine(SINGULAR_AT_2))]), SQUARE, "collapses at t = 2"),
        (Translation(), [*SQUARE[:3], {"x": [0], "y": [8, 1]}], "its vertices move by"),
        (Squeeze(), SQUARE, "does not know whether its motion, of class Squeeze, keeps"),
    ],
)  # fmt: skip
def test_rings_touch_only_of_a_body_that_keeps_its_shape(motion, vertices, reason):
    """The determinants are 2 - t, t^2 - 2, (t - 2)^2, 3 - t, (t - 1) (t^2 - 2), then 2 - t."""
    body = Body("b", vertices, motion, holes=[NOTCH])
    with pytest.raises(InputError) as raised:
        Scene([body], (0, 3))
    message = str(raised.value)
    assert message.startswith("body 'b': not valid at the start, t = 0: its rings touch at (4, 0)")
    assert reason in message
    assert "\n" not in message
    simple = Body("b", vertices, motion, holes=[[(4, 1), (5, 2), (3, 2)]])
    Scene([simple], (0, 3))


def test_a_span_that_ends_before_the_collapse_is_accepted_and_may_not_be_extended():
    body = notched(Affine(SINGULAR_AT_2))
    scene = Scene([body], (0, 1))
    assert scene.until("1/2").since("1/4").time == (Fraction(1, 4), Fraction(1, 2))
    with pytest.raises(InputError, match="collapses at t = 2"):
        Planner([body], (0, 2))
    Scene([Body("b", SQUARE, Affine(SINGULAR_AT_2), holes=[NOTCH])], (Fraction(5, 2), 4))


def test_first_contact_is_that_of_the_hole_whose_side_is_met_first():
    """The point (4, 1 + t / 2) is in the notch until y = 2 at t = 2: on edge 5 of the hole."""
    scene = scene_of()
    contact = first_contact(scene)
    assert contact.time == 2
    assert [(p.body, p.other, p.edge, p.normal) for p in contact.pairs] == [
        ("point", "notched", 5, (0.0, -1.0))
    ]
    for options in (
        {"method": "pairs"}, {"method": "auto"}, {"exact_only": True},
        {"between": [("point", "notched")]}, {"after_start": True}, {"since": "1/2"},
        {"ignoring": [["other", "another"]]},
    ):  # fmt: skip
        far = [Body("other", [(90, 90)]), Body("another", [(80, 90)])]
        others = Scene([*scene.bodies, *far], scene.time)
        assert first_contact(others, **options).time == 2


@pytest.mark.parametrize("exact_only", [False, True])
@pytest.mark.parametrize("motion", [Translation(), Affine([[1, 0], [0, Polynomial([1, "1/2"])]])])
def test_a_contact_in_the_point_of_the_touch_has_the_incidences_with_both_rings(motion, exact_only):
    """The point comes from below to (4, 0), on edge 0 of the outline and vertex 4 of the hole.

    The touch of that vertex and that edge is not among them.
    """
    scene = scene_of(motion, Translation([4], [-1, 1]))
    contact = first_contact(scene, exact_only=exact_only)
    assert disagreement(reference.first_contact(scene), contact) is None
    assert contact.time == 1
    assert all(pair.body != pair.other for pair in contact.pairs)
    found = {(p.kind, p.edge, p.other_vertex) for p in contact.pairs} | {
        (p.kind, p.vertex) for p in contact.pairs if p.body == "notched"
    }
    assert ("vertex-edge", 0, None) in found
    assert any(kind == "vertex-vertex" for kind, *_ in found)


def test_every_question_about_pairs_has_the_answer_by_hand():
    """From y = 1 the point meets the side at y = 2, is inside up to y = 8, at t = 2 to 14."""
    scene = scene_of(time=(0, 20))
    (interval,) = contact_intervals(scene, "point", "notched")
    assert (interval.start, interval.end) == (2, 14)
    assert [(i.start, i.end) for i in contacts(scene)] == [(2, 14)]
    # At (4, 1) the sides x = 4 -+ y / 2 are at the squared distance (1/2)^2 / (1 + 1/4) = 1/5.
    assert distance(scene, "point", "notched", at=0).squared == Fraction(1, 5)
    assert clearance(scene, "point", "notched").minimum.time == 2
    assert clearance(scene, "point").minimum.body == "notched"
    # On y = 2 - d the distance from the side y = 2 is d = 1/8 at y = 15/8, t = 7/4.
    assert first_within(scene, "point", "notched", "1/8") == Fraction(7, 4)
    bounds = first_contact_enclosed(scene)
    assert (bounds.low, bounds.high) == (2, 2)


def test_a_radius_narrows_the_notch():
    """With radius 1/8 the side y = 2 is met at y = 15/8, t = 7/4; (4, 1) is 1 / sqrt 5 away."""
    contact = first_contact(scene_of(radius="1/8"))
    assert contact.time == Fraction(7, 4)
    assert contact.pairs[0].normal == (0.0, -1.0)


def test_planners_take_them_as_shapes_and_as_obstacles():
    point = Body("point", [(0, 0)])
    assert Planner([notched()], (0, 9)).first_contact(point, POINT).time == 2
    back = Translation([-4], [-1, "-1/2"])
    assert Planner([point], (0, 9)).first_contact(notched(), back).time == 2
    with pytest.raises(InputError, match="not valid at the start"):
        Planner([point], (0, 9)).first_contact(notched(), Affine(SINGULAR_AT_2))


def test_batches_answer_them():
    scenes = scene_of(), scene_of(Translation([0, 1]))
    first, second = answers([json.dumps(scene.to_json()) for scene in scenes], Options())
    assert first["contact"]["time"]["low"] == "2"
    assert second["contact"]["kind"] == "vertex-edge"


def test_a_saved_run_of_other_bodies_is_refused():
    """The state is that of a run of a body whose hole is 1 away from the outline."""
    apart = Body("notched", SQUARE, holes=[[(4, 1), (5, 2), (3, 2)]])
    scene = scene_of()
    run = Simulation(Scene([apart, Body("point", [(20, 0)])], scene.time))
    state = Stored(tiling_to_json(run.kinetic), "state")
    bodies = [apart, run.body("point")]
    tiling_from_json(state, bodies, QQ(9), exact_only=False)
    with pytest.raises(InputError, match="body 'notched': its rings touch at"):
        tiling_from_json(state, [notched(), bodies[1]], QQ(9), exact_only=False)
    with pytest.raises(InputError, match="body 'point' has a radius"):
        tiling_from_json(state, [apart, bodies[1].with_radius(1)], QQ(9), exact_only=False)


NEEDS_DISJOINT_RINGS = {
    "kinetic": lambda scene, _: first_contact(scene, method="kinetic"),
    "tiling": lambda scene, _: first_contact(scene, tiling="mixed"),
    "simulation": lambda scene, _: Simulation(scene),
    "added": lambda scene, _: Simulation(Scene(scene.bodies[1:], scene.time)).add(notched()),
    "proof": lambda scene, folder: first_contact(scene, proof=folder / "a.proof"),
    "prove": lambda scene, _: exactpt.prove(scene),
    "certificate": lambda scene, folder: first_contact(scene, certificate=folder / "a.apart"),
    "certify": lambda scene, _: exactpt.certify(scene),
    "certify a time": lambda scene, _: exactpt.certify(scene, at=1),
    "certify others": lambda scene, _: exactpt.certify(
        Scene([*scene.bodies, Body("far", [(99, 99)])], scene.time), between=[("point", "far")]
    ),
    "picture": lambda scene, folder: scene.draw(folder / "a.svg", tiling="greedy"),
    "animation": lambda scene, folder: scene.draw(folder / "a.html", tiling="greedy"),
}


@pytest.mark.parametrize("name", NEEDS_DISJOINT_RINGS)
def test_what_needs_disjoint_rings_refuses_with_the_points(name, tmp_path):
    with pytest.raises(InputError, match=r"^body 'notched': its rings touch at \(4, 0\)") as raised:
        NEEDS_DISJOINT_RINGS[name](scene_of(), tmp_path)
    assert "\n" not in str(raised.value)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "words", ["simulate s.json", "tile s.json", "check s.json", "collide s.json --method kinetic",
              "collide s.json --proof a.proof", "collide s.json --certificate a.apart",
              "collide s.json --tiling lazy", "draw s.json -o a.svg --tiling lazy"]
)  # fmt: skip
def test_commands_that_need_disjoint_rings_refuse_in_a_line(words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    scene_of().save("s.json")
    assert code_of(*words.split()) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith("exactpt: ")
    assert said.err.count("\n") == 1
    assert "body 'notched': its rings touch at (4, 0)" in said.err
    assert [path.name for path in tmp_path.iterdir()] == ["s.json"]


@pytest.mark.parametrize(
    "words", ["collide s.json", "collide s.json --max-events 1", "collide s.json --all",
              "collide s.json --enclosed", "collide s.json --after-start",
              "draw s.json -o a.svg", "draw s.json -o a.html", "draw s.json -o a.png",
              "draw s.json -o b.svg --at contact", "convert s.json a.wkt",
              "convert s.json a.geojson", "convert s.json a.svg"]
)  # fmt: skip
def test_commands_about_pairs_and_pictures_accept_them(words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    scene_of().save("s.json")
    assert code_of(*words.split()) == 0
    assert "collide" not in words or "2" in capsys.readouterr().out
