"""Films: a run as a list of steps, with the lifetimes of edges and tiles between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, final

from exactpt.collision.detector import first_contact
from exactpt.indices import VertexId
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.render.tracker import EdgeSpan, TileSpan, Tracker
from exactpt.simulation.simulation import Simulation

if TYPE_CHECKING:
    from collections.abc import Callable

    from exactpt.certificates.queue import EventTime
    from exactpt.kernel.numbers import QQ
    from exactpt.pairs.contact import Contact
    from exactpt.scene.scene import Scene
    from exactpt.simulation.event import Event

__all__ = ["Change", "Film", "Step", "film_of"]

Pairs: TypeAlias = "tuple[tuple[int, int], ...]"


class Change(NamedTuple):
    """An event: its kind, the edges of the tiling that were removed and added; or words for it."""

    kind: str
    removed: Pairs
    added: Pairs
    words: str = ""


class Step(NamedTuple):
    """The events at one time.

    Attributes:
        time: the exact time.
        changes: the events in order; the last one is of kind "contact" at the first contact.
        certificate: the vertices of the certificate that fails: three that become collinear, or
            two whose x-coordinates become equal; empty if only a motion changes.
    """

    time: AlgebraicNumber
    changes: list[Change]
    certificate: tuple[int, ...]


@final
@dataclass(frozen=True, slots=True)
class Film:
    """A recorded run. Vertices are numbered through all bodies, in the order of the scene.

    Attributes:
        scene: the scene.
        tiling: the name of the tiling; "no" of rounded bodies, which none holds.
        steps: the times with events; step i is ``steps[i - 1]``, step 0 is the start.
        edges: the edges of the tiling, each with its first and last step.
        tiles: the tiles, likewise.
        contact: the first contact, at the last step; None if there is none.
        spans: for each body the time span in which it is there; empty if that is always.
    """

    scene: Scene
    tiling: str
    steps: tuple[Step, ...]
    edges: tuple[EdgeSpan, ...]
    tiles: tuple[TileSpan, ...]
    contact: Contact | None
    spans: tuple[tuple[QQ, QQ], ...] = ()

    def is_there(self, body: int, t: QQ) -> bool:
        """Whether a body, by its index, is there at a time."""
        if not self.spans:
            return True
        since, until = self.spans[body]
        return since <= t and (t < until or until == self.scene._end)

    @property
    def end(self) -> AlgebraicNumber:
        """The last time of the run."""
        if self.contact is not None:
            return self.contact.time
        return AlgebraicNumber(self.scene._end)


def film_of(
    scene: Scene,
    *,
    tiling: str = "auto",
    max_events: int | None = None,
    max_seconds: float | None = None,
    reached: Callable[[AlgebraicNumber], None] | None = None,
) -> Film:
    """Run a scene and record what its animation needs.

    Args:
        scene: the bodies, their motions and the time span.
        tiling: the name of the tiling, or "auto".
        max_events: see `Simulation`.
        max_seconds: see `Simulation`.
        reached: called with the times that the run reaches.

    Raises:
        BudgetExceeded: if ``max_events`` or ``max_seconds`` is exceeded.
    """
    if scene.is_rounded:
        return _without_tiling(
            scene, "no", first_contact(scene, tiling=tiling, max_seconds=max_seconds)
        )
    simulation = Simulation(scene, tiling=tiling, max_events=max_events, max_seconds=max_seconds)
    kinetic = simulation.kinetic
    if kinetic is None:
        return _without_tiling(scene, simulation.name, simulation.contact)
    node = kinetic.vertices.nodes()
    node_of = {kinetic.vertices.name(VertexId(v)): n for v, n in enumerate(node)}
    tracker = Tracker(kinetic, node)
    taken: list[Step] = []
    latest: EventTime | None = None
    for event in simulation.run():
        now = kinetic.certifier.now
        change = _change(event, node_of)
        if now is latest:
            taken[-1].changes.append(change)
            continue
        latest = now
        if reached is not None:
            reached(event.time)
        certificate = tuple(node[v] for v in (now.a, now.b, now.c) if v >= 0)
        taken.append(Step(event.time, [change], certificate))
        if simulation.contact is None:
            tracker.update(len(taken))
    return Film(
        scene,
        simulation.name,
        tuple(taken),
        tuple(tracker.edges),
        tuple(tracker.tiles),
        simulation.contact,
    )


def _without_tiling(scene: Scene, name: str, contact: Contact | None) -> Film:
    """A film of bodies alone, up to the contact."""
    steps: tuple[Step, ...] = ()
    if contact is not None:
        steps = (Step(contact.time, [Change("contact", (), ())], ()),)
    return Film(scene, name, steps, (), (), contact)


def _change(event: Event, node_of: dict[str, int]) -> Change:
    removed, added = (
        tuple((node_of[u], node_of[v]) for u, v in pairs) for pairs in (event.removed, event.added)
    )
    return Change(event.kind, removed, added)
