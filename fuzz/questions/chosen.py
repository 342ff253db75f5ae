"""The first contact of some pairs from a time on: of each pair alone, by definition."""

from __future__ import annotations

from itertools import combinations
from random import Random

from exactpt import Body, Planner, Scene, first_contact
from exactpt.kernel.numbers import QQ
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
    start = scene.exact_start
    groups: list[list[str]] = []
    if kind == "since":
        start += (scene.exact_end - scene.exact_start) * random.randint(0, 7) / 8
        contact = first_contact(scene, since=start)
    elif kind == "ignoring":
        groups = _groups(random, [body.name for body in bodies])
        of_scene = random.randint(0, len(groups))
        scene = Scene(bodies, scene.time, ignoring=groups[:of_scene])
        exact_only = random.random() < 0.3
        contact = first_contact(scene, ignoring=groups[of_scene:], exact_only=exact_only)
    else:
        shape = bodies.pop(random.randrange(len(bodies)))
        groups = [[body.name for body in bodies]]
        contact = Planner(bodies, (scene.start, scene.end)).first_contact(shape, shape.motion)
        bodies.append(shape)
    difference = disagreement(_expected(bodies, groups, start, scene.exact_end), contact)
    return scene, kind, None if difference is None else f"{kind}: {difference}"


def _groups(random: Random, names: list[str]) -> list[list[str]]:
    """Return groups of bodies that ignore each other, which may overlap."""
    return [
        random.sample(names, random.randint(2, len(names))) for _ in range(random.randint(1, 3))
    ]


def _expected(
    bodies: list[Body], groups: list[list[str]], start: QQ, end: QQ
) -> reference.FirstContact | None:
    """Return the first contact, by definition, of the pairs that no group has both bodies of."""
    names = [body.name for body in bodies]
    counted = [
        pair
        for pair in combinations(names, 2)
        if not any(set(pair) <= set(group) for group in groups)
    ]
    alone = [(name, name) for name in names]
    return reference.first_contact(scene_of(bodies, start, end), [*counted, *alone])
