"""The first contact of some pairs from a time on: of each pair alone, by the reference search."""

from __future__ import annotations

from itertools import combinations
from random import Random

from exactpt import AlgebraicNumber, Contact, Planner, Scene, first_contact
from exactpt.kernel.numbers import QQ
from exactpt.scene.scene import scene_of
from fuzz.questions.all_pairs import first_contact_allpairs
from fuzz.questions.scenes import crowded_scene

__all__ = ["wrong_choice"]

Found = tuple[AlgebraicNumber, set[frozenset[str]]] | None


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
    ignored = {frozenset(two) for group in groups for two in combinations(group, 2)}
    expected = _first_of_pairs(scene, ignored, start)
    found = _answer(contact)
    return scene, kind, None if found == expected else f"{kind}: {found}, not {expected}"


def _groups(random: Random, names: list[str]) -> list[list[str]]:
    """Return groups of bodies that ignore each other, which may overlap."""
    return [
        random.sample(names, random.randint(2, len(names))) for _ in range(random.randint(1, 3))
    ]


def _first_of_pairs(scene: Scene, ignored: set[frozenset[str]], start: QQ) -> Found:
    """Return the first time at which a pair that is not ignored meets, and all pairs that do."""
    best: Found = None
    for two in combinations(scene.bodies, 2):
        if frozenset(body.name for body in two) in ignored:
            continue
        found = _answer(first_contact_allpairs(scene_of(two, start, scene.exact_end)))
        if found is None:
            continue
        if best is None or found[0] < best[0]:
            best = found
        elif found[0] == best[0]:
            best = best[0], best[1] | found[1]
    return best


def _answer(contact: Contact | None) -> Found:
    if contact is None:
        return None
    pairs = contact.initial_pairs or tuple((pair.body, pair.other) for pair in contact.pairs)
    return contact.time, {frozenset(names) for names in pairs}
