"""Reference search for the first contact: every vertex against every edge, in exact arithmetic.

It follows the definition of a contact and uses neither a tiling nor a float filter. It shares
the kernel, the trajectories, `exactpt.geometry.polygon` and the predicates of
`exactpt.motion.track` with the searches that it checks. Where a body has a radius,
`fuzz.questions.all_pairs_radii` has the definition; such a body does not touch itself. Nor does one
whose rings touch at the start: it keeps its shape.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from exactpt import AlgebraicNumber, Body, Contact, Scene
from exactpt.geometry.polygon import contains, segments_meet
from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ
from exactpt.kernel.roots import common_roots, roots_after
from exactpt.motion.track import (
    Incidence,
    Track,
    coincide,
    difference,
    lies_on,
    orientation_polynomial,
)
from exactpt.pairs.contact import contact_of
from exactpt.pairs.incidences import tracks_just_before
from fuzz.questions.all_pairs_radii import (
    core_distance,
    first_at_distance,
    touches_at_distance,
)


def first_contact_allpairs(scene: Scene) -> Contact | None:
    """Return the first contact in the scene's closed time span; None if there is none."""
    start = AlgebraicNumber(scene.exact_start)
    initial_pairs = _overlapping_at_start(scene)
    if initial_pairs:
        tracks = [b.exact_piece_after(scene.exact_start).tracks for b in scene.bodies]
        return contact_of(scene, start, touches_at(scene, tracks, start), initial_pairs)
    best: AlgebraicNumber | None = None
    for i in range(len(scene.bodies)):
        for j in range(i if _has_touching_rings(scene, i) else i + 1):
            until = scene.exact_end if best is None else best.exact_high
            time = _first_between(scene, i, j, until)
            if time is not None and (best is None or time.compare(best) < 0):
                best = time
    if best is None:
        return None
    tracks = [tracks_just_before(body, best, scene.exact_start) for body in scene.bodies]
    return contact_of(scene, best, touches_at(scene, tracks, best))


def _reach(a: Body, b: Body) -> QQ:
    return a.exact_radius + b.exact_radius


def _has_touching_rings(scene: Scene, i: int) -> bool:
    """Return True if a vertex of a body is on an edge of another of its rings at the start."""
    body = scene.bodies[i]
    points = body.exact_at(scene.exact_start)
    return any(
        segments_meet(points[v], points[v], points[a], points[b])
        for ring in body.rings
        for v in ring
        for a, b in body.edges
        if len(body.rings) > 1 and a not in ring
    )


def _first_between(scene: Scene, i: int, j: int, until: QQ) -> AlgebraicNumber | None:
    """Return the first time in (start, until] at which i and j touch (i == j: itself)."""
    a, b = scene.bodies[i], scene.bodies[j]
    ends = sorted(
        {t for t in (*a.exact_breakpoints, *b.exact_breakpoints) if scene.exact_start < t < until}
    )
    begin = scene.exact_start
    for end in (*ends, until):
        p, q = a.exact_piece_after(begin).tracks, b.exact_piece_after(begin).tracks
        if _reach(a, b):
            met = None if i == j else first_at_distance(a, b, p, q, (begin, end))
            if met is not None:
                return met
            begin = end
            continue
        pairs = _vertex_edge_pairs(p, q, b.edges, same=i == j)
        if i != j:
            pairs += _vertex_edge_pairs(q, p, a.edges, same=False)
        best: AlgebraicNumber | None = None
        for v, u, w in pairs:
            limit = end if best is None else best.exact_high
            time = next(_meetings(v, u, w, AlgebraicNumber(begin), limit), None)
            if time is not None and (best is None or time.compare(best) < 0):
                best = time
        if best is not None:
            return best
        begin = end
    return None


