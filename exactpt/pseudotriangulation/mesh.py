"""A tiling as topology with marks: the region of every half-edge, and which angles are corners.

The angle of half-edge h is the one at its origin, between the half-edge before it and h,
in the face on the left.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, Final, NamedTuple, cast

from librt.vecs import append, vec
from mypy_extensions import u8

from exactpt.errors import AuditError
from exactpt.indices import (
    NO_HALF_EDGE,
    NO_VERTEX,
    Ends,
    HalfEdge,
    VertexId,
    half_edge_vec,
)
from exactpt.kernel.stored import Stored
from exactpt.planar.halfedge import PlanarMap, twin

FREE: Final = 0
OUTER: Final = 1
SOLID: Final = 2
INSIDE: Final = 3


class Diagonal(NamedTuple):
    """An edge of a tiling between two vertices, in free space or inside a body."""

    u: VertexId
    v: VertexId
    region: int = FREE


class Tile(NamedTuple):
    """The relative hull that a tile lies in, by its body, and its level there; body -1: none."""

    body: int
    level: int


F2: Final = Tile(-1, 0)


class Mesh:
    """A planar map of body edges and diagonals, with marks that every repair maintains.

    `exactpt.tiling.mixed.labels` adds labels, and the rules for them.

    Attributes:
        map: the half-edges.
        region: for each half-edge, the kind of the face on its left: `FREE` (a
            pseudo-triangle), `OUTER` (outside the convex hull), `SOLID` (inside a rigid
            body), `INSIDE` (a pseudo-triangle inside a body that deforms).
        corner: for each half-edge, whether its angle is less than pi; a tile has three.
        boundary: for each edge (half of the handle), whether it is an edge of a body.
        ring_edge: for each vertex, the half-edge to the next one on its ring; the body is
            on its left. `NO_HALF_EDGE` for a vertex of no body.
    """

    def __init__(self, vertices: int) -> None:
        self.map = PlanarMap()
        self.region: vec[u8] = vec[u8]()
        self.corner: vec[bool] = vec[bool]()
        self.boundary: vec[bool] = vec[bool]()
        self.ring_edge: vec[HalfEdge] = half_edge_vec([NO_HALF_EDGE] * vertices)

    def add_edge(self, u: VertexId, v: VertexId, *, boundary: bool) -> HalfEdge:
        """Add an edge, not linked yet, with free space on both sides; returns a half-edge."""
        h = self.map.add_edge(u, v)
        self._mark(h, boundary=boundary)
        return h

    def _mark(self, h: HalfEdge, *, boundary: bool) -> None:
        if h == len(self.region):
            self.region = append(append(self.region, FREE), FREE)
            self.corner = append(append(self.corner, False), False)
            self.boundary = append(self.boundary, boundary)
        else:
            self.region[h] = self.region[h + 1] = FREE
            self.boundary[h >> 1] = boundary

    def is_boundary(self, h: HalfEdge) -> bool:
        """Return True if a half-edge belongs to a body edge."""
        return self.boundary[h >> 1]

    def is_hull(self, h: HalfEdge) -> bool:
        """Return True if an edge is on the convex hull of all bodies."""
        return OUTER in (self.region[h], self.region[h ^ 1])

    def is_fixed(self, h: HalfEdge) -> bool:
        """Return True if an edge is never flipped: a body edge, or one that has a label."""
        return self.boundary[h >> 1]

    def is_flippable(self, h: HalfEdge) -> bool:
        """Return True if a half-edge belongs to a diagonal between two tiles of free space."""
        return self.region[h] == self.region[h ^ 1] == FREE and not self.is_fixed(h)

    def flippable(self) -> list[HalfEdge]:
        """Return the diagonals (even half-edges) that may be flipped."""
        return [h for h in self.diagonals() if self.is_flippable(h)]

    def stays(self, h: HalfEdge) -> tuple[bool, bool]:
        """Return True if h and the edge before it remain when their angle becomes straight."""
        return self.is_boundary(self.map.previous[h]), self.is_boundary(h)

    def tile(self, h: HalfEdge) -> Tile:  # noqa: ARG002 - without labels there is only one
        """Return the relative hull and level of the tile on the left of a half-edge."""
        return F2

    def ends(self, h: HalfEdge) -> Ends:
        """Return the origin and the target of a half-edge."""
        return self.map.origin[h], self.map.origin[h ^ 1]

    def diagonals(self) -> list[HalfEdge]:
        """Return the even half-edges of all edges that are not body edges."""
        origin = self.map.origin
        half_edges = map(HalfEdge, range(0, len(origin), 2))
        return [h for h in half_edges if origin[h] >= 0 and not self.boundary[h >> 1]]

    def ring_edges(self) -> list[HalfEdge]:
        """Return the half-edges of all rings, in the order of their origins."""
        return [h for h in self.ring_edge if h != NO_HALF_EDGE]

    def faces(self, region: int = FREE) -> list[list[HalfEdge]]:
        """Return the faces of a kind as cycles of half-edges, each from its least half-edge."""
        seen: set[HalfEdge] = set()
        faces = []
        for h in self.map.half_edges():
            if h not in seen and self.region[h] == region:
                face = self.map.face(h)
                seen.update(face)
                faces.append(face)
        return faces

    def collapse_corner(self, h: HalfEdge, *, origin_moves: bool) -> None:
        """Repair the corner of h, whose angle has become 0.

        With ``origin_moves`` the edge before h is the shorter one, and the origin of h moves
        to its far end. Otherwise h is shorter, and the edge before it ends at its target.
        """
        m = self.map
        region, corner = self.region, self.corner
        if origin_moves:
            a, t = m.previous[h], twin(h)
            m.slide_origin(h)
            corner[h], corner[a], region[a] = True, False, region[t]
        else:
            a = m.previous[h]
            t, b = twin(a), m.following[h]
            was = corner[t]
            m.slide_target(a)
            # The face of a loses the corner; the one across gains a reflex angle at t.
            corner[b], corner[h], corner[t] = True, was, False
            region[h] = region[t]

    def straighten(self, h: HalfEdge, *, origin_moves: bool) -> None:
        """Repair the reflex angle at the origin of h, which has become straight.

        With ``origin_moves`` the origin of h moves to the origin of the edge before it.
        Otherwise the target of the edge before moves to that of h.
        """
        m = self.map
        region, corner = self.region, self.corner
        if origin_moves:
            a, t = m.previous[h], twin(h)
            c, was = m.following[t], corner[a]
            m.slide_origin(h)
            corner[h], corner[a], corner[c] = was, True, False
            region[a] = region[t]
        else:
            a = m.previous[h]
            t = twin(a)
            m.slide_target(a)
            # t: a corner now, at the far end of h; h: reflex, at the old reflex vertex.
            corner[h], corner[t] = False, True
            region[h] = region[t]

    def cut_off(self, h: HalfEdge) -> HalfEdge:
        """Cut off the triangle at the origin of h by a new edge; returns its outer half-edge.

        The new half-edge leads from the origin of the half-edge before h to the target of
        h, with their old face on its left.
        """
        m = self.map
        a, b = m.previous[h], m.following[h]
        was = self.corner[a]
        e = m.split_face(a, b)
        self._mark(min(e, twin(e)), boundary=False)
        self.region[e] = self.region[a]
        inside = INSIDE if self.region[a] == INSIDE else FREE
        for g in (a, h, twin(e)):
            self.region[g], self.corner[g] = inside, True
        self.corner[e] = was
        return e

    def dissolve_triangle(self, h: HalfEdge) -> None:
        """Remove a diagonal on which the opposite vertex of its triangle lies now.

        The vertex becomes a reflex vertex of the face across.
        """
        m = self.map
        first, second = m.following[h], m.previous[h]
        self.corner[first] = self.corner[h ^ 1]
        self.corner[second] = False
        self.region[first] = self.region[second] = self.region[h ^ 1]
        m.remove_edge(h)

    def flip_out(self, h: HalfEdge) -> tuple[HalfEdge, HalfEdge]:
        """Remove a diagonal between two tiles.

        Returns:
            The next half-edges at its origin and at its target; each now has the joined
            angle there, whose mark the caller must set.
        """
        m = self.map
        at_origin, at_target = m.following[h ^ 1], m.following[h]
        m.remove_edge(h)
        return at_origin, at_target

    def flip_in(self, h: HalfEdge, g: HalfEdge) -> HalfEdge:
        """Insert a diagonal between the visits of h and g in one tile.

        Returns:
            The half-edge from the origin of h to that of g; the four angles at its ends
            belong to it, its twin, h and g, and the caller must set their marks.
        """
        e = self.map.split_face(h, g)
        self._mark(min(e, twin(e)), boundary=False)
        self.region[e] = self.region[e ^ 1] = self.region[h]
        return e

    def copy(self) -> Mesh:
        """Return an independent copy."""
        other = Mesh(0)
        self._copy_to(other)
        return other

    def _copy_to(self, other: Mesh) -> None:
        other.map = self.map.copy()
        other.region, other.corner = self.region[:], self.corner[:]
        other.boundary, other.ring_edge = self.boundary[:], self.ring_edge[:]

    def state(self) -> dict[str, list[Any]]:
        """Return the mesh as JSON data."""
        m = self.map
        return {
            "origin": list(m.origin),
            "following": list(m.following),
            "previous": list(m.previous),
            "free": list(m.free),
            "region": list(self.region),
            "corner": [int(c) for c in self.corner],
            "boundary": [int(b) for b in self.boundary],
            "ring_edge": list(self.ring_edge),
        }

    def resume(self, state: Stored, vertices: int) -> None:
        """Have these half-edges and marks.

        Args:
            state: what `state` returned.
            vertices: the number of vertex ids.

        Raises:
            AuditError: if the free handles are others than those that are not in use.
            InputError: if the lists do not belong together, or an entry is out of range.
        """
        origin = state["origin"].integers(int(NO_VERTEX), vertices - 1)
        count = len(origin)
        if count % 2:
            raise state["origin"].refused("an even number of half-edges")

        def half_edges(key: str, length: int | None = count) -> list[HalfEdge]:
            # A cast: to call `HalfEdge` for each of them takes most of the time of a copy.
            return cast("list[HalfEdge]", state[key].integers(0, count - 1, length=length))

        self.map = PlanarMap.of(
            cast("list[VertexId]", origin),
            half_edges("following"),
            half_edges("previous"),
            list(half_edges("free", length=None)),
        )
        self.map.audit_free()
        self.region = vec[u8](state["region"].integers(FREE, INSIDE, length=count))
        corner = state["corner"].integers(0, 1, length=count)
        boundary = state["boundary"].integers(0, 1, length=count // 2)
        self.corner, self.boundary = vec[bool](map(bool, corner)), vec[bool](map(bool, boundary))
        ring_edge = state["ring_edge"].integers(int(NO_HALF_EDGE), count - 1, length=vertices)
        self.ring_edge = half_edge_vec(cast("list[HalfEdge]", ring_edge))
        on_rings = {h >> 1 for h in ring_edge if h != NO_HALF_EDGE}
        for edge, is_marked in enumerate(boundary):
            if origin[2 * edge] >= 0 and is_marked != (edge in on_rings):
                raise state["boundary"].refused(f"1 for the edges of bodies alone (edge {edge})")

    def labelling(self) -> list[frozenset[int]]:
        """Of each half-edge, the geodesics that run along it; empty if none are kept."""
        return []

    def relative_hulls(self) -> Callable[[int], list[VertexId]] | None:
        """Return the shortest loop around each body, as vertex ids; None if unknown."""
        return None

    def audit(self) -> None:
        """Check links and marks.

        Raises:
            AuditError: if a tile does not have three corners, the outer face has any, or the
                half-edges of a face are marked with different regions.
        """
        self.map.audit()
        for h in self.map.half_edges():
            if self.region[h] != self.region[self.map.following[h]]:
                raise AuditError(f"half-edge {h} and the next one bound different regions")
        self.audit_faces(self.map.half_edges())

    def audit_faces(self, half_edges: Iterable[HalfEdge]) -> None:
        """Check the number of corners of the faces of some half-edges.

        Raises:
            AuditError: if a tile does not have three corners, or the outer face has any.
        """
        seen: set[HalfEdge] = set()
        for h in half_edges:
            if h in seen or self.map.origin[h] < 0 or self.region[h] == SOLID:
                continue
            face = self.map.face(h)
            seen.update(face)
            corners = [g for g in face if self.corner[g]]
            if len(corners) != (0 if self.region[h] == OUTER else 3):
                raise AuditError(f"face {face} has corners {corners}")
