"""The interface of kinetic tilings: certificates, a queue of their failures, a clock.

Simulations, queries, pictures and the fuzzer use a tiling only through this interface.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventQueue, EventTime
from exactpt.certificates.table import CertificateTable
from exactpt.indices import CertificateId, HalfEdge
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ
from exactpt.kernel.stored import Stored
from exactpt.motion.vertices import Vertices
from exactpt.tiling.catalogue import Entry
from exactpt.tiling.clock import Clock
from exactpt.tiling.events import Log, Stats, TilingEvent

if TYPE_CHECKING:
    from exactpt.certificates.at_time import PredicatesAt
    from exactpt.motion.body import Body
    from exactpt.pseudotriangulation.mesh import Mesh
    from exactpt.tiling.incremental.fan import Fan

FEW: Final = 16
"""Number of event times from one look at the budget to the next."""

State: TypeAlias = "dict[str, Any]"
"""A JSON object that is written; one that is read is `Stored`."""


class Tiling(ABC):
    """A tiling of the free space, maintained over time.

    Attributes:
        entry: its line in the catalogue.
        vertices: the moving vertices.
        certifier: certificates and the current time.
        table: the pending and the violated certificates, and the flat angles.
        clock: advances the current time.
        log: the record of events.
        contact_free_until: the last time up to which it has been advanced without a contact;
            None before.
        fan: the fan triangulation; None if it is not maintained.
    """

    def __init__(
        self, entry: Entry, vertices: Vertices, certifier: Certifier, stats: Stats
    ) -> None:
        self.entry: Entry = entry
        self.vertices: Vertices = vertices
        self.certifier: Certifier = certifier
        self.table: CertificateTable = CertificateTable(certifier)
        self.clock: Clock = Clock(certifier, self.table, vertices.normalization)
        self.log: Log = Log(certifier, stats)
        self.contact_free_until: EventTime | None = None
        self.fan: Fan | None = None

    @abstractmethod
    def begin(self, start: QQ) -> None:
        """Build the tiling just after a time at which the bodies are disjoint."""

    @abstractmethod
    def state(self) -> State:
        """Return the tiling between two events, exactly, as a JSON object."""

    @abstractmethod
    def resume(self, state: Stored) -> None:
        """Restore a saved tiling; the caller schedules its certificates.

        Raises:
            AuditError: if values contradict each other.
            InputError: if a value is not what `state` returns.
        """

    @abstractmethod
    def has_part(self, certificate: CertificateId) -> bool:
        """Return True if the part that a certificate is about exists."""

    @abstractmethod
    def mesh_after(self) -> Mesh:
        """Return the tiling just after the current time."""

    def changes(self) -> set[HalfEdge] | None:
        """Return the half-edges that may have another origin or successor since the last call.

        Returns:
            Half-edges of `mesh_after`; None if it is another mesh, and at the first call.
        """
        return self.mesh_after().map.take_changes()

    @abstractmethod
    def mesh_now(self, time: QQ) -> Mesh:
        """Return the tiling at a rational time: the current one, or one before the next event."""

    @abstractmethod
    def mesh_at(self, instant: PredicatesAt) -> Mesh:
        """Return the tiling of an instant, built from scratch."""

    @abstractmethod
    def audit(self, mesh: Mesh, instant: PredicatesAt) -> None:
        """Check a mesh of this tiling at an instant.

        Raises:
            AuditError: if an angle is not as marked.
        """

    def audit_structure(self, instant: PredicatesAt) -> None:  # noqa: B027 - most have none
        """Compare the data besides the mesh with those built from scratch at an instant.

        Raises:
            AuditError: if they differ.
        """

    @abstractmethod
    def change_motions(self, bodies: Mapping[int, Body], t: QQ) -> list[TilingEvent] | None:
        """Give bodies new motions, in time proportional to the number of their certificates.

        Args:
            bodies: for the number of each such body, the body from now on; its current positions
                must be the same.
            t: the current time.

        Returns:
            The events now; None if this tiling cannot be changed and must be rebuilt.
        """

    @abstractmethod
    def add_body(self, body: Body, t: QQ) -> list[TilingEvent] | None:
        """Add a body as the last one, changing only the faces that it intersects.

        Returns:
            The events now; None if this tiling cannot be changed and must be rebuilt.

        Raises:
            InputError: if it touches another body.
        """

    @abstractmethod
    def remove_body(self, i: int, t: QQ) -> list[TilingEvent] | None:
        """Remove a body, changing only the faces at its vertices; the last body gets its number.

        Returns:
            The events now, in which ids of the removed body may occur; None if this tiling
            cannot be changed and must be rebuilt.
        """

    @abstractmethod
    def _process(self, time: EventTime, entries: list[tuple[CertificateId, EventTime]]) -> None:
        """Process all events of one time."""

    @property
    def name(self) -> str:
        """Its name in the catalogue."""
        return self.entry.name

    @property
    def queue(self) -> EventQueue:
        """The queue of failures."""
        return self.table.pending

    @property
    def stats(self) -> Stats:
        """Counts of the run."""
        return self.log.stats

    @property
    def now(self) -> AlgebraicNumber:
        """The current time."""
        return self.certifier.exact_now

    def is_after(self, t: QQ) -> bool:
        """Return True if now is after a rational time."""
        return self.clock.is_after(t)

    def next_number(self) -> AlgebraicNumber | None:
        """Return the exact time of the next failure; None if there is none."""
        return self.clock.next_number()

    def advance(self, until: QQ) -> list[TilingEvent] | None:
        """Process the events of the next event time, if it is not after ``until``.

        Returns:
            The events (none if all are internal); None if no event time was left, and the
            current time is now ``until``.

        Raises:
            ContactFound: if there is a contact at that time.
        """
        check_budget()
        return self.log.take() if self._step(until) else None

    def advance_many(self, until: QQ, most: int) -> int:
        """Process the events of up to ``most`` event times; they are counted, not reported.

        Returns:
            The number of event times; 0 if none was left, and the current time is now ``until``.

        Raises:
            ContactFound: if there is a contact; the events before it have been processed.
        """
        done = 0
        self.log.is_recording = False
        try:
            while done < most:
                if done % FEW == 0:
                    check_budget()
                if not self._step(until):
                    break
                done += 1
        finally:
            self.log.is_recording = True
        return done

    def _step(self, until: QQ) -> bool:
        """Process the events of the next event time; if there are none, move to ``until``.

        Returns:
            Whether there was an event time up to ``until``.
        """
        popped = self.clock.pop(until)
        if popped is None:
            self.clock.move_to(until)
        else:
            time, entries = popped
            self._process(time, entries)
        self.contact_free_until = self.certifier.now
        return popped is not None

    def retreat(self, grid: QQ) -> QQ:
        """After `ContactFound`: return to a rational time just before the contact.

        Args:
            grid: the time is the last multiple of it before the contact; or, if there is an
                event in between, a dyadic rational after that event.

        Returns:
            The time. The tiling is the one just before the contact.
        """
        return self.clock.retreat(grid)

    def take_over_counts(self, other: Tiling) -> None:
        """Continue the counts of another tiling of the same run."""
        other.stats.most = max(other.stats.most, self.stats.most)
        other.stats.flips += self.stats.flips
        self.log.stats = other.stats
        self.certifier.made += other.certifier.made
        self.certifier.skipped += other.certifier.skipped
        self.certifier.zeros += other.certifier.zeros
        self.vertices.counters.add(other.vertices.counters.now())
        if self.fan is not None and other.fan is not None:
            self.fan.changes += other.fan.changes

    def __reduce__(self) -> tuple[object, ...]:
        raise TypeError("the tiling of a run is copied and pickled with its simulation")
