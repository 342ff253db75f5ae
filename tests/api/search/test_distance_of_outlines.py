"""Distances of outlines of many vertices, whose nearest features are known by construction."""

from fractions import Fraction

import pytest

from exactpt import Body, Scene, Translation, distance

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
