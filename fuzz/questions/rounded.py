"""Two bodies of which one or both have radii, with frequent ties."""

from __future__ import annotations

from random import Random

from exactpt import Body, Scene
from fuzz.questions.tiny import pair_scene
from fuzz.rings import parts_of

__all__ = ["rounded_pair"]


def rounded_pair(random: Random) -> Scene:
    """A tiny pair of bodies, one or both with a radius that makes ties frequent."""
    scene = pair_scene(random)
    radii = random.choice([("0", "1"), ("1", "1"), ("1/2", "2"), ("1", "0"), ("2", "3/2")])
    bodies = []
    for body, radius in zip(scene.bodies, radii, strict=True):
        if body.has_rings:
            parts = parts_of(body, body.vertices)
            bodies.append(Body(body.name, motion=body.motion, parts=parts, radius=radius))
            continue
        vertices = None if body.keyframes else body.vertices
        keyframes = body.keyframes or None
        bodies.append(
            Body(
                body.name,
                vertices,
                body.motion,
                closed=body.closed,
                keyframes=keyframes,
                radius=radius,
            )
        )
    return Scene(bodies, (scene.start, scene.end))
