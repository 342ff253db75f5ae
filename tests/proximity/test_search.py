"""The first approach of any two bodies: the least of all pairs, and few exact decisions."""

from itertools import combinations

import pytest

from exactpt import Body, Rigid, Scene, Translation
from exactpt.kernel.numbers import QQ
from exactpt.proximity.search import ApproachSearch
from exactpt.proximity.within import first_within
from exactpt.scene.generate import FAMILIES, generate


def search(scene, d):
    return ApproachSearch(scene, lambda i, j: d * d, [d / 2] * len(scene.bodies)).run()  # noqa: ARG005


def by_pairs(scene, d):
    """The least of all pairs."""
    found = []
    for (i, a), (j, b) in combinations(enumerate(scene.bodies), 2):
        time = first_within(scene, a.name, b.name, d, norm="euclidean")
        if time is not None:
            found.append((time, (i, j)))
    if not found:
        return None
    least = min(time for time, _ in found)
    return least, tuple(sorted(ij for time, ij in found if time == least))


def small(family, seed):
    scene = generate(family, seed)
    bodies = [body for body in scene.bodies if body.size <= 5][:3]
    return Scene(bodies, (scene.start, scene.end)) if len(bodies) > 1 else None


@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_the_least_of_all_pairs(family):
    scene = small(family, 0)
    if scene is not None:
        extent = max(abs(c) for body in scene.bodies for p in body.at(scene.start) for c in p)
        assert search(scene, QQ(extent) / 30) == by_pairs(scene, QQ(extent) / 30)


def test_pairs_with_limits_of_their_own():
    bodies = [Body(f"p{i}", [(10 * i, 0)], Translation([0, -i])) for i in range(3)]
    radius = [1, 2, 3]

    found = ApproachSearch(
        Scene(bodies, (0, 20)), lambda i, j: QQ(radius[i] + radius[j]) ** 2, list(map(QQ, radius))
    ).run()

    assert found == (QQ(5), ((1, 2),)) if found.time == 5 else found.time == 7


def test_a_turning_body():
    mill = Body("mill", [(0, -5), (1, -5), (1, 5), (0, 5)], Rigid([0, -1], pivot=(0, 0)))
    points = [Body(f"p{i}", [(6, i)]) for i in range(-2, 3)]
    scene = Scene([mill, *points], (0, 2))

    assert search(scene, QQ(1)) == by_pairs(scene, QQ(1))
