"""A look at a scene of the scope: all methods beside the reference, and now and then a tiling."""

from __future__ import annotations

import time as clock
from typing import Final, NamedTuple

from exactpt.collision.allpairs import first_contact_allpairs
from exactpt.collision.comparison import contrast
from exactpt.collision.contact import Contact
from exactpt.kernel.numbers import ZZ
from exactpt.scene.scene import Scene
from fuzz.cases import limit
from fuzz.small_scope.scope import Planned
from fuzz.statics import run_and_audit
from fuzz.witnesses import contact_by, tilings_of

__all__ = ["AUDITED", "Answer", "Look", "look"]

AUDITED: Final = 16
"""Of so many scenes in one the tiling is compared with the static one between events."""

PATIENCE: Final = 20.0
"""A method that takes more seconds than this, of processor time, hangs."""


class Answer(NamedTuple):
    """What a method says of a scene.

    Attributes:
        method: "pairs", the name of a tiling, or "static" and that.
        seconds: of processor time.
        fault: what is wrong with it; None: nothing.
    """

    method: str
    seconds: float
    fault: str | None


class Look(NamedTuple):
    """What was seen in a scene.

    Attributes:
        planned: the scene.
        contact: whether there is a contact.
        as_planned: whether it is at the planned time.
        answers: of all methods.
    """

    planned: Planned
    contact: bool
    as_planned: bool
    answers: list[Answer]


def look(planned: Planned) -> Look:
    """Compare all methods with the reference."""
    scene = planned.scene
    expected = first_contact_allpairs(scene)
    names = tilings_of(scene)
    answers = [_answer(scene, name, expected) for name in ("pairs", *names)]
    turn, rest = divmod(planned.number, AUDITED)
    if rest == 0:
        answers.append(_audit(scene, names[turn % len(names)]))
    return Look(planned, expected is not None, _as_planned(planned, expected), answers)


def _as_planned(planned: Planned, contact: Contact | None) -> bool:
    local = planned.clock.local[0]
    return contact is not None and not contact.time.sign_of(tuple(ZZ(c) for c in local))


def _answer(scene: Scene, name: str, expected: Contact | None) -> Answer:
    began = clock.process_time()
    try:
        with limit(PATIENCE):
            fault = contrast(expected, contact_by(scene, name))
    except Exception as error:  # whatever breaks is a finding
        fault = type(error).__name__
    return Answer(name, clock.process_time() - began, fault)


def _audit(scene: Scene, name: str) -> Answer:
    began = clock.process_time()
    fault = None
    try:
        with limit(PATIENCE):
            run_and_audit(scene, name, middle=False)
    except Exception as error:
        fault = type(error).__name__
    return Answer(f"static {name}", clock.process_time() - began, fault)
