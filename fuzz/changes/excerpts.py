"""Sub-scenes: a few of the bodies of a scene, so that a campaign covers many more scenes.

Failures involve few bodies (see tests/cases), and a scene of a few bodies takes a hundredth of
the time of a whole one. Every `WHOLE`-th scene is taken as it is.
"""

from __future__ import annotations

from collections.abc import Sequence
from random import Random
from typing import Final

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ
from exactpt.scene.groups import kept_groups
from exactpt.scene.scene import Scene
from exactpt.testing.scenes import generate
from fuzz.changes import awkward
from fuzz.changes.thin import SUFFIX, thinned

__all__ = ["scene_of", "subscene"]

WHOLE: Final = 64
"""One in this many scenes of a family is left whole."""

FEWEST, MOST = 4, 24
"""Range of the target number of vertices of a sub-scene: bodies are added until it is reached.

A body counts as three vertices at least: points and segments have infinitesimal copies of
their vertices."""


def scene_of(family: str, seed: int) -> Scene:
    """The scene that a campaign checks: usually a sub-scene of the family's.

    Args:
        family: the name of a family; with `fuzz.changes.thin.SUFFIX`, half of the bodies are
            replaced by parts of their boundaries; with `fuzz.changes.awkward.SUFFIX` the scene by
            an awkward image.
        seed: seed of the scene.
    """
    if family.endswith(awkward.SUFFIX):
        scene = scene_of(family.removesuffix(awkward.SUFFIX), seed)
        return awkward.awkward(scene, Random(f"{family}:{seed}"))
    name = family.removesuffix(SUFFIX)
    scene = generate(name, seed)
    if seed % WHOLE:
        # The text of the seed stays, so that a seed gives the same scene in every version.
        scene = subscene(scene, Random(f"excerpt of {name}:{seed}"))
    return scene if name == family else thinned(scene, Random(f"{family}:{seed}"))


def _gap(p: Sequence[Point], q: Sequence[Point]) -> QQ:
    """The gap of the bounding boxes of two bodies, in the maximum norm."""
    gap = QQ(0)
    for k in (0, 1):
        a, b = [v[k] for v in p], [v[k] for v in q]
        gap = max(gap, min(a) - max(b), min(b) - max(a))
    return gap


def subscene(scene: Scene, rng: Random) -> Scene:
    """Some bodies of a scene, in its order: random ones, or one and its nearest at a random time.

    At least two, if the scene has two; small sub-scenes are more likely than large ones.
    """
    enough = FEWEST + int((MOST - FEWEST) * rng.random() ** 3)
    order = list(range(len(scene.bodies)))
    rng.shuffle(order)
    if rng.random() < 0.7:
        time = scene.start + (scene.end - scene.start) * QQ(rng.randrange(17), 16)
        places = [body.at(time) for body in scene.bodies]
        first = order[:1]
        order.sort(key=lambda i: _gap(places[i], places[first[0]]))
    chosen: list[int] = []
    size = 0
    for i in order:
        if len(chosen) >= 2 and size >= enough:
            break
        chosen.append(i)
        size += max(3, scene.bodies[i].size)
    bodies = [scene.bodies[i] for i in sorted(chosen)]
    names = [[body.name for body in some] for some in (scene.bodies, bodies)]
    return Scene(bodies, (scene.start, scene.end), ignoring=kept_groups(scene.ignoring, *names))
