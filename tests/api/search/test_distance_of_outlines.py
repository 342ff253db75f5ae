"""Distances of outlines of many vertices, whose nearest features are known by construction."""

from fractions import Fraction

import pytest

from exactpt import Body, Rigid, Scene, Translation, clearance, distance

TEETH = 250
"""Number of teeth of a saw; it has twice as many vertices, and two for its back."""


def saw(base: Fraction, tip: Fraction, back: Fraction) -> list[tuple[Fraction, Fraction]]:
    """Return a saw with its teeth at x = 0, 2, 4, ..., and the first tip as vertex 0."""
    edge = [
        point
        for tooth in range(TEETH)
        for point in ((Fraction(2 * tooth), tip), (Fraction(2 * tooth + 1), base))
    ]
    return [*edge, (Fraction(2 * TEETH), back), (Fraction(-1), back)]


def vertex(number: int) -> tuple[int, None]:
    """Return a feature: a vertex and no edge."""
    return number, None


@pytest.mark.parametrize("gap", [Fraction(3), Fraction(1, 7), Fraction(1, 10**20)])
def test_distance_of_facing_saws_has_all_pairs_of_tips(gap: Fraction) -> None:
    """Tips are opposite each other; a tip is farther from all that is beside its own opposite."""
    lower = Body("lower", saw(Fraction(-1), Fraction(0), Fraction(-5)))
    upper = Body("upper", saw(gap + 1, gap, gap + 5))
    found = distance(Scene([lower, upper], time=(0, 1)), "lower", "upper", at=0)
    assert found.squared == gap**2
    assert found.features == tuple((vertex(2 * k), vertex(2 * k)) for k in range(TEETH))


@pytest.mark.parametrize("far", [Fraction(0), Fraction(10**20, 3)])
def test_distance_of_a_saw_that_sinks_to_a_wall_is_that_of_all_tips(far: Fraction) -> None:
    """A tip at (x, far + 4 - t) is above the edge y = far of the wall, between its ends."""
    above = Body("saw", saw(far + 5, far + 4, far + 9), Translation([0], [0, -1]))
    wall = [(x, far + y) for x, y in ((-7, -2), (2 * TEETH + 7, -2), (2 * TEETH + 7, 0), (-7, 0))]
    scene = Scene([above, Body("wall", wall)], time=(0, 3))
    found = distance(scene, "saw", "wall", at=Fraction(7, 3))
    assert found.squared == Fraction(5, 3) ** 2
    edge = None, 2
    assert found.features == tuple((vertex(2 * k), edge) for k in range(TEETH))


def test_distance_of_a_point_from_a_long_chain_is_that_of_one_vertex() -> None:
    """The chain climbs by steps (1, 1): the foot of the perpendicular is its vertex (301, 301)."""
    chain = Body("chain", [(k, k) for k in range(601)], closed=False)
    point = Body("point", [(300, 302)])
    found = distance(Scene([point, chain], time=(0, 1)), "point", "chain", at=0)
    assert found.squared == 2
    assert found.features == ((vertex(0), vertex(301)),)


def test_distance_of_interlocked_saws_that_cross_is_0_without_features() -> None:
    """The flank y = -x of the lower saw crosses that of the upper one, y = x - 2/3, at x = 1/3."""
    lower = Body("lower", saw(Fraction(-1), Fraction(0), Fraction(-5)))
    upper = Body("upper", saw(Fraction(1, 3), Fraction(-2, 3), Fraction(5)))
    found = distance(Scene([lower, upper], time=(0, 1)), "lower", "upper", at=0)
    assert (found.squared, found.features) == (0, ())


@pytest.mark.parametrize("unit", [Fraction(1), Fraction(2) ** 300, Fraction(1, 2**300)])
def test_distance_in_a_hole_has_all_sides_that_are_equally_near(unit: Fraction) -> None:
    """A square of half-width 2 in a hole of half-width 3 is 1 from each side, at all corners."""

    def square(half: int) -> list[tuple[Fraction, Fraction]]:
        return [(x * half * unit, y * half * unit) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]

    frame = Body("frame", square(5), holes=[square(3)[::-1]])
    inner = Body("inner", square(2))
    found = distance(Scene([frame, inner], time=(0, 1)), "frame", "inner", at=0)
    assert found.squared == unit**2
    edges = [4, 5, 6, 7]  # of the hole, from (-3, 3) on: its right side is edge 5
    assert [(one.edge, two.vertex) for one, two in found.features] == [
        (edge, corner) for edge, corners in zip(edges, SIDES, strict=True) for corner in corners
    ]


SIDES = [(2, 3), (1, 2), (0, 1), (0, 3)]
"""The corners of a square at its upper, right, lower and left side."""


def test_distance_of_a_body_inside_another_is_0_without_features() -> None:
    outer = Body("outer", [(0, 0), (9, 0), (9, 9), (0, 9)])
    inner = Body("inner", saw_of(4, Fraction(1, 200)))
    found = distance(Scene([outer, inner], time=(0, 1)), "outer", "inner", at=0)
    assert (found.squared, found.features) == (0, ())


def saw_of(corner: int, unit: Fraction) -> list[tuple[Fraction, Fraction]]:
    """Return a small saw beside a corner (corner, corner)."""
    points = saw(Fraction(-1), Fraction(0), Fraction(-5))
    return [(corner + x * unit, corner + y * unit) for x, y in points]


def test_distance_of_a_turned_square_is_that_of_its_corner() -> None:
    """At t = 1/3 the square has turned by the angle with the cosine 4/5 and the sine 3/5.

    Its corner (5, 5) is at (4 - 3, 3 + 4) = (1, 7), the highest one: 3 below (1, 10).
    """
    square = [(-5, -5), (5, -5), (5, 5), (-5, 5)]
    scene = Scene(
        [
            Body("square", square, Rigid([0, 1])),
            Body("bar", [(-9, 10), (9, 10), (9, 11), (-9, 11)]),
        ],
        time=(0, 1),
    )
    found = distance(scene, "square", "bar", at=Fraction(1, 3))
    assert found.squared == 9
    assert found.features == ((vertex(2), (None, 0)),)


def test_nearest_of_many_bodies_is_the_first_of_equally_near_ones() -> None:
    """Discs of radius 1 around (3, 4) and (-5, 0), and a point at (0, 4), are 4 from the origin."""
    others = [Body(f"far {k}", [(20 + k, 0), (20 + k, 1)]) for k in range(6)]
    ties = [
        Body("disc", [(3, 4)], radius=1),
        Body("point", [(0, 4)]),
        Body("other disc", [(-5, 0)], radius=1),
    ]
    scene = Scene([*others, Body("origin", [(0, 0)]), *ties], time=(0, 1))
    name, found = clearance(scene, "origin").nearest(0)
    assert name == "disc"
    assert (found.core_squared, found.radius, found.squared) == (25, 1, 16)
