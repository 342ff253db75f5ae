"""Work that is never done: certificates, polynomials, exact times, comparisons, imports.

Each scene is run to its first contact twice: as usual, and with every certificate decided by
exact arithmetic. Calls are counted with the profiler of the standard library.
"""

from __future__ import annotations

import cProfile
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from random import Random
from typing import Final, NamedTuple

import exactpt
from benchmarks.first_contact import FAMILIES
from benchmarks.methods.own import fresh
from benchmarks.output import Output, Row
from benchmarks.timing import timed
from exactpt import AlgebraicNumber, AuditError, Body, Scene, Simulation, Translation
from exactpt.certificates import perturbation
from exactpt.kernel.isolated_root import IsolatedRoot
from exactpt.motion.track import orientation_polynomial
from exactpt.tiling.start import tiling_for_contact

__all__ = ["FULL", "QUICK", "Sizes", "run"]

CALLS: Final = {
    "polynomials": (
        orientation_polynomial,
        perturbation.copy_orientation,
        perturbation.x_order,
        perturbation.cross,
    ),
    "exact times": (IsolatedRoot.__init__, IsolatedRoot.root, IsolatedRoot.surd),
    "comparisons": (AlgebraicNumber.compare,),
}
"""The functions whose calls are counted; they are plain Python in every build."""


class Sizes(NamedTuple):
    """Sizes of the scenes of `first_contact`, by family; and of a convoy."""

    sizes: Mapping[str, int]
    convoy: int


QUICK: Final = Sizes({"dense": 30, "clamps": 5, "combs": 16, "deforming": 4, "grazing": 4}, 20)
FULL: Final = Sizes(
    {
        "sparse": 300,
        "dense": 300,
        "clamps": 100,
        "combs": 256,
        "spirals": 256,
        "deforming": 16,
        "grazing": 16,
        "thin and fast": 100,
    },
    300,
)


class _Paid(NamedTuple):
    """The cost of a run: counts by name, and seconds."""

    counts: dict[str, int]
    seconds: float
    contact: AlgebraicNumber | None


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Compare the counts of both runs.

    Raises:
        AuditError: if the two find different contacts.
    """
    scenes = {
        family: FAMILIES[family](size, Random(f"skipping:{family}:{seed}"))
        for family, size in sizes.sizes.items()
    }
    crowd = FAMILIES["sparse"](sizes.convoy, Random(f"skipping:convoy:{seed}"))
    scenes["convoy"] = Scene(
        [Body(b.name, b.vertices, Translation([0, 3], [0, 5])) for b in crowd.bodies], (0, 100)
    )
    rows: list[Row] = []
    for name, scene in scenes.items():
        output.progress(name)
        paid, full = (_pay(scene, exact_only=exact_only) for exact_only in (False, True))
        if paid.contact != full.contact:
            raise AuditError(f"skipping, {name}: {paid.contact} is not {full.contact}")
        for what, count in paid.counts.items():
            of = full.counts[what]
            if what == "certificates":  # neither run computes those that cannot fail
                of = count + paid.counts["certificates that cannot fail"]
            elif what == "certificates that cannot fail":
                continue
            rows.append(_row(name, what, count, of))
        rows.append(_row(name, "seconds", paid.seconds, full.seconds))
    for method in ("kinetic", "pairs"):
        loaded, there = _modules(scenes["convoy"], method)
        rows.append(_row(f"imports, {method}", "modules of exactpt", loaded, there))
    output.table("skipping", rows)


def _row(scene: str, what: str, paid: float, of: float) -> Row:
    return {
        "scene": scene,
        "what": what,
        "paid": paid,
        "without skipping": of,
        "never paid": 1 - paid / of if of else None,
    }


def _pay(scene: Scene, *, exact_only: bool) -> _Paid:
    _run(fresh(scene), exact_only=exact_only)  # imports on first use are not counted
    given = fresh(scene)
    _, seconds = timed(lambda: _run(given, exact_only=exact_only))
    profile = cProfile.Profile(builtins=False)
    simulation = profile.runcall(_run, fresh(scene), exact_only=exact_only)
    stats = simulation.stats
    counts = {
        "certificates": _whole(stats["certificates"]),
        "certificates that cannot fail": _whole(stats["skipped"]),
        "exact decisions": _whole(stats["exact"]),
        **_calls(profile),
    }
    return _Paid(counts, seconds, simulation.contact and simulation.contact.time)


def _run(scene: Scene, *, exact_only: bool) -> Simulation:
    """A run to the first contact, with its preparation."""
    tiling = tiling_for_contact(scene, "auto")
    simulation = Simulation(scene, tiling=tiling, exact_only=exact_only)
    simulation.run_to_contact()
    return simulation


def _whole(count: object) -> int:
    if not isinstance(count, int):
        raise TypeError(f"not a count: {count!r}")
    return count


def _calls(profile: cProfile.Profile) -> dict[str, int]:
    """Number of calls of the counted functions."""
    made = {entry.code: entry.callcount for entry in profile.getstats()}
    return {
        what: sum(made.get(function.__code__, 0) for function in functions)
        for what, functions in CALLS.items()
    }


def _modules(scene: Scene, method: str) -> tuple[int, int]:
    """Number of modules of exactpt that a first contact imports, and number of all modules."""
    package = Path(exactpt.__file__).parent
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.json"
        scene.save(path)
        code = (
            f"import sys, exactpt\n"
            f"exactpt.first_contact(exactpt.Scene.load({str(path)!r}), method={method!r})\n"
            f"print(sum(m.split('.')[0] == 'exactpt' for m in sys.modules))\n"
        )
        printed = _printed([sys.executable, "-c", code], package.parent)
    return int(printed), sum(1 for _ in package.rglob("*.py"))


def _printed(command: Sequence[str], where: Path) -> str:
    environment = {**os.environ, "PYTHONPATH": str(where)}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    return done.stdout
