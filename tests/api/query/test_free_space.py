"""Places, rays and hulls in the free space, by hand; by definition they are the laws `space/*`."""

import copy
import pickle
from dataclasses import asdict, replace
from fractions import Fraction
from random import Random

import numpy as np
import pytest

from exactpt import Body, InputError, Scene, Simulation, Translation
from exactpt.testing.reference import space as definition
from exactpt.testing.scenes import generate


def space_of(*bodies, tiling="auto"):
    return Simulation(Scene(bodies, (0, 1)), tiling=tiling).space()


# Few bodies


def test_space_without_bodies_is_free():
    space = space_of()

    assert space.hull() == []
    assert space.locate((0, 0)).kind == "outside"
    assert space.ray_cast((0, 0), (1, 0)) is None
    assert space.path((0, 0), (3, 4)).length == space.shorten([(0, 0), (3, 4)]).length == 5
    assert space.shortest_path((0, 0), (3, 4)).length == 5


@pytest.mark.parametrize("count", [1, 2, 3])
def test_hull_of_points_on_a_line_has_each_of_them(count):
    """A hull without area is traversed in both directions."""
    space = space_of(*(Body(f"p{i}", [(2 * i, i)]) for i in range(count)))

    assert set(space.hull()) == {(f"p{i}", 0) for i in range(count)}
    assert space.locate((0, 0)).body == "p0"
    assert space.ray_cast((-4, -2), (2, 1)).at == 2
    assert space.ray_cast((-4, -2), (1, 1)) is None
    assert space.neighbours("p0") == (["p1"] if count > 1 else [])


def test_relative_hull_of_a_point_is_the_point():
    """In the tiling of points, which has no copies of them, it was an internal error."""
    points = [Body(f"p{i}", [(i, i * i)], Translation([0, -i], [0, 2])) for i in range(6)]
    simulation = Simulation(Scene(points, (0, 3)))

    assert simulation.name == "incremental"
    assert [simulation.relative_hull(p.name) for p in points] == [[(p.name, 0)] for p in points]


@pytest.mark.parametrize("tiling", ["mixed", "lazy"])
def test_relative_hull_of_a_mouth_that_is_pulled_shut_passes_a_tooth_twice(tiling):
    """The loop around the jaw with its prey passes vertex 10 on either side (clamps:168)."""
    jaw = [(-20, -10), (100, -10), (80, 8), (60, 0), (40, 4), (20, 7), (0, 7), (-10, 10),
           (-3, 12), (25, 33), (45, 9), (60, 17), (79, 32), (100, 63), (-20, 63)]  # fmt: skip
    prey = [(21, 17), (21, 13), (22, 11), (27, 13), (24, 16)]

    space = space_of(Body("jaw", jaw), Body("prey", prey), tiling=tiling)

    assert space.relative_hull("jaw").count(("jaw", 10)) == 2


# Given numbers


