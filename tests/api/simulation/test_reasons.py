"""The exact decisions by what was decided, and why floats did not do, by hand.

That each exact decision has a reason is the law `simulation/stops`.
"""

from fractions import Fraction
from random import Random

import pytest

from exactpt import Body, Scene, Simulation, Translation


@pytest.fixture
def with_filters(request):
    if request.config.getoption("--exact-only"):
        pytest.skip("is about what the filters leave open")


def reasons_of(scene, **options):
    simulation = Simulation(scene, **options)
    list(simulation.run())
    stats = simulation.stats
    assert sum(stats["reasons"].values()) == stats["exact"]
    return stats["reasons"], stats


def points(*placed):
    return [Body(f"p{i}", [at], Translation([0, v[0]], [0, v[1]])) for i, (at, v) in
            enumerate(placed)]  # fmt: skip


@pytest.mark.usefixtures("with_filters")
def test_points_on_a_line_are_zeros():
    """Three in a row for ever, at rest: nothing is merely close."""
    reasons, _ = reasons_of(Scene(points(((0, 0), (0, 0)), ((1, 1), (0, 0)), ((2, 2), (0, 0)))))

    assert {key for key in reasons if not key.endswith(": zero")} == set()
    assert reasons["sign: zero"] > 0


@pytest.mark.usefixtures("with_filters")
def test_points_that_nearly_meet_on_a_line_are_close():
    """One passes the line of two others by 2^-60 of their distance."""
    tiny = Fraction(1, 1 << 60)
    scene = Scene(points(((0, 0), (0, 0)), ((2, 2), (0, 0)), ((1, 1 + tiny), (0, 0))))
    reasons, _ = reasons_of(scene)

    assert sum(n for key, n in reasons.items() if key.endswith(": close")) > 0


@pytest.mark.usefixtures("with_filters")
def test_huge_numbers_are_out_of_range():
    """Two neighbours at a distance of 2^-300 of the scene's width."""
    far = 1 << 300
    apart = points(((0, 0), (1, 0)), ((far, 3), (0, 0)), ((-far, 1), (0, 0)))
    near = [Body("near", [(2, 9)]), Body("up", [(5, 7)], Translation([0], [0, 1]))]
    scene = Scene([*apart, *near], (0, 8))
    reasons, _ = reasons_of(scene)

    assert sum(n for key, n in reasons.items() if key.endswith(": range")) > 0


@pytest.mark.usefixtures("with_filters")
def test_segments_have_copies():
    rng = Random(1)
    bodies = []
    for i in range(4):
        x, y = 10 * i, rng.randint(0, 20)
        bodies.append(Body(f"s{i}", [(x, y), (x + 5, y + rng.randint(-3, 3))]))
    reasons, _ = reasons_of(Scene(bodies), tiling="lazy")

    assert sum(n for key, n in reasons.items() if key.endswith(": copies")) > 0
