"""What a proof needs of a tiling: the faces after every event, and when that was.

The only module of this room that knows tilings. Vertices are those of the scene here; what
is infinitesimal or without area for ever has been contracted.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple, final

from exactpt.collision.tilings import start_tiling, tiling_for_contact
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.motion.incidence import orientation
from exactpt.planar.halfedge import NOTHING
from exactpt.proof.contraction import Face, contract
from exactpt.tiling.events import ContactFound
from exactpt.tiling.mesh import FREE, INSIDE, OUTER, SOLID

if TYPE_CHECKING:
    from exactpt.motion.incidence import Touch
    from exactpt.proof.nodes import Nodes
    from exactpt.scene.scene import Scene

__all__ = ["Moment", "Run"]


class Moment(NamedTuple):
    """The tiling just after a time.

    Attributes:
        time: when.
        names: vertices of which the orientation (three) or the difference of abscissas (two)
            may vanish at that time.
        faces: all but the solid ones: the label and the vertices around it.
    """

    time: AlgebraicNumber
    names: list[tuple[int, ...]]
    faces: list[tuple[str, tuple[int, ...]]]


@final
class Run:
    """A tiling of a scene on its way to the first contact.

    Attributes:
        name: of the tiling.
        touches: what touches at the end of the run; empty if nothing does.
    """

    def __init__(
        self, scene: Scene, nodes: Nodes, tiling: str, *, exact_only: bool = False
    ) -> None:
        self._scene, self._nodes = scene, nodes
        self.name = tiling_for_contact(scene, tiling)
        self._kinetic = start_tiling(scene, self.name, scene.start, exact_only=exact_only)
        self._node = self._kinetic.vertices.nodes()
        self.touches: list[Touch] = []
        self._changes = -1
        self._flat: dict[tuple[int, ...], bool] = {}

    def moments(self) -> Iterator[Moment]:
        """The tiling at the start, and after each event before the contact."""
        kinetic, end = self._kinetic, self._scene.end
        yield self._moment()
        try:
            while kinetic.advance(end) is not None:
                if kinetic.now.compare_rational(end) < 0:
                    yield self._moment()
        except ContactFound as found:
            self.touches = sorted(found.touches)

    @property
    def now(self) -> AlgebraicNumber:
        """The time of the last event, or of the contact."""
        return self._kinetic.now

    def names(self) -> list[tuple[int, ...]]:
        """What may vanish now, as in `Moment`."""
        certifier, node = self._kinetic.certifier, self._node
        cause = certifier.now
        triples = [(cause.a, cause.b, cause.c), *certifier.roots_now]
        return [tuple([node[v] for v in t if v >= 0]) for t in triples if t[0] >= 0]

    def _moment(self) -> Moment:
        kinetic = self._kinetic
        mesh = kinetic.mesh_after()
        m, node = mesh.map, self._node
        rigid, body_of = self._nodes.rigid, self._nodes.body_of
        faces = []
        seen = [v == NOTHING for v in m.origin]
        for h in range(len(seen)):
            if seen[h]:
                continue
            cycle = m.face(h)
            for g in cycle:
                seen[g] = True
            region = mesh.region[h]
            around = [node[m.origin[g]] for g in cycle]
            if region in (SOLID, INSIDE) and (
                rigid[body_of[around[0]]] or self._is_thin(around[0])
            ):
                continue
            corners = [node[m.origin[g]] for g in cycle if mesh.corner[g]]
            label = {FREE: "face", OUTER: "outer"}.get(region, "inside")
            faces.append(Face(label, around, [] if region in (SOLID, OUTER) else corners))
        if not faces:
            faces.append(Face("outer", [0], []))  # of a single point
        if kinetic.vertices.changes != self._changes:
            self._changes = kinetic.vertices.changes
            self._flat.clear()
        return Moment(self.now, self.names(), contract(faces, self._is_flat, self._later))

    def _is_flat(self, *corners: int) -> bool:
        """Whether three vertices are on one line in the present pieces of their motions."""
        if corners not in self._flat:
            nodes, bodies = self._nodes, self._kinetic.vertices.bodies
            tracks = [nodes.track(v, bodies[nodes.body_of[v]].since) for v in corners]
            self._flat[corners] = not orientation(*tracks)
        return self._flat[corners]

    def _is_thin(self, v: int) -> bool:
        body = self._scene.bodies[self._nodes.body_of[v]]
        return body.size < 3 or not body.closed

    def _later(self) -> list[tuple[QQ, QQ]]:
        """The places of all vertices at a rational time before the next event."""
        now, following = self.now, self._kinetic.next_number()
        end = AlgebraicNumber(self._scene.end)
        if following is None or following.compare(end) > 0:
            following = end
        t = rational_between(now, following)
        return [self._nodes.track(v, t).at(t) for v in range(len(self._nodes.body_of))]
