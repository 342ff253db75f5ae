"""The proof of the first contact of a scene, generated while a tiling runs to it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from fractions import Fraction
from typing import TYPE_CHECKING, final

from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.motion.body import refuse_rounded
from exactpt.pairs.contact import Contact, contact_of
from exactpt.pairs.start import initial_touches
from exactpt.proof.degrees import refuse_degrees
from exactpt.proof.lines import Lines, header
from exactpt.proof.nodes import Nodes
from exactpt.proof.watch import Watch
from exactpt.scene.written import to_json
from exactpt.tiling.events import ContactFound
from exactpt.tiling.start import check_tiling, proved_until, start_tiling, tiling_for_contact

if TYPE_CHECKING:
    from exactpt.scene.scene import Scene
    from exactpt.tiling.tiling import Tiling

__all__ = ["ProofRun", "scene_bytes"]


def scene_bytes(scene: Scene) -> bytes:
    """The bytes that `Scene.save` writes: the file to which a proof of this scene refers."""
    return (json.dumps(to_json(scene), indent=1) + "\n").encode()


@final
class ProofRun:
    """A run to the first contact of a scene, which generates the proof line by line.

    Args:
        scene: the scene.
        tiling: the name of the tiling, as for `exactpt.first_contact`.
        scene_file: the bytes of the scene's file; by default those that `Scene.save` writes.
        exact_only: whether the float filters are switched off.
        max_events: the maximum number of events of the tiling; None for no limit.

    Attributes:
        tiling: the name of the tiling.
        nodes: the vertices of the scene.
        maker: what makes the lines.
        kinetic: the tiling; None before the run, or if there is no run.
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
        refuse_degrees(scene.bodies)
        check_tiling(tiling)
        self.tiling: str = tiling_for_contact(scene, tiling)
        self._options = exact_only, max_events
        self._file = scene_bytes(scene) if scene_file is None else scene_file
        self.nodes = Nodes(scene)
        self.maker = Lines(self.nodes)
        self.kinetic: Tiling | None = None
        self.contact: Contact | None = None
        self._begun = False

    def passed(self) -> Fraction | None:
        """See `Search.passed`."""
        if not self._begun:
            return None
        return proved_until(self.kinetic, self._scene._start)

    def lines(self) -> Iterator[str]:
        """The lines, without line ends."""
        scene = self._scene
        yield from header(self._file, scene._start, scene._end)
        touches, overlaps = initial_touches(scene)
        if overlaps:
            self.contact = contact_of(scene, AlgebraicNumber(scene._start), touches, overlaps)
            yield self.maker.contact_at_start(touches, overlaps)
        elif scene.bodies:
            yield from self._run()
        else:
            yield "none"

    def _run(self) -> Iterator[str]:
        scene, (exact_only, most), events = self._scene, self._options, 0
        self._begun = True
        kinetic = start_tiling(scene, self.tiling, scene._start, exact_only=exact_only)
        self.kinetic = kinetic
        watch = Watch(kinetic, self.nodes)
        yield from self.maker.faces(watch.first())
        try:
            while (happened := kinetic.advance(scene._end)) is not None:
                events += len(happened)
                if most is not None and events > most:
                    raise BudgetExceeded("the number of events is used up", self.passed())
                if kinetic.now.compare_rational(scene._end) < 0:
                    yield from self.maker.event(watch.step())
        except ContactFound as found:
            self.contact = contact_of(scene, kinetic.now, sorted(found.touches))
            yield from self.maker.contact(kinetic.now, watch.names(), found.touches)
        else:
            yield from self.maker.none(scene._end)
