"""The first approach of any two bodies: the least of all pairs, and few exact decisions."""

from fractions import Fraction
from itertools import combinations
from random import Random

import pytest

from benchmarks.shapes import crowd
from exactpt import Approach, Body, InputError, Rigid, Scene, Translation, first_within
from exactpt.kernel.numbers import QQ
from exactpt.pair.features import FeaturePair
from exactpt.search.reading import rows_of
from exactpt.search.sweep_search import AllPairs, Slabs, Sweep
from exactpt.testing import reference
from exactpt.testing.scenes import FAMILIES, generate
from fuzz.questions.tiny import touching_scene


def search(scene, d):
    """The time and the pairs of the first approach; None if there is none."""
    found = first_within(scene, distance=d)
    if found is None:
        return None
    numbers = {body.name: k for k, body in enumerate(scene.bodies)}
    pairs = (tuple(sorted((numbers[a], numbers[b]))) for a, b in found.pairs)
    return found.time, tuple(sorted(pairs))


def sweep_of(scene, d):
    """A sweep for approaches within a distance after the start."""
    rows = rows_of(scene.bodies, scene.exact_start, scene.exact_end, d / 2)
    return Sweep(rows, Slabs(rows, AllPairs(rows, with_themselves=False)), lambda *_: d * d)


def by_pairs(scene, d):
    """The least of all pairs."""
    found = []
    for (i, a), (j, b) in combinations(enumerate(scene.bodies), 2):
        time = first_within(scene, a.name, b.name, d)
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


def test_pairs_with_radii_of_their_own():
    """p1 and p2 are 10 - t apart, and within 2 + 3 at t = 5; p0 and p1 within 1 + 2 at t = 7."""
    bodies = [Body(f"p{i}", [(10 * i, 0)], Translation([0, -i]), radius=i + 1) for i in range(3)]

    assert search(Scene(bodies, (0, 20)), QQ(0)) == (QQ(5), ((1, 2),))


def test_a_turning_body():
    mill = Body("mill", [(0, -5), (1, -5), (1, 5), (0, 5)], Rigid([0, -1], pivot=(0, 0)))
    points = [Body(f"p{i}", [(6, i)]) for i in range(-2, 3)]
    scene = Scene([mill, *points], (0, 2))

    assert search(scene, QQ(1)) == by_pairs(scene, QQ(1))


def defined(scene, squared):
    """The first approach of any two bodies, from the definition."""
    found = []
    for a, b in combinations(scene.bodies, 2):
        time = reference.first_within(a, b, scene.time, squared)
        if time is not None:
            found.append((time, (a.name, b.name)))
    least = min((time for time, _ in found), default=None)
    return least and Approach(least, tuple(sorted(ab for time, ab in found if time == least)))


