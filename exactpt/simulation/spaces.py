"""The free space and the tiling at the current time of a run, or between it and the next event."""

from __future__ import annotations

from typing import TYPE_CHECKING, final

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, Rational, power_of_two, rational, shorten, show
from exactpt.pseudotriangulation.snapshot import placed_at, snapshot

if TYPE_CHECKING:
    from exactpt.certificates.queue import EventTime
    from exactpt.pair.contact import Contact
    from exactpt.pseudotriangulation.snapshot import Snapshot
    from exactpt.query.space import FreeSpace
    from exactpt.tiling.tiling import Tiling


@final
class SpaceCache:
    """The last requested free space, kept until time passes or bodies change.

    Either gives the tiling a new `EventTime` as its current time.
    """

    def __init__(self) -> None:
        self._now: EventTime | None = None
        self._space: FreeSpace | None = None

    def space(self, kinetic: Tiling, at: Rational | None) -> FreeSpace:
        """Return the free space at a time, see `Simulation.space`."""
        t = _now(kinetic) if at is None else _before_next_event(kinetic, rational(at))
        now = kinetic.certifier.now
        if self._space is None or self._now is not now or self._space.exact_at != t:
            from exactpt.query.space import FreeSpace

            self._now, self._space = now, FreeSpace(kinetic, t)
        return self._space

    @staticmethod
    def tiling_just_after(kinetic: Tiling) -> Snapshot:
        """Return the tiling just after the irrational time now, placed at that time.

        Until the next event the nodes, edges and faces are the same at all times: they are read at
        a rational one.
        """
        now, limit = kinetic.now, AlgebraicNumber(kinetic.certifier.end)
        following = kinetic.next_number()
        if following is not None and following < limit:
            limit = following
        later = _short_between(now, limit)
        tiling = snapshot(kinetic.vertices, kinetic.mesh_now(later), kinetic.name, later)
        return placed_at(tiling, now, kinetic.vertices)


def _short_between(now: AlgebraicNumber, limit: AlgebraicNumber) -> QQ:
    """Return the first multiple of 2^-k after a time, for the least k such that it is before."""
    bits = 0
    while True:
        scaled = now * power_of_two(bits)
        above = int(scaled) + (scaled.compare_rational(0) > 0)  # int rounds towards zero
        q = above * power_of_two(-bits)
        if limit.compare_rational(q) > 0:
            return q
        bits += 1


def _now(kinetic: Tiling) -> QQ:
    now = kinetic.now.simplified()
    if not now.is_rational:
        raise InputError(
            f"now, t = {float(now)!r}, is not rational: give a rational time after it and before "
            "the next event, simulation.space(at=...)"
        )
    return now.exact_low


def _before_next_event(kinetic: Tiling, t: QQ) -> QQ:
    following = kinetic.next_number()
    late = t > kinetic.certifier.end or (
        following is not None and following.compare_rational(t) <= 0
    )
    if late or kinetic.now.compare_rational(t) > 0:
        raise InputError(
            f"t = {show(t)} is not between now, t = {float(kinetic.now)!r}, and the next event"
        )
    return t


def why_no_tiling(contact: Contact) -> str:
    """Return the reason why a scene has no tiling at a contact, and a remedy."""
    time = f"t = {float(contact.time)!r}"
    if contact.kind != "initial":
        return f"the first contact is at {time}; there is one before it, where run(until=...) stops"
    pairs = [*contact.initial_pairs, *((pair.body, pair.other) for pair in contact.pairs)]
    one, other = map(shorten, pairs[0])
    which = f"body {one} touches itself" if one == other else f"bodies {one} and {other} touch"
    more = len({frozenset(pair) for pair in pairs}) - 1
    others = f" (and {counted(more, 'more pair')})" if more else ""
    return (
        f"{which} at the start, {time}{others}; move them apart, make one body of them "
        "(exactpt.union), or use first_contact(ignoring=...), which keeps no tiling"
    )
