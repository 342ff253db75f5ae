"""A tiling reduced to the contents of a proof: changes of faces, and their times.

Vertices are those of the
scene; infinitesimal copies and faces that have no area for all times have been contracted.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, NamedTuple, final

from exactpt.indices import NO_VERTEX, HalfEdge
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.motion.track import orientation_polynomial
from exactpt.proof.contraction import Contraction, Cycle, Face
from exactpt.pseudotriangulation.mesh import FREE, INSIDE, OUTER, SOLID, Mesh

if TYPE_CHECKING:
    from exactpt.proof.nodes import Nodes
    from exactpt.tiling.tiling import Tiling


class Step(NamedTuple):
    """A change of the tiling.

    Attributes:
        time: the time of the change.
        names: vertices whose orientation (three) or difference of abscissas (two) may vanish
            at that time.
        gone, come: the faces removed and added, except solid ones.
    """

    time: AlgebraicNumber
    names: list[tuple[int, ...]]
    gone: set[Cycle]
    come: set[Cycle]


@final
class Watch:
    """What changes in a tiling, event by event.

    Args:
        kinetic: the tiling, between two events.
        nodes: the vertices of its bodies.
    """

    def __init__(self, kinetic: Tiling, nodes: Nodes) -> None:
        self.kinetic = kinetic
        self._nodes = nodes
        self._node = kinetic.vertices.nodes()
        bodies = kinetic.vertices.bodies
        self._changes, self._since = kinetic.vertices.changes, [moving.since for moving in bodies]
        self._flat: dict[tuple[int, ...], bool] = {}
        self._faces: dict[HalfEdge, list[HalfEdge]] = {}
        self._face_of: dict[HalfEdge, HalfEdge] = {}
        self._corners: dict[HalfEdge, list[int]] = {}
        self._with_corner_of: list[set[HalfEdge]] = [set() for _ in bodies]
        self._contraction = Contraction(self._is_flat)

    @property
    def now(self) -> AlgebraicNumber:
        """The time of the last event, or of the contact."""
        return self.kinetic.now

    def first(self) -> set[Cycle]:
        """Return all faces just after now."""
        self.kinetic.changes()
        mesh = self.kinetic.mesh_after()
        _, come = self._replace(mesh, set(mesh.map.half_edges()))
        # A single point has no half-edge.
        return come or {Cycle("outer", (v,)) for v in range(len(self._nodes.body_of))}

    def step(self, changed: set[HalfEdge] | None) -> Step:
        """Return the changes since the last call, from those half-edges (`Tiling.changes`)."""
        mesh = self.kinetic.mesh_after()
        if changed is None:
            changed = {*mesh.map.half_edges(), *self._face_of}
        if self.kinetic.vertices.changes != self._changes:
            self._changes = self.kinetic.vertices.changes
            changed |= self._of_new_pieces()
        return Step(self.now, self.names(), *self._replace(mesh, changed))

    def names(self) -> list[tuple[int, ...]]:
        """Return the vertices whose function may vanish now, as in `Step`."""
        certifier, node = self.kinetic.certifier, self._node
        triples = [(t.a, t.b, t.c) for t in (certifier.now, *certifier.roots_now)]
        return [tuple([node[v] for v in t if v >= 0]) for t in triples if t[0] >= 0]

    def _of_new_pieces(self) -> set[HalfEdge]:
        """Half-edges of the faces with a corner of a body that has begun a piece of its motion."""
        bodies, found = self.kinetic.vertices.bodies, set[HalfEdge]()
        for i, (moving, since) in enumerate(zip(bodies, self._since, strict=True)):
            if moving.since != since:
                found |= self._with_corner_of[i]
        self._since = [moving.since for moving in bodies]
        self._flat.clear()
        return found

    def _replace(self, mesh: Mesh, changed: set[HalfEdge]) -> tuple[set[Cycle], set[Cycle]]:
        """Update the faces of the mesh; returns those removed and those added."""
        return self._contraction.update(*self._update(mesh, changed), self._later())

    def _update(
        self, mesh: Mesh, changed: set[HalfEdge]
    ) -> tuple[list[HalfEdge], list[tuple[HalfEdge, Face]]]:
        """Update the faces of the mesh; returns the keys of those removed, and those added."""
        m = mesh.map
        gone = sorted({self._face_of[h] for h in changed if h in self._face_of})
        pool = changed.union(*(self._faces.pop(key) for key in gone))
        for h in pool:
            self._face_of.pop(h, None)
        for key in gone:
            for i in self._corners.pop(key, ()):
                self._with_corner_of[i].discard(key)
        come = []
        for h in sorted(pool):
            if h >= len(m.origin) or m.origin[h] == NO_VERTEX or h in self._face_of:
                continue
            cycle = self._faces[h] = m.face(h)
            self._face_of.update(dict.fromkeys(cycle, h))
            face = self._face(mesh, cycle)
            if face is not None:
                come.append((h, face))
                self._corners[h] = [self._nodes.body_of[v] for v in face.corners]
                for i in self._corners[h]:
                    self._with_corner_of[i].add(h)
        return gone, come

    def _face(self, mesh: Mesh, cycle: list[HalfEdge]) -> Face | None:
        """Return a face in vertices of the scene; None inside a rigid or degenerate body."""
        around = [self._node[mesh.map.origin[h]] for h in cycle]
        region, i = mesh.region[cycle[0]], self._nodes.body_of[around[0]]
        body = self._nodes.scene.bodies[i]
        is_thin = body.size < 3 or not body.closed
        if region in (SOLID, INSIDE) and (self._nodes.rigid[i] or is_thin):
            return None
        corners = [v for v, h in zip(around, cycle, strict=True) if mesh.corner[h]]
        label = {FREE: "face", OUTER: "outer"}.get(region, "inside")
        return Face(label, around, [] if region in (SOLID, OUTER) else corners)

    def _is_flat(self, *corners: int) -> bool:
        """Return True if three vertices stay collinear in the current pieces of their motions."""
        if corners not in self._flat:
            nodes, bodies = self._nodes, self.kinetic.vertices.bodies
            tracks = [nodes.track(v, bodies[nodes.body_of[v]].since) for v in corners]
            self._flat[corners] = not orientation_polynomial(*tracks)
        return self._flat[corners]

    def _later(self) -> Callable[[int], tuple[QQ, QQ]]:
        """Return the positions of vertices at a rational time before the next event."""

        @cache
        def time() -> QQ:
            following = self.kinetic.next_number()
            end = AlgebraicNumber(self._nodes.scene.end)
            if following is None or following.compare(end) > 0:
                following = end
            return rational_between(self.now, following)

        return cache(lambda v: self._nodes.track(v, time()).at(time()))
