"""When bodies that touch overlap: the table of docs/format.md, also with edges cut into parts."""

from collections import Counter
from itertools import pairwise, product
from random import Random

import pytest
import shapely

from exactpt import Body, Scene, Translation, first_contact
from exactpt.kernel.numbers import QQ
from exactpt.pair.overlap import overlap
from exactpt.testing import reference
from exactpt.testing.reference.crossing import chains_cross

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
"""A polygon: a list that ends where it begins."""


def polygon(*points):
    return [*points, points[0]]


CASES = {
    ("point", "point"): ([[(0, 0)], [(0, 0)], False],),
    ("point", "segment"): (
        [[(1, 0)], [(0, 0), (2, 0)], False],
        [[(0, 0)], [(0, 0), (2, 0)], False],
    ),
    ("point", "chain"): (
        [[(1, 0)], [(0, 0), (1, 0), (1, 2)], False],
        [[(1, 1)], [(0, 0), (1, 0), (1, 2)], False],
    ),
    ("point", "polygon"): (
        [[(4, 4)], polygon(*SQUARE), False],
        [[(4, 1)], polygon(*SQUARE), False],
        [[(3, 1)], polygon(*SQUARE), True],
    ),
    ("segment", "segment"): (
        [[(0, 0), (0, 2)], [(-2, 0), (2, 0)], False],  # an end on the other one
        [[(0, 0), (0, 2)], [(0, 0), (2, 0)], False],  # ends together
        [[(-2, 0), (0, 0)], [(0, 0), (2, 0)], False],
        [[(-2, 0), (1, 0)], [(0, 0), (2, 0)], False],  # one along the other
        [[(-2, 0), (3, 0)], [(0, 0), (2, 0)], False],
        [[(0, -1), (0, 2)], [(-2, 0), (2, 0)], True],
        [[(-1, -1), (1, 1)], [(-2, 0), (2, 0)], True],
    ),
    ("segment", "chain"): (
        [[(0, 0), (0, 2)], [(-2, 0), (0, 0), (2, 0)], False],  # an end on a straight vertex
        [[(-2, 0), (2, 0)], [(-1, 1), (0, 0), (1, 1)], False],  # a corner touches it
        [[(-2, 0), (2, 0)], [(-2, 1), (-1, 0), (1, 0), (2, 1)], False],  # an edge along it
        [[(0, 0), (2, 0)], [(0, -1), (0, 0), (1, 0), (1, 1)], False],  # its end on the path
        [[(-2, 0), (2, 0)], [(0, -1), (0, 0), (1, 0)], False],
        [[(-2, 0), (2, 0)], [(-1, 1), (0, 0), (1, -1)], True],  # through a vertex
        [[(-2, 0), (2, 0)], [(-1, 1), (0, 0), (0, -1)], True],
        [[(-3, 0), (3, 0)], [(-2, 1), (-1, 0), (1, 0), (2, -1)], True],  # along it, then beyond
        [[(0, -1), (0, 1)], [(-2, 0), (0, 0), (2, 0)], True],
    ),
    ("chain", "chain"): (
        [[(-1, 1), (0, 0), (1, 1)], [(-1, -1), (0, 0), (1, -1)], False],  # corners
        [[(-1, 1), (0, 0), (1, 1)], [(-1, 2), (0, 0), (1, 2)], False],  # one in the other
        [[(-1, 1), (0, 0), (2, 0), (3, 1)], [(-1, -1), (0, 0), (2, 0), (3, -1)], False],
        [[(-1, 1), (0, 0), (2, 0), (3, 1)], [(-1, -1), (0, 0), (2, 0)], False],
        [[(-1, 1), (0, 0), (2, 0), (2, 2)], [(-1, 1), (0, 0), (2, 0), (2, 2)], False],
        [[(-1, 1), (0, 0), (1, 1)], [(0, 1), (0, 0), (0, -1)], True],
        [[(-1, 1), (0, 0), (1, -1)], [(-1, -1), (0, 0), (1, 1)], True],
        [[(-1, 1), (0, 0), (2, 0), (3, 1)], [(-1, -1), (0, 0), (2, 0), (2, 1)], True],
        [[(-2, 0), (0, 0), (0, 2), (2, 2)], [(0, -2), (0, 0), (0, 2), (0, 4)], True],
        [[(-2, 0), (0, 0), (0, 2), (-2, 2)], [(0, -2), (0, 0), (0, 2), (0, 4)], False],
    ),
    ("segment", "polygon"): (
        [[(4, 1), (6, 1)], polygon(*SQUARE), False],
        [[(1, 4), (6, 4)], polygon(*SQUARE), False],  # along an edge
        [[(3, 5), (5, 3)], polygon(*SQUARE), False],  # past a corner
        [[(3, 1), (6, 1)], polygon(*SQUARE), True],
        [[(4, 0), (0, 4)], polygon(*SQUARE), True],  # from corner to corner
        [[(1, 1), (2, 2)], polygon(*SQUARE), True],
        [[(0, 4), (6, 4)], polygon((0, 0), (6, 0), (6, 4), (3, 1), (0, 4)), False],
    ),
    ("chain", "polygon"): (
        [[(5, 5), (4, 4), (6, 4)], polygon(*SQUARE), False],
        [[(4, 6), (4, 0), (0, 0)], polygon(*SQUARE), False],  # along its boundary
        [[(6, 1), (4, 1), (4, 3), (6, 3)], polygon(*SQUARE), False],
        [[(6, 1), (4, 1), (4, 3), (3, 3)], polygon(*SQUARE), True],
        [[(6, 1), (4, 4), (0, 0)], polygon(*SQUARE), True],
    ),
    ("polygon", "polygon"): (
        [polygon((4, 0), (8, 0), (8, 4), (4, 4)), polygon(*SQUARE), False],  # an edge in common
        [polygon((4, 4), (8, 4), (8, 8)), polygon(*SQUARE), False],  # a corner
        [polygon((0, 4), (3, 1), (6, 4)), polygon((0, 0), (6, 0), (6, 4), (3, 1), (0, 4)), False],
        [polygon(*SQUARE), polygon(*SQUARE), True],
        [polygon((2, 2), (8, 2), (8, 8)), polygon(*SQUARE), True],
        [polygon((1, 1), (2, 1), (1, 2)), polygon(*SQUARE), True],
    ),
}  # fmt: skip
"""For each two kinds of bodies examples, and whether they overlap."""


