"""The choice of the search for a first contact."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from exactpt.errors import InputError
from exactpt.extensions import extension
from exactpt.motion.tileable import are_tileable
from exactpt.pairs.search import pair_search
from exactpt.pairs.selection import Selection
from exactpt.scene.groups import groups_given
from exactpt.scene.scene import Scene

if TYPE_CHECKING:
    from exactpt.collision.search import Search


class ContactQuery(NamedTuple):
    """A query for a first contact, and the method of the search.

    Attributes:
        method, tiling, exact_only, ignoring, after_start, between, proof, certificate: as in
            `first_contact`; the names of method and tiling are known.
        scene_file: the bytes of the scene's file, which a proof then names.
        given: the scene with its first start, which a certificate names without a file.
        max_events: maximum number of events of a tiling, which "auto" then keeps if it can; None
            for no limit.
        max_seconds: time limit, in seconds; None for no limit.
    """

    method: str
    tiling: str
    exact_only: bool = False
    ignoring: Iterable[Iterable[str]] = ()
    after_start: bool = False
    between: Iterable[Sequence[str]] | None = None
    proof: Path | None = None
    certificate: Path | None = None
    scene_file: bytes | None = None
    given: Scene | None = None
    max_events: int | None = None
    max_seconds: float | None = None


def search_for(scene: Scene, question: ContactQuery) -> Search:
    """Return the search for a query.

    Args:
        scene: the bodies, their motions and the time span.
        question: the question.

    Raises:
        InputError: if the method does not support this query.
    """
    if question.certificate is not None:
        return _certified(scene, question)
    selection = Selection(scene, question.between, question.ignoring)
    refuse_conflicts(question, has_groups=bool(selection.groups))
    if question.proof is not None:
        return _proved(scene, question, question.proof)
    exact_only, seconds = question.exact_only, question.max_seconds
    if question.after_start or selection.named is not None:
        from exactpt.pairs.selected import SelectedSearch

        return SelectedSearch(
            scene,
            after_start=question.after_start,
            selection=selection,
            exact_only=exact_only,
            max_seconds=seconds,
        )
    method, tiling = question.method, question.tiling
    if selection.groups:
        method = "pairs"  # a tiling watches all pairs
    elif question.max_events is not None and method == "auto":
        method = "kinetic" if are_tileable(scene.bodies) else "pairs"
    if searches_pairs(method, tiling):
        search = pair_search(scene, exact_only=exact_only, selection=selection, max_seconds=seconds)
        if method == "pairs" or not search.lacks_boxes:
            return search
    from exactpt.collision.tiling_search import TilingSearch

    most = question.max_events
    return TilingSearch(scene, tiling, exact_only=exact_only, max_events=most, max_seconds=seconds)


def _certified(scene: Scene, question: ContactQuery) -> Search:
    """Return the search, whichever it is, that writes a certificate.

    Raises:
        InputError: if there is a proof, too, or it is about new contacts.
    """
    if question.after_start or question.proof is not None:
        what = "with a proof" if question.proof is not None else "of a new contact after the start"
        raise InputError(f"there is no certificate {what}")
    groups = groups_given(question.ignoring)  # two searches read them
    between = None if question.between is None else list(question.between)
    question = question._replace(ignoring=groups, between=between)
    search = search_for(scene, question._replace(certificate=None))
    certified: Search = extension("search that writes a certificate")(search, scene, question)
    return certified


def refuse_conflicts(question: ContactQuery, *, has_groups: bool) -> None:
    """Refuse a query whose parts exclude each other.

    Args:
        question: the query, without a certificate.
        has_groups: whether bodies ignore each other, in the scene or for this query.

    Raises:
        InputError: if a tiling or a proof is requested of some pairs or of new contacts, or a proof
            without a tiling.
    """
    is_proved = question.proof is not None
    names_tiling = question.method == "auto" and question.tiling != "auto"
    needs_tiling = question.method == "kinetic" or names_tiling or is_proved
    if question.after_start or question.between is not None:
        if needs_tiling or question.tiling != "auto":
            what = "a proof is about" if is_proved else "a tiling watches"
            raise InputError(
                f"{what} all bodies, from the start on: contacts between some, or new ones after "
                "the start, are found only by pairs"
            )
    elif is_proved and question.method == "pairs":
        raise InputError("a proof needs a tiling, and method='pairs' has none")
    if has_groups and needs_tiling:
        why, use = "a tiling", "the method pairs, or auto without a tiling"
        if is_proved:
            why, use = "a proof needs a tiling, which", "a certificate, which can be checked, too"
        raise InputError(f"{why} watches all bodies, but some ignore each other: use {use}")


def _proved(scene: Scene, question: ContactQuery, path: Path) -> Search:
    """Return the search by a tiling that writes a proof."""
    proved: Search = extension("search that writes a proof")(
        scene,
        path,
        tiling=question.tiling,
        scene_file=question.scene_file,
        exact_only=question.exact_only,
        max_events=question.max_events,
    )
    return proved


def searches_pairs(method: str, tiling: str) -> bool:
    """Return True if a method searches pairs: "pairs" does, "auto" does unless a tiling is named.

    For a single first contact from a cold start the search over pairs is the faster one, also
    for bodies that deform, change their motion, are entangled, drive in a convoy or never touch
    (`python -m benchmarks first-contact`); "auto" leaves it only where it has no boxes
    (`PairsSearch.lacks_boxes`). Only a tiling can continue after the contact and compute queries
    about the free space.
    """
    return method == "pairs" or (method == "auto" and tiling == "auto")
