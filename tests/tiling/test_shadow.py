"""Flips: from any tiling back to the greedy one, and what a walk does on a broken mesh."""

from random import Random

import pytest
from flipped import flipped_at_random, scattered

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.predicates import Predicates
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices
from exactpt.pseudotriangulation.flip import flip_until_greedy, shadow, tangency
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
        shadows = {}

        flips += len(flip_until_greedy(mesh, instant, mesh.diagonals(), shadows))

        assert diagonals(mesh) == greedy
        assert shadows == {
            h: shadow(mesh, h, instant)
            for h in mesh.diagonals()
            if not mesh.is_fixed(h) and not mesh.is_hull(h)
        }
    assert flips > 100


class Nonsense(Predicates):
    """Predicates that answer anything, but always the same."""

    def __init__(self, seed):
        self.seed = seed

    def sign(self, a, b, c):
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


def test_the_neighbours_of_a_shadow_are_those_on_the_boundary_of_both_faces():
    """Also of other visits of these faces; there are none of half-edges elsewhere."""
    at_ends = elsewhere = 0
    for instant in instants(2):
        mesh = VerticalRules.build(instant)
        origin = mesh.map.origin
        half_edges = mesh.map.half_edges()
        for h in mesh.flippable():
            around = boundary(mesh, h)
            points = [origin[g] for g in around]
            for i, g in enumerate(around):
                k = (2 * i + 1) % len(around)
                x, y = points[i], points[k]
                at_ends += g in (mesh.map.following[h], mesh.map.following[h ^ 1])
                assert tangency(mesh, h, (g, around[k])) == [
                    (x, points[(i + 1) % len(points)], y),
                    (x, y, points[i - 1]),
                    (y, points[(k + 1) % len(points)], x),
                    (y, x, points[k - 1]),
                ]
            for g in (h, h ^ 1, *(g for g in half_edges[:40] if g not in around)):
                elsewhere += 1
                assert tangency(mesh, h, (around[0], g)) == []
                assert tangency(mesh, h, (g, around[0])) == []
    assert at_ends > 50 < elsewhere
