"""The refusal of bodies that no tiling can hold: those with a radius, or with rings that touch."""

from __future__ import annotations

from collections.abc import Iterable

from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten, show_points
from exactpt.motion.body import Body


def refuse_untileable(bodies: Iterable[Body]) -> None:
    """Refuse bodies that a tiling cannot hold.

    It would keep only the cores of rounded bodies apart, and a point in which rings touch pinches
    the free space.

    Raises:
        InputError: if one of them is rounded, or its rings touch.
    """
    body = _untileable(bodies)
    if body is None:
        return
    refuse_touching_rings([body], "no tiling holds such bodies; their contacts are found by pairs")
    raise InputError(
        f"body {shorten(body.name)} has a radius: no tiling holds rounded bodies; "
        "their contacts are found by pairs (first_contact, collide)"
    )


def are_tileable(bodies: Iterable[Body]) -> bool:
    """Return True if a tiling can hold bodies."""
    return _untileable(bodies) is None


def refuse_touching_rings(bodies: Iterable[Body], why: str) -> None:
    """Refuse bodies with rings that touch, where these have to be disjoint.

    Args:
        bodies: the bodies.
        why: the reason, as the end of the message.

    Raises:
        InputError: if rings of one of the bodies touch.
    """
    for body in bodies:
        touches = body.exact_ring_touches
        if touches:
            raise InputError(
                f"body {shorten(body.name)}: its rings touch at {show_points(touches)} in its "
                f"rest frame: {why}"
            )


def _untileable(bodies: Iterable[Body]) -> Body | None:
    """Return the first body that a tiling cannot hold."""
    radii = getattr(bodies, "radii", None)  # of bodies in arrays, which have one ring each
    if radii is not None and not radii.any():
        return None
    return next((body for body in bodies if body.exact_radius or body.exact_ring_touches), None)
