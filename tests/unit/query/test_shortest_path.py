"""Shortest paths against the whole visibility graph, lengths to 500 bits."""

import math
from fractions import Fraction
from itertools import islice, permutations
from random import Random

import pytest

from exactpt import Body, FreeSpace, InputError, Scene, Simulation, UnreachableError
from exactpt.pairs.start import initial_touches
from exactpt.testing.reference import space as definition
from exactpt.testing.reference.paths import length_of, shortest_length
from exactpt.testing.scenes import FAMILIES, RINGS
from exactpt.tiling.start import start_tiling
from fuzz.transformations.run import scene_of
from tests.unit.query.test_space import check_taut, some_point, spaces


def space_of(*bodies, tiling="auto"):
    scene = Scene(bodies, (0, 1))
    return FreeSpace(start_tiling(scene, tiling, scene.start), scene.start)


def check_shortest(space, bodies, rng, count):
    """Some random pairs of points; how many of them were not inside a body."""
    found = 0
    for _ in range(count):
        start, goal = some_point(rng, bodies), some_point(rng, bodies)
        owners = [definition.owner(p, bodies) for p in (start, goal)]
        if any(owner and owner[1:] == (None, None) for owner in owners):
            continue
        found += 1
        expected = shortest_length(bodies, start, goal)
        if expected is None:
            with pytest.raises(UnreachableError, match="no path leads from"):
                space.shortest_path(start, goal)
            continue
        path = space.shortest_path(start, goal)
        check_taut(path, bodies)
        assert (path.points[0], path.points[-1]) == (start, goal)
        assert length_of(path.points).may_be(expected)
        assert path.length == pytest.approx(float(expected), rel=1e-15)
        if owners == [None, None]:
            assert path.length <= space.path(start, goal).length
    return found


@pytest.mark.parametrize("family", sorted({**FAMILIES, **RINGS}))
def test_it_is_as_long_as_in_the_visibility_graph(family):
    for scene, space, rng in islice(spaces(family, range(1)), 2):
        if scene.vertex_count <= 16:
            check_shortest(space, definition.points_of(scene, space.at), rng, 1)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(25))
def test_it_is_as_long_as_in_the_visibility_graph_in_1000_scenes(seed):
    """All families with one seed, some 40 scenes; a seed is chosen by ``[3]`` after the name."""
    scenes = paths = 0
    for family in (*FAMILIES, *RINGS):
        for scene, space, rng in spaces(family, (seed,)):
            if scene.vertex_count <= 40:
                paths += check_shortest(space, definition.points_of(scene, space.at), rng, 3)
                scenes += 1
    print(f"seed {seed}: {paths} paths in {scenes} scenes")  # noqa: T201 - shown with -s
    assert paths > 0


@pytest.mark.long
@pytest.mark.parametrize("seed", range(2))
def test_among_boxes_on_a_grid_ties_and_straight_bends_abound(seed):
    rng = Random(seed)
    boxes = [
        Body(f"{x},{y}", [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)])
        for x in range(0, 4, 2)
        for y in range(0, 6, 2)
        if rng.random() < 0.7
    ]
    space = space_of(*boxes, Body("far", [(7, 7)]))
    bodies = {b.name: list(b.at(0)) for b in [*boxes, Body("far", [(7, 7)])]}
    check_shortest(space, bodies, rng, 4)


def test_a_path_does_not_cross_a_chain_at_its_vertex():
    """From one side of the middle vertex of a chain to the other it leads around an end."""
    chain = Body("chain", [(-3, 1), (0, 0), (4, 1)], closed=False)
    path = space_of(chain).shortest_path((0, 1), (0, -1))

    assert path.bends == (("chain", 0),)
    assert path.points == ((0, 1), (-3, 1), (0, -1))


def test_a_path_runs_along_edges_and_begins_and_ends_on_them():
    box = Body("box", [(0, 0), (4, 0), (4, 2), (0, 2)])
    space = space_of(box)

    along = space.shortest_path((1, 0), (4, 1))
    assert (along.bends, along.length) == ((("box", 1),), 4.0)
    assert space.shortest_path((0, 0), (4, 2)).length == 6.0
    assert space.shortest_path((0, 0), (3, 0)).bends == ()
    assert space.shortest_path((-1, 0), (9, 0)).points == ((-1, 0), (9, 0))
    assert space.shortest_path((2, 0), (2, 0)).length == 0.0


