"""What all searches for the first contact have in common."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from exactpt.collision.contact import Contact

__all__ = ["Search"]


class Search(Protocol):
    """A search for the first contact of a scene."""

    @property
    def name(self) -> str | None:
        """The name of the tiling that is kept; None if there is none."""

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the search so far, see docs/format.md."""

    def run_to_contact(self) -> Contact | None:
        """The first contact in the closed time span of the scene; None if there is none.

        Raises:
            BudgetExceeded: if the events, the time or the memory are used up.
        """

    def passed(self) -> Fraction | None:
        """A rational time up to which there is no contact; None if nothing has been proved."""
