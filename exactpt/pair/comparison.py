"""Comparison of two first contacts of one scene."""

from __future__ import annotations

from exactpt.pair.contact import Contact


def contrast(expected: Contact | None, found: Contact | None) -> str | None:
    """Return the first attribute in which two contacts of one scene differ; None if they agree.

    One of "missed", "found" (only one of the two is a contact), "time", "kind", "pairs" and
    "initial_pairs".
    """
    if expected is None or found is None:
        if (expected is None) == (found is None):
            return None
        return "found" if expected is None else "missed"
    if found.time.compare(expected.time) != 0:
        return "time"
    for what in ("kind", "pairs", "initial_pairs"):
        if getattr(found, what) != getattr(expected, what):
            return what
    return None


def in_words(contact: Contact | None) -> str:
    """Return one line of text: the time, the kind and the first four incidences of a contact."""
    if contact is None:
        return "finds no contact"
    pairs = ", ".join(
        f"{p.body}:{p.vertex} on "
        + (f"{p.other}:{p.other_vertex}" if p.edge is None else f"edge {p.edge} of {p.other}")
        for p in contact.pairs[:4]
    )
    more = f" and {len(contact.pairs) - 4} more" if len(contact.pairs) > 4 else ""
    return f"finds t = {float(contact.time)!r}, {contact.kind}: {pairs}{more}"
