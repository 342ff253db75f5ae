"""Verification of a scene's run by independent means.

First a proof of the first contact (docs/proofs.md) is written, and verified by `cgal_check`.
Then CGAL verifies every tiling and every event time of a run, and a search over pairs of
features, without a tiling, must find the same contact.
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import final

from exactpt.brief import record_in_brief
from exactpt.cgal import BodyShape, CgalCheck, IsolatedRoot, ProofVerdict, check_proof
from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.budget import deadline_in
from exactpt.kernel.numbers import QQ
from exactpt.pair.comparison import contrast, in_words
from exactpt.proof.emit import ProofRun
from exactpt.pseudotriangulation.snapshot import snapshot
from exactpt.scene.scene import Scene
from exactpt.scene.written import scene_bytes
from exactpt.search.first import pair_search
from exactpt.tiling.driver import EVENTS, Driver, Observer
from exactpt.tiling.events import TilingEvent
from exactpt.tiling.start import plan_tiling
from exactpt.tiling.tiling import Tiling


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
        proof: whether `cgal_check` accepts the proof of it; None if there has been none.
        pairs_agree: whether the search over pairs finds the same contact; None if it has not
            been run.
        failures: one line for each failure.
    """

    tiling: str
    tilings: int = 0
    times: int = 0
    events: int = 0
    contact: dict[str, object] | None = None
    proof: bool | None = None
    pairs_agree: bool | None = None
    failures: list[str] = field(default_factory=list)

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def ok(self) -> bool:
        """True without failures."""
        return not self.failures

    def to_json(self) -> dict[str, object]:
        """Return the report as JSON data."""
        return {
            "ok": self.ok,
            "tiling": self.tiling,
            "tilings": self.tilings,
            "times": self.times,
            "events": self.events,
            "contact": self.contact,
            "proof": self.proof,
            "pairs_agree": self.pairs_agree,
            "failures": self.failures,
        }

    def lines(self) -> list[str]:
        """Return the report as lines of text."""
        by_cgal = len(self.failures) - (self.pairs_agree is False)
        head = f"CGAL {'DISAGREES' if by_cgal else 'agrees'}: "
        if self.proof is not None:
            head += f"the proof is {'accepted' if self.proof else 'REJECTED'}; "
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
    scene_file: bytes | None = None,
    max_events: int | None = None,
    max_seconds: float | None = None,
    reached: Callable[[AlgebraicNumber], None] | None = None,
) -> Report:
    """Prove the first contact of a scene, then check a run of it (`check_run`).

    Args:
        scene: the bodies, their motions and the time span.
        tiling: the name of the tiling, or "auto".
        scene_file: the bytes of the scene's file, of which the proof is made; by default those
            that `Scene.save` writes.
        max_events: maximum number of events; None for no limit.
        max_seconds: see `exactpt.Simulation`.
        reached: called with each event time after its verification.

    Raises:
        InputError: if the program cgal_check is missing.
        BudgetExceeded: if ``max_events`` or ``max_seconds`` is exceeded.
    """
    deadline = deadline_in(max_seconds)
    name = plan_tiling(scene, tiling, scene.exact_start).name
    file = scene_bytes(scene) if scene_file is None else scene_file
    proof = ProofRun(scene, tiling=name, scene_file=file, max_events=max_events)
    verdict = _verdict(proof, file, deadline)
    report = check_run(
        scene,
        tiling=name,
        max_events=max_events,
        max_seconds=_left(deadline),
        reached=reached,
    )
    report.proof = verdict.accepted
    if not verdict.accepted:
        report.failures.insert(0, f"proof {verdict.line}")
    return report


