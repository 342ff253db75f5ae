"""Convex bodies that bounce in a box: contacts a second, and the cost of a change of plan.

The bodies move straight, and get new velocities at every contact. The rate of the last third of
the contacts beside that of the first shows if a run slows down with its age. Audits are
timed apart: all angles of the tiling, and that no two bodies touch.
"""

from __future__ import annotations

import gc
from random import Random
from time import process_time
from typing import Final, NamedTuple, final

from benchmarks.output import Output, Row
from exactpt import AuditError, Body, Bounce, Contact, Scene, Simulation, Translation, onward
from exactpt.certificates.at_time import PredicatesAt
from exactpt.kernel.numbers import QQ
from exactpt.pair.start import initial_touches
from exactpt.testing.scenes.shapes import cells, convex_polygon
from exactpt.tiling.tiling import Tiling

__all__ = ["FULL", "QUICK", "Living", "Sizes", "audit", "box", "run"]

WIDTH: Final = 10
"""Width of the cell of a body at the start."""

SPEED: Final = 8
"""Maximum absolute value of each coordinate of a velocity at the start; twice that later."""

LOOKS: Final = 30
"""Number of times that a run looks at the clock, which may be slow itself."""

WALLS: Final = ("south", "east", "north", "west")


class Sizes(NamedTuple):
    """Size of the benchmark.

    Attributes:
        bodies: numbers of bodies that bounce.
        tilings: the tilings that are kept.
        contacts: number of contacts of a run.
        audit_every: number of contacts from one audit to the next.
        plans: number of changes of plans that are timed.
    """

    bodies: tuple[int, ...]
    tilings: tuple[str, ...]
    contacts: int
    audit_every: int
    plans: int


QUICK: Final = Sizes((20,), ("lazy", "greedy"), 60, 20, 20)
FULL: Final = Sizes((100, 1000, 10000), ("lazy", "greedy"), 6000, 1000, 1000)


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Measure every tiling with every number of bodies.

    Raises:
        AuditError: if an audit fails.
    """
    rows: list[Row] = []
    for bodies in sizes.bodies:
        for tiling in sizes.tilings:
            output.progress(f"living: {bodies} bodies, {tiling}")
            living = Living(box(bodies, Random(f"living:{bodies}:{seed}")), tiling, sizes)
            rows.append({"bodies": bodies, "tiling": tiling, **living.measured(seed)})
    output.table("living", rows)


def box(bodies: int, rng: Random) -> Scene:
    """Convex bodies in cells of a square, with random velocities, between four walls."""
    moving = []
    for i, (cx, cy) in enumerate(cells(rng, bodies, WIDTH)):
        x, y = (QQ(rng.randint(-SPEED << 20, SPEED << 20), 1 << 20) for _ in range(2))
        outline = convex_polygon(rng, (cx, cy), WIDTH // 2 - 1, rng.randint(3, 7))
        moving.append(Body(f"b{i}", outline, Translation([0, x], [0, y])))
    points = [p for body in moving for p in body.exact_at(QQ(0))]
    (left, right), (below, above) = (
        (min(p[k] for p in points) - 1, max(p[k] for p in points) + 1) for k in (0, 1)
    )
    outer_left, outer_right = left - WIDTH, right + WIDTH
    sides = (
        (outer_left, below - WIDTH, outer_right, below),
        (right, below + 1, outer_right, above - 1),
        (outer_left, above, outer_right, above + WIDTH),
        (outer_left, below + 1, left, above - 1),
    )
    walls = [
        Body(name, [(a, b), (c, b), (c, d), (a, d)])
        for name, (a, b, c, d) in zip(WALLS, sides, strict=True)
    ]
    return Scene([*moving, *walls], (0, 10**6))


@final
class Living:
    """A run of bodies that bounce.

    Args:
        scene: bodies between `WALLS`.
        tiling: the tiling to keep.
        sizes: how many contacts, audits and changes.

    Attributes:
        simulation: the run.
    """

    def __init__(self, scene: Scene, tiling: str, sizes: Sizes) -> None:
        self._sizes = sizes
        self._bounce = Bounce(WALLS, fastest=2 * SPEED)
        self.simulation = Simulation(scene, tiling=tiling)
        self._contacts = 0
        self._look_every = max(1, sizes.contacts // LOOKS)
        self._audits: list[float] = []
        self._clock: list[float] = []

    def measured(self, seed: int) -> Row:
        """The figures of the run, by name of the column."""
        simulation, clock = self.simulation, self._clock
        gc.collect()
        clock.append(process_time())
        for _ in simulation.run(on_contact=self._respond):
            if self._contacts >= self._sizes.contacts:
                break
        third, kinetic = len(clock) // 3, _tiling_of(simulation)
        exact, filtered, _ = kinetic.vertices.counters.now()
        return {
            "contacts": self._contacts,
            "contacts a second": self._look_every * (len(clock) - 1) / (clock[-1] - clock[0]),
            "last third / first": (clock[third] - clock[0]) / (clock[-1] - clock[-1 - third]),
            "events a contact": kinetic.stats.total / self._contacts,
            "exact in 1000": 1000 * exact / (exact + filtered),
            "ms an audit": 1000 * sum(self._audits) / max(1, len(self._audits)),
            "us a change of plan": 1e6 * self._change_plans(Random(f"plans:{seed}")),
        }

    def _respond(self, simulation: Simulation, contact: Contact) -> None:
        """Bounce; now and then audit, and note the processor time without that of audits."""
        self._bounce(simulation, contact)
        self._contacts += 1
        if self._contacts % self._sizes.audit_every == 0:
            began = process_time()
            audit(simulation)
            self._audits.append(process_time() - began)
        if self._contacts % self._look_every == 0:
            self._clock.append(process_time() - sum(self._audits))

    def _change_plans(self, rng: Random) -> float:
        """Seconds for a change of one body's velocity, at the current time."""
        simulation = self.simulation
        now, names = (
            simulation.now.exact_low,
            [b.name for b in simulation.scene.bodies[: -len(WALLS)]],
        )
        plans = []
        for name in rng.choices(names, k=self._sizes.plans):
            velocity = [QQ(rng.randint(-SPEED << 20, SPEED << 20), 1 << 20) for _ in range(2)]
            plans.append((name, onward(simulation.body(name), now, velocity)))
        began = process_time()
        for name, plan in plans:
            simulation.set_motion(name, plan)
        return (process_time() - began) / len(plans)


def audit(simulation: Simulation) -> None:
    """Check all angles of the tiling just after now, and that no two bodies touch.

    Raises:
        AuditError: if an angle is not as marked, or bodies touch.
    """
    if initial_touches(simulation.scene)[1]:
        raise AuditError(f"bodies touch at t = {float(simulation.now)!r}")
    kinetic = _tiling_of(simulation)
    mesh = kinetic.mesh_after()
    mesh.audit()
    kinetic.audit(mesh, PredicatesAt(kinetic.vertices, simulation.now.exact_low))


def _tiling_of(simulation: Simulation) -> Tiling:
    if simulation.kinetic is None:
        raise AuditError("the bodies touch at the start")
    return simulation.kinetic
