"""First contacts of bodies of many vertices among small ones: all incidences, with ties."""

from fractions import Fraction

import pytest

from exactpt import Body, Pieces, Planner, Scene, Translation, first_contact, first_within
from exactpt.testing import ending_at

TEETH = 60
"""Number of teeth of a saw, which has twice as many vertices, and two for its back."""

FALLS = Translation([0], [0, -1])
STEPS_ASIDE = Pieces([(2, Translation([0, 2], [0, -1])), (None, Translation([8, -2], [0, -1]))])
"""Falls, to the right first and then to the left: above its first place at t = 4."""


def saw(base: int, tip: int, back: int) -> list[tuple[int, int]]:
    """Return a saw with its teeth at x = 0, 2, 4, ..., and the first tip as vertex 0."""
    edge = [p for k in range(TEETH) for p in ((2 * k, tip), (2 * k + 1, base))]
    return [*edge, (2 * TEETH, back), (-1, back)]


def saws(motion: Translation | Pieces) -> list[Body]:
    """Return two saws whose tips meet at t = 4, and small bodies around them."""
    stands = [(-9, -9), (-7, -9), (-8, 0)]
    falls = [(-8, 4), (-7, 6), (-9, 6)]
    return [
        Body("lower", saw(-1, 0, -5)),
        Body("stands", stands),
        Body("upper", saw(5, 4, 9), motion),
        Body("falls", falls, FALLS),
        Body("far", [(999, 999)]),
    ]


@pytest.mark.parametrize("motion", [FALLS, STEPS_ASIDE])
@pytest.mark.parametrize("others", [0, 20])
def test_first_contact_of_large_bodies_has_all_incidences_and_those_of_small_ones(
    motion: Translation | Pieces, others: int
) -> None:
    """All tips meet their opposites at t = 4, and a small body comes upon another one."""
    bodies = saws(motion) + [
        Body(f"other {k}", [(-99, 9 * k), (-98, 9 * k)]) for k in range(others)
    ]
    contact = first_contact(Scene(bodies, (0, 9)), method="pairs")
    assert contact is not None
    assert contact.time == 4
    tips = {("lower", 2 * k, "upper", 2 * k) for k in range(TEETH)}
    met = {(p.body, p.vertex, p.other, p.other_vertex) for p in contact.pairs}
    assert met == tips | {("stands", 2, "falls", 0)}


def test_first_within_of_large_bodies_is_exact() -> None:
    """Tips above tips are at the distance 1/3 at t = 4 - 1/3."""
    found = first_within(Scene(saws(FALLS), (0, 9)), distance=Fraction(1, 3))
    assert found is not None
    assert found.time == 4 - Fraction(1, 3)
    assert found.pairs == (("lower", "upper"), ("stands", "falls"))


def test_first_contact_of_rounded_large_bodies_is_exact() -> None:
    """Radii of 1/2 and 1/4 touch at t = 4 - 3/4, those of points first."""
    lower, _, upper, *_ = saws(FALLS)
    rounded = [
        Body("a", lower.vertices, radius="1/2"),
        Body("b", upper.vertices, FALLS, radius="1/4"),
    ]
    contact = first_contact(Scene([*rounded, Body("far", [(999, 999)])], (0, 9)), method="pairs")
    assert contact is not None
    assert contact.time == 4 - Fraction(3, 4)
    assert len(contact.pairs) == TEETH


def test_first_contacts_of_a_large_shape_among_large_obstacles_are_planned() -> None:
    """The shape falls from y = 4 upon the tips of the obstacle."""
    lower, _, upper, *_ = saws(FALLS)
    planner = Planner([lower, Body("far", [(999, 999), (998, 999)])], time=(0, 9))
    (contact, none) = planner.first_contacts(upper.vertices, [FALLS, Translation([0], [0, 1])])
    assert none is None
    assert contact is not None
    assert contact.time == 4
    assert len(contact.pairs) == TEETH


def test_first_contact_beside_a_large_body_compares_nothing_more() -> None:
    """A body of 200 vertices far away changes only what is read."""
    small = [
        Body(f"{k}", [(3 * k, 0), (3 * k + 1, 0), (3 * k, 1)], Translation([0], [0, k % 3]))
        for k in range(40)
    ]
    large = Body("large", [(-500 + k, 500 + k * k) for k in range(200)])
    looks = []
    for bodies in (small, [*small, large]):
        scene = Scene(bodies, (0, 9))
        with ending_at(None) as clock:
            assert first_contact(scene, method="pairs") is None
        looks.append(clock.looks)
    assert looks[1] <= looks[0] + 4


@pytest.mark.parametrize("exponent", [-1072, 0, 1016])
def test_first_contact_of_leaning_planks_at_the_ends_of_doubles_is_exact(exponent: int) -> None:
    """The boxes of 30 parallel planks overlap, so that rectangles along them are compared.

    A rectangle's direction cannot be normalised where it is subnormal, and the sizes of four
    vertices overflow at the other end. Edges 3 apart in x meet at speed 1 at t = 3.
    """
    unit = 2.0**exponent
    outline = [(0, 0), (1, 0), (101, 100), (100, 100)]
    planks = [
        Body(f"b{k}", [((4 * k + x) * unit, y * unit) for x, y in outline]) for k in range(30)
    ]
    planks[0] = planks[0].with_motion(Translation([0, unit]))

    contact = first_contact(Scene(planks, (0, 9)), method="pairs")

    assert contact is not None
    assert contact.time == 3
    assert {(pair.body, pair.other) for pair in contact.pairs} == {("b0", "b1")}
