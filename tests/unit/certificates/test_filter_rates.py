"""How many decisions the float filters leave to exact arithmetic, over whole runs.

Off degeneracy fewer than one in a hundred, whatever the motion, the kind of its numbers, and
the place, time and scale of the scene.
"""

import pytest

from exactpt.pairs.features_sweep import PairsSearch
from exactpt.simulation.simulation import Simulation
from fuzz.general import MOTIONS, NUMBERS, SETTINGS, lanes, random_scene


@pytest.fixture(autouse=True)
def with_filters(request):
    if request.config.getoption("--exact-only"):
        pytest.skip("is about what the filters leave open")


def share(scene, tiling):
    """The share of exact decisions in a whole run, and the reasons."""
    simulation = Simulation(scene, tiling=tiling)
    list(simulation.run())
    stats = simulation.stats
    decisions = stats["exact"] + stats["filtered"]
    assert decisions > 300
    return stats["exact"] / decisions, stats["reasons"]


@pytest.mark.long("wobbling-doubles-greedy")
@pytest.mark.parametrize("tiling", ["greedy", "lazy"])
@pytest.mark.parametrize("numbers", NUMBERS)
@pytest.mark.parametrize("motion", MOTIONS)
def test_few_decisions_are_exact(motion, numbers, tiling):
    exact, reasons = share(random_scene(motion, numbers, 0), tiling)

    assert exact < 0.005, reasons


def few_are_exact(motion, numbers, setting):
    scene = random_scene(motion, numbers, 2, setting=SETTINGS[setting], side=3)
    exact, reasons = share(scene, "lazy")
    assert exact < 0.01, reasons


@pytest.mark.parametrize("setting", SETTINGS)
@pytest.mark.parametrize("motion", MOTIONS)
def test_few_decisions_are_exact_anywhere(motion, setting):
    cell = list(MOTIONS).index(motion) + list(SETTINGS).index(setting)
    few_are_exact(motion, NUMBERS[cell % 3], setting)


@pytest.mark.slow
@pytest.mark.parametrize("numbers", NUMBERS)
@pytest.mark.parametrize("setting", SETTINGS)
@pytest.mark.parametrize("motion", MOTIONS)
def test_few_decisions_are_exact_anywhere_with_any_numbers(motion, setting, numbers):
    few_are_exact(motion, numbers, setting)


@pytest.mark.long("doubles-mixed", "ratios-mixed")
@pytest.mark.parametrize("tiling", ["greedy", "lazy", "mixed"])
@pytest.mark.parametrize("numbers", NUMBERS)
def test_few_decisions_are_exact_in_lanes(numbers, tiling):
    """Parallel velocities: the leading coefficient of three bodies' orientation is zero."""
    simulation = Simulation(lanes(numbers, 0, bodies=64), tiling=tiling)
    list(simulation.run())
    stats = simulation.stats
    certificates = sum(n for why, n in stats["reasons"].items() if why.startswith("certificate"))

    assert certificates < 0.005 * stats["certificates"], stats["reasons"]
    assert stats["exact"] < 0.005 * stats["filtered"], stats["reasons"]


@pytest.mark.parametrize("numbers", NUMBERS)
def test_few_decisions_are_exact_in_a_search_by_pairs(numbers):
    search = PairsSearch(random_scene("rolling", numbers, 0))
    search.run_to_contact()

    assert search.stats["filtered"] > 100
    assert search.stats["exact"] < 10