def kind_of(points):
    if len(points) > 2 and points[0] == points[-1]:
        return "polygon"
    return ("point", "segment", "chain")[min(len(points), 3) - 1]


def cut(points, parts):
    """The same points, each edge cut into a number of parts."""
    found = [points[0]]
    for (x, y), (u, v) in pairwise(points):
        found += [(x + QQ(k, parts) * (u - x), y + QQ(k, parts) * (v - y))
                  for k in range(1, parts + 1)]  # fmt: skip
    return found


def body(name, points, motion=None):
    closed = kind_of(points) == "polygon"
    shown = [tuple(map(str, p)) for p in (points[:-1] if closed else points)]
    return Body(name, shown, motion or Translation([0]), closed=closed)


EXAMPLES = [(*kinds, *example) for kinds, examples in CASES.items() for example in examples]


def test_the_table_has_all_kinds():
    kinds = ["point", "segment", "chain", "polygon"]
    assert {frozenset(pair) for pair in CASES} == set(map(frozenset, product(kinds, repeat=2)))
    for first, second, p, q, _ in EXAMPLES:
        assert [kind_of(p), kind_of(q)] == [first, second]
    for pair, examples in CASES.items():
        expected = {False} if "point" in pair and "polygon" not in pair else {False, True}
        assert {example[2] for example in examples} == expected


@pytest.mark.parametrize("parts", [(1, 1), (1, 2), (2, 1), (2, 3), (4, 4)])
@pytest.mark.parametrize("first, second, p, q, expected", EXAMPLES)
def test_overlap_does_not_depend_on_further_vertices(first, second, p, q, expected, parts):
    shapes = [cut(points, n) for points, n in zip((p, q), parts, strict=True)]
    for a, b in (shapes, [s[::-1] for s in shapes], shapes[::-1]):
        assert overlap(body("a", a), body("b", b), QQ(0)) is expected
        assert reference.overlap(body("a", a), body("b", b), QQ(0)) is expected


WALL = [(-2, 0), (2, 0)]


@pytest.mark.parametrize("parts", [1, 2, 3])
@pytest.mark.parametrize("exact_only", [False, True])
@pytest.mark.parametrize(
    "points, motion, expected",
    [
        ([(0, 0), (0, 1)], Translation(0, [0, -1]), 0),  # it stands on the wall, and sinks
        ([(0, 0), (0, 1)], Translation([0, 1]), None),  # it slides off
        ([(0, 0), (0, 1)], Translation(0, [0, 3, -1]), 3),  # it jumps, and lands
        ([(-1, 1), (0, 0), (1, 1)], Translation(0, [0, -1]), 0),
        ([(-1, 1), (0, 0), (1, 1)], Translation([0, 1]), None),
        ([(-1, 0), (1, 0)], Translation([0, 1]), None),  # along the wall
        ([(-1, 0), (1, 0), (1, 1)], Translation(0, [0, -1]), 0),
        ([(-1, 0), (1, 0)], Translation(0, [0, -1]), None),
        ([(0, 0)], Translation(0, [0, -1]), None),  # points never cross
        ([(-1, 1), (1, 1), (0, 0), (-1, 1)], Translation(0, [0, -1]), 0),
        ([(-1, 0), (1, 0), (0, 3), (-1, 0)], Translation(0, [0, -1]), 0),
        ([(-1, 0), (1, 0), (0, 3), (-1, 0)], Translation([0, 1]), None),
    ],
)
def test_bug_new_contacts_depended_on_how_a_wall_is_cut(
    points, motion, expected, exact_only, parts
):
    for n in (1, 2, 3):
        moving = body("moving", cut(points, n), motion)
        scene = Scene([moving, body("wall", cut(WALL, parts))], time=(0, 9))
        contact = first_contact(scene, after_start=True, exact_only=exact_only)
        assert (contact and contact.time) == expected


def chain(random):
    """A simple chain on a small grid."""
    while True:
        points = [(random.randint(0, 3), random.randint(0, 3)) for _ in range(random.randint(2, 4))]
        line = shapely.LineString(points)
        if line.is_simple and line.length and len(set(points)) == len(points):
            return points


@pytest.mark.long
def test_chains_on_a_grid_cross_as_counted():
    random, seen = Random(7), Counter()
    for _ in range(1000):
        p, q = chain(random), chain(random)
        found = {
            overlap(body("a", cut(p, n)), body("b", cut(q, m)), QQ(0))
            for n, m in ((1, 1), (1, 3), (2, 1), (3, 2))
        }
        counted = chains_cross(*(body("c", points).exact_at(QQ(0)) for points in (p, q)))
        assert found == {counted}, (p, q)
        seen[counted, shapely.LineString(p).crosses(shapely.LineString(q))] += 1
    assert seen[True, True] > 60
    assert seen[False, True] > 20
