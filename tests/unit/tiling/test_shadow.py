"""Flips: from any tiling back to the greedy one, and what a walk does on a broken mesh."""

from random import Random

import pytest
from flipped import flipped_at_random, scattered

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.predicates import Predicates
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices
from exactpt.pseudotriangulation.flip import flip_until_greedy
from exactpt.pseudotriangulation.shadow import has_visits, shadow, visit_after, visit_before
from exactpt.scene.generate import generate
from exactpt.tiling.greedy.greedy import VerticalRules

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
