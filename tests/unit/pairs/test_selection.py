"""The record of the pairs that count, against its definition."""

from itertools import combinations, product
from random import Random

import numpy as np
import pytest

from exactpt import Body, InputError, Scene
from exactpt.pairs.selection import Selection


def scene_of(count, groups=()):
    return Scene([Body(f"b{k}", [(k, 0)]) for k in range(count)], ignoring=groups)


def random_groups(random, count):
    numbers = range(count)
    return [random.sample(numbers, random.randint(2, count)) for _ in range(random.randint(0, 5))]


@pytest.mark.parametrize("seed", range(40))
def test_selection_of_random_groups_is_as_the_definition(seed):
    random = Random(seed)
    count = random.randint(3, 12)
    groups = random_groups(random, count)
    names = [[f"b{i}" for i in group] for group in groups]
    split = random.randint(0, len(groups))
    selection = Selection(scene_of(count, names[:split]), ignoring=names[split:])

    def is_ignored(i, j):
        return i != j and any(i in group and j in group for group in groups)

    pairs = list(product(range(count), repeat=2))
    first, second = np.array(pairs).T
    assert [selection.ignores(i, j) for i, j in pairs] == [is_ignored(i, j) for i, j in pairs]
    assert [selection.counts(i, j) for i, j in pairs] == [not is_ignored(i, j) for i, j in pairs]
    assert selection.ignored(first, second).tolist() == [is_ignored(i, j) for i, j in pairs]
    assert selection.is_all == (not groups)

    some = sorted(random.sample(range(count), random.randint(1, count)))
    part = selection.of_bodies(some)
    for a, b in product(range(len(some)), repeat=2):
        assert part.ignores(a, b) == is_ignored(some[a], some[b])

    disjoint = selection.disjoint_groups()
    different = {frozenset(group) for group in groups}
    largest = [group for group in different if not any(group < other for other in different)]
    overlap = any(one & other for one, other in combinations(largest, 2))
    assert (disjoint is None) == overlap
    if disjoint is not None:
        assert {frozenset(group) for group in disjoint} == set(largest)


def test_selection_of_no_pair_of_arrays_is_empty():
    selection = Selection(scene_of(3), ignoring=[("b0", "b1")])
    none = np.empty(0, dtype=np.int64)
    assert selection.ignored(none, none).tolist() == []


def test_selection_of_named_pairs_has_no_body_with_itself():
    selection = Selection(scene_of(4, [("b0", "b1")]), between=[("b3", "b1"), ("b1", "b3")])

    assert selection.named == [(1, 3)]
    assert [pair for pair in product(range(4), repeat=2) if selection.counts(*pair)] == [
        (1, 3), (3, 1)
    ]  # fmt: skip
    assert selection.of_bodies([1, 3]).named == [(0, 1)]
    assert selection.of_bodies([1, 2]).named == []


def test_selection_among_other_bodies_has_names_without_patterns():
    scene = scene_of(4, [("b*",)])
    assert Selection(scene).among(scene.bodies[:2]) == {
        "between": None, "ignoring": [{"b0", "b1"}]
    }  # fmt: skip
    assert Selection(scene).among(scene.bodies[:1]) == {"between": None, "ignoring": []}


@pytest.mark.parametrize("groups", [[], [("b0", "b1")]])
def test_selection_that_names_an_ignored_pair_is_refused(groups):
    scene = scene_of(3, groups)
    more = [] if groups else [("b*",)]
    where = "in this scene" if groups else "by ignoring="
    message = f"^between: bodies 'b0' and 'b1' ignore each other {where}; leave this pair out$"
    with pytest.raises(InputError, match=message):
        Selection(scene, between=[("b1", "b0")], ignoring=more)
