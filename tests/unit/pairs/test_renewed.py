"""New contacts of bodies that touch at the start, and whether bodies overlap."""

from itertools import pairwise
from random import Random

import pytest
import shapely
from folding import every

from exactpt import Body, Pieces, Translation
from exactpt.kernel.numbers import QQ
from exactpt.pairs.overlap import overlap
from exactpt.pairs.renewed import new_contact_time

BOX = [(0, 0), (2, 0), (2, 2), (0, 2)]
FLOOR = Body("floor", [(-5, -1), (9, -1), (9, 0), (-5, 0)])


def time_of(body, other=FLOOR, end=20):
    time = new_contact_time(body, other, QQ(0), QQ(end))
    return None if time is None else float(time)


def box(*motion):
    return Body("box", BOX, Translation(*motion))


def test_a_box_that_rests_or_slides_is_in_no_new_contact():
    assert time_of(box([0])) is None
    assert time_of(box([0, 1], [0])) is None


def test_a_box_that_is_pressed_down_overlaps_at_once():
    assert time_of(box([0], [0, -1])) == 0


def test_a_box_that_jumps_lands_again():
    assert time_of(box([0], [0, 3, -1])) == 3
    assert time_of(box([0], [0, 3, -1]), end=3) == 3
    assert time_of(box([0], [0, 3, -1]), end=2) is None


def test_a_box_that_leaves_does_not_come_back():
    assert time_of(box([0], [0, 1])) is None


def test_bodies_that_overlap_at_the_start_must_part_first():
    sunk = Body("sunk", [(x, y - 1) for x, y in BOX], Translation([0], [0, 4, -1]))

    assert time_of(sunk) == pytest.approx(2 + 3**0.5)  # up at 2 - sqrt(3), down at 2 + sqrt(3)
    assert time_of(sunk, end=3) is None


def test_overlap_that_begins_later():
    later = Pieces([(3, Translation([0, 1])), (None, Translation([0, 1], [3, -1]))])

    assert time_of(Body("box", BOX, later)) == 3


def test_corners_that_touch_and_part_at_one_time():
    """Two boxes that touch in a corner and slide past each other."""
    other = Body("other", [(2, 2), (4, 2), (4, 4), (2, 4)], Translation([0, -1]))

    assert time_of(Body("box", BOX), other) is None  # along the top of the box, not into it
    into = Body("other", [(2, 2), (4, 2), (4, 4), (2, 4)], Translation([0, -1], [0, -1]))
    assert time_of(Body("box", BOX), into) == 0


@every(
    "first, second, expected",
    [
        ([(0, 0), (2, 0), (2, 2), (0, 2)], [(0, 0), (2, 0), (2, 2), (0, 2)], True),
        ([(0, 0), (2, 0), (2, 2), (0, 2)], [(2, 0), (4, 0), (4, 2), (2, 2)], False),
        ([(0, 0), (4, 0), (0, 4)], [(1, 1)], True),
        ([(0, 0), (4, 0), (0, 4)], [(2, 0)], False),
        ([(0, 0), (4, 0), (0, 4)], [(0, 0), (2, 2)], True),
        ([(0, 0), (4, 0), (0, 4)], [(0, 0), (3, 0)], False),
        ([(0, 0), (2, 2)], [(0, 2), (2, 0)], True),
        ([(0, 0), (2, 2)], [(1, 1), (2, 0)], False),
        ([(0, 0), (6, 0), (6, 4), (3, 1), (0, 4)], [(0, 4), (3, 1), (6, 4), (3, 9)], False),
        ([(0, 0), (6, 0), (6, 4), (3, 1), (0, 4)], [(0, 4), (3, 0), (6, 4), (3, 9)], True),
    ],
)
def test_overlap(first, second, expected):
    a, b = Body("a", first, closed=len(first) > 2), Body("b", second, closed=len(second) > 2)

    assert overlap(a, b, QQ(0)) is expected
    assert overlap(b, a, QQ(0)) is expected


def test_overlap_of_polygons_is_an_area_in_common():
    """Small integers: edges along edges, vertices on edges."""
    random, seen = Random(4), set()
    shapes = [s for _ in range(400) if (s := quadrilateral(random)) is not None]
    for p, q in pairwise(shapes):
        area = shapely.Polygon(p).intersection(shapely.Polygon(q)).area
        found = overlap(Body("a", p), Body("b", q), QQ(0))
        assert found == (area > 1e-9), (p, q)
        seen.add((found, shapely.Polygon(p).intersects(shapely.Polygon(q))))
    assert seen == {(True, True), (False, True), (False, False)}


def quadrilateral(random):
    points = [(random.randint(0, 4), random.randint(0, 4)) for _ in range(4)]
    polygon = shapely.Polygon(points)
    return points if polygon.is_valid and polygon.area else None
