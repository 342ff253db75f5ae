"""Which outlines are in which hole, from the coordinates alone."""

from exactpt.geometry.polygon import contains


def components(scene):
    """(body, hole ring) or None for the outside -> the first points of the outlines in it."""
    points = [body.at(scene.start) for body in scene.bodies]
    rings = [
        (i, ring, k > 0)
        for i, body in enumerate(scene.bodies)
        for part in (body.parts if body.size > 2 and body.closed else [[range(body.size)]])
        for k, ring in enumerate(part)
    ]
    found = {}
    for i, ring, is_hole in rings:
        if is_hole:
            continue
        p = points[i][ring.start]
        # The innermost of the rings around it is that of a hole, or there is none.
        around = [
            (j, other)
            for j, other, other_is_hole in rings
            if other_is_hole and contains([points[j][k] for k in other], p)
        ]
        innermost = [
            (j, other)
            for j, other in around
            if not any(
                contains([points[j][k] for k in other], points[l][smaller.start])
                for l, smaller in around
                if (l, smaller) != (j, other)
            )
        ]
        key = (innermost[0][0], innermost[0][1].start) if innermost else None
        found.setdefault(key, []).append(p)
    return found
