"""Questions that both versions know, and answers as texts that are compared byte for byte.

This file is imported by the witness, where `exactpt` is that of the checkout; and it is run as a
script where `exactpt` is the old one. So it needs nothing but the public interface of both.

As a script it reads a request a line (JSON) and writes an answer a line:

    {"question": "distance", "scene": {...}, "arguments": {"a": "b0", "b": "b1", "at": "1/2"}}
    {"said": "..."}             the answer
    {"refused": "..."}          the scene or the question is not accepted, with the reason
    {"failed": "..."}           the type and the function of any other exception

Its first line says what runs: {"version": "0.2.0", "where": "/.../exactpt/__init__.py"}.
"""

from __future__ import annotations

import inspect
import json
import sys
import traceback
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any, Final, TypeAlias

import exactpt
from exactpt import AlgebraicNumber, InputError, Scene

__all__ = ["QUESTIONS", "answer_to"]

Arguments: TypeAlias = "Mapping[str, Any]"
"""Values that JSON can hold; numbers that are not integers are texts like "1/3"."""


def _first_contact(scene: Scene, arguments: Arguments) -> object:
    """Answer by default, or with some of the options method, tiling and after_start."""
    contact = exactpt.first_contact(scene, **arguments)
    return None if contact is None else contact.to_json()


def _enclosed(scene: Scene, arguments: Arguments) -> object:  # noqa: ARG001
    enclosed = exactpt.first_contact_enclosed(scene)
    return None if enclosed is None else enclosed.to_json()


def _contacts(scene: Scene, arguments: Arguments) -> object:  # noqa: ARG001
    return [interval.to_json() for interval in exactpt.contacts(scene)]


def _intervals(scene: Scene, arguments: Arguments) -> object:
    found = exactpt.contact_intervals(scene, arguments["a"], arguments["b"])
    return [interval.to_json() for interval in found]


def _distance(scene: Scene, arguments: Arguments) -> object:
    at = Fraction(arguments["at"])
    there = exactpt.distance(scene, arguments["a"], arguments["b"], at=at)
    features = [[[f.vertex, f.edge] for f in pair] for pair in there.features]
    return str(there.core_squared), sorted(features, key=repr)


def _clearance(scene: Scene, arguments: Arguments) -> object:
    gap = exactpt.clearance(scene, arguments["a"], arguments["b"])
    return _number(gap.minimum.time), _number(gap.minimum.squared)


def _within(scene: Scene, arguments: Arguments) -> object:
    distance = Fraction(arguments["distance"])
    pair = arguments["a"], arguments["b"]
    # The old version measures by another norm unless this one is named; today's has no other.
    has_norms = "norm" in inspect.signature(exactpt.first_within).parameters
    options: dict[str, Any] = {"norm": "euclidean"} if has_norms else {}
    time = exactpt.first_within(scene, *pair, distance, **options)
    return None if time is None else _number(time)


def _run(scene: Scene, arguments: Arguments) -> object:
    """Answer with all events of a run by a tiling, with or without filters."""
    run = exactpt.Simulation(scene, **arguments)
    return [event.to_json() for event in run.run()]


def _number(number: AlgebraicNumber) -> object:
    """Return the same for equal numbers, however far they have been refined."""
    polynomial = [str(c) for c in number.minimal_polynomial()]
    return polynomial, [str(end) for end in number.canonical_interval()]


QUESTIONS: Final[dict[str, Callable[[Scene, Arguments], object]]] = {
    "first contact": _first_contact,
    "enclosed contact": _enclosed,
    "contacts": _contacts,
    "contact intervals": _intervals,
    "distance": _distance,
    "clearance": _clearance,
    "first within": _within,
    "run": _run,
}
"""The questions by name."""


def answer_to(question: str, scene: Scene, arguments: Arguments) -> dict[str, str]:
    """Return the answer to a question, a refusal or a failure; see the module."""
    try:
        return {"said": json.dumps(QUESTIONS[question](scene, arguments))}
    except InputError as error:
        return {"refused": str(error)}
    except Exception as error:  # whatever it is, the other version must do the same
        where = traceback.extract_tb(error.__traceback__)[-1].name
        return {"failed": f"{type(error).__name__} in {where}"}


def _reply(request: Mapping[str, Any]) -> dict[str, str]:
    try:
        scene = Scene.from_json(request["scene"])
    except InputError as error:
        return {"refused": str(error)}
    return answer_to(request["question"], scene, request["arguments"])


def _main() -> None:
    version = getattr(exactpt, "__version__", "0.2.0")
    _say({"version": version, "where": exactpt.__file__})
    for line in sys.stdin:
        _say(_reply(json.loads(line)))


def _say(value: object) -> None:
    sys.stdout.write(json.dumps(value) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    _main()
