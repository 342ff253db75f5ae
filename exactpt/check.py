"""Verification of a scene's run by independent means.

CGAL verifies every tiling and every event time. This does not prove that no contact was missed
in between; a search over pairs of features, without a tiling, verifies that.
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import final

from exactpt.cgal import BodyShape, CgalCheck, IsolatedRoot
from exactpt.collision.comparison import contrast, in_words
from exactpt.collision.contact import Contact, contact_of, time_to_json
from exactpt.collision.initial import initial_touches
from exactpt.collision.pairs import PairsSearch
from exactpt.collision.tilings import plan_tiling
from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.pseudotriangulation.snapshot import snapshot
from exactpt.scene.scene import Scene
from exactpt.tiling.events import ContactFound
from exactpt.tiling.tiling import Tiling

__all__ = ["Report", "check_scene"]


@final
@dataclass(slots=True)
class Report:
    """The extent of a check, and its failures.

    Attributes:
        tiling: the name of the tiling.
        tilings: number of tilings that CGAL has verified.
        times: number of event times that CGAL has verified.
        events: number of events.
        contact: the time of the first contact, as in docs/format.md, or None.
        pairs_agree: whether the search over pairs finds the same contact; None if it has not
            been run.
        failures: one line for each failure.
    """

    tiling: str
    tilings: int = 0
    times: int = 0
    events: int = 0
    contact: dict[str, object] | None = None
    pairs_agree: bool | None = None
    failures: list[str] = field(default_factory=list)

    @property
    def ok(self) -> bool:
        """Whether there are no failures."""
        return not self.failures

    def to_json(self) -> dict[str, object]:
        """The report as JSON data."""
        return {
            "ok": self.ok,
            "tiling": self.tiling,
            "tilings": self.tilings,
            "times": self.times,
            "events": self.events,
            "contact": self.contact,
            "pairs_agree": self.pairs_agree,
            "failures": self.failures,
        }

    def lines(self) -> list[str]:
        """The report as lines of text."""
        by_cgal = len(self.failures) - (self.pairs_agree is False)
        head = f"CGAL {'DISAGREES' if by_cgal else 'agrees'}: "
        head += f"{self.tilings} tilings ({self.tiling}), {self.times} event times"
        if not self.tilings:
            head += " (bodies touch at the start: there is nothing to tile)"
        if self.pairs_agree is not None:
            head += f"; a search over pairs {'agrees' if self.pairs_agree else 'DISAGREES'}"
        return [head, *(f"  {failure}" for failure in self.failures)]


def check_scene(
    scene: Scene,
    *,
    tiling: str = "auto",
    max_events: int | None = None,
    max_seconds: float | None = None,
    reached: Callable[[AlgebraicNumber], None] | None = None,
) -> Report:
    """Simulate a scene, and have CGAL verify its tilings and event times.

    Tilings are verified at the start, at a rational time between any two consecutive event
    times, and at the end. Each event time must be the only real root of its polynomial in its
    interval, and not earlier than the one before. Then a search over pairs of features must
    find the same first contact.

    Args:
        scene: the bodies, their motions and the time span.
        tiling: the name of the tiling, or "auto".
        max_events: maximum number of events; None for no limit.
        max_seconds: see `exactpt.Simulation`.
        reached: called with each event time after its verification.

    Raises:
        InputError: if the program cgal_check is missing.
        BudgetExceeded: if ``max_events`` or ``max_seconds`` is exceeded.
    """
    plan = plan_tiling(scene, tiling, scene._start)
    report = Report(plan.name)
    deadline = None if max_seconds is None else clock.monotonic() + max_seconds
    with CgalCheck() as cgal:
        witness = _Witness(scene, cgal, report)
        touches, overlaps = initial_touches(scene)
        contact: Contact | None
        if overlaps:
            contact = contact_of(scene, AlgebraicNumber(scene._start), touches, overlaps)
            witness.time(contact.time)
        else:
            contact = _watch(plan.start(scene._start), witness, max_events, deadline, reached)
    report.contact = None if contact is None else time_to_json(contact.time)
    remaining = None if deadline is None else max(0.0, deadline - clock.monotonic())
    expected = PairsSearch(scene, max_seconds=remaining).run_to_contact()
    difference = contrast(expected, contact)
    report.pairs_agree = difference is None
    if difference is not None:
        report.failures.append(
            f"first contact ({difference}): the tiling {in_words(contact)}, "
            f"but the search over pairs {in_words(expected)}"
        )
    return report


def _watch(
    kinetic: Tiling,
    witness: _Witness,
    max_events: int | None,
    deadline: float | None,
    reached: Callable[[AlgebraicNumber], None] | None,
) -> Contact | None:
    """Run to the first contact, and have all tilings and event times verified."""
    scene, report = witness.scene, witness.report
    try:
        witness.tiling(kinetic, scene._start)
        while True:
            witness.between(kinetic)
            events = kinetic.advance(scene._end)
            if events is None:
                break
            report.events += len(events)
            witness.time(kinetic.now)
            if reached is not None:
                reached(kinetic.now)
            if (max_events is not None and report.events > max_events) or (
                deadline is not None and clock.monotonic() > deadline
            ):
                low = kinetic.now.canonical_interval()[0]
                raise BudgetExceeded("the budget of the check is used up", low)
        witness.tiling(kinetic, scene._end)
    except ContactFound as found:
        witness.time(kinetic.now)
        return contact_of(scene, kinetic.now, found.touches)
    return None


@final
class _Witness:
    """Asks CGAL about the tilings and event times of a run, and collects the verdicts."""

    def __init__(self, scene: Scene, cgal: CgalCheck, report: Report) -> None:
        self.scene = scene
        self.report = report
        self._shapes = BodyShape.of_scene(scene)
        self._cgal = cgal
        self._before: IsolatedRoot | None = None

    def between(self, kinetic: Tiling) -> None:
        """Verify the tiling between now and the next event, unless they are simultaneous."""
        following = kinetic.next_number()
        if following is not None and kinetic.now.compare(following) < 0:
            self.tiling(kinetic, rational_between(kinetic.now, following))

    def tiling(self, kinetic: Tiling, at: QQ) -> None:
        """Verify the tiling at a rational time before the next event."""
        mesh = kinetic.mesh_now(at)
        tile = snapshot(kinetic.vertices, mesh, self.report.tiling, at).to_json()
        verdict = self._cgal.check_tiling(tile, self._shapes)
        self.report.tilings += 1
        if not verdict.ok:
            self.report.failures.append(f"tiling at t = {at}: {verdict.reason}")

    def time(self, time: AlgebraicNumber) -> None:
        """Verify an event time, and that it is not before the previous one."""
        number = time.simplified()
        root = IsolatedRoot(number._polynomial, *number._canonical_interval())
        verdict = self._cgal.check_root(*root)
        self.report.times += 1
        if not verdict.ok:
            self.report.failures.append(f"event time {time!r}: {verdict.reason}")
        elif self._before is not None and self._cgal.compare_roots(self._before, root) > 0:
            self.report.failures.append(f"event time {time!r} is before the one before it")
        self._before = root
