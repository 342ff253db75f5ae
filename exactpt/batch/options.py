"""The query of a batch about each of its scenes."""

from __future__ import annotations

from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Final, final

from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.files import MAX_BYTES
from exactpt.kernel.budget import bounded
from exactpt.kernel.numbers import Rational, rational
from exactpt.scene.groups import groups_given
from exactpt.scene.scene import Scene
from exactpt.search.first import ContactQuery, first_contact, refuse_conflicts
from exactpt.search.intervals import contacts
from exactpt.search.query import pairs_given
from exactpt.search.within import first_within

NOTHING: Final = Scene([])
"""A scene for which any options have a result, unless they exclude each other."""
FIRST_ONLY: Final = ("method", "tiling", "ignoring", "after_start", "between", "exact_only")
"""The options that are about the first contact alone."""


@final
@dataclass(frozen=True, slots=True)
class Options:
    """The query about each scene: by default its first contact, as `exactpt.first_contact`.

    Attributes:
        every: whether all intervals of contact are wanted (`exactpt.contacts`).
        distance: for the first time at which two bodies are within this Euclidean distance
            (`exactpt.first_within`).
        until, since: an earlier end and a later start of the time span.
        method, tiling, ignoring, after_start, between, exact_only: as of `exactpt.first_contact`.
        max_seconds: the wall-clock time for each scene.
        max_memory: maximum memory of a process in bytes.
        max_bytes: maximum size of a scene in bytes.

    Raises:
        InputError: if options exclude each other, or groups and pairs are not names.
    """

    every: bool = False
    distance: Rational | None = None
    until: Rational | None = None
    since: Rational | None = None
    method: str = "auto"
    tiling: str = "auto"
    ignoring: tuple[tuple[str, ...], ...] = ()
    after_start: bool = False
    between: tuple[tuple[str, str], ...] | None = None
    exact_only: bool = False
    max_seconds: float | None = None
    max_memory: int | None = None
    max_bytes: int = MAX_BYTES

    def __repr__(self) -> str:
        return record_in_brief(self)

    def __post_init__(self) -> None:
        for value in (self.distance, self.until, self.since):
            if value is not None:
                rational(value)
        # The names are read once: an iterator would be empty for the second scene.
        object.__setattr__(self, "ignoring", groups_given(self.ignoring))
        if self.between is not None:
            object.__setattr__(self, "between", pairs_given(self.between))
        if self.every and self.distance is not None:
            raise InputError("expected either every=True or a distance, not both")
        plain = self._first_only() == Options._defaults()
        if (self.every or self.distance is not None) and not plain:
            raise InputError(
                "methods and choices of bodies are supported only for the first contact"
            )
        if self.distance is not None:
            first_within(NOTHING, distance=self.distance)
        first_contact(NOTHING, method=self.method, tiling=self.tiling)  # refuses unknown names
        question = ContactQuery(
            self.method, self.tiling, after_start=self.after_start, between=self.between
        )
        refuse_conflicts(question, has_groups=bool(self.ignoring))

    def _first_only(self) -> list[object]:
        return [getattr(self, name) for name in FIRST_ONLY]

    @staticmethod
    def _defaults() -> list[object]:
        return ["auto", "auto", (), False, None, False]

    @property
    def is_plain(self) -> bool:
        """True if it is about the first contact of all bodies in the whole span, by any method."""
        spans = (self.every, self.distance, self.until, self.since)
        plain = spans == (False, None, None, None)
        return plain and self._first_only() == self._defaults()

    def to_json(self) -> dict[str, object]:
        """Return the options on which results depend, as one value."""
        numbers = {
            name: None if value is None else str(rational(value))
            for name in ("distance", "until", "since")
            for value in [getattr(self, name)]
        }
        rest = ("every", *FIRST_ONLY, "max_seconds", "max_memory", "max_bytes")
        return numbers | {name: getattr(self, name) for name in rest}

    def budget(self) -> AbstractContextManager[None]:
        """Return the context of the query about one scene."""
        return bounded(self.max_seconds, self.max_memory)

    def answer(self, scene: Scene) -> dict[str, object]:
        """Return the result of a scene as JSON, see docs/format.md.

        Raises:
            BudgetExceeded: if time or memory is used up.
            InputError: if the options make no sense for the scene.
        """
        if self.until is not None:
            scene = scene.until(self.until)
        if self.since is not None:
            scene = scene.since(self.since)
        if self.every:
            return {"intervals": [interval.to_json() for interval in contacts(scene)]}
        if self.distance is not None:
            near = first_within(scene, distance=self.distance)
            if near is None:
                return {"approach": None}
            pairs = [list(names) for names in near.pairs]
            return {"approach": {"time": near.time.to_json(), "pairs": pairs}}
        contact = first_contact(
            scene,
            method=self.method,
            tiling=self.tiling,
            exact_only=self.exact_only,
            ignoring=self.ignoring,
            after_start=self.after_start,
            between=self.between,
        )
        return {"contact": None if contact is None else contact.to_json()}
