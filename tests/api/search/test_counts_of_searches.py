"""A search compares few of all pairs exactly: the counts that `exactpt collide --stats` reports."""

import json
import math
from random import Random

import pytest
from commands import run

from exactpt import Body, Scene, Translation


@pytest.fixture
def stats(tmp_path):
    """Return the counts of a search in a scene, and its contact, as JSON."""

    def ask(scene):
        path = tmp_path / "scene.json"
        scene.save(path)
        answer = json.loads(run("collide", path, "--json", "--stats", "--method", "pairs").stdout)
        return answer["stats"], answer["contact"]

    return ask


def plank(k, angle, spread, rng):
    """A triangle 1000 long and a tenth wide, beside others, that drifts slowly."""
    x, y = -1.5 * k * math.sin(angle), 1.5 * k * math.cos(angle)
    turn = angle + rng.uniform(-spread, spread)
    end = x + 1000 * math.cos(turn), y + 1000 * math.sin(turn)
    tip = end[0] - 0.1 * math.sin(turn), end[1] + 0.1 * math.cos(turn)
    drift = Translation([0, rng.uniform(-0.1, 0.1)], [0, rng.uniform(-0.1, 0.1)])
    return Body(f"p{k}", [(x, y), end, tip], drift)


@pytest.mark.parametrize("degrees, spread", [(45, 0), (20, 0), (70, 0.01)])
def test_long_thin_bodies_side_by_side_are_compared_with_few_others(stats, degrees, spread):
    """Boxes along the axes of 1,770 pairs overlap; those along the planks separate nearly all."""
    rng = Random(degrees)
    turns = math.radians(degrees), math.radians(spread)
    scene = Scene([plank(k, *turns, rng) for k in range(60)], time=(0, 3))

    counts, contact = stats(scene)

    assert contact is None
    assert counts["certificates"] <= 60


def test_crowd_of_discs_needs_few_exact_decisions(stats):
    """Of 400 discs near each other, doubles leave out all pairs but those that touch first."""
    rng = Random(3)
    bodies = [
        Body(
            str(k),
            [(5.0 * (k % 20) + rng.random(), 5.0 * (k // 20) + rng.random())],
            Translation([0.0, rng.uniform(-1, 1)], [0.0, rng.uniform(-1, 1)]),
            radius=1.0,
        )
        for k in range(400)
    ]

    counts, contact = stats(Scene(bodies, (0, 20)))

    assert contact["kind"] == "vertex-vertex"
    assert 1 <= counts["exact"] <= 10
