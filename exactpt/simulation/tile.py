"""The tiling of a scene at a rational time, built there or reached by a run."""

from __future__ import annotations

from exactpt.errors import TimeRangeError
from exactpt.kernel.numbers import QQ, show
from exactpt.pseudotriangulation.snapshot import Snapshot, snapshot
from exactpt.scene.scene import Scene
from exactpt.simulation.simulation import Simulation
from exactpt.simulation.spaces import why_no_tiling
from exactpt.tiling.catalogue import AUTO
from exactpt.tiling.start import plan_tiling, tiling_for_contact


def tile_at(
    scene: Scene,
    at: QQ,
    *,
    tiling: str = "auto",
    by_running: bool = False,
    fan: bool = False,
    max_events: int | None = None,
    max_seconds: float | None = None,
) -> Snapshot:
    """Return the tiling at a time in the span of the scene.

    Args:
        scene: the scene.
        at: the rational time.
        tiling: the name of the tiling, or "auto".
        by_running: whether to run from the start to that time; otherwise it is built at that time.
        fan: whether the tiling must have a fan triangulation, which `Snapshot.fan` lists; a run
            then maintains it.
        max_events: see `Simulation`.
        max_seconds: see `Simulation`.

    Raises:
        InputError: if the tiling does not exist, or does not support these bodies or the fan.
        TimeRangeError: if the time is outside the span, or not before the first contact.
        BudgetExceeded: if ``max_events`` or ``max_seconds`` is exceeded.
    """
    if not scene.exact_start <= at <= scene.exact_end:
        raise TimeRangeError(
            f"t = {show(at)} is outside the time span "
            f"from {show(scene.exact_start)} to {show(scene.exact_end)}"
        )
    name = plan_tiling(scene, tiling, scene.exact_start, fan=fan).name
    plan = plan_tiling(scene, name, at)
    simulation = Simulation(
        scene,
        tiling=tiling if by_running else tiling_for_contact(scene, AUTO),
        fan=fan and by_running,
        max_events=max_events,
        max_seconds=max_seconds,
    )
    _run_until(simulation, at)
    if by_running:
        return simulation.snapshot()
    return snapshot(plan.vertices, plan.mesh_at(at), plan.name, at)


def _run_until(simulation: Simulation, at: QQ) -> None:
    for _ in simulation.run(at):
        pass
    if simulation.contact is not None:
        raise TimeRangeError(f"no tiling at t = {show(at)}: {why_no_tiling(simulation.contact)}")
