"""A search for the first contact by a tiling that is kept up to it."""

from __future__ import annotations

from fractions import Fraction

from exactpt.kernel.budget import Budget, searching
from exactpt.motion.tileable import refuse_untileable
from exactpt.pair.contact import Contact
from exactpt.scene.groups import NO_TILING, refuse_groups
from exactpt.scene.scene import Scene
from exactpt.tiling.driver import Driver
from exactpt.tiling.report import report
from exactpt.tiling.start import tiling_for_contact


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
        driver: drives the tiling.

    Raises:
        InputError: if the tiling does not exist, or does not support these bodies.
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
        refuse_untileable(scene.bodies)
        refuse_groups(scene, NO_TILING)
        self.name: str = tiling_for_contact(scene, tiling)
        self._scene = scene
        self._exact_only = exact_only
        self._budget = Budget(max_events, max_seconds)
        self.driver = Driver(scene, budget=self._budget)

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the search so far, see docs/format.md."""
        return report(self._scene, self.driver.tiled.tiling)

    def contact_free_until(self) -> Fraction | None:
        """See `Search.contact_free_until`."""
        return self.driver.contact_free_until()

    def run_to_contact(self) -> Contact | None:
        """Return the first contact in the closed time span of the scene; None if there is none.

        Raises:
            BudgetExceeded: if the events or the time are used up; its ``reached`` is a time up to
                which no contact exists.
        """
        with searching(None, self.contact_free_until), self._budget.held():
            contact = self.driver.start(self.name, exact_only=self._exact_only)
            return self.driver.run(self._scene.exact_end) if contact is None else contact
