"""Films: a run to its end or its first contact, as steps and what lives between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, final

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.render.run import Run
from exactpt.render.tracker import EdgeSpan, TileSpan, Tracker

if TYPE_CHECKING:
    from exactpt.collision.contact import Contact
    from exactpt.kinetic.queue import EventTime
    from exactpt.scene.scene import Scene
    from exactpt.tiling.events import TilingEvent

__all__ = ["Change", "Film", "Step", "film_of"]

Pairs: TypeAlias = "tuple[tuple[int, int], ...]"


class Change(NamedTuple):
    """One event: its kind, and the edges of the tiling that went and came."""

    kind: str
    removed: Pairs
    added: Pairs


class Step(NamedTuple):
    """The events of one time.

    Attributes:
        time: exactly when.
        changes: in order; one of kind "contact" at the first contact.
        certificate: the vertices whose certificate fails: three that become collinear, or
            two that come to lie above one another; none if a motion changes.
    """

    time: AlgebraicNumber
    changes: tuple[Change, ...]
    certificate: tuple[int, ...]


@final
@dataclass(frozen=True, slots=True)
class Film:
    """A run. Vertices are counted through all bodies, in the order of the scene.

    Attributes:
        scene: what moved.
        tiling: the name of the tiling.
        steps: the times at which something happened; counted from 1, 0 is the start.
        edges: of the tiling, each with its steps.
        tiles: likewise.
        contact: the first contact; the last step is its time.
    """

    scene: Scene
    tiling: str
    steps: tuple[Step, ...]
    edges: tuple[EdgeSpan, ...]
    tiles: tuple[TileSpan, ...]
    contact: Contact | None

    @property
    def end(self) -> AlgebraicNumber:
        """The last time."""
        if self.contact is not None:
            return self.contact.time
        return AlgebraicNumber(self.scene.end)


def film_of(
    scene: Scene,
    *,
    tiling: str = "auto",
    max_events: int | None = None,
    max_seconds: float | None = None,
) -> Film:
    """Run a scene, and keep what its animation needs.

    Raises:
        BudgetExceeded: if the bounds are reached.
    """
    run = Run(scene, tiling=tiling, max_events=max_events, max_seconds=max_seconds)
    contact_change = Change("contact", (), ())
    if run.kinetic is None or run.contact is not None:
        steps = (Step(run.now, (contact_change,), ()),)
        return Film(scene, run.name, steps, (), (), run.contact)
    vertices = run.kinetic.vertices
    first = [0]
    for body in scene.bodies:
        first.append(first[-1] + body.size)
    node = [first[v.body] + v.index for v in vertices.all]
    tracker = Tracker(run.kinetic, node)
    taken: list[Step] = []
    while (events := run.advance(scene.end)) is not None:
        if events:
            changes = tuple(_change(event, node) for event in events)
            taken.append(Step(run.now, changes, _certificate(events[0].time, node)))
            tracker.update(len(taken))
    if run.contact is not None:
        certificate = _certificate(run.kinetic.certifier.now, node)
        taken.append(Step(run.contact.time, (contact_change,), certificate))
    return Film(
        scene, run.name, tuple(taken), tuple(tracker.edges), tuple(tracker.tiles), run.contact
    )


def _change(event: TilingEvent, node: list[int]) -> Change:
    removed, added = (
        tuple((node[u], node[v]) for u, v in pairs) for pairs in (event.removed, event.added)
    )
    return Change(event.kind, removed, added)


def _certificate(time: EventTime, node: list[int]) -> tuple[int, ...]:
    return tuple(node[v] for v in (time.a, time.b, time.c) if v >= 0)
