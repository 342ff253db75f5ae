"""Cases that break a law today, each with the reason; a known one that holds fails the run."""

from __future__ import annotations

from typing import Final, NamedTuple

__all__ = ["KNOWN", "Known", "reason_of"]


class Known(NamedTuple):
    """A case that breaks a law, to be mended.

    Attributes:
        case: the case, as `fuzz.laws.runner.Case` writes it.
        reason: why the law is broken there.
    """

    case: str
    reason: str


HOLES: Final = "where a body with holes comes or goes, the whole tiling is built anew"

KNOWN: Final[tuple[Known, ...]] = (
    Known("cost/changes whole/frames:0:4", HOLES),
    Known("cost/changes whole/frames:0:9", HOLES),
    Known("cost/changes whole/frames:0:14", HOLES),
    Known("cost/changes whole/frames:0:19", HOLES),
)
"""The known cases. Who mends one removes it here."""


def reason_of(case: str) -> str | None:
    """Return the reason of a known case; None if the case is not known."""
    return next((known.reason for known in KNOWN if known.case == case), None)
