"""Queries in scenes with holes, by hand; the laws `space/*` have more."""

import pytest

from exactpt import Body, InputError, Scene, Simulation, Translation, UnreachableError

TILINGS = ("greedy", "mixed", "lazy")

FRAME = [(0, 0), (12, 0), (12, 12), (0, 12)]
HOLE = [(1, 1), (11, 1), (11, 11), (1, 11)]
ISLE = {"vertices": [(2, 2), (5, 2), (5, 5), (2, 5)], "holes": [[(3, 3), (4, 3), (4, 4), (3, 4)]]}

OUT, IN, IN_ISLE = (20, 6), (9, 3), ("7/2", "7/2")
"""A point in each of the three components of the free space."""


def scene(*, deforms=False):
    outline = [{"x": [x], "y": [y, "1/9" if deforms else 0]} for x, y in FRAME]
    frame = Body("frame", parts=[{"vertices": outline, "holes": [HOLE]}, ISLE])
    return Scene([frame, Body("wall", [(9, 5), (7, 9)]), Body("post", [(20, -1)])], (0, 3))


@pytest.fixture(params=TILINGS)
def space(request):
    made = scene(deforms=request.param == "lazy")
    return Simulation(made, tiling=request.param).space()


def test_places(space):
    assert all(space.locate(p).is_free for p in (IN, IN_ISLE, OUT))
    assert space.locate((9, "10/3")).kind == space.locate(("10/3", "7/2")).kind == "tile"
    assert space.locate((50, 50)).kind == "outside"
    for p in (("1/2", 6), ("5/2", "5/2"), (4, "9/2")):
        place = space.locate(p)
        assert (place.kind, place.body, place.is_free) == ("body", "frame", False)
    assert space.locate((11, 6)).edge == 5
    assert space.locate((1, 6)).edge == 7
    assert space.locate((3, 3)).vertex == 12


def test_rays_stay_in_their_hole(space):
    hit = space.ray_cast(IN, (1, 0))
    assert (hit.body, hit.edge, hit.at) == ("frame", 5, 2)
    assert space.ray_cast(IN_ISLE, (0, -1)).edge == 12
    assert space.ray_cast((6, 6), (1, 0)).body == "wall"
    assert space.ray_cast(OUT, (-1, 0)).edge == 1
    assert space.ray_cast(OUT, (1, 0)) is None
    assert space.is_free(IN, (9, 2))
    assert not space.is_free(IN, OUT)


def test_paths_within_a_hole(space):
    path = space.shortest_path((6, 6), (9, 8))
    assert path.bends in ((("wall", 0),), (("wall", 1),))
    assert space.path((6, 6), (9, 8)).length >= path.length
    around = space.shortest_path((2, "13/2"), ("13/2", 2))
    assert around.bends == (("frame", 10),)
    assert space.shorten([(6, 6), (6, 10), (9, 10), (9, 8)]).bends == (("wall", 1),)
    assert space.shortest_path((1, 1), (11, 1)).length == 10


@pytest.mark.parametrize(
    ("start", "goal"),
    [(OUT, IN), (IN, OUT), (IN, IN_ISLE), (IN_ISLE, OUT)],
)
def test_no_path_leads_out_of_a_hole(space, start, goal):
    for find in (space.path, space.shortest_path):
        with pytest.raises(UnreachableError, match=r"^no path leads from \(.*\) to \(.*\): "):
            find(start, goal)


def test_the_edges_of_a_hole_are_reached_from_inside_alone(space):
    assert space.shortest_path(IN, (11, 6)).bends == ()
    assert space.shortest_path(OUT, (12, 6)).length == 8
    for start, goal in ((OUT, (11, 6)), ((12, 6), (11, 6)), ((0, 0), (1, 1)), ((2, 2), (3, 3))):
        with pytest.raises(UnreachableError):
            space.shortest_path(start, goal)


def test_hulls_and_neighbours(space):
    assert space.hull() == [("frame", 0), ("post", 0), ("frame", 2), ("frame", 3)]
    assert space.relative_hull("wall") == [("wall", 0), ("wall", 1)]
    with pytest.raises(InputError, match=r"^body 'frame' has several parts: no loop"):
        space.relative_hull("frame")
    assert space.neighbours("frame") == ["wall", "post"]
    assert space.neighbours("wall") == ["frame"]


def test_the_loop_around_a_body_with_holes_leads_around_its_outline():
    bodies = [Body("frame", FRAME, holes=[HOLE]), Body("in", [(5, 5)]), Body("out", [(6, 20)])]
    made = Scene(bodies, (0, 1))
    for tiling in TILINGS:
        space = Simulation(made, tiling=tiling).space()
        assert space.relative_hull("frame") == [("frame", v) for v in range(4)]
        assert space.relative_hull("in") == [("in", 0)]


def test_a_simulation_tells_when_there_is_no_path():
    ball = Body("ball", [(6, 6), (7, 6), (6, 7)], Translation([0, 1]))
    simulation = Simulation(Scene([Body("frame", FRAME, holes=[HOLE]), ball], (0, 9)))
    list(simulation.run(until=2))
    assert simulation.path((2, 2), (10, 10)).points[-1] == (10, 10)
    with pytest.raises(InputError, match=r"no path leads from \(2, 2\) to \(20, 2\)"):
        simulation.shortest_path((2, 2), (20, 2))
