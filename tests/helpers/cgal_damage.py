"""Kinds of damage to a tile, each with a sentence that says why no such tile is right.

A kind is a function (rng, tile, shapes) that changes copies; the result is (tile, shapes), or None
where this tiling does not offer the damage (`Unsuited`).
"""

from copy import deepcopy
from fractions import Fraction

from cgal_tilings import contains, corners, cyclic_pairs, merged, turn

from exactpt.cgal import BodyShape

TINY = Fraction(1, 10**40)

KINDS = {}


class Unsuited(Exception):  # noqa: N818 - an outcome
    """The tiling does not offer the damage."""


def pick(rng, options):
    if not options:
        raise Unsuited
    return rng.choice(options)


def damage(name):
    def register(function):
        def on_copies(rng, tile, shapes):
            tile, shapes = deepcopy(tile), list(shapes)
            try:
                function(rng, tile, shapes)
            except Unsuited:
                return None
            return tile, shapes

        KINDS[name] = on_copies
        return on_copies

    return register


def positions(tile):
    return [(Fraction(v["x"]), Fraction(v["y"])) for v in tile["vertices"]]


def move(tile, v, point):
    tile["vertices"][v] |= {"x": str(point[0]), "y": str(point[1])}


def on_line(a, b, s):
    return (a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]))


def pairs(tile):
    return {tuple(sorted((e["u"], e["v"]))) for e in tile["edges"]}


def rings(tile, shapes):
    """The vertices of each polygon, counter-clockwise."""
    place = {(v["body"], v["vertex"]): i for i, v in enumerate(tile["vertices"])}
    points = positions(tile)
    result = []
    for shape in shapes:
        if shape.closed and shape.size > 2:
            ring = [place[shape.name, i] for i in range(shape.size)]
            area = sum(
                points[u][0] * points[v][1] - points[v][0] * points[u][1]
                for u, v in cyclic_pairs(ring)
            )
            result.append(ring if area > 0 else ring[::-1])
    return result


def beside(tile):
    return {e: face for face in tile["faces"] for e in cyclic_pairs(face["vertices"])}


def edge_between(u, v, *, kind="diagonal", hull=False):
    return {"u": u, "v": v, "kind": kind, "hull": hull}


@damage("edge removed")
def edge_removed(rng, tile, shapes):
    """Its two regions became one, or a body lost an edge, or the hull is open."""
    tile["edges"].remove(pick(rng, tile["edges"]))


@damage("diagonal removed, two faces merged")
def two_faces_merged(rng, tile, shapes):
    """Consistent, but the merged face has not three corners, or meets itself."""
    points, side = positions(tile), beside(tile)
    edges = [e for e in tile["edges"] if e["kind"] == "diagonal" and not e["hull"]]
    rng.shuffle(edges)
    for edge in edges:
        u, v = edge["u"], edge["v"]
        f, g = side[u, v], side[v, u]
        cycle = merged(f["vertices"], g["vertices"], u, v)
        convex = corners(points, cycle)
        if len(set(cycle)) == len(cycle) and len(convex) == 3:
            continue
        tile["edges"].remove(edge)
        tile["faces"].remove(f)
        tile["faces"].remove(g)
        tile["faces"].append({"vertices": cycle, "corners": (convex * 3)[:3], "region": "F2"})
        return
    raise Unsuited


@damage("edge added")
def edge_added(rng, tile, shapes):
    """It crosses something, or cuts a face or a polygon that is listed as one."""
    there, n = pairs(tile), len(tile["vertices"])
    free = [(u, v) for u in range(n) for v in range(u) if (v, u) not in there]
    tile["edges"].append(edge_between(*pick(rng, free)))


@damage("edge repeated")
def edge_repeated(rng, tile, shapes):
    """No edge is there twice, from either end."""
    edge = pick(rng, tile["edges"])
    tile["edges"].append(edge | {"u": edge["v"], "v": edge["u"]})


def facing(tile):
    """Vertices and an edge of one face, neither they nor their neighbours there beyond it."""
    points = positions(tile)
    for face in tile["faces"]:
        cycle = face["vertices"]
        for a, b in cyclic_pairs(cycle):
            for i, v in enumerate(cycle):
                near = (cycle[i - 1], v, cycle[(i + 1) % len(cycle)])
                turns = [turn(points[a], points[b], points[w]) for w in near]
                if v not in (a, b) and min(turns) >= 0:
                    yield v, a, b


@damage("vertex moved onto an edge")
def vertex_onto_edge(rng, tile, shapes):
    """No vertex is inside an edge: one across the face, or any."""
    points = positions(tile)
    choices = list(facing(tile))
    if rng.random() < 0.5:
        v = rng.randrange(len(points))
        choices = [(v, a, b) for a, b in sorted(pairs(tile)) if v not in (a, b)]
    v, a, b = pick(rng, choices)
    move(tile, v, on_line(points[a], points[b], Fraction(rng.randint(1, 98), 99)))


