"""ipctk: conservative continuous collision detection of vertices and edges, in linear pieces.

In each piece its sweep-and-prune finds candidates and its narrow phase a collision-free step.
Pairs of vertices of one rigid body are filtered out, and one thread is used, so that processor
times can be compared.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Final

import numpy as np

from benchmarks.methods.method import Answer, Method
from benchmarks.methods.moving import Floats, Moving
from exactpt.scene.scene import Scene

if TYPE_CHECKING:
    import ipctk

__all__ = ["with_additive", "with_tight_inclusion"]

ITERATIONS: Final = 1_000_000


def with_tight_inclusion(tolerance: float, pieces: int) -> Method:
    """Tight-Inclusion, which stops within a tolerance of the contact."""

    def phase() -> ipctk.NarrowPhaseCCD:
        import ipctk

        return ipctk.TightInclusionCCD(tolerance, ITERATIONS, 1.0 - tolerance)

    return _method("ipctk, tight inclusion", f"tolerance {tolerance:g}, {pieces}", phase, pieces)


def with_additive(rescaling: float, pieces: int) -> Method:
    """Additive CCD, which covers a given share of the distance to the contact."""

    def phase() -> ipctk.NarrowPhaseCCD:
        import ipctk

        return ipctk.AdditiveCCD(ITERATIONS, rescaling)

    return _method("ipctk, additive", f"rescaling {rescaling:g}, {pieces}", phase, pieces)


def _method(
    name: str, setting: str, phase: Callable[[], ipctk.NarrowPhaseCCD], pieces: int
) -> Method:
    def prepare(scene: Scene) -> Callable[[], Answer]:
        moving = Moving(scene)
        mesh = _mesh(moving)
        return lambda: _first(moving, mesh, phase(), pieces)

    return Method(name, f"{setting} pieces", prepare, "ipctk")


def _mesh(moving: Moving) -> ipctk.CollisionMesh:
    import ipctk

    mesh = ipctk.CollisionMesh(_columns(moving.at(moving.start)), np.asfortranarray(moving.edges))
    deforms = np.array([shape.deforms for shape in moving.shapes])[moving.body]
    own = len(moving.shapes) + np.arange(len(moving.body), dtype=np.int32)
    patches = np.where(deforms, own, moving.body).astype(np.int32)
    mesh.can_collide = ipctk.make_vertex_patches_filter(patches)
    return mesh


def _first(
    moving: Moving, mesh: ipctk.CollisionMesh, phase: ipctk.NarrowPhaseCCD, pieces: int
) -> float | None:
    import ipctk

    ipctk.set_num_threads(1)
    ipctk.set_logger_level(ipctk.error)
    broad = ipctk.SweepAndPrune()
    candidates = ipctk.Candidates()
    length = (moving.end - moving.start) / pieces
    here = _columns(moving.at(moving.start))
    for i in range(pieces):
        there = _columns(moving.at(moving.start + length * (i + 1)))
        candidates.build(mesh, here, there, 0.0, broad)
        free: float = candidates.compute_collision_free_stepsize(mesh, here, there, 0.0, phase)
        if free < 1.0:
            return moving.start + length * (i + free)
        here = there
    return None


def _columns(positions: Floats) -> Floats:
    return np.asfortranarray(positions)
