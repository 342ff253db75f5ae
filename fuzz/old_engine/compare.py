"""The same questions to this version and to the old one, about one scene."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final, NamedTuple, TypeAlias

from exactpt import Scene
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
    """

    question: str
    arguments: Arguments
    new: Answer
    old: Answer

    @property
    def is_left_out(self) -> bool:
        """True if the old version has no answer: it refuses the scene, or fails."""
        return self.old.kind != "said"


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
    for question, arguments in _questions(scene, tilings, turn):
        old = engine.ask(question, scene, **arguments)
        new = Answer.of(answer_to(question, scene, arguments)) if old.kind == "said" else old
        yield Compared(question, arguments, new, old)


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
