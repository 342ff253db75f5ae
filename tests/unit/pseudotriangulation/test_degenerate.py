"""The order in which corners close at the very time of an event."""

import pytest

from exactpt import AlgebraicNumber, Simulation
from exactpt.certificates.perturbation import comes_first
from exactpt.pseudotriangulation import degenerate
from exactpt.testing.scenes import generate

pytestmark = pytest.mark.plain


def test_of_copies_of_one_triple_the_first_to_close_does(monkeypatch):
    """First the triple of the least half-edge; of its copies none that closes after another."""
    choose, moved = degenerate._first, []

    def checked(mesh, due, instant):
        def vertices(h):
            return tuple(instant.vertices.all[v] for v in degenerate._angle(mesh, h))

        def scene_triple(h):
            return {(v.body, v.index) for v in vertices(h)}

        chosen, now = choose(mesh, due, instant), AlgebraicNumber(instant.time)
        assert scene_triple(chosen) == scene_triple(min(due))
        for h in due:
            if scene_triple(h) == scene_triple(chosen):
                assert not comes_first(vertices(h), -1, vertices(chosen), -1, now)
        moved.append(chosen != min(due))
        return chosen

    monkeypatch.setattr(degenerate, "_first", checked)
    simulation = Simulation(generate("small_grid", 8), tiling="greedy")
    for event in simulation.run():
        if event.kind != "contact" and simulation.now.is_rational:
            simulation.snapshot()

    assert any(moved)
