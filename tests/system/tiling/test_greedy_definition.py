"""The greedy tiling against its definition; of convex bodies it is one, in two ways."""

from random import Random

import pytest

from exactpt.certificates.certifier import Certifier
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices
from exactpt.pairs.start import initial_touches
from exactpt.simulation.tile import tile_at
from exactpt.testing.audits import audit_at
from exactpt.testing.reference.greedy import ConvexBodies as Oracle
from exactpt.testing.scenes import CONVEX, FAMILIES, generate
from exactpt.tiling import catalogue
from exactpt.tiling.events import ContactFound, Stats
from exactpt.tiling.start import make, plan_tiling
from fuzz.laws.kept import kept, names
from fuzz.witnesses import tilings_of

SOME = ("convex", "mixed_shapes", "ballistic", "turning", "deforming")


def generic_scenes(count):
    """Scenes and rational times without contact so far, at which nothing is collinear."""
    rng = Random(5)
    found = 0
    seed = 0
    while found < count:
        seed += 1
        scene = generate(SOME[seed % len(SOME)], seed)
        at = scene.start + (scene.end - scene.start) * QQ(rng.randint(1, 999), 9973)
        try:
            snapshot = tile_at(scene, at)
        except ValueError:
            continue  # a contact before that time
        bodies = []
        for body in scene.bodies:
            points = body.at(at)
            area = sum(
                p[0] * q[1] - p[1] * q[0]
                for p, q in zip(points, points[1:] + points[:1], strict=True)
            )
            order = list(range(len(points)))
            bodies.append(order[::-1] if area < 0 else order)
        oracle = Oracle(
            [[b.at(at)[v] for v in o] for b, o in zip(scene.bodies, bodies, strict=True)]
        )
        yield scene, snapshot, oracle, bodies
        found += 1


def diagonals(scene, snapshot):
    index = {body.name: i for i, body in enumerate(scene.bodies)}
    nodes = [(index[n.body], n.vertex) for n in snapshot.nodes]
    return {tuple(sorted([nodes[e.u], nodes[e.v]])) for e in snapshot.diagonals}


@pytest.fixture(
    scope="module",
    params=[
        10,
        pytest.param(300, marks=[pytest.mark.slow, pytest.mark.xdist_group("greedy definition")]),
    ],
)
def scenes(request):
    return list(generic_scenes(request.param))


def test_the_sweep_finds_the_greedy_bitangents(scenes):
    """Paper, section 4.1: sorted by theta, each is taken that crosses none taken before."""
    for scene, snapshot, oracle, orders in scenes:
        expected = {
            tuple(sorted((i, orders[i][a]) for i, a in edge))
            for edge in oracle.edges(oracle.greedy())
        }

        assert diagonals(scene, snapshot) == expected


def test_lemma_4_1_left_to_right_property(scenes):
    """Paper, Lemma 4.1: s is in G iff theta(s) is less than that of every free s' it crosses."""
    for _, _, oracle, _ in scenes[:60]:
        free, chosen = oracle.bitangents(), set(oracle.greedy())
        for s in free:
            smallest = all(oracle.theta_order(s, t) < 0 for t in free if oracle.crosses(s, t))

            assert smallest == (s in chosen)


def test_counts(scenes):
    """3k - 3 labelled bitangents; without labels one less a point; k + m - 2 faces (Lemma 2.1)."""
    for scene, snapshot, oracle, _ in scenes:
        k = len(scene.bodies)
        points = sum(body.size == 1 for body in scene.bodies)
        if k > 1:
            assert len(oracle.greedy()) == 3 * k - 3
            assert len(snapshot.diagonals) == 3 * k - 3 - points
            assert len(snapshot.faces) == k + (k - points) - 2
        assert all(len(face.corners) == 3 for face in snapshot.faces)


# The greedy tiling of convex bodies is one, by the vertical decomposition and by shadow edges


def in_greedy_order(scene, *, convex):
    """The kinetic tiling of a scene, by the vertical decomposition if ``convex``."""
    vertices = Vertices.of(scene.bodies, scene.start, scene.exact_end)
    certifier = Certifier(vertices, scene.exact_start, scene.exact_end, exact_only=False)
    tiling = make(catalogue.find("greedy", convex=convex), vertices, certifier, Stats())
    tiling.begin(scene.exact_start)
    return tiling


def ends_of_diagonals(tiling):
    mesh = tiling.mesh_after()
    return sorted(tuple(sorted(mesh.ends(h))) for h in mesh.diagonals())


def following(tiling, scene):
    """The time of the next event, or the end."""
    return tiling.next_number() or AlgebraicNumber(scene.exact_end)


def advance_to(tiling, scene, time):
    """Process all events up to a time; whether there is a contact then."""
    try:
        while following(tiling, scene).compare(time) <= 0:
            if tiling.advance(scene.exact_end) is None:
                return False
    except ContactFound:
        return True
    return False


def compare(scene):
    """Run both up to the contact or the end.

    Returns:
        The number of intervals between events in which the tilings were compared.
    """
    walls, shadows = in_greedy_order(scene, convex=True), in_greedy_order(scene, convex=False)
    compared, end = 0, AlgebraicNumber(scene.exact_end)
    while True:
        now = max(walls.now, shadows.now)
        until = min(following(walls, scene), following(shadows, scene))
        if now < until:
            assert ends_of_diagonals(walls) == ends_of_diagonals(shadows)
            audit_at(shadows, rational_between(now, until))
            compared += 1
        if until == end:
            return compared
        found = advance_to(walls, scene, until), advance_to(shadows, scene, until)
        assert found[0] == found[1]
        if found[0]:
            return compared


def are_convex(scene):
    """Whether a scene, which is not of points alone, is for the vertical decomposition."""
    return (
        any(body.size > 1 for body in scene.bodies)
        and not initial_touches(scene)[1]
        and plan_tiling(scene, "greedy", scene.exact_start).entry.bodies is catalogue.Bodies.CONVEX
    )


@pytest.mark.parametrize("family", sorted(CONVEX))
def test_walls_and_shadows_keep_the_same_tiling(family):
    """Between any two events of either; contacts too."""
    scenes = [scene for seed in range(4) if are_convex(scene := generate(family, seed))]

    assert sum(map(compare, scenes)) >= len(scenes) > 0


@pytest.mark.slow
@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_walls_and_shadows_keep_the_same_tiling_in_many_scenes(family):
    """Of all families: some scenes of simple polygons happen to be convex."""
    scenes = [scene for seed in range(60) if are_convex(scene := generate(family, seed))]

    assert sum(map(compare, scenes)) >= len(scenes)
    assert scenes or family not in CONVEX


def test_walls_and_shadows_keep_the_same_tiling_in_kept_cases():
    scenes = [kept(name).scene for name in names()]
    scenes = [scene for scene in scenes if "greedy" in tilings_of(scene) and are_convex(scene)]

    assert len(scenes) > 5
    assert sum(map(compare, scenes)) >= len(scenes)
