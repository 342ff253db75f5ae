"""Test for scenes of convex bodies only, for which there are simpler tilings."""

from __future__ import annotations

import numpy as np

from exactpt.certificates.at_time import PredicatesAt
from exactpt.kernel.doubles import view


def all_stay_convex(instant: PredicatesAt) -> bool:
    """Return True if all bodies are convex and stay so; angles of pi are allowed.

    False if there is an open chain of more than two vertices, even a straight one: it may
    bend later.
    """
    vertices, bodies = instant.vertices, instant.vertices.bodies
    if any(
        b.is_tiled or not (b.is_polygon or (b.body.size < 3 and not b.body.has_rings))
        for b in bodies
    ):
        return False
    ids = np.array(vertices.ids(), np.int64)
    ahead, behind = view(vertices.next_ids)[ids], view(vertices.previous_ids)[ids]
    return not (instant.signs_of(np.stack((ahead, ids, behind), axis=1)) > 0).any()
