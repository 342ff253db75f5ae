"""Flips and shadow edges: walks, and edges that are found without one."""

from itertools import combinations
from random import Random

import pytest
from flipped import flipped_at_random, scattered

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.predicates import Predicates
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices
from exactpt.pseudotriangulation.flip import flip_until_greedy
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.shadow import (
    has_visits,
    is_tangent,
    shadow,
    visit_after,
    visit_before,
)
from exactpt.simulation.simulation import Simulation
from exactpt.testing.scenes import generate
from exactpt.tiling.greedy import shadows
from exactpt.tiling.greedy.greedy import VerticalRules
from exactpt.tiling.greedy.shadowed import ShadowRules
from fuzz.general import lanes

FAMILIES = ("mixed_shapes", "small_grid", "row", "mirrored", "concentric", "polygons_in_step")


def instants(count):
    """Of scattered polygons, and of the families at their start, points and segments included."""
    for seed in range(count):
        yield PredicatesAt(Vertices.of(scattered(Random(seed), 12), QQ(0), QQ(1)), QQ(0))
        for family in FAMILIES:
            scene = generate(family, seed)
            yield PredicatesAt(Vertices.of(scene.bodies, scene.start, scene.end), scene.start)


def diagonals(mesh):
    return {frozenset(mesh.ends(h)) for h in mesh.diagonals()}


def test_flips_lead_from_any_tiling_back_to_the_greedy_one():
    """Paper, Lemma 4.2: each diagonal before its shadow is enough."""
    flips = 0
    for seed, instant in enumerate(instants(3)):
        mesh = VerticalRules.build(instant)
        if all(mesh.is_hull(h) for h in mesh.diagonals()):
            continue
        greedy = diagonals(mesh)
        flipped_at_random(mesh, instant, Random(seed), 30)

        flips += len(flip_until_greedy(mesh, instant, mesh.diagonals()))

        assert diagonals(mesh) == greedy
    assert flips > 100


class Nonsense(Predicates):
    """Predicates that answer anything, but always the same."""

    def __init__(self, seed):
        self.seed = seed

    def orientation(self, a, b, c):
        return Random(f"{self.seed}:{a}:{b}:{c}").choice((-1, 1))


@pytest.mark.plain
@pytest.mark.parametrize("seed", range(40))
def test_the_walk_to_a_shadow_ends_whatever_the_signs(seed):
    """Where a mesh is no pseudo-triangulation just after now, its ends may go to and fro."""
    instant = PredicatesAt(Vertices.of(scattered(Random(seed), 6), QQ(0), QQ(1)), QQ(0))
    mesh = VerticalRules.build(instant)
    for h in mesh.diagonals():
        if not mesh.is_hull(h):
            shadow(mesh, h, Nonsense(seed))


def boundary(mesh, h):
    """The half-edges around the two faces of a diagonal, from the one after it."""
    following = mesh.map.face(h)[1:]
    return following + mesh.map.face(h ^ 1)[1:]


def test_visits_are_those_on_the_boundary_of_both_faces_in_its_order():
    """Half-edges elsewhere are none, nor is the diagonal itself."""
    at_ends = elsewhere = 0
    for instant in instants(2):
        mesh = VerticalRules.build(instant)
        half_edges = mesh.map.half_edges()
        for h in mesh.flippable():
            around = boundary(mesh, h)
            for k, g in enumerate(around):
                at_ends += g in (mesh.map.following[h], mesh.map.following[h ^ 1])
                assert visit_before(mesh, h, g) == around[k - 1]
                assert visit_after(mesh, h, around[k - 1]) == g
                assert has_visits(mesh, h, g, around[(2 * k + 1) % len(around)])
            for g in (h, h ^ 1, *(g for g in half_edges[:40] if g not in around)):
                elsewhere += 1
                assert not has_visits(mesh, h, around[0], g)
                assert not has_visits(mesh, h, g, around[0])
    assert at_ends > 50 < elsewhere


# Shadow edges that are found without a walk: segments that are tangent at both ends

