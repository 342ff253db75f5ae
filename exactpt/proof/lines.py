"""The lines of a proof, made from the changes of a tiling."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, final

from exactpt.geometry.polygon import segments_meet
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.motion.inside import covers
from exactpt.proof.changes import Angle, Angles, DirectedEdge, change, followers
from exactpt.proof.times import time_text

if TYPE_CHECKING:
    from exactpt.kernel.numbers import QQ
    from exactpt.motion.track import Incidence
    from exactpt.proof.contraction import Cycle
    from exactpt.proof.nodes import Nodes
    from exactpt.proof.watch import Step


def header(scene_file: bytes, start: QQ, end: QQ) -> list[str]:
    """Return the lines at the beginning.

    Args:
        scene_file: the bytes of the scene's file.
        start: the start of the scene.
        end: its end, or an earlier time: that up to which there is a proof.
    """
    digest = hashlib.sha256(scene_file).hexdigest()
    return ["exactpt-proof 1", f"scene sha256 {digest}", f"span {start} {end}"]


@final
class Lines:
    """Makes the lines of a proof, all but the header.

    Args:
        nodes: the vertices of the scene.

    Attributes:
        after: of each half-edge of the map, the one that follows around its face.
    """

    def __init__(self, nodes: Nodes) -> None:
        self._nodes = nodes
        self._angles = Angles(nodes)
        self.after: dict[DirectedEdge, DirectedEdge] = {}

    def faces(self, faces: Iterable[Cycle]) -> Iterator[str]:
        """Yield the lines of the faces from the start on."""
        ordered = sorted(faces)
        links = followers(face.nodes for face in ordered)
        self.after = links | followers(self._nodes.solid_faces())
        for label, cycle in ordered:
            yield f"{label} {' '.join(map(str, cycle))}"
        self._angles.begin(_angles(links, {}), AlgebraicNumber(self._nodes.scene.exact_start))

    def contact(
        self, time: AlgebraicNumber, names: Sequence[tuple[int, ...]], touches: Iterable[Incidence]
    ) -> Iterator[str]:
        """Yield the last lines, if there is a contact.

        Args:
            time: the time of the contact.
            names: as in `Step`.
            touches: the incidences at that time.
        """
        yield from self.renewals(time)
        ordered = sorted(touches)
        when = time_text(time, [*names, *map(self._name, ordered)], self._nodes)
        yield f"contact {when} {self._touch(ordered[0])}"

    def contact_at_start(
        self, touches: Sequence[Incidence], initial_pairs: Sequence[tuple[int, int]]
    ) -> str:
        """Return the last line, if there is a contact at the start."""
        start = self._nodes.scene.exact_start
        what = self._touch(touches[0]) if touches else self._overlap(*initial_pairs[0])
        return f"contact {start} {start} {what}"

    def none(self, end: QQ) -> Iterator[str]:
        """Yield the last lines without a contact."""
        yield from self.renewals(AlgebraicNumber(end))
        yield "none"

    def event(self, step: Step) -> Iterator[str]:
        """Yield the line of an event, if it has items, after those of renewals before it."""
        yield from self.renewals(step.time)
        renewed = self._angles.vanishing(step.time)
        old, new = (followers(f.nodes for f in faces) for faces in (step.gone, step.come))
        items = change(self.after, old, new, self.is_body_edge)
        begun = _angles(new, old)
        changed = {(v, w) for _, v, w in begun}
        renewed = [
            angle for angle in renewed if angle[1:] in self.after and angle[1:] not in changed
        ]
        items += [f"= {v} {w}" for _, v, w in renewed]
        self._angles.end(old.keys() - new.keys())
        self._angles.begin([*begun, *renewed], step.time)
        if items:
            yield f"event {time_text(step.time, step.names, self._nodes)} {' '.join(items)}"

    def renewals(self, until: AlgebraicNumber) -> Iterator[str]:
        """Yield the lines of angles that vanish before a time, when the map does not change."""
        while (time := self._angles.next_time()) is not None and time.compare(until) < 0:
            angles = self._angles.vanishing(time)
            self._angles.begin(angles, time)
            items = " ".join(f"= {v} {w}" for _, v, w in angles)
            yield f"event {time_text(time, angles, self._nodes)} {items}"

    def is_body_edge(self, u: int, v: int) -> bool:
        """Return True if two vertices are the ends of an edge of a body."""
        i = self._nodes.body_of[u]
        if self._nodes.body_of[v] != i:
            return False
        body, first = self._nodes.scene.bodies[i], self._nodes.first[i]
        if body.has_rings:
            ends = u - first, v - first
            return body.end_of_edge(ends[0]) == ends[1] or body.end_of_edge(ends[1]) == ends[0]
        apart = abs(u - v)
        return apart == 1 or (body.closed and apart == body.size - 1)

    def _name(self, touch: Incidence) -> tuple[int, ...]:
        first = self._nodes.first
        v = first[touch.body] + touch.vertex
        if touch.edge < 0:
            return v, first[touch.other] + touch.other_vertex
        return v, *self._edge(touch.other, touch.edge)

    def _edge(self, i: int, edge: int) -> tuple[int, int]:
        first = self._nodes.first[i]
        return first + edge, first + self._nodes.scene.bodies[i].end_of_edge(edge)

    def _touch(self, touch: Incidence) -> str:
        v, *others = self._name(touch)
        return f"vertex {v} {'edge' if touch.edge >= 0 else 'vertex'} {' '.join(map(str, others))}"

    def _overlap(self, i: int, j: int) -> str:
        """Return a common point of two bodies at the start, if none is a vertex on a boundary."""
        bodies = [self._nodes.scene.bodies[k] for k in (i, j)]
        p, q = (body.exact_at(self._nodes.scene.exact_start) for body in bodies)
        of_p, of_q = (body.edges for body in bodies)
        for k, (a, b) in enumerate(of_p):
            for m, (c, d) in enumerate(of_q):
                if segments_meet(p[a], p[b], q[c], q[d]):
                    ends = (*self._edge(i, k), *self._edge(j, m))
                    return "edge {} {} edge {} {}".format(*ends)
        inside = (
            (other, ring.start, one)
            for one, other, points, of_other in ((i, j, p, q), (j, i, q, p))
            for ring in self._nodes.scene.bodies[other].rings
            if covers(self._nodes.scene.bodies[one], points, of_other[ring.start])
        )
        other, vertex, one = next(inside)
        return f"vertex {self._nodes.first[other] + vertex} inside {one}"


def _angles(
    links: dict[DirectedEdge, DirectedEdge], old: dict[DirectedEdge, DirectedEdge]
) -> list[Angle]:
    """Return the angles of new links that are not among the old ones."""
    return [(u, v, w) for (u, v), (_, w) in links.items() if old.get((u, v)) != (v, w)]
