"""Tilings shown at the very time of an event: whole, and without faces that have no area."""

from itertools import pairwise

import pytest

from exactpt import Body, Scene, Simulation
from exactpt.cgal import BodyShape
from exactpt.geometry.polygon import signed_area2
from exactpt.geometry.predicates import orientation
from exactpt.kernel.numbers import QQ
from exactpt.simulation.tile import tile_at
from exactpt.testing.scenes import generate
from exactpt.testing.scenes.shapes import hull
from exactpt.tiling.start import TILINGS

FAMILIES = (
    "small_grid",
    "row",
    "grids_passing",
    "mirrored",
    "letters",
    "flat",
    "nested",
    "chains",
    "chains_on_grid",
)


def snapshots(family, seed, tiling):
    """The tilings at the rational times of events, but a contact."""
    simulation = Simulation(generate(family, seed), tiling=tiling)
    last = None
    for event in simulation.run():
        now = simulation.now.simplified()
        if event.kind != "contact" and now.is_rational and now != last:
            last = now
            yield simulation.scene, simulation.snapshot()


def assert_whole(scene, snapshot):
    """Faces have three corners each, and with the bodies they make up the convex hull."""
    points = [(node.x, node.y) for node in snapshot.nodes]
    area = 0
    for face in snapshot.faces:
        assert len(face.corners) == 3
        cycle = [points[v] for v in face.nodes]
        turns = zip(face.nodes, [cycle[-1], *cycle], cycle, [*cycle[1:], cycle[0]], strict=False)
        assert {v for v, a, p, b in turns if orientation(a, p, b) > 0} == set(face.corners)
        area += signed_area2(cycle)
    for body in scene.bodies:
        if body.closed and body.size > 2:
            area += abs(signed_area2(body.at(snapshot.at)))
    assert area == signed_area2(hull(points))
    edges = {(e.u, e.v) for e in snapshot.edges}
    for face in snapshot.faces:
        for u, v in pairwise([*face.nodes, face.nodes[0]]):
            assert (min(u, v), max(u, v)) in edges


@pytest.mark.long(
    "grids_passing-greedy",
    "grids_passing-mixed",
    "grids_passing-lazy",
    "flat-mixed",
    "chains-greedy",
    "chains-mixed",
    "chains-lazy",
)
@pytest.mark.parametrize("tiling", [t for t in TILINGS if t != "incremental"])
@pytest.mark.parametrize("family", FAMILIES)
def test_a_tiling_at_an_event_is_whole(family, tiling):
    seen = 0
    for seed in range(12):
        for scene, snapshot in snapshots(family, seed, tiling):
            assert_whole(scene, snapshot)
            seen += 1
            if seen == 12:
                return


@pytest.mark.parametrize("tiling", [t for t in TILINGS if t != "incremental"])
@pytest.mark.parametrize(
    "family, seed", [("simultaneous_swaps", 4), ("grid_points", 1), ("crossing_lines", 4)]
)
def test_corners_that_close_on_each_other_at_an_event(family, seed, tiling):
    """One by one they do not end in a tiling: that one is built."""
    for scene, snapshot in snapshots(family, seed, tiling):
        assert_whole(scene, snapshot)


@pytest.mark.parametrize("tiling", [t for t in TILINGS if t != "incremental"])
def test_a_chain_that_is_straight_at_an_event(tiling):
    """Its vertex is reflex after it, with a diagonal that has to go."""
    middle = {"x": [28], "y": [54, "-1/2"]}
    ends = [("57/2", "103/2"), middle, ("55/2", "111/2"), (25, 61), (33, 46)]
    scene = Scene([Body("a", ends, closed=False)], (0, 1))
    simulation = Simulation(scene, tiling=tiling)
    for _ in simulation.run():
        pass

    assert_whole(scene, simulation.snapshot())


@pytest.mark.parametrize("tiling", [t for t in TILINGS if t != "incremental"])
@pytest.mark.parametrize("seed", [1, 2])
def test_a_chain_that_is_straight_at_the_start(tiling, seed):
    """Where it bends just after, its copies were once all on one line (chains 1, vertex b4:1)."""
    bend = {"x": ["3171/25", -2], "y": ["30551/100", -5 * seed]}
    ends = [{"x": [127, -1], "y": [300, -3]}, bend, {"x": ["3167/25", -8], "y": ["15551/50", 5]}]
    scene = Scene([Body("a", ends, closed=False), Body("b", [(100, 310), (90, 300)])], (0, 1))

    assert_whole(scene, Simulation(scene, tiling=tiling).snapshot())
    assert_whole(scene, tile_at(scene, QQ(0), tiling=tiling))


@pytest.mark.long
@pytest.mark.cgal
@pytest.mark.parametrize("tiling", [t for t in TILINGS if t != "incremental"])
@pytest.mark.parametrize("family", FAMILIES)
def test_cgal_accepts_a_tiling_at_an_event(family, tiling, witness):
    seen = 0
    for seed in range(12):
        for scene, snapshot in snapshots(family, seed, tiling):
            verdict = witness.check_tiling(snapshot.to_json(), BodyShape.of_scene(scene))
            assert verdict.ok, (seed, snapshot.at, verdict.reason)
            seen += 1
            if seen == 30:
                return