@pytest.mark.parametrize(
    "offset", [0, 10**15, Fraction(10**20, 3), 10**400], ids=["0", "large", "a third", "no double"]
)
def test_doubles_are_taken_exactly_wherever_the_bodies_are(offset):
    """Squares of side 4 stand at 0, 8 and 16 from the offset, which may be no double."""
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    space = space_of(
        *(Body(f"{i}", [(offset + x + 8 * i, y) for x, y in square]) for i in range(3))
    )
    points = [(offset + Fraction(x, 2), Fraction(y, 3)) for x in range(-3, 44) for y in (-1, 6, 12)]
    if offset < 10**16:
        points += [(float(x), float(y)) for x, y in points]
    for x, y in points:
        at, place = Fraction(x) - offset, space.locate((x, y))
        inside = at % 8 <= 4 and 0 <= at <= 20 and 0 <= y <= 4
        assert (place.body == f"{at // 8}") == inside
        hit = space.ray_cast((x, y), (1.0, 0.0))
        if not inside and 0 < y < 4:
            assert (hit is None) == (at > 20)
            assert hit is None or hit.point[0] - offset == max(0, -(-at // 8) * 8)


@pytest.mark.parametrize("beside", [-1, 1])
def test_bug_segment_that_crosses_a_scene_on_one_line_is_not_free(beside):
    """From one unit in the last place beside the line y = x / 2 to the other side of it.

    Of the two half-edges of the edge it crossed, the one on whose left it came was the end.
    """
    space = space_of(Body("a", [(0, 0), (4, 2)]))
    p = 2 + Fraction(beside, 2**51), 1

    assert not space.is_free(p, (2 - 3 * beside, 1))
    assert space.is_free(p, (2 + 3 * beside, 1))
    assert not space.is_free(p, (2 - beside, 2 + beside))


def test_many_locations_are_those_of_each_point():
    """By the kinds of places: inside, on an edge, on a vertex, in the open, outside."""
    triangle = [(0, 0), (4, 0), (0, 4)]
    space = space_of(Body("a", triangle), Body("b", [(x + 9, y) for x, y in triangle]))

    found = space.locate_many(np.array([(1, 1), (2, 0), (9, 0), (6, 1), (50, 50)]))

    assert repr(found) == "<Located: 5 points>"
    places = ("tile", "diagonal", "outside", "body", "edge", "vertex")
    assert [places[kind] for kind in found.kind] == ["body", "edge", "vertex", "tile", "outside"]
    assert list(found.owner[:3]) == [0, 0, 1]
    assert list(found.feature) == [-1, 0, 0, -1, -1]


# Refusals


def test_directions_points_and_bodies_that_are_none_are_refused():
    space = space_of(Body("a", [(0, 0), (4, 0), (0, 4)]), Body("b", [(9, 0), (12, 0), (9, 5)]))
    with pytest.raises(InputError, match="direction"):
        space.ray_cast((0, 0), (0, 0))
    with pytest.raises(InputError, match="two coordinates"):
        space.locate((0, 0, 0))
    with pytest.raises(InputError, match="no body 'c'"):
        space.neighbours("c")


def test_arrays_of_other_shapes_or_with_infinite_numbers_are_refused():
    space = Simulation(generate("convex", 1)).space()
    assert [len(column) for column in space.locate_many(np.empty((0, 2)))] == [0, 0, 0]
    with pytest.raises(InputError, match=r"shape \(n, 2\), got \(3,\)"):
        space.locate_many([1.0, 2.0, 3.0])
    with pytest.raises(InputError, match="row 1 is not finite"):
        space.locate_many([[0.0, 0.0], [np.nan, 0.0]])


# Costs, by the edges that a walk has crossed


@pytest.mark.long
def test_few_edges_are_crossed_in_the_relative_hull():
    """Lemma 5.4: O(log n) edges on the way through F1, here two a level of the tree.

    What is over a bowl of 2 m + 3 vertices is a convex pocket.
    """
    for m in (8, 64, 512):
        outline = [(-m - 1, -1), (m + 1, -1), *((i, i * i) for i in range(m, -m - 1, -1))]
        space = space_of(Body("bowl", outline), Body("far", [(0, 2 * m * m)]), tiling="mixed")
        rng = Random(m)
        most = 0
        for _ in range(100):
            x = Fraction(rng.randint(-2 * m + 1, 2 * m - 1), 2)
            hit = space.ray_cast((x, x * x + 1), (rng.randint(-9, 9), rng.randint(-m, m) or 1))
            most = max(most, hit.crossed if hit else 0)

        assert 1 < most <= 2 * (2 * m + 3).bit_length()


def test_edges_crossed_are_of_the_order_of_bodies():
    """A greedy tiling of k convex bodies has 2k - 2 tiles: no line crosses more than O(k)."""
    for seed in range(4):
        scene = generate("convex", seed)
        space, rng = Simulation(scene, tiling="greedy").space(), Random(seed)
        corners = [p for points in definition.points_of(scene, space.at).values() for p in points]
        for _ in range(50):
            (a, b), (c, d) = rng.choice(corners), rng.choice(corners)
            p = (a + c) / 2, (b + d) / 2 + 1
            crossed = [space.locate(p).crossed]
            hit = space.ray_cast(p, (d - b + 1, a - c))
            crossed.append(hit.crossed if hit else 0)
            assert max(crossed) <= 8 * len(scene.bodies)


def test_walks_to_places_are_short():
    """They begin in the cell of a point: their length does not grow with the number of bodies."""
    scene = generate("convex", 5)
    space = Simulation(scene).space()
    rng = Random("short")
    points = [
        (float(x) + rng.random() - 0.5, float(y) + rng.random() - 0.5)
        for points in definition.points_of(scene, space.at).values()
        for x, y in points
    ]

    assert sum(space.locate(p).crossed for p in points) <= 6 * len(points)


# Hits


@pytest.fixture(name="hit")
def _hit():
    """From (0, 1/2) to the right: to the edge of a box at x = 3, after 3/2 of the direction."""
    box = Body("box", [(3, 0), (5, 0), (5, 2), (3, 2)])
    return space_of(box).ray_cast((0.0, 0.5), (2.0, 0.0))


def test_hit_has_its_point_and_parameter_as_fractions(hit):
    assert (hit.body, hit.vertex, hit.edge) == ("box", None, 3)
    assert (hit.point, hit.at) == ((3, Fraction(1, 2)), Fraction(3, 2))
    assert all(type(number) is Fraction for number in (hit.at, *hit.point))


@pytest.mark.parametrize(
    "of",
    [
        repr,
        hash,
        asdict,
        copy.copy,
        copy.deepcopy,
        lambda hit: [pickle.dumps(hit, protocol) for protocol in range(2, 6)],
        lambda hit: pickle.loads(pickle.dumps(hit)),
        lambda hit: replace(hit, crossed=7),
        lambda hit: hasattr(hit, "__dict__"),
        lambda hit: hit,
    ],
)
def test_hit_whose_point_was_not_read_is_as_one_whose_values_were_given(hit, of):
    point, at = (Fraction(3), Fraction(1, 2)), Fraction(3, 2)
    given = type(hit)(hit.body, hit.vertex, hit.edge, point, at, hit.crossed)

    assert of(hit) == of(given)


def test_hit_has_no_other_attributes(hit):
    with pytest.raises(AttributeError, match="'Hit' object has no attribute 'distance'"):
        _ = hit.distance
    with pytest.raises(AttributeError, match="cannot assign to field 'at'"):
        hit.at = 1


# Where doubles decide nothing, or help nothing


def test_ray_beside_a_corner_hits_the_edge_on_its_side():
    """It passes (7, 9) to the left, by 2^-40 in x: edge 0 goes from there to (6, 9).

    The places at which it crosses the two edges of a tile that meet in the corner are so near each
    other that doubles do not order them.
    """
    space = space_of(
        Body("triangle", [(6, 9), (7, 9), (7, 10)]),
        Body("left", [(0, 24), (1, 24), (0, 25)]),
        Body("low", [(0, 6), (1, 6), (0, 7)]),
    )
    beside = Fraction(1, 2**40)

    hit = space.ray_cast((42 - beside, -71), (-7, 16))

    assert (hit.body, hit.edge, hit.at) == ("triangle", 0, 5)
    assert hit.point == (7 - beside, 9)


def test_point_far_from_all_vertices_is_located_between_two_crowds():
    """Cells around it have no vertices, of 75 around (0, 0) and 75 around (10^6, 10^6)."""
    corners = [(far + 3 * i, far + 3 * j) for far in (0, 10**6) for i in range(5) for j in range(5)]
    space = space_of(*(Body(f"{x} {y}", [(x, y), (x + 1, y), (x, y + 1)]) for x, y in corners))
    between = 5 * 10**5

    assert space.locate((between, between)).kind == "tile"
    assert space.locate((between, -between)).kind == "outside"
    hit = space.ray_cast((between, between), (1, 1))
    assert (hit.body, hit.vertex) == ("1000000 1000000", 0)
