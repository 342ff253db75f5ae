"""The first contact of a scene: the question, the choice of the search, and the call of a user."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple, Protocol

from exactpt.errors import InputError, carrying
from exactpt.extensions import extension
from exactpt.kernel.budget import bounded, deadline_in
from exactpt.kernel.numbers import Rational, shorten
from exactpt.motion.tileable import are_tileable
from exactpt.pair.contact import Contact
from exactpt.scene.groups import groups_given
from exactpt.scene.scene import Scene, a_scene
from exactpt.search.query import Selection
from exactpt.search.reading import rows_of_scene
from exactpt.search.sweep_search import Slabs, Sweep, SweepSearch, pairs_that_count

if TYPE_CHECKING:
    from exactpt.search.new import NewContactSearch

METHODS: Final = ("kinetic", "pairs", "auto")
"""Names of the methods of `first_contact`."""


def first_contact(
    scene: Scene,
    *,
    method: str = "auto",
    tiling: str = "auto",
    exact_only: bool = False,
    ignoring: Iterable[Iterable[str]] = (),
    after_start: bool = False,
    between: Iterable[Sequence[str]] | None = None,
    since: Rational | None = None,
    proof: str | Path | None = None,
    certificate: str | Path | None = None,
    max_seconds: float | None = None,
    max_memory: int | None = None,
) -> Contact | None:
    """Return the first contact in the closed time span of a scene; None if there is none.

    Args:
        scene: the bodies, their motions and the time span.
        method: "kinetic" keeps a tiling; "pairs" searches pairs of features without a tiling;
            "auto" is "pairs" unless a tiling is named or a proof is wanted.
        tiling: the tiling to keep, one of `TILINGS`, or "incremental" for points; "auto" is
            "incremental" if all bodies are points, else "lazy", which has the fewest events.
        exact_only: whether exact arithmetic decides everything, without the float filters.
        ignoring: groups of names and patterns as of a `Scene`, beside those of the scene.
            Contacts between two bodies of one group are ignored. A tiling watches all bodies, so
            groups need "pairs", or "auto" without a tiling.
        after_start: whether to find the first contact that is new: bodies that touch at the
            start count only when they have parted and touch again, or when they begin to
            overlap. This needs "pairs" or "auto", as does ``between``.
        between: pairs of names; contacts of other pairs do not count, nor do those of a body
            with itself. All if not given. A pair that is ignored is an error.
        since: a later start of the time span. Bodies that touch at it are in contact at it.
        proof: file to write, with all that an independent program needs to check the result
            (docs/proofs.md). The scene is written beside it, with ``.scene.json`` after the
            name. This needs a tiling: "kinetic" or "auto".
        certificate: file to write, and the scene likewise; another program checks by them
            that bodies stay apart up to a time L, and that two are in contact by a time H soon
            after (docs/proofs.md): by any method, not for ``after_start``.
        max_seconds: time limit in seconds of wall-clock time; None for no limit.
        max_memory: maximum memory of the process, in bytes; None for no limit.

    Raises:
        BudgetExceeded: if the time or memory is used up, in any thread, also before the search
            begins; its ``reached`` is a time up to which no contact exists, or None.
        InputError: if the method, tiling or a body does not exist, the scene is none, a group is
            wrong, a named pair is ignored, or the proof or certificate cannot be written.
    """
    if method not in METHODS:
        raise InputError(f"no method {shorten(method)}; there are: {', '.join(METHODS)}")
    from exactpt.tiling import catalogue  # the command, which asks `search_for`, needs no tiling

    catalogue.choose(tiling, points=True, convex=lambda: True)  # refuses unknown names
    a_scene(scene)
    with bounded(max_seconds, max_memory), carrying(lambda: scene):
        given = scene
        if since is not None:
            scene = scene.since(since)
        question = ContactQuery(
            method,
            tiling,
            exact_only=exact_only,
            ignoring=ignoring,
            after_start=after_start,
            between=between,
            proof=None if proof is None else Path(proof),
            certificate=None if certificate is None else Path(certificate),
            given=given,
        )
        return search_for(scene, question).run_to_contact()


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


class Search(Protocol):
    """A search for the first contact of a scene."""

    @property
    def name(self) -> str | None:
        """The name of the tiling that is kept; None if there is none."""

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the search so far, see docs/format.md."""

    def run_to_contact(self) -> Contact | None:
        """Return the first contact in the closed time span of the scene; None if there is none.

        Raises:
            BudgetExceeded: if the events, the time or the memory are used up.
        """

    def contact_free_until(self) -> Fraction | None:
        """Return a rational time such that there is provably no contact from the start to it.

        The interval is closed: with a contact at t = 3, the time is less than 3. It is None if
        nothing has been proved, as before the bodies that touch at the start are known. It is
        right whenever it is called, also in the middle of an event and after the contact.
        """


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
    if question.after_start:
        return _new_search(scene, selection, exact_only=exact_only, max_seconds=seconds)
    method, tiling = question.method, question.tiling
    if not selection.is_all:
        method = "pairs"  # a tiling watches all pairs
    elif question.max_events is not None and method == "auto":
        method = "kinetic" if are_tileable(scene.bodies) else "pairs"
    if searches_pairs(method, tiling):
        return pair_search(scene, exact_only=exact_only, selection=selection, max_seconds=seconds)
    from exactpt.tiling.tiling_search import TilingSearch

    most = question.max_events
    return TilingSearch(scene, tiling, exact_only=exact_only, max_events=most, max_seconds=seconds)


def pair_search(
    scene: Scene,
    *,
    exact_only: bool = False,
    selection: Selection | None = None,
    max_seconds: float | None = None,
) -> SweepSearch:
    """Return the search over pairs.

    Args:
        scene: the bodies, their motions and the time span.
        exact_only: whether exact arithmetic decides everything that boxes do not exclude.
        selection: the pairs that count; by default all but those that the scene ignores.
        max_seconds: time limit, in seconds; None for no limit.
    """
    chosen = Selection(scene) if selection is None else selection
    rows = rows_of_scene(scene)
    pairs = pairs_that_count(rows, chosen)
    return SweepSearch(scene, rows, pairs, exact_only=exact_only, max_seconds=max_seconds)


def _new_search(
    scene: Scene, selection: Selection, *, exact_only: bool, max_seconds: float | None
) -> NewContactSearch:
    """Return the search for new contacts."""
    from exactpt.search.new import NewContactSearch  # few callers ask for it

    deadline = deadline_in(max_seconds)
    rows = rows_of_scene(scene)

    def sweep_but(apart: Sequence[tuple[int, int]]) -> Sweep:
        slabs = Slabs(rows, pairs_that_count(rows, selection, apart))
        return Sweep(rows, slabs, exact_only=exact_only, deadline=deadline)

    return NewContactSearch(scene, sweep_but, deadline)


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
        InputError: if a tiling or a proof is requested of some pairs or of new contacts, a proof
            without a tiling, or a tiling of a search that keeps none.
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
    elif question.method == "pairs" and question.tiling != "auto":
        raise InputError(f"method='pairs' keeps no tiling: leave out {question.tiling!r}")
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
    (`python -m benchmarks first-contact`). Only a tiling can continue after the contact and
    compute queries about the free space.
    """
    return method == "pairs" or (method == "auto" and tiling == "auto")
