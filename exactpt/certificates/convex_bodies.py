"""Whether a scene has only convex bodies, for which there are simpler tilings."""

from __future__ import annotations

from exactpt.certificates.at_time import PredicatesAt


def all_stay_convex(instant: PredicatesAt) -> bool:
    """Return True if all bodies are convex and stay so; angles of pi are allowed.

    False if there is an open chain of more than two vertices, even a straight one: it may
    bend later.
    """
    v, bodies = instant.vertices.all, instant.vertices.bodies
    if any(
        b.is_tiled or not (b.is_polygon or (b.body.size < 3 and not b.body.has_rings))
        for b in bodies
    ):
        return False
    triples = [(v[p].ahead, p, v[p].behind) for body in bodies for p in body.ring]
    return all(s <= 0 for s in instant.signs(triples))
