"""A scene checked by independent witnesses.

CGAL verifies every tiling and event time. That these are right does not say that no contact
was missed between them; a search over pairs of features, without a tiling, verifies that.
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
    """What was checked, and what failed.

    Attributes:
        tiling: the name of the tiling.
        tilings: how many tilings CGAL has verified.
        times: how many event times.
        events: how many events there were.
        contact: the time of the first contact, as in docs/format.md, or None.
        pairs_agree: whether the search over pairs finds the same contact; None if it has
            not been asked.
        failures: a line each.
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
        """Whether nothing failed."""
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
        """The report for people."""
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
    """Simulate a scene, and have CGAL verify what the tiling was and when it changed.

    The tiling at the start, at a rational time between any two consecutive event times,
    and at the end; each event time is one real root of its polynomial in its interval, and
    later than the one before. Then the first contact is looked for once more, by a search
    over pairs of features.

    Args:
        scene: what moves.
        tiling: which tiling to keep.
        max_events: stop when there have been more events than these.
        max_seconds: see `exactpt.Simulation`.
        reached: is told of each event time when it has been checked.

    Raises:
        InputError: if the program cgal_check is missing.
        BudgetExceeded: if the bounds are reached.
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
    """Run to the first contact, with a witness to all tilings and times."""
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
    """CGAL, asked about the tilings and event times of a run, and the report of its answers."""

    def __init__(self, scene: Scene, cgal: CgalCheck, report: Report) -> None:
        self.scene = scene
        self.report = report
        self._shapes = BodyShape.of_scene(scene)
        self._cgal = cgal
        self._before: IsolatedRoot | None = None

    def between(self, kinetic: Tiling) -> None:
        """Verify the tiling between now and the next event, if there is time between."""
        following = kinetic.next_number()
        if following is not None and kinetic.now.compare(following) < 0:
            self.tiling(kinetic, rational_between(kinetic.now, following))

    def tiling(self, kinetic: Tiling, at: QQ) -> None:
        """Verify the tiling at a time at which it holds."""
        mesh = kinetic.mesh_now(at)
        tile = snapshot(kinetic.vertices, mesh, self.report.tiling, at).to_json()
        verdict = self._cgal.check_tiling(tile, self._shapes)
        self.report.tilings += 1
        if not verdict.ok:
            self.report.failures.append(f"tiling at t = {at}: {verdict.reason}")

    def time(self, time: AlgebraicNumber) -> None:
        """Verify an event time, and that it is not before the last one."""
        number = time.simplified()
        root = IsolatedRoot(number._polynomial, *number._canonical_interval())
        verdict = self._cgal.check_root(*root)
        self.report.times += 1
        if not verdict.ok:
            self.report.failures.append(f"event time {time!r}: {verdict.reason}")
        elif self._before is not None and self._cgal.compare_roots(self._before, root) > 0:
            self.report.failures.append(f"event time {time!r} is before the one before it")
        self._before = root
