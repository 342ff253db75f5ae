"""Scenes on an integer grid and pseudo-triangulations of them, written for these tests alone.

Nothing here is exactpt's. Points are pairs of Python integers, so everything is exact,
and most things are degenerate: equal coordinates, collinear vertices of different
bodies, vertices inside a side of the hull or of a face.

A tiling is made the slow way: a maximal set of edges that meet nothing is a
triangulation of the free space; then diagonals are deleted, in random order, where the
two faces beside one make a pseudo-triangle together.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import cmp_to_key
from itertools import combinations, pairwise

from exactpt.cgal import BodyShape

CELL, ROOM = 6, 5  # a body keeps to 0..4 of its cell, so bodies never touch


@dataclass
class Body:
    vertices: list  # positions in Tiling.points, in order; a polygon's counter-clockwise
    closed: bool

    @property
    def is_polygon(self):
        return self.closed and len(self.vertices) > 2

    def edges(self):
        pairs = list(pairwise(self.vertices))
        return pairs + [(self.vertices[-1], self.vertices[0])] * self.is_polygon


@dataclass
class Tiling:
    points: list
    bodies: list
    diagonals: set  # of sorted pairs
    faces: list  # free ones, counter-clockwise
    outside: list  # the outer boundary, clockwise

    def boundary(self):
        return {tuple(sorted(e)) for body in self.bodies for e in body.edges()}

    def hull(self):
        return {tuple(sorted(e)) for e in cyclic_pairs(self.outside)}


def turn(a, b, c):
    """Positive where a, b, c turn left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])


def inside_segment(a, b, p):
    return p not in (a, b) and turn(a, b, p) == 0 and min(a, b) < p < max(a, b)


def meet(a, b, c, d):
    """Whether segments ab and cd share more than ends of both."""
    if max(a[0], b[0]) < min(c[0], d[0]) or max(c[0], d[0]) < min(a[0], b[0]):
        return False
    if max(a[1], b[1]) < min(c[1], d[1]) or max(c[1], d[1]) < min(a[1], b[1]):
        return False
    if turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0:
        return True
    return (
        {a, b} == {c, d}
        or any(inside_segment(a, b, p) for p in (c, d))
        or any(inside_segment(c, d, p) for p in (a, b))
    )


def cyclic_pairs(cycle):
    return list(zip(cycle, [*cycle[1:], *cycle[:1]], strict=True))


def area2(points, cycle):
    return sum(
        points[u][0] * points[v][1] - points[v][0] * points[u][1] for u, v in cyclic_pairs(cycle)
    )


def corners(points, cycle):
    n = len(cycle)
    return [
        cycle[i]
        for i in range(n)
        if turn(points[cycle[i - 1]], points[cycle[i]], points[cycle[(i + 1) % n]]) > 0
    ]


def contains(ring, p):
    """Whether p, which is not on the boundary, is inside the polygon with these points."""
    inside = False
    for a, b in cyclic_pairs(ring):
        if (a[1] > p[1]) != (b[1] > p[1]) and (turn(a, b, p) > 0) == (b[1] > a[1]):
            inside = not inside
    return inside


def is_simple(points, *, closed):
    sides = cyclic_pairs(points) if closed else list(pairwise(points))
    return len(set(points)) == len(points) and not any(
        meet(*e, *f) for e, f in combinations(sides, 2)
    )


def convex_ring(points):
    """The corners of the hull, counter-clockwise (gift wrapping)."""
    ring = [min(points)]
    while True:
        best = None
        for p in points:
            if p == ring[-1]:
                continue
            t = 0 if best is None else turn(ring[-1], best, p)
            if best is None or t < 0 or (t == 0 and inside_segment(ring[-1], p, best)):
                best = p
        if best == ring[0]:
            return ring
        ring.append(best)


def with_flat_vertices(rng, ring):
    """Some of the grid points inside the edges become vertices."""
    result = []
    for a, b in cyclic_pairs(ring):
        result.append(a)
        between = [(x, y) for x in range(ROOM) for y in range(ROOM) if inside_segment(a, b, (x, y))]
        if between and rng.random() < 0.3:
            result.append(rng.choice(between))
    return result


