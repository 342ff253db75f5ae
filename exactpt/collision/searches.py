"""The choice of the search for a first contact."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from exactpt.errors import InputError
from exactpt.extensions import extension
from exactpt.motion.tileable import are_tileable
from exactpt.pairs.search import pair_search
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
    ignoring: Sequence[Collection[str]] = ()
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
    method, tiling, exact_only, groups = question[:4]
    if question.certificate is not None:
        return _certified(scene, question)
    if question.after_start or question.between is not None:
        return _selected(scene, question)
    if groups and method == "kinetic":
        raise InputError("a tiling watches all bodies: to ignore some, use the method pairs")
    if question.proof is not None:
        return _proved(scene, question, question.proof)
    if question.max_events is not None and method == "auto" and not groups:
        method = "kinetic" if are_tileable(scene.bodies) else "pairs"
    seconds = question.max_seconds
    if searches_pairs(method, tiling, groups):
        search = pair_search(scene, exact_only=exact_only, ignoring=groups, max_seconds=seconds)
        if method == "pairs" or groups or not search.lacks_boxes:
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
    if question.between is not None:
        question = question._replace(between=list(question.between))
    search = search_for(scene, question._replace(certificate=None))
    certified: Search = extension("search that writes a certificate")(search, scene, question)
    return certified


def _selected(scene: Scene, question: ContactQuery) -> Search:
    """Return the search for contacts of some pairs, or for new ones.

    Raises:
        InputError: if a tiling or a proof is requested.
    """
    if question.method == "kinetic" or question.tiling != "auto" or question.proof is not None:
        what = "a tiling watches" if question.proof is None else "a proof is about"
        raise InputError(
            f"{what} all bodies, from the start on: contacts between some, or new ones after "
            "the start, are found only by pairs"
        )
    from exactpt.pairs.selected import SelectedSearch

    return SelectedSearch(
        scene,
        after_start=question.after_start,
        between=question.between,
        ignoring=question.ignoring,
        exact_only=question.exact_only,
        max_seconds=question.max_seconds,
    )


def _proved(scene: Scene, question: ContactQuery, path: Path) -> Search:
    """Return the search by a tiling that writes a proof.

    Raises:
        InputError: if the result is to be found without a tiling.
    """
    if question.method == "pairs" or question.ignoring:
        what = "groups that ignore each other" if question.ignoring else "method='pairs'"
        raise InputError(f"a proof needs a tiling, and {what} has none")
    proved: Search = extension("search that writes a proof")(
        scene,
        path,
        tiling=question.tiling,
        scene_file=question.scene_file,
        exact_only=question.exact_only,
        max_events=question.max_events,
    )
    return proved


def searches_pairs(method: str, tiling: str, groups: Collection[object] = ()) -> bool:
    """Return True if a method searches pairs: "pairs" does, "auto" does unless a tiling is named.

    For a single first contact from a cold start the search over pairs is the faster one, also
    for bodies that deform, change their motion, are entangled, drive in a convoy or never touch
    (`python -m benchmarks first-contact`); "auto" leaves it only where it has no boxes
    (`PairsSearch.lacks_boxes`). Only a tiling can continue after the contact and compute queries
    about the free space.
    """
    return method == "pairs" or (method == "auto" and (bool(groups) or tiling == "auto"))
