"""Box2D 2.3 by pybox2d: the time of impact of two convex polygons that are swept."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

ABOUT: dict[str, Any] = {
    "name": "Box2D 2.3",
    "package": "box2d",
    "module": "Box2D",
    "install": "pip install box2d",
    "asked": "`b2TimeOfImpact` of two polygons (or edges), each about its first vertex, with "
    "sweeps that do not turn, tMax 1. "
    "It seeks the time at which the distance is linearSlop = 0.005, within a quarter of it; "
    "e_overlapped is taken as a contact at the start, e_failed as a failure. In single precision, "
    "so only numbers that it represents are used, and only sizes for which it is tuned.",
    "promises": [
        [("Compute the upper bound on time before two shapes penetrate. Time is represented as a "
         "fraction between [0,tMax]. This uses a swept separating axis and may miss some "
         "intermediate, non-tunneling collision."), "docstring of Box2D.b2TimeOfImpact"],
        [("Box2D has been tuned to work well with moving shapes between 0.1 and 10 meters. [...] "
         "Static shapes may be up to 50 meters long without trouble."), "Box2D manual, Units"],
    ],
    "takes": {
        "shapes": ["convex", "segment"],
        "motion": "linear",
        "vertices": 16,
        "digits": 24,
        "least": 0.1,
        "most": 50.0,
    },
    "ways": {
        "": {"asked": "", "allows": {"distance": 0.00625, "of_coordinates": 2.0**-20}},
    },
}  # fmt: skip


def answer(question: dict[str, Any], way: str) -> float | None:  # noqa: ARG001
    """The time at which the shapes are about the slop apart."""
    import Box2D

    state, share = impact_of(question)()
    if state == Box2D.b2TOIOutput.e_failed:
        raise RuntimeError("e_failed")
    return time_of(state, share, question["span"])


def impact_of(question: dict[str, Any]) -> Callable[[], tuple[int, float]]:
    """The function that finds the state and the share of the span."""
    import Box2D

    a, b, span = question["a"], question["b"], question["span"]
    given = {
        "shapeA": shape_of(a),
        "shapeB": shape_of(b),
        "sweepA": sweep(a, span),
        "sweepB": sweep(b, span),
    }
    return lambda: Box2D.b2TimeOfImpact(**given, tMax=1.0)


def time_of(state: int, share: float, span: float) -> float | None:
    """The time of a state and a share."""
    import Box2D

    return None if state == Box2D.b2TOIOutput.e_separated else share * span


def shape_of(body: dict[str, Any]) -> Any:  # noqa: ANN401 - of Box2D
    """A polygon, or an edge if there are two vertices."""
    import Box2D

    left, low = body["vertices"][0]
    vertices = [(x - left, y - low) for x, y in body["vertices"]]
    if len(vertices) == 2:
        return Box2D.b2EdgeShape(vertices=vertices)
    return Box2D.b2PolygonShape(vertices=vertices)


def sweep(body: dict[str, Any], span: float) -> Any:  # noqa: ANN401 - of Box2D
    """The motion of a body."""
    import Box2D

    x, y = body["vertices"][0]
    end = (x + body["x"][1] * span, y + body["y"][1] * span)
    return Box2D.b2Sweep(localCenter=(0.0, 0.0), c0=(x, y), c=end, a0=0.0, a=0.0, alpha0=0.0)
