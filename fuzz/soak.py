"""A soak: one simulation that goes on for a long time while all kinds of things happen to it.

Bodies bounce in a box; motions are replaced, bodies come and go, and the run is copied, saved
and restored at random times. A copy must go on as the original, a restored run must have the
state that was saved, the tiling must equal the one built from nothing, and a proof of what
comes next must be accepted. Memory, digits and speed must stay as they are.
"""

from __future__ import annotations

import json
import time as clock
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from statistics import median
from tempfile import TemporaryDirectory
from typing import Final, NamedTuple

from exactpt import proof_check, proof_scene
from exactpt.errors import AuditError, InputError
from exactpt.kernel import budget
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.pair.contact import Contact
from exactpt.pair.start import initial_touches
from exactpt.proof.written import write_proof
from exactpt.scene.scene import Scene
from exactpt.scene.written import to_json
from exactpt.simulation.motion_changes import onward
from exactpt.simulation.responses import Bounce
from exactpt.simulation.simulation import Simulation
from exactpt.testing import audit

__all__ = ["Sample", "Soak", "table", "verdict"]

SIDE: Final = 100
"""Side of the box."""

WALLS: Final = ("south", "east", "north", "west")
END: Final = 10**6
"""Last time of the scene, which is not reached."""

FEWEST, MOST = 8, 24
"""Range of the number of bodies in the box."""

STEP: Final = QQ(1, 64)
"""All changes happen at multiples of this time."""

GROWTH: Final = 1.25
"""Maximum ratio of the memory, digits and milliseconds of the last third to the second third."""

MARGIN: Final = 16.0
"""Growth, in megabytes or bits, that is not counted as such."""


class Sample(NamedTuple):
    """A measurement, from time to time.

    Attributes:
        seconds: elapsed time.
        time: time of the simulation.
        events, contacts: numbers since the last sample.
        memory: of the process, in megabytes.
        digits: largest number of bits of a coordinate.
        ms: milliseconds of processor time per event since the last sample.
    """

    seconds: float
    time: float
    events: int
    contacts: int
    memory: float
    digits: int
    ms: float


