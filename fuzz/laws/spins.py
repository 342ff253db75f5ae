"""A law about spins: what is found of a `Spin` is what is found of its pieces.

The pieces of a `Spin` are made where a search needs them. A body that consists of all of them, as
`Pieces`, has each at once. So both have the same contacts, whatever was asked before: questions
about one scene share what was read of it.
"""

from __future__ import annotations

from fractions import Fraction
from random import Random

import exactpt
from exactpt import Body, Scene, Spin
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.questions import DISTANCES

__all__ = ["spins_are_their_pieces"]


def spins_are_their_pieces(scene: Scene, random: Random) -> str:
    """First contacts and approaches of bodies that spin are those of their pieces, in any order."""
    refuse_unless(any(isinstance(body.motion, Spin) for body in scene.bodies))
    pieces = Scene([_in_pieces(body, scene) for body in scene.bodies], scene.time)
    distance = Fraction(random.choice(DISTANCES))
    later = scene.start + (scene.end - scene.start) * Fraction(random.randint(1, 7), 8)
    questions = ["contact", "new contact", "within", "since"]
    random.shuffle(questions)
    for question in questions:
        check_equal(
            question,
            _answer(question, scene, distance, later),
            _answer(question, pieces, distance, later),
        )
    return "a contact" if exactpt.first_contact(scene) else "no contact"


def _in_pieces(body: Body, scene: Scene) -> Body:
    """Return a body that consists of the pieces of its spin in the time span."""
    motion = body.motion
    if not isinstance(motion, Spin):
        return body
    return body.with_motion(motion.pieces_during(scene.start, scene.end))


def _answer(question: str, scene: Scene, distance: Fraction, later: Fraction) -> object:
    if question == "within":
        return exactpt.first_within(scene, distance=distance)
    if question == "since":
        contact = exactpt.first_contact(scene, since=later)
    else:
        contact = exactpt.first_contact(scene, after_start=question == "new contact")
    return None if contact is None else contact.to_json()
