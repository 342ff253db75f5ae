"""The common part of all searches for the first contact."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from exactpt.pairs.contact import Contact


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
