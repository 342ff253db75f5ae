"""The incremental pseudo-triangulation of points: kinetic, static, by definition, by counts."""

import math
from collections import Counter
from random import Random

import pytest
from folding import every
from point_audits import points_at, run_and_audit, started, structure_of, tangents_by_slope

from exactpt import AuditError, Body, InputError, Scene, Simulation, Translation, first_contact
from exactpt.certificates.at_time import PredicatesAt
from exactpt.collision.driver import Driver
from exactpt.kernel.numbers import QQ
from exactpt.planar.halfedge import edge_key
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from exactpt.testing.scenes import POINTS, generate
from exactpt.tiling.incremental.fan import chain, fan_edges
from exactpt.tiling.incremental.incremental import IncrementalTiling
from exactpt.tiling.incremental.paths import SearchableTree
from exactpt.tiling.incremental.static import sweep_at
from exactpt.tiling.incremental.structure import UPPER
from exactpt.tiling.incremental.tree_repairs import TreeRepairs
from exactpt.tiling.start import plan_tiling, start_tiling

GENERIC = ("linear_points", "ballistic_points", "piecewise_points")


def at_rest(points):
    return Scene([Body(f"p{i}", [p]) for i, p in enumerate(points)])


def static(points):
    scene = at_rest(points)
    vertices = plan_tiling(scene, "incremental", scene.start).vertices
    return sweep_at(PredicatesAt(vertices, scene.start))


@pytest.mark.long("ballistic_points-few", "parabola_points-few", "piecewise_points-few")
@pytest.mark.parametrize(
    "count", [4, pytest.param(250, marks=pytest.mark.slow)], ids=["few", "many"]
)
@pytest.mark.parametrize("family", sorted(POINTS))
def test_kinetic_equals_static(family, count):
    """Paper, Lemma 3.1 and Theorem 3.2: 2,250 scenes in the slow run, no mismatch."""
    total = Counter()
    for seed in range(count):
        result = run_and_audit(generate(family, seed), by_slope=True)
        if result is None:
            total["touching at the start"] += 1
            continue
        kinetic, contact, gaps = result
        total["scenes"] += 1
        total["gaps"] += gaps
        total["contacts"] += contact is not None
        total["rebuilds"] += kinetic.stats.rebuilds
        total["batches"] += kinetic.stats.batches
        total.update({f"{kind} events": n for kind, n in kinetic.stats.events.items()})
    print(family, dict(total))  # noqa: T201 - shown with -s
    assert total["gaps"] >= count
    if family in GENERIC:
        assert total["rebuilds"] == 0


@pytest.mark.long("parabola_points-few")
@pytest.mark.parametrize(
    "count", [4, pytest.param(150, marks=pytest.mark.slow)], ids=["few", "many"]
)
@pytest.mark.parametrize("family", sorted(POINTS))
def test_first_contact_equals_reference(family, count):
    """Time, kind and every incidence."""
    for seed in range(count):
        scene = generate(family, seed)
        expected, found = reference.first_contact(scene), first_contact(scene, tiling="incremental")
        assert disagreement(expected, found) is None


@pytest.mark.long
@pytest.mark.parametrize("family", sorted(POINTS))
def test_filter_changes_nothing(family):
    """The event log is the same, and so is the end, with and without the float filters."""
    for seed in range(3):
        scene = generate(family, seed)
        logs = [
            [event.to_json() for event in Simulation(scene, exact_only=exact_only).run()]
            for exact_only in (False, True)
        ]
        assert logs[0] == logs[1]


@pytest.mark.long("ballistic_points-few", "parabola_points-few", "piecewise_points-few")
@pytest.mark.parametrize(
    "count", [3, pytest.param(60, marks=pytest.mark.slow)], ids=["few", "many"]
)
@pytest.mark.parametrize("family", sorted(POINTS))
def test_searchable_chains_equal_linked_ones(family, count):
    """Paper, Theorem 3.2: the same events, whichever way the chains are kept."""
    for seed in range(count):
        scene = generate(family, seed)
        results = [
            run_and_audit(scene, chains=chains) for chains in ("linked", "searchable", "auto")
        ]
        if results[0] is None:
            continue
        assert len({str(kinetic.stats.events) for kinetic, _, _ in results}) == 1
        assert len({str(structure_of(kinetic.structure)) for kinetic, _, _ in results}) == 1