def check_run(
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

    Args and raises: as `check_scene`.
    """
    plan = plan_tiling(scene, tiling, scene.exact_start)
    report = Report(plan.name)
    deadline = deadline_in(max_seconds)
    with CgalCheck() as cgal:
        witness = _Witness(scene, cgal, report, max_events, deadline, reached)
        driver = Driver(scene, observers=[witness])
        contact = driver.start(plan)
        if contact is None:
            witness.tiling(driver.tiled.kinetic, scene.exact_start)
            contact = driver.run(scene.exact_end)
        if contact is not None:
            witness.time(contact.time)
    report.contact = None if contact is None else contact.time.to_json()
    expected = pair_search(scene, max_seconds=_left(deadline)).run_to_contact()
    difference = contrast(expected, contact)
    report.pairs_agree = difference is None
    if difference is not None:
        report.failures.append(
            f"first contact ({difference}): the tiling {in_words(contact)}, "
            f"but the search over pairs {in_words(expected)}"
        )
    return report


def _left(deadline: float | None) -> float | None:
    """Seconds until a deadline."""
    return None if deadline is None else max(0.0, deadline - clock.monotonic())


def _verdict(proof: ProofRun, scene_file: bytes, deadline: float | None) -> ProofVerdict:
    """Write a proof, and have it verified."""
    with TemporaryDirectory() as folder:
        scene_path, path = Path(folder) / "scene.json", Path(folder) / "proof"
        scene_path.write_bytes(scene_file)
        with path.open("w", encoding="utf-8") as file:
            for line in proof.lines():
                file.write(f"{line}\n")
                if deadline is not None and clock.monotonic() > deadline:
                    raise BudgetExceeded("limit of the check exceeded", proof.contact_free_until())
        return check_proof(scene_path, path, max_seconds=_left(deadline))


@final
class _Witness(Observer):
    """Has CGAL verify the tilings and event times of a run, and collects the verdicts."""

    listens_to: int = EVENTS

    def __init__(
        self,
        scene: Scene,
        cgal: CgalCheck,
        report: Report,
        max_events: int | None,
        deadline: float | None,
        progress: Callable[[AlgebraicNumber], None] | None,
    ) -> None:
        self._end = scene.exact_end
        self._report = report
        self._shapes = BodyShape.of_scene(scene)
        self._cgal = cgal
        self._bounds = max_events, deadline
        self._progress = progress
        self._before: IsolatedRoot | None = None

    def on_advance(self, scene: Scene, tiling: Tiling) -> None:  # noqa: ARG002 - as in `Observer`
        """Verify the tiling between now and the next event, unless they are simultaneous."""
        following = tiling.next_number()
        if following is not None and tiling.now.compare(following) < 0:
            self.tiling(tiling, rational_between(tiling.now, following))

    def on_events(self, tiling: Tiling, events: Sequence[TilingEvent]) -> None:
        """Verify an event time.

        Raises:
            BudgetExceeded: if the budget is used up.
        """
        self._report.events += len(events)
        self.time(tiling.now)
        if self._progress is not None:
            self._progress(tiling.now)
        most, deadline = self._bounds
        if (most is not None and self._report.events > most) or (
            deadline is not None and clock.monotonic() > deadline
        ):
            low = tiling.now.canonical_interval()[0]
            raise BudgetExceeded("limit of the check exceeded", low)

    def on_end(self, tiling: Tiling) -> None:
        """Verify the tiling at the end."""
        self.tiling(tiling, self._end)

    def tiling(self, kinetic: Tiling, at: QQ) -> None:
        """Verify the tiling at a rational time before the next event."""
        mesh = kinetic.mesh_now(at)
        tile = snapshot(kinetic.vertices, mesh, self._report.tiling, at).to_json()
        verdict = self._cgal.check_tiling(tile, self._shapes)
        self._report.tilings += 1
        if not verdict.ok:
            self._report.failures.append(f"tiling at t = {at}: {verdict.reason}")

    def time(self, time: AlgebraicNumber) -> None:
        """Verify an event time, and that it is not before the previous one."""
        number = time.simplified()
        root = IsolatedRoot(number.exact_polynomial, *number.exact_canonical_interval())
        verdict = self._cgal.check_root(*root)
        self._report.times += 1
        if not verdict.ok:
            self._report.failures.append(f"event time {time!r}: {verdict.reason}")
        elif self._before is not None and self._cgal.compare_roots(self._before, root) > 0:
            self._report.failures.append(f"event time {time!r} is before the one before it")
        self._before = root
