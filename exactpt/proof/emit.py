"""The proof of the first contact of a scene, generated while a tiling runs to it."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, final

from exactpt.collision.driver import CHANGES, Driver, Observer
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.budget import Budget
from exactpt.motion.body import refuse_rounded
from exactpt.proof.degrees import refuse_degrees
from exactpt.proof.lines import Lines, header
from exactpt.proof.nodes import Nodes
from exactpt.proof.watch import Step, Watch
from exactpt.scene.written import to_json
from exactpt.tiling.start import check_tiling, tiling_for_contact

if TYPE_CHECKING:
    from exactpt.indices import HalfEdge
    from exactpt.kernel.numbers import QQ
    from exactpt.motion.incidence import Touch
    from exactpt.pairs.contact import Contact
    from exactpt.scene.scene import Scene
    from exactpt.tiling.tiling import Tiling

__all__ = ["Part", "ProofRun", "scene_bytes"]


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
        driver: drives the tiling.
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
        self._exact_only = exact_only
        self._file = scene_bytes(scene) if scene_file is None else scene_file
        self.nodes = Nodes(scene)
        self.maker = Lines(self.nodes)
        self.driver = Driver(lambda: scene, budget=Budget(max_events, None))
        self.contact: Contact | None = None

    def lines(self) -> Iterator[str]:
        """The lines, without line ends."""
        scene, driver = self._scene, self.driver
        yield from header(self._file, scene._start, scene._end)
        if not scene.bodies:
            yield "none"
            return
        self.contact = driver.start(self.tiling, exact_only=self._exact_only)
        if self.contact is not None:
            yield self.maker.contact_at_start(driver.touches or (), driver.overlaps)
            return
        made: list[str] = []
        part = Part(driver.kinetic, self.nodes, self.maker, made.extend)
        driver.observers.append(part)
        while (events := driver.advance(scene._end)) is not None:
            driver.spend(len(events))
            yield from made
            made.clear()
        if driver.touches is None:
            part.none(scene._end)
        else:
            self.contact = driver.meet()
        yield from made


@final
class Part(Observer):
    """The lines of a proof from a time on, but the header.

    The last event is held back, since there is no line for one at the end.

    Args:
        kinetic: the tiling, between two events.
        nodes: the vertices of its bodies, in a scene that starts now.
        maker: makes the lines.
        put: what takes the lines, without line ends.

    Attributes:
        watch: the tiling.
    """

    listens_to: int = CHANGES

    def __init__(
        self, kinetic: Tiling, nodes: Nodes, maker: Lines, put: Callable[[Iterable[str]], None]
    ) -> None:
        self.watch = Watch(kinetic, nodes)
        self._maker, self._put = maker, put
        self._held: Step | None = None
        self._last = AlgebraicNumber(nodes.scene._start)
        self._put(self._maker.faces(self.watch.first()))

    def changed(self, changed: set[HalfEdge] | None) -> None:
        """See `Observer.changed`."""
        if self._held is None or self._held.time.compare(self.watch.now) < 0:
            self._release()
            self._held = self.watch.step(changed)

    def met(self, tiling: Tiling, touches: Sequence[Touch]) -> None:
        """See `Observer.met`."""
        self._release()
        self._put(self._maker.contact(tiling.now, self.watch.names(), touches))

    def none(self, end: QQ) -> None:
        """Put the last lines, if there is no contact up to a time."""
        if self._held is not None and self._held.time.compare_rational(end) < 0:
            self._release()
        self._put(self._maker.none(end))

    def before_now(self) -> QQ:
        """Now, if it is rational; else a time between the last two events."""
        now = self.watch.now.simplified()
        return now._low if now.is_rational else rational_between(self._last, now)

    def _release(self) -> None:
        """Put the lines of the event that is held back."""
        if self._held is not None:
            self._last = self._held.time
            self._put(self._maker.event(self._held))
            self._held = None
