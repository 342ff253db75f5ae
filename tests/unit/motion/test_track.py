"""Trajectories as packed integers, and incidences of two vertices: each with its mirrored twin."""

import pytest

from exactpt.kernel.numbers import ZZ
from exactpt.motion.track import Incidence, Track, renumbered, vertex_touch
from fuzz.planted import PLANTED


def test_incidence_of_two_vertices_is_the_same_for_swapped_bodies():
    """Vertex 7 of body 2 is on vertex 5 of body 1: the lower body comes first, with its vertex."""
    expected = Incidence(body=1, vertex=5, other=2, edge=-1, other_vertex=7)

    assert vertex_touch(1, 5, 2, 7) == expected
    assert vertex_touch(2, 7, 1, 5) == expected


def test_renumbered_incidence_keeps_each_vertex_with_its_body():
    """Body 0 becomes 9 and body 1 becomes 4: vertex 3 stays that of body 9, vertex 8 of body 4."""
    touches = renumbered({Incidence(0, 3, 1, -1, 8)}, 9, 4)

    assert touches == {Incidence(4, 8, 9, -1, 3)}


@pytest.mark.plain
def test_renumbered_incidence_of_swapped_bodies_is_wrong_if_vertices_stay():
    with PLANTED["vertices of swapped bodies not swapped"].made():
        assert renumbered({Incidence(0, 3, 1, -1, 8)}, 9, 4) == {Incidence(4, 3, 9, -1, 8)}


@pytest.mark.parametrize("widths", [(16, 32, 16), (64, 8, 64), (32, 31, 33)])
def test_packed_trajectory_is_its_value_at_the_power_asked_for(widths):
    """x = 3 + 5 t is 3 + 5 2^w at t = 2^w, whatever width was asked for before."""
    track = Track((ZZ(3), ZZ(5)), (ZZ(-1),), (ZZ(2),), None)

    for width in widths:
        assert track.packed(width) == (3 + 5 * 2**width, -1, 2)
