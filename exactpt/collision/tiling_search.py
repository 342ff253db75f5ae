"""A search for the first contact by a tiling that is kept up to it."""

from __future__ import annotations

import time as clock
from fractions import Fraction
from typing import TYPE_CHECKING, Final, final

from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import searching
from exactpt.kernel.counters import Counts
from exactpt.motion.body import refuse_rounded
from exactpt.pairs.contact import Contact, contact_of
from exactpt.pairs.start import initial_touches
from exactpt.scene.scene import Scene
from exactpt.tiling.events import ContactFound
from exactpt.tiling.report import report
from exactpt.tiling.start import proved_until, start_tiling, tiling_for_contact

if TYPE_CHECKING:
    from exactpt.tiling.tiling import Tiling

__all__ = ["MANY", "TilingSearch"]

MANY: Final = 64
"""Number of event times from one look at the limits to the next."""


@final
class TilingSearch:
    """A search for the first contact.

    Args:
        scene: the bodies, their motions and the time span.
        tiling: the name of the tiling; "auto" is the one with the fewest events.
        exact_only: whether exact arithmetic decides everything, without the float filters.
        max_events: maximum number of events; None for no limit.
        max_seconds: time limit, in seconds; None for no limit.

    Attributes:
        name: the name of the tiling.

    Raises:
        InputError: if there is no such tiling, or it does not support these bodies.
    """

    def __init__(
        self,
        scene: Scene,
        tiling: str = "auto",
        *,
        exact_only: bool = False,
        max_events: int | None = None,
        max_seconds: float | None = None,
    ) -> None:
        refuse_rounded(scene.bodies)
        self.name: str = tiling_for_contact(scene, tiling)
        self._scene = scene
        self._exact_only = exact_only
        self._max_events = max_events
        self._deadline = None if max_seconds is None else clock.monotonic() + max_seconds
        self._kinetic: Tiling | None = None
        self._begun = False

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the search so far, see docs/format.md."""
        kinetic = self._kinetic
        counts = Counts(0, 0, {}) if kinetic is None else kinetic.vertices.counters.now()
        return report(self._scene, kinetic, counts)

    def passed(self) -> Fraction | None:
        """See `Search.passed`."""
        if not self._begun:
            return None
        return proved_until(self._kinetic, self._scene._start)

    def run_to_contact(self) -> Contact | None:
        """The first contact in the closed time span of the scene; None if there is none.

        Raises:
            BudgetExceeded: if the events or the time are used up; its ``reached`` is a time up to
                which there is no contact.
        """
        with searching(self._deadline, self.passed):
            return self._first_contact()

    def _first_contact(self) -> Contact | None:
        scene = self._scene
        touches, overlaps = initial_touches(scene)
        if overlaps:
            return contact_of(scene, AlgebraicNumber(scene._start), touches, overlaps)
        self._begun = True
        kinetic = start_tiling(scene, self.name, scene._start, exact_only=self._exact_only)
        self._kinetic = kinetic
        events = 0
        try:
            if self._max_events is None:
                while kinetic.advance_many(scene._end, MANY):
                    self._check(kinetic, events)
            else:
                while (happened := kinetic.advance(scene._end)) is not None:
                    events += len(happened)
                    self._check(kinetic, events)
        except ContactFound as found:
            return contact_of(scene, kinetic.now, found.touches)
        return None

    def _check(self, kinetic: Tiling, events: int) -> None:
        """Check that neither the events nor the time are used up."""
        if self._max_events is not None and events > self._max_events:
            what = "number of events"
        elif self._deadline is not None and clock.monotonic() > self._deadline:
            what = "time"
        else:
            return
        now = kinetic.now
        reached = now.low if now.is_rational else now.canonical_interval()[0]
        raise BudgetExceeded(f"the {what} is used up", reached)
