"""Which boxes meet, against all pairs: many on one line, nested, long, without end."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from exactpt.geometry import boxes as boxes_module
from exactpt.geometry.boxes import crossing_pairs, overlapping_pairs

sides = st.tuples(st.integers(-9, 9), st.integers(0, 18)).map(lambda s: (s[0], s[0] + s[1]))
without_end = st.just((-np.inf, np.inf))
box = st.tuples(sides | without_end, sides | without_end).map(lambda b: (*b[0], *b[1]))


def pairs_of(boxes):
    return [
        (int(i), int(j))
        for first, second in overlapping_pairs(np.array(boxes, dtype=float).reshape(-1, 4))
        for i, j in zip(first, second, strict=True)
    ]


def all_pairs(boxes):
    return {
        (i, j)
        for j, b in enumerate(boxes)
        for i, a in enumerate(boxes[:j])
        if a[0] <= b[1] and b[0] <= a[1] and a[2] <= b[3] and b[2] <= a[3]
    }


@pytest.mark.parametrize("few", [0, 64])
@given(st.lists(box, max_size=40))
def test_every_pair_that_meets_is_told_once(few, boxes):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(boxes_module, "_FEW", few)
        found = pairs_of(boxes)

    assert len(found) == len(set(found))
    assert set(found) == all_pairs(boxes)


@pytest.mark.parametrize("many", [0, 1 << 16])
@given(some=st.lists(box, max_size=20), others=st.lists(box, max_size=20))
def test_pairs_of_boxes_of_two_kinds(many, some, others):
    arrays = [np.array(boxes, dtype=float).reshape(-1, 4) for boxes in (some, others)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(boxes_module, "_ALL", many - 1)
        found = [
            (int(i), int(j))
            for first, second in crossing_pairs(*arrays)
            for i, j in zip(first, second, strict=True)
        ]

    n = len(some)
    expected = {(i, j - n) for i, j in all_pairs(some + others) if i < n <= j}
    assert sorted(found) == sorted(expected)


@given(st.lists(box, min_size=2, max_size=40))
def test_chunks_are_of_no_matter(boxes):
    whole = sorted(pairs_of(boxes))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(boxes_module, "_FEW", 0)
        patch.setattr(boxes_module, "_CHUNK", 3)
        assert sorted(pairs_of(boxes)) == whole


@pytest.mark.parametrize("axis", [0, 1])
def test_long_boxes_side_by_side_are_not_tried_in_pairs(axis, monkeypatch):
    """A thousand lanes: along them all boxes meet, across them none does."""
    lanes = np.zeros((1000, 4))
    lanes[:, 2 * axis], lanes[:, 2 * axis + 1] = 0, 1000
    lanes[:, 2 - 2 * axis] = 10 * np.arange(1000)
    lanes[:, 3 - 2 * axis] = lanes[:, 2 - 2 * axis] + 9
    tried = []
    spread = boxes_module._spread

    def counted(items, start, stop):
        items, numbers = spread(items, start, stop)
        tried.append(len(items))
        return items, numbers

    monkeypatch.setattr(boxes_module, "_spread", counted)

    assert pairs_of(lanes) == []
    assert sum(tried) < 40_000
