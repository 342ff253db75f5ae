"""The lines of a proof, generated while a tiling runs to the first contact."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, final

from exactpt.collision.contact import Contact, contact_of
from exactpt.collision.initial import initial_touches
from exactpt.collision.tilings import check_tiling, tiling_for_contact
from exactpt.geometry.polygon import contains, segments_meet
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.motion.body import refuse_rounded
from exactpt.proof.changes import Angle, Angles, DirectedEdge, change, followers
from exactpt.proof.nodes import Nodes
from exactpt.proof.run import Run, Step
from exactpt.proof.times import time_text
from exactpt.scene.format import to_json

if TYPE_CHECKING:
    from exactpt.kernel.numbers import QQ
    from exactpt.motion.incidence import Touch
    from exactpt.scene.scene import Scene
    from exactpt.tiling.tiling import Tiling

__all__ = ["Proof", "scene_bytes"]


def scene_bytes(scene: Scene) -> bytes:
    """The bytes that `Scene.save` writes: the file to which a proof of this scene refers."""
    return (json.dumps(to_json(scene), indent=1) + "\n").encode()


@final
class Proof:
    """The proof of the first contact of a scene, generated line by line.

    Args:
        scene: the scene.
        tiling: the name of the tiling, as for `exactpt.first_contact`.
        scene_file: the bytes of the scene's file; by default those that `Scene.save` writes.
        exact_only: whether the float filters are switched off.
        max_events: the maximum number of events of the tiling; None for no limit.

    Attributes:
        tiling: the name of the tiling.
        contact: the first contact, or None; known once all lines have been generated.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        tiling: str = "auto",
        scene_file: bytes | None = None,
        exact_only: bool = False,
        max_events: int | None = None,
    ) -> None:
        self._scene = scene
        refuse_rounded(scene.bodies)
        check_tiling(tiling)
        self.tiling: str = tiling_for_contact(scene, tiling)
        self._options = exact_only, max_events
        self._running: Run | None = None
        self._file = scene_bytes(scene) if scene_file is None else scene_file
        self._nodes = Nodes(scene)
        self._angles = Angles(self._nodes)
        self._after: dict[DirectedEdge, DirectedEdge] = {}
        self.contact: Contact | None = None

    @property
    def kinetic(self) -> Tiling | None:
        """The tiling; None before the run, or if there is no run."""
        return None if self._running is None else self._running.kinetic

    def reached(self) -> QQ:
        """A rational time before which there is provably no contact."""
        return self._scene.start if self._running is None else self._running.reached()

    def lines(self) -> Iterator[str]:
        """The lines, without line ends."""
        scene = self._scene
        yield "exactpt-proof 1"
        yield f"scene sha256 {hashlib.sha256(self._file).hexdigest()}"
        yield f"span {scene._start} {scene._end}"
        touches, overlaps = initial_touches(scene)
        if overlaps:
            start = AlgebraicNumber(scene._start)
            self.contact = contact_of(scene, start, touches, overlaps)
            what = self._touch(touches[0]) if touches else self._overlap(*overlaps[0])
            yield f"contact {scene._start} {scene._start} {what}"
        elif scene.bodies:
            yield from self._run()
        else:
            yield "none"

    def _run(self) -> Iterator[str]:
        exact_only, most = self._options
        run = Run(self._scene, self._nodes, self.tiling, exact_only=exact_only, max_events=most)
        self._running = run
        steps = run.steps()
        first = next(steps)
        faces = sorted(first.come)
        links = followers(face.nodes for face in faces)
        self._after = links | followers(self._nodes.solid_faces())
        for label, cycle in faces:
            yield f"{label} {' '.join(map(str, cycle))}"
        self._angles.begin(_angles(links, {}), first.time)
        for step in steps:
            yield from self._event(step)
        end = AlgebraicNumber(self._scene.end) if not run.touches else run.now
        yield from self._renewals(end)
        if run.touches:
            self.contact = contact_of(self._scene, run.now, run.touches)
            names = [*run.names(), *map(self._name, run.touches)]
            when = time_text(run.now, names, self._nodes)
            yield f"contact {when} {self._touch(run.touches[0])}"
        else:
            yield "none"

    def _event(self, step: Step) -> Iterator[str]:
        """The line of an event, if it has items, after those of renewals before it."""
        yield from self._renewals(step.time)
        renewed = self._angles.vanishing(step.time)
        old, new = (followers(f.nodes for f in faces) for faces in (step.gone, step.come))
        items = change(self._after, old, new, self._is_body_edge)
        begun = _angles(new, old)
        changed = {(v, w) for _, v, w in begun}
        renewed = [
            angle for angle in renewed if angle[1:] in self._after and angle[1:] not in changed
        ]
        items += [f"= {v} {w}" for _, v, w in renewed]
        self._angles.end(old.keys() - new.keys())
        self._angles.begin([*begun, *renewed], step.time)
        if items:
            yield f"event {time_text(step.time, step.names, self._nodes)} {' '.join(items)}"

    def _renewals(self, until: AlgebraicNumber) -> Iterator[str]:
        """The lines of angles that vanish before a time, when the map does not change."""
        while (time := self._angles.next_time()) is not None and time.compare(until) < 0:
            angles = self._angles.vanishing(time)
            self._angles.begin(angles, time)
            items = " ".join(f"= {v} {w}" for _, v, w in angles)
            yield f"event {time_text(time, angles, self._nodes)} {items}"

    def _is_body_edge(self, u: int, v: int) -> bool:
        i = self._nodes.body_of[u]
        if self._nodes.body_of[v] != i:
            return False
        body = self._scene.bodies[i]
        apart = abs(u - v)
        return apart == 1 or (body.closed and apart == body.size - 1)

    def _name(self, touch: Touch) -> tuple[int, ...]:
        first = self._nodes.first
        v = first[touch.body] + touch.vertex
        if touch.edge < 0:
            return v, first[touch.other] + touch.other_vertex
        return v, *self._edge(touch.other, touch.edge)

    def _edge(self, i: int, edge: int) -> tuple[int, int]:
        first, size = self._nodes.first[i], self._scene.bodies[i].size
        return first + edge, first + (edge + 1) % size

    def _touch(self, touch: Touch) -> str:
        v, *others = self._name(touch)
        return f"vertex {v} {'edge' if touch.edge >= 0 else 'vertex'} {' '.join(map(str, others))}"

    def _overlap(self, i: int, j: int) -> str:
        """A common point of two bodies at the start, if none is a vertex on a boundary."""
        bodies = [self._scene.bodies[k] for k in (i, j)]
        p, q = (body._at(self._scene.start) for body in bodies)
        of_p, of_q = (body.edges for body in bodies)
        for k, (a, b) in enumerate(of_p):
            for m, (c, d) in enumerate(of_q):
                if segments_meet(p[a], p[b], q[c], q[d]):
                    ends = (*self._edge(i, k), *self._edge(j, m))
                    return "edge {} {} edge {} {}".format(*ends)
        if bodies[0].has_interior and contains(p, q[0]):
            return f"vertex {self._nodes.first[j]} inside {i}"
        return f"vertex {self._nodes.first[i]} inside {j}"


def _angles(
    links: dict[DirectedEdge, DirectedEdge], old: dict[DirectedEdge, DirectedEdge]
) -> list[Angle]:
    """The angles of new links that are not among the old ones."""
    return [(u, v, w) for (u, v), (_, w) in links.items() if old.get((u, v)) != (v, w)]
