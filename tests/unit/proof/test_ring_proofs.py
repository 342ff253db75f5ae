"""Proofs of scenes with holes: a map of several components, in both checkers."""

import hashlib
import json

import proving
import pytest
from folding import every
from proving import accepted, agrees, by_both_checkers, proof_of, verdict  # noqa: F401 - a fixture

from exactpt import Body, Scene, Translation
from exactpt.proof.lines import header
from exactpt.scene.scene import scene_of
from exactpt.scene.written import scene_bytes
from exactpt.testing.scenes import RINGS, generate
from exactpt.tiling.start import TILINGS

pytestmark = pytest.mark.usefixtures("by_both_checkers")

FRAME = [(0, 0), (12, 0), (12, 12), (0, 12)]
HOLE = [(1, 1), (11, 1), (11, 11), (1, 11)]


def room(*bodies, **options):
    return Scene([Body("frame", FRAME, holes=[HOLE], **options), *bodies], (0, 9))


def ball(x=6, speed=1, name="ball"):
    return Body(name, [(x, 6), (x + 1, 6), (x, 7)], Translation([0, speed]))


def lines_of(scene):
    lines, _ = proof_of(scene, "lazy")
    assert accepted(scene, lines)
    return lines


@pytest.mark.long
@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize("family", sorted(RINGS))
def test_right_answers_are_accepted(family, tiling):
    claims = set()
    for seed in (0, 1, 2, 3, 6, 9):
        scene = generate(family, seed)
        lines, contact = proof_of(scene, tiling)
        assert accepted(scene, lines), seed
        claims.add(None if contact is None else contact.kind)
        if contact is not None and contact.kind != "initial":
            late = [*lines[:-1], "none"]
            assert not accepted(scene, late), seed
    assert {None, "vertex-edge"} <= claims


def test_a_hole_is_a_component():
    scene = room(ball())
    lines = lines_of(scene)
    faces = [
        set(map(int, line.split()[1:])) for line in lines if line.startswith(("face", "outer"))
    ]
    assert {0, 1, 2, 3} in faces
    assert not any(face & {0, 1, 2, 3} and face & set(range(4, 11)) for face in faces)


def test_a_component_that_is_left_out():
    scene = room(ball())
    lines = [line for line in lines_of(scene) if not line.startswith("face")]
    assert "edge" in verdict(scene, lines)


def test_bodies_in_a_hole_that_are_a_component_of_their_own():
    """The ball floats in the hole: its own outer face is a second one."""
    scene = room(ball(speed=0))
    rest = [line for line in lines_of(scene) if not line.startswith(("face", "none", "event"))]
    hole = ["face 4 5 6", "face 4 6 7", "outer 10 9 8"]
    assert "not connected" in verdict(scene, [*rest, *hole, "none"])


def test_an_edge_between_two_components():
    scene = room(ball(speed=0), Body("out", [(20, 5)]))
    lines = lines_of(scene)
    wrong = [*lines[:-1], "event 1 1 + 11 8 0 9", "none"]
    assert "joins two components" in verdict(scene, wrong)


def test_a_body_in_the_solid_part_overlaps_at_the_start():
    scene = room(Body("ball", [("1/2", "1/2"), ("3/4", "1/2"), ("1/2", "3/4")]))
    lines = lines_of(scene)
    assert lines[-1].endswith("vertex 8 inside 0")
    inside = room(Body("ball", [(6, 6), (7, 6), (6, 7)]))
    assert not accepted(inside, [*lines_of(inside)[:3], lines[-1]])


def test_a_scene_in_which_a_hole_is_nowhere():
    """Scenes that exactpt refuses: the checkers do so, too."""
    scene = room(ball(speed=0))
    lines = lines_of(scene)
    for hole in ([(20, 1), (30, 1), (30, 11), (20, 11)], [(-1, 1), (11, 1), (11, 11), (1, 11)]):
        frame = Body("frame", FRAME, holes=[hole])
        forged = scene_of((frame, scene.bodies[1]), scene.exact_start, scene.exact_end)
        reported = verdict(
            forged, [*header(scene_bytes(forged), forged.exact_start, forged.exact_end), *lines[3:]]
        )
        assert any(
            words in reported for words in ("not simple", "none can be", "a hole or part amiss")
        )


@every(
    "body",
    [
        '"vertices": [[0,0],[9,0],[0,9]], "holes": [[[1,1],[2,1]]]',
        '"parts": [{"vertices": [[0,0],[9,0]]}]',
        '"parts": [{"vertices": [[0,0],[9,0],[0,9]], "motion": {}}]',
        '"closed": false, "parts": [{"vertices": [[0,0],[9,0],[0,9]]}]',
        '"vertices": [[0,0],[9,0],[0,9]], "parts": []',
        '"keyframes": [{"t": 0, "vertices": [[0,0],[9,0],[0,9]]}], "holes": []',
        '"parts": []',
    ],
)
def test_scenes_that_are_none(body):
    """What the reader of scenes refuses is no scene to the checkers."""
    text = f'{{"exactpt": 1, "time": [0, 1], "bodies": [{{"name": "b", {body}}}]}}'.encode()
    proof = f"exactpt-proof 1\nscene sha256 {hashlib.sha256(text).hexdigest()}\nspan 0 1\nnone\n"
    assert proving.current[0](text, proof.encode()).startswith("rejected: ")
    with pytest.raises(ValueError, match="b"):
        Scene.from_json(json.loads(text))


def test_a_deforming_body_is_one_component_with_its_holes():
    hole = [{"x": [x], "y": [y, "1/9"]} for x, y in HOLE]
    scene = Scene([Body("frame", FRAME, holes=[hole]), ball(speed=0)], (0, 8))
    lines, contact = proof_of(scene, "lazy")
    assert accepted(scene, lines)
    assert sum(line.startswith("inside") for line in lines) == 4
    assert agrees(scene, contact)