@dataclass(slots=True)
class Soak:
    """A running soak.

    Attributes:
        seed: seed of everything that happens.
        tiling: name of the tiling.
        did: number of actions of each kind.
        samples: the measurements.
    """

    seed: int
    tiling: str
    did: Counter[str] = field(default_factory=Counter)
    samples: list[Sample] = field(default_factory=list)
    events: int = 0
    made: int = 0
    rng: Random = field(init=False)
    simulation: Simulation = field(init=False)
    respond: Bounce = field(init=False)

    def __post_init__(self) -> None:
        self.rng = Random(f"soak {self.seed}")
        self._begin_anew()

    def _begin_anew(self) -> None:
        low, high = -5, SIDE + 5
        walls = [(low, low, high, 0), (SIDE, 1, high, SIDE - 1), (low, SIDE, high, high),
                 (low, 1, 0, SIDE - 1)]  # fmt: skip
        bodies = [
            Body(name, [(a, b), (c, b), (c, d), (a, d)])
            for name, (a, b, c, d) in zip(WALLS, walls, strict=True)
        ]
        self.simulation = Simulation(Scene(bodies, (0, END)), tiling=self.tiling)
        self.respond = Bounce(WALLS, fastest=16)
        while len(self.simulation.scene.bodies) < FEWEST + len(WALLS):
            self.come()

    def run(self, seconds: float, report: Callable[[Sample], None]) -> None:
        """Act at random for some time, and take about thirty samples.

        Raises:
            AuditError: if anything is not as it should be.
        """
        began, used = clock.monotonic(), clock.process_time()
        last_events = last_contacts = 0
        chosen = self._actions()
        while (elapsed := clock.monotonic() - began) < seconds:
            action = self.rng.choices(*chosen)[0]
            self.did[action.__name__] += 1
            action()
            if elapsed >= seconds * len(self.samples) / 30:
                events, contacts = self.events - last_events, self.did["contact"] - last_contacts
                now = clock.process_time()
                sample = self._sample(elapsed, events, contacts, now - used)
                self.samples.append(sample)
                report(sample)
                last_events, last_contacts, used = self.events, self.did["contact"], now

    def act(self, count: int) -> None:
        """Do some actions at random.

        Raises:
            AuditError: if anything is not as it should be.
        """
        chosen = self._actions()
        for action in self.rng.choices(*chosen, k=count):
            action()

    def _actions(self) -> tuple[list[Callable[[], None]], list[int]]:
        weights: dict[Callable[[], None], int] = {
            self.go_on: 40, self.plan: 10, self.come: 6, self.go: 6, self.copy: 4,
            self.save: 4, self.audit: 4, self.prove: 2,
        }  # fmt: skip
        return list(weights), list(weights.values())

    def _sample(self, elapsed: float, events: int, contacts: int, used: float) -> Sample:
        now = self.simulation.now.exact_low
        bits = max(
            max(c.numerator.bit_length(), c.denominator.bit_length())
            for body in self.simulation.scene.bodies
            for point in body.exact_at(now)
            for c in point
        )
        memory = budget.resident_memory() / 2**20
        ms = 1000 * used / max(1, events)
        return Sample(elapsed, float(now), events, contacts, memory, bits, ms)

    # Actions

    def go_on(self) -> None:
        """Let time pass, with bounces."""
        self._advance(self.simulation, self.rng.randint(1, 64))
        if self.simulation.contact is not None:  # the same contact again: nothing can be done
            self.did["begun anew"] += 1
            self._begin_anew()

    def _advance(self, simulation: Simulation, steps: int) -> list[str]:
        now = simulation.now.canonical_interval()[1]
        until = QQ(int(now / STEP) + steps) * STEP

        def respond(simulation: Simulation, contact: Contact) -> None:
            self.did["contact"] += 1
            self.respond(simulation, contact)

        log = [json.dumps(e.to_json()) for e in simulation.run(until, on_contact=respond)]
        self.events += len(log)
        return log

    def plan(self) -> None:
        """Give a body another velocity."""
        body = self._any_body()
        if body is not None:
            velocity = self.rng.randint(-8, 8), self.rng.randint(-8, 8)
            now = self.simulation.now.exact_low
            self.simulation.set_motion(body.name, onward(body, now, velocity, grid=STEP))

    def come(self) -> None:
        """Put a new body into the box, where there is room."""
        if len(self.simulation.scene.bodies) >= MOST + len(WALLS):
            return
        rng, now = self.rng, self.simulation.now.exact_low
        x, y = rng.randint(8, SIDE - 8), rng.randint(8, SIDE - 8)
        corners = [(3, 0), (0, 3), (-3, 0), (0, -3), (2, 2), (-2, 2), (-2, -2), (2, -2)]
        order = [0, 4, 1, 5, 2, 6, 3, 7]
        shape = [corners[i] for i in order if rng.random() < 0.6]
        vx, vy = rng.randint(-8, 8), rng.randint(-8, 8)
        motion = Translation([x - vx * now, vx], [y - vy * now, vy])
        self.made += 1
        try:
            self.simulation.add(Body(f"body {self.made}", shape or corners[:1], motion))
        except InputError:
            self.did["no room"] += 1

    def go(self) -> None:
        """Take a body out of the box."""
        body = self._any_body()
        if body is not None and len(self.simulation.scene.bodies) > FEWEST + len(WALLS):
            self.simulation.remove(body.name)

    def copy(self) -> None:
        """Let a copy go on for a while: it does the same as the original."""
        twin = self.simulation.copy()
        steps = self.rng.randint(1, 16)
        if self._advance(twin, steps) != self._advance(self.simulation, steps):
            raise AuditError("a copy goes on in another way")
        if self.simulation.contact is not None:
            self._begin_anew()

    def save(self) -> None:
        """Save the run, and go on with the restored one."""
        with TemporaryDirectory() as folder:
            path = Path(folder) / "run.json"
            self.simulation.save(path)
            restored = Simulation.restore(path)
        if restored.to_json() != self.simulation.to_json():
            raise AuditError("a restored run has another state")
        self.simulation = restored

    def audit(self) -> None:
        """Compare the tiling with the static one; no two bodies overlap."""
        audit(self.simulation)
        if initial_touches(self._scene_now())[1]:
            raise AuditError("bodies overlap")

    def prove(self) -> None:
        """Prove the next part, and have the proof checked by the independent program."""
        now = self.simulation.now.exact_low
        scene = self._scene_now().until(now + self.rng.randint(1, 16) * STEP)
        text = json.dumps(to_json(scene)).encode()
        with TemporaryDirectory() as folder:
            path = Path(folder) / "answer.proof"
            write_proof(scene, path, scene_file=text, tiling=self.tiling)
            try:
                proof_check.check(text, path.read_bytes())
            except proof_scene.Rejected as verdict:
                raise AuditError(f"a proof is rejected: {verdict}") from None

    def _scene_now(self) -> Scene:
        """The bodies from now on."""
        return Scene(self.simulation.scene.bodies, (self.simulation.now.exact_low, END))

    def _any_body(self) -> Body | None:
        names = [b.name for b in self.simulation.scene.bodies if b.name not in WALLS]
        return self.simulation.body(self.rng.choice(names)) if names else None


def table(soak: Soak) -> list[str]:
    """The curve of memory, digits and speed, and the number of actions of each kind."""
    lines = [f"{'seconds':>8}{'t':>10}{'events':>8}{'contacts':>9}{'MB':>8}{'bits':>6}{'ms':>8}"]
    lines += [
        f"{s.seconds:>8.0f}{s.time:>10.1f}{s.events:>8}{s.contacts:>9}"
        f"{s.memory:>8.1f}{s.digits:>6}{s.ms:>8.2f}"
        for s in soak.samples
    ]
    did = ", ".join(f"{word.replace('_', ' ')} {n}" for word, n in sorted(soak.did.items()))
    return [*lines, did]


def verdict(soak: Soak) -> list[str]:
    """Return the quantities that have grown from the second third of the soak to the last."""
    third = len(soak.samples) // 3
    if not third:
        return []
    grown = []
    for name in ("memory", "digits", "ms"):
        before = median(getattr(s, name) for s in soak.samples[third : 2 * third])
        after = median(getattr(s, name) for s in soak.samples[2 * third :])
        if after > max(GROWTH * before, before + MARGIN):
            grown.append(f"{name}: {before:.1f} became {after:.1f}")
    return grown
