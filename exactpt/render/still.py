"""Stills: a scene with its tiling at one time, the time of the first contact included."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, final

from exactpt.errors import InputError, TimeRangeError
from exactpt.kernel.numbers import show
from exactpt.pseudotriangulation.snapshot import Snapshot, snapshot
from exactpt.render.fixed import near
from exactpt.scene.groups import is_tileable
from exactpt.search.first import first_contact
from exactpt.simulation.simulation import Simulation

if TYPE_CHECKING:
    from exactpt.kernel.numbers import QQ
    from exactpt.pair.contact import Contact
    from exactpt.scene.scene import Scene


@final
@dataclass(frozen=True, slots=True)
class Still:
    """A scene at a time.

    Attributes:
        scene: the scene.
        at: the time; a rational just before it if the time is irrational.
        tiling: the tiling at that time (at a contact: the one just before); None if the bodies
            touch at the start, no tiling can hold them, or none is wanted.
        contact: the contact, if this is its time.
        fan: whether the edges of the tiling's fan are drawn.
    """

    scene: Scene
    at: QQ
    tiling: Snapshot | None
    contact: Contact | None
    fan: bool = False


def still(
    scene: Scene,
    at: QQ | None,
    *,
    tiling: str | None = "auto",
    fan: bool = False,
    max_events: int | None = None,
    max_seconds: float | None = None,
) -> Still:
    """Return the scene at a rational time, or at its first contact if ``at`` is None.

    Raises:
        InputError: if a contact is requested, but there is none; or a fan is, and the bodies or
            the tiling have none.
        TimeRangeError: if the time is outside the span or after the first contact.
        BudgetExceeded: if ``max_events`` or ``max_seconds`` is exceeded.
    """
    if at is not None and not scene.exact_start <= at <= scene.exact_end:
        raise TimeRangeError(
            f"t = {show(at)} is outside the time span "
            f"from {show(scene.exact_start)} to {show(scene.exact_end)}"
        )
    simulation: Simulation | None = None
    has_tiling = tiling is not None and (tiling != "auto" or is_tileable(scene))
    if tiling is None or not (has_tiling or fan):  # a run refuses the bodies of a fan
        contact = first_contact(scene, tiling=tiling or "auto", max_seconds=max_seconds)
    else:
        simulation = Simulation(
            scene, tiling=tiling, fan=fan, max_events=max_events, max_seconds=max_seconds
        )
        for _ in simulation.run(at):
            pass
        contact = simulation.contact
    if contact is not None and at is not None and contact.time.compare_rational(at) > 0:
        contact = None
    if at is None and contact is None:
        raise InputError(
            f"no contact to draw from t = {show(scene.exact_start)} to t = {show(scene.exact_end)}"
        )
    if at is not None and contact is not None and contact.time.compare_rational(at) != 0:
        raise TimeRangeError(
            f"nothing to draw at t = {show(at)}: "
            f"the first contact is at t = {float(contact.time)!r}"
        )
    if simulation is not None:
        return still_of(simulation)
    now = (
        at
        if contact is None
        else near(contact.time.simplified(), scene.exact_end - scene.exact_start)
    )
    return Still(scene, scene.exact_start if now is None else now, None, contact)


def still_of(simulation: Simulation) -> Still:
    """Return a simulation at its current time."""
    scene, kinetic, contact = simulation.scene, simulation.kinetic, simulation.contact
    now = (simulation.now if contact is None else contact.time).simplified()
    at = near(now, scene.exact_end - scene.exact_start)
    if kinetic is None:
        return Still(scene, at, None, contact)
    # At an event time the tiling may be undefined: draw the one that ends or begins there.
    mesh = kinetic.mesh_now(at) if contact is None and now.is_rational else kinetic.mesh_after()
    tiling = snapshot(kinetic.vertices, mesh, simulation.name, at)
    return Still(scene, at, tiling, contact, has_fan(simulation))


def has_fan(simulation: Simulation) -> bool:
    """Return True if a simulation maintains the fan triangulation."""
    return simulation.kinetic is not None and simulation.kinetic.fan is not None
