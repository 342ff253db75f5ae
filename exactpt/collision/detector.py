"""The first contact of a scene."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Final

from exactpt.collision.searches import ContactQuery, search_for
from exactpt.errors import InputError, carrying
from exactpt.kernel.budget import bounded
from exactpt.kernel.numbers import Rational, shorten
from exactpt.pairs.contact import Contact
from exactpt.scene.scene import Scene, a_scene
from exactpt.tiling import catalogue

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
            "auto" is "pairs" unless a tiling is named or a proof is wanted, or the
            coefficients of many vertices are out of the range of doubles.
        tiling: the tiling to keep, one of `TILINGS` or `POINT_TILING`; "auto" is "incremental"
            if all bodies are points, else "lazy", which has the fewest events.
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
