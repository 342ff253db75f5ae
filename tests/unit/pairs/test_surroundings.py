"""One body against all others, and questions about some of all pairs."""

from itertools import combinations, pairwise
from random import Random

import pytest

from exactpt import (
    Body,
    InputError,
    PosePath,
    Scene,
    Translation,
    clearance,
    contact_intervals,
    contacts,
    distance,
    first_within,
)
from exactpt.kernel import algebraic_value
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.pairs import clearance as clearance_module
from fuzz.questions.scenes import crowded_scene

SEEDS = range(12)


def crowd(seed):
    """Three tiny bodies or more, with ties; some meet."""
    random = Random(f"surroundings {seed}")
    while len((scene := crowded_scene(random)).bodies) < 3:
        pass
    return scene


def room():
    """A point that flies by a box, with far bodies, one of which moves towards it."""
    ball = Body("ball", [(-9, 3)], Translation([0, 1]))
    box = Body("box", [(0, 0), (2, 0), (2, 2), (0, 2)])
    far = Body("far", [(0, 99), (1, 99), (1, 100)], Translation([0], [0, -1]))
    posts = [Body(f"post {k}", [(k, -50)]) for k in range(3)]
    return Scene([ball, box, far, *posts], time=(0, 20))


@pytest.mark.long("0", "8")
@pytest.mark.parametrize("seed", SEEDS)
def test_minimum_is_the_least_of_all_pairs(seed):
    scene = crowd(seed)
    name, *others = (body.name for body in scene.bodies)
    alone = [(clearance(scene, name, other).minimum, other) for other in others]
    least = min(minimum.squared for minimum, _ in alone)
    time = min(minimum.time for minimum, _ in alone if minimum.squared == least)
    first = next(other for m, other in alone if (m.squared, m.time) == (least, time))

    found = clearance(scene, name).minimum

    assert (found.body, found.time, found.squared) == (first, time, least)


@pytest.mark.parametrize("seed", SEEDS)
def test_below_agrees_with_distances_at_single_times(seed):
    scene = crowd(seed)
    name, *others = (body.name for body in scene.bodies)
    found = clearance(scene, name).below(2)
    span = scene.end - scene.start
    times = [scene.start + span * k / 16 for k in range(17)]

    for other in others:
        of_pair = [i for i in found if i.b == other]
        for t in times:
            inside = any(i.start <= t <= i.end for i in of_pair)
            assert inside == (float(distance(scene, name, other, t)) <= 2)
        first = first_within(scene, name, other, 2)
        assert (of_pair[0].start if of_pair else None) == first
        for interval in of_pair:
            assert (interval.pieces[0].start, interval.pieces[-1].end) == interval[2:4]
            assert all(p.end == q.start for p, q in pairwise(interval.pieces))
    assert [i.start for i in found] == sorted(i.start for i in found)


def test_below_a_distance_reached_at_one_time_is_one_time():
    point = Body("point", [(-5, 1)], Translation([0, 1]))
    scene = Scene([point, Body("origin", [(0, 0)])], time=(0, 10))

    (touch,) = clearance(scene, "point", "origin").below(1)

    assert (touch.start, touch.end) == (AlgebraicNumber(5), AlgebraicNumber(5))
    assert clearance(scene, "point", "origin").below("0.999") == ()
    assert clearance(scene, "point").below("0.999") == ()


def test_below_zero_are_the_contacts():
    ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]), radius="1/4")
    scene = Scene([ball, Body("wall", [(9, -5), (9, 5)])], time=(0, 10))
    (expected,) = contact_intervals(scene, "ball", "wall")

    (found,) = clearance(scene, "ball").below(0)

    assert (found.start, found.end) == (expected.start, expected.end)


def test_far_bodies_are_not_computed():
    around = clearance(room(), "ball")

    assert around.minimum.body == "box"
    assert [i.b for i in around.below(1)] == ["box"]
    assert list(around._found) == ["box"]
    assert around.nearest(0)[0] == "box"
    assert around(10) == 1.0
    assert around.others == ("box", "far", "post 0", "post 1", "post 2")
    assert repr(around) == "<Surroundings of 'ball': 5 other bodies>"


def test_bug_of_equal_distances_the_minimum_was_not_the_earliest():
    """The later one is first in the scene; both touch, or both pass at a distance of 1."""
    for height in (0, 1):
        ball = Body("ball", [(0, height)], Translation([0, 1]))
        posts = [Body(f"post {x}", [(x, 0)]) for x in (9, 5, 7)]
        found = clearance(Scene([ball, *posts], time=(0, 10)), "ball").minimum
        assert (found.body, found.time, found.squared) == ("post 5", 5, height)


