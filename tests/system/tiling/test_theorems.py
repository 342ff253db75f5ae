"""What the paper proves of the sizes of tilings and the numbers of their certificates.

Laws compare each tiling with its definition; here are counts, in scenes of which the paper, or
a figure, tells what they are.
"""

import math
from itertools import pairwise
from random import Random

import pytest

from benchmarks.statics import swept
from exactpt import Body, Scene, Simulation, Translation
from exactpt.testing.reference.greedy import ConvexBodies
from exactpt.testing.scenes import generate
from fuzz.general import lanes

# Convex bodies (paper, section 4)


def convex_bodies(rng, count):
    """Triangles and points, one in each of some columns, in general position."""
    bodies = []
    for i in range(count):
        x, y = 20 * i + rng.randint(0, 5), rng.randint(-30, 30)
        triangle = [(x, y), (x + rng.randint(3, 9), y + rng.randint(-2, 2)), (x + 2, y + 7)]
        bodies.append(triangle[: rng.choice([1, 3, 3])])
    return bodies


@pytest.mark.parametrize("seed", range(8))
def test_greedy_bitangents_have_the_left_to_right_property(seed):
    """Lemma 4.1: s is taken exactly if theta(s) is less than that of each free s' it crosses."""
    defined = ConvexBodies(convex_bodies(Random(seed), 5))
    free, chosen = defined.bitangents(), set(defined.greedy())

    for s in free:
        is_least = all(defined.theta_order(s, t) < 0 for t in free if defined.crosses(s, t))
        assert is_least == (s in chosen)


def round_polygon(n, x, y):
    angles = [2 * math.pi * k / n for k in range(n)]
    return [(x + 4 * math.cos(a), y + 4 * math.sin(a)) for a in angles]


def test_decisions_of_the_sweep_grow_with_the_square_of_the_logarithm():
    """Of 64 and of 2,048 vertices a body: 32 times as many, if it walked along them."""
    few, many = (
        swept([Body(str(i), round_polygon(n, 11 * i, 3 * i % 7)) for i in range(9)])
        for n in (64, 2048)
    )

    assert few.diagonals == many.diagonals == 3 * 9 - 3
    assert many.decisions < 4 * few.decisions


# Points (paper, section 3)