def random_shape(rng):
    """The vertices of a body in a cell, and whether it is closed."""

    def grid(count):
        return rng.sample([(x, y) for x in range(ROOM) for y in range(ROOM)], count)

    kind = rng.choice(["point", "segment", "chain", "triangle", "convex", "convex", "simple"])
    if kind in ("point", "segment"):
        return grid(1 if kind == "point" else 2), True
    if kind == "chain":
        while not is_simple(points := grid(rng.randint(3, 5)), closed=False):
            pass
        return points, False
    if kind == "simple":
        while not is_simple(points := grid(rng.randint(4, 7)), closed=True):
            pass
        return points if area2(points, range(len(points))) > 0 else points[::-1], True
    while True:
        points = grid(3 if kind == "triangle" else rng.randint(4, 10))
        if any(turn(points[0], points[1], p) for p in points):
            return with_flat_vertices(rng, convex_ring(points)), True


def random_scene(rng, columns, rows):
    points, bodies = [], []
    cells = [(i, j) for i in range(columns) for j in range(rows)]
    for i, j in cells:
        shape, closed = random_shape(rng)
        bodies.append(Body(list(range(len(points), len(points) + len(shape))), closed))
        points += [(x + CELL * i, y + CELL * j) for x, y in shape]
    return points, bodies


def triangulate(rng, points, bodies):
    """Diagonals that, with the bodies' edges, cut the free space into triangles."""
    edges = {tuple(sorted(e)) for body in bodies for e in body.edges()}
    rings = [[points[v] for v in body.vertices] for body in bodies if body.is_polygon]
    # Short edges first, so that a full set is found soon; with noise, so that it varies.
    noise = {e: rng.uniform(1, 8) for e in combinations(range(len(points)), 2)}
    order = sorted(noise, key=lambda e: noise[e] * squared(points[e[0]], points[e[1]]))
    full = full_count(points, bodies)
    diagonals = set()
    for u, v in order:
        if len(edges) == full:
            break
        a, b = points[u], points[v]
        if (u, v) in edges or any(inside_segment(a, b, p) for p in points):
            continue
        if any(meet(a, b, points[c], points[d]) for c, d in edges):
            continue
        middle = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)  # exact: the numbers are small
        if not any(contains(ring, middle) for ring in rings):
            edges.add((u, v))
            diagonals.add((u, v))
    assert len(edges) == full
    return diagonals


