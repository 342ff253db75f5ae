"""The rotational sweep where bitangents are parallel, and its repairs where they turn vertical."""

from math import cos, pi, sin
from random import Random

import pytest

from benchmarks.shapes import crowd
from exactpt.certificates.at_time import PredicatesAt
from exactpt.collision.driver import Driver
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.vertex import MovingBody
from exactpt.motion.vertices import Vertices
from exactpt.planar.halfedge import edge_key
from exactpt.pseudotriangulation.build import build_mesh
from exactpt.pseudotriangulation.flip import flip_until_greedy
from exactpt.tiling.greedy.sweep import greedy_diagonals
from exactpt.tiling.greedy.vertical import VerticalDecomposition
from exactpt.tiling.start import start_tiling

SHAPES = (
    [(0, 0), (2, 0), (0, 1)],
    [(0, 0), (2, 0), (2, 2), (0, 2)],
    [(0, 0), (1, -1), (2, 0), (1, 1)],
    [(0, 0), (3, 1), (1, 2)],
)


def scattered(rng, side):
    """Bodies of few shapes on a coarse lattice: many bitangents have one direction."""
    return [
        Body(f"{i} {j}", [(7 * i + x + dx, 7 * j + y + dy) for x, y in rng.choice(SHAPES)])
        for i in range(side)
        for j in range(side)
        for dx, dy in [(rng.randint(0, 2) + j, rng.randint(0, 2) - i)]
    ]


def swept(bodies):
    instant = PredicatesAt(Vertices.of(bodies, QQ(0), QQ(1)), QQ(0))
    return instant, *greedy_diagonals(instant, VerticalDecomposition.at(instant))


@pytest.mark.long("4")
@pytest.mark.parametrize("side", [2, 3, 4])
def test_the_order_of_parallel_bitangents_on_different_lines_does_not_matter(side):
    rng = Random(side)
    parallel = 0
    for _ in range(40):
        instant, diagonals, tied = swept(scattered(rng, side))
        slopes = []
        for u, v, _ in diagonals:
            (ax, ay), (bx, by) = instant.position(u), instant.position(v)
            slopes.append((by - ay) / (bx - ax) if ax != bx else None)
        mesh = build_mesh(instant, diagonals)
        flips = flip_until_greedy(mesh, instant, mesh.diagonals())

        assert tied or not flips
        parallel += not tied and len(set(slopes)) < len(slopes)
    assert parallel


@pytest.mark.long
def test_on_grids_those_on_one_line_are_in_the_right_order():
    """So there is nothing to flip, neither among them nor anywhere else."""
    rng = Random(5)
    met = 0
    for _ in range(60):
        bodies = [
            Body(f"{i} {j}", [(4 * i + x, 4 * j + y) for x, y in rng.choice(SHAPES)])
            for i in range(3)
            for j in range(3)
        ]
        instant, diagonals, tied = swept(bodies)
        mesh = build_mesh(instant, diagonals)
        edges = {edge_key(*mesh.ends(h)) for h in mesh.diagonals()}

        assert tied <= edges
        assert not flip_until_greedy(mesh, instant, mesh.diagonals())
        met += bool(tied) and tied < edges
    assert met > 30


def test_two_bitangents_on_one_line_are_told():
    square = SHAPES[1]
    in_line = [Body(str(i), [(5 * i + x, y) for x, y in square]) for i in range(3)]
    in_steps = [Body(str(i), [(5 * i + x, 3 * i * i + y) for x, y in square]) for i in range(3)]

    assert swept(in_line)[2]
    assert not swept(in_steps)[2]


def test_the_diagonal_of_a_bitangent_that_becomes_vertical_is_found():
    """Also one that starts where the bitangent does; else the tiling is built anew."""
    scene = crowd(40, Random(1), radius=60, end=100)
    kinetic = start_tiling(scene, "greedy", QQ(0))
    for _ in Driver(scene, kinetic).events(scene.end):
        if kinetic.stats.total >= 300:
            break

    assert kinetic.stats.flips + kinetic.stats.total >= 200
    assert kinetic.stats.rebuilds == 0


@pytest.mark.plain
def test_bug_each_bitangent_listed_all_vertices_of_its_bodies(monkeypatch):
    rng, listed = Random(1), []
    bodies = [round_body(f"{i} {j}", 20 * i, 20 * j, rng) for i in range(3) for j in range(3)]
    ring = MovingBody.ring
    counted = property(lambda body: listed.append(body) or ring.fget(body), ring.fset)
    monkeypatch.setattr(MovingBody, "ring", counted)

    swept(bodies)

    assert len(listed) <= 10 * len(bodies)


def round_body(name, x, y, rng):
    """A polygon of so many vertices that its bitangents are found by nested bisections."""
    angles = [2 * pi * (i + rng.random() / 2) / 64 for i in range(64)]
    return Body(name, [(x + 8 * cos(a), y + 8 * sin(a)) for a in angles])
