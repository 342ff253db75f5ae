"""The proof of the first contact of a scene, generated while a tiling runs to it."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final, final

from exactpt.errors import InputError
from exactpt.files import open_regular, write_atomically, writing
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.budget import searching
from exactpt.proof.degrees import refuse_degrees
from exactpt.proof.lines import Lines, header
from exactpt.proof.nodes import Nodes
from exactpt.proof.watch import Step, Watch
from exactpt.scene.written import scene_bytes
from exactpt.tiling.driver import CHANGES, Observer
from exactpt.tiling.tiling_search import TilingSearch

if TYPE_CHECKING:
    from exactpt.indices import HalfEdge
    from exactpt.kernel.numbers import QQ
    from exactpt.motion.track import Incidence
    from exactpt.pair.contact import Contact
    from exactpt.scene.scene import Scene
    from exactpt.tiling.tiling import Tiling

HEADER: Final = 1000
"""Number of bytes of a proof or certificate in which the digest of its scene is."""


def beside(path: Path) -> Path:
    """Return the path of the scene of a proof or certificate."""
    return path.with_name(f"{path.name}.scene.json")


def may_write_beside(path: Path, scene: bytes) -> bool:
    """Return True if the scene of a proof or certificate is to be written beside it.

    False if it is there already.

    Args:
        path: the path of the proof or certificate.
        scene: the bytes of the scene's file.

    Raises:
        InputError: if another file is there, which is not the scene of an earlier proof at this
            path: nobody has named it to be replaced.
    """
    place = beside(path)
    if not os.path.lexists(place):
        return True
    with open_regular(place, writable=False) as file:
        known = file.read()
    if known == scene:
        return False
    digest = hashlib.sha256(known).hexdigest().encode()
    try:
        with open_regular(path, writable=False) as file:
            is_own = digest in file.read(HEADER)
    except InputError:
        is_own = False
    if not is_own:
        raise InputError(
            f"{place}: not the scene of {path.name}: move it away, or choose another name"
        )
    return True


def write_beside(path: Path, scene: bytes) -> None:
    """Write the scene of a proof or certificate beside it, see `may_write_beside`."""
    if may_write_beside(path, scene):
        write_atomically(beside(path), scene)


@final
class ProofRun(TilingSearch):
    """A search for the first contact by a tiling, which generates the proof of its result.

    Args:
        scene: the scene.
        path: the path of the proof, for `run_to_contact`.
        tiling: the name of the tiling, as for `exactpt.first_contact`.
        scene_file: the bytes of the scene's file; by default those that `Scene.save` writes, and
            `run_to_contact` writes the scene beside the proof, with ``.scene.json`` appended to
            its name.
        exact_only: whether the float filters are switched off.
        max_events: the maximum number of events of the tiling; None for no limit.

    Attributes:
        nodes: the vertices of the scene.
        maker: what makes the lines.
        contact: the first contact, or None; known once all lines have been generated.
    """

    def __init__(
        self,
        scene: Scene,
        path: Path | None = None,
        *,
        tiling: str = "auto",
        scene_file: bytes | None = None,
        exact_only: bool = False,
        max_events: int | None = None,
    ) -> None:
        super().__init__(scene, tiling, exact_only=exact_only, max_events=max_events)
        refuse_degrees(scene.bodies)
        self._path, self._beside = path, scene_file is None
        self._file = scene_bytes(scene) if scene_file is None else scene_file
        self.nodes = Nodes(scene)
        self.maker = Lines(self.nodes)
        self.contact: Contact | None = None

    def run_to_contact(self) -> Contact | None:
        """Write the proof, and return the first contact, or None.

        Raises:
            BudgetExceeded: if there are more than ``max_events`` events, or the time or memory of
                this thread is used up.
            InputError: if a file cannot be written.
        """
        path = self._path
        if path is None:
            raise InputError("path: a proof needs one")
        if self._beside:
            write_beside(path, self._file)
        with searching(None, self.contact_free_until), writing(path) as write:
            for line in self.lines():
                write(f"{line}\n")
        return self.contact

    def lines(self) -> Iterator[str]:
        """Yield the lines, without line ends."""
        scene, driver = self._scene, self.driver
        yield from header(self._file, scene.exact_start, scene.exact_end)
        if not scene.bodies:
            yield "none"
            return
        self.contact = driver.start(self.name, exact_only=self._exact_only)
        if self.contact is not None:
            yield self.maker.contact_at_start(driver.touches or (), driver.initial_pairs)
            return
        made: list[str] = []
        part = Part(driver.tiled.kinetic, self.nodes, self.maker, made.extend)
        driver.observers.append(part)
        while (events := driver.advance(scene.exact_end)) is not None:
            driver.spend(len(events))
            yield from made
            made.clear()
        if driver.touches is None:
            part.none(scene.exact_end)
        else:
            self.contact = driver.meet()
        yield from made


@final
class Part(Observer):
    """The lines of a proof from a time on, but the header.

    The last event is held back, since an event at the end has no line.

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
        self._last = AlgebraicNumber(nodes.scene.exact_start)
        self._put(self._maker.faces(self.watch.first()))

    def on_changed_edges(self, changed: set[HalfEdge] | None) -> None:
        """See `Observer.on_changed_edges`."""
        if self._held is None or self._held.time.compare(self.watch.now) < 0:
            self._release()
            self._held = self.watch.step(changed)

    def on_contact(self, tiling: Tiling, touches: Sequence[Incidence]) -> None:
        """See `Observer.on_contact`."""
        self._release()
        self._put(self._maker.contact(tiling.now, self.watch.names(), touches))

    def none(self, end: QQ) -> None:
        """Put the last lines, without a contact up to a time."""
        if self._held is not None and self._held.time.compare_rational(end) < 0:
            self._release()
        self._put(self._maker.none(end))

    def before_now(self) -> QQ:
        """Now, if it is rational; else a time between the last two events."""
        now = self.watch.now.simplified()
        return now.exact_low if now.is_rational else rational_between(self._last, now)

    def _release(self) -> None:
        """Put the lines of the event that is held back."""
        if self._held is not None:
            self._last = self._held.time
            self._put(self._maker.event(self._held))
            self._held = None
