"""Films: a run as a list of steps, with the lifetimes of edges and tiles between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, final

from exactpt.errors import carrying
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import Budget, searching
from exactpt.render.tracker import EdgeSpan, TileSpan, Tracker
from exactpt.scene.groups import is_tileable
from exactpt.search.first import first_contact
from exactpt.tiling.driver import Driver
from exactpt.tiling.start import plan_tiling

if TYPE_CHECKING:
    from collections.abc import Callable

    from exactpt.kernel.numbers import QQ
    from exactpt.pair.contact import Contact
    from exactpt.scene.scene import Scene
    from exactpt.tiling.events import TilingEvent
    from exactpt.tiling.tiling import Tiling

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
        edges: the edges of the tiling and of its fan, each with its first and last step.
        tiles: the tiles, each with its first and last step.
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
        """Return True if a body, by its index, is there at a time."""
        if not self.spans:
            return True
        since, until = self.spans[body]
        return since <= t and (t < until or until == self.scene.exact_end)

    @property
    def end(self) -> AlgebraicNumber:
        """The last time of the run."""
        if self.contact is not None:
            return self.contact.time
        return AlgebraicNumber(self.scene.exact_end)


def film_of(
    scene: Scene,
    *,
    tiling: str | None = "auto",
    fan: bool = False,
    max_events: int | None = None,
    max_seconds: float | None = None,
    reached: Callable[[AlgebraicNumber], None] | None = None,
) -> Film:
    """Run a scene and record what its animation needs.

    Args:
        scene: the bodies, their motions and the time span.
        tiling: the name of the tiling, or "auto", which is none if no tiling can hold the bodies;
            None for bodies without a tiling.
        fan: whether the edges of the fan triangulation are recorded too.
        max_events: see `Simulation`.
        max_seconds: see `Simulation`.
        reached: called with the times that the run reaches.

    Raises:
        BudgetExceeded: if ``max_events`` or ``max_seconds`` is exceeded.
        InputError: if a fan is requested, and the bodies or the tiling have none.
    """
    has_tiling = tiling is not None and (tiling != "auto" or is_tileable(scene))
    if tiling is None or not (has_tiling or fan):  # a run refuses the bodies of a fan
        contact = first_contact(scene, tiling=tiling or "auto", max_seconds=max_seconds)
        return film_without_tiling(scene, "no", contact)
    budget = Budget(max_events, max_seconds)
    driver = Driver(scene, budget=budget)
    with carrying(lambda: scene), searching(None, driver.contact_free_until), budget.held():
        plan = plan_tiling(scene, tiling, scene.exact_start, fan=fan)
        contact = driver.start(plan)
        if contact is not None:
            return film_without_tiling(scene, plan.name, contact)
        node = driver.tiled.kinetic.vertices.nodes()
        tracker = Tracker(driver.tiled.kinetic, node)
        driver.observers.append(tracker)
        steps: list[Step] = []
        while (events := driver.advance(scene.exact_end)) is not None:
            if events:
                changes = [_change(event, node) for event in events]
                steps.append(_step(driver.tiled.kinetic, node, changes))
                tracker.update(len(steps))
                if reached is not None:
                    reached(steps[-1].time)
            driver.spend(len(events))
        if driver.touches is not None:
            contact = driver.meet()
            steps.append(_step(driver.tiled.kinetic, node, [Change("contact", (), ())]))
            if reached is not None:
                reached(contact.time)
    edges, tiles = tuple(tracker.edges), tuple(tracker.tiles)
    return Film(scene, plan.name, tuple(steps), edges, tiles, contact)


def film_without_tiling(
    scene: Scene, name: str, contact: Contact | None, spans: tuple[tuple[QQ, QQ], ...] = ()
) -> Film:
    """Return a film of bodies alone, up to the contact."""
    steps = () if contact is None else (Step(contact.time, [Change("contact", (), ())], ()),)
    return Film(scene, name, steps, (), (), contact, spans)


def _step(kinetic: Tiling, node: list[int], changes: list[Change]) -> Step:
    """Return the step of the event time that is now."""
    now = kinetic.certifier.now
    certificate = tuple(node[v] for v in (now.a, now.b, now.c) if v >= 0)
    return Step(kinetic.now, changes, certificate)


def _change(event: TilingEvent, node: list[int]) -> Change:
    removed, added = (
        tuple((node[u], node[v]) for u, v in edges) for edges in (event.removed, event.added)
    )
    return Change(event.kind, removed, added)
