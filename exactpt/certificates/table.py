"""The table of certificates: what is pending, what is violated, what is flat for ever."""

from __future__ import annotations

from typing import cast, final

from exactpt.certificates.certificate import ANGLE, KIND_COUNT, kind_of
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventQueue, EventTime, ExactQueue
from exactpt.indices import CertificateId, HalfEdge

__all__ = ["CertificateTable"]


@final
class CertificateTable:
    """The certificates of a structure at the current time.

    Attributes:
        pending: the times of failures, by certificate.
        violated: of each kind, the parts whose certificate is violated just after now.
        angles: of these, the half-edges whose angles are violated.
        flat: the half-edges whose angles are straight for ever.
    """

    def __init__(self, certifier: Certifier) -> None:
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

    def move(self, old: CertificateId, new: CertificateId) -> None:
        """Let a certificate have the time of another one, which is forgotten."""
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
