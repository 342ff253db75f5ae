"""The first contact of a scene."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from pathlib import Path
from typing import Final

from exactpt.collision.contact import Contact, contact_of
from exactpt.collision.initial import initial_touches
from exactpt.collision.tilings import check_tiling, start_tiling, tiling_for_contact
from exactpt.errors import InputError
from exactpt.extensions import extension
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.scene.scene import Scene
from exactpt.tiling.events import ContactFound

__all__ = ["METHODS", "check_provable", "first_contact", "searches_pairs"]


METHODS: Final = ("kinetic", "pairs", "auto")
"""Names of the methods of `first_contact`."""


def first_contact(
    scene: Scene,
    *,
    method: str = "kinetic",
    tiling: str = "auto",
    exact_only: bool = False,
    ignoring: Iterable[Collection[str]] = (),
    proof: str | Path | None = None,
) -> Contact | None:
    """The first contact in the closed time span of a scene; None if there is none.

    Args:
        scene: the bodies, their motions and the time span.
        method: "kinetic" keeps a tiling; "pairs" searches pairs of features without a tiling;
            "auto" is "pairs" unless a tiling is named.
        tiling: the tiling to keep, one of `TILINGS` or `POINT_TILING`; "auto" is "incremental"
            if all bodies are points, else "lazy", which has the fewest events.
        exact_only: whether exact arithmetic decides everything, without the float filters.
        ignoring: groups of body names. Contacts between two bodies of one group are ignored.
            A tiling cannot hold bodies that overlap, so this needs "pairs" or "auto".
        proof: file to write, with what an independent program needs to check the answer
            (docs/proofs.md). The scene is written beside it, with ``.scene.json`` after the
            name. This needs a tiling: "kinetic" or "auto".

    Raises:
        InputError: if there is no such method, tiling or body, or the proof cannot be written.
    """
    if method not in METHODS:
        raise InputError(f"no method {method!r}; there are: {', '.join(METHODS)}")
    check_tiling(tiling)
    groups = list(ignoring)
    if groups and method == "kinetic":
        raise InputError("a tiling watches all bodies: to ignore some, use method='pairs'")
    if proof is not None:
        check_provable(method, groups)
        write_proof = extension("proof of a first contact")
        contact: Contact | None = write_proof(scene, proof, tiling=tiling, exact_only=exact_only)
        return contact
    if searches_pairs(method, tiling, groups):
        from exactpt.collision.pairs import PairsSearch

        return PairsSearch(scene, exact_only=exact_only, ignoring=groups).run_to_contact()
    touches, overlaps = initial_touches(scene)
    if overlaps:
        return contact_of(scene, AlgebraicNumber(scene._start), touches, overlaps)
    name = tiling_for_contact(scene, tiling)
    kinetic = start_tiling(scene, name, scene._start, exact_only=exact_only)
    try:
        for _ in kinetic.run():
            pass
    except ContactFound as found:
        return contact_of(scene, kinetic.now, found.touches)
    return None


def check_provable(method: str, groups: Collection[object]) -> None:
    """Check that an answer of this method can be proved.

    Raises:
        InputError: if not.
    """
    if method == "pairs" or groups:
        what = "method='pairs'" if method == "pairs" else "groups that ignore each other"
        raise InputError(f"a proof needs a tiling, and {what} has none")


def searches_pairs(method: str, tiling: str, groups: Collection[object] = ()) -> bool:
    """Whether a method searches pairs: "pairs" does, "auto" does unless a tiling is named.

    Measured by `exactpt bench first-contact`: for a single first contact from a cold start the
    search over pairs takes between 0.2 and 1 times as long as a tiling, also for bodies that
    deform, change their motion, are entangled, drive in a convoy or never touch (spirals: up
    to 1.7 times). Only a tiling can continue after the contact and answer questions about the
    free space.
    """
    return method == "pairs" or (method == "auto" and (bool(groups) or tiling == "auto"))
