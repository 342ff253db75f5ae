"""The definitions that laws compare with: the only module of the laws that imports references."""

from __future__ import annotations

from fuzz.questions import brute
from fuzz.questions.all_pairs import first_contact_allpairs as first_contact
from fuzz.questions.reference import (
    contact_intervals,
    first_within,
    intervals_within,
    meet_at,
    nearest,
    tracks,
)
from fuzz.questions.renewal import first_new_contact
from fuzz.questions.visibility_graph import VisibilityGraph, length_of

__all__ = [
    "VisibilityGraph",
    "brute",
    "contact_intervals",
    "first_contact",
    "first_new_contact",
    "first_within",
    "intervals_within",
    "length_of",
    "meet_at",
    "nearest",
    "tracks",
]