def squared(a, b):
    return (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2


def full_count(points, bodies):
    """The number of edges of any triangulation of the free space (Euler)."""
    if all(turn(points[0], p, q) == 0 for p in points for q in points):
        return len(points) - 1
    ring = convex_ring(points)
    on_hull = len(ring) + sum(
        inside_segment(a, b, p) for a, b in cyclic_pairs(ring) for p in points
    )
    inside = sum(len(body.vertices) - 3 for body in bodies if body.is_polygon)
    return 3 * len(points) - 3 - on_hull - inside


def cycles(points, edges):
    """The boundary cycles of the regions, each region on the left of its cycle."""
    around = {v: [] for v in range(len(points))}
    for u, v in edges:
        around[u].append(v)
        around[v].append(u)
    for v, neighbours in around.items():
        around[v] = by_angle(points, v, neighbours)
    left, found = {(u, v) for e in edges for u, v in (e, e[::-1])}, []
    while left:
        u, v = start = min(left)
        cycle = []
        while (u, v) in left:
            left.remove((u, v))
            cycle.append(u)
            fan = around[v]
            u, v = v, fan[fan.index(u) - 1]  # the next one clockwise
        assert (u, v) == start
        found.append(cycle)
    return found


def by_angle(points, centre, others):
    """Sorted counter-clockwise around the centre, from the positive x axis."""

    def upper(v):
        x, y = points[v][0] - points[centre][0], points[v][1] - points[centre][1]
        return y > 0 or (y == 0 and x > 0)

    def compare(u, v):
        if upper(u) != upper(v):
            return -1 if upper(u) else 1
        return -turn(points[centre], points[u], points[v])

    return sorted(others, key=cmp_to_key(compare))


def merged(f, g, u, v):
    """The cycle of faces f and g together, without the edge u-v between them (u->v in f)."""
    i, j = f.index(v), g.index(u)
    # f from v to u, then g on from u to v, which are not repeated.
    return [*f[i:], *f[:i], *[*g[j:], *g[:j]][1:-1]]


def is_pseudo_triangle(points, cycle):
    return len(set(cycle)) == len(cycle) and len(corners(points, cycle)) == 3


def random_tiling(rng, columns, rows, *, deletions=1.0):
    """A pseudo-triangulation of a random scene; a share of the deletable diagonals is deleted."""
    points, bodies = random_scene(rng, columns, rows)
    return tiling_of(rng, points, bodies, deletions=deletions)


def tiling_of(rng, points, bodies, *, deletions=1.0):
    diagonals = triangulate(rng, points, bodies)
    boundary = {tuple(sorted(e)) for body in bodies for e in body.edges()}
    rings = {frozenset(body.vertices) for body in bodies if body.is_polygon}
    free, outside = [], []
    for cycle in cycles(points, boundary | diagonals):
        if area2(points, cycle) <= 0:
            outside = cycle
        elif frozenset(cycle) not in rings:
            free.append(cycle)
    beside = {e: cycle for cycle in free for e in cyclic_pairs(cycle)}
    order = sorted(diagonals)
    rng.shuffle(order)
    for u, v in order:
        f, g = beside.get((u, v)), beside.get((v, u))
        if f is None or g is None or rng.random() > deletions:
            continue
        cycle = merged(f, g, u, v)
        if is_pseudo_triangle(points, cycle):
            diagonals.remove((u, v))
            del beside[u, v], beside[v, u]
            beside.update(dict.fromkeys(cyclic_pairs(cycle)))
            for e in cyclic_pairs(cycle):
                beside[e] = cycle
    faces = list({id(cycle): cycle for cycle in beside.values()}.values())
    return Tiling(points, bodies, diagonals, faces, outside)


def random_map(rng):
    """A random affine map with rational coefficients that keeps orientations."""

    def number():
        return Fraction(rng.randint(-999, 999), rng.randint(1, 999))

    while True:
        a, b, c, d, e, f = (number() for _ in range(6))
        if a * d - b * c > 0:
            return lambda p: (a * p[0] + b * p[1] + e, c * p[0] + d * p[1] + f)


def as_tile(rng, tiling, mapping=None):
    """The contract's dictionary, its vertices in random order, and the shapes of the bodies."""
    points = tiling.points if mapping is None else [mapping(p) for p in tiling.points]
    order = list(range(len(points)))
    rng.shuffle(order)  # order[i]: the point that becomes vertex i
    place = {v: i for i, v in enumerate(order)}
    label, shapes = {}, []
    for b, body in enumerate(tiling.bodies):
        clockwise = body.is_polygon and rng.random() < 0.3
        numbered = body.vertices[::-1] if clockwise else body.vertices
        label |= {v: (f"b{b}", i) for i, v in enumerate(numbered)}
        known = clockwise if rng.random() < 0.8 else None
        shapes.append(BodyShape(f"b{b}", len(numbered), body.closed, known))
    boundary, hull = tiling.boundary(), tiling.hull()
    edges = [
        {
            "u": place[u],
            "v": place[v],
            "kind": "boundary" if (u, v) in boundary else "diagonal",
            "hull": (u, v) in hull,
        }
        for u, v in sorted(boundary | tiling.diagonals)
    ]
    faces = [
        {
            "vertices": [place[v] for v in cycle],
            "corners": [place[v] for v in corners(tiling.points, cycle)],
            "region": "F2",
        }
        for cycle in tiling.faces
    ]
    vertices = [
        {"body": label[v][0], "vertex": label[v][1], "x": str(points[v][0]), "y": str(points[v][1])}
        for v in order
    ]
    rng.shuffle(edges)
    rng.shuffle(faces)
    tile = {"at": "0", "tiling": "test", "vertices": vertices, "edges": edges, "faces": faces}
    return tile, shapes
