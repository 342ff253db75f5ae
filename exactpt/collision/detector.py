"""The first contact of a scene."""

from __future__ import annotations

from exactpt.collision.contact import Contact, contact_of
from exactpt.collision.initial import initial_touches
from exactpt.collision.tilings import start_tiling
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.scene.scene import Scene
from exactpt.tiling.events import ContactFound

__all__ = ["first_contact"]


def first_contact(
    scene: Scene, *, tiling: str = "auto", exact_only: bool = False
) -> Contact | None:
    """The first contact in the closed time span of a scene, or None.

    Args:
        scene: what moves.
        tiling: which tiling to keep, one of `TILINGS`; "auto" is "incremental" for points
            alone, else "lazy", which has the fewest events.
        exact_only: decide everything by exact arithmetic, without the float filters.
    """
    touches, overlaps = initial_touches(scene)
    if overlaps:
        return contact_of(scene, AlgebraicNumber(scene.start), touches, overlaps)
    points = all(body.size == 1 for body in scene.bodies)
    name = "lazy" if tiling == "auto" and not points else tiling
    kinetic = start_tiling(scene, name, scene.start, exact_only=exact_only)
    try:
        for _ in kinetic.run():
            pass
    except ContactFound as found:
        return contact_of(scene, kinetic.now, found.touches)
    return None
