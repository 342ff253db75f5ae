"""The first contact equals that of the all-pairs reference: time, kind and every incidence."""

import copy
import json
import pickle
from collections import Counter
from pathlib import Path

import pytest

from exactpt import Body, Pieces, Scene, Translation, first_contact
from exactpt.kernel.numbers import QQ
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from exactpt.testing.scenes import FAMILIES, generate
from exactpt.tiling.start import TILINGS

SCENES = Path(__file__).parents[2] / "data" / "scenes"


def assert_same(found, expected):
    assert disagreement(expected, found) is None


@pytest.mark.long(
    "chains-few",
    "flat-few",
    "grids_passing-few",
    "hairs-few",
    "mixed_shapes-few",
    "pieces-few",
    "polygons_in_step-few",
    "turning-few",
)
@pytest.mark.parametrize(
    "count", [3, pytest.param(75, marks=pytest.mark.slow)], ids=["few", "many"]
)
@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_first_contact_equals_reference(family, count):
    """More than 2,000 scenes in the slow run, many of them without contact."""
    kinds = Counter()
    for seed in range(count):
        scene = generate(family, seed)
        expected = reference.first_contact(scene)
        for tiling in TILINGS:
            assert_same(first_contact(scene, tiling=tiling), expected)
        assert_same(first_contact(scene, method="pairs"), expected)
        kinds[expected.kind if expected else "none"] += 1
    print(family, dict(kinds))  # noqa: T201 - shown with -s


def box(name, x, y, motion, width=2, height=2):
    corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
    return Body(name, corners, motion)


def two(first, second, time=(0, 10)):
    return Scene([first, second], time)


STILL = Translation()
DEGENERATE = {
    "boxes on one line meet end to end": (
        two(box("a", 0, 0, Translation([0, 1])), box("b", 5, 0, STILL)),
        3,
    ),
    "boxes on one line never meet": (
        two(box("a", 0, 0, Translation([0, -1])), box("b", 5, 0, STILL)),
        None,
    ),
    "a box slides on the level of another, under its edge": (
        two(box("a", 0, 2, Translation([0, 1])), box("b", 5, 0, STILL)),
        3,
    ),
    "corners only": (
        two(box("a", 0, 0, Translation([0, 1], [0, 1])), box("b", 5, 5, STILL)),
        3,
    ),
    "equal velocities": (
        two(
            box("a", 0, 0, Translation([0, 3], [0, 7])), box("b", 3, 0, Translation([0, 3], [0, 7]))
        ),
        None,
    ),
    "vertex meets vertex": (
        two(
            Body("a", [(0, -1), (1, 0), (0, 1), (-1, 0)], Translation([0, "1/2"])),
            Body("b", [(10, -1), (11, 0), (10, 1), (9, 0)], Translation([0, "-1/2"])),
        ),
        8,
    ),
    "a graze from below, by a parabola": (
        two(box("a", 0, 0, Translation([], [0, 4, -1])), box("b", 0, 6, STILL)),
        2,
    ),
    "a near miss by a parabola": (
        two(box("a", 0, 0, Translation([], [0, 4, -1])), box("b", 0, QQ(6) + QQ(1, 10**40), STILL)),
        None,
    ),
    "contact at the start": (two(box("a", 0, 0, STILL), box("b", 2, 1, STILL)), 0),
    "overlap at the start": (two(box("a", 0, 0, STILL), box("b", 1, 1, STILL)), 0),
    "containment at the start": (two(box("a", 0, 0, STILL, 9, 9), box("b", 3, 3, STILL)), 0),
    "contact at the very end": (
        two(box("a", 0, 0, Translation([0, 1])), box("b", 12, 0, STILL)),
        10,
    ),
    "contact just after the end": (
        two(box("a", 0, 0, Translation([0, 1])), box("b", QQ(12) + QQ(1, 10**30), 0, STILL)),
        None,
    ),
    "contact at a piece boundary, then away": (
        two(
            box("a", 0, 0, Pieces([(3, Translation([0, 1])), (None, Translation([6, -1]))])),
            box("b", 5, 0, STILL),
        ),
        3,
    ),
    "turning back just before contact": (
        two(
            box(
                "a",
                0,
                0,
                Pieces([("2999/1000", Translation([0, 1])), (None, Translation(["2999/500", -1]))]),
            ),
            box("b", 5, 0, STILL),
        ),
        None,
    ),
    "start time on an event": (
        Scene(
            [
                box("a", 0, 0, Translation([0, 1], [0, 1])),
                box("b", 3, 0, Translation([], [0, -1])),
                box("c", 6, 0, STILL),
            ],
            (0, 10),
        ),
        None,
    ),
    "a point on a segment": (
        two(
            Body("a", [(0, 5)], Translation([], [0, -1])),
            Body("b", [(-3, 0), (7, 0)]),
        ),
        5,
    ),
    "two points": (
        two(Body("a", [(0, 0)], Translation([0, 1])), Body("b", [(4, 0)], Translation([0, -1]))),
        2,
    ),
    "a deforming segment shrinks to a point": (
        Scene([Body("a", [{"x": [0, 1], "y": [0, 1]}, {"x": [6, -1], "y": [6, -1]}])], (0, 10)),
        3,
    ),
    "a triangle folds flat": (
        Scene([Body("a", [(0, 0), (4, 0), {"x": [1], "y": [6, -2]}])], (0, 10)),
        3,
    ),
}


