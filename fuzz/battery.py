"""The battery: large, highly degenerate scenes with known answers.

Every tiling is compared with the all-pairs reference, or with the answer known by construction if
the reference would take too long; CGAL verifies snapshots at sampled times.
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Final

from exactpt import Body, Contact, ExactPTError, Rigid, Scene, Simulation, Translation
from exactpt.cgal import BodyShape, CgalCheck
from exactpt.kernel.numbers import QQ
from exactpt.testing import reference
from exactpt.testing.agreement import disagreement
from exactpt.testing.scenes.degenerate import grids, rings
from exactpt.testing.scenes.shapes import box, poly
from fuzz.witnesses import tilings_of

__all__ = ["BATTERY", "Row", "Trial", "play", "table"]

NEVER: Final = "never"


@dataclass(frozen=True, slots=True)
class Trial:
    """A scene of the battery.

    Attributes:
        build: a function that makes it.
        contact: the time of its first contact, or `NEVER`.
        large: whether the reference takes minutes.
    """

    build: Callable[[], Scene]
    contact: QQ | str
    large: bool = False


@dataclass(slots=True)
class Row:
    """The result of a scene with a tiling.

    Attributes:
        name, tiling: the scene and the tiling.
        bodies: number of bodies.
        events: number of events of all kinds.
        batches: number of times at which several certificates failed.
        rebuilds: number of times that the tiling was rebuilt.
        flips: number of flips in repairs.
        exact: number of decisions by exact arithmetic.
        contact: the first contact, in words.
        snapshots: number of tilings that CGAL has accepted.
        differences: one line for each.
        seconds: processor time of the run itself.
    """

    name: str
    tiling: str
    bodies: int
    events: int = 0
    batches: int = 0
    rebuilds: int = 0
    flips: int = 0
    exact: int = 0
    contact: str = NEVER
    snapshots: int = 0
    differences: list[str] = field(default_factory=list)
    seconds: float = 0.0


def _row_of_boxes(speeds: Sequence[int], gap: int) -> Scene:
    bodies = [
        Body(f"b{i}", box((2 + gap) * i, 0), Translation([0, v])) for i, v in enumerate(speeds)
    ]
    return Scene(bodies, (0, 10))


def _in_step(n: int, pitch: int) -> Scene:
    turn = poly(0, 1)
    bodies = []
    for i in range(n):
        for j in range(n):
            x, y = QQ(pitch * i), QQ(pitch * j)
            if (i + j) % 2:
                outline = [(x + 2, y), (x, y + 2), (x - 2, y), (x, y - 2)]
            else:
                outline = [(x + a, y + b) for a, b in _OCTAGON]
            bodies.append(Body(f"b{i}.{j}", outline, Rigid(turn, pivot=(x, y))))
    return Scene(bodies, (0, 2))


_OCTAGON: Final = tuple(
    (QQ(2 * a, 5), QQ(2 * b, 5))
    for a, b in ((5, 0), (4, 3), (0, 5), (-4, 3), (-5, 0), (-4, -3), (0, -5), (4, -3))
)


def _mirrored(n: int) -> Scene:
    """Pairs of bodies that pass near each other below and above a mirror line without contact."""
    bodies = []
    for i in range(n):
        x, y = 10 * i, 3 + i % 3
        speed = (-1) ** i * (1 + i % 2)
        for name, s in (("up", 1), ("down", -1)):
            outline = [(x, s * y), (x + 4, s * y), (x + 2 + i % 2, s * (y + 3))]
            motion = Translation([0, speed], [0, 0, QQ(s, 8)])
            bodies.append(Body(f"{name}{i}", outline, motion))
    return Scene(bodies, (0, 2))


def _convoy(n: int) -> Scene:
    motion = Translation([0, 3, -1], [0, QQ(1, 7), 0, 2])
    bodies = [Body(f"b{i}.{j}", box(3 * i, 3 * j), motion) for i in range(n) for j in range(n)]
    return Scene(bodies, (0, 9))


def _sweeps(n: int, gap: QQ) -> Scene:
    """Boxes that sweep along the edges of long tables, all at the same distance."""
    bodies = []
    for i in range(n):
        y = 5 * i
        bodies.append(Body(f"table{i}", box(0, y, 30, 2)))
        bodies.append(Body(f"sweeper{i}", box(-5, y + 2 + gap), Translation([0, 4])))
    return Scene(bodies, (0, 10))


def _grazing(n: int, miss: QQ) -> Scene:
    """Bodies thrown up to a ceiling, which all reach it at t = 2 or miss it by ``miss``."""
    rise = 8 - miss
    motion = Translation([], poly(0, rise, -rise / 4))
    ceiling = Body("ceiling", box(-5, 10, 6 * n + 10, 2))
    bodies = [Body(f"b{i}", [(6 * i, 0), (6 * i + 4, 0), (6 * i + 2, 2)], motion) for i in range(n)]
    return Scene([ceiling, *bodies], (0, 4))


_UP: Final = Translation([], [0, 1])
_TINY: Final = QQ(1, 10**30)

BATTERY: Final[dict[str, Trial]] = {
    "grids 5x5 through the gaps": Trial(lambda: grids(5, 5, QQ(3), _UP), NEVER),
    "grids 5x5, a hair's breadth": Trial(lambda: grids(5, 5, 2 + _TINY, _UP), NEVER),
    "grids 5x5, side to side": Trial(lambda: grids(5, 5, QQ(2), _UP), QQ(4)),
    "grids 5x5, head on": Trial(lambda: grids(5, 5, QQ(1), _UP), QQ(4)),
    "grids 20x20 through the gaps": Trial(lambda: grids(20, 5, QQ(3), _UP), NEVER, large=True),
    "row end to end": Trial(lambda: _row_of_boxes([1, -1] * 10, 4), QQ(2)),
    "row, accordion": Trial(lambda: _row_of_boxes(range(-10, 10), 4), NEVER),
    "row, closing in": Trial(lambda: _row_of_boxes(range(10, -10, -1), 4), QQ(4)),
    "polygons in step, 5x5": Trial(lambda: _in_step(5, 5), NEVER),
    "polygons in step, corner to corner": Trial(lambda: _in_step(3, 4), QQ(0)),
    "mirror images": Trial(lambda: _mirrored(8), NEVER),
    "one velocity, 8x8": Trial(lambda: _convoy(8), NEVER),
    "concentric rings": Trial(
        lambda: rings([8, 8, 8], [QQ(1), QQ(-1), QQ(1, 2)], 2, (0, 4)), NEVER
    ),
    "concentric rings in step": Trial(lambda: rings([4, 8, 8, 8], [QQ(1)] * 4, 2, (0, 2)), NEVER),
    "sweeping along edges": Trial(lambda: _sweeps(8, QQ(0)), QQ(3, 4)),
    "sweeping a hair above": Trial(lambda: _sweeps(8, _TINY), NEVER),
    "100 grazing contacts": Trial(lambda: _grazing(100, QQ(0)), QQ(2)),
    "100 near misses": Trial(lambda: _grazing(100, _TINY), NEVER),
}
"""The scenes by name."""


def play(name: str, *, samples: int = 5, cgal: bool = True) -> Iterator[Row]:
    """Run a scene of the battery with every tiling that supports it."""
    trial = BATTERY[name]
    scene = trial.build()
    expected = None if trial.large else reference.first_contact(scene)
    for tiling in tilings_of(scene):
        row = Row(name, tiling, len(scene.bodies))
        began = clock.perf_counter()
        try:
            contact = _run(scene, row)
        except ExactPTError as error:
            row.differences.append(f"{type(error).__name__}: {error}")
            yield row
            continue
        row.seconds = clock.perf_counter() - began
        found = NEVER if contact is None else str(contact.time.simplified().low)
        row.contact = found if contact is None else f"{found} ({len(contact.pairs)} pairs)"
        if found != str(trial.contact):
            row.differences.append(f"contact {found}, by construction {trial.contact}")
        if not trial.large and (difference := disagreement(expected, contact)):
            row.differences.append(f"contact: {difference.what} differs from the reference")
        if cgal:
            _look(scene, row, contact, samples)
        yield row


def _run(scene: Scene, row: Row) -> Contact | None:
    simulation = Simulation(scene, tiling=row.tiling)
    contact = simulation.run_to_contact()
    stats = simulation.stats
    for what in ("events", "batches", "rebuilds", "flips", "exact"):
        value = stats.get(what, 0)
        setattr(row, what, value)
    return contact


def _look(scene: Scene, row: Row, contact: Contact | None, samples: int) -> None:
    """Have CGAL verify snapshots at times spread over the span before the contact."""
    end = scene.end if contact is None else contact.time.low
    times = [scene.start + (end - scene.start) * i / samples for i in range(samples)]
    shapes = BodyShape.of_scene(scene)
    if contact is not None and contact.kind == "initial":
        return
    with CgalCheck() as witness:
        simulation = Simulation(scene, tiling=row.tiling)
        for t in times:
            for _ in simulation.run(t):
                pass
            verdict = witness.check_tiling(simulation.snapshot().to_json(), shapes)
            if verdict.ok:
                row.snapshots += 1
            else:
                row.differences.append(f"t = {t}: CGAL: {verdict.reason}")


def table(rows: Sequence[Row]) -> list[str]:
    """The rows as lines of text, with the differences below each."""
    head = (
        f"{'scene':36}{'tiling':9}{'bodies':>7}{'events':>8}{'batches':>8}{'rebuilds':>9}"
        f"{'flips':>6}{'exact':>8}{'CGAL':>5}{'differ':>7}{'seconds':>8}  contact"
    )
    lines = [head]
    for r in rows:
        lines.append(
            f"{r.name:36}{r.tiling:9}{r.bodies:>7}{r.events:>8}{r.batches:>8}{r.rebuilds:>9}"
            f"{r.flips:>6}{r.exact:>8}{r.snapshots:>5}{len(r.differences):>7}{r.seconds:>8.2f}"
            f"  {r.contact}"
        )
        lines += [f"    {difference}" for difference in r.differences]
    return lines