def spread(n, seed, degree=1):
    """Random points in general position, with motions of a degree."""
    rng = Random(f"{n} {seed} {degree}")

    def coordinate():
        return [rng.randint(-(10**6), 10**6) // (i + 1) for i in range(degree + 1)]

    bodies = [Body(f"p{i}", [{"x": coordinate(), "y": coordinate()}]) for i in range(n)]
    return Scene(bodies, (0, 3))


@pytest.mark.parametrize("degree", [1, 2])
@pytest.mark.parametrize("seed", range(3))
def test_events_of_points_change_few_edges_and_certificates(seed, degree):
    """Theorem 3.2: an edge or two an event, O(1) certificates, and 3 n - 5 of them are enough.

    The edges stay as they are only when two of the first three points change places.
    """
    n = 24
    run = Simulation(spread(n, seed, degree))
    at_start = run.stats["certificates"]
    assert at_start == 3 * n - 5

    for event in run.run():
        assert len(event.removed) <= 2
        assert len(event.added) <= 2
        assert event.removed or event.added or event.kind == "x-order"

    assert run.stats["certificates"] - at_start <= 8 * run.stats["events"]
    assert run.stats["most_pending"] <= 3 * n - 5
    assert run.stats["rebuilds"] == 0


@pytest.mark.parametrize("seed", range(3))
def test_fan_changes_more_often_than_the_tiling_and_within_its_bound(seed):
    """Theorem 3.4: at most n^(4/3) lambda_s(n) times, here with the constant 1."""
    n = 40
    run = Simulation(spread(n, seed), fan=True)
    run.run_to_contact()

    assert run.stats["events"] < run.stats["fan_changes"] < n ** (7 / 3)


@pytest.mark.parametrize(
    ("velocity", "offset"),
    [
        ((1, 0), (-5, "1/2")),
        ((0, 1), ("1/2", "-11/2")),
        ((1, 1), (-5, "-14/3")),
        ((2, 1), (-10, "-34/7")),
    ],
)
def test_two_grids_of_points_pass_without_a_new_sweep(velocity, offset):
    """Whole columns change places at one time; the points of a column are swept again alone."""
    cells = [(i, j) for i in range(5) for j in range(5)]
    motion = Translation([offset[0], velocity[0]], [offset[1], velocity[1]])
    bodies = [Body(f"s{i}.{j}", [(i, j)]) for i, j in cells]
    bodies += [Body(f"m{i}.{j}", [(i, j)], motion) for i, j in cells]
    run = Simulation(Scene(bodies, (0, 20)))

    assert run.run_to_contact() is None
    assert run.stats["events"] > 50
    assert run.stats["rebuilds"] == 0


def test_columns_that_pass_are_swept_not_exchanged_pair_by_pair():
    """12 points pass 12 others at one time: 144 pairs, and far fewer events."""
    column = [Body(f"s{j}", [(0, j)]) for j in range(12)]
    moving = [Body(f"m{j}", [(-3, j)], Translation([0, 1], ["1/2"])) for j in range(12)]
    ends = [Body("first", [(-9, 5)]), Body("last", [(9, 6)])]
    run = Simulation(Scene([*column, *moving, *ends], (0, 6)))

    assert run.run_to_contact() is None
    assert run.stats["rebuilds"] == 0
    assert run.stats["by_kind"]["x-order"] < 60


# Bodies of any shape (paper, section 5)


def comb(teeth, x, y, *, down=False):
    lower = [(-2, -2), (8 * teeth, -2), (8 * teeth, 0)]
    for i in reversed(range(teeth)):
        lower += [(8 * i + 2, 0), (8 * i + 2, 9), (8 * i, 9), (8 * i, 0)]
    lower.append((-2, 0))
    return [(a + x, y - b if down else y + b) for a, b in (reversed(lower) if down else lower)]


def hook(size, x, gap):
    """A ring with a gap of 40 degrees around an angle: a polygon of twice ``size`` vertices."""
    turns = [math.radians(gap + 20 + 320 * i / (size - 1)) for i in range(size)]
    arcs = [(10_000, turns), (8_000, turns[::-1])]
    return [(x + round(r * math.cos(a)), round(r * math.sin(a))) for r, arc in arcs for a in arc]


def mixed(first, second):
    """The mixed tiling of two bodies at the start, the second one moving."""
    bodies = [Body("a", first), Body("b", second, Translation([0, "1/7"], [0, "1/5"]))]
    return Simulation(Scene(bodies, (0, 8)), tiling="mixed")


def bridges_of_hulls(run):
    """The number of edges that join two bodies and are a side of a face in a relative hull."""
    tiling = run.tiling
    inner = {
        frozenset(side)
        for face in tiling.faces
        if face.region == "F1"
        for side in pairwise([*face.nodes, face.nodes[0]])
    }
    edges = [edge for edge in tiling.diagonals if frozenset((edge.u, edge.v)) in inner]
    return sum(tiling.nodes[e.u].body != tiling.nodes[e.v].body for e in edges)


def test_certificates_of_bodies_far_apart_do_not_depend_on_their_vertices():
    """Theorem 5.6: O(kappa log n), and the separator of two combs far apart is constant."""
    made = {
        mixed(comb(teeth, 0, 0), comb(teeth, 10_000 * teeth, 11, down=True)).stats["certificates"]
        for teeth in (4, 16, 64)
    }
    assert len(made) == 1
    assert made.pop() <= 30


def test_certificates_in_a_corridor_do_not_depend_on_its_length():
    """A point in the middle of a corridor with teeth on both sides."""
    made = set()
    for teeth in (8, 32, 128):
        outline = [(-2, -6), (4 * teeth + 2, -6), (4 * teeth + 2, 7), (-2, 7)]
        low = [p for i in range(teeth) for p in ((4 * i, -4), (4 * i + 2, -1))]
        high = [p for i in reversed(range(teeth)) for p in ((4 * i + 4, 2), (4 * i + 2, 5))]
        wall = Body("wall", outline, holes=[[*low, (4 * teeth, -4), *high]])
        point = Body("p", [(2 * teeth, 0)], Translation([0, "1/9"]))
        made.add(Simulation(Scene([wall, point]), tiling="mixed").stats["certificates"])
    assert len(made) == 1
    assert made.pop() <= 15


@pytest.mark.parametrize("size", [8, 32, 128])
def test_hooks_in_each_other_are_kept_apart_by_five_links(size):
    """Lemma 5.5, Theorem 5.7: so many bridges, and the logarithm of the vertices at most."""
    hooked = mixed(hook(size, 0, 60), hook(size, 9_000, 240))
    apart = mixed(hook(size, 0, 60), hook(size, 90_000, 240))

    assert 5 <= bridges_of_hulls(hooked) <= 5 + math.log2(size)
    assert bridges_of_hulls(apart) == 0


@pytest.mark.parametrize("teeth", [4, 16, 64])
def test_combs_that_mesh_are_kept_apart_by_four_links_a_tooth(teeth):
    """Lemma 5.5, Theorem 5.7."""
    meshed = mixed(comb(teeth, 0, 0), comb(teeth, 4, 11, down=True))

    assert 3 * teeth <= bridges_of_hulls(meshed) <= 4 * teeth


def test_loop_in_a_hole_bends_around_its_tooth():
    """The shortest loop around what is in a hole: the sides of faces in and out of hulls."""
    hole = [(1, 1), (39, 1), (39, 39), (21, 39), (20, 10), (19, 39), (1, 39)]
    room = Body("room", [(0, 0), (40, 0), (40, 40), (0, 40)], holes=[hole])
    bodies = [Body("a", [(5, 30), (8, 30), (5, 33)]), Body("b", [(32, 30), (35, 30), (35, 33)])]
    tiling = Simulation(Scene([room, *bodies]), tiling="mixed").tiling
    regions = {}
    for face in tiling.faces:
        for side in pairwise([*face.nodes, face.nodes[0]]):
            regions.setdefault(frozenset(side), set()).add(face.region)

    loop = {
        frozenset((tiling.nodes[v].x, tiling.nodes[v].y) for v in side)
        for side, beside in regions.items()
        if beside == {"F1", "F2"}
    }
    # The loop also goes along a, over (5, 33), and along b, over (35, 33): sides of bodies, beside
    # which there is one face.
    assert loop == {
        frozenset(((8, 30), (20, 10))),
        frozenset(((20, 10), (32, 30))),
        frozenset(((35, 30), (20, 10))),
        frozenset(((20, 10), (5, 30))),
    }


# Events


@pytest.mark.parametrize("seed", [1])
def test_events_of_the_mixed_tiling_take_few_certificates(seed):
    """Of convex bodies in lanes: at most three times as many as in the greedy tiling."""
    rates = []
    for tiling in ("greedy", "mixed"):
        run = Simulation(lanes("decimals", seed, bodies=100), tiling=tiling)
        at_start = run.stats["certificates"]
        run.run_to_contact()
        rates.append((run.stats["certificates"] - at_start) / run.stats["events"])

    assert rates[1] < 3 * rates[0]


def test_certificates_that_fail_together_are_not_compared_exactly(request):
    """Of convex bodies in lanes: the angle at a diagonal, and the tangency of its shadow."""
    if request.config.getoption("--exact-only"):
        pytest.skip("is about what the filters decide")
    run = Simulation(lanes("decimals", 1, bodies=100), tiling="mixed")
    run.run_to_contact()

    assert run.stats["batches"] > 50
    assert run.stats["exact"] < 5


@pytest.mark.parametrize("seed, flips", [(0, 0), (4, 2), (7, 2), (36, 3)])
def test_pairs_exchanged_on_one_vertical_line_need_no_rebuild(seed, flips):
    """Rings in step: a diagonal that has to give way is not there yet (4, 36), or a bitangent
    that enters finds none to replace (0, 7, 36). What the check flips is the static tiling.
    """
    run = Simulation(generate("concentric", seed), tiling="greedy")
    run.run_to_contact()

    assert run.stats["rebuilds"] == 0
    assert run.stats["flips"] == flips
