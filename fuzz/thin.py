"""Scenes with half of their bodies cut down to chains, segments and points.

Bodies without an inside have copies of their vertices, which most families never show.
"""

from __future__ import annotations

from random import Random
from typing import Final

from exactpt.motion.body import Body
from exactpt.scene.scene import Scene

__all__ = ["SUFFIX", "thinned"]

SUFFIX: Final = "/thin"
"""Of the name of a family whose scenes are thinned."""


def thinned(scene: Scene, rng: Random) -> Scene:
    """A scene with half of its bodies, by chance, replaced by a part of their boundary."""
    bodies = [_part(body, rng) if rng.random() < 0.5 else body for body in scene.bodies]
    return Scene(bodies, (scene.start, scene.end))


def _part(body: Body, rng: Random) -> Body:
    """Some consecutive vertices of a body, in the same motion: as an open chain, or fewer."""
    most = rng.choice([1, 2, body.size, body.size])
    size, first = min(most, body.size), rng.randrange(body.size) if body.closed else 0
    chosen = [(first + i) % body.size for i in range(size)]
    if body.keyframes:
        frames = [(f.t, [f.vertices[i] for i in chosen]) for f in body.keyframes]
        return Body(body.name, None, body.motion, closed=False, keyframes=frames)
    return Body(body.name, [body.vertices[i] for i in chosen], body.motion, closed=False)