@pytest.mark.long
def test_long_chains_are_searched():
    """Two points change places beside an arc: walked along it is n steps, searched log n."""
    n, swaps = 400, 100
    arc = [Body(f"a{y}", [(-y * y, 2 * y)]) for y in range(-n + 1, n, 2)]
    scene = Scene(
        [
            *arc,
            *(
                Body(name, keyframes=[(t, [(n * n + s * (-1) ** t, y)]) for t in range(swaps + 1)])
                for name, s, y in (("p", 1, 3 * n), ("q", -1, -3 * n))
            ),
        ],
        (0, swaps),
    )
    steps, ends = {}, set()
    for chains in ("linked", "searchable", "auto"):
        kinetic = started(scene, chains=chains)
        Driver(scene, kinetic).run(scene.end)
        trees = kinetic.structure.trees
        ends.add(str(structure_of(kinetic.structure)))
        assert kinetic.stats.events["x-order"] == swaps
        assert isinstance(trees[UPPER], SearchableTree) == (chains != "linked")
        steps[chains] = sum(tree.steps for tree in trees)
    assert len(ends) == 1
    assert steps["linked"] > n // 8 * swaps
    assert steps["searchable"] < n + 4 * math.log2(n) * swaps
    assert steps["searchable"] < steps["auto"] < steps["linked"]


@pytest.mark.long("parabola_points")
@pytest.mark.parametrize("family", sorted(POINTS))
def test_fan_changes(family):
    """Paper, section 3.4: the edges that are maintained are those of the trees, and are counted."""
    for seed in range(4):
        sets, counts = [], []

        def note(kinetic, sets=sets, counts=counts):
            sets.append({edge_key(*e) for e in fan_edges(kinetic.structure)})
            assert kinetic.fan.edges == sets[-1]
            counts.append((kinetic.fan.changes, kinetic.stats.total))

        run_and_audit(generate(family, seed), each=note, fan=True)
        steps = zip(sets, sets[1:], counts, counts[1:], strict=False)
        for before, after, (n, events), (m, more) in steps:
            if more == events + 1:
                assert m - n == len(before ^ after)
            else:  # changes at one time that cancel each other count too
                assert m - n >= len(before ^ after)


@pytest.mark.long
@pytest.mark.parametrize(
    ("velocity", "offset"),
    [
        ((1, 0), (-5, QQ(1, 2))),
        ((0, 1), (QQ(1, 2), QQ(-11, 2))),
        ((1, 1), (-5, QQ(-14, 3))),
        ((2, 1), (-10, QQ(-34, 7))),
    ],
)
def test_two_grids_pass_through_each_other(velocity, offset):
    """Two rigid 5 x 5 grids of points: whole columns change places at one time."""
    (dx, dy), (x, y) = velocity, offset
    cells = [(i, j) for i in range(5) for j in range(5)]
    bodies = [Body(f"s{i}.{j}", [(i, j)]) for i, j in cells]
    motion = Translation([0, dx], [0, dy])
    bodies += [Body(f"m{i}.{j}", [(i + x, j + y)], motion) for i, j in cells]
    kinetic, contact, gaps = run_and_audit(Scene(bodies, (0, 20)))
    assert contact is None
    assert gaps > 8
    assert kinetic.stats.total > 50
    assert kinetic.stats.rebuilds == 0


@pytest.mark.parametrize("chains", ["linked", "searchable"])
@pytest.mark.parametrize("family", ["point_grids_passing", "simultaneous_swaps", "crossing_lines"])
@pytest.mark.plain
@pytest.mark.parametrize("refused", ["_repair_one", "_sort_columns", "both"])
def test_whatever_way_out_is_refused_the_structure_is_the_static_one(
    monkeypatch, refused, family, chains
):
    """Exchanges one by one, columns as a whole, and the sweep anew lead to one structure."""
    rebuilds = 0
    for name in ("_repair_one", "_sort_columns"):
        if refused in (name, "both"):
            monkeypatch.setattr(TreeRepairs, name, lambda _: False)
    for seed in range(6):
        result = run_and_audit(generate(family, seed), chains=chains)
        rebuilds += result[0].stats.rebuilds if result else 0
    assert (rebuilds > 0) == (refused != "_sort_columns" or family == "simultaneous_swaps")


def test_a_column_that_passes_another_is_swept_not_exchanged_pair_by_pair():
    """12 points pass 12 others at one time: 144 pairs, and far fewer certificates."""
    column = [Body(f"s{j}", [(0, j)]) for j in range(12)]
    moving = [Body(f"m{j}", [(-3, j + QQ(1, 2))], Translation([0, 1])) for j in range(12)]
    ends = [Body("first", [(-9, 5)]), Body("last", [(9, 6)])]
    kinetic, contact, _ = run_and_audit(Scene([*column, *moving, *ends], (0, 6)))
    assert contact is None
    assert kinetic.stats.rebuilds == 0
    assert kinetic.stats.events["x-order"] < 60


