"""The texts in the set: its description, how it is read and cited, and its licence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final

from benchmarks.collision_set import passages
from benchmarks.collision_set.parts import VERSION, Part, Written
from exactpt.testing import families

_HERE: Final = Path(__file__).parent

LICENSE: Final = (_HERE / "CC0-1.0.txt").read_text(encoding="utf-8")
_TEXT: Final = (_HERE / "about.txt").read_text(encoding="utf-8")


def about(parts: Sequence[Part], written: Sequence[Written]) -> str:
    """The README of a set."""
    contacts = {tuple(w.name.partition(".")[0].split("/")): w.contacts for w in written}
    numbers = {}
    for kind in ("point-segment", "scenes"):
        of_kind = [part for part in parts if part.kind == kind]
        touching = sum(contacts[kind, part.family] for part in of_kind)
        numbers[kind] = f"{sum(part.size for part in of_kind):,}", f"{touching:,}"
    return _TEXT.format(
        version=VERSION,
        passages=numbers["point-segment"][0],
        passage_contacts=numbers["point-segment"][1],
        scenes=numbers["scenes"][0],
        scene_contacts=numbers["scenes"][1],
        point_segment=_list(passages.DEGENERATE, passages.GENERIC),
        scene_families=_list(families.DEGENERATE, families.GENERIC),
    )


def _list(degenerate: Mapping[str, object], generic: Mapping[str, object]) -> str:
    lines = []
    for word, those in (("Degenerate", degenerate), ("Generic", generic)):
        lines += [
            f"{word}:",
            "",
            *(f"* `{name}`: {_first_line(f)}" for name, f in those.items()),
            "",
        ]
    return "\n".join(lines).rstrip()


def _first_line(family: object) -> str:
    return (family.__doc__ or "").partition("\n")[0]
