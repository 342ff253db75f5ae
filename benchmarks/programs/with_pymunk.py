"""pymunk (Munk2D, formerly Chipmunk): a space with two bodies, in 1000 steps."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

ABOUT: dict[str, Any] = {
    "name": "pymunk",
    "package": "pymunk",
    "module": "pymunk",
    "install": "pip install pymunk",
    "asked": "A space without gravity, each body with its velocity, 1000 steps; the time of the "
    "step in which `begin` is called. Vertices are given about the middle of their body, as the "
    "documentation requires. It detects collisions at the end of a step and no time between; "
    "each step rounds the places of bodies once.",
    "promises": [
        ["begin: Two shapes just started touching for the first time this step.",
         "docstring of pymunk.Space.on_collision"],
        ["Multiple calls with a smaller dt creates a more stable and accurate simulation.",
         "docstring of pymunk.Space.step"],
        ["another is to limit the velocity which is useful to prevent tunneling",
         "docstring of pymunk.Body.velocity_func"],
    ],
    "takes": {"shapes": ["convex", "segment", "point"], "motion": "linear"},
    "ways": {
        "": {
            "asked": "",
            "allows": {"of_coordinates": 2.0**-42, "late": 1 / 999, "brief": 1 / 999},
        },
    },
}  # fmt: skip

STEPS = 1000


def answer(question: dict[str, Any], way: str) -> float | None:  # noqa: ARG001
    """The end of the step in which the shapes begin to touch."""
    space, _ = space_of([question["a"], question["b"]])
    step = first_step(space, question["span"] / STEPS, STEPS)
    return None if step is None else question["span"] * step / STEPS


def space_of(bodies: list[dict[str, Any]]) -> tuple[Any, list[Any]]:
    """A space of bodies that do not turn, and its bodies."""
    import pymunk

    space = pymunk.Space()
    made = [shapes_of(body) for body in bodies]
    for objects in made:
        space.add(*objects)
    return space, [objects[0] for objects in made]


def first_step(
    space: Any,  # noqa: ANN401 - of pymunk
    seconds: float,
    steps: int,
    before: Callable[[int], None] = lambda _: None,
) -> int | None:
    """The first step in which shapes begin to touch; None if there is none.

    Args:
        space: the space.
        seconds: the length of a step.
        steps: number of steps.
        before: called before each step with its number.
    """
    begun: list[bool] = []
    space.on_collision(1, 1, begin=lambda *_: begun.append(True))
    for step in range(1, steps + 1):
        before(step)
        space.step(seconds)
        if begun:
            return step
    return None


def shapes_of(body: dict[str, Any]) -> list[Any]:
    """A body that does not turn, and the shapes of its convex parts (by default, one)."""
    import pymunk

    vertices = body["vertices"]
    middle = [sum(v[k] for v in vertices) / len(vertices) for k in (0, 1)]
    moving = pymunk.Body(1.0, float("inf"))
    moving.position = (middle[0], middle[1])
    moving.velocity = (body["x"][1], body["y"][1])
    made = [moving]
    for part in body.get("parts", [vertices]):
        local = [(x - middle[0], y - middle[1]) for x, y in part]
        if len(local) == 1:
            shape = pymunk.Circle(moving, 0.0, local[0])
        elif len(local) == 2:
            shape = pymunk.Segment(moving, local[0], local[1], 0.0)
        else:
            shape = pymunk.Poly(moving, local)
        shape.collision_type = 1
        made.append(shape)
    return made