@pytest.mark.parametrize("size", [3, 6, 50])
@pytest.mark.parametrize("count", [1, 2, 3, 8, 30])
def test_sweep_is_the_definition(size, count):
    """Paper, section 3.3: d(p) has the largest slope of all points left of p, u(p) the least."""
    for seed in range(20):
        rng = Random(f"{size} {count} {seed}")
        cells = rng.sample(range(size * size), min(count, size * size))
        points = [divmod(cell, size) for cell in cells]
        assert structure_of(static(points)) == tangents_by_slope(
            [(QQ(x), QQ(y)) for x, y in points]
        )


def test_counts():
    """n - 2 faces and 2n - 3 edges in general position; a certificate an edge and a neighbour."""
    for n in (2, 3, 10, 60):
        rng = Random(n)
        points = rng.sample([(x, (x * x * 7919) % 10007) for x in range(500)], n)
        structure = static(points)
        scene = at_rest(points)
        vertices = plan_tiling(scene, "incremental", scene.start).vertices
        mesh = IncrementalTiling.build(PredicatesAt(vertices, scene.start))
        mesh.audit()
        assert len(mesh.faces()) == n - 2
        assert len(mesh.diagonals()) == 2 * n - 3
        edges = [structure.certificate(side, b) for side in (0, 1) for b in range(n)]
        assert sum(c is not None for c in edges) == 2 * n - 4
        ranks = [[structure.rank[v] for v in c[:3]] for c in edges if c is not None]
        assert all(a < b < c for a, b, c in ranks)
        inside = [v for p in structure.order[2:] for v in chain(structure, p)[1:-1]]
        assert len(inside) == len(set(inside)), "a vertex is inside one chain at most"


def test_collinear_points_are_a_path():
    """Of points on one tangent the nearest counts; so nothing passes through a point."""
    for points in ([(i, 2 * i) for i in range(6)], [(3, -i) for i in range(6)]):
        order, u, d = structure_of(static(points))
        assert order == list(range(6))
        assert u == d == [-1, 0, 1, 2, 3, 4]


def test_auto_is_incremental_for_points():
    points = at_rest([(0, 0), (1, 1)])
    assert plan_tiling(points, "auto", points.start).name == "incremental"
    mixed = Scene([Body("p", [(0, 0)]), Body("s", [(1, 0), (2, 0)])])
    assert plan_tiling(mixed, "auto", mixed.start).name != "incremental"
    with pytest.raises(InputError, match=r"body 's': has 2 vertices: the incremental tiling"):
        start_tiling(mixed, "incremental", mixed.start)


@pytest.mark.parametrize("points", [[], [(1, 2)], [(1, 2), (1, 3)]])
def test_hardly_any_points(points):
    scene = at_rest(points)
    simulation = Simulation(scene)
    assert list(simulation.run()) == []
    tile = simulation.snapshot().to_json()
    assert (simulation.name, tile["faces"]) == ("incremental", [])
    assert len(tile["edges"]) == (len(points) == 2)


def test_audit_notices_a_wrong_tree():
    scene = at_rest([(0, 0), (1, 3), (2, 1), (3, 2)])
    kinetic = start_tiling(scene, "incremental", scene.start)
    kinetic.mesh_now(scene.start)
    upper = kinetic.structure.trees[0]
    assert upper.parent[3] == 1
    upper.detach(3)
    upper.append(2, 3)
    with pytest.raises(AuditError):
        kinetic.mesh_now(scene.start)


def test_level_points_touch_without_passing():
    """x touches, or is equal for ever: found though no order changes."""
    apex = Body("a", [{"x": [-1, 2, -1], "y": [0]}])  # reaches x = 0 at t = 1, and turns back
    for others in (
        [("b", (0, 0), Translation())],
        [("b", (0, 3), Translation()), ("c", (0, 0), Translation())],
        [("b", (0, -1), Translation()), ("c", (0, 1), Translation([0], [0, -1]))],
        [("b", (0, 1), Translation([0], [0, 1])), ("c", (0, 0), Translation())],
    ):
        scene = Scene([apex, *(Body(n, [p], m) for n, p, m in others)], (0, 3))
        expected = reference.first_contact(scene)
        assert expected is not None
        found = first_contact(scene, tiling="incremental")
        assert disagreement(expected, found) is None


def test_many_meet_at_one_time():
    """Two contacts of two points and one of three, among points that only are level."""
    speeds = [(-3, 0), (-1, 0), (2, 0), (-2, 5), (4, 5), (1, -7), (3, -7), (5, 2), (6, 9)]
    bodies = [Body(f"p{i}", [(-2 * a, b)], Translation([0, a])) for i, (a, b) in enumerate(speeds)]
    scene = Scene(bodies, (0, 5))
    found = first_contact(scene, tiling="incremental")
    assert found.time == 2
    assert len(found.pairs) == 3 + 1 + 1
    assert disagreement(reference.first_contact(scene), found) is None


