"""The mixed tiling: labels, counts, and what they promise (paper, section 5)."""

import math
from random import Random

import pytest

from exactpt import Body, Scene, Simulation, Translation
from exactpt.certificates.at_time import PredicatesAt
from exactpt.geometry.predicates import orientation
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices
from exactpt.pairs.start import initial_touches
from exactpt.pseudotriangulation.audit import audit_angles
from exactpt.pseudotriangulation.build import build_mesh
from exactpt.pseudotriangulation.flip import flip
from exactpt.pseudotriangulation.mesh import FREE
from exactpt.pseudotriangulation.plane_sweep import Sweep, body_edges
from exactpt.pseudotriangulation.shadow import shadow
from exactpt.testing.scenes import FAMILIES, generate
from exactpt.tiling.mixed.geodesics import Geodesics
from exactpt.tiling.mixed.labels import Forest
from exactpt.tiling.mixed.static import mixed_mesh
from exactpt.tiling.start import start_tiling
from fuzz.general import lanes

COUNTS = [2, pytest.param(60, marks=pytest.mark.slow)]


def instants(family, count):
    for seed in range(count):
        scene = generate(family, seed)
        if not initial_touches(scene)[1]:
            yield seed, PredicatesAt(Vertices.of(scene.bodies, scene.start, scene.end), scene.start)


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_labels_are_paths_and_each_node_has_one_face(family, count):
    """Theory: the facts about labels; 2 k - 2 faces in F2, one for each other node at most."""
    for _, instant in instants(family, count):
        mesh = mixed_mesh(instant)
        mesh.audit()
        audit_angles(mesh, instant)
        assert all(mesh.forest.is_path(label) for label in mesh.labels)
        nodes = []
        for face in mesh.faces():
            of_face = {mesh.forest.node(mesh.labels[h], mesh.labels[h ^ 1]) for h in face}
            assert len(of_face) == 1
            nodes += of_face
        inner = [node for node in nodes if node >= 0]
        assert len(inner) == len(set(inner))
        assert not mesh.forest.leaves & set(inner)
        assert nodes.count(-1) == max(0, 2 * len(instant.vertices.bodies) - 2)


def shuffled(instant, rng):
    """A triangulation of the free space, some of its diagonals flipped at random."""
    mesh = build_mesh(instant, Sweep(instant, body_edges(instant), triangulate=True).run())
    for h in mesh.flippable():
        far = {mesh.map.target(mesh.map.following[g]) for g in (h, h ^ 1)}
        if rng.random() < 0.5 and len(far) == 2 and convex(instant, *mesh.ends(h), *far):
            visits = shadow(mesh, h, instant)
            assert {mesh.map.origin[g] for g in visits} == far
            flip(mesh, h, visits, instant)
    return mesh


def free(mesh):
    """The half-edges of the tiles in free space."""
    return {h for h in mesh.map.half_edges() if mesh.region[h] == FREE}


def convex(instant, a, b, c, d):
    """Whether the segments ab and cd cross."""
    sign = instant.orientation
    return sign(a, b, c) * sign(a, b, d) < 0 and sign(c, d, a) * sign(c, d, b) < 0


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("family", ["stars", "combs", "spirals", "letters", "clamps", "chains"])
def test_geodesics_do_not_depend_on_the_triangulation(family, count):
    for seed, instant in instants(family, count):
        rng = Random(seed)
        forest = Forest(instant.vertices)
        meshes = [shuffled(instant, rng) for _ in range(2)]
        for ((tree, _, chain, _),) in forest.bodies:
            for node in range(1, len(tree)):
                part = chain[tree.low[node] : tree.high[node]]
                first, second = (
                    Geodesics(instant, mesh, free(mesh)).path([mesh.ring_edge[v] for v in part])
                    for mesh in meshes
                )
                assert first == second


def crosses(p, q, a, b):
    return (
        orientation(p, q, a) * orientation(p, q, b) < 0
        and orientation(a, b, p) * orientation(a, b, q) < 0
    )


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("family", ["stars", "combs", "spirals", "letters"])
def test_a_free_segment_crosses_few_edges_of_f1(family, count):
    """Paper, Lemma 5.4: at most 2 (ceil(log2 n) + 2), n the size of the largest polygon."""
    tried = 0
    for seed, instant in instants(family, count):
        rng = Random(seed)
        mesh = mixed_mesh(instant)
        at = [instant.position(v.id) for v in instant.vertices.all]
        m = mesh.map
        solid = [(at[v], at[m.target(mesh.ring_edge[v])]) for v in range(len(at))]
        bridges = [
            tuple(at[v] for v in mesh.ends(h))
            for h in mesh.diagonals()
            if mesh.region[h] == FREE and (mesh.labels[h] or mesh.labels[h ^ 1])
        ]
        most = max(len(body.ring) for body in instant.vertices.bodies)
        bound = 2 * (math.ceil(math.log2(most)) + 2)
        for _ in range(100):
            p, q = (random_free_point(rng, instant) for _ in range(2))
            if p != q and not any(crosses(p, q, *edge) for edge in solid):
                tried += 1
                assert sum(crosses(p, q, *edge) for edge in bridges) <= bound
    assert tried


