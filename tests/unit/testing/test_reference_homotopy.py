"""The definition of the class of a walk: which anchors it crosses, in order and undone, by hand."""

from exactpt.testing.reference import homotopy
from exactpt.testing.reference.space import OpenChain

CHAIN = OpenChain([(0, 0), (4, 0), (4, -3)])


def test_bug_path_along_a_chain_is_told_by_what_it_does_not_touch():
    """The crossing word said that it had left the class of the walk (chains:0, chains:1)."""
    bodies = {"chain": CHAIN, "point": [(9, 1)]}
    inner = {name: homotopy.inner_point(points, None) for name, points in bodies.items()}
    walk = [(-1, -2), (-1, 1), (5, 1), (5, -2)]
    over, under = [walk[0], (0, 0), (4, 0), walk[-1]], [walk[0], (4, -3), walk[-1]]

    anchors = homotopy.anchors_beside(over, bodies, inner)

    assert anchors == {"chain": (4, -3), "point": (9, 1)}
    word = homotopy.crossing_word(walk, anchors)
    assert word == homotopy.crossing_word(over, anchors) == [("chain", 1)]
    anchors = homotopy.anchors_beside(under, bodies, inner)
    assert homotopy.crossing_word(under, anchors) == []


def test_bug_way_back_over_two_anchors_in_one_column_undoes_the_way_there():
    """It was in the same order as the way there (chains_on_grid:1)."""
    anchors = {"a": (1, 4), "b": (1, 2), "c": (1, 9)}

    assert homotopy.crossing_word([(0, 5), (2, 6)], anchors) == [("a", 1), ("b", 1)]
    assert homotopy.crossing_word([(0, 5), (2, 6), (2, 5), (0, 6)], anchors) == []
    assert homotopy.crossing_word([(0, 5), (1, 6), (0, 7)], anchors) == []
    assert homotopy.crossing_word([(0, 5), (2, 6), (1, 3), (0, 3)], anchors) == [("a", 1)]


def test_points_that_a_path_covers_anchor_nothing():
    assert homotopy.anchors_beside([(0, 0), (4, 0)], {"p": [(1, 0)]}, {"p": (1, 0)}) == {}
