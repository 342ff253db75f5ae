"""Shortest paths and shortened walks, by hand.

That paths are the shortest by the visibility graph, and walks are taut in their class, are the laws
`space/paths` and `space/walks`.
"""

import math
from fractions import Fraction
from itertools import permutations

import pytest

from exactpt import Body, InputError, Scene, Simulation
from exactpt.testing.scenes import generate


def space_of(*bodies, tiling="auto"):
    return Simulation(Scene(bodies, (0, 1)), tiling=tiling).space()


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


def test_paths_lead_around_the_hull():
    """Two pockets of one body are joined outside alone; the winding of a walk is kept."""
    space = space_of(Body("hourglass", [(0, 0), (3, 4), (0, 8), (9, 8), (6, 4), (9, 0)]))
    left, right = (1, 4), (8, 4)

    path = space.path(left, right)
    over = space.shorten([left, (-9, 4), (-9, 99), (99, 99), (99, 4), right])
    around = space.shorten([left, (-9, 4), (-9, 99), (99, 99), (99, -9), (-9, -9), (-9, 4), left])

    assert path.bends in (
        (("hourglass", 0), ("hourglass", 5)),
        (("hourglass", 2), ("hourglass", 3)),
    )
    assert over.bends == (("hourglass", 2), ("hourglass", 3))
    assert set(around.bends) == {("hourglass", v) for v in (0, 2, 3, 5)}
    assert space.path((-50, 4), (50, 4)).length < 102


def test_walk_along_a_chain_bends_at_its_vertices_on_its_own_side():
    chain = Body("chain", [(0, 0), (4, 0), (4, -3)], closed=False)
    space = space_of(chain, Body("point", [(9, 1)]))
    walk = [(-1, -2), (-1, 1), (5, 1), (5, -2)]

    over, under = space.shorten(walk), space.shorten([walk[0], (-1, -4), (5, -4), walk[-1]])

    assert over.points == (walk[0], (0, 0), (4, 0), walk[-1])
    assert under.points == (walk[0], (4, -3), walk[-1])


def test_paths_and_walks_through_bodies_are_refused():
    space = space_of(Body("a", [(0, 0), (4, 0), (0, 4)]), Body("b", [(9, 0), (12, 0), (9, 5)]))

    with pytest.raises(InputError, match="body 'a' has it"):
        space.path((1, 1), (6, 1))
    with pytest.raises(InputError, match="meets body 'b' at"):
        space.shorten([(6, 1), (8, 1), (14, 1)])


@pytest.mark.parametrize("far", [(500, -9000), (9000, 70), (-3, 4)])
def test_path_does_not_depend_on_what_was_asked_before(far):
    """A goal far away makes the rectangle larger in which paths are searched."""
    scene = generate("stars", 5)
    fresh, asked = (Simulation(scene, tiling="lazy").space() for _ in range(2))
    spots = [(x, y) for x in range(-40, 41, 20) for y in range(-40, 41, 20)]
    free = [p for p in spots if fresh.locate(p).is_free]
    if asked.locate(far).is_free:
        asked.path(far, free[0])

    assert len(free) > 5
    for p, q in zip(free, free[3:], strict=False):
        assert asked.path(p, q) == fresh.path(p, q)
