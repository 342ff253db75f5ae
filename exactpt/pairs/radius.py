"""First contacts of bodies with radii in any motion, after the start.

Bodies without radius meet each other, and themselves, as in a scene of their own. Two bodies of
which one has a radius touch where the distance of their cores is the sum of the radii; a body
with a radius does not touch itself. The earlier of the two first contacts counts, or both together.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from exactpt.geometry.boxes import Indices
from exactpt.kernel.numbers import QQ
from exactpt.motion.incidence import Touch
from exactpt.pairs.approach_search import ApproachSearch
from exactpt.pairs.contact import Contact, contact_of
from exactpt.pairs.rational import Earliest
from exactpt.scene.scene import Scene

__all__ = ["first_with_radii"]


def first_with_radii(scene: Scene, group: Indices, plain: Contact | None) -> Contact | None:
    """Return the first contact of a scene in which no two bodies touch at the start.

    Args:
        scene: the bodies, some of which have a radius.
        group: a number for each body; contacts of bodies with the same number are ignored.
        plain: the first contact of the bodies without radius.
    """
    radii = [body._radius for body in scene.bodies]
    has_radius = np.array([r > 0 for r in radii], np.bool_)

    def squared(i: int, j: int) -> QQ:
        return (radii[i] + radii[j]) ** 2

    def apart(i: Indices, j: Indices) -> NDArray[np.bool_]:
        one = has_radius[i] | has_radius[j]
        watched: NDArray[np.bool_] = one & (i != j) & (group[i] != group[j])
        return watched

    end = scene._end if plain is None else min(scene._end, plain.time._high)
    found = ApproachSearch(scene.until(end), squared, radii, apart).run()
    best: Earliest[Touch] = Earliest()
    if found is not None:
        best.add(*found)
    if plain is not None:
        numbers = {body.name: i for i, body in enumerate(scene.bodies)}
        best.add(plain.time, plain._touches(numbers))
    return None if best.number is None else contact_of(scene, best.number, best.found)
