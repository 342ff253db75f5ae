"""Excerpts: a few of the bodies of a scene, so that a campaign sees many more scenes.

What goes wrong goes wrong among a few bodies (see the corpus), and a scene of a few costs
a hundredth of a whole one. Whole scenes still come, now and then.
"""

from __future__ import annotations

from collections.abc import Sequence
from random import Random
from typing import Final

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ
from exactpt.scene.generate import generate
from exactpt.scene.scene import Scene
from fuzz.thin import SUFFIX, thinned

__all__ = ["scene_of", "subscene"]

WHOLE: Final = 64
"""Of so many scenes of a family one is left whole."""

FEWEST, MOST = 4, 24
"""Vertices of an subscene; one more body is taken while there are fewer. (A point counts as
three, a segment too: what has no inside has copies, which move apart from each other.)"""


def scene_of(family: str, seed: int) -> Scene:
    """The scene that a campaign looks at: mostly an subscene of the family's.

    Args:
        family: its name; with `fuzz.thin.SUFFIX`, half of the bodies are thinned.
        seed: of the scene.
    """
    name = family.removesuffix(SUFFIX)
    scene = generate(name, seed)
    if seed % WHOLE:
        scene = subscene(scene, Random(f"excerpt of {name}:{seed}"))
    return scene if name == family else thinned(scene, Random(f"{family}:{seed}"))


def _gap(p: Sequence[Point], q: Sequence[Point]) -> QQ:
    """How far the boxes of two bodies are apart, in x or in y."""
    gap = QQ(0)
    for k in (0, 1):
        a, b = [v[k] for v in p], [v[k] for v in q]
        gap = max(gap, min(a) - max(b), min(b) - max(a))
    return gap


def subscene(scene: Scene, rng: Random) -> Scene:
    """Some bodies of a scene, in its order: at random, or one and those near it at some time.

    At least two, if there are so many; few vertices are more likely than many.
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
    return Scene([scene.bodies[i] for i in sorted(chosen)], (scene.start, scene.end))
