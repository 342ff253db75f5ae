"""The search that answers a question about the first contact."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from exactpt.errors import InputError
from exactpt.kernel.numbers import shorten

if TYPE_CHECKING:
    from exactpt.collision.pairs import PairsSearch
    from exactpt.collision.selected import SelectedSearch
    from exactpt.proof.written import ProvedSearch
    from exactpt.scene.scene import Scene
    from exactpt.simulation.simulation import Simulation

    Search: TypeAlias = Simulation | PairsSearch | ProvedSearch | SelectedSearch

__all__ = ["names_in", "search_for", "two_names"]


def names_in(text: str, option: str) -> list[str]:
    """The names in a text, separated by commas; a name may stand in double quotes, as in CSV."""
    try:
        (names,) = csv.reader([text], strict=True)
    except (csv.Error, ValueError):
        raise InputError(f"{option}: quotes that do not match: {shorten(text)}") from None
    return names


def two_names(text: str, option: str) -> tuple[str, str]:
    """The names of two bodies in a text."""
    names = names_in(text, option)
    if len(names) != 2:
        raise InputError(f"{option}: not the names of two bodies: {shorten(text)}")
    return names[0], names[1]


def search_for(
    scene: Scene,
    method: str,
    tiling: str,
    *,
    ignoring: list[list[str]],
    after_start: bool,
    between: list[tuple[str, str]] | None,
    exact_only: bool,
    max_events: int | None,
    max_seconds: float | None,
    proof: Path | None,
    path: Path,
) -> Search:
    """The search that finds the first contact."""
    from exactpt.collision.detector import check_provable, searches_pairs

    if after_start or between is not None:
        from exactpt.collision.selected import SelectedSearch, check_selectable

        check_selectable(method, tiling, proof)
        return SelectedSearch(
            scene,
            after_start=after_start,
            between=between,
            ignoring=ignoring,
            exact_only=exact_only,
            max_seconds=max_seconds,
        )
    if proof is not None:
        check_provable(method, ignoring)
        from exactpt.proof.written import ProvedSearch

        return ProvedSearch(
            scene,
            proof,
            tiling=tiling,
            scene_file=path.read_bytes(),
            exact_only=exact_only,
            max_events=max_events,
        )

    if ignoring and method == "kinetic":
        raise InputError("--ignore: a tiling watches all bodies; --method pairs need not")
    if method == "auto" and max_events is not None and not ignoring:
        method = "kinetic"
    if searches_pairs(method, tiling, ignoring):
        from exactpt.collision.pairs import PairsSearch

        search = PairsSearch(
            scene, exact_only=exact_only, max_seconds=max_seconds, ignoring=ignoring
        )
        if method == "pairs" or ignoring or not search.is_blind():
            return search
    from exactpt.collision.tilings import tiling_for_contact
    from exactpt.simulation.simulation import Simulation

    return Simulation(
        scene,
        tiling=tiling_for_contact(scene, tiling),
        exact_only=exact_only,
        max_events=max_events,
        max_seconds=max_seconds,
    )
