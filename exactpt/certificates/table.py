"""The table of certificates: pending, violated, and permanently flat ones."""

from __future__ import annotations

from typing import cast, final

from exactpt.certificates.certificate import ANGLE, KIND_COUNT, kind_of
from exactpt.certificates.certifier import X_ORDER, Certifier, least_first
from exactpt.certificates.queue import EventQueue, EventTime, ExactQueue
from exactpt.filters.rounding import INFINITY
from exactpt.indices import CertificateId, HalfEdge, VertexId


@final
class CertificateTable:
    """The certificates of a structure at the current time.

    Attributes:
        pending: the times of failures, by certificate.
        violated: of each kind, the parts whose certificate is violated just after now.
        angles: of these, the half-edges whose angles are violated.
        flat: the half-edges whose angles are straight for all times.
    """

    def __init__(self, certifier: Certifier) -> None:
        self._certifier = certifier
        counters = certifier.counters
        self.pending: EventQueue = (
            ExactQueue(certifier, counters)
            if certifier.exact_only
            else EventQueue(certifier, counters)
        )
        self.violated: list[set[int]] = [set() for _ in range(KIND_COUNT)]
        self.angles: set[HalfEdge] = cast("set[HalfEdge]", self.violated[ANGLE])
        self.flat: set[HalfEdge] = set()

    def schedule(self, certificate: CertificateId, time: EventTime | None) -> None:
        """Let a certificate fail at a time, or never."""
        if time is None:
            self.pending.cancel(certificate)
        else:
            self.pending.schedule(certificate, time)

    def watch_orientation(
        self, certificate: CertificateId, a: VertexId, b: VertexId, c: VertexId
    ) -> tuple[int, bool]:
        """Let a certificate fail at the next zero of an orientation.

        Returns:
            The sign just after now, 0 if it is identically zero (`Certifier.orientation`); and
            whether it vanishes now.
        """
        certifier, vanishes = self._certifier, False
        a, b, c = least_first(a, b, c)
        s, low, high = certifier.filtered_orientation(a, b, c)
        if s == 0:
            s, time, vanishes = certifier.exact_orientation(a, b, c)
            self.schedule(certificate, time)
        elif low == INFINITY:
            self.pending.cancel(certificate)
        else:
            self.pending.schedule_crossing(certificate, low, high, a, b, c)
        return s, vanishes

    def watch_x_order(
        self, certificate: CertificateId, a: VertexId, b: VertexId, *, touching: bool = False
    ) -> int:
        """Let a certificate fail when an x-order ends; return its sign (`Certifier.x_order`)."""
        s, low, high = self._certifier.filtered_x_order(a, b)
        if s == 0:
            s, time = self._certifier.exact_x_order(a, b, touching=touching)
            self.schedule(certificate, time)
        elif low == INFINITY:
            self.pending.cancel(certificate)
        else:
            self.pending.schedule_crossing(certificate, low, high, a, b, X_ORDER)
        return s

    def move(self, old: CertificateId, new: CertificateId) -> None:
        """Let a certificate have the time of a second one, which is removed."""
        time = self.pending.pending(old)
        self.pending.cancel(old)
        self.pending.cancel(new)
        if time is not None and old != new:
            self.pending.schedule(new, time)

    def keep_only(self, kinds: tuple[int, ...]) -> None:
        """Forget all certificates but those of some kinds."""
        self.flat.clear()
        for certificate in self.pending.slots():
            if kind_of(certificate) not in kinds:
                self.pending.cancel(certificate)
