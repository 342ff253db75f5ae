"""Insertion and removal of bodies in the mixed tiling: changed geodesics are recomputed.

A new geodesic is computed in a triangulated region, along a chain: the unchanged geodesics of
the highest nodes below its own (for a new body, its ring). The chain is homotopic to the
boundary, with the body and the tiles of these nodes on its left and the new geodesic on its
right. The region consists of the faces that the body intersects, or the faces at its vertices, and
the tiles of the nodes that change. At a vertex where a face on the right of the chain is
outside the region, the geodesic is assumed to pass. The resulting path is the shortest one of
its homotopy class, which is unique, if it is locally shortest; that is, if at every vertex
where it bends, it bends around the body of that vertex:

* Among triangles a path bends at a vertex only around faces that are not among them. The body
  of the vertex is such a face.
* Where the geodesic is assumed to pass, this is checked. If it fails, the geodesic has to move
  to the right there; the tiles on that side are added to the region, and the path is computed
  again.

At the end all tiles between the chain and the new geodesic are in the region. For each such
tile has a vertex on the chain that the geodesic does not pass: where the geodesic has left the
chain it bends to the right, so no tile with all its vertices on the geodesic is on its left.
The tiles between the chain and the old geodesic are in the region from the start. So all other
tiles keep their nodes.

The body has one ring. Where geodesics along a hole change, whose cycle is around the contents of
the hole, the whole is tiled anew instead.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, final

from exactpt.certificates.predicates import Predicates
from exactpt.errors import AuditError
from exactpt.indices import Ends, HalfEdge, VertexId
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.mesh import FREE, OUTER, SOLID
from exactpt.pseudotriangulation.plane_sweep import Sweep
from exactpt.pseudotriangulation.region import Region, Retiled
from exactpt.tiling.mixed.changed_geodesics import (
    ChangedGeodesics,
    changed_geodesics,
    nodes_changed_by_insertion,
    nodes_changed_by_removal,
)
from exactpt.tiling.mixed.forest import RingTree
from exactpt.tiling.mixed.geodesics import Geodesics, joined
from exactpt.tiling.mixed.labels import LabelledMesh
from exactpt.tiling.mixed.tree import TOP

if TYPE_CHECKING:
    from exactpt.motion.vertices import MovingBody, Vertices


def region_of_insertion(mesh: LabelledMesh, faces: Sequence[HalfEdge]) -> LabelledRegion | None:
    """Return the region to retile when a body is added; None if a geodesic of a hole changes.

    Args:
        mesh: the tiling.
        faces: one half-edge of every face that it intersects.
    """
    changing = nodes_changed_by_insertion(mesh, faces)
    return (
        None if mesh.forest.has_hole(changing) else LabelledRegion(mesh, faces, [], changing, None)
    )


def region_of_removal(
    mesh: LabelledMesh, i: int, edges: Sequence[HalfEdge]
) -> LabelledRegion | None:
    """Return the region to retile when a body is removed; None if a geodesic of a hole changes.

    Args:
        mesh: the tiling.
        i: the number of the body.
        edges: the edges at its vertices.
    """
    sides = [g for h in edges for g in (h, twin(h))]
    (own,) = mesh.forest.bodies[i]
    changing = nodes_changed_by_removal(mesh, own, sides)
    return (
        None
        if mesh.forest.has_hole(changing)
        else LabelledRegion(mesh, sides, edges, changing, own)
    )


@final
class LabelledRegion(Region):
    """Merged faces of a mixed tiling, and the geodesics that change there.

    Args:
        mesh: the mesh; the edges and labels are removed from it at once.
        faces: one half-edge of every face to merge; the tiles of changing nodes are merged too.
        gone: the edges to be removed besides those between these faces.
        changing: the nodes whose geodesics change.
        own: the tree of the body that is removed, if one is.
    """

    def __init__(
        self,
        mesh: LabelledMesh,
        faces: Iterable[HalfEdge],
        gone: Iterable[HalfEdge],
        changing: set[int],
        own: RingTree | None,
    ) -> None:
        self._labelled = mesh
        self._triangles: set[HalfEdge] = set()
        self._triangulation: list[HalfEdge] = []
        self._was_fixed: dict[HalfEdge, bool] = {}
        forest = mesh.forest
        bodies = sorted({forest.body(node) for node in changing})
        self._changed = [
            changed_geodesics(mesh, tree, changing)
            for i in bodies
            for tree in forest.bodies[i]
            if tree.nodes[TOP] in changing
        ]
        paths = [
            (changed.tree.nodes[k], mesh.geodesic(changed.tree, k))
            for changed in self._changed
            for k in changed.spans
        ]
        if own is not None:
            paths += [(node, mesh.geodesic(own, k)) for k, node in enumerate(own.nodes)]
        tiles = [h for node, path in paths for h in path if forest.bot(mesh.labels[h]) == node]
        for node, path in paths:
            for h in path:
                self._was_fixed[min(h, twin(h))] = True
                mesh.labels[h] -= {node}
        super().__init__(mesh, [*faces, *tiles], gone)
        self._remove(self._inner())

    def add_ring(self, vertices: Vertices, moving: MovingBody) -> None:
        """As `Region.add_ring`, and add the tree of the body."""
        super().add_ring(vertices, moving)
        (of,) = self._labelled.forest.add(moving)
        ring = [self.mesh.ring_edge[v] for v in moving.ring]
        spans = {k: (of.tree.low[k], of.tree.high[k]) for k in range(len(of.nodes))}
        self._changed.append(ChangedGeodesics(of, ring, {}, spans))

    def tile(self, predicates: Predicates) -> Retiled:
        """As `Region.tile`: F1 by geodesics, F2 by a sweep.

        Raises:
            AuditError: if the region cannot be tiled, because bodies in it overlap.
        """
        self._triangulate(predicates, self._rim, self._around)
        paths = self._paths(predicates)
        for h in self._triangulation:
            self.mesh.map.remove_edge(h)
        self._remove(self._inner())
        bridges = self._label(predicates, paths)
        retiled = super().tile(predicates)
        # A tile may become one of F2 unchanged; its edges can then be flipped.
        refixed = [
            g
            for h, was_fixed in self._was_fixed.items()
            if self.mesh.map.origin[h] >= 0 and self.mesh.is_fixed(h) != was_fixed
            for g in (h, twin(h))
        ]
        return Retiled(
            retiled.handles,
            retiled.removed,
            bridges + retiled.added,
            list(dict.fromkeys((*retiled.angles, *refixed))),
        )

    def _inner(self) -> list[HalfEdge]:
        """Return the diagonals between faces of the region."""
        before = self._before
        return [
            h for h in before if h % 2 == 0 and h ^ 1 in before and not self.mesh.is_boundary(h)
        ]

    def _remove(self, edges: list[HalfEdge]) -> None:
        super()._remove(edges)
        for h in edges:
            self._was_fixed.pop(min(h, twin(h)), None)

    def _open(self) -> list[HalfEdge]:
        return [h for h in self._rim if self._labelled.node(h) < 0]

    # Geodesics

    def _triangulate(self, predicates: Predicates, rim: list[HalfEdge], around: int) -> None:
        """Triangulate the faces on the left of half-edges."""
        mesh, m = self.mesh, self.mesh.map
        sweep = Sweep(predicates, self._edges(predicates, rim), triangulate=True, around=around)
        new = self._insert(predicates, [(u, v) for u, v, _ in sweep.run()])
        self._triangulation += [h for h in new if h % 2 == 0]
        seen: set[HalfEdge] = set()
        for h in (*rim, *new):
            if h not in seen:
                face = m.face(h)
                seen.update(face)
                is_outer = around == FREE and (
                    len(face) != 3 or predicates.orientation(*(m.origin[g] for g in face)) <= 0
                )
                for g in face:
                    mesh.region[g] = OUTER if is_outer else FREE
                if not is_outer:
                    self._triangles.update(face)

    def _paths(self, predicates: Predicates) -> list[tuple[int, list[VertexId]]]:
        """Return the nodes with new geodesics, and these geodesics."""
        geodesics = Geodesics(predicates, self.mesh, self._triangles)
        paths = []
        for tree, edges, after, spans in self._changed:
            for k, (start, end) in spans.items():
                chain = geodesics.from_leftmost(edges) if k == TOP else edges[start:end]
                paths.append((tree.nodes[k], self._pulled(predicates, geodesics, chain, after)))
        return paths

    def _pulled(
        self,
        predicates: Predicates,
        geodesics: Geodesics,
        chain: Sequence[HalfEdge],
        after: dict[HalfEdge, HalfEdge],
    ) -> list[VertexId]:
        """Return the geodesic homotopic to a chain; tiles that it enters join the region."""
        while True:
            chain = geodesics.without_loops(chain)
            parts = geodesics.parts(chain)
            path = joined(parts)
            beside: list[HalfEdge] = []
            at = 0
            for part in parts[:-1]:
                at += len(part.path) - 1
                triple, g, h = path[at - 1 : at + 2], chain[part.end - 1], chain[part.end]
                if after.get(g) == h and triple == [*self.mesh.ends(g), self.mesh.map.target(h)]:
                    continue  # as in the unchanged geodesic
                if not self._is_taut(predicates, *triple):
                    beside += self._beside(g, h)
            if not beside:
                return path
            for h in beside:
                if h not in self._triangles:
                    self._join(h)
                    self._triangulate(predicates, self.mesh.map.face(h), SOLID)

    def _is_taut(self, predicates: Predicates, a: VertexId, v: VertexId, b: VertexId) -> bool:
        """Return True if a path a v b bends around the body of v, or is straight for all times."""
        s = 0 if a == b else predicates.orientation(a, v, b)
        if s == 0:
            return a != b and predicates.nearer(a, v, b)
        # The body is on the left of the edge ahead.
        right, left = (a, b) if s < 0 else (b, a)
        ahead = self.mesh.map.target(self.mesh.ring_edge[v])
        return ahead == right or (
            ahead != left
            and predicates.orientation(v, right, ahead) >= 0
            and predicates.orientation(v, ahead, left) >= 0
        )

    def _beside(self, before: HalfEdge, after: HalfEdge) -> list[HalfEdge]:
        """Return the angles at a vertex, on the right of a chain, of tiles not in the region yet.

        Raises:
            AuditError: if there are none, or a face there is not in free space.
        """
        m = self.mesh.map
        beside = []
        h = twin(before)
        while h != after:
            if self.mesh.region[h] != FREE:
                raise AuditError(f"a geodesic is not taut at vertex {m.origin[h]}")
            if h not in self._triangles:
                beside.append(h)
            h = twin(m.previous[h])
        if not beside:
            raise AuditError(f"a geodesic is not taut at vertex {m.origin[h]}")
        return beside

    # Labels

    def _label(
        self, predicates: Predicates, paths: Iterable[tuple[int, list[VertexId]]]
    ) -> list[Ends]:
        """Label the edges along geodesics; returns the new edges."""
        mesh = self._labelled
        nodes: dict[Ends, set[int]] = {}
        for node, path in paths:
            for ends in pairwise(path):
                nodes.setdefault(ends, set()).add(node)
        chains = [h for changed in self._changed for h in changed.edges]
        edges = {mesh.ends(g): g for h in (*self._rim, *chains) for g in (h, twin(h))}
        bridges = [
            ends
            for ends in nodes
            if ends not in edges and (ends[0] < ends[1] or ends[::-1] not in nodes)
        ]
        new = self._insert(predicates, bridges)
        self._rim += new
        edges.update((mesh.ends(h), h) for h in new)
        for ends, label in nodes.items():
            h = edges[ends]
            self._was_fixed.setdefault(min(h, twin(h)), mesh.is_fixed(h))
            mesh.labels[h] |= label
        return bridges
