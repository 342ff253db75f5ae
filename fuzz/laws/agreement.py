"""Laws about one question: its ways agree, with its definition and with each other."""

from __future__ import annotations

from random import Random

from exactpt import Scene
from fuzz.laws.law import Check
from fuzz.laws.questions import QUESTIONS, Answer
from fuzz.witnesses import Difference, LeftOutError

__all__ = ["as_defined", "two_ways_agree", "way_is_as_defined"]


def as_defined(question: str, *, several: int | None = None) -> Check:
    """Return the check that every way, or several of them, answer as the definition does."""
    asked = QUESTIONS[question]

    def check(scene: Scene, random: Random) -> str:
        """Each way to ask a question agrees with its definition."""
        about = asked.draw(scene, random)
        expected = asked.define(scene, about)
        names = list(asked.ways)
        for name in random.sample(names, min(several or len(names), len(names))):
            try:
                found = asked.ways[name](scene, about)
            except LeftOutError:
                continue
            found = asked.comparable(found)
            if found != expected:
                raise Difference(name, f"{found!r}, by definition {expected!r}")
        return asked.kind(expected)

    return check


def way_is_as_defined(question: str, way: str) -> Check:
    """Return the check that one way answers as the definition does, for more cases in its time."""
    asked = QUESTIONS[question]

    def check(scene: Scene, random: Random) -> str:
        """One way to ask a question agrees with its definition."""
        about = asked.draw(scene, random)
        expected = asked.define(scene, about)
        found = asked.comparable(asked.ways[way](scene, about))
        if found != expected:
            raise Difference(way, f"{found!r}, by definition {expected!r}")
        return asked.kind(expected)

    return check


def two_ways_agree(question: str) -> Check:
    """Return the check that two ways, chosen at random, give the same answer."""
    asked = QUESTIONS[question]

    def check(scene: Scene, random: Random) -> str:
        """Two ways to ask a question give the same answer."""
        about = asked.draw(scene, random)
        answers: dict[str, Answer] = {}
        for name in random.sample(list(asked.ways), len(asked.ways)):
            try:
                answers[name] = asked.ways[name](scene, about)
            except LeftOutError:
                continue
            if len(answers) == 2:
                break
        else:
            raise LeftOutError
        (one, found), (other, expected) = answers.items()
        if found != expected:
            raise Difference(f"{one} and {other}", f"{found!r} and {expected!r}")
        return asked.kind(found)

    return check
