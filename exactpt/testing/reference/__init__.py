"""Definitions: what first contacts, distances and new contacts are, decided by brute force.

Each function answers a question from its definition, in exact arithmetic: every vertex against
every edge, at and between all times at which anything can change. There is no filter, no search
and no early end, so it is slow, and short enough to be read. It shares with the package the
arithmetic of numbers, polynomials and roots, scenes, bodies and the trajectories of vertices.
Answers are plain values, times are exact. `exactpt.testing.agreement` compares answers of the
package with them.

>>> from exactpt import Body, Scene, Translation
>>> from exactpt.testing import reference
>>> ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]))
>>> scene = Scene([ball, Body("wall", [(9, -5), (9, 5)])], time=(0, 10))
>>> reference.first_contact(scene).time
AlgebraicNumber('4')
"""

from exactpt.testing.reference.contact import (
    FirstContact,
    NamedIncidence,
    contact_intervals,
    counted_pairs,
    first_contact,
    first_meeting,
    incidences,
)
from exactpt.testing.reference.nearest import Least, Nearest, Place, least_distance, nearest
from exactpt.testing.reference.new import first_new_contact, new_contact, overlap
from exactpt.testing.reference.within import first_within, intervals_within

__all__ = [
    "FirstContact",
    "Least",
    "NamedIncidence",
    "Nearest",
    "Place",
    "contact_intervals",
    "counted_pairs",
    "first_contact",
    "first_meeting",
    "first_new_contact",
    "first_within",
    "incidences",
    "intervals_within",
    "least_distance",
    "nearest",
    "new_contact",
    "overlap",
]
