"""The other way to answer a query: every vertex and every edge of every body, no tiling.

Written from the definitions in plain rational arithmetic; shares nothing with
`exactpt.query` or the tilings.
"""


def cross(o, a, b):
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def on_segment(p, a, b):
    return (
        cross(a, b, p) == 0
        and min(a[0], b[0]) <= p[0] <= max(a[0], b[0])
        and min(a[1], b[1]) <= p[1] <= max(a[1], b[1])
    )


def edges_of(points):
    """(number, a, b) of each edge; a body of one vertex has none, of two one."""
    n = len(points)
    count = n if n > 2 else n - 1
    return [(i, points[i], points[(i + 1) % n]) for i in range(count)]


def winding(p, points):
    """How often a polygon turns around a point that is not on it."""
    total = 0
    for _, a, b in edges_of(points):
        if a[1] <= p[1] < b[1] and cross(a, b, p) > 0:
            total += 1
        elif b[1] <= p[1] < a[1] and cross(a, b, p) < 0:
            total -= 1
    return total


def owner(p, scene):
    """(body, vertex, edge) of the body that has a point, or None; scene: name -> points."""
    for name, points in scene.items():
        if p in points:
            return name, points.index(p), None
        for i, a, b in edges_of(points):
            if on_segment(p, a, b):
                return name, None, i
        if len(points) > 2 and winding(p, points):
            return name, None, None
    return None


def first_hit(origin, direction, scene):
    """(parameter, body, vertex, edge) of the first point of a ray in a body, or None."""
    found = owner(origin, scene)
    if found is not None:
        return (0, *found)
    (ox, oy), (dx, dy) = origin, direction
    tip = (ox + dx, oy + dy)
    best = None
    for name, points in scene.items():
        for i, p in enumerate(points):
            if cross(origin, tip, p) == 0:
                t = ((p[0] - ox) * dx + (p[1] - oy) * dy) / (dx * dx + dy * dy)
                if t >= 0 and (best is None or t < best[0]):
                    best = (t, name, i, None)
        for i, a, b in edges_of(points):
            if cross(origin, tip, a) * cross(origin, tip, b) < 0:
                ex, ey = b[0] - a[0], b[1] - a[1]
                t = ((a[0] - ox) * ey - (a[1] - oy) * ex) / (dx * ey - dy * ex)
                if t >= 0 and (best is None or t < best[0]):
                    best = (t, name, None, i)
    return best


def convex_hull(points):
    """The strictly convex hull, counter-clockwise (gift wrapping)."""
    start = here = min(points)
    cycle = []
    while True:
        cycle.append(here)
        best = None
        for p in points:
            if p == here:
                continue
            turn = 1 if best is None else -cross(here, best, p)
            far = best is not None and cross(here, best, p) == 0 and on_segment(best, here, p)
            if best is None or turn > 0 or far:
                best = p
        if best is None or best == start:
            return cycle
        here = best
