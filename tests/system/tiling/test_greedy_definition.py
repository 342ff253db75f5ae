"""The greedy tiling against its definition, and the paper's lemmas on it."""

from random import Random

import pytest
from gvpt_oracle import Scene as Oracle

from exactpt.kernel.numbers import QQ
from exactpt.scene.generate import generate
from exactpt.simulation.tile import tile_at

FAMILIES = ("convex", "mixed_shapes", "ballistic", "turning", "deforming")


def generic_scenes(count):
    """Scenes and rational times without contact so far, at which nothing is collinear."""
    rng = Random(5)
    found = 0
    seed = 0
    while found < count:
        seed += 1
        scene = generate(FAMILIES[seed % len(FAMILIES)], seed)
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
