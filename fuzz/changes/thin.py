"""Scenes with half of their bodies reduced to degenerate ones: chains, segments and points.

Bodies without interior have infinitesimal copies of vertices, which few families contain.
"""

from __future__ import annotations

from random import Random
from typing import Final

from exactpt import Body, Scene

__all__ = ["SUFFIX", "thinned"]

SUFFIX: Final = "/thin"
"""Suffix of the name of a family whose scenes are reduced in this way."""


def thinned(scene: Scene, rng: Random) -> Scene:
    """A scene with half of its bodies, chosen at random, replaced by parts of their boundaries."""
    bodies = [_part(body, rng) if rng.random() < 0.5 else body for body in scene.bodies]
    return Scene(bodies, (scene.start, scene.end), ignoring=scene.ignoring)


def _part(body: Body, rng: Random) -> Body:
    """Some consecutive vertices of a body, in the same motion, as an open chain or less."""
    ring = rng.choice(body.rings) if body.has_rings else range(body.size)
    most = rng.choice([1, 2, len(ring), len(ring)])
    size, first = min(most, len(ring)), rng.randrange(len(ring)) if body.closed else 0
    chosen = [ring[(first + i) % len(ring)] for i in range(size)]
    if body.keyframes:
        frames = [(f.t, [f.vertices[i] for i in chosen]) for f in body.keyframes]
        return Body(
            body.name, None, body.motion, closed=False, keyframes=frames, radius=body.radius
        )
    vertices = [body.vertices[i] for i in chosen]
    return Body(body.name, vertices, body.motion, closed=False, radius=body.radius)
