"""The first contact of a scene."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Final

from exactpt.collision.contact import Contact, contact_of
from exactpt.collision.initial import initial_touches
from exactpt.collision.tilings import start_tiling, tiling_for_contact
from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.scene.scene import Scene
from exactpt.tiling.events import ContactFound

__all__ = ["METHODS", "first_contact", "prefers_pairs"]


METHODS: Final = ("kinetic", "pairs", "auto")


def first_contact(
    scene: Scene,
    *,
    method: str = "kinetic",
    tiling: str = "auto",
    exact_only: bool = False,
    ignoring: Iterable[Collection[str]] = (),
) -> Contact | None:
    """The first contact in the closed time span of a scene, or None.

    Args:
        scene: what moves.
        method: "kinetic", by a tiling; "pairs", by a search over pairs of features without
            one; "auto", whichever is expected to be faster.
        tiling: which tiling to keep, one of `TILINGS`; "auto" is "incremental" for points
            alone, else "lazy", which has the fewest events.
        exact_only: decide everything by exact arithmetic, without the float filters.
        ignoring: groups of names; bodies of one group do not touch each other, whatever they
            do. A tiling has no place for bodies that overlap: this needs "pairs" or "auto".

    Raises:
        InputError: if there is no such method, tiling or body.
    """
    if method not in METHODS:
        raise InputError(f"no method {method!r}; there are: {', '.join(METHODS)}")
    groups = list(ignoring)
    if groups and method == "kinetic":
        raise InputError("a tiling watches all bodies: to ignore some, use method='pairs'")
    if method == "pairs" or (method == "auto" and (groups or prefers_pairs(scene))):
        from exactpt.collision.pairs import PairsSearch

        return PairsSearch(scene, exact_only=exact_only, ignoring=groups).run_to_contact()
    touches, overlaps = initial_touches(scene)
    if overlaps:
        return contact_of(scene, AlgebraicNumber(scene.start), touches, overlaps)
    name = tiling_for_contact(scene, tiling)
    kinetic = start_tiling(scene, name, scene.start, exact_only=exact_only)
    try:
        for _ in kinetic.run():
            pass
    except ContactFound as found:
        return contact_of(scene, kinetic.now, found.touches)
    return None


def prefers_pairs(scene: Scene) -> bool:
    """Whether a search over pairs is expected to find the first contact sooner.

    Measured (`exactpt bench first-contact`): once and from a cold start it does, up to
    three times, except where bodies deform; these near themselves are pairs in every slab.
    """
    pieces = (body.piece_after(scene.start).tracks for body in scene.bodies)
    return all(
        tracks[0].frame is not None and all(track.frame == tracks[0].frame for track in tracks)
        for tracks in pieces
    )
