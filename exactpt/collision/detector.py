"""The first contact of a scene."""

from __future__ import annotations

import contextlib
import time as clock
from collections.abc import Collection, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from exactpt.collision.contact import Contact, contact_of
from exactpt.collision.ignoring import groups_of
from exactpt.collision.initial import initial_touches
from exactpt.collision.straight_search import Row, first_touching, near_at, rows_of
from exactpt.errors import BudgetExceeded, InputError, carrying
from exactpt.extensions import extension
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import within
from exactpt.kernel.numbers import Rational, fraction
from exactpt.scene.scene import Scene
from exactpt.tiling import catalogue

if TYPE_CHECKING:
    from exactpt.tiling.tiling import Tiling

__all__ = ["METHODS", "check_provable", "first_contact", "searches_pairs"]


METHODS: Final = ("kinetic", "pairs", "auto")
"""Names of the methods of `first_contact`."""


def first_contact(
    scene: Scene,
    *,
    method: str = "auto",
    tiling: str = "auto",
    exact_only: bool = False,
    ignoring: Iterable[Collection[str]] = (),
    after_start: bool = False,
    between: Iterable[Sequence[str]] | None = None,
    since: Rational | None = None,
    proof: str | Path | None = None,
    max_seconds: float | None = None,
    max_memory: int | None = None,
) -> Contact | None:
    """The first contact in the closed time span of a scene; None if there is none.

    Args:
        scene: the bodies, their motions and the time span.
        method: "kinetic" keeps a tiling; "pairs" searches pairs of features without a tiling;
            "auto" is "pairs" unless a tiling is named, or the coefficients of many vertices
            are out of the range of doubles.
        tiling: the tiling to keep, one of `TILINGS` or `POINT_TILING`; "auto" is "incremental"
            if all bodies are points, else "lazy", which has the fewest events.
        exact_only: whether exact arithmetic decides everything, without the float filters.
        ignoring: groups of body names. Contacts between two bodies of one group are ignored.
            A tiling cannot hold bodies that overlap, so this needs "pairs" or "auto".
        after_start: whether to find the first contact that is new: bodies that touch at the
            start count only when they have parted and touch again, or when they begin to
            overlap. This needs "pairs" or "auto", as does ``between``.
        between: pairs of names; contacts of other pairs do not count, nor do those of a body
            with itself. All if not given.
        since: a later start of the time span. Bodies that touch then are in contact then.
        proof: file to write, with what an independent program needs to check the answer
            (docs/proofs.md). The scene is written beside it, with ``.scene.json`` after the
            name. This needs a tiling: "kinetic" or "auto".
        max_seconds: time limit in seconds of wall-clock time; None for no limit.
        max_memory: maximum memory of the process, in bytes; None for no limit.

    Raises:
        BudgetExceeded: if the time or memory is used up, in any thread, also before the search
            begins; its ``reached`` is a time up to which there is no contact, or None.
        InputError: if there is no such method, tiling or body, or the proof cannot be written.
    """
    if method not in METHODS:
        raise InputError(f"no method {method!r}; there are: {', '.join(METHODS)}")
    catalogue.choose(tiling, points=True, convex=lambda: True)  # refuses unknown names
    with _budget(max_seconds, max_memory), carrying(lambda: scene):
        groups = list(ignoring)
        if since is not None:
            scene = scene.since(since)
        if after_start or between is not None:
            from exactpt.collision.selected import SelectedSearch, check_selectable

            check_selectable(method, tiling, proof)
            return SelectedSearch(
                scene,
                after_start=after_start,
                between=between,
                ignoring=groups,
                exact_only=exact_only,
            ).run_to_contact()
        return _contact(scene, method, tiling, exact_only=exact_only, groups=groups, proof=proof)


def _budget(
    max_seconds: float | None, max_memory: int | None
) -> contextlib.AbstractContextManager[None]:
    """A context in which the time and memory are bounded.

    Raises:
        InputError: if a bound is not a number >= 0.
    """
    if max_seconds is None and max_memory is None:
        return contextlib.nullcontext()
    for what, bound in (("max_seconds", max_seconds), ("max_memory", max_memory)):
        if bound is not None and not bound >= 0:
            raise InputError(f"{what}: not a number from 0 on: {bound!r}")
    deadline = None if max_seconds is None else clock.monotonic() + max_seconds
    return within(deadline, max_memory)


