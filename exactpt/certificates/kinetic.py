"""An event queue of named certificates, for custom kinetic data structures.

The engine of the tilings has certificates of its own, in doubles with proved bounds. Here they
are polynomials, and their roots are exact from the beginning; only the order of the queue is
decided by doubles where these suffice.
"""

from __future__ import annotations

from collections.abc import Hashable
from typing import final

from mypy_extensions import i64

from exactpt.certificates.queue import EventQueue, EventTime
from exactpt.errors import InputError
from exactpt.filters.rounding import check_rounding
from exactpt.indices import CertificateId
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.counters import Counters
from exactpt.kernel.numbers import Rational, rational
from exactpt.kernel.polynomial import Polynomial


@final
class _Failures:
    """The exact times of failure by slot of the queue; the first number of an event is its slot."""

    def __init__(self) -> None:
        self.times: dict[i64, AlgebraicNumber] = {}

    def resolve(self, time: EventTime) -> AlgebraicNumber:
        """Return the exact time of an event."""
        time.exact = self.times[time.a]
        return time.exact


@final
class CertificateQueue:
    """Certificates f(t) >= 0, and the time up to which all of them hold.

    A certificate fails at the first time, from now on, just after which its polynomial is
    negative. A polynomial that only touches 0, or vanishes identically, does not fail.

    >>> from exactpt.kernel import Polynomial
    >>> t = Polynomial([0, 1])
    >>> queue = CertificateQueue(until=10)
    >>> queue.watch("below 2", 2 - t**2)
    >>> queue.watch("never below 3", (t - 3) ** 2)
    >>> queue.advance(), queue.now
    (['below 2'], <1.4142135623730951... (root of a polynomial of degree 2)>)
    >>> queue.advance(), queue.now
    ([], AlgebraicNumber('10'))

    Args:
        start: the first time, rational.
        until: the last time, rational, at least the first.

    Attributes:
        now: the current time.

    Raises:
        InputError: if the times are not rational, or the last is before the first.
    """

    def __init__(self, start: Rational = 0, until: Rational = 1) -> None:
        self.now: AlgebraicNumber = AlgebraicNumber(start)
        self._until = rational(until)
        if self.now.compare_rational(self._until) > 0:
            raise InputError(f"the end {until} is before the start {start}")
        self._failures = _Failures()
        self._events = EventQueue(self._failures, Counters())
        self._ids: dict[Hashable, CertificateId] = {}
        self._names: list[Hashable] = []

    def watch(self, name: Hashable, certificate: Polynomial) -> None:
        """Watch a certificate from now on, instead of the one of the same name, if any.

        Args:
            name: what `advance` returns; equal names are one.
            certificate: the polynomial that is to stay >= 0.

        Raises:
            RoundingError: see `check_rounding`.
        """
        check_rounding()
        if name not in self._ids:
            self._ids[name] = CertificateId(len(self._names))
            self._names.append(name)
        failure = self._failure(certificate)
        if failure is None:
            self.cancel(name)
            return
        slot = self._ids[name]
        self._failures.times[slot] = failure
        self._events.schedule(slot, EventTime(*failure.enclosure(), slot, 0, 0))

    def cancel(self, name: Hashable) -> None:
        """Stop watching a certificate; nothing happens if it is not watched."""
        if name in self._ids:
            self._events.cancel(self._ids[name])

    def advance(self) -> list[Hashable]:
        """Move to the next time at which certificates fail, or to the end.

        Returns:
            All names that fail at that time, in the order in which they were first given; they
            are not watched after that. An empty list at the end.

        Raises:
            RoundingError: see `check_rounding`.
        """
        check_rounding()
        group = self._events.pop()
        if group is None:
            self.now = AlgebraicNumber(self._until)
            return []
        first, failed = group
        self.now = self._failures.resolve(first)
        return [self._names[slot] for slot, _ in failed]

    def _failure(self, f: Polynomial) -> AlgebraicNumber | None:
        """Return the first time >= now, and before the end, just after which f is negative."""
        if f.sign_after(self.now) < 0:
            return self.now
        if f.degree < 1:
            return None
        for root in f.roots(after=self.now, until=self._until):
            if f.sign_after(root) < 0 and root < self._until:
                return root
        return None
