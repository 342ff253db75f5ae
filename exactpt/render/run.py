"""A scene run for its pictures: the tiling within reach at every step, the contact at its end."""

from __future__ import annotations

import time as clock
from typing import TYPE_CHECKING, final

from exactpt.collision.contact import contact_of
from exactpt.collision.initial import initial_touches
from exactpt.collision.tilings import start_tiling, tiling_for
from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.tiling.events import ContactFound, TilingEvent

if TYPE_CHECKING:
    from exactpt.collision.contact import Contact
    from exactpt.kernel.numbers import QQ
    from exactpt.scene.scene import Scene
    from exactpt.tiling.tiling import Tiling

__all__ = ["Run"]


@final
class Run:
    """A scene on its way to its end or its first contact.

    Args:
        scene: what moves.
        tiling: which tiling to keep.
        max_events: raise `BudgetExceeded` beyond so many events.
        max_seconds: raise `BudgetExceeded` after this time.

    Attributes:
        scene: the scene.
        name: the name of the tiling.
        kinetic: the tiling; at a contact the one just before it. None if the bodies touch
            at the start.
        contact: the first contact, once it has been reached.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        tiling: str = "auto",
        max_events: int | None = None,
        max_seconds: float | None = None,
    ) -> None:
        self.scene = scene
        self.name = tiling_for(scene, tiling)
        self.kinetic: Tiling | None = None
        self.contact: Contact | None = None
        self._events = 0
        self._max_events = max_events
        self._deadline = None if max_seconds is None else clock.monotonic() + max_seconds
        touches, overlaps = initial_touches(scene)
        if overlaps:
            self.contact = contact_of(scene, AlgebraicNumber(scene.start), touches, overlaps)
        else:
            self.kinetic = start_tiling(scene, self.name, scene.start)

    @property
    def now(self) -> AlgebraicNumber:
        """The current time."""
        if self.kinetic is None:
            return AlgebraicNumber(self.scene.start)
        return self.kinetic.now

    def advance(self, until: QQ) -> list[TilingEvent] | None:
        """Let the events of the next time happen, if that is not after ``until``.

        Returns:
            The events, perhaps none that show; None at ``until`` or at the first contact.

        Raises:
            BudgetExceeded: if the bounds are reached.
        """
        if self.kinetic is None or self.contact is not None:
            return None
        try:
            events = self.kinetic.advance(until)
        except ContactFound as found:
            self.contact = contact_of(self.scene, self.kinetic.now, found.touches)
            return None
        self._events += len(events or ())
        self._check_budget()
        return events

    def _check_budget(self) -> None:
        late = self._deadline is not None and clock.monotonic() > self._deadline
        many = self._max_events is not None and self._events > self._max_events
        if late or many:
            reached = self.now.simplified().canonical_interval()[0]
            what = "time" if late else "number of events"
            raise BudgetExceeded(f"the {what} is used up at t = {float(reached)!r}", reached)