def test_from_a_point_on_a_segment_it_leads_to_either_side():
    space = space_of(Body("wall", [(0, 0), (4, 0)]), Body("p", [(9, 9)]))

    assert space.shortest_path((1, 0), (2, 1)).length == math.sqrt(2)
    assert space.shortest_path((1, 0), (2, -1)).length == math.sqrt(2)
    assert space.shortest_path((1, 1), (1, -1)).points == ((1, 1), (0, 0), (1, -1))


def test_through_points_it_goes_straight():
    points = [Body(f"p{i}", [(i, 0)]) for i in range(1, 5)]
    path = space_of(*points).shortest_path((0, 0), (5, 0))

    assert (path.bends, path.length) == ((), 5.0)


def test_out_of_a_pocket():
    hook = [(0, 0), (6, 0), (6, 6), (5, 6), (5, 1), (1, 1), (1, 6), (0, 6)]
    path = space_of(Body("hook", hook)).shortest_path((3, 2), (3, -1))

    assert path.points in (
        ((3, 2), (1, 6), (0, 6), (0, 0), (3, -1)),
        ((3, 2), (5, 6), (6, 6), (6, 0), (3, -1)),
    )


def test_lengths_that_differ_by_less_than_doubles_can_tell():
    """Around a spike: on one side the way is longer by 1e-40."""
    for sign in (1, -1):
        spike = Body("spike", [(0, "3/10"), (0, f"-{3 * 10**39 + sign}/{10**40}")])
        path = space_of(spike).shortest_path((-1, 0), (1, 0))
        assert path.bends == (("spike", 0 if sign > 0 else 1),)


def test_what_a_shortest_path_refuses():
    space = space_of(Body("a", [(0, 0), (4, 0), (0, 4)]))
    for ends in (((1, 1), (9, 9)), ((9, 9), (1, 1))):
        with pytest.raises(InputError, match=r"\(1, 1\) is not free: body 'a' has it"):
            space.shortest_path(*ends)
    assert space_of().shortest_path((0, 0), (3, 4)).length == 5.0


def test_a_simulation_finds_it_too():
    simulation = Simulation(Scene([Body("a", [(0, 0), (4, 0), (0, 4)])], (0, 1)))
    assert simulation.shortest_path((-1, 1), (2, -1)).bends == (("a", 0),)


def test_bug_a_walk_between_two_points_of_one_diagonal_went_to_its_end():
    """Start and goal are on the diagonal that is crossed: the funnel has no width."""
    parts = [[(3, 3), (5, 3), (3, 5)], [(5, 5), (4, 5), (5, 4)], [(-4, -5), (-3, -5), (-4, -4)]]
    bodies = [
        Body("parts", parts=[{"vertices": part} for part in parts]),
        Body("a", [(3, -3), (5, -3), (5, -1), (4, -2)]),
        Body("b", [(4, 0), (5, 1)]),
    ]
    for order in permutations(bodies):
        for tiling in ("lazy", "greedy", "mixed"):
            space = Simulation(Scene(order, time=(0, 2)), tiling=tiling).space()
            for turn in (1, -1):
                walk = [(3, 1), (0, 3), ("5/2", "1/2")][::turn]
                assert space.shorten(walk).points == tuple(
                    (Fraction(x), Fraction(y)) for x, y in walk[::2]
                )


def on_a_line(random, points):
    """A point on the line through two vertices: often on a diagonal."""
    a, b = random.choice(points), random.choice(points)
    u = Fraction(random.randint(-3, 7), 4)
    return tuple(p + u * (q - p) for p, q in zip(a, b, strict=True))


@pytest.mark.slow
def test_shortened_walks_are_as_long_in_every_tiling():
    """2,000 tiny scenes, in two orders of the bodies; walks back and forth over diagonals."""
    walks = 0
    for seed in range(2000):
        random = Random(f"walks {seed}")
        scene = scene_of(random)
        orders = scene, Scene(scene.bodies[::-1], (scene.start, scene.end))
        if scene.has_radius or initial_touches(scene)[1]:
            continue
        spaces = [
            Simulation(one, tiling=tiling).space()
            for one in orders
            for tiling in ("lazy", "greedy", "mixed")
        ]
        points = [p for body in scene.bodies for p in body.at(scene.start)]
        for _ in range(6):
            walk = [on_a_line(random, points) for _ in range(random.randint(2, 4))]
            found = [shortened(space, walk) for space in spaces]
            walks += found[0] is not None
            assert len(set(found)) == 1, (seed, walk, found)
    assert walks > 400  # the others meet bodies


def shortened(space, walk):
    try:
        return round(space.shorten(walk).length, 9)
    except InputError:
        return None