@damage("vertex moved 1e-40 beyond an edge")
def vertex_beyond_edge(rng, tile, shapes):
    """A vertex has left its face, just so."""
    points = positions(tile)
    choices = list(facing(tile))
    v, a, b = pick(rng, choices)
    p, q = points[a], points[b]
    x, y = on_line(p, q, Fraction(rng.randint(1, 98), 99))
    move(tile, v, (x + TINY * (q[1] - p[1]), y - TINY * (q[0] - p[0])))


@damage("flat vertex moved 1e-40 aside")
def flat_vertex_aside(rng, tile, shapes):
    """A flat vertex of a face becomes its fourth corner, or the hull has a dent."""
    points = positions(tile)
    flat = []
    for face in tile["faces"]:
        for i, v in enumerate(cycle := face["vertices"]):
            a, b = cycle[i - 1], cycle[(i + 1) % len(cycle)]
            if turn(points[a], points[v], points[b]) == 0:
                flat.append((v, points[a], points[b], 1))
    for u, v in [(e["u"], e["v"]) for e in tile["edges"] if e["hull"]]:
        for w in range(len(points)):
            a, m, b = points[u], points[v], points[w]
            if w != u and edge_is_hull(tile, v, w) and turn(a, m, b) == 0:
                # Inwards: away from the outside.
                inner = next((p for p in points if turn(a, b, p) != 0), None)
                left = inner is None or turn(a, b, inner) > 0
                flat.append((v, a, b, -1 if left else 1))
    v, a, b, side = pick(rng, flat)
    x, y = points[v]
    move(tile, v, (x + side * TINY * (b[1] - a[1]), y - side * TINY * (b[0] - a[0])))


def edge_is_hull(tile, u, v):
    return any(e["hull"] and {e["u"], e["v"]} == {u, v} for e in tile["edges"])


@damage("duplicate vertex")
def duplicate_vertex(rng, tile, shapes):
    """No two vertices are at one point."""
    points = positions(tile)
    if len(points) < 2:
        raise Unsuited
    u, v = rng.sample(range(len(points)), 2)
    move(tile, u, points[v])


@damage("vertex listed twice")
def vertex_listed_twice(rng, tile, shapes):
    """A vertex of a body is one vertex."""
    tile["vertices"].append(dict(rng.choice(tile["vertices"])))


@damage("isolated vertex")
def isolated_vertex(rng, tile, shapes):
    """A body without an edge, in a face, in a polygon, on an edge, or outside the hull."""
    points = positions(tile)
    if len(points) < 2:
        raise Unsuited
    a, b, c = (rng.choice(points) for _ in range(3))
    s, t = Fraction(rng.randint(1, 50), 99), Fraction(rng.randint(1, 48), 99)
    x, y = on_line(on_line(a, b, s), c, t)
    if (x, y) in points:
        raise Unsuited
    tile["vertices"].append({"body": "new", "vertex": 0, "x": str(x), "y": str(y)})
    shapes.append(BodyShape("new", 1))


@damage("face dropped")
def face_dropped(rng, tile, shapes):
    """Every free region is a face."""
    tile["faces"].remove(pick(rng, tile["faces"]))


@damage("face reversed")
def face_reversed(rng, tile, shapes):
    """Faces are counter-clockwise."""
    pick(rng, tile["faces"])["vertices"].reverse()


@damage("face repeated")
def face_repeated(rng, tile, shapes):
    """No region is two faces."""
    tile["faces"].append(deepcopy(pick(rng, tile["faces"])))


@damage("vertices of a face swapped")
def face_scrambled(rng, tile, shapes):
    """Another cycle of the same vertices is another face."""
    faces = [f for f in tile["faces"] if len(f["vertices"]) > 3]
    cycle = pick(rng, faces)["vertices"]
    i = rng.randrange(len(cycle))
    cycle[i], cycle[i - 1] = cycle[i - 1], cycle[i]


@damage("wrong corner")
def wrong_corner(rng, tile, shapes):
    """The three corners are the convex ones of that face."""
    face = pick(rng, tile["faces"])
    others = [v for v in range(len(tile["vertices"])) if v not in face["corners"]]
    reflex = [v for v in face["vertices"] if v in others]
    if rng.random() < 0.7:
        others = reflex
    face["corners"][rng.randrange(3)] = pick(rng, others)


