"""The check of a scene of the scope: all methods against the reference, sometimes a tiling."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Final, NamedTuple

from exactpt import Contact, InputError, Scene, Simulation, first_contact, stop
from exactpt.kernel.numbers import ZZ
from exactpt.motion.outline import straight_pieces
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement, plain_contact
from exactpt.testing.audits import run_and_audit
from exactpt.testing.reference import FirstContact
from fuzz.changes.images import halved
from fuzz.limits import TooSlow, limit
from fuzz.normals import wrong_normal
from fuzz.small_scope.by_arrays import ARRAYS, suits, verdicts
from fuzz.small_scope.scope import Planned
from fuzz.witnesses import check_proof, contact_by, tilings_of

__all__ = ["AUDITED", "Answer", "Look", "are_straight", "look", "looks", "looks_at_proofs"]

AUDITED: Final = 16
"""One in this many scenes gets an audit of a tiling between events, and another one a simulation
that continues after the contact."""

REFERENCE: Final = "reference"

RENEWED: Final = 4
"""One in this many scenes is asked for the first new contact, also with edges cut in two."""

AFTER_START: Final = "after start"
NORMALS: Final = "normals"

PATIENCE: Final = 20.0
"""Seconds of processor time after which a method counts as hanging."""


class Answer(NamedTuple):
    """The answer of a method about a scene.

    Attributes:
        method: "auto", "pairs", "arrays", "after start", "normals", the name of a tiling, or
            "static" or "going on" and such a name.
        seconds: processor time.
        fault: the fault of the result; None if it is right.
    """

    method: str
    seconds: float
    fault: str | None


class Look(NamedTuple):
    """The result of a scene.

    Attributes:
        planned: the scene.
        contact: the first contact by definition; None if there is none.
        as_planned: whether it is at the planned time.
        answers: the answers of all methods.
    """

    planned: Planned
    contact: FirstContact | None
    as_planned: bool
    answers: list[Answer]

    @property
    def has_reference(self) -> bool:
        """Return True if the reference has a result."""
        return self.answers[0].method != REFERENCE


def are_straight(scene: Scene) -> bool:
    """Return True if all bodies move straight, piece by piece: "auto" is then a sweep over rows."""
    return all(straight_pieces(body) is not None for body in scene.bodies)


def looks(several: Sequence[Planned]) -> list[Look]:
    """Compare all methods with the reference in each of some scenes, arrays in one call."""
    seen = [look(planned) for planned in several]
    asked = [one for one in seen if one.has_reference and suits(one.planned.scene)]
    judged = verdicts([one.planned.scene for one in asked], [one.contact for one in asked])
    for one, (seconds, fault) in zip(asked, judged, strict=True):
        one.answers.append(Answer(ARRAYS, seconds, fault))
    return seen


def look(planned: Planned) -> Look:
    """Compare methods with the reference: all but arrays.

    Where bodies do not all move straight, "auto" is "pairs", and is not asked.
    """
    scene = planned.scene
    try:
        expected = reference.first_contact(scene)
    except Exception as error:  # any exception is a finding
        broken = Answer(REFERENCE, 0.0, type(error).__name__)
        return Look(planned, None, as_planned=False, answers=[broken])

    def compare(name: str) -> str | None:
        return _fault_of(expected, contact_by(scene, name))

    def go_on(name: str) -> str | None:
        return _fault_of(expected, _before_going_on(scene, name))

    def audit(name: str) -> None:
        run_and_audit(scene, name, middle=False)

    def judge_normals(_: str) -> str | None:
        return wrong_normal(scene, contact_by(scene, "pairs"))

    names = tilings_of(scene)
    searches = ("auto", "pairs") if are_straight(scene) else ("pairs",)
    answers = [_answer(name, compare, name) for name in (*searches, *names)]
    answers.append(_answer(NORMALS, judge_normals, ""))
    turn, rest = divmod(planned.number, AUDITED)
    name = names[turn % len(names)]
    if rest == 0:
        answers.append(_answer(f"static {name}", audit, name))
    elif rest == AUDITED // 2:
        answers.append(_answer(f"going on {name}", go_on, name))
    elif rest % RENEWED == 1:
        answers.append(_answer(AFTER_START, lambda _: _new_contact(scene, expected), ""))
    return Look(planned, expected, _as_planned(planned, expected), answers)


def looks_at_proofs(several: Sequence[Planned]) -> list[Look]:
    """Check the proof by one of the tilings in C++, and of one scene in 32 in Python too."""
    return [_look_at_proof(planned) for planned in several]


def _look_at_proof(planned: Planned) -> Look:
    names = tilings_of(planned.scene)
    name, in_python = names[planned.number % len(names)], planned.number % 32 == 0

    def check(tiling: str) -> None:
        check_proof(planned.scene, tiling, in_python=in_python)

    answer = _answer(f"proof {name}", check, name)
    return Look(planned, contact=None, as_planned=False, answers=[answer])


def _fault_of(expected: FirstContact | None, contact: Contact | None) -> str | None:
    difference = disagreement(expected, contact)
    return None if difference is None else difference.what


def _as_planned(planned: Planned, contact: FirstContact | None) -> bool:
    local = planned.clock.local[0]
    return contact is not None and not contact.time.sign_of(tuple(ZZ(c) for c in local))


def _answer(method: str, judge: Callable[[str], str | None], name: str) -> Answer:
    began = clock.process_time()
    try:
        with limit(PATIENCE):
            fault = judge(name)
    except (Exception, TooSlow) as error:  # any exception is a finding
        fault = type(error).__name__
    return Answer(method, clock.process_time() - began, fault)


def _new_contact(scene: Scene, contact: FirstContact | None) -> str | None:
    """Return the fault of the first new contact, from the planned one on if it is simple."""
    if contact is not None and contact.time.is_rational and contact.time < scene.end:
        with suppress(InputError):  # a body that touches itself then
            scene = scene.since(contact.time.low)
    expected = reference.first_new_contact(scene)
    for same, what in ((scene, "new contact"), (halved(scene), "new contact of cut edges")):
        found = plain_contact(first_contact(same, after_start=True))
        if expected != (None if found is None else (found.time, found.names)):
            return what
    return None


def _before_going_on(scene: Scene, tiling: str) -> Contact | None:
    """The first contact of a simulation in which bodies stop when they touch."""
    met: list[Contact] = []

    def respond(simulation: Simulation, contact: Contact) -> None:
        met.append(contact)
        stop(simulation, contact)

    simulation = Simulation(scene, tiling=tiling)
    for _ in simulation.run(on_contact=respond):
        pass
    return met[0] if met else simulation.contact