@pytest.mark.parametrize("tiling", ["greedy", "lazy"])
@pytest.mark.parametrize("name", DEGENERATE)
def test_degenerate_battery(name, tiling):
    scene, time = DEGENERATE[name]

    found = first_contact(scene, tiling=tiling)

    assert_same(found, reference.first_contact(scene))
    if time is not None:
        assert found.time == time


@pytest.mark.long
def test_given_scenes():
    """The convex scenes with known answers."""
    answers = json.loads((SCENES / "answers.json").read_text())
    checked = 0
    for name, answer in answers.items():
        if not name.startswith(("ballistic", "convex", "sparse", "degen")):
            continue
        contact = first_contact(Scene.load(SCENES / f"{name}.json"))
        assert float(contact.time) == answer["approx"]
        exact = answer["first_contact"]
        if exact["kind"] == "rational":
            assert contact.time == exact["value"]
        else:
            polynomial = tuple(int(c) for c in exact["poly"])
            assert contact.time.sign_of(polynomial) == 0
        vertices = {(p.body, p.vertex, p.other, p.edge) for p in contact.pairs}
        pair = answer["pair"]
        assert (pair["bodies"][0], pair["vertex"], pair["bodies"][1], pair["edge"]) in vertices or (
            contact.kind == "vertex-vertex"
        )
        checked += 1
    assert checked == 11


def test_bug_equal_contacts_were_not_equal():
    fall = Translation([0], [0, 0, -1])
    ball, floor = Body("ball", [(0, 2), (1, 2), (0, 3)], fall), Body("floor", [(-5, 0), (5, 0)])
    scene = Scene([ball, floor], time=(0, 2))
    found = [first_contact(scene, method=method) for method in ("auto", "pairs", "kinetic")]
    found += [copy.copy(found[0]), pickle.loads(pickle.dumps(found[1]))]

    assert not found[0].time.is_rational
    assert all(contact == found[0] for contact in found)
    assert len({hash(contact) for contact in found}) == len(set(found)) == 1
    others = [
        first_contact(Scene([ball.with_motion(Translation(0, [0, -1])), floor], time=(0, 3))),
        first_contact(Scene([ball, Body("floor", [(6, -1), (-5, 0), (6, 0)])], time=(0, 2))),
        first_contact(Scene([ball, Body("ground", [(-5, 0), (5, 0)])], time=(0, 2))),
        first_contact(scene, since="3/2"),
    ]
    assert all(other != found[0] for other in others)
    assert found[0] != found[0].time


def test_kind_with_a_self_contact_at_the_same_time():
    """As its docstring says: two bodies touch each at themselves; and two vertices besides."""

    def fold(name, x):
        return Body(name, [(x, 0), (x + 2, 0), {"x": [x + 1], "y": [1, -1]}])

    def kind(*bodies):
        contact = first_contact(Scene(bodies, time=(0, 1)))
        assert contact.time == 1
        return contact.kind, sorted({pair.kind for pair in contact.pairs})

    p, q = Body("p", [(9, 0)], Translation([0, 1])), Body("q", [(10, 0)])
    assert kind(fold("a", 0), fold("b", 5)) == ("self", ["vertex-edge"])
    assert kind(fold("a", 0), p, q) == ("vertex-vertex", ["vertex-edge", "vertex-vertex"])
    assert kind(fold("a", 0), p, Body("q", [(10, -1), (10, 1)])) == ("vertex-edge", ["vertex-edge"])


@pytest.mark.parametrize("tiling", ["greedy", "lazy", "mixed"])
def test_first_contact_of_the_only_body_whose_motion_is_in_no_doubles_is_exact(tiling):
    """A tiling of many bodies begins in arrays of doubles, if these hold all numbers.

    The shift of the body cancels its coordinates but for 100/3. As a double, it would be off by
    as much, and the body inside the next one. Its right corner moves from 256 - 100/3 to the next
    body, at 236, at speed 1/3: in 40.
    """
    far, size = 2**60, 256  # the difference of two doubles near 2^60
    outline = [(0, 0), (size, 0), (0, size)]
    first = Body(
        "first",
        [(far + x, y) for x, y in outline],
        Translation([f"{-3 * far - 100}/3", "1/3"]),
    )
    others = [Body(f"b{k}", [(236 + 10 * size * k + x, y) for x, y in outline]) for k in range(30)]

    contact = first_contact(Scene([first, *others], (0, 90)), method="kinetic", tiling=tiling)

    assert contact.time == 40
    assert {(pair.body, pair.other) for pair in contact.pairs} == {("first", "b0")}