@damage("diagonal inside a polygon")
def diagonal_inside(rng, tile, shapes):
    """A body's inside is one region without an edge."""
    points, choices = positions(tile), []
    for ring in rings(tile, shapes):
        polygon = [points[v] for v in ring]
        for i, u in enumerate(ring):
            for v in ring[i + 2 :]:
                middle = on_line(points[u], points[v], Fraction(1, 2))
                sides = [turn(points[a], points[b], middle) for a, b in cyclic_pairs(ring)]
                if 0 not in sides and contains(polygon, middle):
                    choices.append((u, v))
    tile["edges"].append(edge_between(*pick(rng, choices)))


@damage("clockwise polygon")
def clockwise_polygon(rng, tile, shapes):
    """A polygon keeps the orientation that it has in the scene."""
    known = [i for i, s in enumerate(shapes) if s.closed and s.size > 2 and s.clockwise is not None]
    i = pick(rng, known)
    shapes[i] = shapes[i]._replace(clockwise=not shapes[i].clockwise)


@damage("vertices of a body swapped")
def body_scrambled(rng, tile, shapes):
    """The edges of a body join the vertices in its order."""
    long = [s for s in shapes if s.size > (3 if s.closed else 2)]
    shape = pick(rng, long)
    i = rng.randrange(1, shape.size - 1)
    for vertex in tile["vertices"]:
        if vertex["body"] == shape.name and vertex["vertex"] in (i, i + 1):
            vertex["vertex"] = 2 * i + 1 - vertex["vertex"]


@damage("hull edge missing")
def hull_edge_missing(rng, tile, shapes):
    """Consistent, with the face beside it gone too, but the whole is not convex."""
    edges = [e for e in tile["edges"] if e["hull"] and e["kind"] == "diagonal"]
    edge = pick(rng, edges)
    side = beside(tile)
    face = side.get((edge["u"], edge["v"])) or side.get((edge["v"], edge["u"]))
    tile["edges"].remove(edge)
    if face is not None:
        tile["faces"].remove(face)
        exposed = {tuple(sorted(e)) for e in cyclic_pairs(face["vertices"])}
        for e in tile["edges"]:
            e["hull"] |= tuple(sorted((e["u"], e["v"]))) in exposed


@damage("wrong kind of edge")
def wrong_kind(rng, tile, shapes):
    """Boundary edges are exactly those of the bodies."""
    edge = pick(rng, tile["edges"])
    edge["kind"] = "boundary" if edge["kind"] == "diagonal" else "diagonal"


@damage("wrong hull flag")
def wrong_hull_flag(rng, tile, shapes):
    """Hull edges are exactly those with the outside beside them."""
    edge = pick(rng, tile["edges"])
    edge["hull"] = not edge["hull"]


@damage("body forgotten")
def body_forgotten(rng, tile, shapes):
    """Every vertex belongs to a body of the scene."""
    shapes.remove(rng.choice(shapes))


@damage("vertex forgotten")
def vertex_forgotten(rng, tile, shapes):
    """Every vertex of every body is in the tile."""
    i = rng.randrange(len(shapes))
    shapes[i] = shapes[i]._replace(size=shapes[i].size + 1)


@damage("mirror image")
def mirror_image(rng, tile, shapes):
    """In a mirror image every face is clockwise."""
    if not tile["faces"]:
        raise Unsuited
    for v, (x, y) in enumerate(positions(tile)):
        move(tile, v, (-x, y))
    shapes[:] = [shape._replace(clockwise=None) for shape in shapes]


@damage("vertex moved into a polygon")
def vertex_into_polygon(rng, tile, shapes):
    """A vertex of another body, its edges drawn along, lies inside a polygon."""
    points, inside = positions(tile), rings(tile, shapes)
    ring = pick(rng, inside)
    others = [v for v in range(len(points)) if v not in ring]
    polygon = [points[v] for v in ring]
    a, b, c = (rng.choice(polygon) for _ in range(3))
    p = on_line(on_line(a, b, Fraction(rng.randint(1, 98), 99)), c, Fraction(1, 3))
    on_side = any(turn(points[u], points[v], p) == 0 for u, v in cyclic_pairs(ring))
    if not others or on_side or not contains(polygon, p):
        raise Unsuited
    move(tile, rng.choice(others), p)


@damage("diagonal replaced by a crossing one")
def diagonal_flipped_wrongly(rng, tile, shapes):
    """The other diagonal of the two faces, while the faces stay as they were."""
    side = beside(tile)
    edges = [e for e in tile["edges"] if e["kind"] == "diagonal" and not e["hull"]]
    rng.shuffle(edges)
    for edge in edges:
        u, v = edge["u"], edge["v"]
        ends = [
            rng.choice([w for w in side[e]["vertices"] if w not in (u, v)])
            for e in ((u, v), (v, u))
        ]
        if ends[0] != ends[1] and tuple(sorted(ends)) not in pairs(tile):
            edge["u"], edge["v"] = ends
            return
    raise Unsuited
