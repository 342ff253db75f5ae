"""The first contact of some pairs from a time on: of each pair alone, by definition."""

from __future__ import annotations

from itertools import combinations
from random import Random

from exactpt import Planner, Scene, first_contact
from exactpt.scene.scene import scene_of
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from fuzz.questions.scenes import crowded_scene

__all__ = ["wrong_choice"]


def wrong_choice(random: Random) -> tuple[Scene, str, str | None]:
    """Return a scene, the query about it, and the fault of the result, if any."""
    scene = crowded_scene(random)
    kind = random.choice(["since", "ignoring", "planner"])
    bodies = list(scene.bodies)
    asked = bodies
    group = random.sample(bodies, random.randint(1, len(bodies) - 1))
    start = scene.exact_start
    if kind == "since":
        start += (scene.exact_end - scene.exact_start) * random.randint(0, 7) / 8
        group, contact = [], first_contact(scene, since=start)
    elif kind == "ignoring":
        contact = first_contact(scene, ignoring=[[body.name for body in group]])
    else:
        shape = random.choice(bodies)
        group = [body for body in bodies if body is not shape]
        asked = [*group, shape]
        contact = Planner(group, (scene.start, scene.end)).first_contact(shape, shape.motion)
    names, ignored = [body.name for body in asked], {body.name for body in group}
    counted = [pair for pair in combinations(names, 2) if not ignored.issuperset(pair)]
    counted += [(name, name) for name in names]
    expected = reference.first_contact(scene_of(asked, start, scene.exact_end), counted)
    difference = disagreement(expected, contact)
    return scene, kind, None if difference is None else f"{kind}: {difference}"
