"""The mixed tiling of bodies with holes and several parts: geodesics along each ring."""

from random import Random

import pytest
from folding import every

from exactpt import Body, Scene, Translation
from exactpt.certificates.at_time import PredicatesAt
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices
from exactpt.pairs.start import initial_touches
from exactpt.pseudotriangulation.audit import audit_angles
from exactpt.pseudotriangulation.mesh import FREE
from exactpt.testing.reference.space import components
from exactpt.testing.scenes import RINGS, generate
from exactpt.testing.scenes.shapes import hull
from exactpt.tiling.mixed.forest import Forest
from exactpt.tiling.mixed.geodesics import Geodesics
from exactpt.tiling.mixed.static import mixed_mesh
from exactpt.tiling.mixed.tree import ROOT, TOP
from exactpt.tiling.start import start_tiling
from tests.unit.tiling.test_mixed import free, shuffled

COUNTS = [6, pytest.param(100, marks=pytest.mark.slow)]


def instant_of(scene):
    return PredicatesAt(Vertices.of(scene.bodies, scene.start, scene.end), scene.start)


def instants(family, count):
    for seed in range(count):
        scene = generate(family, seed)
        if not initial_touches(scene)[1]:
            yield scene, instant_of(scene)


def room(hole, *bodies):
    """A box with a hole, and what is in it."""
    return Scene(
        [Body("room", [(0, 0), (40, 0), (40, 40), (0, 40)], holes=[hole]), *bodies], (0, 1)
    )


HOLE = [(1, 1), (39, 1), (39, 39), (1, 39)]


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("family", sorted(RINGS))
def test_each_node_has_one_face_and_f2_those_of_each_component(family, count):
    """2 c - 2 faces of F2 in a component with c outlines, none in a hole with nothing in it."""
    for scene, instant in instants(family, count):
        mesh = mixed_mesh(instant)
        mesh.audit()
        audit_angles(mesh, instant)
        nodes = []
        for face in mesh.faces():
            of_face = {mesh.node(h) for h in face}
            assert len(of_face) == 1
            nodes += of_face
        inner = [node for node in nodes if node >= 0]
        assert len(inner) == len(set(inner))
        assert not mesh.forest.leaves & set(inner)
        assert nodes.count(-1) == sum(
            max(0, 2 * len(outlines) - 2) for outlines in components(scene).values()
        )


def cycle_of(geodesics, mesh, tree):
    ring = [mesh.ring_edge[v] for v in tree.chain[:-1]]
    around = geodesics.around_contents if tree.is_hole else geodesics.from_leftmost
    return around(ring)


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("family", sorted(RINGS))
def test_geodesics_do_not_depend_on_the_triangulation(family, count):
    holes = 0
    for scene, instant in instants(family, count):
        rng = Random(scene.vertex_count)
        trees = [tree for rings in Forest(instant.vertices).bodies for tree in rings]
        meshes = [shuffled(instant, rng) for _ in range(2)]
        found = []
        for mesh in meshes:
            geodesics = Geodesics(instant, mesh, free(mesh))
            paths = []
            found.append(paths)
            for tree in trees:
                ring = [mesh.ring_edge[v] for v in tree.chain[:-1]]
                cycle = cycle_of(geodesics, mesh, tree)
                holes += bool(cycle) and tree.is_hole
                if cycle:
                    paths += [geodesics.path(cycle), geodesics.path(ring)]
                shape = tree.tree
                paths += [
                    geodesics.path(ring[shape.low[k] : shape.high[k]])
                    for k in range(ROOT + 1, len(shape))
                ]
        assert found[0] == found[1]
    assert holes or family == "walls"


def around(mesh, vertices, body, ring):
    """The positions along the unpinned cycle of a ring."""
    tree = mesh.forest.bodies[body][ring]
    instant = PredicatesAt(vertices, QQ(0))
    return [instant.position(v) for v in mesh.cycle(tree)]


@every("seed", range(8))
def test_around_all_that_is_in_a_wide_hole_leads_its_convex_hull(seed):
    """Clockwise, for the body of the hole is on the left of it."""
    rng = Random(seed)
    bodies = [
        Body(f"b{i}", hull([(x + rng.randint(0, 6), y + rng.randint(0, 6)) for _ in range(9)]))
        for i, (x, y) in enumerate([(4, 4), (20, 6), (10, 20), (25, 25)][: rng.randint(1, 4)])
    ]
    instant = instant_of(room(HOLE, *bodies))
    cycle = around(mixed_mesh(instant), instant.vertices, 0, 1)[::-1]
    expected = hull([p for b in bodies for p in b.exact_at(QQ(0))])
    first = cycle.index(expected[0])
    assert [*cycle[first:], *cycle[:first]] == expected


def test_the_cycle_bends_around_the_teeth_of_the_hole():
    hole = [(1, 1), (39, 1), (39, 39), (21, 39), (20, 10), (19, 39), (1, 39)]
    bodies = [Body("a", [(5, 30), (8, 30), (5, 33)]), Body("b", [(32, 30), (35, 30), (35, 33)])]
    instant = instant_of(room(hole, *bodies))
    cycle = around(mixed_mesh(instant), instant.vertices, 0, 1)
    first = cycle.index((5, 30))
    assert [*cycle[first:], *cycle[:first]] == [
        (5, 30), (5, 33), (8, 30), (20, 10), (32, 30), (35, 33), (35, 30), (20, 10),
    ]  # fmt: skip


def test_a_hole_with_nothing_in_it_has_neither_loop_nor_f2():
    instant = instant_of(room([(1, 1), (20, 5), (39, 1), (35, 20), (39, 39), (1, 39)]))
    mesh = mixed_mesh(instant)
    tree = mesh.forest.bodies[0][1]
    assert not any({tree.nodes[TOP], tree.nodes[ROOT]} & label for label in mesh.labels)
    assert [face for face in mesh.faces(FREE) if mesh.node(face[0]) < 0] == []


def toothed(teeth):
    """A hole with teeth on both sides of a corridor."""
    low = [p for i in range(teeth) for p in ((4 * i, -4), (4 * i + 2, -1))]
    high = [p for i in reversed(range(teeth)) for p in ((4 * i + 4, 2), (4 * i + 2, 5))]
    return [*low, (4 * teeth, -4), *high]


def test_the_certificates_do_not_depend_on_the_vertices_of_the_hole():
    """In the middle of a corridor with teeth on both sides, as long as the hole is."""
    made = set()
    for teeth in (8, 32, 128):
        outline = [(-2, -6), (4 * teeth + 2, -6), (4 * teeth + 2, 7), (-2, 7)]
        wall = Body("wall", outline, holes=[toothed(teeth)])
        scene = Scene([wall, Body("p", [(2 * teeth, 0)], Translation([0, "1/9"]))], (0, 1))
        made.add(start_tiling(scene, "mixed", QQ(0)).certifier.made)
    assert len(made) == 1
    assert made.pop() <= 15
