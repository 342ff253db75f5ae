"""The run of a tiling, reduced to what a proof contains: the changes of faces, and their times.

This is the only module of the package that depends on tilings. Vertices are those of the
scene; infinitesimal copies and faces that have no area for ever have been contracted.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING, Final, NamedTuple, final

from exactpt.collision.tilings import start_tiling
from exactpt.errors import BudgetExceeded
from exactpt.indices import NO_VERTEX, HalfEdge, VertexId
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.motion.incidence import orientation
from exactpt.proof.contraction import Cycle, Face, contract
from exactpt.pseudotriangulation.mesh import FREE, INSIDE, OUTER, SOLID, Mesh
from exactpt.tiling.events import ContactFound

if TYPE_CHECKING:
    from exactpt.motion.incidence import Touch
    from exactpt.proof.nodes import Nodes
    from exactpt.scene.scene import Scene
    from exactpt.tiling.tiling import Tiling

__all__ = ["Run", "Step"]

CHUNK: Final = 256
"""Number of links of half-edges that are compared at once."""


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
class Run:
    """A tiling of a scene on its way to the first contact.

    Attributes:
        kinetic: the tiling.
        touches: the incidences at the first contact; empty if there is none.
    """

    def __init__(
        self,
        scene: Scene,
        nodes: Nodes,
        tiling: str,
        *,
        exact_only: bool = False,
        max_events: int | None = None,
    ) -> None:
        self._scene, self._nodes = scene, nodes
        self.kinetic: Tiling = start_tiling(scene, tiling, scene._start, exact_only=exact_only)
        self._most = max_events
        self._node = self.kinetic.vertices.nodes()
        self.touches: list[Touch] = []
        self._changes = -1
        self._flat: dict[tuple[int, ...], bool] = {}
        self._forget()
        self._shown: set[Cycle] = set()

    def _forget(self) -> None:
        """Forget the faces of the mesh, so that all of them count as new."""
        self._following: list[HalfEdge] = []
        self._origin: list[VertexId] = []
        self._faces: dict[HalfEdge, tuple[list[HalfEdge], Face | None]] = {}
        self._face_of: dict[HalfEdge, HalfEdge] = {}
        self._cutting: set[HalfEdge] = set()

    def steps(self) -> Iterator[Step]:
        """The tiling at the start, and after each event before the contact."""
        kinetic, end = self.kinetic, self._scene.end
        yield self._step()
        count = 0
        try:
            while (events := kinetic.advance(end)) is not None:
                count += len(events)
                if self._most is not None and count > self._most:
                    raise BudgetExceeded("the number of events is used up", self.reached())
                if kinetic.now.compare_rational(end) < 0:
                    yield self._step()
        except ContactFound as found:
            self.touches = sorted(found.touches)

    @property
    def now(self) -> AlgebraicNumber:
        """The time of the last event, or of the contact."""
        return self.kinetic.now

    def reached(self) -> QQ:
        """A rational time not after now."""
        return self.now._low if self.now.is_rational else self.now._canonical_interval()[0]

    def names(self) -> list[tuple[int, ...]]:
        """The vertices whose function may vanish now, as in `Step`."""
        certifier, node = self.kinetic.certifier, self._node
        cause = certifier.now
        triples = [(cause.a, cause.b, cause.c), *certifier.roots_now]
        return [tuple([node[v] for v in t if v >= 0]) for t in triples if t[0] >= 0]

    def _step(self) -> Step:
        kinetic = self.kinetic
        if kinetic.vertices.changes != self._changes:
            self._changes = kinetic.vertices.changes
            self._flat.clear()
            self._forget()
        all_new, were_cut = not self._faces, bool(self._cutting)
        gone, come = self._update(kinetic.mesh_after())
        if all_new or were_cut or self._cutting:
            now = contract([f for _, f in self._faces.values() if f], self._is_flat, self._later)
            # A single point has no half-edge.
            now = now or {Cycle("outer", (0,))}
            before = self._shown
        else:
            now, before = (contract(faces, self._is_flat, self._later) for faces in (come, gone))
        self._shown = (self._shown - before) | now
        return Step(self.now, self.names(), before - now, now - before)

    def _update(self, mesh: Mesh) -> tuple[list[Face], list[Face]]:
        """Update the faces of the mesh; returns those removed and those added."""
        m = mesh.map
        changed = {*_differing(self._following, m.following), *_differing(self._origin, m.origin)}
        self._following, self._origin = m.following[:], m.origin[:]
        keys = {self._face_of[h] for h in changed if h in self._face_of}
        old = [self._faces.pop(key) for key in sorted(keys)]
        self._cutting -= keys
        pool = changed.union(*(cycle for cycle, _ in old))
        for h in pool:
            self._face_of.pop(h, None)
        come = []
        for h in sorted(pool):
            if h >= len(m.origin) or m.origin[h] == NO_VERTEX or h in self._face_of:
                continue
            cycle = m.face(h)
            self._face_of.update(dict.fromkeys(cycle, h))
            face = self._face(mesh, cycle)
            self._faces[h] = cycle, face
            if face is not None:
                come.append(face)
                if len(set(face.around)) > 2 and face.corners and self._is_flat(*face.corners):
                    self._cutting.add(h)
        return [face for _, face in old if face is not None], come

    def _face(self, mesh: Mesh, cycle: list[HalfEdge]) -> Face | None:
        """A face in vertices of the scene; None for the interior of a rigid or a thin body."""
        around = [self._node[mesh.map.origin[h]] for h in cycle]
        region, i = mesh.region[cycle[0]], self._nodes.body_of[around[0]]
        body = self._scene.bodies[i]
        is_thin = body.size < 3 or not body.closed
        if region in (SOLID, INSIDE) and (self._nodes.rigid[i] or is_thin):
            return None
        corners = [v for v, h in zip(around, cycle, strict=True) if mesh.corner[h]]
        label = {FREE: "face", OUTER: "outer"}.get(region, "inside")
        return Face(label, around, [] if region in (SOLID, OUTER) else corners)

    def _is_flat(self, *corners: int) -> bool:
        """Whether three vertices stay collinear in the current pieces of their motions."""
        if corners not in self._flat:
            nodes, bodies = self._nodes, self.kinetic.vertices.bodies
            tracks = [nodes.track(v, bodies[nodes.body_of[v]].since) for v in corners]
            self._flat[corners] = not orientation(*tracks)
        return self._flat[corners]

    def _later(self) -> list[tuple[QQ, QQ]]:
        """The positions of all vertices at a rational time before the next event."""
        now, following = self.now, self.kinetic.next_number()
        end = AlgebraicNumber(self._scene.end)
        if following is None or following.compare(end) > 0:
            following = end
        t = rational_between(now, following)
        return [self._nodes.track(v, t).at(t) for v in range(len(self._nodes.body_of))]


def _differing(old: Sequence[int], new: Sequence[int]) -> Iterator[HalfEdge]:
    """The half-edges at which two lists differ; either may be longer."""
    for i in range(0, max(len(old), len(new)), CHUNK):
        a, b = old[i : i + CHUNK], new[i : i + CHUNK]
        if a != b:
            for k, (x, y) in enumerate(zip_longest(a, b)):
                if x != y:
                    yield HalfEdge(i + k)
