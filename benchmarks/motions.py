"""First contacts in any motion by turns with version 0.2, in two processes.

Version 0.2 is in plain Python, as `make old-engine` builds it; this version as it is here. In each
turn both are asked the same question, first the old one, about a scene that each builds anew. The
building is measured only where a part of it may be left to the search: see `FITTED`. Times are the
least of some turns, so that whatever else the machine does is shared by both; but of a busy machine
both are longer than those of an idle one.

Aims were set before: how many times as fast as version 0.2, or how many milliseconds. And a crowd
with one body beside it that is unlike all others was to take at most 1.5 times as long as the crowd
alone.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Final, NamedTuple, final

import exactpt
from benchmarks.methods.own import in_build
from benchmarks.motion_scenes import BESIDE, FITTED, PLANS, SCENES, Asked
from benchmarks.output import Output, Row
from exactpt import AuditError
from fuzz.old_engine.build import SITE, is_built

__all__ = ["FULL", "QUICK", "Sizes", "run"]

SCRIPT: Final = Path(__file__).with_name("motion_scenes.py")
HERE: Final = Path(exactpt.__file__).parents[1]
OLD: Final = "version 0.2"

AIMS: Final[Mapping[str, str]] = {
    "two polygons with constant rates": "2 ms",
    "turning bodies": "35 times",
    "combs": "14 times",
    "holes": "8 times",
    "deforming stars": "3 times",
    "discs": "2 times",
    PLANS: "10 times",
}
"""What was aimed at, by scene: times as fast as version 0.2, or milliseconds."""

NEARLY: Final = 1e-3
"""More than times of contacts of `FITTED` differ: the two versions fit different pieces."""


class Sizes(NamedTuple):
    """Sizes of scenes by name, number of bodies of a crowd beside another one, number of turns."""

    scenes: Mapping[str, Sequence[int]]
    crowd: int
    turns: int


QUICK: Final = Sizes(dict.fromkeys([*SCENES, PLANS], (24,)), crowd=100, turns=1)
FULL: Final = Sizes(
    {
        "two triangles": (2,),
        "a triangle on a parabola": (2,),
        "a square that turns": (2,),
        "two polygons with constant rates": (2,),
        "constant rates, apart": (100,),
        "a dense crowd": (10, 100, 1000, 10_000),
        "a sparse crowd": (1000,),
        "turning bodies": (10, 100, 1000),
        "turning bodies, faster and faster": (100, 400),
        "turning stars, apart": (16, 64),
        "combs": (256, 1024, 4096),
        "holes": (200,),
        "deforming stars": (4, 64, 256),
        "discs": (100, 1000),
        PLANS: (1000,),
    },
    crowd=1000,
    turns=5,
)


@final
class _Engine:
    """A process that answers by one version.

    Args:
        process: the process, see `benchmarks.motion_scenes`.
        site: the folder of its package.

    Raises:
        AuditError: if another package answers.
    """

    def __init__(self, process: subprocess.Popen[str], site: Path) -> None:
        self._process = process
        where = Path(json.loads(self._line())["where"])
        if not where.is_relative_to(site):
            raise AuditError(f"motions: {where} answers instead of {site}")

    def ask(self, scene: str, size: int, seed: int) -> Asked:
        """Return what the process says about a scene."""
        assert self._process.stdin is not None  # noqa: S101
        request = {"scene": scene, "size": size, "seed": seed}
        self._process.stdin.write(json.dumps(request) + "\n")
        self._process.stdin.flush()
        return Asked(**json.loads(self._line()))

    def _line(self) -> str:
        assert self._process.stdout is not None  # noqa: S101
        line = self._process.stdout.readline()
        if not line:
            raise AuditError("motions: a process has ended")
        return line


@contextmanager
def _engine(site: Path) -> Iterator[_Engine]:
    """Start the process of a version; it ends with the context."""
    # -P: the folder of the script is not searched. PYTHONPATH comes before what is installed.
    with subprocess.Popen(
        [sys.executable, "-P", str(SCRIPT)],
        env={**os.environ, "PYTHONPATH": str(site)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        encoding="utf-8",
    ) as process:
        try:
            yield _Engine(process, site)
        finally:
            process.kill()


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Measure all scenes.

    Raises:
        AuditError: if the two versions have different results.
    """
    sites = {in_build("this version"): HERE}
    if is_built():
        sites = {OLD: SITE, **sites}
    else:
        output.say("skipped: version 0.2 is not built (make old-engine)")
    with ExitStack() as stack:
        engines = {name: stack.enter_context(_engine(site)) for name, site in sites.items()}
        rows = []
        for scene, chosen in sizes.scenes.items():
            for size in chosen:
                output.progress(f"motions: {scene}, {size}")
                asked = _by_turns(engines, scene, size, seed, sizes.turns)
                rows.append(_row(scene, asked))
        beside = [_by_turns(engines, what, sizes.crowd, seed, sizes.turns) for what in BESIDE]
    output.table("motions", rows)
    output.table("motions-beside", _rows_beside(beside))


def _by_turns(
    engines: Mapping[str, _Engine], scene: str, size: int, seed: int, turns: int
) -> dict[str, Asked]:
    """Return by version what it says, with its least time.

    Raises:
        AuditError: if the versions have different results.
    """
    least: dict[str, Asked] = {}
    for _ in range(turns):
        for name, engine in engines.items():
            asked = engine.ask(scene, size, seed)
            if name not in least or asked.seconds < least[name].seconds:
                least[name] = asked
    first, *others = least.values()
    if not all(_agree(scene, first, other) for other in others):
        said = {name: asked.found[:3] for name, asked in least.items()}
        raise AuditError(f"motions: the versions disagree about {scene}, {size}: {said}")
    return least


def _agree(scene: str, one: Asked, other: Asked) -> bool:
    """Return True if the times are the same, or of bodies that are fitted, nearly so."""
    if scene not in FITTED:
        return one.found == other.found
    times = zip(one.doubles, other.doubles, strict=True)
    return all(a is b or (a and b and abs(a - b) < NEARLY) for a, b in times)


def _row(scene: str, asked: Mapping[str, Asked]) -> Row:
    old, new = asked.get(OLD), asked[in_build("this version")]
    return {
        "scene": scene,
        "bodies": new.bodies,
        "vertices": new.vertices,
        "old ms": None if old is None else 1000.0 * old.seconds,
        "new ms": 1000.0 * new.seconds,
        "times as fast": None if old is None else old.seconds / new.seconds,
        "aim": AIMS.get(scene, ""),
        "contact": new.doubles[0] if scene != PLANS else None,
    }


def _rows_beside(asked: Sequence[Mapping[str, Asked]]) -> list[Row]:
    """Return a row of each body beside a crowd, with the ratio to the crowd alone."""
    name = in_build("this version")
    alone = asked[0]
    rows: list[Row] = []
    for what, each in zip(BESIDE, asked, strict=True):
        ratios = {
            version: each[version].seconds / alone[version].seconds if version in each else None
            for version in (OLD, name)
        }
        old = each.get(OLD)
        rows.append(
            {
                "beside": what,
                "bodies": each[name].bodies,
                "old ms": None if old is None else 1000.0 * old.seconds,
                "new ms": 1000.0 * each[name].seconds,
                "old times alone": ratios[OLD],
                "new times alone": ratios[name],
            }
        )
    return rows