RUNS = [
    *(
        (family, "mixed")
        for family in ("pieces", "mirrored", "chains", "lakes", "ballistic_points")
    ),
    *((family, "greedy") for family in ("turning_stars", "blobs", "chains", "gears", "lakes")),
]


def visits_around(mesh: Mesh, h):
    """The visits of the two faces of a diagonal without it."""
    return mesh.map.face(h)[1:] + mesh.map.face(h ^ 1)[1:]


def tangent_pairs(mesh, h, instant):
    """The pairs of visits with a segment that is tangent at both ends."""
    return {
        frozenset(pair)
        for pair in combinations(visits_around(mesh, h), 2)
        if all(is_tangent(mesh, h, *ends, instant) for ends in (pair, pair[::-1]))
    }


@pytest.mark.parametrize("seed", range(6))
def test_only_a_diagonal_and_its_shadow_edge_are_tangent_at_both_ends(seed):
    """In tiles of many reflex vertices, greedy or not, with corners at reflex vertices or not."""
    rng = Random(seed)
    instant = PredicatesAt(Vertices.of(scattered(rng, 10), QQ(0), QQ(1)), QQ(0))
    mesh = (ShadowRules if seed % 2 else VerticalRules).build(instant)
    for _ in range(3):
        for h in mesh.flippable():
            at_ends = frozenset((mesh.map.following[h], mesh.map.following[h ^ 1]))
            assert tangent_pairs(mesh, h, instant) == {
                at_ends,
                frozenset(shadow(mesh, h, instant)),
            }
        flipped_at_random(mesh, instant, rng, 15)


@pytest.mark.parametrize("family", ["mixed_shapes", "small_grid", "mirrored", "chains_on_grid"])
def test_in_degenerate_scenes_nothing_else_is_tangent(family):
    """Vertices that are collinear, and copies: what is tangent strictly is one of the two."""
    for seed in range(2):
        scene = generate(family, seed)
        instant = PredicatesAt(Vertices.of(scene.bodies, scene.start, scene.end), scene.start)
        mesh = ShadowRules.build(instant)
        for h in mesh.flippable():
            at_ends = frozenset((mesh.map.following[h], mesh.map.following[h ^ 1]))
            found = frozenset(shadow(mesh, h, instant))
            assert tangent_pairs(mesh, h, instant) <= {at_ends, found}


@pytest.mark.long("ballistic_points-mixed", "gears-greedy")
@pytest.mark.parametrize(("family", "tiling"), RUNS)
def test_after_every_event_they_are_those_of_a_walk(family, tiling):
    """Both ends in the order of a walk, with their neighbours in the mesh."""
    tested = 0
    for seed in range(3):
        simulation = Simulation(generate(family, seed), tiling=tiling)
        for _ in zip(range(12), simulation.run(), strict=False):
            if simulation.contact is not None:
                break
            engine = simulation.kinetic
            mesh, after = engine.mesh, engine.certified.after()
            for h in mesh.flippable():
                known = engine.rules._shadows._get(h)
                ends = known.first, known.second
                assert tuple(end.visit for end in ends) == shadow(mesh, h, after)
                around = visits_around(mesh, h)
                origins = [mesh.map.origin[g] for g in around]
                for end in ends:
                    k = around.index(end.visit)
                    assert (end.before, end.vertex) == (origins[k - 1], origins[k])
                    assert end.after == origins[(k + 1) % len(around)]
                tested += 1
    assert tested > 40


@pytest.mark.plain
def test_less_than_two_thirds_of_the_shadow_edges_need_a_walk(monkeypatch):
    walks, asked = [], []
    walk, find = shadows.shadow, shadows.CertifiedShadows.find
    monkeypatch.setattr(shadows, "shadow", lambda *which: walks.append(which) or walk(*which))
    monkeypatch.setattr(
        shadows.CertifiedShadows, "find", lambda *which: asked.append(which) or find(*which)
    )
    simulation = Simulation(lanes("decimals", 1, bodies=60), tiling="mixed")
    walks.clear()
    asked.clear()

    list(simulation.run())

    assert 0 < 3 * len(walks) < 2 * len(asked)
