"""Laws about limits of time: a search ends at a look at the clock, and what it reached is true."""

from __future__ import annotations

from random import Random
from typing import Final

from exactpt import BudgetExceeded, Contact, Scene, first_contact
from exactpt.kernel.numbers import rational
from exactpt.testing import ending_at
from fuzz.laws.law import refuse_unless
from fuzz.witnesses import Difference, tilings_of

__all__ = ["ended_search_is_true"]

LATE: Final = 1
"""Number of looks after the strike within which a search ends: loops within loops look too."""


def ended_search_is_true(scene: Scene, random: Random) -> str:
    """A search whose time is over ends at once, and no contact is before what it has reached."""
    way = random.choice(["auto", "pairs", *tilings_of(scene)])
    with ending_at(None) as whole:
        contact = _search(scene, way)
    refuse_unless(whole.looks >= 2)
    strike = random.randint(2, whole.looks)  # at the first look the limit begins
    reached = None
    with ending_at(strike) as clock:
        try:
            _search(scene, way)
        except BudgetExceeded as spent:
            reached = spent.reached
    if clock.looks_after > LATE:
        raise Difference(f"{way}: late", f"{clock.looks_after} looks after that at {strike}")
    if contact is not None and reached is not None:
        if contact.time.compare_rational(rational(reached)) <= 0:
            raise Difference(f"{way}: reached", f"{reached}, but a contact at {contact.time}")
        return f"{way}, before a contact"
    return f"{way}, {'nothing reached' if reached is None else 'no contact'}"


def _search(scene: Scene, way: str) -> Contact | None:
    if way in ("auto", "pairs"):
        return first_contact(scene, method=way, max_seconds=1.0)
    return first_contact(scene, tiling=way, max_seconds=1.0)
