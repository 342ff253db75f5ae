"""The incremental pseudo-triangulation of points: kinetic, static, by definition, by counts."""

from collections import Counter
from random import Random

import pytest
from point_audits import run_and_audit, structure_of, tangents_by_slope

from exactpt.collision.allpairs import first_contact_allpairs
from exactpt.collision.detector import first_contact
from exactpt.collision.tilings import plan_tiling, start_tiling
from exactpt.errors import AuditError, InputError
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.scene.generate import POINTS, generate
from exactpt.scene.scene import Scene
from exactpt.simulation.simulation import Simulation
from exactpt.tiling.incremental.fan import chain, fan_edges
from exactpt.tiling.incremental.incremental import IncrementalTiling
from exactpt.tiling.incremental.static import sweep_at
from exactpt.tiling.instant import Instant

GENERIC = ("linear_points", "ballistic_points", "piecewise_points")


def at_rest(points):
    return Scene([Body(f"p{i}", [p]) for i, p in enumerate(points)])


def static(points):
    scene = at_rest(points)
    vertices = IncrementalTiling.vertices_of(scene.bodies, scene.start, scene.end)
    return sweep_at(Instant(vertices, scene.start))


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


@pytest.mark.parametrize(
    "count", [4, pytest.param(150, marks=pytest.mark.slow)], ids=["few", "many"]
)
@pytest.mark.parametrize("family", sorted(POINTS))
def test_first_contact_equals_reference(family, count):
    """Time, kind and every incidence."""
    for seed in range(count):
        scene = generate(family, seed)
        expected, found = first_contact_allpairs(scene), first_contact(scene, tiling="incremental")
        assert (found is None) == (expected is None)
        if expected is not None:
            assert found.to_json() == expected.to_json()


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


@pytest.mark.parametrize("family", sorted(POINTS))
def test_fan_changes(family):
    """Paper, section 3.4: what is counted is how the set of edges changes."""
    for seed in range(4):
        sets, counts = [], []

        def note(kinetic, sets=sets, counts=counts):
            sets.append({frozenset(e) for e in fan_edges(kinetic.structure)})
            counts.append((kinetic.stats.fan, kinetic.stats.total))

        run_and_audit(generate(family, seed), each=note, fan=True)
        steps = zip(sets, sets[1:], counts, counts[1:], strict=False)
        for before, after, (n, events), (m, more) in steps:
            if more == events + 1:
                assert m - n == len(before ^ after)
            else:  # changes at one time that cancel each other count too
                assert m - n >= len(before ^ after)


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
        vertices = IncrementalTiling.vertices_of(scene.bodies, scene.start, scene.end)
        mesh = IncrementalTiling.mesh_at(Instant(vertices, scene.start))
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
        expected = first_contact_allpairs(scene)
        assert expected is not None
        found = first_contact(scene, tiling="incremental")
        assert found.to_json() == expected.to_json()


def test_many_meet_at_one_time():
    """Two contacts of two points and one of three, among points that only are level."""
    speeds = [(-3, 0), (-1, 0), (2, 0), (-2, 5), (4, 5), (1, -7), (3, -7), (5, 2), (6, 9)]
    bodies = [Body(f"p{i}", [(-2 * a, b)], Translation([0, a])) for i, (a, b) in enumerate(speeds)]
    scene = Scene(bodies, (0, 5))
    found = first_contact(scene, tiling="incremental")
    assert found.time == 2
    assert len(found.pairs) == 3 + 1 + 1
    assert found.to_json() == first_contact_allpairs(scene).to_json()