def test_bug_values_at_irrational_times_were_computed_that_are_not_needed(monkeypatch):
    """Each took seconds where a body follows a path of poses: bounds compare nearly all of them."""
    path = PosePath([0, 1], [([0, 3], [0, 0, 1], [0, 1])], error="1/9")
    arm = Body("arm", [(-1, 0), (1, 0)], path)
    computed = []
    original = algebraic_value.quotient_at
    for module in (algebraic_value, clearance_module):
        monkeypatch.setattr(
            module, "quotient_at", lambda *given: computed.append(given) or original(*given)
        )
    gap = clearance(Scene([arm, Body("post", [(3, -2)])], time=(0, 1)), "arm", "post")

    assert len(gap.pieces) > 2
    assert len(gap.below(3)) == 1
    assert not computed
    assert 2 < float(gap.minimum) < 3
    assert len(computed) == 1


def test_unusable_names_and_distances_are_refused():
    scene = room()
    with pytest.raises(InputError, match="nobody"):
        clearance(scene, "nobody")
    with pytest.raises(InputError, match="no body but 'ball'"):
        clearance(Scene(scene.bodies[:1], time=(0, 1)), "ball")
    with pytest.raises(InputError, match="at least 0, got -1"):
        clearance(scene, "ball").below(-1)
    with pytest.raises(InputError, match="at least 0, got -1"):
        clearance(scene, "ball", "box").below(-1)


# Some of all pairs


@pytest.mark.parametrize("seed", SEEDS)
def test_contacts_of_some_pairs(seed):
    scene = crowd(seed)
    names = [body.name for body in scene.bodies]
    every = contacts(scene)
    between, group = [(names[1], names[0]), (names[0], names[2])], names[:2]

    assert contacts(scene, between=between) == [
        i for i in every if {i.a, i.b} in [set(pair) for pair in between]
    ]
    assert contacts(scene, ignoring=[group]) == [i for i in every if {i.a, i.b} != set(group)]
    assert contacts(scene, between=between[1:], ignoring=[group]) == [
        i for i in every if {i.a, i.b} == {names[0], names[2]}
    ]
    with pytest.raises(InputError, match=r"ignore each other by ignoring=; leave this pair out$"):
        contacts(scene, between=between, ignoring=[group])


@pytest.mark.parametrize("seed", range(24))
def test_first_within_of_some_pairs(seed):
    scene = crowd(seed)
    names = [body.name for body in scene.bodies]
    group = names[:2]
    pairs = [pair for pair in combinations(names, 2) if set(pair) != set(group)]
    alone = [(first_within(scene, *pair, 1), pair) for pair in pairs]
    times = [time for time, _ in alone if time is not None]

    found = first_within(scene, distance=1, ignoring=[group])

    assert found == first_within(scene, distance=1, between=pairs)
    if not times:
        assert found is None
    else:
        assert found.time == min(times)
        assert found.pairs == tuple(sorted(pair for time, pair in alone if time == min(times)))


def test_a_pair_with_a_selection_is_refused():
    scene = room()
    for selection in ({"between": [("ball", "box")]}, {"ignoring": [("ball", "far")]}):
        with pytest.raises(InputError, match="not supported for two named bodies"):
            first_within(scene, "ball", "box", 1, **selection)
    with pytest.raises(InputError, match="there is no body 'nobody'"):
        contacts(scene, between=[("ball", "nobody")])


def test_bug_whether_a_squared_distance_of_rounded_bodies_was_refused_depended_on_boxes():
    far = [Body(f"b{i}", [(50 * i, 0)], radius=1 if i == 5 else 0) for i in range(6)]
    with pytest.raises(InputError, match="it must be the square of a rational"):
        first_within(Scene(far, time=(0, 1)), distance_squared=2)


def test_bug_a_distance_beyond_the_range_of_doubles_had_no_minimum():
    far = 10**400
    points = [Body(f"p{i}", [(i * far, 0)], Translation([0, i])) for i in range(1, 7)]
    around = clearance(Scene([Body("a", [(0, 0)]), *points], time=(0, 1)), "a")
    assert (around.minimum.body, around.minimum.squared) == ("p1", far**2)
