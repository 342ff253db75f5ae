"""The answers of `exactpt.arrays` about scenes of the scope: many scenes in one call."""

from __future__ import annotations

import time as clock
from collections.abc import Sequence
from typing import NamedTuple

from exactpt.arrays import KINDS, Contacts
from exactpt.kernel.numbers import of_double
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.scene.scene import Scene
from exactpt.testing import truth
from exactpt.testing.questions import Question
from exactpt.testing.reference import FirstContact
from fuzz.limits import TooSlow, limit

__all__ = ["ARRAYS", "Verdict", "suits", "verdicts"]

ARRAYS = "arrays"

PATIENCE = 20.0
"""Seconds of processor time after which a call counts as hanging."""

WIDEST = 2.0**-40
"""Maximum width of the enclosure of a time."""


class Verdict(NamedTuple):
    """The judgement of an answer.

    Attributes:
        seconds: its share of the processor time of the call.
        fault: its fault; None if it is right.
    """

    seconds: float
    fault: str | None


def suits(scene: Scene) -> bool:
    """Return True if a scene is a question for arrays: two rigid bodies that translate."""
    return len(scene.bodies) == 2 and all(map(_translates, scene.bodies))


def _translates(body: Body) -> bool:
    rigid = bool(body.vertices) and all(f.degree <= 0 for vertex in body.vertices for f in vertex)
    return rigid and isinstance(body.motion, Translation)


def verdicts(scenes: Sequence[Scene], expected: Sequence[FirstContact | None]) -> list[Verdict]:
    """The judgement of each answer; if the call fails, each scene is asked for by itself."""
    began = clock.process_time()
    try:
        with limit(PATIENCE):
            contacts = truth.contacts_of([Question.from_scene(scene) for scene in scenes])
            faults = [
                _fault(scene, contacts, k, contact)
                for k, (scene, contact) in enumerate(zip(scenes, expected, strict=True))
            ]
    except (Exception, TooSlow) as error:  # any exception is a finding
        if len(scenes) == 1:
            return [Verdict(clock.process_time() - began, type(error).__name__)]
        pairs = zip(scenes, expected, strict=True)
        return [verdict for one in pairs for verdict in verdicts([one[0]], [one[1]])]
    share = (clock.process_time() - began) / max(1, len(scenes))
    return [Verdict(share, fault) for fault in faults]


def _fault(scene: Scene, contacts: Contacts, k: int, expected: FirstContact | None) -> str | None:
    """Return the fault of the result for a scene; None if it is right."""
    if expected is None or not contacts.found[k]:
        if (expected is None) == (not contacts.found[k]):
            return None
        return "found" if expected is None else "missed"
    low, high = (of_double(float(end[k])) for end in (contacts.low, contacts.high))
    if expected.time.compare_rational(low) < 0 or expected.time.compare_rational(high) > 0:
        return "time"
    if high - low > WIDEST:
        return "enclosure"
    if KINDS[contacts.kind[k]] != expected.kind:
        return "kind"
    printed = [int(row[k]) for row in (contacts.body, contacts.vertex)]
    printed += [int(row[k]) for row in (contacts.edge, contacts.other_vertex)]
    return None if printed == _first_incidence(scene, expected) else "pairs"


def _first_incidence(scene: Scene, expected: FirstContact) -> list[int]:
    """Body, vertex, edge and other vertex of the first incidence; -1 for what there is not."""
    numbers = {body.name: i for i, body in enumerate(scene.bodies)}
    rows = [
        [
            numbers[incidence.body],
            incidence.vertex,
            -1 if incidence.edge is None else incidence.edge,
            -1 if incidence.other_vertex is None else incidence.other_vertex,
        ]
        for incidence in expected.incidences
    ]
    return min(rows, default=[-1] * 4)
