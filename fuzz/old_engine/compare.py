"""The same questions to this version and to the old one, about one scene.

Answers are the same text, byte for byte, with one exception that is declared here: the bounds of an
enclosed contact of bodies that spin or follow a path. Of these it is promised that the true time is
between them, not which numbers they are, and three things have changed on purpose:

* `exactpt.motion.displacement` bounds the distance of a point from the pivot by a square root.
  If it is rational, this version takes it itself; the old one took a number that is up to
  1 + 2^-21 times as large. Otherwise both round it up in the same way, this version at most as far.
* `exactpt.pair.sure` proves more contacts to be certain, of convex bodies, so upper bounds differ.
* At the start, a touch is not certain if an error of the place is stated.

So no body is displaced further than in the old version. If the old one excludes a contact, this one
does; and no lower bound is earlier. What the two say must be true of one and the same time.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final, NamedTuple, TypeAlias

from exactpt import AlgebraicNumber, PosePath, Scene, Spin
from fuzz.old_engine.answers import answer_to
from fuzz.old_engine.process import Answer, OtherEngine

__all__ = ["Compared", "compared"]

Arguments: TypeAlias = "Mapping[str, Any]"

SHARES: Final = ((0, 1), (1, 2), (1, 3), (5, 7))
"""Parts of the time span at which a distance is asked for."""

DISTANCES: Final = ("0", "1/3", "1", "5/2")


class Compared(NamedTuple):
    """A question to both versions.

    Attributes:
        question: its name.
        arguments: its arguments.
        new, old: the answers.
        are_bounds: True if the answers are bounds of a time that neither version knows exactly.
    """

    question: str
    arguments: Arguments
    new: Answer
    old: Answer
    are_bounds: bool = False

    @property
    def is_left_out(self) -> bool:
        """True if the old version has no answer: it refuses the scene, or fails."""
        return self.old.kind != "said"

    @property
    def agrees(self) -> bool:
        """True if both answers are the same text, or bounds that can be those of one time."""
        if self.new == self.old:
            return True
        is_said = self.new.kind == self.old.kind == "said"
        return self.are_bounds and is_said and _are_of_one_time(self.new.text, self.old.text)


class _Bounds(NamedTuple):
    """Bounds of the time of a first contact; ``high`` is None if it is not certain."""

    low: AlgebraicNumber
    high: AlgebraicNumber | None

    @classmethod
    def of(cls, text: str) -> _Bounds | None:
        """Return the bounds of an answer; None if there is no contact for sure."""
        found = json.loads(text)
        if found is None:
            return None
        high = found["high"]
        return cls(_number(found["low"]), None if high is None else _number(high))


def _number(data: Mapping[str, Any]) -> AlgebraicNumber:
    """Return the number that `AlgebraicNumber.to_json` has written."""
    polynomial = tuple(map(int, data["polynomial"]))
    return AlgebraicNumber.root(polynomial, data["low"], data["high"])


def _are_of_one_time(new: str, old: str) -> bool:
    """Return True if the bounds of both versions can be those of one time; see the module."""
    bounds, bounds_of_old = _Bounds.of(new), _Bounds.of(old)
    if bounds is None:
        return bounds_of_old is None or bounds_of_old.high is None
    if bounds_of_old is None or bounds.low < bounds_of_old.low:
        return False
    highs = [high for high in (bounds.high, bounds_of_old.high) if high is not None]
    return all(bounds.low <= high for high in highs)


def compared(
    scene: Scene, tilings: Sequence[str], turn: int | None, engine: OtherEngine
) -> Iterator[Compared]:
    """Ask both versions about a scene; the new one only if the old one has an answer.

    Args:
        scene: the scene.
        tilings: the tilings that must support it.
        turn: selects some of the questions, see `fuzz.witnesses.Witness`; None: all of them.
        engine: the running old version.
    """
    is_inexact = any(isinstance(body.motion, (Spin, PosePath)) for body in scene.bodies)
    for question, arguments in _questions(scene, tilings, turn):
        old = engine.ask(question, scene, **arguments)
        new = Answer.of(answer_to(question, scene, arguments)) if old.kind == "said" else old
        are_bounds = question == "enclosed contact" and is_inexact
        yield Compared(question, arguments, new, old, are_bounds)


def _questions(
    scene: Scene, tilings: Sequence[str], turn: int | None
) -> Iterator[tuple[str, Arguments]]:
    yield "first contact", {}
    yield "enclosed contact", {}
    ways: list[tuple[str, Arguments]] = [
        ("first contact", {"method": "pairs"}),
        ("first contact", {"after_start": True}),
        ("contacts", {}),
        *(("first contact", {"method": "kinetic", "tiling": name}) for name in tilings),
    ]
    two = list(_about_two(scene, turn or 0))
    if turn is None:
        yield from [*ways, *two]
    else:
        yield ways[turn % len(ways)]
        if two:
            yield two[turn % len(two)]


def _about_two(scene: Scene, turn: int) -> Iterator[tuple[str, Arguments]]:
    """Yield the questions about two bodies: the pairs take turns."""
    n = len(scene.bodies)
    if n < 2:
        return
    first = turn % n
    other = (first + 1 + turn // n % (n - 1)) % n
    names = {"a": scene.bodies[first].name, "b": scene.bodies[other].name}
    part, whole = SHARES[turn % len(SHARES)]
    at = scene.start + (scene.end - scene.start) * part / whole
    yield "contact intervals", names
    yield "distance", {**names, "at": str(at)}
    yield "clearance", names
    yield "first within", {**names, "distance": DISTANCES[turn % len(DISTANCES)]}
