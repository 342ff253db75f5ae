"""Bodies that come and go in the mixed tiling: geodesics are looked for where they change.

A new geodesic is looked for in triangles, along those of the highest nodes below its own
that have not changed: a chain that can be shrunk to the boundary, with the body and their
tiles on its left and the new geodesic on its right. (Of a body that comes, along its ring.)
Cut into triangles are the faces that the body meets, or has touched, and the tiles of the
nodes that change. At a vertex where the chain has anything else on its right, its geodesic
is taken to pass. What comes out is as short as can be, and as such the only one, if it is
so locally; that is, if it bends at any vertex around the body of that vertex:

* Among triangles a path bends around what is none of them, next to a vertex. The body of
  the vertex is no triangle.
* Where it is taken to pass, that is looked at. If it is not so, it has to move to its
  right, and the tiles there are cut into triangles as well, until it is.

All tiles between the chain and the new geodesic have become triangles then. For each has a
vertex on the chain that the geodesic does not pass: where the geodesic has left the chain
it bends to the right, and no triangle of its own vertices is on its left. As those between
the chain and the old geodesic were cut from the start, all others keep their nodes.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, final

from exactpt.certificates.predicates import Predicates
from exactpt.errors import AuditError
from exactpt.pseudotriangulation.mesh import FREE, OUTER, SOLID
from exactpt.pseudotriangulation.plane_sweep import Sweep
from exactpt.pseudotriangulation.region import Region, Retiled
from exactpt.tiling.mixed.changing import Chains, chains_of, nodes_left, nodes_met
from exactpt.tiling.mixed.geodesics import Geodesics, joined
from exactpt.tiling.mixed.labels import BodyTree, LabelledMesh
from exactpt.tiling.mixed.tree import TOP

if TYPE_CHECKING:
    from exactpt.motion.vertices import MovingBody, Vertices

__all__ = ["LabelledRegion", "region_left", "region_met"]


def region_met(mesh: LabelledMesh, faces: Sequence[int]) -> LabelledRegion:
    """The region of a body that comes.

    Args:
        mesh: the tiling.
        faces: a half-edge of every face that it meets.
    """
    return LabelledRegion(mesh, faces, [], nodes_met(mesh, faces), None)


def region_left(mesh: LabelledMesh, i: int, edges: Sequence[int]) -> LabelledRegion:
    """The region of a body that goes.

    Args:
        mesh: the tiling.
        i: the number of the body.
        edges: those at its vertices.
    """
    sides = [g for h in edges for g in (h, h ^ 1)]
    own = mesh.forest.bodies[i]
    return LabelledRegion(mesh, sides, edges, nodes_left(mesh, own, sides), own)


@final
class LabelledRegion(Region):
    """Faces of a mixed tiling that have been joined, and the geodesics that change there.

    Args:
        mesh: the mesh; the edges are removed from it at once, and the labels.
        faces: a half-edge of every face that is joined; those of nodes that change are too.
        gone: the edges to be removed, besides those between these faces.
        changing: the nodes whose geodesics change.
        own: the tree of the body that goes.
    """

    def __init__(
        self,
        mesh: LabelledMesh,
        faces: Iterable[int],
        gone: Iterable[int],
        changing: set[int],
        own: BodyTree | None,
    ) -> None:
        self._labelled = mesh
        self._triangles: set[int] = set()
        self._triangulation: list[int] = []
        self._was_fixed: dict[int, bool] = {}
        forest = mesh.forest
        trees = [forest.bodies[i] for i in sorted({forest.body(node) for node in changing})]
        self._chains = [chains_of(mesh, of, changing) for of in trees]
        paths = [
            (chains.of.nodes[k], mesh.geodesic(chains.of, k))
            for chains in self._chains
            for k in chains.spans
        ]
        if own is not None:
            paths += [(node, mesh.geodesic(own, k)) for k, node in enumerate(own.nodes)]
        tiles = [h for node, path in paths for h in path if forest.bot(mesh.labels[h]) == node]
        for node, path in paths:
            for h in path:
                self._was_fixed[min(h, h ^ 1)] = True
                mesh.labels[h] -= {node}
        super().__init__(mesh, [*faces, *tiles], gone)
        self._remove(self._inner())

    def add_ring(self, vertices: Vertices, moving: MovingBody) -> None:
        """As `Region.add_ring`; and its tree."""
        super().add_ring(vertices, moving)
        of = self._labelled.forest.add(moving.ring)
        ring = [self.mesh.ring_edge[v] for v in moving.ring]
        spans = {k: (of.tree.low[k], of.tree.high[k]) for k in range(len(of.nodes))}
        self._chains.append(Chains(of, ring, {}, spans))

    def tile(self, predicates: Predicates) -> Retiled:
        """As `Region.tile`: F1 by its geodesics, F2 by a sweep.

        Raises:
            AuditError: if that is not possible: what is in it overlaps.
        """
        self._triangulate(predicates, self._rim, self._around)
        paths = self._paths(predicates)
        for h in self._triangulation:
            self.mesh.map.remove_edge(h)
        self._remove(self._inner())
        bridges = self._label(predicates, paths)
        retiled = super().tile(predicates)
        # A tile may become one of F2 as it is; its edges can be flipped then.
        refixed = [
            g
            for h, was_fixed in self._was_fixed.items()
            if self.mesh.map.origin[h] >= 0 and self.mesh.is_fixed(h) != was_fixed
            for g in (h, h ^ 1)
        ]
        return Retiled(
            retiled.handles,
            retiled.removed,
            bridges + retiled.added,
            list(dict.fromkeys((*retiled.angles, *refixed))),
        )

    def _inner(self) -> list[int]:
        """The edges between faces of the region, none of them of a body."""
        before = self._before
        return [
            h for h in before if h % 2 == 0 and h ^ 1 in before and not self.mesh.is_boundary(h)
        ]

    def _remove(self, edges: list[int]) -> None:
        super()._remove(edges)
        for h in edges:
            self._was_fixed.pop(min(h, h ^ 1), None)

    def _open(self) -> list[int]:
        return [h for h in self._rim if self._labelled.node(h) < 0]

    # Geodesics

    def _triangulate(self, predicates: Predicates, rim: list[int], around: int) -> None:
        """Triangulate what is on the left of half-edges."""
        mesh, m = self.mesh, self.mesh.map
        sweep = Sweep(predicates, self._edges(predicates, rim), triangulate=True, around=around)
        new = self._insert(predicates, [(u, v) for u, v, _ in sweep.run()])
        self._triangulation += [h for h in new if h % 2 == 0]
        seen: set[int] = set()
        for h in (*rim, *new):
            if h not in seen:
                face = m.face(h)
                seen.update(face)
                is_outer = around == FREE and (
                    len(face) != 3 or predicates.sign(*(m.origin[g] for g in face)) <= 0
                )
                for g in face:
                    mesh.region[g] = OUTER if is_outer else FREE
                if not is_outer:
                    self._triangles.update(face)

    def _paths(self, predicates: Predicates) -> list[tuple[int, list[int]]]:
        """The nodes whose geodesics are new, with these."""
        geodesics = Geodesics(predicates, self.mesh, self._triangles)
        paths = []
        for of, edges, after, spans in self._chains:
            for k, (start, end) in spans.items():
                chain = geodesics.from_leftmost(edges) if k == TOP else edges[start:end]
                paths.append((of.nodes[k], self._pulled(predicates, geodesics, chain, after)))
        return paths

    def _pulled(
        self,
        predicates: Predicates,
        geodesics: Geodesics,
        chain: Sequence[int],
        after: dict[int, int],
    ) -> list[int]:
        """The geodesic along a chain; what it is pulled into joins the region."""
        while True:
            chain = geodesics.without_loops(chain)
            parts = geodesics.parts(chain)
            path = joined(parts)
            beside: list[int] = []
            at = 0
            for part in parts[:-1]:
                at += len(part.path) - 1
                bend, g, h = path[at - 1 : at + 2], chain[part.end - 1], chain[part.end]
                if after.get(g) == h and bend == [*self.mesh.ends(g), self.mesh.map.target(h)]:
                    continue  # as in the geodesic below
                if not self._is_taut(predicates, *bend):
                    beside += self._beside(g, h)
            if not beside:
                return path
            for h in beside:
                if h not in self._triangles:
                    self._join(h)
                    self._triangulate(predicates, self.mesh.map.face(h), SOLID)

    def _is_taut(self, predicates: Predicates, a: int, v: int, b: int) -> bool:
        """Whether a path from a to b bends at v around the body of v, or is straight for ever."""
        s = 0 if a == b else predicates.sign(a, v, b)
        if s == 0:
            return a != b and predicates.nearer(a, v, b)
        # The body is on the left of the edge ahead.
        right, left = (a, b) if s < 0 else (b, a)
        ahead = self.mesh.map.target(self.mesh.ring_edge[v])
        return ahead == right or (
            ahead != left
            and predicates.sign(v, right, ahead) >= 0
            and predicates.sign(v, ahead, left) >= 0
        )

    def _beside(self, before: int, after: int) -> list[int]:
        """The angles at a vertex, on the right of a chain, of tiles that are no triangles yet.

        Raises:
            AuditError: if there are none.
        """
        m = self.mesh.map
        beside = []
        h = before ^ 1
        while h != after:
            if self.mesh.region[h] != FREE:
                raise AuditError(f"a geodesic is not taut at vertex {m.origin[h]}")
            if h not in self._triangles:
                beside.append(h)
            h = m.previous[h] ^ 1
        if not beside:
            raise AuditError(f"a geodesic is not taut at vertex {m.origin[h]}")
        return beside

    # Labels

    def _label(
        self, predicates: Predicates, paths: Iterable[tuple[int, list[int]]]
    ) -> list[tuple[int, int]]:
        """Label the edges along geodesics; those that are new."""
        mesh = self._labelled
        nodes: dict[tuple[int, int], set[int]] = {}
        for node, path in paths:
            for ends in pairwise(path):
                nodes.setdefault(ends, set()).add(node)
        chains = [h for chains in self._chains for h in chains.edges]
        edges = {mesh.ends(g): g for h in (*self._rim, *chains) for g in (h, h ^ 1)}
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
            self._was_fixed.setdefault(min(h, h ^ 1), mesh.is_fixed(h))
            mesh.labels[h] |= label
        return bridges
