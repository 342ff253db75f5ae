"""Doubles near the control points of a certificate, and lines between whole bodies."""

from fractions import Fraction
from random import Random

import numpy as np
import pytest

from exactpt import Body, Rigid, Scene, Translation
from exactpt.check_apart import planes_of, side_of
from exactpt.proof.frame import Frame
from exactpt.proof.paths import DIRECTIONS, Paths, Plane
from exactpt.proof.whole import WholeBodies
from exactpt.testing.scenes import generate

FAMILIES = ["convex", "keyframed", "turning", "deforming", "discs"]
THIRD, FAR = Fraction(1, 3), 10**9
BOX = [(0, 0), (1, 0), (1, 1), (0, 1)]


def moved(x, y, *motion):
    return Body(f"{x}", [(a + x, b + y) for a, b in BOX], Translation(*motion))


def scenes():
    """Scenes of families, and one far from the origin with coordinates that are no doubles."""
    yield from (generate(family, 1) for family in FAMILIES)
    motions = ([0, THIRD], [THIRD, -1]), ([-FAR, 3], [0]), ([1], [0, THIRD, 1])
    places = [FAR + 3 * k + THIRD for k in range(3)]
    yield Scene([moved(x, 0, *p) for x, p in zip(places, motions, strict=True)], time=(0, 5))


def frame_of(scene, distance=Fraction(0)):
    paths = Paths(scene.bodies, distance, scene.time)
    start, end = Fraction(scene.start), Fraction(scene.end)
    return paths, Frame(paths, np.arange(len(paths.items)), start, (start + end) / 2)


def exact(paths, frame):
    """The control points, the vertices in the order of the frame."""
    vertices = dict.fromkeys(v for _, *ends in paths.items for v in ends)
    return [frame.time.hull(paths, v) for v in vertices]


def test_doubles_are_as_near_as_the_bound_of_tests_needs():
    for scene in scenes():
        paths, frame = frame_of(scene)
        (a, b), start = frame._origin, frame.start
        hulls = [point for hull in exact(paths, frame) for point in hull]
        assert len(hulls) == len(frame._points)
        for (x, y, t, w), near in zip(hulls, frame._points.tolist(), strict=True):
            right = Fraction(x, w) - a, Fraction(y, w) - b, Fraction(t, w) - start
            errors = [abs(Fraction(p) - q) for p, q in zip(near, right, strict=True)]
            assert max(errors[:2]) <= Fraction(4, 2**53) * Fraction(frame._size)
            assert errors[2] <= Fraction(1, 2**53) * Fraction(frame.length)


@pytest.mark.parametrize("distance", [Fraction(0), Fraction(1, 7)])
def test_bodies_are_separated_where_the_checker_finds_them_so(distance):
    random, found = Random(5), 0
    for scene in scenes():
        paths, frame = frame_of(scene, distance)
        x, y = map(int, frame._origin)
        hulls = exact(paths, frame)
        of = [paths.body_of[v] for v in dict.fromkeys(v for _, *e in paths.items for v in e)]
        for _ in range(8):
            n, m = random.choice([(1, 0), (0, 1), (1, -1), (3, 2)])
            c = n * x + m * y + Fraction(random.randrange(-400, 400), 8)
            plane = Plane(n, m, c, Fraction(random.randrange(-3, 4)))
            sides = {}
            for i, hull in zip(of, hulls, strict=True):
                planes = planes_of(*plane, paths.radii[i], distance)
                sides.setdefault(i, set()).add(side_of(hull, *planes))
            below = {i for i, side in sides.items() if side == {-1}}
            certain = frame.separates(plane, below, frame.bodies)
            assert not certain or all(sides[i] == {1} for i in sides.keys() - below)
            found += certain and 0 < len(below) < len(sides)
            one = {random.choice(frame.bodies)}
            assert not frame.separates(plane, one - below, one) or sides[min(one)] == {1}
    assert found > 3


def test_extents_of_straight_paths_decide_as_their_points_do():
    found = [0, 0]
    for scene in scenes():
        _, frame = frame_of(scene)
        extents = frame.body_extents()
        for k, (n, m) in enumerate(DIRECTIONS.tolist() if frame.is_straight else []):
            low, high = (of[..., [k]] for of in extents)
            middles = sorted({*(low / 2 + high / 2).mean(axis=0)[:, 0].tolist()})
            for c in map(Fraction, np.convolve(middles, [0.5, 0.5], "valid").tolist()):
                rows = (high[..., 0] < c).all(axis=0)
                if rows.all() or not rows.any():
                    continue
                plane = Plane(n, m, c + n * frame._origin[0] + m * frame._origin[1], Fraction(0))
                below = {i for i, is_below in zip(frame.bodies, rows, strict=True) if is_below}
                ends = high[:, rows, 0].max(axis=1), low[:, ~rows, 0].min(axis=1)
                certain = frame.separates(plane, below, frame.bodies)
                assert frame.is_between(plane, *ends) == certain
                found[certain] += 1
    assert min(found) > 3


def test_whole_bodies_are_cut_in_halves_by_lines_at_rest():
    scene = Scene([moved(3 * k, 0, [0, (-1) ** k * THIRD]) for k in range(8)], time=(0, 2))
    _, frame = frame_of(scene)
    plane, below = WholeBodies(frame, range(8)).cut(set(range(8)))
    assert (plane.x, plane.y, plane.v) == (1, 0, 0)
    assert below == {0, 1, 2, 3}
    plane, below = WholeBodies(frame, range(8)).cut({1, 5})
    assert below == {1}


def test_groups_are_cut_apart_before_their_bodies():
    scene = Scene([moved(3 * k, 0) for k in range(5)], time=(0, 2))
    _, frame = frame_of(scene)
    _, below = WholeBodies(frame, [0, 1, 1, 1, 1]).cut(set(range(5)))
    assert below == {0}


def test_no_line_between_bodies_that_cross():
    crossing = [Body("a", [(0, 0), (4, 4)]), Body("b", [(0, 4), (4, 0)], Rigid([0, 1]))]
    _, frame = frame_of(Scene(crossing, time=(0, 1)))
    assert WholeBodies(frame, range(2)).cut({0, 1}) is None


def test_bodies_of_a_node_alone_are_looked_at():
    """The time of a certificate of many bodies would be quadratic."""
    scene = Scene([moved(3 * k, 0) for k in range(40)], time=(0, 2))
    _, frame = frame_of(scene)
    whole = WholeBodies(frame, range(40))
    rows = list[int]()
    best = whole._best
    whole._best = lambda j, some: rows.extend(some) or best(j, some)
    assert whole.cut({3, 7, 20})[1] == {3, 7}
    assert set(rows) == {3, 7, 20}
