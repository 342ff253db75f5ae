"""Films: a run to its end or its first contact, as steps and what lives between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, final

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.render.tracker import EdgeSpan, TileSpan, Tracker
from exactpt.simulation.simulation import Simulation

if TYPE_CHECKING:
    from collections.abc import Callable

    from exactpt.certificates.queue import EventTime
    from exactpt.collision.contact import Contact
    from exactpt.scene.scene import Scene
    from exactpt.simulation.event import Event

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
    changes: list[Change]
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
        return AlgebraicNumber(self.scene._end)


def film_of(
    scene: Scene,
    *,
    tiling: str = "auto",
    max_events: int | None = None,
    max_seconds: float | None = None,
    reached: Callable[[AlgebraicNumber], None] | None = None,
) -> Film:
    """Run a scene, and keep what its animation needs.

    Args:
        scene: what moves.
        tiling: which tiling to keep.
        max_events: see `Simulation`.
        max_seconds: see `Simulation`.
        reached: is told of the times that the run reaches.

    Raises:
        BudgetExceeded: if the bounds are reached.
    """
    simulation = Simulation(scene, tiling=tiling, max_events=max_events, max_seconds=max_seconds)
    kinetic = simulation.kinetic
    if kinetic is None:
        steps = (Step(simulation.now, [Change("contact", (), ())], ()),)
        return Film(scene, simulation.name, steps, (), (), simulation.contact)
    node = kinetic.vertices.nodes()
    node_of = {kinetic.vertices.name(v): n for v, n in enumerate(node)}
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


def _change(event: Event, node_of: dict[str, int]) -> Change:
    removed, added = (
        tuple((node_of[u], node_of[v]) for u, v in pairs) for pairs in (event.removed, event.added)
    )
    return Change(event.kind, removed, added)