def random_free_point(rng, instant):
    """A point near a vertex, on its free side or not: a segment into a body crosses its edge."""
    x, y = instant.position(rng.randrange(len(instant.vertices.all)))
    return x + QQ(rng.randint(-300, 300), 97), y + QQ(rng.randint(-300, 300), 101)


def comb(teeth, x, y, *, down=False):
    lower = [(-2, -2), (8 * teeth, -2), (8 * teeth, 0)]
    for i in reversed(range(teeth)):
        lower += [(8 * i + 2, 0), (8 * i + 2, 9), (8 * i, 9), (8 * i, 0)]
    lower.append((-2, 0))
    return [(a + x, y - b if down else y + b) for a, b in (reversed(lower) if down else lower)]


def test_far_apart_the_certificates_do_not_depend_on_the_vertices():
    """Paper, Theorem 5.6: O(kappa log n) certificates, and kappa is constant here."""
    made = set()
    for teeth in (4, 16, 64):
        far = 10_000 * teeth
        bodies = [
            Body("a", comb(teeth, 0, 0)),
            Body("b", comb(teeth, far, 11, down=True), Translation([0, "1/7"], [0, "1/5"])),
        ]
        kinetic = start_tiling(Scene(bodies, (0, 8)), "mixed", QQ(0))
        made.add(kinetic.certifier.made)
    assert len(made) == 1
    assert made.pop() <= 30


def bridges(mesh, vertices):
    """How many edges join two bodies: in F1, of those the ones next to F2, and within F2."""
    body, labels = [v.body for v in vertices.all], mesh.labels
    found = [0, 0, 0]
    for h in mesh.diagonals():
        u, v = mesh.ends(h)
        if mesh.region[h] == FREE and body[u] != body[v]:
            nodes = (
                mesh.forest.node(labels[h], labels[h ^ 1]),
                mesh.forest.node(labels[h ^ 1], labels[h]),
            )
            labelled = bool(labels[h] or labels[h ^ 1])
            found[0] += labelled
            found[1] += labelled and -1 in nodes
            found[2] += not labelled
    return found


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_around_f2_there_are_few_bridges(family, count):
    """Paper, Lemma 5.2: O(k) bridge edges on the border of F2, and (Corollary 5.3) within."""
    for _, instant in instants(family, count):
        k = len(instant.vertices.bodies)
        _, border, within = bridges(mixed_mesh(instant), instant.vertices)
        assert border <= 6 * k
        assert within <= 3 * k


def hook(size, x, gap):
    """A ring with a gap of 40 degrees around an angle: a polygon of twice ``size`` vertices."""
    turns = [math.radians(gap + 20 + 320 * i / (size - 1)) for i in range(size)]
    arcs = [(10_000, turns), (8_000, turns[::-1])]
    return [(x + round(r * math.cos(a)), round(r * math.sin(a))) for r, arc in arcs for a in arc]


def sizes_of(first, second):
    """The bridges of the mixed tiling of two bodies, the second one moving; its certificates."""
    bodies = [Body("a", first), Body("b", second, Translation([0, "1/7"], [0, "1/5"]))]
    kinetic = start_tiling(Scene(bodies, (0, 8)), "mixed", QQ(0))
    inner, _, outer = bridges(kinetic.mesh, kinetic.vertices)
    assert len(kinetic.mesh.diagonals()) <= 2 * (len(first) + len(second))
    assert kinetic.certifier.made <= 4 * (inner + outer) + 10 * 2
    return inner


@pytest.mark.long
def test_bridges_follow_what_separates_the_bodies():
    """Paper, Lemma 5.5, Theorems 5.6 and 5.7, on bodies whose separators are known.

    Two hooks, each with its end within the other, are kept apart by five links, however
    many vertices they have; two combs whose teeth mesh, by four links a tooth.
    """
    for size in (8, 32, 128, 512):
        found = sizes_of(hook(size, 0, 60), hook(size, 9_000, 240))
        assert 5 <= found <= 5 + math.log2(size)
        assert sizes_of(hook(size, 0, 60), hook(size, 90_000, 240)) == 0
    for teeth in (4, 16, 64):
        found = sizes_of(comb(teeth, 0, 0), comb(teeth, 4, 11, down=True))
        assert 3 * teeth <= found <= 4 * teeth


@pytest.mark.long
def test_an_event_takes_few_certificates():
    """Of convex bodies in lanes, at most three times as many as in the greedy tiling."""
    rates = []
    for tiling in ("greedy", "mixed"):
        simulation = Simulation(lanes("decimals", 1, bodies=100), tiling=tiling)
        before = simulation.stats["certificates"]
        list(simulation.run())
        stats = simulation.stats
        rates.append((stats["certificates"] - before) / stats["events"])

    assert rates[1] < 3 * rates[0]


@pytest.mark.long
def test_certificates_that_fail_together_are_not_compared_exactly(request):
    """Of convex bodies in lanes: the angle at a diagonal, and the tangency of its shadow."""
    if request.config.getoption("--exact-only"):
        pytest.skip("is about what the filters decide")
    simulation = Simulation(lanes("decimals", 1, bodies=100), tiling="mixed")
    list(simulation.run())

    assert simulation.stats["batches"] > 50
    assert simulation.stats["exact"] < 5
