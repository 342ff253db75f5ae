"""The mesh of a set of diagonals, by sorting the edges around every vertex."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import cmp_to_key
from typing import Final, TypeAlias, final

import numpy as np
from librt.vecs import vec
from mypy_extensions import u8

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.predicates import Predicates
from exactpt.errors import AuditError
from exactpt.indices import NO_HALF_EDGE, HalfEdge, VertexId, half_edge_vec, vertex_vec
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import items, view
from exactpt.planar.halfedge import PlanarMap, twin
from exactpt.pseudotriangulation.mesh import FREE, INSIDE, OUTER, SOLID, Diagonal, Mesh
from exactpt.pseudotriangulation.stars import follow_stars

MANY: Final = 300
"""Number of vertices from which on a mesh of free space is built in numpy."""

Stars: TypeAlias = dict[VertexId, list[HalfEdge]]


def build_mesh(
    instant: PredicatesAt, diagonals: Iterable[Diagonal], mesh: Mesh | None = None
) -> Mesh:
    """Return the mesh of all body edges and these diagonals, with its marks.

    Args:
        instant: the predicates.
        diagonals: pairwise noncrossing diagonals that form a pseudo-triangulation together
            with the body edges.
        mesh: an empty mesh to fill.

    Raises:
        AuditError: if a tile does not have three corners.
    """
    vertices = instant.vertices
    if mesh is None:
        mesh = Mesh(len(vertices.all))
        diagonals = list(diagonals)
        is_free = all(d.region == FREE for d in diagonals)
        if (
            len(vertices.all) >= MANY
            and is_free
            and not any(body.is_tiled for body in vertices.bodies)
        ):
            _fill(instant, mesh, diagonals)
            _mark_angles(instant, mesh)
            return mesh
    _add_rings(instant, mesh)
    outside, inside = _add_diagonals(mesh, diagonals)
    link = mesh.map.link
    for v in vertices.ids():
        # Counter-clockwise: the edge to the next vertex of the ring, the diagonals inside the
        # body, the edge to the vertex before, the diagonals in free space.
        ahead, behind = mesh.ring_edge[v], twin(mesh.ring_edge[vertices.behind(v)])
        star = _sorted_star(instant, mesh, v, ahead, inside[v]) if v in inside else []
        star.append(behind)
        if v in outside:
            star += _sorted_star(instant, mesh, v, behind, outside[v])
        before = ahead
        for h in star:
            link(twin(h), before)
            before = h
        link(twin(ahead), before)
    _mark_angles(instant, mesh)
    return mesh


def _fill(instant: PredicatesAt, mesh: Mesh, diagonals: Sequence[Diagonal]) -> None:
    """Fill a mesh with the edges of all rings and with diagonals in free space, in numpy."""
    ring = instant.vertices.ids()
    ahead, ids = view(instant.vertices.next_ids).astype(np.int64), np.array(ring, np.int64)
    ends = np.array([(d.u, d.v) for d in diagonals], np.int64).reshape(-1, 2)
    origin = np.concatenate((np.stack((ids, ahead[ids]), axis=1), ends)).ravel()
    region, boundary = np.full(len(origin), FREE, np.uint8), np.zeros(len(origin) // 2, np.bool_)
    region[: 2 * len(ring) : 2], boundary[: len(ring)] = SOLID, True
    of_rings = np.full(len(ahead), NO_HALF_EDGE, np.int64)
    of_rings[ids] = 2 * np.arange(len(ring))
    mesh.region, mesh.boundary = vec[u8](items(region)), vec[bool](items(boundary))
    mesh.ring_edge = half_edge_vec(items(of_rings))
    mesh.map.origin = vertex_vec(items(origin))  # for the predicates of a star

    def sort(v: VertexId, reference: HalfEdge, star: list[HalfEdge]) -> list[HalfEdge]:
        return _sorted_star(instant, mesh, v, reference, star)

    following = follow_stars(instant, origin, ring, ahead, sort)
    previous = np.empty_like(following)
    previous[following] = np.arange(len(following))
    mesh.map = PlanarMap.of(items(origin), items(following), items(previous), [])


def _add_rings(instant: PredicatesAt, mesh: Mesh) -> None:
    vertices = instant.vertices
    for body in vertices.bodies:
        for v in body.ring:
            mesh.ring_edge[v] = mesh.add_edge(v, vertices.ahead(v), boundary=True)
            mesh.region[mesh.ring_edge[v]] = INSIDE if body.is_tiled else SOLID


def _add_diagonals(mesh: Mesh, diagonals: Iterable[Diagonal]) -> tuple[Stars, Stars]:
    """Add the diagonals; the half-edges out of each vertex, outside and inside the bodies."""
    outside: Stars = {}
    inside: Stars = {}
    for u, v, region in diagonals:
        h = mesh.add_edge(u, v, boundary=False)
        mesh.region[h] = mesh.region[twin(h)] = region
        stars = inside if region == INSIDE else outside
        stars.setdefault(u, []).append(h)
        stars.setdefault(v, []).append(twin(h))
    return outside, inside


def _sorted_star(
    instant: PredicatesAt, mesh: Mesh, v: VertexId, reference: HalfEdge, edges: list[HalfEdge]
) -> list[HalfEdge]:
    """Return the half-edges out of v in counter-clockwise order from a reference half-edge."""
    if len(edges) < 2:
        return edges
    return sorted(edges, key=cmp_to_key(star_order(instant, mesh, v, reference)))


def star_order(
    predicates: Predicates, mesh: Mesh, v: VertexId, reference: HalfEdge
) -> Callable[[HalfEdge, HalfEdge], int]:
    """Return a comparison of half-edges out of v by their angles in [0, 2 pi) from a reference."""
    return _Around(predicates, mesh, v, reference).compare


@final
class _Around:
    """The order of the half-edges out of a vertex, counter-clockwise from a reference."""

    __slots__ = ("_base", "_center", "_halves", "_map", "_predicates")

    def __init__(
        self, predicates: Predicates, mesh: Mesh, center: VertexId, reference: HalfEdge
    ) -> None:
        self._predicates = predicates
        self._map: PlanarMap = mesh.map
        self._center = center
        self._base: VertexId = mesh.map.target(reference)
        self._halves: dict[HalfEdge, int] = {}

    def compare(self, g: HalfEdge, h: HalfEdge) -> int:
        """Negative if g is before h, positive if after it."""
        below, other = self._half(g), self._half(h)
        if below != other:
            return other - below
        target = self._map.target
        return -self._predicates.orientation(self._center, target(g), target(h))

    def _half(self, h: HalfEdge) -> int:
        """1 if the angle from the reference is below pi, 0 if pi, -1 if above."""
        known = self._halves.get(h)
        if known is None:
            known = self._predicates.orientation(self._center, self._base, self._map.target(h))
            self._halves[h] = known
        return known


def _mark_angles(instant: PredicatesAt, mesh: Mesh) -> None:
    m = mesh.map
    origin = view(m.origin)
    angles = np.flatnonzero((origin >= 0) & (view(mesh.region) != SOLID))
    ids = np.stack((origin[view(m.previous)[angles]], origin[angles], origin[angles ^ 1]), axis=1)
    is_corner = ids[:, 0] == ids[:, 2]
    is_corner[~is_corner] = instant.signs_of(ids[~is_corner]) > 0
    flags = np.zeros(len(origin), np.bool_)
    flags[angles] = is_corner
    mesh.corner = vec[bool](items(flags))
    seen = [False] * len(m.origin)
    for h in m.half_edges():
        if not seen[h] and mesh.region[h] != SOLID:
            check_budget()
            _mark_face(instant, mesh, h, seen)


def _mark_face(instant: PredicatesAt, mesh: Mesh, first: HalfEdge, seen: list[bool]) -> None:
    """Mark the outer face; every other face must have three corners."""
    m = mesh.map
    corners = 0
    h = first
    while not seen[h]:
        seen[h] = True
        corners += mesh.corner[h]
        h = m.following[h]
    if h != first:  # of inconsistent signs, such as those of a forged file
        raise AuditError(
            f"the half-edges after {instant.vertices.name(m.origin[first])} return elsewhere"
        )
    if corners == 0:
        for h in m.face(first):
            mesh.region[h] = OUTER
    elif corners != 3:
        names = " ".join(instant.vertices.name(m.origin[h]) for h in m.face(first))
        raise AuditError(f"a face with {corners} corners: {names}")