def _vertex_edge_pairs(
    p: tuple[Track, ...], q: tuple[Track, ...], q_edges: list[tuple[int, int]], *, same: bool
) -> list[tuple[Track, Track, Track]]:
    """Return all pairs of a vertex of p and an edge (a, b) of q, as triples (vertex, a, b).

    A point counts as the edge from itself to itself. Within one body (``same``) a vertex is not
    paired with its own edges; in addition the two ends of each edge are paired, since a
    deforming edge may shrink to a point.
    """
    triples = [
        (v, q[a], q[b])
        for i, v in enumerate(p)
        for a, b in (q_edges or [(0, 0)])
        if not (same and i in (a, b))
    ]
    if same:
        triples += [(q[a], q[b], q[b]) for a, b in q_edges]
    return triples


def _meetings(
    v: Track, a: Track, b: Track, start: AlgebraicNumber, until: QQ
) -> Iterator[AlgebraicNumber]:
    """Yield the times in (start, until] at which v comes onto the segment ab, in order.

    If the three are collinear for all times, v enters the segment at one of its ends.
    """
    f = orientation_polynomial(a, b, v)
    if f:
        for root in roots_after(f, start, until):
            if lies_on(v, a, b, root.time):
                yield root.time
        return
    times: list[AlgebraicNumber] = []
    for u in (a, b):
        dx, dy = difference(u.x, u.w, v.x, v.w), difference(u.y, u.w, v.y, v.w)
        times += [root.time for root in common_roots(dx, dy, start, until)][:1]
    if times:
        yield min(times)


def touches_at(
    scene: Scene, tracks: list[tuple[Track, ...]], time: AlgebraicNumber
) -> Iterator[Incidence]:
    """Yield every incidence of a vertex with a vertex or an edge at a time.

    Of rounded bodies: of features at the sum of the radii, unless the bodies overlap at the start.
    """
    bodies = scene.bodies
    for i, j in combinations(range(len(bodies)), 2):
        reach = _reach(bodies[i], bodies[j])
        overlap = time.compare_rational(scene.exact_start) == 0 and (
            core_distance(bodies[i], bodies[j], scene.exact_start) < reach**2
        )
        if reach and not overlap:
            yield from touches_at_distance(bodies, tracks, (i, j), time)
    for i, p in enumerate(tracks):
        for j, q in enumerate(tracks):
            if _reach(bodies[i], bodies[j]) or (i == j and _has_touching_rings(scene, i)):
                continue
            for v, track in enumerate(p):
                on_vertex = [
                    w
                    for w, other in enumerate(q)
                    if (i, v) != (j, w) and coincide(track, other, time)
                ]
                for w in on_vertex:
                    if (i, v) < (j, w):
                        yield Incidence(i, v, j, -1, w)
                for e, (a, b) in enumerate(bodies[j].edges):
                    ends = {(j, a), (j, b)}
                    if (i, v) in ends or a in on_vertex or b in on_vertex:
                        continue
                    if lies_on(track, q[a], q[b], time):
                        yield Incidence(i, v, j, e, -1)


def _overlapping_at_start(scene: Scene) -> list[tuple[int, int]]:
    points = [body.exact_at(scene.exact_start) for body in scene.bodies]
    found = []
    for j, b in enumerate(scene.bodies):
        for i, a in enumerate(scene.bodies[:j]):
            if _reach(a, b):
                if core_distance(a, b, scene.exact_start) <= _reach(a, b) ** 2:
                    found.append((i, j))
                continue
            crossing = any(
                segments_meet(points[i][u], points[i][v], points[j][x], points[j][y])
                for u, v in a.edges or [(0, 0)]
                for x, y in b.edges or [(0, 0)]
            )
            if (
                crossing
                or _is_inside(a, points[i], b, points[j])
                or _is_inside(b, points[j], a, points[i])
            ):
                found.append((i, j))
    return sorted(found)


def _is_inside(a: Body, p: Sequence[Point], b: Body, q: Sequence[Point]) -> bool:
    """Return True if a ring of a body is in a part of another one, if no edges cross.

    It is then in the outline, and in none of the holes.
    """
    return b.has_interior and any(
        contains([q[i] for i in outline], p[ring.start])
        and not any(contains([q[i] for i in hole], p[ring.start]) for hole in holes)
        for ring in a.rings
        for outline, *holes in b.parts
    )
