"""Coefficients in `Vertices.places`: equal to those of the vertices, and so are the answers."""

from itertools import islice, permutations
from random import Random

import pytest

from exactpt.certificates import coefficients
from exactpt.certificates.certifier import Certifier
from exactpt.kernel.rounding import INFINITY
from exactpt.motion.vertices import HORIZON, MOTION, OTHER_MOTION, WIDTH, Vertices
from exactpt.scene.generate import FAMILIES, generate


def place_of(vertices, v):
    return list(vertices.places[WIDTH * v : WIDTH * v + MOTION + 1])


def check_places(vertices):
    """Compare all places with the vertices; return the number of those in linear translation."""
    assert len(vertices.places) == WIDTH * len(vertices.all)
    count = 0
    for vertex in vertices.all:
        place, float_track = place_of(vertices, vertex.id), vertex.float_track
        is_plain = vertex.body >= 0 and vertex.offset is None and float_track.degree <= 1
        if not is_plain or float_track.ws:
            assert place[MOTION] == OTHER_MOTION
            continue
        count += 1
        coefficients = [float_track.x0, float_track.y0, float_track.x1, float_track.y1]
        until = vertex.moving.until
        horizon = INFINITY if until is None else vertices.normalization.time(until)[1]
        expected = [*coefficients, horizon, float(float_track.motion)]
        assert [str(value) for value in place] == [str(value) for value in expected]
    return count


def vertices_of(scene):
    return Vertices.of(scene.bodies, scene._start, scene._end)


def test_places_of_every_family_equal_the_images():
    counts = {family: check_places(vertices_of(generate(family, 0))) for family in FAMILIES}

    vertices = {family: len(vertices_of(generate(family, 0)).all) for family in FAMILIES}
    assert counts["convex"] == vertices["convex"]
    assert 0 < counts["turning"] < vertices["turning"]
    assert counts["ballistic"] == counts["chains"] == 0


@pytest.mark.parametrize("family", ["convex", "pieces", "mixed_shapes", "deforming", "chains"])
def test_places_follow_pieces_additions_and_removals(family):
    scene, other = generate(family, 1), generate("convex", 2)
    vertices = vertices_of(scene)
    middle = (scene._start + scene._end) / 2

    for i in range(len(vertices.bodies)):
        vertices.enter_piece(i, middle)
    check_places(vertices)
    before = len(vertices.all)
    vertices.remove(0)
    check_places(vertices)
    for body in other.bodies:
        vertices.add(body, other._start)
        check_places(vertices)
    assert len(vertices.all) > before


@pytest.mark.parametrize("family", FAMILIES)
def test_answers_by_places_equal_those_by_images(family):
    """The two ways to the coefficients lead to one formula: equal bits."""
    scene = generate(family, 3)
    vertices = vertices_of(scene)
    certifier = Certifier(vertices, scene._start, scene._end, exact_only=False)
    ids = vertices.ids()
    Random(family).shuffle(ids)
    for a, b, c in islice(permutations(ids, 3), 300):
        if min(a, b, c) != a:
            continue
        va, vb, vc = (vertices.all[v] for v in (a, b, c))
        horizon = min(certifier._end_high, *(place_of(vertices, v)[HORIZON] for v in (a, b, c)))
        now = certifier.now_low, certifier.now_high
        if not (va.is_copy_of(vb) or vb.is_copy_of(vc) or va.is_copy_of(vc)):
            float_tracks = va.float_track, vb.float_track, vc.float_track
            s, low, high = coefficients.orientation(
                *float_tracks, certifier.errors, *now, horizon, at_root=False
            )
            known = (s, low, high) if low <= horizon else (s, INFINITY, INFINITY)
            assert certifier.filtered_orientation(a, b, c) == known
        if not va.is_copy_of(vb):
            horizon = min(certifier._end_high, *(place_of(vertices, v)[HORIZON] for v in (a, b)))
            s, low, high = coefficients.x_difference(
                va.float_track, vb.float_track, certifier.errors, *now, horizon, at_root=False
            )
            known = (s, low, high) if low <= horizon else (s, INFINITY, INFINITY)
            assert certifier.filtered_x_order(a, b) == known
