"""Two bodies of which one or both are rounded: distances, intervals and approaches by definition.

The cores are within the sum of the radii of each other at a time, or they are not: signs of
polynomials at that time tell, by `exactpt.testing.reference`.
"""

from __future__ import annotations

from random import Random

from exactpt import Body, Scene, clearance, contact_intervals, distance, first_within
from exactpt.kernel.numbers import QQ
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from fuzz.questions.tiny import pair_scene
from fuzz.rings import parts_of

__all__ = ["rounded_pair", "wrong_answer"]


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


def wrong_answer(random: Random, scene: Scene) -> str | None:
    """Return a difference of a rounded pair from the definition; None without one."""
    a, b = scene.bodies
    start, end = scene.exact_start, scene.exact_end
    reach = a.exact_radius + b.exact_radius
    expected = reference.contact_intervals(a, b, scene.time)
    if difference := disagreement(expected, contact_intervals(scene, a.name, b.name)):
        return f"intervals: {difference}"
    d = QQ(random.choice([0, 1, 2]), random.choice([1, 3]))
    time = first_within(scene, a.name, b.name, d)
    first = reference.first_within(a, b, scene.time, (d + reach) ** 2)
    if time != first:
        return f"within {d}: {time}, not {first}"
    gap = clearance(scene, a.name, b.name)
    least = float(gap.minimum)
    for _ in range(4):
        t = start + (end - start) * random.randint(0, 997) / 997
        there = distance(scene, a.name, b.name, at=t)
        if there.core_squared != reference.nearest(a, b, t).core_squared:
            return f"the distance of the cores at {t}: {there}"
        if not gap(t) == float(there) >= least:
            return f"the distance at {t}: {there}, by clearance {gap(t)}, at least {least}"
    return None
