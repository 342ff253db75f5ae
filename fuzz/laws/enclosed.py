"""Laws about enclosed motion: bounds of a contact contain the time of true turns."""

from __future__ import annotations

from random import Random

from exactpt import PosePath, Scene, Spin
from fuzz.laws.law import refuse_unless
from fuzz.questions.spinning import case_of
from fuzz.witnesses import Difference

__all__ = ["bounds_contain_the_truth"]


def bounds_contain_the_truth(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """The bounds of an enclosed contact contain the time by sines to 200 digits, and are narrow."""
    refuse_unless(any(isinstance(body.motion, (Spin, PosePath)) for body in scene.bodies))
    case = case_of(scene)
    if case.fault is not None:
        raise Difference("bounds", case.fault)
    return case.kind
