"""The vertices and edges that touch at the current time: these decide whether it is a contact.

Proof that no contact is missed. Let t be the first contact. Consider the tiling just before
t, in the limit towards t, with the infinitesimal copies of a vertex
(`exactpt.motion.infinitesimal`) contracted to the vertex: its faces are pseudo-triangles,
except for those that have lost all area, which are edges.

*Which angles vanish.* Let vertex v touch a body edge e, or a vertex. Just before t, a short
segment from v to e leaves v through a face, crosses diagonals, and ends in a face at e; it
shrinks to a point z. Each of these faces is pinched at z into two loops. Its three corners
are divided between them, so one loop has at most one corner besides z. The turning angles
along a closed loop add up to 2 pi; those at z and at a corner are at most pi, all others at
most 0. So either no corner exists, and an edge has shrunk to a point: two neighbours
coincide. Or there is one, q, with an angle of 0, and every other angle of the loop is
straight. So the vertices of the loop, v and both ends of e included, belong to angles
(previous, here, next) whose orientation vanishes at t.

*Copies vanish with their vertex.* Let the turning angle of a face at a vertex be the sum of
those at its copies. At most one copy is a corner: a face with two at one vertex has at most
two real corners, and no area. The turning angle at a corner is less than pi, at the other
copies at most 0. So if the angle at the vertex becomes 0 (a turning angle of pi), the turning
angle at the corner among the copies becomes pi and the others become 0; and if a reflex
angle becomes straight (a turning angle of 0), all of them become 0: no corner is among
them, or the face would have two real corners only. So each of these copies has an
orientation that vanishes at t, or is identically zero.

*Each has an event.* An orientation that vanishes at t has an event at t, whether it changes
sign or only touches 0, also at the end of a piece of motion (`Certifier.orientation`);
and if it is identically zero, there is one when two of its vertices coincide. No corner whose
angle is identically zero remains in the tiling (`exactpt.certificates.perturbation`), so q has an
event, and the angles beside it that are straight for all times are found by following the chain.
Hence testing the vertices of all angles with an event at t, extended along straight angles,
finds every contact. (Where more than two features touch at z, consecutive ones do so as
above, and all pairs among the vertices and edges found are tested.)

The faces are those of the free space, in holes of bodies too, and of the interiors that are tiled,
around holes. A deforming
body without a diagonal, a segment or a triangle, may lose its interior too: then all its
vertices are tested (`exactpt.tiling.pieces`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import combinations, product
from typing import TYPE_CHECKING, Final, TypeAlias

import numpy as np

from exactpt.certificates.coincidence import boxes_now, coincide, lies_on
from exactpt.geometry.boxes import Boxes, overlapping_pairs
from exactpt.indices import VertexId
from exactpt.motion.track import Incidence

if TYPE_CHECKING:
    from exactpt.certificates.certifier import Certifier
    from exactpt.motion.vertex import Vertex
    from exactpt.motion.vertices import Vertices

FEW: Final = 24
"""Maximum number of points for which testing all pairs is faster than boxes."""

_Edge: TypeAlias = "tuple[Vertex, int, Vertex]"


def touches(
    certifier: Certifier, vertices: Vertices, candidates: Iterable[VertexId]
) -> list[Incidence]:
    """Return all touches now among these vertices and the body edges between them, in order.

    Two coinciding vertices count once, and not also as vertices on the edges that end there.
    Neighbours on one body touch only if their edge has shrunk to a point.
    """
    chosen: dict[tuple[int, int], Vertex] = {}
    for vertex_id in candidates:
        vertex = vertices.all[vertex_id]
        chosen.setdefault((vertex.body, vertex.index), vertex)
    points = [chosen[key] for key in sorted(chosen)]
    edges = [(a, *e) for a in points for e in _edges(vertices, chosen, a)]
    boxes = boxes_now(certifier, points) if len(points) > FEW else None
    found: set[Incidence] = set()
    meeting: set[tuple[int, int, int, int]] = set()
    for a, b in _pairs(points, boxes):
        if coincide(certifier, a, b):
            found.add(Incidence(a.body, a.index, b.body, -1, b.index))
            meeting.add((a.body, a.index, b.body, b.index))
            meeting.add((b.body, b.index, a.body, a.index))
    for v, (a, edge, b) in _near(points, edges, boxes):
        if v.body == a.body and v.index in (a.index, b.index):
            continue
        if (v.body, v.index, a.body, a.index) in meeting:
            continue
        if (v.body, v.index, b.body, b.index) in meeting:
            continue
        if lies_on(certifier, v, a, b):
            found.add(Incidence(v.body, v.index, a.body, edge, -1))
    return sorted(found)


def _pairs(points: list[Vertex], boxes: Boxes | None) -> Iterator[tuple[Vertex, Vertex]]:
    """Yield the pairs of points, in order; with boxes, only those whose boxes overlap."""
    if boxes is None:
        yield from combinations(points, 2)
    else:
        for first, second in overlapping_pairs(boxes):
            for i, j in zip(first.tolist(), second.tolist(), strict=True):
                yield points[i], points[j]


def _near(
    points: list[Vertex], edges: list[_Edge], boxes: Boxes | None
) -> Iterator[tuple[Vertex, _Edge]]:
    """Yield the pairs of a point and an edge; with boxes, only those whose boxes overlap."""
    if boxes is None or not edges:
        yield from product(points, edges)
        return
    position = {v.id: i for i, v in enumerate(points)}
    ends = boxes[[[position[a.id], position[b.id]] for a, _, b in edges]]
    low, high = ends.min(axis=1), ends.max(axis=1)
    of_edges = np.stack((low[:, 0], high[:, 1], low[:, 2], high[:, 3]), axis=1)
    n = len(points)
    for first, second in overlapping_pairs(np.concatenate((boxes, of_edges))):
        mixed = (first < n) & (second >= n)
        for i, j in zip(first[mixed].tolist(), second[mixed].tolist(), strict=True):
            yield points[i], edges[j - n]


def _edges(
    vertices: Vertices, chosen: dict[tuple[int, int], Vertex], a: Vertex
) -> list[tuple[int, Vertex]]:
    """Return the body edge that starts at a, as (number, other end), if that end is chosen too."""
    body = vertices.bodies[a.body].body
    size = body.size
    if size == 1 or (a.index == size - 1 and (size == 2 or not body.closed)):
        return []
    other = chosen.get((a.body, body.end_of_edge(a.index)))
    return [] if other is None else [(a.index, other)]
