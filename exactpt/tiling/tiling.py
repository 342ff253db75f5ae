"""What every kinetic tiling is: certificates, a queue of their failures, time that passes.

All that is above this room, simulations and saved ones, queries, pictures, the fuzzer, asks
a tiling by this interface.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventQueue, EventTime
from exactpt.certificates.table import CertificateTable
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from exactpt.motion.vertices import Vertices
from exactpt.tiling.catalogue import Entry
from exactpt.tiling.clock import Clock
from exactpt.tiling.events import Log, Stats, TilingEvent

if TYPE_CHECKING:
    from exactpt.certificates.at_time import PredicatesAt
    from exactpt.motion.body import Body
    from exactpt.pseudotriangulation.mesh import Mesh

__all__ = ["State", "Tiling"]

State: TypeAlias = "dict[str, Any]"
"""A JSON object; what is wrong with it shows where it is used."""


class Tiling(ABC):
    """A tiling of the free space that is kept up to date as time goes on.

    Attributes:
        entry: its line in the catalogue.
        vertices: the moving vertices.
        certifier: certificates and the current time.
        table: what is pending, violated and flat.
        clock: how time passes.
        log: what has happened.
    """

    def __init__(
        self, entry: Entry, vertices: Vertices, certifier: Certifier, stats: Stats
    ) -> None:
        self.entry: Entry = entry
        self.vertices: Vertices = vertices
        self.certifier: Certifier = certifier
        self.table: CertificateTable = CertificateTable(certifier)
        self.clock: Clock = Clock(certifier, self.table, vertices.frame)
        self.log: Log = Log(certifier, stats)

    @abstractmethod
    def begin(self, start: QQ) -> None:
        """Build the tiling just after a time at which the bodies are disjoint."""

    @abstractmethod
    def state(self) -> State:
        """The structure between two events, exactly, as JSON data."""

    @abstractmethod
    def resume(self, state: State) -> None:
        """Go on with a structure; what is pending is the caller's to schedule."""

    @abstractmethod
    def mesh_after(self) -> Mesh:
        """The tiling just after the current time."""

    @abstractmethod
    def mesh_now(self, time: QQ) -> Mesh:
        """The tiling at a rational time: the current one, or one before the next event."""

    @abstractmethod
    def mesh_at(self, instant: PredicatesAt) -> Mesh:
        """The tiling of an instant, built from nothing."""

    @abstractmethod
    def audit(self, mesh: Mesh, instant: PredicatesAt) -> None:
        """Check a mesh of this tiling at an instant.

        Raises:
            AuditError: if an angle is not as marked.
        """

    def audit_structure(self, instant: PredicatesAt) -> None:  # noqa: B027 - most have none
        """Compare what is kept besides the mesh with what is built at an instant.

        Raises:
            AuditError: if they differ.
        """

    @abstractmethod
    def change_plans(self, plans: Mapping[int, Body], t: QQ) -> list[TilingEvent] | None:
        """Let bodies go on by other plans; work for their certificates alone.

        Args:
            plans: by the number of the body, what it is from now on. Its positions now are
                those that it has.
            t: now.

        Returns:
            What changes at once; None if a tiling must be built anew, and nothing is changed.
        """

    @abstractmethod
    def add_body(self, body: Body, t: QQ) -> list[TilingEvent] | None:
        """Add a body as the last one; work for the faces that it meets.

        Returns:
            What changes at once; None if a tiling must be built anew, and nothing is changed.

        Raises:
            InputError: if it touches another one.
        """

    @abstractmethod
    def remove_body(self, i: int, t: QQ) -> list[TilingEvent] | None:
        """Remove a body; work for the faces that it touches. The last body gets its number.

        Returns:
            What changes at once; the ids of the body may stand in it. None if a tiling must
            be built anew, and nothing is changed.
        """

    @abstractmethod
    def _process(self, time: EventTime, entries: list[tuple[int, EventTime]]) -> None:
        """Let all events of one time happen."""

    @property
    def name(self) -> str:
        """Its name in the catalogue."""
        return self.entry.name

    @property
    def queue(self) -> EventQueue:
        """What fails when."""
        return self.table.pending

    @property
    def stats(self) -> Stats:
        """Counts of the run."""
        return self.log.stats

    @property
    def now(self) -> AlgebraicNumber:
        """The current time."""
        return self.certifier.exact_now

    def next_time(self) -> EventTime | None:
        """When the next certificates fail; the queue keeps them."""
        return self.clock.next_time()

    def next_number(self) -> AlgebraicNumber | None:
        """When the next certificates fail, exactly."""
        return self.clock.next_number()

    def run(self, until: QQ | None = None) -> Iterator[TilingEvent]:
        """Process all events up to and including a time (default: the end of the span).

        Raises:
            ContactFound: at the first contact.
        """
        end = self.certifier.end if until is None else min(until, self.certifier.end)
        while (events := self.advance(end)) is not None:
            yield from events

    def advance(self, until: QQ) -> list[TilingEvent] | None:
        """Process the events of the next time, if that is not after ``until``.

        Returns:
            The events (perhaps none that matter outside); None if there are no more, and
            then the current time is ``until``.

        Raises:
            ContactFound: if there is a contact at that time.
        """
        popped = self.clock.pop(until)
        if popped is None:
            self.clock.move_to(until)
            return None
        self._process(*popped)
        return self.log.take()

    def retreat(self, grid: QQ) -> QQ:
        """After `ContactFound`: go back to a rational time just before the contact.

        Args:
            grid: the time is the last multiple of it before the contact; or, if an event
                is in between, a dyadic rational after that.

        Returns:
            The time. The tiling is the one that leads up to the contact.
        """
        return self.clock.retreat(grid)

    def take_over_counts(self, other: Tiling) -> None:
        """Go on counting where another tiling of the same run has stopped."""
        other.stats.most = max(other.stats.most, self.stats.most)
        other.stats.flips += self.stats.flips
        self.log.stats = other.stats
        self.certifier.made += other.certifier.made
        self.certifier.skipped += other.certifier.skipped
        self.certifier.zeros += other.certifier.zeros
        self.vertices.counters.add(other.vertices.counters.now())

    def __reduce__(self) -> tuple[object, ...]:
        raise TypeError("the tiling of a run is copied and pickled with its simulation")