def changes_of_tangents(scene):
    """How often u(p) and d(p) of each point change, by the trees; the tiling at the end."""
    kinetic = start_tiling(scene, "incremental", scene.start)
    before = [tree.parent[:] for tree in kinetic.structure.trees]
    counts = [[0] * len(parents) for parents in before]
    for _ in Driver(scene, kinetic).events(scene.end):
        for tree, parents, count in zip(kinetic.structure.trees, before, counts, strict=True):
            for p, z in enumerate(tree.parent):
                if z != parents[p]:
                    parents[p] = z
                    count[p] += 1
    return counts, kinetic


def spread(n, seed, degree=1):
    """Random points in general position, with motions of a degree."""
    rng = Random(f"{n} {seed} {degree}")

    def coordinate():
        return [rng.randint(-(10**6), 10**6) // (i + 1) for i in range(degree + 1)]

    bodies = [Body(f"p{i}", [{"x": coordinate(), "y": coordinate()}]) for i in range(n)]
    return Scene(bodies, (0, 3))


@pytest.mark.parametrize("degree", [1, 2])
def test_theorem_3_2(degree):
    """Every event moves one edge or two, takes O(1) certificates, and 3n - 5 are enough.

    The edges stay as they are only when two of the first three points change places.
    """
    for seed in range(4):
        scene = spread(24, seed, degree)
        kinetic = start_tiling(scene, "incremental", scene.start)
        n, made = len(scene.bodies), kinetic.certifier.made
        assert made == 3 * n - 5
        while (step := kinetic.advance(scene.end)) is not None:
            for event in step:
                assert len(event.removed) <= 2
                assert len(event.added) <= 2
                if not event.removed + event.added:
                    assert event.kind == "x-order"
                    first = kinetic.structure.order[:3]
                    assert {event.time.a, event.time.b} <= set(first)
        assert kinetic.certifier.made - made <= 8 * kinetic.stats.total
        assert kinetic.stats.most <= 3 * n - 5
        assert kinetic.stats.rebuilds == 0


def test_theorem_3_3():
    """u(p) changes as often as an envelope of n partial functions: lambda_4(n), nearly n.

    In linear motion a slope to p is a fraction of linear functions: two are equal twice at
    most, and each is defined until or from one time on.
    """
    for seed in range(3):
        scene = spread(40, seed)
        counts, kinetic = changes_of_tangents(scene)
        assert kinetic.stats.total > 200
        assert max(map(max, counts)) < 2 * len(scene.bodies)


def test_theorem_3_4():
    """The fan changes at most n^(4/3) lambda_s(n) times, here with the constant 1."""
    for seed in range(3):
        scene = spread(40, seed)
        kinetic = started(scene, fan=True)
        Driver(scene, kinetic).run(scene.end)
        assert kinetic.stats.total < kinetic.fan.changes < 40 ** (7 / 3)


def test_tangents_change_when_slopes_are_equal():
    """Paper, section 3.3: u(p) and d(p) are envelopes; they change at no other times."""
    for seed in range(3):
        scene = spread(9, seed)
        kinetic = start_tiling(scene, "incremental", scene.start)
        times = [float(scene.start)]
        while kinetic.advance(scene.end) is not None:
            times.append(float(kinetic.now))
        rng = Random(seed)
        for _ in range(40):
            i = rng.randrange(len(times) - 1)
            low, high = QQ(times[i]), QQ(times[i + 1])
            margin = (high - low) / 100
            early, late = low + margin, high - margin
            assert tangents_by_slope(points_at(scene, early)) == tangents_by_slope(
                points_at(scene, late)
            )


@every("factor", [QQ(10**40), QQ(1, 10**40), QQ(1, 3)])
@every("family", ["linear_points", "grid_points", "points_in_line"])
def test_scale_and_place_change_nothing(family, factor):
    """Far beyond doubles, or moved by a third: the same events."""
    for seed in range(3):
        scene = generate(family, seed)
        moved = [
            Body(
                body.name,
                [{"x": [c * factor for c in x], "y": [c * factor for c in y]}],
            )
            for body in scene.bodies
            for x, y in [coordinates(body)]
        ]
        runs = [
            [(event.kind, event.removed, event.added) for event in Simulation(each).run()]
            for each in (scene, Scene(moved, (scene.start, scene.end)))
        ]
        assert runs[0] == runs[1]


def coordinates(body):
    """The polynomials x and y of a point that translates."""
    track = body.exact_piece_after(QQ(0)).tracks[0]
    return (
        [QQ(c) / track.w[0] + QQ(1, 7) * (i == 0) for i, c in enumerate(f)] or [QQ(1, 7)]
        for f in (track.x, track.y)
    )