@pytest.mark.long
@pytest.mark.parametrize(
    "count", [60, pytest.param(3_000, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_all_bodies_against_the_definition(count):
    random, seen = Random(f"approach {count}"), set()
    for _ in range(count):
        scene = touching_scene(random)
        squared = QQ(random.choice([0, 0, 1, 2]), random.choice([1, 4, 9]))
        found = first_within(scene, distance_squared=squared)
        assert found == defined(scene, squared)
        seen.add(found and (found.time == scene.start, len(found.pairs) > 1))
    assert {(True, True), (True, False), (False, False)} <= seen


@pytest.mark.parametrize("seed", range(3))
def test_first_approach_is_the_least_of_all_pairs(seed):
    scene = crowd(6, Random(seed), radius=300, end=4)
    found = first_within(scene, distance=100)

    every = [
        (first_within(scene, a.name, b.name, 100), (a.name, b.name))
        for a, b in combinations(scene.bodies, 2)
    ]
    least = min((time for time, _ in every if time is not None), default=None)
    nearest = tuple(sorted(ab for time, ab in every if time == least))
    assert found == (None if least is None else Approach(least, nearest))


@pytest.mark.parametrize("seed", [1, 4])
def test_first_approach_of_three_pairs_at_once_beside_a_crowd(seed):
    """Three pairs, 40 apart at 300 a unit of time, are 10 apart at t = 30 / 300."""
    scene = crowd(40, Random(seed), radius=100, end=4)
    far = [Body(f"far{i}", [(9000 + 50 * i, y)]) for i in range(3) for y in (0,)]
    close = [Body(f"near{i}", [(9000 + 50 * i, 40)], Translation([0], [0, -300])) for i in range(3)]
    both = Scene([*scene.bodies, *far, *close], (0, 4))

    found = first_within(both, distance=10)

    assert found.time == QQ(1, 10)
    assert found.pairs == (("far0", "near0"), ("far1", "near1"), ("far2", "near2"))
    alone = first_within(scene, distance=10)
    assert (alone.time, alone.pairs) == named(scene, search(scene, QQ(10)))


def named(scene, found):
    return found[0], tuple((scene.bodies[i].name, scene.bodies[j].name) for i, j in found[1])


@pytest.mark.parametrize(
    "options, words",
    [
        ({}, "either a distance or its square"),
        ({"distance": 2, "distance_squared": 4}, "either a distance or its square"),
        ({"distance": -1}, "a distance is not negative: -1"),
        ({"a": "p", "distance": 1}, "two names of bodies are given, or none for all bodies"),
    ],
)
def test_wrong_questions(options, words):
    scene = Scene([Body("p", [(0, 0)]), Body("q", [(5, 0)])])
    with pytest.raises(InputError, match=words):
        first_within(scene, **options)


@pytest.mark.parametrize("d", ["1e-400", "1e-30", "1e30", "1e400"])
def test_distances_beyond_the_range_of_doubles(d):
    """Few bodies and many: the searches with boxes are asked with all of them."""
    for count in (2, 14):
        bodies = [Body(f"p{i:2}", [(10 * i, 10 * i)], Translation([0, -i])) for i in range(count)]
        scene = Scene(bodies, (0, 20))
        found = first_within(scene, distance=d)

        every = {
            (a.name, b.name): first_within(scene, a.name, b.name, d)
            for a, b in combinations(bodies, 2)
        }
        least = min((time for time in every.values() if time is not None), default=None)
        pairs = tuple(sorted(ab for ab, time in every.items() if time == least))
        assert found == (None if least is None else Approach(least, pairs))


def test_bodies_that_hover_are_decided_exactly_in_few_windows():
    """Without a limit, all windows would be halved to the end: 130,000 of them."""
    hub = Body("hub", [(0, 0), (1, 0), (1, 1), (0, 1)])
    arms = [Body(f"a{i}", [(2 + i, 0), (2 + i, 2)], Rigid([0, 1], pivot=(0, 0))) for i in range(4)]
    scene = Scene([hub, *arms], (-2, 2))

    sweep = sweep_of(scene, QQ(1, 2))

    assert sweep.first_after_start() is None
    assert sweep.compared < 2000
    assert sweep.exact < 10


def test_bodies_that_stay_apart():
    scene = Scene([Body("p", [(0, 0)]), Body("q", [(5, 0)])])
    assert first_within(scene, distance=4) is None
    assert first_within(Scene([]), distance=4) is None


def test_numbers_out_of_range_are_not_bisected():
    """Distances that filters hardly know are decided exactly, once for each slab."""
    tiny = Fraction(1, 10**400)
    unknown = [
        Body(str(i), [(3 * i, 0)], Translation([0, tiny], [0, tiny * i, 1])) for i in range(12)
    ]
    sweep = sweep_of(Scene(unknown, (0, 5)), QQ(2))
    assert sweep.first_after_start() is None
    assert sweep.exact <= 4

    near = []
    for i in range(8):
        near.append(Body(f"post {i}", [(10 * i, 0)]))
        turn = Rigid([0, 1], pivot=(10 * i, 0))
        near.append(Body(f"orbiter {i}", [(10 * i + 2 + tiny, 0)], turn))
    sweep = sweep_of(Scene(near, (0, 2)), QQ(2))
    assert sweep.first_after_start() is None
    assert sweep.exact <= 300


def test_two_bodies_of_many_vertices_need_few_exact_decisions(monkeypatch):
    decided = []
    first_time = FeaturePair.first_time
    monkeypatch.setattr(
        FeaturePair,
        "first_time",
        lambda self, *given: decided.append(1) or first_time(self, *given),
    )
    ring = [(k * k, 4 * k) for k in range(-20, 21)]
    ball = [(x * 5 + 1, y) for x, y in [(k, k * k) for k in range(-20, 21)]]
    scene = Scene(
        [Body("a", ball, Translation([0, 30])), Body("b", ring, Translation([900]))], (0, 90)
    )

    assert first_within(scene, "a", "b", "1/3") is not None
    assert 1 <= len(decided) <= 12
    with pytest.raises(InputError, match="square of a rational"):
        first_within(
            Scene([Body("p", [(0, 0)], radius=1), Body("q", [(9, 9)])]),
            "p", "q", distance_squared=2,
        )  # fmt: skip