def _contact(
    scene: Scene,
    method: str,
    tiling: str,
    *,
    exact_only: bool,
    groups: list[Collection[str]],
    proof: str | Path | None,
) -> Contact | None:
    """As `first_contact`, with checked names."""
    if groups and method == "kinetic":
        raise InputError("a tiling watches all bodies: to ignore some, use method='pairs'")
    if proof is not None:
        check_provable(method, groups)
        write_proof = extension("proof of a first contact")
        found: Contact | None = write_proof(scene, proof, tiling=tiling, exact_only=exact_only)
        return found
    if searches_pairs(method, tiling, groups):
        return _by_pairs(scene, groups, tiling if method == "auto" else None, exact_only=exact_only)
    return _by_tiling(scene, tiling, exact_only=exact_only)


def _by_pairs(
    scene: Scene, groups: list[Collection[str]], otherwise: str | None, *, exact_only: bool
) -> Contact | None:
    """The first contact, by pairs of features.

    Where boxes exclude nothing, and there are no groups, a tiling is kept if one is given.
    """
    rows = None if exact_only else rows_of(scene)
    if rows is not None:
        return _first_of_rows(scene, rows, groups)
    from exactpt.collision.pairs import PairsSearch

    search = PairsSearch(scene, exact_only=exact_only, ignoring=groups)
    if otherwise is not None and not groups and search.is_blind():
        return _by_tiling(scene, otherwise, exact_only=exact_only)
    return search.run_to_contact()


def _by_tiling(scene: Scene, tiling: str, *, exact_only: bool) -> Contact | None:
    """The first contact, by a tiling that is kept up to it."""
    from exactpt.collision.tilings import start_tiling, tiling_for_contact
    from exactpt.tiling.events import ContactFound

    touches, overlaps = initial_touches(scene)
    if overlaps:
        return contact_of(scene, AlgebraicNumber(scene._start), touches, overlaps)
    name = tiling_for_contact(scene, tiling)
    passed: float | None = None
    kinetic: Tiling | None = None
    try:
        kinetic = start_tiling(scene, name, scene._start, exact_only=exact_only)
        try:
            for _ in kinetic.run():
                passed = kinetic.certifier.now.low
        except ContactFound as found:
            return contact_of(scene, kinetic.now, found.touches)
    except BudgetExceeded as spent:
        spent.reached = scene.start
        if kinetic is not None and passed is not None:
            reached = kinetic.vertices.frame.exact_time(passed)
            spent.reached = fraction(max(scene._start, reached))
        raise
    return None


def _first_of_rows(
    scene: Scene, rows: Sequence[Row], groups: Iterable[Collection[str]]
) -> Contact | None:
    """The first contact of bodies that all move straight."""
    group = groups_of(scene, groups)

    def apart(i: int, j: int) -> bool:
        return group[i] != group[j]

    near = [(i, j) for i, j in near_at(rows, scene._start) if apart(i, j)]
    if near:
        touches, overlaps = initial_touches(scene, near)
        if overlaps:
            return contact_of(scene, AlgebraicNumber(scene._start), touches, overlaps)
    try:
        found = first_touching(rows, scene._start, scene._end, apart)
    except BudgetExceeded as spent:
        spent.reached = scene.start
        raise
    return None if found is None else contact_of(scene, AlgebraicNumber(found.time), found.touches)


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

    For a single first contact from a cold start the search over pairs is the faster one, also
    for bodies that deform, change their motion, are entangled, drive in a convoy or never touch
    (`exactpt bench first-contact`); "auto" leaves it only where it has no boxes
    (`PairsSearch.is_blind`). Only a tiling can continue after the contact and answer questions
    about the free space.
    """
    return method == "pairs" or (method == "auto" and (bool(groups) or tiling == "auto"))
