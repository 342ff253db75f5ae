"""Candidates of contacts: what is kept, and in which order."""

import math

import pytest

from exactpt.filters.candidates import Candidate, Candidates, two_vertices, vertex_on_edge

NAN, INFINITY = math.nan, math.inf


def test_candidates_by_low_are_those_up_to_the_limit():
    found = Candidates(5.0)
    found.add(vertex_on_edge(0, 3, 1, 2), 4.0, 6.0, 9.0)
    found.add(vertex_on_edge(0, 1, 1, 2), 5.5, 6.0, 9.0)
    found.add(two_vertices(1, 0, 0, 7), 1.0, 2.0, 9.0)
    found.add(vertex_on_edge(0, 2, 1, 2), 5.0, 6.0, 9.0)

    assert found.rows() == [
        Candidate(1.0, 2.0, one=1, vertex=0, other=0, edge=-1, other_vertex=7, until=9.0),
        Candidate(4.0, 6.0, one=0, vertex=3, other=1, edge=2, other_vertex=-1, until=9.0),
        Candidate(5.0, 6.0, one=0, vertex=2, other=1, edge=2, other_vertex=-1, until=9.0),
    ]


@pytest.mark.parametrize("features", [(0, 1, 2, 3), (0, 2, 1, 3), (1, 0, 0, 0)])
def test_candidates_of_one_time_are_in_the_order_of_their_numbers(features):
    found, other = Candidates(1.0), Candidates(1.0)
    rest = vertex_on_edge(0, 2, 2, 0)
    for candidates, order in ((found, 1), (other, -1)):
        for each in (vertex_on_edge(*features), rest)[::order]:
            candidates.add(each, 0.0, 1.0, 1.0)

    assert found.rows() == other.rows()


def test_candidate_of_which_nothing_is_known_is_kept_and_first():
    found = Candidates(1.0)
    found.add(vertex_on_edge(0, 0, 1, 0), 0.0, 1.0, 1.0)
    found.add(vertex_on_edge(0, 1, 1, 0), NAN, NAN, NAN, is_sure=True)

    first = found.rows()[0]

    assert (first.low, first.high, first.until, first.vertex) == (-INFINITY, INFINITY, INFINITY, 1)
    assert list(found.sure) == [0, 0]


def test_candidate_added_as_sure_is_sure():
    found = Candidates(1.0)
    found.add(vertex_on_edge(0, 0, 1, 0), 0.0, 1.0, 1.0, is_sure=True)
    found.add(vertex_on_edge(0, 0, 1, 0), 0.0, 1.0, 1.0)

    assert list(found.sure) == [1, 0]


def test_features_of_a_candidate_are_those_that_were_added():
    found = Candidates(1.0)
    found.add(two_vertices(4, 3, 2, 1), 0.0, 1.0, 1.0)

    features = found.features(0)

    assert (features.one, features.vertex, features.other) == (4, 3, 2)
    assert (features.edge, features.other_vertex) == (-1, 1)
    assert found.count() == 1
