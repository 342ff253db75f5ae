"""First contacts of bodies with holes and parts: against the reference, and by hand."""

from itertools import pairwise

import pytest

from exactpt import Body, InputError, Planner, Rigid, Scene, Translation, first_contact
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from exactpt.testing.scenes import RINGS, generate
from exactpt.tiling.start import TILINGS

FRAME = [(0, 0), (10, 0), (10, 10), (0, 10)]
HOLE = [(1, 1), (9, 1), (9, 9), (1, 9)]


def summary(contact):
    if contact is None:
        return None
    return contact.time.to_json(), contact.kind, contact.pairs, contact.initial_pairs


def frame(*more, **options):
    return Body("frame", parts=[{"vertices": FRAME, "holes": [HOLE]}, *more], **options)


@pytest.mark.long
@pytest.mark.parametrize("family", sorted(RINGS))
def test_first_contacts_are_those_of_the_reference(family):
    kinds = set()
    for seed in range(25):
        scene = generate(family, seed)
        truth = reference.first_contact(scene)
        kinds.add(None if truth is None else truth.kind)
        assert disagreement(truth, first_contact(scene)) is None, seed
        assert disagreement(truth, first_contact(scene, method="pairs")) is None, seed
        exactly = first_contact(scene, method="pairs", exact_only=True)
        assert disagreement(truth, exactly) is None, seed
        for tiling in ("auto", *TILINGS):
            found = first_contact(scene, method="kinetic", tiling=tiling)
            assert disagreement(truth, found) is None, (seed, tiling)
    assert {None, "vertex-edge"} < kinds


def test_a_body_in_a_hole_is_apart_until_it_touches_from_inside():
    ball = Body("ball", [(5, 5), (6, 5), (5, 6)], Translation([0, 1]))
    contact = first_contact(Scene([frame(), ball], (0, 10)))
    assert contact.time == 3
    (pair,) = contact.pairs
    assert (pair.vertex, pair.edge, pair.normal) == (1, 5, (-1.0, 0.0))
    assert contact.kind == "vertex-edge"


@pytest.mark.parametrize("hole", [HOLE, HOLE[::-1]])
@pytest.mark.parametrize("outline", [FRAME, FRAME[::-1]])
def test_normals_point_out_of_the_body(outline, hole):
    """Into the hole at its edges, away from the body at its outline, whatever the orientations."""
    body = Body("frame", outline, holes=[hole])
    for start, speed in ((5, 1), (5, -1), (-5, 1), (15, -1)):
        ball = Body("ball", [(start, 5)], Translation([0, speed]))
        (pair,) = first_contact(Scene([body, ball], (0, 20))).pairs
        assert pair.normal == (-speed, 0.0)


@pytest.mark.parametrize(
    ("other", "overlaps"),
    [
        ([(5, 5)], False),
        ([(FRAME[0][0] + 1, 5)], True),
        ([("1/2", 5)], True),
        ([("1/2", "1/2"), ("3/4", "1/2"), ("1/2", "3/4")], True),
        ([(-1, -1), (11, -1), (11, 11), (-1, 11)], True),
        ([(2, 2), (8, 2), (8, 8), (2, 8)], False),
    ],
)
def test_what_shares_a_point_at_the_start(other, overlaps):
    scene = Scene([frame(), Body("other", other)], (0, 1))
    found, truth = first_contact(scene), reference.first_contact(scene)
    assert disagreement(truth, found) is None
    assert (found is not None) == overlaps


def test_a_part_alone_in_another_body_is_an_overlap():
    """Whichever part it is, and in whichever part of the other one."""
    for parts in ([FRAME, [(30, 0), (40, 0), (30, 9)]], [[(30, 0), (40, 0), (30, 9)], FRAME]):
        for small in ([[(2, 2), (3, 2), (2, 3)], [(50, 0), (51, 0), (50, 1)]],) * 2:
            scene = Scene([Body("a", parts=parts), Body("b", parts=small[::-1])], (0, 1))
            assert first_contact(scene).initial_pairs == (("a", "b"),)
            assert disagreement(reference.first_contact(scene), first_contact(scene)) is None


def test_parts_move_together():
    body = Body("two", parts=[[(0, 0), (1, 0), (0, 1)], [(5, 0), (6, 0), (5, 1)]],
                motion=Translation([0, 1]))  # fmt: skip
    contact = first_contact(Scene([body, Body("post", [(8, 0)])], (0, 10)))
    assert contact.time == 2
    assert contact.pairs[0].vertex == 4


def test_a_hole_that_closes_on_its_outline_touches_itself():
    ring = [{"x": [x, 1], "y": [y]} for x, y in HOLE]
    scene = Scene([Body("b", FRAME, holes=[ring])], (0, 5))
    contact = first_contact(scene)
    assert (contact.kind, contact.time) == ("self", 1)
    assert disagreement(reference.first_contact(scene), contact) is None


def test_a_ring_that_turns_around_a_body():
    slab = Body("slab", [(2, 4), (8, 4), (8, 6), (2, 6)])
    hole = [(1, 3), (9, 3), (9, 7), (1, 7)]
    turning = Body("frame", FRAME, holes=[hole], motion=Rigid([0, "1/4"], pivot=(5, 5)))
    scene = Scene([turning, slab], (0, 4))
    contact = first_contact(scene)
    assert disagreement(reference.first_contact(scene), contact) is None
    assert contact is not None
    assert not contact.time.is_rational


def test_nesting():
    """A body in a hole of a body in a hole: each is apart from all others."""
    rings = [
        Body(f"ring{k}", [(-3 * k - 2, -3 * k - 2), (3 * k + 2, -3 * k - 2), (0, 4 * k + 3)],
             holes=[[(-3 * k - 1, -3 * k - 1), (3 * k + 1, -3 * k - 1), (0, 4 * k + 1)]])
        for k in range(1, 4)
    ]  # fmt: skip
    scene = Scene([*rings, Body("core", [(0, 0)])], (0, 1))
    assert first_contact(scene) is reference.first_contact(scene) is None
    for a, b in pairwise(rings):
        assert first_contact(Scene([a, b], (0, 1))) is None


@pytest.mark.long
@pytest.mark.parametrize("family", sorted(RINGS))
def test_planners_answer_as_first_contacts(family):
    for seed in range(15):
        scene = generate(family, seed)
        *obstacles, body = scene.bodies
        found = Planner(obstacles, (scene.start, scene.end)).first_contact(body, body.motion)
        named = [(b.name, body.name) for b in obstacles]
        alone = Scene([body], (scene.start, scene.end))
        contacts = [first_contact(scene, between=named), first_contact(alone)]
        times = [c.time for c in contacts if c is not None]
        assert (found and found.time) == min(times, default=None), seed
        if contacts[1] is None:
            assert summary(found) == summary(contacts[0]), seed


def test_the_tiling_of_points_refuses_them_in_one_line():
    message = "^body 'frame': has 8 vertices: the incremental tiling is for points$"
    with pytest.raises(InputError, match=message):
        first_contact(Scene([frame()], (0, 1)), tiling="incremental")


def test_coefficients_out_of_the_range_of_doubles_are_no_reason_for_a_tiling():
    huge = 10**400
    ring = [(x * huge, y * huge) for x, y in FRAME]
    hole = [(x * huge, y * huge) for x, y in HOLE]
    ball = Body("ball", [{"x": [5 * huge, huge], "y": [5 * huge]}])
    scene = Scene([Body("frame", ring, holes=[hole]), ball], (0, 9))
    assert first_contact(scene).time == 4
