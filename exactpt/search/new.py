"""The first contact that is new: two bodies that touch at the start may come into a new contact.

They do when they touch after they have parted, or when they begin to overlap: just after a time
they do, just before it they did not (at the start of the time span: then they did not). Whether two
bodies intersect or overlap changes only at times of incidences (`exactpt.search.intervals`): a
rational time between any two consecutive ones decides for all times between.

All other pairs are searched as ever, by a sweep.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import chain
from typing import NamedTuple, TypeAlias, final

from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.budget import check_budget, searching
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.track import Incidence, renumbered
from exactpt.pair.contact import Contact, contact_of
from exactpt.pair.overlap import bodies_meet, overlap
from exactpt.pair.start import initial_touches, touches_at_distance
from exactpt.pair.straight import Earliest
from exactpt.scene.scene import Scene, scene_of
from exactpt.search.intervals import incidence_times
from exactpt.search.sweep_search import Sweep, stats_of

SweepBut: TypeAlias = "Callable[[Sequence[tuple[int, int]]], Sweep]"
"""Returns the sweep over all pairs of bodies that count, but for some."""


class Meeting(NamedTuple):
    """What comes into contact at a time.

    Attributes:
        touches: the incidences with which the contact begins.
        pair: the two bodies, if they touched before; else None.
    """

    touches: Iterable[Incidence]
    pair: tuple[int, int] | None = None


@final
class NewContactSearch:
    """A search for the first contact that is new.

    Args:
        scene: the bodies, their motions and the time span.
        sweep_but: returns the sweep over other pairs.
        deadline: the time on the clock after which the search ends; None for no limit.

    Attributes:
        name: the name of the tiling: None.
    """

    name = None

    def __init__(self, scene: Scene, sweep_but: SweepBut, deadline: float | None = None) -> None:
        self._scene = scene
        self._sweep_but = sweep_but
        self._deadline = deadline
        self._sweep = sweep_but([])

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the search so far, see docs/format.md."""
        return stats_of(self._scene, self._sweep)

    def contact_free_until(self) -> None:
        """No time is known: bodies that touch at the start are looked at last."""

    def run_to_contact(self) -> Contact | None:
        """Return the first contact that counts in the closed time span; None if there is none.

        Raises:
            BudgetExceeded: when the time limit is reached.
        """
        with searching(self._deadline, self.contact_free_until):
            try:
                return self._first_contact()
            except BudgetExceeded as spent:
                spent.reached = None  # bounds of one pair do not hold for all
                raise

    def _first_contact(self) -> Contact | None:
        scene = self._scene
        near = self._sweep.near_at_start()
        touching = initial_touches(scene, near)[1] if near else []
        if touching:
            self._sweep = self._sweep_but(touching)
        first: Earliest[Meeting] = Earliest()
        found = self._sweep.first_after_start()
        if found is not None:
            first.add(found.number, [Meeting(found.touches)])
        for pair in touching:
            check_budget()
            self._add_renewed(pair, first)
        if first.number is None:
            return None
        touches = chain.from_iterable(meeting.touches for meeting in first.found)
        is_at_start = first.number.compare_rational(scene.exact_start) == 0
        renewed = sorted(meeting.pair for meeting in first.found if meeting.pair is not None)
        return contact_of(scene, first.number, touches, renewed if is_at_start else [])

    def _add_renewed(self, pair: tuple[int, int], first: Earliest[Meeting]) -> None:
        """Add the first new contact of two bodies that touch at the start, unless it is too late.

        It is looked for beyond the first time so far: at that time they may begin to overlap.
        """
        scene = self._scene
        a, b = (scene.bodies[i] for i in pair)
        start = scene.exact_start
        if _move_together(a, b, start, scene.exact_end):
            return
        time = new_contact_time(a, b, start, scene.exact_end, first.number)
        if time is None:
            return
        part = scene_of((a, b), start, scene.exact_end)
        is_at_start = time.compare_rational(start) == 0
        touches = (
            initial_touches(part)[0] if is_at_start else touches_at_distance(part, [(0, 1)], time)
        )
        first.add(time, [Meeting(renumbered(touches, *pair), pair)])


def _move_together(a: Body, b: Body, start: QQ, end: QQ) -> bool:
    """Return True if two bodies certainly keep their places relative to each other."""
    pieces = a.exact_piece_after(start), b.exact_piece_after(start)
    if any(piece.until is not None and piece.until < end for piece in pieces):
        return False
    tracks = (*pieces[0].tracks, *pieces[1].tracks)
    motion = tracks[0].motion
    return motion is not None and all(track.motion == motion for track in tracks)


def new_contact_time(
    a: Body, b: Body, start: QQ, end: QQ, latest: AlgebraicNumber | None = None
) -> AlgebraicNumber | None:
    """Return the first time of a new contact of two bodies that touch at the start, or None.

    It is the start itself if the bodies only touch there and overlap just after it. Bodies that
    overlap at the start count again only when they have parted, or have only touched.

    Args:
        a: a body.
        b: another body.
        start: the start of the time span.
        end: its end.
        latest: a later contact does not matter.
    """
    last = AlgebraicNumber(start)
    overlaps = overlap(a, b, start)
    stop = AlgebraicNumber(end)
    for time in chain(incidence_times(a, b, start, end), (stop,)):
        if time.compare(last) <= 0:
            return None  # the end, once more
        if latest is not None and last.compare(latest) > 0:
            return None
        between = rational_between(last, time)
        if not bodies_meet(a, b, between):
            if time.compare(stop) < 0 or bodies_meet(a, b, end):
                return time
            return None
        if overlap(a, b, between) and not overlaps:
            return last
        overlaps = overlap(a, b, between)
        last = time
    return None
